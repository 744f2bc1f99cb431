// SPDX-License-Identifier: Apache-2.0
/// @file Two actuators that drive two joints through a four-bar linkage.
#pragma once

#include "articula/hardware/transmission/transmission.hpp"

#include <array>

namespace articula {

/// A four-bar linkage: the second actuator drives the second joint past the first, so that the
/// second joint also moves when the first one does. With the reductions n of actuators and m of
/// joints,
///
///     q_1 = q_a1/(m_1 n_1) + offset_1
///     q_2 = (q_a2/n_2 - q_a1/(m_1 n_1))/m_2 + offset_2
///     effort_1 = m_1 n_1 effort_a1 + n_2 effort_a2
///     effort_2 = m_2 n_2 effort_a2
///
/// and velocities as positions, without offset. Figures are those of ROS's
/// transmission_interface::FourBarLinkageTransmission; versions of it whose efforts do not have the
/// power of the velocities are not followed in that. All functions of this type are real-time: yes.
struct FourBarTransmission {
  static constexpr int size = 2;
  using Vector = JointVector<2>;  ///< 2 x 1

  std::array<double, 2> actuator_reduction{1, 1};  ///< n [1, rad/m, ...]
  std::array<double, 2> joint_reduction{1, 1};     ///< m [1, rad/m, ...]
  std::array<double, 2> joint_offset{};  ///< where joints are when actuators are at 0 [rad or m]

  [[nodiscard]] Vector joint_position(const Vector& actuator) const noexcept {
    return joint_velocity(actuator) + Vector(joint_offset[0], joint_offset[1]);
  }
  [[nodiscard]] Vector joint_velocity(const Vector& actuator) const noexcept {
    const auto& [n1, n2] = actuator_reduction;
    const auto& [m1, m2] = joint_reduction;
    const double first = actuator[0] / (m1 * n1);
    return {first, (actuator[1] / n2 - first) / m2};
  }
  [[nodiscard]] Vector joint_effort(const Vector& actuator) const noexcept {
    const auto& [n1, n2] = actuator_reduction;
    const auto& [m1, m2] = joint_reduction;
    const double second = n2 * actuator[1];
    return {m1 * n1 * actuator[0] + second, m2 * second};
  }
  [[nodiscard]] Vector actuator_position(const Vector& joint) const noexcept {
    return actuator_velocity(joint - Vector(joint_offset[0], joint_offset[1]));
  }
  [[nodiscard]] Vector actuator_velocity(const Vector& joint) const noexcept {
    const auto& [n1, n2] = actuator_reduction;
    const auto& [m1, m2] = joint_reduction;
    return {m1 * n1 * joint[0], n2 * (joint[0] + m2 * joint[1])};
  }
  [[nodiscard]] Vector actuator_effort(const Vector& joint) const noexcept {
    const auto& [n1, n2] = actuator_reduction;
    const auto& [m1, m2] = joint_reduction;
    const double second = joint[1] / m2;
    return {(joint[0] - second) / (m1 * n1), second / n2};
  }
};

/// @throws std::invalid_argument if a reduction is 0 or a figure is not finite
/// Real-time: no (throws).
inline void validate(const FourBarTransmission& transmission, std::string_view where) {
  detail::check_reduction(where, "actuator_reduction[0]", transmission.actuator_reduction[0]);
  detail::check_reduction(where, "actuator_reduction[1]", transmission.actuator_reduction[1]);
  detail::check_reduction(where, "joint_reduction[0]", transmission.joint_reduction[0]);
  detail::check_reduction(where, "joint_reduction[1]", transmission.joint_reduction[1]);
  detail::check_offset(where, "joint_offset[0]", transmission.joint_offset[0]);
  detail::check_offset(where, "joint_offset[1]", transmission.joint_offset[1]);
}

}  // namespace articula
