// SPDX-License-Identifier: Apache-2.0
/// @file The age of a CiA 402 drive's feedback, from counting its frames.
#pragma once

#include "articula/hardware/can/can_codec.hpp"
#include "articula/hardware/canopen/canopen.hpp"
#include "articula/hardware/cia402/cia402_process_data.hpp"
#include "articula/hardware/cia402/sync_history.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace articula {

/// The age of one drive's feedback.
///
/// A drive answers each SYNC with one frame of each process data object, in order. Frames have no
/// number, so they are counted: a frame answers the oldest SYNC without an answer. Its age is the
/// number of cycles since that SYNC.
///
/// A lost frame looks like a late one. Two things tell them apart, because frames of a drive do not
/// overtake each other:
/// - The other objects. A drive sends its objects in order, once for each SYNC. So what is missing
///   before a frame that has arrived is lost.
/// - A mark. It is a request to read an object. A drive answers it later than every SYNC before it.
///   So feedback to a SYNC before the request that is missing when the answer arrives is lost. A
///   drive takes some cycles to answer and sends feedback meanwhile. So a mark covers later SYNCs
///   as well, by the time of the fastest answer. One cycle stays unknown, because times are counted
///   in whole cycles. The set-up reads object 1018h, so that the time is known before feedback
///   begins.
///
/// All functions are real-time.
class Cia402FeedbackAge {
 public:
  /// Whether the next frame of a stream answers the SYNC of this cycle, as one before has done.
  [[nodiscard]] bool is_in_time(std::size_t stream, const SyncHistory& syncs) const noexcept {
    return next_[stream] == syncs.cycle() && syncs.is_new() && least_age_ == 0;
  }
  /// The cycle of a stream's last frame; 0 if there was none.
  [[nodiscard]] std::uint64_t cycle_of(std::size_t stream) const noexcept { return cycle_[stream]; }

  /// Counts a frame of a stream for which `is_in_time` holds.
  /// @param streams  number of process data objects that the drive sends
  /// @param cycle    of the bus, this one
  /// @param report   of the drive; receives the age
  void count_in_time(std::size_t stream, std::size_t streams, std::uint64_t cycle,
                     DriveReport& report) noexcept {
    cycle_[stream] = cycle;
    next_[stream] = cycle + 1;
    skip_lost(stream, streams);
    if (least(cycle_, streams) == cycle) report.age = 0;
  }
  /// Counts any frame of a stream; parameters as above.
  /// @param syncs  of the bus; receives the note that an answer is missing
  /// @return false if there was no SYNC that it could answer, or the node is not started
  [[nodiscard]] bool count(std::size_t stream, std::size_t streams, SyncHistory& syncs,
                           DriveReport& report) noexcept {
    is_still_operational_ = is_still_operational_ || (next_[stream] == never && has_answered_);
    if (!syncs.has_begun() || next_[stream] == never) return false;
    // Before the record, each cycle counts as one with SYNC: a frame may seem older than it is.
    cycle_[stream] =
        syncs.has_forgotten_from(next_[stream]) ? next_[stream] : syncs.first_from(next_[stream]);
    next_[stream] = std::max(next_[stream], cycle_[stream] + 1);
    skip_lost(stream, streams);
    if (lag(streams, syncs) > 0) syncs.note_missing();
    const std::uint64_t oldest = least(cycle_, streams);
    if (oldest > 0) {
      report.age = static_cast<std::uint32_t>(syncs.cycle() - oldest);
      if (report.age < least_age_) note_least_age(report.age, syncs);
    }
    return true;
  }

  /// Notes a command to the node to leave the operational state. What still arrives answers earlier
  /// SYNCs, so nothing counts until begin_feedback().
  void end_feedback() noexcept {
    cycle_ = {};
    next_.fill(never);
    least_age_ = unknown_age;
    known_lag_ = 0;
    has_answered_ = is_still_operational_ = false;
  }
  /// Whether the node has sent feedback after the answer to a request that came after the command
  /// to leave the operational state. So it has not got that command, or not yet.
  [[nodiscard]] bool is_still_operational() const noexcept { return is_still_operational_; }
  /// Notes a command to the node to start now. Without feedback since end_feedback(), it was not
  /// operational, so that it does not answer the SYNCs until now.
  void begin_feedback(const SyncHistory& syncs) noexcept {
    if (std::ranges::any_of(cycle_, [](std::uint64_t cycle) { return cycle > 0; })) return;
    next_.fill(syncs.cycle() + 1);
  }

  /// The request for a mark. It is due if more answers are missing than at the last mark. It also
  /// is if some are missing and the last mark is ten cycles old. Any node answers it, by the object
  /// or by a refusal.
  [[nodiscard]] std::optional<canopen::Sdo> next_mark(std::size_t streams,
                                                      SyncHistory& syncs) noexcept {
    constexpr std::uint64_t interval = 10;  // [cycles]
    const std::uint64_t patience = std::max(std::uint64_t{20}, fastest_answer_ + 10);
    const std::uint32_t missing = lag(streams, syncs);
    if (missing == 0 && syncs.is_new() && least_age_ > 0 && least_age_ != unknown_age) {
      note_least_age(0, syncs);
    }
    if (missing == 0 && !must_measure_) return {};
    const std::uint64_t since = syncs.cycle() - mark_cycle_;
    const bool known = !must_measure_ && missing <= known_lag_ && since < interval;
    if (awaits_mark_ ? since < patience : known) return {};
    // Subindices alternate, so that a late answer to the mark before does not count for this one.
    constexpr std::uint8_t objects = 5;
    mark_number_ = static_cast<std::uint8_t>((mark_number_ + 1) % objects);
    place_mark({canopen::identity, mark_number_}, syncs);
    measures_ = must_measure_;
    return canopen::read_request(mark_);
  }
  /// Notes that an object is requested now. A request is a mark if the one before was for another
  /// object. Else an answer may be to an earlier request, such as one that was repeated.
  void place_mark(const canopen::ObjectAddress& object, const SyncHistory& syncs) noexcept {
    awaits_mark_ = object != mark_;
    mark_ = object;
    mark_cycle_ = syncs.cycle();
    measures_ = false;
  }
  /// Notes that the bus did not take the last request.
  void cancel_mark() noexcept { awaits_mark_ = false; }

  /// Notes the answer to a request.
  ///
  /// Without a queue, an answer to a request just before SYNC takes at least F - 1 cycles. Feedback
  /// takes less than a + 1. F and a are the fewest cycles counted. A queue delays both alike. So
  /// the drive has sent feedback to SYNCs up to F - 1 - (a + 1) cycles after the one before the
  /// answer. Where another node sends SYNC, requests vary by up to one cycle. F must not be from a
  /// time with a longer queue than at a. So F is measured anew whenever a becomes less.
  /// @param object  that was requested
  /// @param sync    sender of SYNC
  void take_answer(const canopen::ObjectAddress& object, std::size_t streams,
                   const SyncHistory& syncs, SyncProducer sync) noexcept {
    if (!awaits_mark_ || object != mark_) return;
    awaits_mark_ = false;
    has_answered_ = true;
    const std::uint64_t cycles = syncs.cycle() - mark_cycle_;
    fastest_answer_ = std::min(fastest_answer_, cycles);
    const std::uint64_t unsure = least_age_ + 1 + (sync == SyncProducer::host ? 0 : 1);
    const bool covers_more = !must_measure_ && fastest_answer_ > unsure;
    const std::uint64_t covered = mark_cycle_ + (covers_more ? fastest_answer_ - unsure : 0);
    // While more is missing, there may be a queue. Feedback varies by a cycle, and one may be lost.
    constexpr std::uint32_t usual = 2;  // [cycles]
    if (measures_) must_measure_ = lag(streams, syncs) > least_age_ + usual;
    measures_ = false;
    for (std::uint64_t& next : next_) next = std::max(next, covered + 1);
    known_lag_ = lag(streams, syncs);
  }

 private:
  /// Notes the fewest cycles of any feedback.
  [[gnu::cold]] void note_least_age(std::uint64_t age, SyncHistory& syncs) noexcept {
    least_age_ = age;
    must_measure_ = true;
    measures_ = false;
    syncs.note_missing();  // which lets the next output ask for a mark
  }

  using Cycles = std::array<std::uint64_t, cia402::ProcessData::most>;

  /// Skips what the drive has sent on other streams before a frame that has arrived.
  void skip_lost(std::size_t stream, std::size_t streams) noexcept {
    const std::uint64_t cycle = cycle_[stream];
    for (std::size_t i = 0; i < streams; ++i) {
      next_[i] = std::max(next_[i], i < stream ? cycle + 1 : cycle);
    }
  }

  [[nodiscard]] static std::uint64_t least(const Cycles& cycles, std::size_t streams) noexcept {
    std::uint64_t lowest = cycles[0];
    for (std::size_t i = 1; i < streams; ++i) lowest = std::min(lowest, cycles[i]);
    return lowest;
  }
  /// SYNCs without an answer.
  [[nodiscard]] std::uint32_t lag(std::size_t streams, const SyncHistory& syncs) const noexcept {
    return syncs.count_from(least(next_, streams));
  }

  static constexpr std::uint64_t unknown_age = 1'000'000;  ///< longer than any answer takes
  static constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();

  /// Cycle whose SYNC the stream's next frame answers, or the first later one; or never.
  Cycles next_{};
  Cycles cycle_{};  ///< of the stream's last frame; 0: there was none
  bool awaits_mark_ = false;
  bool has_answered_ = false;  ///< a mark, since the end of feedback
  bool is_still_operational_ = false;
  bool must_measure_ = false;  ///< the time of the fastest answer is not known for the least age
  bool measures_ = false;      ///< by the last mark
  std::uint8_t mark_number_ = 0;
  canopen::ObjectAddress mark_{};
  std::uint64_t fastest_answer_ = 100;     ///< to a request [cycles]; at first the slowest expected
  std::uint64_t least_age_ = unknown_age;  ///< of any feedback [cycles]
  std::uint64_t mark_cycle_ = 0;           ///< of the request
  std::uint32_t known_lag_ = 0;            ///< SYNCs without an answer after the last mark
};

}  // namespace articula
