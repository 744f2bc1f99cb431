// SPDX-License-Identifier: Apache-2.0
/// @file The Quanser arm on a CAN bus. CMake target: articula::socketcan.
#pragma once

#include "articula/hardware/can_hardware.hpp"
#include "articula/hardware/quanser_codec.hpp"
#include "articula/hardware/socketcan.hpp"
#include "articula/robots/q2d.hpp"

#include <string>

namespace articula {

/// The joint modules of the Quanser arm, shoulder then elbow: docs/quanser_protocol.md. Encoders
/// with 4096 counts per turn behind gears of 100 and 80; the load's encoders have 65536 counts per
/// turn. These figures are ours: check them on the arm at hand, see docs/hardware.md.
inline constexpr QuanserModules<2> q2d_modules{{
    {.node = 1, .motor_counts_per_turn = 4096, .gear_ratio = 100, .load_counts_per_turn = 65536},
    {.node = 2, .motor_counts_per_turn = 4096, .gear_ratio = 80, .load_counts_per_turn = 65536},
}};

/// The Quanser arm on a CAN bus: what was tuned on Q2dSim runs here.
///
///     Loop<Q2dCan, PidPlusGravity> loop;                      // on can0
///     Loop<Q2dCan, PidPlusGravity> loop(Q2dCan("vcan0"));
class Q2dCan : public CanHardware<Q2d, QuanserCodec<Q2d>, SocketCan> {
 public:
  /// @param interface  the CAN interface
  /// @param modules    the arm's joint modules
  /// @param options    how patient the driver is
  /// @throws std::invalid_argument if modules, options or the interface's name make no sense
  /// @throws std::runtime_error if the interface does not exist
  explicit Q2dCan(const std::string& interface = "can0",
                  const QuanserModules<2>& modules = q2d_modules,
                  const CanHardwareOptions& options = {})
      : CanHardware(QuanserCodec<Q2d>(modules), SocketCan(interface), options) {}
};

}  // namespace articula
