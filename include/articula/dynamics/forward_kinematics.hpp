// SPDX-License-Identifier: Apache-2.0
/// @file Forward kinematics: where the links stand.
#pragma once

#include "articula/dynamics/body_placements.hpp"
#include "articula/dynamics/evaluate.hpp"

#include <Eigen/Geometry>

#include <string_view>

namespace articula {

/// A link of a robot, found by name once and used in the loop.
struct LinkIndex {
  std::size_t value = 0;
};

/// Finds a link by name, fixed ones included. As a constant it is checked by the compiler:
/// `constexpr auto tool = link_index(Q2d{}, "tool_link");`.
/// @throws std::invalid_argument if the robot has no such link; the message lists its links
/// Real-time: no (throws).
template <Robot R>
[[nodiscard]] constexpr LinkIndex link_index(const R& robot, std::string_view name) {
  const auto& links = model_of(robot).links;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (links[i].name.view() == name) return {i};
  }
  detail::no_such_link(model_of(robot), name);
}

/// Where a link's frame stands in the frame of the robot's root link: X_0L(q).
/// @param robot  a described robot or a model
/// @param q      joint positions [rad or m], N x 1
/// @param link   the link, from link_index of the same robot
/// @return       rotation (dimensionless) and translation [m], as a 4 x 4 isometry
/// Real-time: yes. O(N).
template <Robot R>
[[nodiscard]] Eigen::Isometry3d forward_kinematics(const R& robot,
                                                   const JointVector<joint_count<R>>& q,
                                                   LinkIndex link) noexcept {
  const LinkFrame& frame = model_of(robot).links[link.value];
  Placement<double> placement = frame.placement;
  if (frame.body >= 0) {
    const auto bodies = detail::evaluate<BodyPlacements>(robot, q);
    placement = bodies[static_cast<std::size_t>(frame.body)] * placement;
  }
  const auto to_eigen = [](const Vector3<double>& a) { return Eigen::Vector3d(a.x, a.y, a.z); };
  Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
  for (int k = 0; k < 3; ++k) isometry.linear().col(k) = to_eigen(placement.rotation.column(k));
  isometry.translation() = to_eigen(placement.translation);
  return isometry;
}

/// The same for a link given by name.
/// @throws std::invalid_argument if the robot has no such link
/// Real-time: no (throws, searches by name).
template <Robot R>
[[nodiscard]] Eigen::Isometry3d forward_kinematics(const R& robot,
                                                   const JointVector<joint_count<R>>& q,
                                                   std::string_view link) {
  return forward_kinematics(robot, q, link_index(robot, link));
}

}  // namespace articula
