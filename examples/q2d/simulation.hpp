// SPDX-License-Identifier: Apache-2.0
/// @file One experiment under one controller: recorded, measured and timed.
#pragma once

#include "articula/articula.hpp"
#include "articula/tuning/step_metrics.hpp"
#include "csv_file.hpp"
#include "experiments.hpp"
#include "progress.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace articula::examples {

/// Results of one joint in one run.
struct JointResult {
  StepMetrics step;
  double end_error = 0;        ///< position reference minus position in the last cycle [rad]
  double peak_effort = 0;      ///< highest |command| [N m]
  double saturated_share = 0;  ///< share of the cycles whose command is at a limit of the drive
};

/// Results of one run.
struct RunResult {
  std::vector<JointResult> joints;
  double speed = 0;  ///< simulated seconds per second
};

/// A loop at the start of an experiment.
template <template <class> class ControllerTemplate>
[[nodiscard]] auto make_loop(const Experiment& experiment,
                             const ControllerTemplate<Q2d>& controller) {
  Loop<Q2dSim, ControllerTemplate> loop(Q2dSim({.initial_position = experiment.initial}),
                                        controller);
  loop.reference() = experiment.reference();
  return loop;
}

/// One cycle, which must go well.
/// @throws std::runtime_error if it does not
void update(auto& loop) {
  const Status status = loop.update();
  if (status != Status::ok) {
    throw std::runtime_error("stopped after " + std::to_string(loop.time()) +
                             " s: " + std::string(to_string(status)));
  }
}

/// Simulated seconds per second of a loop that is left alone.
[[nodiscard]] double speed_of(auto loop, long cycles) {
  const auto begin = std::chrono::steady_clock::now();
  for (long k = 0; k < cycles; ++k) update(loop);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  return static_cast<double>(cycles) * loop.period() / elapsed.count();
}

/// Runs an experiment twice: once with an eye on it, once for speed.
/// @param csv  where the recording goes
/// @throws std::runtime_error if the loop fails or the recording cannot be written
template <template <class> class ControllerTemplate>
[[nodiscard]] RunResult simulate(const Experiment& experiment,
                                 const ControllerTemplate<Q2d>& controller,
                                 const std::filesystem::path& csv) {
  constexpr int n = joint_count<Q2d>;
  const Q2dVector limits = effort_limits(Q2d());
  auto loop = make_loop(experiment, controller);
  const long cycles = std::lround(experiment.duration / loop.period());

  RunResult result;
  for (int j = 0; j < n; ++j) {
    result.joints.push_back(
        {StepMetrics(experiment.initial[j], experiment.reference().position[j])});
  }
  CsvFile<n> file(csv, joint_names(Q2d()));
  Progress progress(csv.stem().string());
  for (long k = 0; k < cycles; ++k) {
    update(loop);
    file.add(loop.time(), loop.reference(), loop.state(), loop.command());
    for (int j = 0; j < n; ++j) {
      JointResult& joint = result.joints[static_cast<std::size_t>(j)];
      const double effort = std::abs(loop.command().effort[j]);
      joint.step.add(loop.time(), loop.state().position[j]);
      joint.end_error = loop.reference().position[j] - loop.state().position[j];
      joint.peak_effort = std::max(joint.peak_effort, effort);
      if (effort >= limits[j]) joint.saturated_share += 1.0 / static_cast<double>(cycles);
    }
    progress.update(static_cast<double>(k + 1) / static_cast<double>(cycles));
  }
  file.close();
  constexpr long enough = 10'000;  // cycles to time
  result.speed = speed_of(make_loop(experiment, controller), std::min(cycles, enough));
  return result;
}

}  // namespace articula::examples
