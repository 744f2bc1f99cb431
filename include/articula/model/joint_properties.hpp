// SPDX-License-Identifier: Apache-2.0
/// @file What a joint has besides its place in the mechanism.
#pragma once

#include "articula/core/name.hpp"
#include "articula/model/joint.hpp"

#include <algorithm>
#include <span>

namespace articula {

/// What a joint that can be commanded has besides its place in the mechanism. With a joint that
/// others mimic, limits, damping and friction are those of all of them together; soft limits and
/// the effort limit are its own.
struct JointProperties {
  Name name{};
  JointType type = JointType::revolute;
  JointLimits limits{};
  double damping = 0;   ///< viscous friction [N m s/rad or N s/m]
  double friction = 0;  ///< Coulomb friction [N m or N]
};

namespace detail {

constexpr JointLimits own_limits(const Joint& joint) {
  JointLimits limits = joint.limits;
  if (joint.type == JointType::continuous) {
    limits.lower = -JointLimits::infinity;
    limits.upper = JointLimits::infinity;
    limits.soft_lower = -JointLimits::infinity;
    limits.soft_upper = JointLimits::infinity;
  }
  return limits;
}

}  // namespace detail

/// The properties of a joint that mimics no other. For those that mimic it, it stays where they may
/// be too, and it feels their damping and friction through the coupling (by equal power).
/// @param joints  all joints of the description
/// @param joint   one of them
/// @return        lower limit above the upper one if the limits of all have nothing in common
[[nodiscard]] constexpr JointProperties properties_of(std::span<const Joint> joints,
                                                      const Joint& joint) {
  JointLimits limits = detail::own_limits(joint);
  double damping = joint.damping, friction = joint.friction;
  for (const Joint& other : joints) {
    if (other.type == JointType::fixed || !(other.mimic.joint == joint.name)) continue;
    const auto [name, multiplier, offset] = other.mimic;
    const double size = multiplier < 0 ? -multiplier : multiplier;
    damping += size * size * other.damping;
    friction += size * other.friction;
    const JointLimits own = detail::own_limits(other);
    if (size == 0) {  // it stands at its offset
      if (offset >= own.lower && offset <= own.upper) continue;
      limits.lower = JointLimits::infinity;
      limits.upper = -JointLimits::infinity;
      continue;
    }
    const double a = (own.lower - offset) / multiplier, b = (own.upper - offset) / multiplier;
    limits.lower = std::max(limits.lower, std::min(a, b));
    limits.upper = std::min(limits.upper, std::max(a, b));
    limits.velocity = std::min(limits.velocity, own.velocity / size);
    limits.acceleration = std::min(limits.acceleration, own.acceleration / size);
    limits.jerk = std::min(limits.jerk, own.jerk / size);
  }
  return {joint.name, joint.type, limits, damping, friction};
}

}  // namespace articula
