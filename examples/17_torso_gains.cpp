// SPDX-License-Identifier: Apache-2.0
// Both arms of a torso reach forward, one of them with a load of 0 to 1 kg that the controller does
// not know. The program searches gains for all six joints by three numbers, so that 95 % of the
// torsos follow best, and tries them on torsos that the search has not seen. The plot has the error
// of each of these over its load.
#include <articula/articula.hpp>
#include <articula/robots/two_arm_torso.hpp>
#include <articula/sweep/closed_loop_experiment.hpp>
#include <articula/sweep/search_gains.hpp>
#include <articula/sweep/sweep.hpp>
#include <articula/tuning/equivalent_inertia.hpp>

#include "support/plot.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace articula;

/// What the six joints have in common, whatever inertia they feel.
struct Tuning {
  double frequency;  ///< natural, of the closed loop [rad/s]
  double damping;    ///< ratio [1]
  double integral;   ///< frequency of the integral action [rad/s]
};

/// The arms bent, as the pose for which gains are computed. Left arm first.
const JointVector<6> bent(-0.4, 0.2, 0.8, -0.4, -0.2, 0.8);

/// A joint of inertia J gets J w^2, 2 d w J and J w^2 times the integral's frequency.
JointPidGains<6> gains_of(const Tuning& t) {
  JointPidGains<6> gains;
  int joint = 0;
  for (PidGains& gain : gains) {
    const double inertia = equivalent_inertia(TwoArmTorso(), bent, joint++);
    gain.proportional = inertia * t.frequency * t.frequency;
    gain.derivative = inertia * 2 * t.damping * t.frequency;
    gain.integral = gain.proportional * t.integral;
  }
  return gains;
}

/// @param each  gets the load [kg] and the worst joint's rms tracking error [rad] of each torso
SweepResult torsos(const Tuning& tuning, std::uint64_t runs, std::uint64_t seed,
                   const std::function<void(double, double)>& each = {}) {
  ClosedLoopOptions<6> options;
  options.duration = 1.5;
  options.target = bent;
  options.vary = {{VariedQuantity::payload, "left_forearm_link", 0, 1},
                  {VariedQuantity::mass, {}, 0.9, 1.1},
                  {VariedQuantity::added_friction, {}, 0, 0.2},
                  {VariedQuantity::delay, {}, 0, 0.004}};
  const ClosedLoopExperiment experiment(
      TwoArmTorso(), gains_of(tuning),
      [](const JointPidGains<6>& gains) { return PidPlusGravity<TwoArmTorso>(gains); }, options);
  SweepHooks hooks;
  hooks.row = [&each, metrics = experiment.metrics()](const SweepRow& torso) {
    double worst = 0;
    for (std::size_t k = 0; k < metrics.size(); ++k) {
      if (metrics[k].name.ends_with(".tracking_rms")) worst = std::max(worst, torso.metrics[k]);
    }
    if (each) each(torso.parameters[0], worst);
  };
  return sweep(experiment,
               {.sampling = {.method = SamplingMethod::sobol, .runs = runs, .seed = seed}}, hooks);
}

/// The rms tracking error of the worst joint that 95 % of the torsos stay below [rad].
double error_of(const SweepResult& result) {
  double worst = 0;
  for (const Joint& joint : TwoArmTorso::description.joints) {
    const std::string metric = std::string(joint.name.view()) + ".tracking_rms";
    worst = std::max(worst, result.summary(metric).quantile(0.95));
  }
  return worst;
}

/// The share of torsos that do not end stable.
double unstable_share(const SweepResult& result) {
  return 1 - static_cast<double>(result.runs_with(SimulationEnd::stable)) /
                 static_cast<double>(result.runs());
}

void print(const char* name, const Tuning& t, const SweepResult& result) {
  std::printf("%-8s %5.1f rad/s, damping %.2f, integral %4.1f rad/s: %.3f rad, %.1f %% unstable\n",
              name, t.frequency, t.damping, t.integral, error_of(result),
              100 * unstable_share(result));
}

int main() {
  const Tuning first{10, 1, 1};
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Plot plot("torso_gains", {"first guess [rad]", "searched [rad]"}, "load [kg]");
  const SweepResult before =
      torsos(first, 256, 2, [&](double load, double by) { plot.add(load, {by, none}); });
  print("first", first, before);

  const auto tuning_of = [](const std::vector<double>& x) { return Tuning{x[0], x[1], x[2]}; };
  const SearchResult best =
      search_gains({.parameters = {{"frequency", "rad/s", 5, 100, Spacing::logarithmic},
                                   {"damping", "1", 0.3, 2, Spacing::logarithmic},
                                   {"integral", "rad/s", 0.1, 20, Spacing::logarithmic}},
                    .evaluations = 60},
                   [&](const std::vector<double>& x) {
                     const SweepResult result = torsos(tuning_of(x), 32, 1);
                     return error_of(result) + unstable_share(result);
                   });
  const SweepResult after = torsos(tuning_of(best.parameters), 256, 2,
                                   [&](double load, double by) { plot.add(load, {none, by}); });
  print("searched", tuning_of(best.parameters), after);
  plot.save();
  return error_of(after) < 0.7 * error_of(before) && unstable_share(after) < 0.05 ? 0 : 1;
}
