// SPDX-License-Identifier: Apache-2.0
/// @file Where a link of a robot is.
#pragma once

#include <array>
#include <string>

namespace articula::remote {

/// The placement of a link in the root link's frame.
struct LinkPose {
  std::string link{};
  std::array<double, 3> translation{};         ///< [m]
  std::array<double, 4> rotation{0, 0, 0, 1};  ///< unit quaternion x, y, z, w
};

}  // namespace articula::remote
