// SPDX-License-Identifier: Apache-2.0
/// @file Statistics of durations in memory of fixed size.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace articula {

/// Durations counted in buckets: 16 for each octave, and one for each nanosecond below 32 ns.
/// Count, minimum, mean and maximum are exact; a percentile is at most 1/16 too high. Negative
/// durations count as 0.
class DurationHistogram {
 public:
  using Duration = std::chrono::nanoseconds;

  /// Counts one duration. Real-time: yes. O(1).
  void add(Duration duration) noexcept {
    const auto value = static_cast<std::uint64_t>(std::max(duration, Duration::zero()).count());
    ++buckets_[bucket_of(value)];
    ++count_;
    sum_ += static_cast<double>(value);
    min_ = std::min(min_, value);
    max_ = std::max(max_, value);
  }

  /// How many durations were added. Real-time: yes.
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  /// The shortest; 0 where there is none. Real-time: yes.
  [[nodiscard]] Duration min() const noexcept { return to_duration(count_ == 0 ? 0 : min_); }
  /// The longest; 0 where there is none. Real-time: yes.
  [[nodiscard]] Duration max() const noexcept { return to_duration(max_); }
  /// The average, in whole nanoseconds; 0 where there is none. Real-time: yes.
  [[nodiscard]] Duration mean() const noexcept {
    return Duration(count_ == 0 ? 0 : std::llround(sum_ / static_cast<double>(count_)));
  }

  /// A duration that at least this share of the durations does not exceed. It is the upper edge of
  /// the bucket in which the share is reached, or max() where that is less.
  /// @param share  0 .. 1, such as 0.99
  /// Real-time: yes. O(number of buckets).
  [[nodiscard]] Duration percentile(double share) const noexcept {
    const double wanted = share * static_cast<double>(count_);
    double reached = 0;
    for (std::size_t i = 0; i < buckets_.size(); ++i) {
      reached += static_cast<double>(buckets_[i]);
      if (buckets_[i] > 0 && reached >= wanted) return to_duration(std::min(upper_edge(i), max_));
    }
    return max();
  }

 private:
  static constexpr int fraction_bits = 4;  // 2^4 buckets for each octave
  static constexpr std::uint64_t per_octave = std::uint64_t{1} << fraction_bits;
  static constexpr std::size_t bucket_count = (64 - fraction_bits + 1) * per_octave;

  [[nodiscard]] static constexpr std::size_t bucket_of(std::uint64_t value) noexcept {
    if (value < per_octave) return value;
    const auto octave = static_cast<std::uint64_t>(std::bit_width(value) - 1 - fraction_bits);
    return octave * per_octave + (value >> octave);
  }
  [[nodiscard]] static constexpr std::uint64_t upper_edge(std::size_t bucket) noexcept {
    if (bucket < 2 * per_octave) return bucket;
    const std::size_t octave = bucket / per_octave - 1;
    // The last bucket's edge is 2^64 - 1: its shift overflows to 0, as unsigned numbers may.
    return ((bucket - octave * per_octave + 1) << octave) - 1;
  }
  [[nodiscard]] static Duration to_duration(std::uint64_t value) noexcept {
    return Duration(static_cast<Duration::rep>(value));
  }

  std::array<std::uint64_t, bucket_count> buckets_{};
  std::uint64_t count_ = 0;
  double sum_ = 0;
  std::uint64_t min_ = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t max_ = 0;
};

}  // namespace articula
