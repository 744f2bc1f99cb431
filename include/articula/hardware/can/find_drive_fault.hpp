// SPDX-License-Identifier: Apache-2.0
/// @file The search for the faulty drive in the reports of all drives.
#pragma once

#include "articula/hardware/can/can_codec.hpp"
#include "articula/hardware/can/can_fault.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace articula {

/// The first drive with a fault, while all drives should follow commands.
/// @param reports       in the order of the joints
/// @param silent_after  age from which a drive counts as silent [cycles]
/// @return              CanCause::none if there is no such drive
/// Real-time: yes. O(N).
[[nodiscard]] constexpr CanFault find_drive_fault(std::span<const DriveReport> reports,
                                                  std::uint32_t silent_after) noexcept {
  for (std::size_t j = 0; j < reports.size(); ++j) {
    const DriveReport& report = reports[j];
    const int joint = static_cast<int>(j);
    if (report.fault != 0) return {CanCause::drive_fault, joint, report.fault};
    if (report.encoder_mismatch) return {CanCause::encoder_mismatch, joint};
    if (!report.enabled) return {CanCause::drive_disabled, joint};
    if (report.age >= silent_after) return {CanCause::drive_silent, joint};
  }
  return {};
}

/// The drive because of which an activation has failed: one whose encoders contradict each other,
/// else one that is faulty or silent, else one that is not enabled.
/// @param reports      in the order of the joints
/// @param stale_after  age from which a drive's figures are not used [cycles]
/// @return             CanCause::encoder_mismatch; else CanCause::no_activation, with joint -1 if no
///                     drive is the reason
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

}  // namespace articula
