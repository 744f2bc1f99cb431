// SPDX-License-Identifier: Apache-2.0
/// @file The search for faults of a CAN bus and its drives in each cycle.
#pragma once

#include "articula/hardware/can/can_hardware_options.hpp"
#include "articula/hardware/can/can_transport.hpp"
#include "articula/hardware/can/find_drive_fault.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

namespace articula::detail {

/// Finds faults of the link, of another node's SYNC and of the drives. It counts the consecutive
/// cycles without SYNC, or with feedback that is too old.
class CanFaultWatch {
 public:
  /// Clears the counts of consecutive cycles. Real-time: yes.
  void restart() noexcept { stale_ = unpaced_ = 0; }

  /// Notes how many cycles another node has begun before a reading.
  /// @return false if none has begun since the reading before
  /// Real-time: yes.
  [[nodiscard]] bool note_cycles(std::uint64_t begun_cycles) noexcept {
    const bool begun = begun_cycles != begun_cycles_;
    begun_cycles_ = begun_cycles;
    unpaced_ = begun ? 0 : unpaced_ + 1;
    return begun;
  }

  /// The first fault of link, SYNC or drives; CanCause::none if there is none.
  /// Real-time: yes. O(N).
  [[nodiscard]] CanFault find(CanLink link, std::span<const DriveReport> reports,
                              const CanHardwareOptions& options) noexcept {
    if (link != CanLink::up) return {cause_of(link)};
    if (unpaced_ >= options.silent_after) return {CanCause::no_sync};
    const CanFault drive = find_drive_fault(reports, options.silent_after);
    if (drive.cause != CanCause::none) return drive;
    // Feedback that arrives in every cycle, but late.
    const auto oldest = std::ranges::max_element(reports, {}, &DriveReport::age);
    stale_ = oldest->age >= options.stale_after ? stale_ + 1 : 0;
    if (stale_ < options.silent_after) return {};
    return {CanCause::drive_silent, static_cast<int>(oldest - reports.begin())};
  }

 private:
  std::uint32_t stale_ = 0;         ///< consecutive readings with figures that are too old
  std::uint32_t unpaced_ = 0;       ///< consecutive readings before which no cycle had begun
  std::uint64_t begun_cycles_ = 0;  ///< at the last reading
};

}  // namespace articula::detail
