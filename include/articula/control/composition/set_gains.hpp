// SPDX-License-Identifier: Apache-2.0
/// @file Changes the gains of a running controller.
#pragma once

#include "articula/control/composition/parts.hpp"

#include <cstddef>
#include <tuple>
#include <type_traits>

namespace articula {

namespace detail {

/// A law or controller with a function `set_gains` of its own.
template <class C, class Gains>
concept SetsGains = requires(C& controller, const Gains& gains) {
  { controller.set_gains(gains) } noexcept;
};

/// How many take such gains: a law or controller itself, or else of its parts.
template <class C, class Gains>
[[nodiscard]] consteval std::size_t count_gain_takers() {
  if constexpr (SetsGains<C, Gains>) {
    return 1;
  } else if constexpr (HasParts<C>) {
    return []<class... Parts>(std::type_identity<std::tuple<Parts...>>) {
      return (count_gain_takers<std::remove_reference_t<Parts>, Gains>() + ... + std::size_t{0});
    }(std::type_identity<PartsOf<C>>());
  } else {
    return 0;
  }
}

}  // namespace detail

/// A law or controller that can go on with other gains of the kind `Gains` between two cycles. It
/// has a function `set_gains`, or one of its parts takes them.
template <class C, class Gains>
concept TakesGains = detail::count_gain_takers<std::remove_reference_t<C>, Gains>() == 1;

/// Goes on with other gains of a controller, or of the one of its parts that takes them. A sum of
/// laws is one controller: all its laws of that kind get them. If several controllers of a Switch
/// or Groups take them, pass the one that is meant: `member<I>()`.
/// @param controller  of a loop, for instance
/// @param gains       as ValidPidGains<N>
/// Real-time: yes.
template <class C, class Gains>
void set_gains(C& controller, const Gains& gains) noexcept {
  constexpr std::size_t takers = detail::count_gain_takers<C, Gains>();
  static_assert(takers > 0,
                "neither this controller nor a part of it takes such gains, or it is const; a "
                "controller of your own needs set_gains(const Gains&) noexcept, a composition "
                "needs parts");
  static_assert(takers < 2,
                "several controllers take such gains: pass the one that is meant, member<I>()");
  if constexpr (detail::SetsGains<C, Gains>) {
    controller.set_gains(gains);
  } else if constexpr (takers == 1) {
    const auto set = [&](auto& part) noexcept {
      if constexpr (TakesGains<decltype(part), Gains>) set_gains(part, gains);
    };
    std::apply([&](auto&... parts) noexcept { (set(parts), ...); }, C::parts(controller));
  }
}

}  // namespace articula
