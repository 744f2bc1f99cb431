// SPDX-License-Identifier: Apache-2.0
/// @file A running loop as ROS 2's tools see and steer it.
#pragma once

#include "articula/ros2/bridge/core/bridge_options.hpp"
#include "articula/ros2/node/context.hpp"

#include <memory>
#include <string>

namespace articula::remote {
class Port;
}  // namespace articula::remote

namespace articula::ros2 {

class Transport;

/// Offers a running loop to ROS 2, as a controller_manager with its controllers does, from a thread
/// of its own until it is destroyed:
///
///     SupervisedLoop<Q2dSim, PidPlusGravity> arm;
///     Remote remote(arm);
///     ros2::Bridge bridge(remote, {.distribution = ros2::Distribution::jazzy});
///     remote.run(clock);
///
/// The loop does nothing for ROS but what a Remote costs. The thread wakes up when something comes,
/// and each 2 ms. Programs with a thread of their own use BridgeNodes. Real-time: no.
class Bridge {
 public:
  /// Over Fast DDS. By default it keeps to the loopback interface; see FastDdsOptions.
  /// @param port  outlives this
  /// @throws std::invalid_argument if an option makes no sense
  /// @throws std::runtime_error if Fast DDS cannot make a participant
  explicit Bridge(remote::Port& port, const BridgeOptions& options = {});
  /// Over another transport.
  /// @param port       outlives this
  /// @param transport  not null
  /// @throws std::invalid_argument if an option makes no sense; what the transport throws if it
  ///         cannot offer a topic or service
  Bridge(remote::Port& port, std::unique_ptr<Transport> transport, const BridgeOptions& options);
  /// Ends the thread, then the transport.
  ~Bridge();

  /// Messages that were not taken so far.
  [[nodiscard]] DroppedMessages dropped() const;
  /// The last message or request that failed, such as a reply that is too large; else empty. The
  /// others go on.
  [[nodiscard]] std::string error() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace articula::ros2
