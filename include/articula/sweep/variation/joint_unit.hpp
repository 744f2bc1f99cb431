// SPDX-License-Identifier: Apache-2.0
/// @file Units of quantities of joints that rotate or translate.
#pragma once

#include "articula/model/joint.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace articula::detail {

/// The unit of a quantity of some joints: "rad", "m", or "rad or m" if both kinds are among them.
/// @param angular  unit of the quantity for a joint that rotates, such as "rad" or "1"
/// @param joints   if there are none, the quantity is not of joints
/// Real-time: no (allocates).
[[nodiscard]] inline std::string joint_unit(std::string_view angular,
                                            std::span<const JointType> joints) {
  constexpr auto linear = std::to_array<std::pair<std::string_view, std::string_view>>(
      {{"rad", "m"}, {"rad/s", "m/s"}, {"N m", "N"}, {"kg m^2", "kg"}});
  const auto found = std::ranges::find(linear, angular, &decltype(linear)::value_type::first);
  const auto translating = std::ranges::count(joints, JointType::prismatic);
  if (found == linear.end() || translating == 0) return std::string(angular);
  const std::string unit(found->second);
  return translating == std::ssize(joints) ? unit : std::string(angular) + " or " + unit;
}

}  // namespace articula::detail
