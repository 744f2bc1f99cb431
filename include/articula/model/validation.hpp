// SPDX-License-Identifier: Apache-2.0
/// @file Check of a description, and the compiler error for a faulty one.
#pragma once

#include "articula/model/joint.hpp"
#include "articula/model/rule.hpp"

#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace articula {

/// A fault of a description.
struct DescriptionFault {
  Name element{};          ///< the link, joint or robot at fault
  Rule rule = Rule::none;  ///< the broken rule; none if there is no fault
};

namespace detail {

inline constexpr auto no_element = static_cast<std::size_t>(-1);

/// The index of an element by name, no_element if there is none.
template <class Element>
constexpr std::size_t index_of(std::span<const Element> elements, const Name& name) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (elements[i].name == name) return i;
  }
  return no_element;
}

/// The tree by indices. Names are compared once only, because compilers limit the number of steps.
struct TreeIndex {
  std::vector<std::size_t> carriers;  ///< by link: the joint that carries it, or no_element
  std::vector<std::size_t> parents;   ///< by joint: its parent link

  /// The joint that carries a joint's parent link.
  [[nodiscard]] constexpr std::size_t parent_joint(std::size_t joint) const {
    return carriers[parents[joint]];
  }
};

/// Fills the index of the tree. Returns the fault if links and joints do not form a tree.
constexpr DescriptionFault index_tree(std::span<const Link> links, std::span<const Joint> joints,
                                      TreeIndex& tree) {
  tree.carriers.assign(links.size(), no_element);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Joint& joint = joints[j];
    const std::size_t parent = index_of(links, joint.parent), child = index_of(links, joint.child);
    if (parent == no_element) return {joint.name, Rule::parent_link_does_not_exist};
    if (child == no_element) return {joint.name, Rule::child_link_does_not_exist};
    if (tree.carriers[child] != no_element)
      return {joint.child, Rule::link_is_the_child_of_two_joints};
    tree.carriers[child] = j;
    tree.parents.push_back(parent);
  }
  std::size_t root_count = 0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    std::size_t steps = 0;
    for (std::size_t j = tree.carriers[i]; j != no_element; j = tree.parent_joint(j)) {
      if (++steps > joints.size()) return {links[i].name, Rule::links_form_a_loop};
    }
    if (steps == 0 && ++root_count > 1) {
      return {links[i].name, Rule::links_have_more_than_one_root};
    }
  }
  return {};
}

/// By joint, whether it moves mass: that of its child link, of a descendant, or of a joint that
/// mimics it.
constexpr std::vector<char> mass_movers(std::span<const Link> links, std::span<const Joint> joints,
                                        const TreeIndex& tree) {
  std::vector<char> movers(joints.size(), 0);
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (links[i].mass == 0 && links[i].inertia == Symmetric3<double>{}) continue;
    for (std::size_t j = tree.carriers[i]; j != no_element; j = tree.parent_joint(j)) movers[j] = 1;
  }
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Mimic& mimic = joints[j].mimic;
    if (movers[j] == 0 || joints[j].type == JointType::fixed || mimic.multiplier == 0) continue;
    const std::size_t mimicked = index_of(joints, mimic.joint);
    if (mimicked != no_element) movers[mimicked] = 1;
  }
  return movers;
}

/// True for joints that can be commanded.
constexpr bool is_free(const Joint& joint) {
  return joint.type != JointType::fixed && joint.mimic.joint.empty();
}

/// The first rule about mimics that a joint breaks.
constexpr Rule broken_mimic_rule(std::span<const Joint> joints, const Joint& joint) {
  if (joint.type == JointType::fixed || joint.mimic.joint.empty()) return Rule::none;
  const std::size_t mimicked = index_of(joints, joint.mimic.joint);
  if (mimicked == no_element) return Rule::mimicked_joint_does_not_exist;
  return is_free(joints[mimicked]) ? Rule::none : Rule::mimicked_joint_is_not_free;
}

/// The first rule about shared rotors that a joint breaks. The kinetic energy of rotors must not be
/// negative at any velocity. That is c^2 <= a b, with the shared inertia c and the reflected
/// inertias a and b of the two joints. One drive for both joints has c^2 = a b, so the tolerance
/// for rounding is 1e-12.
constexpr Rule broken_rotor_rule(std::span<const Joint> joints, const Joint& joint) {
  const auto& [name, inertia] = joint.shared_rotors;
  if (name.empty()) {
    return inertia == 0 ? Rule::none : Rule::rotors_are_shared_with_no_free_joint;
  }
  const std::size_t other = index_of(joints, name);
  if (other == no_element || name == joint.name || !is_free(joint) || !is_free(joints[other])) {
    return Rule::rotors_are_shared_with_no_free_joint;
  }
  for (const Joint& third : joints) {
    const Name& shares_with = third.shared_rotors.joint;
    if (third.name == joint.name || shares_with.empty()) continue;
    if (third.name == name || shares_with == name || shares_with == joint.name) {
      return Rule::rotors_are_shared_twice;
    }
  }
  const double most = joint.reflected_inertia * joints[other].reflected_inertia;
  const bool fits = inertia * inertia <= most * (1 + 1e-12) && (most > 0 || inertia == 0);
  return fits ? Rule::none : Rule::shared_inertia_is_too_large;
}

/// The first broken rule of single links or joints, or a name that is used twice.
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
    if (index_of(elements, elements[i].name) != i) {
      return {elements[i].name, Rule::name_is_used_twice};
    }
  }
  return {};
}

}  // namespace detail

/// The first fault of a description. A description without fault is a tree of physically possible
/// bodies; see Rule for all rules.
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
  const std::vector<char> movers = detail::mass_movers(links, joints, tree);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Joint& joint = joints[j];
    Rule rule = detail::broken_rotor_rule(joints, joint);
    if (rule == Rule::none) rule = detail::broken_mimic_rule(joints, joint);
    if (rule != Rule::none) return {joint.name, rule};
    if (joint.type == JointType::fixed) continue;
    moves = true;
    if (!kinematic && detail::is_free(joint) && movers[j] == 0) {
      return {joint.name, Rule::joint_moves_no_mass};
    }
    const JointLimits limits = properties_of(joints, joint).limits;
    if (!(limits.lower <= limits.upper)) return {joint.name, Rule::mimics_leave_no_position};
  }
  if (!moves) return {name, Rule::robot_has_no_moving_joint};
  return {};
}

namespace detail {

/// Types that show a name in compiler errors: g++ prints a Name as text; clang prints it as
/// numbers, but single characters as text.
template <Name Text>
struct Named {};
template <char... Characters>
struct Spelled {};

template <Name Text>
[[nodiscard]] consteval auto printable() {
#if defined(__clang__)
  return []<std::size_t... I>(std::index_sequence<I...>) {
    return Spelled<Text.characters[I]...>{};
  }(std::make_index_sequence<Text.view().size()>{});
#else
  return Named<Text>{};
#endif
}

/// Its instantiation is the compiler error for a description with a fault.
/// @tparam Element  the link or joint at fault
/// @tparam Broken   the rule that it breaks
template <class Element, Rule Broken>
struct RobotIsNotPhysical {
  static_assert(Broken == Rule::none,
                "articula: this robot cannot exist. The first template argument of "
                "RobotIsNotPhysical is the link or joint at fault, the second is "
                "the rule that it breaks. (A robot whose masses are not known is described with "
                ".kinematic = true.)");
};

/// Instantiates the error. (Compilers print deduced arguments as values, explicit ones as
/// expressions.)
template <class Element, Rule Broken>
consteval auto reject(Element, std::integral_constant<Rule, Broken>) {
  return RobotIsNotPhysical<Element, Broken>{};
}

}  // namespace detail

}  // namespace articula
