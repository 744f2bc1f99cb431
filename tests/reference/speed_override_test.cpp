// SPDX-License-Identifier: Apache-2.0
#include <articula/reference/speed_override.hpp>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::infinity;
using support::not_a_number;

TEST_CASE("at speed 1 time is time") {
  SpeedOverride clock;
  for (int k = 0; k < 1000; ++k) clock.advance(0.001);
  CHECK(clock.time() == Approx(1).epsilon(1e-13));
  const JointReference<1> r{JointVector<1>(1.0), JointVector<1>(2.0), JointVector<1>(3.0)};
  CHECK(clock.apply(r).velocity[0] == 2);
  CHECK(clock.apply(r).acceleration[0] == 3);
}

TEST_CASE("no speed above the highest is taken") {
  SpeedOverride usual(1e9), fast(1e9, 1.5);
  for (SpeedOverride* clock : {&usual, &fast}) {
    clock->set(50);
    clock->advance(1);
    CHECK(clock->speed() == (clock == &fast ? 1.5 : 1));
  }
}

TEST_CASE("the speed changes at its rate and the time is its integral") {
  SpeedOverride clock(2, 1.5);
  clock.set(0);
  clock.advance(0.25);
  CHECK(clock.speed() == 0.5);
  CHECK(clock.time() == 0.1875);
  clock.advance(0.5);  // stands still after half of it
  CHECK(clock.speed() == 0);
  CHECK(clock.time() == 0.25);
  clock.set(1.5);
  clock.advance(1);
  CHECK(clock.speed() == 1.5);
  CHECK(clock.time() == Approx(0.25 + 0.75 * 0.75 + 0.25 * 1.5).epsilon(1e-14));
}

TEST_CASE("velocity and acceleration are the derivatives of the position in real time") {
  constexpr unsigned seed = 3;
  CAPTURE(seed);
  support::Random random(seed);
  SpeedOverride clock(0.7);
  const auto sample = [&] {  // r(s) = s^3
    const double s = clock.time();
    return clock.apply(JointReference<1>{JointVector<1>(s * s * s), JointVector<1>(3 * s * s),
                                         JointVector<1>(6 * s)});
  };
  constexpr double h = 1e-3;
  auto last = sample();
  for (int k = 0; k < 3000; ++k) {
    if (random.one_in(300)) clock.set(random.number(0, 1));
    clock.advance(h);
    const auto now = sample();
    // the trapezoidal rule, off by h^3/12 of the third derivative, or h^2 of the jump of the second
    // where the speed starts or stops changing: 27 times 0.7
    const double moved = h * (now.velocity[0] + last.velocity[0]) / 2;
    REQUIRE(now.position[0] - last.position[0] == Approx(moved).margin(20 * h * h));
    REQUIRE(std::abs(now.velocity[0] - last.velocity[0]) <= 40 * h);
    const auto back = clock.unapply(now);
    if (clock.speed() > 0.01) {
      REQUIRE(back.velocity[0] == Approx(3 * clock.time() * clock.time()).margin(1e-12));
      REQUIRE(back.acceleration[0] == Approx(6 * clock.time()).margin(1e-9));
    }
    last = now;
  }
}

TEST_CASE("hostile speeds pause, hostile periods are no time") {
  for (const double bad : {not_a_number, infinity, -infinity, -1.0}) {
    CAPTURE(bad);
    SpeedOverride clock(1e9);
    clock.set(bad);
    clock.advance(1e-3);
    CHECK(clock.speed() == 0);
    const double before = clock.time();
    clock.set(1);
    clock.advance(bad);
    CHECK(clock.time() == before);
  }
}

TEST_CASE("a rate or a highest speed out of range is refused") {
  for (const double bad : {0.0, 0.99, -1.0, 1e10, infinity, not_a_number}) {
    CHECK_THROWS_WITH(SpeedOverride(2, bad), Contains("highest speed"));
  }
  for (const double bad : {0.0, -1.0, 1e10, infinity, not_a_number}) {
    CHECK_THROWS_AS(SpeedOverride(bad), std::invalid_argument);
  }
}
