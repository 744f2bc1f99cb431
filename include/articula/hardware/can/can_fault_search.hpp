// SPDX-License-Identifier: Apache-2.0
/// @file The search for faults of a CAN bus and its drives.
#pragma once

#include "articula/hardware/can/can_fault.hpp"
#include "articula/hardware/can/can_hardware_options.hpp"
#include "articula/hardware/can/can_transport.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace articula::detail {

/// The drive because of which an activation has failed. It is one whose encoders contradict each
/// other, else one that is faulty or silent, else one that is not enabled.
/// @param reports      in the order of the joints
/// @param stale_after  age from which a drive's figures are not used [cycles]
/// @return             CanCause::encoder_mismatch; else CanCause::no_activation, with joint -1 if
///                     no drive is the reason
/// Real-time: yes. O(N).
[[nodiscard]] constexpr CanFault find_activation_fault(std::span<const DriveReport> reports,
                                                       std::uint32_t stale_after) noexcept {
  const auto first = [&](auto condition) -> CanFault {
    for (std::size_t j = 0; j < reports.size(); ++j) {
      if (!condition(reports[j])) continue;
      return {CanCause::no_activation, static_cast<int>(j), reports[j].fault};
    }
    return {CanCause::no_activation};
  };
  const CanFault mismatch = first([](const DriveReport& r) { return r.encoder_mismatch; });
  if (mismatch.joint >= 0) return {CanCause::encoder_mismatch, mismatch.joint};
  const CanFault faulty =
      first([&](const DriveReport& r) { return r.fault != 0 || r.age >= stale_after; });
  return faulty.joint >= 0 ? faulty : first([](const DriveReport& r) { return !r.enabled; });
}

/// Finds faults of the link, of another node's SYNC and of the drives. It counts the consecutive
/// cycles without SYNC, or with feedback that is too old.
class CanFaultSearch {
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
    for (std::size_t j = 0; j < reports.size(); ++j) {
      const DriveReport& report = reports[j];
      const int joint = static_cast<int>(j);
      if (report.fault != 0) return {CanCause::drive_fault, joint, report.fault};
      if (report.encoder_mismatch) return {CanCause::encoder_mismatch, joint};
      if (!report.enabled) return {CanCause::drive_disabled, joint};
      if (report.age >= options.silent_after) return {CanCause::drive_silent, joint};
    }
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
