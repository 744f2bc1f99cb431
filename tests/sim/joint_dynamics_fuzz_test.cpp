// SPDX-License-Identifier: Apache-2.0
// Random robots with stops, damping and dry friction, thrown about: whatever happens, limits hold
// to the last bit, numbers stay finite and energy comes from the drives alone.
#include <articula/sim/simulator.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "robots/energy.hpp"
#include "robots/random_robots.hpp"

using namespace articula;

namespace {

/// A random robot with random properties of its joints: each has one in so many cases none, a very
/// small or a common value.
template <int N>
Model<N> random_model(support::Random& random) {
  Model<N> robot = support::random_robot(random, N).model<N>();
  for (auto& joint : robot.joints) {
    joint.damping = random.one_in(2) ? 0 : std::pow(10, random.number(-6, 1));
    joint.friction = random.one_in(2) ? 0 : std::pow(10, random.number(-3, 1.5));
    joint.limits.effort = random.number(0, 100);
    if (random.one_in(4)) continue;
    joint.limits.lower = random.number(-1, 0);
    joint.limits.upper = random.one_in(6) ? joint.limits.lower : random.number(0, 1);
  }
  return robot;
}

template <int N>
SimulatorOptions<N> random_start(support::Random& random, const Model<N>& robot, double speed) {
  SimulatorOptions<N> options{.period = 1e-3, .substeps = 2};
  options.initial_velocity = random.vector<N>(speed);
  JointVector<N> position;
  for (int j = 0; j < N; ++j) {
    const auto& limits = robot.joints[static_cast<std::size_t>(j)].limits;
    position[j] = random.one_in(5)
                      ? random.one_in(2) ? limits.lower : limits.upper
                      : random.number(std::max(limits.lower, -1.0), std::min(limits.upper, 1.0));
    if (!is_finite(position[j])) position[j] = 0;
  }
  options.initial_position = position;
  return options;
}

template <int N>
void throw_about(unsigned seed, int robots) {
  support::Random random(seed);
  for (int r = 0; r < robots; ++r) {
    const Model<N> robot = random_model<N>(random);
    const auto options = random_start<N>(random, robot, 5);
    CAPTURE(N, seed, r);
    const JointVector<N> friction =
        joint_values(robot, [](const JointProperties& j) { return j.friction; });
    // Nearly massless parts move too fast for any fixed step; they are not what is tested here.
    try {
      validate(robot, options);
    } catch (const std::invalid_argument&) {
      continue;
    }
    Simulator<Model<N>> simulator(robot, options), again(robot, options);
    EffortCommand<N> command;
    for (int k = 0; k < 400; ++k) {
      CAPTURE(k);
      if (k % 50 == 0) command.effort = random.vector<N>(50);
      const JointVector<N> start = simulator.true_state().position;
      const double before = support::energy(simulator);
      const double unearned = support::unearned_energy(simulator, command.effort);
      static_cast<void>(again.write(command));
      const auto& state = simulator.true_state();
      REQUIRE(is_finite(state));
      REQUIRE(support::within_limits(simulator));
      REQUIRE(again.true_state().position == state.position);
      REQUIRE(again.true_state().velocity == state.velocity);
      // The Runge-Kutta error of a step, in parts of the energy that is there: it grows with the
      // fifth power of speed times step. A defect of stops or friction gives parts of the whole.
      const double scale =
          1 + std::abs(before) + kinetic_energy(robot, state.position, state.velocity);
      const double turn = state.velocity.cwiseAbs().maxCoeff() * options.period;
      REQUIRE(unearned <= (1e-9 + std::pow(turn, 4)) * scale);
      // What friction takes on a straight path it must have taken.
      const double taken = friction.dot((state.position - start).cwiseAbs());
      REQUIRE(unearned + taken <= (1e-5 + std::pow(turn, 2)) * scale);
    }
  }
}

}  // namespace

TEST_CASE("random robots keep their limits and their energy balance") {
  throw_about<1>(31, 150);
  throw_about<2>(32, 150);
  throw_about<3>(33, 100);
  throw_about<5>(35, 60);
}

// The check of damping against the step, held against the eigenvalues that it estimates.
TEST_CASE("steps that the fastest decay makes unstable are refused") {
  constexpr unsigned seed = 40;
  support::Random random(seed);
  for (int r = 0; r < 500; ++r) {
    CAPTURE(seed, r);
    Model<4> robot = support::random_robot(random, 4).model<4>();
    JointVector<4> damping;
    for (int j = 0; j < 4; ++j) {
      auto& joint = robot.joints[static_cast<std::size_t>(j)];
      joint.damping = damping[j] = std::pow(10, random.number(-2, 2));
      joint.limits = {};
    }
    const auto m = mass_matrix(robot, JointVector<4>::Zero());
    // D x = rate M x with both symmetric.
    const JointMatrix<4> d = damping.asDiagonal();
    const double rate =
        Eigen::GeneralizedSelfAdjointEigenSolver<JointMatrix<4>>(d, m).eigenvalues().maxCoeff();
    SimulatorOptions<4> options{.period = 2.785 / rate};
    CHECK_THROWS_AS(validate(robot, options), std::invalid_argument);
    options.period = 2.785 / rate / 2.01;  // and half of that is enough
    CHECK_NOTHROW(validate(robot, options));
  }
}
