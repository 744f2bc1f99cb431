// SPDX-License-Identifier: Apache-2.0
/// @file Lists the joints of a URDF with type, links, axis and limits.
///
///     urdf_joints robot.urdf [--moving] [--transmissions]
///                 [--model [--root LINK] [--tip LINK] [--lock JOINT]... [--allow-unphysical]]
///
/// With --model it also prints the call that loads the file, or that part of it: the sizes, the
/// joints in their order, and the notices. A robot without masses is shown as load_kinematic_urdf
/// loads it.
///
/// Exit status 0; 1 if the file cannot be read or is not URDF, 2 if the options are wrong.
#include <articula/model/build_model.hpp>
#include <articula/urdf/read_urdf.hpp>

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

std::string text_of(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

const char* type_name(int type) {
  switch (type) {
    case urdf::Joint::REVOLUTE:
      return "revolute";
    case urdf::Joint::CONTINUOUS:
      return "continuous";
    case urdf::Joint::PRISMATIC:
      return "prismatic";
    case urdf::Joint::FLOATING:
      return "floating";
    case urdf::Joint::PLANAR:
      return "planar";
    case urdf::Joint::FIXED:
      return "fixed";
    default:
      return "unknown";
  }
}

/// The type, links, axis and limits of a joint.
std::string properties(const articula::UrdfDocument& document, const urdf::Joint& joint) {
  std::string text = type_name(joint.type);
  text += ", " + joint.parent_link_name + " -> " + joint.child_link_name;
  if (joint.type == urdf::Joint::FIXED || joint.type == urdf::Joint::FLOATING) return text;
  const std::string unit = joint.type == urdf::Joint::PRISMATIC ? "m" : "rad";
  const std::string effort_unit = joint.type == urdf::Joint::PRISMATIC ? "N" : "N m";
  const urdf::Vector3& axis = joint.axis;
  text += ", axis " + text_of(axis.x) + " " + text_of(axis.y) + " " + text_of(axis.z);

  const articula::JointLimits limits = articula::joint_limits(document, joint);
  constexpr double infinity = articula::JointLimits::infinity;
  if (limits.lower > -infinity || limits.upper < infinity) {
    text += ", " + text_of(limits.lower) + " to " + text_of(limits.upper) + " " + unit;
  }
  if (limits.velocity < infinity) text += ", " + text_of(limits.velocity) + " " + unit + "/s";
  if (limits.effort < infinity) text += ", " + text_of(limits.effort) + " " + effort_unit;
  if (joint.dynamics) {
    text += ", damping " + text_of(joint.dynamics->damping) + " " + effort_unit + " s/" + unit +
            ", friction " + text_of(joint.dynamics->friction) + " " + effort_unit;
  }
  if (!document.robot->links_.at(joint.child_link_name)->inertial) {
    text += ", no mass in " + joint.child_link_name;
  }
  if (joint.mimic) {
    text += ", mimics " + joint.mimic->joint_name + ": " + text_of(joint.mimic->multiplier) +
            " q + " + text_of(joint.mimic->offset);
  }
  return text;
}

/// Prints all joints below a link, depth first.
void list(const articula::UrdfDocument& document, const urdf::Link& root, bool moving_only) {
  std::vector<urdf::JointSharedPtr> open;  // the next one last
  const auto add_joints = [&open](const urdf::Link& link) {
    open.insert(open.end(), link.child_joints.rbegin(), link.child_joints.rend());
  };
  add_joints(root);
  while (!open.empty()) {
    const urdf::JointSharedPtr next = open.back();
    const urdf::Joint& joint = *next;
    open.pop_back();
    add_joints(*document.robot->links_.at(joint.child_link_name));
    if (moving_only && joint.type == urdf::Joint::FIXED) continue;
    std::printf("%s: %s\n", joint.name.c_str(), properties(document, joint).c_str());
  }
}

void list_transmissions(const articula::UrdfDocument& document) {
  const auto print = [](const char* kind, const auto& ends) {
    for (const auto& end : ends) {
      std::printf(", %s %s (reduction %s)", kind, end.name.c_str(),
                  text_of(end.mechanical_reduction).c_str());
    }
  };
  for (const auto& transmission : document.transmissions) {
    std::printf("transmission %s: %s", transmission.name.c_str(), transmission.type.c_str());
    print("joint", transmission.joints);
    print("actuator", transmission.actuators);
    std::printf("\n");
  }
}

/// Prints the call that loads a robot, its joints and its notices.
void describe(const articula::UrdfDescription& description) {
  const articula::ModelSize size = articula::model_size(description->joints);
  std::printf("%s<%d", description->kinematic ? "load_kinematic_urdf" : "load_urdf", size.joints);
  if (size.bodies != size.joints) std::printf(", %d", size.bodies);
  const char* separator = ">: ";
  for (const articula::Joint& joint : description->joints) {
    if (joint.type == articula::JointType::fixed || !joint.mimic.joint.empty()) continue;
    std::printf("%s%s", separator, std::string(joint.name.view()).c_str());
    separator = ", ";
  }
  std::printf("\n");
  for (const std::string& notice : description->notices) std::printf("%s\n", notice.c_str());
}

/// Describes a file; if load_urdf refuses its masses, as a robot without masses.
void describe(const articula::UrdfDocument& document, articula::UrdfOptions options) {
  std::string reason;
  try {
    return describe(articula::read_urdf(document, options));
  } catch (const articula::FileError& error) {
    reason = error.what();
  }
  options.kinematic = true;
  try {
    describe(articula::read_urdf(document, options));
  } catch (const articula::FileError&) {  // the masses are not the only fault
    throw std::runtime_error(reason);
  }
  std::printf("load_urdf refuses it: %s\n", reason.c_str());
}

}  // namespace

int main(int count, char** words) {
  CLI::App app("Lists the joints of a URDF.");
  std::string file;
  bool moving_only = false, transmissions = false, model = false;
  articula::UrdfOptions options;
  std::vector<std::string> locked;
  app.add_option("file", file, "the URDF")->required();
  app.add_flag("--moving", moving_only, "skip fixed joints");
  app.add_flag("--transmissions", transmissions, "list the transmissions as well");
  app.add_flag("--model", model, "print the call that loads the file");
  app.add_option("--root", options.root, "the model's root link")->needs("--model");
  app.add_option("--tip", options.tip, "the link at which a chain ends")->needs("--model");
  app.add_option("--lock", locked, "a joint to hold at 0")
      ->needs("--model")
      ->allow_extra_args(false);  // one each time
  app.add_flag("--allow-unphysical", options.allow_unphysical, "accept inertias that no body has")
      ->needs("--model");
  try {
    app.parse(count, words);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "urdf_joints: %s\n", error.what());
    return 2;
  }
  try {
    const articula::UrdfDocument document = articula::parse_urdf(std::filesystem::path(file));
    list(document, *document.robot->getRoot(), moving_only);
    if (transmissions) list_transmissions(document);
    options.locked.assign(locked.begin(), locked.end());
    if (model) describe(document, options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "urdf_joints: %s\n", error.what());
    return 1;
  }
}
