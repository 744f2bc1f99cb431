// SPDX-License-Identifier: Apache-2.0
/// @file Decoding the feedback of one CiA 402 drive into its report.
#pragma once

#include "articula/hardware/can/can_codec.hpp"
#include "articula/hardware/cia402/cia402.hpp"
#include "articula/hardware/cia402/cia402_drive.hpp"
#include "articula/hardware/cia402/cia402_feedback_age.hpp"
#include "articula/hardware/cia402/cia402_process_data.hpp"
#include "articula/hardware/cia402/sync_history.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace articula {

/// Decodes the feedback of one drive. All functions are real-time.
class Cia402Feedback {
 public:
  /// Clears the state.
  void restart() noexcept { *this = {}; }

  /// Decodes a frame with the usual layout that answers the SYNC of this cycle, of a drive in
  /// operation. Nearly all frames are like that. The layout is a constant here, which is fast.
  /// @tparam Number  of the process data object, 0 for TPDO 1
  /// @param frame   with its identifier
  /// @param data    the drive's process data
  /// @param drive   its units
  /// @param syncs   of the bus
  /// @param report  of the drive
  /// @return        false if the frame is another one: nothing has changed, see take_pdo
  template <std::size_t Number>
  [[nodiscard, gnu::always_inline]] inline bool take_usual(const CanFrame& frame,
                                                           const cia402::ProcessData& data,
                                                           const Cia402Drive& drive,
                                                           const SyncHistory& syncs,
                                                           DriveReport& report) noexcept {
    constexpr cia402::TransmitLayout layout = cia402::usual_transmit[Number];
    const bool in_time = age_.is_in_time(layout.stream, syncs);
    if (!data.is_usual || !in_time || frame.length != layout.length) return false;
    if constexpr (layout.statusword != absent) {
      const auto bits = load_little_endian<std::uint16_t>(frame.data, layout.statusword);
      if (!cia402::in_operation(bits)) return false;
      take_operation((bits & cia402::follows_target) != 0, report);
      report.fault = 0;
    }
    age_.count_in_time(layout.stream, cia402::usual_transmit.size(), syncs.cycle(), report);
    take_figures(layout, frame, drive, report);
    if constexpr (layout.position != absent) {
      report.position = position_in(layout, frame, drive);
    }
    return true;
  }

  /// Decodes any frame of a process data object; parameters as above.
  /// @param syncs   receives the note that an answer is missing
  /// @param number  of the object, 0 for TPDO 1
  /// @return        CanDecoding::outdated before the first SYNC
  [[nodiscard]] CanDecoding take_pdo(std::size_t number, const CanFrame& frame,
                                     const cia402::ProcessData& data, const Cia402Drive& drive,
                                     SyncHistory& syncs, DriveReport& report) noexcept {
    const cia402::TransmitLayout& layout = data.transmit[number];
    if (layout.length == 0) return CanDecoding::foreign;
    if (frame.length != layout.length) return CanDecoding::malformed;
    std::uint16_t bits = 0;
    std::optional<cia402::State> state;
    if (layout.statusword != absent) {
      bits = load_little_endian<std::uint16_t>(frame.data, layout.statusword);
      state = cia402::state_of(bits);
      if (!state) return CanDecoding::malformed;
    }
    if (!age_.count(layout.stream, data.stream_count, syncs, report)) return CanDecoding::outdated;
    if (state) take_state(*state, (bits & cia402::follows_target) != 0, report);
    take_figures(layout, frame, drive, report);
    if (layout.position != absent) {
      const double position = position_in(layout, frame, drive);
      if (!data.has_velocity) {
        take_difference(position, age_.cycle_of(layout.stream), data, report);
      }
      report.position = position;
    }
    return CanDecoding::accepted;
  }

  /// Decodes an emergency message. It has the code of a fault; the statusword decides whether there
  /// is one.
  [[nodiscard]] CanDecoding take_emergency(const CanFrame& frame) noexcept {
    const auto emergency = canopen::decode_emergency(frame);
    if (!emergency) return CanDecoding::malformed;
    emergency_ = emergency->code;
    return CanDecoding::accepted;
  }
  /// Evaluates a statusword that was read by access to its object.
  void take_statusword(std::uint16_t bits) noexcept {
    const auto state = cia402::state_of(bits);
    powered_ = !state || cia402::may_exert(*state);
  }

  [[nodiscard]] Cia402FeedbackAge& age() noexcept { return age_; }
  /// Whether the drive has reported, in operation, that it follows its target. Not all drives do.
  [[nodiscard]] bool has_followed() const noexcept { return has_followed_; }
  /// Whether the drive may exert effort: it has not reported that it is off.
  [[nodiscard]] bool powered() const noexcept { return powered_; }

 private:
  static constexpr std::uint8_t absent = cia402::TransmitLayout::absent;

  /// Decodes all but position and state.
  [[gnu::always_inline]] static inline void take_figures(const cia402::TransmitLayout& layout,
                                                         const CanFrame& frame,
                                                         const Cia402Drive& drive,
                                                         DriveReport& report) noexcept {
    if (layout.torque != absent) {
      report.effort = drive.effort(load_little_endian<std::int16_t>(frame.data, layout.torque));
    }
    if (layout.velocity != absent) {
      const auto units = load_little_endian<std::int32_t>(frame.data, layout.velocity);
      report.velocity = drive.velocity(units);
    }
    if (layout.error_code != absent && report.fault != 0) {
      const auto code = load_little_endian<std::uint16_t>(frame.data, layout.error_code);
      if (code != 0) report.fault = code;
    }
  }
  [[nodiscard]] static double position_in(const cia402::TransmitLayout& layout,
                                          const CanFrame& frame,
                                          const Cia402Drive& drive) noexcept {
    return drive.position(load_little_endian<std::int32_t>(frame.data, layout.position));
  }

  /// The drive is in operation.
  void take_operation(bool follows, DriveReport& report) noexcept {
    has_followed_ = has_followed_ || follows;
    report.enabled = follows || !has_followed_;
    powered_ = true;
  }
  void take_state(cia402::State state, bool follows, DriveReport& report) noexcept {
    constexpr std::uint16_t generic_error = 0x1000;  // [CiA 301], for a fault without a code
    report.enabled = false;
    powered_ = cia402::may_exert(state);
    if (state == cia402::State::operation_enabled) take_operation(follows, report);
    const bool fault =
        state == cia402::State::fault || state == cia402::State::fault_reaction_active;
    if (!fault) {
      report.fault = 0;
    } else if (report.fault == 0) {
      report.fault = emergency_ != 0 ? emergency_ : generic_error;
    }
  }

  /// Velocity from two positions, for a drive that does not report it.
  void take_difference(double position, std::uint64_t cycle, const cia402::ProcessData& data,
                       DriveReport& report) noexcept {
    if (cycle <= position_cycle_) return;
    if (position_cycle_ > 0) {
      const auto cycles = static_cast<double>(cycle - position_cycle_);
      report.velocity = (position - report.position) / (cycles * data.sync_period);
    }
    position_cycle_ = cycle;
  }

  Cia402FeedbackAge age_{};
  bool has_followed_ = false;
  bool powered_ = true;
  std::uint64_t position_cycle_ = 0;  ///< of the last position, for differences
  std::uint16_t emergency_ = 0;
};

}  // namespace articula
