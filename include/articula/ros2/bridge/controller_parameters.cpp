// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/bridge/controller_parameters.hpp"

#include <cmath>
#include <cstdint>

namespace articula::ros2 {

namespace {

const std::string gains = "gains.";

std::string number_text(double value) { return articula::detail::message_of({value}); }

}  // namespace

ControllerParameters::ControllerParameters(BridgeCore& core, const BridgedController& controller)
    : core_(core), controller_(controller) {
  const std::vector<std::string> states{"position", "velocity", "effort"};
  fixed_ = {
      read_only("command_interfaces", to_value(core.port.robot().commands),
                "What is commanded of each joint."),
      read_only("joints", to_value(controller.joints), "The joints that are commanded."),
      read_only("state_interfaces", to_value(states), "What is measured of each joint."),
      read_only("update_rate",
                to_value(static_cast<std::int64_t>(std::lround(1 / core.port.robot().period))),
                "Cycles of the loop in a second."),
      read_only("use_sim_time", to_value(core.options.use_sim_time),
                "Whether stamps have the time of the loop.")};
}

std::vector<NodeParameter> ControllerParameters::list() {
  std::vector<NodeParameter> all;
  const std::string prefix = controller_.name + ".";
  for (const remote::Parameter& own : core_.port.parameters()) {
    if (!own.name.starts_with(prefix)) continue;
    NodeParameter parameter{.value = to_value(own.value)};
    auto& descriptor = parameter.descriptor;
    descriptor.name = gains + own.name.substr(prefix.size());
    descriptor.type = parameter.value.type;
    descriptor.description = own.description + " [" + own.unit + "]";
    if (std::isfinite(own.lowest) && std::isfinite(own.highest)) {
      descriptor.floating_point_range.push_back({own.lowest, own.highest, 0});
    } else {
      descriptor.additional_constraints =
          "within " + number_text(own.lowest) + " .. " + number_text(own.highest);
    }
    all.push_back(std::move(parameter));
  }
  all.insert(all.end(), fixed_.begin(), fixed_.end());
  return all;
}

void ControllerParameters::set(const NamedValues& values, OnSet on_set) {
  remote::SetParameters request;
  for (const auto& own : values) {
    request.values.push_back(
        {controller_.name + "." + own.name.substr(gains.size()), own.value.double_value});
  }
  core_.loop_operator.ask(request, [on_set = std::move(on_set)](const remote::Answer& answer) {
    const bool done = answer.verdict == remote::Verdict::done;
    on_set(done ? std::string() : answer.text.empty() ? "refused" : answer.text);
  });
}

}  // namespace articula::ros2
