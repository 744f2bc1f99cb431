// SPDX-License-Identifier: Apache-2.0
/// @file The scalars that a result consists of, whatever its shape.
#pragma once

#include "articula/model/placement.hpp"
#include "articula/model/vector3.hpp"

#include <concepts>

namespace articula::symbolic {

/// Calls `visit` for each scalar of a result, always in the same order.
/// @tparam S      the scalar
/// @param result  a scalar, Vector3, Matrix3 or Placement of scalars, or arrays of those, nested as
///                they like
/// @param visit   takes an S&
/// Real-time: yes, if `visit` is.
template <class S, class Result, class Visit>
constexpr void for_each_scalar(Result& result, const Visit& visit) noexcept {
  if constexpr (std::same_as<Result, S>) {
    visit(result);
  } else if constexpr (std::same_as<Result, Vector3<S>>) {
    visit(result.x);
    visit(result.y);
    visit(result.z);
  } else if constexpr (std::same_as<Result, Matrix3<S>>) {
    for_each_scalar<S>(result.rows, visit);
  } else if constexpr (std::same_as<Result, Placement<S>>) {
    for_each_scalar<S>(result.rotation, visit);
    for_each_scalar<S>(result.translation, visit);
  } else {
    for (auto& element : result) for_each_scalar<S>(element, visit);
  }
}

}  // namespace articula::symbolic
