// SPDX-License-Identifier: Apache-2.0
/// @file The options of the command line.
#pragma once

#include "experiments.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace articula::examples {

/// Experiments, controllers and output.
struct Options {
  std::vector<std::string> controllers{"bypass", "pid", "pid-plus-gravity", "computed-torque"};
  std::vector<Experiment> experiments = reference_experiments();
  JointPidGains<joint_count<Q2d>> gains = Q2d::pid_gains;  ///< of pid and pid-plus-gravity
  double bandwidth = 20;                                   ///< of computed-torque [rad/s]
  std::filesystem::path output = "q2d";                    ///< folder for recordings and plots
  bool plots = true;
};

/// Reads the command line.
/// @return empty if it asked for help, which has been printed
/// @throws std::invalid_argument naming the wrong option
[[nodiscard]] std::optional<Options> parse_options(int argc, const char* const* argv);

}  // namespace articula::examples
