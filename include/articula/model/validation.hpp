// SPDX-License-Identifier: Apache-2.0
/// @file Which descriptions are robots, and what is wrong with the others.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/model/joint_properties.hpp"
#include "articula/model/link.hpp"
#include "articula/model/rule.hpp"

#include <span>
#include <vector>

namespace articula {

/// What is wrong with a description.
struct DescriptionFault {
  Name element{};          ///< the link, joint or robot at fault
  Rule rule = Rule::none;  ///< the rule that it breaks; none if there is no fault
};

namespace detail {

constexpr bool all_finite(const Vector3<double>& a) {
  return is_finite(a.x) && is_finite(a.y) && is_finite(a.z);
}

/// Numbers whose products, as those of masses, lengths and accelerations, cannot overflow.
constexpr bool are_usable(auto... numbers) {
  constexpr double most = 1e50;
  return ((numbers >= -most && numbers <= most) && ...);
}
constexpr bool are_usable(const Vector3<double>& a) { return are_usable(a.x, a.y, a.z); }
constexpr bool are_usable(const Symmetric3<double>& m) {
  return are_usable(m.xx, m.xy, m.xz, m.yy, m.yz, m.zz);
}

/// Angles that are finite and whose sines mean something.
constexpr bool are_angles(const Vector3<double>& rpy) {
  constexpr double most = constant_math::largest_angle;
  return rpy.x >= -most && rpy.x <= most && rpy.y >= -most && rpy.y <= most && rpy.z >= -most &&
         rpy.z <= most;
}

/// Positive definite: all pivots of the elimination are positive.
constexpr bool is_positive_definite(const Symmetric3<double>& m) {
  if (!(m.xx > 0)) return false;
  const double yy = m.yy - m.xy * m.xy / m.xx, yz = m.yz - m.xy * m.xz / m.xx;
  if (!(yy > 0)) return false;
  return m.zz - m.xz * m.xz / m.xx - yz * yz / yy > 0;
}

/// The principal moments A, B, C of a real mass distribution obey A + B >= C in every order. That
/// is the same as the second moments of mass, (trace/2) 1 - I, being positive semidefinite
/// [Wensing, Kim, Slotine 2018, section III]. A flat plate lies on the edge, so rounding of the
/// figures is forgiven: 1e-12 of the trace, some thousand units in the last place.
constexpr bool obeys_triangle_inequality(const Symmetric3<double>& i) {
  const double trace = i.xx + i.yy + i.zz, half = trace / 2 + 1e-12 * trace;
  return is_positive_definite({half - i.xx, -i.xy, -i.xz, half - i.yy, -i.yz, half - i.zz});
}

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

template <class Element>
constexpr int index_of(std::span<const Element> elements, const Name& name) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (elements[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

/// The joint that carries a link: a span of one, empty for a root. (Not a pointer: with
/// -fsanitize=undefined g++ 12 takes a pointer as a condition for no constant expression.)
constexpr std::span<const Joint> carrier_of(std::span<const Joint> joints, const Name& link) {
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].child == link) return joints.subspan(j, 1);
  }
  return {};
}

/// Who stands on whom, by index: names are compared once only, as compilers count every step.
struct TreeIndex {
  std::vector<int> carriers;  ///< by link: the joint that carries it, -1 for a root
  std::vector<int> parents;   ///< by joint: the link that it stands on

  /// The joint before this one on the way to the root, -1 if there is none.
  [[nodiscard]] constexpr int before(int joint) const {
    return carriers[static_cast<std::size_t>(parents[static_cast<std::size_t>(joint)])];
  }
};

/// Finds out who stands on whom, or why they do not form a tree.
constexpr DescriptionFault index_tree(std::span<const Link> links, std::span<const Joint> joints,
                                      TreeIndex& tree) {
  tree.carriers.assign(links.size(), -1);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Joint& joint = joints[j];
    const int parent = index_of(links, joint.parent), child = index_of(links, joint.child);
    if (parent < 0) return {joint.name, Rule::parent_link_does_not_exist};
    if (child < 0) return {joint.name, Rule::child_link_does_not_exist};
    int& carrier = tree.carriers[static_cast<std::size_t>(child)];
    if (carrier >= 0) return {joint.child, Rule::link_is_the_child_of_two_joints};
    carrier = static_cast<int>(j);
    tree.parents.push_back(parent);
  }
  int root = -1;
  for (std::size_t i = 0; i < links.size(); ++i) {
    std::size_t steps = 0;
    for (int j = tree.carriers[i]; j >= 0; j = tree.before(j)) {
      if (++steps > joints.size()) return {links[i].name, Rule::links_form_a_loop};
    }
    if (steps > 0) continue;
    if (root >= 0) return {links[i].name, Rule::links_have_more_than_one_root};
    root = static_cast<int>(i);
  }
  return {};
}

/// Which joints move mass: that of their child link or of a link further out.
constexpr std::vector<char> mass_movers(std::span<const Link> links, const TreeIndex& tree) {
  std::vector<char> movers(tree.parents.size(), 0);
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (links[i].mass == 0 && links[i].inertia == Symmetric3<double>{}) continue;
    for (int j = tree.carriers[i]; j >= 0; j = tree.before(j)) {
      movers[static_cast<std::size_t>(j)] = 1;
    }
  }
  return movers;
}

constexpr bool is_free(const Joint& joint) {
  return joint.type != JointType::fixed && joint.mimic.joint.empty();
}

/// True if a joint moves mass, by itself or by those that mimic it.
constexpr bool moves_mass(std::span<const Joint> joints, std::size_t index,
                          const std::vector<char>& movers) {
  if (movers[index] != 0) return true;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Joint& other = joints[j];
    const bool follows = other.type != JointType::fixed && other.mimic.multiplier != 0 &&
                         other.mimic.joint == joints[index].name;
    if (follows && movers[j] != 0) return true;
  }
  return false;
}

constexpr Rule broken_mimic_rule(std::span<const Joint> joints, const Joint& joint) {
  if (joint.type == JointType::fixed || joint.mimic.joint.empty()) return Rule::none;
  const int followed = index_of(joints, joint.mimic.joint);
  if (followed < 0) return Rule::mimicked_joint_does_not_exist;
  const bool free = is_free(joints[static_cast<std::size_t>(followed)]);
  return free ? Rule::none : Rule::mimicked_joint_is_not_free;
}

/// No combination of two joints' velocities may give rotors negative energy: with a and b the
/// reflected inertias of the two, c^2 <= a b. One drive for both joints lies on the edge, so
/// rounding is forgiven.
constexpr Rule broken_rotor_rule(std::span<const Joint> joints, const Joint& joint) {
  const auto& [name, inertia] = joint.shared_rotors;
  if (name.empty()) {
    return inertia == 0 ? Rule::none : Rule::rotors_are_shared_with_no_free_joint;
  }
  const int other = index_of(joints, name);
  if (other < 0 || name == joint.name || !is_free(joint) ||
      !is_free(joints[static_cast<std::size_t>(other)])) {
    return Rule::rotors_are_shared_with_no_free_joint;
  }
  for (const Joint& third : joints) {
    const Name& shares_with = third.shared_rotors.joint;
    if (third.name == joint.name || shares_with.empty()) continue;
    if (third.name == name || shares_with == name || shares_with == joint.name) {
      return Rule::rotors_are_shared_twice;
    }
  }
  const double most =
      joint.reflected_inertia * joints[static_cast<std::size_t>(other)].reflected_inertia;
  const bool fits = inertia * inertia <= most * (1 + 1e-12) && (most > 0 || inertia == 0);
  return fits ? Rule::none : Rule::shared_inertia_is_too_large;
}

/// The first broken rule of single links or joints, and names that are used twice.
template <class Element>
constexpr DescriptionFault element_fault(std::span<const Element> elements, bool allow_unphysical,
                                         bool kinematic) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Rule rule = broken_rule(elements[i]);
    const bool is_waived =
        (allow_unphysical && concerns_inertia(rule)) || (kinematic && concerns_mass(rule));
    if (rule != Rule::none && !is_waived) {
      return {elements[i].name, rule};
    }
    if (index_of(elements, elements[i].name) != static_cast<int>(i)) {
      return {elements[i].name, Rule::name_is_used_twice};
    }
  }
  return {};
}

}  // namespace detail

/// The first fault of a description: what makes it not a tree of physically possible bodies. Links
/// have both mass and a possible inertia or neither; see Rule for all rules.
/// @param name     of the robot
/// @param gravity  acceleration of free fall [m/s^2], 3 x 1
/// @param links    all links
/// @param joints   all joints
/// @param allow_unphysical  waives the rules that concern inertia, see concerns_inertia
/// @param kinematic         waives the rules that concern mass, see concerns_mass
/// @return         element and rule, or Rule::none
/// Real-time: no (quadratic in the number of links; meant for compile time and set-up).
[[nodiscard]] constexpr DescriptionFault find_fault(
    const Name& name, const Vector3<double>& gravity, std::span<const Link> links,
    std::span<const Joint> joints, bool allow_unphysical = false, bool kinematic = false) {
  if (!detail::are_usable(gravity)) return {name, Rule::number_is_not_finite};
  DescriptionFault fault = detail::element_fault(links, allow_unphysical, kinematic);
  if (fault.rule == Rule::none) fault = detail::element_fault(joints, allow_unphysical, kinematic);
  detail::TreeIndex tree;
  if (fault.rule == Rule::none) fault = detail::index_tree(links, joints, tree);
  if (fault.rule != Rule::none) return fault;
  bool moves = false;
  const std::vector<char> movers = detail::mass_movers(links, tree);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Joint& joint = joints[j];
    Rule rule = detail::broken_rotor_rule(joints, joint);
    if (rule == Rule::none) rule = detail::broken_mimic_rule(joints, joint);
    if (rule != Rule::none) return {joint.name, rule};
    if (joint.type == JointType::fixed) continue;
    moves = true;
    if (!kinematic && detail::is_free(joint) && !detail::moves_mass(joints, j, movers)) {
      return {joint.name, Rule::joint_moves_no_mass};
    }
    const JointLimits limits = properties_of(joints, joint).limits;
    if (!(limits.lower <= limits.upper)) return {joint.name, Rule::mimics_leave_no_position};
  }
  if (!moves) return {name, Rule::robot_has_no_moving_joint};
  return {};
}

}  // namespace articula
