// SPDX-License-Identifier: Apache-2.0
/// @file The modes of a supervised loop.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace articula {

/// What a supervised loop is about.
enum class LoopMode : unsigned char {
  inactive,  ///< It watches. The hardware is not active and is written nothing.
  starting,  ///< The hardware is active and gets safe commands until a good state comes.
  active,    ///< It controls.
  fault,     ///< Something went wrong. The safe behaviour goes on until it is acknowledged.
};

/// The mode in words. Real-time: yes.
[[nodiscard]] constexpr std::string_view to_string(LoopMode mode) noexcept {
  constexpr std::array<std::string_view, 4> names{"inactive", "starting", "active", "fault"};
  const auto index = static_cast<std::size_t>(mode);
  return index < names.size() ? names[index] : "unknown mode";
}

}  // namespace articula
