// SPDX-License-Identifier: Apache-2.0
/// @file Several numbers that a processor computes with at once.
#pragma once

#include "articula/symbolic/vector_sine_cosine.hpp"

#include <cmath>
#include <cstring>

namespace articula::symbolic {

/// How many doubles fit into a register of the processor that is compiled for.
#if defined(__AVX512F__)
inline constexpr int lanes_of_a_register = 8;
#elif defined(__AVX__)
inline constexpr int lanes_of_a_register = 4;
#else
inline constexpr int lanes_of_a_register = 2;
#endif

/// The sine and the cosine of something.
template <class S>
struct SineAndCosine {
  S sine;
  S cosine;
};

/// Doubles side by side, which one instruction adds or multiplies: a scalar for algorithms that makes
/// them compute for as many robots at once.
/// @tparam Lanes  how many: 2, or 4 or 8 if they fit into a register
template <int Lanes = lanes_of_a_register>
requires(Lanes == 2 || Lanes == 4 || Lanes == 8) && (Lanes <= lanes_of_a_register) class Pack {
 public:
  static constexpr int lanes = Lanes;

  Pack() = default;  ///< not initialised, as a double
  /// The same number in all lanes.
  [[gnu::always_inline]] explicit Pack(double x) noexcept : reals_(x - Reals{}) {}

  /// Reads as many numbers as there are lanes, the first into lane 0.
  [[nodiscard, gnu::always_inline]] static Pack load(const double* numbers) noexcept {
    Pack pack;
    std::memcpy(&pack.reals_, numbers, sizeof(Reals));
    return pack;
  }
  [[gnu::always_inline]] void store(double* numbers) const noexcept {
    std::memcpy(numbers, &reals_, sizeof(Reals));
  }
  [[nodiscard, gnu::always_inline]] double operator[](int lane) const noexcept {
    return reals_[lane];
  }

  [[gnu::always_inline]] friend Pack operator+(const Pack& a, const Pack& b) noexcept {
    return made_of(a.reals_ + b.reals_);
  }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a, const Pack& b) noexcept {
    return made_of(a.reals_ - b.reals_);
  }
  [[gnu::always_inline]] friend Pack operator*(const Pack& a, const Pack& b) noexcept {
    return made_of(a.reals_ * b.reals_);
  }
  [[gnu::always_inline]] friend Pack operator/(const Pack& a, const Pack& b) noexcept {
    return made_of(a.reals_ / b.reals_);
  }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a) noexcept {
    return made_of(-a.reals_);
  }
  [[gnu::always_inline]] friend Pack sqrt(const Pack& a) noexcept {
    return a.each([](double x) { return std::sqrt(x); });
  }
  [[gnu::always_inline]] friend Pack sin(const Pack& a) noexcept { return sincos(a).sine; }
  [[gnu::always_inline]] friend Pack cos(const Pack& a) noexcept { return sincos(a).cosine; }

  /// Sines and cosines [rad], within three units in the last place; NaN for angles that are not
  /// finite. Large angles are left to <cmath>.
  [[gnu::always_inline]] friend SineAndCosine<Pack> sincos(const Pack& angle) noexcept {
    double size = 0;
    for (int lane = 0; lane < Lanes; ++lane) size += std::abs(angle[lane]);
    SineAndCosine<Pack> result;
    if (size <= detail::largest_reduced_angle) [[likely]] {
      detail::sine_cosine_by_lane<Lanes>(angle.reals_, result.sine.reals_, result.cosine.reals_);
    } else {
      result = {angle.each([](double x) { return std::sin(x); }),
                angle.each([](double x) { return std::cos(x); })};
    }
    return result;
  }

 private:
  using Reals = detail::Reals<Lanes>;

  [[gnu::always_inline]] static Pack made_of(const Reals& reals) noexcept {
    Pack pack;
    pack.reals_ = reals;
    return pack;
  }
  template <class Function>
  [[gnu::noinline, gnu::cold]] Pack each(const Function& f) const noexcept {
    Pack result;
    for (int lane = 0; lane < Lanes; ++lane) result.reals_[lane] = f(reals_[lane]);
    return result;
  }

  Reals reals_;
};

}  // namespace articula::symbolic
