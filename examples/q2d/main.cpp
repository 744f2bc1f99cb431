// SPDX-License-Identifier: Apache-2.0
/// @file The Q2D under control: every chosen experiment under every chosen controller.
#include "options.hpp"
#include "plots.hpp"
#include "simulation.hpp"
#include "table.hpp"

#include <algorithm>
#include <cctype>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

using namespace articula;
using namespace articula::examples;

namespace {

/// Runs an experiment under the controller of that name.
RunResult run(const Experiment& experiment, const std::string& controller, const Options& options) {
  const std::filesystem::path csv = options.output / csv_name(experiment, controller);
  if (controller == "bypass") return simulate(experiment, Bypass<Q2d>(), csv);
  if (controller == "pid") return simulate(experiment, Pid<Q2d>(options.gains), csv);
  if (controller == "pid-plus-gravity") {
    return simulate(experiment, PidPlusGravity<Q2d>(options.gains), csv);
  }
  const auto gains = ComputedTorque<Q2d>::critically_damped(options.bandwidth);
  return simulate(experiment, ComputedTorque<Q2d>(gains), csv);
}

/// Makes the output folder and puts the plot scripts there, which shows that it can be written to.
void prepare_output(const Options& options) try {
  std::filesystem::create_directories(options.output);
  for (const Experiment& experiment : options.experiments) {
    figure_of(experiment, options).write_script(options.output);
  }
} catch (const std::runtime_error& error) {
  throw std::invalid_argument("--output: " + std::string(error.what()));
}

void run_all(const Options& options) {
  prepare_output(options);
  std::vector<Run> runs;
  for (const Experiment& experiment : options.experiments) {
    for (const std::string& controller : options.controllers) {
      runs.push_back({experiment, controller, run(experiment, controller, options)});
    }
  }
  print_table(std::cout, runs);
  if (options.plots) {
    for (const Experiment& experiment : options.experiments) {
      if (figure_of(experiment, options).draw(options.output)) continue;
      throw std::runtime_error("no plots: gnuplot is not installed (Debian: gnuplot-nox); " +
                               ("the recordings are in " + options.output.string()));
    }
  }
  std::cout << "\nRecordings (CSV)" << (options.plots ? ", plots (SVG)" : "")
            << " and plot scripts (gnuplot) are in " << options.output.string() << '\n'
            << "The arm in a browser: cmake/install-dependencies.sh --view && "
               "cmake --workflow --preset view\n"
            << std::flush;
  if (!std::cout) throw std::runtime_error("cannot write to standard output");
}

/// Says what went wrong, in one line even if the user put line breaks into an option.
int complain(std::string message, int exit_status) {
  std::ranges::replace_if(message, [](unsigned char c) { return std::iscntrl(c); }, ' ');
  std::cerr << "q2d_demo: " << message << '\n';
  return exit_status;
}

}  // namespace

/// @return 0; 1 if a run or its output fails; 2 if the options make no sense
int main(int argc, char** argv) try {
  const std::optional<Options> options = parse_options(argc, argv);
  if (options) run_all(*options);
  return 0;
} catch (const std::invalid_argument& error) {
  return complain(error.what(), 2);
} catch (const std::exception& error) {
  return complain(error.what(), 1);
}
