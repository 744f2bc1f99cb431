// SPDX-License-Identifier: Apache-2.0
/// @file One CiA 402 drive: its node and its units.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/hardware/canopen.hpp"
#include "articula/model/robot.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <stdexcept>

namespace articula {

/// One CiA 402 drive: its node and its units, seen from the joint.
struct Cia402Drive {
  std::uint8_t node = 0;      ///< 1 .. 127, no two alike
  double rated_effort = 1;    ///< effort of the joint at 1000 per mille of torque [N m or N]
  double position_scale = 1;  ///< position units per rad or m of the joint; < 0 if they run
                              ///< against it, and then the rated effort is, too
  double velocity_scale = 1;  ///< velocity units per rad/s or m/s of the joint
  std::int32_t zero_position =
      0;  ///< position of the drive where the joint's is 0 [position units]
};

/// Drives in the order of the joints.
template <int N>
using Cia402DriveList = std::array<Cia402Drive, static_cast<std::size_t>(N)>;

/// Refuses drives that cannot drive a robot: nodes out of range or used twice, scales that are not
/// finite or 0, positions and efforts that do not fit into the objects.
/// @throws std::invalid_argument naming the joint, the value and the limit
/// Real-time: no (throws).
template <Robot R>
void validate(const R& robot, const Cia402DriveList<joint_count<R>>& drives) {
  for (std::size_t j = 0; j < drives.size(); ++j) {
    const Cia402Drive& drive = drives[j];
    const JointProperties& joint = model_of(robot).joints[j];
    const auto require = [&](bool condition, const auto&... parts) {
      if (condition) return;
      std::ostringstream message;
      message << "CiA 402 drive of '" << joint.name.view() << "': ";
      (message << ... << parts);
      throw std::invalid_argument(message.str());
    };
    require(drive.node >= 1 && drive.node <= canopen::last_node, "node ", int{drive.node},
            " is not within 1 .. ", int{canopen::last_node});
    for (std::size_t other = 0; other < j; ++other) {
      require(drives[other].node != drive.node, "node ", int{drive.node}, " is used twice");
    }
    const auto scale = [&](const char* what, double value) {
      require(is_finite(value) && value != 0, what, " ", value, " is not a number other than 0");
    };
    scale("rated_effort", drive.rated_effort);
    scale("position_scale", drive.position_scale);
    scale("velocity_scale", drive.velocity_scale);
    const double highest_effort = 32.767 * std::abs(drive.rated_effort);  // 16 bits of per mille
    require(!is_finite(joint.limits.effort) || joint.limits.effort <= highest_effort,
            "the joint's effort limit ", joint.limits.effort, " N m is above the ", highest_effort,
            " N m that a frame can carry");
    for (const double limit : {joint.limits.lower, joint.limits.upper}) {
      if (!is_finite(limit)) continue;
      const double units = std::abs(limit * drive.position_scale + drive.zero_position);
      require(units <= 2147483647.0, "the joint's limit ", limit, " is ", units,
              " position units, above the 2147483647 that a frame can carry");
    }
  }
}

}  // namespace articula
