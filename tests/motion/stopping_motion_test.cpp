// SPDX-License-Identifier: Apache-2.0
#include <articula/motion/stopping_motion.hpp>

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "random.hpp"

using namespace articula;

namespace {

struct Case {
  JointMotion from;
  double deceleration, jerk, period;
};

Case random_case(support::Random& random) {
  Case c;
  c.period = std::pow(10, random.number(-4, -1.5));
  c.deceleration = std::pow(10, random.number(-1, 3));
  c.jerk = random.one_in(3) ? 1e30 : c.deceleration * std::pow(10, random.number(-0.5, 5));
  // Within two thousand cycles or so.
  const double speed = 2000 * c.deceleration * c.period;
  c.from = {random.number(-1, 1), random.number(-1, 1) * std::min(speed, 10.0),
            random.one_in(5) ? 0 : random.number(-1, 1) * c.deceleration};
  const bool takes_long = c.jerk * c.period < 0.01 * c.deceleration;
  if (random.one_in(4) && !takes_long) c.from.acceleration *= 5;  // it may brake harder already
  return c;
}

}  // namespace

TEST_CASE("at rest nothing happens") {
  StoppingMotion stop({3, 0, 0}, 1, 10, 1e-3);
  stop.advance();
  CHECK(stop.motion().position == 3);
  CHECK(stop.motion().velocity == 0);
  CHECK(stop.positions().lowest == 3);
  CHECK(stop.positions().highest == 3);
}

TEST_CASE("without a limit of jerk the deceleration is constant, but for the last cycle's rest") {
  StoppingMotion stop({0, 1, 0}, 1, 1e30, 0.3);  // 3.3 cycles, so three and one with less
  const double expected[] = {0.7, 0.4, 0.1, 0};
  for (const double velocity : expected) {
    stop.advance();
    CHECK(stop.motion().velocity == Approx(velocity).margin(1e-15));
  }
  CHECK(stop.motion().position == Approx(0.3 * 1.2).epsilon(1e-15));
}

TEST_CASE(
    "stops keep their limits in every cycle, end at rest, and stay within the foretold range") {
  constexpr unsigned seed = 7;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 20000; ++k) {
    CAPTURE(k);
    const Case c = random_case(random);
    StoppingMotion stop(c.from, c.deceleration, c.jerk, c.period);
    const ValueRange q = stop.positions(), v = stop.velocities();
    JointMotion last = c.from;
    ValueRange seen_q{last.position, last.position}, seen_v{last.velocity, last.velocity};
    int cycles = 0;
    bool kept = true;
    do {
      stop.advance();
      const JointMotion& m = stop.motion();
      seen_q = {std::min(seen_q.lowest, m.position), std::max(seen_q.highest, m.position)};
      seen_v = {std::min(seen_v.lowest, m.velocity), std::max(seen_v.highest, m.velocity)};
      // Up to rounding: of sums of thousands of cycles, and what is not worth a cycle (1e-9 of a
      // step).
      const double a = c.deceleration;
      kept =
          kept &&
          std::abs(m.acceleration) <= std::max(a, std::abs(last.acceleration)) * (1 + 1e-6) &&
          std::abs(m.acceleration - last.acceleration) <=
              c.jerk * c.period * (1 + 1e-6) + 1e-9 * a &&
          std::abs(m.velocity - last.velocity - m.acceleration * c.period) <= 1e-7 * a * c.period;
      last = m;
    } while ((last.velocity != 0 || last.acceleration != 0) && ++cycles < 100000);
    CHECK(cycles < 100000);
    CHECK(kept);
    // Sums of thousands of cycles against closed forms.
    const double way = 1 + q.highest - q.lowest, speed = 1e-3 + v.highest - v.lowest;
    CHECK(seen_q.lowest == Approx(q.lowest).margin(1e-9 * way));
    CHECK(seen_q.highest == Approx(q.highest).margin(1e-9 * way));
    CHECK(seen_v.lowest == Approx(v.lowest).margin(1e-9 * speed));
    CHECK(seen_v.highest == Approx(v.highest).margin(1e-9 * speed));
  }
}

TEST_CASE("a stop is about as fast as in continuous time") {
  constexpr unsigned seed = 8;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 2000; ++k) {
    const double v = random.number(0.1, 5), b = random.number(1, 50), j = random.number(10, 1e4);
    CAPTURE(v, b, j);
    constexpr double dt = 1e-3;
    // From a = 0: ramps of p/J each and a rest between them.
    const double p = std::min(b, std::sqrt(j * v));
    const double time = p / j + v / p;
    StoppingMotion stop({0, v, 0}, b, j, dt);
    int cycles = 0;
    while (stop.motion().velocity != 0 || stop.motion().acceleration != 0) {
      stop.advance();
      ++cycles;
    }
    // Three stretches of whole cycles.
    CHECK(cycles * dt <= time + 3 * dt);
    CHECK(stop.motion().position <= v * time / 2 + dt * v);
  }
}

TEST_CASE("who brakes too hard takes that back step by step, and then brakes as hard as may be") {
  constexpr double dt = 1e-3;
  for (const double jerk : {200.0, 3e3, 4.9e3, 9e3, 1e5, 1e30}) {
    CAPTURE(jerk);
    StoppingMotion stop({0, 2, -10}, 2, jerk, dt);
    const double steps = std::ceil(8 / (jerk * dt));
    for (int cycle = 1; cycle <= steps; ++cycle) {
      const double before = stop.motion().acceleration;
      stop.advance();
      CHECK(stop.motion().acceleration <= -2 + 1e-9);
      CHECK(stop.motion().acceleration - before <= jerk * dt * (1 + 1e-9));
    }
    CHECK(stop.motion().acceleration == Approx(-2));
    // The way back takes B^2/(2 J) of the velocity, and what is left by whole cycles less than B
    // dt.
    while (stop.motion().velocity > 2 * 2 / (2 * jerk) + 2 * 2 * dt) {
      stop.advance();
      REQUIRE(stop.motion().acceleration == Approx(-2));
    }
  }
}

TEST_CASE("what is on any way to rest has a stop, whose highest velocity is no higher") {
  constexpr unsigned seed = 9;
  CAPTURE(seed);
  support::Random random(seed);
  constexpr double dt = 1e-3;
  for (int k = 0; k < 300; ++k) {
    const double most = random.number(1, 50), jerk = most * std::pow(10, random.number(0, 3));
    const double step = jerk * dt;
    CAPTURE(k, most, jerk);
    // Backwards from rest: the acceleration wanders, in steps that often are as large as they may
    // be.
    JointMotion m;
    double highest = 0;  // speed on the rest of the way
    for (int cycle = 0; cycle < 300; ++cycle) {
      const double change = random.one_in(2) ? step : step * random.number(-1, 1);
      const double before = std::clamp(m.acceleration - change, -most, most);
      m = {0, m.velocity - m.acceleration * dt, before};
      highest = std::max(highest, std::abs(m.velocity));
      const StoppingMotion stop(m, most, jerk, dt);
      const ValueRange v = stop.velocities();
      CAPTURE(cycle, m.velocity, m.acceleration);
      REQUIRE(std::max(v.highest, -v.lowest) <= highest * (1 + 1e-12) + 1e-12);  // rounding
    }
  }
}
