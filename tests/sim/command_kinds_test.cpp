// SPDX-License-Identifier: Apache-2.0
// The simulator's ideal drives, and its drives with springs and dampers.
#include <articula/dynamics/friction_effort.hpp>
#include <articula/dynamics/gravity.hpp>
#include <articula/sim/simulator.hpp>

#include "catch.hpp"
#include "numbers.hpp"
#include "robots/energy.hpp"
#include "robots/test_robots.hpp"

#include <cmath>

using namespace articula;
using support::infinity;

namespace {

using One = JointVector<1>;
using Vector = JointVector<2>;
using SliderSim = Simulator<Model<1>>;

/// A slider of 2 kg with ideal drives, read every 0.25 s.
SliderSim ideal_slider(const JointLimits& limits = {}) {
  Model<1> slider = support::slider();
  slider.joints[0].limits = limits;
  return SliderSim(slider, {.period = 0.25, .drives = DriveModel::ideal});
}

}  // namespace

TEST_CASE("ideal drives are at the command at the end of the period") {
  SliderSim simulator = ideal_slider();
  REQUIRE(simulator.write(PositionCommand<1>{One(0.5)}) == Status::ok);
  CHECK(simulator.true_state().position[0] == 0.5);
  CHECK(simulator.true_state().velocity[0] == 2);
  CHECK(simulator.true_state().effort[0] == 16);  // 2 kg, from 0 to 2 m/s in 0.25 s
  CHECK(simulator.time() == 0.25);
  REQUIRE(simulator.write(PositionCommand<1>{One(0.5)}) == Status::ok);
  CHECK(simulator.true_state().velocity[0] == 0);
  CHECK(simulator.true_state().effort[0] == -16);
  REQUIRE(simulator.write(VelocityCommand<1>{One(-1.0)}) == Status::ok);
  CHECK(simulator.true_state().position[0] == 0.25);
  CHECK(simulator.true_state().velocity[0] == -1);
}

TEST_CASE("ideal drives keep the limits of position and velocity") {
  SliderSim simulator = ideal_slider({.lower = -1, .upper = 0.75, .velocity = 2, .effort = 1});
  REQUIRE(simulator.write(PositionCommand<1>{One(support::largest)}) == Status::ok);
  CHECK(simulator.true_state().position[0] == 0.5);
  REQUIRE(simulator.write(PositionCommand<1>{One(support::largest)}) == Status::ok);
  CHECK(simulator.true_state().position[0] == 0.75);
  CHECK(simulator.true_state().velocity[0] == 1);
  for (int k = 0; k < 5; ++k) {
    REQUIRE(simulator.write(VelocityCommand<1>{One(-support::largest)}) == Status::ok);
    CHECK(simulator.true_state().velocity[0] >= -2);
  }
  CHECK(simulator.true_state().position[0] == -1);
  CHECK(simulator.true_state().velocity[0] == 0);
}

TEST_CASE("ideal drives report the effort that the motion takes") {
  SimulatorOptions<2> options;
  options.drives = DriveModel::ideal;
  Simulator<support::TiltedQ2d> simulator(options);
  for (int k = 1; k <= 10; ++k) {
    REQUIRE(simulator.write(PositionCommand<2>{Vector(0.001, -0.002) * k}) == Status::ok);
  }
  const JointState<2>& state = simulator.true_state();
  CHECK((state.velocity - Vector(1, -2)).norm() < 1e-9);
  const Vector expected = nonlinear_effects(support::TiltedQ2d(), state.position, state.velocity) -
                          friction_effort(support::TiltedQ2d(), state.velocity);
  CHECK((state.effort - expected).norm() < 1e-9);  // velocities are even but for rounding/period
}

TEST_CASE("ideal drives take efforts as any, and refuse what is no number") {
  SliderSim simulator = ideal_slider();
  REQUIRE(simulator.write({One(8.0)}) == Status::ok);
  CHECK(simulator.true_state().velocity[0] == 1);
  CHECK(simulator.write(PositionCommand<1>{One(infinity)}) == Status::non_finite_command);
  CHECK(simulator.true_state().velocity[0] == 1);
  CHECK(simulator.true_state().effort[0] == 0);
}

TEST_CASE("a drive with a spring makes an oscillator of its joint") {
  // 2 kg and 50 N/m: 5 rad/s, whatever the period. In steps of h the method lags by (5 h)^4/120 of
  // the angle: 3e-7 rad after a second in steps of 10 ms.
  for (const double period : {1e-3, 0.01}) {
    SimulatorOptions<1> options{.period = period};
    options.initial_position = One(1.5);
    SliderSim simulator(support::slider(), options);
    MultiModeCommand<1> spring;
    spring.position[0] = 1;
    spring.stiffness[0] = 50;
    while (simulator.time() < 1) {
      REQUIRE(simulator.write(spring) == Status::ok);
      const double q = 1 + 0.5 * std::cos(5 * simulator.time());
      CHECK(std::abs(simulator.true_state().position[0] - q) < 2e-7);
      CHECK(simulator.true_state().effort[0] == 50 * (1 - simulator.true_state().position[0]));
    }
  }
}

TEST_CASE("springs and dampers are within the effort limits and refuse what is no number") {
  Model<1> slider = support::slider();
  slider.joints[0].limits.effort = 3;
  SliderSim simulator(slider, {.period = 0.25});
  MultiModeCommand<1> command;
  command.velocity[0] = 1;
  command.damping[0] = 1e3;
  REQUIRE(simulator.write(command) == Status::ok);
  CHECK(simulator.true_state().velocity[0] == 3 / 2.0 * 0.25);
  CHECK(simulator.true_state().effort[0] == 3);
  command.stiffness[0] = support::largest;
  command.damping[0] = support::largest;
  command.position[0] = -support::largest;
  command.velocity[0] = support::largest;
  REQUIRE(simulator.write(command) == Status::ok);  // infinity less infinity
  CHECK(simulator.true_state().effort[0] == 0);
  CHECK(is_finite(simulator.true_state()));
  for (auto member : {&MultiModeCommand<1>::position, &MultiModeCommand<1>::velocity,
                      &MultiModeCommand<1>::stiffness, &MultiModeCommand<1>::damping,
                      &MultiModeCommand<1>::effort}) {
    MultiModeCommand<1> bad;
    (bad.*member)[0] = support::not_a_number;
    CHECK(simulator.write(bad) == Status::non_finite_command);
    CHECK(simulator.true_state().effort[0] == 0);
  }
}

TEST_CASE("without stiffness and damping the effort of a spring is an effort command") {
  Q2dSim spring, effort;
  for (int k = 0; k < 100; ++k) {
    const Vector push(std::sin(0.1 * k), 40 * std::cos(0.2 * k));
    MultiModeCommand<2> command;
    command.effort = push;
    REQUIRE(spring.write(command) == Status::ok);
    REQUIRE(effort.write({push}) == Status::ok);
  }
  CHECK((spring.true_state().position - effort.true_state().position).norm() < 1e-14);
  CHECK(spring.true_state().effort == effort.true_state().effort);
}
