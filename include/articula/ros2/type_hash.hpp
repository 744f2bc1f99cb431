// SPDX-License-Identifier: Apache-2.0
/// @file The hash by which ROS 2 compares types, since Iron.
#pragma once

#include "articula/ros2/sha256.hpp"
#include "articula/ros2/type_description.hpp"

#include <array>
#include <cstdint>
#include <string_view>

namespace articula::ros2 {

/// The text of a type hash: RIHS01_ and 64 hexadecimal digits.
using TypeHash = InlineText<71>;

/// Computes the hash of a message type from its struct. `type_hash` has the result as a constant.
/// Real-time: yes.
template <Message M>
constexpr TypeHash compute_type_hash() {
  Sha256 hash;
  describe<M>(hash);
  std::array<char, TypeHash::capacity> text{'R', 'I', 'H', 'S', '0', '1', '_'};
  std::size_t size = 7;
  for (const std::uint8_t byte : hash.finish()) {
    text[size++] = "0123456789abcdef"[byte >> 4];
    text[size++] = "0123456789abcdef"[byte & 15];
  }
  return std::string_view(text.data(), size);
}

/// The hash of a message type, computed by the compiler.
template <Message M>
inline constexpr TypeHash type_hash = compute_type_hash<M>();

}  // namespace articula::ros2
