// SPDX-License-Identifier: Apache-2.0
/// @file The description of one CiA 402 drive: node, units and watchdog.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/hardware/can/drive_checks.hpp"
#include "articula/hardware/canopen/canopen.hpp"
#include "articula/hardware/canopen/canopen_object_value.hpp"
#include "articula/model/robot.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace articula {

/// The mechanism that stops a drive when its host is gone: the program has ended, or the cable is
/// cut.
enum class Cia402Watchdog : unsigned char {
  commands,   ///< The deadline for RPDOs, object 1400h,5. Not all drives have it.
  heartbeat,  ///< The host's heartbeats: objects 1016h and 6007h. See host_node.
  none,       ///< None: the drive follows its last command until its power is switched off.
};

/// One CiA 402 drive. All units are seen from the joint.
struct Cia402Drive {
  std::uint8_t node = 0;      ///< 1 .. 127, different for each drive
  double rated_effort = 1;    ///< effort of the joint at 1000 per mille of torque [N m or N]
  double position_scale = 1;  ///< position units per rad or m of the joint; negative if they count
                              ///< against it, and then rated_effort is negative, too
  double velocity_scale = 1;  ///< velocity units per rad/s or m/s of the joint
  std::int32_t zero_position = 0;  ///< the drive's position at joint position 0 [position units]
  Cia402Watchdog watchdog = Cia402Watchdog::commands;
  std::uint8_t host_node = canopen::last_node;  ///< node number of the host's heartbeats, for
                                                ///< Cia402Watchdog::heartbeat
  /// Further objects that activation writes before the drive is enabled, such as 6072h (maximum
  /// torque), 605Ah .. 605Eh (stop options), 1006h or 60C2h (the period).
  canopen::ObjectValues objects{};

  // The joint's figures in the drive's units, and back. Real-time: yes.
  [[nodiscard]] constexpr double position_units(double position) const noexcept {
    return position * position_scale + zero_position;
  }
  [[nodiscard]] constexpr double position(double units) const noexcept {
    return (units - zero_position) / position_scale;
  }
  [[nodiscard]] constexpr double velocity_units(double velocity) const noexcept {
    return velocity * velocity_scale;
  }
  [[nodiscard]] constexpr double velocity(double units) const noexcept {
    return units / velocity_scale;
  }
  [[nodiscard]] constexpr double per_mille(double effort) const noexcept {
    return effort / rated_effort * 1e3;
  }
  [[nodiscard]] constexpr double effort(double per_mille) const noexcept {
    return per_mille * rated_effort / 1e3;
  }
};

/// Drives in the order of the joints.
template <int N>
using Cia402DriveList = std::array<Cia402Drive, static_cast<std::size_t>(N)>;

/// Checks the drives of a robot: nodes, host nodes, scales, and the range of positions and efforts.
/// @throws std::invalid_argument with the joint, the value and the limit
/// Real-time: no (throws).
template <Robot R>
void validate(const R& robot, const Cia402DriveList<joint_count<R>>& drives) {
  for (std::size_t j = 0; j < drives.size(); ++j) {
    const Cia402Drive& drive = drives[j];
    const detail::DriveChecks check{"CiA 402 drive", model_of(robot).joints[j]};
    check.nodes(drives, j, canopen::last_node);
    if (drive.watchdog == Cia402Watchdog::heartbeat) {
      check.node("host_node", drive.host_node, canopen::last_node);
      for (const Cia402Drive& other : drives) {
        if (other.node == drive.host_node) {
          check.refuse({"host_node ", int{drive.host_node}, " is the node of a drive"});
        }
        if (other.watchdog == drive.watchdog && other.host_node != drive.host_node) {
          check.refuse({"host_node ", int{drive.host_node}, " differs from another drive's ",
                        int{other.host_node}});
        }
      }
    }
    check.scale("rated_effort", drive.rated_effort);
    check.scale("position_scale", drive.position_scale);
    check.scale("velocity_scale", drive.velocity_scale);
    constexpr double most_per_mille = 32767;  // 16 bits
    if (is_finite(check.joint.limits.effort)) check.effort(std::abs(drive.effort(most_per_mille)));
    check.position([&](double q) { return drive.position_units(q); }, 2147483647, "position units");
  }
}

}  // namespace articula
