// SPDX-License-Identifier: Apache-2.0
/// @file Notices: what the user of a URDF should know, but no reason to refuse the file.
#pragma once

#include "articula/model/validation.hpp"
#include "articula/urdf/convert.hpp"
#include "articula/urdf/description.hpp"
#include "articula/urdf/options.hpp"
#include "articula/urdf/xml/document.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace articula::detail {

/// Collects the notices about a robot, a line each.
class UrdfNotices {
 public:
  /// Begins with those about the file. Unknown words come first: they may explain others.
  UrdfNotices(const UrdfDocument& document, bool kinematic)
      : document_(document), kinematic_(kinematic), notices_(document.unknown_words) {
    notices_.insert(notices_.end(), document.notices.begin(), document.notices.end());
  }

  [[nodiscard]] std::vector<std::string> take() { return std::move(notices_); }

  void add(const std::string& line) { notices_.push_back(line); }

  /// A locked joint. Positions beyond its limits are accepted, since the file's limits may be
  /// wrong.
  void add_lock(const urdf::Joint& joint, double position) {
    if (joint.type == urdf::Joint::FIXED) {
      add("joint '" + joint.name + "': it is locked, but is fixed anyway");
    }
    add_position(joint, "it is locked at " + rounded_text(position), position);
  }

  /// A root other than the file's. Gravity is given in the root's frame, so its default is probably
  /// wrong where that frame is rotated.
  void add_root(const urdf::Link& root, const Vector3<double>& gravity) {
    const Vector3<double> usual = UrdfOptions{}.gravity;
    if (!root.parent_joint || gravity != usual) return;
    std::vector<const urdf::Joint*> way;  // from the root upwards
    for (const urdf::Link* at = &root; at->parent_joint; at = at->getParent().get()) {
      way.push_back(at->parent_joint.get());
    }
    const std::string frame = " its frame, but gravity is 0 0 -9.81 in it";
    constexpr double noticeable = 1e-3;  // [m/s^2], more than files' rounded angles make
    Vector3<double> down = usual;
    for (auto at = way.rbegin(); at != way.rend(); ++at) {
      const urdf::Joint& joint = **at;
      down = transposed_times(rotation_from_rpy(document_.joint_orientations.at(joint.name)), down);
      if (joint.type == urdf::Joint::FIXED || joint.type == urdf::Joint::PRISMATIC) continue;
      // A rotation about the vertical does not change gravity.
      const Vector3<double> tilt = cross(direction_of(vector_of(joint.axis)), down);
      if (joint.type == urdf::Joint::FLOATING || std::hypot(tilt.x, tilt.y, tilt.z) > noticeable) {
        return add("root '" + root.name + "': joint '" + joint.name + "' rotates" + frame);
      }
    }
    if (std::hypot(down.x, down.y) < noticeable && down.z < 0) return;
    const auto text = [](double x) { return rounded_text(std::abs(x) < noticeable ? 0 : x); };
    add("root '" + root.name + "': the file rotates" + frame +
        "; to keep the gravity of the file's root, set it to " + text(down.x) + " " + text(down.y) +
        " " + text(down.z));
  }

  void add_robot(std::span<const Link> links, std::span<const Joint> joints) {
    for (const Link& link : links) {
      const Rule rule = broken_rule(link);
      if (rule != Rule::none) add(fault_text({link.name, rule}, links, {}));
      if (!kinematic_) add_odd_units(link);
    }
    for (const Joint& joint : joints) {
      add_large_angle(joint_text(joint) + "<origin>",
                      document_.joint_orientations.at(std::string(joint.name)));
      if (joint.type != JointType::fixed) add_joint(joint, joints);
    }
  }

  /// A mimic joint whose limits are replaced, see correct_mimic_limits.
  void add_ignored_mimic_limits(const Joint& joint) {
    add(joint, "its limits, " + range_text(joint.limits) + ", are ignored: within them '" +
                   std::string(joint.mimic.joint) + "', which it mimics " +
                   rounded_text(joint.mimic.multiplier) + " times, could not move");
  }

 private:
  [[nodiscard]] static std::string joint_text(const Joint& joint) {
    return "joint '" + std::string(joint.name) + "': ";
  }
  void add(const Joint& joint, const std::string& text) { add(joint_text(joint) + text); }
  [[nodiscard]] static std::string range_text(double lower, double upper) {
    return rounded_text(lower) + " .. " + rounded_text(upper);
  }
  [[nodiscard]] static std::string range_text(const JointLimits& limits) {
    return range_text(limits.lower, limits.upper);
  }

  /// Angles of more than a turn. A turn itself may be rounded up.
  void add_large_angle(const std::string& where, const Vector3<double>& rpy) {
    if (std::max({std::abs(rpy.x), std::abs(rpy.y), std::abs(rpy.z)}) < 6.3) return;
    add(where + ": rpy " + rounded_text(rpy.x) + " " + rounded_text(rpy.y) + " " +
        rounded_text(rpy.z) + " rad is more than a turn; are these degrees?");
  }

  /// An <inertial> in other units. An inertia in kg mm^2 makes a body seem a thousand times as
  /// large as it is. For comparison, a crane's jib has a radius of gyration of 20 m.
  void add_odd_units(const Link& link) {
    constexpr double largest_radius = 50;  // of gyration [m]
    const std::string where = "link '" + std::string(link.name) + "': <inertial>: ";
    const auto orientation = document_.inertia_orientations.find(std::string(link.name));
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
    const std::string name(joint.name), child(joint.child);
    const urdf::Joint& written = *document_.robot->joints_.at(name);
    add_limits(joint);
    add_soft_limits(joint);
    if (joint.type == JointType::continuous) add_unused_limits(joint, written);
    if (joint.mimic.joint.empty()) {
      const JointLimits limits = properties_of(joints, joint).limits;
      if (limits.lower == limits.upper && joint.limits.lower != joint.limits.upper) {
        add(joint,
            "it cannot move: the limits of the joints that mimic it leave it only the "
            "position " +
                rounded_text(limits.lower));
      }
    }
    const auto initial = document_.control.initial_values.find(name);
    if (initial != document_.control.initial_values.end() && initial->second.position) {
      const double position = *initial->second.position;
      add_position(written, "its initial_value is " + rounded_text(position), position);
    }
    if (!kinematic_ && !document_.robot->links_.at(child)->inertial) {
      add("link '" + child + "': it has no <inertial> and is taken as massless, but joint '" +
          name + "' moves it");
    }
  }

  /// Limits of 0, which programs write that do not know the limits, and limits of many turns, which
  /// often are degrees. Neither is refused: dynamics do not use limits, and a winch makes many
  /// turns.
  void add_limits(const Joint& joint) {
    const auto is_far = [](double limit) {
      constexpr double four_turns = 8 * std::numbers::pi;
      return is_finite(limit) && std::abs(limit) > four_turns;
    };
    const JointLimits& limits = joint.limits;
    if (joint.type == JointType::revolute && (is_far(limits.lower) || is_far(limits.upper))) {
      add(joint, "its limits, " + range_text(limits) +
                     " rad, are more than four turns from 0; are they degrees?");
    }
    if (limits.lower == limits.upper) {
      add(joint, "it cannot move: its lower and upper limits are " + rounded_text(limits.lower));
    }
    if (limits.velocity == 0) add(joint, "its velocity limit is 0, so it must not move");
    if (limits.effort == 0 && joint.mimic.joint.empty()) {
      add(joint, "its effort limit is 0, so it cannot be driven");
    }
  }

  /// Soft limits without effect.
  void add_soft_limits(const Joint& joint) {
    const auto soft = document_.control.limits.find(std::string(joint.name));
    if (soft == document_.control.limits.end() || !is_finite(soft->second.soft_lower)) return;
    const JointLimits& limits = joint.limits;
    const std::string range =
        "its soft limits, " + range_text(soft->second.soft_lower, soft->second.soft_upper);
    if (!joint.mimic.joint.empty()) {
      add(joint, range + ", are ignored: it mimics '" + std::string(joint.mimic.joint) + "'");
    } else if (!is_finite(limits.soft_lower)) {
      add(joint, range + ", are ignored: they are beyond its limits, " + range_text(limits));
    } else if (limits.lower < limits.upper && std::max(limits.lower, limits.soft_lower) >=
                                                  std::min(limits.upper, limits.soft_upper)) {
      add(joint, range + ", leave it no room to move within its limits, " + range_text(limits));
    }
  }

  /// Position limits of a continuous joint, which URDF does not define.
  void add_unused_limits(const Joint& joint, const urdf::Joint& written) {
    JointLimits unused;
    const auto command = document_.control.limits.find(written.name);
    if (command != document_.control.limits.end()) unused = command->second;
    if (written.limits && (written.limits->lower != 0 || written.limits->upper != 0)) {
      unused.lower = written.limits->lower;
      unused.upper = written.limits->upper;
    }
    if (is_finite(unused.lower) || is_finite(unused.upper)) {
      add(joint,
          "it is continuous, so its position limits, " + range_text(unused) + ", are ignored");
    }
  }

  const UrdfDocument& document_;
  bool kinematic_;  ///< masses are not used
  std::vector<std::string> notices_;
};

}  // namespace articula::detail
