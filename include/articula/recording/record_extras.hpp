// SPDX-License-Identifier: Apache-2.0
/// @file Mimic joints and link poses in a recording.
#pragma once

#include "articula/dynamics/forward_kinematics.hpp"
#include "articula/dynamics/moving_joints.hpp"
#include "articula/model/robot.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace articula {

/// What a sink writes in addition to the commanded joints:
///
///     CsvWriter<Q2d, EffortCommand<2>> csv("motion.csv", {.links = {"tool_link"}});
struct RecordContents {
  bool mimic_joints = true;  ///< position and velocity of each joint that mimics another one
  std::vector<std::string> links{};  ///< links whose poses in the root link's frame are written
};

/// A joint that mimics another one.
struct MimicJoint {
  std::string name{};
  bool slides = false;  ///< whether it is prismatic
  int index = 0;        ///< of the joint in moving_joint_names()
};

/// A link whose pose is recorded.
struct RecordedLink {
  std::string name{};
  LinkIndex index{};
};

/// The mimic joints of a robot and the recorded links, found by name once.
/// @tparam R  the robot
template <Robot R>
struct RecordExtras {
  std::vector<MimicJoint> mimic_joints{};  ///< in the order of moving_joint_names()
  std::vector<RecordedLink> links{};       ///< in the order of RecordContents

  /// @throws std::invalid_argument if the robot has no link of a name; the message lists its links
  /// Real-time: no (allocates, throws).
  RecordExtras(const R& robot, const RecordContents& contents) {
    for (const std::string& link : contents.links) {
      links.push_back({link, link_index(robot, link)});
    }
    if (!contents.mimic_joints || moving_joint_count<R> == joint_count<R>) return;
    const auto& model = model_of(robot);
    for (std::size_t i = 0; i < model.moving_joints.size(); ++i) {
      const int followed = model.mechanism.couplings[i].joint;
      if (model.moving_joints[i] == model.joints[followed].name) continue;
      mimic_joints.push_back({std::string(model.moving_joints[i].view()),
                              model.mechanism.bodies[i].prismatic, static_cast<int>(i)});
    }
  }
};

}  // namespace articula
