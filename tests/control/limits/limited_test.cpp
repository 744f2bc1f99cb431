// SPDX-License-Identifier: Apache-2.0
// Position and velocity commands within their limits: whatever is asked for, and with a way back.
#include <articula/control/forward_position.hpp>
#include <articula/control/forward_velocity.hpp>
#include <articula/control/limits/limited.hpp>
#include <articula/control/position_by_velocity.hpp>
#include <articula/reference/jerk_limited_profile.hpp>

#include <algorithm>
#include <cmath>

#include "by_hand.hpp"
#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using support::infinity;
using support::not_a_number;

namespace {

constexpr double dt = 1e-3;

using Slider = Model<1>;
using Positions = support::ByHand<Limited<Slider, ForwardPosition<Slider>>>;
using Velocities = support::ByHand<Limited<Slider, ForwardVelocity<Slider>>>;

/// Limits of one joint, some of them infinite.
CommandLimits<1> random_limits(support::Random& random) {
  CommandLimits<1> limits;
  limits.lower[0] = random.number(-2, -0.1);
  limits.upper[0] = random.number(0.1, 2);
  if (!random.one_in(4)) limits.velocity[0] = random.number(0.1, 5);
  if (!random.one_in(4)) {
    limits.acceleration[0] = std::pow(10, random.number(0, 3));
    if (random.one_in(3)) {
      limits.deceleration[0] = limits.acceleration[0] * std::pow(10, random.number(-2, 0));
    }
    if (random.one_in(2))
      limits.jerk[0] = limits.acceleration[0] * std::pow(10, random.number(0.5, 4.5));
  }
  return limits;
}

/// Limits of smooth motion.
CommandLimits<1> smooth(double velocity, double acceleration, double jerk) {
  CommandLimits<1> limits;
  limits.velocity[0] = velocity;
  limits.acceleration[0] = acceleration;
  limits.jerk[0] = jerk;
  return limits;
}

/// A wish that changes at random: steps, noise, ramps, and beyond all limits.
class Wishes {
 public:
  Wishes(support::Random& random, double size) : random_(random), size_(size) {}

  double next() {
    if (random_.one_in(300)) mode_ = random_.integer(0, 2);
    if (mode_ == 0 || random_.one_in(200)) wish_ = random_.number(-size_, size_);
    if (mode_ == 1) wish_ += random_.number(-1, 1) * size_ * dt;
    if (random_.one_in(5000)) return random_.number(-1, 1) * 1e12;
    return wish_;
  }

 private:
  support::Random& random_;
  double size_, wish_ = 0;
  int mode_ = 0;
};

/// Follows commands and checks each against the limits, by differences.
struct Watch {
  const CommandLimits<1>& limits;
  double q = 0, v = 0, a = 0;

  /// @return whether the limits are kept, up to what differences of rounded numbers tell
  bool follow(double position) {
    const double rounding = 1e-15 * (1 + std::abs(position));
    const double v_new = (position - q) / dt, a_new = (v_new - v) / dt, j = (a_new - a) / dt;
    const bool kept =
        position >= limits.lower[0] && position <= limits.upper[0] &&
        std::abs(v_new) <= limits.velocity[0] * (1 + 1e-9) + 4 * rounding / dt &&
        std::abs(a_new) <= limits.acceleration[0] * (1 + 1e-8) + 8 * rounding / dt / dt &&
        std::abs(j) <= limits.jerk[0] * (1 + 1e-6) + 16 * rounding / dt / dt / dt;
    q = position;
    v = v_new;
    a = a_new;
    return kept;
  }
};

JointState<1> at(double position, double velocity = 0) {
  JointState<1> state;
  state.position[0] = position;
  state.velocity[0] = velocity;
  return state;
}

JointReference<1> to_position(double position) {
  JointReference<1> reference;
  reference.position[0] = position;
  return reference;
}

JointReference<1> to_velocity(double velocity) {
  JointReference<1> reference;
  reference.velocity[0] = velocity;
  return reference;
}

Positions positions_within(const CommandLimits<1>& limits) {
  const Slider robot = support::slider();
  return Positions(robot, limits, ForwardPosition<Slider>(robot));
}

/// Position commands to a drive that follows.
struct PositionRun {
  Positions controller;
  double q = 0, v = 0;

  explicit PositionRun(const CommandLimits<1>& limits, double position = 0, double velocity = 0)
      : controller(positions_within(limits)) {
    start(position, velocity);
  }
  void start(double position, double velocity) {
    q = position;
    v = velocity;
    controller.start(at(q, v));
  }
  double next(double asked, double period = dt) {
    const double given = controller.update(at(q, v), to_position(asked), period).position[0];
    v = (given - q) / period;
    return q = given;
  }
  [[nodiscard]] const JointLimitReport& report() const { return controller.report()[0]; }
};

Velocities velocities_within(const CommandLimits<1>& limits) {
  const Slider robot = support::slider();
  return Velocities(robot, limits, ForwardVelocity<Slider>(robot));
}

}  // namespace

TEST_CASE("position commands keep all limits in every cycle, whatever is asked for") {
  constexpr unsigned seed = 9;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 200; ++k) {
    CAPTURE(k);
    const CommandLimits<1> limits = random_limits(random);
    PositionRun run(limits);
    Wishes wishes(random, 3);
    Watch watch{limits};
    for (int cycle = 0; cycle < 3000; ++cycle) {
      CAPTURE(cycle);
      const double wish = wishes.next();
      REQUIRE(watch.follow(run.next(wish)));
    }
  }
}

TEST_CASE("velocity commands keep all limits of a drive that follows") {
  constexpr unsigned seed = 10;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 200; ++k) {
    CAPTURE(k);
    const CommandLimits<1> limits = random_limits(random);
    Velocities controller = velocities_within(limits);
    Wishes wishes(random, 5);
    double q = 0, v = 0, a = 0, furthest = 0;
    controller.start(at(0));
    for (int cycle = 0; cycle < 3000; ++cycle) {
      CAPTURE(cycle);
      const double given = controller.update(at(q, v), to_velocity(wishes.next()), dt).velocity[0];
      const double a_new = (given - v) / dt;
      REQUIRE(std::abs(given) <= limits.velocity[0] * (1 + 1e-15));  // rounding
      REQUIRE(std::abs(a_new) <= limits.acceleration[0] * (1 + 1e-8));
      REQUIRE(std::abs(a_new - a) <= limits.jerk[0] * dt * (1 + 1e-6) + 1e-9);
      q += given * dt;
      v = given;
      a = a_new;
      furthest = std::max({furthest, limits.lower[0] - q, q - limits.upper[0]});
    }
    CHECK(furthest < 1e-12);  // rounding
  }
}

TEST_CASE("a joint at its limit comes back as fast as its limits allow") {
  constexpr unsigned seed = 11;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 200; ++k) {
    CommandLimits<1> limits = random_limits(random);
    limits.velocity[0] = random.number(0.5, 5);
    limits.acceleration[0] = limits.deceleration[0] = random.number(5, 50);
    CAPTURE(k, limits.upper[0], limits.velocity[0], limits.acceleration[0], limits.jerk[0]);
    PositionRun run(limits);
    for (int cycle = 0; cycle < 20000; ++cycle) run.next(1e6);
    CHECK(run.q == Approx(limits.upper[0]).margin(1e-9));
    CHECK(run.report().position);
    // A quarter of a second from rest: a t^2/2, or what jerk and velocity leave of it.
    const double a = limits.acceleration[0], j = limits.jerk[0], t = 0.25;
    const double reached = std::min({a * t * t / 2, j * t * t * t / 6, limits.velocity[0] * t});
    for (int cycle = 0; cycle < 250; ++cycle) run.next(-1e6);
    CHECK(limits.upper[0] - run.q >=
          std::min(0.3 * reached, 0.5 * (limits.upper[0] - limits.lower[0])));
  }
}

TEST_CASE("what is within the limits passes to the last bit, and is not reported") {
  CommandLimits<1> limits = smooth(10, 100, 1e4);
  limits.lower[0] = -1;
  limits.upper[0] = 1;
  Positions positions = positions_within(limits);
  Velocities velocities = velocities_within(limits);
  positions.start(at(0.5));
  velocities.start(at(0.5));
  for (int k = 0; k < 5000; ++k) {
    const double t = k * dt;
    const double q = 0.5 * std::cos(2 * t), v = -std::sin(2 * t);
    REQUIRE(positions.update(at(q), to_position(q), dt).position[0] == q);
    REQUIRE(velocities.update(at(q, v), to_velocity(v), dt).velocity[0] == v);
    REQUIRE_FALSE(positions.report()[0].any());
    REQUIRE_FALSE(velocities.report()[0].any());
    CHECK(positions.report()[0].asked == q);
    CHECK(positions.report()[0].limited == q);
  }
}

TEST_CASE("a constant position is approached without crossing it, and then held to the last bit") {
  constexpr unsigned seed = 14;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 200; ++k) {
    CommandLimits<1> limits = random_limits(random);
    if (k == 0) {  // known to ring by 0.097 where nothing looks ahead
      limits = smooth(1, 10, 100);
    }
    CAPTURE(k, limits.velocity[0], limits.acceleration[0], limits.deceleration[0], limits.jerk[0]);
    PositionRun run(limits);
    Watch watch{limits};
    for (int leg = 0; leg < 3; ++leg) {
      const double goal =
          k == 0 ? 0.5 - 0.4 * leg
                 : random.number(std::max(limits.lower[0], -2.0), std::min(limits.upper[0], 2.0));
      CAPTURE(leg, goal, watch.q);
      // What is so near cannot be told from the beginning of a motion that is to be followed.
      const double near = is_finite(limits.jerk[0]) ? 2.2 * limits.jerk[0] * dt * dt * dt : 0;
      if (std::abs(goal - watch.q) < near) continue;
      const double side = goal > watch.q ? 1 : -1;
      double beyond = 0;
      int cycles = 0;
      // It rests there for ten cycles; the slowest way takes 4 m at 0.1 m/s, and 4 s to speed up.
      for (int held = 0; held < 10 && cycles < 50000; ++cycles) {
        REQUIRE(watch.follow(run.next(goal)));
        beyond = std::max(beyond, side * (watch.q - goal));
        held = watch.q == goal ? held + 1 : 0;
      }
      CHECK(beyond < 1e-12);  // rounding
      CHECK(cycles < 50000);
      CHECK(watch.v == 0);
      CHECK(watch.a == 0);
    }
  }
}

TEST_CASE("a position that moves is met in its own motion, and followed") {
  const CommandLimits<1> limits = smooth(1, 10, 100);
  // A joint at rest cannot follow these from the first cycle on: it must catch up.
  const auto ramp = [](double t) { return 0.3 * t; };
  const auto wave = [](double t) { return 0.3 * std::sin(2 * t); };
  const auto check = [&](const auto& signal, double crossed) {
    PositionRun run(limits);
    Watch watch{limits};
    double beyond = 0;
    for (int k = 1; k < 3000; ++k) {
      CAPTURE(k);
      const double asked = signal(k * dt);
      REQUIRE(watch.follow(run.next(asked)));
      beyond = std::max(beyond, watch.q - asked);
      if (k > 500) REQUIRE(watch.q == asked);
    }
    CHECK(beyond <= crossed);
  };
  check(ramp, 1e-12);  // rounding
  check(wave, 5e-3);   // its acceleration is not constant, as is foreseen
}

TEST_CASE("a moving position may be rounded") {
  const CommandLimits<1> limits = smooth(1, 10, 100);
  PositionRun run(limits);
  double largest = 0;
  for (int k = 0; k < 5000; ++k) {
    const auto rounded = static_cast<float>(0.3 * (1 - std::cos(2 * k * dt)));
    const auto asked = static_cast<double>(rounded);
    const double given = run.next(asked);
    largest = std::max(largest, std::abs(given - asked));
  }
  CHECK(largest < 2e-4);  // the acceleration begins with a step, of 1.2; braking takes 5e-2
}

TEST_CASE("a motion as fast as the limits allow passes to the last bit") {
  constexpr unsigned seed = 15;
  CAPTURE(seed);
  support::Random random(seed);
  const Slider robot = support::slider();
  for (int k = 0; k < 300; ++k) {
    const double acceleration = std::pow(10, random.number(0, 2));
    CommandLimits<1> limits =
        smooth(random.number(0.1, 3), acceleration, acceleration * random.number(3, 300));
    const JointVector<1> from(random.number(-1, 1)), to(random.number(-1, 1));
    const JerkLimitedProfile<Slider> profile(robot, from, to,
                                             {limits.velocity, limits.acceleration, limits.jerk});
    const bool ends_at_limit = random.one_in(2);
    (to[0] > from[0] ? limits.upper : limits.lower)[0] =
        ends_at_limit ? to[0] : 2 * to[0] - from[0];
    CAPTURE(k, from[0], to[0], limits.velocity[0], limits.acceleration[0], limits.jerk[0]);
    PositionRun run(limits, from[0]);
    for (int cycle = 1; cycle * dt < profile.duration() + 0.1; ++cycle) {
      CAPTURE(cycle);
      const double asked = profile.sample(cycle * dt).position[0];
      REQUIRE(run.next(asked) == asked);
      REQUIRE_FALSE(run.report().any());
    }
  }
}

TEST_CASE("a position far out leads to the limit, and says so") {
  CommandLimits<1> limits = smooth(1, 10, 100);
  limits.lower[0] = -1;
  limits.upper[0] = 1;
  for (const double asked : {2.0, 1e15, 1e300, 1e308}) {
    CAPTURE(asked);
    PositionRun run(limits);
    double given = 0;
    for (int k = 0; k < 5000; ++k) {
      given = run.next(asked);
    }
    CHECK(given == Approx(1));
    CHECK(run.report().position);
    CHECK_FALSE(run.report().non_finite);
  }
}

TEST_CASE("the report says which limit it was") {
  CommandLimits<1> limits;
  const auto report_of = [&](double wish) {
    Positions controller = positions_within(limits);
    controller.start(at(0));
    static_cast<void>(controller.update(at(0), to_position(wish), dt));
    return controller.report()[0];
  };
  CHECK_FALSE(report_of(1).any());
  limits.velocity[0] = 1;
  CHECK(report_of(1).velocity);
  CHECK(report_of(1).limited == Approx(1e-3));
  CHECK(report_of(1).asked == 1);
  limits = {};
  limits.acceleration[0] = 1;
  CHECK(report_of(1).acceleration);
  limits = {};
  limits.jerk[0] = 1;
  CHECK(report_of(1).jerk);
  limits = {};
  limits.upper[0] = 0.5;
  CHECK(report_of(1).position);
  CHECK_FALSE(report_of(0.5).any());
  limits = {};
  limits.soft_upper[0] = 0.5;
  limits.soft_rate[0] = 10;
  CHECK(report_of(1).soft_position);
  limits.soft_rate[0] = infinity;
  CHECK(report_of(1).soft_position);
  CHECK_FALSE(report_of(1).position);
  CHECK(report_of(not_a_number).non_finite);
  CHECK_FALSE(report_of(not_a_number).position);
}

TEST_CASE("a soft limit is approached with a speed proportional to the distance") {
  CommandLimits<1> limits;
  limits.upper[0] = 1;
  limits.soft_upper[0] = 0.5;
  limits.soft_rate[0] = 10;
  PositionRun run(limits);
  double q = 0;
  for (int k = 0; k < 500; ++k) {
    const double expected = q + 10 * (0.5 - q) * dt;
    q = run.next(2);
    REQUIRE(q == Approx(expected).epsilon(1e-12));
  }
  CHECK(q == Approx(0.5).margin(0.5 * std::exp(-5)));
  q = run.next(-2);  // and back without delay
  CHECK(q == -2);
}

TEST_CASE("a joint brakes in time for its soft limit, and rests there") {
  constexpr unsigned seed = 13;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 100; ++k) {
    CommandLimits<1> limits = random_limits(random);
    limits.soft_lower[0] = limits.lower[0] / 2;
    limits.soft_upper[0] = limits.upper[0] / 2;
    if (random.one_in(2)) limits.soft_rate[0] = std::pow(10, random.number(0, 4));
    CAPTURE(k, limits.velocity[0], limits.acceleration[0], limits.jerk[0], limits.soft_rate[0]);
    PositionRun run(limits);
    Watch watch{limits};
    const double side = random.one_in(2) ? 1 : -1;
    const double end = side > 0 ? limits.soft_upper[0] : limits.soft_lower[0];
    for (int cycle = 0; cycle < 30000; ++cycle) {
      REQUIRE(watch.follow(run.next(2 * end)));
      REQUIRE(watch.q * side <= end * side + 1e-12);  // rounding
    }
    CHECK(watch.q == Approx(end).margin(1e-6));
    CHECK(run.report().soft_position);
    CHECK_FALSE(run.report().position);
    for (int cycle = 0; cycle < 30000 && watch.q * side > 0; ++cycle) {  // the way back is open
      REQUIRE(watch.follow(run.next(0)));
    }
    CHECK(watch.q * side <= 0);
  }
}

TEST_CASE("however high its rate, a soft limit is reached in a cycle and not passed") {
  for (const double rate : {1e3, 5e3, 1e300, infinity}) {
    CAPTURE(rate);
    CommandLimits<1> limits;
    limits.upper[0] = 1;
    limits.soft_upper[0] = 0.5;
    limits.soft_rate[0] = rate;
    PositionRun run(limits);
    for (int k = 0; k < 3; ++k) {
      const double q = run.next(2);
      REQUIRE(q == Approx(0.5).epsilon(1e-12));
      REQUIRE(run.report().soft_position);
    }
  }
}

TEST_CASE("a joint that begins beyond its limits may come back, and go no further") {
  constexpr unsigned seed = 12;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 200; ++k) {
    CAPTURE(k);
    const CommandLimits<1> limits = random_limits(random);
    const double outside = limits.upper[0] + random.number(0.01, 1);
    PositionRun run(limits, outside);
    for (int cycle = 0; cycle < 100; ++cycle) {
      REQUIRE(run.next(100) == outside);
    }
    double q = outside;
    for (int cycle = 0; cycle < 60000 && q > 0; ++cycle) {
      const double next = run.next(-100);
      REQUIRE(next <= q);
      q = next;
    }
    CHECK(q <= 0);
  }
}

TEST_CASE("a joint that moves when control begins is slowed down, not stopped dead") {
  CommandLimits<1> limits;
  limits.acceleration[0] = 10;
  limits.velocity[0] = 1;
  PositionRun run(limits, 0, 2);  // twice as fast as it may be
  for (int k = 0; k < 300; ++k) {
    const double before = run.v;
    run.next(0);
    REQUIRE(std::abs(run.v - before) <= 10 * dt * (1 + 1e-6));
  }
  CHECK(run.v < 0);  // on its way back
}

TEST_CASE("a joint that moves when control begins follows from the first cycle on") {
  PositionRun run(smooth(2, 10, infinity));
  for (const double from : {0.0, 5.0}) {  // also where another position was asked for before
    CAPTURE(from);
    run.start(from, 1);
    for (int k = 1; k < 100; ++k) {
      CAPTURE(k);
      REQUIRE(run.next(from + k * dt) == from + k * dt);
      REQUIRE_FALSE(run.report().any());
    }
  }
}

TEST_CASE("a position that jumps ahead of a joint that follows it is not crossed") {
  PositionRun run(smooth(2, 10, infinity), 0, 1);
  for (int k = 1; k < 100; ++k) REQUIRE(run.next(k * dt) == k * dt);
  // From 1 m/s the way to rest is 1/(2 * 10) m, and half a cycle's way more on the grid; one
  // cycle's acceleration more, and it would be too long.
  const double goal = run.q + 0.0512;
  for (int k = 0; k < 1000; ++k) REQUIRE(run.next(goal) <= goal + 1e-12);  // rounding
  CHECK(run.q == goal);
}

TEST_CASE("after it has braked for a wrong number a joint follows as after a start") {
  PositionRun run(smooth(1, 10, 100));
  for (int k = 0; k < 500; ++k) run.next(100);
  for (int k = 0; k < 1000; ++k) run.next(not_a_number);
  double q = run.q, v = 0, a = 0;  // at rest
  for (int k = 0; k < 50; ++k) {
    CAPTURE(k);
    a += 0.9 * 100 * dt;
    v += a * dt;
    q += v * dt;
    REQUIRE(run.next(q) == q);
  }
}

TEST_CASE("on the way to a position every cycle's report says what holds the joint back") {
  const auto check = [](const CommandLimits<1>& limits, bool JointLimitReport::* limit) {
    PositionRun run(limits);
    int cycles = 0;
    // What has come as close as rounding is there.
    for (; std::abs(run.next(0.5) - 0.5) > 1e-11 && cycles < 5000; ++cycles) {
      CAPTURE(cycles);
      REQUIRE(run.report().*limit);
    }
    CHECK(cycles > 100);
    CHECK(cycles < 5000);
  };
  check(smooth(infinity, 10, infinity), &JointLimitReport::acceleration);
  check(smooth(infinity, infinity, 100), &JointLimitReport::jerk);
}

TEST_CASE("a velocity drive that is pushed beyond its limit is not sent further") {
  CommandLimits<1> limits;
  limits.upper[0] = 1;
  limits.acceleration[0] = 10;
  Velocities controller = velocities_within(limits);
  controller.start(at(1.2));
  CHECK(controller.update(at(1.2), to_velocity(1), dt).velocity[0] == 0);
  CHECK(controller.update(at(1.3), to_velocity(1), dt).velocity[0] == 0);
  CHECK(controller.update(at(1.3), to_velocity(-1), dt).velocity[0] == Approx(-0.01));
}

TEST_CASE("the reserve between deceleration and acceleration is used when it is needed") {
  CommandLimits<1> limits;
  limits.upper[0] = 1;
  limits.deceleration[0] = 5;
  limits.acceleration[0] = 20;
  Velocities controller = velocities_within(limits);
  controller.start(at(0.5));
  double q = 0.5, v = 0, hardest = 0;
  for (int k = 0; k < 2000; ++k) {
    const double given = controller.update(at(q, v), to_velocity(2), dt).velocity[0];
    hardest = std::max(hardest, (v - given) / dt);
    v = given;
    q += 1.02 * v * dt;  // the drive goes a little further than told
  }
  CHECK(hardest > 5);
  CHECK(hardest <= 20 * (1 + 1e-9));
  CHECK(q < 1 + 1e-4);
}

TEST_CASE("numbers that are none never pass, and the joint brakes within its limits") {
  const double hostile[] = {not_a_number, infinity, -infinity};
  for (const double wrong : hostile) {
    CAPTURE(wrong);
    CommandLimits<1> limits;
    limits.acceleration[0] = 10;
    limits.upper[0] = 1;
    Positions positions = positions_within(limits);
    Velocities velocities = velocities_within(limits);
    positions.start(at(0, 0.5));
    velocities.start(at(0, 0.5));
    double q = 0, v = 0.5;
    for (int k = 0; k < 100; ++k) {
      const double next = positions.update(at(q, v), to_position(wrong), dt).position[0];
      REQUIRE(is_finite(next));
      CHECK(positions.report()[0].non_finite);
      const double given = velocities.update(at(q, v), to_velocity(wrong), dt).velocity[0];
      CHECK(velocities.report()[0].non_finite);
      REQUIRE((next - q) / dt == Approx(given).margin(1e-12));
      REQUIRE(v - given <= 10 * dt * (1 + 1e-9));
      q = next;
      v = given;
    }
    CHECK(v == 0);
  }
}

TEST_CASE("the controller's cut is what the limits took, and it does not wind up") {
  const Slider robot = support::slider();
  CommandLimits<1> limits;
  limits.velocity[0] = 1;
  using Approach = support::ByHand<Limited<Slider, PositionByVelocity<Slider>>>;
  Approach controller(
      robot, limits,
      PositionByVelocity<Slider>(robot, {PidGains{.proportional = 5, .integral = 2}}));
  controller.start(at(0));
  for (int k = 0; k < 100; ++k) static_cast<void>(controller.update(at(0), to_position(10), dt));
  // The last step is taken back, and no other follows.
  static_cast<void>(controller.update(at(0), to_position(0), dt));
  CHECK(controller.controller().part<PidLaw<1>>().integral()[0] == 0);
}

TEST_CASE("the period may change") {
  CommandLimits<1> limits = smooth(2, 10, 100);
  limits.upper[0] = 1;
  PositionRun run(limits);
  double q = 0;
  for (int k = 0; k < 4000; ++k) {
    const double period = k % 7 == 0 ? 2e-3 : 1e-3;
    const double next = run.next(5, period);
    REQUIRE(next <= 1);
    REQUIRE(std::abs(next - q) <= 2 * period * (1 + 1e-9));
    q = next;
  }
  CHECK(q == Approx(1).margin(1e-3));
}

TEST_CASE("positions and speeds stay within their limits however the period changes") {
  constexpr unsigned seed = 11;
  CAPTURE(seed);
  support::Random random(seed);
  enum class Periods { alternating, around, extreme };
  double fastest = 0;
  for (const Periods periods : {Periods::alternating, Periods::around, Periods::extreme}) {
    for (int k = 0; k < 200; ++k) {
      CAPTURE(static_cast<int>(periods), k);
      const CommandLimits<1> limits = random_limits(random);
      PositionRun run(limits);
      Wishes wishes(random, 3);
      for (int cycle = 0; cycle < 1000; ++cycle) {
        const double period = periods == Periods::alternating ? (cycle % 2 == 0 ? 0.5e-3 : 1.5e-3)
                              : periods == Periods::around    ? random.number(0.5e-3, 1.5e-3)
                              : random.one_in(5)              ? std::pow(10, random.number(-5, -1))
                                                              : dt;
        const double before = run.q, q = run.next(wishes.next(), period);
        REQUIRE(q >= limits.lower[0]);
        REQUIRE(q <= limits.upper[0]);
        const double rounding = 4e-15 * (1 + std::abs(q)) / period;
        REQUIRE(std::abs(q - before) / period <= limits.velocity[0] * (1 + 1e-9) + rounding);
        fastest = std::max(fastest, std::abs(q - before) / period / limits.velocity[0]);
      }
    }
  }
  CHECK(fastest > 0.99);  // the limit is reached
}

TEST_CASE("limits that make no sense are refused, naming joint, limit and value") {
  struct Bad {
    JointVector<1> CommandLimits<1>::* member;
    double value;
    const char* name;
  };
  Slider robot = support::slider();
  robot.joints[0].limits = {.lower = -1, .upper = 1, .velocity = 2, .effort = 3};
  const Bad all[] = {{&CommandLimits<1>::lower, -1.5, "lower -1.5"},
                     {&CommandLimits<1>::upper, 1.5, "upper 1.5"},
                     {&CommandLimits<1>::lower, 2, "lower 2"},
                     {&CommandLimits<1>::upper, not_a_number, "upper nan"},
                     {&CommandLimits<1>::velocity, 2.5, "velocity 2.5"},
                     {&CommandLimits<1>::velocity, -1, "velocity -1"},
                     {&CommandLimits<1>::acceleration, 0, "acceleration 0"},
                     {&CommandLimits<1>::acceleration, not_a_number, "acceleration nan"},
                     {&CommandLimits<1>::deceleration, -5, "deceleration -5"},
                     {&CommandLimits<1>::jerk, 0, "jerk 0"},
                     {&CommandLimits<1>::effort, 3.5, "effort 3.5"},
                     {&CommandLimits<1>::effort_rate, not_a_number, "effort_rate nan"},
                     {&CommandLimits<1>::soft_lower, infinity, "soft_lower inf"},
                     {&CommandLimits<1>::soft_upper, not_a_number, "soft_upper nan"},
                     {&CommandLimits<1>::soft_rate, 0, "soft_rate 0"}};
  for (const Bad& bad : all) {
    CAPTURE(bad.name);
    CommandLimits<1> limits = command_limits(robot);
    (limits.*bad.member)[0] = bad.value;
    CHECK_THROWS_WITH(Positions(robot, limits, ForwardPosition<Slider>(robot)),
                      Catch::Matchers::Contains("'joint'") && Catch::Matchers::Contains(bad.name));
  }
  CommandLimits<1> limits = command_limits(robot);
  limits.acceleration[0] = 1;
  limits.deceleration[0] = 2;
  CHECK_THROWS_WITH(
      Positions(robot, limits, ForwardPosition<Slider>(robot)),
      Catch::Matchers::Contains("deceleration 2 is above the limit 1 of acceleration"));
  CHECK_THROWS_WITH(
      (Limited<Q2d, ForwardPosition<Q2d>>(CommandLimits<2>{.acceleration = {20, 20}})),
      Catch::Matchers::Contains("lower -inf is below the limit -") &&
          Catch::Matchers::Contains("begin with command_limits(robot)"));
  CHECK_NOTHROW(Limited<Q2d, ForwardPosition<Q2d>>());  // the description's

  // Soft limits that are all beyond the others leave no way.
  for (const double side : {1.0, -1.0}) {
    limits = command_limits(robot);
    limits.soft_lower[0] = std::min(side * 5, side * 6);
    limits.soft_upper[0] = std::max(side * 5, side * 6);
    CHECK_THROWS_WITH(Positions(robot, limits, ForwardPosition<Slider>(robot)),
                      Catch::Matchers::Contains("'joint'") &&
                          Catch::Matchers::Contains(side > 0 ? "soft_lower 5" : "soft_upper -5") &&
                          Catch::Matchers::Contains("-1 .. 1"));
    (side > 0 ? limits.soft_lower : limits.soft_upper)[0] = side * 1;
    CHECK_NOTHROW(Positions(robot, limits, ForwardPosition<Slider>(robot)));
  }
}
