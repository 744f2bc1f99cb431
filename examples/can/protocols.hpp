// SPDX-License-Identifier: Apache-2.0
/// @file The two protocols of the simulated drives.
#pragma once

#include "articula/hardware/can/can_codec.hpp"
#include "articula/hardware/cia402/simulated_cia402_drives.hpp"
#include "articula/hardware/quanser/simulated_quanser_drives.hpp"
#include "articula/robots/q2d.hpp"
#include "articula/robots/q2d_modules.hpp"

#include <cstdint>
#include <numbers>

namespace articula::examples {

/// The arm with CiA 402 drives: nodes 1 and 2, 2^20 position units per turn of the joint, velocity
/// in 1e-6 rad/s, torque in per mille of a little more than the joints' limits.
inline constexpr Cia402DriveList<2> q2d_cia402{{
    {.node = 1,
     .rated_effort = 30,
     .position_scale = 1048576 / (2 * std::numbers::pi),
     .velocity_scale = 1e6},
    {.node = 2,
     .rated_effort = 15,
     .position_scale = 1048576 / (2 * std::numbers::pi),
     .velocity_scale = 1e6},
}};

/// The protocol of the Quanser arm's joint modules.
struct QuanserProtocol {
  using Drives = SimulatedQuanserDrives<Q2d>;
  static constexpr std::uint32_t sync = quanser::sync_identifier;
  static constexpr std::uint32_t feedback = quanser::position_base;

  static Drives make(const SimulatorOptions<2>& options) { return Drives(q2d_modules, options); }
  /// The frames that the drives receive.
  static CanSubscription subscription() {
    CanSubscription wanted{.identifiers = {sync}};
    for (const QuanserModule& module : q2d_modules) {
      wanted.identifiers.push_back(quanser::control_base + module.node);
      wanted.identifiers.push_back(quanser::effort_base + module.node);
    }
    return wanted;
  }
  static std::uint8_t node(int joint) { return static_cast<std::uint8_t>(joint + 1); }
  static std::uint8_t node_of(const CanFrame& frame) { return quanser::node_of(frame); }
  static void raise_fault(Drives& drives, int joint) {
    drives.raise_fault(joint, quanser::over_current);
  }
};

/// CANopen drives of the profile CiA 402.
struct Cia402Protocol {
  using Drives = SimulatedCia402Drives<Q2d>;
  static constexpr std::uint32_t sync = canopen::sync_identifier;
  static constexpr std::uint32_t feedback = canopen::transmit_pdo_1_base;

  static Drives make(const SimulatorOptions<2>& options) { return Drives(q2d_cia402, options); }
  static CanSubscription subscription() {
    CanSubscription wanted{.identifiers = {canopen::nmt_identifier, sync}};
    for (const Cia402Drive& drive : q2d_cia402) {
      wanted.identifiers.push_back(canopen::receive_pdo_1_base + drive.node);
      wanted.identifiers.push_back(canopen::sdo_request_base + drive.node);
      wanted.identifiers.push_back(canopen::heartbeat_base + drive.host_node);
    }
    return wanted;
  }
  static std::uint8_t node(int joint) { return static_cast<std::uint8_t>(joint + 1); }
  static std::uint8_t node_of(const CanFrame& frame) {
    return static_cast<std::uint8_t>(frame.identifier & 0x7f);
  }
  static void raise_fault(Drives& drives, int joint) { drives.raise_fault(joint, 0x2310); }
};

}  // namespace articula::examples
