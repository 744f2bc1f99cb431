// SPDX-License-Identifier: Apache-2.0
/// @file The names of the types of joints, as URDF writes them.
#pragma once

#include "articula/model/joint.hpp"

#include <string_view>

namespace articula {

/// @param type  of a joint
/// @return      its name in a URDF and in the source: `revolute`, `continuous`, `prismatic`,
///              `fixed`
/// Real-time: yes.
[[nodiscard]] constexpr std::string_view to_string(JointType type) noexcept {
  switch (type) {
    case JointType::revolute:
      return "revolute";
    case JointType::continuous:
      return "continuous";
    case JointType::prismatic:
      return "prismatic";
    case JointType::fixed:
      break;
  }
  return "fixed";
}

}  // namespace articula
