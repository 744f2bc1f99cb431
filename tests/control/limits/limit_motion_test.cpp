// SPDX-License-Identifier: Apache-2.0
#include <articula/control/limits/limit_position.hpp>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"

using namespace articula;
using support::not_a_number;

namespace {

const JointCommandLimits limits{
    .lower = -1, .upper = 1, .velocity = 2, .acceleration = 10, .deceleration = 8, .jerk = 200};

}  // namespace

TEST_CASE("a step leaves the state to its caller, who may try it and choose another") {
  const StoppingMotion state({0.2, 0, 0}, limits.deceleration, limits.jerk, 1e-3);
  const MotionStep first = limit_motion(state, 0.1, limits, 1e-3);
  CHECK(limit_motion(state, -2, limits, 1e-3).next.motion().velocity < 0);
  const MotionStep again = limit_motion(state, 0.1, limits, 1e-3);
  CHECK(again.next.motion().velocity == first.next.motion().velocity);
  CHECK_FALSE(first.granted);
  CHECK(first.report.acceleration);
  CHECK(first.next.motion().velocity == 200 * 1e-3 * 1e-3);
  CHECK(limit_motion(state, 1e-4, limits, 1e-3).granted);
}

TEST_CASE("steps keep the limits for any requests, those of positions for any periods") {
  constexpr unsigned seed = 15;
  CAPTURE(seed);
  support::Random random(seed);
  StoppingMotion motion({0, 0, 0}, limits.deceleration, limits.jerk, 1e-3);
  PositionLimitState state{.stop = motion};
  double position = 0;
  for (int k = 0; k < 100'000; ++k) {
    const double period = k % 100 < 50 ? 1e-3 : random.number(5e-4, 4e-3);
    CAPTURE(k, period);
    motion = limit_motion(motion, random.number(-3, 3), limits, 1e-3).next;
    REQUIRE(std::abs(motion.motion().position) <= 1);
    REQUIRE(std::abs(motion.motion().velocity) <= 2 * (1 + 1e-9));

    const double request = random.one_in(50) ? not_a_number : random.number(-2, 2);
    state = limit_position(state, request, limits, period).next;
    const double next = state.stop.motion().position;
    REQUIRE(std::abs(next) <= 1);
    REQUIRE(std::abs(next - position) <= 2 * period * (1 + 1e-9));
    position = next;
  }
}

TEST_CASE("steps keep the acceleration if no deceleration is given, and take infinite limits") {
  constexpr unsigned seed = 16;
  CAPTURE(seed);
  support::Random random(seed);
  const double infinity = JointCommandLimits::infinity, period = 1e-3;
  const JointCommandLimits one{.lower = -1, .upper = 1, .velocity = 2, .acceleration = 5};
  const JointCommandLimits unlimited{
      .acceleration = infinity, .deceleration = infinity, .jerk = infinity};
  const auto start = [&](const JointCommandLimits& of) {
    return StoppingMotion({0, 0, 0}, of.bounded().deceleration, of.bounded().jerk, period);
  };
  StoppingMotion motion = start(one), free = start(unlimited);
  PositionLimitState state{.stop = start(one)};
  for (int k = 0; k < 20'000; ++k) {
    CAPTURE(k);
    const double request = random.number(-3, 3);
    motion = limit_motion(motion, request, one, period).next;
    REQUIRE(std::abs(motion.motion().acceleration) <= 5 * (1 + 1e-9));  // rounding
    state = limit_position(state, random.number(-2, 2), one, period).next;
    // The position limit wins over the acceleration by the slack of a position, 1e-13/dt^2.
    REQUIRE(std::abs(state.stop.motion().acceleration) <= 5 + 1e-6);
    free = limit_motion(free, request, unlimited, period).next;
    REQUIRE(free.motion().velocity == request);
  }
}
