// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/node/goal_book.hpp"

#include "articula/ros2/node/ros_time.hpp"

#include <algorithm>

namespace articula::ros2 {

namespace {

/// As in rcl: not one that has ended or is being canceled already.
bool can_be_canceled(std::int8_t status) {
  return !GoalBook::has_ended(status) && status != GoalBook::Status::canceling;
}

action_msgs::msg::GoalInfo info_of(const GoalEntry& goal) {
  return {{goal.id}, to_message<builtin_interfaces::msg::Time>(goal.accepted)};
}

}  // namespace

const GoalEntry* GoalBook::find(const GoalId& id) const {
  const auto found = std::find_if(goals_.begin(), goals_.end(),
                                  [&](const GoalEntry& goal) { return goal.id == id; });
  return found == goals_.end() ? nullptr : &*found;
}

void GoalBook::add(const GoalId& id, std::chrono::nanoseconds now) {
  goals_.push_back({id, now, Status::executing, {}});
}

bool GoalBook::set_status(const GoalId& id, std::int8_t status, std::chrono::nanoseconds now) {
  for (GoalEntry& goal : goals_) {
    if (goal.id != id || has_ended(goal.status)) continue;
    goal.status = status;
    if (has_ended(status)) goal.ended = now;
    return true;
  }
  return false;
}

GoalBook::Selection GoalBook::select(const action_msgs::msg::GoalInfo& request) const {
  using Codes = action_msgs::srv::CancelGoal<Jazzy>;
  const GoalId& id = request.goal_id.uuid;
  const bool by_id = id != GoalId{};
  const bool by_stamp = request.stamp.sec != 0 || request.stamp.nanosec != 0;
  if (by_id && !by_stamp) {
    const GoalEntry* const goal = find(id);
    if (goal == nullptr) return {Codes::unknown_goal, {}};
    if (!can_be_canceled(goal->status)) return {Codes::goal_terminated, {}};
    return {Codes::none, {id}};
  }
  Selection selection;
  for (const GoalEntry& goal : goals_) {
    const bool early = by_stamp && goal.accepted <= from_message(request.stamp);
    const bool meant = goal.id == id || early || (!by_id && !by_stamp);
    if (meant && can_be_canceled(goal.status)) selection.goals.push_back(goal.id);
  }
  return selection;
}

std::vector<GoalId> GoalBook::forget(std::chrono::nanoseconds now) {
  std::vector<GoalId> forgotten;
  std::erase_if(goals_, [&](const GoalEntry& goal) {
    const bool old = has_ended(goal.status) && now - goal.ended > lifetime_;
    if (old) forgotten.push_back(goal.id);
    return old;
  });
  for (std::size_t i = 0; full() && i < goals_.size();) {
    if (!has_ended(goals_[i].status)) {
      ++i;
      continue;
    }
    forgotten.push_back(goals_[i].id);
    goals_.erase(goals_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return forgotten;
}

action_msgs::msg::GoalInfo GoalBook::info(const GoalId& id) const {
  const GoalEntry* const goal = find(id);
  return goal == nullptr ? action_msgs::msg::GoalInfo{{id}, {}} : info_of(*goal);
}

action_msgs::msg::GoalStatusArray<Jazzy> GoalBook::status() const {
  action_msgs::msg::GoalStatusArray<Jazzy> all;
  for (const GoalEntry& goal : goals_) all.status_list.push_back({info_of(goal), goal.status});
  return all;
}

}  // namespace articula::ros2
