// SPDX-License-Identifier: Apache-2.0
/// @file Helpers for descriptions of robots with a left and a right side.
#pragma once

#include "articula/core/name.hpp"

#include <array>
#include <cstddef>
#include <string_view>

namespace articula::detail {

/// A side of a robot, for parts that are described once and mirrored in the plane y = 0.
struct Side {
  std::string_view prefix;  ///< of the names of its parts
  double sign;              ///< of y: +1 to the left, -1 to the right

  /// The name of a part of this side: prefix and name, at most 63 characters.
  [[nodiscard]] constexpr Name operator()(std::string_view name) const {
    Name result = prefix;
    for (char c : name) result.characters[result.size++] = c;
    return result;
  }
};

/// The elements of all arrays, in order.
template <class Element, std::size_t... Sizes>
[[nodiscard]] constexpr auto joined(const std::array<Element, Sizes>&... parts) {
  std::array<Element, (Sizes + ...)> all{};
  std::size_t next = 0;
  const auto append = [&](const auto& part) {
    for (const Element& element : part) all[next++] = element;
  };
  (append(parts), ...);
  return all;
}

}  // namespace articula::detail
