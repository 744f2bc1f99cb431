// SPDX-License-Identifier: Apache-2.0
/// @file A robot or simulator in ROS 2, as hardware of a loop.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/hardware.hpp"
#include "articula/model/robot.hpp"
#include "articula/ros2/hardware/topic_clock.hpp"
#include "articula/ros2/hardware/topic_link.hpp"
#include "articula/ros2/hardware/topic_thread.hpp"

#include <chrono>
#include <concepts>
#include <memory>
#include <string>
#include <thread>
#include <utility>

namespace articula::ros2 {

/// A robot whose joint states come from a topic, and whose commands go out on another one, as the
/// plugin topic_based_ros2_control has it:
///
///     using Arm = ros2::TopicHardware<Q2d>;
///     Loop<Arm, PidPlusGravity> loop(Arm(std::make_unique<ros2::FastDdsTransport>(
///         ros2::FastDdsOptions{}, ros2::Distribution::jazzy)));
///
/// - A command is a sensor_msgs/msg/JointState with all joints, in which the field of the command's
///   kind is filled. Each `write` replaces the command that was not sent yet. In contrast to the
///   plugin, a command near the measured position is sent as well.
/// - `read` and `write` exchange figures with the transport's thread, wait-free. They do not block.
/// - A joint that is silent for `silent_after` is a fault, which lasts until `activate`. In a fault
///   and at the end the joints get no effort, no velocity, or the position where they are.
/// - If `write` is not called for `command_deadline`, the transport's thread sends that stop.
/// - A simulator that does not run in real time needs TopicHardwareOptions::clock_topic. Nothing is
///   then older than by its time, and `clock` paces the loop.
/// @tparam R            the robot
/// @tparam CommandType  EffortCommand, PositionCommand or VelocityCommand
/// @tparam Clock        of this host; a test may have another one
template <Robot R, class CommandType = EffortCommand<articula::joint_count<R>>,
          class Clock = std::chrono::steady_clock>
  requires JointCommand<CommandType, articula::joint_count<R>> &&
           (!std::same_as<CommandType, MultiModeCommand<articula::joint_count<R>>>)
class TopicHardware {
 public:
  using RobotType = R;
  using Command = CommandType;
  static constexpr int joint_count = articula::joint_count<R>;

  /// With a transport of its own, which a thread polls until this is destroyed.
  /// @throws std::invalid_argument if an option makes no sense or there is no transport; what the
  ///         transport throws if it cannot offer a topic
  TopicHardware(const R& robot, std::unique_ptr<Transport> transport,
                const TopicHardwareOptions& options = {})
      : robot_(robot), thread_(std::make_unique<detail::TopicThread>(std::move(transport))) {
    use(thread_->transport(), options);
    thread_->start([link = link_.get()] { link->exchange(); },
                   [link = link_.get()] { link->fail(); });
  }
  /// For a robot known at compile time.
  explicit TopicHardware(std::unique_ptr<Transport> transport,
                         const TopicHardwareOptions& options = {})
    requires DescribedRobot<R>
      : TopicHardware(R(), std::move(transport), options) {}
  /// With a transport that the program polls; after each poll it calls `exchange`. It destroys this
  /// in the same thread.
  /// @param transport  outlives this
  /// @throws std::invalid_argument if an option makes no sense; what the transport throws if it
  ///         cannot offer a topic
  TopicHardware(const R& robot, Transport& transport, const TopicHardwareOptions& options = {})
      : robot_(robot) {
    use(transport, options);
  }
  /// The object that is moved from has no joints any more.
  TopicHardware(TopicHardware&&) noexcept = default;
  TopicHardware& operator=(TopicHardware&&) = delete;
  /// Stops joints that are active.
  ~TopicHardware() {
    if (link_ == nullptr) return;
    static_cast<void>(deactivate());
    try {
      if (thread_ != nullptr) {
        thread_->stop();  // it uses the link, and sends the stop
      } else {
        link_->exchange();
      }
    } catch (...) {  // NOLINT(bugprone-empty-catch): the transport is gone, no report is possible
    }
  }

  /// Waits until there is a state of each joint, and a reader of the commands.
  /// @return Status::ok, or Status::hardware_fault after `set_up_time`, see problem()
  /// Real-time: no (waits).
  [[nodiscard]] Status activate() noexcept {
    mode_ = Mode::inactive;
    const auto end = std::chrono::steady_clock::now() + set_up_time_;
    while (!is_ready()) {
      if (std::chrono::steady_clock::now() >= end) return Status::hardware_fault;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    mode_ = Mode::active;
    return Status::ok;
  }
  /// Stops the joints.
  /// @return Status::ok
  /// Real-time: yes.
  [[nodiscard]] Status deactivate() noexcept {
    if (mode_ != Mode::inactive) put_stop();
    mode_ = Mode::inactive;
    return Status::ok;
  }

  /// Takes over the last figures.
  /// @param state  receives them; zeros before the first ones
  /// @return       Status::ok; Status::stale_state if those of a joint are too old;
  ///               Status::hardware_fault if a joint was silent; Status::inactive
  /// Real-time: yes, but for the clock.
  [[nodiscard]] Status read(JointState<joint_count>& state) noexcept {
    const auto& latest = link_->states();
    state = latest.state;
    const auto age = age_of(latest);
    if (mode_ == Mode::active && age >= silent_after_) mode_ = Mode::faulted;
    if (mode_ == Mode::faulted) return Status::hardware_fault;
    if (mode_ == Mode::inactive) return Status::inactive;
    return age >= stale_after_ ? Status::stale_state : Status::ok;
  }
  /// Hands a command to the transport's thread. After a fault it is the stop instead, while
  /// inactive there is none.
  /// @param command  if it is not finite, the stop is sent instead
  /// @return         Status::ok; Status::non_finite_command; Status::hardware_fault after a fault;
  ///                 Status::inactive
  /// Real-time: yes.
  [[nodiscard]] Status write(const Command& command) noexcept {
    if (mode_ == Mode::inactive) return Status::inactive;
    const bool finite = is_finite(command);
    if (mode_ == Mode::active && finite) {
      link_->put(command, true);
      return Status::ok;
    }
    put_stop();
    return mode_ == Mode::faulted ? Status::hardware_fault : Status::non_finite_command;
  }

  /// Sends what was written. In the thread that polls the transport, if that is the program's.
  /// Real-time: no (allocates).
  void exchange() { link_->exchange(); }

  /// The clock of a loop that keeps the simulator's pace.
  /// @param stop  ends the run in which the loop waits for a paused simulator; outlives the clock
  /// @throws std::invalid_argument if there is no TopicHardwareOptions::clock_topic
  /// Real-time: no (throws).
  [[nodiscard]] TopicClock clock(const StopFlag* stop = nullptr) const {
    if (link_->simulated_time() == nullptr) {
      articula::detail::refuse({"topic hardware: there is no clock_topic, as /clock"});
    }
    return {link_->simulated_time(), stop};
  }

  /// Why activation is not possible now; empty if it is. In the loop's thread. Real-time: no.
  [[nodiscard]] std::string problem() {
    if (thread_ != nullptr && !thread_->error().empty()) return thread_->error();
    if (!has_time()) return "no time on " + clock_topic_;
    const auto& latest = link_->states();
    if (age_of(latest) >= stale_after_) {
      return "joint '" + std::string(link_->joint_name(latest.oldest())) +
             "': no recent state on " + states_topic_;
    }
    return link_->has_reader() ? "" : "nobody reads " + commands_topic_;
  }
  [[nodiscard]] TopicStatistics statistics() const noexcept { return link_->statistics(); }
  [[nodiscard]] const R& robot() const noexcept { return robot_; }

 private:
  using Link = detail::TopicLink<R, Command, Clock>;
  enum class Mode : unsigned char { inactive, active, faulted };

  void use(Transport& transport, const TopicHardwareOptions& options) {
    link_ = std::make_unique<Link>(robot_, transport, options);
    stale_after_ = to_duration(options.stale_after);
    silent_after_ = to_duration(options.silent_after);
    set_up_time_ = to_duration(options.set_up_time);
    clock_topic_ = options.clock_topic;
    states_topic_ = options.joint_states_topic;
    commands_topic_ = options.joint_commands_topic;
  }
  [[nodiscard]] std::chrono::nanoseconds age_of(
      const TopicStates<joint_count>& states) const noexcept {
    return ros2::age(link_->now(), states.arrival[states.oldest()]);
  }
  [[nodiscard]] bool has_time() const noexcept {
    return link_->simulated_time() == nullptr || link_->simulated_time()->is_known();
  }
  [[nodiscard]] bool is_ready() noexcept {
    return has_time() && age_of(link_->states()) < stale_after_ && link_->has_reader();
  }
  void put_stop() noexcept {
    link_->put(detail::stop_command<Command, joint_count>(link_->states().state.position), false);
  }

  [[no_unique_address]] R robot_;
  std::unique_ptr<detail::TopicThread> thread_{};  ///< none: the program polls
  std::unique_ptr<Link> link_{};                   ///< ends before its transport
  std::chrono::nanoseconds stale_after_{}, silent_after_{}, set_up_time_{};
  std::string clock_topic_{}, states_topic_{}, commands_topic_{};
  Mode mode_ = Mode::inactive;
};

}  // namespace articula::ros2
