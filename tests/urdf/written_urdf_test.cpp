// SPDX-License-Identifier: Apache-2.0
/// @file What urdf_text writes is the same robot when load_urdf reads it.
#include <articula/dynamics/dynamics.hpp>
#include <articula/remote/sheet/urdf_text.hpp>
#include <articula/robots/gripper_arm.hpp>
#include <articula/robots/panda.hpp>
#include <articula/robots/pr2.hpp>
#include <articula/robots/pr2_arm.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/robots/two_arm_torso.hpp>
#include <articula/robots/ur10.hpp>
#include <articula/urdf/urdf.hpp>

#include "catch.hpp"
#include "numbers.hpp"
#include "robots/random_robots.hpp"

#include <string>
#include <type_traits>

using namespace articula;

namespace {

/// Some roundings of 1.1e-16 of positions [m] and directions, along at most some forty joints.
constexpr double placement_rounding = 1e-13;
/// Inertias are moved to the centre of mass and back, which cancels.
constexpr double dynamics_rounding = 1e-11;

template <class A, class B>
void check_close(const A& ours, const B& theirs, double tolerance) {
  CHECK((ours - theirs).norm() <= tolerance * (1 + ours.norm()));
}

/// @param limits  of a joint, as URDF can express them
void check_limits(const JointProperties& ours, const JointProperties& theirs) {
  const auto alike = [](double a, double b) {  // 1e9 stands for none; mimics may widen by rounding
    if (!std::isfinite(a)) return a == b || std::abs(b) >= 1e9 * (1 - 1e-6);
    return std::abs(a - b) <= 1e-11 * (1 + std::abs(a));
  };
  CHECK(alike(ours.limits.lower, theirs.limits.lower));
  CHECK(alike(ours.limits.upper, theirs.limits.upper));
  CHECK(alike(ours.limits.velocity, theirs.limits.velocity));
  CHECK(alike(ours.limits.effort, theirs.limits.effort));
  CHECK(ours.damping == theirs.damping);
  CHECK(ours.friction == theirs.friction);
}

template <class AnyModel>
void check_round_trip(const AnyModel& ours, unsigned seed, const UrdfOptions& options) {
  constexpr int n = AnyModel::joint_count;
  const std::string text = remote::urdf_text(ours);
  INFO(text);
  const auto theirs = load_urdf<n, AnyModel::body_count>(text, options);
  CHECK(theirs.name == ours.name);
  for (std::size_t i = 0; i < ours.joints.size(); ++i) {
    CAPTURE(std::string(ours.joints[i].name.view()));
    REQUIRE(theirs.joints[i].name == ours.joints[i].name);
    check_limits(ours.joints[i], theirs.joints[i]);
  }
  for (std::size_t i = 0; i < ours.moving_joints.size(); ++i) {
    CHECK(theirs.moving_joints[i] == ours.moving_joints[i]);
  }
  REQUIRE(theirs.links.size() == ours.links.size());
  support::Random random(seed);
  CAPTURE(seed);
  for (int state = 0; state < 5; ++state) {
    const JointVector<n> q = random.vector<n>(3), v = random.vector<n>(2), a = random.vector<n>(5);
    for (std::size_t i = 0; i < ours.links.size(); ++i) {
      REQUIRE(theirs.links[i].name == ours.links[i].name);
      CAPTURE(std::string(ours.links[i].name.view()));
      check_close(forward_kinematics(ours, q, ours.links[i].name.view()).matrix(),
                  forward_kinematics(theirs, q, ours.links[i].name.view()).matrix(),
                  placement_rounding);
    }
    check_close(inverse_dynamics(ours, q, v, a), inverse_dynamics(theirs, q, v, a),
                dynamics_rounding);
    check_close(mass_matrix(ours, q), mass_matrix(theirs, q), dynamics_rounding);
  }
}

/// The described robot as a model: its programs are tested elsewhere, and slow to compile.
template <class R>
void check_ready_robot() {
  check_round_trip(model_of(R{}), 601,
                   {.allow_unphysical = R::description.allow_unphysical,
                    .gravity = R::description.gravity,
                    .right_angle_tolerance = R::description.right_angle_tolerance});
}

template <int N, int Bodies>
void check_random_robots(unsigned seed) {
  support::Random random(seed);
  for (int robot = 0; robot < 40; ++robot) {
    CAPTURE(seed, robot);
    const support::Blueprint blueprint =
        support::random_robot(random, Bodies, support::Shape::tree, Bodies - N);
    check_round_trip(blueprint.model<N, Bodies>(), 602, {.gravity = blueprint.gravity});
  }
}

/// A robot without masses.
struct Drawing {
  static constexpr auto description =
      RobotDescription{.name = "drawing",
                       .links = std::to_array<Link>({{.name = "base"}, {.name = "pen"}}),
                       .joints = std::to_array<Joint>({{.name = "lift",
                                                        .type = JointType::prismatic,
                                                        .parent = "base",
                                                        .child = "pen",
                                                        .origin = {0, 0, 0.2},
                                                        .axis = {0, 0, 1},
                                                        .limits = {.lower = 0, .upper = 0.1}}}),
                       .kinematic = true};
};

}  // namespace

TEST_CASE("a ready robot is the same after writing and reading") {
  check_ready_robot<Q2d>();
  check_ready_robot<Ur10>();
  check_ready_robot<Panda>();
  check_ready_robot<GripperArm>();
  check_ready_robot<TwoArmTorso>();
  check_ready_robot<Pr2>();
}

TEST_CASE("a random tree is the same after writing and reading") {
  check_random_robots<1, 1>(603);
  check_random_robots<4, 4>(604);
  check_random_robots<7, 7>(605);
}

TEST_CASE("a random tree with mimic joints is the same after writing and reading") {
  check_random_robots<1, 3>(606);
  check_random_robots<5, 8>(607);
}

TEST_CASE("limits of joints and of their mimics stay as they are") {
  support::Random random(608);
  for (int robot = 0; robot < 40; ++robot) {
    CAPTURE(robot);
    support::Blueprint blueprint = support::random_robot(random, 6, support::Shape::tree, 3);
    for (Joint& joint : blueprint.joints) {
      if (joint.type == JointType::fixed || !joint.mimic.joint.empty()) continue;
      joint.limits = {.lower = random.number(-3, -1),
                      .upper = random.number(1, 3),
                      .velocity = random.number(1, 5),
                      .effort = random.number(1, 100)};
      joint.damping = random.number(0, 1);
      joint.friction = random.number(0, 1);
    }
    check_round_trip(blueprint.model<3, 6>(), 609, {.gravity = blueprint.gravity});
  }
}

TEST_CASE("every body has a shape, and shapes have sizes above zero") {
  support::Random random(610);
  for (int robot = 0; robot < 40; ++robot) {
    const auto model = support::random_robot(random, 5).model<5>();
    const auto tree = remote::link_tree(model);
    const auto shapes = remote::link_shapes(model, tree);
    REQUIRE(shapes.size() == tree.size());
    for (std::size_t i = 0; i < tree.size(); ++i) {
      CAPTURE(robot, i);
      CHECK(shapes[i].empty() == (i > 0 && tree[i].moving_body < 0));
      for (const remote::LinkShape& shape : shapes[i]) {
        CHECK(shape.size.x > 0);
        CHECK(shape.size.y > 0);
        CHECK(shape.size.z > 0);
      }
    }
  }
}

TEST_CASE("a robot without masses is written without them") {
  const std::string text = remote::urdf_text(Drawing{});
  CHECK(text.find("inertial") == std::string::npos);
  const auto theirs = load_kinematic_urdf<1>(text);
  CHECK(theirs.joints[0].limits.upper == 0.1);
  CHECK(theirs.joints[0].type == JointType::prismatic);
}

TEST_CASE("names may have characters that XML reserves") {
  auto model = model_of(Q2d{});
  model.name = "<a & \"b\">";
  const auto theirs = load_urdf<2>(remote::urdf_text(model), {.gravity = model.mechanism.gravity});
  CHECK(theirs.name == model.name);
  model.name = "a\x01";
  CHECK_THROWS_AS(remote::urdf_text(model), std::invalid_argument);
}
