// SPDX-License-Identifier: Apache-2.0
/// @file The name, limits and friction of a joint that can be commanded.
#pragma once

#include "articula/core/name.hpp"
#include "articula/model/joint.hpp"

#include <algorithm>
#include <span>

namespace articula {

/// The name, limits and friction of a joint that can be commanded. If other joints mimic it, its
/// limits, damping and friction include theirs; its soft limits and effort limit do not.
struct JointProperties {
  Name name{};
  JointType type = JointType::revolute;
  JointLimits limits{};
  double damping = 0;   ///< viscous friction [N m s/rad or N s/m]
  double friction = 0;  ///< Coulomb friction [N m or N]
};

namespace detail {

/// The limits of a joint without those of its mimics.
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

/// The properties of a joint that mimics no other. Its limits are narrowed so that the joints which
/// mimic it stay within theirs. Their damping and friction are added, converted by equal power.
/// @param joints  all joints of the description
/// @param joint   one of them
/// @return        with lower limit above upper limit if the limits have no position in common
[[nodiscard]] constexpr JointProperties properties_of(std::span<const Joint> joints,
                                                      const Joint& joint) {
  JointLimits limits = detail::own_limits(joint);
  double damping = joint.damping, friction = joint.friction;
  for (const Joint& other : joints) {
    if (other.type == JointType::fixed || !(other.mimic.joint == joint.name)) continue;
    const auto [name, multiplier, offset] = other.mimic;
    const double size = detail::magnitude(multiplier);
    damping += size * size * other.damping;
    friction += size * other.friction;
    const JointLimits own = detail::own_limits(other);
    if (size == 0) {  // it stays at its offset
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
