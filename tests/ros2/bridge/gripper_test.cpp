// SPDX-License-Identifier: Apache-2.0
// ROS 2's clients open and close a gripper. The elbow of the Q2D is its joint.
#include "articula/ros2/messages/action_msgs.hpp"
#include "articula/ros2/messages/control_msgs.hpp"
#include "articula/ros2/messages/controller_manager_msgs.hpp"
#include "articula/ros2/messages/rcl_interfaces.hpp"

#include "bridged_arm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

using namespace articula;
using namespace articula::ros2;
using support::BridgedArm;
using support::elbow_joint;

namespace {

using GoalState = action_msgs::msg::GoalStatus;
using Simple = control_msgs::action::GripperCommand<Jazzy>;
using Parallel = control_msgs::action::ParallelGripperCommand<Jazzy>;
const std::string simple_type = "position_controllers/GripperActionController",
                  parallel_type = "parallel_gripper_action_controller/GripperActionController",
                  action = "/pid_plus_gravity/gripper_cmd/_action/";

/// An active arm with a gripper.
template <class Type>
struct Gripper : BridgedArm {
  explicit Gripper(const GripperOptions& options = {.joint = elbow_joint})
      : BridgedArm(
            {.controllers = {{"pid_plus_gravity",
                              {.type = std::is_same_v<Type, Simple> ? simple_type : parallel_type,
                               .gripper = options}}}}) {
    REQUIRE(ask(remote::Activate{}).verdict == remote::Verdict::done);
  }

  bool send(std::uint8_t id, const typename Type::Goal& goal) {
    typename SendGoal<Type>::Request request{.goal = goal};
    request.goal_id.uuid[0] = id;
    return call<SendGoal<Type>>(action + "send_goal", request).accepted;
  }
  typename GetResult<Type>::Response wait_for(std::uint8_t id) {
    typename GetResult<Type>::Request request;
    request.goal_id.uuid[0] = id;
    return reply_to<GetResult<Type>>(
        transport.request(action + "get_result", support::bytes_of(request)), 5000);
  }
  auto cancel_all() {
    return call<action_msgs::srv::CancelGoal<Jazzy>>(action + "cancel_goal").goals_canceling.size();
  }
  /// The elbow holds nothing any more, as one that an object blocks does not move.
  void let_go() {
    remote::SetParameters none;
    for (const char* gain : {"p", "i", "d"}) {
      none.values.push_back({"pid_plus_gravity." + elbow_joint + "." + gain, 0});
    }
    REQUIRE(ask(none).verdict == remote::Verdict::done);
  }
};

Simple::Goal to(double position, double max_effort = 0) { return {{position, max_effort}}; }

}  // namespace

TEST_CASE("a gripper reaches its goal, and nothing else of its controller is offered") {
  Gripper<Simple> arm;
  CHECK_FALSE(arm.transport.services.contains(
      "/pid_plus_gravity/follow_joint_trajectory/_action/send_goal"));
  REQUIRE(arm.send(1, to(0.3)));
  arm.run(200);
  const auto feedback = arm.transport.last<FeedbackMessage<Simple>>(action + "feedback");
  REQUIRE(feedback);
  CHECK(feedback->feedback.position > 0);
  const auto response = arm.wait_for(1);
  CHECK(response.status == GoalState::succeeded);
  CHECK(response.result.reached_goal);
  CHECK_FALSE(response.result.stalled);
  CHECK(std::abs(response.result.position - 0.3) < 0.01);  // goal_tolerance
  CHECK(arm.send(2, to(0.305)));                           // where it is
  CHECK(arm.wait_for(2).result.reached_goal);
}

TEST_CASE("a gripper that is blocked has stalled, which is a success only if that is allowed") {
  const auto close = [](bool allow_stalling) {
    Gripper<Simple> arm({.joint = elbow_joint, .allow_stalling = allow_stalling});
    arm.let_go();
    REQUIRE(arm.send(1, to(0.3)));
    arm.run(900);
    CHECK(arm.transport.last<action_msgs::msg::GoalStatusArray<Jazzy>>(action + "status")
              ->status_list[0]
              .status == GoalState::executing);
    return arm.wait_for(1);
  };
  const auto aborted = close(false);
  CHECK(aborted.status == GoalState::aborted);
  CHECK(aborted.result.stalled);
  CHECK_FALSE(aborted.result.reached_goal);
  CHECK(std::abs(aborted.result.position) < 0.1);
  const auto succeeded = close(true);
  CHECK(succeeded.status == GoalState::succeeded);
  CHECK(succeeded.result.stalled);
}

TEST_CASE("goals of a gripper that cannot be are rejected, and the log says why") {
  Gripper<Simple> arm;
  const auto rejected = [&](const Simple::Goal& goal, const std::string& words) {
    CHECK_FALSE(arm.send(1, goal));
    INFO(words);
    CHECK(arm.logged(words));
  };
  rejected(to(0.3, 5),
           "max_effort 5 is below the limit of joint 'elbow_active_joint', 13.62, and the loop has "
           "no limit for one goal: send 0");
  rejected(to(0.3, -1), "max_effort -1 is not a finite number >= 0");
  rejected(to(3), "position 3 rad of joint 'elbow_active_joint' is not within");
  rejected(to(std::numeric_limits<double>::quiet_NaN()), "position nan");
  CHECK(arm.send(1, to(0.1, 20)));  // the joint has no more than 13.62 anyway
}

TEST_CASE("a canceled goal leaves the gripper where it is, and a new one replaces the last") {
  Gripper<Simple> arm;
  REQUIRE(arm.send(1, to(1)));
  REQUIRE(arm.send(2, to(0.5)));
  CHECK(arm.wait_for(1).status == GoalState::canceled);
  CHECK(arm.wait_for(2).result.reached_goal);
  REQUIRE(arm.send(3, to(-1)));
  arm.run(100);
  CHECK(arm.cancel_all() == 1);
  const auto canceled = arm.wait_for(3);
  CHECK(canceled.status == GoalState::canceled);
  CHECK_FALSE(canceled.result.reached_goal);
  arm.run(2000);
  CHECK(arm.loop->port().situation().motion == "rest");
  // It came back to where it was at the cancelation, within what it moved until then.
  REQUIRE(arm.send(4, to(canceled.result.position)));
  CHECK(arm.wait_for(4).result.reached_goal);
}

TEST_CASE("another motion, and the end of its controller, end a gripper's goal") {
  Gripper<Simple> arm;
  REQUIRE(arm.send(1, to(1)));
  arm.run(100);
  CHECK(arm.ask(remote::Stop{}).verdict == remote::Verdict::done);
  const auto replaced = arm.wait_for(1);
  CHECK(replaced.status == GoalState::aborted);
  CHECK_FALSE(replaced.result.stalled);
  CHECK(arm.logged("another motion than the goal's moves joint 'elbow_active_joint'"));
  REQUIRE(arm.send(2, to(-1)));
  arm.run(100);
  controller_manager_msgs::srv::SetHardwareComponentState<Jazzy>::Request hardware;
  hardware.name = "q2d";
  hardware.target_state.label = "inactive";
  CHECK(arm.call<controller_manager_msgs::srv::SetHardwareComponentState<Jazzy>>(
               "/controller_manager/set_hardware_component_state", hardware)
            .ok);
  CHECK(arm.wait_for(2).status == GoalState::aborted);
  CHECK(arm.logged("goal: the controller is not active any more"));
  CHECK_FALSE(arm.send(3, to(0)));
  CHECK(arm.logged("Controller is not running"));
}

TEST_CASE("a parallel gripper has its own action, with a velocity") {
  Gripper<Parallel> arm;
  Parallel::Goal goal;
  CHECK_FALSE(arm.send(1, goal));
  CHECK(arm.logged("Received action goal with wrong number of position values, expects 1, got 0"));
  goal.command.name = {"knee"};
  goal.command.position = {0.3};
  CHECK_FALSE(arm.send(1, goal));
  CHECK(arm.logged("Incoming joint knee doesn't match the gripper's joint, elbow_active_joint"));
  goal.command.name = {elbow_joint};
  goal.command.velocity = {0.3};
  REQUIRE(arm.send(1, goal));
  const auto begin = arm.now;
  const auto response = arm.wait_for(1);
  CHECK(response.status == GoalState::succeeded);
  CHECK(response.result.reached_goal);
  CHECK(response.result.state.name == std::vector<std::string>{elbow_joint});
  CHECK(response.result.state.position.size() == 1);
  CHECK(response.result.state.effort.size() == 1);
  CHECK(arm.now - begin > std::chrono::milliseconds(900));  // 0.3 rad at 0.3 rad/s
}

TEST_CASE("tolerances of a gripper are parameters") {
  Gripper<Simple> arm;
  using Set = rcl_interfaces::srv::SetParameters<Jazzy>;
  const auto set = [&](double value) {
    rcl_interfaces::msg::Parameter<Jazzy> tolerance;
    tolerance.name = "goal_tolerance";
    tolerance.value.type = rcl_interfaces::msg::ParameterType::floating_point;
    tolerance.value.double_value = value;
    Set::Request request;
    request.parameters = {tolerance};
    return arm.call<Set>("/pid_plus_gravity/set_parameters", request).results[0].successful;
  };
  CHECK_FALSE(set(-1));
  CHECK(set(2));
  REQUIRE(arm.send(1, to(1)));
  CHECK(arm.wait_for(1).result.position < 0.5);  // within the tolerance from the beginning
}

TEST_CASE("a gripper that no controller moves to a position has no goals") {
  BridgedArm arm(
      {.controllers = {{"bypass", {.type = simple_type, .gripper = {.joint = elbow_joint}}}}},
      support::bypass_arm());
  SendGoal<Simple>::Request request{.goal = to(0.2)};
  CHECK_FALSE(
      arm.call<SendGoal<Simple>>("/bypass/gripper_cmd/_action/send_goal", request).accepted);
  CHECK(arm.logged("no active controller moves joint 'elbow_active_joint' to a position"));
}
