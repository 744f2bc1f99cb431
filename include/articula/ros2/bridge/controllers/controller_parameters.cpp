// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/bridge/controllers/controller_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace articula::ros2 {

namespace {

std::string number_text(double value) { return articula::detail::message_of({value}); }

/// A name with another end, if it has a certain one.
std::string with_end(std::string name, std::string_view end, std::string_view other) {
  if (name.ends_with(end)) name.replace(name.size() - end.size(), end.size(), other);
  return name;
}
// The gain that ROS calls otherwise.
constexpr std::string_view own_end = ".velocity_feedforward", ros_end = ".ff_velocity_scale";
std::string ros_gain(std::string name) { return with_end(std::move(name), own_end, ros_end); }
std::string own_gain(std::string name) { return with_end(std::move(name), ros_end, own_end); }

}  // namespace

double ControllerParameters::Constraint::value() const {
  double largest = 0;
  for (const double* const own : values) largest = std::max(largest, *own);
  return largest;
}

ControllerParameters::ControllerParameters(BridgeCore& core, BridgedController& controller)
    : core_(core), controller_(controller) {
  const std::vector<std::string> states{"position", "velocity", "effort"};
  fixed_ = {read_only("command_interfaces", to_value(core.port.robot().commands),
                      "What is commanded of each joint."),
            read_only("joints", to_value(controller.joints), "The joints that are commanded."),
            read_only("state_interfaces", to_value(states), "What is measured of each joint."),
            core.update_rate(),
            read_only("use_sim_time", to_value(core.options.use_sim_time),
                      "Whether stamps have a simulator's time.")};
  if (controller.gripper) {
    fixed_.push_back(read_only("joint", to_value(controller.gripper->joint), "The joint."));
    fixed_.push_back(read_only("allow_stalling", to_value(controller.gripper->allow_stalling),
                               "Whether a stalled gripper has succeeded."));
  }
}

std::vector<NodeParameter> ControllerParameters::list() {
  std::vector<NodeParameter> all;
  const std::string prefix = controller_.name + ".";
  for (const remote::Parameter& own : core_.port.parameters()) {
    if (!own.name.starts_with(prefix)) continue;
    NodeParameter parameter{.value = to_value(own.value)};
    auto& descriptor = parameter.descriptor;
    descriptor.name = controller_.gain_prefix + ros_gain(own.name.substr(prefix.size()));
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
  for (const Constraint& own : constraints()) {
    NodeParameter parameter{.value = to_value(own.value())};
    parameter.descriptor.name = own.name;
    parameter.descriptor.type = parameter.value.type;
    parameter.descriptor.description = own.description;
    parameter.descriptor.additional_constraints = "a finite number >= 0";
    all.push_back(std::move(parameter));
  }
  all.insert(all.end(), fixed_.begin(), fixed_.end());
  return all;
}

std::vector<ControllerParameters::Constraint> ControllerParameters::constraints() {
  TrajectoryConstraints& own = controller_.constraints;
  Constraint velocity{"constraints.stopped_velocity_tolerance",
                      {},
                      "Velocity of all joints at the end [rad/s or m/s]. 0: not checked."};
  for (auto& joint : own.joints) velocity.values.push_back(&joint.stopped_velocity);
  std::vector<Constraint> all{{"constraints.goal_time",
                               {&own.goal_time},
                               "Time to arrive after the last point [s]. 0: not checked."},
                              std::move(velocity)};
  if (controller_.gripper) {
    GripperOptions& gripper = *controller_.gripper;
    all.push_back(
        {"goal_tolerance", {&gripper.goal_tolerance}, "Distance from the goal [rad or m]."});
    all.push_back({"stall_velocity_threshold",
                   {&gripper.stall_velocity_threshold},
                   "The joint moves above it [rad/s or m/s]."});
    all.push_back({"stall_timeout",
                   {&gripper.stall_timeout},
                   "Time without motion after which the joint is stalled [s]."});
  }
  for (std::size_t j = 0; j < own.joints.size(); ++j) {
    const std::string prefix = "constraints." + controller_.joints[j];
    all.push_back({prefix + ".trajectory",
                   {&own.joints[j].trajectory},
                   "Distance from the trajectory [rad or m]. 0: not checked."});
    all.push_back({prefix + ".goal",
                   {&own.joints[j].goal},
                   "Distance at the end [rad or m]. 0: not checked."});
  }
  return all;
}

void ControllerParameters::set(const NamedValues& values, OnSet on_asker) {
  const auto on_set = [this, on_asker = std::move(on_asker)](const std::string& refusal) {
    if (!refusal.empty()) core_.log.write(RosLog::Line::warn, controller_.node, refusal);
    on_asker(refusal);
  };
  const auto all = constraints();
  remote::SetParameters request;
  std::vector<std::pair<Constraint, double>> changes;
  for (const auto& own : values) {
    const double value = own.value.double_value;
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const auto& other) { return other.name == own.name; });
    if (found == all.end()) {
      request.values.push_back(
          {controller_.name + "." + own_gain(own.name.substr(controller_.gain_prefix.size())),
           value});
    } else if (std::isfinite(value) && value >= 0) {
      changes.emplace_back(*found, value);
    } else {
      return on_set("parameter '" + own.name + "': " + number_text(value) +
                    " is not a finite number >= 0");
    }
  }
  const auto apply = [changes] {
    for (const auto& [constraint, value] : changes) {
      for (double* const own : constraint.values) *own = value;
    }
  };
  if (request.values.empty()) {
    const std::string refusal = core_.loop_operator.session().take_controls();
    if (refusal.empty()) apply();
    return on_set(refusal);
  }
  core_.loop_operator.ask(request, [on_set, apply](const remote::Answer& answer) {
    if (answer.verdict == remote::Verdict::done) {
      apply();
      return on_set({});
    }
    on_set(answer.text.empty() ? "refused" : answer.text);
  });
}

}  // namespace articula::ros2
