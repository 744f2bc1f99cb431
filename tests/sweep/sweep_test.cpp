// SPDX-License-Identifier: Apache-2.0
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/sweep/closed_loop_experiment.hpp>
#include <articula/sweep/jobs/resumable_sweep.hpp>
#include <articula/sweep/sweep.hpp>

#include "catch.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

using namespace articula;

namespace {

constexpr auto make = [](const JointPidGains<2>& gains) { return PidPlusGravity<Q2d>(gains); };

ClosedLoopOptions<2> options_of(std::vector<Variation> vary) {
  ClosedLoopOptions<2> options;
  options.duration = 0.2;
  options.target = JointVector<2>(0.3, -0.2);
  options.vary = std::move(vary);
  return options;
}
auto experiment_of(std::vector<Variation> vary) {
  return ClosedLoopExperiment(Q2d(), Q2d::pid_gains, make, options_of(std::move(vary)));
}
auto arms() {
  return experiment_of({{VariedQuantity::mass, "elbow_passive_link", 0.5, 3},
                        {VariedQuantity::payload, "tool_link", 0, 0.5},
                        {VariedQuantity::damping, {}, 0.5, 2},
                        {VariedQuantity::added_friction, "elbow_active_joint", 0, 0.1},
                        {VariedQuantity::delay, {}, 0, 0.003},
                        {VariedQuantity::position_noise, {}, 0, 1e-4},
                        {VariedQuantity::encoder_resolution, "shoulder_active_joint", 0, 1e-3},
                        {VariedQuantity::proportional, "elbow_active_joint", 0.5, 2},
                        {VariedQuantity::lost_commands, {}, 0, 0.5}});
}

/// All bits of all rows.
std::vector<std::uint64_t> bits_of(const std::vector<SweepRow>& rows) {
  std::vector<std::uint64_t> bits;
  for (const SweepRow& row : rows) {
    bits.insert(bits.end(), {row.number, row.seed, static_cast<std::uint64_t>(row.end)});
    for (const double x : row.parameters) bits.push_back(std::bit_cast<std::uint64_t>(x));
    for (const double x : row.metrics) bits.push_back(std::bit_cast<std::uint64_t>(x));
  }
  return bits;
}
/// All bits of a sweep: its rows, its worst runs and its summaries.
std::vector<std::uint64_t> bits_of_sweep(const auto& experiment, const SweepOptions& options) {
  std::vector<SweepRow> rows;
  const SweepResult result = sweep(experiment, options, {[&](const SweepRow& row) {
                                     REQUIRE(row.number == rows.size());
                                     rows.push_back(row);
                                   }});
  REQUIRE(result.runs() == rows.size());
  std::vector<std::uint64_t> bits = bits_of(rows);
  const auto worst = bits_of(result.worst());
  bits.insert(bits.end(), worst.begin(), worst.end());
  for (const MetricSummary& summary : result.summaries()) {
    for (const double x : {summary.mean(), summary.quantile(0.1), summary.quantile(0.9)}) {
      bits.push_back(std::bit_cast<std::uint64_t>(x));
    }
  }
  return bits;
}

}  // namespace

TEST_CASE("a sweep has the same bits for any number of threads and any chunk") {
  const auto experiment = arms();
  SweepOptions options{.sampling = {.method = SamplingMethod::latin_hypercube, .runs = 60}};
  options.worst_metric = "elbow_active_joint.settling_time";
  options.threads = 1;
  options.chunk = 60;
  const auto expected = bits_of_sweep(experiment, options);
  REQUIRE(expected.size() > 60 * 20);
  for (const auto& [threads, chunk] : {std::pair{1, 1}, {2, 7}, {4, 1}, {3, 64}}) {
    options.threads = threads;
    options.chunk = static_cast<std::uint64_t>(chunk);
    CHECK(bits_of_sweep(experiment, options) == expected);
  }
  options.sampling.seed = 2;
  CHECK(bits_of_sweep(experiment, options) != expected);
}

TEST_CASE("a run is a loop of one's own, to the last bit") {
  const auto experiment = arms();
  const Samples samples(experiment.parameters(), {.runs = 20, .seed = 9});
  for (const std::uint64_t number : {std::uint64_t{3}, std::uint64_t{17}}) {
    const SweepRow row = run_once(experiment, samples, number);
    const auto own = experiment.loop(row.run());
    ControlLoop loop(
        DelayedCommands(Simulator(own.robot.value(), own.simulation), own.delay, own.lost),
        PidPlusGravity<Q2d>(own.gains));
    StepMetrics elbow(0, -0.2);
    double effort = 0;
    for (int k = 0; k <= 200; ++k) {
      const JointState<2>& state = loop.hardware().simulator().true_state();
      elbow.add(k * 1e-3, state.position[1]);
      effort = std::max(effort, std::abs(state.effort[1]));
      loop.reference().position << 0.3, -0.2;
      if (k < 200) REQUIRE(loop.update() == Status::ok);
    }
    const auto metric = [&](const char* name) {
      return row.metrics[detail::metric_index(experiment.metrics(), name)];
    };
    CHECK(metric("elbow_active_joint.overshoot") == elbow.overshoot().value());
    CHECK(metric("elbow_active_joint.steady_error") == std::abs(elbow.steady_error().value()));
    CHECK(metric("elbow_active_joint.effort_peak") == effort);
  }
}

TEST_CASE("a heavier and a damped arm are slower; a payload is felt as its inertia") {
  const auto rise = [](const Variation& variation) {
    const auto experiment = experiment_of({variation});
    const Samples samples(experiment.parameters(), {.runs = 1});
    const SweepRow row = run_once(experiment, samples, 0);
    return row.metrics[detail::metric_index(experiment.metrics(), "elbow_active_joint.rise_time")];
  };
  const double nominal = rise({VariedQuantity::mass, {}, 1, 1});
  CHECK(rise({VariedQuantity::mass, {}, 3, 3}) > 1.01 * nominal);
  CHECK(rise({VariedQuantity::damping, {}, 1.5, 1.5}) > 1.01 * nominal);
  const auto loop_of = [](const Variation& variation, double value) {
    const auto experiment = experiment_of({variation});
    return experiment.loop({0, 1, std::vector{value}});
  };
  const auto with = loop_of({VariedQuantity::payload, "tool_link", 0, 1}, 0.75);
  const JointVector<2> q(0.4, 0.9);
  const JointMatrix<2> added = mass_matrix(with.model, q) - mass_matrix(Q2d(), q);
  CHECK(added(1, 1) == Approx(0.75 * 0.267 * 0.267));
  CHECK(added(0, 0) ==
        Approx(0.75 * (0.267 * 0.267 + 0.343 * 0.343 + 2 * 0.267 * 0.343 * std::cos(0.9))));
}

TEST_CASE("drives vary: their inertia adds to the mass matrix, and their limit holds") {
  const auto loop_of = [](const Variation& variation, double value) {
    return experiment_of({variation}).loop({0, 1, std::vector{value}});
  };
  const JointVector<2> q(0.4, 0.9);
  const auto inert =
      loop_of({VariedQuantity::added_reflected_inertia, "elbow_active_joint", 0, 1}, 0.02);
  const JointMatrix<2> added = mass_matrix(inert.model, q) - mass_matrix(Q2d(), q);
  const double rounding = 1e-15;  // of sums of the size of the arm's inertias, below 1 kg m^2
  CHECK(added(1, 1) == Approx(0.02).margin(rounding));
  CHECK(std::abs(added(0, 0)) < rounding);
  CHECK(std::abs(added(0, 1)) < rounding);

  const auto weak = experiment_of({{VariedQuantity::effort_limit, {}, 0.02, 1}});
  const double limit = effort_limits(Q2d())[1];
  const auto peak_at = [&](double factor) {
    std::vector<double> metrics(weak.metrics().size());
    const auto end = weak.run({0, 1, std::vector{factor}}, metrics);
    REQUIRE(end != SimulationEnd::non_finite);
    return metrics[detail::metric_index(weak.metrics(), "elbow_active_joint.effort_peak")];
  };
  REQUIRE(peak_at(1) > 0.02 * limit);
  CHECK(peak_at(0.02) == 0.02 * limit);
}

TEST_CASE("the worst runs replay by their numbers, to the last bit") {
  const auto experiment = arms();
  const SweepOptions options{.sampling = {.method = SamplingMethod::sobol, .runs = 40, .seed = 3},
                             .worst_metric = "elbow_active_joint.overshoot",
                             .worst = 4};
  const SweepResult result = sweep(experiment, options);
  REQUIRE(result.worst().size() == 4);
  const Samples samples(experiment.parameters(), options.sampling);
  for (const SweepRow& row : result.worst()) {
    CHECK(bits_of({row}) == bits_of({run_once(experiment, samples, row.number)}));
  }
}

TEST_CASE("a light, strongly damped arm takes shorter steps") {
  const auto experiment =
      experiment_of({{VariedQuantity::mass, {}, 0.05, 1}, {VariedQuantity::damping, {}, 1, 10}});
  CHECK(experiment.loop({0, 1, std::vector{1.0, 1.0}}).simulation.substeps == 1);
  CHECK(experiment.loop({0, 1, std::vector{0.05, 10.0}}).simulation.substeps > 20);
  const Samples samples(experiment.parameters(),
                        {.method = SamplingMethod::latin_hypercube, .runs = 4});
  for (std::uint64_t k = 0; k < 4; ++k) {
    CHECK(run_once(experiment, samples, k).end == SimulationEnd::stable);
  }
}

TEST_CASE("lost commands leave the drives what they had") {
  const auto metric = [](double share, const char* name) {
    const auto experiment = experiment_of({{VariedQuantity::lost_commands, {}, share, share}});
    const Samples samples(experiment.parameters(), {.runs = 1});
    const SweepRow row = run_once(experiment, samples, 0);
    return row.metrics[detail::metric_index(experiment.metrics(), name)];
  };
  CHECK(metric(1, "elbow_active_joint.effort_peak") == 0);
  // Each command acts for a mean of 1 / (1 - 0.9) periods, as a delay of some milliseconds.
  CHECK(metric(0.9, "elbow_active_joint.overshoot") > metric(0, "elbow_active_joint.overshoot"));

  int lost = 0;
  constexpr int cycles = 10000;
  for (std::uint64_t cycle = 0; cycle < cycles; ++cycle) {
    lost += LostCommands{.share = 0.3, .seed = 7}.contain(cycle) ? 1 : 0;
  }
  // Of independent draws the count has a standard deviation of 46; six of them are one in 10^9.
  CHECK(std::abs(lost - 3000) < 6 * 46);
}

TEST_CASE("metrics of three samples are those computed by hand") {
  // The first sample is before the first period, so its effort is 0 and no part of the mean.
  RunMeasures<2> measures({0, 0}, {0, 0}, {});
  const JointReference<2> reference{};
  measures.add(0, {{0, 0}, {0, 0}, {0, 0}}, reference, 1e-3);
  measures.add(1e-3, {{0.1, -0.2}, {2, -1}, {5, -3}}, reference, 1e-3);
  measures.add(2e-3, {{0.3, 0.1}, {-3, 0.5}, {5, 3}}, reference, 1e-3);
  const std::array<JointProperties, 2> joints{{{.name = "a"}, {.name = "b"}}};
  const auto metrics = RunMeasures<2>::metrics(joints, {});
  std::vector<double> values(metrics.size());
  measures.values(values);
  const auto value = [&](const char* name) { return values[detail::metric_index(metrics, name)]; };
  CHECK(value("a.effort_rms") == 5);
  CHECK(value("b.effort_rms") == 3);
  CHECK(value("a.effort_peak") == 5);
  CHECK(value("b.effort_peak") == 3);
  CHECK(value("a.tracking_peak") == 0.3);
  CHECK(value("b.tracking_peak") == 0.2);
  CHECK(value("a.tracking_rms") == Approx(std::sqrt((0.01 + 0.09) / 3)));
  CHECK(value("a.velocity_peak") == 3);
  CHECK(value("b.velocity_peak") == 1);
  CHECK(value("energy") == Approx(1e-3 * (5 * 2 + 3 * 1 + 5 * 3 + 3 * 0.5)));
}

TEST_CASE("drives that swing between their limits make a run unstable in its last quarter alone") {
  const JointVector<2> limits(10, 10);
  const auto end_of = [&](int first, int last) {
    detail::RunPlan<Q2d> plan;
    plan.cycles = 100;
    detail::RunWatch<Q2d> watch(plan, {0, 0}, limits);
    for (int cycle = 0; cycle < plan.cycles; ++cycle) {
      JointState<2> state{};
      if (cycle >= first && cycle < last) state.effort[1] = cycle % 2 == 0 ? 10 : -10;
      CHECK(watch.begin(cycle, state, {}));
      watch.finish(cycle, state);
    }
    std::vector<double> values(100);
    plan.standard_metrics = values.size();
    return watch.result(values);
  };
  CHECK(end_of(0, 70) == SimulationEnd::stable);
  CHECK(end_of(80, 100) == SimulationEnd::unstable);
}

TEST_CASE("an unstable loop is a result") {
  const auto experiment =
      experiment_of({{VariedQuantity::proportional, {}, 1, 1e6, Spacing::logarithmic, 5},
                     {VariedQuantity::delay, {}, 0, 0.02, Spacing::linear, 3}});
  const SweepResult result =
      sweep(experiment, {.sampling = {.method = SamplingMethod::grid},
                         .specifications = {{"elbow_active_joint.tracking_rms", 0.15}},
                         .worst_metric = "elbow_active_joint.effort_rms",
                         .worst = 3});
  CHECK(result.runs() == 15);
  CHECK(result.runs_with(SimulationEnd::unstable) >= 4);
  CHECK(result.runs_with(SimulationEnd::stable) >= 3);
  CHECK(result.runs_within() >= 1);
  CHECK(result.runs_within() <= result.runs_with(SimulationEnd::stable));
  REQUIRE(result.worst().size() == 3);
  CHECK(result.worst()[0].end == SimulationEnd::unstable);
  const std::size_t effort =
      detail::metric_index(experiment.metrics(), "elbow_active_joint.effort_rms");
  CHECK(result.worst()[0].metrics[effort] >= result.worst()[1].metrics[effort]);
  CHECK(result.worst()[0].metrics[effort] == result.summaries()[effort].highest);
}

TEST_CASE("set-up refuses what cannot be swept, and says why") {
  const auto message = [](const auto& function) -> std::string {
    try {
      function();
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  const auto refused = [&](const Variation& variation) {
    return message([&] { static_cast<void>(experiment_of({variation})); });
  };
  CHECK_THAT(refused({VariedQuantity::mass, "no_link", 1, 2}), Catch::Contains("no_link"));
  CHECK_THAT(refused({VariedQuantity::mass, "base_link", 1, 2}), Catch::Contains("does not move"));
  CHECK_THAT(refused({VariedQuantity::mass, {}, -1, 2}), Catch::Contains("-1 .. 2"));
  CHECK_THAT(refused({VariedQuantity::mass, {}, 2, 1}), Catch::Contains("above its high end"));
  CHECK_THAT(refused({VariedQuantity::mass, {}, 1, std::nan("")}), Catch::Contains("not finite"));
  CHECK_THAT(refused({VariedQuantity::payload, {}, 0, 1}), Catch::Contains("needs the name"));
  // The Q2D has no dry friction.
  CHECK_THAT(refused({VariedQuantity::friction, {}, 1, 2}),
             Catch::Contains("'friction' is a factor of numbers that are 0") &&
                 Catch::Contains("expected added_friction"));
  CHECK(refused({VariedQuantity::friction, {}, 0, 0}).empty());  // without friction, as it is
  CHECK_THAT(refused({VariedQuantity::delay, "elbow_active_joint", 0, 1}),
             Catch::Contains("whole loop"));
  CHECK_THAT(refused({VariedQuantity::lost_commands, {}, 0, 1.5}),
             Catch::Contains("'lost_commands': its range 0 .. 1.5 is not within 0 .. 1"));
  CHECK_THAT(refused({VariedQuantity::damping, {}, 0, 1e6}), Catch::Contains("with damping 1e+06"));
  CHECK_THAT(message([&] {
               static_cast<void>(experiment_of(
                   {{VariedQuantity::mass, {}, 0.02, 1}, {VariedQuantity::damping, {}, 1, 20}}));
             }),
             Catch::Contains("mass 0.02, damping 20"));
  CHECK_THAT(message([] {
               ClosedLoopOptions<2> options;
               options.simulation.period = 1e-6;
               options.duration = 1e-4;
               options.vary = {{VariedQuantity::delay, {}, 0, 5}};
               const auto make = [](const JointPidGains<2>& own) {
                 return PidPlusGravity<Q2d>(own);
               };
               const ClosedLoopExperiment experiment(Q2d(), Q2d::pid_gains, make, options);
             }),
             Catch::Contains("with delay 5: delay: 5000000 periods"));
  CHECK_THAT(message([&] {
               static_cast<void>(
                   experiment_of({{VariedQuantity::position_noise, {}, 0, 0.1},
                                  {VariedQuantity::position_noise, "elbow_active_joint", 0, 0.2}}));
             }),
             Catch::Contains("'position_noise' and 'position_noise.elbow_active_joint'"));
  CHECK_THAT(message([&] {
               static_cast<void>(experiment_of(
                   {{VariedQuantity::mass, {}, 1, 2}, {VariedQuantity::mass, {}, 1, 3}}));
             }),
             Catch::Contains("'mass' varies twice"));
  CHECK_THAT(message([&] {
               static_cast<void>(experiment_of({{VariedQuantity::mass, "elbow_passive_link", 1, 2},
                                                {VariedQuantity::mass, "tool_link", 1, 3}}));
             }),
             Catch::Contains("'mass.elbow_passive_link' and 'mass.tool_link' are of one body"));
  const auto experiment = arms();
  CHECK_THAT(message([&] { static_cast<void>(sweep(experiment, {.worst_metric = "speed"})); }),
             Catch::Contains("'speed'") && Catch::Contains("elbow_active_joint.overshoot"));
  CHECK_THAT(message([&] { static_cast<void>(sweep(experiment, {.sampling = {.runs = 0}})); }),
             Catch::Contains("runs 0"));
  CHECK_THAT(message([&] { static_cast<void>(sweep(experiment, {.chunk = 0})); }),
             Catch::Contains("chunk 0"));
}

TEST_CASE("factors scale the described numbers, whatever the order of the list") {
  const std::vector<Variation> all{{VariedQuantity::payload, "elbow_passive_link", 0.5, 0.5},
                                   {VariedQuantity::added_friction, {}, 0.2, 0.2},
                                   {VariedQuantity::mass, {}, 2, 2},
                                   {VariedQuantity::friction, {}, 0, 0}};
  const std::vector<double> values{0.5, 0.2, 2, 0};
  const VariedLoop<Q2d> own = experiment_of(all).loop({0, 1, values});
  const auto reversed = experiment_of({all.rbegin(), all.rend()});
  const std::vector<double> other_values(values.rbegin(), values.rend());
  const VariedLoop<Q2d> other = reversed.loop({0, 1, other_values});
  double mass = 0, described = 0;
  for (int b = 0; b < 2; ++b) {
    mass += own.model.mechanism.bodies[b].inertia.mass;
    described += model_of(Q2d()).mechanism.bodies[b].inertia.mass;
    CHECK(own.model.mechanism.bodies[b].inertia.mass ==
          other.model.mechanism.bodies[b].inertia.mass);
    CHECK(own.model.joints[b].friction == 0.2);
    CHECK(other.model.joints[b].friction == 0.2);
  }
  CHECK(mass == Approx(2 * described + 0.5));  // the payload itself is not doubled
}

namespace {

/// Its first run does not depend on the factor.
struct LateDifference {
  double factor = 1;
  [[nodiscard]] std::vector<SweepParameter> parameters() const { return {{"x", "1", 0, 1}}; }
  [[nodiscard]] std::vector<SweepMetric> metrics() const { return {{"y", "1"}}; }
  [[nodiscard]] SimulationEnd run(const SweepRun& run, std::span<double> metrics) const {
    metrics[0] = run.number == 0 ? 1 : factor * run.parameters[0];
    return SimulationEnd::stable;
  }
};

}  // namespace

TEST_CASE("a checkpoint is refused by an experiment whose first runs have other rows") {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / "articula_sweep_identity";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const auto with_gains = [&](double factor) {
    JointPidGains<2> gains = Q2d::pid_gains;
    gains[1].derivative *= factor;
    ClosedLoopOptions<2> options;
    options.duration = 0.05;
    options.target = JointVector<2>(0.3, -0.2);
    options.vary = {{VariedQuantity::mass, {}, 1, 2}};
    const ClosedLoopExperiment experiment(
        Q2d(), gains, [](const JointPidGains<2>& own) { return PidPlusGravity<Q2d>(own); },
        options);
    return resumable_sweep(experiment, {.sampling = {.runs = 20}},
                           {.rows = folder / "rows.csv", .checkpoint = folder / "checkpoint"});
  };
  CHECK(with_gains(1).runs() == 20);
  CHECK(with_gains(1).runs() == 20);  // goes on
  CHECK_THROWS_WITH(with_gains(1.0000001), Catch::Contains("has other rows than this sweep"));
  const auto late = [&](double factor) {
    return resumable_sweep(LateDifference{factor}, {.sampling = {.runs = 20}},
                           {.checkpoint = folder / "late"});
  };
  CHECK(late(1).runs() == 20);
  CHECK_THROWS_WITH(late(2), Catch::Contains("has other rows than this sweep"));
  std::filesystem::remove(folder / "rows.csv");
  CHECK_THROWS_WITH(with_gains(1), Catch::Contains("rows.csv cannot be read") &&
                                       Catch::Contains("remove the checkpoint"));
  std::filesystem::remove_all(folder);
}
