// SPDX-License-Identifier: Apache-2.0
/// @file Where the joints of a mechanism stand, ready for the algorithms.
#pragma once

#include "articula/core/constant_math.hpp"
#include "articula/dynamics/engine/coupling.hpp"
#include "articula/model/mechanism.hpp"
#include "articula/symbolic/sine_cosine.hpp"

#include <cmath>
#include <concepts>
#include <type_traits>

namespace articula {

/// A body's mass distribution by its moments about the origin of a frame: all that its motion can
/// feel of it. The second moment, unlike the inertia, is turned and shifted without regard to its
/// trace, and its part along the joint's axis is zero in a canonical mechanism.
template <class S>
struct MassMoments {
  S mass = S(0.0);         ///< m [kg]
  Vector3<S> first{};      ///< h = integral of r dm [kg m], 3 x 1
  Symmetric3<S> second{};  ///< J = integral of r r^T dm = trace(I)/2 1 - I [kg m^2], 3 x 3

  friend constexpr MassMoments operator+(const MassMoments& a, const MassMoments& b) noexcept {
    return {a.mass + b.mass, a.first + b.first, a.second + b.second};
  }
};

/// The moments of an inertia.
template <class S>
[[nodiscard]] constexpr MassMoments<S> moments_of(const Inertia<double>& inertia) noexcept {
  const Symmetric3<double>& i = inertia.moment;
  return {S(inertia.mass),
          constant<S>(inertia.first_moment),
          {S((i.yy + i.zz - i.xx) / 2), S(-i.xy), S(-i.xz), S((i.xx + i.zz - i.yy) / 2), S(-i.yz),
           S((i.xx + i.yy - i.zz) / 2)}};
}

/// A turn about z.
template <class S>
struct AxialTurn {
  S sine = S(0.0);
  S cosine = S(1.0);

  [[nodiscard]] constexpr Vector3<S> operator()(const Vector3<S>& x) const noexcept {
    return {cosine * x.x - sine * x.y, sine * x.x + cosine * x.y, x.z};
  }
  [[nodiscard]] constexpr Vector3<S> back(const Vector3<S>& x) const noexcept {
    return {cosine * x.x + sine * x.y, cosine * x.y - sine * x.x, x.z};
  }
  /// Rz A Rz^T. With k = s (xx - yy) + 2 c xy the elements become xx - s k, yy + s k and c k - xy.
  [[nodiscard]] constexpr Symmetric3<S> operator()(const Symmetric3<S>& a) const noexcept {
    const S k = sine * (a.xx - a.yy) + cosine * (a.xy + a.xy), shift = sine * k;
    return {a.xx - shift, cosine * k - a.xy,           cosine * a.xz - sine * a.yz,
            a.yy + shift, sine * a.xz + cosine * a.yz, a.zz};
  }
  [[nodiscard]] constexpr MassMoments<S> operator()(const MassMoments<S>& m) const noexcept {
    return {m.mass, (*this)(m.first), (*this)(m.second)};
  }
};

/// A turn about z and another one after it, as a matrix: R Rz.
template <class S>
[[nodiscard]] constexpr Matrix3<S> turned(const Matrix3<S>& rotation,
                                          const AxialTurn<S>& turn) noexcept {
  const Vector3<S> x = rotation.column(0), y = rotation.column(1);
  const S &s = turn.sine, &c = turn.cosine;
  return Matrix3<S>{{{c * x + s * y, c * y - s * x, rotation.column(2)}}}.transposed();
}

/// Where one body stands relative to its parent, and how its mass lies in its frame. For scalars
/// that know zeros, turning by the joint and turning by the body's fixed placement are kept apart:
/// a turn about z costs four multiplications, and a fixed one often none. For numbers they are one
/// matrix.
template <class S>
struct JointPlacement {
  static constexpr bool turns_are_apart = requires { requires S::simplifies; };

  Matrix3<S> rotation;     ///< turn to the parent's frame: R Rz(q); apart, R
  AxialTurn<S> turn;       ///< apart, the turn about z that comes before it; else of no meaning
  Vector3<S> translation;  ///< origin of this body in the parent's frame [m], 3 x 1
  MassMoments<S> moments;  ///< of the body, in its frame

  /// Adds the joint's turn to the fixed one, once.
  constexpr void add_turn(const AxialTurn<S>& joint) noexcept {
    if constexpr (turns_are_apart) {
      turn = joint;
    } else {
      rotation = turned(rotation, joint);
    }
  }
  /// Parent's components of a vector given in this body's: R Rz(q) x.
  [[nodiscard]] constexpr Vector3<S> to_parent(const Vector3<S>& x) const noexcept {
    if constexpr (turns_are_apart) return rotation * turn(x);
    return rotation * x;
  }
  /// The same for a matrix: R Rz(q) A Rz(q)^T R^T.
  [[nodiscard]] constexpr Symmetric3<S> to_parent(const Symmetric3<S>& a) const noexcept {
    if constexpr (turns_are_apart) return rotated(rotation, turn(a));
    return rotated(rotation, a);
  }
  /// This body's components of a vector given in the parent's: Rz(q)^T R^T x.
  [[nodiscard]] constexpr Vector3<S> from_parent(const Vector3<S>& x) const noexcept {
    if constexpr (turns_are_apart) return turn.back(transposed_times(rotation, x));
    return transposed_times(rotation, x);
  }
  /// Adds a mass distribution given in this body's frame to one of the parent: with t the
  /// translation, h the turned first moment and a = h + m t/2, J becomes R J R^T + a t^T + t a^T.
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
  /// The whole turn as a matrix, R Rz(q).
  [[nodiscard]] constexpr Matrix3<S> matrix() const noexcept {
    if constexpr (turns_are_apart) return turned(rotation, turn);
    return rotation;
  }
};

/// All bodies of a mechanism relative to their parents.
template <class S, int Bodies>
using Configuration = JointArray<JointPlacement<S>, Bodies>;

/// The frames in which the vectors of a body are given. All have z along the joint's axis.
enum class Frames : unsigned char {
  moving,  ///< Each body's own frame.
  /// Where it can be, the frame that the body would have if its joint stood at 0. Bodies on
  /// parallel axes are then seen from one direction, angles are added where vectors would be
  /// turned, and it is the body's mass that turns. It can be where a body carries no axes but such
  /// as are parallel to its own; the others have their own frame.
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

/// The turn about z by an angle [rad], also where the compiler itself computes.
template <class S>
[[nodiscard]] constexpr AxialTurn<S> turn_by(const S& angle) noexcept {
  if constexpr (std::same_as<S, double>) {
    if (std::is_constant_evaluated()) {
      const auto [sine, cosine] = constant_math::sine_cosine(angle);
      return {sine, cosine};
    }
  }
  if constexpr (requires { sincos(angle); }) {
    const auto [sine, cosine] = sincos(angle);
    return {sine, cosine};
  } else {
    using std::cos, std::sin;
    return {sin(angle), cos(angle)};
  }
}

/// The same for all bodies. At run time it pays to take all sines and cosines together.
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
/// @tparam frames    in which the algorithms shall calculate
/// @param mechanism  the robot's bodies; for resting frames in canonical form
/// @param q          joint positions [rad or m]
/// Real-time: yes. O(N) for moving frames.
template <class S, int N, int B, Frames frames = Frames::moving>
[[nodiscard]] constexpr Configuration<S, B> configuration_of(const Mechanism<N, B>& mechanism,
                                                             const JointArray<S, N>& q) noexcept {
  const JointArray<S, B> position = body_positions<S, N, B>(mechanism, q);
  Configuration<S, B> configuration;
  const auto place_at_zero = [&](int i) __attribute__((always_inline)) {
    const Body& body = mechanism.bodies[i];
    configuration[i] = {constant<S>(body.placement.rotation),
                        {},
                        constant<S>(body.placement.translation),
                        moments_of<S>(body.inertia)};
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
    // How far a body has turned in the frame in which it is seen, as an angle and as a turn: not at
    // all where that is its own frame; elsewhere the frame does not turn with the joint.
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
        // Either the parent is seen in its own frame and its angle is 0, or this is a joint on an
        // axis parallel to the parent's: 1 if both point the same way, -1 if not.
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

}  // namespace articula
