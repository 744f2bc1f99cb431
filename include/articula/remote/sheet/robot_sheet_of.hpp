// SPDX-License-Identifier: Apache-2.0
/// @file The sheet of a robot, and the placements of its links, from its type.
#pragma once

#include "articula/command/command_parts.hpp"
#include "articula/dynamics/forward_kinematics.hpp"
#include "articula/reference/trajectory/trajectory_tolerances.hpp"
#include "articula/remote/engine/loop_traits.hpp"
#include "articula/remote/sheet/link_pose.hpp"
#include "articula/remote/sheet/link_tree.hpp"
#include "articula/remote/sheet/robot_sheet.hpp"
#include "articula/remote/sheet/urdf_text.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

namespace articula::remote {

/// The links of a robot in the order of its sheet: the root first.
template <Robot R>
[[nodiscard]] std::vector<std::size_t> sheet_links(const R& robot) {
  const auto& links = model_of(robot).links;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const bool root = links[i].carrier.empty();
    order.insert(root ? order.begin() : order.end(), i);
  }
  return order;
}

/// The sheet of a loop's robot.
/// @param loop        a ControlLoop or SupervisedControlLoop
/// @param urdf        the robot as a URDF document; if empty, urdf_text makes one
/// @param tolerances  of trajectories that bring none
template <class LoopType>
[[nodiscard]] RobotSheet robot_sheet_of(
    LoopType& loop, std::string urdf,
    const TrajectoryTolerances<LoopType::joint_count>& tolerances) {
  const auto& robot = loop.hardware().robot();
  const auto& model = model_of(robot);
  RobotSheet sheet{.name = std::string(model.name.view()),
                   .urdf = urdf.empty() ? urdf_text(robot) : std::move(urdf),
                   .period = loop.period(),
                   .goal_time = tolerances.goal_time,
                   .is_simulated = is_simulated<LoopType>};
  for (int j = 0; j < LoopType::joint_count; ++j) {
    const JointProperties& joint = model.joints[j];
    sheet.joints.push_back({.name = std::string(joint.name.view()),
                            .type = joint.type,
                            .limits = joint.limits,
                            .path_tolerance = tolerances.path_position[j],
                            .goal_tolerance = tolerances.goal_position[j],
                            .stopped_velocity = tolerances.stopped_velocity[j]});
  }
  using AnyModel = std::remove_cvref_t<decltype(model)>;
  if constexpr (AnyModel::body_count > AnyModel::joint_count) {
    for (int b = 0; b < AnyModel::body_count; ++b) {
      const Coupling& coupling = model.mechanism.couplings[b];
      if (model.moving_joints[b] == model.joints[coupling.joint].name) continue;
      sheet.mimics.push_back({std::string(model.moving_joints[b].view()), coupling.joint,
                              coupling.multiplier, coupling.offset});
    }
  }
  const auto order = sheet_links(robot);
  const std::vector<TreeLink> tree = link_tree(robot);
  for (const std::size_t i : order) {
    sheet.links.emplace_back(model.links[i].name.view());
    const auto parent = std::find(order.begin(), order.end(),
                                  static_cast<std::size_t>(tree[i].parent));  // not there: the root
    const int place = parent == order.end() ? -1 : static_cast<int>(parent - order.begin());
    sheet.parents.push_back({place, tree[i].moving_body < 0});
  }
  const typename LoopType::Command command{};
  for (const auto& part : parts_of(command)) {
    sheet.commands.emplace_back(to_string(part.quantity));
  }
  return sheet;
}

/// The placements of all links, in the order of the sheet.
/// @param position  of each joint [rad or m]
/// @throws std::invalid_argument if there are not as many numbers as joints
template <Robot R>
[[nodiscard]] std::vector<LinkPose> link_poses_of(const R& robot,
                                                  const std::vector<double>& position) {
  if (position.size() != static_cast<std::size_t>(joint_count<R>)) {
    articula::detail::refuse(
        {"link_poses: ", position.size(), " positions for ", joint_count<R>, " joints"});
  }
  const JointVector<joint_count<R>> q =
      Eigen::Map<const JointVector<joint_count<R>>>(position.data());
  std::vector<LinkPose> poses;
  for (const std::size_t i : sheet_links(robot)) {
    const Eigen::Isometry3d pose = forward_kinematics(robot, q, LinkIndex{i});
    const Eigen::Quaterniond turn(pose.linear());
    poses.push_back({std::string(model_of(robot).links[i].name.view()),
                     {pose.translation().x(), pose.translation().y(), pose.translation().z()},
                     {turn.x(), turn.y(), turn.z(), turn.w()}});
  }
  return poses;
}

}  // namespace articula::remote
