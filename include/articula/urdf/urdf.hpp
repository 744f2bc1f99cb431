// SPDX-License-Identifier: Apache-2.0
/// @file Robots from URDF at run time. Needs the CMake target articula::urdf (urdfdom).
#pragma once

#include "articula/model/build_model.hpp"
#include "articula/urdf/description.hpp"

#include <string>
#include <vector>

namespace articula {

namespace detail {

/// How many joints, and which, for the message that another number was asked for.
[[nodiscard]] inline std::string size_text(const UrdfDescription& description, int n, int bodies) {
  const ModelSize size = model_size(description.joints);
  std::string joints, mimics;
  for (const Joint& joint : description.joints) {
    if (joint.type == JointType::fixed) continue;
    std::string& list = joint.mimic.joint.empty() ? joints : mimics;
    list += (list.empty() ? "" : ", ") + std::string(joint.name.view());
  }
  const auto sizes = [](int count, int moving) {
    return std::to_string(count) + (count == moving ? "" : ", " + std::to_string(moving));
  };
  std::string text = "robot '" + std::string(description.name.view()) + "': it has " +
                     std::to_string(size.joints) + " joints: " + joints;
  if (!mimics.empty()) text += "; and joints that mimic one of them: " + mimics;
  return text + "; <" + sizes(n, bodies) + "> was asked for, <" + sizes(size.joints, size.bodies) +
         "> is right";
}

/// The model of a description, of either kind.
template <int N, int Bodies, bool Kinematic>
[[nodiscard]] Model<N, Bodies, std::vector<LinkFrame>, Kinematic> any_model_of_urdf(
    const UrdfDescription& description) {
  const ModelSize size = model_size(description.joints);
  if (size.joints != N || size.bodies != Bodies) {
    throw UrdfError(description.file, size_text(description, N, Bodies));
  }
  const DescriptionFault fault =
      find_fault(description.name, description.gravity, description.links, description.joints,
                 description.allow_unphysical,  // what was changed since it was read is not known
                 Kinematic);
  if (fault.rule != Rule::none) {
    throw UrdfError(description.file, fault_text(fault, description.links, description.joints));
  }
  return build_model<N, Bodies, Kinematic>(
      description.name, description.gravity, description.links, description.joints,
      std::vector<LinkFrame>(description.links.size()), description.right_angle_tolerance);
}

}  // namespace detail

/// The model of a description read from URDF.
/// @tparam N       number of joints that can be commanded
/// @tparam Bodies  number of moving bodies: N and one for each mimic joint
/// @throws UrdfError if the robot is of another size (it says which), if its description is
///         kinematic, or if the description was changed so that it breaks a Rule
/// Real-time: no (allocates, throws).
template <int N, int Bodies = N>
[[nodiscard]] Model<N, Bodies> model_of_urdf(const UrdfDescription& description) {
  if (description.kinematic) {
    throw UrdfError(description.file,
                    "it was read as kinematic, without masses: call load_kinematic_urdf or "
                    "kinematic_model_of_urdf, or read it without UrdfOptions::kinematic");
  }
  return detail::any_model_of_urdf<N, Bodies, false>(description);
}

/// The model of a description of which the masses do not count, see KinematicModel.
/// @copydetails model_of_urdf
template <int N, int Bodies = N>
[[nodiscard]] KinematicModel<N, Bodies> kinematic_model_of_urdf(
    const UrdfDescription& description) {
  return detail::any_model_of_urdf<N, Bodies, true>(description);
}

/// Loads a robot:
///
///     const auto arm = articula::load_urdf<7>("panda.urdf", {.locked = {"panda_finger_joint1"}});
///     articula::gravity(arm, q);
///
/// Fixed and locked joints are welded, mimic joints follow theirs, joints stand depth first and
/// siblings by name. Transmissions and what else a file tells is in read_urdf's result.
/// @tparam N       number of joints that can be commanded
/// @tparam Bodies  number of moving bodies: N and one for each mimic joint
/// @param source   a file's name or path, or XML: a string that begins with '<'
/// @param options  which part to read, and how strictly
/// @throws UrdfError with file, element, reason and figures if the file is broken, not physical or
///         of another size
/// Real-time: no (reads a file, allocates, throws).
template <int N, int Bodies = N>
[[nodiscard]] Model<N, Bodies> load_urdf(const UrdfSource& source,
                                         const UrdfOptions& options = {}) {
  return model_of_urdf<N, Bodies>(read_urdf(source, options));
}

/// Loads a robot whose masses are not known, or not needed: many files have none. Masses and
/// inertias of the file do not count.
///
///     const auto arm = articula::load_kinematic_urdf<6>("scara.urdf");
///     articula::forward_kinematics(arm, q, "tool");
///
/// Kinematics, profiles, loops of positions and velocities, and mocks take it. What needs dynamics
/// does not compile with it.
/// @copydetails load_urdf
template <int N, int Bodies = N>
[[nodiscard]] KinematicModel<N, Bodies> load_kinematic_urdf(const UrdfSource& source,
                                                            UrdfOptions options = {}) {
  options.kinematic = true;
  return kinematic_model_of_urdf<N, Bodies>(read_urdf(source, options));
}

}  // namespace articula
