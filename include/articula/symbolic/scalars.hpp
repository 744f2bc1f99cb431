// SPDX-License-Identifier: Apache-2.0
/// @file Access to all scalars of a result of any shape.
#pragma once

#include "articula/model/placement.hpp"
#include "articula/model/vector3.hpp"

#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace articula::symbolic {

/// Calls `visit` for each scalar of a result, always in the same order.
/// @tparam S      the scalar
/// @param result  a scalar, Vector3, Matrix3 or Placement of scalars, or nested arrays of those
/// @param visit   takes an S&, or a const S& if the result is const
/// Real-time: yes, if `visit` is.
template <class S, class Result, class Visit>
[[gnu::always_inline]] constexpr void for_each_scalar(Result& result, const Visit& visit) noexcept {
  using Shape = std::remove_const_t<Result>;
  if constexpr (std::same_as<Shape, S>) {
    visit(result);
  } else if constexpr (std::same_as<Shape, Vector3<S>>) {
    visit(result.x);
    visit(result.y);
    visit(result.z);
  } else if constexpr (std::same_as<Shape, Matrix3<S>>) {
    for_each_scalar<S>(result.rows, visit);
  } else if constexpr (std::same_as<Shape, Placement<S>>) {
    for_each_scalar<S>(result.rotation, visit);
    for_each_scalar<S>(result.translation, visit);
  } else {
    // A fold and not a loop: compilers leave arrays in memory that are filled by loops.
    [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
      (for_each_scalar<S>(result[I], visit), ...);
    }(std::make_index_sequence<std::tuple_size_v<Shape>>{});
  }
}

}  // namespace articula::symbolic
