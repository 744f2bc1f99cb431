// SPDX-License-Identifier: Apache-2.0
/// @file joints: the joints of a URDF with type, links, axis and limits.
#include "files/robot_file.hpp"
#include "program.hpp"
#include "table.hpp"

#include <articula/model/build_model.hpp>
#include <articula/urdf/read_urdf.hpp>

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace terminal {

namespace {

using articula::JointLimits;

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

bool has_axis(const urdf::Joint& joint) {
  return joint.type != urdf::Joint::FIXED && joint.type != urdf::Joint::FLOATING;
}

bool has_mass(const articula::UrdfDocument& document, const urdf::Joint& joint) {
  return document.robot->links_.at(joint.child_link_name)->inertial != nullptr;
}

/// The type, links, axis and limits of a joint, for people.
std::string properties(const articula::UrdfDocument& document, const urdf::Joint& joint) {
  std::string text = type_name(joint.type);
  text += ", " + joint.parent_link_name + " -> " + joint.child_link_name;
  if (!has_axis(joint)) return text;
  const std::string unit = joint.type == urdf::Joint::PRISMATIC ? "m" : "rad";
  const std::string effort_unit = joint.type == urdf::Joint::PRISMATIC ? "N" : "N m";
  const urdf::Vector3& axis = joint.axis;
  text += ", axis " + text_of(axis.x) + " " + text_of(axis.y) + " " + text_of(axis.z);

  const JointLimits limits = articula::joint_limits(document, joint);
  constexpr double infinity = JointLimits::infinity;
  if (limits.lower > -infinity || limits.upper < infinity) {
    text += ", " + text_of(limits.lower) + " to " + text_of(limits.upper) + " " + unit;
  }
  if (limits.velocity < infinity) text += ", " + text_of(limits.velocity) + " " + unit + "/s";
  if (limits.effort < infinity) text += ", " + text_of(limits.effort) + " " + effort_unit;
  if (joint.dynamics) {
    text += ", damping " + text_of(joint.dynamics->damping) + " " + effort_unit + " s/" + unit +
            ", friction " + text_of(joint.dynamics->friction) + " " + effort_unit;
  }
  if (!has_mass(document, joint)) text += ", no mass in " + joint.child_link_name;
  if (joint.mimic) {
    text += ", mimics " + joint.mimic->joint_name + ": " + text_of(joint.mimic->multiplier) +
            " q + " + text_of(joint.mimic->offset);
  }
  return text;
}

/// The same for programs. A limit that is not there is null.
Json properties_json(const articula::UrdfDocument& document, const urdf::Joint& joint) {
  Json json{{"name", joint.name},
            {"type", type_name(joint.type)},
            {"parent", joint.parent_link_name},
            {"child", joint.child_link_name}};
  if (!has_axis(joint)) return json;
  const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(); };
  const JointLimits limits = articula::joint_limits(document, joint);
  json["axis"] = {joint.axis.x, joint.axis.y, joint.axis.z};
  json["limits"] = {{"lower", number(limits.lower)},
                    {"upper", number(limits.upper)},
                    {"velocity", number(limits.velocity)},
                    {"effort", number(limits.effort)}};
  json["damping"] = joint.dynamics ? joint.dynamics->damping : 0.0;
  json["friction"] = joint.dynamics ? joint.dynamics->friction : 0.0;
  json["child_has_mass"] = has_mass(document, joint);
  if (joint.mimic) {
    json["mimic"] = {{"joint", joint.mimic->joint_name},
                     {"multiplier", joint.mimic->multiplier},
                     {"offset", joint.mimic->offset}};
  }
  return json;
}

/// What is printed: JSON for programs, lines for people.
struct Listing {
  Json json = Json::object();
  std::string text{};

  void add_line(const std::string& line) { text += (text.empty() ? "" : "\n") + line; }
};

/// Lists all joints below a link, depth first.
void list(const articula::UrdfDocument& document, const urdf::Link& root, bool moving_only,
          Listing& listing) {
  Json& joints = listing.json["joints"] = Json::array();
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
    joints.push_back(properties_json(document, joint));
    listing.add_line(joint.name + ": " + properties(document, joint));
  }
}

void list_transmissions(const articula::UrdfDocument& document, Listing& listing) {
  Json& transmissions = listing.json["transmissions"] = Json::array();
  for (const auto& transmission : document.transmissions) {
    std::string line = "transmission " + transmission.name + ": " + transmission.type;
    Json json{{"name", transmission.name}, {"type", transmission.type}};
    const auto add = [&](const char* kind, const auto& ends) {
      for (const auto& end : ends) {
        line += std::string(", ") + kind + " " + end.name + " (reduction " +
                text_of(end.mechanical_reduction) + ")";
        json[std::string(kind) + "s"].push_back(
            {{"name", end.name}, {"reduction", end.mechanical_reduction}});
      }
    };
    add("joint", transmission.joints);
    add("actuator", transmission.actuators);
    transmissions.push_back(json);
    listing.add_line(line);
  }
}

/// Describes the call that loads a robot, its joints and its notices.
void describe(const articula::UrdfDescription& description, Listing& listing) {
  const articula::ModelSize size = articula::model_size(description->joints);
  const std::string call =
      std::string(description->kinematic ? "load_kinematic_urdf<" : "load_urdf<") +
      std::to_string(size.joints) +
      (size.bodies == size.joints ? "" : ", " + std::to_string(size.bodies)) + ">";
  std::string line = call;
  Json joints = Json::array();
  for (const articula::Joint& joint : description->joints) {
    if (joint.type == articula::JointType::fixed || !joint.mimic.joint.empty()) continue;
    line += (joints.empty() ? ": " : ", ") + std::string(joint.name.view());
    joints.push_back(joint.name.view());
  }
  listing.add_line(line);
  for (const std::string& notice : description->notices) listing.add_line(notice);
  listing.json["model"] = {{"call", call},
                           {"joints", joints},
                           {"bodies", size.bodies},
                           {"notices", description->notices}};
}

/// Describes a file; if load_urdf refuses its masses, as a robot without masses.
void describe(const articula::UrdfDocument& document, articula::UrdfOptions options,
              Listing& listing) {
  std::string reason;
  try {
    return describe(articula::read_urdf(document, options), listing);
  } catch (const articula::FileError& error) {
    reason = error.what();
  }
  options.kinematic = true;
  try {
    describe(articula::read_urdf(document, options), listing);
  } catch (const articula::FileError&) {  // the masses are not the only fault
    throw Refusal(reason);
  }
  listing.add_line("load_urdf refuses it: " + reason);
  listing.json["model"]["without_masses_because"] = reason;
}

struct Joints {
  std::string file{};
  bool moving_only = false, transmissions = false, model = false;
  articula::UrdfOptions options{};
  std::vector<std::string> locked{};
};

/// Prints what the library reports about a file, or why it does not load it.
void print_notes(const articula::UrdfDocument& document, const std::string& file) {
  const auto print = [&](const std::string& text) {
    std::fprintf(stderr, "note: %s: %s\n", file.c_str(), text.c_str());
  };
  try {
    const articula::UrdfDescription description = articula::read_urdf(document);
    for (const std::string& notice : description->notices) print(notice);
  } catch (const articula::FileError& error) {
    print(std::string("load_urdf refuses it: ") + error.what());
  }
}

void print_joints(const Program& program, Joints arguments) {
  const articula::UrdfDocument document = articula::parse_urdf(robot_source(arguments.file));
  Listing listing;
  list(document, *document.robot->getRoot(), arguments.moving_only, listing);
  if (arguments.transmissions) list_transmissions(document, listing);
  arguments.options.locked.assign(arguments.locked.begin(), arguments.locked.end());
  if (arguments.model) {
    describe(document, arguments.options, listing);
  } else {
    print_notes(document, arguments.file);
  }
  program.print(listing.json, listing.text);
}

}  // namespace

void add_joints_command(CLI::App& app, Program& program) {
  const auto joints = std::make_shared<Joints>();
  CLI::App* command =
      add_command(app, program, "joints", "Lists the joints of a URDF: type, links, axis, limits.",
                  [&program, joints] { print_joints(program, *joints); });
  command->add_option("file", joints->file, "the URDF, or a .xacro")->required();
  command->add_flag("--moving", joints->moving_only, "skip fixed joints");
  command->add_flag("--transmissions", joints->transmissions, "list the transmissions as well");
  command->add_flag("--model", joints->model, "print the call that loads the file");
  command->add_option("--root", joints->options.root, "the model's root link")->needs("--model");
  command->add_option("--tip", joints->options.tip, "the link at which a chain ends")
      ->needs("--model");
  command->add_option("--lock", joints->locked, "a joint to hold at 0")
      ->needs("--model")
      ->allow_extra_args(false);  // one each time
  command
      ->add_flag("--allow-unphysical", joints->options.allow_unphysical,
                 "accept inertias that no body has")
      ->needs("--model");
}

}  // namespace terminal
