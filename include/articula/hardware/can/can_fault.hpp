// SPDX-License-Identifier: Apache-2.0
/// @file The faults of a CAN bus and its drives.
#pragma once

#include "articula/hardware/can/object_address.hpp"
#include "articula/text/characters.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace articula {

/// The cause for which the driver has disabled the drives.
enum class CanCause : unsigned char {
  none,              ///< There is no fault.
  no_activation,     ///< The drives could not be enabled in time, or one has refused.
  no_watchdog,       ///< A drive lacks the watchdog that its description names.
  link_down,         ///< The interface is switched off.
  link_gone,         ///< The interface does not exist any more.
  bus_off,           ///< The controller has left the bus after too many errors.
  not_sent,          ///< The bus has not taken the host's frames for too many cycles.
  no_sync,           ///< The node that begins the bus's cycles is silent.
  drive_silent,      ///< A drive's feedback is missing, or late, for too many cycles.
  drive_fault,       ///< A drive reports a fault.
  drive_disabled,    ///< A drive reports that it does not follow commands, without a fault.
  encoder_mismatch,  ///< Two encoders of a joint contradict each other.
};

/// The first fault: its cause, joint and object.
struct CanFault {
  CanCause cause = CanCause::none;
  int joint = -1;          ///< index of the joint of the faulty drive; -1 if it is no drive
  std::uint16_t code = 0;  ///< the drive's own fault code; 0 if it gave none
  /// The object that a CANopen drive has refused, or has not answered for, at activation; index 0
  /// if there is none.
  canopen::ObjectAddress object{};
  std::uint32_t abort_code = 0;  ///< of the refusal [CiA 301, table 22], or 0
};

/// The cause in words. Real-time: yes.
[[nodiscard]] constexpr std::string_view to_string(CanCause cause) noexcept {
  constexpr std::array<std::string_view, 12> texts{"no fault",
                                                   "the drives could not be enabled",
                                                   "a drive has no watchdog",
                                                   "the CAN interface is down",
                                                   "the CAN interface is gone",
                                                   "the CAN controller is bus-off",
                                                   "the CAN bus does not take frames",
                                                   "the SYNC of another node is missing",
                                                   "a drive's feedback is missing or late",
                                                   "a drive reports a fault",
                                                   "a drive has disabled itself",
                                                   "two encoders of a joint contradict each other"};
  const auto index = static_cast<std::size_t>(cause);
  return index < texts.size() ? texts[index] : "unknown fault";
}

/// A fault in words: cause, joint, the drive's code, and at activation the object that the drive
/// has refused or not answered for. Real-time: no (allocates).
[[nodiscard]] inline std::string describe(const CanFault& fault) {
  std::string text(to_string(fault.cause));
  if (fault.joint >= 0) text += ": joint " + std::to_string(fault.joint);
  if (fault.code != 0) text += ", fault code " + detail::hexadecimal(fault.code, 4);
  if (fault.object.index == 0) return text;
  text += fault.abort_code != 0 ? ", refuses object " : ", set-up stopped at object ";
  text += canopen::to_string(fault.object);
  if (fault.abort_code != 0) {
    text += " with abort code " + detail::hexadecimal(fault.abort_code, 8);
  }
  return text;
}

}  // namespace articula
