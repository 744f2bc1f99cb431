// SPDX-License-Identifier: Apache-2.0
/// @file What is odd about a robot's description, but no reason to refuse it.
#pragma once

#include "articula/model/validation.hpp"
#include "articula/urdf/convert.hpp"
#include "articula/urdf/fault_text.hpp"
#include "articula/urdf/left_out.hpp"
#include "articula/urdf/name_notices.hpp"
#include "articula/urdf/options.hpp"
#include "articula/urdf/xml/document.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace articula::detail {

/// Collects what the user of a URDF should know, a line each.
class UrdfNotices {
 public:
  /// Begins with words that are not known and what stands twice: they may be why there are others.
  UrdfNotices(const UrdfDocument& document, bool kinematic)
      : document_(document), kinematic_(kinematic), notices_(document.unknown_words) {
    notices_.insert(notices_.end(), document.repeated_elements.begin(),
                    document.repeated_elements.end());
    notices_.insert(notices_.end(), document.drive_notices.begin(), document.drive_notices.end());
  }

  [[nodiscard]] std::vector<std::string> take() { return std::move(notices_); }

  /// A joint that is held. Beyond its limits is no reason to refuse a robot, since a file may have
  /// them wrong, but an odd place to be.
  void add_lock(const urdf::Joint& joint, double position) {
    if (joint.type == urdf::Joint::FIXED) {
      add("joint '" + joint.name + "': it is to be locked, but is fixed anyway");
    }
    add_position(joint, "it is locked at " + rounded_text(position), position);
  }

  /// A root other than the file's, whose frame may be turned. Gravity is given in that frame, so
  /// its default may not be what the user thinks of.
  void add_root(const urdf::Link& root, const Vector3<double>& gravity) {
    const Vector3<double> usual = UrdfOptions{}.gravity;
    if (!root.parent_joint || gravity != usual) return;
    std::vector<const urdf::Joint*> way;  // from the root upwards
    for (const urdf::Link* at = &root; at->parent_joint; at = at->getParent().get()) {
      way.push_back(at->parent_joint.get());
    }
    const std::string taken = ", and gravity is 0 0 -9.81 in its own frame";
    constexpr double noticeable = 1e-3;  // [m/s^2], more than files' rounded angles make
    Eigen::Vector3d down(usual.x, usual.y, usual.z);
    for (auto at = way.rbegin(); at != way.rend(); ++at) {
      const urdf::Joint& joint = **at;
      down = rotation_of(document_.joint_orientations.at(joint.name)).transpose() * down;
      if (joint.type == urdf::Joint::FIXED || joint.type == urdf::Joint::PRISMATIC) continue;
      // A turn about the vertical leaves gravity where it is.
      const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
      if (joint.type == urdf::Joint::FLOATING ||
          axis.stableNormalized().cross(down).norm() > noticeable) {
        return add("root '" + root.name + "': joint '" + joint.name + "' turns it" + taken);
      }
    }
    if (std::hypot(down.x(), down.y()) < noticeable && down.z() < 0) return;
    const auto text = [](double x) { return rounded_text(std::abs(x) < noticeable ? 0 : x); };
    add("root '" + root.name + "': it is turned against the file's root" + taken +
        "; what is 0 0 -9.81 in the file's is there " + text(down.x()) + " " + text(down.y()) +
        " " + text(down.z()));
  }

  /// A chain that leaves out what its joints carry in the file.
  void add_tip(const std::string& tip, const LeftOut& left_out) {
    if (left_out.joints.empty()) return;
    const std::size_t others = left_out.joints.size() - 1;
    add("tip '" + tip + "': " + rounded_text(left_out.mass) +
        " kg that hang on the chain are left out, at joint '" + left_out.joints.front() + "'" +
        (others == 0 ? "" : " and " + std::to_string(others) + " more") +
        "; without a tip, and with all other joints locked, they are carried along");
  }

  /// All about a robot's links and joints, and names in the file that lead nowhere.
  void add_robot(std::span<const Link> links, std::span<const Joint> joints) {
    for (const Link& link : links) {
      const Rule rule = broken_rule(link);
      if (rule != Rule::none) add(fault_text({link.name, rule}, links, {}));
      add_odd_units(link);
    }
    for (const Joint& joint : joints) {
      const std::string name(joint.name.view());
      add_large_angle("joint '" + name + "': <origin>", document_.joint_orientations.at(name));
      if (joint.type != JointType::fixed) add_joint(joint, joints);
    }
    const std::vector<std::string> names = name_notices(document_);
    notices_.insert(notices_.end(), names.begin(), names.end());
  }

  /// A mimic whose limits do not count.
  void add_contradiction(const Joint& joint) {
    add(joint, "its limits, " + range_text(joint.limits) + ", would leave '" +
                   std::string(joint.mimic.joint.view()) + "', which it mimics " +
                   rounded_text(joint.mimic.multiplier) +
                   " times, no room to move, so they do not count");
  }

  /// Anything else.
  void add(const std::string& text) { notices_.push_back(text); }

 private:
  void add(const Joint& joint, const std::string& text) {
    add("joint '" + std::string(joint.name.view()) + "': " + text);
  }
  [[nodiscard]] static std::string range_text(const JointLimits& limits) {
    return rounded_text(limits.lower) + " .. " + rounded_text(limits.upper);
  }

  /// Angles of more than a turn, which itself may be rounded up.
  void add_large_angle(const std::string& where, const Vector3<double>& rpy) {
    if (std::max({std::abs(rpy.x), std::abs(rpy.y), std::abs(rpy.z)}) < 6.3) return;
    add(where + ": rpy " + rounded_text(rpy.x) + " " + rounded_text(rpy.y) + " " +
        rounded_text(rpy.z) + " rad is more than a turn; are these degrees?");
  }

  /// An <inertial> in other units. In kg mm^2 a body seems a thousand times as large as it is; a
  /// crane's jib has a radius of gyration of 20 m.
  void add_odd_units(const Link& link) {
    constexpr double largest_radius = 50;  // of gyration [m]
    const std::string where = "link '" + std::string(link.name.view()) + "': <inertial>: ";
    const auto orientation = document_.inertia_orientations.find(std::string(link.name.view()));
    if (orientation != document_.inertia_orientations.end()) {
      add_large_angle(where + "<origin>", orientation->second);
    }
    const double largest = std::max({link.inertia.xx, link.inertia.yy, link.inertia.zz});
    const double radius = link.mass > 0 ? std::sqrt(largest / link.mass) : 0;
    if (radius > largest_radius) {
      add(where + "the inertia is that of " + rounded_text(link.mass) + " kg at a distance of " +
          rounded_text(radius) + " m; is it in kg m^2?");
    }
  }

  void add_position(const urdf::Joint& joint, const std::string& text, double position) {
    if (joint.type != urdf::Joint::REVOLUTE && joint.type != urdf::Joint::PRISMATIC) return;
    const JointLimits limits = joint_limits(document_, joint);
    if (position >= limits.lower && position <= limits.upper) return;
    add("joint '" + joint.name + "': " + text + ", beyond its limits, " + range_text(limits));
  }

  /// A joint that moves.
  void add_joint(const Joint& joint, std::span<const Joint> joints) {
    const std::string name(joint.name.view()), child(joint.child.view());
    const urdf::Joint& written = *document_.robot->joints_.at(name);
    add_limits(joint);
    add_soft_limits(joint);
    if (joint.type == JointType::continuous) add_unused_limits(joint, written);
    if (joint.mimic.joint.empty()) {
      const JointLimits limits = properties_of(joints, joint).limits;
      if (limits.lower == limits.upper && joint.limits.lower != joint.limits.upper) {
        add(joint,
            "those that mimic it together leave it no room to move, lower and upper limit are " +
                rounded_text(limits.lower));
      }
    }
    const auto initial = document_.initial_values.find(name);
    if (initial != document_.initial_values.end() && initial->second.position) {
      const double position = *initial->second.position;
      add_position(written, "its initial_value is " + rounded_text(position), position);
    }
    if (!kinematic_ && !document_.robot->links_.at(child)->inertial) {
      add("link '" + child + "': it has no <inertial>, so it counts as massless, though joint '" +
          name + "' moves it");
    }
  }

  /// Limits of 0, as programs write them that do not know the figures, and limits of many turns,
  /// which often are degrees. No reason to refuse a file: dynamics have no use for them, and a
  /// winch turns often.
  void add_limits(const Joint& joint) {
    constexpr double four_turns = 8 * std::numbers::pi;
    const auto is_far = [](double limit) {
      return is_finite(limit) && std::abs(limit) > four_turns;
    };
    if (joint.type == JointType::revolute &&
        (is_far(joint.limits.lower) || is_far(joint.limits.upper))) {
      add(joint, "its limits, " + range_text(joint.limits) +
                     " rad, reach farther than four turns; are they degrees?");
    }
    if (joint.limits.lower == joint.limits.upper) {
      add(joint,
          "it has no room to move, lower and upper limit are " + rounded_text(joint.limits.lower));
    }
    if (joint.limits.velocity == 0) {
      add(joint, "its velocity limit is 0, so it must not move");
    }
    if (joint.limits.effort == 0 && joint.mimic.joint.empty()) {
      add(joint, "its effort limit is 0, so it cannot be driven");
    }
  }

  /// Soft limits that are no use.
  void add_soft_limits(const Joint& joint) {
    const auto soft = document_.soft_limits.find(std::string(joint.name.view()));
    if (soft == document_.soft_limits.end()) return;
    const std::string range = "its soft limits, " + rounded_text(soft->second.lower) + " .. " +
                              rounded_text(soft->second.upper) + ", do not count: ";
    if (!joint.mimic.joint.empty()) {
      add(joint, range + "it mimics '" + std::string(joint.mimic.joint.view()) + "'");
    } else if (!is_finite(joint.limits.soft_lower)) {
      add(joint, range + "they are beyond its limits, " + range_text(joint.limits));
    } else if (joint.limits.lower < joint.limits.upper &&
               std::max(joint.limits.lower, joint.limits.soft_lower) >=
                   std::min(joint.limits.upper, joint.limits.soft_upper)) {
      add(joint, "its soft limits, " + rounded_text(soft->second.lower) + " .. " +
                     rounded_text(soft->second.upper) +
                     ", leave it no room to move within its limits, " + range_text(joint.limits));
    }
  }

  /// URDF has none for continuous joints, but people write them.
  void add_unused_limits(const Joint& joint, const urdf::Joint& written) {
    JointLimits unused;
    const auto command = document_.command_limits.find(written.name);
    if (command != document_.command_limits.end()) unused = command->second;
    if (written.limits && (written.limits->lower != 0 || written.limits->upper != 0)) {
      unused.lower = written.limits->lower;
      unused.upper = written.limits->upper;
    }
    if (is_finite(unused.lower) || is_finite(unused.upper)) {
      add(joint, "it is continuous, so its position limits do not count, " + range_text(unused));
    }
  }

  const UrdfDocument& document_;
  bool kinematic_;  ///< masses do not count
  std::vector<std::string> notices_;
};

}  // namespace articula::detail
