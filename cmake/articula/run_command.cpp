// SPDX-License-Identifier: Apache-2.0
/// @file run: a robot from a URDF with the controllers of a YAML file, without a compiler.
#include "controllers_file.hpp"
#include "loops/loop_plan.hpp"
#include "program.hpp"
#include "robot_file.hpp"
#include "table.hpp"
#include "within.hpp"

#include <articula/config/load_controller.hpp>
#include <articula/model/build_model.hpp>
#include <articula/urdf/read_urdf.hpp>
#include <articula/view/open_in_browser.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace terminal {

namespace {

namespace fs = std::filesystem;

struct Run {
  std::string robot{}, controllers{};
  std::vector<std::string> chosen{};
  bool is_mock = false, shows = false, is_read_only = false, allows_unphysical = false;
  int priority = 0;
  int substeps = 0;  ///< 0: so many that none is longer than a millisecond
  double rate = 0;   ///< of the loop [Hz]; 0: that of the file
  double seconds = std::numeric_limits<double>::infinity();
};

using RunLoop = LoopEnd (*)(const LoopPlan&);

template <Drives D, int... Less>
std::array<RunLoop, sizeof...(Less)> all_sizes(std::integer_sequence<int, Less...>) {
  return {&run_loop<Less + 1, D>...};
}

/// The loop for a robot.
RunLoop loop_for(const articula::UrdfDescription& robot, const ControllersPlan& controllers,
                 const std::string& advice) {
  const articula::ModelSize size = articula::model_size(robot->joints);
  const std::string name = "robot '" + std::string(robot->name.view()) + "'";
  if (size.bodies != size.joints) {
    throw Refusal(name + " has mimic joints, for which no loop is ready" + advice);
  }
  if (size.joints > most_joints) {
    throw Refusal(name + " has " + std::to_string(size.joints) +
                  " joints; loops are ready for 1 to " + std::to_string(most_joints) + advice);
  }
  constexpr auto sizes = std::make_integer_sequence<int, most_joints>{};
  const auto at = static_cast<std::size_t>(size.joints - 1);
  switch (controllers.drives) {
    case Drives::efforts:
      return all_sizes<Drives::efforts>(sizes)[at];
    case Drives::positions:
      return all_sizes<Drives::positions>(sizes)[at];
    case Drives::velocities:
      break;
  }
  throw Refusal(controllers.file + ": no loop is ready for drives that take velocities" + advice);
}

/// Refuses controllers that name joints which the robot does not have. Those with gains are checked
/// with them.
void check_joints(const articula::UrdfDescription& robot, const ControllersPlan& controllers) {
  std::vector<std::string> names;
  for (const articula::Joint& joint : robot->joints) {
    if (articula::detail::is_free(joint)) names.emplace_back(joint.name.view());
  }
  for (const PlannedController& controller : controllers.controllers) {
    if (traits_of(controller.kind).has_gains || controller.section.empty()) continue;
    const auto config = articula::load_controller(controllers.file, controller.section);
    for (const articula::ConfiguredJoint& joint : config.joints) {
      if (std::ranges::find(names, joint.name) != names.end()) continue;
      throw articula::FileError(joint.place,
                                "robot '" + std::string(robot->name.view()) + "' has no joint '" +
                                    joint.name + "' that takes commands",
                                articula::detail::one_of_words(joint.name, names));
    }
  }
}

/// The folder of a ROS package around a file: a folder of its name with a package.xml, which holds
/// the file or is beside a folder that does. Empty if there is none. The name comes from a URDF, so
/// without these rules a file could have any folder of the machine served.
std::string package_folder(const std::string& package, const std::string& file) {
  const auto belongs_to_a_name = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  };
  if (package.empty() || !std::ranges::all_of(package, belongs_to_a_name)) return {};
  std::error_code error;
  for (fs::path folder = fs::weakly_canonical(fs::path(file), error).parent_path();
       folder != folder.parent_path(); folder = folder.parent_path()) {
    const fs::path found = folder.filename() == package ? folder : folder / package;
    if (fs::exists(found / "package.xml", error)) return found.string();
  }
  return {};
}

/// The folders of the packages whose meshes a URDF names.
std::map<std::string, std::string> mesh_folders(const std::string& urdf, const std::string& file) {
  constexpr std::string_view scheme = "package://";
  std::map<std::string, std::string> folders;
  std::set<std::string> seen;
  for (std::size_t at = urdf.find(scheme); at != std::string::npos; at = urdf.find(scheme, at)) {
    at += scheme.size();
    const std::string package = urdf.substr(at, urdf.find_first_of("/\"' ", at) - at);
    if (!seen.insert(package).second) continue;
    const std::string folder = package_folder(package, file);
    if (folder.empty()) {
      std::fprintf(stderr,
                   "note: no meshes of package '%s': no folder of its name with a package.xml "
                   "is above the URDF or beside a folder above it\n",
                   package.c_str());
    } else {
      folders[package] = folder;
    }
  }
  return folders;
}

/// The folder of the view's page beside this program, as it is installed; empty if there is none.
std::string installed_page() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path page = program.parent_path().parent_path() / "share/articula/page";
  return !error && fs::exists(page / "index.html", error) ? page.string() : std::string();
}

void run(const Program& program, const Run& options) {
  ControllersPlan controllers = read_controllers(options.controllers, options.chosen);
  if (options.rate > 0) controllers.period = 1 / options.rate;
  controllers.substeps =
      options.substeps > 0 ? options.substeps : default_substeps(controllers.period);
  articula::UrdfOptions reading;
  reading.root = controllers.root;
  reading.tip = controllers.tip;
  reading.allow_unphysical = options.allows_unphysical;
  if (controllers.gravity) reading.gravity = *controllers.gravity;
  const articula::UrdfSource source = robot_source(options.robot);
  const articula::UrdfDescription robot = articula::read_urdf(source, reading);

  const std::string advice = "; articula new " + options.robot + " " + options.controllers +
                             " writes a project that compiles one";
  check_joints(robot, controllers);
  const RunLoop loop = loop_for(robot, controllers, advice);
  if (controllers.controllers.size() > 8) {
    throw Refusal(controllers.file + ": it lists " +
                  std::to_string(controllers.controllers.size()) + " controllers; 8 at most");
  }
  if (options.is_mock && controllers.drives == Drives::efforts) {
    throw Refusal(controllers.file +
                  ": its controllers command efforts, which do not move a mock; leave --mock out "
                  "for a simulation");
  }
  for (const std::string& note : controllers.notes)
    std::fprintf(stderr, "note: %s\n", note.c_str());
  for (const std::string& notice : robot->notices) {
    std::fprintf(stderr, "note: %s: %s\n", options.robot.c_str(), notice.c_str());
  }

  LoopPlan plan{.robot = robot};
  const std::string text = source.text();
  if (text.find("<visual") != std::string::npos) plan.urdf_text = text;
  plan.mesh_folders = mesh_folders(plan.urdf_text, options.robot);
  plan.page_folder = installed_page();
  plan.controllers = controllers;
  plan.is_mock = options.is_mock;
  plan.address = program.address;
  plan.port = program.port;
  plan.token = program.token;
  plan.is_read_only = options.is_read_only;
  plan.priority = options.priority;
  plan.seconds = options.seconds;
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
                      shown(1 / controllers.period) + " Hz, the first controller is active:\n" +
                      table(rows) + "\n" + url + "\nCtrl-C ends it");
    if (options.shows && !articula::open_in_browser(url)) {
      std::fprintf(stderr, "note: there is no screen, or no xdg-open: open the address yourself\n");
    }
  };
  const LoopEnd end = loop(plan);
  program.print(
      {{"cycles", end.cycles}, {"overruns", end.overruns}, {"status", end.status}},
      std::to_string(end.cycles) + " cycles, " + std::to_string(end.overruns) + " overruns");
}

}  // namespace

void add_run_command(CLI::App& app, Program& program) {
  const auto options = std::make_shared<Run>();
  CLI::App* command = add_command(
      app, program, "run", "Runs a robot with the controllers of a file, and serves its view.",
      [&program, options] { run(program, *options); });
  command->add_option("robot", options->robot, "the URDF, or a .xacro")->required();
  command->add_option("controllers", options->controllers, "YAML of ROS's controllers")->required();
  command->add_option("--controller", options->chosen, "one of the file to use, in place of all")
      ->allow_extra_args(false);
  command->add_flag("--mock", options->is_mock,
                    "joints follow every position at once, in place of a simulation");
  command->add_flag("--view", options->shows, "open the page in a browser");
  command->add_flag("--read-only", options->is_read_only, "clients watch only");
  command->add_flag("--allow-unphysical", options->allows_unphysical,
                    "accept inertias that no body has");
  command->add_option("--rate", options->rate, "of the loop [Hz]")
      ->check(within(1.0, 20000.0))
      ->default_str("that of the file");
  command->add_option("--substeps", options->substeps, "steps of the simulation in a period")
      ->check(within(1, 10000))
      ->default_str("steps of 1 ms or less");
  command->add_option("--priority", options->priority, "of the loop's thread, SCHED_FIFO; 0: none")
      ->check(within(0, 99))
      ->capture_default_str();
  command->add_option("--seconds", options->seconds, "how long [s]")
      ->check(within(0.0, 1e6))
      ->default_str("until Ctrl-C");
}

}  // namespace terminal
