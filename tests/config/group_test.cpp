// SPDX-License-Identifier: Apache-2.0
#include <articula/config/load_pid_gains.hpp>
#include <articula/config/load_trajectory_tolerances.hpp>
#include <articula/control/bypass.hpp>
#include <articula/control/laws/on_joints.hpp>
#include <articula/control/laws/pid_law.hpp>
#include <articula/control/pid.hpp>
#include <articula/control/switching/groups.hpp>
#include <articula/robots/gripper_arm.hpp>

#include <string>
#include <string_view>
#include <vector>

#include "catch.hpp"
#include "config_support.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::config_file;
using support::yaml;

namespace {

using Vector = JointVector<7>;

const std::string file = "gripper_arm_controllers.yaml";

}  // namespace

TEST_CASE("the trajectory controller of six joints of seven leaves the gripper unchecked") {
  const auto config = load_trajectory_tolerances(GripperArm(), config_file(file));
  const int gripper = joint_index(GripperArm(), "left_outer_knuckle_joint");
  for (int j = 0; j < 7; ++j) {
    CHECK(config.tolerances.stopped_velocity[j] == (j == gripper ? 0 : 0.01));
    CHECK(config.tolerances.path_position[j] ==
          (j == joint_index(GripperArm(), "joint_1") ? 0.1 : 0));
  }
  CHECK_NOTHROW(validate(GripperArm(), config.tolerances));
  bool noted = false;
  for (const std::string& note : config.notes) {
    noted = noted || note.find(
                         "no tolerances for joint 'left_outer_knuckle_joint', which is not "
                         "in 'joints': it is not checked") != std::string::npos;
  }
  CHECK(noted);
  CHECK_THROWS_WITH(load_trajectory_tolerances(GripperArm(), yaml("constraints: {goal_time: 1}")),
                    Contains("is missing, expected an entry in 'joints'"));
}

TEST_CASE("gains of six joints of seven are those of a group") {
  CHECK_THROWS_WITH(
      load_pid_gains(GripperArm(), config_file(file)),
      Contains("has the joint 'left_outer_knuckle_joint', which is missing, expected gains"));

  const auto arm =
      load_pid_gains(GripperArm(), config_file(file), "arm_controller", GainsOf::some_joints);
  REQUIRE(arm.group.size() == 6);
  const int gripper = joint_index(GripperArm(), "left_outer_knuckle_joint");
  for (const Name& name : arm.group) {
    CHECK(arm.gains[static_cast<std::size_t>(joint_index(GripperArm(), name))].derivative > 0);
  }
  CHECK(arm.gains[static_cast<std::size_t>(gripper)].proportional == 0);

  using Parts = Groups<GripperArm, Pid<GripperArm>, Bypass<GripperArm>>;
  Parts parts({{{"arm", arm.group}, {"gripper", {"left_outer_knuckle_joint"}}}},
              Pid<GripperArm>(arm.gains), Bypass<GripperArm>());
  JointState<7> state{};
  JointReference<7> reference;
  reference.position = Vector::Constant(0.01);
  reference.effort[gripper] = 0.5;
  parts.start({state, reference, 0.01});
  const Vector effort = parts.update({state, reference, 0.01}).command.effort;
  CHECK(effort[joint_index(GripperArm(), "joint_4")] == Approx(0.4));
  CHECK(effort[gripper] == 0.5);

  const std::vector<std::string_view> names(arm.group.begin(), arm.group.end());
  OnJoints<7, PidLaw<7>> part(GripperArm(), PidLaw<7>(GripperArm(), arm.gains), names);
  part.start({state, reference, 0.01});
  CHECK(part.output({state, reference, 0.01})[gripper] == 0);
}

TEST_CASE("of a group all joints have gains and lie in the chain") {
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      static_cast<void>(load_pid_gains(GripperArm(), yaml(text), "", GainsOf::some_joints));
    } catch (const FileError& error) {
      return error.what();
    }
    return "none";
  };
  const std::string two = "joints: [joint_1, joint_2]\njoint_1: {p: 1}\n";
  CHECK_THAT(complaint(two), Contains("joints[1]: joint 'joint_2' has no gains"));
  const std::string link(model_of(GripperArm()).links.back().name.view());
  CHECK(complaint(two + "joint_2: {p: 1}\nchain: {tip: " + link + "}\n") == "none");
  CHECK_THAT(complaint("gains: {left_outer_knuckle_joint: {p: 1}}\nchain: {tip: flange_link}\n"),
             Contains("chain to 'flange_link'") &&
                 Contains("leaves joint 'left_outer_knuckle_joint' out"));
  CHECK_THAT(complaint("gravity: {z: -9.81}\n"), Contains("which is missing"));
  CHECK_THAT(complaint("gains: {right_outer_knuckle_joint: {p: 1}}\n"),
             Contains("mimics 'left_outer_knuckle_joint'"));
}
