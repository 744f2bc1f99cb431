// SPDX-License-Identifier: Apache-2.0
/// @file The robot, drives and sensors that one lane simulates.
#pragma once

#include "articula/dynamics/varied_robot.hpp"
#include "articula/sim/lost_commands.hpp"
#include "articula/sim/simulator_options.hpp"

namespace articula {

/// The robot of one lane, its start, drives and sensors.
/// @tparam R  the kind of robot, the same in all lanes
template <DescribedRobot R>
struct LaneSetup {
  VariedRobot<R> robot{};
  /// Start, sensors and seed of this lane. Period and substeps are the same in all lanes.
  SimulatorOptions<joint_count<R>> simulation{};
  /// Delay of the command, 0 .. 1 000 000 [cycles]. The drives give no effort before the first
  /// command.
  int delay = 0;
  LostCommands lost{};  ///< before their delay
};

}  // namespace articula
