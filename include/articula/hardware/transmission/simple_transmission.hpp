// SPDX-License-Identifier: Apache-2.0
/// @file One joint driven by one actuator through a gear.
#pragma once

#include "articula/hardware/transmission/transmission.hpp"

#include <string_view>

namespace articula {

/// A gear between one actuator and one joint:
///
///     q = q_a/n + offset,   v = v_a/n,   effort = n effort_a.
///
/// Signs and offset are those of ROS's transmission_interface::SimpleTransmission. A negative
/// reduction reverses the direction. All functions are real-time.
struct SimpleTransmission {
  static constexpr int size = 1;
  static constexpr std::string_view urdf_name = "SimpleTransmission";
  using Vector = JointVector<1>;  ///< 1 x 1

  double reduction = 1;     ///< n, turns of the actuator per turn of the joint [1, rad/m, ...]
  double joint_offset = 0;  ///< q where the actuator is at 0 [rad or m]

  [[nodiscard]] Vector joint_position(const Vector& actuator) const noexcept {
    return Vector(actuator[0] / reduction + joint_offset);
  }
  [[nodiscard]] Vector joint_velocity(const Vector& actuator) const noexcept {
    return Vector(actuator[0] / reduction);
  }
  [[nodiscard]] Vector joint_effort(const Vector& actuator) const noexcept {
    return Vector(reduction * actuator[0]);
  }
  [[nodiscard]] Vector actuator_position(const Vector& joint) const noexcept {
    return Vector(reduction * (joint[0] - joint_offset));
  }
  [[nodiscard]] Vector actuator_velocity(const Vector& joint) const noexcept {
    return Vector(reduction * joint[0]);
  }
  [[nodiscard]] Vector actuator_effort(const Vector& joint) const noexcept {
    return Vector(joint[0] / reduction);
  }
};

/// @throws std::invalid_argument if the reduction is 0 or a figure is not finite
/// Real-time: no (throws).
inline void validate(const SimpleTransmission& transmission, std::string_view where) {
  detail::check_reduction(where, "reduction", transmission.reduction);
  detail::check_offset(where, "joint_offset", transmission.joint_offset);
}

}  // namespace articula
