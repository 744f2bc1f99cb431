// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/bridge/controllers/gripper_action.hpp"

#include "articula/core/finite.hpp"
#include "articula/ros2/bridge/controllers/trajectory_check.hpp"
#include "articula/ros2/messages/control_msgs.hpp"
#include "articula/ros2/node/action_server.hpp"
#include "articula/ros2/node/periodic.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::ros2 {

namespace {

using SimpleGripper = control_msgs::action::GripperCommand<Jazzy>;  // the same in all distributions
using ParallelGripper = control_msgs::action::ParallelGripperCommand<Jazzy>;

/// What a joint does.
struct GripperState {
  std::string joint{};
  double position = 0;  ///< [rad or m]
  double velocity = 0;  ///< [rad/s or m/s]
  double effort = 0;    ///< [N m or N]
};

sensor_msgs::msg::JointState<Jazzy> to_command(const SimpleGripper::Goal& goal) {
  sensor_msgs::msg::JointState<Jazzy> command;
  command.position = {goal.command.position};
  command.effort = {goal.command.max_effort};
  return command;
}
const sensor_msgs::msg::JointState<Jazzy>& to_command(const ParallelGripper::Goal& goal) {
  return goal.command;
}

void put_state(SimpleGripper::Feedback& feedback, const GripperState& own,
               const std_msgs::msg::Header<Jazzy>&) {
  feedback.position = own.position;
  feedback.effort = own.effort;
}
void put_state(SimpleGripper::Result& result, const GripperState& own,
               const std_msgs::msg::Header<Jazzy>&) {
  result.position = own.position;
  result.effort = own.effort;
}
/// Of ParallelGripperCommand.
template <class Message>
void put_state(Message& message, const GripperState& own,
               const std_msgs::msg::Header<Jazzy>& header) {
  message.state = {header, {own.joint}, {own.position}, {own.velocity}, {own.effort}};
}

template <class Type>
class GripperAction final : public ControllerAction {
 public:
  using Server = ActionServer<Type>;
  using Status = typename Server::Status;
  using Goal = typename Server::Goal;

  GripperAction(BridgeCore& core, const Node& node, const BridgedController& controller)
      : core_(core),
        controller_(controller),
        options_(*controller.gripper),
        joint_(controller.indices.front()),
        server_(node, "~/gripper_cmd", to_duration(core.options.result_lifetime),
                {.on_goal = [this](const GoalId& id, const Goal& goal) { begin(id, goal); },
                 .on_cancel = [this](const GoalId& id) { return cancel(id); }}),
        feedback_due_(core.options.feedback_rate) {}

  void update() override {
    server_.update();
    if (!running_ || running_->canceling) return;
    const LoopWatch& watch = core_.watch;
    if (!watch.is_active(controller_.name)) {
      if (watch.situation.mode == LoopMode::active) core_.stop(controller_.node, {options_.joint});
      core_.log.write(RosLog::Line::warn, controller_.node,
                      "goal: the controller is not active any more");
      return end(Status::aborted);
    }
    if (!watch.has_new_cycle(running_->cycle)) return;
    running_->cycle = watch.cycle.number;
    const GripperState now = measured();
    const double time = watch.cycle.time;
    if (std::abs(running_->position - now.position) < options_.goal_tolerance) {
      return end(Status::succeeded, {.reached_goal = true});
    }
    if (is_replaced()) {
      core_.log.write(RosLog::Line::warn, controller_.node,
                      "another motion than the goal's moves joint '" + options_.joint + "'");
      return end(Status::aborted);
    }
    const bool moves = std::abs(now.velocity) > options_.stall_velocity_threshold;
    if (moves || time < running_->moved) running_->moved = time;
    if (time - running_->moved > options_.stall_timeout) {
      return end(options_.allow_stalling ? Status::succeeded : Status::aborted, {.stalled = true});
    }
    if (!feedback_due_.due(core_.context.now)) return;
    typename Server::Feedback feedback;
    put_state(feedback, now, core_.header());
    server_.feed_back(running_->id, std::move(feedback));
  }

 private:
  struct Running {
    GoalId id{};
    double position = 0;                       ///< of the goal [rad or m]
    double moved = 0;                          ///< when the joint did, on the loop's clock [s]
    std::optional<std::uint64_t> cycle{};      ///< the last one that was looked at
    std::optional<std::uint64_t> elsewhere{};  ///< since when another motion moves the joint
    bool canceling = false;
  };
  struct End {
    bool stalled = false;
    bool reached_goal = false;
  };

  [[nodiscard]] const remote::SheetJoint& joint() const {
    return core_.port.robot().joints[joint_];
  }
  [[nodiscard]] GripperState measured() const {
    if (!core_.watch.has_cycle) return {options_.joint};
    const remote::Cycle& cycle = core_.watch.cycle;
    return {options_.joint, cycle.position[joint_], cycle.velocity[joint_], cycle.effort[joint_]};
  }

  void reject(const GoalId& id, const std::string& reason) {
    core_.log.refuse(controller_.node, reason);
    server_.reject(id);
  }

  void begin(const GoalId& id, const Goal& goal) {
    if (!core_.watch.is_active(controller_.name)) {
      return reject(id, "Can't accept new action goals. Controller is not running.");
    }
    if (std::string reason = refusal_of_motion(core_.watch, controller_, {}); !reason.empty()) {
      return reject(id, reason);
    }
    const auto& command = to_command(goal);
    if (command.position.size() != 1) {
      return reject(id,
                    "Received action goal with wrong number of position values, expects 1, got " +
                        std::to_string(command.position.size()));
    }
    if (const std::string reason = refusal_of(command); !reason.empty()) return reject(id, reason);
    remote::Go go{.positions = {{options_.joint, command.position[0]}}};
    if (!command.velocity.empty() && command.velocity[0] > 0) {
      // A motion has at least a hundredth of the joint's velocity. A joint without a limit moves by
      // the port's own.
      const double most = joint().limits.velocity;
      if (is_finite(most)) go.speed = std::clamp(command.velocity[0] / most, 0.01, 1.0);
    }
    core_.loop_operator.ask(
        go, [this, id, position = command.position[0]](const remote::Answer& answer) {
          if (answer.verdict != remote::Verdict::done) return reject(id, answer.text);
          if (running_) end(Status::canceled);  // the new goal replaces it
          running_ = {.id = id, .position = position, .moved = core_.watch.cycle.time};
          server_.accept(id);
        });
  }

  /// Why a command is refused; empty if it is not.
  [[nodiscard]] std::string refusal_of(const sensor_msgs::msg::JointState<Jazzy>& command) const {
    using articula::detail::message_of;
    const std::string& name = options_.joint;
    if (!command.name.empty() && command.name != std::vector<std::string>{name}) {
      return "Incoming joint " + command.name[0] + " doesn't match the gripper's joint, " + name;
    }
    for (const auto& [what, values] :
         {std::pair("velocity", &command.velocity), std::pair("max_effort", &command.effort)}) {
      if (values->size() > 1) {
        return std::string(what) + ": " + std::to_string(values->size()) + " numbers for 1 joint";
      }
      if (!values->empty() && !(std::isfinite((*values)[0]) && (*values)[0] >= 0)) {
        return message_of({what, " ", (*values)[0], " is not a finite number >= 0"});
      }
    }
    if (command.effort.empty() || command.effort[0] == 0) return {};
    const double limit = joint().limits.effort;
    if (command.effort[0] >= limit) return {};
    return message_of({"max_effort ", command.effort[0], " is below the limit of joint '", name,
                       "', ", limit, ", and the loop has no limit for one goal: send 0"});
  }

  bool cancel(const GoalId& id) {
    if (!running_ || running_->id != id || running_->canceling) return false;
    if (!core_.watch.has_cycle) return false;  // where the joint is, is not known yet
    running_->canceling = true;
    const auto& limits = joint().limits;
    const double place = std::clamp(measured().position, limits.lower, limits.upper);
    core_.loop_operator.ask(remote::Go{.positions = {{options_.joint, place}}},
                            [this, id](const remote::Answer&) {
                              if (running_ && running_->id == id) end(Status::canceled);
                            });
    return true;
  }

  /// Whether the reference is on its way elsewhere: another client has moved it. Cycles come later
  /// than the situation, so it must last.
  [[nodiscard]] bool is_replaced() {
    const std::string_view motion = core_.watch.motion_of(joint_);
    const double reference = core_.watch.cycle.reference_position[joint_];
    const bool arrived = std::abs(reference - running_->position) < 1e-9;
    if (motion == "go" || (motion == "rest" && arrived)) {
      running_->elsewhere.reset();
      return false;
    }
    if (!running_->elsewhere) running_->elsewhere = core_.watch.cycle.number;
    return core_.watch.cycle.number > *running_->elsewhere + 2;
  }

  void end(std::int8_t status, const End& how = {}) {
    typename Server::Result result;
    put_state(result, measured(), core_.header());
    result.stalled = how.stalled;
    result.reached_goal = how.reached_goal;
    server_.end(running_->id, status, result);
    running_.reset();
  }

  BridgeCore& core_;
  const BridgedController& controller_;
  const GripperOptions& options_;
  std::size_t joint_;  ///< index into the loop's
  Server server_;
  Periodic feedback_due_;
  std::optional<Running> running_{};
};

}  // namespace

std::unique_ptr<ControllerAction> make_gripper_action(BridgeCore& core, const Node& node,
                                                      const BridgedController& controller) {
  if (is_parallel_gripper(controller.type)) {
    return std::make_unique<GripperAction<ParallelGripper>>(core, node, controller);
  }
  return std::make_unique<GripperAction<SimpleGripper>>(core, node, controller);
}

}  // namespace articula::ros2
