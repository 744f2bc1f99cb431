// SPDX-License-Identifier: Apache-2.0
/// @file Limits of <ros2_control> that leave a joint nothing: refused, or noted where they do not
/// count.
#pragma once

#include "articula/model/joint.hpp"
#include "articula/text/numbers.hpp"
#include "articula/urdf/notices.hpp"
#include "articula/urdf/xml/document.hpp"
#include "articula/urdf/xml/error.hpp"

#include <string>

namespace articula::detail {

/// Refuses limits of <ros2_control> that leave a joint no velocity, effort or place. Where they do
/// not count, a notice says so instead: those of a joint that mimics another one, and efforts of a
/// robot without dynamics.
class LimitContradictions {
 public:
  /// @param kinematic  whether efforts do not count
  LimitContradictions(const UrdfDocument& document, bool kinematic, UrdfNotices& notices)
      : document_(document), kinematic_(kinematic), notices_(notices) {}

  /// @param joint   as written
  /// @param leader  whom it mimics; empty: nobody
  /// @param limits  those that count; positions of a mimic become those of <limit> where
  ///                <ros2_control> leaves it no place
  /// @throws UrdfError at what leaves the joint nothing
  void check(const urdf::Joint& joint, const std::string& leader, JointLimits& limits) {
    const std::string why =
        leader.empty() ? "the robot has no dynamics" : "it mimics '" + leader + "'";
    const auto [first, last] = document_.contradictions.equal_range(joint.name);
    for (auto at = first; at != last; ++at) {
      const LimitContradiction& found = at->second;
      const std::string owner = "<ros2_control>: joint '" + joint.name + "': " + found.kind + ": ";
      if (leader.empty() && !(kinematic_ && found.kind != "velocity")) {
        throw UrdfError(document_.file, owner + found.reason);
      }
      notices_.add(owner + "its limits (" + found.bounds + ") do not count: " + why);
    }
    check_places(joint, leader, limits);
  }

 private:
  void check_places(const urdf::Joint& joint, const std::string& leader, JointLimits& limits) {
    const auto command = document_.command_limits.find(joint.name);
    if (command == document_.command_limits.end() || limits.lower <= limits.upper ||
        !joint.limits || joint.limits->lower > joint.limits->upper) {
      return;  // whatever else is wrong is no matter of these
    }
    const auto range = [](double lower, double upper) {
      return number_text(lower) + " .. " + number_text(upper);
    };
    const std::string text =
        "joint '" + joint.name + "': its limits, " +
        range(command->second.lower, command->second.upper) + " in <ros2_control> and " +
        range(joint.limits->lower, joint.limits->upper) + " in <limit>, leave it no place";
    if (leader.empty()) throw UrdfError(document_.file, text);
    notices_.add(text + "; it mimics '" + leader + "', so those of <limit> count");
    limits.lower = joint.limits->lower;
    limits.upper = joint.limits->upper;
  }

  const UrdfDocument& document_;
  bool kinematic_;
  UrdfNotices& notices_;
};

}  // namespace articula::detail
