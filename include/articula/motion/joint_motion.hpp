// SPDX-License-Identifier: Apache-2.0
/// @file Position, velocity and acceleration of one joint, and ranges of such values.
#pragma once

#include "articula/core/joint_reference.hpp"

#include <algorithm>
#include <limits>

namespace articula {

/// The motion of one joint at one moment. Profiles, stops and limits share this type. On the grid
/// of control cycles, dt apart, differences take the place of derivatives:
/// v_k = (q_k - q_(k-1))/dt and a_k = (v_k - v_(k-1))/dt.
struct JointMotion {
  double position = 0;      ///< q [rad or m]
  double velocity = 0;      ///< v [rad/s or m/s]
  double acceleration = 0;  ///< a [rad/s^2 or m/s^2]
};

/// The motion of one joint of a reference.
/// @param joint  0 .. N - 1, not checked
/// Real-time: yes.
template <int N>
[[nodiscard]] JointMotion motion_of(const JointReference<N>& reference, int joint) noexcept {
  return {reference.position[joint], reference.velocity[joint], reference.acceleration[joint]};
}

/// Sets the motion of one joint of a reference. Its effort stays.
/// @param joint  0 .. N - 1, not checked
/// Real-time: yes.
template <int N>
void set_motion(JointReference<N>& reference, int joint, const JointMotion& motion) noexcept {
  reference.position[joint] = motion.position;
  reference.velocity[joint] = motion.velocity;
  reference.acceleration[joint] = motion.acceleration;
}

namespace detail {

/// The reference at a time that is not finite: its position is NaN, which a loop refuses.
/// Real-time: yes.
template <int N>
[[nodiscard]] JointReference<N> undefined_reference() noexcept {
  return {.position = JointVector<N>::Constant(std::numeric_limits<double>::quiet_NaN())};
}

}  // namespace detail

/// The lowest and the highest value of a quantity, such as the position during a motion.
struct ValueRange {
  double lowest = 0;
  double highest = 0;

  /// The smallest range that contains this one and a value. Real-time: yes.
  [[nodiscard]] constexpr ValueRange extended_to(double value) const noexcept {
    return {std::min(lowest, value), std::max(highest, value)};
  }
  /// Whether this range lies within another one. Real-time: yes.
  [[nodiscard]] constexpr bool is_within(const ValueRange& other) const noexcept {
    return lowest >= other.lowest && highest <= other.highest;
  }
};

}  // namespace articula
