// SPDX-License-Identifier: Apache-2.0
/// @file Selection and access by lane: what algorithms over any scalar need beyond arithmetic.
///
/// An algorithm over a scalar S computes for one robot where S is double. Where S is a pack, it
/// computes for several robots. The pack holds the number of one robot in each lane. A comparison
/// of packs gives a mask with a truth value for each lane, so such an algorithm selects where
/// others branch:
///
///     x = select(x > limit, limit, x);
///
/// This header has these operations for double and bool. Argument-dependent lookup finds those of a
/// pack.
#pragma once

#include "articula/core/joint_command.hpp"
#include "articula/core/joint_reference.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/core/lane_mask.hpp"

#include <type_traits>

namespace articula {

/// The number of robots whose numbers a scalar holds.
template <class S>
inline constexpr int lanes = 1;
template <class S>
  requires requires { S::lanes; }
inline constexpr int lanes<S> = S::lanes;

/// A scalar that holds the numbers of several robots.
template <class S>
concept PackedScalar = lanes<S> > 1;

namespace detail {

/// The type of a number of a hardware or controller: its Scalar, else double.
template <class T>
struct ScalarIn {
  using Type = double;
};
template <class T>
  requires requires { typename T::Scalar; }
struct ScalarIn<T> {
  using Type = typename T::Scalar;
};

}  // namespace detail

/// The type of a number that a hardware measures or a controller computes with: its member type
/// `Scalar`, else double. A simulator or controller of several robots names its pack by it.
template <class T>
using ScalarOf = typename detail::ScalarIn<T>::Type;

/// The result of a comparison of two scalars: bool, or a mask with a truth value for each lane.
template <class S>
using MaskOf = decltype(S() < S());

/// A mask with the same truth value in all lanes. Real-time: yes.
template <class S>
[[nodiscard]] constexpr MaskOf<S> mask_of(bool truth) noexcept {
  return S(0) < S(truth ? 1 : 0);
}

/// `chosen` in lanes where the mask is true, else `other`. Real-time: yes.
[[nodiscard]] constexpr double select(bool mask, double chosen, double other) noexcept {
  return mask ? chosen : other;
}
/// Replaces x by another number in lanes where the mask is true. For double this is a branch.
/// Real-time: yes.
template <class S>
constexpr void replace_where(const MaskOf<S>& mask, S& x,
                             const std::type_identity_t<S>& other) noexcept {
  if constexpr (PackedScalar<S>) {
    x = select(mask, other, x);
  } else {
    if (mask) x = other;
  }
}

/// The number between two limits that is nearest to x; a NaN stays one. Real-time: yes.
/// @pre low <= high
template <class S>
[[nodiscard]] constexpr S clamp(const S& x, const std::type_identity_t<S>& low,
                                const std::type_identity_t<S>& high) noexcept {
  const S below = select(high < x, high, x);  // one after the other: processors have min and max
  return select(below < low, low, below);
}

/// The number of the robot in one lane, 0 .. lanes<S> - 1. Real-time: yes.
template <class S>
[[nodiscard]] constexpr double lane_of(const S& x, [[maybe_unused]] int lane) noexcept {
  if constexpr (PackedScalar<S>) {
    return x[lane];
  } else {
    return x;
  }
}
/// @copydoc lane_of(const S&, int)
template <int N, class S>
[[nodiscard]] JointVector<N> lane_of(const JointVector<N, S>& x, int lane) noexcept {
  return for_each_joint<N>([&](int j) noexcept { return lane_of(x[j], lane); });
}

template <int N, class S>
[[nodiscard]] JointState<N> lane_of(const JointState<N, S>& x, int lane) noexcept {
  return {lane_of(x.position, lane), lane_of(x.velocity, lane), lane_of(x.effort, lane)};
}
template <int N, class S>
[[nodiscard]] JointReference<N> lane_of(const JointReference<N, S>& x, int lane) noexcept {
  return {lane_of(x.position, lane), lane_of(x.velocity, lane), lane_of(x.acceleration, lane),
          lane_of(x.effort, lane)};
}
template <int N, class S>
[[nodiscard]] EffortCommand<N> lane_of(const EffortCommand<N, S>& x, int lane) noexcept {
  return {lane_of(x.effort, lane)};
}
template <int N, class S>
[[nodiscard]] PositionCommand<N> lane_of(const PositionCommand<N, S>& x, int lane) noexcept {
  return {lane_of(x.position, lane)};
}
template <int N, class S>
[[nodiscard]] VelocityCommand<N> lane_of(const VelocityCommand<N, S>& x, int lane) noexcept {
  return {lane_of(x.velocity, lane)};
}
template <int N, class S>
[[nodiscard]] MultiModeCommand<N> lane_of(const MultiModeCommand<N, S>& x, int lane) noexcept {
  return {lane_of(x.position, lane), lane_of(x.velocity, lane), lane_of(x.stiffness, lane),
          lane_of(x.damping, lane), lane_of(x.effort, lane)};
}

/// Replaces the number of the robot in one lane. Real-time: yes.
template <class S>
constexpr void set_lane(S& x, [[maybe_unused]] int lane, double number) noexcept {
  if constexpr (PackedScalar<S>) {
    x.set(lane, number);
  } else {
    x = number;
  }
}
template <int N, class S>
void set_lane(JointVector<N, S>& x, int lane, const JointVector<N>& numbers) noexcept {
  for (int j = 0; j < N; ++j) set_lane(x[j], lane, numbers[j]);
}
template <int N, class S>
void set_lane(EffortCommand<N, S>& x, int lane, const EffortCommand<N>& own) noexcept {
  set_lane(x.effort, lane, own.effort);
}
template <int N, class S>
void set_lane(PositionCommand<N, S>& x, int lane, const PositionCommand<N>& own) noexcept {
  set_lane(x.position, lane, own.position);
}
template <int N, class S>
void set_lane(VelocityCommand<N, S>& x, int lane, const VelocityCommand<N>& own) noexcept {
  set_lane(x.velocity, lane, own.velocity);
}
template <int N, class S>
void set_lane(MultiModeCommand<N, S>& x, int lane, const MultiModeCommand<N>& own) noexcept {
  set_lane(x.position, lane, own.position);
  set_lane(x.velocity, lane, own.velocity);
  set_lane(x.stiffness, lane, own.stiffness);
  set_lane(x.damping, lane, own.damping);
  set_lane(x.effort, lane, own.effort);
}

/// The same numbers in all lanes. Real-time: yes.
template <class S, int N>
[[nodiscard]] JointVector<N, S> in_all_lanes(const JointVector<N>& numbers) noexcept {
  return for_each_joint<N, S>([&](int j) noexcept { return S(numbers[j]); });
}

}  // namespace articula
