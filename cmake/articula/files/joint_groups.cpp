// SPDX-License-Identifier: Apache-2.0
#include "files/joint_groups.hpp"

#include "program.hpp"

#include <articula/model/build_model.hpp>
#include <articula/text/file_error.hpp>
#include <articula/text/similar_word.hpp>

#include <algorithm>

namespace terminal {

namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

}  // namespace

std::vector<PlannedGroup> joint_groups(const articula::UrdfDescription& robot,
                                       const ControllersPlan& plan) {
  std::vector<std::string> names;
  for (const articula::Joint& joint : robot->joints) {
    if (articula::detail::is_free(joint)) names.emplace_back(joint.name.view());
  }
  std::vector<PlannedGroup> groups;
  for (std::size_t at = 0; at < plan.controllers.size(); ++at) {
    const PlannedController& controller = plan.controllers[at];
    PlannedGroup own;
    for (const articula::ConfiguredJoint& joint : controller.config.joints) {
      if (!contains(names, joint.name)) {
        throw articula::FileError(joint.place,
                                  "robot '" + std::string(robot->name.view()) + "' has no joint '" +
                                      joint.name + "' that takes commands",
                                  articula::detail::one_of_words(joint.name, names));
      }
      own.joints.push_back(joint.name);
    }
    if (own.joints.empty()) own.joints = names;  // the file names none
    std::ranges::sort(own.joints);
    bool is_known = false;
    for (PlannedGroup& group : groups) {
      if (group.joints == own.joints) {
        group.controllers.push_back(at);
        is_known = true;
        continue;
      }
      for (const std::string& joint : own.joints) {
        if (!contains(group.joints, joint)) continue;
        throw Refusal(plan.source.name() + ": the controllers '" +
                      plan.controllers[group.controllers.front()].name + "' and '" +
                      controller.name + "' share joint '" + joint +
                      "', and other joints not; choose controllers with the same joints, or with "
                      "none in common, by --controller");
      }
    }
    if (is_known) continue;
    own.controllers = {at};
    groups.push_back(std::move(own));
  }
  std::erase_if(names, [&](const std::string& name) {
    return std::ranges::any_of(
        groups, [&](const PlannedGroup& group) { return contains(group.joints, name); });
  });
  if (!names.empty()) groups.push_back({.joints = names});
  return groups;
}

}  // namespace terminal
