// SPDX-License-Identifier: Apache-2.0
/// @file A running loop as ROS 2's tools expect a controller_manager.
#pragma once

#include "articula/ros2/bridge/core/bridge_options.hpp"
#include "articula/ros2/node/context.hpp"

#include <chrono>
#include <memory>

namespace articula::remote {
class Port;
}  // namespace articula::remote

namespace articula::ros2 {

/// Offers a running loop to ROS 2 as a controller_manager with its controllers does: joint states,
/// frames, services, parameters, trajectories. It has no thread:
///
///     BridgeNodes bridge(remote, transport);
///     while (running) {
///       transport.poll(std::chrono::milliseconds(5));
///       bridge.update(std::chrono::system_clock::now().time_since_epoch());
///     }
///
/// All requests pass the checks of the port and take its controls, as those of other clients. In
/// the thread that polls the transport. Real-time: no (allocates, locks).
class BridgeNodes {
 public:
  /// @param port       outlives the bridge
  /// @param transport  likewise
  /// @throws std::invalid_argument if an option makes no sense
  BridgeNodes(remote::Port& port, Transport& transport, const BridgeOptions& options = {});
  ~BridgeNodes();

  /// Delivers answers of the loop, and publishes what is due.
  /// @param now  since 1970-01-01
  void update(std::chrono::nanoseconds now);

  /// The messages that were not taken.
  [[nodiscard]] DroppedMessages dropped() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace articula::ros2
