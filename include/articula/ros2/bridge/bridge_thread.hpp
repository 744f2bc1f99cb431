// SPDX-License-Identifier: Apache-2.0
/// @file A bridge to ROS 2 with a thread of its own.
#pragma once

#include "articula/ros2/bridge/bridge_options.hpp"
#include "articula/ros2/node/context.hpp"

#include <memory>
#include <string>

namespace articula::remote {
class Port;
}  // namespace articula::remote

namespace articula::ros2 {

/// Runs a Bridge and its transport in a thread of its own until it is destroyed:
///
///     Remote remote(arm);
///     ros2::BridgeThread bridge(remote, std::make_unique<ros2::FastDdsTransport>());
///     remote.run(clock);
///
/// The thread wakes up when something comes, and each 2 ms. Real-time: no (its own thread).
class BridgeThread {
 public:
  /// @param port       outlives this
  /// @param transport  not null
  /// @throws std::invalid_argument if an option makes no sense; what the transport throws if it
  ///         cannot offer a topic or service
  BridgeThread(remote::Port& port, std::unique_ptr<Transport> transport,
               const BridgeOptions& options = {});
  /// Ends the thread, then the transport.
  ~BridgeThread();

  /// Messages that were not taken so far.
  [[nodiscard]] DroppedMessages dropped() const;
  /// Why the thread has ended, if the transport or a lack of memory ended it; else empty.
  [[nodiscard]] std::string error() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace articula::ros2
