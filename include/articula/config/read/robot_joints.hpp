// SPDX-License-Identifier: Apache-2.0
/// @file The joints of a robot by name, and checks that a configuration fits the robot.
#pragma once

#include "articula/config/read/controller_config.hpp"
#include "articula/config/yaml/scalar.hpp"
#include "articula/core/joint_array.hpp"
#include "articula/model/robot.hpp"
#include "articula/text/characters.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/numbers.hpp"
#include "articula/text/similar_word.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

template <Robot R>
[[nodiscard]] std::string robot_text(const R& robot) {
  return "robot '" + std::string(model_of(robot).name.view()) + "'";
}

struct RobotJoints {
  std::string robot{};                          ///< the robot's name in messages
  std::vector<std::string> names{};             ///< of joints that take commands, in their order
  std::map<std::string, std::string> others{};  ///< joints that take none, and why

  [[nodiscard]] bool has(std::string_view name) const {
    return std::find(names.begin(), names.end(), name) != names.end();
  }
  /// The index of a joint.
  /// @throws FileError if there is no such joint, or if it takes no commands
  [[nodiscard]] std::size_t index(const std::string& name, const FilePlace& place) const {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    const auto other = others.find(name);
    throw FileError(place,
                    other == others.end()
                        ? robot + " has no joint '" + shown(name) + "'"
                        : "joint '" + shown(name) + "' of " + robot + " " + other->second,
                    one_of_words(name, names) + value_hint(name));
  }
};

template <Robot R>
[[nodiscard]] RobotJoints joints_of(const R& robot) {
  RobotJoints joints{.robot = robot_text(robot)};
  const auto& model = model_of(robot);
  for (const auto& joint : model.joints) joints.names.emplace_back(joint.name.view());
  for (const LinkFrame& link : model.links) {
    if (!link.carrier.empty()) joints.others.emplace(link.carrier.view(), "is fixed");
  }
  for (std::size_t body = 0; body < model.moving_joints.size(); ++body) {
    if (joints.has(model.moving_joints[body].view())) continue;
    const Name& followed = model.joints[model.mechanism.couplings[body].joint].name;
    joints.others[std::string(model.moving_joints[body].view())] =
        "mimics '" + std::string(followed.view()) + "'";
  }
  return joints;
}

/// The joints of a configuration in the order of the robot's; nullptr for a joint that is missing.
/// @throws FileError if the robot lacks a joint
template <Robot R>
[[nodiscard]] JointArray<const ConfiguredJoint*, joint_count<R>> arranged_joints(
    const ControllerConfig& config, const R& robot) {
  JointArray<const ConfiguredJoint*, joint_count<R>> arranged{};
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

/// @throws FileError if the chain's root moves, or the chain leaves out a joint of the
///         configuration
template <Robot R>
void check_chain(const ControllerConfig& config, const R& robot) {
  const std::string &root = config.chain_root, &tip = config.chain_tip;
  if (!root.empty() && link_of_chain(robot, root, config.places.at("root")).body >= 0) {
    throw FileError(config.places.at("root"), "the link '" + shown(root) + "' moves",
                    "a link of the base of " + robot_text(robot));
  }
  if (tip.empty()) return;
  const auto& model = model_of(robot);
  std::vector<std::string_view> chain;  // its joints
  for (int body = link_of_chain(robot, tip, config.places.at("tip")).body; body >= 0;
       body = model.mechanism.bodies[body].parent) {
    chain.push_back(model.moving_joints[body].view());
  }
  for (const ConfiguredJoint& joint : config.joints) {
    if (std::find(chain.begin(), chain.end(), joint.name) != chain.end()) continue;
    throw FileError(config.places.at("tip"),
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
    gravity = link_of_chain(robot, config.chain_root, config.places.at("root")).placement.rotation *
              gravity;
  }
  const Vector3<double> own = model_of(robot).mechanism.gravity;
  const Vector3<double> error = gravity - own;
  if (std::hypot(error.x, error.y, error.z) <= tolerance) return;
  const auto text = [](const Vector3<double>& v) {
    return "(" + rounded_text(v.x) + ", " + rounded_text(v.y) + ", " + rounded_text(v.z) + ")";
  };
  throw FileError(config.places.at("gravity"),
                  "gravity " + text(*config.gravity) + " m/s^2 is not that of " + robot_text(robot),
                  text(own) + " in the frame of its base, or a robot with the file's gravity");
}

}  // namespace articula::detail
