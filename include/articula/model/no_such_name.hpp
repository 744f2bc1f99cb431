// SPDX-License-Identifier: Apache-2.0
/// @file Messages about names of joints or links that a robot does not have.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/model/model.hpp"

#include <string>
#include <string_view>

namespace articula::detail {

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
/// @copydoc no_such_joint
template <class AnyModel>
[[noreturn]] void no_such_link(const AnyModel& model, std::string_view name) {
  refuse({"robot '", model.name.view(), "' has no link '", name,
          "'; links: ", listed_names(model.links)});
}

}  // namespace articula::detail
