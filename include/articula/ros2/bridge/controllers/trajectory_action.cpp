// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/bridge/controllers/trajectory_action.hpp"

#include "articula/ros2/bridge/controllers/trajectory_check.hpp"
#include "articula/ros2/bridge/controllers/trajectory_messages.hpp"
#include "articula/ros2/node/action_server.hpp"
#include "articula/ros2/node/periodic.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace articula::ros2 {

namespace {

template <class Layout>
class Action final : public ControllerAction {
 public:
  using Type = control_msgs::action::FollowJointTrajectory<Layout>;
  using Server = ActionServer<Type>;
  using Status = typename Server::Status;
  using Goal = typename Server::Goal;

  Action(BridgeCore& core, const Node& node, const BridgedController& controller)
      : core_(core),
        controller_(controller),
        server_(node, "~/follow_joint_trajectory", to_duration(core.options.result_lifetime),
                {.on_goal = [this](const GoalId& id, const Goal& goal) { begin(id, goal); },
                 .on_cancel = [this](const GoalId& id) { return cancel(id); }}),
        feedback_due_(core.options.feedback_rate) {}

  void update() override {
    server_.update();
    for (auto& [id, own] : running_) {
      // The loop has refused by now what it does not begin.
      const auto passed = core_.context.wall - own.asked;
      const bool begun = core_.watch.cycle.number >= own.first_cycle + 3 ||
                         passed > std::chrono::milliseconds(100) ||
                         passed < std::chrono::milliseconds(0);  // the clock was set
      if (begun && !own.accepted) accept(id, own);
    }
    if (running_.empty()) return;
    if (!core_.watch.is_active(controller_.name)) return leave();
    if (core_.watch.has_cycle && feedback_due_.due(core_.context.now)) publish_feedback();
  }

 private:
  struct Running {
    std::uint64_t order = 0;            ///< of its coming
    std::uint64_t first_cycle = 0;      ///< the last one before it was asked for
    std::chrono::nanoseconds asked{0};  ///< by the wall's clock, which no pause stops
    bool accepted = false;
    bool canceling = false;
    bool left = false;      ///< its controller was deactivated
    bool replaced = false;  ///< by a newer one
    std::vector<std::string> joints{};
  };

  void reject(const GoalId& id, const std::string& reason) {
    core_.log.refuse(controller_.node, reason);
    server_.reject(id);
  }

  void begin(const GoalId& id, const Goal& goal) {
    if (!core_.watch.is_active(controller_.name)) {
      return reject(id, "Can't accept new action goals. Controller is not running.");
    }
    const auto& joints = goal.trajectory.joint_names;
    const std::string reason = refusal_of_motion(core_.watch, controller_, joints);
    if (!reason.empty()) return reject(id, reason);
    remote::PlayTrajectory request =
        to_request(goal.trajectory, core_.context.now, core_.watch.speed());
    request.path_tolerances = to_request(goal.path_tolerance);
    request.goal_tolerances = to_request(goal.goal_tolerance);
    const double goal_time = seconds_of(goal.goal_time_tolerance);
    request.goal_time = goal_time < 0 ? -1 : goal_time;
    controller_.constraints.complete(request, controller_.joints);
    running_[id] = {.order = ++last_order_,
                    .first_cycle = core_.watch.cycle.number,
                    .asked = core_.context.wall,
                    .joints = joints};
    core_.loop_operator.ask(request, [this, id](const remote::Answer& answer) { end(id, answer); });
  }

  void accept(const GoalId& id, Running& own) {
    own.accepted = true;
    server_.accept(id);
    // A controller has one goal. The loop has ended those with one of its joints.
    for (auto& [other, older] : running_) {
      if (older.order >= own.order) continue;
      older.replaced = true;
      std::vector<std::string> rest;
      std::ranges::copy_if(older.joints, std::back_inserter(rest), [&](const auto& joint) {
        return std::ranges::find(own.joints, joint) == own.joints.end();
      });
      if (!rest.empty()) core_.stop(controller_.node, rest);
    }
  }

  bool cancel(const GoalId& id) {
    const auto found = running_.find(id);
    if (found == running_.end()) return false;
    found->second.canceling = true;
    const auto& joints = found->second.joints;
    core_.stop(controller_.node, joints.empty() ? controller_.joints : joints);
    return true;
  }

  /// The controller is not active any more.
  void leave() {
    for (auto& [id, own] : running_) {
      if (std::exchange(own.left, true) || core_.watch.situation.mode != LoopMode::active) continue;
      core_.stop(controller_.node, controller_.joints);
    }
  }

  /// The loop has answered: the trajectory was refused or has ended.
  void end(const GoalId& id, const remote::Answer& answer) {
    using enum TrajectoryOutcome;
    const auto found = running_.find(id);
    if (found == running_.end()) return;
    if (answer.verdict == remote::Verdict::refused && !found->second.accepted) {
      running_.erase(found);
      return reject(id, answer.text);
    }
    if (!found->second.accepted) accept(id, found->second);
    const Running own = found->second;
    running_.erase(found);
    const auto is_newer = [&](const auto& other) { return other.second.order > own.order; };
    const bool is_replaced = own.replaced || std::ranges::any_of(running_, is_newer);
    if (answer.verdict == remote::Verdict::done) {
      return server_.end(id, Status::succeeded, {Type::successful, "Goal successfully reached!"});
    }
    if (own.canceling) return server_.end(id, Status::canceled, {});
    if (answer.outcome == path_tolerance_violated) {
      return abort(id, Type::path_tolerance_violated, "Aborted due to path tolerance violation");
    }
    if (answer.outcome == goal_tolerance_violated) {
      return abort(id, Type::goal_tolerance_violated,
                   "Aborted due to goal_time_tolerance: " + answer.text);
    }
    if (answer.outcome < successful) {
      return abort(id, static_cast<std::int32_t>(answer.outcome), answer.text);
    }
    if (is_replaced) {
      return server_.end(
          id, Status::canceled,
          {Type::invalid_goal, "Current goal cancelled due to new incoming action."});
    }
    if (own.left || core_.port.situation().mode == LoopMode::inactive) {
      // As ros2_controllers has it since its pull request 1517.
      return abort(id, Type::invalid_goal, "Current goal cancelled during deactivate transition.");
    }
    abort(id, Type::invalid_goal, answer.text);
  }
  void abort(const GoalId& id, std::int32_t code, const std::string& reason) {
    core_.log.write(RosLog::Line::warn, controller_.node, "goal: " + reason);
    server_.end(id, Status::aborted, {code, reason});
  }

  void publish_feedback() {
    const CyclePoints points =
        points_of(core_.watch.cycle, controller_.indices, core_.port.robot());
    const auto convert = [](const TrajectoryPointMessage& from) {
      return trajectory_msgs::msg::JointTrajectoryPoint<Layout>{
          from.positions, from.velocities, from.accelerations, from.effort, from.time_from_start};
    };
    for (const auto& [id, own] : running_) {
      if (!own.accepted) continue;
      typename Server::Feedback feedback;
      feedback.header = {core_.header().stamp, {}};
      feedback.joint_names = controller_.joints;
      feedback.desired = convert(points.reference);
      feedback.actual = convert(points.measured);
      feedback.error = convert(points.error);
      server_.feed_back(id, std::move(feedback));
    }
  }

  BridgeCore& core_;
  const BridgedController& controller_;
  Server server_;
  Periodic feedback_due_;
  std::map<GoalId, Running> running_{};
  std::uint64_t last_order_ = 0;
};

}  // namespace

std::unique_ptr<ControllerAction> make_trajectory_action(BridgeCore& core, const Node& node,
                                                         const BridgedController& controller) {
  // The layouts of Humble and Jazzy are the same.
  if (core.options.distribution == Distribution::rolling) {
    return std::make_unique<Action<Rolling>>(core, node, controller);
  }
  return std::make_unique<Action<Jazzy>>(core, node, controller);
}

}  // namespace articula::ros2
