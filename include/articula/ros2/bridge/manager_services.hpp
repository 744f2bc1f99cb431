// SPDX-License-Identifier: Apache-2.0
/// @file The services of a controller_manager.
#pragma once

#include "articula/ros2/bridge/core/bridge_core.hpp"

#include <memory>

namespace articula::ros2 {

/// The services and topics of a controller_manager: what `ros2 control`, rqt and MoveIt call.
///
/// - Controllers are compiled into the loop. Loading and configuring a known one is done already;
///   unloading, cleaning up and reloading libraries are refused.
/// - Switching hands the request to the loop and replies with its answer.
/// - The hardware is one component, which is active while a supervised loop controls. A fault is
///   "unconfigured": "inactive" acknowledges it, "active" also activates.
class ManagerServices {
 public:
  virtual ~ManagerServices() = default;
  /// Publishes the activity if it has changed, and diagnostics once a second.
  virtual void update() = 0;
};

/// The services in the layout of a distribution.
/// @param core  outlives them
/// Real-time: no (allocates).
[[nodiscard]] std::unique_ptr<ManagerServices> make_manager_services(BridgeCore& core);

}  // namespace articula::ros2
