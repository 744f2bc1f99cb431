// SPDX-License-Identifier: Apache-2.0
/// @file The host's side of one CiA 402 drive.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/hardware/can/can_codec.hpp"
#include "articula/hardware/can/nearest_units.hpp"
#include "articula/hardware/cia402/cia402.hpp"
#include "articula/hardware/cia402/cia402_drive.hpp"
#include "articula/hardware/cia402/cia402_feedback.hpp"
#include "articula/hardware/cia402/cia402_set_up.hpp"
#include "articula/hardware/cia402/cia402_stop.hpp"
#include "articula/hardware/cia402/sync_history.hpp"

#include <cstddef>
#include <cstdint>

namespace articula {

/// The host's side of one drive: set-up, commands, feedback and stop. All functions but the
/// constructor are real-time.
struct Cia402Channel {
  Cia402Channel() = default;
  /// Parameters as those of Cia402SetUp.
  Cia402Channel(const Cia402Drive& its_drive, cia402::Mode mode, std::uint8_t period,
                std::uint16_t deadline, SyncProducer sync_producer)
      : drive(its_drive),
        sync(sync_producer),
        set_up(its_drive, mode, period, deadline, sync_producer) {}

  Cia402Drive drive{};
  SyncProducer sync = SyncProducer::host;
  Cia402SetUp set_up{};
  Cia402Stop stop{};
  Cia402Feedback feedback{};

  /// Appends an RPDO.
  /// @tparam Mode   of operation
  /// @param value   position, velocity or effort after the mode; if it is not finite, zero, or in
  ///                position mode the measured position
  /// @param report  of the drive
  template <cia402::Mode Mode>
  void push_command(std::uint16_t controlword, double value, const DriveReport& report,
                    CanBatch& batch) const noexcept {
    const cia402::ReceiveLayout& layout = set_up.process_data().receive;
    if (!batch.push_back(layout.frame)) return;
    auto& data = batch.back().data;
    store_little_endian(data, layout.controlword, controlword);
    constexpr double most = 2147483647;
    constexpr bool is_position = Mode == cia402::Mode::cyclic_synchronous_position;
    if (!is_finite(value)) value = is_position ? report.position : 0;
    if constexpr (is_position) {
      store_little_endian(data, layout.target, nearest_units(drive.position_units(value), most));
    } else if constexpr (Mode == cia402::Mode::cyclic_synchronous_velocity) {
      store_little_endian(data, layout.target, nearest_units(drive.velocity_units(value), most));
    } else {
      const std::int32_t per_mille = nearest_units(drive.per_mille(value), 32767);
      store_little_endian(data, layout.target, static_cast<std::int16_t>(per_mille));
    }
  }
  /// Appends a request that tells lost feedback from late feedback, if it is due.
  /// @return number of frames appended
  std::size_t push_mark(SyncHistory& syncs, CanBatch& batch) noexcept {
    const auto request = feedback.age().next_mark(set_up.process_data().stream_count, syncs);
    if (!request) return 0;
    return batch.push_back(canopen::encode_request(*request, drive.node)) ? 1 : 0;
  }

  /// Decodes a frame of a TPDO.
  /// @tparam Number  0 for TPDO 1
  template <std::size_t Number>
  [[nodiscard, gnu::always_inline]] inline CanDecoding take_pdo(const CanFrame& frame,
                                                                SyncHistory& syncs,
                                                                DriveReport& report) noexcept {
    if constexpr (Number < cia402::usual_transmit.size()) {
      const bool taken =
          feedback.template take_usual<Number>(frame, set_up.process_data(), drive, syncs, report);
      if (taken) [[likely]]
        return CanDecoding::accepted;
    }
    return take_unusual(Number, frame, syncs, report);
  }
  /// Decodes any other frame with an identifier of the drive's node.
  // Not inlined: that would cost the decoding of each TPDO some registers.
  [[nodiscard, gnu::noinline]] CanDecoding take_other(const CanFrame& frame, SyncHistory& syncs,
                                                      DriveReport& report) noexcept {
    switch (frame.identifier - drive.node) {
      case canopen::emergency_base:
        return feedback.take_emergency(frame);
      case canopen::sdo_answer_base:
        return take_answer(frame, syncs);
      case canopen::heartbeat_base:
        if (const auto state = canopen::decode_heartbeat(frame)) {
          // A node that is not operational, such as one that has restarted, ignores process data.
          if (*state != canopen::NmtState::operational) report.enabled = false;
          return CanDecoding::accepted;
        }
        return CanDecoding::malformed;
      default:
        return CanDecoding::foreign;
    }
  }

 private:
  // Not inlined, as above.
  [[nodiscard, gnu::noinline]] CanDecoding take_unusual(std::size_t number, const CanFrame& frame,
                                                        SyncHistory& syncs,
                                                        DriveReport& report) noexcept {
    return feedback.take_pdo(number, frame, set_up.process_data(), drive, syncs, report);
  }
  [[nodiscard]] CanDecoding take_answer(const CanFrame& frame, SyncHistory& syncs) noexcept {
    const auto answer = canopen::decode_answer(frame);
    if (!answer) return CanDecoding::malformed;
    set_up.take(*answer);
    feedback.age().take_answer(answer->address, set_up.process_data().stream_count, syncs, sync);
    syncs.note_missing();
    if (const auto statusword = stop.take(*answer)) feedback.take_statusword(*statusword);
    return CanDecoding::accepted;
  }
};

}  // namespace articula
