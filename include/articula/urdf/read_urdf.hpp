// SPDX-License-Identifier: Apache-2.0
/// @file Robot descriptions from URDF files.
#pragma once

#include "articula/text/similar_word.hpp"
#include "articula/urdf/convert.hpp"
#include "articula/urdf/description.hpp"
#include "articula/urdf/mimic.hpp"
#include "articula/urdf/notices.hpp"
#include "articula/urdf/options.hpp"
#include "articula/urdf/xml/document.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula {

namespace detail {

/// The mass of a link and of all its descendants [kg].
[[nodiscard]] inline double mass_from(const urdf::Link& link) {
  double mass = 0;
  for (std::vector<const urdf::Link*> open{&link}; !open.empty();) {
    const urdf::Link& next = *open.back();
    open.pop_back();
    if (next.inertial) mass += next.inertial->mass;
    for (const auto& child : next.child_links) open.push_back(child.get());
  }
  return mass;
}

/// Selects a robot from a document and converts it.
class UrdfReader {
 public:
  UrdfReader(const UrdfDocument& document, const UrdfOptions& options)
      : document_(document), options_(options), notices_(document, options.kinematic) {}

  /// @throws FileError if options and document do not fit. The result is not checked otherwise.
  [[nodiscard]] UrdfContents read() {
    result_ = {.file = document_.file,
               .name = name_of(document_, document_.robot->getName()),
               .gravity = options_.gravity,
               .right_angle_tolerance = options_.right_angle_tolerance,
               .allow_unphysical = options_.allow_unphysical,
               .kinematic = options_.kinematic,
               .transmissions = document_.transmissions,
               .initial_values = document_.control.initial_values};
    const urdf::Link& root =
        options_.root.empty() ? *document_.robot->getRoot() : find_link("root", options_.root);
    if (!options_.kinematic) notices_.add_root(root, options_.gravity);
    options_.tip.empty() ? select_tree(root) : select_chain(root, find_link("tip", options_.tip));
    lock();
    if (!options_.tip.empty() && !options_.kinematic) note_excluded_branches();
    add(root);
    for (const urdf::Joint* joint : selected_) {
      add(*joint);
      add(*document_.robot->links_.at(joint->child_link_name));
    }
    correct_mimic_limits(result_.joints, notices_);
    notices_.add_robot(result_.links, result_.joints);
    result_.notices = notices_.take();
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw FileError(document_.file, reason);
  }
  [[noreturn]] void fail(const std::string& joint, const std::string& reason) const {
    fail("joint '" + joint + "': " + reason);
  }

  /// An element that an option names.
  template <class Elements>
  [[nodiscard]] const auto& find(const Elements& elements, const std::string& option,
                                 const std::string& kind, const std::string& name) const {
    const auto found = elements.find(name);
    if (found != elements.end()) return *found->second;
    std::vector<std::string_view> names;
    for (const auto& [each, element] : elements) names.push_back(each);
    fail(option + " '" + name + "': there is no such " + kind + choice_of(name, kind + "s", names));
  }
  [[nodiscard]] const urdf::Link& find_link(const char* option, const std::string& name) const {
    return find(document_.robot->links_, option, "link", name);
  }

  /// Selects all joints below the root, depth first.
  void select_tree(const urdf::Link& root) {
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
      if (!at->parent_joint) {
        fail("tip '" + tip.name + "': it is not a descendant of root '" + root.name + "'");
      }
      selected_.insert(selected_.begin(), at->parent_joint.get());
    }
  }

  /// Checks and stores the positions of locked joints.
  void lock() {
    for (const auto& [name, position] : options_.locked) {
      const urdf::Joint& joint = find(document_.robot->joints_, "locked joint", "joint", name);
      if (!is_finite(position)) fail(name, "it cannot be locked at " + rounded_text(position));
      const auto [at, is_new] = locked_.try_emplace(name, position);
      if (is_new) notices_.add_lock(joint, position);
      if (at->second == position) continue;
      fail(name, "it is locked at two positions, " + rounded_text(at->second) + " and " +
                     rounded_text(position));
    }
  }

  /// Adds a notice about branches with mass that leave the moving part of a chain. Branches from
  /// its resting part do not change the dynamics.
  void note_excluded_branches() {
    std::vector<std::string> joints;
    double mass = 0;
    bool moves = false;
    for (std::size_t i = 0; i < selected_.size(); ++i) {
      const urdf::Joint& joint = *selected_[i];
      moves = moves || (joint.type != urdf::Joint::FIXED &&
                        !locked_.contains(resolve_mimic(document_, locked_, joint).joint));
      if (!moves) continue;
      for (const auto& branch : document_.robot->links_.at(joint.child_link_name)->child_joints) {
        if (i + 1 < selected_.size() && branch.get() == selected_[i + 1]) continue;
        const double own = mass_from(*document_.robot->links_.at(branch->child_link_name));
        if (!(own > 0)) continue;
        joints.push_back(branch->name);
        mass += own;
      }
    }
    if (joints.empty()) return;
    notices_.add("tip '" + options_.tip + "': the chain's joints carry " + rounded_text(mass) +
                 " kg that are left out, at joint '" + joints.front() + "'" +
                 (joints.size() == 1 ? "" : " and " + std::to_string(joints.size() - 1) + " more") +
                 "; to include them, set no tip and lock all other joints");
  }

  void add(const urdf::Link& link) {
    result_.links.push_back(link_of(document_, link, options_.kinematic));
  }

  void add(const urdf::Joint& joint) {
    const auto [mimicked, multiplier, offset] = resolve_mimic(document_, locked_, joint);
    const bool mimics = mimicked != joint.name;
    if (const auto locked = locked_.find(mimicked); locked != locked_.end()) {
      const double position = multiplier * locked->second + offset;
      result_.joints.push_back(locked_joint_of(document_, joint, position));
      if (mimics) notices_.add_lock(joint, position);
      return;
    }
    Joint& added = result_.joints.emplace_back(joint_of(document_, joint));
    if (added.type != JointType::fixed) {
      check_command_limits(document_, options_.kinematic, joint, mimics ? mimicked : "",
                           added.limits, notices_);
    }
    if (!mimics) return;
    check_is_selected(joint.name, mimicked);
    added.mimic = {name_of(document_, mimicked), multiplier, offset};
    added.limits.soft_lower = -JointLimits::infinity;  // those of a mimic joint are not used
    added.limits.soft_upper = added.limits.soft_rate = JointLimits::infinity;
  }

  /// Without the joint that it mimics, the position of a mimic joint is unknown.
  void check_is_selected(const std::string& joint, const std::string& mimicked) const {
    const auto found = document_.robot->joints_.find(mimicked);
    if (found == document_.robot->joints_.end()) return;  // find_fault reports it
    if (std::ranges::find(selected_, found->second.get()) != selected_.end()) return;
    fail(joint, "it mimics '" + mimicked + "', which is not between root and tip: lock '" +
                    mimicked +
                    "' at a position, or choose root and tip so that it is between them");
  }

  const UrdfDocument& document_;
  const UrdfOptions& options_;
  UrdfContents result_{};
  UrdfNotices notices_;
  std::vector<const urdf::Joint*> selected_{};  ///< from the root outwards
  std::map<std::string, double> locked_{};      ///< position [rad or m] by joint
};

}  // namespace detail

/// Selects and checks a robot's description.
/// @param document  from parse_urdf
/// @param options   the part of the robot, locked joints, accepted faults, gravity
/// @throws FileError with file, element, reason and figures if there is a fault
/// Real-time: no (allocates, throws).
[[nodiscard]] inline UrdfDescription read_urdf(const UrdfDocument& document,
                                               const UrdfOptions& options = {}) {
  UrdfContents contents = detail::UrdfReader(document, options).read();
  try {
    return UrdfDescription(std::move(contents));
  } catch (const FileError& error) {
    throw FileError(error, detail::possible_cause(document.unknown_words, error.what()));
  }
}

/// Reads and checks a robot's description from a file or XML.
/// @copydetails read_urdf
/// @param source  a file's name or path, or XML: a string that begins with '<'
[[nodiscard]] inline UrdfDescription read_urdf(const UrdfSource& source,
                                               const UrdfOptions& options = {}) {
  return read_urdf(parse_urdf(source, options.kinematic), options);
}

}  // namespace articula
