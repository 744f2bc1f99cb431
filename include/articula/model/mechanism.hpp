// SPDX-License-Identifier: Apache-2.0
/// @file The moving bodies of a robot: the parameters of its equations of motion.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/model/inertia.hpp"
#include "articula/model/placement.hpp"

namespace articula {

/// The rigid body that one joint moves, with everything welded to it. Its frame's origin lies on
/// the joint's axis, and the axis is +z. A revolute joint rotates the body about z, and a prismatic
/// joint translates it along z.
struct Body {
  int parent = -1;         ///< index of the body that carries the joint; -1 for the fixed base
  bool prismatic = false;  ///< translates along z instead of rotating about it
  Placement<double> placement{};  ///< this body's frame in the parent's, at q = 0
  Inertia<double> inertia{};      ///< about the origin of this body's frame
  double reflected_inertia = 0;   ///< of the joint's drive, see Joint [kg m^2 or kg]
  double shared_inertia = 0;      ///< of drives shared with another joint, see SharedRotors
  int sharing_body = -1;          ///< index of that joint's body
};

/// The motion of a body by a joint: q_body = multiplier q_joint + offset. A body on a mimic joint
/// is moved by the mimicked joint, any other by its own joint with multiplier 1 and offset 0.
struct Coupling {
  int joint = -1;
  double multiplier = 1;
  double offset = 0;
};

/// A tree of moving bodies on a fixed base, each on one joint with one degree of freedom. A body's
/// parent has a smaller index; the algorithms rely on that. Without mimic joints, body i is on
/// joint i.
/// @tparam N       number of joints that can be commanded
/// @tparam Bodies  number of moving bodies: N and one for each mimic joint
template <int N, int Bodies = N>
struct Mechanism {
  JointArray<Body, Bodies> bodies{};
  JointArray<Coupling, Bodies> couplings{};  ///< not used if Bodies == N
  Vector3<double> gravity{};  ///< acceleration of free fall in the base frame [m/s^2], 3 x 1
};

namespace detail {

/// The index of the body that carries body i. The bounds let compilers conclude that algorithms
/// read only elements that they have set.
/// @pre body i has a parent, whose index is smaller than i
[[nodiscard, gnu::always_inline]] constexpr int parent_of(const Body& body, int i) noexcept {
  const int parent = body.parent;
  if (parent < 0 || parent >= i) __builtin_unreachable();
  return parent;
}

}  // namespace detail

}  // namespace articula
