// SPDX-License-Identifier: Apache-2.0
/// @file Lines of the log that ROS's tools show.
#pragma once

#include "articula/ros2/messages/rcl_interfaces.hpp"
#include "articula/ros2/node/publisher.hpp"
#include "articula/ros2/node/ros_time.hpp"

#include <chrono>
#include <cstdint>
#include <string>

namespace articula::ros2 {

/// Publishes lines to /rosout, at most `most_a_second`. Real-time: no (allocates).
class RosLog {
 public:
  using Line = rcl_interfaces::msg::Log<Jazzy>;
  static constexpr int most_a_second = 50;

  explicit RosLog(const Node& node)
      : context_(node.context()), publisher_(node, "/rosout", quality_of_service::log) {}

  /// @param level  Line::info, Line::warn or Line::error
  /// @param name   of who says it, as "controller_manager"
  void write(std::uint8_t level, const std::string& name, const std::string& text) {
    const auto passed = context_.wall - second_;
    if (passed >= std::chrono::seconds(1) || passed < std::chrono::seconds(0)) {
      second_ = context_.wall;
      lines_ = 0;
    }
    if (++lines_ > most_a_second) return;
    publisher_.publish({.stamp = to_message<builtin_interfaces::msg::Time>(context_.now),
                        .level = level,
                        .name = name,
                        .msg = text});
  }
  /// A request that was refused, which is counted.
  void refuse(const std::string& name, const std::string& reason) {
    ++context_.dropped.refused;
    write(Line::warn, name, reason);
  }

 private:
  Context& context_;
  Publisher<Line> publisher_;
  std::chrono::nanoseconds second_{0};  ///< in which lines_ are counted
  int lines_ = 0;
};

}  // namespace articula::ros2
