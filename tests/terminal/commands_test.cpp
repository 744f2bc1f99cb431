// SPDX-License-Identifier: Apache-2.0
/// @file The commands of articula, against a loop that runs.
#include "../view/web_client.hpp"
#include "catch.hpp"
#include "completion.hpp"
#include "running_arm.hpp"
#include "scratch_file.hpp"

#include <articula/recording/mcap_record_reader.hpp>
#include <articula/replay/replay.hpp>
#include <articula/ros2/cdr_decoder.hpp>
#include <articula/ros2/messages/sensor_msgs.hpp>
#include <articula/view/show_arguments.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <future>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

using support::Result;
using support::RunningArm;
using support::ScratchFile;
using Json = nlohmann::json;

namespace {

constexpr const char* shoulder = "shoulder_active_joint";
constexpr const char* elbow = "elbow_active_joint";

/// What is done in the end, however busy the machine is.
template <class Condition>
bool eventually(Condition condition) {
  for (int k = 0; k < 600; ++k) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

Json done(const Result& result) {
  INFO(result.output + result.errors);
  REQUIRE(result.exit_code == 0);
  return result.json();
}

/// Refused, with a message that has these words in it.
void check_refused(const Result& result, const std::vector<std::string>& words) {
  INFO(result.output + result.errors);
  CHECK(result.exit_code == 1);
  const Json json = result.json();
  CHECK(json.at("success") == false);
  CHECK(json.at("exit_code") == 1);
  for (const std::string& word : words) {
    CAPTURE(word);
    CHECK(json.at("message").get<std::string>().find(word) != std::string::npos);
  }
}

double of_joint(const RunningArm& arm, const std::string& joint, const char* member) {
  const Json status = done(arm.ask({"status"}));
  for (const Json& each : status.at("joints")) {
    if (each.at("name") == joint) return each.at(member).get<double>();
  }
  FAIL("no joint " + joint);
  return 0;
}

double position(const RunningArm& arm, const std::string& joint) {
  return of_joint(arm, joint, "position");
}

double reference(const RunningArm& arm, const std::string& joint) {
  return of_joint(arm, joint, "reference_position");
}

std::string mode(const RunningArm& arm) {
  return done(arm.ask({"status"})).at("situation").at("mode").get<std::string>();
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

}  // namespace

TEST_CASE("status shows robot, situation, statistics and joints") {
  const RunningArm arm;
  REQUIRE(eventually([&] { return mode(arm) == "active"; }));
  const Json status = done(arm.ask({"status"}));
  CHECK(status.at("robot").at("name") == "q2d");
  CHECK(status.at("robot").at("is_simulated") == true);
  CHECK(status.at("robot").at("joints").size() == 2);
  CHECK(status.at("situation").at("fault") == "ok");
  CHECK(status.at("situation").at("operates") == true);
  CHECK(status.at("statistics").at("cycles").get<int>() > 0);
  CHECK(status.at("joints").at(0).at("name") == shoulder);
  CHECK(status.at("joints").at(0).at("reference_position").is_number());
  CHECK(status.at("joints").at(0).at("effort").is_number());

  const Result text = support::run_articula({"status", "--port", arm.port()});
  CHECK(text.exit_code == 0);
  for (const char* word :
       {"q2d, simulated, 1000 Hz", "active", "pid_plus_gravity", "nobody", "reference", elbow}) {
    CAPTURE(word);
    CHECK(text.output.find(word) != std::string::npos);
  }
}

TEST_CASE("watch prints a document for each state") {
  const RunningArm arm;
  const Result result = arm.ask({"watch", "--seconds", "2", "--rate", "20"});
  CHECK(result.exit_code == 0);
  std::vector<double> times;
  for (std::size_t at = 0; at < result.output.size();) {
    const std::size_t end = result.output.find('\n', at);
    const Json line = Json::parse(result.output.substr(at, end - at));
    times.push_back(line.at("time").get<double>());
    CHECK(line.at("joints").size() == 2);
    CHECK(line.at("joints").at(1).at("reference_position").is_number());
    at = end + 1;
  }
  REQUIRE(times.size() >= 2);
  CHECK(std::ranges::is_sorted(times));
}

TEST_CASE("controllers are listed and switched") {
  const RunningArm arm;
  const auto status_of = [&](const std::string& name) {
    const Json answer = done(arm.ask({"controllers"}));
    for (const Json& each : answer.at("controllers")) {
      if (each.at("name") == name) return each.at("status").get<std::string>();
    }
    return std::string("none");
  };
  CHECK(eventually([&] { return status_of("pid_plus_gravity") == "active"; }));
  CHECK(status_of("bypass") == "inactive");
  done(arm.ask({"switch", "--start", "bypass", "--stop", "pid_plus_gravity"}));
  CHECK(eventually([&] { return status_of("bypass") == "active"; }));
  CHECK(status_of("pid_plus_gravity") == "inactive");
  done(arm.ask({"switch", "--start", "pid_plus_gravity", "--replace"}));
  CHECK(eventually([&] { return status_of("pid_plus_gravity") == "active"; }));
  check_refused(arm.ask({"switch", "--start", "nonsense"}), {"nonsense"});
  check_refused(arm.ask({"switch", "--start", "bypass"}), {"bypass", "active", "replace"});
  check_refused(arm.ask({"switch", "--start", "bypass", "pid_plus_gravity", "--replace"}),
                {"pid_plus_gravity", "another controller of these joints", "starts, too"});
  CHECK(status_of("pid_plus_gravity") == "active");
}

TEST_CASE("gains are read and set, all or none") {
  const RunningArm arm;
  const std::string p = std::string("pid_plus_gravity.") + elbow + ".p",
                    d = std::string("pid_plus_gravity.") + elbow + ".d";
  const auto value = [&](const std::string& name) {
    const Json parameters = done(arm.ask({"gains", "get", name})).at("parameters");
    REQUIRE(parameters.size() == 1);
    return parameters.at(0).at("value").get<double>();
  };
  CHECK(value(p) == 339);
  CHECK(done(arm.ask({"gains", "get", p})).at("parameters").at(0).at("unit") == "N m/rad");
  CHECK(done(arm.ask({"gains", "get"})).at("parameters").size() >
        done(arm.ask({"gains", "get", std::string("pid_plus_gravity.") + elbow}))
            .at("parameters")
            .size());
  done(arm.ask({"gains", "set", p + "=300", d + "=0.5"}));
  CHECK(eventually([&] { return value(p) == 300; }));
  CHECK(value(d) == 0.5);
  check_refused(arm.ask({"gains", "set", d + "=1", p + "=-1"}), {elbow});
  CHECK(value(d) == 0.5);
  // A clamp is set, shown, and taken away in the way in which it is shown.
  const std::string clamp = std::string("pid_plus_gravity.") + elbow + ".u_clamp_min";
  const auto is_shown = [&](const std::string& text) {
    return support::run_articula({"--port", arm.port(), "gains", "get", clamp})
               .output.find(" " + text) != std::string::npos;
  };
  CHECK(is_shown("-inf"));
  done(arm.ask({"gains", "set", clamp + "=-25"}));
  CHECK(eventually([&] { return is_shown("-25"); }));
  done(arm.ask({"gains", "set", clamp + "=-inf"}));
  CHECK(eventually([&] { return is_shown("-inf"); }));
  check_refused(arm.ask({"gains", "set", clamp + "=inf"}), {clamp, "inf"});
  check_refused(arm.ask({"gains", "set", p + "=inf"}), {elbow, "inf"});
  check_refused(arm.ask({"gains", "set", "nonsense.p=1"}), {"nonsense"});
  check_refused(arm.ask({"gains", "get", "pid_plus_gravity.elbow_active_joint.pp"}),
                {"did you mean"});
}

TEST_CASE("bash completes the names of the running loop") {
  using Words = std::vector<std::string>;
  const RunningArm arm;
  const auto offered = [&](Words words) {
    words.insert(words.begin(), {"--port", arm.port()});
    return support::offered(words);
  };
  const Words joints{std::string(shoulder) + "=", std::string(elbow) + "="};
  CHECK(offered({"switch", "--stop", "pid"}) == Words{"pid_plus_gravity"});
  CHECK(offered({"switch", "--start", "bypass", "--stop", ""}) ==
        Words{"pid_plus_gravity", "bypass"});
  CHECK(offered({"go", ""}) == joints);
  CHECK(offered({"stop", "el"}) == Words{std::string(elbow)});
  CHECK(offered({"go", "--wait", "--speed", "0.5", "el"}) == Words{joints[1]});
  CHECK(offered({"go", joints[0], "=", "0.1", "el"}) == Words{joints[1]});
  CHECK(offered({"go", "--speed", "el"}) == Words{""});
  CHECK(offered({"go", "elbow", "="}) == Words{""});
  CHECK(offered({"publish", "--velocity", "el"}) == Words{joints[1]});
  CHECK(offered({"gains", "get", "pid_plus_gravity.elbow_active_joint.pos"}).size() == 1);
  CHECK(offered({"gains", "set", "pid_plus_gravity.elbow_active_joint.pos"}) ==
        Words{"pid_plus_gravity.elbow_active_joint.position_weight="});
  CHECK(offered({"pull", ""}).size() > 2);
  CHECK(support::offered({"--port", "=", arm.port(), "pull", ""}) == offered({"pull", ""}));
  CHECK(support::offered({"--port", "1", "go", "el"}) == Words{""});  // no loop there, no message
}

TEST_CASE("go moves a joint and waits for it") {
  const RunningArm arm;
  REQUIRE(eventually([&] { return mode(arm) == "active"; }));
  done(arm.ask({"go", std::string(shoulder) + "=0.2", "--wait"}));
  CHECK(eventually([&] { return std::abs(position(arm, shoulder) - 0.2) < 1e-3; }));
  CHECK(std::abs(reference(arm, shoulder) - 0.2) < 1e-9);
  // Without --wait the motion goes on after the program's end.
  done(arm.ask(
      {"go", std::string(shoulder) + "=-0.1", std::string(elbow) + "=0.1", "--speed", "0.5"}));
  CHECK(eventually([&] { return std::abs(position(arm, shoulder) + 0.1) < 1e-3; }));
  CHECK(std::abs(position(arm, elbow) - 0.1) < 1e-2);
  check_refused(arm.ask({"go", "nonsense=1"}), {"nonsense"});
  check_refused(arm.ask({"go", std::string(shoulder) + "=100"}), {shoulder, "100"});
}

TEST_CASE("publish sets the reference once or again and again") {
  const RunningArm arm;
  REQUIRE(eventually([&] { return mode(arm) == "active"; }));
  done(arm.ask({"publish", std::string(elbow) + "=0.05"}));
  CHECK(eventually([&] { return std::abs(position(arm, elbow) - 0.05) < 1e-3; }));
  const Json often = done(arm.ask({"publish", std::string(elbow) + "=0", "--velocity",
                                   std::string(elbow) + "=0", "--rate", "50", "--seconds", "0.2"}));
  CHECK(often.at("published").get<int>() > 1);
  CHECK(eventually([&] { return std::abs(position(arm, elbow)) < 1e-3; }));
  check_refused(arm.ask({"publish", "nonsense=1"}), {"nonsense"});
}

TEST_CASE("play follows trajectories as ROS writes them") {
  const RunningArm arm;
  REQUIRE(eventually([&] { return mode(arm) == "active"; }));
  const support::ScratchFile yaml("trajectory.yaml"), json("trajectory.json");
  write(yaml.path(),
        "header: {frame_id: base}\n"
        "joint_names: [elbow_active_joint, shoulder_active_joint]\n"
        "points:\n"
        "  - positions: [0.1, -0.1]\n"
        "    time_from_start: {sec: 0, nanosec: 400000000}\n"
        "  - positions: [0.2, -0.2]\n"
        "    time_from_start: 0.8\n");
  done(arm.ask({"play", yaml.path().string()}));
  CHECK(eventually([&] { return std::abs(position(arm, elbow) - 0.2) < 1e-3; }));
  CHECK(std::abs(position(arm, shoulder) + 0.2) < 1e-2);
  write(json.path(),
        R"({"trajectory": {"joint_names": ["shoulder_active_joint", "elbow_active_joint"],
            "points": [{"positions": [0, 0], "velocities": [0, 0],
                        "time_from_start": {"secs": 1, "nsecs": 0}}]}})");
  done(arm.ask({"play", json.path().string()}));
  CHECK(eventually([&] { return std::abs(position(arm, elbow)) < 1e-3; }));

  for (const auto& [text, word] : std::vector<std::pair<std::string, std::string>>{
           {"", "no map"},
           {"[", "no YAML"},
           {"points: []", "joint_names"},
           {"joint_names: [a]\npoints: []", "no points"},
           {"joint_names: [a]\npoints: [{positions: [1, 2], time_from_start: 1}]", "2 numbers"},
           {"joint_names: [a]\npoints: [{positions: [x], time_from_start: 1}]", "'x' is no number"},
           {"joint_names: [a]\npoints: [{positions: [1]}]", "time_from_start"},
           {"joint_names: [a]\npoints: [{position: [1], time_from_start: 1}]", "'position'"},
           {"joint_names: [a]\npoints: [{positions: [1], time_from_start: 1}]", "a"}}) {
    CAPTURE(text);
    write(yaml.path(), text);
    check_refused(arm.ask({"play", yaml.path().string()}), {word});
  }
  check_refused(arm.ask({"play", "/no/such/file"}), {"/no/such/file", "cannot be read"});
}

TEST_CASE("a program that is ended while it plays stops the motion") {
  RunningArm arm;
  REQUIRE(eventually([&] { return mode(arm) == "active"; }));
  const support::ScratchFile yaml("long.yaml");
  write(yaml.path(),
        "joint_names: [shoulder_active_joint, elbow_active_joint]\n"
        "points:\n"
        "  - {positions: [1, 1], time_from_start: 1000}\n");
  {
    support::Process play({ARTICULA_PROGRAM, "--port", arm.port(), "play", yaml.path().string()});
    CHECK(eventually([&] { return arm.remote().situation().motion == "trajectory"; }));
  }
  CHECK(eventually([&] { return arm.remote().situation().motion == "rest"; }));
  CHECK(arm.remote().situation().operator_name.empty());
}

TEST_CASE("the loop is deactivated, activated and stopped") {
  RunningArm arm;
  REQUIRE(eventually([&] { return mode(arm) == "active"; }));
  done(arm.ask({"stop"}));
  // At this speed, the motion takes more than 20 s.
  done(arm.ask(
      {"go", "--speed", "0.01", std::string(shoulder) + "=0.5", std::string(elbow) + "=0.5"}));
  done(arm.ask({"stop", std::string(elbow)}));
  const auto motions = arm.remote().situation().joint_motions;
  CHECK(motions.at(0) == "go");
  CHECK(motions.at(1) != "go");
  check_refused(arm.ask({"stop", "knee"}), {"knee"});
  done(arm.ask({"deactivate"}));
  CHECK(eventually([&] { return mode(arm) == "inactive"; }));
  check_refused(arm.ask({"go", std::string(elbow) + "=0.1"}), {"active"});
  check_refused(arm.ask({"fault", "ack"}), {"fault"});  // there is none
  done(arm.ask({"activate"}));
  CHECK(eventually([&] { return mode(arm) == "active"; }));
}

TEST_CASE("a simulation is paused, stepped, slowed, reset and pulled at") {
  RunningArm arm;
  REQUIRE(eventually([&] { return mode(arm) == "active"; }));
  done(arm.ask({"pause"}));
  CHECK(eventually([&] { return arm.remote().situation().paused; }));
  CHECK(std::isfinite(reference(arm, shoulder)));  // although no cycle comes
  done(arm.ask({"step", "10"}));
  done(arm.ask({"resume"}));
  CHECK(eventually([&] { return !arm.remote().situation().paused; }));
  done(arm.ask({"speed", "0.5"}));
  CHECK(eventually([&] { return arm.remote().situation().speed == 0.5; }));
  done(arm.ask({"speed", "1"}));
  done(arm.ask({"reset", std::string(shoulder) + "=0.3"}));
  CHECK(eventually([&] { return std::abs(position(arm, shoulder) - 0.3) < 0.05; }));
  done(arm.ask({"pull", "tool_link", "--force", "0", "-5", "0", "--seconds", "0.05"}));
  check_refused(arm.ask({"pull", "nonsense", "--force", "0", "0", "1", "--seconds", "0"}),
                {"nonsense"});
  check_refused(arm.ask({"reset", "nonsense=1"}), {"nonsense"});
}

TEST_CASE("record writes all cycles to an MCAP file") {
  const RunningArm arm;
  REQUIRE(eventually([&] { return mode(arm) == "active"; }));
  const support::ScratchFile file("record.mcap");
  const Json result = done(arm.ask({"record", file.path().string(), "--seconds", "2"}));
  CHECK(result.at("cycles").get<int>() > 0);
  std::ifstream stream(file.path(), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  const std::string magic("\x89MCAP0\r\n", 8);
  CHECK(bytes.starts_with(magic));
  CHECK(bytes.ends_with(magic));  // it was closed
  int messages = 0;
  for (std::size_t at = 0; (at = bytes.find("\"timing\":{\"latency\":", at)) != std::string::npos;
       ++at) {
    ++messages;
  }
  CHECK(messages == result.at("cycles").get<int>());
  CHECK(bytes.find("\"shoulder_active_joint\":{\"position\":") != std::string::npos);
  check_refused(arm.ask({"record", "/no/such/folder/x.mcap", "--seconds", "0"}),
                {"/no/such/folder"});

  check_refused(arm.ask({"record", file.path().string(), "--seconds", "0"}),
                {file.path().string(), "exists", "--force"});
  CHECK(std::filesystem::file_size(file.path()) == bytes.size());
  done(arm.ask({"record", file.path().string(), "--seconds", "0", "--force"}));
  CHECK(std::filesystem::file_size(file.path()) < bytes.size());
}

TEST_CASE("record --ros writes all cycles as messages of ROS 2") {
  const RunningArm arm;
  REQUIRE(eventually([&] { return mode(arm) == "active"; }));
  const support::ScratchFile file("ros.mcap");
  const Json result = done(arm.ask({"record", file.path().string(), "--ros", "--seconds", "1"}));
  const auto cycles = result.at("cycles").get<std::size_t>();
  CHECK(cycles > 0);
  using States = articula::ros2::sensor_msgs::msg::JointState<articula::ros2::Jazzy>;
  std::size_t messages = 0, with_position = 0;
  articula::McapReader(file.path()).read([&](std::uint64_t, std::string_view bytes) {
    States states;
    REQUIRE(articula::ros2::decode(std::as_bytes(std::span(bytes)), states) ==
            articula::ros2::CdrError::none);
    CHECK(states.name.size() == 2);
    CHECK(states.effort.size() == 2);
    ++messages;
    if (states.position.size() == 2) ++with_position;
  });
  CHECK(messages == 3 * cycles);       // state, reference, command
  CHECK(with_position == 2 * cycles);  // an effort alone is commanded
}

TEST_CASE("what record writes is replayed to the last bit, with gains and a switch in it") {
  RunningArm arm;
  REQUIRE(eventually([&] { return mode(arm) == "active"; }));
  const std::string gain = "pid_plus_gravity." + std::string(elbow) + ".p";
  CHECK(arm.ask({"gains", "set", gain + "=300"}).exit_code == 0);  // before the recording
  CHECK(arm.ask({"deactivate"}).exit_code == 0);
  const support::ScratchFile file("replay.mcap");
  auto recorded = std::async(std::launch::async, [&] {
    return arm.ask({"record", file.path().string(), "--seconds", "4"});
  });
  REQUIRE(eventually([&] { return std::filesystem::exists(file.path()); }));
  CHECK(mode(arm) == "inactive");
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"activate"},
           {"go", std::string(elbow) + "=0.4"},
           {"gains", "set", gain + "=350"},
           {"switch", "--start", "bypass", "--stop", "pid_plus_gravity"}}) {
    CHECK(arm.ask(words).exit_code == 0);
  }
  CHECK(done(recorded.get()).at("lost") == 0);
  using Loop = articula::SupervisedLoop<articula::Q2dSim, support::ArmControllers>;
  const auto recording = articula::read_mcap_recording<Loop::Command>(articula::Q2d(), file.path());
  REQUIRE(recording.changes.size() == 3);  // the first one has what was set before
  CHECK(recording.changes.back().cycle > recording.cycles.front().cycle);
  const articula::ReplayOptions<Loop::ControllerType> options{.supervision = {.overruns = 1000000}};
  const auto found = articula::Replay<Loop>(recording, options).run();
  CHECK((found ? articula::to_string(*found) : "") == "");
  auto lacking = recording;
  lacking.changes.erase(lacking.changes.begin());
  CHECK(articula::Replay<Loop>(lacking, options).run());
}

TEST_CASE("somebody else's controls are respected") {
  RunningArm arm;
  REQUIRE(eventually([&] { return mode(arm) == "active"; }));
  const auto other = arm.remote().connect("Ada", true);
  REQUIRE(other->take_controls().empty());
  auto result =
      std::async(std::launch::async, [&] { return arm.ask({"go", std::string(elbow) + "=0.1"}); });
  while (result.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) {
    other->keep_alive();
  }
  check_refused(result.get(), {"Ada"});
  CHECK(arm.ask({"status"}).exit_code == 0);  // who watches needs no controls
}

TEST_CASE("a read-only view refuses what operates, and shows the rest") {
  const RunningArm arm(articula::ViewOptions{});
  CHECK(done(arm.ask({"status"})).at("situation").at("operates") == false);
  CHECK(done(arm.ask({"gains", "get"})).at("parameters").size() > 0);
  check_refused(arm.ask({"go", std::string(elbow) + "=0.1"}), {"only shows"});
  check_refused(arm.ask({"activate"}), {"only shows"});
}

TEST_CASE("a token is needed where the view has one") {
  const RunningArm arm({.operates = true, .token = "0123456789abcdef"});
  CHECK(arm.ask({"status"}).exit_code == 3);
  CHECK(arm.ask({"status", "--token", "wrong &?# token"}).exit_code == 3);
  CHECK(arm.ask({"--token", "0123456789abcdef", "status"}).exit_code == 0);
}

TEST_CASE("show serves the URDF that it is given, and ends by Ctrl-C") {
  const ScratchFile file("shown.urdf");
  const std::string urdf = "<!-- of a file -->" + articula::remote::urdf_text(articula::Q2d());
  write(file.path(), urdf);
  boost::asio::io_context context;
  boost::asio::ip::tcp::acceptor acceptor(context, {boost::asio::ip::tcp::v4(), 0});
  const std::uint16_t port = acceptor.local_endpoint().port();
  acceptor.close();
  articula::SupervisedLoop<articula::Q2dSim, support::ArmControllers> arm(
      articula::SupervisionOptions{.overruns = 1000000});
  auto shown = std::async(std::launch::async, [&] {
    const std::string number = std::to_string(port);
    const std::array<const char*, 3> words{"arm", "--port", number.c_str()};
    return articula::show_with_arguments(
        arm, 3, words.data(), {.view = {.client_limit = 4}, .urdf = file.path().string()});
  });
  Json robot, situation;
  REQUIRE(eventually([&] {
    try {
      support::WebClient client(port);
      robot = client.call("/robot", Json::object());
      situation = client.call("/situation", Json::object());
      return true;
    } catch (const std::exception&) {  // the port is not open yet
      return false;
    }
  }));
  INFO(robot.dump());
  CHECK(robot.dump().find("of a file") != std::string::npos);
  CHECK(situation.at("operates") == true);  // also with options of the view
  std::raise(SIGINT);
  CHECK(shown.get() == 0);

  CHECK(articula::show(arm, {.urdf = "/no/such.urdf"}) == 1);
}

TEST_CASE("the command line changes the options of show") {
  const auto read = [](const std::vector<const char*>& words) {
    return articula::with_arguments({}, static_cast<int>(words.size()), words.data());
  };
  const articula::ShowOptions all =
      read({"arm", "--port", "0", "--address", "::1", "--token", "abc", "--read-only", "--view",
            "--seconds", "2.5", "--priority", "7"});
  CHECK(all.view.port == 0);
  CHECK(all.view.address == "::1");
  CHECK(all.view.token == "abc");
  CHECK(all.view.operates == false);
  CHECK(all.opens_browser);
  CHECK(all.seconds == 2.5);
  CHECK(all.thread.priority == 7);
  CHECK(all.thread.lock_memory);
  CHECK(!read({"arm"}).view.operates.has_value());
  using Wrong = std::vector<const char*>;
  for (const Wrong& wrong : {Wrong{"arm", "--port"}, Wrong{"arm", "--port", "65536"},
                             Wrong{"arm", "--port", "1.5"}, Wrong{"arm", "--priority", "100"},
                             Wrong{"arm", "--seconds", "nan"}, Wrong{"arm", "--prot", "1"}}) {
    CHECK_THROWS_AS(read(wrong), std::invalid_argument);
  }
}
