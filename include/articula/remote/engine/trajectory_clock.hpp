// SPDX-License-Identifier: Apache-2.0
/// @file The time of a trajectory beside that of its loop.
#pragma once

#include "articula/reference/speed_override.hpp"

#include <optional>

namespace articula::remote {

/// How the time of a trajectory runs at the moment.
struct TrajectoryClock {
  double loop_time = 0;  ///< the present of the loop [s]
  /// The trajectory's own time then. None before its start and after its end.
  std::optional<SpeedOverride> own{};

  /// The trajectory's own time at a later time of the loop [s], if nobody changes the speed.
  /// @pre  own
  /// Real-time: yes.
  [[nodiscard]] SpeedOverride at(double later) const noexcept {
    SpeedOverride then = *own;
    then.advance(later - loop_time);
    return then;
  }
};

}  // namespace articula::remote
