// SPDX-License-Identifier: Apache-2.0
/// @file The compiler's error message for a link that a robot does not have.
#pragma once

#include "articula/model/physical_check.hpp"
#include "articula/model/robot.hpp"

#include <cstddef>
#include <utility>

namespace articula::detail {

/// Its instantiation is the error message for a link that the robot does not have.
/// @tparam R      the robot
/// @tparam Asked  the requested name
/// @tparam Links  the names of its links
template <class R, class Asked, class... Links>
struct RobotHasNoLink {
  static_assert(!Robot<R>,
                "articula: the robot has no link of that name. The first template argument of "
                "RobotHasNoLink is the robot, the second is the requested name, the others are the "
                "names of its links.");
};

/// Whether a robot has a link of a name.
template <Name Link, DescribedRobot R>
[[nodiscard]] consteval bool has_link() {
  for (const auto& link : model_of(R{}).links) {
    if (link.name == Link) return true;
  }
  return false;
}

/// Instantiates the message. (Deduced arguments are printed as values, given ones as expressions.)
template <class R, class Asked, class... Links>
constexpr void print_names(Asked, Links...) {
  static_cast<void>(RobotHasNoLink<R, Asked, Links...>());
}

/// Causes the compiler's error message, with the names of the robot's links.
template <Name Link, DescribedRobot R>
constexpr void reject_link() {
  constexpr const auto& links = model_of(R{}).links;
  []<std::size_t... I>(std::index_sequence<I...>) {
    print_names<R>(printable<Link>(), printable<links[I].name>()...);
  }(std::make_index_sequence<links.size()>());
}

}  // namespace articula::detail
