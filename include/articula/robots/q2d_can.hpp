// SPDX-License-Identifier: Apache-2.0
/// @file The Quanser arm on a CAN bus. CMake target: articula::socketcan.
#pragma once

#include "articula/hardware/can/can_hardware.hpp"
#include "articula/hardware/can/socketcan.hpp"
#include "articula/hardware/quanser/quanser_codec.hpp"
#include "articula/robots/q2d.hpp"
#include "articula/robots/q2d_modules.hpp"

#include <string>

namespace articula {

/// The Quanser arm on a CAN bus. It accepts the controllers that run on Q2dSim.
///
///     Loop<Q2dCan, PidPlusGravity> loop;                      // on can0
///     Loop<Q2dCan, PidPlusGravity> loop(Q2dCan("vcan0"));
class Q2dCan : public CanHardware<Q2d, QuanserCodec<Q2d>, SocketCan> {
 public:
  /// @param interface  the CAN interface
  /// @param modules    the arm's joint modules
  /// @param options    time-outs of the driver
  /// @throws std::invalid_argument if modules, options or the interface's name are invalid
  /// @throws std::runtime_error if the interface does not exist
  explicit Q2dCan(const std::string& interface = "can0",
                  const QuanserModules<2>& modules = q2d_modules,
                  const CanHardwareOptions& options = {})
      : CanHardware(QuanserCodec<Q2d>(modules), SocketCan(interface), options) {}
};

}  // namespace articula
