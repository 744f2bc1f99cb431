// SPDX-License-Identifier: Apache-2.0
/// @file Controllers as the documentation of ros_control and ros2_control and courses have them.
#include <articula/config/load_controller_manager.hpp>
#include <articula/config/load_pid_gains.hpp>
#include <articula/config/load_trajectory_tolerances.hpp>
#include <articula/robots/q2d.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "catch.hpp"
#include "config_support.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::yaml;

namespace {

/// A robot's joints are called as in q2d.hpp, all else is as it stands there.
const std::string joint_list = "[shoulder_active_joint, elbow_active_joint]\n";

/// Keys that are noted as not used, one by one.
void check_noted(const std::vector<std::string>& notes, const std::vector<std::string>& keys) {
  CHECK(notes.size() == keys.size());
  for (const std::string& key : keys) {
    INFO(key);
    CHECK(std::any_of(notes.begin(), notes.end(), [&](const std::string& note) {
      return note.find("." + key + ": not used") != std::string::npos;
    }));
  }
}

}  // namespace

TEST_CASE("a joint trajectory controller of ROS 2 over effort") {
  const std::string text =
      "controller_manager:\n"
      "  ros__parameters:\n"
      "    update_rate: 100  # Hz\n"
      "    joint_state_broadcaster:\n"
      "      type: joint_state_broadcaster/JointStateBroadcaster\n"
      "    arm_controller:\n"
      "      type: joint_trajectory_controller/JointTrajectoryController\n"
      "arm_controller:\n"
      "  ros__parameters:\n"
      "    joints:\n"
      "      - shoulder_active_joint\n"
      "      - elbow_active_joint\n"
      "    command_interfaces: [effort]\n"
      "    state_interfaces: [position, velocity]\n"
      "    start_with_holding: true\n"
      "    allow_partial_joints_goal: false # Defaults to false\n"
      "    gains:\n"
      "      shoulder_active_joint:\n"
      "        p: 100.0\n"
      "        i: 1.0\n"
      "        d: 10.0\n"
      "        i_clamp: 1.0\n"
      "        ff_velocity_scale: 0.5\n"
      "      elbow_active_joint: {p: 50.0, i: 1.0, d: 5.0, i_clamp: 2.0, normalize_error: false}\n"
      "    constraints:\n"
      "      stopped_velocity_tolerance: 0.02\n"
      "      goal_time: 0.6\n"
      "      shoulder_active_joint: { trajectory: 0.2, goal: 0.05 }\n"
      "      elbow_active_joint: { trajectory: 0.0, goal: 0.03 }\n";
  const auto gains = load_pid_gains(Q2d(), yaml(text));
  CHECK(gains.type == "joint_trajectory_controller/JointTrajectoryController");
  CHECK(gains.gains[0].proportional == 100);
  CHECK(gains.gains[0].velocity_feedforward == 0.5);
  CHECK(gains.gains[1].integral_clamp_min == -2);
  check_noted(gains.notes, {"command_interfaces", "state_interfaces", "start_with_holding"});
  const auto tolerances = load_trajectory_tolerances(Q2d(), yaml(text)).tolerances;
  CHECK(tolerances.path_position[0] == 0.2);
  CHECK(tolerances.goal_position[1] == 0.03);
  CHECK(tolerances.stopped_velocity[1] == 0.02);
  CHECK(load_controller_manager(yaml(text)).controllers.size() == 2);
}

TEST_CASE("a gripper's action controller over effort") {
  const std::string text =
      "gripper_controller:\n"
      "  type: effort_controllers/GripperActionController\n"
      "  joint: elbow_active_joint\n"
      "  gains:\n"
      "    elbow_active_joint: {p: 1.0, i: 0.0, d: 0.0}\n"
      "  action_monitor_rate: 50\n"
      "  goal_tolerance: 0.01\n"
      "  max_effort: 0.1\n"
      "  stall_velocity_threshold: 0.001\n"
      "  stall_timeout: 1.0\n"
      "  allow_stalling: true\n";
  const auto gains = load_pid_gains(Q2d(), yaml(text), "", GainsOf::some_joints);
  CHECK(gains.gains[1].proportional == 1);
  check_noted(gains.notes, {"action_monitor_rate", "goal_tolerance", "max_effort",
                            "stall_velocity_threshold", "stall_timeout", "allow_stalling"});
  const ControllerConfig config = load_controller(yaml(text));
  CHECK(config.gripper.allow_stalling);
  CHECK(config.gripper.stall_timeout == 1);
  CHECK(config.gain_prefix == "gains.");
  CHECK_THROWS_WITH(
      load_controller(yaml(text + "  max_effor: 1\n")),
      Contains("test:12:3: gripper_controller.max_effor: unknown key 'max_effor', "
               "expected one of max_effort, max_effort_interface, max_velocity, ...; did "
               "you mean 'max_effort'?"));
}

TEST_CASE("controllers of ROS 1") {
  const auto shoulder_gain = [](const std::string& text) {
    return load_pid_gains(Q2d(), yaml(text)).gains[0].proportional;
  };
  const std::string gains =
      "    shoulder_active_joint: {p: 100.0, i: 0.01, d: 1, i_clamp: 5}\n"
      "    elbow_active_joint: {p: 100.0, i: 0.01, d: 1, i_clamp: 5}\n";
  CHECK(shoulder_gain("/arm_controller:\n  type: effort_controllers/JointTrajectoryController\n"
                      "  joints: " +
                      joint_list + "  gains:\n" + gains +
                      "  constraints: {goal_time: 0.6}\n  stop_trajectory_duration: 0.5\n") == 100);
  CHECK(shoulder_gain("gazebo_ros_control:\n  pid_gains:\n" + gains) == 100);
  CHECK(shoulder_gain("rrbot:\n  joint_state_controller:\n"
                      "    type: joint_state_controller/JointStateController\n"
                      "    publish_rate: 50\n"
                      "  joint1_position_controller:\n"
                      "    type: effort_controllers/JointPositionController\n"
                      "    joint: shoulder_active_joint\n"
                      "    pid: &gains {p: 100.0, i: 0.01, d: 10.0}\n"
                      "  joint2_position_controller:\n"
                      "    type: effort_controllers/JointPositionController\n"
                      "    joint: elbow_active_joint\n"
                      "    pid: *gains\n") == 100);
}

TEST_CASE("a byte order mark and all line ends are read, and lines counted") {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
      const auto text = [&](const std::string& p) {
        return yaml(mark + "joints: [shoulder_active_joint, elbow_active_joint]" + end + end +
                    "gains:" + end + "  shoulder_active_joint: {p: 1}" + end +
                    "  elbow_active_joint:" + end + "    p: " + p + end);
      };
      CHECK(load_pid_gains(Q2d(), text("7")).gains[1].proportional == 7);
      CHECK_THROWS_WITH(load_pid_gains(Q2d(), text("many")),
                        Contains("test:6:8: gains.elbow_active_joint.p: the word 'many'"));
    }
  }
}
