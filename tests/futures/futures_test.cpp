// SPDX-License-Identifier: Apache-2.0
#include <articula/articula.hpp>
#include <articula/futures/futures.hpp>
#include <articula/robots/q2d.hpp>

#include "catch.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

using namespace articula;

namespace {

using Arm = Loop<Q2dSim, PidPlusGravity>;
using Law = PidPlusGravity<Q2d>;
using Start = FutureStart<EffortCommand<2>>;

constexpr FutureSpread no_spread{
    .mass = 0, .friction = 0, .delay = 0, .position_noise = 0, .velocity_noise = 0};

/// An arm in the middle of a step, with integrals that are not 0.
void move(Arm& arm) {
  arm.reference().position << 0.3, -0.2;
  for (int k = 0; k < 40; ++k) REQUIRE(arm.update() == Status::ok);
}
Start start_of(const Arm& arm) {
  return {arm.hardware().true_state(), arm.reference(), arm.command()};
}
std::vector<Future<2>> futures_of(const Arm& arm, const FutureOptions& options) {
  return futures(Q2d(), arm.controller(), start_of(arm), arm.hardware().options(), options);
}
/// The distance of two futures at their most distant sample.
double distance(const Future<2>& a, const Future<2>& b) {
  double most = 0;
  for (std::size_t k = 0; k < std::min(a.positions.size(), b.positions.size()); ++k) {
    most = std::max(most, (a.positions[k] - b.positions[k]).cwiseAbs().maxCoeff());
  }
  return most;
}

}  // namespace

TEST_CASE("without a spread, futures are what the loop does, to the last bit") {
  Arm arm;
  move(arm);
  const auto fan = futures_of(arm, {.spread = no_spread, .count = 2, .samples = 1000});
  REQUIRE(fan.size() == 2);
  CHECK(distance(fan[0], fan[1]) == 0);
  REQUIRE(fan[0].positions.size() == 1001);
  CHECK((fan[0].positions[0] - fan[0].positions[1000]).norm() > 0.01);
  for (std::size_t k = 0; k <= 1000; ++k) {
    const JointVector<2>& simulated = fan[0].positions[k];
    const JointVector<2>& real = arm.hardware().true_state().position;
    REQUIRE((simulated[0] == real[0] && simulated[1] == real[1]));
    REQUIRE(arm.update() == Status::ok);
  }
}

TEST_CASE("futures follow references as the loop does, to the last bit, and hold the last one") {
  Arm arm;
  move(arm);
  Start start = start_of(arm);
  for (int k = 0; k < 100; ++k) {
    start.references.push_back(arm.reference());
    start.references.back().position[0] -= 1e-3 * k;
    start.references.back().velocity[0] = -1;
  }
  const FutureOptions options{.spread = no_spread, .count = 1, .horizon = 0.3, .samples = 300};
  const auto fan = futures(Q2d(), arm.controller(), start, arm.hardware().options(), options);
  for (std::size_t k = 0; k <= 300; ++k) {
    const JointVector<2>& simulated = fan[0].positions[k];
    const JointVector<2>& real = arm.hardware().true_state().position;
    REQUIRE((simulated[0] == real[0] && simulated[1] == real[1]));
    arm.reference() = start.references[std::min<std::size_t>(k, 99)];
    REQUIRE(arm.update() == Status::ok);
  }
  start.references[7].position[1] = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(futures(Q2d(), arm.controller(), start, arm.hardware().options(), options),
                  std::invalid_argument);
}

TEST_CASE("a future depends on seed and number alone, in whatever order they are computed") {
  Arm arm;
  move(arm);
  const FutureOptions options{.count = 5};
  const auto fan = futures_of(arm, options);
  for (const std::uint64_t k : {4U, 0U, 2U, 3U, 1U}) {
    const auto own =
        future_of(Q2d(), arm.controller(), start_of(arm), arm.hardware().options(), options, k);
    CHECK(distance(own, fan[k]) == 0);
    CHECK(own.positions.size() == 51);
  }
  CHECK(distance(fan[0], fan[1]) > 0);
  const auto other = futures_of(arm, {.seed = 2, .count = 1});
  CHECK(distance(other[0], fan[0]) > 0);
}

TEST_CASE("futures in lanes are those of robots that are simulated alone") {
  Arm arm;
  move(arm);
  constexpr int lanes = LaneSimulator<Q2d>::lane_count;
  const FutureOptions options{.count = lanes + 3};  // the second pack is not full
  const auto together = futures_of(arm, options);
  // A model is no type, so its futures are simulated one after the other.
  const auto alone =
      futures(model_of(Q2d()), arm.controller(), start_of(arm), arm.hardware().options(), options);
  REQUIRE(together.size() == alone.size());
  for (std::size_t k = 0; k < alone.size(); ++k) {
    CAPTURE(k);
    CHECK(together[k].end == alone[k].end);
    CHECK(together[k].positions.size() == alone[k].positions.size());
    // Programs and recursions round differently: 1e-16 in each of 1000 cycles of a stable loop.
    CHECK(distance(together[k], alone[k]) < 1e-12);
  }
}

TEST_CASE("robots that need shorter steps are futures, too, and change no other one") {
  // The described Q2D is stable with steps of 2.5 ms, some of those that are 20 % lighter are not.
  const SimulatorOptions<2> slow{.period = 0.0025};
  const Law law(Q2d::pid_gains);
  Start start;
  start.reference.position << 0.3, -0.2;
  const FutureOptions options{.count = 100};
  const auto fan = futures(Q2d(), law, start, slow, options);
  REQUIRE(fan.size() == 100);
  int shorter = 0;
  for (std::uint64_t k = 0; k < 100; ++k) {
    const std::uint64_t key = detail::random_bits(options.seed, k);
    const auto model = varied_model(Q2d(), options.spread, detail::random_bits(key, 2));
    shorter += longest_step(model, {0, 0}) < slow.period ? 1 : 0;
    const auto own = future_of(Q2d(), law, start, slow, options, k);
    CHECK(distance(own, fan[k]) == 0);
    CHECK(own.end == SimulationEnd::stable);
  }
  CHECK(shorter > 0);
  CHECK(shorter < 50);
}

TEST_CASE("one future refuses what a fan refuses") {
  const Law law(Q2d::pid_gains);
  const auto of = [&](const FutureOptions& options, const Start& start = {}) {
    return future_of(Q2d(), law, start, SimulatorOptions<2>(), options, 0);
  };
  CHECK_THROWS_AS(of({.spread = {.delay = -1}}), std::invalid_argument);
  CHECK_THROWS_AS(of({.samples = -5}), std::invalid_argument);
  CHECK_THROWS_AS(of({.horizon = std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
  Start start;
  start.state.position[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(of({}, start), std::invalid_argument);
}

TEST_CASE("a lane that ends early changes no other one") {
  // It fails where its robot has moved, which each does in a time of its own.
  struct Failing {
    PidPlusGravity<Q2d> law{};
    Outcome<EffortCommand<2>> update(const ControlInput<2>& in) noexcept {
      const bool is_beyond = std::abs(in.state.position[0]) > 0.1;
      return {law.update(in), is_beyond ? Verdict::failed : Verdict::fine};
    }
  };
  Start start;
  start.reference.position << 0.3, -0.2;
  const FutureOptions options{.spread = {.mass = 0.5}, .count = 20, .horizon = 0.1};
  const auto some = futures(Q2d(), Failing(), start, {}, options);
  const auto alone = futures(model_of(Q2d()), Failing(), start, {}, options);
  for (std::size_t k = 0; k < some.size(); ++k) {
    CHECK(some[k].end == alone[k].end);
    CHECK(some[k].positions.size() == alone[k].positions.size());
    CHECK(distance(some[k], alone[k]) < 1e-12);  // see above
  }
  CHECK(std::any_of(some.begin(), some.end(), [&](const Future<2>& future) {
    return future.positions.size() != some[0].positions.size();
  }));
}

TEST_CASE("each spread alone makes different futures") {
  Arm arm;
  move(arm);
  FutureSpread spread = no_spread;
  SECTION("mass") { spread.mass = 0.2; }
  SECTION("friction") { spread.friction = 0.2; }
  SECTION("delay") { spread.delay = 20; }
  SECTION("noise of positions") { spread.position_noise = 1e-3; }
  SECTION("noise of velocities") { spread.velocity_noise = 0.1; }
  const auto fan = futures_of(arm, {.spread = spread, .count = 10});
  double most = 0;
  for (const auto& future : fan) most = std::max(most, distance(future, fan[0]));
  CHECK(most > 1e-6);
  CHECK(most < 0.5);
}

TEST_CASE("the masses of a varied model are within the spread, and its dynamics are theirs") {
  const auto model = varied_model(Q2d(), {.mass = 0.2, .friction = 0}, 7);
  const auto& described = model_of(Q2d());
  for (int b = 0; b < 2; ++b) {
    const double factor =
        model.mechanism.bodies[b].inertia.mass / described.mechanism.bodies[b].inertia.mass;
    CHECK(factor != 1);
    CHECK(std::abs(factor - 1) <= 0.2);
  }
  // The elbow's inertia is that of its body, and of nothing else.
  const double factor =
      model.mechanism.bodies[1].inertia.mass / described.mechanism.bodies[1].inertia.mass;
  const JointVector<2> q{0.1, 0.4};
  CHECK(mass_matrix(model, q)(1, 1) == Approx(factor * mass_matrix(Q2d(), q)(1, 1)));
}

TEST_CASE("gains that make the arm unstable give unstable futures, and good ones stable futures") {
  Arm arm;
  move(arm);
  for (const Future<2>& future : futures_of(arm, {.count = 20})) {
    CHECK(future.end == SimulationEnd::stable);
  }
  JointPidGains<2> gains = Q2d::pid_gains;
  for (PidGains& own : gains) own.derivative = 1000;
  const Law bad(gains);
  for (const Future<2>& future : futures(Q2d(), bad, start_of(arm), {}, {.count = 20})) {
    CHECK(future.end == SimulationEnd::unstable);
    CHECK(future.positions.size() == 51);
  }
}

TEST_CASE("futures end when they are not wanted any more") {
  const Law law(Q2d::pid_gains);
  int asked = 0;
  constexpr int lanes = LaneSimulator<Q2d>::lane_count;  // so many are simulated at once
  const FutureOptions options{.count = 3 * lanes};
  const auto some = futures(Q2d(), law, Start{}, {}, options, [&] { return ++asked < 300; });
  CHECK(some.size() == 2 * lanes);  // futures of 1000 cycles ask 126 times
  const auto all = futures(Q2d(), law, Start{}, {}, options);
  REQUIRE(all.size() == 3 * lanes);
  for (std::size_t k = 0; k < some.size(); ++k) CHECK(some[k].positions == all[k].positions);
  CHECK(futures(Q2d(), law, Start{}, {}, {.count = 10}, [] { return false; }).empty());
}

TEST_CASE("a controller that computes no number ends its future") {
  const auto broken = [](const ControlInput<2>&) noexcept {
    return EffortCommand<2>{JointVector<2>::Constant(std::numeric_limits<double>::quiet_NaN())};
  };
  const auto fan = futures(Q2d(), broken, Start{}, {}, {.count = 1});
  CHECK(fan[0].end == SimulationEnd::non_finite);
  CHECK(fan[0].positions.size() == 1);
}

TEST_CASE("options out of their range are refused by name") {
  const auto refusal = [](const FutureOptions& options, const Start& start = {}) -> std::string {
    try {
      static_cast<void>(futures(Q2d(), Law(), start, {}, options));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return {};
  };
  CHECK(refusal({.count = 1001}) == "futures: count 1001 is not within 1 .. 1000");
  CHECK(refusal({.horizon = 0}).starts_with("futures: horizon 0"));
  CHECK(refusal({.samples = 0}).starts_with("futures: samples 0"));
  CHECK(refusal({.spread = {.mass = 1}}).starts_with("futures: mass 1 "));
  CHECK(refusal({.spread = {.friction = -1}}).starts_with("futures: friction -1"));
  CHECK(refusal({.spread = {.delay = 101}}).starts_with("futures: delay 101"));
  Start start;
  start.state.position[1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal({}, start).find("not finite") != std::string::npos);
}
