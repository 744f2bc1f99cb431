// SPDX-License-Identifier: Apache-2.0
/// @file Sines and cosines of the lanes of compilers' vectors, without branches.
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

/// The vectors of g++ and clang++: they have the operators of numbers, lane by lane.
template <int Lanes>
struct Vectors {
  typedef double Reals __attribute__((vector_size(Lanes * sizeof(double))));           // NOLINT
  typedef std::int64_t Integers __attribute__((vector_size(Lanes * sizeof(double))));  // NOLINT
};

template <int Lanes>
using Reals = typename Vectors<Lanes>::Reals;
template <int Lanes>
using Integers = typename Vectors<Lanes>::Integers;

/// Keeps -ffast-math from rearranging what is rounded on purpose. (clang++ has a pragma for that.)
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

/// Lanes 0 and 1, 2 and 3, ... in each other's place.
template <int Lanes>
[[gnu::always_inline]] inline Reals<Lanes> with_swapped_lanes(const Reals<Lanes>& x) noexcept {
  return [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
    return Reals<Lanes>{x[I ^ 1U]...};
  }(std::make_index_sequence<static_cast<std::size_t>(Lanes)>{});
}

/// The largest angle that is reduced right [rad].
inline constexpr double largest_reduced_angle = 2e5;
/// Its square, with which a sum of squares is compared: that asks once whether all angles of many
/// are small, finite numbers.
inline constexpr double largest_reduced_square = largest_reduced_angle * largest_reduced_angle;

/// An angle as right angles and the rest.
template <int Lanes>
struct ReducedAngle {
  Reals<Lanes> rest;             ///< in [-pi/4, pi/4] [rad]
  Integers<Lanes> right_angles;  ///< their number in the last bits
};

/// Pi/2 is subtracted in three parts, of which the first two have so few bits that up to 2^20 times
/// them are exact [Cody, Waite 1980, chapter 8]. Adding 1.5 * 2^52 rounds to an integer and leaves
/// it in the last bits.
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

// Of a reduced angle x, with z = x^2: sin x = x + x z p(z), cos x = 1 + z q(z). The polynomials go
// through the true values at Chebyshev's nodes, which keeps p z and (q + 1/2) z within 2e-17 in
// between. Signs by the number of right angles are + + - - for the sine, + - - + for the cosine; an
// odd number has them change places.
//
// There are two ways to fill the lanes, and how many lanes there are is a matter of the processor.
// Both do the same operations for each angle, so that all give the same bits unless the compiler
// contracts multiplications and additions.

/// Coefficients of z^0 to z^6. (What is multiplied with a 0 and added changes no bit.)
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

/// A polynomial of z, summed in pairs: no step waits long for another one [Estrin].
/// @tparam Degree      5 or 6
/// @param coefficient  takes the power of z
template <std::size_t Degree, class Vector, class Coefficient>
[[gnu::always_inline]] inline Vector polynomial(const Vector& z, const Vector& z2, const Vector& z4,
                                                const Coefficient& coefficient) noexcept {
  Vector last = coefficient(4) + z * coefficient(5);
  if constexpr (Degree == 6) last = last + z2 * coefficient(6);
  return ((coefficient(0) + z * coefficient(1)) + z2 * (coefficient(2) + z * coefficient(3))) +
         z4 * last;
}

/// Stage by stage for several vectors: processors look ahead not much farther than one of them
/// goes, and what they find to do beside it is the next one's part in the same stage.
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

/// The same for few angles, with half the work: the sine in one lane, the cosine in the next.
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
