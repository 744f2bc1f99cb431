// SPDX-License-Identifier: Apache-2.0
/// @file The compiler error for a faulty description.
#pragma once

#include "articula/core/name.hpp"
#include "articula/model/validation.hpp"

#include <cstddef>
#include <type_traits>
#include <utility>

namespace articula::detail {

/// Types that show a name in compiler errors: g++ prints a Name as text; clang prints it as numbers,
/// but single characters as text.
template <Name Text>
struct Named {};
template <char... Characters>
struct Spelled {};

template <Name Text>
[[nodiscard]] consteval auto printable() {
#if defined(__clang__)
  return []<std::size_t... I>(std::index_sequence<I...>) {
    return Spelled<Text.characters[I]...>{};
  }(std::make_index_sequence<Text.view().size()>{});
#else
  return Named<Text>{};
#endif
}

/// Its instantiation is the compiler error for a description with a fault.
/// @tparam Element  the link or joint at fault
/// @tparam Broken   the rule that it breaks
template <class Element, Rule Broken>
struct RobotIsNotPhysical {
  static_assert(Broken == Rule::none,
                "articula: this robot cannot exist. The first template argument of "
                "RobotIsNotPhysical is the link or joint at fault, the second is "
                "the rule that it breaks. (A robot whose masses are not known is described with "
                ".kinematic = true.)");
};

/// Instantiates the error. (Compilers print deduced arguments as values, explicit ones as
/// expressions.)
template <class Element, Rule Broken>
consteval auto reject(Element, std::integral_constant<Rule, Broken>) {
  return RobotIsNotPhysical<Element, Broken>{};
}

}  // namespace articula::detail
