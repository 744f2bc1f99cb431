// SPDX-License-Identifier: Apache-2.0
/// @file A robot whose drives are on a CAN bus.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/hardware.hpp"
#include "articula/hardware/can/can_codec.hpp"
#include "articula/hardware/can/can_fault.hpp"
#include "articula/hardware/can/can_hardware_options.hpp"
#include "articula/hardware/can/can_transport.hpp"
#include "articula/hardware/can/find_drive_fault.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace articula {

/// A robot whose drives are on a CAN bus.
///
/// `write` sends the commands of a cycle and the frame that puts them into force; the drives answer
/// with feedback, which the next `read` takes in. Where another node begins the cycles of the bus
/// (see PacedCanCodec), it can pace the loop, and this is PacingHardware. Where the feedback of
/// some joint is missing, its last one is used until it is too old. When something is wrong for
/// good (see CanCause) while the drives are active, they are told to let go, in every cycle from
/// then on, until `activate` succeeds again: nothing starts to move by itself. docs/hardware.md has
/// a table of all faults.
/// @tparam R          the robot
/// @tparam Codec      the language of its drives
/// @tparam Transport  the way to the bus
template <Robot R, CanCodec Codec, CanTransport Transport>
class CanHardware {
 public:
  using RobotType = R;
  using Command = typename Codec::Command;
  static constexpr int joint_count = articula::joint_count<R>;
  static_assert(Codec::joint_count == joint_count, "the codec is for another number of joints");

  /// @param robot      whose joints the drives move
  /// @param codec      the drives' language
  /// @param transport  the way to the bus
  /// @throws std::invalid_argument as validate(options) says
  CanHardware(const R& robot, Codec codec, Transport transport,
              const CanHardwareOptions& options = {})
      : robot_(robot),
        codec_(std::move(codec)),
        transport_(std::move(transport)),
        options_(options) {
    validate(options);
  }
  /// For a robot known at compile time.
  CanHardware(Codec codec, Transport transport, const CanHardwareOptions& options = {})
    requires DescribedRobot<R>
      : CanHardware(R(), std::move(codec), std::move(transport), options) {}

  /// The one that is moved from has no drives any more.
  CanHardware(CanHardware&&) noexcept = default;
  CanHardware& operator=(CanHardware&&) = delete;

  /// Drives that are active are told to let go.
  ~CanHardware() {
    if (mode_ != Mode::inactive) static_cast<void>(deactivate());
  }

  /// Opens the way to the bus, anew if need be, clears faults and enables the drives.
  /// @return Status::ok when all drives are enabled and have reported where they are; else
  ///         Status::hardware_fault, and fault() tells why
  /// Real-time: no (waits for the drives).
  [[nodiscard]] Status activate() noexcept {
    mode_ = Mode::inactive;
    fault_ = {};
    dropped_ = not_sent_ = stale_ = unpaced_ = 0;
    codec_.restart();
    if (transport_.open(codec_.subscription()) != Status::ok) {
      fault_ = {CanCause::link_gone};
      return Status::hardware_fault;
    }
    drain();
    codec_.restart();  // what had been waiting in the receive queue told of the past
    const std::uint64_t heard_before = heard_cycles();
    const auto begin = transport_.now();
    bool is_ready = false;
    while (!is_ready) {
      const auto elapsed = transport_.now() - begin;
      if (elapsed > options_.set_up_time) break;
      CanBatch batch;
      const CanSetUp progress = codec_.set_up(elapsed, batch);
      if (!batch.empty()) static_cast<void>(offer_patiently(batch));
      if (progress == CanSetUp::failed) break;
      // A whole period from here on, however late it is: the drives are to answer before the next.
      listen_until(transport_.now() + options_.set_up_period);
      is_ready = progress == CanSetUp::done && all_young();
    }
    if (is_ready) {
      dropped_ = not_sent_ = 0;
      read_cycle_ = awaited_cycle_ = heard_cycles();
      mode_ = Mode::active;
      return Status::ok;
    }
    fault_ = find_activation_fault(reports(), options_.stale_after);
    if constexpr (ExplainingCanCodec<Codec>) fault_ = codec_.set_up_fault();
    const bool refused = fault_.abort_code != 0;
    if (is_paced && !refused && heard_cycles() == heard_before) fault_ = {CanCause::no_sync};
    static_cast<void>(stop());
    return Status::hardware_fault;
  }

  /// Tells the drives to let go and waits until they have; over a new way to the bus, if the old
  /// one is gone.
  /// @return Status::ok when all drives have reported it, else Status::hardware_fault
  /// Real-time: no (waits for the drives).
  [[nodiscard]] Status deactivate() noexcept {
    mode_ = Mode::inactive;
    if (transport_.link() == CanLink::gone &&
        transport_.open(codec_.subscription()) != Status::ok) {
      return Status::hardware_fault;
    }
    return stop();
  }

  /// Takes in what the drives have said and judges it.
  /// @param state  receives the last figures of each joint
  /// @return       Status::ok; Status::stale_state if a joint's figures are too old;
  ///               Status::hardware_fault if the link or a drive has failed, and fault() tells why;
  ///               Status::inactive while the drives are not active
  /// Real-time: yes, but for the bus.
  [[nodiscard]] Status read(JointState<joint_count>& state) noexcept {
    drain();
    if (is_paced) note_pace();
    if (mode_ == Mode::active) look_for_faults();
    bool stale = false, partial = false;
    for (int j = 0; j < joint_count; ++j) {
      const DriveReport& report = reports()[static_cast<std::size_t>(j)];
      state.position[j] = report.position;
      state.velocity[j] = report.velocity;
      state.effort[j] = report.effort;
      stale = stale || report.age >= options_.stale_after;
      partial = partial || report.age > 0;
    }
    if (partial) ++statistics_.partial;
    if (mode_ == Mode::faulted || transport_.link() != CanLink::up) return Status::hardware_fault;
    if (mode_ == Mode::inactive) return Status::inactive;
    return stale ? Status::stale_state : Status::ok;
  }

  /// Sends the commands of a cycle. While the drives are not active, they are told to let go
  /// instead, and go on reporting.
  /// @param command  per joint; if it is not finite, the drives get zero effort, zero velocity or
  ///                 the measured position instead
  /// @return         Status::ok, also while the bus is too busy for a cycle or two, whose commands
  ///                 are dropped; Status::non_finite_command; Status::hardware_fault if the bus
  ///                 takes nothing for as long as feedback may be missing, or after a fault;
  ///                 Status::inactive while the drives are not active
  /// Real-time: yes, but for the bus.
  [[nodiscard]] Status write(const Command& command) noexcept {
    ++statistics_.cycles;
    CanBatch batch;
    const bool finite = is_finite(command);
    if (mode_ == Mode::active) {
      codec_.encode(finite ? command : substitute(), batch);
    } else {
      codec_.encode_stop(batch);
    }
    const CanSending sending = offer(batch);
    count(sending);
    const bool bad = sending == CanSending::failed || dropped_ >= options_.stale_after;
    if (mode_ == Mode::active) judge(sending, bad);
    if (mode_ == Mode::faulted || bad) return Status::hardware_fault;
    if (mode_ == Mode::inactive) return Status::inactive;
    return finite ? Status::ok : Status::non_finite_command;
  }

  /// Waits until the bus's next cycle has begun and its feedback is there, or CanHardwareOptions's
  /// feedback_time is over. A cycle that has begun since this was called last counts as the next.
  /// @param timeout  longest time to wait for the beginning
  /// @return         Status::ok, Status::stale_state if no cycle began in time, or
  ///                 Status::hardware_fault, at once, while the link is not up
  /// Real-time: yes, but for the wait.
  [[nodiscard]] Status wait_for_cycle(std::chrono::nanoseconds timeout) noexcept
    requires PacedCanCodec<Codec>
  {
    const auto end = transport_.now() + timeout;
    drain();
    while (codec_.heard_cycles() == awaited_cycle_) {
      if (transport_.link() != CanLink::up) return Status::hardware_fault;
      const auto rest = end - transport_.now();
      if (rest.count() <= 0) return Status::stale_state;
      transport_.wait(rest);
      drain();
    }
    awaited_cycle_ = codec_.heard_cycles();
    // What is missing then, `read` tells.
    static_cast<void>(wait_for_feedback(options_.feedback_time));
    return Status::ok;
  }

  /// Waits until the feedback of all joints for the last cycle is there: for going through cycles
  /// as fast as drives without a clock of their own answer, as in tests.
  /// @param time  longest time to wait
  /// @return      Status::ok, or Status::stale_state if it did not come in time
  /// Real-time: yes, but for the wait.
  [[nodiscard]] Status wait_for_feedback(std::chrono::nanoseconds time) noexcept {
    const auto end = transport_.now() + time;
    for (;;) {
      drain();
      const bool complete =
          std::ranges::all_of(reports(), [](const DriveReport& r) { return r.age == 0; });
      if (complete) return Status::ok;
      const auto rest = end - transport_.now();
      if (rest.count() <= 0 || transport_.link() != CanLink::up) return Status::stale_state;
      transport_.wait(rest);
    }
  }

  /// Why `read`, `write` or `activate` answered Status::hardware_fault; CanCause::none if all is
  /// well. Real-time: yes.
  [[nodiscard]] const CanFault& fault() const noexcept { return fault_; }
  /// When the newest frame that was taken in arrived, by the transport's time stamps. Real-time:
  /// yes.
  [[nodiscard]] std::chrono::nanoseconds feedback_time() const noexcept { return feedback_time_; }
  [[nodiscard]] const CanStatistics& statistics() const noexcept { return statistics_; }
  [[nodiscard]] auto reports() const noexcept { return codec_.reports(); }
  [[nodiscard]] const Codec& codec() const noexcept { return codec_; }
  [[nodiscard]] Transport& transport() noexcept { return transport_; }
  [[nodiscard]] const Transport& transport() const noexcept { return transport_; }
  [[nodiscard]] const R& robot() const noexcept { return robot_; }

 private:
  enum class Mode : unsigned char { inactive, active, faulted };
  /// A mode that goes along when the hardware is moved, and leaves an inactive one behind.
  struct OwnMode {
    OwnMode() = default;
    OwnMode(OwnMode&& other) noexcept : mode(std::exchange(other.mode, Mode::inactive)) {}
    OwnMode& operator=(Mode other) noexcept { return mode = other, *this; }
    operator Mode() const noexcept { return mode; }
    Mode mode = Mode::inactive;
  };
  static constexpr bool is_paced = PacedCanCodec<Codec>;

  /// How many cycles another node has begun.
  [[nodiscard]] std::uint64_t heard_cycles() const noexcept {
    if constexpr (is_paced) return codec_.heard_cycles();
    return 0;
  }

  /// Counts the readings before which no cycle has begun.
  void note_pace() noexcept {
    const bool begun = heard_cycles() != read_cycle_;
    read_cycle_ = heard_cycles();
    unpaced_ = begun ? 0 : unpaced_ + 1;
    if (!begun) ++statistics_.unpaced;
  }

  /// Takes in what has arrived. A flood of frames does not hold up the loop: what is left after
  /// some hundred waits for the next cycle, or is lost in the kernel, which counts it.
  void drain() noexcept {
    constexpr int most_rounds = 8;
    for (int round = 0; round < most_rounds; ++round) {
      std::array<ReceivedCanFrame, 32> frames;
      const std::size_t count = transport_.receive(frames);
      for (std::size_t i = 0; i < count; ++i) take(frames[i]);
      if (count < frames.size()) return;
    }
  }

  void take(const ReceivedCanFrame& received) noexcept {
    const CanDecoding decoding = codec_.decode(received.frame);
    statistics_.count(decoding);
    if (decoding == CanDecoding::accepted) feedback_time_ = received.time;
  }

  void look_for_faults() noexcept {
    const CanCause link = cause_of(transport_.link());
    if (link != CanCause::none) return fail({link});
    if (unpaced_ >= options_.silent_after) return fail({CanCause::no_sync});
    const CanFault drive = find_drive_fault(reports(), options_.silent_after);
    if (drive.cause != CanCause::none) return fail(drive);
    // Feedback that comes in every cycle, but late.
    const auto oldest = std::ranges::max_element(reports(), {}, &DriveReport::age);
    stale_ = oldest->age >= options_.stale_after ? stale_ + 1 : 0;
    if (stale_ < options_.silent_after) return;
    fail({CanCause::drive_silent, static_cast<int>(oldest - reports().begin())});
  }

  void fail(const CanFault& fault) noexcept {
    fault_ = fault;
    mode_ = Mode::faulted;
  }

  /// What stands in for a command with a NaN or infinity.
  [[nodiscard]] Command substitute() const noexcept {
    Command command;
    if constexpr (std::same_as<Command, PositionCommand<joint_count>>) {
      for (int j = 0; j < joint_count; ++j) {
        command.position[j] = reports()[static_cast<std::size_t>(j)].position;
      }
    }
    return command;
  }

  /// Judges what became of a cycle's frames. Of an output that is bad for now, and not for good,
  /// the cause is there until the bus takes frames again.
  void judge(CanSending sending, bool bad) noexcept {
    const CanCause link = cause_of(transport_.link());
    if (sending == CanSending::failed && link != CanCause::none) return fail({link});
    if (not_sent_ >= options_.not_sent_after) return fail({CanCause::not_sent});
    fault_ = {bad ? CanCause::not_sent : CanCause::none};
  }

  [[nodiscard]] static bool is_taken(CanSending sending) noexcept {
    return sending == CanSending::sent || sending == CanSending::unconfirmed;
  }
  /// Offers a cycle's frames to the bus. Those before may have been on it without a sign of it
  /// having been fetched: then it is fetched, and they are offered again.
  [[nodiscard]] CanSending attempt(const CanBatch& batch) noexcept {
    const CanSending sending = transport_.send(batch);
    if (sending != CanSending::backlog) return sending;
    drain();
    return transport_.link() == CanLink::up ? transport_.send(batch) : CanSending::failed;
  }

  CanSending offer(const CanBatch& batch) noexcept { return settled(attempt(batch)); }

  /// Likewise, but waits one set-up period at most until those before have been on the bus.
  CanSending offer_patiently(const CanBatch& batch) noexcept {
    const auto end = transport_.now() + options_.set_up_period;
    CanSending sending = attempt(batch);
    for (auto rest = end - transport_.now(); sending == CanSending::backlog && rest.count() > 0;
         rest = end - transport_.now()) {
      transport_.wait(rest);
      sending = attempt(batch);
    }
    return settled(sending);
  }

  /// Takes back what the codec has noted of frames that the bus did not take.
  CanSending settled(CanSending sending) noexcept {
    if constexpr (requires { codec_.withdraw(); }) {
      if (!is_taken(sending)) codec_.withdraw();
    }
    return sending;
  }

  void count(CanSending sending) noexcept {
    if (sending == CanSending::unconfirmed) ++statistics_.unconfirmed;
    const bool taken = is_taken(sending);
    if (!taken) ++statistics_.not_sent;
    dropped_ = taken ? 0 : dropped_ + 1;
    not_sent_ = sending == CanSending::sent ? 0 : not_sent_ + 1;
  }

  /// What the drives have said is young enough to begin with.
  [[nodiscard]] bool all_young() const noexcept {
    return std::ranges::all_of(reports(), [this](const DriveReport& r) {
      return r.age < options_.stale_after || r.age == DriveReport::never;
    });
  }

  [[nodiscard]] bool all_let_go() const noexcept {
    if constexpr (requires { codec_.let_go(); }) {
      return codec_.let_go();
    } else {
      return std::ranges::all_of(reports(), [this](const DriveReport& r) {
        return !r.enabled && r.age < options_.stale_after;
      });
    }
  }

  /// Tells the drives to let go until all have said that they have, and releases them.
  [[nodiscard]] Status stop() noexcept {
    const Status status = let_go();
    release();
    return status;
  }

  [[nodiscard]] Status let_go() noexcept {
    // Set-up periods. Two accesses stop a drive; some answer each after 100 ms, and one may be lost.
    constexpr int patience = 300;
    for (int k = 0; k < patience; ++k) {
      CanBatch batch;
      codec_.encode_stop(batch);
      count(offer_patiently(batch));
      listen_until(transport_.now() + options_.set_up_period);
      if (all_let_go()) return Status::ok;
    }
    return Status::hardware_fault;
  }

  /// Takes the drives' watchdogs off, where the codec can.
  void release() noexcept {
    if constexpr (ReleasingCanCodec<Codec>) {
      constexpr std::chrono::milliseconds patience{250};  // an access may be lost, twice
      const auto begin = transport_.now();
      for (auto tick = begin; tick - begin <= patience; tick += options_.set_up_period) {
        CanBatch batch;
        if (codec_.release(tick - begin, batch) == CanSetUp::done) return;
        if (batch.empty()) codec_.encode_stop(batch);  // until then the watchdogs want commands
        count(offer_patiently(batch));
        listen_until(tick + options_.set_up_period);
      }
    }
  }

  void listen_until(std::chrono::nanoseconds end) noexcept {
    for (auto now = transport_.now(); now < end; now = transport_.now()) {
      transport_.wait(end - now);
      drain();
    }
  }

  [[no_unique_address]] R robot_;
  Codec codec_;
  Transport transport_;
  CanHardwareOptions options_;
  OwnMode mode_{};
  CanFault fault_{};
  std::uint32_t dropped_ = 0;     ///< cycles in a row that the bus did not take
  std::uint32_t not_sent_ = 0;    ///< cycles in a row that did not, or not surely, get onto it
  std::uint32_t stale_ = 0;       ///< readings in a row with figures of a joint that are too old
  std::uint32_t unpaced_ = 0;     ///< readings in a row before which no cycle of the bus had begun
  std::uint64_t read_cycle_ = 0;  ///< cycles that had been heard at the last reading
  std::uint64_t awaited_cycle_ = 0;  ///< and at the end of the last wait
  std::chrono::nanoseconds feedback_time_{};
  CanStatistics statistics_{};
};

}  // namespace articula
