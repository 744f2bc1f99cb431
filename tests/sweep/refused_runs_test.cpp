// SPDX-License-Identifier: Apache-2.0
// Runs that cannot be simulated are counted; units of joints that rotate and translate.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/sweep/closed_loop_experiment.hpp>
#include <articula/sweep/sweep.hpp>

#include "catch.hpp"
#include "robots/test_robots.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

using namespace articula;

namespace {

/// The factor of the elbow's proportional gain.
double factor_of(const JointPidGains<2>& gains) {
  return gains[1].proportional / Q2d::pid_gains[1].proportional;
}
bool is_refused(double factor) { return factor > 1.2 && factor < 1.4; }

/// A controller that refuses gains between the ends of the range.
constexpr auto make_strict = [](const JointPidGains<2>& gains) {
  if (is_refused(factor_of(gains))) throw std::invalid_argument("these gains are not accepted");
  return PidPlusGravity<Q2d>(gains);
};

/// The same for all lanes of a pack: one such lane refuses the pack.
constexpr auto make_strict_pack = []<class S>(const JointPidGains<2, S>& gains) {
  for (int lane = 0; lane < lanes<S>; ++lane) {
    const double factor = lane_of(gains[1].proportional, lane) / Q2d::pid_gains[1].proportional;
    if (is_refused(factor)) throw std::invalid_argument("these gains are not accepted");
  }
  return PidPlusGravity<Q2d, S>(gains);
};

auto experiment_of(const auto& robot, const auto& make, std::vector<OwnMetric<2>> own = {}) {
  ClosedLoopOptions<2> options;
  options.duration = 0.05;
  options.target = JointVector<2>(0.3, -0.2);
  options.vary = {{VariedQuantity::proportional, "elbow_active_joint", 1, 2}};
  options.own_metrics = std::move(own);
  return ClosedLoopExperiment(robot, Q2d::pid_gains, make, options);
}

/// Some runs of which some are refused, in chunks of some size.
void check_refused(const auto& experiment, std::uint64_t chunk) {
  std::vector<SweepRow> rows;
  const SweepResult result = sweep(experiment,
                                   {.sampling = {.runs = 600, .seed = 5},
                                    .worst_metric = "elbow_active_joint.tracking_rms",
                                    .worst = 3,
                                    .chunk = chunk},
                                   {[&](const SweepRow& row) { rows.push_back(row); }});
  REQUIRE(rows.size() == 600);
  std::uint64_t refused = 0;
  for (const SweepRow& row : rows) {
    CAPTURE(row.number, row.parameters[0]);
    const bool is_bad = is_refused(row.parameters[0]);
    refused += is_bad ? 1 : 0;
    CHECK((row.end == SimulationEnd::refused) == is_bad);
    const bool is_undefined =
        std::ranges::all_of(row.metrics, [](double x) { return std::isnan(x); });
    CHECK(is_undefined == is_bad);
    std::vector<double> again(row.metrics.size());
    CHECK(experiment.run(row.run(), again) == row.end);
    CHECK(std::ranges::equal(again, row.metrics, [](double a, double b) {
      return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    }));
    if (!is_bad) continue;
    CHECK_THROWS_WITH(experiment.run_alone(experiment.loop(row.run()), again),
                      "these gains are not accepted");
  }
  CHECK(refused > 60);
  CHECK(result.runs_with(SimulationEnd::refused) == refused);
  CHECK(result.worst()[0].end == SimulationEnd::refused);
}

}  // namespace

TEST_CASE("a run between the corners that is refused is counted, and the sweep goes on") {
  check_refused(experiment_of(Q2d(), make_strict), 64);
  check_refused(experiment_of(Q2d(), make_strict_pack), 64);
  check_refused(experiment_of(Q2d(), make_strict), 600);  // more than are in memory at once
  check_refused(experiment_of(support::model<Q2d>(), make_strict), 64);  // one after the other
}

TEST_CASE("what one's own metric throws ends the sweep, and is no refusal") {
  const OwnMetric<2> thrower{{"own", "1"}, [](double, const auto&, const auto&) -> double {
                               throw std::invalid_argument("no such number");
                             }};
  const auto check = [&](const auto& robot, const std::string& runs) {
    const auto experiment = experiment_of(
        robot, [](const JointPidGains<2>& gains) { return PidPlusGravity<Q2d>(gains); }, {thrower});
    CHECK_THROWS_WITH(static_cast<void>(sweep(experiment, {.sampling = {.runs = 8}, .threads = 1})),
                      Catch::Contains(runs) && Catch::Contains("no such number"));
  };
  check(Q2d(), "runs 0 .. 7");
  check(support::model<Q2d>(), "runs 0 .. 7");
}

TEST_CASE("units are those of joints that rotate or translate") {
  ClosedLoopOptions<1> options;
  options.target = JointVector<1>(0.1);
  options.vary = {{VariedQuantity::position_noise, {}, 0, 1e-4},
                  {VariedQuantity::added_friction, "joint", 0, 1},
                  {VariedQuantity::added_reflected_inertia, "joint", 0, 1},
                  {VariedQuantity::damping, "joint", 0, 0},
                  {VariedQuantity::payload, "body", 0, 1},
                  {VariedQuantity::delay, {}, 0, 1e-3}};
  const auto units = [&](JointType type) {
    const Model<1> robot = support::single_joint(type);
    const ClosedLoopExperiment experiment(
        robot, {PidGains{.proportional = 10, .derivative = 5}},
        [&](const JointPidGains<1>& gains) { return Pid<Model<1>>(robot, gains); }, options);
    std::vector<std::string> all;
    for (const SweepParameter& each : experiment.parameters()) all.push_back(each.unit);
    for (const SweepMetric& each : experiment.metrics()) all.push_back(each.unit);
    return all;
  };
  using Units = std::vector<std::string>;
  CHECK(units(JointType::prismatic) ==
        Units{"m", "N", "kg", "1", "kg", "s", "s", "1", "s", "m", "m", "m", "m/s", "N", "N", "J"});
  CHECK(units(JointType::revolute) == Units{"rad", "N m", "kg m^2", "1", "kg", "s", "s", "1", "s",
                                            "rad", "rad", "rad", "rad/s", "N m", "N m", "J"});
  CHECK(detail::joint_unit("rad/s", std::vector{JointType::prismatic, JointType::continuous}) ==
        "rad/s or m/s");
}
