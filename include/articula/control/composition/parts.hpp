// SPDX-License-Identifier: Apache-2.0
/// @file Controllers that are made of others, and show them.
#pragma once

#include "articula/control/composition/part_scope.hpp"

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

namespace articula {

/// A controller or law that is made of others and shows them, its parts. One static function serves
/// constant and other objects:
///
///     static auto parts(auto& self) noexcept { return std::tie(self.controller); }
///
/// The gains of the parts can then be set, are checked in `loop.notices()` and are parameters of a
/// Remote. A Switch among the parts takes requests. Without the function nothing of this is known.
///
/// - For notices and parameters, a std::variant among the parts stands for the one that it holds.
///   `set_gains` and requests to a Switch do not reach into it.
/// - `part_scope(index)` gives the PartScope of a part, by its index in the tuple. A composition
///   that uses all joints of its parts in every cycle has no need of it.
template <class C>
concept HasParts = requires(C& composition) { std::remove_const_t<C>::parts(composition); };

namespace detail {

template <class C>
using PartsOf = decltype(std::remove_const_t<C>::parts(std::declval<C&>()));

template <class T>
inline constexpr bool is_variant = false;
template <class... Kinds>
inline constexpr bool is_variant<std::variant<Kinds...>> = true;

/// Calls function(part, index) for each part of a composition.
template <HasParts C>
void for_each_part(C& composition, auto&& function) {
  std::size_t index = 0;
  const auto visit = [&](auto& part) {
    if constexpr (is_variant<std::remove_cvref_t<decltype(part)>>) {
      std::visit([&](auto& held) { function(held, index); }, part);
    } else {
      function(part, index);
    }
    ++index;
  };
  std::apply([&](auto&... part) { (visit(part), ...); },
             std::remove_const_t<C>::parts(composition));
}

/// What a composition does with the output of one of its parts. Real-time: yes.
template <int N, HasParts C>
[[nodiscard]] PartScope<N> scope_of_part(const C& composition, std::size_t index) noexcept {
  if constexpr (requires { composition.part_scope(index); }) {
    return composition.part_scope(index);
  } else {
    return {};
  }
}

}  // namespace detail

}  // namespace articula
