// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/bridge/robot_topics.hpp"

#include <Eigen/Geometry>

#include <utility>

namespace articula::ros2 {

namespace {

geometry_msgs::msg::Transform relative(const remote::LinkPose& parent,
                                       const remote::LinkPose& link) {
  const auto turn = [](const remote::LinkPose& pose) {
    const auto& [x, y, z, w] = pose.rotation;
    return Eigen::Quaterniond(w, x, y, z);
  };
  const auto place = [](const remote::LinkPose& pose) {
    return Eigen::Vector3d(pose.translation[0], pose.translation[1], pose.translation[2]);
  };
  const Eigen::Quaterniond back = turn(parent).conjugate();
  const Eigen::Vector3d translation = back * (place(link) - place(parent));
  const Eigen::Quaterniond rotation = (back * turn(link)).normalized();
  return {.translation = {translation.x(), translation.y(), translation.z()},
          .rotation = {rotation.x(), rotation.y(), rotation.z(), rotation.w()}};
}

}  // namespace

RobotTopics::RobotTopics(BridgeCore& core)
    : core_(core),
      broadcaster_(core.context, BridgeCore::broadcaster, core.options.name_space),
      state_publisher_(core.context, "robot_state_publisher", core.options.name_space),
      joint_states_(broadcaster_, "joint_states", quality_of_service::states),
      dynamic_joint_states_(broadcaster_, "dynamic_joint_states", quality_of_service::states),
      tf_(state_publisher_, "/tf", quality_of_service::tf),
      tf_static_(state_publisher_, "/tf_static", quality_of_service::tf_static),
      description_(state_publisher_, "robot_description", quality_of_service::robot_description),
      states_due_(core.options.state_rate) {
  if (core.options.use_sim_time && core.options.clock_topic.empty()) {
    clock_.emplace(core.manager, "/clock", quality_of_service::clock);
  }
  const remote::RobotSheet& robot = core.port.robot();
  for (const remote::SheetJoint& joint : robot.joints) joints_.name.push_back(joint.name);
  for (const remote::SheetMimic& mimic : robot.mimics) joints_.name.push_back(mimic.name);
  dynamic_.joint_names = joints_.name;
  dynamic_.interface_values.assign(
      joints_.name.size(),
      {.interface_names = {"position", "velocity", "effort"}, .values = {0, 0, 0}});
  description_.publish({.data = robot.urdf});
}

void RobotTopics::update() {
  if (!core_.watch.has_new_cycle(published_cycle_) || !states_due_.due(core_.context.now)) return;
  published_cycle_ = core_.watch.cycle.number;
  if (clock_) clock_->publish({to_message<builtin_interfaces::msg::Time>(core_.context.now)});
  if (core_.broadcasts) publish_joints();
  publish_frames();
}

void RobotTopics::publish_joints() {
  const remote::Cycle& cycle = core_.watch.cycle;
  joints_.header = core_.header();
  joints_.position = cycle.position;
  joints_.velocity = cycle.velocity;
  joints_.effort = cycle.effort;
  for (const remote::SheetMimic& mimic : core_.port.robot().mimics) {
    const auto joint = static_cast<std::size_t>(mimic.joint);
    joints_.position.push_back(mimic.multiplier * cycle.position[joint] + mimic.offset);
    joints_.velocity.push_back(mimic.multiplier * cycle.velocity[joint]);
    joints_.effort.push_back(0);
  }
  dynamic_.header = joints_.header;
  for (std::size_t j = 0; j < joints_.name.size(); ++j) {
    dynamic_.interface_values[j].values = {joints_.position[j], joints_.velocity[j],
                                           joints_.effort[j]};
  }
  joint_states_.publish(joints_);
  dynamic_joint_states_.publish(dynamic_);
}

void RobotTopics::publish_frames() {
  const remote::RobotSheet& robot = core_.port.robot();
  const auto poses = core_.port.link_poses(core_.watch.cycle.position);
  const std::string& prefix = core_.options.frame_prefix;
  const auto frame = [&](std::size_t link) {
    const auto parent = static_cast<std::size_t>(robot.parents[link].link);
    return geometry_msgs::msg::TransformStamped<Jazzy>{
        .header = core_.header(prefix + robot.links[parent]),
        .child_frame_id = prefix + robot.links[link],
        .transform = relative(poses[parent], poses[link])};
  };
  frames_.transforms.clear();
  tf2_msgs::msg::TFMessage<Jazzy> fixed;
  for (std::size_t link = 0; link < robot.parents.size(); ++link) {
    if (robot.parents[link].link < 0) continue;
    if (!robot.parents[link].is_fixed) {
      frames_.transforms.push_back(frame(link));
    } else if (!static_published_) {
      fixed.transforms.push_back(frame(link));
    }
  }
  if (!static_published_) tf_static_.publish(fixed);
  static_published_ = true;
  tf_.publish(frames_);
}

}  // namespace articula::ros2
