// SPDX-License-Identifier: Apache-2.0
/// @file A record of the cycles of a bus that began with SYNC.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace articula {

/// A record of the last 64 cycles of a bus: which began with SYNC, and whether an answer to one is
/// missing. All functions are real-time.
class SyncHistory {
 public:
  /// Begins a cycle; the first one is number 1.
  constexpr void begin_cycle(bool with_sync) noexcept {
    ++cycle_;
    if (!with_sync) cancel_sync();
  }
  /// Notes that the bus did not take the SYNC of this cycle.
  constexpr void cancel_sync() noexcept {
    if (last_gap_ != cycle_ && last_gap_ + 1 != cycle_) last_before_gap_ = cycle_ - 1;
    gaps_ = gaps() | 1;
    last_gap_ = cycle_;
  }

  /// The number of this cycle.
  [[nodiscard]] constexpr std::uint64_t cycle() const noexcept { return cycle_; }
  /// Whether this cycle began with SYNC.
  [[nodiscard]] constexpr bool is_new() const noexcept { return last_gap_ != cycle_; }
  /// Whether a cycle from `first` on began with SYNC that is not in the record any more. True also
  /// if that is not known, because several cycles without SYNC are in the record.
  [[nodiscard]] constexpr bool has_forgotten_from(std::uint64_t first) const noexcept {
    if (cycle_ < 64) return false;
    const std::uint64_t oldest = cycle_ - 63;  // in the record
    const bool ends_in_gap =
        last_gap_ + 1 == oldest || (last_gap_ >= oldest && last_before_gap_ < oldest);
    const std::uint64_t last = ends_in_gap ? last_before_gap_ : oldest - 1;
    return last > 0 && first <= last;
  }
  /// Whether any of the last cycles began with SYNC.
  [[nodiscard]] constexpr bool has_begun() const noexcept { return from(0) != 0; }
  /// Number of cycles from `first` on that began with SYNC.
  [[nodiscard]] constexpr std::uint32_t count_from(std::uint64_t first) const noexcept {
    std::uint32_t count = 0;  // std::popcount may be a call
    for (std::uint64_t syncs = from(first); syncs != 0; syncs &= syncs - 1) ++count;
    return count;
  }
  /// The first cycle from `first` on that began with SYNC; without one, the last that did.
  /// Precondition: has_begun().
  [[nodiscard]] constexpr std::uint64_t first_from(std::uint64_t first) const noexcept {
    const std::uint64_t syncs = from(first);
    const int ago = syncs != 0 ? 63 - std::countl_zero(syncs) : std::countr_zero(from(0));
    return cycle_ - static_cast<std::uint64_t>(ago);
  }

  /// Notes that an answer is missing or late.
  constexpr void note_missing() noexcept { missing_ = true; }
  constexpr void forget_missing() noexcept { missing_ = false; }
  [[nodiscard]] constexpr bool is_missing() const noexcept { return missing_; }

 private:
  /// A bit for each cycle from `first` on that began with SYNC; bit 0 is this cycle.
  [[nodiscard]] constexpr std::uint64_t from(std::uint64_t first) const noexcept {
    const std::uint64_t cycles = cycle_ - std::min(std::max(first, std::uint64_t{1}) - 1, cycle_);
    return cycles < 64 ? ~gaps() & ((std::uint64_t{1} << cycles) - 1) : ~gaps();
  }
  /// A bit for each cycle that did not.
  [[nodiscard]] constexpr std::uint64_t gaps() const noexcept {
    const std::uint64_t ago = cycle_ - last_gap_;
    return ago < 64 ? gaps_ << ago : 0;
  }

  std::uint64_t cycle_ = 0;
  std::uint64_t last_gap_ = 0;         ///< the last cycle without SYNC
  std::uint64_t last_before_gap_ = 0;  ///< the last cycle with SYNC before that one; 0: none
  std::uint64_t gaps_ = 0;             ///< a bit for each cycle without SYNC; bit 0 is last_gap_
  bool missing_ = false;
};

}  // namespace articula
