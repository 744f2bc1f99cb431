// SPDX-License-Identifier: Apache-2.0
/// @file The numbers of a writer's messages without leaps.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

namespace articula::ros2::dds {

/// Numbers the messages of a remote writer such that they have no long leaps. Fast DDS 2.9.1 goes
/// through skipped numbers one by one, so a writer that has been there for hours would hold up all
/// others for a minute, and a wrong number for ever. It also notes each number of a gap that
/// something before is missing of.
///
/// A number leads on by `longest_step` at most. Behind a larger step the numbers go on from the one
/// before, and those that were skipped do not exist. Without such steps nothing changes.
/// Real-time: yes, all functions.
class WriterNumbers {
 public:
  static constexpr std::uint64_t longest_step = 1 << 16;
  static constexpr std::uint64_t margin = 1 << 10;  ///< that are kept before a leap
  static constexpr std::uint64_t ahead = 1 << 10;  ///< of what was acknowledged, if it costs memory

  /// The number of a message, as Fast DDS gets it.
  /// @return nothing for one from before a leap
  [[nodiscard]] std::optional<std::uint64_t> of_message(std::uint64_t original) noexcept {
    if (original <= offset_) return std::nullopt;
    if (original - offset_ > last_ + longest_step) offset_ = original - last_ - margin;
    last_ = std::max(last_, original - offset_);
    return original - offset_;
  }
  /// The first number that a writer still has.
  [[nodiscard]] std::uint64_t of_beginning(std::uint64_t original) noexcept {
    return of_message(original).value_or(1);
  }
  /// The last number that a writer has.
  [[nodiscard]] std::uint64_t of_end(std::uint64_t original) const noexcept {
    return original > offset_ ? original - offset_ : 0;
  }
  /// The number behind a gap, which may be shorter than the writer says: the rest is asked for.
  /// @param begin  of the gap, as Fast DDS gets it
  /// @return nothing if Fast DDS would have to note too many numbers
  [[nodiscard]] std::optional<std::uint64_t> of_gap(std::uint64_t begin,
                                                    std::uint64_t original) noexcept {
    const bool leads_on = begin <= acknowledged_ + 1;
    const std::uint64_t most = leads_on ? begin + longest_step : acknowledged_ + ahead;
    const std::uint64_t end = std::min(of_end(original), most);
    if (end <= begin) return std::nullopt;
    last_ = std::max(last_, end);
    return end;
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
  /// A reader of Fast DDS has found the writer, or has lost it. A reader that finds it again begins
  /// with the number 1.
  void match(bool found) noexcept {
    readers_ = std::max(0, readers_ + (found ? 1 : -1));
    if (readers_ == 0) last_ = acknowledged_ = 0;
  }
  /// The number as the writer knows it.
  [[nodiscard]] std::uint64_t original(std::uint64_t number) const noexcept {
    return number + offset_;
  }

 private:
  std::uint64_t offset_ = 0;        ///< of the writer's numbers
  std::uint64_t last_ = 0;          ///< the highest one that Fast DDS has got
  std::uint64_t acknowledged_ = 0;  ///< the last one of those without a hole
  int readers_ = 0;                 ///< that have found the writer
};

}  // namespace articula::ros2::dds
