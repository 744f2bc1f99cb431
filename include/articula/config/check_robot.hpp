// SPDX-License-Identifier: Apache-2.0
/// @file Checks that a controller's configuration fits a robot.
#pragma once

#include "articula/config/read/controller_config.hpp"
#include "articula/config/read/robot_joints.hpp"
#include "articula/model/robot.hpp"
#include "articula/text/characters.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/numbers.hpp"
#include "articula/text/similar_word.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// The joints of a configuration in the order of the robot's; nullptr for a joint that is missing.
/// @throws FileError if the robot lacks a joint
template <Robot R>
[[nodiscard]] std::array<const ConfiguredJoint*, static_cast<std::size_t>(joint_count<R>)>
arranged_joints(const ControllerConfig& config, const R& robot) {
  std::array<const ConfiguredJoint*, static_cast<std::size_t>(joint_count<R>)> arranged{};
  const RobotJoints joints = joints_of(robot);
  for (const ConfiguredJoint& joint : config.joints) {
    arranged[joints.index(joint.name, joint.place)] = &joint;
  }
  return arranged;
}

/// @throws FileError about a joint that the configuration lacks
template <Robot R>
[[noreturn]] void refuse_missing(const ControllerConfig& config, const R& robot, std::size_t joint,
                                 const std::string& what) {
  throw FileError(config.place,
                  robot_text(robot) + " has the joint '" + std::string(joint_names(robot)[joint]) +
                      "', which is missing",
                  what + " for each of its " + std::to_string(joint_count<R>) + " joints");
}

/// @throws FileError if the robot has no such link
template <Robot R>
[[nodiscard]] const LinkFrame& link_of_chain(const R& robot, const std::string& name,
                                             const FilePlace& place) {
  std::vector<std::string_view> names;
  for (const LinkFrame& link : model_of(robot).links) {
    if (link.name.view() == name) return link;
    names.push_back(link.name.view());
  }
  throw FileError(place, robot_text(robot) + " has no link '" + shown(name) + "'",
                  one_of_words(name, names));
}

/// @throws FileError if the chain's root moves, or the chain leaves out a joint of the configuration
template <Robot R>
void check_chain(const ControllerConfig& config, const R& robot) {
  const std::string &root = config.chain_root, &tip = config.chain_tip;
  if (!root.empty() && link_of_chain(robot, root, config.chain_root_place).body >= 0) {
    throw FileError(config.chain_root_place, "the link '" + shown(root) + "' moves",
                    "a link of the base of " + robot_text(robot));
  }
  if (tip.empty()) return;
  const auto& model = model_of(robot);
  std::vector<std::string_view> chain;  // its joints
  int body = link_of_chain(robot, tip, config.chain_tip_place).body;
  while (body >= 0) {
    chain.push_back(model.moving_joints[static_cast<std::size_t>(body)].view());
    body = model.mechanism.bodies[static_cast<std::size_t>(body)].parent;
  }
  for (const ConfiguredJoint& joint : config.joints) {
    if (std::find(chain.begin(), chain.end(), joint.name) != chain.end()) continue;
    throw FileError(config.chain_tip_place,
                    "the chain to '" + shown(tip) + "' of " + robot_text(robot) +
                        " leaves joint '" + shown(joint.name) + "' out",
                    "a tip beyond all joints");
  }
}

/// @throws FileError if the file's gravity is not the robot's
template <Robot R>
void check_gravity(const ControllerConfig& config, const R& robot) {
  if (!config.gravity) return;
  constexpr double tolerance = 1e-9;  // rounding of decimal numbers and of a rotation [m/s^2]
  Vector3<double> gravity = *config.gravity;
  if (!config.chain_root.empty()) {
    gravity = link_of_chain(robot, config.chain_root, config.chain_root_place).placement.rotation *
              gravity;
  }
  const Vector3<double> own = model_of(robot).mechanism.gravity;
  const Vector3<double> error = gravity - own;
  if (std::hypot(error.x, error.y, error.z) <= tolerance) return;
  const auto text = [](const Vector3<double>& v) {
    return "(" + rounded_text(v.x) + ", " + rounded_text(v.y) + ", " + rounded_text(v.z) + ")";
  };
  throw FileError(config.gravity_place,
                  "gravity " + text(*config.gravity) + " m/s^2 is not that of " + robot_text(robot),
                  text(own) + " in the frame of its base, or a robot with the file's gravity");
}

}  // namespace articula::detail
