// SPDX-License-Identifier: Apache-2.0
/// @file Sines and cosines of several angles at once.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>

// Packs of four doubles and more pay off; ARTICULA_WITHOUT_XSIMD keeps to <cmath>.
#if defined(__AVX2__) && __has_include(<xsimd/xsimd.hpp>) && !defined(ARTICULA_WITHOUT_XSIMD)
#define ARTICULA_HAS_WIDE_PACKS
#include <xsimd/xsimd.hpp>
#endif

namespace articula::symbolic {

#ifdef ARTICULA_HAS_WIDE_PACKS
namespace detail {

/// Sines and cosines of K angles [rad] in packs, the last of which is filled up with zeros.
template <std::size_t K>
[[gnu::always_inline]] inline void packed_sine_cosine(const std::array<double, K>& angle,
                                                      std::array<double, K>& sine,
                                                      std::array<double, K>& cosine) noexcept {
  using Pack = xsimd::batch<double>;
  constexpr std::size_t padded = (K + Pack::size - 1) / Pack::size * Pack::size;
  alignas(Pack) std::array<double, padded> angles{}, sines, cosines;
  for (std::size_t i = 0; i < K; ++i) angles[i] = angle[i];
  for (std::size_t i = 0; i < padded; i += Pack::size) {
    const auto [s, c] = xsimd::sincos(Pack::load_aligned(&angles[i]));
    s.store_aligned(&sines[i]);
    c.store_aligned(&cosines[i]);
  }
  for (std::size_t i = 0; i < K; ++i) {
    sine[i] = sines[i];
    cosine[i] = cosines[i];
  }
}

}  // namespace detail
#endif

/// Sines and cosines of K angles [rad], found by argument-dependent lookup or in namespace std;
/// those of three doubles and more by xsimd where the compiler may use AVX2 or wider and xsimd is
/// there, within two units in the last place. Programs take those of all joints by one call of
/// this function.
/// Real-time: yes, if those of S are.
template <class S, std::size_t K>
[[gnu::always_inline]] inline void sine_cosine(const std::array<S, K>& angle,
                                               std::array<S, K>& sine,
                                               std::array<S, K>& cosine) noexcept {
#ifdef ARTICULA_HAS_WIDE_PACKS
  if constexpr (std::same_as<S, double> && K >= 3) {
    return detail::packed_sine_cosine(angle, sine, cosine);
  }
#endif
  using std::cos, std::sin;
  for (std::size_t i = 0; i < K; ++i) {
    sine[i] = sin(angle[i]);
    cosine[i] = cos(angle[i]);
  }
}

}  // namespace articula::symbolic
