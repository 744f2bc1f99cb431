// SPDX-License-Identifier: Apache-2.0
// The Q2D's dynamics against the textbook's planar arm, upright and on bases that lean.
#include "catch.hpp"
#include "eigen.hpp"
#include "random.hpp"
#include "robots/test_robots.hpp"
#include "robots/two_link_arm.hpp"
#include "slope.hpp"

#include <articula/dynamics/dynamics.hpp>
#include <articula/robots/q2d.hpp>

#include <numbers>

using namespace articula;
using support::distance;
using support::TwoLinkArm;
using Vector = JointVector<2>;

namespace {

/// Some fifty roundings of 1.1e-16 of numbers of the size of the result or of 1.
constexpr double rounding = 1e-14;

bool close(const Eigen::MatrixXd& ours, const Eigen::MatrixXd& closed_form) {
  return distance(ours, closed_form) <= rounding * (1 + closed_form.norm());
}

/// All that there is to compare, at one state.
template <Robot R>
void check_dynamics(const R& robot, const TwoLinkArm& arm, const Vector& q, const Vector& v,
                    const Vector& input) {
  CAPTURE(q.transpose(), v.transpose(), input.transpose());
  CHECK(close(mass_matrix(robot, q), arm.mass_matrix(q)));
  CHECK(close(gravity(robot, q), arm.gravity(q)));
  CHECK(close(nonlinear_effects(robot, q, v), arm.bias(q, v) + arm.gravity(q)));
  CHECK(close(inverse_dynamics(robot, q, v, input), arm.inverse_dynamics(q, v, input)));
  // The mass matrix' condition number is below 100.
  CHECK(distance(forward_dynamics(robot, q, v, input), arm.forward_dynamics(q, v, input)) <=
        1e-12 * (1 + arm.forward_dynamics(q, v, input).norm()));
  CHECK(kinetic_energy(robot, q, v) == Approx(arm.kinetic_energy(q, v)).epsilon(1e-13));
}

template <Robot R>
void check_states(const R& robot, const TwoLinkArm& arm, support::Random& random, int count) {
  const Vector zero = Vector::Zero();
  check_dynamics(robot, arm, zero, zero, zero);
  for (double tiny : {1e-300, 1e-12}) {
    check_dynamics(robot, arm, Vector(tiny, -tiny), Vector(-tiny, tiny), Vector(tiny, tiny));
  }
  for (double right_angle : {-std::numbers::pi / 2, std::numbers::pi / 2, std::numbers::pi}) {
    check_dynamics(robot, arm, Vector(right_angle, right_angle), Vector(1, -1), Vector(2, 3));
  }
  for (int k = 0; k < count; ++k) {
    check_dynamics(robot, arm, random.vector<2>(4), random.vector<2>(20), random.vector<2>(100));
  }
  // Far outside of the joints' limits. (Not too far: the closed form adds up the two angles.)
  check_dynamics(robot, arm, random.vector<2>(20), random.vector<2>(1e4), random.vector<2>(1e9));
}

}  // namespace

TEST_CASE("the Q2D is the textbook's planar arm") {
  const unsigned seed = 301;
  CAPTURE(seed);
  support::Random random(seed);
  check_states(Q2d{}, TwoLinkArm{}, random, 1000);
}

TEST_CASE("gravity has no effect on the upright Q2D, to the last bit") {
  const unsigned seed = 302;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 1000; ++k) {
    CHECK(gravity(Q2d{}, random.vector<2>(4)) == Vector::Zero());
  }
}

TEST_CASE("a tilted Q2D is the planar arm with gravity, known at compile time or at run time") {
  const unsigned seed = 303;
  CAPTURE(seed);
  support::Random random(seed);
  const Vector3<double> fall = support::TiltedQ2d::description.gravity;
  TwoLinkArm arm{.gravity_vector = {fall.x, fall.y}};
  check_states(support::TiltedQ2d{}, arm, random, 300);

  support::Blueprint robot = support::blueprint_of(Q2d::description);
  for (int k = 0; k < 30; ++k) {
    robot.gravity = random.vector3(9.8);
    arm.gravity_vector = {robot.gravity.x, robot.gravity.y};
    check_states(robot.model<2>(), arm, random, 20);
  }
}

TEST_CASE("gravity of a tilted Q2D is the slope of its potential energy") {
  const unsigned seed = 304;
  CAPTURE(seed);
  support::Random random(seed);
  const support::TiltedQ2d robot;
  const TwoLinkArm arm{.gravity_vector = {robot.description.gravity.x, 0}};
  const double offset = potential_energy(robot, Vector::Zero()) - arm.potential_energy({0, 0});
  for (int k = 0; k < 300; ++k) {
    const Vector q = random.vector<2>(4);
    CAPTURE(q.transpose());
    // The same height over the pose at q = 0; energies up to 15 J.
    CHECK(std::abs(potential_energy(robot, q) - arm.potential_energy(q) - offset) < 1e-13);
    for (int j = 0; j < 2; ++j) {
      const double by_differences = support::slope(
          [&](double t) { return potential_energy(robot, q + t * Vector::Unit(j)); });
      CHECK(std::abs(gravity(robot, q)[j] - by_differences) < 1e-10);  // 100 times slope's error
    }
  }
}

TEST_CASE("the Q2D's tool moves on the textbook's circles") {
  const unsigned seed = 305;
  CAPTURE(seed);
  support::Random random(seed);
  constexpr LinkIndex tool = link_index(Q2d{}, "tool_link");
  for (int k = 0; k < 300; ++k) {
    const Vector q = random.vector<2>(4);
    const Eigen::Isometry3d pose = forward_kinematics(Q2d{}, q, tool);
    const double both = q[0] + q[1];
    const Eigen::Vector3d expected(0.343 * std::cos(q[0]) + 0.267 * std::cos(both),
                                   0.343 * std::sin(q[0]) + 0.267 * std::sin(both), 0.1477);
    CHECK(distance(pose.translation(), expected) < 1e-15);
    CHECK(distance(pose.linear(), support::rotation_of_rpy({0, 0, both})) < 2e-15);
    CHECK(forward_kinematics(Q2d{}, q, "tool_link").isApprox(pose, 0));
  }
}
