// SPDX-License-Identifier: Apache-2.0
/// @file The results as a table.
#pragma once

#include "simulation.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace articula::examples {

/// One experiment under one controller, with its result.
struct Run {
  Experiment experiment;
  std::string controller;
  RunResult result;
};

/// Prints a line for each joint of each run, "-" for what is undefined:
/// rise, overshoot, settling: see StepMetrics; undefined where no position step is asked for;
/// steady error: position reference minus position at the end, undefined for bypass under a torque;
/// peak effort: highest absolute command;
/// saturated: share of the cycles whose command is at a limit of the drive;
/// speed: simulated seconds per second of the whole loop with nothing recorded, one figure a run.
void print_table(std::ostream& out, const std::vector<Run>& runs);

}  // namespace articula::examples
