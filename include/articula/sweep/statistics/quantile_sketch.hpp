// SPDX-License-Identifier: Apache-2.0
/// @file Quantiles of many numbers in little memory.
#pragma once

#include "articula/sweep/statistics/class_counts.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

namespace articula {

/// Counts numbers in classes of equal ratio. A quantile has a relative error of at most `accuracy`,
/// or an absolute error of `zero`. Sketches of parts merge to the sketch of all: counts add up, in
/// any order.
/// Source: Masson, Rim, Lee: DDSketch: a fast and fully-mergeable quantile sketch with
/// relative-error guarantees, VLDB 2019.
class QuantileSketch {
 public:
  static constexpr double accuracy = 0.005;  ///< relative [1]
  static constexpr double zero = 1e-15;      ///< numbers not above it count as 0

  /// Adds numbers of one value.
  /// @param x  finite
  /// Real-time: no (allocates).
  void add(double x, std::uint64_t count = 1) {
    if (std::fabs(x) <= zero) {
      zeros_ += count;
    } else {
      (x < 0 ? negative_ : positive_).add(class_of(std::fabs(x)), count);
    }
  }
  void merge(const QuantileSketch& other) {
    for (const auto& [own, more] :
         {std::pair(&negative_, &other.negative_), std::pair(&positive_, &other.positive_)}) {
      more->for_each([own](std::int32_t place, std::uint64_t count) { own->add(place, count); });
    }
    zeros_ += other.zeros_;
  }

  [[nodiscard]] std::uint64_t count() const noexcept {
    return negative_.count() + zeros_ + positive_.count();
  }

  /// The number of a rank in ascending order.
  /// @param rank  0 .. count() - 1
  [[nodiscard]] double at_rank(std::uint64_t rank) const noexcept {
    const std::uint64_t below = negative_.count();
    if (rank < below) return -value_of(negative_.at_rank(below - 1 - rank));
    if (rank < below + zeros_) return 0;
    return value_of(positive_.at_rank(rank - below - zeros_));
  }

  // The counts, for files and histograms.
  [[nodiscard]] const ClassCounts& negative() const noexcept { return negative_; }
  [[nodiscard]] const ClassCounts& positive() const noexcept { return positive_; }
  [[nodiscard]] std::uint64_t zeros() const noexcept { return zeros_; }
  /// A sketch of these counts.
  [[nodiscard]] static QuantileSketch from_counts(ClassCounts negative, std::uint64_t zeros,
                                                  ClassCounts positive) {
    QuantileSketch sketch;
    sketch.negative_ = std::move(negative);
    sketch.positive_ = std::move(positive);
    sketch.zeros_ = zeros;
    return sketch;
  }
  /// The number that stands for a class: its relative distance from both ends is the same.
  [[nodiscard]] static double value_of(std::int32_t place) noexcept {
    return 2 * std::exp(place * step()) / (ratio + 1);
  }

 private:
  static constexpr double ratio = (1 + accuracy) / (1 - accuracy);

  [[nodiscard]] static double step() noexcept {
    static const double logarithm = std::log(ratio);
    return logarithm;
  }
  /// Class k has the numbers above ratio^(k - 1), up to ratio^k.
  [[nodiscard]] static std::int32_t class_of(double x) noexcept {
    return static_cast<std::int32_t>(std::ceil(std::log(x) / step()));
  }

  ClassCounts negative_{}, positive_{};
  std::uint64_t zeros_ = 0;
};

}  // namespace articula
