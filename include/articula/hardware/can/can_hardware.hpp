// SPDX-License-Identifier: Apache-2.0
/// @file The driver of a robot whose drives are on a CAN bus.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/hardware.hpp"
#include "articula/hardware/can/can_exchange.hpp"
#include "articula/hardware/can/can_fault_search.hpp"
#include "articula/hardware/can/can_set_up.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>
#include <chrono>
#include <concepts>
#include <cstdint>
#include <utility>

namespace articula {

/// A robot whose drives are on a CAN bus, as hardware of a Loop.
///
///     using Arm = CanHardware<MyArm, Cia402Codec<MyArm>, SocketCan>;
///     Loop<Arm, PidPlusGravity> loop(Arm(Cia402Codec<MyArm>(drives), SocketCan("can0")));
///
/// - `write` sends the commands of a cycle and the frame that puts them into force. The drives
///   answer with feedback, which the next `read` decodes.
/// - Where another node begins the cycles of the bus (see PacedCanCodec), that node can pace the
///   loop; this class is PacingHardware then.
/// - Where the feedback of a joint is missing, its last figures stay until they are too old.
/// - A lasting fault (see CanCause) while the drives are active disables them in every cycle, until
///   `activate` succeeds again. Nothing starts to move by itself.
///
/// docs/hardware.md has a table of all faults. For drives on EtherCAT or a serial line, write a
/// type that satisfies Hardware instead.
/// @tparam R          the robot
/// @tparam Codec      language of its drives
/// @tparam Transport  access to the bus
template <Robot R, CanCodec Codec, CanTransport Transport>
class CanHardware {
 public:
  using RobotType = R;
  using Command = typename Codec::Command;
  static constexpr int joint_count = articula::joint_count<R>;
  static_assert(Codec::joint_count == joint_count, "the codec is for another number of joints");

  /// @param robot      whose joints the drives move
  /// @param codec      language of the drives
  /// @param transport  access to the bus
  /// @param options    ages and times from which something counts as a fault
  /// @throws std::invalid_argument as validate(options)
  CanHardware(const R& robot, Codec codec, Transport transport,
              const CanHardwareOptions& options = {})
      : robot_(robot), exchange_{std::move(codec), std::move(transport)}, options_(options) {
    validate(options);
  }
  /// For a robot known at compile time.
  CanHardware(Codec codec, Transport transport, const CanHardwareOptions& options = {})
    requires DescribedRobot<R>
      : CanHardware(R(), std::move(codec), std::move(transport), options) {}

  /// The object that is moved from has no drives any more.
  CanHardware(CanHardware&&) noexcept = default;
  CanHardware& operator=(CanHardware&&) = delete;

  /// Disables drives that are active.
  ~CanHardware() {
    if (mode_ != Mode::inactive) static_cast<void>(deactivate());
  }

  /// Opens the transport, clears faults and enables the drives.
  /// @return Status::ok when all drives are enabled and have reported, else Status::hardware_fault
  /// Real-time: no (waits for the drives).
  [[nodiscard]] Status activate() noexcept {
    mode_ = Mode::inactive;
    fault_ = {};
    exchange_.dropped = exchange_.unconfirmed = 0;
    search_.restart();
    exchange_.codec.restart();
    if (exchange_.transport.open(exchange_.codec.subscription()) != Status::ok) {
      fault_ = {CanCause::link_gone};
      return Status::hardware_fault;
    }
    exchange_.receive();
    exchange_.codec.restart();  // frames that were in the receive queue are from the past
    fault_ = detail::set_up_drives(exchange_, options_);
    if (fault_.cause != CanCause::none) {
      static_cast<void>(detail::stop_drives(exchange_, options_));
      return Status::hardware_fault;
    }
    exchange_.dropped = exchange_.unconfirmed = 0;
    awaited_cycle_ = exchange_.begun_cycles();
    static_cast<void>(search_.note_cycles(awaited_cycle_));
    search_.restart();
    mode_ = Mode::active;
    return Status::ok;
  }

  /// Disables the drives. If the link is gone, it opens the transport again first.
  /// @return Status::ok when all drives have reported it, else Status::hardware_fault
  /// Real-time: no (waits for the drives).
  [[nodiscard]] Status deactivate() noexcept {
    mode_ = Mode::inactive;
    if (exchange_.transport.link() == CanLink::gone &&
        exchange_.transport.open(exchange_.codec.subscription()) != Status::ok) {
      return Status::hardware_fault;
    }
    return detail::stop_drives(exchange_, options_);
  }

  /// Decodes the drives' frames and searches for faults.
  /// @param state  receives the last figures of each joint
  /// @return       Status::ok. Status::stale_state if a joint's figures are too old.
  ///               Status::hardware_fault if the link or a drive has failed, see fault().
  ///               Status::inactive while the drives are not active.
  /// Real-time: yes, but for the bus.
  [[nodiscard]] Status read(JointState<joint_count>& state) noexcept {
    exchange_.receive();
    if (is_paced && !search_.note_cycles(exchange_.begun_cycles())) ++exchange_.statistics.unpaced;
    const CanCause link = cause_of(exchange_.transport.link());
    if (mode_ == Mode::active)
      fail_on(search_.find(exchange_.transport.link(), reports(), options_));
    if (mode_ == Mode::inactive && link != CanCause::none) fault_ = {link};
    bool stale = false, partial = false;
    int j = 0;
    for (const DriveReport& report : reports()) {
      state.position[j] = report.position;
      state.velocity[j] = report.velocity;
      state.effort[j++] = report.effort;
      stale = stale || report.age >= options_.stale_after;
      partial = partial || report.age > 0;
    }
    if (partial) ++exchange_.statistics.partial;
    if (mode_ == Mode::faulted || link != CanCause::none) return Status::hardware_fault;
    if (mode_ == Mode::inactive) return Status::inactive;
    return stale ? Status::stale_state : Status::ok;
  }

  /// Sends the commands of a cycle. While the drives are not active, it sends the stop instead; the
  /// drives keep reporting.
  /// @param command  per joint; if it is not finite, the drives get zero effort, zero velocity or
  ///                 the measured position instead
  /// @return         Status::ok, also if the bus has dropped the commands of fewer than
  ///                 `stale_after` cycles. Status::hardware_fault if it has dropped more, or after
  ///                 a fault. Status::non_finite_command. Status::inactive while the drives are not
  ///                 active.
  /// Real-time: yes, but for the bus.
  [[nodiscard]] Status write(const Command& command) noexcept {
    ++exchange_.statistics.cycles;
    CanBatch batch;
    const bool finite = is_finite(command);
    if (mode_ == Mode::active) {
      exchange_.codec.encode(finite ? command : substitute(), batch);
    } else {
      exchange_.codec.encode_stop(batch);
    }
    const CanSending sending = exchange_.send(batch);
    exchange_.count(sending);
    const bool bad = sending == CanSending::failed || exchange_.dropped >= options_.stale_after;
    judge(sending, bad);
    if (mode_ == Mode::faulted || bad) return Status::hardware_fault;
    if (mode_ == Mode::inactive) return Status::inactive;
    return finite ? Status::ok : Status::non_finite_command;
  }

  /// Waits until the bus's next cycle has begun, then at most CanHardwareOptions::feedback_time for
  /// its feedback. A cycle that has begun since the last call counts as the next.
  /// @param timeout  longest time to wait for the beginning
  /// @return         Status::ok, Status::stale_state if no cycle began in time, or
  ///                 Status::hardware_fault, at once, while the link is not up
  /// Real-time: yes, but for the wait.
  [[nodiscard]] Status wait_for_cycle(std::chrono::nanoseconds timeout) noexcept
    requires PacedCanCodec<Codec>
  {
    const Status status = exchange_.receive_until(
        timeout, [this] { return exchange_.begun_cycles() != awaited_cycle_; });
    if (status != Status::ok) return status;
    awaited_cycle_ = exchange_.begun_cycles();
    static_cast<void>(wait_for_feedback(options_.feedback_time));  // `read` reports what is missing
    return Status::ok;
  }

  /// Waits until the feedback of all joints for the last cycle has arrived, as tests in lockstep
  /// do.
  /// @param time  longest time to wait
  /// @return      Status::ok, or Status::stale_state if it did not arrive in time
  /// Real-time: yes, but for the wait.
  [[nodiscard]] Status wait_for_feedback(std::chrono::nanoseconds time) noexcept {
    const bool complete = Status::ok == exchange_.receive_until(time, [this] {
      return std::ranges::all_of(reports(), [](const DriveReport& r) { return r.age == 0; });
    });
    return complete ? Status::ok : Status::stale_state;
  }

  /// The cause of the last Status::hardware_fault; CanCause::none without one. Real-time: yes.
  [[nodiscard]] const CanFault& fault() const noexcept { return fault_; }
  /// Arrival of the newest accepted frame, by the transport's time stamps. Real-time: yes.
  [[nodiscard]] std::chrono::nanoseconds feedback_time() const noexcept {
    return exchange_.feedback_time;
  }
  [[nodiscard]] const CanStatistics& statistics() const noexcept { return exchange_.statistics; }
  [[nodiscard]] decltype(auto) reports() const noexcept { return exchange_.codec.reports(); }
  [[nodiscard]] const Codec& codec() const noexcept { return exchange_.codec; }
  [[nodiscard]] Transport& transport() noexcept { return exchange_.transport; }
  [[nodiscard]] const Transport& transport() const noexcept { return exchange_.transport; }
  [[nodiscard]] const R& robot() const noexcept { return robot_; }

 private:
  enum class Mode : unsigned char { inactive, active, faulted };
  /// A mode that moves with the hardware. The object that is moved from becomes inactive.
  struct OwnMode {
    OwnMode() = default;
    OwnMode(OwnMode&& other) noexcept : mode(std::exchange(other.mode, Mode::inactive)) {}
    OwnMode& operator=(Mode other) noexcept { return mode = other, *this; }
    operator Mode() const noexcept { return mode; }
    Mode mode = Mode::inactive;
  };
  static constexpr bool is_paced = PacedCanCodec<Codec>;

  void fail_on(const CanFault& fault) noexcept {
    if (fault.cause == CanCause::none) return;
    fault_ = fault;
    mode_ = Mode::faulted;
  }

  /// The command that replaces one with a NaN or infinity.
  [[nodiscard]] Command substitute() const noexcept {
    Command command;
    if constexpr (std::same_as<Command, PositionCommand<joint_count>>) {
      int j = 0;
      for (const DriveReport& report : reports()) command.position[j++] = report.position;
    }
    return command;
  }

  /// Sets the fault after sending. A temporary fault lasts until the bus takes frames again.
  void judge(CanSending sending, bool bad) noexcept {
    const CanCause link = cause_of(exchange_.transport.link());
    if (mode_ == Mode::inactive && bad) {
      fault_ = {link != CanCause::none ? link : CanCause::not_sent};
    }
    if (mode_ != Mode::active) return;
    if (sending == CanSending::failed && link != CanCause::none) return fail_on({link});
    if (exchange_.unconfirmed >= options_.not_sent_after) return fail_on({CanCause::not_sent});
    fault_ = {bad ? CanCause::not_sent : CanCause::none};
  }

  [[no_unique_address]] R robot_;
  detail::CanExchange<Codec, Transport> exchange_;
  CanHardwareOptions options_;
  OwnMode mode_{};
  CanFault fault_{};
  detail::CanFaultSearch search_{};
  std::uint64_t awaited_cycle_ = 0;  ///< cycles that had begun at the end of the last wait
};

}  // namespace articula
