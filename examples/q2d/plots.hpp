// SPDX-License-Identifier: Apache-2.0
/// @file Plots of the recordings, drawn by gnuplot.
#pragma once

#include "options.hpp"

namespace articula::examples {

/// The recording of one experiment under one controller, in the output folder.
[[nodiscard]] inline std::string csv_name(const Experiment& experiment,
                                          const std::string& controller) {
  return experiment.name + "_" + controller + ".csv";
}

/// Writes <experiment>.gp into the output folder: the gnuplot script that draws <experiment>.svg,
/// with position and effort under all controllers, from the recordings beside it.
/// @throws std::runtime_error if the file cannot be written
void write_plot_script(const Experiment& experiment, const Options& options);

/// Draws <experiment>.svg.
/// @throws std::runtime_error if gnuplot is missing or fails
void draw_plot(const Experiment& experiment, const Options& options);

}  // namespace articula::examples
