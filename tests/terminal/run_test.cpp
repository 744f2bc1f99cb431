// SPDX-License-Identifier: Apache-2.0
/// @file articula run and articula new: robots and controllers from files.
#include "catch.hpp"
#include "scratch_file.hpp"
#include "scratch_folder.hpp"
#include "terminal.hpp"

#include <articula/remote/sheet/urdf_text.hpp>
#include <articula/robots/pr2.hpp>
#include <articula/robots/q2d.hpp>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using support::Result;
using support::run_articula;
using support::ScratchFile;
using Json = nlohmann::json;

namespace {

const std::string files = TERMINAL_FILES;

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// The Q2D as a file, whose gravity is the controllers' one.
struct Q2dFile {
  ScratchFile file{"q2d.urdf"};
  Q2dFile() { write(file.path(), articula::remote::urdf_text(articula::Q2d())); }
  [[nodiscard]] std::string name() const { return file.path().string(); }
};

/// The Q2D without masses.
std::string massless_q2d() {
  std::string text = articula::remote::urdf_text(articula::Q2d());
  for (std::size_t begin = 0; (begin = text.find("<inertial>")) != std::string::npos;) {
    text.erase(begin, text.find("</inertial>") + 11 - begin);
  }
  return text;
}

/// A controller of positions, the name of whose first joint has a placeholder.
const std::string controllers_with_placeholder =
    "controller_manager:\n  ros__parameters:\n    update_rate: 1000\n"
    "    arm: {type: joint_trajectory_controller/JointTrajectoryController}\n"
    "arm:\n  ros__parameters:\n    joints: [$(var side)_active_joint, elbow_active_joint]\n"
    "    command_interfaces: [position]\n";

/// A program that runs a loop from files at a free port.
class Running {
 public:
  explicit Running(std::vector<std::string> words) : process_(command(std::move(words))) {
    begin_ = Json::parse(process_.line());
    const std::string url = begin_.at("url");
    port_ = url.substr(url.rfind(':') + 1, url.find('/', 8) - url.rfind(':') - 1);
  }
  [[nodiscard]] const Json& begin() const { return begin_; }
  [[nodiscard]] const std::string& port() const { return port_; }
  Json ask(std::vector<std::string> words) const {
    words.insert(words.begin(), {"--json", "--port", port_});
    const Result result = run_articula(std::move(words));
    INFO(result.output + result.errors);
    REQUIRE(result.exit_code == 0);
    return result.json();
  }
  [[nodiscard]] Result end() {
    process_.interrupt();
    return process_.end();
  }

 private:
  static std::vector<std::string> command(std::vector<std::string> words) {
    words.insert(words.begin(), {ARTICULA_PROGRAM, "--json", "--port", "0", "run"});
    return words;
  }
  support::Process process_;
  Json begin_;
  std::string port_;
};

template <class Condition>
bool eventually(Condition condition) {
  for (int k = 0; k < 600; ++k) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

/// A short run with some of the file's controllers.
Result articula_chosen(const std::string& robot, const std::string& controllers,
                       const std::vector<std::string>& names) {
  std::vector<std::string> words{"--port", "0", "run", robot, controllers, "--seconds", "0.01"};
  for (const std::string& name : names) {
    words.emplace_back("--controller");
    words.push_back(name);
  }
  return run_articula(words);
}

void check_refused(const Result& result, const std::string& words) {
  INFO(result.output + result.errors);
  CAPTURE(words);
  CHECK(result.exit_code == 1);
  CHECK(result.errors.find(words) != std::string::npos);
}

}  // namespace

TEST_CASE("run serves the meshes of packages, and no other folder that a URDF names") {
  const auto workspace = std::filesystem::temp_directory_path() / "articula_package_test";
  const auto package = workspace / "my_arm";
  std::filesystem::create_directories(package / "urdf");
  std::filesystem::create_directories(workspace / "no_package");
  write(package / "package.xml", "<package/>");
  std::string urdf = articula::remote::urdf_text(articula::Q2d());
  const std::size_t end = urdf.rfind("</robot>");
  urdf.insert(end,
              "<!-- package://etc/a package://../a package://no_package/a package://my_arm/a -->");
  const auto file = package / "urdf" / "q2d.urdf";
  write(file, urdf);
  Running arm({file.string(), files + "/q2d.yaml"});
  const Json folders = arm.begin().at("mesh_folders");
  CHECK(folders == Json{{"my_arm", std::filesystem::canonical(package).string()}});
  CHECK(arm.end().exit_code == 0);
  std::filesystem::remove_all(workspace);
}

TEST_CASE("the course's files run, with their controllers, and are operated from the terminal") {
  const Q2dFile robot;
  Running running({robot.name(), files + "/q2d.yaml"});
  CHECK(running.begin().at("robot") == "q2d");
  CHECK(running.begin().at("rate") == 1000);
  const auto mode = [&] { return running.ask({"status"}).at("situation").at("mode"); };
  REQUIRE(eventually([&] { return mode() == "active"; }));

  const Json controllers = running.ask({"controllers"}).at("controllers");
  REQUIRE(controllers.size() == 3);
  CHECK(controllers.at(0).at("name") == "group_bypass");
  CHECK(controllers.at(0).at("status") == "active");
  CHECK(controllers.at(2).at("name") == "computed_torque_controller");

  running.ask({"switch", "--start", "pid_plus_gravity_controller", "--replace"});
  const Json gains =
      running.ask({"gains", "get", "pid_plus_gravity_controller.shoulder_active_joint.p"});
  CHECK(gains.at("parameters").at(0).at("value") == 2310);
  const Json torque = running.ask({"gains", "get", "computed_torque_controller"});
  CHECK(torque.at("parameters").at(0).at("unit") == "1/s^2");
  running.ask({"go", "elbow_active_joint=0.2", "--wait"});
  CHECK(eventually([&] {
    const Json joints = running.ask({"status"}).at("joints");
    return std::abs(joints.at(1).at("position").get<double>() - 0.2) < 1e-3;
  }));
  const Result end = running.end();
  CHECK(end.exit_code == 0);
  CHECK(end.json().at("cycles").get<int>() > 0);
}

TEST_CASE("a configuration in several files runs as one") {
  const Q2dFile robot;
  const ScratchFile manager("manager.yaml"), gains("gains.yaml");
  write(manager.path(),
        "controller_manager:\n  ros__parameters:\n    update_rate: 500\n"
        "    pid: {type: effort_controllers/PidPlusGravityController}\n");
  write(gains.path(),
        "pid:\n  ros__parameters:\n    joints: [shoulder_active_joint, elbow_active_joint]\n"
        "    gains:\n      shoulder_active_joint: {p: 2310}\n      elbow_active_joint: {p: 339}\n");
  const std::string first = manager.path().string(), second = gains.path().string();
  const Result alone = run_articula({"run", robot.name(), first, "--port", "0"});
  CHECK(alone.errors.find("here or in a further file") != std::string::npos);
  const Running running({robot.name(), first, second});
  CHECK(running.ask({"gains", "get", "pid.elbow_active_joint.p"})
            .at("parameters")
            .at(0)
            .at("value") == 339);
  const Result swapped = run_articula({"run", first, robot.name()});
  CHECK(swapped.errors.find("the robot comes first") != std::string::npos);
}

TEST_CASE("anybody may stop a motion, and a paused loop shows its state") {
  const Q2dFile robot;
  const Running running(
      {robot.name(), files + "/q2d.yaml", "--controller", "pid_plus_gravity_controller"});
  const auto motion = [&] { return running.ask({"status"}).at("situation").at("motion"); };
  support::Process operating({ARTICULA_PROGRAM, "--port", running.port(), "go",
                              "shoulder_active_joint=1.5", "--speed", "0.02", "--wait"});
  CHECK(eventually([&] { return motion() == "go"; }));
  const Result refused = run_articula({"--port", running.port(), "go", "elbow_active_joint=0.1"});
  CHECK(refused.errors.find("has the controls") != std::string::npos);
  const Json stopped = running.ask({"stop"});
  CHECK(stopped.at("success") == true);
  CHECK(eventually([&] { return motion() == "rest"; }));
  CHECK(operating.end().exit_code == 1);  // it is not where it was to go

  running.ask({"pause"});
  const Json paused = running.ask({"status"});
  CHECK(paused.at("situation").at("paused") == true);
  CHECK(paused.at("joints").size() == 2);
  CHECK(paused.at("joints").at(0).at("position").is_number());

  // Commands that would wait with the controls are refused; others say that they wait.
  const ScratchFile trajectory("trajectory.yaml");
  write(trajectory.path(),
        "joint_names: [shoulder_active_joint, elbow_active_joint]\n"
        "points:\n- {positions: [0.1, 0.1], time_from_start: {sec: 1}}\n");
  for (const auto& words :
       std::vector<std::vector<std::string>>{{"go", "elbow_active_joint=0.1", "--wait"},
                                             {"signal", "elbow_active_joint=0.1", "--sine", "1"},
                                             {"play", trajectory.path()}}) {
    std::vector<std::string> command{"--port", running.port()};
    command.insert(command.end(), words.begin(), words.end());
    const Result waiting = run_articula(command);
    CHECK(waiting.exit_code == 1);
    CHECK(waiting.errors == "articula: the simulation is paused: 'articula resume' first\n");
  }
  support::Process watching(
      {ARTICULA_PROGRAM, "--port", running.port(), "watch", "--seconds", "0.1"});
  CHECK(watching.error_line() ==
        "note: the simulation is paused; 'articula resume' in another terminal goes on");
  running.ask({"resume"});
  CHECK(watching.end().exit_code == 0);
}

TEST_CASE("a motion that no controller follows is told of") {
  const Q2dFile robot;
  const Running running({robot.name(), files + "/q2d.yaml", "--controller", "group_bypass"});
  const Result result =
      run_articula({"--port", running.port(), "go", "elbow_active_joint=0.3", "--wait"});
  CHECK(result.exit_code != 0);
  CHECK(result.errors.find("the reference of joint 'elbow_active_joint' is at ") !=
        std::string::npos);
  CHECK(result.errors.find(", not at 0.3: ") != std::string::npos);
  const Json told = running.ask({"go", "elbow_active_joint=0.3"});
  CHECK(told.at("message") ==
        "the reference moves, but no active controller moves to it: 'elbow_active_joint'");
}

TEST_CASE("positions go to simulated drives, and to a mock") {
  const Q2dFile robot;
  const ScratchFile controllers("position.yaml");
  write(controllers.path(),
        "controller_manager:\n  ros__parameters:\n    update_rate: 100\n"
        "    arm_controller: {type: joint_trajectory_controller/JointTrajectoryController}\n"
        "arm_controller:\n  ros__parameters:\n"
        "    joints: [shoulder_active_joint, elbow_active_joint]\n"
        "    command_interfaces: [position]\n    state_interfaces: [position, velocity]\n");
  for (const bool mocks : {false, true}) {
    std::vector<std::string> words{robot.name(), controllers.path().string()};
    if (mocks) words.emplace_back("--mock");
    Running running(words);
    CHECK(running.begin().at("hardware") == (mocks ? "mock" : "simulated"));
    CHECK(running.begin().at("rate") == 100);
    REQUIRE(
        eventually([&] { return running.ask({"status"}).at("situation").at("mode") == "active"; }));
    running.ask({"go", "shoulder_active_joint=0.3", "--wait"});
    CHECK(eventually([&] {
      const Json joints = running.ask({"status"}).at("joints");
      return std::abs(joints.at(0).at("position").get<double>() - 0.3) < 1e-3;
    }));
    CHECK(running.end().exit_code == 0);
  }
}

TEST_CASE("a mock needs no masses, a simulation does") {
  const ScratchFile robot("massless.urdf"), controllers("placeholder.yaml");
  write(robot.path(), massless_q2d());
  write(controllers.path(), controllers_with_placeholder);
  std::vector<std::string> words{"--port",
                                 "0",
                                 "run",
                                 robot.path().string(),
                                 controllers.path().string(),
                                 "--value",
                                 "side=shoulder",
                                 "--seconds",
                                 "0.05"};
  check_refused(run_articula(words), "the joint moves no link that has mass");
  words.emplace_back("--mock");
  words.insert(words.begin(), "--json");
  const Result result = run_articula(words);
  INFO(result.output + result.errors);
  CHECK(result.exit_code == 0);
  CHECK(result.output.find("\"cycles\":50") != std::string::npos);
  CHECK(result.errors.find("its masses are not used: ") != std::string::npos);
  const Result joints = run_articula({"joints", robot.path().string()});
  CHECK(joints.exit_code == 0);
  CHECK(joints.errors.find("load_urdf refuses it: ") != std::string::npos);
  // Without the value, and with what is none.
  check_refused(run_articula({"run", robot.path().string(), controllers.path().string(), "--mock"}),
                "side");
  CHECK(run_articula({"run", robot.path().string(), controllers.path().string(), "--value", "side"})
            .errors.find("'side' is not NAME=TEXT") != std::string::npos);
}

TEST_CASE("a new project without masses has drives of positions, and values in its YAML") {
  const ScratchFile robot("massless.urdf"), controllers("drives.yaml");
  write(robot.path(), massless_q2d());
  write(controllers.path(),
        controllers_with_placeholder +
            "can_drives:\n  ros__parameters:\n    protocol: cia402\n"
            "    $(var side)_active_joint: {node: 1, rated_effort: 10.0, position_scale: 10.0, "
            "velocity_scale: 1.0}\n"
            "    elbow_active_joint: {node: 2, rated_effort: 10.0, position_scale: 10.0, "
            "velocity_scale: 1.0}\n");
  const support::ScratchFolder folder("massless");
  const Result result =
      run_articula({"new", robot.path().string(), controllers.path().string(), "--can", "can0",
                    "--value", "side=shoulder", "--output", (folder.path() / "arm").string()});
  INFO(result.output + result.errors);
  REQUIRE(result.exit_code == 0);
  const auto text_of = [&](const char* name) {
    std::ifstream stream(folder.path() / "arm" / name);
    return std::string((std::istreambuf_iterator<char>(stream)), {});
  };
  CHECK(text_of("CMakeLists.txt").find(" KINEMATIC)") != std::string::npos);
  CHECK(text_of("controllers.yaml").find("shoulder_active_joint: {node: 1") != std::string::npos);
}

TEST_CASE("names that a shell would expand are not completed") {
  std::string text = articula::remote::urdf_text(articula::Q2d());
  const std::string elbow = "elbow_active_joint";
  for (std::size_t at = 0; (at = text.find(elbow, at)) != std::string::npos;) {
    text.replace(at, elbow.size(), "elbow`exit`");
  }
  const ScratchFile robot("hostile.urdf"), controllers("hostile.yaml");
  write(robot.path(), text);
  write(controllers.path(),
        "controller_manager:\n  ros__parameters:\n    update_rate: 100\n"
        "    bypass: {type: effort_controllers/JointGroupEffortController}\n"
        "bypass:\n  ros__parameters:\n    joints: [shoulder_active_joint, 'elbow`exit`']\n");
  const Running running({robot.path().string(), controllers.path().string()});
  CHECK(running.ask({"status"}).at("joints").at(1).at("name") == "elbow`exit`");
  CHECK(run_articula({"--port", running.port(), "names", "JOINT=VALUE"}).output ==
        "shoulder_active_joint=\n");
}

TEST_CASE("a run ends after its time, and read-only means it") {
  const Q2dFile robot;
  const Result result = run_articula({"--json", "--port", "0", "run", robot.name(),
                                      files + "/q2d.yaml", "--seconds", "0.05", "--read-only"});
  CHECK(result.exit_code == 0);
  CHECK(result.output.find("\"cycles\":50") != std::string::npos);
}

TEST_CASE("what cannot run is refused with its reason and the cure") {
  const Q2dFile robot;
  const ScratchFile file("controllers.yaml"), urdf("robot.urdf");
  const std::string yaml = file.path().string();
  const auto run = [&](const std::string& robot_file) {
    return run_articula({"--port", "0", "run", robot_file, yaml, "--seconds", "0.01"});
  };
  check_refused(run_articula({"run", "/no/such.urdf", files + "/q2d.yaml"}), "/no/such.urdf");
  check_refused(run_articula({"run", robot.name(), "/no/such.yaml"}), "/no/such.yaml");
  check_refused(run_articula({"run", robot.name(), files + "/q2d.yaml", "--mock"}), "--mock");

  write(file.path(), "controller_manager:\n  ros__parameters:\n    update_rate: 100\n");
  check_refused(run(robot.name()), "names no controller");
  write(file.path(),
        "controller_manager:\n  ros__parameters:\n"
        "    odd: {type: odd_controllers/OddThing}\nodd:\n  ros__parameters:\n"
        "    joints: [shoulder_active_joint, elbow_active_joint]\n");
  check_refused(run(robot.name()), "OddThing");
  write(file.path(),
        "controller_manager:\n  ros__parameters:\n"
        "    both: {type: effort_controllers/JointGroupEffortController}\n"
        "    one: {type: effort_controllers/JointGroupEffortController}\n"
        "both:\n  ros__parameters:\n    joints: [shoulder_active_joint, elbow_active_joint]\n"
        "one:\n  ros__parameters:\n    joints: [elbow_active_joint]\n");
  check_refused(run(robot.name()), "'both' and 'one' share joint 'elbow_active_joint'");
  const std::string both_kinds =
      "controller_manager:\n  ros__parameters:\n"
      "    torque: {type: effort_controllers/JointGroupEffortController}\n"
      "    place: {type: position_controllers/JointGroupPositionController}\n"
      "torque:\n  ros__parameters:\n    joints: [shoulder_active_joint, elbow_active_joint]\n"
      "place:\n  ros__parameters:\n    joints: [shoulder_active_joint, elbow_active_joint]\n";
  write(file.path(), both_kinds);
  const Result both = run(robot.name());  // with the first kind, and a note on the other
  CHECK(both.exit_code == 0);
  CHECK(both.errors.find("'place'") != std::string::npos);
  write(file.path(), both_kinds + "stray: 1\n");
  const std::string once = run(robot.name()).errors;  // a note of both controllers
  CHECK(once.find("stray") != std::string::npos);
  CHECK(once.find("stray") == once.rfind("stray"));
  check_refused(articula_chosen(robot.name(), yaml, {"torque", "place"}), "same quantity");
  check_refused(articula_chosen(robot.name(), yaml, {"nonsense"}), "nonsense");
  CHECK(articula_chosen(robot.name(), yaml, {"place"}).exit_code == 0);

  write(file.path(),
        "controller_manager:\n  ros__parameters:\n"
        "    gravity: {type: effort_controllers/PidPlusGravityController}\n");
  check_refused(run(robot.name()), "'gravity' has no gains");
  check_refused(run_articula({"new", robot.name(), yaml, "--output", "/tmp/no-gains"}),
                "'gravity' has no gains");

  write(file.path(),
        "torque:\n  ros__parameters:\n    type: effort_controllers/JointGroupEffortController\n"
        "    joints: [shoulder_active_joint, wrist]\n");
  check_refused(run(robot.name()), "'wrist'");

  write(file.path(),
        "torque:\n  ros__parameters:\n    type: effort_controllers/JointGroupEffortController\n"
        "    joints: [torso_lift_joint]\n");
  write(urdf.path(), articula::remote::urdf_text(articula::Pr2()));
  check_refused(run(urdf.path().string()), "20 joints");
  check_refused(run(urdf.path().string()), "--compile");
}

TEST_CASE("--compile names what is missing") {
  const Q2dFile robot;
  const std::vector<std::string> words{"run", robot.name(), files + "/q2d.yaml", "--compile"};
  setenv("CXX", "/no/such/compiler", 1);
  check_refused(run_articula(words), "needs a C++ compiler");
  unsetenv("CXX");
}

TEST_CASE("controllers of some joints are active at the same time, and switched on their own") {
  const Q2dFile robot;
  const ScratchFile controllers("groups.yaml");
  write(controllers.path(),
        "controller_manager:\n  ros__parameters:\n    update_rate: 1000\n"
        "    arm: {type: effort_controllers/JointGroupPositionController}\n"
        "    hand: {type: effort_controllers/PidPlusGravityController}\n"
        "    hand_torque: {type: effort_controllers/JointGroupEffortController}\n"
        "arm:\n  ros__parameters:\n    joints: [shoulder_active_joint]\n"
        "    gains: {shoulder_active_joint: {p: 2310, i: 4640, d: 0.3}}\n"
        "hand:\n  ros__parameters:\n    joints: [elbow_active_joint]\n"
        "    gains: {elbow_active_joint: {p: 339, i: 851, d: 0.35}}\n"
        "hand_torque:\n  ros__parameters:\n    joints: [elbow_active_joint]\n");
  Running running({robot.name(), controllers.path().string()});
  const auto list = [&] {
    std::string text;
    const Json answer = running.ask({"controllers"});
    for (const Json& each : answer.at("controllers")) {
      text +=
          each.at("name").get<std::string>() + " " + each.at("status").get<std::string>() + ", ";
    }
    return text;
  };
  CHECK(eventually([&] { return list() == "arm active, hand active, hand_torque inactive, "; }));
  REQUIRE(
      eventually([&] { return running.ask({"status"}).at("situation").at("mode") == "active"; }));
  running.ask({"switch", "--start", "hand_torque", "--stop", "hand"});
  CHECK(eventually([&] { return list() == "arm active, hand inactive, hand_torque active, "; }));
  // A controller has the gains of its own joints.
  const Json gains = running.ask({"gains", "get", "hand"}).at("parameters");
  REQUIRE(!gains.empty());
  for (const Json& gain : gains) {
    CHECK(gain.at("name").get<std::string>().starts_with("hand.elbow_active_joint."));
  }
  CHECK(running.end().exit_code == 0);
}

TEST_CASE("velocities go to simulated drives, and to a mock") {
  const Q2dFile robot;
  const ScratchFile controllers("velocity.yaml");
  write(controllers.path(),
        "controller_manager:\n  ros__parameters:\n    update_rate: 100\n"
        "    arm: {type: velocity_controllers/JointGroupVelocityController}\n"
        "    follower: {type: velocity_controllers/JointTrajectoryController}\n"
        "arm:\n  ros__parameters:\n    joints: [shoulder_active_joint, elbow_active_joint]\n"
        "follower:\n  ros__parameters:\n    joints: [shoulder_active_joint, elbow_active_joint]\n"
        "    gains: {shoulder_active_joint: {p: 5}, elbow_active_joint: {p: 5}}\n");
  for (const bool mocks : {false, true}) {
    std::vector<std::string> words{robot.name(), controllers.path().string()};
    if (mocks) words.emplace_back("--mock");
    Running running(words);
    CHECK(running.begin().at("controllers").at(1).at("class") == "PositionByVelocity");
    REQUIRE(
        eventually([&] { return running.ask({"status"}).at("situation").at("mode") == "active"; }));
    const auto elbow = [&] {
      return running.ask({"status"}).at("joints").at(1).at("position").get<double>();
    };
    running.ask({"publish", "--velocity", "elbow_active_joint=0.2"});
    CHECK(eventually([&] { return elbow() > 0.02; }));
    running.ask({"stop"});
    running.ask({"switch", "--start", "follower", "--replace"});
    running.ask({"go", "elbow_active_joint=-0.1", "--wait"});
    CHECK(eventually([&] { return std::abs(elbow() + 0.1) < 1e-3; }));
    CHECK(running.end().exit_code == 0);
  }
}

TEST_CASE("the tolerances of the file count in trajectories") {
  const Q2dFile robot;
  const ScratchFile controllers("tolerances.yaml"), trajectory("trajectory.yaml");
  write(trajectory.path(),
        "joint_names: [elbow_active_joint]\n"
        "points: [{positions: [0.3], velocities: [0], time_from_start: 0.5}]\n");
  // Simulated drives lag behind a moving target by far more than 0.1 mrad, and by less than 1 rad.
  for (const auto& [tolerance, status] : {std::pair{"0.0001", 1}, std::pair{"1.0", 0}}) {
    write(controllers.path(),
          "controller_manager:\n  ros__parameters:\n    update_rate: 100\n"
          "    arm: {type: joint_trajectory_controller/JointTrajectoryController}\n"
          "arm:\n  ros__parameters:\n    joints: [shoulder_active_joint, elbow_active_joint]\n"
          "    command_interfaces: [position]\n    state_interfaces: [position, velocity]\n"
          "    constraints: {elbow_active_joint: {trajectory: " +
              std::string(tolerance) + "}}\n");
    Running running({robot.name(), controllers.path().string()});
    REQUIRE(
        eventually([&] { return running.ask({"status"}).at("situation").at("mode") == "active"; }));
    const Result result =
        run_articula({"--port", running.port(), "play", trajectory.path().string()});
    INFO(result.output + result.errors);
    CHECK(result.exit_code == status);
    const bool is_named = result.errors.find("path tolerance violated") != std::string::npos;
    CHECK(is_named == (status == 1));
    CHECK(running.end().exit_code == 0);
  }
}

TEST_CASE("a port that is in use is named") {
  using boost::asio::ip::tcp;
  boost::asio::io_context context;
  const tcp::acceptor acceptor(context, {boost::asio::ip::address_v4::loopback(), 0});
  const std::string port = std::to_string(acceptor.local_endpoint().port());
  const Q2dFile robot;
  check_refused(run_articula({"--port", port, "run", robot.name(), files + "/q2d.yaml"}), port);
}

TEST_CASE("a new project has the robot, the controllers and a short program") {
  const Q2dFile robot;
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("articula-new-" + std::to_string(getpid()));
  const Result result = run_articula(
      {"--json", "new", robot.name(), files + "/q2d.yaml", "--output", folder.string()});
  INFO(result.output + result.errors);
  REQUIRE(result.exit_code == 0);
  CHECK(result.json().at("commands").size() == 3);
  const auto text = [&](const char* name) {
    std::ifstream stream(folder / name);
    return std::string((std::istreambuf_iterator<char>(stream)), {});
  };
  CHECK(text("CMakeLists.txt").find("GRAVITY 0 0 -9.8") != std::string::npos);
  CHECK(text("CMakeLists.txt").find("TIP \"tool_link\"") != std::string::npos);
  CHECK(text("main.cpp").find("articula::ComputedTorque<") != std::string::npos);
  CHECK(text("robot.urdf") == articula::remote::urdf_text(articula::Q2d()));
  CHECK(text("main.cpp").find(".urdf = URDF") != std::string::npos);  // it has visuals
  // What is there is never overwritten.
  check_refused(
      run_articula({"new", robot.name(), files + "/q2d.yaml", "--output", folder.string()}),
      "not empty");
  std::filesystem::remove_all(folder);
}

TEST_CASE("a project for drives on a CAN bus has their figures") {
  const Q2dFile robot;
  const ScratchFile controllers("can.yaml");
  const std::string head =
      "controller_manager:\n  ros__parameters:\n    cpu_affinity: 1\n"
      "    arm: {type: TYPE}\n"
      "arm:\n  ros__parameters:\n    joints: [shoulder_active_joint, elbow_active_joint]\n"
      "    constraints: {elbow_active_joint: {trajectory: 0.05}}\n";
  const std::string section = "can_drives:\n  ros__parameters:\n    protocol: ";
  const std::string figures = "rated_effort: 30, position_scale: 10, velocity_scale: 2";
  const std::string shoulder =
      "    shoulder_active_joint: {node: 1, watchdog: heartbeat, " + figures + "}\n";
  const auto elbow = [](const std::string& items) {
    return "    elbow_active_joint: {" + items + "}\n";
  };
  const auto made = [&](const std::string& text,
                        const std::string& type = "effort_controllers/JointGroupEffortController") {
    std::string before = head;
    before.replace(before.find("TYPE"), 4, type);
    write(controllers.path(), before + text);
    const support::ScratchFolder scratch("articula-new-can");
    const Result result = run_articula({"new", robot.name(), controllers.path().string(), "--can",
                                        "can7", "--output", scratch.path().string()});
    std::ifstream stream(scratch.path() / "main.cpp");
    const std::string program((std::istreambuf_iterator<char>(stream)), {});
    return std::pair(result, program);
  };
  const std::string drives = section + "cia402\n" + shoulder;
  const auto [result, program] =
      made(section + "cia402\n" + elbow("zero_position: -7, node: 2, " + figures) + shoulder);
  INFO(result.output + result.errors + program);
  REQUIRE(result.exit_code == 0);
  for (const char* part :
       {"{.node = 1, .rated_effort = 30, .position_scale = 10, .velocity_scale = 2, "
        ".watchdog = articula::Cia402Watchdog::heartbeat},\n"
        "      // elbow_active_joint\n"
        "      {.node = 2, .rated_effort = 30, .position_scale = 10, .velocity_scale = 2, "
        ".zero_position = -7}",
        "articula::Cia402Codec<", "articula::EffortCommand<", "articula::SocketCan(\"can7\")",
        ".thread = {.priority = 80, .processors = {1}}", "CONTROLLERS, {\"arm\"})}",
        // Efforts that are passed on are 0 at first: the arm would fall.
        ".active = \"\""}) {
    INFO(part);
    CHECK(program.find(part) != std::string::npos);
  }

  const auto refused = [&](const std::string& text) { return made(text).first; };
  check_refused(refused(""), "can_drives");
  check_refused(refused("can_drives:\n  ros__parameters:\n" + shoulder), "protocol");
  check_refused(refused(section + "ethercat\n"), "'ethercat'");
  check_refused(refused(drives), "'elbow_active_joint'");
  check_refused(refused(drives + elbow("node: 2, " + figures) + "    wrist: {node: 3}\n"),
                "'wrist'");
  check_refused(refused(drives + elbow("node: 128, " + figures)), "127");
  check_refused(refused(drives + elbow(figures)), "node");
  check_refused(refused(drives + elbow("node: 2, rated_effort: 3")), "position_scale");
  check_refused(refused(drives + elbow("node: 2, rated_efort: 3")), "rated_effort");
  check_refused(refused(drives + elbow("node: 2, watchdog: dog, " + figures)), "heartbeat");
  check_refused(refused(drives + elbow("node: 2, rated_effort: x")), "a number");
  check_refused(
      made(section + "quanser\n", "position_controllers/JointGroupPositionController").first,
      "efforts alone");
}

TEST_CASE("a new project shows the visuals and the meshes of its robot") {
  const support::ScratchFolder scratch("articula-new-meshes");
  scratch.write("my_arm/package.xml", "<package/>");
  std::string urdf = articula::remote::urdf_text(articula::Q2d());
  urdf.insert(urdf.rfind("</robot>"),
              "<link name=\"plate\"><visual><geometry><mesh filename=\"package://my_arm/a.stl\"/>"
              "</geometry></visual></link><joint name=\"plate_joint\" type=\"fixed\">"
              "<parent link=\"tool_link\"/><child link=\"plate\"/></joint>");
  scratch.write("my_arm/arm.urdf", urdf);
  const std::string output = (scratch.path() / "project").string();
  const Result result = run_articula({"new", (scratch.path() / "my_arm/arm.urdf").string(),
                                      files + "/q2d.yaml", "--output", output});
  INFO(result.output + result.errors);
  REQUIRE(result.exit_code == 0);
  std::ifstream stream(output + "/main.cpp");
  const std::string text((std::istreambuf_iterator<char>(stream)), {});
  CHECK(text.find(".urdf = URDF") != std::string::npos);
  const std::string folder = std::filesystem::canonical(scratch.path() / "my_arm").string();
  CHECK(text.find("{\"my_arm\", \"" + folder + "\"}") != std::string::npos);
}
