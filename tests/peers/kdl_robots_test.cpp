// SPDX-License-Identifier: Apache-2.0
// A ready robot, ARTICULA_ROBOT, in the Orocos Kinematics and Dynamics Library. KDL reads the
// description as its author wrote it; what becomes of it here (welding, axes on z, couplings,
// canonical form, straight-line programs) has no part in its results.
#include "peers/agreement.hpp"
#include "peers/kdl_robot.hpp"

#include ARTICULA_ROBOT_HEADER

using namespace articula;

TEST_CASE("KDL has the same dynamics of a ready robot") {
  const support::Blueprint blueprint = support::blueprint_of(ARTICULA_ROBOT::description);
  support::KdlRobot peer(blueprint, joint_names(ARTICULA_ROBOT{}));
  // Some thousand products, each off by 1.1e-16 of the largest terms, which cancel in part; solving
  // for accelerations multiplies that by the condition of the mass matrix, up to 1e6 where a torso
  // carries fingers.
  const support::Tolerance tolerance{.effort = 1e-12, .acceleration = 1e-10};

  SECTION("known at compile time") {
    support::check_agreement(ARTICULA_ROBOT{}, peer, 2000, 921, tolerance);
  }
  SECTION("as a model") {
    using R = std::remove_cvref_t<decltype(model_of(ARTICULA_ROBOT{}))>;
    support::check_agreement(blueprint.model<R::joint_count, R::body_count>(), peer, 2000, 922,
                             tolerance);
  }
}
