// SPDX-License-Identifier: Apache-2.0
/// @file The drives of a robot on a CAN bus, as a configuration file describes them.
#pragma once

#include "files/controllers_file.hpp"

#include <articula/urdf/description.hpp>

#include <string>
#include <vector>

namespace terminal {

/// One drive, as the initialiser of its struct in C++.
struct PlannedDrive {
  std::string joint{};
  std::string code{};  ///< as "{.node = 1, .rated_effort = 30}"
};

/// The drives of a robot in the order of its joints, and the types for them.
struct PlannedDrives {
  std::string interface{};  ///< of the CAN bus, as "can0"; empty: there is no bus
  std::string header{};     ///< of the codec
  std::string codec{};      ///< a template over the robot
  std::string list{};       ///< of the descriptions, a template over the number of joints
  bool commands_efforts_only = false;
  std::vector<PlannedDrive> drives{};
};

/// Reads the section `can_drives` of a file: the protocol, and for each joint the figures of
/// Cia402Drive or QuanserModule by their names.
///
///     can_drives:
///       ros__parameters:
///         protocol: cia402
///         shoulder: {node: 1, rated_effort: 30.0, position_scale: 166886.1, velocity_scale: 1.0e6}
///
/// @param plan       controllers of the file, which say what the drives are commanded
/// @param interface  of the bus
/// @throws articula::FileError with place, value and what was expected
[[nodiscard]] PlannedDrives read_drives(const ControllersPlan& plan, const std::string& interface,
                                        const articula::UrdfDescription& robot);

}  // namespace terminal
