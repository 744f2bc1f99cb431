// SPDX-License-Identifier: Apache-2.0
/// @file Two joints driven by two actuators through a four-bar linkage.
#pragma once

#include "articula/hardware/transmission/transmission.hpp"

#include <array>
#include <string_view>

namespace articula {

/// A four-bar linkage: the second actuator drives the second joint past the first, so the first
/// actuator moves both joints. With the reductions n of actuators and m of joints,
///
///     q_1 = q_a1/(m_1 n_1) + offset_1
///     q_2 = (q_a2/n_2 - q_a1/(m_1 n_1))/m_2 + offset_2
///     effort_1 = m_1 n_1 effort_a1 + n_2 effort_a2
///     effort_2 = m_2 n_2 effort_a2
///
/// and velocities as positions, without offset. Parameters are those of ROS's
/// transmission_interface::FourBarLinkageTransmission. In some versions of it, efforts do not match
/// the power of the velocities; this type keeps the power. All functions are real-time.
struct FourBarTransmission {
  static constexpr int size = 2;
  static constexpr std::string_view urdf_name = "FourBarLinkageTransmission";
  using Vector = JointVector<2>;  ///< 2 x 1

  std::array<double, 2> actuator_reduction{1, 1};  ///< n [1, rad/m, ...]
  std::array<double, 2> joint_reduction{1, 1};     ///< m [1, rad/m, ...]
  std::array<double, 2> joint_offset{};            ///< q where the actuators are at 0 [rad or m]

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
  detail::check_two_joints(where, transmission.actuator_reduction, transmission.joint_reduction,
                           transmission.joint_offset);
}

}  // namespace articula
