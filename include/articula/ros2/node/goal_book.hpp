// SPDX-License-Identifier: Apache-2.0
/// @file The goals of an action server and their states.
#pragma once

#include "articula/ros2/messages/action_msgs.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace articula::ros2 {

/// The identifier of a goal, which its client has chosen.
using GoalId = std::array<std::uint8_t, 16>;

/// A goal of an action server.
struct GoalEntry {
  GoalId id{};
  std::chrono::nanoseconds accepted{0};  ///< when it was
  std::int8_t status = 0;                ///< see action_msgs::msg::GoalStatus
  std::chrono::nanoseconds ended{0};     ///< when it was, if it has
};

/// The goals that an action server has accepted, with the rules of ROS's action servers for
/// canceling them and for forgetting ended ones. Real-time: no (allocates).
class GoalBook {
 public:
  using Status = action_msgs::msg::GoalStatus;
  static constexpr std::size_t most = 64;  ///< goals

  /// @param lifetime  of a goal after its end
  explicit GoalBook(std::chrono::nanoseconds lifetime) : lifetime_(lifetime) {}

  [[nodiscard]] static bool has_ended(std::int8_t status) { return status >= Status::succeeded; }

  /// @return null if there is no such goal
  [[nodiscard]] const GoalEntry* find(const GoalId& id) const;
  /// Whether there is no room for another goal.
  [[nodiscard]] bool full() const noexcept { return goals_.size() >= most; }
  /// Adds a goal that is executed from now on.
  /// @pre  no goal has this identifier
  void add(const GoalId& id, std::chrono::nanoseconds now);
  /// Changes the status of a goal that has not ended.
  /// @return false if there is none
  bool set_status(const GoalId& id, std::int8_t status, std::chrono::nanoseconds now);

  /// The goals that a request to cancel means.
  struct Selection {
    std::int8_t code = 0;  ///< see action_msgs::srv::CancelGoal
    std::vector<GoalId> goals{};
  };
  /// @param request  all goals if it is zero; the goal of its identifier; those up to its stamp
  [[nodiscard]] Selection select(const action_msgs::msg::GoalInfo& request) const;

  /// Forgets goals whose end is long ago, and, if the book is full, those that ended first.
  /// @return those that are forgotten
  std::vector<GoalId> forget(std::chrono::nanoseconds now);

  [[nodiscard]] action_msgs::msg::GoalInfo info(const GoalId& id) const;
  /// All goals, in the order in which they were accepted.
  [[nodiscard]] action_msgs::msg::GoalStatusArray<Jazzy> status() const;

 private:
  std::chrono::nanoseconds lifetime_;
  std::vector<GoalEntry> goals_{};
};

}  // namespace articula::ros2
