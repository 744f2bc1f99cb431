// SPDX-License-Identifier: Apache-2.0
/// @file Options and counters of the CAN driver.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/hardware/can/can_codec.hpp"

#include <chrono>
#include <cstdint>

namespace articula {

/// Ages and times from which the CAN driver treats something as a fault.
struct CanHardwareOptions {
  /// Age from which a joint's figures are not used, in cycles since the cycle that they belong to.
  /// Feedback of the last cycle has age 0. Also the number of consecutive cycles that the bus does
  /// not take from which `write` fails.
  std::uint32_t stale_after = 3;
  /// Age from which the drive counts as silent, which is a fault [cycles].
  std::uint32_t silent_after = 20;
  /// Number of consecutive cycles without a sign that their frames were on the bus, from which that
  /// is a fault.
  std::uint32_t not_sent_after = 10;
  /// Longest wait for feedback after another node has begun a cycle of the bus; about half the
  /// period.
  std::chrono::nanoseconds feedback_time = std::chrono::microseconds(500);
  /// Time between two steps of the set-up, about the period of the loop.
  std::chrono::nanoseconds set_up_period = std::chrono::milliseconds(1);
  /// Longest time of the set-up. Some drives take many seconds to boot, to charge their capacitors
  /// or to align motor and encoder.
  std::chrono::nanoseconds set_up_time = std::chrono::seconds(20);
};

/// Refuses options that make no sense.
/// @throws std::invalid_argument naming the option, the value and the limit
/// Real-time: no (throws).
inline void validate(const CanHardwareOptions& options) {
  const auto refuse = [](detail::MessageParts parts) {
    detail::refuse({"CAN hardware: ", detail::message_of(parts)});
  };
  if (options.stale_after < 1) {
    refuse({"stale_after ", options.stale_after, " is less than 1 cycle"});
  }
  if (options.silent_after < options.stale_after) {
    refuse(
        {"silent_after ", options.silent_after, " is less than stale_after ", options.stale_after});
  }
  if (options.not_sent_after < 1) {
    refuse({"not_sent_after ", options.not_sent_after, " is less than 1 cycle"});
  }
  if (options.feedback_time.count() < 0) {
    refuse({"feedback_time ", options.feedback_time.count(), " ns is negative"});
  }
  if (options.set_up_period.count() <= 0) {
    refuse({"set_up_period ", options.set_up_period.count(), " ns is not positive"});
  }
  if (options.set_up_time < options.set_up_period) {
    refuse({"set_up_time ", options.set_up_time.count(), " ns is less than set_up_period ",
            options.set_up_period.count(), " ns"});
  }
}

/// Counters of the CAN driver since its construction.
struct CanStatistics {
  std::uint64_t cycles = 0;       ///< commands written
  std::uint64_t not_sent = 0;     ///< of these, not or not completely taken by the bus
  std::uint64_t unconfirmed = 0;  ///< of these, sent without a sign of the one before
  std::uint64_t partial = 0;      ///< readings with missing feedback of some joint
  std::uint64_t unpaced = 0;      ///< readings before which another node should have begun a cycle
  std::uint64_t accepted = 0;     ///< frames that the codec has accepted
  std::uint64_t outdated = 0;     ///< drives' frames that were too old
  std::uint64_t foreign = 0;      ///< frames with unknown identifiers
  std::uint64_t malformed = 0;    ///< drives' frames with invalid content

  /// Counts a frame by the result of decoding. Real-time: yes.
  constexpr void count(CanDecoding decoding) noexcept {
    accepted += decoding == CanDecoding::accepted;
    outdated += decoding == CanDecoding::outdated;
    foreign += decoding == CanDecoding::foreign;
    malformed += decoding == CanDecoding::malformed;
  }
};

}  // namespace articula
