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

// A compiler that was told that there is no NaN removes the checks that keep NaN from the drives.
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

/// True if every element is finite.
/// Real-time: yes. O(N).
template <int N>
[[nodiscard]] bool is_finite(const JointVector<N>& x) noexcept {
  bool finite = true;
  for (int i = 0; i < N; ++i) finite = finite && is_finite(x[i]);
  return finite;
}

/// True if every member is finite.
/// Real-time: yes. O(N).
template <int N>
[[nodiscard]] bool is_finite(const JointState<N>& state) noexcept {
  return is_finite(state.position) && is_finite(state.velocity) && is_finite(state.effort);
}

/// @copydoc is_finite(const JointState<N>&)
template <int N>
[[nodiscard]] bool is_finite(const JointReference<N>& reference) noexcept {
  return is_finite(reference.position) && is_finite(reference.velocity) &&
         is_finite(reference.acceleration) && is_finite(reference.effort);
}

/// @copydoc is_finite(const JointState<N>&)
template <int N>
[[nodiscard]] bool is_finite(const EffortCommand<N>& command) noexcept {
  return is_finite(command.effort);
}

/// @copydoc is_finite(const JointState<N>&)
template <int N>
[[nodiscard]] bool is_finite(const PositionCommand<N>& command) noexcept {
  return is_finite(command.position);
}

/// @copydoc is_finite(const JointState<N>&)
template <int N>
[[nodiscard]] bool is_finite(const VelocityCommand<N>& command) noexcept {
  return is_finite(command.velocity);
}

/// @copydoc is_finite(const JointState<N>&)
template <int N>
[[nodiscard]] bool is_finite(const MultiModeCommand<N>& command) noexcept {
  return is_finite(command.position) && is_finite(command.velocity) &&
         is_finite(command.stiffness) && is_finite(command.damping) && is_finite(command.effort);
}

}  // namespace articula
