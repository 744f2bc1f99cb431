// SPDX-License-Identifier: Apache-2.0
// Sweeps whose runs go into lanes, beside the same runs alone.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/sweep/closed_loop_experiment.hpp>
#include <articula/sweep/sweep.hpp>

#include "catch.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

using namespace articula;

namespace {

/// Where the processor fuses multiplications and additions, compilers fuse other ones in packs.
#if defined(__FMA__) || defined(__FP_FAST_FMA)
constexpr double tolerance = 1e-7;
#else
constexpr double tolerance = 0;
#endif

/// A pendulum whose bob is on a line through the axis, and whose hook is beside that line.
struct Hook {
  static constexpr auto description = RobotDescription{
      .name = "hook",
      .links = std::to_array<Link>({
          {.name = "base"},
          {.name = "rod",
           .mass = 1,
           .center_of_mass = {0.2, 0, 0},
           .inertia = {.xx = 0.01, .yy = 0.01, .zz = 0.01}},
          {.name = "hook"},
      }),
      .joints = std::to_array<Joint>({
          {.name = "hinge",
           .type = JointType::revolute,
           .parent = "base",
           .child = "rod",
           .axis = {0, 1, 0},
           .limits = {.lower = -2, .upper = 2, .velocity = 20, .effort = 30},
           .damping = 0.2},
          {.name = "weld", .parent = "rod", .child = "hook", .origin = {0.2, 0, 0.1}},
      })};
};

/// Counts its own calls in a run.
template <int N>
OwnMetric<N> counting(std::vector<double>* seen = nullptr) {
  return {{"calls", "1"}, [seen](double so_far, const JointState<N>&, const JointReference<N>&) {
            if (seen != nullptr) seen->push_back(so_far);
            return so_far + 1;
          }};
}

template <class R>
auto experiment_of(const JointPidGains<joint_count<R>>& gains,
                   ClosedLoopOptions<joint_count<R>> options) {
  return ClosedLoopExperiment(
      R(), gains, [](const JointPidGains<joint_count<R>>& own) { return PidPlusGravity<R>(own); },
      std::move(options));
}

std::vector<SweepRow> rows_of(const auto& experiment, const SweepOptions& options) {
  std::vector<SweepRow> rows;
  const SweepResult result =
      sweep(experiment, options, {[&](const SweepRow& row) { rows.push_back(row); }});
  REQUIRE(result.runs() == rows.size());
  return rows;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

/// Checks that rows are what each run gives alone.
void check_alone(const auto& experiment, const std::vector<SweepRow>& rows) {
  for (const SweepRow& row : rows) {
    CAPTURE(row.number);
    std::vector<double> alone(row.metrics.size());
    const auto loop = experiment.loop(row.run());
    REQUIRE(experiment.run_alone(loop, alone) == row.end);
    if constexpr (tolerance == 0) {
      REQUIRE(same_bits(row.metrics, alone));
    } else {
      for (std::size_t k = 0; k < alone.size(); ++k) {
        CAPTURE(k, row.metrics[k], alone[k]);
        REQUIRE(std::isfinite(row.metrics[k]) == std::isfinite(alone[k]));
        if (!std::isfinite(alone[k])) continue;
        REQUIRE(std::abs(row.metrics[k] - alone[k]) <= tolerance * (1 + std::abs(alone[k])));
      }
    }
  }
}

ClosedLoopOptions<2> q2d_options() {
  ClosedLoopOptions<2> options;
  options.duration = 0.3;
  options.target = JointVector<2>(0.3, -0.2);
  options.own_metrics = {counting<2>()};
  return options;
}

/// One controller for all lanes.
constexpr auto make_for_lanes = []<class S>(const JointPidGains<2, S>& gains) {
  return PidPlusGravity<Q2d, S>(gains);
};

/// A spring of one's own, which may overflow: one for all lanes.
constexpr auto make_springs = []<class S>(const JointPidGains<2, S>& gains) {
  return [gains](const ControlInput<2, S>& in) noexcept {
    EffortCommand<2, S> command;
    for (int j = 0; j < 2; ++j) {
      command.effort[j] = gains[static_cast<std::size_t>(j)].proportional *
                          (in.reference.position[j] - in.state.position[j]);
    }
    return command;
  };
};

/// The same, one for each run.
constexpr auto make_spring = [](const JointPidGains<2>& gains) { return make_springs(gains); };

/// Checks runs of which every second one overflows.
void check_overflows(const auto& make) {
  ClosedLoopOptions<2> options = q2d_options();
  options.target = JointVector<2>(0.3, 1.4);
  options.vary = {
      {VariedQuantity::damping, {}, 0.5, 2, Spacing::linear, 4},
      {VariedQuantity::proportional, "elbow_active_joint", 1, 1.75e308 / 339, Spacing::linear, 2}};
  const ClosedLoopExperiment experiment(Q2d(), Q2d::pid_gains, make, options);
  const SweepOptions all{.sampling = {.method = SamplingMethod::grid}, .threads = 1, .chunk = 8};
  const auto rows = rows_of(experiment, all);
  REQUIRE(rows.size() == 8);
  check_alone(experiment, rows);
  options.vary[1].high = 1;
  const auto healthy = rows_of(ClosedLoopExperiment(Q2d(), Q2d::pid_gains, make, options), all);
  int overflows = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const bool bad = rows[k].parameters[1] > 1;
    CHECK((rows[k].end == SimulationEnd::non_finite) == bad);
    CHECK(std::ranges::all_of(rows[k].metrics, [](double x) { return std::isnan(x); }) == bad);
    overflows += bad ? 1 : 0;
    if (!bad) CHECK(same_bits(rows[k].metrics, healthy[k].metrics));
  }
  CHECK(overflows == 4);
}

}  // namespace

TEST_CASE("runs have the same numbers in lanes as alone, and the same bits in any chunk") {
  ClosedLoopOptions<2> options = q2d_options();
  options.disturbances = {{"elbow_active_joint", SineSignal{.amplitude = 3}, SignalTarget::effort}};
  options.vary = {{VariedQuantity::mass, "elbow_passive_link", 0.05, 3},
                  {VariedQuantity::payload, "tool_link", 0, 0.5},
                  {VariedQuantity::damping, {}, 0.5, 8},  // steps of several lengths
                  {VariedQuantity::added_friction, {}, 0, 1},
                  {VariedQuantity::effort_limit, {}, 0.1, 1},
                  {VariedQuantity::delay, {}, 0, 0.003},
                  {VariedQuantity::position_noise, {}, 0, 1e-4},
                  {VariedQuantity::encoder_resolution, "shoulder_active_joint", 0, 1e-3},
                  {VariedQuantity::initial_position, {}, -0.1, 0.1},
                  {VariedQuantity::proportional, "elbow_active_joint", 0.5, 2},
                  {VariedQuantity::integral, {}, 0, 2},
                  {VariedQuantity::derivative, {}, 0.5, 2},
                  {VariedQuantity::lost_commands, {}, 0, 0.5}};
  const ClosedLoopExperiment experiment(Q2d(), Q2d::pid_gains, make_for_lanes, options);
  const auto rows = rows_of(experiment, {.sampling = {.runs = 50}, .threads = 2, .chunk = 50});
  REQUIRE(rows.size() == 50);
  std::set<int> substeps;
  for (const SweepRow& row : rows) {
    substeps.insert(experiment.loop(row.run()).simulation.substeps);
  }
  CHECK(substeps.size() > 1);
  check_alone(experiment, rows);
  for (const std::uint64_t chunk : {1U, 7U}) {
    const auto other =
        rows_of(experiment, {.sampling = {.runs = 50}, .threads = 2, .chunk = chunk});
    for (std::size_t k = 0; k < rows.size(); ++k) {
      CHECK(other[k].number == k);
      CHECK(same_bits(other[k].metrics, rows[k].metrics));
    }
  }
}

TEST_CASE("a run that overflows in a lane is a result and changes no bit of the others") {
  check_overflows(make_spring);
  check_overflows(make_springs);
}

TEST_CASE("an unstable run in a lane leaves the bits of the others") {
  ClosedLoopOptions<2> options = q2d_options();
  options.vary = {{VariedQuantity::proportional, {}, 1, 1e6, Spacing::logarithmic, 4},
                  {VariedQuantity::delay, {}, 0, 0.02, Spacing::linear, 2}};
  const ClosedLoopExperiment experiment(Q2d(), Q2d::pid_gains, make_for_lanes, options);
  const auto rows = rows_of(experiment, {.sampling = {.method = SamplingMethod::grid}, .chunk = 8});
  int stable = 0, unstable = 0;
  for (const SweepRow& row : rows) {
    stable += row.end == SimulationEnd::stable ? 1 : 0;
    unstable += row.end == SimulationEnd::unstable ? 1 : 0;
  }
  CHECK(stable >= 1);
  CHECK(unstable >= 2);
#if !defined(__FMA__) && !defined(__FP_FAST_FMA)  // an unstable motion magnifies any difference
  check_alone(experiment, rows);
#endif
}

TEST_CASE("runs that no lane takes run one after the other behind the same call") {
  std::vector<double> seen;
  ClosedLoopOptions<1> options;
  options.duration = 0.1;
  options.target = JointVector<1>(0.3);
  options.own_metrics = {counting<1>(&seen)};
  options.vary = {{VariedQuantity::payload, "hook", 0, 1, Spacing::linear, 2},
                  {VariedQuantity::damping, {}, 1, 2, Spacing::linear, 2}};
  const JointPidGains<1> gains{{{.proportional = 50, .derivative = 2}}};
  const auto experiment = experiment_of<Hook>(gains, options);
  const auto rows =
      rows_of(experiment, {.sampling = {.method = SamplingMethod::grid}, .threads = 1});
  REQUIRE(rows.size() == 4);
  // The payload beside the line runs alone: the metric is called for all cycles of a run.
  int changes = 0, interleaved = 0;
  for (std::size_t k = 1; k < seen.size(); ++k) {
    changes += seen[k] == seen[k - 1] + 1 ? 0 : 1;
    interleaved += seen[k] == seen[k - 1] ? 1 : 0;
  }
  CHECK(seen.size() == std::size_t{4} * 101);
  CHECK(interleaved == 101);  // two runs in lanes, cycle by cycle
  CHECK(changes == 101 + 2);  // and two alone
  for (const SweepRow& row : rows) {
    const auto loop = experiment.loop(row.run());
    CHECK(loop.robot.has_value() == (row.parameters[0] == 0));
  }
  check_alone(experiment, rows);
}
