// SPDX-License-Identifier: Apache-2.0
/// @file examples/robots/*.urdf, read at run time, and the robots of articula/robots: the same
/// models.
#include <articula/robots/gripper_arm.hpp>
#include <articula/robots/panda.hpp>
#include <articula/robots/pr2.hpp>
#include <articula/robots/two_arm_torso.hpp>
#include <articula/robots/ur10.hpp>
#include <articula/urdf/urdf.hpp>

#include "catch.hpp"

#include <string>
#include <type_traits>

using namespace articula;

namespace {

/// The file is named as the robot is. Both are built by the same text, by the compiler and at run
/// time; what differs is how products are rounded where the processor can fuse them with sums.
template <class R>
void check_file() {
  const auto& ours = model_of(R{});
  using Ours = std::remove_cvref_t<decltype(ours)>;
  const std::string file =
      URDF_FILES "/../../examples/robots/" + std::string(ours.name.view()) + ".urdf";
  CAPTURE(file);
  const UrdfDescription description =
      read_urdf(file, {.allow_unphysical = R::description.allow_unphysical});
  const auto theirs = load_urdf<Ours::joint_count, Ours::body_count>(description);
  CHECK(theirs.name == ours.name);
  CHECK(theirs.mechanism.gravity == ours.mechanism.gravity);

  const auto close = [](const Vector3<double>& a, const Vector3<double>& b) {
    const Vector3<double> d = a - b;
    return dot(d, d) <= 1e-30 * (1 + dot(b, b));
  };
  const auto placed_alike = [&](const Placement<double>& a, const Placement<double>& b) {
    return close(a.translation, b.translation) && close(a.rotation.rows[0], b.rotation.rows[0]) &&
           close(a.rotation.rows[1], b.rotation.rows[1]) &&
           close(a.rotation.rows[2], b.rotation.rows[2]);
  };
  for (std::size_t i = 0; i < ours.mechanism.bodies.size(); ++i) {
    CAPTURE(i);
    const Body &a = theirs.mechanism.bodies[i], &b = ours.mechanism.bodies[i];
    CHECK(a.parent == b.parent);
    CHECK(a.prismatic == b.prismatic);
    CHECK(placed_alike(a.placement, b.placement));
    CHECK(a.inertia.mass == Approx(b.inertia.mass).epsilon(1e-15));
    CHECK(close(a.inertia.first_moment, b.inertia.first_moment));
    const Symmetric3<double>&m = a.inertia.moment, &n = b.inertia.moment;
    CHECK(close({m.xx, m.yy, m.zz}, {n.xx, n.yy, n.zz}));
    CHECK(close({m.xy, m.xz, m.yz}, {n.xy, n.xz, n.yz}));
    const Coupling &c = theirs.mechanism.couplings[i], &d = ours.mechanism.couplings[i];
    CHECK(c.joint == d.joint);
    CHECK(c.multiplier == d.multiplier);
    CHECK(c.offset == d.offset);
  }
  for (std::size_t i = 0; i < ours.joints.size(); ++i) {
    const JointProperties &a = theirs.joints[i], &b = ours.joints[i];
    CAPTURE(std::string(b.name.view()));
    CHECK(a.name == b.name);
    CHECK(a.type == b.type);
    CHECK(a.limits.lower == b.limits.lower);
    CHECK(a.limits.upper == b.limits.upper);
    CHECK(a.limits.velocity == b.limits.velocity);
    CHECK(a.limits.effort == b.limits.effort);
    CHECK(a.damping == b.damping);
    CHECK(a.friction == b.friction);
  }
  REQUIRE(theirs.links.size() == ours.links.size());
  for (std::size_t i = 0; i < ours.links.size(); ++i) {
    CAPTURE(std::string(ours.links[i].name.view()));
    CHECK(theirs.links[i].name == ours.links[i].name);
    CHECK(theirs.links[i].body == ours.links[i].body);
    CHECK(placed_alike(theirs.links[i].placement, ours.links[i].placement));
  }
}

}  // namespace

TEST_CASE("The UR10's file is the UR10") { check_file<Ur10>(); }
TEST_CASE("The Panda's file is the Panda") { check_file<Panda>(); }
TEST_CASE("The gripper arm's file is the gripper arm") { check_file<GripperArm>(); }
TEST_CASE("The torso's file is the torso") { check_file<TwoArmTorso>(); }
TEST_CASE("The PR2's file is the PR2") { check_file<Pr2>(); }
