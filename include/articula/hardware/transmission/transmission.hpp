// SPDX-License-Identifier: Apache-2.0
/// @file What a transmission between actuators and joints is.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_vector.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/joint.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <string_view>

namespace articula {

/// A transmission without loss between as many actuators as joints. Its maps are linear up to the
/// joints' offsets, and equal in power: efforts go the way back of velocities, so that
/// actuator_effort . actuator_velocity = joint_effort . joint_velocity.
///
/// - `size` is the number of joints, and of actuators;
/// - `joint_position(q_a)`, `joint_velocity(v_a)`, `joint_effort(effort_a)` go from actuators to
///   joints;
/// - `actuator_position(q)`, `actuator_velocity(v)`, `actuator_effort(effort)` go back;
/// - `validate(transmission, where)` throws std::invalid_argument that begins with `where` and
///   names the figure, its value and its limit.
///
/// All vectors are size x 1, in rad, rad/s, N m or m, m/s, N. The maps take any value and are
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

/// Refuses a reduction by which nothing can be divided. Products of two that are accepted neither
/// overflow nor vanish.
inline void check_reduction(std::string_view where, std::string_view what, double reduction) {
  if (is_finite(reduction) && std::abs(reduction) >= 1e-100 && std::abs(reduction) <= 1e100) return;
  refuse({where, ": ", what, " ", reduction, " is not a number between 1e-100 and 1e100 in size"});
}

inline void check_offset(std::string_view where, std::string_view what, double offset) {
  if (is_finite(offset)) return;
  refuse({where, ": ", what, " ", offset, " is not finite"});
}

}  // namespace detail

/// What the joints feel of the actuators' rotors: A^T diag(J) A, with A the matrix of
/// actuator_velocity. For a simple transmission that is n^2 J, the `reflected_inertia` of a Joint.
///
/// Between the two joints of a differential there is no coupling if J n^2 is the same for both
/// actuators; else, and in a four-bar transmission, elements off the diagonal are left: the
/// `shared_rotors` of one of the two joints.
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

/// The limits within which actuators must work so that the joints can be anywhere, as fast and as
/// strong as their own limits allow, all at once.
/// @param transmission  between actuators and joints
/// @param joints        limits of the joints
/// @return              of the actuators, in the order of the transmission
/// Real-time: yes.
template <Transmission T>
[[nodiscard]] std::array<JointLimits, static_cast<std::size_t>(T::size)> actuator_limits(
    const T& transmission,
    const std::array<JointLimits, static_cast<std::size_t>(T::size)>& joints) noexcept {
  using Vector = JointVector<T::size>;
  std::array<JointLimits, static_cast<std::size_t>(T::size)> actuators;
  const Vector origin = transmission.actuator_position(Vector::Zero());
  for (int a = 0; a < T::size; ++a) {
    JointLimits& actuator = actuators[static_cast<std::size_t>(a)];
    actuator = {.lower = origin[a], .upper = origin[a], .velocity = 0, .effort = 0};
    for (int j = 0; j < T::size; ++j) {
      const JointLimits& joint = joints[static_cast<std::size_t>(j)];
      const double rate = transmission.actuator_velocity(Vector::Unit(j))[a];
      const double share = transmission.actuator_effort(Vector::Unit(j))[a];
      if (rate != 0) {  // 0 times infinity is no number
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
