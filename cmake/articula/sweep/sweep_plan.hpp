// SPDX-License-Identifier: Apache-2.0
/// @file What a sweep from a file is made of.
#pragma once

#include "files/controllers_file.hpp"
#include "program.hpp"
#include "sweep/any_experiment.hpp"

#include <articula/config/yaml/source.hpp>
#include <articula/reference/joint_signals.hpp>
#include <articula/sweep/sweep_options.hpp>
#include <articula/sweep/variation/variation.hpp>
#include <articula/text/file_error.hpp>
#include <articula/urdf/description.hpp>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace terminal {

/// A plot of the rows.
struct SweepPlot {
  enum class Kind : unsigned char { histogram, scatter, map };
  Kind kind{};
  std::vector<std::string> columns{};  ///< one, or two: abscissa and ordinate
};

/// A search of what makes a metric's quantile smallest, before the sweep.
struct SweepSearch {
  std::string metric{};  ///< to minimise; empty: nothing is searched
  double quantile = 0.95;
  std::vector<articula::Variation> over{};
  int evaluations = 100;
};

/// Makes an experiment of the robot and the controller for which it was compiled. Its owner deletes
/// it.
using MakeExperiment = AnyExperiment*(const SweptLoop&);

/// What a sweep from a file is made of.
struct SweepPlan {
  std::optional<articula::UrdfDescription> robot{};  ///< always there after read_sweep
  std::string urdf{};                                ///< the URDF
  bool allows_unphysical = false;
  MakeExperiment* compiled = nullptr;  ///< of `--compile`
  ControllersPlan controllers{};       ///< the first one is swept
  double duration = 1;                 ///< [s]
  int substeps = 1;
  std::map<std::string, double> start{}, target{};  ///< by joint [rad or m]
  std::vector<articula::JointSignal> disturbances{};
  std::vector<articula::Variation> vary{};
  SweepSearch search{};
  articula::SweepOptions options{};
  std::vector<double> quantiles{0.05, 0.5, 0.95};
  std::vector<SweepPlot> plots{};
  std::string output{};                                ///< folder
  std::string text{};                                  ///< of all files, for the checkpoint
  std::map<std::string, articula::FilePlace> names{};  ///< places of metrics and columns
  std::vector<std::string> notes{};

  [[nodiscard]] SweptLoop loop() const {
    return {.controllers = controllers.source,
            .section = controllers.controllers.front().section,
            .period = controllers.period,
            .substeps = substeps,
            .duration = duration,
            .start = start,
            .target = target,
            .disturbances = disturbances,
            .vary = vary};
  }
};

/// Reads a file and those that it names, which are beside it.
/// @throws articula::FileError with file, line, key and what was expected; Refusal
/// @param compiles  the robot may have any number of joints
[[nodiscard]] SweepPlan read_sweep(const std::string& file, bool compiles);

/// Compiles the plan's robot and controller for the lanes of this processor, unless the user's
/// cache has them.
/// @throws Refusal if a compiler, CMake or the installed articula is not found
[[nodiscard]] MakeExperiment* compiled_experiment(const SweepPlan& plan);

/// The experiment of a robot with N joints.
/// @throws articula::FileError, std::invalid_argument
template <int N>
AnyExperiment make_experiment(const SweepPlan& plan);

/// The N for which there is make_experiment.
inline constexpr auto swept_joints = std::to_array<int>({ARTICULA_SWEPT_JOINTS});

/// The experiment of the plan's robot.
/// @throws as make_experiment
[[nodiscard]] AnyExperiment experiment_of(const SweepPlan& plan);

/// Searches what the plan wants. Each value of `over` that is tried makes a sweep over `vary`. If
/// more runs than the quantile leaves out are not stable, its cost is infinite.
/// @return the plan of a sweep with what was found, and the search itself as JSON and as a line
/// @throws Refusal without NLopt, or if nothing that was tried is stable
struct SearchedPlan {
  SweepPlan plan{};
  Json json{};
  std::string line{};
};
[[nodiscard]] SearchedPlan search_sweep(SweepPlan plan);

/// Writes gnuplot scripts beside the rows, and runs gnuplot where it is installed.
/// @param experiment  for the units of the axes
/// @return a line for people: what was drawn, or why not
/// @throws Refusal if a script cannot be written
[[nodiscard]] std::string draw_sweep(const SweepPlan& plan, const AnyExperiment& experiment);

}  // namespace terminal
