// SPDX-License-Identifier: Apache-2.0
/// @file The numbers of a mechanism's bodies in the equations of motion, over any scalar.
#pragma once

#include "articula/dynamics/engine/axial_turn.hpp"
#include "articula/model/mechanism.hpp"

namespace articula {

/// The numbers of one body: constants, or inputs of a program where robots of one kind differ. The
/// tree, the kinds of the joints and the directions of their axes are not among them.
template <class S>
struct BodyNumbers {
  Vector3<S> translation{};         ///< of the body's frame in the parent's, at q = 0 [m], 3 x 1
  MassMoments<S> moments{};         ///< in the body's frame
  S reflected_inertia = S(0.0);     ///< of the joint's drive [kg m^2 or kg]
  static constexpr int count = 14;  ///< of numbers
};

/// The numbers of a body as constants.
template <class S>
[[nodiscard]] constexpr BodyNumbers<S> numbers_of(const Body& body) noexcept {
  return {constant<S>(body.placement.translation), moments_of<S>(body.inertia),
          S(body.reflected_inertia)};
}

/// Calls `visit` for each of a body's numbers, always in the same order.
/// @param visit  takes an S&, or a const S& if the numbers are const
template <class Numbers, class Visit>
constexpr void for_each_number(Numbers& numbers, const Visit& visit) {
  visit(numbers.translation.x);
  visit(numbers.translation.y);
  visit(numbers.translation.z);
  visit(numbers.moments.mass);
  visit(numbers.moments.first.x);
  visit(numbers.moments.first.y);
  visit(numbers.moments.first.z);
  visit(numbers.moments.second.xx);
  visit(numbers.moments.second.xy);
  visit(numbers.moments.second.xz);
  visit(numbers.moments.second.yy);
  visit(numbers.moments.second.yz);
  visit(numbers.moments.second.zz);
  visit(numbers.reflected_inertia);
}

}  // namespace articula
