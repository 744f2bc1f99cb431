// SPDX-License-Identifier: Apache-2.0
/// @file Masks of several registers: the truth values of a comparison of wide packs.
#pragma once

#include "articula/core/lane_mask.hpp"
#include "articula/symbolic/vector_sine_cosine.hpp"

#include <array>
#include <cstddef>
#include <functional>

namespace articula::symbolic {

/// The truth values of a comparison of WidePacks, register by register. It has the operations of
/// the mask of one register, see core/lane_mask.hpp.
/// @tparam Register  the mask of one register
/// @tparam Count     number of registers
template <class Register, std::size_t Count>
struct WideMask {
  std::array<Register, Count> registers;

  [[gnu::always_inline]] friend WideMask operator&(const WideMask& a, const WideMask& b) noexcept {
    return of_registers(std::bit_and<>(), a.registers, b.registers);
  }
  [[gnu::always_inline]] friend WideMask operator|(const WideMask& a, const WideMask& b) noexcept {
    return of_registers(std::bit_or<>(), a.registers, b.registers);
  }
  [[gnu::always_inline]] friend WideMask operator^(const WideMask& a, const WideMask& b) noexcept {
    return of_registers(std::bit_xor<>(), a.registers, b.registers);
  }
  [[gnu::always_inline]] friend WideMask operator~(const WideMask& a) noexcept {
    return of_registers(std::bit_not<>(), a.registers);
  }
  [[gnu::always_inline]] friend WideMask operator!(const WideMask& a) noexcept { return ~a; }
  [[gnu::always_inline]] WideMask& operator&=(const WideMask& b) noexcept {
    return *this = *this & b;
  }
  [[gnu::always_inline]] WideMask& operator|=(const WideMask& b) noexcept {
    return *this = *this | b;
  }

  [[nodiscard, gnu::always_inline]] friend WideMask not_of(const WideMask& a) noexcept {
    return ~a;
  }
  [[nodiscard, gnu::always_inline]] friend bool any_of(const WideMask& a) noexcept {
    return articula::any_of(folded(std::bit_or<>(), a));
  }
  [[nodiscard, gnu::always_inline]] friend bool all_of(const WideMask& a) noexcept {
    return articula::all_of(folded(std::bit_and<>(), a));
  }
  [[nodiscard]] friend bool is_true(const WideMask& a, int lane) noexcept {
    return articula::is_true(a.registers[register_of(lane)], lane % lanes_of_register);
  }
  friend void set_truth(WideMask& a, int lane, bool truth) noexcept {
    articula::set_truth(a.registers[register_of(lane)], lane % lanes_of_register, truth);
  }

  /// f of each register.
  template <class Function, class... Registers>
  [[nodiscard, gnu::always_inline]] static WideMask of_registers(const Function& f,
                                                                 const Registers&... a) noexcept {
    WideMask mask;
    detail::for_each_index<Count>(
        [&](std::size_t i) __attribute__((always_inline)) { mask.registers[i] = f(a[i]...); });
    return mask;
  }

 private:
  static constexpr int lanes_of_register = static_cast<int>(sizeof(Register) / sizeof(double));

  [[nodiscard]] static constexpr std::size_t register_of(int lane) noexcept {
    return static_cast<std::size_t>(lane / lanes_of_register);
  }
  template <class Function>
  [[nodiscard, gnu::always_inline]] static Register folded(const Function& f,
                                                           const WideMask& a) noexcept {
    Register all = a.registers[0];
    detail::for_each_index<Count - 1>(
        [&](std::size_t i) __attribute__((always_inline)) { all = f(all, a.registers[i + 1]); });
    return all;
  }
};

}  // namespace articula::symbolic
