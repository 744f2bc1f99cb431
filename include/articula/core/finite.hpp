// SPDX-License-Identifier: Apache-2.0
/// @file Tests for NaN and infinity, at compile time and at run time.
#pragma once

#include "articula/core/joint_command.hpp"
#include "articula/core/joint_reference.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/core/joint_vector.hpp"

#include <bit>
#include <cstdint>

namespace articula {

// A compiler that assumes that there is no NaN removes the checks that keep NaN from the drives.
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "articula checks for NaN: add -fno-finite-math-only after -ffast-math or -Ofast"
#endif

/// True unless x is NaN or infinite: by the exponent's bits (IEEE 754-2019, section 3.4), for
/// std::isfinite is not constexpr before C++23.
/// @param x  any number
/// Real-time: yes.
[[nodiscard]] constexpr bool is_finite(double x) noexcept {
  constexpr std::uint64_t exponent = 0x7ff0'0000'0000'0000U;
  return (std::bit_cast<std::uint64_t>(x) & exponent) != exponent;
}

namespace detail {

/// 0 if every element is finite, else NaN, as infinity minus infinity is.
template <int N, class S>
[[nodiscard]] S difference_to_itself(const JointVector<N, S>& x) noexcept {
  S sum = x[0] - x[0];                             // NOLINT(misc-redundant-expression): see above
  for (int i = 1; i < N; ++i) sum += x[i] - x[i];  // NOLINT(misc-redundant-expression): likewise
  return sum;
}

/// True if every element of all vectors is finite; of packs a mask.
template <class... Vectors>
[[nodiscard]] auto are_finite(const Vectors&... x) noexcept {
  return (difference_to_itself(x) + ...) == 0;
}

}  // namespace detail

/// True if every element is finite. For packs it is a mask with a truth value for each robot; the
/// functions below do likewise.
/// Real-time: yes. O(N).
template <int N, class S>
[[nodiscard]] auto is_finite(const JointVector<N, S>& x) noexcept {
  return detail::are_finite(x);
}

/// True if every member is finite.
/// Real-time: yes. O(N).
template <int N, class S>
[[nodiscard]] auto is_finite(const JointState<N, S>& state) noexcept {
  return detail::are_finite(state.position, state.velocity, state.effort);
}

/// @copydoc is_finite(const JointState<N, S>&)
template <int N, class S>
[[nodiscard]] auto is_finite(const JointReference<N, S>& reference) noexcept {
  return detail::are_finite(reference.position, reference.velocity, reference.acceleration,
                            reference.effort);
}

/// @copydoc is_finite(const JointState<N, S>&)
template <int N, class S>
[[nodiscard]] auto is_finite(const EffortCommand<N, S>& command) noexcept {
  return detail::are_finite(command.effort);
}

/// @copydoc is_finite(const JointState<N, S>&)
template <int N, class S>
[[nodiscard]] auto is_finite(const PositionCommand<N, S>& command) noexcept {
  return detail::are_finite(command.position);
}

/// @copydoc is_finite(const JointState<N, S>&)
template <int N, class S>
[[nodiscard]] auto is_finite(const VelocityCommand<N, S>& command) noexcept {
  return detail::are_finite(command.velocity);
}

/// @copydoc is_finite(const JointState<N, S>&)
template <int N, class S>
[[nodiscard]] auto is_finite(const MultiModeCommand<N, S>& command) noexcept {
  return detail::are_finite(command.position, command.velocity, command.stiffness, command.damping,
                            command.effort);
}

}  // namespace articula
