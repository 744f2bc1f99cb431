// SPDX-License-Identifier: Apache-2.0
/// @file Lines of the log that ROS's tools show.
#pragma once

#include "articula/ros2/messages/rcl_interfaces.hpp"
#include "articula/ros2/node/publisher.hpp"
#include "articula/ros2/node/ros_time.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>

namespace articula::ros2 {

/// Publishes lines to /rosout, at most `most_a_second` and each of them once a second. Real-time:
/// no (allocates).
class RosLog {
 public:
  using Line = rcl_interfaces::msg::Log<Jazzy>;
  static constexpr std::size_t most_a_second = 50;

  explicit RosLog(const Node& node)
      : context_(node.context()), publisher_(node, "/rosout", quality_of_service::log) {
    const std::string& name = node.name();
    name_space_ = name.substr(1, name.rfind('/'));
  }

  /// @param level  Line::info, Line::warn or Line::error
  /// @param name   of who says it, in the namespace of the log's node, as "controller_manager"
  void write(std::uint8_t level, const std::string& name, const std::string& text) {
    const auto passed = context_.wall - second_;
    if (passed >= std::chrono::seconds(1) || passed < std::chrono::seconds(0)) {
      second_ = context_.wall;
      lines_.clear();
    }
    if (lines_.size() == most_a_second || !lines_.insert(name + text).second) return;
    std::string logger = name_space_ + name;
    std::replace(logger.begin(), logger.end(), '/', '.');  // as ROS names a node's log
    publisher_.publish({.stamp = to_message<builtin_interfaces::msg::Time>(context_.now),
                        .level = level,
                        .name = std::move(logger),
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
  std::string name_space_{};            ///< of the node, as "left/"
  std::chrono::nanoseconds second_{0};  ///< when that of lines_ began
  std::set<std::string> lines_{};       ///< that were written in this second
};

}  // namespace articula::ros2
