// SPDX-License-Identifier: Apache-2.0
// The Q2D against the figures that its maker's model gives, typed once more.
#include "catch.hpp"

#include <articula/robots/q2d.hpp>

#include <algorithm>
#include <numbers>

using namespace articula;

namespace {

const Link& link(std::string_view name) {
  const auto& links = Q2d::description.links;
  const auto found = std::find_if(links.begin(), links.end(),
                                  [&](const Link& l) { return l.name.view() == name; });
  REQUIRE(found != links.end());
  return *found;
}

const Joint& joint(std::string_view name) {
  const auto& joints = Q2d::description.joints;
  const auto found = std::find_if(joints.begin(), joints.end(),
                                  [&](const Joint& j) { return j.name.view() == name; });
  REQUIRE(found != joints.end());
  return *found;
}

/// One row of the table of links: mass, centre of mass, ixx ixy ixz iyy iyz izz.
void check_link(std::string_view name, double mass, const Vector3<double>& center,
                const Symmetric3<double>& inertia) {
  CAPTURE(name);
  CHECK(link(name).mass == mass);
  CHECK(link(name).center_of_mass == center);
  CHECK(link(name).inertia == inertia);
  CHECK(link(name).inertia_orientation == Vector3<double>{});
}

/// One row of the table of joints.
void check_joint(std::string_view name, std::string_view parent, std::string_view child,
                 const Vector3<double>& origin, double velocity, double effort, double damping) {
  CAPTURE(name);
  const Joint& j = joint(name);
  CHECK(j.type == JointType::revolute);
  CHECK(j.parent.view() == parent);
  CHECK(j.child.view() == child);
  CHECK(j.origin == origin);
  CHECK(j.orientation == Vector3<double>{});
  CHECK(j.axis == Vector3<double>{0, 0, 1});
  CHECK(j.limits.lower == -std::numbers::pi / 2);
  CHECK(j.limits.upper == std::numbers::pi / 2);
  CHECK(j.limits.velocity == velocity);
  CHECK(j.limits.effort == effort);
  CHECK(j.damping == damping);
  CHECK(j.friction == 0);
}

void check_weld(std::string_view name, std::string_view parent, std::string_view child,
                const Vector3<double>& origin) {
  CAPTURE(name);
  const Joint& j = joint(name);
  CHECK(j.type == JointType::fixed);
  CHECK(j.parent.view() == parent);
  CHECK(j.child.view() == child);
  CHECK(j.origin == origin);
  CHECK(j.orientation == Vector3<double>{});
}

}  // namespace

TEST_CASE("the Q2D's links") {
  CHECK(Q2d::description.links.size() == 7);
  check_link("origin_link", 0, {}, {});
  check_link("base_link", 6.9621272394, {0.074571214, -0.00008502114, 0.0396000605},
             {0.12983348950453222, 0.00004414079177225, -0.03019200341025967, 0.17857934382693791,
              0.00000393635720902, 0.258121438746214});
  check_link("shoulder_active_link", 0.19730261508, {0.0252456823, -0.00000002723, 0.06470401873},
             {0.00038685518702305, 0.00000000055222416, -0.00000031340718614, 0.0001024143891387,
              -0.00000000015426019, 0.00047879093657893});
  check_link("shoulder_passive_link", 1.26475817816,
             {0.16516344805, -0.00048428845, -0.00016382412},
             {0.00346199967740929, -0.00010902049981923, -0.00401182173261703, 0.03314904030482527,
              0.00005087359051462, 0.03113579694057124});
  check_link("elbow_active_link", 0.19712951877, {0.02548273493, -0.00000002263, 0.05254513577},
             {0.00038850510800265, 0.00000000052121416, 0.00000404728675587, 0.00010146693248154,
              0.00000000002789435, 0.00048091942023028});
  check_link("elbow_passive_link", 0.67529215765, {0.06204831581, 0.00000013809, 0.01489882531},
             {0.00132247071698947, -0.00000000605403474, -0.00090893541574333, 0.0077400710225375,
              0.00000000624688369, 0.00751638349361413});
  check_link("tool_link", 0, {}, {});
}

TEST_CASE("the Q2D's joints") {
  CHECK(Q2d::description.joints.size() == 6);
  check_joint("shoulder_active_joint", "base_link", "shoulder_active_link", {0, 0, 0.1477}, 2.27,
              27.94, 29.7914);
  check_joint("elbow_active_joint", "shoulder_passive_link", "elbow_active_link", {0.343, 0, 0},
              23.08, 13.62, 2.6404);
  check_weld("base_joint", "origin_link", "base_link", {});
  check_weld("shoulder_passive_joint", "shoulder_active_link", "shoulder_passive_link", {});
  check_weld("elbow_passive_joint", "elbow_active_link", "elbow_passive_link", {});
  check_weld("end_joint", "elbow_passive_link", "tool_link", {0.267, 0, 0});
}

TEST_CASE("the Q2D's gravity is the course's") {
  CHECK(Q2d::description.gravity == Vector3<double>{0, 0, -9.8});
}

TEST_CASE("the Q2D's model: shoulder then elbow, on two bodies") {
  const auto& model = model_of(Q2d{});
  CHECK(joint_count<Q2d> == 2);
  CHECK(joint_names(Q2d{}) ==
        std::array<std::string_view, 2>{"shoulder_active_joint", "elbow_active_joint"});
  CHECK(effort_limits(Q2d{}) == JointVector<2>(27.94, 13.62));
  CHECK(model.mechanism.bodies[0].inertia.mass == 0.19730261508 + 1.26475817816);
  CHECK(model.mechanism.bodies[1].inertia.mass == 0.19712951877 + 0.67529215765);
}
