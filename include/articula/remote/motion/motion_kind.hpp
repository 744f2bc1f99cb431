// SPDX-License-Identifier: Apache-2.0
/// @file The kinds of sources of a remote loop's reference.
#pragma once

#include <string_view>

namespace articula::remote {

/// The source of a reference.
enum class MotionKind : unsigned char {
  rest,        ///< The reference does not change.
  go,          ///< a jerk-limited profile
  set,         ///< numbers that another program computes
  trajectory,  ///< a trajectory through points
  signals,     ///< signals around a reference
  stop,        ///< the end of any other motion
};

/// The kind in a word. Real-time: yes.
[[nodiscard]] constexpr std::string_view to_string(MotionKind kind) noexcept {
  switch (kind) {
    case MotionKind::rest:
      return "rest";
    case MotionKind::go:
      return "go";
    case MotionKind::set:
      return "set";
    case MotionKind::trajectory:
      return "trajectory";
    case MotionKind::signals:
      return "signals";
    case MotionKind::stop:
      return "stop";
  }
  return "unknown motion";
}

}  // namespace articula::remote
