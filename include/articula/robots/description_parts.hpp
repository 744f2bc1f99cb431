// SPDX-License-Identifier: Apache-2.0
/// @file Parts of the descriptions of ready robots that occur several times.
#pragma once

#include "articula/model/joint.hpp"
#include "articula/model/link.hpp"

#include <array>
#include <cstddef>
#include <string_view>

namespace articula::detail {

/// A side of a robot, for parts that are described once and mirrored in the plane y = 0.
struct Side {
  std::string_view prefix;  ///< of the names of its parts
  double sign;              ///< of y: +1 to the left, -1 to the right

  /// The name of a part of this side: prefix and name, at most 63 characters.
  [[nodiscard]] constexpr Name operator()(std::string_view name) const {
    Name result = prefix;
    for (char c : name) result.characters[result.size++] = c;
    return result;
  }
};

/// A link with its centre of mass on the z axis.
/// @param height  of the centre of mass [m]
[[nodiscard]] constexpr Link upright_link(const Name& name, double mass, double height,
                                          const Symmetric3<double>& inertia) {
  return {.name = name, .mass = mass, .center_of_mass = {0, 0, height}, .inertia = inertia};
}

/// A link with its centre of mass at the origin and the same inertia about every axis.
[[nodiscard]] constexpr Link uniform_link(const Name& name, double mass, double inertia) {
  return upright_link(name, mass, 0, {.xx = inertia, .yy = inertia, .zz = inertia});
}

/// A joint that does not move and keeps the orientation of its parent link.
[[nodiscard]] constexpr Joint fixed_joint(const Name& name, const Name& parent, const Name& child,
                                          const Vector3<double>& origin = {}) {
  return {.name = name, .parent = parent, .child = child, .origin = origin};
}

/// A revolute joint that keeps the orientation of its parent link at zero.
[[nodiscard]] constexpr Joint revolute_joint(const Name& name, const Name& parent,
                                             const Name& child, const Vector3<double>& origin,
                                             const Vector3<double>& axis, const JointLimits& limits,
                                             double damping) {
  return {.name = name,
          .type = JointType::revolute,
          .parent = parent,
          .child = child,
          .origin = origin,
          .axis = axis,
          .limits = limits,
          .damping = damping};
}

/// Limits of a joint that moves as far in one direction as in the other.
/// @param largest   position [rad]
/// @param velocity  highest speed [rad/s]
/// @param effort    highest effort [N m]
[[nodiscard]] constexpr JointLimits symmetric_limits(double largest, double velocity,
                                                     double effort) {
  return {.lower = -largest, .upper = largest, .velocity = velocity, .effort = effort};
}

/// The elements of all arrays, in order.
template <class Element, std::size_t... Sizes>
[[nodiscard]] constexpr auto joined(const std::array<Element, Sizes>&... parts) {
  std::array<Element, (Sizes + ...)> all{};
  std::size_t next = 0;
  const auto append = [&](const auto& part) {
    for (const Element& element : part) all[next++] = element;
  };
  (append(parts), ...);
  return all;
}

}  // namespace articula::detail
