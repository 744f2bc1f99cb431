// SPDX-License-Identifier: Apache-2.0
/// @file Why a joint or link that was asked for by name is not there.
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

/// Why a model has no joint of that name to command: it mimics another, is fixed, or unknown.
/// @param model  made by build_model
/// @param name   of none of its joints
/// @return       one line with the robot, the name and what may be asked for instead
template <class AnyModel>
[[nodiscard]] std::string no_such_joint_text(const AnyModel& model, std::string_view name) {
  const std::string robot = message_of({"robot '", model.name.view(), "'"});
  const std::string joint = message_of({"joint '", name, "'"});
  for (std::size_t body = 0; body < model.moving_joints.size(); ++body) {
    if (model.moving_joints[body].view() != name) continue;
    const auto followed = static_cast<std::size_t>(model.mechanism.couplings[body].joint);
    return message_of(
        {robot, ": ", joint, " mimics '", model.joints[followed].name.view(), "': ask for that"});
  }
  const std::string choice = message_of({"; joints: ", listed_names(model.joints)});
  for (const LinkFrame& link : model.links) {
    if (!link.carrier.empty() && link.carrier.view() == name) {
      return message_of({robot, ": ", joint, " is fixed", choice});
    }
  }
  return message_of({robot, " has no ", joint, choice});
}

/// Likewise for links.
template <class AnyModel>
[[nodiscard]] std::string no_such_link_text(const AnyModel& model, std::string_view name) {
  return message_of({"robot '", model.name.view(), "' has no link '", name,
                     "'; links: ", listed_names(model.links)});
}

/// No constant expressions: compilers name them where a constant asks for what is not there.
template <class AnyModel>
[[noreturn]] void no_such_joint(const AnyModel& model, std::string_view name) {
  refuse({no_such_joint_text(model, name)});
}
/// @copydoc no_such_joint
template <class AnyModel>
[[noreturn]] void no_such_link(const AnyModel& model, std::string_view name) {
  refuse({no_such_link_text(model, name)});
}

}  // namespace articula::detail
