// SPDX-License-Identifier: Apache-2.0
/// @file How patient the CAN driver is, and what it counts.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/hardware/can/can_codec.hpp"

#include <chrono>
#include <cstdint>

namespace articula {

/// How patient the CAN driver is.
struct CanHardwareOptions {
  /// Age from which a joint's figures are not used: in cycles since the one they belong to. The
  /// feedback of the last cycle has age 0. Likewise, how many cycles in a row the bus may be too
  /// busy to take before writing is no longer ok.
  std::uint32_t stale_after = 3;
  /// Age from which the drive counts as silent, which is a fault [cycles].
  std::uint32_t silent_after = 20;
  /// Cycles in a row whose frames did not, or not surely, get onto the bus, from which that is a
  /// fault.
  std::uint32_t not_sent_after = 10;
  /// Where another node begins the bus's cycles: how long after that a cycle of the loop waits for
  /// the drives' feedback, at most; about half the period.
  std::chrono::nanoseconds feedback_time = std::chrono::microseconds(500);
  /// Time between two steps of the drives' set-up, about the period of the loop.
  std::chrono::nanoseconds set_up_period = std::chrono::milliseconds(1);
  /// Longest time that the set-up may take. Some drives take many seconds to boot, to charge their
  /// capacitors, or to find how motor and encoder stand to each other.
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

/// What the CAN driver has counted since it was made.
struct CanStatistics {
  std::uint64_t cycles = 0;       ///< commands written
  std::uint64_t not_sent = 0;     ///< of these, not or not wholly taken by the bus
  std::uint64_t unconfirmed = 0;  ///< of these, sent without a sign of life of the one before
  std::uint64_t partial = 0;      ///< readings in which some joint's feedback was missing
  std::uint64_t unpaced = 0;      ///< readings before which no cycle of the bus had begun, where
                                  ///< another node begins them
  std::uint64_t accepted = 0;     ///< frames that were taken in
  std::uint64_t outdated = 0;     ///< frames of the drives that were too old
  std::uint64_t foreign = 0;      ///< frames of nobody we know
  std::uint64_t malformed = 0;    ///< frames with a drive's identifier that make no sense

  /// Counts a frame by what the codec made of it. Real-time: yes.
  constexpr void count(CanDecoding decoding) noexcept {
    switch (decoding) {
      case CanDecoding::accepted:
        ++accepted;
        return;
      case CanDecoding::outdated:
        ++outdated;
        return;
      case CanDecoding::foreign:
        ++foreign;
        return;
      case CanDecoding::malformed:
        ++malformed;
        return;
    }
  }
};

}  // namespace articula
