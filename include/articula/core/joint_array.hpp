// SPDX-License-Identifier: Apache-2.0
/// @file One value of any type for each joint.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>

namespace articula {

/// One value for each of N joints, indexed by the joint's number as joint vectors are. Also one
/// value for each of N bodies, indexed by the body's number. Use a JointVector for numbers that
/// need arithmetic.
/// @tparam T  type of a value
/// @tparam N  number of joints or bodies
template <class T, int N>
struct JointArray : std::array<T, static_cast<std::size_t>(N)> {
  using Base = std::array<T, static_cast<std::size_t>(N)>;

  /// The value of a joint. Real-time: yes.
  /// @param joint  0 .. N - 1, not checked
  [[nodiscard]] constexpr T& operator[](std::integral auto joint) noexcept {
    return Base::operator[](static_cast<std::size_t>(joint));
  }
  [[nodiscard]] constexpr const T& operator[](std::integral auto joint) const noexcept {
    return Base::operator[](static_cast<std::size_t>(joint));
  }
};

}  // namespace articula

template <class T, int N>
struct std::tuple_size<articula::JointArray<T, N>>
    : std::tuple_size<typename articula::JointArray<T, N>::Base> {};
