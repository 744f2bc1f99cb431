// SPDX-License-Identifier: Apache-2.0
/// @file The placements and masses of a mechanism's bodies at given joint positions.
#pragma once

#include "articula/dynamics/engine/body_numbers.hpp"
#include "articula/dynamics/engine/coupling.hpp"
#include "articula/model/mechanism.hpp"
#include "articula/symbolic/sine_cosine.hpp"

#include <concepts>
#include <type_traits>

namespace articula {

/// The placement of one body relative to its parent, and its mass distribution. For numbers, the
/// joint's turn and the body's fixed rotation are one matrix. Scalars that simplify expressions
/// keep them apart: a turn about z costs four multiplications, and a fixed rotation often none.
template <class S>
struct JointPlacement {
  static constexpr bool has_separate_turn = requires { requires S::simplifies; };

  Matrix3<S> rotation;     ///< to the parent's frame: R Rz(q), or R with a separate turn
  AxialTurn<S> turn;       ///< the separate turn Rz(q), else unused
  Vector3<S> translation;  ///< origin of this body in the parent's frame [m], 3 x 1
  MassMoments<S> moments;  ///< of the body, in its frame
  S reflected_inertia;     ///< of the joint's drive [kg m^2 or kg]

  /// Adds the joint's turn to the fixed rotation, once.
  constexpr void add_turn(const AxialTurn<S>& joint) noexcept {
    if constexpr (has_separate_turn) {
      turn = joint;
    } else {
      rotation = turned(rotation, joint);
    }
  }
  /// A vector in the parent's frame, from one in this body's: R Rz(q) x.
  [[nodiscard]] constexpr Vector3<S> to_parent(const Vector3<S>& x) const noexcept {
    if constexpr (has_separate_turn) return rotation * turn(x);
    return rotation * x;
  }
  /// The same for a matrix: R Rz(q) A Rz(q)^T R^T.
  [[nodiscard]] constexpr Symmetric3<S> to_parent(const Symmetric3<S>& a) const noexcept {
    if constexpr (has_separate_turn) return rotated(rotation, turn(a));
    return rotated(rotation, a);
  }
  /// A vector in this body's frame, from one in the parent's: Rz(q)^T R^T x.
  [[nodiscard]] constexpr Vector3<S> from_parent(const Vector3<S>& x) const noexcept {
    if constexpr (has_separate_turn) return turn.back(transposed_times(rotation, x));
    return transposed_times(rotation, x);
  }
  /// Adds a mass distribution in this body's frame to one of the parent. With t the translation, h
  /// the turned first moment and a = h + m t/2, J becomes R J R^T + a t^T + t a^T.
  constexpr void add_to_parent(const MassMoments<S>& own, MassMoments<S>& parent) const noexcept {
    const Vector3<S>& t = translation;
    const Vector3<S> h = to_parent(own.first), half_shift = (S(0.5) * own.mass) * t;
    const Vector3<S> a = h + half_shift;
    const S xx = a.x * t.x, yy = a.y * t.y, zz = a.z * t.z;
    const Symmetric3<S> shift{xx + xx, a.x * t.y + a.y * t.x, a.x * t.z + a.z * t.x,
                              yy + yy, a.y * t.z + a.z * t.y, zz + zz};
    parent.mass = parent.mass + own.mass;
    parent.first = parent.first + h + (half_shift + half_shift);
    parent.second = parent.second + shift + to_parent(own.second);
  }
  /// The rotation as a matrix, R Rz(q).
  [[nodiscard]] constexpr Matrix3<S> matrix() const noexcept {
    if constexpr (has_separate_turn) return turned(rotation, turn);
    return rotation;
  }
};

/// All bodies of a mechanism relative to their parents.
template <class S, int Bodies>
using Configuration = JointArray<JointPlacement<S>, Bodies>;

/// The frames in which the algorithms express the vectors of a body. All have z along the joint's
/// axis.
enum class Frames : unsigned char {
  moving,  ///< Each body's own frame.
  /// The frame of the body with its joint at 0, if all axes that the body carries are parallel to
  /// its own. Else it is the body's own frame. Bodies on parallel axes then share one orientation:
  /// angles are added instead of turning vectors, and the body's mass distribution turns.
  resting,
};

namespace detail {

/// True if all axes that a body carries are parallel to its own.
template <int N, int B>
[[nodiscard]] constexpr bool carries_parallel_axes(const Mechanism<N, B>& mechanism,
                                                   int index) noexcept {
  for (const Body& body : mechanism.bodies) {
    const Vector3<double>& axis = body.placement.rotation.rows[2];
    if (body.parent == index && (axis.x != 0 || axis.y != 0)) return false;
  }
  return true;
}

/// The turns of all bodies. At run time all sines and cosines are computed together, which is
/// faster.
template <class S, int B>
[[nodiscard]] constexpr JointArray<AxialTurn<S>, B> turns_by(
    const JointArray<S, B>& angle) noexcept {
  JointArray<AxialTurn<S>, B> turns;
  if constexpr (std::same_as<S, double>) {
    if (!std::is_constant_evaluated()) {
      JointArray<double, B> sine, cosine;
      symbolic::sine_cosine(angle, sine, cosine);
      for (int i = 0; i < B; ++i) turns[i] = {sine[i], cosine[i]};
      return turns;
    }
  }
  for (int i = 0; i < B; ++i) turns[i] = turn_by(angle[i]);
  return turns;
}

}  // namespace detail

/// The configuration of a mechanism at joint positions.
/// @tparam frames    see Frames
/// @param mechanism  the robot's bodies; for resting frames in canonical form
/// @param q          joint positions [rad or m]
/// @param numbers    callable with the index of a body -> BodyNumbers<S>, in place of its own
/// Real-time: yes. O(N) for moving frames.
template <class S, int N, int B, Frames frames = Frames::moving, class Numbers>
[[nodiscard]] constexpr Configuration<S, B> configuration_of(const Mechanism<N, B>& mechanism,
                                                             const JointArray<S, N>& q,
                                                             const Numbers& numbers) noexcept {
  const JointArray<S, B> position = body_positions<S, N, B>(mechanism, q);
  Configuration<S, B> configuration;
  const auto place_at_zero = [&](int i) __attribute__((always_inline)) {
    const BodyNumbers<S> own = numbers(i);
    configuration[i] = {constant<S>(mechanism.bodies[i].placement.rotation),
                        {},
                        own.translation,
                        own.moments,
                        own.reflected_inertia};
  };
  const auto slide = [&](int i) __attribute__((always_inline)) {
    JointPlacement<S>& joint = configuration[i];
    joint.translation = joint.translation + position[i] * joint.rotation.column(2);
  };
  if constexpr (frames == Frames::moving) {
    const JointArray<AxialTurn<S>, B> turns = detail::turns_by(position);
    for (int i = 0; i < B; ++i) {
      place_at_zero(i);
      if (mechanism.bodies[i].prismatic) {
        slide(i);
      } else {
        configuration[i].add_turn(turns[i]);
      }
    }
  } else {
    // The rotation of each body relative to its frame, as an angle and as a turn: zero where that
    // is its own frame.
    JointArray<S, B> angle;
    JointArray<AxialTurn<S>, B> own_turn;
    angle.fill(S(0.0));  // g++ 12 leaves elements of arrays uninitialised where braces should do it
    own_turn.fill({S(0.0), S(1.0)});
    for (int i = 0; i < B; ++i) {
      const Body& body = mechanism.bodies[i];
      JointPlacement<S>& joint = configuration[i];
      place_at_zero(i);
      if (body.parent >= 0) {
        const int parent = detail::parent_of(body, i);
        joint.translation = own_turn[parent](joint.translation);
        // Either the parent has its own frame and its angle is 0, or this joint's axis is parallel
        // to the parent's. rows[2].z is 1 for the same direction, -1 for the opposite one.
        angle[i] = S(body.placement.rotation.rows[2].z) * angle[parent];
      }
      if (body.prismatic) {
        slide(i);
      } else {
        angle[i] = angle[i] + position[i];
      }
      const AxialTurn<S> turn = detail::turn_by(angle[i]);
      if (detail::carries_parallel_axes(mechanism, i)) {
        own_turn[i] = turn;
        joint.moments = turn(joint.moments);
      } else {
        joint.add_turn(turn);
        angle[i] = S(0.0);
      }
    }
  }
  return configuration;
}

/// The configuration with the mechanism's own numbers. Real-time: yes.
template <class S, int N, int B, Frames frames = Frames::moving>
[[nodiscard]] constexpr Configuration<S, B> configuration_of(const Mechanism<N, B>& mechanism,
                                                             const JointArray<S, N>& q) noexcept {
  return configuration_of<S, N, B, frames>(mechanism, q, [&](int i) __attribute__((always_inline)) {
    return numbers_of<S>(mechanism.bodies[i]);
  });
}

}  // namespace articula
