// SPDX-License-Identifier: Apache-2.0
/// @file Overruns of a loop within a second.
#pragma once

#include <cstdint>

namespace articula {

/// Counts the overruns of a loop: cycles that ended after the next one was due. The count begins
/// again where more than a second of cycles has passed since it began. SupervisedLoop has one.
class OverrunCounter {
 public:
  /// @param most    overruns that are borne within a second
  /// @param period  of the loop [s]
  OverrunCounter(int most, double period)
      : most_(most), cycles_of_a_second_(static_cast<std::uint64_t>(1 / period)) {}

  /// Notes a cycle. Real-time: yes.
  void note_cycle() noexcept { ++cycles_; }

  /// Begins again. Real-time: yes.
  void start() noexcept {
    overruns_ = 0;
    since_ = cycles_;
  }

  /// Notes an overrun.
  /// @return  whether there are more than are borne
  /// Real-time: yes.
  [[nodiscard]] bool note_overrun() noexcept {
    if (cycles_ - since_ > cycles_of_a_second_) start();
    return ++overruns_ > most_;
  }

 private:
  int most_;
  std::uint64_t cycles_of_a_second_;
  std::uint64_t cycles_ = 0;
  int overruns_ = 0;
  std::uint64_t since_ = 0;  ///< cycle in which the count began
};

}  // namespace articula
