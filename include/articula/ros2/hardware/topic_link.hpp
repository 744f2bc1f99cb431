// SPDX-License-Identifier: Apache-2.0
/// @file The topics of a TopicHardware, read and written outside the loop's thread.
#pragma once

#include "articula/core/joint_command.hpp"
#include "articula/loop/exchange/latest_value.hpp"
#include "articula/model/robot.hpp"
#include "articula/ros2/hardware/joint_state_collector.hpp"
#include "articula/ros2/hardware/topic_clock.hpp"
#include "articula/ros2/hardware/topic_hardware_options.hpp"
#include "articula/ros2/messages/rosgraph_msgs.hpp"
#include "articula/ros2/node/publisher.hpp"
#include "articula/ros2/node/ros_time.hpp"
#include "articula/ros2/node/subscription.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace articula::ros2::detail {

/// The command with which joints stop: no effort, no velocity, or where they are.
template <class Command, int N>
[[nodiscard]] Command stop_command(const JointVector<N>& position) noexcept {
  Command command;
  if constexpr (std::same_as<Command, PositionCommand<N>>) command.position = position;
  return command;
}

/// The names of a robot's joints, for threads that do not have the robot.
template <Robot R>
[[nodiscard]] auto names_of(const R& robot) {
  std::array<Name, static_cast<std::size_t>(joint_count<R>)> names;
  std::ranges::copy(joint_names(robot), names.begin());
  return names;
}

/// States in and commands out, each by one wait-free exchange.
/// @tparam Command  effort, position or velocity
/// @tparam Clock    of this host
template <Robot R, class Command, class Clock>
class TopicLink {
 public:
  static constexpr int N = joint_count<R>;
  using Message = sensor_msgs::msg::JointState<Jazzy>;
  using Time = std::chrono::nanoseconds;

  TopicLink(const R& robot, Transport& transport, const TopicHardwareOptions& options)
      : context_(transport, checked_distribution(options)),
        node_(context_, options.node.empty()
                            ? "topic_based_ros2_control_" + std::string(model_of(robot).name.view())
                            : options.node),
        commands_(node_, options.joint_commands_topic, quality_of_service::states),
        deadline_(to_duration(options.command_deadline)),
        names_(names_of(robot)),
        collector_(names_, options.sum_wrapped_joint_states) {
    subscribe<Message>(node_, options.joint_states_topic, quality_of_service::sensor_data,
                       [this](const Message& message) { take(message); });
    if (options.clock_topic.empty()) return;
    simulated_ = std::make_shared<ReceivedTime>();
    subscribe<rosgraph_msgs::msg::Clock>(
        node_, options.clock_topic, quality_of_service::sensor_data,
        [this](const auto& message) { simulated_->take(from_message(message.clock)); });
  }

  // For the transport's thread:

  /// Sends the last command that was written, or a stop if none was written in time. Lets the
  /// simulator's time pass.
  void exchange() {
    if (simulated_ != nullptr) simulated_->pass();
    const TopicTime now = this->now();
    if (outgoing_.update()) {
      send(outgoing_.value().command);
      follows_ = outgoing_.value().follows;
      written_ = now;
    } else if (follows_ && age(now, written_) >= deadline_) {
      send(stop_command<Command, N>(collector_.states().state.position));
      follows_ = false;
      missed_deadlines_.fetch_add(1, std::memory_order_relaxed);
    }
    undecoded_.store(context_.dropped.malformed, std::memory_order_relaxed);
    has_reader_.store(commands_.readers() > 0, std::memory_order_relaxed);
  }

  /// The transport has failed: nothing will come any more.
  void fail() {
    if (simulated_ != nullptr) simulated_->end();
  }

  // For the loop's thread:

  /// The last states. Real-time: yes.
  [[nodiscard]] const TopicStates<N>& states() noexcept {
    static_cast<void>(incoming_.update());
    return incoming_.value();
  }
  /// A command for the transport's thread.
  /// @param follows  more are to come within the deadline
  /// Real-time: yes.
  void put(const Command& command, bool follows) noexcept { outgoing_.write({command, follows}); }

  // For any thread:

  /// The present. Real-time: yes, but for the clock.
  [[nodiscard]] TopicTime now() const noexcept {
    const Time host = Clock::now().time_since_epoch();
    if (simulated_ == nullptr) return {host, host};
    return {host, simulated_->is_known() ? simulated_->now() : TopicStates<N>::never.simulated};
  }
  /// The time of a simulator; null without a topic for it.
  [[nodiscard]] const std::shared_ptr<ReceivedTime>& simulated_time() const noexcept {
    return simulated_;
  }
  [[nodiscard]] bool has_reader() const noexcept {
    return has_reader_.load(std::memory_order_relaxed);
  }
  [[nodiscard]] TopicStatistics statistics() const noexcept {
    const auto value = [](const auto& counter) { return counter.load(std::memory_order_relaxed); };
    return {value(taken_[0]),
            value(taken_[1]),
            value(taken_[2]) + value(undecoded_),
            value(sent_),
            value(missed_deadlines_),
            simulated_ != nullptr ? simulated_->jumps() : 0};
  }
  [[nodiscard]] std::string_view joint_name(std::size_t joint) const noexcept {
    return names_[joint].view();
  }

 private:
  struct Outgoing {
    Command command{};
    bool follows = false;
  };

  static Distribution checked_distribution(const TopicHardwareOptions& options) {
    validate(options);
    return options.distribution;
  }

  void take(const Message& message) {
    const StatesMessage taken = collector_.take(message, now());
    taken_[static_cast<std::size_t>(taken)].fetch_add(1, std::memory_order_relaxed);
    if (taken == StatesMessage::accepted) incoming_.write(collector_.states());
  }

  void send(const Command& command) {
    Message message;
    message.header.stamp = to_message<builtin_interfaces::msg::Time>(
        simulated_ != nullptr ? simulated_->latest()
                              : std::chrono::system_clock::now().time_since_epoch());
    for (const Name& name : names_) message.name.emplace_back(name.view());
    const auto put_values = [](const JointVector<N>& values, std::vector<double>& to) {
      to.assign(values.begin(), values.end());
    };
    if constexpr (std::same_as<Command, PositionCommand<N>>) {
      put_values(command.position, message.position);
    } else if constexpr (std::same_as<Command, VelocityCommand<N>>) {
      put_values(command.velocity, message.velocity);
    } else {
      put_values(command.effort, message.effort);
    }
    commands_.publish(message);
    sent_.fetch_add(1, std::memory_order_relaxed);
  }

  Context context_;
  Node node_;
  Publisher<Message> commands_;
  Time deadline_;
  std::array<Name, static_cast<std::size_t>(N)> names_;
  JointStateCollector<N> collector_;
  std::shared_ptr<ReceivedTime> simulated_{};
  TopicTime written_{};   ///< when the last command came from the loop
  bool follows_ = false;  ///< another one is to come
  LatestValue<TopicStates<N>> incoming_{};
  LatestValue<Outgoing> outgoing_{};
  std::array<std::atomic<std::uint64_t>, 3> taken_{};  ///< messages by StatesMessage
  std::atomic<std::uint64_t> undecoded_ = 0, sent_ = 0, missed_deadlines_ = 0;
  std::atomic<bool> has_reader_ = false;
};

}  // namespace articula::ros2::detail
