// SPDX-License-Identifier: Apache-2.0
/// @file Sines and cosines of vector registers, lane by lane, without branches.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace articula::symbolic::detail {

/// Calls f with 0 to Count - 1. (Compilers leave arrays in memory that are filled by loops.)
template <std::size_t Count, class Function>
[[gnu::always_inline]] inline void for_each_index(const Function& f) noexcept {
  [&]<std::size_t... I>(std::index_sequence<I...>)
      __attribute__((always_inline)) { (f(I), ...); }(std::make_index_sequence<Count>{});
}

/// The vector types of g++ and clang++, with the operators of numbers for each lane.
template <int Lanes>
struct Vectors {
  typedef double Reals __attribute__((vector_size(Lanes * sizeof(double))));           // NOLINT
  typedef std::int64_t Integers __attribute__((vector_size(Lanes * sizeof(double))));  // NOLINT
};

template <int Lanes>
using Reals = typename Vectors<Lanes>::Reals;
template <int Lanes>
using Integers = typename Vectors<Lanes>::Integers;

/// Prevents -ffast-math from rearranging intended rounding. (clang++ has a pragma for that.)
template <class Vector>
[[gnu::always_inline]] inline Vector as_written(const Vector& x) noexcept {
#if defined(__clang__)
  return x;
#else
  return __builtin_assoc_barrier(x);
#endif
}

/// Numbers of even lanes and of odd lanes.
template <class Vector, class T>
[[gnu::always_inline]] inline Vector alternating(T even, T odd) noexcept {
  return [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
    return Vector{(I % 2 == 0 ? even : odd)...};
  }(std::make_index_sequence<sizeof(Vector) / sizeof(T)>{});
}

/// Lanes 0 and 1, 2 and 3, ... exchanged.
template <int Lanes>
[[gnu::always_inline]] inline Reals<Lanes> with_swapped_lanes(const Reals<Lanes>& x) noexcept {
  return [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
    return Reals<Lanes>{x[I ^ 1U]...};
  }(std::make_index_sequence<static_cast<std::size_t>(Lanes)>{});
}

/// The largest angle whose reduction is accurate [rad].
inline constexpr double largest_reduced_angle = 2e5;
/// Its square. A sum of squares below it shows that all angles are small and finite.
inline constexpr double largest_reduced_square = largest_reduced_angle * largest_reduced_angle;

/// An angle as a number of right angles and a rest.
template <int Lanes>
struct ReducedAngle {
  Reals<Lanes> rest;             ///< in [-pi/4, pi/4] [rad]
  Integers<Lanes> right_angles;  ///< their number in the last bits
};

/// Subtracts pi/2 in three parts. The first two have so few bits that their multiples up to 2^20
/// are exact [Cody, Waite 1980, chapter 8]. Adding 1.5 * 2^52 rounds to an integer in the last
/// bits.
/// @pre the angle is no larger than largest_reduced_angle
template <int Lanes>
[[gnu::always_inline]] inline ReducedAngle<Lanes> reduce(const Reals<Lanes>& angle) noexcept {
#if defined(__clang__)
#pragma clang fp reassociate(off)
#endif
  constexpr double rounder = 0x1.8p52, right_angles_in_a_radian = 0x1.45f306dc9c883p-1;
  constexpr double head = 0x1.921fb544p0, middle = 0x1.0b4611a6p-34, tail = 0x1.3198a2e037073p-69;
  const Reals<Lanes> shifted = as_written(angle * right_angles_in_a_radian + rounder);
  const Reals<Lanes> count = as_written(shifted - rounder);
  const Reals<Lanes> near = as_written(as_written(angle - count * head) - count * middle);
  return {near - count * tail, reinterpret_cast<Integers<Lanes>>(shifted)};
}

// For a reduced angle x, with z = x^2: sin x = x + x z p(z), cos x = 1 + z q(z). The polynomials
// interpolate the true values at Chebyshev's nodes, so that p z and (q + 1/2) z are accurate to
// 2e-17. The signs by the number of right angles are + + - - for the sine and + - - + for the
// cosine; an odd number exchanges sine and cosine.
//
// There are two ways to fill the lanes, and the number of lanes depends on the processor. All do
// the same operations for each angle and give the same bits, unless the compiler contracts
// multiplications and additions.

/// Coefficients of z^0 to z^6. (Adding a product with the 0 changes no bit.)
inline constexpr double of_sine[] = {-0x1.5555555555555p-3,
                                     0x1.1111111110bb2p-7,
                                     -0x1.a01a019e83816p-13,
                                     0x1.71de379654304p-19,
                                     -0x1.ae600aca92c64p-26,
                                     0x1.5e0b05bff20f2p-33,
                                     0};
inline constexpr double of_cosine[] = {-0.5,
                                       0x1.5555555555555p-5,
                                       -0x1.6c16c16c16967p-10,
                                       0x1.a01a019f4e9b4p-16,
                                       -0x1.27e4fa17bf139p-22,
                                       0x1.1eeb68cd22f56p-29,
                                       -0x1.907d8f29fe831p-37};

/// A polynomial of z, summed in pairs for short dependencies [Estrin].
/// @tparam Degree      5 or 6
/// @param coefficient  callable with the power of z
template <std::size_t Degree, class Vector, class Coefficient>
[[gnu::always_inline]] inline Vector polynomial(const Vector& z, const Vector& z2, const Vector& z4,
                                                const Coefficient& coefficient) noexcept {
  Vector last = coefficient(4) + z * coefficient(5);
  if constexpr (Degree == 6) last = last + z2 * coefficient(6);
  return ((coefficient(0) + z * coefficient(1)) + z2 * (coefficient(2) + z * coefficient(3))) +
         z4 * last;
}

/// Sines and cosines of several vectors, stage by stage. Processors look ahead about as far as the
/// operations of one vector; this order gives them independent operations of other vectors.
/// @param[out] sine, cosine  of the angle in each lane
/// @pre the angles are no larger than largest_reduced_angle
template <int Lanes, std::size_t Count>
[[gnu::always_inline]] inline void sine_cosine_by_lane(
    const std::array<Reals<Lanes>, Count>& angle, std::array<Reals<Lanes>, Count>& sine,
    std::array<Reals<Lanes>, Count>& cosine) noexcept {
  using Vector = Reals<Lanes>;
  std::array<ReducedAngle<Lanes>, Count> reduced;
  std::array<Vector, Count> z, p, q;
  const auto each = [](const auto& stage)
                        __attribute__((always_inline)) { for_each_index<Count>(stage); };
  each([&](std::size_t i) __attribute__((always_inline)) { reduced[i] = reduce<Lanes>(angle[i]); });
  each([&](std::size_t i)
           __attribute__((always_inline)) { z[i] = reduced[i].rest * reduced[i].rest; });
  each([&](std::size_t i) __attribute__((always_inline)) {
    const Vector z2 = z[i] * z[i], z4 = z2 * z2;
    const auto in_all_lanes = [](const double* numbers) __attribute__((always_inline)) {
      return [numbers](std::size_t k) __attribute__((always_inline)) {
        return numbers[k] - Vector{};  // vectors have no constructor for that
      };
    };
    p[i] = polynomial<5>(z[i], z2, z4, in_all_lanes(of_sine));
    q[i] = polynomial<6>(z[i], z2, z4, in_all_lanes(of_cosine));
  });
  each([&](std::size_t i) __attribute__((always_inline)) {
    const auto& [x, right_angles] = reduced[i];
    const auto s = reinterpret_cast<Integers<Lanes>>(x + (x * z[i]) * p[i]);
    const auto c = reinterpret_cast<Integers<Lanes>>(1.0 + z[i] * q[i]);
    const Integers<Lanes> odd = right_angles << 63;    // the last bit as a sign
    const Integers<Lanes> swap = (s ^ c) & (odd < 0);  // true is a lane full of ones
    const Integers<Lanes> sign = (right_angles & 2) << 62;
    sine[i] = reinterpret_cast<Vector>(s ^ swap ^ sign);
    cosine[i] = reinterpret_cast<Vector>(c ^ swap ^ sign ^ odd);
  });
}

/// The same for few angles, with half the operations: the sine in one lane, the cosine in the next.
/// @param angle  each in two lanes
/// @return       sines in even lanes, cosines in odd ones
/// @pre the angles are no larger than largest_reduced_angle
template <int Lanes>
[[gnu::always_inline]] inline Reals<Lanes> sine_cosine_side_by_side(
    const Reals<Lanes>& angle) noexcept {
  using Vector = Reals<Lanes>;
  const auto [x, turns] = reduce<Lanes>(angle);
  const Vector z = x * x, z2 = z * z, z4 = z2 * z2;
  const Vector r = polynomial<6>(z, z2, z4, [](std::size_t k) __attribute__((always_inline)) {
    return alternating<Vector>(of_sine[k], of_cosine[k]);
  });
  const auto odd = alternating<Integers<Lanes>, std::int64_t>(0, 1);
  const Vector first = odd != 0 ? alternating<Vector>(1.0, 1.0) : x;
  const Vector values = first + (first * z) * r;
  const Vector placed = (turns << 63) < 0 ? with_swapped_lanes<Lanes>(values) : values;
  return reinterpret_cast<Vector>(reinterpret_cast<Integers<Lanes>>(placed) ^
                                  (((turns + odd) & 2) << 62));
}

}  // namespace articula::symbolic::detail
