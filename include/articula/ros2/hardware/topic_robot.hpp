// SPDX-License-Identifier: Apache-2.0
/// @file A running loop as a robot behind two topics, which controllers in ROS 2 command.
#pragma once

#include "articula/remote/port.hpp"
#include "articula/ros2/hardware/joint_command.hpp"
#include "articula/ros2/hardware/topic_robot_options.hpp"
#include "articula/ros2/hardware/topic_thread.hpp"
#include "articula/ros2/messages/rosgraph_msgs.hpp"
#include "articula/ros2/messages/sensor_msgs.hpp"
#include "articula/ros2/node/publisher.hpp"
#include "articula/ros2/node/ros_time.hpp"
#include "articula/ros2/node/subscription.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace articula::ros2 {

/// Publishes the states of a running loop's joints, and takes their commands, as the plugin
/// topic_based_ros2_control of ROS 2 expects it from a simulator. It is the other side of
/// TopicHardware. The loop's controller passes its reference on, as ForwardPosition and Bypass do:
///
///     Loop<Q2dSim, Bypass> arm;
///     Remote remote(arm);
///     ros2::TopicRobot topics(remote, std::make_unique<ros2::FastDdsTransport>(
///                                         ros2::FastDdsOptions{}, ros2::Distribution::jazzy));
///     remote.run(clock);
///
/// - A command is a sensor_msgs/msg/JointState with some of the joints. Its fields position,
///   velocity and effort are taken as far as the loop commands them. NaN leaves a joint as it is.
/// - A command becomes the request SetReference. So it keeps the robot's limits, and it needs the
///   controls of the port.
/// - States and /clock have the loop's time, which begins at 0. They come after each poll in which
///   there was a new cycle. A loop that stands still publishes nothing.
///
/// Real-time: no (allocates, locks).
class TopicRobot {
 public:
  using Message = sensor_msgs::msg::JointState<Jazzy>;

  /// With a transport of its own, which a thread polls each millisecond until this is destroyed.
  /// @param port  outlives this
  /// @throws std::invalid_argument if an option makes no sense or there is no transport; what the
  ///         transport throws if it cannot offer a topic
  TopicRobot(remote::Port& port, std::unique_ptr<Transport> transport,
             const TopicRobotOptions& options = {})
      : TopicRobot(port, std::make_unique<detail::TopicThread>(std::move(transport)), options) {}
  /// With a transport that the program polls; after each poll it calls `update`.
  /// @param port       outlives this
  /// @param transport  likewise
  /// @throws std::invalid_argument if an option makes no sense
  TopicRobot(remote::Port& port, Transport& transport, const TopicRobotOptions& options = {})
      : port_(port),
        options_((validate(options), options)),
        session_(port.connect("ROS 2 topics", true)),
        context_(transport, options.distribution),
        node_(context_, options.node.empty() ? port.robot().name : options.node,
              options.name_space),
        states_(node_, options.joint_states_topic, quality_of_service::states) {
    if (options.publishes_clock) clock_.emplace(node_, "/clock", quality_of_service::clock);
    for (const remote::SheetJoint& joint : port.robot().joints) state_.name.push_back(joint.name);
    subscribe<Message>(node_, options.joint_commands_topic, quality_of_service::states,
                       [this](const Message& message) { take(message); });
  }
  /// Ends the thread, if there is one, and what the last commands began.
  ~TopicRobot() {
    if (thread_ != nullptr) thread_->stop();
    leave();
  }
  TopicRobot(const TopicRobot&) = delete;
  TopicRobot& operator=(const TopicRobot&) = delete;

  /// Publishes what is new, and ends what has lasted too long.
  /// @param now  of a clock that never jumps
  void update(std::chrono::nanoseconds now) {
    const std::lock_guard lock(mutex_);
    while (const auto answer = session_->answer()) note(*answer, now);
    if (!complaint_.empty()) warn(now, std::exchange(complaint_, {}));
    statistics_.malformed = refused_messages_ + context_.dropped.malformed;
    end_old_command(now);
    publish_newest();
  }
  [[nodiscard]] TopicRobotStatistics statistics() const {
    const std::lock_guard lock(mutex_);
    return statistics_;
  }

 private:
  static constexpr std::size_t most_pending = 32;

  TopicRobot(remote::Port& port, std::unique_ptr<detail::TopicThread> thread,
             const TopicRobotOptions& options)
      : TopicRobot(port, thread->transport(), options) {
    thread_ = std::move(thread);
    thread_->start([this] { update(std::chrono::steady_clock::now().time_since_epoch()); },
                   [this] {
                     leave();
                     if (options_.warn) options_.warn("the topics have ended: " + thread_->error());
                   });
  }

  /// Ends what lasts of commands. Nobody waits for the answers.
  void leave() {
    const std::lock_guard lock(mutex_);
    if ((pending_.empty() && !moves_ && !pushes_) || !may_operate()) return;
    bool pushes = pushes_;
    for (const auto& own : pending_) pushes |= own.second.pushes();
    ask_to_end(pushes);
    // Otherwise the loss of the operator would make the request void.
    session_->release_controls();
    pending_.clear();
    moves_ = pushes_ = false;
  }

  void take(const Message& message) {
    using Kind = detail::JointCommand::Kind;
    const std::lock_guard lock(mutex_);
    const detail::JointCommand command = detail::read_joint_command(message, port_.robot());
    switch (command.kind) {
      case Kind::malformed:
        ++refused_messages_;
        complaint_ = "a command's fields differ in length, or it names a joint twice";
        return;
      case Kind::foreign:
        ++statistics_.foreign;
        complaint_ = "a command names no joint of robot '" + port_.robot().name + "'";
        return;
      case Kind::unusable:
        return refuse("a command has no number of the quantities that the drives take");
      case Kind::usable:
        break;
    }
    // Without a request, which would take the controls from those who may activate the loop.
    if (port_.situation().mode != LoopMode::active) {
      return refuse("the loop is not active: activate it first");
    }
    // A loop takes all that wait in each cycle. Where more wait it stands still, and the end of a
    // command needs a place.
    if (pending_.size() >= most_pending) return refuse("the loop takes no commands");
    pending_.emplace(session_->ask(command.reference), command);
  }

  void refuse(std::string reason) {
    ++statistics_.refused;
    complaint_ = std::move(reason);
  }

  void warn(std::chrono::nanoseconds now, const std::string& reason) {
    if (!options_.warn || (warned_ && now - *warned_ < std::chrono::seconds(1))) return;
    warned_ = now;
    options_.warn(options_.joint_commands_topic + ": " + reason);
  }

  /// A command counts when the loop has taken it. So one that is refused prolongs no other.
  void note(const remote::Answer& answer, std::chrono::nanoseconds now) {
    const bool is_done = answer.verdict == remote::Verdict::done;
    if (!is_done) warn(now, answer.text);
    if (answer.request == end_request_) {
      end_request_ = 0;
      if (is_done || port_.situation().mode != LoopMode::active)
        (pushes_ ? pushes_ : moves_) = false;
      end_due_ = now + std::chrono::milliseconds(100);
      return;
    }
    ++(is_done ? statistics_.accepted : statistics_.refused);
    const auto own = pending_.extract(answer.request);
    // A loop that stood still in a command may still do it.
    if ((!is_done && answer.verdict != remote::Verdict::failed) || own.empty()) return;
    commanded_ = now;
    end_due_ = now;
    is_expired_ = false;
    moves_ |= own.mapped().moves();
    pushes_ |= own.mapped().pushes();
  }

  /// Nobody else has the controls.
  [[nodiscard]] bool may_operate() {
    return session_->has_controls() || port_.situation().operator_name.empty();
  }

  /// Ends efforts, then velocities, until the loop has done it: one that stands still does it when
  /// it goes on.
  void end_old_command(std::chrono::nanoseconds now) {
    const bool is_old = now - commanded_ > to_duration(options_.command_lifetime);
    if (!is_old || !pending_.empty() || end_request_ != 0) {
      if (session_->has_controls()) session_->keep_alive();
    } else if (!moves_ && !pushes_) {
      if (session_->has_controls()) session_->release_controls();
    } else if (now >= end_due_ && may_operate()) {
      if (!std::exchange(is_expired_, true)) ++statistics_.expired;
      end_request_ = ask_to_end(pushes_);
    }
  }
  std::uint64_t ask_to_end(bool pushes) {
    if (!pushes) return session_->ask(remote::Stop{});
    remote::SetReference rest;  // which sets velocities to 0 as well
    for (const std::string& joint : state_.name) rest.efforts.push_back({joint, 0});
    return session_->ask(rest);
  }

  void publish_newest() {
    bool is_new = false;
    while (session_->next(cycle_)) is_new = true;
    while (session_->event()) {  // nobody reads them here
    }
    if (!is_new) return;
    state_.header.stamp =
        to_message<builtin_interfaces::msg::Time>(to_duration(std::max(cycle_.time, 0.0)));
    state_.position = cycle_.position;
    state_.velocity = cycle_.velocity;
    state_.effort = cycle_.effort;
    if (clock_) clock_->publish({state_.header.stamp});
    states_.publish(state_);
  }

  std::unique_ptr<detail::TopicThread> thread_{};  ///< none: the program polls
  remote::Port& port_;
  TopicRobotOptions options_;
  std::unique_ptr<remote::Session> session_;
  Context context_;
  Node node_;
  Publisher<Message> states_;
  std::optional<Publisher<rosgraph_msgs::msg::Clock>> clock_{};
  Message state_{};
  remote::Cycle cycle_{};
  std::chrono::nanoseconds commanded_{0};  ///< when the loop took the last command
  std::map<std::uint64_t, detail::JointCommand> pending_{};  ///< without an answer, by numbers
  bool moves_ = false, pushes_ = false;  ///< what lasts of the commands that the loop has taken
  std::uint64_t end_request_ = 0;        ///< that ends them; 0: none waits for its answer
  std::chrono::nanoseconds end_due_{0};  ///< not before: after a refusal
  bool is_expired_ = false;
  std::uint64_t refused_messages_ = 0;
  std::string complaint_{};                           ///< of a command; for the next warning
  std::optional<std::chrono::nanoseconds> warned_{};  ///< when the last warning was given
  mutable std::mutex mutex_{};
  TopicRobotStatistics statistics_{};  ///< under the mutex
};

}  // namespace articula::ros2
