// SPDX-License-Identifier: Apache-2.0
/// @file The core that the parts of a Bridge share.
#pragma once

#include "articula/ros2/bridge/core/bridge_options.hpp"
#include "articula/ros2/bridge/core/bridged_controller.hpp"
#include "articula/ros2/bridge/core/loop_operator.hpp"
#include "articula/ros2/bridge/core/loop_watch.hpp"
#include "articula/ros2/bridge/core/ros_log.hpp"
#include "articula/ros2/messages/std_msgs.hpp"
#include "articula/ros2/node/node.hpp"
#include "articula/ros2/node/parameter_server.hpp"
#include "articula/ros2/node/ros_time.hpp"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace articula::ros2 {

/// What the parts of a Bridge share: port, session, time, log. It stays where it is.
struct BridgeCore {
  /// @throws std::invalid_argument if an option makes no sense
  BridgeCore(remote::Port& own_port, Transport& transport, const BridgeOptions& own_options)
      : port(own_port),
        options((validate(own_options), own_options)),
        context(transport, own_options.distribution),
        manager(context, "controller_manager", own_options.name_space),
        log(manager),
        loop_operator(own_port, own_options.operates, to_duration(own_options.controls_time)),
        watch(own_port, loop_operator.session()),
        controllers(bridged_controllers(own_port, own_options)) {}

  /// The present time for the header of a message.
  [[nodiscard]] std_msgs::msg::Header<Jazzy> header(std::string frame = {}) const {
    return {.stamp = to_message<builtin_interfaces::msg::Time>(context.now),
            .frame_id = std::move(frame)};
  }

  /// Stops joints, and logs if the loop does not.
  /// @param node  in whose name
  void stop(const std::string& node, std::vector<std::string> joints) {
    loop_operator.ask(remote::Stop{std::move(joints)}, [this, node](const remote::Answer& answer) {
      if (answer.verdict != remote::Verdict::done) log.refuse(node, "stop: " + answer.text);
    });
  }

  /// The read-only parameter update_rate.
  [[nodiscard]] NodeParameter update_rate() const {
    return read_only("update_rate",
                     to_value(static_cast<std::int64_t>(std::lround(1 / port.robot().period))),
                     "Cycles of the loop in a second.");
  }

  static constexpr const char* broadcaster = "joint_state_broadcaster";
  static constexpr const char* broadcaster_type = "joint_state_broadcaster/JointStateBroadcaster";

  remote::Port& port;
  BridgeOptions options;
  Context context;
  Node manager;
  RosLog log;
  LoopOperator loop_operator;
  LoopWatch watch;
  std::vector<BridgedController> controllers;
  bool broadcasts = true;  ///< joint states are published
};

}  // namespace articula::ros2
