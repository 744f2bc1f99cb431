// SPDX-License-Identifier: Apache-2.0
#include "options.hpp"

#include "articula/articula.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace articula::examples {

namespace {

constexpr double longest = 3600;  // [s]; one run of an hour leaves half a gigabyte of CSV

/// Throws one line made of parts unless a condition holds.
template <class... Parts>
void require(bool condition, const Parts&... parts) {
  if (condition) return;
  std::ostringstream message;
  (message << ... << parts);
  throw std::invalid_argument(message.str());
}

/// Those with the given names, each once and in their usual order; all if no name is given.
template <class T, class NameOf>
void select(std::vector<T>& all, const std::vector<std::string>& names, NameOf name_of) {
  if (names.empty()) return;
  std::erase_if(
      all, [&](const T& one) { return std::ranges::find(names, name_of(one)) == names.end(); });
}

/// What can be said only of everything together. The library refuses its part by itself.
void validate(const Options& options) {
  const Q2d robot;
  articula::validate(options.gains, joint_names(robot));
  require(is_finite(options.bandwidth) && options.bandwidth > 0, "--bandwidth: ", options.bandwidth,
          " rad/s is not a positive number");
  articula::validate(ComputedTorque<Q2d>::critically_damped(options.bandwidth), joint_names(robot));
  for (const Experiment& experiment : options.experiments) {
    const double shortest = Q2dSim().period();
    require(experiment.duration >= shortest && experiment.duration <= longest,
            "--duration: ", experiment.duration, " s is not within ", shortest, " .. ", longest);
    articula::validate(robot, {.initial_position = experiment.initial});
    for (int j = 0; j < joint_count<Q2d>; ++j) {
      const JointProperties& joint = model_of(robot).joints[static_cast<std::size_t>(j)];
      const double target = experiment.target[j];
      require(is_finite(target), "--reference: ", target, " for joint '", joint.name.view(),
              "' is not a finite number");
      require(
          experiment.is_torque || (target >= joint.limits.lower && target <= joint.limits.upper),
          "--reference: ", target, " rad of joint '", joint.name.view(), "' is outside its limits ",
          joint.limits.lower, " .. ", joint.limits.upper);
    }
  }
}

}  // namespace

std::optional<Options> parse_options(int argc, const char* const* argv) {
  using Pair = std::array<double, 2>;   // shoulder, elbow
  using Gains = std::array<double, 4>;  // proportional, integral, derivative, clamp

  Options options;
  std::vector<std::string> controllers, experiments, experiment_names;
  for (const Experiment& e : options.experiments) experiment_names.push_back(e.name);
  const auto for_each_experiment = [&](auto change) {
    return [&options, change](const auto& value) {
      for (Experiment& e : options.experiments) change(e, value);
    };
  };

  CLI::App app(
      "Runs the Quanser 2-DOF arm (Q2D) under four controllers on three experiments, prints\n"
      "what came of it and leaves recordings and plots.");
  app.add_option("--controller", controllers, "Which controllers to run [all]")
      ->type_name("NAME")
      ->check(CLI::IsMember(options.controllers))
      ->delimiter(',');
  app.add_option("--experiment", experiments, "Which experiments to run [all]")
      ->type_name("NAME")
      ->check(CLI::IsMember(experiment_names))
      ->delimiter(',');
  app.add_option_function<Pair>(
         "--reference",
         for_each_experiment([](Experiment& e, const Pair& x) { e.target = Q2dVector(x.data()); }),
         "Another target for the chosen experiments, shoulder and elbow:\n"
         "a position [rad], or an effort [N m] for open-loop-torque")
      ->type_name("J1,J2")
      ->delimiter(',')
      ->needs("--experiment");
  app.add_option_function<Pair>("--initial", for_each_experiment([](Experiment& e, const Pair& x) {
                                  e.initial = Q2dVector(x.data());
                                }),
                                "Another start position, shoulder and elbow [rad]")
      ->type_name("J1,J2")
      ->delimiter(',');
  app.add_option_function<double>(
         "--duration", for_each_experiment([](Experiment& e, double t) { e.duration = t; }),
         "Another length of each run [s]")
      ->type_name("T");
  for (std::size_t i = 0; i < options.gains.size(); ++i) {
    const std::string joint(short_name(joint_names(Q2d())[i]));
    const auto set_gains = [&gains = options.gains[i]](const Gains& g) {
      gains = {g[0], g[1], g[2], -g[3], g[3]};
    };
    app.add_option_function<Gains>(
           "--" + joint + "-gains", set_gains,
           "Gains of pid and pid-plus-gravity: N m per rad, rad s and rad/s,\n"
           "and the most N m of the integral")
        ->type_name("P,I,D,CLAMP")
        ->delimiter(',');
  }
  app.add_option("--bandwidth", options.bandwidth,
                 "How fast computed-torque lets errors decay [rad/s]")
      ->type_name("W")
      ->capture_default_str();
  app.add_option("--output", options.output, "Folder for recordings and plots")
      ->type_name("FOLDER")
      ->capture_default_str();
  app.add_flag_callback(
      "--no-plots", [&] { options.plots = false; },
      "Only write the scripts that gnuplot draws plots from");

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked_for_help) {
    app.exit(asked_for_help);
    return {};
  } catch (const CLI::ParseError& error) {
    throw std::invalid_argument(error.what());
  }
  select(options.controllers, controllers, [](const std::string& name) { return name; });
  select(options.experiments, experiments, [](const Experiment& e) { return e.name; });
  validate(options);
  return options;
}

}  // namespace articula::examples
