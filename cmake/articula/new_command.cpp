// SPDX-License-Identifier: Apache-2.0
/// @file new: a project that compiles the loop which `articula run` makes from the same files.
#include "controllers_file.hpp"
#include "program.hpp"
#include "robot_file.hpp"

#include <articula/text/numbers.hpp>
#include <articula/urdf/read_urdf.hpp>
#include <articula/version.hpp>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

namespace terminal {

namespace {

namespace fs = std::filesystem;
using articula::detail::number_text;

struct New {
  std::string robot{}, controllers{}, output{};
  std::vector<std::string> chosen{};
  bool allows_unphysical = false;
};

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

std::string cmake_lists(const std::string& type, const std::string& program,
                        const ControllersPlan& plan, const New& options) {
  const bool has_gains = [&] {
    for (const auto& controller : plan.controllers) {
      if (traits_of(controller.kind).has_gains) return true;
    }
    return false;
  }();
  std::string robot = "articula_add_robot(" + type + " URDF robot.urdf";
  if (!plan.root.empty()) robot += " ROOT " + argument(plan.root);
  if (!plan.tip.empty()) robot += " TIP " + argument(plan.tip);
  if (plan.gravity) {
    robot += " GRAVITY " + number_text(plan.gravity->x) + " " + number_text(plan.gravity->y) + " " +
             number_text(plan.gravity->z);
  }
  if (options.allows_unphysical) robot += " ALLOW_UNPHYSICAL";
  return "cmake_minimum_required(VERSION 3.25)\n"
         "project(" +
         program +
         " LANGUAGES CXX)\n"
         "if(NOT CMAKE_BUILD_TYPE)\n"
         "  set(CMAKE_BUILD_TYPE Release)\n"
         "endif()\n\n"
         "find_package(articula " +
         std::string(articula::library_version) + " REQUIRED COMPONENTS urdf view" +
         (has_gains ? " config" : "") + ")\n" + robot +
         ")\n\n"
         "add_executable(" +
         program + " main.cpp)\n" + "target_link_libraries(" + program + " PRIVATE " + type +
         " articula::view" + (has_gains ? " articula::config" : "") + ")\n" +
         (has_gains
              ? "target_compile_definitions(" + program +
                    "\n  PRIVATE CONTROLLERS=\"${CMAKE_CURRENT_SOURCE_DIR}/controllers.yaml\")\n"
              : "");
}

std::string main_file(const std::string& type, const ControllersPlan& plan) {
  std::string kinds, names, controllers;
  bool has_gains = false;
  for (const PlannedController& controller : plan.controllers) {
    const KindTraits& traits = traits_of(controller.kind);
    const std::string of_robot = "articula::" + std::string(traits.class_name) + "<" + type + ">";
    kinds += ",\n                                     " + of_robot;
    names += (names.empty() ? "" : ", ") + quoted(controller.name);
    controllers += ",\n      " + of_robot;
    controllers += traits.has_gains ? "(gains(" + quoted(controller.section) + "))" : "()";
    has_gains = has_gains || traits.has_gains;
  }
  const std::string period = number_text(plan.period);
  const std::string substeps =
      plan.substeps > 1 ? ", .substeps = " + std::to_string(plan.substeps) : "";
  return "// The robot of robot.urdf in simulation, with the controllers of controllers.yaml. For "
         "the\n"
         "// real robot put its driver in place of articula::Simulator.\n"
         "#include <articula/articula.hpp>\n" +
         std::string(has_gains ? "#include <articula/config/load_pid_gains.hpp>\n" : "") +
         "#include <articula/view/show.hpp>\n"
         "#include <" +
         snake_case(type) +
         ".hpp>\n\n"
         "using Controllers = articula::Switch<" +
         type + kinds +
         ">;\n\n"
         "int main() {\n" +
         (has_gains ? "  const auto gains = [](const char* controller) {\n"
                      "    return articula::load_pid_gains(" +
                          type +
                          "(), CONTROLLERS, controller).gains;\n"
                          "  };\n"
                    : "") +
         "  const Controllers controllers(\n"
         "      {.names = {" +
         names + "}}" + controllers +
         ");\n"
         "  // `overruns` bears those of a desktop machine; leave it out for a real robot.\n"
         "  articula::SupervisedControlLoop arm(articula::Simulator<" +
         type + ">({.period = " + period + substeps +
         "}), controllers,\n"
         "                                      {.overruns = 1000000}, " +
         period +
         ");\n"
         "  arm.request_activation();\n"
         "  return articula::show(arm);  // http://127.0.0.1:8765, and `articula status`\n"
         "}\n";
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text << std::flush;
  if (!stream) throw Refusal(file.string() + ": the file cannot be written");
}

void make_project(const Program& program, const New& options) {
  const ControllersPlan plan = read_controllers(options.controllers, options.chosen);
  const articula::UrdfSource source = robot_source(options.robot);
  articula::UrdfOptions reading;
  reading.root = plan.root;
  reading.tip = plan.tip;
  reading.allow_unphysical = options.allows_unphysical;
  if (plan.gravity) reading.gravity = *plan.gravity;
  const articula::UrdfDescription robot = articula::read_urdf(source, reading);

  std::string stem = fs::path(options.robot).stem().string();
  if (stem.ends_with(".urdf")) stem = fs::path(stem).stem().string();  // arm.urdf.xacro
  const std::string type = type_name(stem), name = snake_case(type);
  const fs::path folder = options.output.empty() ? fs::path(name) : fs::path(options.output);
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_empty(folder, error)) {
    throw Refusal(folder.string() + ": the folder is not empty; name another one by --output");
  }
  fs::create_directories(folder, error);
  if (error) throw Refusal(folder.string() + ": " + error.message());
  write(folder / "robot.urdf", source.text());
  fs::copy_file(options.controllers, folder / "controllers.yaml", error);
  if (error) throw Refusal(options.controllers + ": " + error.message());
  write(folder / "CMakeLists.txt", cmake_lists(type, name, plan, options));
  write(folder / "main.cpp", main_file(type, plan));

  const std::string where = folder.string();
  Json commands = {"cmake -S " + where + " -B " + where + "/build",
                   "cmake --build " + where + "/build", where + "/build/" + name};
  std::string lines = where + " is written; build and run it by:";
  for (const Json& command : commands) lines += "\n  " + command.get<std::string>();
  program.print({{"folder", where}, {"robot", robot->name.view()}, {"commands", commands}}, lines);
}

}  // namespace

void add_new_command(CLI::App& app, Program& program) {
  const auto options = std::make_shared<New>();
  CLI::App* command = add_command(app, program, "new",
                                  "Writes a project that compiles a robot and its controllers.",
                                  [&program, options] { make_project(program, *options); });
  command->add_option("robot", options->robot, "the URDF, or a .xacro")->required();
  command->add_option("controllers", options->controllers, "YAML of ROS's controllers")->required();
  command->add_option("--controller", options->chosen, "one of the file to use, in place of all")
      ->allow_extra_args(false);
  command->add_option("--output", options->output, "the folder")->default_str("the robot's name");
  command->add_flag("--allow-unphysical", options->allows_unphysical,
                    "accept inertias that no body has");
}

}  // namespace terminal
