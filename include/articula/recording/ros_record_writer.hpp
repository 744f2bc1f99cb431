// SPDX-License-Identifier: Apache-2.0
/// @file Writes recorded cycles to an MCAP file as messages of ROS 2.
#pragma once

#include "articula/recording/cycle_record.hpp"
#include "articula/recording/mcap_writer.hpp"
#include "articula/ros2/message_buffer.hpp"
#include "articula/ros2/message_text.hpp"
#include "articula/ros2/messages/sensor_msgs.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace articula {

/// Writes cycles to an MCAP file as ROS 2's recorder does, without ROS: as
/// sensor_msgs/msg/JointState in CDR on the topics /joint_states, /reference and /command. The
/// message is the same in Humble, Jazzy and Rolling. Stamps are the loop's time, which begins at 0.
///
/// McapRecordWriter also writes status, timing and changes, from which a run can be computed again.
/// Real-time: no (allocates, calls the system), all functions of this class.
class RosRecordWriter {
 public:
  /// Numbers of all joints, or empty if there are none.
  struct Values {
    std::vector<double> position{};  ///< [rad or m]
    std::vector<double> velocity{};  ///< [rad/s or m/s]
    std::vector<double> effort{};    ///< [N m or N]
  };
  /// The topics by index.
  enum class Topic : unsigned char { joint_states, reference, command };

  /// @param path    of the file; not a pipe
  /// @param joints  their names, in the order of all numbers
  /// @throws std::runtime_error naming the file and the reason, if it cannot be written
  RosRecordWriter(const std::filesystem::path& path, std::vector<std::string> joints)
      : writer_(path, {topic("/joint_states"), topic("/reference"), topic("/command")}, "ros2") {
    message_.name = std::move(joints);
  }

  /// Writes a message.
  /// @param time  of the loop [s]; a negative one is written as 0
  /// @throws std::runtime_error if it cannot be written
  void write(Topic topic, double time, const Values& values) {
    constexpr std::int64_t second = 1'000'000'000;
    const std::int64_t stamp = std::llround(std::max(time, 0.0) * 1e9);
    message_.header.stamp = {static_cast<std::int32_t>(stamp / second),
                             static_cast<std::uint32_t>(stamp % second)};
    message_.position = values.position;
    message_.velocity = values.velocity;
    message_.effort = values.effort;
    const auto bytes = buffer_.encode(message_);
    writer_.write(static_cast<std::size_t>(topic), std::chrono::nanoseconds(stamp),
                  {reinterpret_cast<const char*>(bytes.data()), bytes.size()});  // NOLINT: bytes
  }
  /// Writes a record: a message on each topic.
  template <int N, class Command>
  void write(const CycleRecord<N, Command>& record) {
    const auto& state = record.state;
    const auto& reference = record.reference;
    write(Topic::joint_states, record.time,
          {list(state.position), list(state.velocity), list(state.effort)});
    write(Topic::reference, record.time,
          {list(reference.position), list(reference.velocity), list(reference.effort)});
    Values command;
    if constexpr (requires { record.command.position; }) {
      command.position = list(record.command.position);
    }
    if constexpr (requires { record.command.velocity; }) {
      command.velocity = list(record.command.velocity);
    }
    if constexpr (requires { record.command.effort; }) {
      command.effort = list(record.command.effort);
    }
    write(Topic::command, record.time, command);
  }

  /// Completes the file. Does nothing if it is closed already.
  /// @throws std::runtime_error if not all could be written
  void close() { writer_.close(); }

 private:
  using Message = ros2::sensor_msgs::msg::JointState<ros2::Jazzy>;

  static McapTopic topic(std::string name) {
    return {.name = std::move(name),
            .type = std::string(Message::ros_type.view()),
            .schema = ros2::message_text<Message>(),
            .schema_encoding = "ros2msg",
            .encoding = "cdr"};
  }
  static std::vector<double> list(const auto& vector) { return {vector.begin(), vector.end()}; }

  McapWriter writer_;
  ros2::MessageBuffer buffer_{};
  Message message_{};
};

}  // namespace articula
