// SPDX-License-Identifier: Apache-2.0
/// @file The codec of CANopen drives of the profile CiA 402.
#pragma once

#include "articula/hardware/can/can_codec.hpp"
#include "articula/hardware/can/can_fault.hpp"
#include "articula/hardware/cia402/cia402.hpp"
#include "articula/hardware/cia402/cia402_channels.hpp"
#include "articula/hardware/cia402/cia402_drive.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>

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
/// - With SyncProducer::another_node the codec sends no SYNC. A drive or a master (objects 1005h,
///   1006h) sends it, at the loop's period. Each SYNC begins a cycle.
/// - The stop uses RPDOs and access to objects, because RPDOs need SYNC and the operational state.
/// - Without torque and error code in a drive, they are 0. Without velocity, it is the difference
///   of two positions. Mappings that a drive does not let change are used as they are, see
///   Cia402PdoSetUp.
/// - The watchdog of a drive watches RPDOs or the host's heartbeats, see Cia402Watchdog.
/// - Switch off other process data objects in the drives' configuration: they load the bus.
///
/// For springs and dampers in the command (MultiModeCommand), put HostSprings around the driver.
/// @tparam R            the robot
/// @tparam CommandType  efforts, positions or velocities
/// @tparam Sync         sender of SYNC
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
                "positions, or put HostSprings around the driver");
  static_assert(joint_count < static_cast<int>(CanBatch::capacity) / 2,
                "too many joints for one bus");

  /// @param robot     whose joints the drives move
  /// @param drives    in the order of the joints
  /// @param period    of the loop [ms], 1 .. 255
  /// @param deadline  of the drives' watchdogs: longest time without commands [ms]
  /// @throws std::invalid_argument as validate(robot, drives), if a time is 0, or if the period is
  ///         not below the deadline of a watchdog
  Cia402Codec(const R& robot, const Cia402DriveList<joint_count>& drives, std::uint8_t period = 1,
              std::uint16_t deadline = 10)
      : cycles_per_heartbeat_(std::max(1, deadline / (3 * std::max<int>(1, period)))) {
    validate(robot, drives);
    if (period == 0) detail::refuse({"CiA 402: the period is 0 ms"});
    if (deadline == 0) detail::refuse({"CiA 402: the deadline is 0 ms"});
    joint_of_node_.fill(joint_count);
    for (std::size_t j = 0; j < drives.size(); ++j) {
      const Cia402Drive& drive = drives[j];
      if (drive.watchdog != Cia402Watchdog::none && period >= deadline) {
        detail::refuse({"CiA 402 drive of '", model_of(robot).joints[j].name.view(),
                        "': the loop's period of ", int{period},
                        " ms is not below the deadline of its watchdog, ", int{deadline},
                        " ms; give the codec a longer deadline, best three periods or more"});
      }
      if (drive.watchdog == Cia402Watchdog::heartbeat) host_node_ = drive.host_node;
      joint_of_node_[drive.node] = static_cast<std::uint8_t>(j);
      drives_.channels[j] = Cia402Channel(drive, mode, period, deadline, Sync);
    }
  }
  /// For a robot known at compile time.
  explicit Cia402Codec(const Cia402DriveList<joint_count>& drives, std::uint8_t period = 1,
                       std::uint16_t deadline = 10)
    requires DescribedRobot<R>
      : Cia402Codec(R(), drives, period, deadline) {}

  /// Real-time: no (allocates).
  [[nodiscard]] CanSubscription subscription() const {
    CanSubscription subscription{
        .last_of_cycle = canopen::sync_identifier,
        .frames_per_cycle = joint_count + Cia402Channels<joint_count>::most_accesses + 1};
    if (!sends_sync) {
      subscription.identifiers.push_back(canopen::sync_identifier);
      subscription.last_of_cycle = canopen::receive_pdo_1_base + drives_.channels.back().drive.node;
      --subscription.frames_per_cycle;
    }
    if (host_node_ != 0) ++subscription.frames_per_cycle;
    for (const Cia402Channel& channel : drives_.channels) {
      for (const std::uint32_t base :
           {canopen::transmit_pdo_1_base, canopen::transmit_pdo_2_base,
            canopen::transmit_pdo_3_base, canopen::transmit_pdo_4_base, canopen::emergency_base,
            canopen::sdo_answer_base, canopen::heartbeat_base}) {
        subscription.identifiers.push_back(base + channel.drive.node);
      }
    }
    return subscription;
  }

  /// Clears all that the drives have reported. Real-time: yes.
  void restart() noexcept {
    drives_.restart();
    since_heartbeat_ = cycles_per_heartbeat_;
  }

  /// Enables all drives at the same time. Then each call begins a cycle; it is done when all drives
  /// have reported. Real-time: yes. O(N).
  [[nodiscard]] CanSetUp set_up(std::chrono::nanoseconds elapsed, CanBatch& batch) noexcept {
    const CanSetUp progress = drives_.enable(elapsed, batch);
    if (progress == CanSetUp::in_progress && sends_sync) drives_.begin_cycle(false);
    if (progress != CanSetUp::done) return progress;
    drives_.push_marks(batch);
    if (sends_sync) end_output(batch);
    return drives_.all_ready(elapsed) ? CanSetUp::done : CanSetUp::in_progress;
  }
  /// Switches the drives' watchdogs off, so that no drive faults when commands end. A drive that
  /// may still exert effort keeps its watchdog.
  /// @param elapsed  since the release began; zero in the first call
  /// Real-time: yes. O(N).
  [[nodiscard]] CanSetUp release(std::chrono::nanoseconds elapsed, CanBatch& batch) noexcept {
    return drives_.release(elapsed, batch);
  }
  /// The reason why the set-up has failed or is not done. Real-time: yes. O(N).
  [[nodiscard]] CanFault set_up_fault() const noexcept { return drives_.set_up_fault(); }

  /// Appends an RPDO for each drive, in the drive's units, rounded and within their range, and SYNC
  /// if the host sends it. A NaN gives zero; as a position, the measured one. Real-time: yes. O(N).
  void encode(const Command& command, CanBatch& batch) noexcept {
    push_heartbeat(batch);
    // The marks come first: the transport awaits the last frame of a cycle's output.
    if (drives_.syncs.is_missing()) drives_.push_marks(batch);
    push_commands(cia402::enable_operation, values_of(command), batch);
  }

  /// Switches all drives off: by RPDO, and by access to the objects of each drive that has not yet
  /// reported that it is off. Real-time: yes. O(N).
  void encode_stop(CanBatch& batch) noexcept {
    push_heartbeat(batch);
    drives_.push_stops(batch);
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();  // zero, or the position
    push_commands(cia402::disable_voltage, JointVector<joint_count>::Constant(nothing), batch);
  }

  /// Notes that the bus did not take all frames of the last output, and so not its SYNC.
  /// Real-time: yes. O(N).
  void cancel_output() noexcept {
    if (sends_sync) drives_.syncs.cancel_sync();
    drives_.cancel_output();
  }

  /// Decodes a drive's frame. Real-time: yes. O(1).
  [[nodiscard]] CanDecoding decode(const CanFrame& frame) noexcept {
    if (frame.extended) return CanDecoding::foreign;
    if (!sends_sync && frame.identifier == canopen::sync_identifier) return take_sync(frame);
    const int j = joint_of_node_[frame.identifier % nodes];
    if (j == joint_count) return CanDecoding::foreign;
    switch (frame.identifier - frame.identifier % nodes) {
      case canopen::transmit_pdo_1_base:
        return drives_.channels[j].template take_pdo<0>(frame, drives_.syncs, drives_.reports[j]);
      case canopen::transmit_pdo_2_base:
        return drives_.channels[j].template take_pdo<1>(frame, drives_.syncs, drives_.reports[j]);
      case canopen::transmit_pdo_3_base:
        return drives_.channels[j].template take_pdo<2>(frame, drives_.syncs, drives_.reports[j]);
      case canopen::transmit_pdo_4_base:
        return drives_.channels[j].template take_pdo<3>(frame, drives_.syncs, drives_.reports[j]);
      default:
        return drives_.channels[j].take_other(frame, drives_.syncs, drives_.reports[j]);
    }
  }

  /// The drives' last reports. Real-time: yes.
  [[nodiscard]] const JointArray<DriveReport, joint_count>& reports() const noexcept {
    return drives_.reports;
  }
  /// Whether all drives have reported that they are off. Real-time: yes.
  [[nodiscard]] bool all_off() const noexcept { return drives_.all_off(); }
  /// Number of SYNCs received from another node. Real-time: yes.
  [[nodiscard]] std::uint64_t begun_cycles() const noexcept
    requires(!sends_sync)
  {
    return begun_cycles_;
  }

 private:
  void push_heartbeat(CanBatch& batch) noexcept {
    if (host_node_ == 0 || ++since_heartbeat_ < cycles_per_heartbeat_) return;
    since_heartbeat_ = 0;
    batch.push_back(canopen::encode(canopen::NmtState::operational, host_node_));
  }

  /// Appends the commands of a cycle, and ends its output.
  void push_commands(std::uint16_t controlword, const JointVector<joint_count>& values,
                     CanBatch& batch) noexcept {
    for (int j = 0; j < joint_count; ++j) {
      drives_.channels[j].template push_command<mode>(controlword, values[j], drives_.reports[j],
                                                      batch);
    }
    end_output(batch);
  }
  void end_output(CanBatch& batch) noexcept {
    if (sends_sync) {
      drives_.begin_cycle(true);
      batch.push_back(canopen::encode_sync());
    } else {
      if (!received_sync_) drives_.begin_cycle(false);  // reports grow older without SYNC, too
      received_sync_ = false;
    }
  }
  [[nodiscard]] CanDecoding take_sync(const CanFrame& frame) noexcept {
    if (frame.length > 1) return CanDecoding::malformed;  // 1: with a counter, which is not used
    drives_.begin_cycle(true);
    received_sync_ = true;
    ++begun_cycles_;
    return CanDecoding::accepted;
  }

  static constexpr std::uint32_t nodes = canopen::last_node + 1;

  Cia402Channels<joint_count> drives_{};
  std::array<std::uint8_t, nodes> joint_of_node_{};  ///< joint_count for an unknown node
  std::uint8_t host_node_ = 0;  ///< of the host's heartbeats; 0: there are none
  /// Three heartbeats per deadline, so that two may be lost; at least one per cycle.
  int cycles_per_heartbeat_;
  int since_heartbeat_ = 0;     ///< [cycles]
  bool received_sync_ = false;  ///< since the last output
  std::uint64_t begun_cycles_ = 0;
};

}  // namespace articula
