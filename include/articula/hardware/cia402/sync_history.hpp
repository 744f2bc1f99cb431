// SPDX-License-Identifier: Apache-2.0
/// @file Which of the last cycles of a bus began with SYNC.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace articula {

/// Which of the last 64 cycles of a bus began with SYNC, and whether an answer to one is missing.
class SyncHistory {
 public:
  /// A cycle begins; the first one is number 1. Real-time: yes.
  constexpr void begin_cycle(bool with_sync) noexcept {
    ++cycle_;
    if (!with_sync) withdraw_sync();
  }
  /// The last cycle has not begun with SYNC after all: the bus did not take it. Real-time: yes.
  constexpr void withdraw_sync() noexcept {
    gaps_ = gaps() | 1;
    last_gap_ = cycle_;
  }

  /// The number of this cycle. Real-time: yes.
  [[nodiscard]] constexpr std::uint64_t cycle() const noexcept { return cycle_; }
  /// Whether it began with SYNC. Real-time: yes.
  [[nodiscard]] constexpr bool is_new() const noexcept { return last_gap_ != cycle_; }
  /// Whether any of the last cycles did. Real-time: yes.
  [[nodiscard]] constexpr bool has_begun() const noexcept { return from(0) != 0; }
  /// How many cycles from one on began with SYNC. Real-time: yes.
  [[nodiscard]] constexpr std::uint32_t count_from(std::uint64_t first) const noexcept {
    std::uint32_t count = 0;  // std::popcount may be a call
    for (std::uint64_t syncs = from(first); syncs != 0; syncs &= syncs - 1) ++count;
    return count;
  }
  /// The first cycle from one on that began with SYNC; where there is none, the last that did.
  /// has_begun() has to be true. Real-time: yes.
  [[nodiscard]] constexpr std::uint64_t first_from(std::uint64_t first) const noexcept {
    const std::uint64_t syncs = from(first);
    const int ago = syncs != 0 ? 63 - std::countl_zero(syncs) : std::countr_zero(from(0));
    return cycle_ - static_cast<std::uint64_t>(ago);
  }

  /// Some answer is missing or late. Real-time: yes.
  constexpr void note_missing() noexcept { missing_ = true; }
  constexpr void forget_missing() noexcept { missing_ = false; }
  [[nodiscard]] constexpr bool is_missing() const noexcept { return missing_; }

 private:
  /// A bit for each of the last cycles from one on that began with SYNC; bit 0 is the last one's.
  [[nodiscard]] constexpr std::uint64_t from(std::uint64_t first) const noexcept {
    const std::uint64_t cycles = cycle_ - std::min(std::max(first, std::uint64_t{1}) - 1, cycle_);
    return cycles < 64 ? ~gaps() & ((std::uint64_t{1} << cycles) - 1) : ~gaps();
  }
  /// Likewise for those that did not.
  [[nodiscard]] constexpr std::uint64_t gaps() const noexcept {
    const std::uint64_t ago = cycle_ - last_gap_;
    return ago < 64 ? gaps_ << ago : 0;
  }

  std::uint64_t cycle_ = 0;
  std::uint64_t last_gap_ = 0;  ///< the last cycle without SYNC
  std::uint64_t gaps_ = 0;      ///< a bit for each until then without SYNC, the last one's is bit 0
  bool missing_ = false;
};

}  // namespace articula
