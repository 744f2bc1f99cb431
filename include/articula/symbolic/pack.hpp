// SPDX-License-Identifier: Apache-2.0
/// @file Packs: several doubles as one scalar, computed by the same instructions.
#pragma once

#include "articula/core/lane_mask.hpp"
#include "articula/symbolic/vector_sine_cosine.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace articula::symbolic {

/// The number of doubles in a register of the target processor.
#if defined(__AVX512F__)
inline constexpr int lanes_of_a_register = 8;
#elif defined(__AVX__)
inline constexpr int lanes_of_a_register = 4;
#else
inline constexpr int lanes_of_a_register = 2;
#endif

/// The sine and the cosine of an angle.
template <class S>
struct SineAndCosine {
  S sine;
  S cosine;
};

/// Doubles side by side, which one instruction adds or multiplies: a scalar that makes an algorithm
/// compute for several robots at once. A double converts to a pack with that number in all lanes.
/// @tparam Lanes  number of doubles: 2, or 4 or 8 if they fit into a register
template <int Lanes = lanes_of_a_register>
  requires(Lanes == 2 || Lanes == 4 || Lanes == 8) && (Lanes <= lanes_of_a_register)
class Pack {
 public:
  static constexpr int lanes = Lanes;

  Pack() = default;  ///< uninitialised, like a double
  // A register at a time. Compilers would copy arrays of packs by halves of registers, and loading
  // what was just stored in halves waits for the cache (failed store forwarding).
  [[gnu::always_inline]] Pack(const Pack& other) noexcept : reals_(other.reals_) {}
  // NOLINTNEXTLINE(modernize-use-equals-default): see above
  [[gnu::always_inline]] Pack& operator=(const Pack& other) noexcept {
    reals_ = other.reals_;
    return *this;
  }
  ~Pack() = default;
  /// The same number in all lanes.
  [[gnu::always_inline]] Pack(double x) noexcept : reals_(x - Reals{}) {}  // NOLINT: implicit

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
  [[gnu::always_inline]] void set(int lane, double number) noexcept { reals_[lane] = number; }

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
  [[gnu::always_inline]] Pack& operator+=(const Pack& b) noexcept { return *this = *this + b; }
  [[gnu::always_inline]] Pack& operator-=(const Pack& b) noexcept { return *this = *this - b; }
  [[gnu::always_inline]] Pack& operator*=(const Pack& b) noexcept { return *this = *this * b; }

  // Comparisons give a vector of integers: in each lane -1 for true, 0 for false.
  [[gnu::always_inline]] friend auto operator<(const Pack& a, const Pack& b) noexcept {
    return a.reals_ < b.reals_;
  }
  [[gnu::always_inline]] friend auto operator<=(const Pack& a, const Pack& b) noexcept {
    return a.reals_ <= b.reals_;
  }
  [[gnu::always_inline]] friend auto operator>(const Pack& a, const Pack& b) noexcept {
    return a.reals_ > b.reals_;
  }
  [[gnu::always_inline]] friend auto operator>=(const Pack& a, const Pack& b) noexcept {
    return a.reals_ >= b.reals_;
  }
  [[gnu::always_inline]] friend auto operator==(const Pack& a, const Pack& b) noexcept {
    return a.reals_ == b.reals_;
  }
  [[gnu::always_inline]] friend auto operator!=(const Pack& a, const Pack& b) noexcept {
    return a.reals_ != b.reals_;
  }
  /// `chosen` in lanes where the mask is true, else `other`.
  template <class Mask>
  [[gnu::always_inline]] friend Pack select(const Mask& mask, const Pack& chosen,
                                            const Pack& other) noexcept {
    return made_of(mask ? chosen.reals_ : other.reals_);
  }
  [[gnu::always_inline]] friend Pack abs(const Pack& a) noexcept { return select(a < 0, -a, a); }
  [[gnu::always_inline]] friend auto is_finite(const Pack& a) noexcept {
    return a - a == 0;  // NOLINT(misc-redundant-expression): NaN for infinities and NaN
  }

  [[gnu::always_inline]] friend Pack sqrt(const Pack& a) noexcept {
    Pack root;
    for (int lane = 0; lane < Lanes; ++lane) root.reals_[lane] = std::sqrt(a.reals_[lane]);
    return root;
  }
  [[gnu::always_inline]] friend Pack sin(const Pack& a) noexcept { return sincos(a).sine; }
  [[gnu::always_inline]] friend Pack cos(const Pack& a) noexcept { return sincos(a).cosine; }
  [[gnu::always_inline]] friend SineAndCosine<Pack> sincos(const Pack& a) noexcept {
    std::array<Pack, 1> sine, cosine;
    sincos(std::array{a}, sine, cosine);
    return {sine[0], cosine[0]};
  }

  /// Sines and cosines of K packs of angles [rad], within three units in the last place; NaN for
  /// angles that are not finite. If an angle of a lane is large, <cmath> computes those of this
  /// lane. One check of all costs less than K checks.
  template <std::size_t K>
  [[gnu::always_inline]] friend void sincos(const std::array<Pack, K>& angle,
                                            std::array<Pack, K>& sine,
                                            std::array<Pack, K>& cosine) noexcept {
    Reals squares{};
    for (std::size_t i = 0; i < K; ++i) squares += angle[i].reals_ * angle[i].reals_;
    if (all_of(squares <= detail::largest_reduced_square)) [[likely]] {
      sincos_of_small<0>(angle, sine, cosine);
    } else {
      // Arrays of its own: arrays whose addresses are passed to a call would go through memory.
      std::array<Pack, K> s, c;
      sincos_of_large(std::array<Pack, K>(angle), made_of(squares), s, c);
      sine = s;
      cosine = c;
    }
  }

 private:
  using Reals = detail::Reals<Lanes>;

  [[gnu::always_inline]] static Pack made_of(const Reals& reals) noexcept {
    Pack pack;
    pack.reals_ = reals;
    return pack;
  }
  /// Sines and cosines of the angles from Begin on, three packs at a time: more do not fit into the
  /// registers.
  template <std::size_t Begin, std::size_t K>
  [[gnu::always_inline]] static void sincos_of_small(const std::array<Pack, K>& angle,
                                                     std::array<Pack, K>& sine,
                                                     std::array<Pack, K>& cosine) noexcept {
    if constexpr (Begin < K) {
      constexpr std::size_t count = K - Begin < 3 ? K - Begin : 3;
      std::array<Reals, count> x, s, c;
      detail::for_each_index<count>(
          [&](std::size_t i) __attribute__((always_inline)) { x[i] = angle[Begin + i].reals_; });
      detail::sine_cosine_by_lane<Lanes, count>(x, s, c);
      detail::for_each_index<count>([&](std::size_t i) __attribute__((always_inline)) {
        sine[Begin + i].reals_ = s[i];
        cosine[Begin + i].reals_ = c[i];
      });
      sincos_of_small<Begin + count>(angle, sine, cosine);
    }
  }
  /// The lanes do not depend on each other. The angles of a lane without a large one are computed
  /// as they are in a pack without one, to the last bit.
  template <std::size_t K>
  [[gnu::noinline, gnu::cold]] static void sincos_of_large(const std::array<Pack, K>& angle,
                                                           const Pack& squares,
                                                           std::array<Pack, K>& sine,
                                                           std::array<Pack, K>& cosine) noexcept {
    std::array<Pack, K> small;
    const auto is_small = squares <= Pack(detail::largest_reduced_square);
    for (std::size_t i = 0; i < K; ++i) small[i] = select(is_small, angle[i], Pack(0));
    sincos_of_small<0>(small, sine, cosine);
    for (int lane = 0; lane < Lanes; ++lane) {
      if (is_small[lane] != 0) continue;
      for (std::size_t i = 0; i < K; ++i) {
        sine[i].reals_[lane] = std::sin(angle[i][lane]);
        cosine[i].reals_[lane] = std::cos(angle[i][lane]);
      }
    }
  }

  Reals reals_;
};

}  // namespace articula::symbolic
