// SPDX-License-Identifier: Apache-2.0
/// @file The figure of an experiment: position and effort of both joints under all controllers.
#pragma once

#include "../support/plot.hpp"
#include "options.hpp"

namespace articula::examples {

/// The recording of one experiment under one controller, in the output folder.
[[nodiscard]] inline std::string csv_name(const Experiment& experiment,
                                          const std::string& controller) {
  return experiment.name + "_" + controller + ".csv";
}

/// The figure of the recordings of an experiment.
[[nodiscard]] Figure figure_of(const Experiment& experiment, const Options& options);

}  // namespace articula::examples
