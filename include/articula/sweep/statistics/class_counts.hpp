// SPDX-License-Identifier: Apache-2.0
/// @file Counts of numbered classes that lie close together.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace articula {

/// Counts of classes -100 000 .. 100 000. It keeps a count for each class between the lowest and
/// the highest one that occurs.
class ClassCounts {
 public:
  static constexpr std::int32_t most = 100'000;  ///< the highest class

  /// Adds to a class.
  /// @param place  -most .. most
  /// Real-time: no (allocates).
  void add(std::int32_t place, std::uint64_t count = 1) {
    if (counts_.empty()) first_ = place;
    if (place < first_) {
      counts_.insert(counts_.begin(), static_cast<std::size_t>(first_ - place), 0);
      first_ = place;
    }
    const auto index = static_cast<std::size_t>(place - first_);
    if (index >= counts_.size()) counts_.resize(index + 1);
    counts_[index] += count;
    count_ += count;
  }

  /// The sum of all counts.
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  /// The class of a rank in ascending order.
  /// @param rank  0 .. count() - 1
  [[nodiscard]] std::int32_t at_rank(std::uint64_t rank) const noexcept {
    std::size_t index = 0;
    for (std::uint64_t seen = counts_[0]; seen <= rank; seen += counts_[index]) ++index;
    return first_ + static_cast<std::int32_t>(index);
  }

  /// Calls `visit(class, count)` for each class that occurs, in ascending order.
  void for_each(const auto& visit) const {
    for (std::size_t k = 0; k < counts_.size(); ++k) {
      if (counts_[k] > 0) visit(first_ + static_cast<std::int32_t>(k), counts_[k]);
    }
  }
  /// The number of classes that occur.
  [[nodiscard]] std::size_t size() const noexcept {
    return static_cast<std::size_t>(
        std::ranges::count_if(counts_, [](std::uint64_t count) { return count > 0; }));
  }
  [[nodiscard]] bool operator==(const ClassCounts&) const = default;

 private:
  std::vector<std::uint64_t> counts_{};
  std::int32_t first_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace articula
