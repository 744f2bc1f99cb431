// SPDX-License-Identifier: Apache-2.0
/// @file A question for the futures of a loop with other gains, and its answer.
#pragma once

#include "articula/futures/future_options.hpp"
#include "articula/loop/stop_flag.hpp"
#include "articula/remote/forecast/joint_margins.hpp"
#include "articula/remote/gains/parameter.hpp"
#include "articula/sim/simulation_end.hpp"

#include <optional>
#include <string>
#include <vector>

namespace articula::remote {

/// What was measured at an instant. Each vector has a number for each joint.
struct FuturesState {
  double time = 0;                 ///< of the loop [s]
  std::vector<double> position{};  ///< [rad or m]
  std::vector<double> velocity{};  ///< [rad/s or m/s]
  std::vector<double> effort{};    ///< [N m or N]
};

/// A reference. Each vector has a number for each joint; all but that of the positions may be
/// empty, which means 0.
struct FuturesReference {
  std::vector<double> position{};      ///< [rad or m]
  std::vector<double> velocity{};      ///< [rad/s or m/s]
  std::vector<double> acceleration{};  ///< [rad/s^2 or m/s^2]
  std::vector<double> effort{};        ///< [N m or N]
};

/// A recorded cycle before the futures begin.
struct FuturesCycle {
  FuturesState state{};
  FuturesReference reference{};
  std::vector<std::vector<double>> command{};  ///< one vector for each of RobotSheet::commands
};

/// A test step on a joint.
struct FuturesStep {
  std::string joint{};
  double height = 0;  ///< [rad or m]
};

/// Asks what the loop would do from now on with some other gains, before they are applied. Or asks
/// what it would have done from an instant of a recording on.
struct FuturesQuestion {
  /// The most cycles of all futures together.
  static constexpr double most_cycles = 1e6;
  /// The most positions in an answer: futures, samples and joints multiplied.
  static constexpr int most_positions = 200'000;
  /// The time for an answer. It has the futures that are complete by then [s].
  static constexpr double most_time = 2;

  std::vector<ParameterValue> gains{};  ///< that differ from those of the loop; may be empty
  FutureOptions options{};
  /// Where the futures begin. Without it: at the last cycle of the loop, which must be active.
  std::optional<FuturesState> start{};
  /// With a start: the recorded cycles before it, at least one, the last one a period before the
  /// start. From them the controller gets its memory. Begin them with a cycle in which no drive is
  /// at its limit: the command of that one tells what the integrals are.
  std::vector<FuturesCycle> history{};
  /// What the futures follow, from their start on, at equal distances of time. It is linear between
  /// them. The last one is held with velocity and acceleration 0. Empty: the loop's present
  /// reference is held so, or, with a start, the measured position.
  std::vector<FuturesReference> references{};
  double reference_step = 0;         ///< from one reference to the next; 0: the loop's period [s]
  std::vector<FuturesStep> steps{};  ///< added to the position of all references
  const StopFlag* stop = nullptr;    ///< ends the simulation; what it has until then is the answer
};

/// One simulated future.
struct FutureTrajectory {
  SimulationEnd end = SimulationEnd::stable;
  std::vector<std::vector<double>> positions{};  ///< of each joint, at each sample [rad or m]
};

/// The answer. The samples are at equal distances from `time` to `time` + `horizon`.
struct FuturesAnswer {
  double time = 0;     ///< of the loop, when the futures begin [s]
  double horizon = 0;  ///< [s]
  int samples = 0;     ///< beside the first
  std::vector<FutureTrajectory> futures{};
  std::vector<JointMargins> margins{};  ///< of joints whose law and drive have some
};

}  // namespace articula::remote
