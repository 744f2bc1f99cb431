// SPDX-License-Identifier: Apache-2.0
/// @file A server of an action: goals in; feedback, status and results out.
#pragma once

#include "articula/ros2/names.hpp"
#include "articula/ros2/node/goal_book.hpp"
#include "articula/ros2/node/publisher.hpp"
#include "articula/ros2/node/ros_time.hpp"
#include "articula/ros2/node/service.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace articula::ros2 {

/// Serves an action as ROS's action servers do. A goal is accepted or rejected at once or later.
/// Who asks for the result of a goal gets it at its end. In the thread that polls the transport.
/// Real-time: no (allocates).
/// @tparam Action  such as control_msgs::action::FollowJointTrajectory<Jazzy>
template <class Action>
class ActionServer {
 public:
  using Goal = typename Action::Goal;
  using Result = typename Action::Result;
  using Feedback = typename Action::Feedback;
  using Status = action_msgs::msg::GoalStatus;
  static constexpr std::size_t most_waiting = 64;  ///< clients that wait for results

  /// What the owner does.
  struct Handlers {
    /// Calls `accept` or `reject`, in this call or later.
    std::function<void(const GoalId&, const Goal&)> on_goal{};
    /// Begins to cancel a goal, and calls `end` later.
    /// @return whether it will be canceled
    std::function<bool(const GoalId&)> on_cancel{};
  };

  /// @param name      of the action, see Node::full_name
  /// @param lifetime  of results
  ActionServer(const Node& node, const std::string& name, std::chrono::nanoseconds lifetime,
               Handlers handlers)
      : context_(node.context()),
        goals_(lifetime),
        handlers_(std::move(handlers)),
        feedback_(node, feedback_name(name), quality_of_service::action_feedback),
        status_(node, status_name(name), quality_of_service::action_status) {
    serve<SendGoal<Action>>(node, send_goal_name(name), [this](const auto& request, auto reply) {
      begin(request, std::move(reply));
    });
    serve<GetResult<Action>>(node, get_result_name(name), [this](const auto& request, auto reply) {
      give_result(request.goal_id.uuid, std::move(reply));
    });
    serve<action_msgs::srv::CancelGoal<Jazzy>>(
        node, cancel_goal_name(name),
        [this](const auto& request, auto reply) { reply.send(cancel(request.goal_info)); });
    status_.publish(goals_.status());
  }
  ActionServer(const ActionServer&) = delete;
  ActionServer& operator=(const ActionServer&) = delete;

  /// Accepts a goal that waits for it.
  void accept(const GoalId& id) {
    const auto found = asked_.find(id);
    if (found == asked_.end()) return;
    update();
    goals_.add(id, context_.now);
    found->second.send({true, to_message<builtin_interfaces::msg::Time>(context_.now)});
    asked_.erase(found);
    status_.publish(goals_.status());
  }
  /// Rejects a goal that waits for it.
  void reject(const GoalId& id) {
    const auto found = asked_.find(id);
    if (found == asked_.end()) return;
    found->second.send({false, to_message<builtin_interfaces::msg::Time>(context_.now)});
    asked_.erase(found);
  }
  /// Publishes feedback on a goal.
  void feed_back(const GoalId& id, Feedback feedback) {
    feedback_.publish({{id}, std::move(feedback)});
  }
  /// Ends a goal, which has been accepted.
  /// @param status  Status::succeeded, canceled or aborted
  void end(const GoalId& id, std::int8_t status, const Result& result) {
    if (!goals_.set_status(id, status, context_.now)) return;
    results_[id] = {status, result};
    for (const auto& [waiting, reply] : waiting_) {
      if (waiting == id) reply.send(results_[id]);
    }
    std::erase_if(waiting_, [&](const auto& own) { return own.first == id; });
    status_.publish(goals_.status());
  }
  /// Forgets results whose lifetime is over.
  void update() {
    const std::vector<GoalId> forgotten = goals_.forget(context_.now);
    for (const GoalId& id : forgotten) results_.erase(id);
    if (!forgotten.empty()) status_.publish(goals_.status());
  }

  /// The number of goals that are remembered.
  [[nodiscard]] std::size_t size() const { return results_.size() + asked_.size(); }

 private:
  using Send = SendGoal<Action>;
  using Get = GetResult<Action>;

  void begin(const typename Send::Request& request, Reply<Send> reply) {
    const GoalId& id = request.goal_id.uuid;
    update();
    if (goals_.full() || asked_.size() >= GoalBook::most || goals_.find(id) != nullptr ||
        asked_.contains(id)) {
      ++context_.dropped.refused;
      return reply.send({false, to_message<builtin_interfaces::msg::Time>(context_.now)});
    }
    asked_.emplace(id, std::move(reply));
    handlers_.on_goal(id, request.goal);
  }

  void give_result(const GoalId& id, Reply<Get> reply) {
    if (const auto result = results_.find(id); result != results_.end()) {
      reply.send(result->second);
    } else if (goals_.find(id) == nullptr) {
      reply.send({});  // status 0: unknown
    } else {
      if (waiting_.size() >= most_waiting) {
        ++context_.dropped.refused;
        return reply.send({});
      }
      waiting_.emplace_back(id, std::move(reply));
    }
  }

  action_msgs::srv::CancelGoal<Jazzy>::Response cancel(const action_msgs::msg::GoalInfo& request) {
    using Codes = action_msgs::srv::CancelGoal<Jazzy>;
    const GoalBook::Selection selection = goals_.select(request);
    Codes::Response response{.return_code = selection.code};
    for (const GoalId& id : selection.goals) {
      if (!handlers_.on_cancel(id)) continue;
      goals_.set_status(id, Status::canceling, context_.now);
      response.goals_canceling.push_back(goals_.info(id));
    }
    if (!response.goals_canceling.empty()) {
      status_.publish(goals_.status());
    } else if (!selection.goals.empty()) {
      response.return_code = Codes::rejected;
    }
    return response;
  }

  Context& context_;
  GoalBook goals_;
  Handlers handlers_;
  Publisher<FeedbackMessage<Action>> feedback_;
  Publisher<action_msgs::msg::GoalStatusArray<Jazzy>> status_;
  std::map<GoalId, Reply<Send>> asked_{};
  std::map<GoalId, typename Get::Response> results_{};
  std::vector<std::pair<GoalId, Reply<Get>>> waiting_{};
};

}  // namespace articula::ros2
