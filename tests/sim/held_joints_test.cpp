// SPDX-License-Identifier: Apache-2.0
// What the other joints do while one is held at its stop, and joints that arrive there together.
#include <articula/dynamics/mass_matrix.hpp>
#include <articula/dynamics/nonlinear_effects.hpp>
#include <articula/robots/q2d.hpp>

#include <cmath>
#include <numbers>

#include "catch.hpp"

using namespace articula;

namespace {

using Vector = JointVector<2>;
constexpr double right_angle = std::numbers::pi / 2;  // where the Q2D has its stops

Q2dSim at(const Vector& position, const Vector& velocity) {
  SimulatorOptions<2> options;
  options.initial_position = position;
  options.initial_velocity = velocity;
  return Q2dSim(options);
}

JointState<2> state_of(Q2dSim& simulator) {
  JointState<2> state;
  REQUIRE(simulator.read(state) == Status::ok);
  return state;
}

}  // namespace

TEST_CASE("a joint is damped as ever while another one is held") {
  // With the elbow at its stop the arm is one body with M11 v' = u - D v.
  Q2dSim simulator = at({0, right_angle}, {0, 0});
  const double inertia = mass_matrix(Q2d(), Vector(0, right_angle))(0, 0);
  const double damping = model_of(Q2d()).joints[0].damping, effort = 2, decay = inertia / damping;
  for (int k = 0; k < 6000; ++k) REQUIRE(simulator.write({Vector(effort, 5)}) == Status::ok);
  const JointState<2> state = state_of(simulator);
  CHECK(state.position[1] == right_angle);
  // Runge-Kutta of a linear equation at rest again: rounding, of 6000 steps.
  CHECK(std::abs(state.velocity[0] - effort / damping) < 1e-12);
  // Of the way, what the first steps lost: the step is some tenth of the decay time.
  CHECK(std::abs(state.position[0] - effort / damping * (6 - decay)) < 1e-8);
}

TEST_CASE("the damping of a moving joint counts in whether another one stays at its stop") {
  // The shoulder is slowed down by its damping and takes the elbow along, M21 v1' + h2 = -stop: the
  // stop holds while M21 D v1/M11 exceeds the centrifugal effort h2, which grows with v1^2.
  const Vector position(0, right_angle);
  const JointMatrix<2> m = mass_matrix(Q2d(), position);
  const double centrifugal = nonlinear_effects(Q2d(), position, Vector(1, 0))[1];
  const double balance = m(1, 0) * model_of(Q2d()).joints[0].damping / m(0, 0) / centrifugal;
  REQUIRE(balance > 0);
  const auto elbow_after_a_step = [&](double shoulder_velocity) {
    Q2dSim simulator = at(position, {shoulder_velocity, 0});
    REQUIRE(simulator.write({}) == Status::ok);
    return state_of(simulator).position[1];
  };
  CHECK(elbow_after_a_step(0.5 * balance) == right_angle);
  CHECK(elbow_after_a_step(2 * balance) < right_angle);
}

TEST_CASE("joints that arrive at their stops in the same step both stop") {
  Q2dSim simulator = at({right_angle - 1e-3, right_angle - 5e-3}, {5, 20});
  REQUIRE(simulator.write({Vector(1, 1)}) == Status::ok);
  const JointState<2> state = state_of(simulator);
  CHECK(state.position == Vector(right_angle, right_angle));
  CHECK(state.velocity == Vector(0, 0));
}
