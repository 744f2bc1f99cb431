// SPDX-License-Identifier: Apache-2.0
/// @file Robot models from URDF at run time. Needs the CMake target articula::urdf (urdfdom).
#pragma once

#include "articula/model/build_model.hpp"
#include "articula/urdf/read_urdf.hpp"

#include <string>
#include <vector>

namespace articula {

namespace detail {

/// @throws FileError with the right size if a robot has not this number of joints and bodies
inline void check_size(const UrdfContents& robot, int n, int bodies) {
  const ModelSize size = model_size(robot.joints);
  if (size.joints == n && size.bodies == bodies) return;
  std::string joints, mimics;
  for (const Joint& joint : robot.joints) {
    if (joint.type == JointType::fixed) continue;
    std::string& list = joint.mimic.joint.empty() ? joints : mimics;
    list += (list.empty() ? "" : ", ") + std::string(joint.name);
  }
  const auto arguments = [](int count, int moving) {
    return "<" + std::to_string(count) + (count == moving ? "" : ", " + std::to_string(moving)) +
           ">";
  };
  throw FileError(robot.file, "robot '" + std::string(robot.name) + "': it has " +
                                  std::to_string(size.joints) + " joints: " + joints +
                                  (mimics.empty() ? "" : "; and mimic joints: " + mimics) +
                                  "; load it with " + arguments(size.joints, size.bodies) +
                                  ", not " + arguments(n, bodies));
}

template <int N, int Bodies, bool Kinematic>
[[nodiscard]] auto model_of_urdf(const UrdfContents& robot) {
  check_size(robot, N, Bodies);
  return build_model<N, Bodies, Kinematic>(robot.name, robot.gravity, robot.links, robot.joints,
                                           std::vector<LinkFrame>(robot.links.size()),
                                           robot.right_angle_tolerance);
}

}  // namespace detail

/// Makes the model of a description.
/// @tparam N       number of joints that can be commanded
/// @tparam Bodies  number of moving bodies: N and one for each mimic joint
/// @throws FileError if the robot has another size (the message gives it) or is kinematic
/// Real-time: no (allocates, throws).
template <int N, int Bodies = N>
[[nodiscard]] Model<N, Bodies> load_urdf(const UrdfDescription& description) {
  if (description->kinematic) {
    throw FileError(description->file,
                    "it was read without masses: use load_kinematic_urdf, or read it without "
                    "UrdfOptions::kinematic");
  }
  return detail::model_of_urdf<N, Bodies, false>(*description);
}

/// Makes the model of a description without its masses, see KinematicModel.
/// @copydetails load_urdf(const UrdfDescription&)
template <int N, int Bodies = N>
[[nodiscard]] KinematicModel<N, Bodies> load_kinematic_urdf(const UrdfDescription& description) {
  return detail::model_of_urdf<N, Bodies, true>(*description);
}

/// Loads a robot:
///
///     const auto arm = articula::load_urdf<7>("panda.urdf", {.locked = {"panda_finger_joint1"}});
///     articula::gravity(arm, q);
///
/// Fixed and locked joints are welded. Mimic joints follow the joint that they mimic. Joints are
/// ordered depth first, siblings by name. For transmissions, initial values and notices, see
/// read_urdf. For a robot known at build time, use articula_add_robot: its dynamics are faster.
/// @tparam N       number of joints that can be commanded
/// @tparam Bodies  number of moving bodies: N and one for each mimic joint
/// @param source   a file's name or path, or XML: a string that begins with '<'
/// @param options  the part of the robot, locked joints, accepted faults, gravity
/// @throws FileError with file, element, reason and figures if the file is invalid, the robot is
///         not physical or has another size
/// Real-time: no (reads a file, allocates, throws).
template <int N, int Bodies = N>
[[nodiscard]] Model<N, Bodies> load_urdf(const UrdfSource& source,
                                         const UrdfOptions& options = {}) {
  return load_urdf<N, Bodies>(read_urdf(source, options));
}

/// Loads a robot without masses, which many files lack. All <inertial> are skipped.
///
///     const auto arm = articula::load_kinematic_urdf<6>("scara.urdf");
///     articula::forward_kinematics(arm, q, "tool");
///
/// Kinematics, profiles, loops of positions and velocities, and mocks accept such a robot.
/// Functions that need dynamics do not compile with it.
/// @copydetails load_urdf(const UrdfSource&, const UrdfOptions&)
template <int N, int Bodies = N>
[[nodiscard]] KinematicModel<N, Bodies> load_kinematic_urdf(const UrdfSource& source,
                                                            UrdfOptions options = {}) {
  options.kinematic = true;
  return load_kinematic_urdf<N, Bodies>(read_urdf(source, options));
}

}  // namespace articula
