// SPDX-License-Identifier: Apache-2.0
/// @file The address of a value in a drive's object dictionary.
#pragma once

#include "articula/text/characters.hpp"

#include <cstdint>
#include <string>

namespace articula::canopen {

/// The address of a value in a node's object dictionary [CiA 301, 7.4].
struct ObjectAddress {
  std::uint16_t index = 0;
  std::uint8_t subindex = 0;

  friend constexpr bool operator==(const ObjectAddress&, const ObjectAddress&) = default;
};

/// An address in the notation of manuals, such as "6072h,0". Real-time: no (allocates).
[[nodiscard]] inline std::string to_string(const ObjectAddress& address) {
  return articula::detail::hexadecimal(address.index, 4) + "," + std::to_string(address.subindex);
}

}  // namespace articula::canopen
