// SPDX-License-Identifier: Apache-2.0
/// @file One cycle of a loop as programs outside the loop see it.
#pragma once

#include "articula/core/status.hpp"
#include "articula/loop/cycle_input.hpp"
#include "articula/loop/supervision/loop_mode.hpp"
#include "articula/recording/loop_change.hpp"

#include <cstdint>
#include <vector>

namespace articula::remote {

/// What was measured, asked for and commanded in one cycle. The vectors have a number for each
/// joint of the RobotSheet.
struct Cycle {
  std::uint64_t number = 0;  ///< counts the cycles of the loop
  double time = 0;           ///< of the loop [s]
  Status status = Status::ok;
  LoopMode mode = LoopMode::active;
  std::vector<double> position{};                ///< q [rad or m]
  std::vector<double> velocity{};                ///< v [rad/s or m/s]
  std::vector<double> effort{};                  ///< [N m or N]
  std::vector<double> reference_position{};      ///< [rad or m]
  std::vector<double> reference_velocity{};      ///< [rad/s or m/s]
  std::vector<double> reference_acceleration{};  ///< [rad/s^2 or m/s^2]
  std::vector<double> reference_effort{};        ///< [N m or N]
  std::vector<std::vector<double>> command{};    ///< one vector for each of RobotSheet::commands
  double latency = 0;                            ///< from when the cycle was due to its start [s]
  double period = 0;                             ///< from the start of the last cycle to its [s]
  double update = 0;                             ///< what the loop's update took [s]
  CycleInput input{};                            ///< what else its command depends on
  std::vector<LoopChange> changes{};             ///< made before this cycle, in their order
};

/// Statistics since the start of a run. Durations in seconds.
struct Statistics {
  std::uint64_t cycles = 0;
  std::uint64_t overruns = 0;
  std::uint64_t dropped = 0;  ///< cycles that the outside was too slow to take over
  double latency_median = 0, latency_99 = 0, latency_max = 0;
  double execution_median = 0, execution_99 = 0, execution_max = 0;
};

}  // namespace articula::remote
