// SPDX-License-Identifier: Apache-2.0
/// @file Rules that single links and joints must obey.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/model/joint.hpp"
#include "articula/model/link.hpp"
#include "articula/model/rule.hpp"

namespace articula::detail {

constexpr bool all_finite(const Vector3<double>& a) {
  return is_finite(a.x) && is_finite(a.y) && is_finite(a.z);
}

/// Numbers so small that products of masses, lengths and accelerations cannot overflow.
constexpr bool are_usable(auto... numbers) {
  constexpr double most = 1e50;
  return ((magnitude(numbers) <= most) && ...);
}
constexpr bool are_usable(const Vector3<double>& a) { return are_usable(a.x, a.y, a.z); }
constexpr bool are_usable(const Symmetric3<double>& m) {
  return are_usable(m.xx, m.xy, m.xz, m.yy, m.yz, m.zz);
}

/// Angles that sine_cosine accepts.
constexpr bool are_angles(const Vector3<double>& rpy) {
  const auto is_angle = [](double x) { return magnitude(x) <= constant_math::largest_angle; };
  return is_angle(rpy.x) && is_angle(rpy.y) && is_angle(rpy.z);
}

/// Positive definite: all pivots of the elimination are positive.
constexpr bool is_positive_definite(const Symmetric3<double>& m) {
  if (!(m.xx > 0)) return false;
  const double yy = m.yy - m.xy * m.xy / m.xx, yz = m.yz - m.xy * m.xz / m.xx;
  if (!(yy > 0)) return false;
  return m.zz - m.xz * m.xz / m.xx - yz * yz / yy > 0;
}

/// The principal moments A, B, C of a real mass distribution obey A + B >= C in every order.
/// Equivalently, the second moments of mass, (trace/2) 1 - I, are positive semidefinite
/// [Wensing, Kim, Slotine 2018, section III]. A flat plate has A + B = C, so the tolerance for
/// rounding is 1e-12 of the trace, some thousand units in the last place.
constexpr bool obeys_triangle_inequality(const Symmetric3<double>& i) {
  const double trace = i.xx + i.yy + i.zz, half = trace / 2 + 1e-12 * trace;
  return is_positive_definite({half - i.xx, -i.xy, -i.xz, half - i.yy, -i.yz, half - i.zz});
}

/// The first rule that a link breaks.
constexpr Rule broken_rule(const Link& link) {
  if (link.name.empty()) return Rule::name_is_missing;
  if (!are_usable(link.mass) || !are_usable(link.center_of_mass) || !are_usable(link.inertia) ||
      !are_angles(link.inertia_orientation)) {
    return Rule::number_is_not_finite;
  }
  if (link.mass < 0) return Rule::link_has_negative_mass;
  if (link.mass == 0) {
    return link.inertia == Symmetric3<double>{} ? Rule::none : Rule::link_has_inertia_but_no_mass;
  }
  if (!is_positive_definite(link.inertia)) return Rule::inertia_is_not_positive_definite;
  if (!obeys_triangle_inequality(link.inertia)) return Rule::inertia_breaks_the_triangle_inequality;
  return Rule::none;
}

/// The first rule that a joint breaks by itself.
constexpr Rule broken_rule(const Joint& joint) {
  const JointLimits& limits = joint.limits;
  if (joint.name.empty()) return Rule::name_is_missing;
  if (!are_usable(joint.origin) || !are_angles(joint.orientation) || !all_finite(joint.axis) ||
      !are_usable(joint.damping, joint.friction, joint.reflected_inertia, joint.mimic.multiplier,
                  joint.mimic.offset, joint.shared_rotors.inertia)) {
    return Rule::number_is_not_finite;
  }
  if (joint.type == JointType::fixed) {
    const bool is_bare = limits == JointLimits{} && joint.damping == 0 && joint.friction == 0 &&
                         joint.reflected_inertia == 0;
    return is_bare ? Rule::none : Rule::fixed_joint_has_limits_or_damping;
  }
  if (joint.axis == Vector3<double>{}) return Rule::axis_has_length_zero;
  if (!(limits.lower <= limits.upper)) return Rule::lower_limit_is_above_upper_limit;
  if (limits.lower == JointLimits::infinity || limits.upper == -JointLimits::infinity) {
    return Rule::number_is_not_finite;
  }
  if (!(limits.velocity >= 0)) return Rule::velocity_limit_is_negative;
  if (!(limits.effort >= 0)) return Rule::effort_limit_is_negative;
  if (!(limits.acceleration > 0)) return Rule::acceleration_limit_is_not_positive;
  if (!(limits.jerk > 0)) return Rule::jerk_limit_is_not_positive;
  if (!(limits.soft_lower <= limits.soft_upper && limits.soft_lower <= limits.upper &&
        limits.soft_upper >= limits.lower && limits.soft_rate > 0)) {
    return Rule::soft_limits_leave_no_position;
  }
  if (joint.damping < 0) return Rule::damping_is_negative;
  if (joint.friction < 0) return Rule::friction_is_negative;
  if (joint.reflected_inertia < 0) return Rule::reflected_inertia_is_negative;
  return Rule::none;
}

}  // namespace articula::detail
