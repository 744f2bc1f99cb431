// SPDX-License-Identifier: Apache-2.0
/// @file The context that all nodes of a program share: transport, distribution, time, counters.
#pragma once

#include "articula/ros2/layout.hpp"
#include "articula/ros2/messages/builtin_interfaces.hpp"
#include "articula/ros2/transport.hpp"

#include <chrono>
#include <cstdint>
#include <memory>

namespace articula::ros2 {

/// The messages that a program did not take, since the start.
struct DroppedMessages {
  std::uint64_t malformed = 0;  ///< no message of their type
  std::uint64_t refused = 0;    ///< messages that ask for something that cannot be done
};

/// Transport, distribution and time of the nodes of a program. It stays where it is. In the thread
/// that polls the transport. Functions that the transport calls later than its end do nothing.
class Context {
 public:
  Context(Transport& transport, Distribution distribution)
      : transport_(transport), distribution_(distribution) {}
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  [[nodiscard]] Transport& transport() const noexcept { return transport_; }
  [[nodiscard]] Distribution distribution() const noexcept { return distribution_; }
  /// Humble has no hashes of types.
  [[nodiscard]] bool has_hashes() const noexcept { return distribution_ != Distribution::humble; }

  /// The present time since 1970-01-01, or of a simulation.
  std::chrono::nanoseconds now{0};
  /// The present time since 1970-01-01, also with a simulation: for what a pause must not stop.
  std::chrono::nanoseconds wall{0};
  DroppedMessages dropped{};

  /// What callbacks of the transport check before they use the context.
  [[nodiscard]] std::weak_ptr<const bool> lifetime() const noexcept { return alive_; }

 private:
  Transport& transport_;
  Distribution distribution_;
  std::shared_ptr<const bool> alive_ = std::make_shared<const bool>(true);
};

}  // namespace articula::ros2
