// SPDX-License-Identifier: Apache-2.0
/// @file A sum of doubles without rounding.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace articula {

/// The exact sum of finite doubles. It does not depend on their order, so sums of parts add up to
/// the sum of all, to the last bit. Source: Kulisch: Computer arithmetic and validity, 2008.
class ExactSum {
 public:
  static constexpr std::size_t size = 68;  ///< digits of 32 bits, the lowest worth 2^-1074
  using Digits = std::array<std::int64_t, size>;

  /// Adds a number.
  /// @param x  finite
  /// Real-time: yes.
  void add(double x) noexcept {
    if (x == 0) return;
    int exponent = 0;
    const double fraction = std::frexp(std::fabs(x), &exponent);  // 0.5 .. 1
    auto bits = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
    int place = exponent - 53 + 1074;
    if (place < 0) {  // a subnormal number, whose lowest bits are 0
      bits >>= -place;
      place = 0;
    }
    const auto digit = static_cast<std::size_t>(place / 32);
    const std::uint64_t low = (bits & low_bits) << (place % 32), high = (bits >> 32)
                                                                        << (place % 32);
    const std::int64_t sign = x < 0 ? -1 : 1;
    digits_[digit] += sign * static_cast<std::int64_t>(low & low_bits);
    digits_[digit + 1] += sign * static_cast<std::int64_t>((low >> 32) + (high & low_bits));
    digits_[digit + 2] += sign * static_cast<std::int64_t>(high >> 32);
    if (++added_ == capacity) normalise();
  }
  /// Adds another sum. Real-time: yes.
  void merge(const ExactSum& other) noexcept {
    ExactSum own = other;
    own.normalise();
    normalise();
    for (std::size_t k = 0; k < size; ++k) digits_[k] += own.digits_[k];
    normalise();
  }

  /// The sum, rounded; infinite if it is too large for a double. Real-time: yes.
  [[nodiscard]] double value() const noexcept {
    ExactSum sum = *this;
    sum.normalise();
    const bool negative = sum.digits_.back() < 0;
    if (negative) {
      for (std::int64_t& digit : sum.digits_) digit = -digit;
      sum.normalise();
    }
    double result = 0;
    for (std::size_t k = size; k-- > 0;) {
      const int exponent = 32 * static_cast<int>(k) - 1074;
      result += std::ldexp(static_cast<double>(sum.digits_[k]), exponent);
    }
    return negative ? -result : result;
  }

  /// The digits in their one normal form, each within 0 .. 2^32 - 1 except the last: for files.
  [[nodiscard]] Digits digits() const noexcept {
    ExactSum sum = *this;
    sum.normalise();
    return sum.digits_;
  }
  /// The sum of which these are the digits.
  [[nodiscard]] static ExactSum from_digits(const Digits& digits) noexcept {
    ExactSum sum;
    sum.digits_ = digits;
    return sum;
  }

 private:
  static constexpr std::uint64_t low_bits = 0xffffffff;
  static constexpr std::uint32_t capacity = std::uint32_t{1} << 28;  // additions without overflow

  void normalise() noexcept {
    added_ = 0;
    for (std::size_t k = 0; k + 1 < size; ++k) {
      digits_[k + 1] += digits_[k] >> 32;
      digits_[k] &= static_cast<std::int64_t>(low_bits);
    }
  }

  Digits digits_{};
  std::uint32_t added_ = 0;
};

}  // namespace articula
