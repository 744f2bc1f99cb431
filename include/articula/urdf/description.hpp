// SPDX-License-Identifier: Apache-2.0
/// @file A robot's description read from URDF.
#pragma once

#include "articula/model/validation.hpp"
#include "articula/text/meant_word.hpp"
#include "articula/urdf/contradictions.hpp"
#include "articula/urdf/convert.hpp"
#include "articula/urdf/fault_text.hpp"
#include "articula/urdf/leader.hpp"
#include "articula/urdf/left_out.hpp"
#include "articula/urdf/mimic_limits.hpp"
#include "articula/urdf/notices.hpp"
#include "articula/urdf/options.hpp"
#include "articula/urdf/xml/document.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
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
  bool kinematic = false;         ///< likewise; then no link has mass
  std::vector<UrdfTransmission> transmissions{};              ///< all of the file
  std::map<std::string, UrdfInitialValues> initial_values{};  ///< by joint, from <ros2_control>
  std::vector<std::string> notices{};  ///< what the user should know, a line each:
                                       ///< words in links and joints that URDF does not know,
                                       ///< elements that stand twice and say the same,
                                       ///< inertias that no real body has, limits of 0 and
                                       ///< those of continuous joints, places beyond limits,
                                       ///< links that move without <inertial>, names that lead
                                       ///< nowhere, reductions of 0, mimics that stand in
                                       ///< <ros2_control> alone, fixed joints that are to be
                                       ///< locked, a root that is turned against the file's
                                       ///< where gravity is the default, masses that hang on a
                                       ///< chain and are left out, limits in braces, what is
                                       ///< odd in <ros2_control>, soft limits without use, angles
                                       ///< and inertias that seem to be in other units
};

namespace detail {

/// Takes a robot out of a document.
class UrdfReader {
 public:
  UrdfReader(const UrdfDocument& document, const UrdfOptions& options)
      : document_(document), options_(options), notices_(document, options.kinematic) {}

  [[nodiscard]] UrdfDescription read() {
    check_options();
    result_ = {.file = document_.file,
               .name = name_of(document_, document_.robot->getName()),
               .gravity = options_.gravity,
               .right_angle_tolerance = options_.right_angle_tolerance,
               .allow_unphysical = options_.allow_unphysical,
               .kinematic = options_.kinematic,
               .transmissions = document_.transmissions,
               .initial_values = document_.initial_values};
    select();
    lock();
    if (!options_.tip.empty() && !options_.kinematic) {
      notices_.add_tip(options_.tip, left_out_by(document_, selected_, held_));
    }
    for (const urdf::Joint* joint : selected_) add(*joint);
    mend_mimic_limits(result_.joints, notices_);
    check();
    notices_.add_robot(result_.links, result_.joints);
    result_.notices = notices_.take();
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw UrdfError(document_.file, reason);
  }

  [[nodiscard]] const urdf::Link& link(const std::string& name, const char* what) const {
    const auto found = document_.robot->links_.find(name);
    if (found == document_.robot->links_.end()) {
      fail("link '" + name + "': it is to be the " + what + ", but does not exist" +
           choice_of(name, "links", names_of(document_.robot->links_)));
    }
    return *found->second;
  }

  template <class Elements>
  [[nodiscard]] static std::vector<std::string_view> names_of(const Elements& elements) {
    std::vector<std::string_view> names;
    for (const auto& [name, element] : elements) names.push_back(name);
    return names;
  }

  /// Finds the joints that are wanted, from the root outwards.
  void select() {
    const urdf::Link& root =
        options_.root.empty() ? *document_.robot->getRoot() : link(options_.root, "root");
    result_.links.push_back(link_of(document_, root));
    if (!options_.kinematic) notices_.add_root(root, options_.gravity);
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

  [[noreturn]] void fail(const std::string& joint, const std::string& reason) const {
    fail("joint '" + joint + "': " + reason);
  }

  void check_options() const {
    const double tolerance = options_.right_angle_tolerance;
    if (tolerance >= 0 && tolerance <= 0.1) return;
    fail("right_angle_tolerance: it is " + rounded_text(tolerance) + ", but must lie in 0 .. 0.1");
  }

  /// Where joints are held that are named.
  void lock() {
    for (const auto& [joint, position] : options_.locked) {
      const auto found = document_.robot->joints_.find(joint);
      if (found == document_.robot->joints_.end()) {
        fail(joint, "it is to be locked, but does not exist" +
                        choice_of(joint, "joints", names_of(document_.robot->joints_)));
      }
      if (!is_finite(position)) fail(joint, "it cannot be locked at " + rounded_text(position));
      const auto [held, first] = held_.try_emplace(joint, position);
      if (!first && held->second != position) {
        fail(joint, "it is to be locked at " + rounded_text(held->second) + " and at " +
                        rounded_text(position));
      }
      if (first) notices_.add_lock(*found->second, position);
    }
  }

  void add(const urdf::Joint& joint) {
    const Leader leader = leader_of(document_, held_, joint);
    const bool mimics = leader.joint != joint.name;
    if (const auto held = held_.find(leader.joint); held != held_.end()) {
      const double position = leader.multiplier * held->second + leader.offset;
      result_.joints.push_back(locked_joint_of(document_, joint, position));
      if (mimics) notices_.add_lock(joint, position);
    } else {
      result_.joints.push_back(joint_of(document_, joint));
      if (result_.joints.back().type != JointType::fixed) {
        LimitContradictions(document_, options_.kinematic, notices_)
            .check(joint, mimics ? leader.joint : "", result_.joints.back().limits);
      }
      if (mimics) {
        check_leader(joint.name, leader.joint);
        result_.joints.back().mimic = {name_of(document_, leader.joint), leader.multiplier,
                                       leader.offset};
        JointLimits& limits = result_.joints.back().limits;  // its soft limits do not count
        limits.soft_lower = -JointLimits::infinity;
        limits.soft_upper = limits.soft_rate = JointLimits::infinity;
      }
    }
    result_.links.push_back(link_of(document_, *document_.robot->links_.at(joint.child_link_name)));
  }

  /// Without its leader, nothing says where a joint is.
  void check_leader(const std::string& joint, const std::string& leader) const {
    const bool exists = document_.robot->joints_.contains(leader);  // else find_fault says so
    const bool is_selected = std::any_of(selected_.begin(), selected_.end(),
                                         [&](const auto* each) { return each->name == leader; });
    if (!exists || is_selected) return;
    fail(joint, "it mimics '" + leader + "', which is not between root and tip; lock '" + leader +
                    "' where it is to be, or choose root and tip with it between them");
  }

  void check() const {
    const DescriptionFault fault =
        find_fault(result_.name, result_.gravity, result_.links, result_.joints,
                   options_.allow_unphysical, options_.kinematic);
    if (fault.rule == Rule::none) return;
    std::string text = fault_text(fault, result_.links, result_.joints);
    if (concerns_inertia(fault.rule)) {
      text +=
          "; allow_unphysical (ALLOW_UNPHYSICAL in CMake) accepts it" + others_like(fault.element);
    }
    if (fault.rule == Rule::joint_moves_no_mass) {
      text +=
          "; without dynamics, load_kinematic_urdf (KINEMATIC in CMake) loads the robot and leaves "
          "out all masses";
    }
    fail(text + perhaps_because_of(document_.unknown_words, text));
  }

  /// The other links with inertias that cannot be: whoever accepts one of a file accepts them all.
  [[nodiscard]] std::string others_like(const Name& first) const {
    std::string names;
    for (const Link& link : result_.links) {
      if (link.name == first || !concerns_inertia(broken_rule(link))) continue;
      names += (names.empty() ? ", as it does '" : ", '") + std::string(link.name.view()) + "'";
    }
    return names;
  }

  const UrdfDocument& document_;
  const UrdfOptions& options_;
  UrdfDescription result_{};
  UrdfNotices notices_;
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
  const UrdfDocument document = parse_urdf(source, options.kinematic);
  return detail::UrdfReader(document, options).read();
}

}  // namespace articula
