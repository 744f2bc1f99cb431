// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/bridge/bridge_nodes.hpp"

#include "articula/ros2/bridge/controllers/controller_parameters.hpp"
#include "articula/ros2/bridge/controllers/controller_topics.hpp"
#include "articula/ros2/bridge/controllers/gripper_action.hpp"
#include "articula/ros2/bridge/controllers/trajectory_action.hpp"
#include "articula/ros2/bridge/core/bridge_core.hpp"
#include "articula/ros2/bridge/introspection.hpp"
#include "articula/ros2/bridge/manager_services.hpp"
#include "articula/ros2/bridge/robot_topics.hpp"
#include "articula/ros2/node/ros_time.hpp"
#include "articula/ros2/node/subscription.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace articula::ros2 {

struct BridgeNodes::Parts {
  /// A node whose parameters nobody can change.
  struct FixedNode {
    FixedNode(const Node& node, std::vector<NodeParameter> parameters)
        : store(std::move(parameters)), server(node, store) {}

    FixedParameters store;
    ParameterServer server;
  };

  /// A controller as a node.
  struct ControllerNode {
    ControllerNode(BridgeCore& core, BridgedController& controller)
        : node(core.context, controller.node, core.options.name_space),
          store(core, controller),
          parameters(node, store),
          topics(core, node, controller),
          action(controller.gripper ? make_gripper_action(core, node, controller)
                                    : make_trajectory_action(core, node, controller)) {}

    void update() {
      parameters.update();
      action->update();
      topics.update();
    }

    Node node;
    ControllerParameters store;
    ParameterServer parameters;
    ControllerTopics topics;
    std::unique_ptr<ControllerAction> action;
  };

  Parts(remote::Port& port, Transport& transport, const BridgeOptions& options)
      : core(port, transport, options), robot(core), manager(make_manager_services(core)) {
    if (options.distribution >= Distribution::jazzy) introspection.emplace(core);
    const auto sim_time = read_only("use_sim_time", to_value(options.use_sim_time),
                                    "Whether stamps have a simulator's time.");
    std::vector<NodeParameter> all{sim_time, core.update_rate(),
                                   type_of(BridgeCore::broadcaster, BridgeCore::broadcaster_type)};
    for (const BridgedController& own : core.controllers) {
      all.push_back(type_of(own.name, own.type));
    }
    fixed.push_back(std::make_unique<FixedNode>(core.manager, std::move(all)));
    fixed.push_back(
        std::make_unique<FixedNode>(robot.broadcaster(), std::vector<NodeParameter>{sim_time}));
    fixed.push_back(std::make_unique<FixedNode>(
        robot.state_publisher(),
        std::vector<NodeParameter>{sim_time,
                                   read_only("frame_prefix", to_value(options.frame_prefix),
                                             "What the names of frames begin with."),
                                   read_only("robot_description", to_value(port.robot().urdf),
                                             "The robot as a URDF document.")}));
    if (!options.clock_topic.empty()) {
      subscribe<rosgraph_msgs::msg::Clock>(
          core.manager, options.clock_topic, quality_of_service::sensor_data,
          [this](const auto& message) { simulator_time = from_message(message.clock); });
    }
    for (BridgedController& own : core.controllers) {
      controllers.push_back(std::make_unique<ControllerNode>(core, own));
    }
  }

  static NodeParameter type_of(const std::string& controller, std::string type) {
    return read_only(controller + ".type", to_value(std::move(type)), "Type of the controller.");
  }

  void log_events() {
    while (const auto event = core.loop_operator.session().event()) {
      using Level = remote::Event::Level;
      using Line = RosLog::Line;
      // What became of a request from ROS is told by the node that had it.
      const bool is_own = event->text.starts_with(std::string(LoopOperator::name) + ": ");
      if (is_own && event->level == Level::warning) continue;
      core.log.write(event->level == Level::error     ? Line::error
                     : event->level == Level::warning ? Line::warn
                                                      : Line::info,
                     "loop", event->text);
    }
  }

  void log_warnings() {
    for (const std::string& warning : core.context.transport().warnings()) {
      core.log.write(RosLog::Line::warn, "controller_manager", warning);
    }
  }

  BridgeCore core;
  std::chrono::nanoseconds simulator_time{0};  ///< by the topic of the options
  RobotTopics robot;
  std::unique_ptr<ManagerServices> manager;
  std::optional<Introspection> introspection{};  ///< not in Humble
  std::vector<std::unique_ptr<FixedNode>> fixed{};
  std::vector<std::unique_ptr<ControllerNode>> controllers{};
};

BridgeNodes::BridgeNodes(remote::Port& port, Transport& transport, const BridgeOptions& options)
    : parts_(std::make_unique<Parts>(port, transport, options)) {}
BridgeNodes::~BridgeNodes() = default;

void BridgeNodes::update(std::chrono::nanoseconds now) {
  BridgeCore& core = parts_->core;
  core.context.wall = now;
  const bool has_topic = !core.options.clock_topic.empty();
  const bool has_loops_time = core.options.use_sim_time && !has_topic;
  const std::chrono::nanoseconds clock = has_topic ? parts_->simulator_time : now;
  core.watch.update(clock, has_loops_time);
  core.context.now = has_loops_time ? to_duration(core.watch.cycle.time) : clock;
  core.loop_operator.update(now);
  parts_->log_events();
  parts_->log_warnings();
  parts_->robot.update();
  parts_->manager->update();
  if (parts_->introspection) parts_->introspection->update();
  for (const auto& controller : parts_->controllers) controller->update();
}

DroppedMessages BridgeNodes::dropped() const { return parts_->core.context.dropped; }

}  // namespace articula::ros2
