// SPDX-License-Identifier: Apache-2.0
/// @file Jacobians: how the links move with the joints.
#pragma once

#include "articula/dynamics/forward_kinematics.hpp"

#include <array>
#include <string_view>

namespace articula {

/// How a link's frame moves for each joint's velocity, 6 x N.
/// @tparam N  number of joints
template <int N>
using LinkJacobian = Eigen::Matrix<double, 6, N>;

namespace detail {

/// The rows of a link's Jacobian. A body on the way from the base to the link that turns about the
/// axis z through its origin o moves the link's origin p by z x (p - o) and turns it by z; one that
/// slides moves it by z. Source: [Siciliano et al. 2009, section 3.1.3].
template <class S, int N, int B>
[[nodiscard]] constexpr std::array<JointArray<S, N>, 6> jacobian_rows(
    const Mechanism<N, B>& mechanism, const JointArray<Placement<S>, B>& bodies,
    const LinkFrame& link) noexcept {
  std::array<JointArray<S, B>, 6> of_bodies;
  for (auto& row : of_bodies) row.fill(S(0.0));
  Vector3<S> point{};
  if (link.body >= 0) {
    const Placement<S>& carrier = bodies[static_cast<std::size_t>(link.body)];
    point = carrier.rotation * constant<S>(link.placement.translation) + carrier.translation;
  }
  for (int body = link.body; body >= 0;) {
    const auto i = static_cast<std::size_t>(body);
    const Vector3<S> z = bodies[i].rotation.column(2);
    const bool slides = mechanism.bodies[i].prismatic;
    const Vector3<S> linear = slides ? z : cross(z, point - bodies[i].translation);
    const Vector3<S> angular = slides ? Vector3<S>{} : z;
    of_bodies[0][i] = linear.x, of_bodies[1][i] = linear.y, of_bodies[2][i] = linear.z;
    of_bodies[3][i] = angular.x, of_bodies[4][i] = angular.y, of_bodies[5][i] = angular.z;
    body = mechanism.bodies[i].parent;
  }
  std::array<JointArray<S, N>, 6> rows;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    // Joints and bodies are coupled in a row as they are in efforts: J G and (G^T J^T)^T.
    rows[k] = joint_efforts<S, N, B>(mechanism, of_bodies[k]);
  }
  return rows;
}

}  // namespace detail

/// The geometric Jacobian of a link: J(q) v are the velocity of the origin of the link's frame
/// (rows 0 to 2) and the angular velocity of the link (rows 3 to 5), both in the frame of the
/// robot's root link. J(q)^T (f, n) are the joint efforts that do the work of a force f at that
/// origin and a moment n. Joints that do not move the link have columns of zeros.
/// @param robot  a described robot or a model
/// @param q      joint positions [rad or m], N x 1
/// @param link   the link, from link_index of the same robot
/// @return       J, 6 x N; rows 0 to 2 in m/rad (1 for a prismatic joint), rows 3 to 5 in rad/rad
///               (0 for a prismatic joint)
/// Real-time: yes. O(N). It takes operations<BodyPlacements, R>() and 9 multiplications for each
/// joint before the link.
template <Robot R>
[[nodiscard]] LinkJacobian<joint_count<R>> jacobian(const R& robot,
                                                    const JointVector<joint_count<R>>& q,
                                                    LinkIndex link) noexcept {
  const auto& model = model_of(robot);
  const auto rows = detail::jacobian_rows(
      model.mechanism, detail::evaluate<BodyPlacements>(robot, q), model.links[link.value]);
  LinkJacobian<joint_count<R>> jacobian;
  for (int k = 0; k < 6; ++k) {
    jacobian.row(k) = detail::to_vector(rows[static_cast<std::size_t>(k)]).transpose();
  }
  return jacobian;
}

/// The same for a link given by name.
/// @throws std::invalid_argument if the robot has no such link
/// Real-time: no (throws, searches by name).
template <Robot R>
[[nodiscard]] LinkJacobian<joint_count<R>> jacobian(const R& robot,
                                                    const JointVector<joint_count<R>>& q,
                                                    std::string_view link) {
  return jacobian(robot, q, link_index(robot, link));
}

}  // namespace articula
