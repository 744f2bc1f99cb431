// SPDX-License-Identifier: Apache-2.0
/// @file run: a robot from a URDF with the controllers of a YAML file, without a compiler.
#include "commands/notes.hpp"
#include "files/controllers_file.hpp"
#include "files/drives_file.hpp"
#include "files/joint_groups.hpp"
#include "files/mesh_folders.hpp"
#include "files/robot_file.hpp"
#include "files/within.hpp"
#include "loops/loop_plan.hpp"
#include "program.hpp"
#include "project/cached_build.hpp"
#include "project/project.hpp"
#include "ros2/ros2_options.hpp"
#include "table.hpp"

#include <articula/model/build_model.hpp>
#include <articula/text/numbers.hpp>
#include <articula/view/open_in_browser.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace terminal {

namespace {

namespace fs = std::filesystem;

struct Run {
  std::string robot{};
  std::vector<std::string> controllers{};
  std::string command{};  ///< without a file of controllers: the quantity that is passed on
  std::vector<std::string> chosen{};
  articula::ConfigValues values{};  ///< of placeholders in the controllers' file
  bool is_mock = false, shows = false, is_read_only = false, allows_unphysical = false;
  bool compiles = false;
  std::string bus{};  ///< the CAN interface of the robot's drives; empty: there is none
  int priority = -1;  ///< of the loop's thread; -1: that of the file or 80 with a bus, else 0
  int substeps = 0;   ///< 0: so many that none is longer than a millisecond
  double rate = 0;    ///< of the loop [Hz]; 0: that of the file
  double seconds = std::numeric_limits<double>::infinity();
  Ros2Options ros2{};
};

using RunLoop = LoopEnd (*)(const LoopPlan&);

/// The sizes of robots for which there is a loop.
constexpr auto ready_sizes = std::to_array<articula::ModelSize>({ARTICULA_RUN_SIZES});

template <std::size_t... At>
std::array<RunLoop, sizeof...(At)> all_loops(std::index_sequence<At...>) {
  return {&run_loop<ready_sizes[At].joints, ready_sizes[At].bodies>...};
}

/// A size in words: "7 joints and 5 mimic joints".
std::string size_text(const articula::ModelSize& size) {
  const auto count = [](int number, const std::string& what) {
    return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
  };
  const int mimics = size.bodies - size.joints;
  return count(size.joints, "joint") + (mimics == 0 ? "" : " and " + count(mimics, "mimic joint"));
}

/// The loop for a robot.
/// @throws Refusal if none is ready
RunLoop loop_for(const articula::UrdfDescription& robot, const std::vector<PlannedGroup>& groups,
                 const ControllersPlan& plan) {
  const std::string advice = "; the option --compile makes a loop for any of them";
  if (groups.size() > 4) {
    throw Refusal(plan.source.name() + ": its controllers are for " +
                  std::to_string(groups.size()) + " groups of joints; loops for 4 are ready" +
                  advice);
  }
  for (const PlannedGroup& group : groups) {
    if (group.controllers.size() <= 8) continue;
    throw Refusal(plan.source.name() + ": it lists " + std::to_string(group.controllers.size()) +
                  " controllers for the same joints; loops for 8 are ready" + advice);
  }
  const articula::ModelSize size = articula::model_size(robot->joints);
  std::string ready;
  for (std::size_t at = 0; at < ready_sizes.size(); ++at) {
    const articula::ModelSize& own = ready_sizes[at];
    if (own.joints == size.joints && own.bodies == size.bodies) {
      return all_loops(std::make_index_sequence<ready_sizes.size()>{})[at];
    }
    const int mimics = own.bodies - own.joints;
    ready += (at == 0 ? "" : ", ") + std::to_string(own.joints) +
             (mimics == 0 ? "" : "+" + std::to_string(mimics));
  }
  throw Refusal("robot '" + std::string(robot->name.view()) + "' has " + size_text(size) +
                "; loops are ready for robots of these sizes: " + ready +
                ", where 7+5 stands for 7 joints and 5 mimic joints" + advice);
}

/// What the compiled program needs of the options.
std::vector<std::string> arguments_of(const Program& program, const Run& options) {
  if (program.json || options.ros2.is_wanted) {
    throw WrongUsage(
        "run: --json and --ros2 are not for --compile and --can; articula new writes a program to "
        "change");
  }
  std::vector<std::string> arguments{"--address", program.address, "--port",
                                     std::to_string(program.port)};
  const auto add = [&](std::initializer_list<std::string> words) {
    arguments.insert(arguments.end(), words);
  };
  // Other users can read the arguments of a program.
  if (!program.token.empty()) setenv("ARTICULA_TOKEN", program.token.c_str(), 1);
  if (options.is_read_only) add({"--read-only"});
  if (options.shows) add({"--view"});
  if (options.priority >= 0) add({"--priority", std::to_string(options.priority)});
  if (std::isfinite(options.seconds)) {
    add({"--seconds", articula::detail::number_text(options.seconds)});
  }
  return arguments;
}

/// The folder of the view's page beside this program, as it is installed; empty if there is none.
std::string installed_page() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path page = program.parent_path().parent_path() / "share/articula/page";
  return !error && fs::exists(page / "index.html", error) ? page.string() : std::string();
}

/// A loop whose one controller passes commands on.
ControllersPlan pass_on(const std::string& quantity) {
  using enum ControllerKind;
  ControllersPlan plan;
  plan.source = articula::ConfigSource::text("", "--command " + quantity);
  plan.controllers.push_back({.name = quantity,
                              .kind = quantity == "effort"     ? bypass
                                      : quantity == "velocity" ? forward_velocity
                                                               : forward_position});
  plan.drives = traits_of(plan.controllers[0].kind).drives;
  return plan;
}

void run(const Program& program, const Run& options) {
  ControllersPlan controllers =
      options.controllers.empty()
          ? pass_on(options.command)
          : read_controllers(controllers_source(options.controllers, options.values),
                             options.chosen);
  if (options.rate > 0) controllers.period = 1 / options.rate;
  controllers.substeps =
      options.substeps > 0 ? options.substeps : default_substeps(controllers.period);
  const articula::UrdfSource source = robot_source(options.robot);
  const Mover mover = options.is_mock       ? Mover::mock
                      : options.bus.empty() ? Mover::simulation
                                            : Mover::drives;
  const articula::UrdfDescription robot =
      read_robot(source, controllers, options.allows_unphysical, mover);

  const std::vector<PlannedGroup> groups = joint_groups(robot, controllers);
  if (options.is_mock && controllers.drives == Drives::efforts) {
    throw Refusal(controllers.source.name() +
                  ": its controllers command efforts, which do not move a mock; leave --mock out "
                  "for a simulation");
  }
  if (options.ros2.is_wanted) {
    std::erase_if(controllers.notes, [](const std::string& note) {
      return note.find(articula::gripper_note) != std::string::npos;
    });
  }
  print_notes(controllers, groups, robot, options.robot);

  const std::string text = source.text();
  if (options.compiles || !options.bus.empty()) {
    PlannedDrives drives;
    if (!options.bus.empty()) drives = read_drives(controllers, options.bus, robot);
    run_compiled(make_project({.robot = options.robot,
                               .urdf = text,
                               .controllers = controllers,
                               .groups = groups,
                               .allows_unphysical = options.allows_unphysical,
                               .is_kinematic = robot->kinematic,
                               .is_mock = options.is_mock,
                               .drives = drives}),
                 arguments_of(program, options));
  }
  const RunLoop loop = loop_for(robot, groups, controllers);
  LoopPlan plan{.robot = robot};
  if (text.find("<visual") != std::string::npos) plan.urdf_text = text;
  plan.mesh_folders = mesh_folders(plan.urdf_text, options.robot);
  plan.page_folder = installed_page();
  plan.controllers = controllers;
  plan.groups = groups;
  plan.is_mock = options.is_mock;
  plan.address = program.address;
  plan.port = program.port;
  plan.token = program.token;
  plan.is_read_only = options.is_read_only;
  plan.priority = std::max(options.priority, 0);
  plan.seconds = options.seconds;
  Ros2Options ros2 = options.ros2;
  ros2.operates = !options.is_read_only;
  plan.attach = options.controllers.empty() ? ros2_robot(ros2) : ros2_bridge(ros2, controllers);
  plan.ready = [&](const std::string& url) {
    Json names = Json::array();
    std::vector<Row> rows;
    for (const PlannedController& controller : controllers.controllers) {
      const std::string kind(traits_of(controller.kind).class_name);
      names.push_back({{"name", controller.name}, {"class", kind}});
      rows.push_back({"  " + controller.name, kind});
    }
    const char* hardware = options.is_mock ? "mock" : "simulated";
    program.print({{"robot", robot->name.view()},
                   {"hardware", hardware},
                   {"rate", 1 / controllers.period},
                   {"controllers", names},
                   {"mesh_folders", plan.mesh_folders},
                   {"url", url}},
                  std::string(robot->name.view()) + ", " + hardware + ", " +
                      shown(1 / controllers.period) +
                      " Hz, the first controller of each joint is active:\n" + table(rows) + "\n" +
                      url + "\nCtrl-C ends it");
    if (options.shows && !articula::open_in_browser(url)) {
      std::fprintf(stderr, "note: there is no screen, or no xdg-open: open the address yourself\n");
    }
  };
  const LoopEnd end = loop(plan);
  program.print(
      {{"cycles", end.cycles}, {"overruns", end.overruns}, {"status", end.status}},
      std::to_string(end.cycles) + " cycles, " + std::to_string(end.overruns) + " overruns");
}

/// The options of loops with and without a file of controllers.
void add_loop_options(CLI::App& command, Run& options) {
  command.add_flag("--view", options.shows, "open the page in a browser");
  command.add_flag("--read-only", options.is_read_only, "clients watch only");
  command.add_flag("--allow-unphysical", options.allows_unphysical,
                   "accept inertias that no body has");
  command.add_option("--rate", options.rate, "of the loop [Hz]")
      ->check(within(1.0, 20000.0))
      ->default_str("that of the file, or 1000");
  command.add_option("--substeps", options.substeps, "steps of the simulation in a period")
      ->check(within(1, 10000))
      ->default_str("steps of 1 ms or less");
  command.add_option("--priority", options.priority, "of the loop's thread, SCHED_FIFO; 0: none")
      ->check(within(0, 99))
      ->default_str("that of the file or 80 with --can, else 0");
  command.add_option("--seconds", options.seconds, "how long [s]")
      ->check(within(0.0, 1e6))
      ->default_str("until Ctrl-C");
  add_ros2_options(command, options.ros2);
}

}  // namespace

void add_run_command(CLI::App& app, Program& program) {
  const auto options = std::make_shared<Run>();
  CLI::App* command = add_command(
      app, program, "run", "Runs a robot with the controllers of a file, and serves its view.",
      [&program, options] { run(program, *options); });
  command->add_option("robot", options->robot, "the URDF, or a .xacro")->required();
  command->add_option("controllers", options->controllers, "YAML files of ROS's controllers")
      ->required();
  command->add_option("--controller", options->chosen, "one of the file to use, in place of all")
      ->allow_extra_args(false);
  add_values_option(*command, options->values);
  CLI::Option* mock = command->add_flag(
      "--mock", options->is_mock, "joints follow every position at once, in place of a simulation");
  command
      ->add_option("--can", options->bus,
                   "the real robot: the CAN interface of the drives that the YAML describes")
      ->type_name("INTERFACE")
      ->excludes(mock);
  command->add_flag("--compile", options->compiles,
                    "compile a program for this robot, keep it, and run it");
  add_loop_options(*command, *options);
  command->add_flag("--sim-time", options->ros2.use_sim_time,
                    "with --ros2: stamps have the loop's time, which is on /clock");
}

void add_simulate_command(CLI::App& app, Program& program) {
  const auto options = std::make_shared<Run>();
  options->command = "position";
  CLI::App* command =
      add_command(app, program, "simulate",
                  "Simulates a robot that takes commands from ROS 2's topics or the view.",
                  [&program, options] { run(program, *options); });
  command->add_option("robot", options->robot, "the URDF, or a .xacro")->required();
  command->add_option("--command", options->command, "what its drives take")
      ->check(CLI::IsMember({"position", "velocity", "effort"}))
      ->capture_default_str();
  add_loop_options(*command, *options);
}

}  // namespace terminal
