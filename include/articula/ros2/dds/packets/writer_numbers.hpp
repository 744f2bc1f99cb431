// SPDX-License-Identifier: Apache-2.0
/// @file The numbers of a writer's messages as Fast DDS gets them.
#pragma once

#include "articula/ros2/dds/packets/budget.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>

namespace articula::ros2::dds {

/// Numbers the messages of a remote writer for Fast DDS 2.9.1, which goes through skipped numbers
/// one by one: 41 s for a writer with 30 million messages, and for ever for a wrong number. It also
/// notes each number of a gap behind a missing message.
///
/// A writer that is found with a high first number gets an offset, once. Its first heartbeat
/// decides. Messages before it are hidden for a while, and come again if the writer is reliable.
/// Later steps are bounded by a budget, and by what Fast DDS has acknowledged: that alone tells
/// what it has got. Numbers of other writers stay as they are.
/// Real-time: yes, all functions.
class WriterNumbers {
 public:
  using Time = Budget::Time;

  static constexpr std::uint64_t high = 1 << 16;      ///< a first number that gets an offset
  static constexpr std::uint64_t longest = 1 << 18;   ///< step, and steps of all writers a second
  static constexpr std::uint64_t ahead = 128;         ///< of a missing message, if noted for it
  static constexpr std::uint64_t margin = 1 << 10;    ///< before a message that decides
  static constexpr std::uint64_t free_step = 1 << 6;  ///< of a message, without the budget
  static constexpr std::chrono::seconds patience{2};  ///< for the first heartbeat

  /// The number of a message.
  /// @return nothing if it has none: it is from before the offset, or must wait
  [[nodiscard]] std::optional<std::uint64_t> of_message(std::uint64_t original, Budget& budget,
                                                        Time now) noexcept {
    if (!offset_ && original > acknowledged_ + high) {
      if (!waits_since_) waits_since_ = now;
      if (now - *waits_since_ < patience) return std::nullopt;
      offset_ = original - acknowledged_ - margin;  // a writer without heartbeats
      last_ = acknowledged_ + margin;
    }
    const std::uint64_t number = decided(original);
    if (number == 0) return std::nullopt;
    if (number > last_ + free_step) last_ += budget.take(number - last_, now);
    if (number > last_ + free_step) return std::nullopt;
    last_ = std::max(last_, number);
    return number;
  }
  /// The first number that a writer still has, in a heartbeat.
  [[nodiscard]] std::uint64_t of_beginning(std::uint64_t original, Budget& budget,
                                           Time now) noexcept {
    if (!offset_ && original > acknowledged_ + high) offset_ = original - acknowledged_ - 1;
    const std::uint64_t number = decided(original),
                        gone = number - std::min<std::uint64_t>(number, 1);
    begun_ = std::max(begun_, acknowledged_);
    if (gone > begun_) begun_ += budget.take(gone - begun_, now);
    return std::min({gone, begun_, acknowledged_ + longest}) + 1;
  }
  /// The last number that a writer has, in a heartbeat.
  [[nodiscard]] std::uint64_t of_end(std::uint64_t original) noexcept { return decided(original); }
  /// A gap, which may be shorter than the writer says: the rest is asked for.
  struct Gap {
    std::uint64_t begin = 0, end = 0;
  };
  /// @return nothing if Fast DDS would have to note too many numbers
  [[nodiscard]] std::optional<Gap> of_gap(std::uint64_t begin, std::uint64_t end, Budget& budget,
                                          Time now) noexcept {
    if (!offset_ && begin > acknowledged_ + high) return std::nullopt;
    Gap gap{std::max<std::uint64_t>(decided(begin), 1), decided(end)};
    if (gap.end <= gap.begin) return std::nullopt;
    const bool leads_on = gap.begin <= acknowledged_ + 1;
    if (!leads_on) gap.end = std::min(gap.end, acknowledged_ + ahead);
    gap.end = std::min(gap.end, gap.begin + longest);
    if (gap.end <= gap.begin) return std::nullopt;
    const std::uint64_t steps = gap.end - gap.begin;
    if (steps > free_step) gap.end = gap.begin + std::max(free_step, budget.take(steps, now));
    return gap;
  }
  /// Whether a message is so little ahead that Fast DDS may keep it until those before it come.
  [[nodiscard]] bool is_near(std::uint64_t number) const noexcept {
    return number <= acknowledged_ + ahead;
  }

  /// Fast DDS acknowledges all numbers before one.
  /// @return that number, as the writer knows it
  std::uint64_t acknowledge(std::uint64_t next) noexcept {
    acknowledged_ = next > 0 ? next - 1 : 0;
    return original(next);
  }
  /// The number as the writer knows it.
  [[nodiscard]] std::uint64_t original(std::uint64_t number) const noexcept {
    return number + offset_.value_or(0);
  }

 private:
  /// The number with the offset, which is decided now; 0 before it.
  [[nodiscard]] std::uint64_t decided(std::uint64_t original) noexcept {
    if (!offset_) offset_ = 0;
    return original - std::min(original, *offset_);
  }

  std::optional<std::uint64_t> offset_{};  ///< of the writer's numbers, for good
  std::optional<Time> waits_since_{};      ///< for a heartbeat
  std::uint64_t last_ = 0;                 ///< message
  std::uint64_t begun_ = 0;                ///< the last beginning in a heartbeat
  std::uint64_t acknowledged_ = 0;         ///< the last number of those that Fast DDS has got
};

}  // namespace articula::ros2::dds
