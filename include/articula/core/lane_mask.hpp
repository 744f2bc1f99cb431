// SPDX-License-Identifier: Apache-2.0
/// @file Masks: the truth values of a comparison, one for each robot of a pack.
///
/// A mask of doubles is a bool. A mask of packs is a vector of integers, -1 for true and 0 for
/// false.
#pragma once

#include <cstddef>

namespace articula {

namespace detail {

/// A vector of integers, by its size.
template <class Mask>
concept VectorMask = requires(const Mask& mask) { mask[0]; };

template <std::size_t Size>
struct VectorsOf {
  typedef double Reals __attribute__((vector_size(Size)));        // NOLINT
  typedef long long Integers __attribute__((vector_size(Size)));  // NOLINT
};

/// A bit for each lane, lane 0 the lowest: one instruction where the processor has it. Compilers
/// would take the vector apart.
template <VectorMask Mask>
[[nodiscard, gnu::always_inline]] constexpr unsigned true_lanes(const Mask& mask) noexcept {
#if defined(__AVX512DQ__)
  if constexpr (sizeof(Mask) == 64) {
    return static_cast<unsigned char>(
        __builtin_ia32_cvtq2mask512(reinterpret_cast<VectorsOf<64>::Integers>(mask)));
  }
#endif
#if defined(__AVX__)
  if constexpr (sizeof(Mask) == 32) {
    return static_cast<unsigned>(
        __builtin_ia32_movmskpd256(reinterpret_cast<VectorsOf<32>::Reals>(mask)));
  }
#endif
#if defined(__SSE2__)
  if constexpr (sizeof(Mask) == 16) {
    return static_cast<unsigned>(
        __builtin_ia32_movmskpd(reinterpret_cast<VectorsOf<16>::Reals>(mask)));
  }
#endif
  unsigned bits = 0;
  for (std::size_t k = 0; k < sizeof(Mask) / sizeof(mask[0]); ++k) {
    bits |= (mask[k] != 0 ? 1U : 0U) << k;
  }
  return bits;
}

}  // namespace detail

/// Whether the mask is true in any lane. Real-time: yes.
[[nodiscard]] constexpr bool any_of(bool mask) noexcept { return mask; }
template <detail::VectorMask Mask>
[[nodiscard, gnu::always_inline]] constexpr bool any_of(const Mask& mask) noexcept {
  return detail::true_lanes(mask) != 0;
}
/// Whether the mask is true in all lanes. Real-time: yes.
[[nodiscard]] constexpr bool all_of(bool mask) noexcept { return mask; }
template <detail::VectorMask Mask>
[[nodiscard, gnu::always_inline]] constexpr bool all_of(const Mask& mask) noexcept {
  constexpr std::size_t lanes = sizeof(Mask) / sizeof(mask[0]);
  return detail::true_lanes(mask) == (1U << lanes) - 1;
}
/// True where the mask is false. Real-time: yes.
[[nodiscard]] constexpr bool not_of(bool mask) noexcept { return !mask; }
template <detail::VectorMask Mask>
[[nodiscard, gnu::always_inline]] constexpr Mask not_of(const Mask& mask) noexcept {
  return ~mask;
}
/// Whether the mask is true in one lane. Real-time: yes.
[[nodiscard]] constexpr bool is_true(bool mask, [[maybe_unused]] int lane) noexcept { return mask; }
template <detail::VectorMask Mask>
[[nodiscard]] constexpr bool is_true(const Mask& mask, int lane) noexcept {
  return mask[lane] != 0;
}
/// Replaces the truth value of one lane. Real-time: yes.
template <detail::VectorMask Mask>
constexpr void set_truth(Mask& mask, int lane, bool truth) noexcept {
  mask[lane] = truth ? -1 : 0;
}

}  // namespace articula
