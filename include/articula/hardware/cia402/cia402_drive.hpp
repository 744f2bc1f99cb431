// SPDX-License-Identifier: Apache-2.0
/// @file One CiA 402 drive: its node and its units.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/hardware/canopen/canopen.hpp"
#include "articula/hardware/canopen/canopen_object_value.hpp"
#include "articula/model/robot.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace articula {

/// What stops a drive when its host is gone: the program has ended, or the cable is cut.
enum class Cia402Watchdog : unsigned char {
  commands,   ///< RPDOs that stay away: the deadline of object 1400h,5. Not all drives have it.
  heartbeat,  ///< The host's heartbeats that stay away: objects 1016h, 6007h. See host_node.
  none,       ///< Nothing: the drive goes on with its last command until its power is taken.
};

/// One CiA 402 drive: its node and its units, seen from the joint.
struct Cia402Drive {
  std::uint8_t node = 0;      ///< 1 .. 127, no two alike
  double rated_effort = 1;    ///< effort of the joint at 1000 per mille of torque [N m or N]
  double position_scale = 1;  ///< position units per rad or m of the joint; < 0 if they run
                              ///< against it, and then the rated effort is, too
  double velocity_scale = 1;  ///< velocity units per rad/s or m/s of the joint
  std::int32_t zero_position =
      0;  ///< position of the drive where the joint's is 0 [position units]
  Cia402Watchdog watchdog = Cia402Watchdog::commands;  ///< what stops it when the host is gone
  std::uint8_t host_node = canopen::last_node;  ///< node that the host's heartbeats come from, for
                                                ///< Cia402Watchdog::heartbeat
  /// Further objects that activation writes, after its own and before the drive is enabled, such as
  /// 6072h (most torque), 605Ah .. 605Eh (ways to stop), 1006h or 60C2h (the period).
  canopen::ObjectValues objects{};
};

/// Drives in the order of the joints.
template <int N>
using Cia402DriveList = std::array<Cia402Drive, static_cast<std::size_t>(N)>;

/// Refuses drives that cannot drive a robot: nodes out of range or used twice, host nodes that are
/// drives, or differ, scales that are not
/// finite or 0, positions and efforts that do not fit into the objects.
/// @throws std::invalid_argument naming the joint, the value and the limit
/// Real-time: no (throws).
template <Robot R>
void validate(const R& robot, const Cia402DriveList<joint_count<R>>& drives) {
  for (std::size_t j = 0; j < drives.size(); ++j) {
    const Cia402Drive& drive = drives[j];
    const JointProperties& joint = model_of(robot).joints[j];
    const auto refuse = [&](detail::MessageParts parts) {
      detail::refuse({"CiA 402 drive of '", joint.name.view(), "': ", detail::message_of(parts)});
    };
    if (drive.node < 1 || drive.node > canopen::last_node) {
      refuse({"node ", int{drive.node}, " is not within 1 .. ", int{canopen::last_node}});
    }
    for (std::size_t other = 0; other < j; ++other) {
      if (drives[other].node == drive.node) refuse({"node ", int{drive.node}, " is used twice"});
    }
    if (drive.watchdog == Cia402Watchdog::heartbeat) {
      if (drive.host_node < 1 || drive.host_node > canopen::last_node) {
        refuse(
            {"host_node ", int{drive.host_node}, " is not within 1 .. ", int{canopen::last_node}});
      }
      for (const Cia402Drive& other : drives) {
        if (other.node == drive.host_node) {
          refuse({"host_node ", int{drive.host_node}, " is the node of a drive"});
        }
        if (other.watchdog == drive.watchdog && other.host_node != drive.host_node) {
          refuse({"host_node ", int{drive.host_node}, " differs from another drive's ",
                  int{other.host_node}});
        }
      }
    }
    const auto scale = [&](std::string_view what, double value) {
      if (is_finite(value) && value != 0) return;
      refuse({what, " ", value, " is not a number other than 0"});
    };
    scale("rated_effort", drive.rated_effort);
    scale("position_scale", drive.position_scale);
    scale("velocity_scale", drive.velocity_scale);
    const double highest_effort = 32.767 * std::abs(drive.rated_effort);  // 16 bits of per mille
    if (is_finite(joint.limits.effort) && !(joint.limits.effort <= highest_effort)) {
      refuse({"the joint's effort limit ", joint.limits.effort, " N m is above the ",
              highest_effort, " N m that a frame can carry"});
    }
    for (const double limit : {joint.limits.lower, joint.limits.upper}) {
      if (!is_finite(limit)) continue;
      const double units = std::abs(limit * drive.position_scale + drive.zero_position);
      if (units <= 2147483647.0) continue;
      refuse({"the joint's limit ", limit, " is ", units,
              " position units, above the 2147483647 that a frame can carry"});
    }
  }
}

}  // namespace articula
