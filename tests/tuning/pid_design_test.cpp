// SPDX-License-Identifier: Apache-2.0
#include <articula/robots/q2d.hpp>
#include <articula/tuning/pid_design.hpp>
#include <articula/tuning/stability_margins.hpp>

#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using std::numbers::pi;
using support::infinity;
using support::not_a_number;

namespace {

/// The gains make what was asked for. 1e-12: some ten roundings, magnified where a phase is near
/// +-pi/2 and p a small part of what is asked of C.
void check_reached(const JointPlant& plant, const LoopTarget& target, const PidGains& gains) {
  const LoopGain loop(plant, gains, target.delay);
  CHECK(loop.magnitude(target.crossover) == Approx(1).epsilon(1e-12));
  CHECK(pi + loop.phase(target.crossover) == Approx(target.phase_margin).margin(1e-12));
  const StabilityMargins margins = stability_margins(loop);
  CHECK(margins.stable);
  REQUIRE(margins.crossovers.size() == 1);
  CHECK(margins.crossovers[0].frequency == Approx(target.crossover).epsilon(1e-9));
}

JointPlant random_plant(support::Random& random) {
  const double inertia = std::pow(10, random.number(-6, 4));
  if (random.one_in(4)) return {.inertia = inertia};
  return {.inertia = inertia, .time_constant = std::pow(10, random.number(-4, 3))};
}

/// The phase margin that a proportional gain alone gives.
double margin_alone(const JointPlant& plant, double crossover, double delay) {
  return pi / 2 - std::atan(crossover * plant.time_constant) - crossover * delay;
}

}  // namespace

TEST_CASE("a PID reaches any crossover and any phase margin that its phase allows") {
  support::Random random(11);
  for (int k = 0; k < 1000; ++k) {
    const JointPlant plant = random_plant(random);
    LoopTarget target{.crossover = std::pow(10, random.number(-2, 4))};
    if (random.one_in(2)) target.delay = random.number(0, 0.3) / target.crossover;
    const double alone = margin_alone(plant, target.crossover, target.delay);
    const double low = std::max(0.05, alone - 1.5), high = std::min(3.09, alone + 1.5);
    target.phase_margin = random.number(low, high);
    const double ratio = std::pow(10, random.number(std::log10(2), 4));
    CAPTURE(k, plant.inertia, plant.time_constant, target.crossover, target.phase_margin,
            target.delay, ratio);
    const PidGains gains = design_pid(plant, target, ratio);
    CHECK(gains.proportional > 0);
    CHECK(gains.integral > 0);
    CHECK(gains.derivative > 0);
    const double p = gains.proportional;
    CHECK(p * p / gains.integral / gains.derivative == Approx(ratio).epsilon(1e-12));
    check_reached(plant, target, gains);
  }
}

TEST_CASE("a PI reaches less than a proportional gain does, a PD more") {
  support::Random random(12);
  for (int k = 0; k < 1000; ++k) {
    const JointPlant plant = random_plant(random);
    LoopTarget target{.crossover = std::pow(10, random.number(-2, 4))};
    const double alone = margin_alone(plant, target.crossover, 0);
    CAPTURE(k, plant.inertia, plant.time_constant, target.crossover, alone);
    if (alone > 0.02) {
      target.phase_margin = alone * random.number(0.1, 0.9);
      const PidGains gains = design_pi(plant, target);
      CHECK(gains.integral > 0);
      CHECK(gains.derivative == 0);
      check_reached(plant, target, gains);
    }
    target.phase_margin = alone + random.number(0.01, 1.5);
    const PidGains gains = design_pd(plant, target);
    CHECK(gains.derivative > 0);
    CHECK(gains.integral == 0);
    check_reached(plant, target, gains);
  }
}

TEST_CASE("the course's gains come back from the margins that they have") {
  struct Case {
    JointPlant plant;
    PidGains gains;
  };
  for (const auto& [plant, gains] :
       {Case{{0.087388, 0.005}, Q2d::pid_gains[0]}, Case{{0.008201, 0.004}, Q2d::pid_gains[1]}}) {
    const Crossover crossover = stability_margins(plant, gains).crossovers.at(0);
    const double p = gains.proportional;
    const PidGains again = design_pid(plant, {crossover.frequency, crossover.phase_margin},
                                      p * p / gains.integral / gains.derivative);
    CHECK(again.proportional == Approx(p).epsilon(1e-10));
    // i and d are small parts of C at the crossover, some 1 %: that much less is known of them.
    CHECK(again.integral == Approx(gains.integral).epsilon(1e-8));
    CHECK(again.derivative == Approx(gains.derivative).epsilon(1e-8));
  }
}

TEST_CASE("phase margins out of reach are refused, naming what can be reached") {
  // w T = 1 at 10 rad/s: a proportional gain alone has pi/4.
  const JointPlant plant{.inertia = 2, .time_constant = 0.1};
  CHECK_THROWS_WITH(design_pi(plant, {.crossover = 10, .phase_margin = 0.8}),
                    Contains("PI") && Contains("0.785") && Contains("0.8 rad"));
  CHECK_THROWS_WITH(
      design_pd(plant, {.crossover = 10, .phase_margin = 0.78}),
      Contains("PD") && Contains("0.785") && Contains("2.356") && Contains("0.78 rad"));
  CHECK_THROWS_WITH(design_pd(plant, {.crossover = 10, .phase_margin = 2.4}),
                    Contains("PD") && Contains("2.356") && Contains("2.4 rad"));
  CHECK_THROWS_WITH(design_pid(plant, {.crossover = 10, .phase_margin = 2.4}),
                    Contains("PID") && Contains("2.356") && Contains("2.4 rad"));
  // A PI cannot hold an undamped inertia.
  CHECK_THROWS_WITH(design_pi({.inertia = 2}, {.crossover = 10, .phase_margin = 0.1}),
                    Contains("PI"));
  // Late efforts take their part: 0.1 s at 10 rad/s is 1 rad.
  CHECK_THROWS_WITH(design_pd(plant, {.crossover = 10, .phase_margin = 1.5, .delay = 0.1}),
                    Contains("1.356") && Contains("1.5 rad"));
}

TEST_CASE("targets that make no sense are refused by name and value") {
  const JointPlant plant{.inertia = 2, .time_constant = 0.1};
  const LoopTarget good{.crossover = 10};
  for (double bad : {0.0, -1.0, infinity, -infinity, not_a_number}) {
    CAPTURE(bad);
    LoopTarget target = good;
    target.crossover = bad;
    CHECK_THROWS_WITH(design_pid(plant, target), Contains("crossover"));
    CHECK_THROWS_WITH(design_pi(plant, target), Contains("crossover"));
    CHECK_THROWS_WITH(design_pd(plant, target), Contains("crossover"));
    target = good;
    target.phase_margin = bad;
    CHECK_THROWS_WITH(design_pid(plant, target), Contains("phase_margin"));
    target = good;
    target.delay = bad;
    if (bad != 0) CHECK_THROWS_WITH(design_pid(plant, target), Contains("delay"));
    CHECK_THROWS_WITH(design_pid({.inertia = bad}, good), Contains("inertia"));
    CHECK_THROWS_WITH(design_pid(plant, good, bad), Contains("time_ratio"));
  }
  LoopTarget target = good;
  target.phase_margin = pi;
  CHECK_THROWS_WITH(design_pid(plant, target), Contains("phase_margin") && Contains("3.14"));
  CHECK_THROWS_WITH(design_pid(plant, good, 1.99), Contains("time_ratio 1.99"));
  // What overflows or vanishes is refused, too.
  CHECK_THROWS_AS(design_pid({.inertia = 1e300}, {.crossover = 1e10}), std::invalid_argument);
  CHECK_THROWS_AS(design_pid({.inertia = 1e-300}, {.crossover = 1e-20}), std::invalid_argument);
}
