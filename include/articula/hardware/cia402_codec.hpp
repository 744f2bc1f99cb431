// SPDX-License-Identifier: Apache-2.0
/// @file The language of CANopen drives of the profile CiA 402.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/hardware/can_codec.hpp"
#include "articula/hardware/cia402.hpp"
#include "articula/hardware/cia402_drive.hpp"
#include "articula/hardware/cia402_set_up.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
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
/// another device, one of the drives or a master (objects 1005h, 1006h), at the loop's period. The
/// drives are stopped by access to their objects as well then, since without SYNC no RPDO counts.
///
/// A drive is to fault when RPDO 1 stays away for the deadline (object 1400h, 5, where it has one).
/// Other process data objects that a drive sends by itself are to be switched off in its
/// configuration: they would only load the bus.
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
  /// @throws std::invalid_argument as validate says, or if a time is 0
  Cia402Codec(const R& robot, const Cia402DriveList<joint_count>& drives, std::uint8_t period = 1,
              std::uint16_t deadline = 10)
      : drives_(drives),
        set_ups_(make_set_ups(drives, period, deadline,
                              std::make_index_sequence<static_cast<std::size_t>(joint_count)>())) {
    validate(robot, drives);
    if (period == 0) throw std::invalid_argument("CiA 402: the period is 0 ms");
    if (deadline == 0) throw std::invalid_argument("CiA 402: the deadline is 0 ms");
  }
  /// For a robot known at compile time.
  explicit Cia402Codec(const Cia402DriveList<joint_count>& drives, std::uint8_t period = 1,
                       std::uint16_t deadline = 10) requires DescribedRobot<R>
      : Cia402Codec(R(), drives, period, deadline) {}

  /// Real-time: no (allocates).
  [[nodiscard]] CanSubscription subscription() const {
    CanSubscription subscription{.last_of_cycle = canopen::sync_identifier,
                                 .frames_per_cycle = drives_.size() + 1};
    if (!sends_sync) {
      subscription.identifiers.push_back(canopen::sync_identifier);
      subscription.last_of_cycle = canopen::receive_pdo_1_base + drives_.back().node;
      subscription.frames_per_cycle = 2 * drives_.size();  // a stop takes that many
    }
    for (const Cia402Drive& drive : drives_) {
      for (const std::uint32_t base :
           {canopen::transmit_pdo_1_base, canopen::transmit_pdo_2_base, canopen::emergency_base,
            canopen::sdo_answer_base, canopen::heartbeat_base}) {
        subscription.identifiers.push_back(base + drive.node);
      }
    }
    return subscription;
  }

  /// Forgets what the drives have said. Real-time: yes.
  void restart() noexcept {
    reports_.fill({});
    halves_.fill({});
    for (Cia402SetUp& set_up : set_ups_) set_up.restart();
  }

  /// Brings all drives to operation enabled, side by side, then begins cycles until all have told
  /// where they are. Real-time: yes. O(N).
  [[nodiscard]] CanSetUp set_up(std::chrono::nanoseconds elapsed, CanBatch& batch) noexcept {
    constexpr std::uint32_t fresh = sends_sync ? 0 : 1;  // another's cycle may just have begun
    bool all_enabled = true, all_known = true;
    for (std::size_t j = 0; j < drives_.size(); ++j) {
      const CanSetUp progress = set_ups_[j].advance(elapsed, batch);
      if (progress == CanSetUp::failed) return progress;
      all_enabled = all_enabled && progress == CanSetUp::done;
      const bool known = reports_[j].age <= fresh && reports_[j].enabled;
      if (!known) set_ups_[j].doubt(elapsed);
      all_known = all_known && known;
    }
    if (!all_enabled) return CanSetUp::in_progress;
    if (all_known) return CanSetUp::done;
    if (sends_sync) send_sync(batch);
    return CanSetUp::in_progress;
  }

  /// RPDO 1 for each drive, in the drive's units, rounded and held within their range, and SYNC if
  /// it is ours. A NaN gives zero; for a position, the measured one. Real-time: yes. O(N).
  void encode(const Command& command, CanBatch& batch) noexcept {
    for (std::size_t j = 0; j < drives_.size(); ++j) {
      push_command(j, cia402::enable_operation, target(command, j), batch);
    }
    end_output(batch);
  }

  /// Takes the power from all drives. Real-time: yes. O(N).
  void encode_stop(CanBatch& batch) noexcept {
    Command still;
    if (!sends_sync && !heard_) {
      // What waits for a SYNC that does not come is not done.
      for (const Cia402Drive& drive : drives_) {
        batch.push_back(canopen::encode_request(
            {canopen::SdoKind::download, cia402::controlword, cia402::disable_voltage, 2},
            drive.node));
      }
    }
    for (std::size_t j = 0; j < drives_.size(); ++j) {
      if constexpr (std::same_as<Command, PositionCommand<joint_count>>) {
        still.position[static_cast<int>(j)] = reports_[j].position;
      }
      push_command(j, cia402::disable_voltage, target(still, j), batch);
    }
    end_output(batch);
  }

  /// Takes in a drive's frame. Real-time: yes. O(N).
  [[nodiscard]] CanDecoding decode(const CanFrame& frame) noexcept {
    if (frame.extended) return CanDecoding::foreign;
    if (!sends_sync && frame.identifier == canopen::sync_identifier) return take_sync(frame);
    for (std::size_t j = 0; j < drives_.size(); ++j) {
      switch (frame.identifier - drives_[j].node) {
        case canopen::transmit_pdo_1_base:
          return take_transmit_pdo_1(j, frame);
        case canopen::transmit_pdo_2_base:
          return take_transmit_pdo_2(j, frame);
        case canopen::emergency_base:
          if (const auto emergency = canopen::decode_emergency(frame)) {
            // It gives a fault its name. Whether there is one, the statusword tells.
            halves_[j].emergency = emergency->code;
            return CanDecoding::accepted;
          }
          return CanDecoding::malformed;
        case canopen::sdo_answer_base:
          if (const auto answer = canopen::decode_answer(frame)) {
            set_ups_[j].take(*answer);
            return CanDecoding::accepted;
          }
          return CanDecoding::malformed;
        case canopen::heartbeat_base:
          if (const auto state = canopen::decode_heartbeat(frame)) {
            // A node that is not operational, such as one that has restarted, hears no commands.
            if (*state != canopen::NmtState::operational) reports_[j].enabled = false;
            return CanDecoding::accepted;
          }
          return CanDecoding::malformed;
        default:
          break;
      }
    }
    return CanDecoding::foreign;
  }

  /// What the drives have said. Real-time: yes.
  [[nodiscard]] std::span<const DriveReport, static_cast<std::size_t>(joint_count)> reports()
      const noexcept {
    return reports_;
  }
  /// How far the set-up of one drive is, for messages. Real-time: yes.
  [[nodiscard]] const Cia402SetUp& set_up_of(int joint) const noexcept {
    return set_ups_[static_cast<std::size_t>(joint)];
  }
  [[nodiscard]] const Cia402DriveList<joint_count>& drives() const noexcept { return drives_; }
  /// How many SYNC of another node have been heard. Real-time: yes.
  [[nodiscard]] std::uint64_t heard_cycles() const noexcept requires(!sends_sync) {
    return heard_cycles_;
  }

 private:
  /// What has come of a drive's two feedback frames since the last SYNC.
  struct Halves {
    bool first = false;
    bool second = false;
    double position = 0, effort = 0, velocity = 0;
    std::uint16_t emergency = 0;
  };

  template <std::size_t... J>
  static std::array<Cia402SetUp, sizeof...(J)> make_set_ups(
      const Cia402DriveList<joint_count>& drives, std::uint8_t period, std::uint16_t deadline,
      std::index_sequence<J...>) {
    return {Cia402SetUp(drives[J].node, mode, period, deadline)...};
  }

  /// A number in the drive's units, as 16 or 32 bits.
  [[nodiscard]] static std::int32_t rounded(double value, double most) noexcept {
    return static_cast<std::int32_t>(std::llround(std::clamp(value, -most, most)));
  }

  [[nodiscard]] std::int32_t target(const Command& command, std::size_t j) const noexcept {
    const Cia402Drive& drive = drives_[j];
    const auto i = static_cast<int>(j);
    constexpr double most = 2147483647;
    if constexpr (std::same_as<Command, PositionCommand<joint_count>>) {
      const double q = is_finite(command.position[i]) ? command.position[i] : reports_[j].position;
      return rounded(q * drive.position_scale + drive.zero_position, most);
    } else if constexpr (std::same_as<Command, VelocityCommand<joint_count>>) {
      return is_finite(command.velocity[i])
                 ? rounded(command.velocity[i] * drive.velocity_scale, most)
                 : 0;
    } else {
      return is_finite(command.effort[i])
                 ? rounded(command.effort[i] / drive.rated_effort * 1e3, 32767)
                 : 0;
    }
  }

  void push_command(std::size_t j, std::uint16_t controlword, std::int32_t target,
                    CanBatch& batch) const noexcept {
    constexpr std::uint8_t size = cia402::target_of(mode).size;
    CanFrame frame;
    frame.identifier = canopen::receive_pdo_1_base + drives_[j].node;
    frame.length = 2 + size;
    store_little_endian<0, 2>(frame.data, controlword);
    store_little_endian<2, size>(frame.data, target);
    batch.push_back(frame);
  }

  void begin_cycle() noexcept {
    for (DriveReport& report : reports_) {
      if (report.age < DriveReport::never - 1) ++report.age;
    }
    for (Halves& half : halves_) half.first = half.second = false;
  }
  void send_sync(CanBatch& batch) noexcept {
    begin_cycle();
    batch.push_back(canopen::encode_sync());
  }

  /// After the commands of a cycle.
  void end_output(CanBatch& batch) noexcept {
    if (sends_sync) return send_sync(batch);
    if (!heard_) begin_cycle();  // what is known grows older without SYNC, too
    heard_ = false;
  }

  [[nodiscard]] CanDecoding take_sync(const CanFrame& frame) noexcept {
    if (frame.length > 1) return CanDecoding::malformed;  // 1: with a counter, of no use here
    begin_cycle();
    heard_ = true;
    ++heard_cycles_;
    return CanDecoding::accepted;
  }

  [[nodiscard]] CanDecoding take_transmit_pdo_1(std::size_t j, const CanFrame& frame) noexcept {
    const auto statusword = load_little_endian<std::uint16_t, 0>(frame.data);
    const auto state = cia402::state_of(statusword);
    if (frame.length != 8 || !state) return CanDecoding::malformed;
    const Cia402Drive& drive = drives_[j];
    const auto units = load_little_endian<std::int32_t, 2>(frame.data);
    halves_[j].first = true;
    halves_[j].position = (static_cast<double>(units) - drive.zero_position) / drive.position_scale;
    halves_[j].effort = load_little_endian<std::int16_t, 6>(frame.data) * drive.rated_effort / 1e3;
    reports_[j].enabled = *state == cia402::State::operation_enabled;
    const bool fault =
        *state == cia402::State::fault || *state == cia402::State::fault_reaction_active;
    if (!fault) {
      reports_[j].fault = 0;
    } else if (reports_[j].fault == 0) {
      reports_[j].fault = halves_[j].emergency != 0 ? halves_[j].emergency : generic_error;
    }
    complete(j);
    return CanDecoding::accepted;
  }

  [[nodiscard]] CanDecoding take_transmit_pdo_2(std::size_t j, const CanFrame& frame) noexcept {
    if (frame.length != 6) return CanDecoding::malformed;
    halves_[j].second = true;
    halves_[j].velocity =
        load_little_endian<std::int32_t, 0>(frame.data) / drives_[j].velocity_scale;
    const auto code = load_little_endian<std::uint16_t, 4>(frame.data);
    if (reports_[j].fault != 0 && code != 0) reports_[j].fault = code;
    complete(j);
    return CanDecoding::accepted;
  }

  void complete(std::size_t j) noexcept {
    const Halves& half = halves_[j];
    if (!half.first || !half.second) return;
    reports_[j].position = half.position;
    reports_[j].velocity = half.velocity;
    reports_[j].effort = half.effort;
    reports_[j].age = 0;
  }

  static constexpr std::uint16_t generic_error =
      0x1000;  ///< of CiA 301, for a fault without a name

  Cia402DriveList<joint_count> drives_;
  std::array<Cia402SetUp, static_cast<std::size_t>(joint_count)> set_ups_;
  std::array<DriveReport, static_cast<std::size_t>(joint_count)> reports_{};
  std::array<Halves, static_cast<std::size_t>(joint_count)> halves_{};
  bool heard_ = false;  ///< SYNC has come since the last output
  std::uint64_t heard_cycles_ = 0;
};

}  // namespace articula
