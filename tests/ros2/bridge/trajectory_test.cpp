// SPDX-License-Identifier: Apache-2.0
// ROS 2's clients move a loop's robot: by trajectories as goals or messages, by references, by
// commands.
#include "articula/ros2/bridge/controllers/trajectory_messages.hpp"
#include "articula/ros2/messages/action_msgs.hpp"
#include "articula/ros2/messages/control_msgs.hpp"
#include "articula/ros2/messages/controller_manager_msgs.hpp"
#include "articula/ros2/messages/rcl_interfaces.hpp"
#include "articula/ros2/node/ros_time.hpp"

#include "bridged_arm.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace articula;
using namespace articula::ros2;
using support::BridgedArm;
using support::elbow_joint;
using support::shoulder_joint;

namespace {

using Follow = control_msgs::action::FollowJointTrajectory<Jazzy>;
using Send = SendGoal<Follow>;
using Get = GetResult<Follow>;
using Cancel = action_msgs::srv::CancelGoal<Jazzy>;
using GoalState = action_msgs::msg::GoalStatus;
using Point = trajectory_msgs::msg::JointTrajectoryPoint<Jazzy>;
using Numbers = std_msgs::msg::Float64MultiArray<Jazzy>;
const std::string controller = "/pid_plus_gravity/",
                  action = controller + "follow_joint_trajectory/_action/";

/// An active arm.
struct ActiveArm : BridgedArm {
  using BridgedArm::BridgedArm;
  explicit ActiveArm(const BridgeOptions& options = {},
                     std::unique_ptr<support::AnyLoop> own_loop = support::switched_arm())
      : BridgedArm(options, std::move(own_loop)) {
    REQUIRE(ask(remote::Activate{}).verdict == remote::Verdict::done);
  }

  std::vector<double> reference() {
    const auto session = loop->port().connect("watcher", false);
    remote::Cycle cycle;
    run(1);
    while (session->next(cycle)) {
    }
    return cycle.reference_position;
  }
  Send::Response send(std::uint8_t id, const Follow::Goal& goal, const std::string& to = action) {
    Send::Request request{.goal = goal};
    request.goal_id.uuid[0] = id;
    return call<Send>(to + "send_goal", request);
  }
  /// Asks for a result, which may come later.
  std::shared_ptr<support::Bytes> result(std::uint8_t id, const std::string& from = action) {
    Get::Request request;
    request.goal_id.uuid[0] = id;
    return transport.request(from + "get_result", support::bytes_of(request));
  }
  Get::Response wait_for(std::uint8_t id, const std::string& from = action) {
    return reply_to<Get>(result(id, from), 5000);
  }
  std::int8_t status(std::uint8_t id) {
    const auto all = transport.last<action_msgs::msg::GoalStatusArray<Jazzy>>(action + "status");
    REQUIRE(all);
    for (const auto& own : all->status_list) {
      if (own.goal_info.goal_id.uuid[0] == id) return own.status;
    }
    return 0;
  }
  /// Whether one of the last lines of the log has these words.
};

/// A goal for both joints.
Follow::Goal goal_to(double shoulder, double elbow, std::int32_t seconds) {
  Follow::Goal goal;
  goal.trajectory.joint_names = {elbow_joint, shoulder_joint};
  goal.trajectory.points = {{.positions = {elbow, shoulder}, .time_from_start = {seconds, 0}}};
  return goal;
}

}  // namespace

TEST_CASE("a goal is accepted, gives feedback, and succeeds") {
  ActiveArm arm;
  const auto accepted = arm.send(1, goal_to(0.3, -0.2, 1));
  CHECK(accepted.accepted);
  CHECK(accepted.stamp.sec == 1'700'000'000);
  CHECK(arm.status(1) == GoalState::executing);
  const auto result = arm.result(1);
  arm.run(500);
  CHECK(result->empty());
  const auto feedback = arm.transport.last<FeedbackMessage<Follow>>(action + "feedback");
  REQUIRE(feedback);
  CHECK(feedback->goal_id.uuid[0] == 1);
  CHECK(feedback->feedback.joint_names == std::vector<std::string>{shoulder_joint, elbow_joint});
  CHECK(feedback->feedback.desired.positions[0] > 0.05);
  CHECK(std::abs(feedback->feedback.error.positions[0]) < 0.05);
  const auto count = arm.transport.topics[action + "feedback"].count;
  CHECK((count >= 8 && count <= 12));  // 20 Hz
  const auto response = arm.reply_to<Get>(result, 2000);
  CHECK(response.status == GoalState::succeeded);
  CHECK(response.result.error_code == 0);
  CHECK(response.result.error_string == "Goal successfully reached!");
  CHECK(arm.reference() == std::vector<double>{0.3, -0.2});
  CHECK(arm.status(1) == GoalState::succeeded);
  CHECK(arm.wait_for(1).status == GoalState::succeeded);  // again
  arm.run(10100);
  CHECK(arm.status(1) == 0);
  CHECK(arm.wait_for(1).status == 0);
}

TEST_CASE("goals that cannot be followed are rejected, and the log says why") {
  BridgedArm inactive;
  Send::Request request{.goal = goal_to(0.1, 0.1, 1)};
  CHECK_FALSE(inactive.call<Send>(action + "send_goal", request).accepted);
  CHECK(inactive.transport.last<rcl_interfaces::msg::Log<Jazzy>>("/rosout")->msg ==
        "Can't accept new action goals. Controller is not running.");

  ActiveArm arm;
  const auto rejected = [&](const Follow::Goal& goal, const std::string& words) {
    CHECK_FALSE(arm.send(9, goal).accepted);
    INFO(words);
    CHECK(arm.logged(words));
    arm.transport.topics["/rosout"].sent.clear();
  };
  auto goal = goal_to(0.1, 0.1, 1);
  goal.trajectory.joint_names[0] = "knee";
  rejected(goal, "Incoming joint knee doesn't match the controller's joints.");
  goal = goal_to(0.1, 0.1, 1);
  goal.trajectory.points[0].positions.pop_back();
  rejected(goal, "1 positions for 2 joints");
  goal = goal_to(0.1, 0.1, 1);
  goal.trajectory.points.push_back(goal.trajectory.points[0]);
  rejected(goal, "time_from_start");
  rejected(goal_to(2, 0, 1), "position");
  rejected(goal_to(std::nan(""), 0, 1), "nan");
  rejected({}, "trajectory");
  goal = goal_to(0.1, 0.1, 1);
  goal.path_tolerance = {{.name = shoulder_joint, .position = -0.5}};
  rejected(goal, "path_position");
  goal = goal_to(0.1, 0.1, 1);
  goal.trajectory.header.stamp = {1, 0};  // long ago
  rejected(goal, "old header timestamp");
  CHECK(arm.bridge.dropped().refused == 8);
  CHECK(arm.send(9, goal_to(0.1, 0.1, 1)).accepted);
  CHECK_FALSE(arm.send(9, goal_to(0.1, 0.1, 1)).accepted);  // the same identifier
}

TEST_CASE("a goal with a stamp begins at that time") {
  ActiveArm arm;
  auto goal = goal_to(0.2, 0.2, 1);
  const auto begin = arm.now + std::chrono::seconds(1);
  goal.trajectory.header.stamp = to_message<builtin_interfaces::msg::Time>(begin);
  REQUIRE(arm.send(1, goal).accepted);
  arm.run(900);
  CHECK(arm.reference() == std::vector<double>{0, 0});
  arm.run(500);
  CHECK(arm.reference()[0] > 0.01);
  const auto response = arm.wait_for(1);
  CHECK(response.status == GoalState::succeeded);
  const auto end = arm.now - begin;
  CHECK((end >= std::chrono::milliseconds(990) && end < std::chrono::milliseconds(1100)));
}

TEST_CASE("a goal outside of its path tolerances is aborted with the code of ROS") {
  ActiveArm arm;
  auto goal = goal_to(1, -1, 1);
  goal.path_tolerance = {{.name = shoulder_joint, .position = 1e-7}};
  REQUIRE(arm.send(1, goal).accepted);
  const auto response = arm.wait_for(1);
  CHECK(response.status == GoalState::aborted);
  CHECK(response.result.error_code == Follow::path_tolerance_violated);
  CHECK(response.result.error_string == "Aborted due to path tolerance violation");
}

TEST_CASE("a goal that does not arrive in time is aborted with the code of ROS") {
  ActiveArm arm;
  auto goal = goal_to(1, -1, 1);
  goal.goal_tolerance = {{.name = elbow_joint, .position = 1e-12, .velocity = 1e-12}};
  goal.goal_time_tolerance = {0, 20'000'000};
  REQUIRE(arm.send(1, goal).accepted);
  const auto response = arm.wait_for(1);
  CHECK(response.status == GoalState::aborted);
  CHECK(response.result.error_code == Follow::goal_tolerance_violated);
  CHECK(response.result.error_string.starts_with("Aborted due to goal_time_tolerance"));
}

TEST_CASE("a canceled goal stops the robot") {
  ActiveArm arm;
  REQUIRE(arm.send(1, goal_to(1, -1, 2)).accepted);
  const auto result = arm.result(1);
  arm.run(800);
  const auto canceled = arm.call<Cancel>(action + "cancel_goal");  // all goals
  CHECK(canceled.return_code == Cancel::none);
  REQUIRE(canceled.goals_canceling.size() == 1);
  CHECK(canceled.goals_canceling[0].goal_id.uuid[0] == 1);
  CHECK(
      arm.call<Cancel>(action + "cancel_goal").goals_canceling.empty());  // it is canceled already
  const auto response = arm.reply_to<Get>(result);
  CHECK(response.status == GoalState::canceled);
  CHECK(response.result.error_code == 0);
  arm.run(1000);
  CHECK(arm.loop->port().situation().motion == "rest");
  CHECK(arm.reference()[0] < 0.9);
  Cancel::Request request;
  request.goal_info.goal_id.uuid[0] = 1;
  CHECK(arm.call<Cancel>(action + "cancel_goal", request).return_code == Cancel::goal_terminated);
  request.goal_info.goal_id.uuid[0] = 7;
  CHECK(arm.call<Cancel>(action + "cancel_goal", request).return_code == Cancel::unknown_goal);
}

TEST_CASE("a plan of a planner has up to 1024 points, and the refusal names the limit") {
  ActiveArm arm;
  const auto plan = [](int count) {  // 0.1 s from point to point, as MoveIt's
    Follow::Goal goal;
    goal.trajectory.joint_names = {elbow_joint};
    for (int k = 1; k <= count; ++k) {
      goal.trajectory.points.push_back(
          {.positions = {0.001 * k},
           .time_from_start =
               to_message<builtin_interfaces::msg::Duration>(std::chrono::milliseconds(100) * k)});
    }
    return goal;
  };
  CHECK(arm.send(1, plan(1024)).accepted);
  CHECK_FALSE(arm.send(2, plan(1025)).accepted);
  CHECK(arm.logged("1025 points are more than the capacity, 1024"));
}

TEST_CASE("a goal is answered while the simulation is paused, also with its time") {
  ActiveArm arm({.use_sim_time = true});
  arm.run(500);
  REQUIRE(arm.ask(remote::Pause{true}).verdict == remote::Verdict::done);
  CHECK(arm.send(1, goal_to(0.1, 0.1, 1)).accepted);
  CHECK_FALSE(arm.send(2, goal_to(9, 0, 1)).accepted);
  // The log goes on, too: it has at most some lines a second.
  for (int k = 0; k < 60; ++k) arm.publish("/computed_torque/commands", Numbers{});
  arm.run(1100);
  arm.transport.topics["/rosout"].sent.clear();
  arm.publish("/computed_torque/commands", Numbers{});
  CHECK(arm.logged("is not active"));
  CHECK(arm.call<Cancel>(action + "cancel_goal").goals_canceling.size() == 1);
  CHECK(arm.wait_for(1).status == GoalState::canceled);
}

TEST_CASE("goals are canceled by the time of their acceptance") {
  ActiveArm arm;
  REQUIRE(arm.send(1, goal_to(1, -1, 2)).accepted);
  const auto stamp = [&](std::chrono::nanoseconds time) {
    Cancel::Request request;
    request.goal_info.stamp = to_message<builtin_interfaces::msg::Time>(time);
    return arm.call<Cancel>(action + "cancel_goal", request).goals_canceling.size();
  };
  CHECK(stamp(arm.now - std::chrono::seconds(1)) == 0);
  CHECK(stamp(arm.now) == 1);
}

TEST_CASE("a new goal replaces the last one") {
  ActiveArm arm;
  REQUIRE(arm.send(1, goal_to(1, -1, 2)).accepted);
  arm.run(500);
  CHECK_FALSE(arm.send(2, goal_to(9, -1, 2)).accepted);
  CHECK(arm.status(1) == GoalState::executing);
  REQUIRE(arm.send(3, goal_to(0.5, 0, 2)).accepted);
  const auto old = arm.wait_for(1);
  CHECK(old.status == GoalState::canceled);
  CHECK(old.result.error_code == Follow::invalid_goal);
  CHECK(old.result.error_string == "Current goal cancelled due to new incoming action.");
  CHECK(arm.wait_for(3).status == GoalState::succeeded);
  CHECK(arm.reference() == std::vector<double>{0.5, 0});
}

TEST_CASE("a new goal of a controller ends the one before, also if it is for other joints") {
  ActiveArm arm;
  Follow::Goal shoulder, elbow;
  shoulder.trajectory.joint_names = {shoulder_joint};
  shoulder.trajectory.points = {{.positions = {1}, .time_from_start = {2, 0}}};
  elbow.trajectory.joint_names = {elbow_joint};
  elbow.trajectory.points = {{.positions = {0.5}, .time_from_start = {1, 0}}};
  REQUIRE(arm.send(1, shoulder).accepted);
  arm.run(500);
  REQUIRE(arm.send(2, elbow).accepted);
  const auto old = arm.wait_for(1);
  CHECK(old.status == GoalState::canceled);
  CHECK(old.result.error_string == "Current goal cancelled due to new incoming action.");
  CHECK(arm.wait_for(2).status == GoalState::succeeded);
  CHECK(arm.reference()[0] < 1);
  CHECK(arm.reference()[1] == 0.5);
}

TEST_CASE("goals of two controllers run at once, and a canceled one leaves the other alone") {
  ActiveArm arm({}, support::grouped_arm());
  const auto goal_of = [](const std::string& joint, double position, std::int32_t seconds) {
    Follow::Goal goal;
    goal.trajectory.joint_names = {joint};
    goal.trajectory.points = {{.positions = {position}, .time_from_start = {seconds, 0}}};
    return goal;
  };
  const std::string upper = "/upper/pid_plus_gravity/follow_joint_trajectory/_action/",
                    lower = "/lower/pid_plus_gravity/follow_joint_trajectory/_action/";
  REQUIRE(arm.send(1, goal_of(shoulder_joint, 0.5, 2), upper).accepted);
  arm.run(300);
  REQUIRE(arm.send(2, goal_of(elbow_joint, -0.5, 1), lower).accepted);
  const auto second = arm.wait_for(2, lower);
  CHECK(second.status == GoalState::succeeded);
  REQUIRE(arm.send(3, goal_of(elbow_joint, 0.5, 1), lower).accepted);
  arm.run(200);
  CHECK(arm.call<Cancel>(lower + "cancel_goal").goals_canceling.size() == 1);
  CHECK(arm.wait_for(3, lower).status == GoalState::canceled);
  CHECK(arm.loop->port().situation().joint_motions[0] == "trajectory");
  const auto first = arm.wait_for(1, upper);
  CHECK(first.status == GoalState::succeeded);
  CHECK(arm.reference()[0] == 0.5);
  CHECK(arm.reference()[1] < 0);
}

TEST_CASE("a goal ends with its controller, with the loop, and with another client's motion") {
  ActiveArm arm;
  using Switching = controller_manager_msgs::srv::SwitchController<Jazzy>;
  REQUIRE(arm.send(1, goal_to(1, -1, 2)).accepted);
  Switching::Request switching;
  switching.activate_controllers = {"computed_torque"};
  switching.deactivate_controllers = {"pid_plus_gravity"};
  switching.strictness = Switching::strict;
  REQUIRE(arm.call<Switching>("/controller_manager/switch_controller", switching).ok);
  auto response = arm.wait_for(1);
  CHECK(response.status == GoalState::aborted);
  CHECK(response.result.error_string == "Current goal cancelled during deactivate transition.");
  std::swap(switching.activate_controllers, switching.deactivate_controllers);
  REQUIRE(arm.call<Switching>("/controller_manager/switch_controller", switching).ok);

  REQUIRE(arm.send(2, goal_to(1, -1, 2)).accepted);
  arm.publish(controller + "joint_trajectory", goal_to(0.1, 0.1, 1).trajectory);
  response = arm.wait_for(2);
  CHECK(response.status == GoalState::aborted);
  CHECK(response.result.error_code == Follow::invalid_goal);

  REQUIRE(arm.send(3, goal_to(1, -1, 2)).accepted);
  controller_manager_msgs::srv::SetHardwareComponentState<Jazzy>::Request hardware;
  hardware.name = "q2d";
  hardware.target_state.label = "inactive";
  REQUIRE(arm.call<controller_manager_msgs::srv::SetHardwareComponentState<Jazzy>>(
                 "/controller_manager/set_hardware_component_state", hardware)
              .ok);
  response = arm.wait_for(3);
  CHECK(response.status == GoalState::aborted);
  CHECK(response.result.error_string == "Current goal cancelled during deactivate transition.");
}

TEST_CASE("hundreds of goals leave a bounded list") {
  ActiveArm arm;
  for (int k = 1; k <= 200; ++k) {
    const auto id = static_cast<std::uint8_t>(k);
    CHECK(arm.send(id, goal_to(0.001 * k, 0, 1)).accepted);
  }
  const auto all = arm.transport.last<action_msgs::msg::GoalStatusArray<Jazzy>>(action + "status");
  CHECK(all->status_list.size() <= 64);
  CHECK(arm.wait_for(200).status == GoalState::succeeded);
}

TEST_CASE("a trajectory is published as a message") {
  ActiveArm arm;
  arm.publish(controller + "joint_trajectory", goal_to(0.2, 0.1, 1).trajectory);
  arm.run(1100);
  CHECK(arm.reference() == std::vector<double>{0.2, 0.1});
  auto partial = goal_to(0, 0.3, 1).trajectory;
  partial.joint_names.pop_back();
  partial.points[0].positions.pop_back();
  arm.publish(controller + "joint_trajectory", partial);
  arm.run(1100);
  CHECK(arm.reference() == std::vector<double>{0.2, 0.3});
  CHECK(arm.bridge.dropped().refused == 0);
}

TEST_CASE("references and commands are published, checked, and refused for inactive controllers") {
  ActiveArm arm;
  arm.publish(controller + "reference", Point{.positions = {0.01, 0.02}});
  arm.run(3);
  CHECK(arm.reference() == std::vector<double>{0.01, 0.02});
  arm.publish(controller + "commands", Numbers{.data = {0.03, -0.01}});
  arm.run(3);
  CHECK(arm.reference() == std::vector<double>{0.03, -0.01});
  CHECK(arm.bridge.dropped().refused == 0);

  arm.publish(controller + "commands", Numbers{.data = {0.1}});
  CHECK(arm.logged("commands: 1 numbers for 2 joints"));
  arm.publish(controller + "reference", Point{.positions = {5, 0}});
  arm.run(3);
  CHECK(arm.logged("position 5 rad of joint 'shoulder_active_joint'"));
  arm.publish(controller + "reference", Point{.positions = {std::nan(""), 0}});
  arm.publish("/computed_torque/reference", Point{.positions = {0, 0}});
  CHECK(arm.logged("reference: controller 'computed_torque' is not active"));
  arm.run(3);
  CHECK(arm.bridge.dropped().refused == 4);
  CHECK(arm.reference() == std::vector<double>{0.03, -0.01});
}

TEST_CASE("a reference with a velocity holds until its publisher falls silent") {
  ActiveArm arm;
  arm.publish(controller + "reference", Point{.positions = {0, 0}, .velocities = {0.1, 0}});
  arm.run(900);
  CHECK(arm.loop->port().situation().motion == "set");
  arm.run(200);
  CHECK(arm.loop->port().situation().motion != "set");
  CHECK(arm.logged("the joints stop"));
}

TEST_CASE("commands of a controller without gains are efforts") {
  BridgedArm arm({}, support::bypass_arm());
  arm.publish("/bypass/commands", Numbers{.data = {1, 0.5}});
  arm.run(50);
  const auto state = arm.transport.last<control_msgs::msg::JointTrajectoryControllerState<Jazzy>>(
      "/bypass/controller_state");
  REQUIRE(state);
  CHECK(state->output.effort == std::vector<double>{1, 0.5});
  arm.publish("/bypass/commands", Numbers{.data = {28, 0}});  // above the limit
  arm.run(3);
  CHECK(arm.bridge.dropped().refused == 1);
}

TEST_CASE("a controller of efforts has no goals of positions") {
  BridgedArm arm({}, support::bypass_arm());
  Send::Request request{.goal = goal_to(0.1, 0.1, 1)};
  request.goal_id.uuid[0] = 1;
  CHECK_FALSE(
      arm.call<Send>("/bypass/follow_joint_trajectory/_action/send_goal", request).accepted);
  CHECK(arm.logged("no active controller moves joint 'shoulder_active_joint' to a position"));
  arm.publish("/bypass/joint_trajectory", request.goal.trajectory);
  CHECK(arm.bridge.dropped().refused == 2);
  for (int k = 0; k < 100; ++k) {
    arm.publish("/bypass/reference", Point{.positions = {0.1, 0.1}});
    arm.run(3);
  }
  CHECK(arm.count_logged("the reference moves, but no active controller moves to it: "
                         "'shoulder_active_joint', 'elbow_active_joint'") == 1);
}

TEST_CASE("a trajectory that takes no time is refused") {
  ActiveArm arm;
  CHECK_FALSE(arm.send(1, goal_to(0.1, 0.1, 0)).accepted);
  CHECK(arm.logged("trajectory: time_from_start of the last point is 0 s: give the motion a time"));
}

TEST_CASE("the log has a refusal once") {
  ActiveArm arm;
  arm.publish(controller + "joint_trajectory", goal_to(9, 0, 1).trajectory);
  arm.run(10);
  CHECK(arm.count_logged("position 9") == 1);
}

TEST_CASE("the state of a controller has reference, measurement and error") {
  ActiveArm arm;
  arm.publish(controller + "commands", Numbers{.data = {0.02, 0.01}});
  arm.run(1000);
  const std::string topic = controller + "controller_state";
  const auto state =
      arm.transport.last<control_msgs::msg::JointTrajectoryControllerState<Jazzy>>(topic);
  REQUIRE(state);
  CHECK(state->joint_names == std::vector<std::string>{shoulder_joint, elbow_joint});
  CHECK(state->reference.positions == std::vector<double>{0.02, 0.01});
  CHECK(std::abs(state->feedback.positions[0] - 0.02) < 1e-3);
  CHECK(state->error.positions[0] == 0.02 - state->feedback.positions[0]);
  CHECK(state->output.effort.size() == 2);
  CHECK(state->speed_scaling_factor == 1);
  CHECK(arm.transport.topics["/computed_torque/controller_state"].count == 0);  // it is inactive
}

TEST_CASE("the reference of the past and of the trajectory to come is asked for") {
  using Query = control_msgs::srv::QueryTrajectoryState<Jazzy>;
  ActiveArm arm;
  arm.run(100);
  REQUIRE(arm.send(1, goal_to(0.5, 0, 1)).accepted);
  const auto begin = arm.now;
  REQUIRE(arm.wait_for(1).status == GoalState::succeeded);
  const auto at = [&](std::chrono::nanoseconds time) {
    return arm.call<Query>(controller + "query_state",
                           {.time = to_message<builtin_interfaces::msg::Time>(time)});
  };
  const auto half = at(begin + std::chrono::milliseconds(500));
  REQUIRE(half.success);
  CHECK(half.name.size() == 2);
  CHECK(std::abs(half.position[0] - 0.25) < 0.02);
  CHECK(half.velocity[0] > 0.3);
  CHECK_FALSE(at(begin - std::chrono::seconds(100)).success);
  const auto rest = at(arm.now + std::chrono::seconds(1));
  CHECK(rest.success);
  REQUIRE(rest.position.size() == 2);
  // The rounding of a polynomial's last value, whose coefficients are ten times as large.
  CHECK(std::abs(rest.position[0] - 0.5) < 1e-14);
  CHECK(std::abs(rest.position[1]) < 1e-14);

  // The second half of a trajectory, before it has been followed and after.
  REQUIRE(arm.send(2, goal_to(-0.5, 0.2, 1)).accepted);
  arm.run(500);
  const auto later = arm.now + std::chrono::milliseconds(250);
  const auto planned = at(later);
  REQUIRE(planned.success);
  CHECK(planned.name.size() == 2);
  arm.run(400);
  const auto past = at(later);
  REQUIRE(past.success);
  for (std::size_t j = 0; j < 2; ++j) {
    CHECK(planned.velocity[j] != 0);
    // A time of ROS has nanoseconds, at which joints move by less than these numbers.
    CHECK(std::abs(planned.position[j] - past.position[j]) < 1e-8);
    CHECK(std::abs(planned.velocity[j] - past.velocity[j]) < 1e-7);
    CHECK(std::abs(planned.acceleration[j] - past.acceleration[j]) < 1e-6);
  }
  CHECK(arm.wait_for(2).status == GoalState::succeeded);

  Follow::Goal waiting = goal_to(0, 0, 1);
  waiting.trajectory.header.stamp =
      to_message<builtin_interfaces::msg::Time>(arm.now + std::chrono::seconds(1));
  REQUIRE(arm.send(3, waiting).accepted);
  arm.run(20);
  const auto unknown = at(arm.now + std::chrono::milliseconds(50));
  CHECK_FALSE(unknown.success);
  CHECK(unknown.message ==
        "joint " + std::string(shoulder_joint) +
            " does not rest, and its motion is none of a trajectory that has begun");
}

TEST_CASE(
    "the present is asked for between two cycles, and the loop has made more than are known") {
  using Query = control_msgs::srv::QueryTrajectoryState<Jazzy>;
  ActiveArm arm;
  arm.run(100);
  const auto at = [&](std::chrono::nanoseconds time) {
    return arm.call<Query>(controller + "query_state",
                           {.time = to_message<builtin_interfaces::msg::Time>(time)});
  };
  for (const int late : {-1, 0, 1, 3}) {
    CAPTURE(late);
    arm.loop->cycles(3);  // of which the bridge does not know yet
    const auto rest = at(arm.now + std::chrono::milliseconds(late));
    CHECK(rest.success);
    CHECK(rest.velocity == std::vector<double>{0, 0});
  }
  // The present of another motion is its last reference; its future is not known.
  arm.publish(controller + "reference", trajectory_msgs::msg::JointTrajectoryPoint<Jazzy>{
                                            .positions = {0, 0}, .velocities = {0.1, 0}});
  arm.run(5);
  const auto now = at(arm.now + std::chrono::milliseconds(2));
  CHECK(now.success);
  CHECK(now.velocity == std::vector<double>{0.1, 0});
  CHECK_FALSE(at(arm.now + std::chrono::seconds(1)).success);
}

TEST_CASE("a goal for a loop that has made no cycle waits for one") {
  support::MemoryTransport transport;
  const auto loop = support::plain_arm();
  BridgeNodes bridge(loop->port(), transport, {});
  std::chrono::nanoseconds now{1'700'000'000'000'000'000};
  const auto run = [&](int milliseconds, int cycles) {
    for (int k = 0; k < milliseconds; ++k) {
      loop->cycles(cycles);
      bridge.update(now += std::chrono::milliseconds(1));
    }
  };
  run(1, 0);
  Send::Request request{.goal = goal_to(0.1, 0.1, 1)};
  request.goal_id.uuid[0] = 1;
  const auto reply = transport.request(action + "send_goal", support::bytes_of(request));
  run(300, 0);
  CHECK(transport.topics[action + "feedback"].count == 0);
  run(300, 1);
  Send::Response response;
  REQUIRE(decode(*reply, response) == CdrError::none);
  CHECK(response.accepted);
  const auto feedback = transport.last<FeedbackMessage<Follow>>(action + "feedback");
  REQUIRE(feedback);
  CHECK(feedback->feedback.actual.positions.size() == 2);
}

TEST_CASE("a controller's joints keep the order of the options") {
  const std::vector<std::string> joints{elbow_joint, shoulder_joint};
  ActiveArm arm({.controllers = {{"pid_plus_gravity", {.joints = joints}}}});
  REQUIRE(arm.send(1, goal_to(0.3, -0.2, 1)).accepted);
  REQUIRE(arm.wait_for(1).status == GoalState::succeeded);
  arm.run(50);
  const auto feedback = arm.transport.last<FeedbackMessage<Follow>>(action + "feedback");
  REQUIRE(feedback);
  CHECK(feedback->feedback.joint_names == joints);
  CHECK(feedback->feedback.desired.positions[0] < -0.1);
  const auto state = arm.transport.last<control_msgs::msg::JointTrajectoryControllerState<Jazzy>>(
      controller + "controller_state");
  REQUIRE(state);
  CHECK(state->joint_names == joints);
  CHECK(state->reference.positions == std::vector<double>{-0.2, 0.3});
  const auto asked = arm.call<control_msgs::srv::QueryTrajectoryState<Jazzy>>(
      controller + "query_state", {.time = to_message<builtin_interfaces::msg::Time>(arm.now)});
  REQUIRE(asked.success);
  CHECK(asked.name == joints);
  CHECK(asked.position == std::vector<double>{-0.2, 0.3});
  arm.publish(controller + "commands", Numbers{.data = {-0.19, 0.31}});
  arm.run(5);
  CHECK(arm.reference() == std::vector<double>{0.31, -0.19});

  CHECK_THROWS_WITH(
      BridgedArm({.controllers = {{"pid_plus_gravity", {.joints = {"knee"}}}}}),
      "ros2: controller 'pid_plus_gravity' has the joint 'knee', which robot 'q2d' does not have");
}

TEST_CASE("the error of a continuous joint is less than a half turn") {
  remote::RobotSheet robot{.joints = {{.name = "wheel", .type = JointType::continuous}, {}}};
  remote::Cycle cycle;
  cycle.position = {0.1, 0.1};
  cycle.reference_position = {2 * std::numbers::pi + 0.2, 2 * std::numbers::pi + 0.2};
  cycle.velocity = cycle.reference_velocity = cycle.reference_acceleration = {0, 0};
  const auto error = points_of(cycle, {0, 1}, robot).error.positions;
  CHECK(std::abs(error[0] - 0.1) < 1e-12);
  CHECK(std::abs(error[1] - 2 * std::numbers::pi - 0.1) < 1e-12);
}

TEST_CASE("Rolling's goals give feedback in its layout") {
  using Rolled = control_msgs::action::FollowJointTrajectory<Rolling>;
  ActiveArm arm({.distribution = Distribution::rolling});
  REQUIRE(arm.send(1, goal_to(0.1, 0, 1)).accepted);
  arm.run(500);
  const auto feedback = arm.transport.last<FeedbackMessage<Rolled>>(action + "feedback");
  REQUIRE(feedback);
  CHECK(feedback->feedback.joint_names.size() == 2);
}

TEST_CASE("a reference with a velocity stops only the motion that it began") {
  ActiveArm arm;
  const auto turn_by = [&](double velocity) {
    arm.publish(controller + "reference", Point{.velocities = {velocity, 0}});
    arm.run(5);
  };
  turn_by(0.1);
  REQUIRE(arm.send(1, goal_to(0.3, -0.2, 2)).accepted);  // instead of the reference
  CHECK(arm.wait_for(1).status == GoalState::succeeded);

  arm.run(2000);  // ROS has released the controls
  const auto window = arm.loop->port().connect("window", true);
  REQUIRE(window->take_controls().empty());
  window->ask(remote::Go{.positions = {{shoulder_joint, -0.3}}, .speed = 0.2});
  arm.run(5);
  turn_by(0.1);  // refused: the window has the controls
  CHECK(arm.logged("window"));
  for (int k = 0; k < 4000 && arm.reference()[0] > -0.3; ++k) window->keep_alive();
  CHECK(arm.reference()[0] == -0.3);
}

TEST_CASE("trajectories are slowed down by a factor, which the state shows") {
  ActiveArm arm;
  const std::string topic = controller + "speed_scaling_input";
  CHECK(arm.transport.topics.at(topic).endpoint.quality.transient_local);
  const auto set = [&](double factor) {
    arm.publish(topic, control_msgs::msg::SpeedScalingFactor{factor});
    arm.run(50);
    return arm.transport
        .last<control_msgs::msg::JointTrajectoryControllerState<Jazzy>>(controller +
                                                                        "controller_state")
        ->speed_scaling_factor;
  };
  CHECK(set(1.5) == 1);
  CHECK(arm.logged("trajectory speed: factor 1.5 is not within 0 .. 1"));
  CHECK(set(0.5) == 0.5);
  REQUIRE(arm.send(1, goal_to(0.3, -0.2, 1)).accepted);
  const auto begin = arm.now;
  CHECK(arm.wait_for(1).status == GoalState::succeeded);
  const auto took = arm.now - begin;
  // 2 s, or 0.125 s less if the speed falls only when the trajectory begins: from 1 by 2 in a
  // second.
  CHECK((took > std::chrono::milliseconds(1850) && took < std::chrono::milliseconds(2200)));
  CHECK(set(0) == 0);
  REQUIRE(arm.send(2, goal_to(0, 0, 1)).accepted);
  arm.run(3000);
  CHECK(arm.status(2) == GoalState::executing);
  CHECK(set(1) == 1);
  CHECK(arm.wait_for(2).status == GoalState::succeeded);
}

TEST_CASE("a joint is commanded by a number") {
  ActiveArm arm;
  arm.publish(controller + elbow_joint + "/command", std_msgs::msg::Float64{0.02});
  arm.run(3);
  CHECK(arm.reference() == std::vector<double>{0, 0.02});
  arm.publish("/computed_torque/" + elbow_joint + "/command", std_msgs::msg::Float64{0.02});
  CHECK(arm.logged("command: controller 'computed_torque' is not active"));
}

TEST_CASE("the velocity of a joint ends, whatever other joints are told") {
  ActiveArm arm({.controllers = {{"pid_plus_gravity", {.command_quantity = "velocity"}}}});
  arm.publish(controller + shoulder_joint + "/command", std_msgs::msg::Float64{0.1});
  arm.run(100);
  CHECK(arm.loop->port().situation().joint_motions[0] == "set");
  for (int k = 0; k < 8; ++k) {
    arm.publish(controller + elbow_joint + "/command", std_msgs::msg::Float64{0});
    arm.run(200);
  }
  CHECK(arm.loop->port().situation().joint_motions[0] == "rest");
  CHECK(arm.logged("no reference has followed one with a velocity: the joints stop"));
}
