// SPDX-License-Identifier: Apache-2.0
/// @file A robot's description read from URDF.
#pragma once

#include "articula/model/urdf/convert.hpp"
#include "articula/model/urdf/document.hpp"
#include "articula/model/urdf/fault_text.hpp"
#include "articula/model/urdf/options.hpp"
#include "articula/model/validation.hpp"

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace articula {

/// A robot's description whose size is known at run time: what RobotDescription is at compile time,
/// and what the file tells besides. It has no fault (see find_fault).
struct UrdfDescription {
  std::string file{};  ///< where it comes from
  Name name{};
  Vector3<double> gravity{};  ///< free fall in the root link's frame [m/s^2], 3 x 1
  double right_angle_tolerance = default_right_angle_tolerance;  ///< see UrdfOptions
  std::vector<Link> links{};                                     ///< from the root outwards
  std::vector<Joint> joints{};    ///< likewise, locked ones as fixed; the limits are those of
                                  ///< <limit>, narrowed by <ros2_control>
  bool allow_unphysical = false;  ///< as asked for
  std::vector<UrdfTransmission> transmissions{};              ///< all of the file
  std::map<std::string, UrdfInitialValues> initial_values{};  ///< by joint, from <ros2_control>
  std::vector<std::string> notices{};  ///< what the user should know, a line each:
                                       ///< inertias that no real body has, limits of 0,
                                       ///< links that move without <inertial>, and
                                       ///< names that lead nowhere
};

namespace detail {

/// Takes a robot out of a document.
class UrdfReader {
 public:
  UrdfReader(const UrdfDocument& document, const UrdfOptions& options)
      : document_(document), options_(options) {}

  [[nodiscard]] UrdfDescription read() {
    result_ = {.file = document_.file,
               .name = name_of(document_, document_.robot->getName()),
               .gravity = options_.gravity,
               .right_angle_tolerance = options_.right_angle_tolerance,
               .allow_unphysical = options_.allow_unphysical,
               .transmissions = document_.transmissions,
               .initial_values = document_.initial_values};
    select();
    lock();
    for (const urdf::Joint* joint : selected_) add(*joint);
    fold_mimics();
    check();
    note_oddities();
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw UrdfError(document_.file, reason);
  }

  [[nodiscard]] const urdf::Link& link(const std::string& name, const char* what) const {
    const auto found = document_.robot->links_.find(name);
    if (found == document_.robot->links_.end()) {
      fail("link '" + name + "': it is to be the " + what + ", but does not exist");
    }
    return *found->second;
  }

  /// Finds the joints that are wanted, from the root outwards.
  void select() {
    const urdf::Link& root =
        options_.root.empty() ? *document_.robot->getRoot() : link(options_.root, "root");
    result_.links.push_back(link_of(document_, root));
    if (!options_.tip.empty()) return select_chain(root, link(options_.tip, "tip"));
    std::vector<urdf::JointSharedPtr> open;                        // the next one last
    const auto add_children = [&open](const urdf::Link& parent) {  // urdfdom has sorted them
      open.insert(open.end(), parent.child_joints.rbegin(), parent.child_joints.rend());
    };
    add_children(root);
    while (!open.empty()) {
      selected_.push_back(open.back().get());
      open.pop_back();
      add_children(*document_.robot->links_.at(selected_.back()->child_link_name));
    }
  }

  void select_chain(const urdf::Link& root, const urdf::Link& tip) {
    for (const urdf::Link* at = &tip; at != &root; at = at->getParent().get()) {
      if (!at->parent_joint) fail("link '" + tip.name + "': it is not beyond '" + root.name + "'");
      selected_.insert(selected_.begin(), at->parent_joint.get());
    }
  }

  /// Where joints are held: those that are named, and those that mimic one of them.
  void lock() {
    for (const LockedJoint& locked : options_.locked) {
      if (!document_.robot->joints_.contains(locked.name)) {
        fail("joint '" + locked.name + "': it is to be locked, but does not exist");
      }
      held_[locked.name] = locked.position;
    }
    for (std::size_t before = 0; before != held_.size();) {
      before = held_.size();
      for (const urdf::Joint* joint : selected_) {
        if (!joint->mimic || held_.contains(joint->name)) continue;
        const auto followed = held_.find(joint->mimic->joint_name);
        if (followed == held_.end()) continue;
        held_[joint->name] = joint->mimic->multiplier * followed->second + joint->mimic->offset;
      }
    }
  }

  void add(const urdf::Joint& joint) {
    const auto held = held_.find(joint.name);
    result_.joints.push_back(held == held_.end() ? joint_of(document_, joint)
                                                 : locked_joint_of(document_, joint, held->second));
    result_.links.push_back(link_of(document_, *document_.robot->links_.at(joint.child_link_name)));
  }

  /// Lets a joint that mimics a mimic follow the joint at the end of the line.
  void fold_mimics() {
    std::map<std::string_view, Joint*> joints;
    for (Joint& joint : result_.joints) joints[joint.name.view()] = &joint;
    for (Joint& joint : result_.joints) {
      for (std::size_t step = 0; !joint.mimic.joint.empty(); ++step) {
        const auto found = joints.find(joint.mimic.joint.view());
        if (found == joints.end() || found->second->mimic.joint.empty()) break;
        if (step > joints.size()) {
          fail("joint '" + std::string(joint.name.view()) + "': it mimics itself");
        }
        const Mimic& next = found->second->mimic;
        joint.mimic = {next.joint, joint.mimic.multiplier * next.multiplier,
                       joint.mimic.multiplier * next.offset + joint.mimic.offset};
      }
    }
  }

  void check() const {
    for (const Joint& joint : result_.joints) {
      if (!joint.mimic.joint.empty() && index_of<Joint>(result_.joints, joint.mimic.joint) < 0 &&
          document_.robot->joints_.contains(std::string(joint.mimic.joint.view()))) {
        fail("joint '" + std::string(joint.name.view()) + "': it mimics '" +
             std::string(joint.mimic.joint.view()) + "', which is not between root and tip");
      }
    }
    const DescriptionFault fault = find_fault(result_.name, result_.gravity, result_.links,
                                              result_.joints, options_.allow_unphysical);
    if (fault.rule == Rule::none) return;
    std::string text = fault_text(fault, result_.links, result_.joints);
    if (concerns_inertia(fault.rule)) text += "; allow_unphysical accepts it";
    fail(text);
  }

  /// Limits of 0, as programs write them that do not know the figures. No reason to refuse a file:
  /// dynamics have no use for them.
  [[nodiscard]] static std::vector<std::string> limit_faults(const Joint& joint) {
    std::vector<std::string> faults;
    if (joint.type == JointType::fixed) return faults;
    const std::string name = "joint '" + std::string(joint.name.view()) + "': ";
    if (joint.limits.lower == joint.limits.upper) {
      faults.push_back(name + "it has no room to move, lower and upper limit are " +
                       rounded_text(joint.limits.lower));
    }
    if (joint.limits.velocity == 0) {
      faults.push_back(name + "its velocity limit is 0, so it must not move");
    }
    if (joint.limits.effort == 0 && joint.mimic.joint.empty()) {
      faults.push_back(name + "its effort limit is 0, so it cannot be driven");
    }
    return faults;
  }

  void note_oddities() {
    const auto note = [this](const std::string& text) { result_.notices.push_back(text); };
    for (const Link& link : result_.links) {
      const Rule rule = broken_rule(link);
      if (rule != Rule::none) note(fault_text({link.name, rule}, result_.links, {}));
    }
    for (const Joint& joint : result_.joints) {
      const std::vector<std::string> faults = limit_faults(joint);
      for (const std::string& fault : faults) note(fault);
      if (joint.type != JointType::fixed && joint.mimic.joint.empty()) {
        const JointLimits limits =
            properties_of(std::span<const Joint>(result_.joints), joint).limits;
        if (limits.lower == limits.upper && joint.limits.lower != joint.limits.upper) {
          note("joint '" + std::string(joint.name.view()) +
               "': those that mimic it leave it no room to move, lower and upper limit are " +
               rounded_text(limits.lower));
        }
      }
      const std::string child(joint.child.view());
      if (joint.type == JointType::fixed || document_.robot->links_.at(child)->inertial) continue;
      note("link '" + child + "': it has no <inertial>, so it counts as massless, though joint '" +
           std::string(joint.name.view()) + "' moves it");
    }
    const auto exists = [this](const std::string& joint) {
      return document_.robot->joints_.contains(joint);
    };
    for (const auto& [joint, limits] : document_.command_limits) {
      if (!exists(joint)) note("<ros2_control>: joint '" + joint + "' does not exist");
    }
    for (const UrdfTransmission& transmission : document_.transmissions) {
      for (const UrdfTransmissionEnd& end : transmission.joints) {
        if (exists(end.name)) continue;
        note("transmission '" + transmission.name + "': joint '" + end.name + "' does not exist");
      }
    }
  }

  const UrdfDocument& document_;
  const UrdfOptions& options_;
  UrdfDescription result_{};
  std::vector<const urdf::Joint*> selected_{};
  std::map<std::string, double> held_{};  ///< position [rad or m] by joint
};

}  // namespace detail

/// Reads a robot's description.
/// @param source   a file or XML
/// @param options  which part to read, and how strictly
/// @throws UrdfError with file, element, reason and figures if there is a fault
/// Real-time: no (reads a file, allocates, throws).
[[nodiscard]] inline UrdfDescription read_urdf(const UrdfSource& source,
                                               const UrdfOptions& options = {}) {
  const UrdfDocument document = parse_urdf(source);
  return detail::UrdfReader(document, options).read();
}

}  // namespace articula
