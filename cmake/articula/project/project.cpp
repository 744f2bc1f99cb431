// SPDX-License-Identifier: Apache-2.0
#include "project/project.hpp"

#include "files/mesh_folders.hpp"
#include "files/robot_file.hpp"
#include "program.hpp"

#include <articula/config/yaml/filled_text.hpp>
#include <articula/text/numbers.hpp>
#include <articula/urdf/read_urdf.hpp>
#include <articula/version.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>
#include <system_error>

namespace terminal {

namespace {

namespace fs = std::filesystem;
using articula::detail::number_text;

/// The name of a struct for a file's name: MyArm for my-arm.urdf.
std::string type_name(const std::string& stem) {
  std::string name;
  bool begins = true;
  for (const char c : stem) {
    const bool is_small = c >= 'a' && c <= 'z', is_large = c >= 'A' && c <= 'Z';
    if (!is_small && !is_large && !(c >= '0' && c <= '9')) {
      begins = true;
      continue;
    }
    name += begins && is_small    ? static_cast<char>(c - 'a' + 'A')
            : !begins && is_large ? static_cast<char>(c - 'A' + 'a')
                                  : c;
    begins = false;
  }
  if (name.empty() || (name[0] >= '0' && name[0] <= '9')) name.insert(0, "Robot");
  return name;
}

/// The same in snake case, as articula_add_robot names the header.
std::string snake_case(const std::string& type) {
  std::string name = std::regex_replace(type, std::regex("([A-Z]+)([A-Z][a-z])"), "$1_$2");
  name = std::regex_replace(name, std::regex("([a-z0-9])([A-Z])"), "$1_$2");
  for (char& c : name) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return name;
}

/// A text as a string in C++.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      throw std::invalid_argument("the name '" + text + "' has a control character");
    }
    result += c;
  }
  return result + "\"";
}

/// An argument of CMake, with what has a meaning for it escaped.
std::string argument(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\' || c == '$' || c == ';') result += '\\';
    result += c;
  }
  return result + "\"";
}

bool has_gains(const ControllersPlan& plan) {
  for (const PlannedController& controller : plan.controllers) {
    if (traits_of(controller.kind).has_gains) return true;
  }
  return false;
}

/// Whether the program reads the controllers' file.
bool reads_file(const ControllersPlan& plan) {
  return has_gains(plan) || !sections_with_tolerances(plan).empty();
}

std::string cmake_lists(const std::string& type, const std::string& program,
                        const ProjectOptions& options, bool has_visuals) {
  const ControllersPlan& plan = options.controllers;
  const bool is_on_bus = !options.drives.interface.empty();
  std::string definitions;
  if (reads_file(plan)) {
    definitions += "\n  PRIVATE CONTROLLERS=\"${CMAKE_CURRENT_SOURCE_DIR}/controllers.yaml\"";
  }
  if (has_visuals) definitions += "\n  PRIVATE URDF=\"${CMAKE_CURRENT_SOURCE_DIR}/robot.urdf\"";
  const std::string components = std::string("urdf view") + (reads_file(plan) ? " config" : "") +
                                 (is_on_bus ? " socketcan" : "");
  return project_lines(program, components, type, plan, options.allows_unphysical,
                       options.is_kinematic) +
         "add_executable(" + program + " main.cpp)\n" + "target_link_libraries(" + program +
         " PRIVATE " + type + " articula::view" + (reads_file(plan) ? " articula::config" : "") +
         (is_on_bus ? " articula::socketcan" : "") + ")\n" +
         (definitions.empty() ? "" : "target_compile_definitions(" + program + definitions + ")\n");
}

/// The type and the value of the controllers of some joints.
struct Code {
  std::string type{}, value{};
};

/// A Switch with the controllers of a group. Joints without a controller are held.
Code switch_code(const std::string& robot, const ProjectOptions& options, const PlannedGroup& group,
                 const std::string& indent) {
  const ControllersPlan& plan = options.controllers;
  Code code;
  std::string names, values;
  const auto add = [&](ControllerKind kind, const std::string& name, const std::string& section) {
    const KindTraits& traits = traits_of(kind);
    const std::string type = "articula::" + std::string(traits.class_name) + "<" + robot + ">";
    code.type += ", " + type;
    names += (names.empty() ? "" : ", ") + quoted(name);
    values += ",\n" + indent + "  " + type +
              (traits.has_gains ? "(gains(" + quoted(section) + "))" : "()");
  };
  for (const std::size_t at : group.controllers) {
    const PlannedController& controller = plan.controllers[at];
    add(controller.kind, controller.name, controller.section);
  }
  std::string active;
  if (group.controllers.empty()) {
    const ControllerKind forward = plan.drives == Drives::efforts ? ControllerKind::bypass
                                   : plan.drives == Drives::velocities
                                       ? ControllerKind::forward_velocity
                                       : ControllerKind::forward_position;
    add(forward, std::string(traits_of(forward).name), "");
    active = ", .active = \"\"";
  }
  // Passed-on efforts are 0 until somebody commands some: an arm of real drives would fall.
  const bool is_on_bus = !options.drives.interface.empty();
  if (is_on_bus && !group.controllers.empty() &&
      plan.controllers[group.controllers.front()].kind == ControllerKind::bypass) {
    active = ", .active = \"\"";
  }
  code.type = "articula::Switch<" + robot + code.type + ">";
  code.value = "({.names = {" + names + "}" + active + "}" + values + ")";
  return code;
}

/// The lines that make `controllers`.
std::string controllers_code(const std::string& robot, const ProjectOptions& options) {
  const ControllersPlan& plan = options.controllers;
  std::string gains;
  if (has_gains(plan)) {
    gains =
        "  const auto gains = [](const char* controller) {\n"
        "    return articula::load_pid_gains(" +
        robot +
        "(), CONTROLLERS, controller,\n"
        "                                    articula::GainsOf::some_joints)\n"
        "        .gains;\n"
        "  };\n";
  }
  if (options.groups.size() == 1) {
    const Code code = switch_code(robot, options, options.groups.front(), "  ");
    return gains + "  const " + code.type + " controllers" + code.value + ";\n";
  }
  std::string types, groups, values;
  for (const PlannedGroup& group : options.groups) {
    const Code code = switch_code(robot, options, group, "      ");
    std::string joints;
    for (const std::string& joint : group.joints) {
      joints += (joints.empty() ? "" : ", ") + quoted(joint);
    }
    const std::string name =
        group.controllers.empty() ? "others" : plan.controllers[group.controllers.front()].name;
    types += ",\n      " + code.type;
    groups += std::string(groups.empty() ? "" : ",\n        ") + "{" + quoted(name) + ", {" +
              joints + "}}";
    values += ",\n      " + code.type + code.value;
  }
  return gains + "  const articula::Groups<" + robot + types + "> controllers(\n      {{" + groups +
         "}}" + values + ");\n";
}

/// The hardware of a project: what it is, the headers that it needs, lines that prepare it, and the
/// expression that makes it.
struct HardwareCode {
  std::string what{}, headers{}, lines{}, value{};
};

HardwareCode hardware_code(const std::string& type, const ProjectOptions& options) {
  const ControllersPlan& plan = options.controllers;
  const std::string period = number_text(plan.period);
  const std::string count = "<articula::joint_count<" + type + ">>";
  const std::string command = "articula::" +
                              std::string(plan.drives == Drives::efforts      ? "EffortCommand"
                                          : plan.drives == Drives::velocities ? "VelocityCommand"
                                                                              : "PositionCommand") +
                              count;
  const PlannedDrives& drives = options.drives;
  if (!drives.interface.empty()) {
    std::string lines = "  const articula::" + drives.list + count + " drives{{\n";
    for (const PlannedDrive& drive : drives.drives) {
      lines += "      // " + drive.joint + "\n      " + drive.code + ",\n";
    }
    const std::string codec = "articula::" + drives.codec + "<" + type +
                              (drives.commands_efforts_only ? "" : ", " + command) + ">";
    lines += "  }};\n  using Codec = " + codec + ";\n  using Can = articula::CanHardware<" + type +
             ", Codec, articula::SocketCan>;\n";
    return {"on the CAN bus " + drives.interface,
            "#include <articula/hardware/can/can_hardware.hpp>\n"
            "#include <articula/hardware/can/socketcan.hpp>\n#include <" +
                drives.header + ">\n",
            lines, "Can(Codec(drives), articula::SocketCan(" + quoted(drives.interface) + "))"};
  }
  if (options.is_mock) {
    return {"as a mock", "#include <articula/hardware/mock/mock_hardware.hpp>\n", "",
            "articula::MockHardware<" + type + ", " + command + ">({}, " + period + ")"};
  }
  const std::string substeps =
      plan.substeps > 1 ? ", .substeps = " + std::to_string(plan.substeps) : "";
  return {"in simulation", "", "",
          "articula::Simulator<" + type + ">({.period = " + period + substeps + "})"};
}

std::string main_file(const std::string& type, const ProjectOptions& options,
                      const std::string& show_options) {
  const ControllersPlan& plan = options.controllers;
  const HardwareCode hardware = hardware_code(type, options);
  const bool is_on_bus = !options.drives.interface.empty();
  const std::string body =
      controllers_code(type, options) + hardware.lines +
      (is_on_bus ? ""
                 : "  // A desktop's overruns harm no simulation; a real robot omits this.\n") +
      "  articula::SupervisedControlLoop arm(" + hardware.value +
      ", controllers,\n"
      "                                      {" +
      (is_on_bus ? "" : ".overruns = 1000000") + "}, " + number_text(plan.period) +
      ");\n"
      "  arm.request_activation();\n"
      "  // http://127.0.0.1:8765, and `articula status`; options as --port 8766.\n"
      "  return articula::show_with_arguments(arm, count, words" +
      show_options + ");\n";
  return "// The robot of robot.urdf " + hardware.what +
         ", with the controllers of controllers.yaml.\n"
         "#include <articula/articula.hpp>\n" +
         std::string(has_gains(plan) ? "#include <articula/config/load_pid_gains.hpp>\n" : "") +
         (sections_with_tolerances(plan).empty()
              ? ""
              : "#include <articula/config/load_trajectory_tolerances.hpp>\n") +
         hardware.headers +
         "#include <articula/view/show_arguments.hpp>\n"
         "#include <" +
         snake_case(type) + ".hpp>\n\n" +
         (is_on_bus ? "#include <cstdio>\n#include <exception>\n\n" : "") +
         "int main(int count, char** words) " +
         // The driver refuses an interface that is not there, and drives that do not fit the robot.
         (is_on_bus ? "try {\n" + body +
                          "} catch (const std::exception& error) {\n"
                          "  std::fprintf(stderr, \"%s\\n\", error.what());\n"
                          "  return 1;\n}\n"
                    : "{\n" + body + "}\n");
}

/// The options of `show`: what a robot on a bus needs of its thread, and what a robot with visuals
/// shows.
std::string show_options(const std::string& type, const ProjectOptions& options, bool has_visuals) {
  std::vector<std::string> all;
  std::string folders;
  if (has_visuals) {
    for (const auto& [package, folder] : mesh_folders(options.urdf, options.robot)) {
      folders += (folders.empty() ? "" : ", ") + std::string("{") + quoted(package) + ", " +
                 quoted(folder) + "}";
    }
  }
  if (!folders.empty()) {
    all.push_back(".view = {.operates = true,\n                .mesh_folders = {" + folders + "}}");
  }
  const ControllersPlan& plan = options.controllers;
  std::string processors;
  for (const int processor : plan.processors) {
    processors += (processors.empty() ? "" : ", ") + std::to_string(processor);
  }
  if (!processors.empty()) processors = ", .processors = {" + processors + "}";
  if (!options.drives.interface.empty()) {
    all.push_back(".thread = {.priority = " +
                  std::to_string(plan.priority > 0 ? plan.priority : 80) + processors + "}");
  } else if (!processors.empty()) {
    all.push_back(".thread = {.priority = 0" + processors + ", .lock_memory = false}");
  }
  if (has_visuals) all.emplace_back(".urdf = URDF");
  std::string text;
  for (const std::string& each : all) text += (text.empty() ? "" : ",\n       ") + each;
  std::string sections;
  for (const std::string& section : sections_with_tolerances(plan)) {
    sections += (sections.empty() ? "" : ", ") + quoted(section);
  }
  if (!sections.empty()) {
    return ",\n      {" + text + "},\n      {.tolerances = articula::load_all_tolerances(" + type +
           "(), CONTROLLERS, {" + sections + "})}";
  }
  return all.empty() ? "" : ",\n      {" + text + "}";
}

std::string contents_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(stream)), {});
  if (!stream) throw Refusal(file + ": the file cannot be read");
  return text;
}

/// The controllers' files as one, with values in place of their placeholders.
std::string filled_text(const articula::ConfigSource& source) {
  std::string text =
      articula::detail::FilledText(source.name(), source.contents(), source.values()).text();
  for (const articula::ConfigSource& further : source.further()) {
    text += '\n' + filled_text(further);
  }
  return text;
}

}  // namespace

articula::UrdfDescription read_robot(const articula::UrdfSource& source,
                                     const ControllersPlan& plan, bool allows_unphysical,
                                     Mover mover) {
  articula::UrdfOptions reading;
  reading.root = plan.root;
  reading.tip = plan.tip;
  reading.allow_unphysical = allows_unphysical;
  if (plan.gravity) reading.gravity = *plan.gravity;
  const bool needs_masses = mover == Mover::simulation || plan.drives == Drives::efforts;
  std::string reason;
  try {
    return articula::read_urdf(source, reading);
  } catch (const articula::FileError& error) {
    if (needs_masses) throw;
    reason = error.what();
  }
  reading.kinematic = true;
  try {
    articula::UrdfContents contents = *articula::read_urdf(source, reading);
    contents.notices.push_back("its masses are not used: " + reason);
    return articula::UrdfDescription(std::move(contents));
  } catch (const articula::FileError&) {  // the masses are not the only fault
    throw Refusal(reason);
  }
}

std::string project_lines(const std::string& program, const std::string& components,
                          const std::string& type, const ControllersPlan& plan,
                          bool allows_unphysical, bool is_kinematic) {
  std::string robot = "articula_add_robot(" + type + " URDF robot.urdf";
  if (!plan.root.empty()) robot += " ROOT " + argument(plan.root);
  if (!plan.tip.empty()) robot += " TIP " + argument(plan.tip);
  if (plan.gravity) {
    robot += " GRAVITY " + number_text(plan.gravity->x) + " " + number_text(plan.gravity->y) + " " +
             number_text(plan.gravity->z);
  }
  if (allows_unphysical) robot += " ALLOW_UNPHYSICAL";
  if (is_kinematic) robot += " KINEMATIC";
  return "cmake_minimum_required(VERSION 3.25)\n"
         "project(" +
         program +
         " LANGUAGES CXX)\n"
         "if(NOT CMAKE_BUILD_TYPE)\n"
         "  set(CMAKE_BUILD_TYPE Release)\n"
         "endif()\n\n"
         "find_package(articula " +
         std::string(articula::library_version) + " REQUIRED COMPONENTS " + components + ")\n" +
         robot + ")\n\n";
}

Project make_project(const ProjectOptions& options) {
  std::string stem = fs::path(options.robot).stem().string();
  if (stem.ends_with(".urdf")) stem = fs::path(stem).stem().string();  // arm.urdf.xacro
  const std::string type = type_name(stem);
  Project project{.name = snake_case(type)};
  const bool has_visuals = options.urdf.find("<visual") != std::string::npos;
  project.files = {
      {"robot.urdf", options.urdf},
      {"controllers.yaml", filled_text(options.controllers.source)},
      {"CMakeLists.txt", cmake_lists(type, project.name, options, has_visuals)},
      {"main.cpp", main_file(type, options, show_options(type, options, has_visuals))}};
  return project;
}

void write_project(const Project& project, const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Refusal(folder + ": " + error.message());
  for (const auto& [name, text] : project.files) {
    const fs::path file = fs::path(folder) / name;
    if (fs::exists(file, error) && contents_of(file.string()) == text) continue;
    std::ofstream stream(file, std::ios::binary);
    stream << text << std::flush;
    if (!stream) throw Refusal(file.string() + ": the file cannot be written");
  }
}

}  // namespace terminal
