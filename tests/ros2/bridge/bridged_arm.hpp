// SPDX-License-Identifier: Apache-2.0
/// @file A simulated Q2D with a bridge to ROS 2, and clients that call it.
#pragma once

#include "articula/remote/port.hpp"
#include "articula/ros2/bridge/bridge_nodes.hpp"
#include "articula/ros2/messages/rcl_interfaces.hpp"

#include "catch.hpp"
#include "remote/memory_transport.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>

namespace support {

inline const std::string shoulder_joint = "shoulder_active_joint",
                         elbow_joint = "elbow_active_joint";

/// A running loop without its type, which takes the compiler long.
class AnyLoop {
 public:
  virtual ~AnyLoop() = default;
  virtual articula::remote::Port& port() = 0;
  virtual void cycles(int count) = 0;
};

/// A supervised Q2D with the controllers pid_plus_gravity and computed_torque.
std::unique_ptr<AnyLoop> switched_arm();
/// A supervised Q2D with the controllers upper/pid_plus_gravity of the shoulder, and
/// lower/pid_plus_gravity of the elbow.
std::unique_ptr<AnyLoop> grouped_arm();
/// A Q2D with the controller pid_plus_gravity, without supervision. Its trajectories have
/// tolerances: 0.5 rad on the way, 0.1 rad, 0.2 rad/s and 3 s at the end.
std::unique_ptr<AnyLoop> plain_arm();
/// A Q2D whose one controller passes efforts on.
std::unique_ptr<AnyLoop> bypass_arm();

/// The loop, its bridge, and a clock that a test moves.
class BridgedArm {
 public:
  explicit BridgedArm(const articula::ros2::BridgeOptions& options = {},
                      std::unique_ptr<AnyLoop> own_loop = switched_arm())
      : loop(std::move(own_loop)), bridge(loop->port(), transport, options) {
    run(2);
  }

  /// Lets milliseconds pass.
  void run(int milliseconds) {
    for (int k = 0; k < milliseconds; ++k) {
      loop->cycles(1);
      now += std::chrono::milliseconds(1);
      bridge.update(now);
    }
  }
  /// Asks the loop as another client would.
  articula::remote::Answer ask(const articula::remote::Request& request) {
    const auto session = loop->port().connect("another client", true);
    const auto number = session->ask(request);
    for (int k = 0; k < 50; ++k) {
      run(1);
      if (const auto answer = session->answer()) {
        session->release_controls();
        return *answer;
      }
    }
    FAIL("no answer");
    return {number, articula::remote::Verdict::timed_out, {}};
  }

  /// Sends a request, and waits for the reply.
  template <class Service>
  typename Service::Response call(const std::string& name,
                                  const typename Service::Request& request = {}) {
    return reply_to<Service>(transport.request(name, bytes_of(request)));
  }
  /// Waits for a reply.
  template <class Service>
  typename Service::Response reply_to(const std::shared_ptr<Bytes>& reply, int milliseconds = 200) {
    for (int k = 0; k < milliseconds && reply->empty(); ++k) run(1);
    typename Service::Response response{};
    REQUIRE(!reply->empty());
    REQUIRE(articula::ros2::decode(*reply, response) == articula::ros2::CdrError::none);
    return response;
  }
  template <articula::ros2::Message M>
  void publish(const std::string& topic, const M& message) {
    transport.publish(topic, bytes_of(message));
  }
  bool logged(const std::string& words) { return count_logged(words) > 0; }
  /// How many lines of the log have some words.
  std::ptrdiff_t count_logged(const std::string& words) {
    return std::ranges::count_if(transport.topics["/rosout"].sent, [&](const auto& bytes) {
      articula::ros2::rcl_interfaces::msg::Log<articula::ros2::Jazzy> line;
      return articula::ros2::decode(bytes, line) == articula::ros2::CdrError::none &&
             line.msg.find(words) != std::string::npos;
    });
  }

  MemoryTransport transport{};
  std::unique_ptr<AnyLoop> loop;
  articula::ros2::BridgeNodes bridge;
  std::chrono::nanoseconds now{1'700'000'000'000'000'000};
};

}  // namespace support
