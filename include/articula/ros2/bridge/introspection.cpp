// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/bridge/introspection.hpp"

#include <cstddef>
#include <utility>

namespace articula::ros2 {

namespace {

std::vector<std::string> interface_names(const remote::RobotSheet& robot) {
  std::vector<std::string> names;
  const auto add = [&](const char* kind, const std::string& quantity) {
    for (const auto& joint : robot.joints) names.push_back(kind + joint.name + "/" + quantity);
  };
  for (const char* const quantity : {"position", "velocity", "effort"}) {
    add("state_interface.", quantity);
  }
  for (const std::string& quantity : robot.commands) add("command_interface.", quantity);
  return names;
}

std::vector<std::string> statistics_names() {
  std::vector<std::string> names;
  for (const char* const figure :
       {"execution_time/current_value", "execution_time/median", "execution_time/percentile_99",
        "execution_time/max", "latency/current_value", "latency/median", "latency/percentile_99",
        "latency/max", "periodicity/current_value", "cycles", "overruns"}) {
    names.push_back(std::string("controller_manager.stats/") + figure);
  }
  return names;
}

}  // namespace

NumberTopics::NumberTopics(BridgeCore& core, const std::string& name,
                           std::vector<std::string> names)
    : core_(core),
      names_(std::move(names)),
      names_topic_(core.manager, name + "/names", quality_of_service::numbers),
      values_topic_(core.manager, name + "/values", quality_of_service::numbers),
      full_topic_(core.manager, name + "/full", quality_of_service::numbers) {}

void NumberTopics::publish_names() {
  names_topic_.publish({.header = core_.header(), .names = names_, .names_version = 1});
}

bool NumberTopics::has_readers() const {
  return values_topic_.readers() > 0 || full_topic_.readers() > 0;
}

void NumberTopics::publish(std::vector<double> values) {
  if (full_topic_.readers() > 0) {
    Statistics all{.header = core_.header()};
    for (std::size_t k = 0; k < names_.size(); ++k) {
      all.statistics.push_back({.name = names_[k], .value = values[k]});
    }
    full_topic_.publish(all);
  }
  if (values_topic_.readers() > 0) {
    values_topic_.publish(
        {.header = core_.header(), .values = std::move(values), .names_version = 1});
  }
}

Introspection::Introspection(BridgeCore& core)
    : core_(core),
      interfaces_(core, "~/introspection_data", interface_names(core.port.robot())),
      statistics_(core, "~/statistics", statistics_names()),
      due_(core.options.state_rate) {}

void Introspection::update() {
  if (!std::exchange(has_named_, true)) {
    interfaces_.publish_names();
    statistics_.publish_names();
  }
  if (!core_.watch.has_new_cycle(published_cycle_) || !due_.due(core_.context.now)) return;
  published_cycle_ = core_.watch.cycle.number;
  if (interfaces_.has_readers()) interfaces_.publish(interfaces());
  if (statistics_.has_readers()) statistics_.publish(statistics());
}

std::vector<double> Introspection::interfaces() const {
  const remote::Cycle& cycle = core_.watch.cycle;
  std::vector<double> values;
  const auto add = [&](const std::vector<double>& of_joints) {
    values.insert(values.end(), of_joints.begin(), of_joints.end());
  };
  add(cycle.position);
  add(cycle.velocity);
  add(cycle.effort);
  for (const std::vector<double>& command : cycle.command) add(command);
  return values;
}

std::vector<double> Introspection::statistics() const {
  const remote::Cycle& cycle = core_.watch.cycle;
  const remote::Statistics all = core_.port.statistics();
  return {1e6 * cycle.update,
          1e6 * all.execution_median,
          1e6 * all.execution_99,
          1e6 * all.execution_max,
          1e6 * cycle.latency,
          1e6 * all.latency_median,
          1e6 * all.latency_99,
          1e6 * all.latency_max,
          cycle.period > 0 ? 1 / cycle.period : 0,
          static_cast<double>(all.cycles),
          static_cast<double>(all.overruns)};
}

}  // namespace articula::ros2
