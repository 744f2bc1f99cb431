// SPDX-License-Identifier: Apache-2.0
#include <articula/dynamics/mass_matrix.hpp>
#include <articula/dynamics/nonlinear_effects.hpp>
#include <articula/sim/simulator.hpp>

#include <Eigen/LU>

#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "robots/energy.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using support::unearned_energy;
using support::within_limits;

namespace {

using ArmSim = Simulator<Model<2>>;
using JointSim = Simulator<Model<1>>;
using Vector = JointVector<2>;
using One = JointVector<1>;

constexpr double right_angle = std::numbers::pi / 2;

/// The Q2D's links and stops without damping: all energy that goes, goes at the stops.
Model<2> undamped_arm() {
  Model<2> arm = support::free_arm<support::TiltedQ2d>();
  for (auto& joint : arm.joints) {
    joint.limits.lower = -right_angle;
    joint.limits.upper = right_angle;
  }
  return arm;
}

ArmSim arm_at(const Vector& position, const Vector& velocity, double period = 1e-3,
              const Model<2>& arm = undamped_arm()) {
  SimulatorOptions<2> options{.period = period};
  options.initial_position = position;
  options.initial_velocity = velocity;
  return ArmSim(arm, options);
}

/// A mass of 2 kg that falls onto a floor 1 m below: gravity along the rail, stops at -1 and 0.5.
JointSim lift(double velocity = 0) {
  Model<1> robot = support::single_joint(JointType::prismatic, {0, 0, 1});
  robot.joints[0].limits.lower = -1;
  robot.joints[0].limits.upper = 0.5;
  SimulatorOptions<1> options;
  options.initial_velocity.setConstant(velocity);
  return JointSim(robot, options);
}

// What Runge-Kutta gains or loses in a millisecond at tens of rad/s, measured: below 1e-6 J, of
// some 10 J. A stop that gave energy back would give whole joules.
constexpr double integration_error = 1e-5;

}  // namespace

TEST_CASE("a joint pushed against its stop stays on it and gains nothing") {
  for (const double side : {1.0, -1.0}) {
    CAPTURE(side);
    ArmSim arm = arm_at({0, 0}, {0, 0});
    for (int k = 0; k < 2000; ++k) {
      CAPTURE(k);
      REQUIRE(unearned_energy(arm, side * Vector(8, 3)) < integration_error);
      REQUIRE(within_limits(arm));
    }
    CHECK(arm.true_state().position == side * Vector(right_angle, right_angle));
    CHECK(arm.true_state().velocity == Vector(0, 0));
  }
}

TEST_CASE("a joint leaves its stop at once when it is pulled back") {
  ArmSim arm = arm_at({right_angle, -right_angle}, {0, 0});
  static_cast<void>(arm.write({Vector(30, -30)}));
  CHECK(arm.true_state().position == Vector(right_angle, -right_angle));

  const Vector pull(-6, 5);
  const Vector start = arm.true_state().position;
  const Vector acceleration = mass_matrix(arm.robot(), start).inverse() *
                              (pull - nonlinear_effects(arm.robot(), start, Vector::Zero()));
  static_cast<void>(arm.write({pull}));
  const Vector expected = acceleration * 1e-3 * 1e-3 / 2;
  const Vector moved = arm.true_state().position - start;
  CHECK(moved[0] < 0);
  CHECK(moved[1] > 0);
  CHECK((moved - expected).norm() < 1e-2 * expected.norm());  // the acceleration changes little
}

TEST_CASE("a falling mass stops where and when the floor says, and does not bounce") {
  JointSim mass = lift();
  const double impact = std::sqrt(2 / 9.8);  // s
  while (mass.time() < 2 * impact) {
    CAPTURE(mass.time());
    REQUIRE(unearned_energy(mass, One(0.0)) < 1e-12);
    const double t = mass.time(), x = mass.true_state().position[0];
    REQUIRE(x >= -1);
    if (t < impact) {
      CHECK(x == Approx(-9.8 * t * t / 2).epsilon(1e-11));  // a parabola, up to rounding
    } else {
      REQUIRE(x == -1);
      REQUIRE(mass.true_state().velocity[0] == 0);
    }
  }
}

TEST_CASE("a mass on the floor is lifted by more than its weight, and by nothing less") {
  JointSim mass = lift(-100);  // thrown down: on the floor after 10 ms
  for (int k = 0; k < 20; ++k) static_cast<void>(mass.write({}));
  const double weight = 2 * 9.8;
  for (int k = 0; k < 100; ++k) static_cast<void>(mass.write({One(weight - 1e-9)}));
  CHECK(mass.true_state().position[0] == -1);
  static_cast<void>(mass.write({One(weight + 2)}));  // 1 m/s^2
  CHECK(mass.true_state().position[0] + 1 == Approx(1e-6 / 2).epsilon(1e-9));
}

TEST_CASE("a mass thrown up stops at the upper stop and falls again") {
  JointSim mass = lift(20);
  while (mass.time() < 0.1) {
    REQUIRE(unearned_energy(mass, One(0.0)) < 1e-12);
    REQUIRE(within_limits(mass));
  }
  // At the stop after 0.02543 s; then it falls from rest.
  const double since = 0.1 - (20 - std::sqrt(400 - 9.8)) / 9.8;
  CHECK(mass.true_state().position[0] == Approx(0.5 - 9.8 * since * since / 2).epsilon(1e-9));
}

// Only the joint that hits is pushed, so the momentum that belongs to the other stays.
TEST_CASE("a stop takes the speed of the joint that hits it, through its own axis alone") {
  for (const int hit : {0, 1}) {
    CAPTURE(hit);
    Vector position(0.3, -0.4);
    position[hit] = right_angle;
    const Vector before = hit == 0 ? Vector(9, -4) : Vector(3, 20);
    const double moment = 1e-12;  // s: nothing but the impact happens
    ArmSim arm = arm_at(position, before, moment);
    const double gained = unearned_energy(arm, Vector(0, 0));
    const Vector after = arm.true_state().velocity;
    CHECK(std::abs(after[hit]) < 1e-9);
    const auto m = mass_matrix(arm.robot(), position);
    const Vector impulse = m * (after - before);
    CHECK(impulse[hit] < 0);
    CHECK(std::abs(impulse[1 - hit]) < 1e-9);
    // The loss of an inelastic impact: half the impulse times the speed that was lost.
    CHECK(gained == Approx(impulse[hit] * before[hit] / 2).epsilon(1e-6));
    CHECK(arm.true_state().position[hit] == right_angle);
  }
}

TEST_CASE("two joints that hit together both stop") {
  ArmSim arm = arm_at({right_angle, right_angle}, {7, 12}, 1e-12);
  static_cast<void>(arm.write({}));
  CHECK(arm.true_state().velocity.norm() < 1e-9);  // gravity in a picosecond
  CHECK(arm.true_state().position == Vector(right_angle, right_angle));
}

TEST_CASE("of two joints at their stops one hits, and the other is flung off or pressed on") {
  const Vector corner(right_angle, -right_angle);
  for (const Vector& velocity : {Vector(9, 0), Vector(0, -9), Vector(5, 2), Vector(-2, -5)}) {
    CAPTURE(velocity.transpose());
    ArmSim arm = arm_at(corner, velocity, 1e-12);
    CHECK(unearned_energy(arm, Vector(0, 0)) < 0);
    const Vector after = arm.true_state().velocity;
    CHECK(after[0] <= 0);  // off the upper stop
    CHECK(after[1] >= 0);  // off the lower stop
    // The stops push, and only where the joint stays.
    const Vector impulse = mass_matrix(arm.robot(), corner) * (after - velocity);
    CHECK(impulse[0] < 1e-9);
    CHECK(impulse[1] > -1e-9);
    CHECK(std::abs(impulse[0] * after[0]) < 1e-9);
    CHECK(std::abs(impulse[1] * after[1]) < 1e-9);
  }
}

TEST_CASE("fast impacts while the other joint moves never add energy") {
  for (const Vector& velocity : {Vector(30, -40), Vector(-25, 60), Vector(10, 100)}) {
    CAPTURE(velocity.transpose());
    ArmSim arm = arm_at({0.1, -0.2}, velocity, 1e-4);
    int stops = 0;
    for (int k = 0; k < 20000; ++k) {
      CAPTURE(k);
      REQUIRE(unearned_energy(arm, Vector(0, 0)) < integration_error);
      REQUIRE(within_limits(arm));
      stops += arm.true_state().position.cwiseAbs().maxCoeff() == right_angle ? 1 : 0;
    }
    CHECK(stops > 0);
  }
}

TEST_CASE("a joint whose limits are one point stays there while the other moves freely") {
  Model<2> arm = undamped_arm();
  const double angle = 0.7;
  arm.joints[1].limits.lower = arm.joints[1].limits.upper = angle;
  ArmSim locked = arm_at({0, angle}, {1, 5}, 1e-3, arm);
  double speed = 0;
  for (int k = 0; k < 100; ++k) {
    REQUIRE(unearned_energy(locked, Vector(2, 4)) < integration_error);
    REQUIRE(locked.true_state().position[1] == angle);
    REQUIRE(locked.true_state().velocity[1] == 0);
    speed = locked.true_state().velocity[0];
  }
  // As one rigid body: half of I v^2 is what the drive, the weight and the first impact left.
  ArmSim start = arm_at({0, angle}, {1, 5}, 1e-12, arm);
  static_cast<void>(start.write({}));
  const double inertia = mass_matrix(arm, Vector(0, angle))(0, 0);
  const auto& end = locked.true_state();
  const double work = 2 * end.position[0] + potential_energy(arm, Vector(0, angle)) -
                      potential_energy(arm, end.position);
  const double first = start.true_state().velocity[0];
  CHECK(inertia * speed * speed / 2 == Approx(inertia * first * first / 2 + work).epsilon(1e-9));
}

TEST_CASE("stops hold a drive of the Q2D at full effort, damped as it is") {
  Q2dSim q2d;
  for (int k = 0; k < 8000; ++k) {
    const double side = k < 4000 ? 1 : -1;
    CAPTURE(k);
    REQUIRE(unearned_energy(q2d, side * Vector(1e9, 1e9)) < 1e-9);
    REQUIRE(within_limits(q2d));
  }
  CHECK(q2d.true_state().position == Vector(-right_angle, -right_angle));
}
