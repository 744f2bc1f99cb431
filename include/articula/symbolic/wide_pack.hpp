// SPDX-License-Identifier: Apache-2.0
/// @file Packs of several registers, for algorithms whose operations wait for each other.
#pragma once

#include "articula/symbolic/pack.hpp"
#include "articula/symbolic/wide_mask.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

namespace articula::symbolic {

/// Doubles in several registers as one scalar. An operation has a latency of some cycles of the
/// processor, which could begin others meanwhile. In an algorithm of few operations each waits for
/// the one before. With two registers, those of one fill the gaps of the other. An algorithm of
/// many operations has no gaps, and needs all registers for itself: use Pack there.
///
/// Each lane has the bits that it has in a Pack.
/// @tparam Registers  number of registers of the target processor
template <int Registers>
  requires(Registers >= 1)
class WidePack {
  static constexpr std::size_t count = Registers;
  using Register = Pack<>;

 public:
  static constexpr int lanes = Registers * Register::lanes;
  using Mask = WideMask<decltype(Register() < Register()), count>;

  WidePack() = default;  ///< uninitialised, like a double
  [[gnu::always_inline]] WidePack(const WidePack& other) noexcept { assign(other); }
  // NOLINTNEXTLINE(modernize-use-equals-default): register by register, see Pack
  [[gnu::always_inline]] WidePack& operator=(const WidePack& other) noexcept {
    return assign(other), *this;
  }
  ~WidePack() = default;
  /// The same number in all lanes.
  [[gnu::always_inline]] WidePack(double x) noexcept {  // NOLINT: implicit
    each([&](std::size_t i) __attribute__((always_inline)) { registers_[i] = Register(x); });
  }

  [[nodiscard, gnu::always_inline]] double operator[](int lane) const noexcept {
    return registers_[register_of(lane)][lane % Register::lanes];
  }
  [[gnu::always_inline]] void set(int lane, double number) noexcept {
    registers_[register_of(lane)].set(lane % Register::lanes, number);
  }

  [[gnu::always_inline]] friend WidePack operator+(const WidePack& a, const WidePack& b) noexcept {
    return of_registers(std::plus<>(), a, b);
  }
  [[gnu::always_inline]] friend WidePack operator-(const WidePack& a, const WidePack& b) noexcept {
    return of_registers(std::minus<>(), a, b);
  }
  [[gnu::always_inline]] friend WidePack operator*(const WidePack& a, const WidePack& b) noexcept {
    return of_registers(std::multiplies<>(), a, b);
  }
  [[gnu::always_inline]] friend WidePack operator/(const WidePack& a, const WidePack& b) noexcept {
    return of_registers(std::divides<>(), a, b);
  }
  [[gnu::always_inline]] friend WidePack operator-(const WidePack& a) noexcept {
    return of_registers(std::negate<>(), a);
  }
  [[gnu::always_inline]] WidePack& operator+=(const WidePack& b) noexcept {
    return *this = *this + b;
  }
  [[gnu::always_inline]] WidePack& operator-=(const WidePack& b) noexcept {
    return *this = *this - b;
  }
  [[gnu::always_inline]] WidePack& operator*=(const WidePack& b) noexcept {
    return *this = *this * b;
  }

  [[gnu::always_inline]] friend Mask operator<(const WidePack& a, const WidePack& b) noexcept {
    return Mask::of_registers(std::less<>(), a.registers_, b.registers_);
  }
  [[gnu::always_inline]] friend Mask operator<=(const WidePack& a, const WidePack& b) noexcept {
    return Mask::of_registers(std::less_equal<>(), a.registers_, b.registers_);
  }
  [[gnu::always_inline]] friend Mask operator>(const WidePack& a, const WidePack& b) noexcept {
    return Mask::of_registers(std::greater<>(), a.registers_, b.registers_);
  }
  [[gnu::always_inline]] friend Mask operator>=(const WidePack& a, const WidePack& b) noexcept {
    return Mask::of_registers(std::greater_equal<>(), a.registers_, b.registers_);
  }
  [[gnu::always_inline]] friend Mask operator==(const WidePack& a, const WidePack& b) noexcept {
    return Mask::of_registers(std::equal_to<>(), a.registers_, b.registers_);
  }
  [[gnu::always_inline]] friend Mask operator!=(const WidePack& a, const WidePack& b) noexcept {
    return Mask::of_registers(std::not_equal_to<>(), a.registers_, b.registers_);
  }
  /// `chosen` in lanes where the mask is true, else `other`.
  [[gnu::always_inline]] friend WidePack select(const Mask& mask, const WidePack& chosen,
                                                const WidePack& other) noexcept {
    return made([&](std::size_t i) __attribute__((always_inline)) {
      return select(mask.registers[i], chosen.registers_[i], other.registers_[i]);
    });
  }
  [[gnu::always_inline]] friend WidePack abs(const WidePack& a) noexcept {
    return of_registers([](const Register& x) __attribute__((always_inline)) { return abs(x); }, a);
  }
  [[gnu::always_inline]] friend Mask is_finite(const WidePack& a) noexcept {
    return a - a == 0;  // NOLINT(misc-redundant-expression): NaN for infinities and NaN
  }
  [[gnu::always_inline]] friend WidePack sqrt(const WidePack& a) noexcept {
    return of_registers([](const Register& x) __attribute__((always_inline)) { return sqrt(x); },
                        a);
  }
  [[gnu::always_inline]] friend WidePack sin(const WidePack& a) noexcept { return sincos(a).sine; }
  [[gnu::always_inline]] friend WidePack cos(const WidePack& a) noexcept {
    return sincos(a).cosine;
  }
  [[gnu::always_inline]] friend SineAndCosine<WidePack> sincos(const WidePack& a) noexcept {
    std::array<WidePack, 1> sine, cosine;
    sincos(std::array{a}, sine, cosine);
    return {sine[0], cosine[0]};
  }
  /// Sines and cosines of K packs of angles [rad], see Pack. Large angles of one register change no
  /// bit of another.
  template <std::size_t K>
  [[gnu::always_inline]] friend void sincos(const std::array<WidePack, K>& angle,
                                            std::array<WidePack, K>& sine,
                                            std::array<WidePack, K>& cosine) noexcept {
    each([&](std::size_t i) __attribute__((always_inline)) {
      std::array<Register, K> a, s, c;
      detail::for_each_index<K>(
          [&](std::size_t j) __attribute__((always_inline)) { a[j] = angle[j].registers_[i]; });
      sincos(a, s, c);
      detail::for_each_index<K>([&](std::size_t j) __attribute__((always_inline)) {
        sine[j].registers_[i] = s[j];
        cosine[j].registers_[i] = c[j];
      });
    });
  }

 private:
  template <class Function>
  [[gnu::always_inline]] static void each(const Function& f) noexcept {
    detail::for_each_index<count>(f);
  }
  /// f of each index of a register.
  template <class Function>
  [[nodiscard, gnu::always_inline]] static WidePack made(const Function& f) noexcept {
    WidePack pack;
    each([&](std::size_t i) __attribute__((always_inline)) { pack.registers_[i] = f(i); });
    return pack;
  }
  /// f of each register.
  template <class Function, class... Packs>
  [[nodiscard, gnu::always_inline]] static WidePack of_registers(const Function& f,
                                                                 const Packs&... a) noexcept {
    return made([&](std::size_t i)
                    __attribute__((always_inline)) { return f(a.registers_[i]...); });
  }
  [[gnu::always_inline]] void assign(const WidePack& other) noexcept {
    each([&](std::size_t i)
             __attribute__((always_inline)) { registers_[i] = other.registers_[i]; });
  }
  [[nodiscard]] static constexpr std::size_t register_of(int lane) noexcept {
    return static_cast<std::size_t>(lane / Register::lanes);
  }

  std::array<Register, count> registers_;
};

}  // namespace articula::symbolic
