// SPDX-License-Identifier: Apache-2.0
/// @file The language of CANopen drives of the profile CiA 402.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/hardware/can/can_codec.hpp"
#include "articula/hardware/can/can_fault.hpp"
#include "articula/hardware/can/nearest_units.hpp"
#include "articula/hardware/cia402/cia402.hpp"
#include "articula/hardware/cia402/cia402_drive.hpp"
#include "articula/hardware/cia402/cia402_feedback.hpp"
#include "articula/hardware/cia402/cia402_set_up.hpp"
#include "articula/hardware/cia402/cia402_stop.hpp"
#include "articula/hardware/cia402/sync_history.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace articula {

/// Codec of CANopen drives of the profile CiA 402 in a cyclic synchronous mode: torque, position or
/// velocity, after the type of the command. The set-up maps the process data:
///
/// | object | at SYNC | content |
/// |---|---|---|
/// | RPDO 1 | put into force | controlword, target |
/// | TPDO 1 | sent | statusword, position, torque |
/// | TPDO 2 | sent | velocity, error code |
///
/// Who sends SYNC is an option of the type. With SyncProducer::another_node the codec sends none:
/// one that is received begins the cycle and puts into force what was written before. It comes from
/// another device, one of the drives or a master (objects 1005h, 1006h), at the loop's period.
///
/// The drives are stopped by access to their objects as well as by RPDO, since no RPDO counts
/// without SYNC or out of the operational state.
///
/// Drives without torque, velocity or error code do without them: effort is 0 then, velocity the
/// difference of two positions. Mappings that a drive does not let change are used as they are, see
/// Cia402PdoSetUp.
///
/// A drive is to fault when RPDOs, or the host's heartbeats, stay away for the deadline, see
/// Cia402Watchdog. Other process data objects that a drive sends by itself are to be switched off
/// in its configuration: they would only load the bus.
/// @tparam R            the robot
/// @tparam CommandType  what the drives follow
/// @tparam Sync         who sends SYNC
template <Robot R,
          JointCommand<articula::joint_count<R>> CommandType =
              EffortCommand<articula::joint_count<R>>,
          SyncProducer Sync = SyncProducer::host>
class Cia402Codec {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  static constexpr cia402::Mode mode = cia402::mode_of<CommandType>;
  static constexpr bool sends_sync = Sync == SyncProducer::host;
  using Command = CommandType;
  static_assert(!std::same_as<Command, MultiModeCommand<joint_count>>,
                "CiA 402 has no mode for springs and dampers: command efforts, velocities or "
                "positions");
  static_assert(joint_count < static_cast<int>(CanBatch::capacity) / 2,
                "too many joints for one bus");

  /// @param robot     whose joints the drives move
  /// @param drives    in the order of the joints
  /// @param period    of the loop [ms], 1 .. 255
  /// @param deadline  longest time without commands that the drives are to accept [ms]
  /// @throws std::invalid_argument as validate says, if a time is 0, or if the period is not below
  /// the deadline of a drive's watchdog
  Cia402Codec(const R& robot, const Cia402DriveList<joint_count>& drives, std::uint8_t period = 1,
              std::uint16_t deadline = 10)
      : drives_(drives),
        cycles_per_beat_(std::max(1, deadline / (3 * std::max<int>(1, period)))),
        set_ups_(make_set_ups(drives, period, deadline,
                              std::make_index_sequence<static_cast<std::size_t>(joint_count)>())) {
    validate(robot, drives);
    for (const Cia402Drive& drive : drives) {
      if (drive.watchdog == Cia402Watchdog::heartbeat) host_node_ = drive.host_node;
    }
    joint_of_node_.fill(joint_count);
    for (std::size_t j = 0; j < count; ++j) {
      joint_of_node_[drives[j].node] = static_cast<std::uint8_t>(j);
    }
    if (period == 0) throw std::invalid_argument("CiA 402: the period is 0 ms");
    if (deadline == 0) throw std::invalid_argument("CiA 402: the deadline is 0 ms");
    for (std::size_t j = 0; j < count; ++j) {
      if (drives[j].watchdog == Cia402Watchdog::none || period < deadline) continue;
      detail::refuse({"CiA 402 drive of '", model_of(robot).joints[j].name.view(),
                      "': the loop's period of ", int{period},
                      " ms is not below the deadline of its watchdog, ", int{deadline},
                      " ms; give the codec a longer deadline, best three periods or more"});
    }
  }
  /// For a robot known at compile time.
  explicit Cia402Codec(const Cia402DriveList<joint_count>& drives, std::uint8_t period = 1,
                       std::uint16_t deadline = 10)
    requires DescribedRobot<R>
      : Cia402Codec(R(), drives, period, deadline) {}

  /// Real-time: no (allocates).
  [[nodiscard]] CanSubscription subscription() const {
    CanSubscription subscription{.last_of_cycle = canopen::sync_identifier,
                                 .frames_per_cycle = count + most_accesses + 1};
    if (!sends_sync) {
      subscription.identifiers.push_back(canopen::sync_identifier);
      subscription.last_of_cycle = canopen::receive_pdo_1_base + drives_.back().node;
      subscription.frames_per_cycle = count + most_accesses;
    }
    if (host_node_ != 0) ++subscription.frames_per_cycle;
    for (const Cia402Drive& drive : drives_) {
      for (const std::uint32_t base :
           {canopen::transmit_pdo_1_base, canopen::transmit_pdo_2_base,
            canopen::transmit_pdo_3_base, canopen::transmit_pdo_4_base, canopen::emergency_base,
            canopen::sdo_answer_base, canopen::heartbeat_base}) {
        subscription.identifiers.push_back(base + drive.node);
      }
    }
    return subscription;
  }

  /// Forgets what the drives have said. Real-time: yes.
  void restart() noexcept {
    reports_.fill({});
    syncs_ = {};
    next_stop_ = 0;
    for (Cia402Feedback& feedback : feedbacks_) feedback.restart();
    since_beat_ = cycles_per_beat_;
    for (Cia402Stop& stop : stops_) stop.restart();
    for (Cia402SetUp& set_up : set_ups_) set_up.restart();
  }

  /// Brings all drives to operation enabled, side by side, then begins a cycle with each call and
  /// is done when all have said where they are. Real-time: yes. O(N).
  [[nodiscard]] CanSetUp set_up(std::chrono::nanoseconds elapsed, CanBatch& batch) noexcept {
    bool all_enabled = true, all_known = true, all_follow = true;
    for (std::size_t j = 0; j < drives_.size(); ++j) {
      const std::size_t before = batch.size();
      const CanSetUp progress = set_ups_[j].advance(elapsed, batch);
      if (progress == CanSetUp::failed) return progress;
      if (batch.size() != before) feedbacks_[j].place_mark(set_ups_[j].object(), syncs_);
      all_enabled = all_enabled && progress == CanSetUp::done;
      const bool known = reports_[j].age < doubtful_age && reports_[j].enabled;
      if (!known) set_ups_[j].doubt(elapsed);
      all_known = all_known && known;
      all_follow = all_follow && feedbacks_[j].has_followed();
    }
    if (!all_known) known_since_ = elapsed;
    if (!all_enabled) {
      if (sends_sync) begin_cycle(false);
      return CanSetUp::in_progress;
    }
    push_marks(batch);
    if (sends_sync) end_output(batch);
    // A drive may take a moment until it follows its target. Some follow and never say so.
    const bool never_said = elapsed - known_since_ >= canopen::SdoClient::patience;
    return all_known && (all_follow || never_said) ? CanSetUp::done : CanSetUp::in_progress;
  }

  /// Takes the watchdogs off the drives, so that none of them faults when commands end. A drive that
  /// may exert effort yet keeps its own: that is what is left to stop it.
  /// @param elapsed  since the release began; zero at first
  /// Real-time: yes. O(N).
  [[nodiscard]] CanSetUp release(std::chrono::nanoseconds elapsed, CanBatch& batch) noexcept {
    bool all_done = true;
    for (std::size_t j = 0; j < drives_.size(); ++j) {
      if (elapsed.count() == 0) set_ups_[j].begin_release();
      if (feedbacks_[j].powered()) continue;
      all_done = set_ups_[j].advance(elapsed, batch) == CanSetUp::done && all_done;
    }
    return all_done ? CanSetUp::done : CanSetUp::in_progress;
  }

  /// Why the set-up has failed or is not done: the first drive that has refused, or else the first
  /// that is not ready, and the object with which it is at. Real-time: yes. O(N).
  [[nodiscard]] CanFault set_up_fault() const noexcept {
    const auto first = [](auto condition) {
      std::size_t j = 0;
      while (j < count && !condition(j)) ++j;
      return j;
    };
    std::size_t j = first([this](std::size_t k) { return set_ups_[k].failed(); });
    if (j == count) j = first([this](std::size_t k) { return !set_ups_[k].ended(); });
    if (j == count) j = first([this](std::size_t k) { return !reports_[k].enabled; });
    if (j == count) return {CanCause::no_activation};
    const Cia402SetUp& set_up = set_ups_[j];
    return {set_up.lacks_watchdog() ? CanCause::no_watchdog : CanCause::no_activation,
            static_cast<int>(j), reports_[j].fault, set_up.object(), set_up.abort_code()};
  }

  /// An RPDO for each drive, in the drive's units, rounded and held within their range, and SYNC if
  /// it is ours. A NaN gives zero; for a position, the measured one. Real-time: yes. O(N).
  void encode(const Command& command, CanBatch& batch) noexcept {
    if (host_node_ != 0) push_heartbeat(batch);
    if (syncs_.is_missing())
      push_marks(batch);  // commands last: the transport looks for the end of a cycle's output
    for (std::size_t j = 0; j < drives_.size(); ++j) {
      push_command(j, cia402::enable_operation, target(command, j), batch);
    }
    end_output(batch);
  }

  /// Takes the power from all drives: by RPDO, and by access to its objects from each drive that
  /// has not yet said that it has none. Real-time: yes. O(N).
  void encode_stop(CanBatch& batch) noexcept {
    if (host_node_ != 0) push_heartbeat(batch);
    if (syncs_.is_missing() || syncs_.cycle() >= next_stop_) push_stops(batch);
    Command still;
    for (std::size_t j = 0; j < drives_.size(); ++j) {
      if constexpr (std::same_as<Command, PositionCommand<joint_count>>) {
        still.position[static_cast<int>(j)] = reports_[j].position;
      }
      push_command(j, cia402::disable_voltage, target(still, j), batch);
    }
    end_output(batch);
  }

  /// The bus did not take all frames of the last output, so it did not take SYNC, the last.
  /// Real-time: yes. O(N).
  void cancel_output() noexcept {
    if (sends_sync) syncs_.withdraw_sync();
    for (Cia402Stop& stop : stops_) stop.withdraw();
    for (Cia402Feedback& feedback : feedbacks_) feedback.withdraw();
    syncs_.note_missing();
  }

  /// Takes in a drive's frame. Real-time: yes. O(1).
  [[nodiscard]] CanDecoding decode(const CanFrame& frame) noexcept {
    if (frame.extended) return CanDecoding::foreign;
    if (!sends_sync && frame.identifier == canopen::sync_identifier) return take_sync(frame);
    const std::size_t j = joint_of_node_[frame.identifier % nodes];
    if (j == count) return CanDecoding::foreign;
    switch (frame.identifier - frame.identifier % nodes) {
      case canopen::transmit_pdo_1_base:
        return take_transmit_pdo<0>(frame, j);
      case canopen::transmit_pdo_2_base:
        return take_transmit_pdo<1>(frame, j);
      case canopen::transmit_pdo_3_base:
        return take_transmit_pdo<2>(frame, j);
      case canopen::transmit_pdo_4_base:
        return take_transmit_pdo<3>(frame, j);
      default:
        return take_other(frame, j);
    }
  }

  /// What the drives have said. Real-time: yes.
  [[nodiscard]] std::span<const DriveReport, static_cast<std::size_t>(joint_count)> reports()
      const noexcept {
    return reports_;
  }
  /// Whether all drives have said that they exert nothing. Real-time: yes.
  [[nodiscard]] bool all_off() const noexcept {
    return std::ranges::none_of(feedbacks_, [](const Cia402Feedback& f) { return f.powered(); });
  }
  /// How far the set-up of one drive is, for messages. Real-time: yes.
  [[nodiscard]] const Cia402SetUp& set_up_of(int joint) const noexcept {
    return set_ups_[static_cast<std::size_t>(joint)];
  }
  [[nodiscard]] const Cia402DriveList<joint_count>& drives() const noexcept { return drives_; }
  /// How many SYNC of another node have been heard. Real-time: yes.
  [[nodiscard]] std::uint64_t begun_cycles() const noexcept
    requires(!sends_sync)
  {
    return begun_cycles_;
  }

 private:
  template <std::size_t... J>
  static std::array<Cia402SetUp, sizeof...(J)> make_set_ups(
      const Cia402DriveList<joint_count>& drives, std::uint8_t period, std::uint16_t deadline,
      std::index_sequence<J...>) {
    return {Cia402SetUp(drives[J], mode, period, deadline, Sync)...};
  }

  [[nodiscard]] std::int32_t target(const Command& command, std::size_t j) const noexcept {
    const Cia402Drive& drive = drives_[j];
    const auto i = static_cast<int>(j);
    constexpr double most = 2147483647;
    if constexpr (std::same_as<Command, PositionCommand<joint_count>>) {
      const double q = is_finite(command.position[i]) ? command.position[i] : reports_[j].position;
      return nearest_units(q * drive.position_scale + drive.zero_position, most);
    } else if constexpr (std::same_as<Command, VelocityCommand<joint_count>>) {
      return is_finite(command.velocity[i])
                 ? nearest_units(command.velocity[i] * drive.velocity_scale, most)
                 : 0;
    } else {
      return is_finite(command.effort[i])
                 ? nearest_units(command.effort[i] / drive.rated_effort * 1e3, 32767)
                 : 0;
    }
  }

  void push_command(std::size_t j, std::uint16_t controlword, std::int32_t target,
                    CanBatch& batch) const noexcept {
    using Target =
        std::conditional_t<cia402::target_of(mode).size == 2, std::int16_t, std::int32_t>;
    const cia402::ReceiveLayout& layout = set_ups_[j].process_data().receive;
    if (!batch.push_back(layout.frame)) return;
    std::array<std::uint8_t, 8>& data = batch.back().data;
    store_little_endian(data, layout.controlword, controlword);
    store_little_endian(data, layout.target, static_cast<Target>(target));
  }

  void push_heartbeat(CanBatch& batch) noexcept {
    if (++since_beat_ < cycles_per_beat_) return;
    since_beat_ = 0;
    batch.push_back(canopen::encode(canopen::NmtState::operational, host_node_));
  }

  /// Appends what a few drives in turn need beside their process data.
  /// @param append_for  appends frames for a drive, and says how many
  template <class Append>
  void access(Append append_for) noexcept {
    std::size_t frames = 0;
    for (std::size_t k = 0; k < drives_.size() && frames < most_accesses; ++k) {
      frames += append_for(next_drive_);
      next_drive_ = (next_drive_ + 1) % drives_.size();
    }
    if (frames < most_accesses) syncs_.forget_missing();
  }
  std::size_t push_mark(std::size_t j, CanBatch& batch) noexcept {
    const auto request = feedbacks_[j].next_mark(set_ups_[j].process_data().stream_count, syncs_);
    if (!request) return 0;
    return batch.push_back(canopen::encode_request(*request, drives_[j].node)) ? 1 : 0;
  }
  // Seldom needed; inlined, they would cost each cycle some registers.
  [[gnu::noinline]] void push_marks(CanBatch& batch) noexcept {
    access([&](std::size_t j) { return push_mark(j, batch); });
  }
  [[gnu::noinline]] void push_stops(CanBatch& batch) noexcept {
    next_stop_ = syncs_.cycle() + Cia402Stop::patience;
    access([&](std::size_t j) {
      // How old the feedback of a drive without power is does not matter.
      if (!feedbacks_[j].powered()) return std::size_t{0};
      return stops_[j].advance(drives_[j].node, syncs_.cycle(), batch);
    });
  }

  void begin_cycle(bool with_sync) noexcept {
    syncs_.begin_cycle(with_sync);
    for (DriveReport& report : reports_) {
      if (report.age < DriveReport::never - 1) ++report.age;
    }
  }

  /// After the commands of a cycle.
  void end_output(CanBatch& batch) noexcept {
    if (sends_sync) {
      begin_cycle(true);
      batch.push_back(canopen::encode_sync());
    } else {
      if (!heard_) begin_cycle(false);  // what is known grows older without SYNC, too
      heard_ = false;
    }
  }

  [[nodiscard]] CanDecoding take_sync(const CanFrame& frame) noexcept {
    if (frame.length > 1) return CanDecoding::malformed;  // 1: with a counter, of no use here
    begin_cycle(true);
    heard_ = true;
    ++begun_cycles_;
    return CanDecoding::accepted;
  }

  template <std::size_t Number>
  [[nodiscard]] CanDecoding take_transmit_pdo(const CanFrame& frame, std::size_t j) noexcept {
    if constexpr (Number < cia402::usual_transmit.size()) {
      const bool taken = feedbacks_[j].template take_usual<Number>(
          frame, set_ups_[j].process_data(), drives_[j], syncs_, reports_[j]);
      if (taken) [[likely]]
        return CanDecoding::accepted;
    }
    return take_unusual(frame, j, Number);
  }
  // Functions of their own: inlined, they would cost each frame some registers.
  [[nodiscard, gnu::noinline]] CanDecoding take_unusual(const CanFrame& frame, std::size_t j,
                                                        std::size_t number) noexcept {
    const cia402::ProcessData& data = set_ups_[j].process_data();
    return feedbacks_[j].take_transmit_pdo(data.transmit[number], frame, data, drives_[j], syncs_,
                                           reports_[j]);
  }
  [[nodiscard, gnu::noinline]] CanDecoding take_other(const CanFrame& frame,
                                                      std::size_t j) noexcept {
    switch (frame.identifier - drives_[j].node) {
      case canopen::emergency_base:
        return feedbacks_[j].take_emergency(frame);
      case canopen::sdo_answer_base:
        return take_answer(j, frame);
      case canopen::heartbeat_base:
        if (const auto state = canopen::decode_heartbeat(frame)) {
          // A node that is not operational, such as one that has restarted, obeys no process data.
          if (*state != canopen::NmtState::operational) reports_[j].enabled = false;
          return CanDecoding::accepted;
        }
        return CanDecoding::malformed;
      default:
        return CanDecoding::foreign;
    }
  }

  [[nodiscard]] CanDecoding take_answer(std::size_t j, const CanFrame& frame) noexcept {
    const auto answer = canopen::decode_answer(frame);
    if (!answer) return CanDecoding::malformed;
    set_ups_[j].take(*answer);
    feedbacks_[j].take_answer(answer->address, set_ups_[j].process_data().stream_count, syncs_,
                              Sync);
    syncs_.note_missing();
    if (const auto statusword = stops_[j].take(*answer)) {
      feedbacks_[j].take_statusword(*statusword);
    }
    return CanDecoding::accepted;
  }

  static constexpr auto count = static_cast<std::size_t>(joint_count);
  static constexpr std::uint32_t nodes = canopen::last_node + 1;  ///< a power of two: of 7 bits
  /// Frames of access to objects in a cycle, at most: the queue of a CAN interface takes ten frames
  /// by default, and commands and SYNC need room.
  static constexpr std::size_t most_accesses = count < 7 ? 8 - count : 1;
  /// Cycles without feedback after which the set-up does not trust that a drive is enabled.
  static constexpr std::uint32_t doubtful_age = 20;

  Cia402DriveList<joint_count> drives_;
  std::array<std::uint8_t, nodes> joint_of_node_{};  ///< joint_count for those of nobody
  int cycles_per_beat_;  ///< three heartbeats within the deadline, so that two may be lost; one in
                         ///< each cycle where the period is above a third of the deadline
  std::array<Cia402SetUp, count> set_ups_;
  std::array<Cia402Stop, count> stops_{};
  std::array<Cia402Feedback, count> feedbacks_{};
  std::array<DriveReport, count> reports_{};
  SyncHistory syncs_{};
  std::size_t next_drive_ = 0;              ///< whose turn it is for an access
  std::uint64_t next_stop_ = 0;             ///< while stopping: when it may at the latest
  std::chrono::nanoseconds known_since_{};  ///< all drives were enabled and had reported
  std::uint8_t host_node_ = 0;  ///< that the host's heartbeats come from; 0: there are none
  int since_beat_ = 0;          ///< cycles since the last one
  bool heard_ = false;          ///< SYNC has come since the last output
  std::uint64_t begun_cycles_ = 0;
};

}  // namespace articula
