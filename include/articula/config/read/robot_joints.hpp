// SPDX-License-Identifier: Apache-2.0
/// @file The joints of a robot by name, for messages about files.
#pragma once

#include "articula/config/yaml/scalar.hpp"
#include "articula/model/joint.hpp"
#include "articula/model/robot.hpp"
#include "articula/text/characters.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/similar_word.hpp"

#include <algorithm>
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

/// The joints of a robot.
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
    const auto followed = static_cast<std::size_t>(model.mechanism.couplings[body].joint);
    joints.others[std::string(model.moving_joints[body].view())] =
        "mimics '" + joints.names[followed] + "'";
  }
  return joints;
}

}  // namespace articula::detail
