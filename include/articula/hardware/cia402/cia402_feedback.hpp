// SPDX-License-Identifier: Apache-2.0
/// @file What the feedback of one CiA 402 drive says, and how old it is.
#pragma once

#include "articula/hardware/can/can_codec.hpp"
#include "articula/hardware/cia402/cia402.hpp"
#include "articula/hardware/cia402/cia402_drive.hpp"
#include "articula/hardware/cia402/cia402_process_data.hpp"
#include "articula/hardware/cia402/sync_history.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace articula {

/// What the feedback of one drive says, and how old it is.
///
/// A drive answers each SYNC with one frame of each process data object, in order. A frame has no
/// number, so frames are counted: one that comes answers the oldest SYNC without an answer, and its
/// age is the number of cycles since that SYNC.
///
/// A frame that was lost looks like one that is late. A mark tells them apart. It is a request to
/// read an object; a drive answers it later than every SYNC before it, and frames do not overtake.
/// So the feedback that is missing when the answer comes, to a SYNC before the request, is lost.
/// A drive takes some cycles to answer. It sends feedback meanwhile, which comes before the answer,
/// so a mark covers later SYNCs as well, by the time of the fastest answer. One cycle remains
/// unknown, since that time and the age of feedback are counted in whole cycles. For the time to be
/// known before feedback begins, the set-up reads object 1018h.
class Cia402Feedback {
 public:
  /// Forgets all. Real-time: yes.
  void restart() noexcept { *this = {}; }

  /// Takes in a frame that answers the SYNC of this cycle, with the usual layout, of a drive in
  /// operation. Nearly all frames are like that, and they cost no more than constants.
  /// @tparam Number  of the process data object, 0 for TPDO 1
  /// @param frame   with its identifier
  /// @param data    the drive's process data
  /// @param drive   whose it is
  /// @param syncs   that the drive was to answer; receives the note that an answer is missing
  /// @param report  of the drive
  /// @return        false if the frame is another one: nothing has changed, see take_transmit_pdo
  /// Real-time: yes.
  template <std::size_t Number>
  [[nodiscard, gnu::always_inline]] inline bool take_usual(const CanFrame& frame,
                                                           const cia402::ProcessData& data,
                                                           const Cia402Drive& drive,
                                                           SyncHistory& syncs,
                                                           DriveReport& report) noexcept {
    constexpr cia402::TransmitLayout layout = cia402::usual_transmit[Number];
    const bool in_time = next_[layout.stream] == syncs.cycle() && syncs.is_new();
    if (!data.is_usual || !in_time || frame.length != layout.length) return false;
    if constexpr (layout.statusword != absent) {
      const auto bits = load_little_endian<std::uint16_t>(frame.data, layout.statusword);
      if (!cia402::in_operation(bits)) return false;
      take_operation((bits & cia402::follows_target) != 0, report);
      report.fault = 0;
    }
    answer_in_time(layout.stream, cia402::usual_transmit.size(), syncs, report);
    take_figures(layout, frame, drive, report);
    if constexpr (layout.position != absent) {
      report.position = position_in(layout, frame, drive);
    }
    return true;
  }

  /// Takes in one of the drive's process data objects.
  /// @param layout  of the object
  /// @param frame   with its identifier
  /// @param data    the drive's process data
  /// @param drive   whose it is
  /// @param syncs   that the drive was to answer; receives the note that an answer is missing
  /// @param report  of the drive
  /// @return        CanDecoding::outdated before the first SYNC
  /// Real-time: yes.
  [[nodiscard]] CanDecoding take_transmit_pdo(const cia402::TransmitLayout& layout,
                                              const CanFrame& frame,
                                              const cia402::ProcessData& data,
                                              const Cia402Drive& drive, SyncHistory& syncs,
                                              DriveReport& report) noexcept {
    if (layout.length == 0) return CanDecoding::foreign;
    if (frame.length != layout.length) return CanDecoding::malformed;
    std::uint16_t bits = 0;
    std::optional<cia402::State> state;
    if (layout.statusword != absent) {
      bits = load_little_endian<std::uint16_t>(frame.data, layout.statusword);
      state = cia402::state_of(bits);
      if (!state) return CanDecoding::malformed;
    }
    if (!answer(layout.stream, data.stream_count, syncs, report)) return CanDecoding::outdated;
    if (state) take_state(*state, (bits & cia402::follows_target) != 0, report);
    take_figures(layout, frame, drive, report);
    if (layout.position != absent) {
      const double position = position_in(layout, frame, drive);
      if (!data.has_velocity) take_difference(position, born_[layout.stream], data, report);
      report.position = position;
    }
    return CanDecoding::accepted;
  }

  /// Takes in an emergency message. It gives a fault its name; whether there is one, the statusword
  /// says. Real-time: yes.
  [[nodiscard]] CanDecoding take_emergency(const CanFrame& frame) noexcept {
    const auto emergency = canopen::decode_emergency(frame);
    if (!emergency) return CanDecoding::malformed;
    emergency_ = emergency->code;
    return CanDecoding::accepted;
  }

  /// The request for a mark, where more answers are missing than at the last mark, or some are and
  /// that one was long ago. Every node has the object or refuses it; either is an answer.
  /// @param streams  how many process data objects the drive sends
  /// @param syncs    that it was to answer
  /// Real-time: yes.
  [[nodiscard]] std::optional<canopen::Sdo> next_mark(std::size_t streams,
                                                      const SyncHistory& syncs) noexcept {
    constexpr std::uint64_t interval = 10;  // [cycles]
    const std::uint64_t patience = std::max(std::uint64_t{20}, fastest_answer_ + 10);
    const std::uint32_t missing = lag(streams, syncs);
    if (missing == 0) {
      if (least_age_ != unknown_age) least_age_ = 0;
      return {};
    }
    const std::uint64_t since = syncs.cycle() - mark_cycle_;
    const bool known = missing <= known_lag_ && since < interval;
    if (awaits_mark_ ? since < patience : known) return {};
    // A late answer to the mark before must not pass for one to this.
    constexpr std::uint8_t objects = 5;
    mark_number_ = static_cast<std::uint8_t>((mark_number_ + 1) % objects);
    place_mark({canopen::identity, mark_number_}, syncs);
    return canopen::Sdo{canopen::SdoKind::upload, mark_, 0, 0};
  }

  /// Any access to an object is a mark: it is requested now. Real-time: yes.
  void place_mark(const canopen::ObjectAddress& object, const SyncHistory& syncs) noexcept {
    mark_ = object;
    mark_cycle_ = syncs.cycle();
    awaits_mark_ = true;
  }
  /// The bus did not take the last frames. Real-time: yes.
  void withdraw() noexcept { awaits_mark_ = false; }

  /// The answer to an access has come.
  ///
  /// Without a queue an answer to a request just before SYNC takes F - 1 cycles at least, and
  /// feedback less than a + 1, where F and a are the fewest that were counted. A queue delays both
  /// alike. So the drive has sent feedback to SYNCs up to F - 1 - (a + 1) cycles after that one
  /// before the answer. Where another node sends SYNC, the requests are up to one cycle apart in
  /// their cycles.
  /// @param object   that it was of
  /// @param streams  as next_mark
  /// @param syncs    likewise
  /// @param sync     who sends SYNC
  /// Real-time: yes.
  void take_answer(const canopen::ObjectAddress& object, std::size_t streams,
                   const SyncHistory& syncs, SyncProducer sync) noexcept {
    if (!awaits_mark_ || object != mark_) return;
    awaits_mark_ = false;
    const std::uint64_t cycles = syncs.cycle() - mark_cycle_;
    fastest_answer_ = std::min(fastest_answer_, cycles);
    const std::uint64_t unsure = least_age_ + 1 + (sync == SyncProducer::host ? 0 : 1);
    const std::uint64_t covered =
        mark_cycle_ + (fastest_answer_ > unsure ? fastest_answer_ - unsure : 0);
    for (std::uint64_t& next : next_) next = std::max(next, covered + 1);
    known_lag_ = lag(streams, syncs);
  }

  /// Takes in a statusword that was read by access to the object. Real-time: yes.
  void take_statusword(std::uint16_t bits) noexcept {
    const auto state = cia402::state_of(bits);
    powered_ = !state || cia402::may_exert(*state);
  }

  /// Whether the drive has said, in operation, that it follows its target: not all drives do.
  /// Real-time: yes.
  [[nodiscard]] bool has_followed() const noexcept { return has_followed_; }

  /// Whether the drive may exert effort: it has not said that it does not. Real-time: yes.
  [[nodiscard]] bool powered() const noexcept { return powered_; }

 private:
  static constexpr std::uint8_t absent = cia402::TransmitLayout::absent;
  using Cycles = std::array<std::uint64_t, cia402::ProcessData::most>;

  /// The lowest of the first few.
  [[nodiscard]] static std::uint64_t least(const Cycles& cycles, std::size_t streams) noexcept {
    std::uint64_t lowest = cycles[0];
    for (std::size_t i = 1; i < streams; ++i) lowest = std::min(lowest, cycles[i]);
    return lowest;
  }
  /// SYNCs without an answer.
  [[nodiscard]] std::uint32_t lag(std::size_t streams, const SyncHistory& syncs) const noexcept {
    return syncs.count_from(least(next_, streams));
  }

  /// A frame that answers the SYNC of this cycle has come, and none was missing.
  void answer_in_time(std::size_t stream, std::size_t streams, SyncHistory& syncs,
                      DriveReport& report) noexcept {
    const std::uint64_t cycle = syncs.cycle();
    born_[stream] = cycle;
    next_[stream] = cycle + 1;
    const std::uint64_t least_next = least(next_, streams);
    if (least_next > cycle) {
      report.age = 0;
    } else if (least_next < cycle) {
      syncs.note_missing();
    }
  }
  /// Any frame has come.
  /// @return false if there was no SYNC that it could answer
  [[nodiscard]] bool answer(std::size_t stream, std::size_t streams, SyncHistory& syncs,
                            DriveReport& report) noexcept {
    if (!syncs.has_begun()) return false;
    born_[stream] = syncs.first_from(next_[stream]);
    next_[stream] = std::max(next_[stream], born_[stream] + 1);
    if (lag(streams, syncs) > 0) syncs.note_missing();
    const std::uint64_t oldest = least(born_, streams);
    if (oldest > 0) {
      report.age = static_cast<std::uint32_t>(syncs.cycle() - oldest);
      least_age_ = std::min(least_age_, std::uint64_t{report.age});
    }
    return true;
  }

  /// All but position and state.
  [[gnu::always_inline]] static inline void take_figures(const cia402::TransmitLayout& layout,
                                                         const CanFrame& frame,
                                                         const Cia402Drive& drive,
                                                         DriveReport& report) noexcept {
    if (layout.torque != absent) {
      const auto per_mille = load_little_endian<std::int16_t>(frame.data, layout.torque);
      report.effort = per_mille * drive.rated_effort / 1e3;
    }
    if (layout.velocity != absent) {
      const auto units = load_little_endian<std::int32_t>(frame.data, layout.velocity);
      report.velocity = units / drive.velocity_scale;
    }
    if (layout.error_code != absent && report.fault != 0) {
      const auto code = load_little_endian<std::uint16_t>(frame.data, layout.error_code);
      if (code != 0) report.fault = code;
    }
  }
  [[nodiscard]] static double position_in(const cia402::TransmitLayout& layout,
                                          const CanFrame& frame,
                                          const Cia402Drive& drive) noexcept {
    const auto units = load_little_endian<std::int32_t>(frame.data, layout.position);
    return (static_cast<double>(units) - drive.zero_position) / drive.position_scale;
  }

  /// The drive is in operation.
  void take_operation(bool follows, DriveReport& report) noexcept {
    has_followed_ = has_followed_ || follows;
    report.enabled = follows || !has_followed_;
    powered_ = true;
  }
  void take_state(cia402::State state, bool follows, DriveReport& report) noexcept {
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

  /// The velocity between two positions, for a drive that does not say it. Real-time: yes.
  void take_difference(double position, std::uint64_t cycle, const cia402::ProcessData& data,
                       DriveReport& report) noexcept {
    if (cycle <= position_cycle_) return;
    if (position_cycle_ > 0) {
      const auto cycles = static_cast<double>(cycle - position_cycle_);
      report.velocity = (position - report.position) / (cycles * data.sync_period);
    }
    position_cycle_ = cycle;
  }

  static constexpr std::uint16_t generic_error =
      0x1000;  ///< of CiA 301, for a fault without a name

  Cycles next_{};  ///< each object answers the SYNC of this cycle next, or that of the first later
                   ///< one that has any
  Cycles born_{};  ///< the cycle of its last frame; 0: there was none
  bool has_followed_ = false;
  bool powered_ = true;
  bool awaits_mark_ = false;
  std::uint8_t mark_number_ = 0;
  canopen::ObjectAddress mark_{};
  /// Of the answers to requests [cycles]; the slowest that the set-up waits for, until there is one.
  std::uint64_t fastest_answer_ = 100;
  static constexpr std::uint64_t unknown_age = 1'000'000;  ///< above the time of any answer
  std::uint64_t least_age_ = unknown_age;                  ///< that feedback has had [cycles]
  std::uint64_t mark_cycle_ = 0;                           ///< in which the mark was placed
  std::uint32_t known_lag_ = 0;       ///< SYNCs without an answer when the last mark's came
  std::uint64_t position_cycle_ = 0;  ///< that the last position belongs to; for differences
  std::uint16_t emergency_ = 0;
};

}  // namespace articula
