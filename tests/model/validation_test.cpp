// SPDX-License-Identifier: Apache-2.0
#include "catch.hpp"
#include "eigen.hpp"
#include "numbers.hpp"
#include "robots/blueprint.hpp"
#include "robots/faulty_robots.hpp"
#include "robots/random_robots.hpp"

#include <set>
#include <string>
#include <utility>

using namespace articula;
using support::Blueprint;
using support::infinity;
using support::not_a_number;

namespace {

/// As many rules as there are names for, `none` included.
constexpr int rule_count = [] {
  int count = 0;
  while (to_string(static_cast<Rule>(count)) != "unknown rule") ++count;
  return count;
}();

template <Rule rule>
void check_fault() {
  const DescriptionFault fault = support::blueprint_of(support::robot_with_fault<rule>()).fault();
  CAPTURE(to_string(rule), to_string(fault.rule));
  CHECK(fault.rule == rule);
  CHECK(fault.element.view() == support::element_at_fault(rule).view());
}

Blueprint double_pendulum() { return support::blueprint_of(support::double_pendulum); }

/// The rule that the double pendulum breaks after a change to the rod, or to the knee.
Rule broken_by(void (*change)(Link&)) {
  Blueprint robot = double_pendulum();
  change(robot.links[1]);
  return robot.fault().rule;
}
Rule broken_by(void (*change)(Joint&)) {
  Blueprint robot = double_pendulum();
  change(robot.joints[1]);
  return robot.fault().rule;
}

/// The inertia in axes turned at random.
Symmetric3<double> turned(support::Random& random, const Symmetric3<double>& inertia) {
  return rotated(rotation_from_rpy(random.vector3(3)), inertia);
}

}  // namespace

TEST_CASE("every rule is found broken, and the element at fault named") {
  [&]<int... K>(std::integer_sequence<int, K...>) {
    (check_fault<static_cast<Rule>(K)>(), ...);
  }(std::make_integer_sequence<int, rule_count>());
}

TEST_CASE("every rule has words of its own") {
  std::set<std::string_view> texts;
  for (int k = 0; k < rule_count; ++k) texts.insert(to_string(static_cast<Rule>(k)));
  CHECK(texts.size() == rule_count);
  CHECK(rule_count > 20);
  CHECK(to_string(static_cast<Rule>(-1)) == "unknown rule");
}

TEST_CASE("a number that is not finite is found wherever it stands") {
  using LinkChange = void (*)(Link&, double);
  for (LinkChange change : {
           LinkChange([](Link& l, double x) { l.mass = x; }),
           LinkChange([](Link& l, double x) { l.center_of_mass.x = x; }),
           LinkChange([](Link& l, double x) { l.center_of_mass.z = x; }),
           LinkChange([](Link& l, double x) { l.inertia.xx = x; }),
           LinkChange([](Link& l, double x) { l.inertia.xy = x; }),
           LinkChange([](Link& l, double x) { l.inertia.xz = x; }),
           LinkChange([](Link& l, double x) { l.inertia.yy = x; }),
           LinkChange([](Link& l, double x) { l.inertia.yz = x; }),
           LinkChange([](Link& l, double x) { l.inertia.zz = x; }),
           LinkChange([](Link& l, double x) { l.inertia_orientation.y = x; }),
       }) {
    for (double x : {infinity, -infinity, not_a_number, 1.01e50, -1e51, support::largest}) {
      Blueprint robot = double_pendulum();
      change(robot.links[1], x);
      CHECK(robot.fault().rule == Rule::number_is_not_finite);
      CHECK(robot.fault().element.view() == "rod");
    }
  }
  using JointChange = void (*)(Joint&, double);
  for (JointChange change : {
           JointChange([](Joint& j, double x) { j.origin.x = x; }),
           JointChange([](Joint& j, double x) { j.origin.y = x; }),
           JointChange([](Joint& j, double x) { j.origin.z = x; }),
           JointChange([](Joint& j, double x) { j.orientation.x = x; }),
           JointChange([](Joint& j, double x) { j.orientation.z = x; }),
           JointChange([](Joint& j, double x) { j.damping = x; }),
           JointChange([](Joint& j, double x) { j.friction = x; }),
           JointChange([](Joint& j, double x) { j.reflected_inertia = x; }),
           JointChange([](Joint& j, double x) { j.mimic.multiplier = x; }),
           JointChange([](Joint& j, double x) { j.mimic.offset = x; }),
       }) {
    for (double x : {infinity, -infinity, not_a_number, 1.01e50, -1e51, support::largest}) {
      Blueprint robot = double_pendulum();
      change(robot.joints[1], x);
      CHECK(robot.fault().rule == Rule::number_is_not_finite);
      CHECK(robot.fault().element.view() == "knee");
    }
  }
  for (double x : {infinity, not_a_number, support::largest}) {
    Blueprint robot = double_pendulum();
    robot.gravity.y = x;
    CHECK(robot.fault().rule == Rule::number_is_not_finite);
    CHECK(robot.fault().element.view() == "swing");
  }
  for (double x : {infinity, -infinity, not_a_number}) {  // an axis of any length has a direction
    Blueprint robot = double_pendulum();
    robot.joints[1].axis.x = x;
    CHECK(robot.fault().rule == Rule::number_is_not_finite);
    CHECK(robot.fault().element.view() == "knee");
  }
}

TEST_CASE("limits that are NaN, or leave no position, are faults") {
  using Change = void (*)(Joint&);
  for (Change change : {
           Change([](Joint& j) { j.limits.lower = not_a_number; }),
           Change([](Joint& j) { j.limits.upper = not_a_number; }),
           Change([](Joint& j) { j.limits.velocity = not_a_number; }),
           Change([](Joint& j) { j.limits.effort = not_a_number; }),
           Change([](Joint& j) { j.limits.lower = j.limits.upper = infinity; }),
           Change([](Joint& j) { j.limits.lower = j.limits.upper = -infinity; }),
       }) {
    CHECK(broken_by(change) != Rule::none);
  }
}

TEST_CASE("limits may be equal, zero or missing") {
  CHECK(broken_by([](Joint& j) { j.limits = {}; }) == Rule::none);
  CHECK(broken_by([](Joint& j) { j.limits = {.lower = 1, .upper = 1}; }) == Rule::none);
  CHECK(broken_by([](Joint& j) {
          j.limits = {.lower = 0, .upper = 0, .velocity = 0, .effort = 0};
        }) == Rule::none);
}

TEST_CASE("a mimic whose limits leave the joint it follows no position is a fault") {
  Blueprint robot = double_pendulum();
  robot.joints[0].limits = {.lower = -1, .upper = 1};
  robot.joints[1].type = JointType::revolute;
  robot.joints[1].limits = {.lower = 5, .upper = 6};
  robot.joints[1].mimic = {.joint = "pivot"};
  CHECK(robot.fault().rule != Rule::none);
}

TEST_CASE("a fixed joint needs no axis, and must have no limits") {
  Blueprint robot = double_pendulum();
  Joint& joint = robot.joints[1];
  joint.type = JointType::fixed;
  joint.axis = {0, 0, 0};
  joint.limits = {};
  joint.damping = joint.friction = joint.reflected_inertia = 0;
  CHECK(robot.fault().rule == Rule::none);
  // Whoever forgets the type gets a fixed joint.
  for (double* number :
       {&joint.limits.lower, &joint.limits.upper, &joint.limits.velocity, &joint.limits.effort,
        &joint.damping, &joint.friction, &joint.reflected_inertia}) {
    const double before = std::exchange(*number, 1);
    CHECK(robot.fault().rule == Rule::fixed_joint_has_limits_or_damping);
    CHECK(robot.fault().element == joint.name);
    *number = before;
  }
}

TEST_CASE("a body that cannot exist is told from one that can, in any axes") {
  const unsigned seed = 221;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 1000; ++k) {
    Blueprint robot = double_pendulum();
    Symmetric3<double>& inertia = robot.links[1].inertia;
    const double a = random.number(0.01, 1), b = random.number(0.01, 1);
    const double size = std::pow(10, random.integer(-12, 6));
    const auto principal = [&](double c) {
      return turned(random, {.xx = size * a, .yy = size * b, .zz = size * c});
    };
    CAPTURE(k, a, b, size);
    inertia = principal(a + b);  // a flat plate: possible, whatever rounding makes of it
    CHECK(robot.fault().rule == Rule::none);
    inertia = principal((a + b) * (1 - 1e-9));
    CHECK(robot.fault().rule == Rule::none);
    inertia = principal((a + b) * (1 + 1e-9));  // a thousand times what is forgiven
    CHECK(robot.fault().rule == Rule::inertia_breaks_the_triangle_inequality);
    inertia = principal(-1e-9);
    CHECK(robot.fault().rule == Rule::inertia_is_not_positive_definite);
  }
}

TEST_CASE("inertias that break a rule in one place only") {
  const auto fault_of = [](const Symmetric3<double>& inertia) {
    Blueprint robot = double_pendulum();
    robot.links[1].inertia = inertia;
    return robot.fault().rule;
  };
  // The largest moment in each place.
  CHECK(fault_of({.xx = 3, .yy = 1, .zz = 1}) == Rule::inertia_breaks_the_triangle_inequality);
  CHECK(fault_of({.xx = 1, .yy = 3, .zz = 1}) == Rule::inertia_breaks_the_triangle_inequality);
  CHECK(fault_of({.xx = 1, .yy = 1, .zz = 3}) == Rule::inertia_breaks_the_triangle_inequality);
  CHECK(fault_of({.xx = 2, .yy = 1, .zz = 1}) == Rule::none);
  // Moments that are fine with products that are not.
  CHECK(fault_of({.xx = 1, .xy = 1.1, .yy = 1, .zz = 1}) == Rule::inertia_is_not_positive_definite);
  CHECK(fault_of({.xx = 1, .xz = 1.1, .yy = 1, .zz = 1}) == Rule::inertia_is_not_positive_definite);
  CHECK(fault_of({.xx = 1, .yy = 1, .yz = 1.1, .zz = 1}) == Rule::inertia_is_not_positive_definite);
  CHECK(fault_of({.xx = 1, .xy = 0.6, .yy = 1, .zz = 1}) ==
        Rule::inertia_breaks_the_triangle_inequality);
  // A massive link without inertia, a rod without thickness: the axis along it would feel nothing.
  CHECK(fault_of({}) == Rule::inertia_is_not_positive_definite);
  CHECK(fault_of({.xx = 1, .yy = 1}) == Rule::inertia_is_not_positive_definite);
}

TEST_CASE("masses") {
  CHECK(broken_by([](Link& l) { l.mass = 5e-324; }) == Rule::none);
  CHECK(broken_by([](Link& l) { l.mass = -5e-324; }) == Rule::link_has_negative_mass);
  CHECK(broken_by([](Link& l) { l.mass = 0; }) == Rule::link_has_inertia_but_no_mass);
  CHECK(broken_by([](Link& l) {
          l.mass = 0;
          l.inertia = {};
        }) == Rule::none);  // the pivot still moves the bob
}

TEST_CASE("axes of any length but 0") {
  for (double length : {1e-200, 1e-160, 1e-8, 1.0, 1e8, 1e160, 1e200}) {
    Blueprint robot = double_pendulum();
    robot.joints[1].axis = {0, -length, length};
    CAPTURE(length);
    CHECK(robot.fault().rule == Rule::none);
    // Two roundings of the axis, three of the matrix.
    const Eigen::Matrix3d turn =
        support::to_eigen(robot.model<2>().mechanism.bodies[1].placement.rotation);
    CHECK(support::distance(turn * turn.transpose(), Eigen::Matrix3d::Identity()) < 2e-15);
  }
  CHECK(broken_by([](Joint& j) { j.axis = {-0.0, 0, 0}; }) == Rule::axis_has_length_zero);
}

TEST_CASE("trees: loops, strangers and two roots, wherever they stand in the lists") {
  Blueprint robot = double_pendulum();
  robot.joints[1].parent = "bob";  // carries itself
  CHECK(robot.fault().rule == Rule::links_form_a_loop);
  robot = double_pendulum();
  robot.joints[0].child = "stand";
  CHECK(robot.fault().rule == Rule::links_form_a_loop);
  robot = double_pendulum();
  robot.joints[0].parent = "";
  CHECK(robot.fault().rule == Rule::parent_link_does_not_exist);
  robot = double_pendulum();
  robot.links.insert(robot.links.begin(), Link{.name = "table"});
  CHECK(robot.fault().rule == Rule::links_have_more_than_one_root);
  robot = double_pendulum();
  robot.joints.clear();
  CHECK(robot.fault().rule == Rule::links_have_more_than_one_root);
  robot.links.resize(1);
  CHECK(robot.fault().rule == Rule::robot_has_no_moving_joint);
  robot.links.clear();
  CHECK(robot.fault().rule == Rule::robot_has_no_moving_joint);
}

TEST_CASE("a link and a joint may have the same name") {
  CHECK(broken_by([](Joint& j) { j.name = "bob"; }) == Rule::none);
}

TEST_CASE("random robots have no fault") {
  const unsigned seed = 222;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 500; ++k) {
    const int moving = random.integer(1, 8);
    const Blueprint robot =
        support::random_robot(random, moving, support::Shape::tree, random.integer(0, moving - 1));
    const DescriptionFault fault = robot.fault();
    CAPTURE(k, fault.element.view(), to_string(fault.rule));
    CHECK(fault.rule == Rule::none);
  }
}
