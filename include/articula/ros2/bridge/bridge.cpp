// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/bridge/bridge.hpp"

#include "articula/ros2/bridge/bridge_core.hpp"
#include "articula/ros2/bridge/manager_services.hpp"
#include "articula/ros2/bridge/robot_topics.hpp"

namespace articula::ros2 {

struct Bridge::Parts {
  Parts(remote::Port& port, Transport& transport, const BridgeOptions& options)
      : core(port, transport, options), robot(core), manager(make_manager_services(core)) {}

  void log_events() {
    while (const auto event = core.loop_operator.session().event()) {
      using Level = remote::Event::Level;
      using Line = RosLog::Line;
      core.log.write(event->level == Level::error     ? Line::error
                     : event->level == Level::warning ? Line::warn
                                                      : Line::info,
                     "loop", event->text);
    }
  }

  BridgeCore core;
  RobotTopics robot;
  std::unique_ptr<ManagerServices> manager;
};

Bridge::Bridge(remote::Port& port, Transport& transport, const BridgeOptions& options)
    : parts_(std::make_unique<Parts>(port, transport, options)) {}
Bridge::~Bridge() = default;

void Bridge::update(std::chrono::nanoseconds now) {
  auto& [core, robot, manager] = *parts_;
  core.loop_operator.update(now);
  core.watch.update(now, core.options.use_sim_time);
  core.context.now = core.options.use_sim_time ? to_duration(core.watch.cycle.time) : now;
  parts_->log_events();
  robot.update();
  manager->update();
}

DroppedMessages Bridge::dropped() const { return parts_->core.context.dropped; }

}  // namespace articula::ros2
