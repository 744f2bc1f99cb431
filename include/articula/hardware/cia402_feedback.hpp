// SPDX-License-Identifier: Apache-2.0
/// @file What the feedback of one CiA 402 drive says, and how old it is.
#pragma once

#include "articula/hardware/can_codec.hpp"
#include "articula/hardware/cia402.hpp"
#include "articula/hardware/cia402_drive.hpp"
#include "articula/hardware/cia402_process_data.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

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
/// The count is as good as the answers are fast: a drive that answers a request after n cycles may
/// seem n - 1 cycles late after as many losses.
class Cia402Feedback {
 public:
  /// Forgets all. Real-time: yes.
  void restart() noexcept { *this = {}; }

  /// A cycle begins.
  /// @param with_sync  SYNC begins it, so an answer is due
  /// @param data       the drive's process data
  /// @param report     of the drive; grows older
  /// Real-time: yes.
  void begin_cycle(bool with_sync, const cia402::ProcessData& data, DriveReport& report) noexcept {
    stream_count_ = data.stream_count;
    ++cycle_;
    syncs_ = syncs_ << 1 | std::uint64_t{with_sync};
    for (Stream& stream : streams()) {
      if (with_sync) ++stream.unanswered;
      if (stream.age < DriveReport::never - 1) ++stream.age;
    }
    if (with_sync) {
      has_begun_ = true;
      if (since_mark_ < std::numeric_limits<std::uint32_t>::max()) ++since_mark_;
    }
    report.age = age();
  }

  /// The last SYNC did not get onto the bus. Real-time: yes.
  void withdraw_sync() noexcept {
    syncs_ &= ~std::uint64_t{1};
    for (Stream& stream : streams()) {
      if (stream.unanswered > 0) --stream.unanswered;
    }
    awaits_mark_ = false;  // the request did not either
  }

  /// Takes in one of the drive's process data objects.
  /// @tparam Number  of the object, 0 for TPDO 1
  /// @param frame   with its identifier
  /// @param data    the drive's process data
  /// @param drive   whose it is
  /// @param report  of the drive
  /// Real-time: yes.
  template <std::size_t Number>
  [[nodiscard]] CanDecoding take_transmit_pdo(const CanFrame& frame,
                                              const cia402::ProcessData& data,
                                              const Cia402Drive& drive,
                                              DriveReport& report) noexcept {
    if constexpr (Number < cia402::usual_transmit.size()) {
      constexpr cia402::TransmitLayout usual = cia402::usual_transmit[Number];
      if (data.is_usual) [[likely]]
        return take(usual, frame, data, drive, report);
    }
    return take(data.transmit[Number], frame, data, drive, report);
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
  /// Real-time: yes.
  [[nodiscard]] std::optional<canopen::Sdo> next_mark() noexcept {
    constexpr std::uint32_t interval = 10, patience = 20;  // [cycles]
    if (lag() == 0 || since_mark_ == 0) return {};
    const bool known = lag() <= known_lag_ && since_mark_ < interval;
    if (awaits_mark_ ? since_mark_ < patience : known) return {};
    // A late answer to the mark before must not pass for one to this.
    constexpr std::uint8_t objects = 5;  // of the identity [CiA 301, object 1018h]
    mark_number_ = static_cast<std::uint8_t>((mark_number_ + 1) % objects);
    place_mark({0x1018, mark_number_});
    return canopen::Sdo{canopen::SdoKind::upload, mark_, 0, 0};
  }

  /// Any access to an object is a mark: it is requested now. Real-time: yes.
  void place_mark(const canopen::ObjectAddress& object) noexcept {
    mark_ = object;
    since_mark_ = 0;
    awaits_mark_ = true;
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

  /// The answer to an access has come. Real-time: yes.
  void take_answer(const canopen::ObjectAddress& object) noexcept {
    if (!awaits_mark_ || object != mark_) return;
    awaits_mark_ = false;
    for (Stream& stream : streams()) stream.unanswered = std::min(stream.unanswered, since_mark_);
    known_lag_ = lag();
  }

 private:
  /// One process data object.
  struct Stream {
    std::uint32_t unanswered = 0;            ///< SYNCs that it has not answered
    std::uint32_t age = DriveReport::never;  ///< of its last frame [cycles]
  };

  [[nodiscard]] std::span<Stream> streams() noexcept {
    return std::span(streams_).first(stream_count_);
  }
  [[nodiscard]] std::uint32_t lag() const noexcept {
    std::uint32_t most = streams_[0].unanswered;
    for (std::size_t i = 1; i < stream_count_; ++i) most = std::max(most, streams_[i].unanswered);
    return most;
  }
  [[nodiscard]] std::uint32_t age() const noexcept {
    std::uint32_t oldest = streams_[0].age;
    for (std::size_t i = 1; i < stream_count_; ++i) oldest = std::max(oldest, streams_[i].age);
    return oldest;
  }

  /// Inlined, so that the usual layout costs no more than constants.
  [[nodiscard, gnu::always_inline]] inline CanDecoding take(const cia402::TransmitLayout& layout,
                                                            const CanFrame& frame,
                                                            const cia402::ProcessData& data,
                                                            const Cia402Drive& drive,
                                                            DriveReport& report) noexcept {
    constexpr std::uint8_t absent = cia402::TransmitLayout::absent;
    if (layout.length == 0) return CanDecoding::foreign;
    if (frame.length != layout.length) return CanDecoding::malformed;
    if (layout.statusword != absent) {
      const auto bits = load_little_endian<std::uint16_t>(frame.data, layout.statusword);
      const auto state = cia402::state_of(bits);
      if (!state) return CanDecoding::malformed;
      if (!has_begun_) return CanDecoding::outdated;
      take_state(*state, (bits & cia402::follows_target) != 0, report);
    }
    if (!has_begun_) return CanDecoding::outdated;
    answer(streams_[layout.stream], report);
    if (layout.torque != absent) {
      const auto per_mille = load_little_endian<std::int16_t>(frame.data, layout.torque);
      report.effort = per_mille * drive.rated_effort / 1e3;
    }
    if (layout.velocity != absent) {
      const auto units = load_little_endian<std::int32_t>(frame.data, layout.velocity);
      report.velocity = units / drive.velocity_scale;
    }
    if (layout.position != absent) {
      const auto units = load_little_endian<std::int32_t>(frame.data, layout.position);
      const double position =
          (static_cast<double>(units) - drive.zero_position) / drive.position_scale;
      if (!data.has_velocity) {
        take_difference(position, cycle_ - streams_[layout.stream].age, data, report);
      }
      report.position = position;
    }
    if (layout.error_code != absent) {
      const auto code = load_little_endian<std::uint16_t>(frame.data, layout.error_code);
      if (report.fault != 0 && code != 0) report.fault = code;
    }
    return CanDecoding::accepted;
  }

  void take_state(cia402::State state, bool follows, DriveReport& report) noexcept {
    const bool in_operation = state == cia402::State::operation_enabled;
    has_followed_ = has_followed_ || (in_operation && follows);
    report.enabled = in_operation && (follows || !has_followed_);
    powered_ = cia402::may_exert(state);
    const bool fault =
        state == cia402::State::fault || state == cia402::State::fault_reaction_active;
    if (!fault) {
      report.fault = 0;
    } else if (report.fault == 0) {
      report.fault = emergency_ != 0 ? emergency_ : generic_error;
    }
  }

  /// The velocity between two positions, for a drive that does not say it. Real-time: yes.
  void take_difference(double position, std::uint32_t cycle, const cia402::ProcessData& data,
                       DriveReport& report) noexcept {
    const auto cycles = static_cast<std::int32_t>(cycle - position_cycle_);
    if (has_position_ && cycles <= 0) return;
    if (has_position_) report.velocity = (position - report.position) / (cycles * data.sync_period);
    has_position_ = true;
    position_cycle_ = cycle;
  }

  void answer(Stream& stream, DriveReport& report) noexcept {
    if (stream.unanswered > 0) --stream.unanswered;
    stream.age = cycles_since(stream.unanswered);
    report.age = age();
  }
  /// Cycles since the last SYNC but n.
  [[nodiscard]] std::uint32_t cycles_since(std::uint32_t n) const noexcept {
    constexpr std::uint32_t most = 64;
    std::uint64_t syncs = n < most ? syncs_ : 0;
    for (; n > 0 && syncs != 0; --n) syncs &= syncs - 1;  // leaves out the last one
    return static_cast<std::uint32_t>(std::countr_zero(syncs));
  }

  static constexpr std::uint16_t generic_error =
      0x1000;  ///< of CiA 301, for a fault without a name
  static constexpr std::uint32_t long_ago = 1000;

  std::array<Stream, cia402::ProcessData::most> streams_{};
  std::size_t stream_count_ = 2;
  bool has_followed_ = false;
  bool has_position_ = false;         ///< for differences
  std::uint32_t position_cycle_ = 0;  ///< that the last position belongs to
  std::uint32_t cycle_ = 0;           ///< cycles since the beginning, modulo 2^32
  bool powered_ = true;
  bool has_begun_ = false;   ///< a SYNC has been since the beginning
  std::uint64_t syncs_ = 0;  ///< a bit for each of the last cycles: it had SYNC; bit 0 is
                             ///< the last one
  bool awaits_mark_ = false;
  canopen::ObjectAddress mark_{};
  std::uint8_t mark_number_ = 0;
  std::uint32_t since_mark_ = long_ago;  ///< SYNCs since the mark was placed
  std::uint32_t known_lag_ = 0;          ///< SYNCs without an answer when the last mark's came
  std::uint16_t emergency_ = 0;
};

}  // namespace articula
