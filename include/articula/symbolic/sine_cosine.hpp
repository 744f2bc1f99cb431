// SPDX-License-Identifier: Apache-2.0
/// @file Sines and cosines of several angles at once.
#pragma once

#include "articula/symbolic/pack.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <utility>

namespace articula::symbolic {

namespace detail {

/// The number of lanes for a number of angles: those of the smallest sufficient register.
[[nodiscard]] constexpr int lanes_for(std::size_t angles) noexcept {
  int lanes = 2;
  while (lanes < lanes_of_a_register && static_cast<std::size_t>(lanes) < angles) lanes *= 2;
  return lanes;
}

/// An angle that compilers load alone. They would load neighbours in memory as one vector. If the
/// neighbours were just stored one by one, or as other vectors, the processor could not forward
/// them to that load. It waits until all stores have reached the cache (failed store forwarding).
[[nodiscard, gnu::always_inline]] inline double loaded_alone(double angle) noexcept {
#if defined(__x86_64__)
  asm("" : "+x"(angle));
#endif
  return angle;
}

/// The angles from Begin on, each in `Times` lanes, and zeros in the remaining lanes. The vector is
/// composed in registers: a vector that is stored in parts and loaded as a whole waits long.
template <int Lanes, std::size_t Begin, std::size_t Times, std::size_t K>
[[gnu::always_inline]] inline Reals<Lanes> in_lanes(const std::array<double, K>& angle) noexcept {
  return [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
    // (% K: the index must be valid even where no element is read.)
    return Reals<Lanes>{(Begin + I / Times < K ? angle[(Begin + I / Times) % K] : 0.0)...};
  }(std::make_index_sequence<static_cast<std::size_t>(Lanes)>{});
}

/// Sines and cosines of the angles from Begin on.
/// @pre the angles are no larger than largest_reduced_angle
template <std::size_t Begin, std::size_t K>
[[gnu::always_inline]] inline void sine_cosine_in_lanes(const std::array<double, K>& angle,
                                                        std::array<double, K>& sine,
                                                        std::array<double, K>& cosine) noexcept {
  constexpr std::size_t rest = K - Begin;
  if constexpr (rest > 0 && 2 * rest <= lanes_of_a_register) {
    constexpr int lanes = lanes_for(2 * rest);
    const auto both = sine_cosine_side_by_side<lanes>(in_lanes<lanes, Begin, 2>(angle));
    for_each_index<rest>([&](std::size_t i) __attribute__((always_inline)) {
      sine[Begin + i] = both[2 * i];
      cosine[Begin + i] = both[2 * i + 1];
    });
  } else if constexpr (rest > 0) {
    constexpr int lanes = lanes_for(rest);
    constexpr std::size_t taken = rest < lanes ? rest : lanes;
    std::array<Reals<lanes>, 1> s, c;
    sine_cosine_by_lane<lanes, 1>({in_lanes<lanes, Begin, 1>(angle)}, s, c);
    for_each_index<taken>([&](std::size_t i) __attribute__((always_inline)) {
      sine[Begin + i] = s[0][i];
      cosine[Begin + i] = c[0][i];
    });
    sine_cosine_in_lanes<Begin + taken>(angle, sine, cosine);
  }
}

template <std::size_t K>
[[gnu::noinline, gnu::cold]] inline void sine_cosine_of_large(
    const std::array<double, K>& angle, std::array<double, K>& sine,
    std::array<double, K>& cosine) noexcept {
  for (std::size_t i = 0; i < K; ++i) {
    sine[i] = std::sin(angle[i]);
    cosine[i] = std::cos(angle[i]);
  }
}

}  // namespace detail

/// Sines and cosines of K angles [rad]. Programs compute those of all joints by one call.
///
/// - double: side by side, within three units in the last place; by <cmath> if an angle is large,
///   infinite or NaN
/// - a type with a function sincos, found by argument-dependent lookup: by that function, which
///   takes all angles, as that of packs does, or takes one angle and returns both
/// - any other type: by sin and cos, found by argument-dependent lookup or in namespace std
/// Real-time: yes, if those of S are.
template <class S, std::size_t K>
[[gnu::always_inline]] inline void sine_cosine(const std::array<S, K>& angle,
                                               std::array<S, K>& sine,
                                               std::array<S, K>& cosine) noexcept {
  if constexpr (std::same_as<S, double>) {
    std::array<double, K> single;
    double squares = 0;
    detail::for_each_index<K>([&](std::size_t i) __attribute__((always_inline)) {
      single[i] = detail::loaded_alone(angle[i]);
      squares += single[i] * single[i];
    });
    if (squares <= detail::largest_reduced_square) [[likely]] {
      detail::sine_cosine_in_lanes<0>(single, sine, cosine);
    } else {
      std::array<double, K> s, c;
      detail::sine_cosine_of_large(std::array<double, K>(single), s, c);
      sine = s;
      cosine = c;
    }
  } else if constexpr (requires { sincos(angle, sine, cosine); }) {
    sincos(angle, sine, cosine);
  } else if constexpr (requires { sincos(angle[0]); }) {
    detail::for_each_index<K>([&](std::size_t i) __attribute__((always_inline)) {
      const auto [s, c] = sincos(angle[i]);
      sine[i] = s;
      cosine[i] = c;
    });
  } else {
    using std::cos, std::sin;
    for (std::size_t i = 0; i < K; ++i) {
      sine[i] = sin(angle[i]);
      cosine[i] = cos(angle[i]);
    }
  }
}

}  // namespace articula::symbolic
