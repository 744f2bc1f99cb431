// SPDX-License-Identifier: Apache-2.0
// A UR10 under computed torque picks up a load that its controller does not know, of 0 to 10 kg.
// The program shows how far the elbow is off, and searches the stiffness and the integral that
// bring 95 % of the arms nearest. The plot has the error of each arm over its load.
#include <articula/articula.hpp>
#include <articula/robots/ur10.hpp>
#include <articula/sweep/closed_loop_experiment.hpp>
#include <articula/sweep/search_gains.hpp>
#include <articula/sweep/sweep.hpp>

#include "support/plot.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <limits>
#include <vector>

using namespace articula;

/// Gains of all joints: critically damped at w [rad/s], with an integral [1/s^3].
JointPidGains<6> gains_of(double w, double integral) {
  JointPidGains<6> gains;
  gains.fill({.proportional = w * w, .integral = integral, .derivative = 2 * w});
  return gains;
}

constexpr const char* error = "elbow_joint.steady_error";

/// Runs many arms whose shoulder and elbow make a step.
/// @param each  gets the load [kg] and the error [rad] of each arm
SweepResult arms(double w, double integral, std::uint64_t runs,
                 const std::function<void(double, double)>& each = {}) {
  ClosedLoopOptions<6> options;
  options.duration = 1.5;
  options.simulation.initial_position = JointVector<6>(0, -1.2, 1.2, 0, 0.5, 0);
  options.target = JointVector<6>(0, -1.0, 1.4, 0, 0.5, 0);
  options.vary = {{VariedQuantity::payload, "tool0", 0, 10},
                  {VariedQuantity::mass, {}, 0.95, 1.05},
                  {VariedQuantity::delay, {}, 0, 0.003}};
  const ClosedLoopExperiment experiment(
      Ur10(), gains_of(w, integral),
      [](const JointPidGains<6>& gains) { return ComputedTorque<Ur10>(gains); }, options);
  SweepHooks hooks;
  const std::vector<SweepMetric> metrics = experiment.metrics();
  const auto metric = static_cast<std::size_t>(
      std::ranges::find(metrics, error, &SweepMetric::name) - metrics.begin());
  if (each) hooks.row = [&](const SweepRow& arm) { each(arm.parameters[0], arm.metrics[metric]); };
  return sweep(experiment, {.sampling = {.method = SamplingMethod::sobol, .runs = runs}}, hooks);
}

int main() {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Plot plot("unknown_payload", {"w 10 rad/s, no integral [rad]", "searched [rad]"}, "load [kg]");
  const SweepResult stiff =
      arms(10, 0, 256, [&](double load, double by) { plot.add(load, {by, none}); });
  const MetricSummary& off = stiff.summary(error);
  std::printf("w 10 rad/s: elbow off by %.4f rad on average, 95 %% of the arms below %.4f rad\n",
              off.mean(), off.quantile(0.95));

  // The arms of all evaluations are the same, since their seed is.
  const SearchResult best =
      search_gains({.parameters = {{"w", "rad/s", 5, 200, Spacing::logarithmic},
                                   {"integral", "1/s^3", 1, 20000, Spacing::logarithmic}},
                    .evaluations = 40},
                   [&](const std::vector<double>& x) {
                     return arms(x[0], x[1], 16).summary(error).quantile(0.95);
                   });
  const SweepResult result = arms(best.parameters[0], best.parameters[1], 256,
                                  [&](double load, double by) { plot.add(load, {none, by}); });
  std::printf("w %.0f rad/s, integral %.0f: 95 %% below %.5f rad; %llu of %llu arms stable\n",
              best.parameters[0], best.parameters[1], result.summary(error).quantile(0.95),
              static_cast<unsigned long long>(result.runs_with(SimulationEnd::stable)),
              static_cast<unsigned long long>(result.runs()));
  plot.save();
  return result.summary(error).quantile(0.95) < 0.2 * off.quantile(0.95) ? 0 : 1;
}
