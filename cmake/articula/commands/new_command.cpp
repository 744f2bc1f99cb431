// SPDX-License-Identifier: Apache-2.0
/// @file new: a project that compiles the loop which `articula run` makes from the same files.
#include "commands/notes.hpp"
#include "files/robot_file.hpp"
#include "program.hpp"
#include "project/project.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace terminal {

namespace {

namespace fs = std::filesystem;

struct New {
  std::string robot{}, output{}, bus{};
  std::vector<std::string> controllers{}, chosen{};
  articula::ConfigValues values{};  ///< of placeholders in the controllers' file
  bool allows_unphysical = false;
};

void write_new(const Program& program, const New& options) {
  const ControllersPlan plan =
      read_controllers(controllers_source(options.controllers, options.values), options.chosen);
  const articula::UrdfSource source = robot_source(options.robot);
  const articula::UrdfDescription robot =
      read_robot(source, plan, options.allows_unphysical,
                 options.bus.empty() ? Mover::simulation : Mover::drives);
  const std::vector<PlannedGroup> groups = joint_groups(robot, plan);
  print_notes(plan, groups, robot, options.robot);
  PlannedDrives drives;
  if (!options.bus.empty()) drives = read_drives(plan, options.bus, robot);
  const Project project = make_project({.robot = options.robot,
                                        .urdf = source.text(),
                                        .controllers = plan,
                                        .groups = groups,
                                        .allows_unphysical = options.allows_unphysical,
                                        .is_kinematic = robot->kinematic,
                                        .drives = drives});
  const std::string where = options.output.empty() ? project.name : options.output;
  std::error_code error;
  if (fs::exists(where, error) && !fs::is_empty(where, error)) {
    throw Refusal(where + ": the folder is not empty; name another one by --output");
  }
  write_project(project, where);
  Json commands = {"cmake -S " + where + " -B " + where + "/build",
                   "cmake --build " + where + "/build", where + "/build/" + project.name};
  std::string lines = where + " is written; build and run it by:";
  for (const Json& command : commands) lines += "\n  " + command.get<std::string>();
  program.print({{"folder", where}, {"robot", robot->name.view()}, {"commands", commands}}, lines);
}

}  // namespace

void add_new_command(CLI::App& app, Program& program) {
  const auto options = std::make_shared<New>();
  CLI::App* command = add_command(app, program, "new",
                                  "Writes a project that compiles a robot and its controllers.",
                                  [&program, options] { write_new(program, *options); });
  command->add_option("robot", options->robot, "the URDF, or a .xacro")->required();
  command->add_option("controllers", options->controllers, "YAML files of ROS's controllers")
      ->required();
  command->add_option("--controller", options->chosen, "one of the file to use, in place of all")
      ->allow_extra_args(false);
  add_values_option(*command, options->values);
  command->add_option("--output", options->output, "the folder")->default_str("the robot's name");
  command
      ->add_option("--can", options->bus,
                   "the real robot: the CAN interface of the drives that the YAML describes")
      ->type_name("INTERFACE");
  command->add_flag("--allow-unphysical", options->allows_unphysical,
                    "accept inertias that no body has");
}

}  // namespace terminal
