// SPDX-License-Identifier: Apache-2.0
#include "catch.hpp"
#include "eigen.hpp"
#include "numbers.hpp"
#include "robots/random_robots.hpp"
#include "robots/textbook_robot.hpp"

#include <articula/dynamics/forward_kinematics.hpp>
#include <articula/model/robot.hpp>

#include <algorithm>
#include <array>
#include <string>

using namespace articula;
using support::Blueprint;
using support::distance;
using support::infinity;
using support::to_eigen;

namespace {

constexpr Link ball(const Name& name) {
  return {.name = name, .mass = 1, .inertia = {.xx = 1, .yy = 1, .zz = 1}};
}

constexpr Joint turning(const Name& name, const Name& parent, const Name& child) {
  return {.name = name, .type = JointType::revolute, .parent = parent, .child = child};
}

template <std::size_t N>
using Names = std::array<std::string_view, N>;

/// A chain whose description a function fills member by member.
struct Chain {
  static constexpr auto description = [] {
    RobotDescription<3, 2> chain;
    chain.name = "chain";
    chain.links = {ball("root"), ball("upper"), ball("lower")};
    for (std::size_t i = 0; i < chain.joints.size(); ++i) {
      Joint& joint = chain.joints[i];
      joint = turning(i == 0 ? "a" : "b", chain.links[i].name, chain.links[i + 1].name);
      joint.origin = {0.3, 0, 0};
      joint.orientation = {0.1, 0, 0.2};
    }
    return chain;
  }();
};

}  // namespace

TEST_CASE("joints stand in the order of a depth-first walk, siblings by name") {
  // trunk -b-> arm -z-> hand, and trunk -a-> leg -y-> foot; by breadth or by lists it would differ.
  Blueprint robot{
      .links = {ball("hand"), ball("foot"), ball("trunk"), ball("leg"), ball("arm"), ball("tail")},
      .joints = {turning("z", "arm", "hand"), turning("b", "trunk", "arm"),
                 turning("y", "leg", "foot"), turning("a", "trunk", "leg"),
                 turning("b10", "trunk", "tail")}};
  REQUIRE(robot.fault().rule == Rule::none);
  const Names<5> expected{"a", "y", "b", "z", "b10"};
  std::array<int, 5> order{0, 1, 2, 3, 4};
  const std::vector<Joint> joints = robot.joints;
  do {
    for (std::size_t k = 0; k < order.size(); ++k) {
      robot.joints[k] = joints[static_cast<std::size_t>(order[k])];
    }
    const Model<5> model = robot.model<5>();
    CHECK(joint_names(model) == expected);
    std::array<int, 5> parents{};
    for (std::size_t k = 0; k < 5; ++k) parents[k] = model.mechanism.bodies[k].parent;
    CHECK(parents == std::array{-1, 0, -1, 2, -1});
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("a description may be filled by a function") {
  static_assert(joint_count<Chain> == 2);
  const Blueprint same{.links = {ball("root"), ball("upper"), ball("lower")},
                       .joints = {Chain::description.joints[0], Chain::description.joints[1]}};
  const JointVector<2> q(0.4, -0.7);
  const Eigen::Matrix4d placed = forward_kinematics(Chain{}, q, "lower").matrix();
  const Eigen::Matrix4d expected = forward_kinematics(same.model<2>(), q, "lower").matrix();
  CHECK((placed - expected).norm() < 4e-15);  // rounding: all numbers are about 1
}

TEST_CASE("fixed joints between siblings take part in the order") {
  // root =m=> weld, which carries joint c; root -k-> x; root -z-> y.
  Joint weld = turning("m", "root", "weld");
  weld.type = JointType::fixed;
  const Blueprint robot{.links = {ball("root"), ball("weld"), ball("x"), ball("y"), ball("w")},
                        .joints = {turning("c", "weld", "w"), weld, turning("z", "root", "y"),
                                   turning("k", "root", "x")}};
  REQUIRE(robot.fault().rule == Rule::none);
  const auto model = robot.model<3>();
  CHECK(joint_names(model) == Names<3>{"k", "c", "z"});
}

TEST_CASE("the order of the lists makes no difference") {
  const unsigned seed = 231;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 50; ++k) {
    Blueprint robot = support::random_robot(random, 5);
    const Model<5> before = robot.model<5>();
    std::shuffle(robot.links.begin(), robot.links.end(), random.engine());
    std::shuffle(robot.joints.begin(), robot.joints.end(), random.engine());
    const Model<5> after = robot.model<5>();
    CHECK(joint_names(before) == joint_names(after));
    for (std::size_t i = 0; i < 5; ++i) {
      const Body &a = before.mechanism.bodies[i], &b = after.mechanism.bodies[i];
      CHECK(a.parent == b.parent);
      CHECK(a.prismatic == b.prismatic);
      CHECK(a.placement.rotation == b.placement.rotation);
      CHECK(a.placement.translation == b.placement.translation);
      CHECK(a.inertia.mass == b.inertia.mass);
      CHECK(a.inertia.first_moment == b.inertia.first_moment);
      CHECK(a.inertia.moment == b.inertia.moment);
    }
  }
}

TEST_CASE("a body's parent stands before it, and all links are listed, where they belong") {
  const unsigned seed = 232;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 100; ++k) {
    const Blueprint robot = support::random_robot(random, 6);
    const Model<6> model = robot.model<6>();
    for (int i = 0; i < 6; ++i) {
      CHECK(model.mechanism.bodies[static_cast<std::size_t>(i)].parent < i);
    }
    REQUIRE(model.links.size() == robot.links.size());
    for (const Link& link : robot.links) {
      CHECK(model.links[link_index(model, link.name).value].name == link.name);
    }
  }
}

TEST_CASE("welded links add up to one body") {
  const unsigned seed = 233;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 200; ++k) {
    // root -joint-> link =weld 1=> link =weld 2=> link, the second a mere frame every other time.
    Blueprint robot{
        .links = {support::random_link(random, "root"), support::random_link(random, "first"),
                  support::random_link(random, "second"), support::random_link(random, "third")}};
    if (k % 2 == 0) robot.links[2] = {.name = "second"};
    for (std::size_t i = 0; i < 3; ++i) {
      robot.joints.push_back(
          support::random_joint(random, i == 0 ? JointType::revolute : JointType::fixed));
      robot.joints[i].name = Name("joint_" + std::to_string(i));
      robot.joints[i].parent = robot.links[i].name;
      robot.joints[i].child = robot.links[i + 1].name;
    }
    const Model<1> model = robot.model<1>();
    const Body& body = model.mechanism.bodies[0];
    const support::TextbookRobot textbook(robot, joint_names(model));
    const Eigen::Isometry3d root_to_body = to_eigen(body.placement);
    double mass = 0;
    Eigen::Vector3d first_moment = Eigen::Vector3d::Zero();
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
    for (std::size_t i = 1; i < 4; ++i) {
      const Link& link = robot.links[i];
      const Eigen::Isometry3d in_body =
          root_to_body.inverse() * textbook.placement(link.name, Eigen::VectorXd::Zero(1));
      const Eigen::Matrix3d r =
          in_body.linear() * support::rotation_of_rpy(link.inertia_orientation);
      const Eigen::Vector3d c = in_body * to_eigen(link.center_of_mass);
      mass += link.mass;
      first_moment += link.mass * c;
      moment += r * to_eigen(link.inertia) * r.transpose() +
                link.mass * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
    }
    // Masses up to 12 kg at up to 2 m: some twenty roundings of moments up to 50 kg m^2.
    CHECK(std::abs(body.inertia.mass - mass) < 1e-14);
    CHECK(distance(to_eigen(body.inertia.first_moment), first_moment) < 1e-13);
    CHECK(distance(to_eigen(body.inertia.moment), moment) < 5e-13);
  }
}

TEST_CASE("what is welded to the root does not move and has no part in the dynamics") {
  const Blueprint robot{
      .links = {ball("root"), ball("base"), ball("arm")},
      .joints = {{.name = "weld", .parent = "root", .child = "base", .origin = {1, 2, 3}},
                 turning("hinge", "base", "arm")}};
  const Model<1> model = robot.model<1>();
  const LinkFrame& base = model.links[link_index(model, "base").value];
  CHECK(base.body == -1);
  CHECK(base.placement.translation == Vector3<double>{1, 2, 3});
  CHECK(model.mechanism.bodies[0].inertia.mass == 1);
  CHECK(model.mechanism.bodies[0].placement.translation == Vector3<double>{1, 2, 3});
}

TEST_CASE("the canonical frame: z along the joint's axis, whatever its length and direction") {
  const unsigned seed = 234;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 200; ++k) {
    for (JointType type : {JointType::revolute, JointType::continuous, JointType::prismatic}) {
      Blueprint robot{.links = {ball("root"), support::random_link(random, "link")},
                      .joints = {support::random_joint(random, type)}};
      Joint& joint = robot.joints[0];
      joint.name = "joint";
      joint.parent = "root";
      joint.child = "link";
      const Body body = robot.model<1>().mechanism.bodies[0];
      const Eigen::Vector3d axis =
          support::rotation_of_rpy(joint.orientation) * to_eigen(joint.axis).normalized();
      CHECK(body.prismatic == (type == JointType::prismatic));
      CHECK(distance(to_eigen(body.placement.rotation.column(2)), axis) < 2e-15);
      CHECK(body.placement.translation == joint.origin);
    }
  }
}

TEST_CASE("joints keep their limits, damping and friction; continuous ones have no end") {
  const JointLimits limits{.lower = -1, .upper = 2, .velocity = 3, .effort = 4};
  Blueprint robot{.links = {ball("root"), ball("link")}, .joints = {turning("j", "root", "link")}};
  Joint& joint = robot.joints[0];
  joint.limits = limits;
  joint.damping = 5;
  joint.friction = 6;
  for (JointType type : {JointType::revolute, JointType::continuous, JointType::prismatic}) {
    joint.type = type;
    const JointProperties properties = robot.model<1>().joints[0];
    const bool endless = type == JointType::continuous;
    CHECK(properties.name == Name("j"));
    CHECK(properties.type == type);
    CHECK(properties.limits.lower == (endless ? -infinity : -1));
    CHECK(properties.limits.upper == (endless ? infinity : 2));
    CHECK(properties.limits.velocity == 3);
    CHECK(properties.limits.effort == 4);
    CHECK(properties.damping == 5);
    CHECK(properties.friction == 6);
  }
}

TEST_CASE("a joint answers for those that mimic it") {
  // Two fingers: the second opens the other way, twice as fast, from -0.5 on.
  Blueprint robot{
      .links = {ball("palm"), ball("left"), ball("right")},
      .joints = {turning("left_joint", "palm", "left"), turning("right_joint", "palm", "right")}};
  Joint &left = robot.joints[0], &right = robot.joints[1];
  left.limits = {.lower = -1, .upper = 1, .velocity = 3, .effort = 7};
  left.damping = 0.1;
  left.friction = 0.2;
  right.limits = {.lower = -2, .upper = 1, .velocity = 4};
  right.damping = 0.01;
  right.friction = 0.02;
  right.mimic = {.joint = "left_joint", .multiplier = -2, .offset = -0.5};
  REQUIRE(robot.fault().rule == Rule::none);
  CHECK(model_size(robot.joints).joints == 1);
  CHECK(model_size(robot.joints).bodies == 2);
  const Model<1, 2> model = robot.model<1, 2>();
  const JointProperties& joint = model.joints[0];
  CHECK(joint_names(model) == Names<1>{"left_joint"});
  CHECK(joint.limits.lower == Approx(-0.75));  // where -2 q - 0.5 is 1
  CHECK(joint.limits.upper == Approx(0.75));   // where -2 q - 0.5 is -2
  CHECK(joint.limits.velocity == Approx(2));
  CHECK(joint.limits.effort == 7);
  CHECK(joint.damping == Approx(0.1 + 4 * 0.01));
  CHECK(joint.friction == Approx(0.2 + 2 * 0.02));
}

TEST_CASE("a joint that mimics with multiplier 0 stands still and limits nothing") {
  Blueprint robot{
      .links = {ball("palm"), ball("left"), ball("right")},
      .joints = {turning("left_joint", "palm", "left"), turning("right_joint", "palm", "right")}};
  robot.joints[0].limits = {.lower = -1, .upper = 1, .velocity = 3, .effort = 7};
  robot.joints[1].limits = {.lower = -2, .upper = 1, .velocity = 0};
  robot.joints[1].mimic = {.joint = "left_joint", .multiplier = 0, .offset = 0.5};
  REQUIRE(robot.fault().rule == Rule::none);
  const JointLimits limits = robot.model<1, 2>().joints[0].limits;
  CHECK(limits.lower == -1);
  CHECK(limits.upper == 1);
  CHECK(limits.velocity == 3);
}

TEST_CASE("joints and links are found by name, and what is missing is named") {
  Blueprint robot{
      .name = "arm",
      .links = {ball("root"), ball("link"), ball("tip")},
      .joints = {turning("j", "root", "link"), {.name = "weld", .parent = "link", .child = "tip"}}};
  robot.joints[0].limits.effort = 4;
  const Model<1> model = robot.model<1>();
  CHECK(joint_index(model, "j") == 0);
  CHECK(effort_limits(model)[0] == 4);
  CHECK(joint_values(model, [](const JointProperties& p) { return p.limits.effort + 1; })[0] == 5);
  CHECK_THROWS_AS(joint_index(model, "weld"), std::invalid_argument);
  CHECK_THROWS_WITH(joint_index(model, "weld"), "robot 'arm': joint 'weld' is fixed; joints: j");
  CHECK_THROWS_WITH(joint_index(model, "k"), "robot 'arm' has no joint 'k'; joints: j");
  CHECK_THROWS_WITH(joint_index(model, ""), "robot 'arm' has no joint ''; joints: j");
  CHECK_THROWS_AS(link_index(model, ""), std::invalid_argument);
  CHECK_THROWS_WITH(link_index(model, "j"), "robot 'arm' has no link 'j'; links: root, link, tip");
}

TEST_CASE("who asks for a mimic joint is told which one it follows") {
  Blueprint robot{
      .name = "hand",
      .links = {ball("palm"), ball("left"), ball("right")},
      .joints = {turning("a_right", "palm", "right"), turning("left_joint", "palm", "left")}};
  robot.joints[0].mimic = {.joint = "left_joint"};
  const Model<1, 2> model = robot.model<1, 2>();
  CHECK_THROWS_WITH(joint_index(model, "a_right"),
                    "robot 'hand': joint 'a_right' mimics 'left_joint': name that joint");
}
