// SPDX-License-Identifier: Apache-2.0
/// @file Two joints driven by two actuators through a differential.
#pragma once

#include "articula/hardware/transmission/transmission.hpp"

#include <array>
#include <string_view>

namespace articula {

/// A differential, common in wrists: the first joint moves with the sum of both actuators, the
/// second with their difference. With the reductions n of actuators and m of joints,
///
///     q_1 = (q_a1/n_1 + q_a2/n_2)/(2 m_1) + offset_1
///     q_2 = (q_a1/n_1 - q_a2/n_2)/(2 m_2) + offset_2
///     effort_1 = m_1 (n_1 effort_a1 + n_2 effort_a2)
///     effort_2 = m_2 (n_1 effort_a1 - n_2 effort_a2)
///
/// and velocities as positions, without offset. The code of ROS's
/// transmission_interface::DifferentialTransmission computes the same; its documentation has
/// another sign in effort_2. All functions are real-time.
struct DifferentialTransmission {
  static constexpr int size = 2;
  static constexpr std::string_view urdf_name = "DifferentialTransmission";
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
    const double first = actuator[0] / n1, second = actuator[1] / n2;
    return {(first + second) / (2 * m1), (first - second) / (2 * m2)};
  }
  [[nodiscard]] Vector joint_effort(const Vector& actuator) const noexcept {
    const auto& [n1, n2] = actuator_reduction;
    const auto& [m1, m2] = joint_reduction;
    const double first = n1 * actuator[0], second = n2 * actuator[1];
    return {m1 * (first + second), m2 * (first - second)};
  }
  [[nodiscard]] Vector actuator_position(const Vector& joint) const noexcept {
    return actuator_velocity(joint - Vector(joint_offset[0], joint_offset[1]));
  }
  [[nodiscard]] Vector actuator_velocity(const Vector& joint) const noexcept {
    const auto& [n1, n2] = actuator_reduction;
    const auto& [m1, m2] = joint_reduction;
    const double sum = m1 * joint[0], difference = m2 * joint[1];
    return {n1 * (sum + difference), n2 * (sum - difference)};
  }
  [[nodiscard]] Vector actuator_effort(const Vector& joint) const noexcept {
    const auto& [n1, n2] = actuator_reduction;
    const auto& [m1, m2] = joint_reduction;
    const double sum = joint[0] / m1, difference = joint[1] / m2;
    return {(sum + difference) / (2 * n1), (sum - difference) / (2 * n2)};
  }
};

/// @throws std::invalid_argument if a reduction is 0 or a figure is not finite
/// Real-time: no (throws).
inline void validate(const DifferentialTransmission& transmission, std::string_view where) {
  detail::check_two_joints(where, transmission.actuator_reduction, transmission.joint_reduction,
                           transmission.joint_offset);
}

}  // namespace articula
