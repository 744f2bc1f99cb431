// SPDX-License-Identifier: Apache-2.0
/// @file The concept of a transmission between actuators and joints.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_array.hpp"
#include "articula/core/joint_vector.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/joint.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <string_view>

namespace articula {

/// A lossless transmission between as many actuators as joints. Its maps are linear, apart from the
/// joints' offsets, and keep the power:
/// actuator_effort . actuator_velocity = joint_effort . joint_velocity.
/// Write one for gearing that SimpleTransmission, DifferentialTransmission and FourBarTransmission
/// do not cover. TransmittedHardware takes it, and refuses it if its maps do not agree. For one
/// gear between motor and joint in a CAN drive, use the scales of the drive instead.
///
/// - `size` is the number of joints, and of actuators;
/// - `joint_position(q_a)`, `joint_velocity(v_a)`, `joint_effort(effort_a)` convert from actuators
///   to joints;
/// - `actuator_position(q)`, `actuator_velocity(v)`, `actuator_effort(effort)` convert back;
/// - `validate(transmission, where)` throws std::invalid_argument with `where`, the figure, its
///   value and its limit.
///
/// All vectors are size x 1, in rad, rad/s, N m or m, m/s, N. The maps accept any value and are
/// noexcept.
template <class T>
concept Transmission =
    requires(const T& transmission, const JointVector<T::size>& x, std::string_view where) {
      { transmission.joint_position(x) } noexcept -> std::same_as<JointVector<T::size>>;
      { transmission.joint_velocity(x) } noexcept -> std::same_as<JointVector<T::size>>;
      { transmission.joint_effort(x) } noexcept -> std::same_as<JointVector<T::size>>;
      { transmission.actuator_position(x) } noexcept -> std::same_as<JointVector<T::size>>;
      { transmission.actuator_velocity(x) } noexcept -> std::same_as<JointVector<T::size>>;
      { transmission.actuator_effort(x) } noexcept -> std::same_as<JointVector<T::size>>;
      validate(transmission, where);
    };

namespace detail {

/// Refuses a reduction whose products or quotients could overflow or vanish.
inline void check_reduction(std::string_view where, std::string_view what, double reduction) {
  if (is_finite(reduction) && std::abs(reduction) >= 1e-100 && std::abs(reduction) <= 1e100) return;
  refuse({where, ": ", what, " ", reduction, " is not a number between 1e-100 and 1e100 in size"});
}

inline void check_offset(std::string_view where, std::string_view what, double offset) {
  if (is_finite(offset)) return;
  refuse({where, ": ", what, " ", offset, " is not finite"});
}

inline void check_two_joints(std::string_view where, const std::array<double, 2>& actuators,
                             const std::array<double, 2>& joints,
                             const std::array<double, 2>& offsets) {
  check_reduction(where, "actuator_reduction[0]", actuators[0]);
  check_reduction(where, "actuator_reduction[1]", actuators[1]);
  check_reduction(where, "joint_reduction[0]", joints[0]);
  check_reduction(where, "joint_reduction[1]", joints[1]);
  check_offset(where, "joint_offset[0]", offsets[0]);
  check_offset(where, "joint_offset[1]", offsets[1]);
}

}  // namespace detail

/// The inertia of the actuators' rotors at the joints: A^T diag(J) A, where A is the matrix of
/// actuator_velocity. For a simple transmission it is n^2 J, the `reflected_inertia` of a Joint.
/// Elements off the diagonal are the `shared_rotors` of one of the two joints. They are zero for a
/// differential if J n^2 is the same for both actuators.
/// @param transmission  between actuators and joints
/// @param rotors        J, inertias of the actuators' rotors [kg m^2 or kg]
/// @return              [kg m^2, kg m or kg], size x size
/// Real-time: yes.
template <Transmission T>
[[nodiscard]] JointMatrix<T::size> reflected_inertia(const T& transmission,
                                                     const JointVector<T::size>& rotors) noexcept {
  JointMatrix<T::size> rates;
  for (int j = 0; j < T::size; ++j) {
    rates.col(j) = transmission.actuator_velocity(JointVector<T::size>::Unit(j));
  }
  return rates.transpose() * rotors.asDiagonal() * rates;
}

/// The smallest limits of actuators with which all joints can use their own limits at once.
/// @param transmission  between actuators and joints
/// @param joints        limits of the joints
/// @return              of the actuators, in the order of the transmission
/// Real-time: yes.
template <Transmission T>
[[nodiscard]] JointArray<JointLimits, T::size> actuator_limits(
    const T& transmission, const JointArray<JointLimits, T::size>& joints) noexcept {
  using Vector = JointVector<T::size>;
  JointArray<JointLimits, T::size> actuators;
  const Vector origin = transmission.actuator_position(Vector::Zero());
  for (int a = 0; a < T::size; ++a) {
    JointLimits& actuator = actuators[a];
    actuator = {.lower = origin[a], .upper = origin[a], .velocity = 0, .effort = 0};
    for (int j = 0; j < T::size; ++j) {
      const JointLimits& joint = joints[j];
      const double rate = transmission.actuator_velocity(Vector::Unit(j))[a];
      const double share = transmission.actuator_effort(Vector::Unit(j))[a];
      if (rate != 0) {  // 0 times infinity is NaN
        actuator.lower += rate * (rate > 0 ? joint.lower : joint.upper);
        actuator.upper += rate * (rate > 0 ? joint.upper : joint.lower);
        actuator.velocity += std::abs(rate) * joint.velocity;
      }
      if (share != 0) actuator.effort += std::abs(share) * joint.effort;
    }
  }
  return actuators;
}

}  // namespace articula
