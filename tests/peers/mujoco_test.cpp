// SPDX-License-Identifier: Apache-2.0
// The ready robots in MuJoCo, as models; kdl_robots_test.cpp shows that robots known at compile
// time have the same dynamics.
#include "peers/mujoco.hpp"
#include "peers/agreement.hpp"
#include "robots/blueprint.hpp"

#include <articula/robots/gripper_arm.hpp>
#include <articula/robots/panda.hpp>
#include <articula/robots/pr2.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/robots/two_arm_torso.hpp>
#include <articula/robots/ur10.hpp>

using namespace articula;

TEMPLATE_TEST_CASE("MuJoCo has the same dynamics of the ready robots", "", Q2d, Ur10, Panda,
                   GripperArm, TwoArmTorso, Pr2) {
  using R = std::remove_cvref_t<decltype(model_of(TestType{}))>;
  const auto robot =
      support::blueprint_of(TestType::description).template model<R::joint_count, R::body_count>();
  support::MujocoRobot peer(robot.mechanism);
  // MuJoCo turns inertias to their principal axes by an iteration that it ends early.
  support::check_agreement(robot, peer, 2000, 931, {.effort = 1e-7, .acceleration = 1e-5});
}
