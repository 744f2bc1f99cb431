// SPDX-License-Identifier: Apache-2.0
/// @file A robot as a value: its mechanism, the properties of its joints, the frames of its links.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/core/name.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/joint.hpp"
#include "articula/model/mechanism.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace articula {

/// The frame of a link: its moving body, and its placement on that body.
struct LinkFrame {
  Name name{};
  int body = -1;                  ///< index of the moving body; -1 for the fixed base
  Placement<double> placement{};  ///< in the frame of the body or of the base
  Name carrier{};                 ///< the joint of which it is the child; empty for the root
};

/// A robot as a value, made from a description by build_model. Its parts depend on each other: to
/// change a figure, build another model.
/// @tparam N           number of joints that can be commanded: those that move and mimic no other
/// @tparam Bodies      number of moving bodies: N and one for each mimic joint
/// @tparam LinkFrames  container of LinkFrame: an array where the robot is known at compile time
/// @tparam Kinematic   whether its masses are not known, see KinematicModel
template <int N, int Bodies = N, class LinkFrames = std::vector<LinkFrame>, bool Kinematic = false>
struct Model {
  static constexpr int joint_count = N;
  static constexpr int body_count = Bodies;
  static constexpr bool kinematic = Kinematic;

  Name name{};
  Mechanism<N, Bodies> mechanism{};  ///< the bodies as described; link frames refer to it
  Mechanism<N, Bodies> canonical{};  ///< an equivalent one with shorter equations of motion
  JointArray<JointProperties, N> joints{};
  /// Names of the joints of the bodies, mimic joints included
  JointArray<Name, Bodies> moving_joints{};
  LinkFrames links{};  ///< all links of the description, welded ones included
};

/// A Model of a robot whose masses are not known. Kinematics, profiles, loops of positions and
/// velocities, and mocks accept it. Functions that need dynamics do not compile with it.
template <int N, int Bodies = N, class LinkFrames = std::vector<LinkFrame>>
using KinematicModel = Model<N, Bodies, LinkFrames, true>;

namespace detail {

/// "a, b, c": the names of a range's elements.
template <class Elements>
[[nodiscard]] std::string listed_names(const Elements& elements) {
  std::string list;
  for (const auto& element : elements) {
    list.append(list.empty() ? "" : ", ").append(element.name.view());
  }
  return list;
}

/// The reason why a name is not that of a joint that can be commanded: the joint mimics another, is
/// fixed, or does not exist.
/// @param model  from build_model
/// @param name   of none of its joints
/// @return       one line with the robot, the name and the names that exist
template <class AnyModel>
[[nodiscard]] std::string no_such_joint_text(const AnyModel& model, std::string_view name) {
  const std::string robot = message_of({"robot '", model.name.view(), "'"});
  const std::string joint = message_of({"joint '", name, "'"});
  for (std::size_t body = 0; body < model.moving_joints.size(); ++body) {
    if (model.moving_joints[body].view() != name) continue;
    const Name& mimicked = model.joints[model.mechanism.couplings[body].joint].name;
    return message_of({robot, ": ", joint, " mimics '", mimicked.view(), "': name that joint"});
  }
  const std::string choice = message_of({"; joints: ", listed_names(model.joints)});
  for (const LinkFrame& link : model.links) {
    if (!link.carrier.empty() && link.carrier.view() == name) {
      return message_of({robot, ": ", joint, " is fixed", choice});
    }
  }
  return message_of({robot, " has no ", joint, choice});
}

/// These functions are not constant expressions: compilers name them where a constant has a wrong
/// name.
template <class AnyModel>
[[noreturn]] void no_such_joint(const AnyModel& model, std::string_view name) {
  refuse({no_such_joint_text(model, name)});
}
template <class AnyModel>
[[noreturn]] void no_such_link(const AnyModel& model, std::string_view name) {
  refuse({"robot '", model.name.view(), "' has no link '", name,
          "'; links: ", listed_names(model.links)});
}

}  // namespace detail

}  // namespace articula
