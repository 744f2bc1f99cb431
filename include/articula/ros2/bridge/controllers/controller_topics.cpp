// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/bridge/controllers/controller_topics.hpp"

#include "articula/ros2/bridge/controllers/trajectory_check.hpp"
#include "articula/ros2/node/service.hpp"
#include "articula/ros2/node/subscription.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace articula::ros2 {

namespace {

using Values = std::vector<double>;

/// The same point in the layout of a distribution.
template <class Layout>
trajectory_msgs::msg::JointTrajectoryPoint<Layout> convert(const TrajectoryPointMessage& from) {
  return {from.positions, from.velocities, from.accelerations, from.effort, from.time_from_start};
}

/// The state of a follower of trajectories.
template <class Layout>
control_msgs::msg::JointTrajectoryControllerState<Layout> state_of(
    const std_msgs::msg::Header<Jazzy>& header, const std::vector<std::string>& joints,
    const CyclePoints& points, double speed) {
  control_msgs::msg::JointTrajectoryControllerState<Layout> state;
  state.header = {header.stamp, header.frame_id};
  state.joint_names = joints;
  state.reference = convert<Layout>(points.reference);
  state.feedback = convert<Layout>(points.measured);
  state.error = convert<Layout>(points.error);
  state.output = convert<Layout>(points.output);
  if constexpr (Layout::distribution == Distribution::humble) {
    state.desired = state.reference;
    state.actual = state.feedback;
  } else {
    state.speed_scaling_factor = speed;
  }
  return state;
}

std::vector<remote::JointValue> named(const std::vector<std::string>& joints,
                                      const Values& values) {
  std::vector<remote::JointValue> all;
  for (std::size_t k = 0; k < values.size(); ++k) all.push_back({joints[k], values[k]});
  return all;
}

}  // namespace

ControllerTopics::ControllerTopics(BridgeCore& core, const Node& node,
                                   const BridgedController& controller)
    : core_(core),
      controller_(controller),
      state_due_(core.options.controller_state_rate),
      moving_since_(controller.joints.size()) {
  // The factor is the loop's, so all of its controllers show and set the same one.
  if (core.options.distribution == Distribution::humble) {
    humble_state_.emplace(node, "~/controller_state", quality_of_service::states);
    humble_old_state_.emplace(node, "~/state", quality_of_service::states);
  } else {
    state_.emplace(node, "~/controller_state", quality_of_service::states);
  }
  const auto in = quality_of_service::states;
  const auto taken = [this](const auto& message) { take(message); };
  subscribe<std_msgs::msg::Float64MultiArray<Jazzy>>(node, "~/commands", in, taken);
  for (const std::string& joint : controller.joints) {
    subscribe<std_msgs::msg::Float64>(node, "~/" + ros_name(joint) + "/command", in,
                                      [this, joint](const auto& message) { take(joint, message); });
  }
  subscribe<TrajectoryPointMessage>(node, "~/reference", in, taken);
  subscribe<TrajectoryMessage>(node, "~/joint_trajectory", in, taken);
  if (core.options.distribution != Distribution::humble) {
    subscribe<control_msgs::msg::SpeedScalingFactor>(node, "~/speed_scaling_input",
                                                     quality_of_service::speed_scaling, taken);
  }
  serve<control_msgs::srv::QueryTrajectoryState<Jazzy>>(
      node, "~/query_state",
      [this](const auto& request, const auto& reply) { reply.send(query(request.time)); });
}

void ControllerTopics::update() {
  stop_old_motions();
  if (!core_.watch.is_active(controller_.name)) return;
  if (!core_.watch.has_new_cycle(published_cycle_) || !state_due_.due(core_.context.now)) return;
  published_cycle_ = core_.watch.cycle.number;
  const CyclePoints points = points_of(core_.watch.cycle, controller_.indices, core_.port.robot());
  if (humble_state_) {
    const HumbleState state = state_of<Humble>(core_.header(), controller_.joints, points, 1);
    humble_state_->publish(state);
    humble_old_state_->publish(state);
  } else {
    state_->publish(state_of<Jazzy>(core_.header(), controller_.joints, points,
                                    core_.watch.situation.trajectory_speed));
  }
}

void ControllerTopics::take(const std_msgs::msg::Float64MultiArray<Jazzy>& message) {
  if (!is_active("commands")) return;
  if (message.data.size() != controller_.joints.size()) {
    return refuse("commands: " + std::to_string(message.data.size()) + " numbers for " +
                  std::to_string(controller_.joints.size()) + " joints");
  }
  set(named(controller_.joints, message.data));
}

void ControllerTopics::take(const std::string& joint, const std_msgs::msg::Float64& message) {
  if (is_active("command")) set({{joint, message.data}});
}

void ControllerTopics::take(const TrajectoryPointMessage& message) {
  if (!is_active("reference")) return;
  for (const Values* values : {&message.positions, &message.velocities, &message.effort}) {
    if (values->empty() || values->size() == controller_.joints.size()) continue;
    return refuse("reference: " + std::to_string(values->size()) + " numbers for " +
                  std::to_string(controller_.joints.size()) + " joints");
  }
  set({.positions = named(controller_.joints, message.positions),
       .velocities = named(controller_.joints, message.velocities),
       .efforts = named(controller_.joints, message.effort)});
}

void ControllerTopics::take(const TrajectoryMessage& message) {
  if (!is_active("joint_trajectory")) return;
  const std::string reason = refusal_of_motion(core_.watch, controller_, message.joint_names);
  if (!reason.empty()) return refuse(reason);
  remote::PlayTrajectory request = to_request(message, core_.context.now, core_.watch.speed());
  controller_.constraints.complete(request, controller_.joints);
  ask(request);
}

void ControllerTopics::take(const control_msgs::msg::SpeedScalingFactor& message) {
  ask(remote::SetTrajectorySpeed{message.factor});
}

void ControllerTopics::set(std::vector<remote::JointValue> values) {
  const bool is_velocity = controller_.quantity == "velocity";
  remote::SetReference reference;
  auto& column = is_velocity                          ? reference.velocities
                 : controller_.quantity == "position" ? reference.positions
                                                      : reference.efforts;
  column = std::move(values);
  set(reference);
}

void ControllerTopics::set(const remote::SetReference& reference) {
  const std::chrono::nanoseconds asked = core_.context.now;
  core_.loop_operator.ask(reference, [this, reference, asked](const remote::Answer& answer) {
    if (answer.verdict != remote::Verdict::done) return refuse(answer.text);
    if (!answer.text.empty()) core_.log.write(RosLog::Line::warn, controller_.node, answer.text);
    for (std::size_t k = 0; k < controller_.joints.size(); ++k) {
      const auto names_it = [&](const auto& own) { return own.joint == controller_.joints[k]; };
      const bool is_named = std::ranges::any_of(reference.positions, names_it) ||
                            std::ranges::any_of(reference.efforts, names_it);
      const auto velocity = std::ranges::find_if(reference.velocities, names_it);
      const bool has_velocity = velocity != reference.velocities.end();
      if (is_named || has_velocity) moving_since_[k].reset();
      if (has_velocity && velocity->value != 0) moving_since_[k] = asked;
    }
  });
}

void ControllerTopics::stop_old_motions() {
  remote::Stop stop;
  for (std::size_t k = 0; k < controller_.joints.size(); ++k) {
    auto& since = moving_since_[k];
    if (!since) continue;
    since = std::min(*since, core_.context.now);
    if (core_.context.now - *since <= to_duration(core_.options.controls_time)) continue;
    since.reset();
    // Otherwise somebody has asked for another motion since.
    if (core_.watch.motion_of(controller_.indices[k]) != "set") continue;
    stop.joints.push_back(controller_.joints[k]);
  }
  if (stop.joints.empty()) return;
  refuse("no reference has followed one with a velocity: the joints stop");
  ask(stop);
}

void ControllerTopics::ask(const remote::Request& request) {
  core_.loop_operator.ask(request, [this](const remote::Answer& answer) {
    if (answer.verdict != remote::Verdict::done) refuse(answer.text);
  });
}

void ControllerTopics::refuse(const std::string& reason) {
  core_.log.refuse(controller_.node, reason);
}

bool ControllerTopics::is_active(const char* topic) {
  const bool active = core_.watch.is_active(controller_.name);
  if (!active) refuse(std::string(topic) + ": controller '" + controller_.name + "' is not active");
  return active;
}

control_msgs::srv::QueryTrajectoryState<Jazzy>::Response ControllerTopics::query(
    const builtin_interfaces::msg::Time& time) const {
  control_msgs::srv::QueryTrajectoryState<Jazzy>::Response response;
  const auto& all = core_.watch.references;
  const auto wanted = from_message(time);
  if (!core_.watch.is_active(controller_.name)) {
    response.message = "controller '" + controller_.name + "' is not active";
    return response;
  }
  if (all.empty() || wanted < all.front().time) {
    response.message = "the references of that time are not known any more";
    return response;
  }
  const auto motions_of = [](const PastReference& past) {
    std::vector<std::optional<JointMotion>> motions;
    for (std::size_t j = 0; j < past.position.size(); ++j) {
      motions.push_back(JointMotion{past.position[j], past.velocity[j], past.acceleration[j]});
    }
    return motions;
  };
  const auto later =
      std::find_if(all.begin(), all.end(), [&](const auto& own) { return own.time > wanted; });
  auto motions = motions_of(*std::prev(later));
  if (wanted > all.back().time) {
    auto planned = core_.port.planned(core_.watch.loop_time(wanted));
    // A client's present is a little after the last cycle that is known here.
    const bool is_present =
        wanted <= all.back().time + core_.watch.present(core_.port.robot().period);
    for (std::size_t j = 0; j < motions.size() && j < planned.size(); ++j) {
      if (planned[j] || !is_present) motions[j] = planned[j];
    }
  }
  const auto is_unknown = [&](std::size_t j) { return !motions[j]; };
  const auto unknown = std::ranges::find_if(controller_.indices, is_unknown);
  if (unknown != controller_.indices.end()) {
    const auto place = static_cast<std::size_t>(unknown - controller_.indices.begin());
    response.message = "joint " + controller_.joints[place] +
                       " does not rest, and its motion is none of a trajectory that has begun";
    return response;
  }
  response.success = true;
  response.name = controller_.joints;
  for (const std::size_t j : controller_.indices) {
    response.position.push_back(motions[j]->position);
    response.velocity.push_back(motions[j]->velocity);
    response.acceleration.push_back(motions[j]->acceleration);
  }
  return response;
}

}  // namespace articula::ros2
