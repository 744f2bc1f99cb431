// SPDX-License-Identifier: Apache-2.0
/// @file A CMake project that compiles the loop which `articula run` makes from the same files.
#pragma once

#include "files/controllers_file.hpp"
#include "files/drives_file.hpp"
#include "files/joint_groups.hpp"

#include <articula/urdf/description.hpp>
#include <articula/urdf/xml/source.hpp>

#include <map>
#include <string>
#include <vector>

namespace terminal {

/// What moves a robot.
enum class Mover : unsigned char { simulation, mock, drives };

/// The robot of a URDF, with the chain and the gravity of its controllers' file. Mocks, and drives
/// of positions and velocities, need no masses: without valid ones the robot is kinematic, and a
/// notice has the reason.
/// @throws articula::FileError as read_urdf
[[nodiscard]] articula::UrdfDescription read_robot(const articula::UrdfSource& source,
                                                   const ControllersPlan& plan,
                                                   bool allows_unphysical, Mover mover);

/// What a project is made of.
struct ProjectOptions {
  std::string robot{};  ///< name of the robot's file
  std::string urdf{};   ///< the URDF
  ControllersPlan controllers{};
  std::vector<PlannedGroup> groups{};  ///< at least one
  bool allows_unphysical = false;
  bool is_kinematic = false;  ///< the robot has no valid masses
  bool is_mock = false;
  PlannedDrives drives{};  ///< on a CAN bus; by default a simulation or the mock is in their place
};

/// A project: the name of its program, and its files by name.
struct Project {
  std::string name{};
  std::map<std::string, std::string> files{};
};

/// The first lines of a project's CMakeLists.txt: its name, the package, and the robot of
/// robot.urdf.
/// @param type        of the robot
/// @param components  of the package
[[nodiscard]] std::string project_lines(const std::string& program, const std::string& components,
                                        const std::string& type, const ControllersPlan& plan,
                                        bool allows_unphysical, bool is_kinematic);

/// @throws Refusal if the controllers' file cannot be read
[[nodiscard]] Project make_project(const ProjectOptions& options);

/// Writes the files of a project into a folder, which is made if it is not there.
/// @throws Refusal if that is not possible
void write_project(const Project& project, const std::string& folder);

}  // namespace terminal
