// SPDX-License-Identifier: Apache-2.0
/// @file Quantiles of many numbers in little memory.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>

namespace articula {

/// Counts numbers in classes of equal ratio. A quantile has a relative error of at most `accuracy`,
/// or an absolute error of `zero`. Sketches of parts merge to the sketch of all: counts add up, in
/// any order.
/// Source: Masson, Rim, Lee: DDSketch: a fast and fully-mergeable quantile sketch with relative-error
/// guarantees, VLDB 2019.
class QuantileSketch {
 public:
  static constexpr double accuracy = 0.005;  ///< relative [1]
  static constexpr double zero = 1e-15;      ///< numbers not above it count as 0

  using Classes = std::map<std::int32_t, std::uint64_t>;  ///< counts by class

  /// Adds numbers of one value.
  /// @param x  finite
  /// Real-time: no (allocates).
  void add(double x, std::uint64_t count = 1) {
    if (std::fabs(x) <= zero) {
      zeros_ += count;
    } else {
      (x < 0 ? negative_ : positive_)[class_of(std::fabs(x))] += count;
    }
    count_ += count;
  }
  void merge(const QuantileSketch& other) {
    for (const auto& [place, count] : other.negative_) negative_[place] += count;
    for (const auto& [place, count] : other.positive_) positive_[place] += count;
    zeros_ += other.zeros_;
    count_ += other.count_;
  }

  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }

  /// The number of a rank in ascending order.
  /// @param rank  0 .. count() - 1
  [[nodiscard]] double at_rank(std::uint64_t rank) const noexcept {
    std::uint64_t seen = 0;
    for (auto item = negative_.rbegin(); item != negative_.rend(); ++item) {
      seen += item->second;
      if (rank < seen) return -value_of(item->first);
    }
    seen += zeros_;
    if (rank < seen) return 0;
    for (const auto& [place, count] : positive_) {
      seen += count;
      if (rank < seen) return value_of(place);
    }
    return std::nan("");
  }

  // The counts, for files and histograms.
  [[nodiscard]] const Classes& negative() const noexcept { return negative_; }
  [[nodiscard]] const Classes& positive() const noexcept { return positive_; }
  [[nodiscard]] std::uint64_t zeros() const noexcept { return zeros_; }
  /// A sketch of these counts.
  [[nodiscard]] static QuantileSketch from_counts(Classes negative, std::uint64_t zeros,
                                                  Classes positive) {
    QuantileSketch sketch;
    sketch.negative_ = std::move(negative);
    sketch.positive_ = std::move(positive);
    sketch.zeros_ = sketch.count_ = zeros;
    for (const Classes* classes : {&sketch.negative_, &sketch.positive_}) {
      for (const auto& [place, count] : *classes) sketch.count_ += count;
    }
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

  Classes negative_{}, positive_{};
  std::uint64_t zeros_ = 0, count_ = 0;
};

}  // namespace articula
