// SPDX-License-Identifier: Apache-2.0
/// @file A question for the futures of a loop with other gains, and its answer.
#pragma once

#include "articula/futures/future_end.hpp"
#include "articula/futures/future_options.hpp"
#include "articula/loop/stop_flag.hpp"
#include "articula/remote/gains/parameter.hpp"

#include <string>
#include <vector>

namespace articula::remote {

/// Asks what the loop would do from now on with some other gains, before they are applied.
struct FuturesQuestion {
  /// The most cycles of all futures together.
  static constexpr double most_cycles = 1e6;
  /// The most positions in an answer: futures, samples and joints multiplied.
  static constexpr int most_positions = 200'000;
  /// The time for an answer. It has the futures that are complete by then [s].
  static constexpr double most_time = 2;

  std::vector<ParameterValue> gains{};  ///< that differ from those of the loop; may be empty
  FutureOptions options{};
  const StopFlag* stop = nullptr;  ///< ends the simulation; what it has until then is the answer
};

/// The margins of one joint under one law that is active, with the gains of the question. The joint
/// is an inertia with damping, at the present position and with the other joints free; see
/// stability_margins.
struct JointMargins {
  std::string controller{};  ///< as parameters name it
  std::string joint{};
  bool stable = false;
  double gain_margin = 1;   ///< factor on all gains [1]
  double phase_margin = 0;  ///< [rad]
  double delay_margin = 0;  ///< [s]
};

/// One simulated future.
struct FutureTrajectory {
  FutureEnd end = FutureEnd::stable;
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
