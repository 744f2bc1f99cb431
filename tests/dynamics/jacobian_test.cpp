// SPDX-License-Identifier: Apache-2.0
#include <articula/dynamics/jacobian.hpp>
#include <articula/robots/q2d.hpp>

#include "catch.hpp"
#include "numbers.hpp"
#include "robots/any_robot.hpp"
#include "robots/random_robots.hpp"
#include "robots/test_robots.hpp"
#include "slope.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

using namespace articula;
using Eigen::MatrixXd, Eigen::VectorXd;

namespace {

/// What a fixed joint carries at the end of what a mimic joint carries: turning the shoulder by 1
/// turns the elbow by -2 about an axis 0.5 m off, and slides the tray by 0.1.
struct Follower {
  static constexpr RobotDescription description{
      .name = "follower",
      .gravity = {0, 0, -9.81},
      .links = std::to_array<Link>({
          {.name = "base"},
          {.name = "stand"},
          {.name = "arm", .mass = 1, .inertia = {.xx = 1, .yy = 1, .zz = 1}},
          {.name = "forearm", .mass = 1, .inertia = {.xx = 1, .yy = 1, .zz = 1}},
          {.name = "tray", .mass = 1, .inertia = {.xx = 1, .yy = 1, .zz = 1}},
          {.name = "tool"},
      }),
      .joints = std::to_array<Joint>({
          {.name = "foot", .type = JointType::fixed, .parent = "base", .child = "stand"},
          {.name = "shoulder",
           .type = JointType::continuous,
           .parent = "stand",
           .child = "arm",
           .axis = {0, 0, 1}},
          {.name = "elbow",
           .type = JointType::continuous,
           .parent = "arm",
           .child = "forearm",
           .origin = {0.5, 0, 0},
           .axis = {0, 0, 1},
           .mimic = {.joint = "shoulder", .multiplier = -2}},
          {.name = "rail",
           .type = JointType::prismatic,
           .parent = "forearm",
           .child = "tray",
           .axis = {0, 0, 1},
           .mimic = {.joint = "shoulder", .multiplier = 0.1}},
          {.name = "mount",
           .type = JointType::fixed,
           .parent = "tray",
           .child = "tool",
           .origin = {0.25, 0, 0}},
      })};
};

/// Free joints and moving bodies of the robots that are tried.
constexpr std::pair<int, int> sizes[] = {{1, 1}, {2, 2}, {4, 4}, {7, 7}, {1, 2}, {3, 5}, {5, 8}};

/// @param check  takes a robot, the name of one of its links and a state
template <class Check>
void on_random_robots(unsigned seed, const Check& check) {
  support::Random random(seed);
  for (const auto& [joints, bodies] : sizes) {
    for (int k = 0; k < 20; ++k) {
      const support::Blueprint blueprint =
          support::random_robot(random, bodies, support::Shape::tree, bodies - joints);
      const auto robot = support::any_robot(blueprint);
      const VectorXd q = random.vector(joints, 3), v = random.vector(joints, 2);
      for (const Link& link : blueprint.links) {
        CAPTURE(seed, joints, bodies, k, link.name.view());
        check(*robot, link.name.view(), q, v);
      }
    }
  }
}

/// The vector w of the matrix [w]x.
Eigen::Vector3d vector_of(const Eigen::Matrix3d& skew) {
  return {skew(2, 1), skew(0, 2), skew(1, 0)};
}

}  // namespace

TEST_CASE("The columns of a Jacobian are the slopes of forward kinematics") {
  on_random_robots(421, [](const support::AnyRobot& robot, std::string_view link, const VectorXd& q,
                           const VectorXd&) {
    const MatrixXd jacobian = robot.jacobian(q, link);
    const Eigen::Matrix3d rotation = robot.forward_kinematics(q, link).linear();
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      const Eigen::Matrix4d rate = support::slope([&](double t) -> Eigen::Matrix4d {
        const VectorXd moved = q + t * VectorXd::Unit(q.size(), j);
        return robot.forward_kinematics(moved, link).matrix();
      });
      Eigen::Matrix<double, 6, 1> column;
      column << rate.topRightCorner<3, 1>(),
          vector_of(rate.topLeftCorner<3, 3>() * rotation.transpose());
      // slope is off by 1e-12, times the fifth power of multipliers up to 2 added over two joints.
      CHECK((jacobian.col(j) - column).norm() <= 1e-8);
    }
  });
}

TEST_CASE("A Jacobian's transpose does a wrench's work") {
  on_random_robots(422, [](const support::AnyRobot& robot, std::string_view link, const VectorXd& q,
                           const VectorXd& v) {
    const Eigen::Vector3d force(3, -5, 7);
    Eigen::Matrix<double, 6, 1> wrench;
    wrench << force, Eigen::Vector3d::Zero();
    const double power = support::slope([&](double t) -> double {
      const VectorXd moved = q + t * v;
      return force.dot(robot.forward_kinematics(moved, link).translation());
    });
    const VectorXd effort = robot.jacobian(q, link).transpose() * wrench;
    CHECK(effort.dot(v) == Approx(power).epsilon(1e-7).margin(1e-6));
  });
}

TEST_CASE("A joint that others mimic moves a link with all of them") {
  const auto check = [](const auto& robot) {
    for (const double angle : {0.0, 1e-300, 0.3, -2.5}) {
      CAPTURE(angle);
      const double s = std::sin(angle), c = std::cos(angle);
      const JointVector<1> q(angle);
      // The tool is at 0.5 (c, s) + 0.25 (c, -s), 0.1 q high, and turned by q - 2 q.
      LinkJacobian<1> expected;
      expected << -0.75 * s, 0.25 * c, 0.1, 0, 0, -1;
      CHECK((jacobian(robot, q, "tool") - expected).norm() <= 1e-15);  // sums of two products
      expected << 0, 0, 0, 0, 0, 1;
      CHECK((jacobian(robot, q, "arm") - expected).norm() <= 1e-15);
      CHECK(jacobian(robot, q, "stand") == LinkJacobian<1>::Zero());
      CHECK(jacobian(robot, q, "base") == LinkJacobian<1>::Zero());
    }
  };
  check(Follower{});
  check(support::blueprint_of(Follower::description).model<1, 3>());
}

TEST_CASE("A known robot and its model have the same Jacobians") {
  const unsigned seed = 423;
  CAPTURE(seed);
  support::Random random(seed);
  const auto arm = support::model<Q2d>();
  for (int k = 0; k < 100; ++k) {
    const auto q = random.vector<2>(3);
    for (const LinkFrame& link : arm.links) {
      CAPTURE(k, link.name.view());
      const LinkJacobian<2> difference =
          jacobian(Q2d{}, q, link.name) - jacobian(arm, q, link.name);
      CHECK(difference.norm() <= 1e-15);  // sums of three products of lengths below 1 m
    }
  }
  STATIC_REQUIRE(operations<BodyPlacements, Q2d>().sines == 2);
}

TEST_CASE("Jacobians know no other links than forward kinematics") {
  const auto message_of = [](const auto& call) -> std::string {
    try {
      call();
      return "none";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  const JointVector<2> q = JointVector<2>::Zero();
  const auto arm = support::model<Q2d>();
  CHECK(message_of([&] { static_cast<void>(jacobian(Q2d{}, q, "hand")); }) ==
        message_of([&] { static_cast<void>(link_index(Q2d{}, "hand")); }));
  CHECK_THAT(message_of([&] { static_cast<void>(jacobian(Q2d{}, q, "hand")); }),
             Catch::Matchers::StartsWith("robot 'q2d' has no link 'hand'; links: origin_link, "));
  CHECK(message_of([&] { static_cast<void>(jacobian(arm, q, "hand")); }) ==
        message_of([&] { static_cast<void>(forward_kinematics(arm, q, "hand")); }));
}

TEST_CASE("NaN and infinity in a joint's position stay visible in what it moves") {
  const auto arm = support::model<Q2d>();
  for (const double bad : {support::not_a_number, support::infinity}) {
    CHECK_FALSE(jacobian(Q2d{}, JointVector<2>(bad, 0), "tool_link").allFinite());
    CHECK_FALSE(jacobian(Q2d{}, JointVector<2>(0, bad), "tool_link").allFinite());
    CHECK_FALSE(jacobian(arm, JointVector<2>(0, bad), "tool_link").allFinite());
  }
}
