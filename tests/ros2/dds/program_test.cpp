// SPDX-License-Identifier: Apache-2.0
// The program articula in ROS 2, over DDS on loopback.
#include <articula/remote/sheet/urdf_text.hpp>
#include <articula/robots/q2d.hpp>

#include "articula/ros2/messages/rcl_interfaces.hpp"
#include "articula/ros2/messages/rosgraph_msgs.hpp"
#include "articula/ros2/messages/sensor_msgs.hpp"
#include "articula/ros2/messages/std_msgs.hpp"
#include "articula/ros2/messages/tf2_msgs.hpp"
#include "articula/ros2/names.hpp"

#include "catch.hpp"
#include "fast_dds_peer.hpp"
#include "scratch_file.hpp"
#include "support.hpp"
#include "terminal.hpp"

#include <chrono>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

using namespace articula::ros2;
using namespace articula::ros2::test;
using States = sensor_msgs::msg::JointState<Jazzy>;
using Clock = rosgraph_msgs::msg::Clock;
using Frames = tf2_msgs::msg::TFMessage<Jazzy>;
using Numbers = std_msgs::msg::Float64MultiArray<Jazzy>;
using GetParameters = rcl_interfaces::srv::GetParameters<Jazzy>;
using Value = rcl_interfaces::msg::ParameterValue<Jazzy>;

namespace {

// The program with a robot, until it is destroyed.
class Program {
 public:
  explicit Program(std::vector<std::string> words) : process_(command(std::move(words))) {
    INFO(robot_.path());
    REQUIRE(!process_.line().empty());
  }
  [[nodiscard]] support::Result end() {
    process_.interrupt();
    return process_.end();
  }

 private:
  std::vector<std::string> command(std::vector<std::string> words) {
    std::ofstream(robot_.path()) << articula::remote::urdf_text(articula::Q2d());
    std::vector<std::string> all{ARTICULA_PROGRAM, "--json", "--port", "0"};
    for (std::string& word : words) all.push_back(word == "ROBOT" ? robot_.path().string() : word);
    for (const char* word : {"--ros2", "--domain"}) all.emplace_back(word);
    all.push_back(std::to_string(domain()));
    return all;
  }
  support::ScratchFile robot_{"q2d.urdf"};
  support::Process process_;
};

// The last message that came to a reader, waiting at most 30 s for the first.
template <class M>
std::optional<M> newest(FastDdsPeer& peer, std::size_t reader) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (std::chrono::steady_clock::now() < end) {
    const auto all = peer.take(reader);
    M message{};
    if (!all.empty() && decode(all.back(), message) == CdrError::none) return message;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return std::nullopt;
}

// Parameters of a node, waiting at most 30 s for it.
std::vector<Value> parameters(FastDdsPeer& peer, const std::string& node,
                              const std::vector<std::string>& names) {
  const std::string service = node + "/get_parameters";
  const auto requests =
      peer.make_writer(request_topic_name(service), dds_type_name<GetParameters::Request>());
  const auto replies =
      peer.make_reader(reply_topic_name(service), dds_type_name<GetParameters::Response>());
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  const auto pause = std::chrono::milliseconds(20);
  while (peer.matches_of_writer(requests) == 0 || peer.matches_of_reader(replies) == 0) {
    if (std::chrono::steady_clock::now() > end) return {};
    std::this_thread::sleep_for(pause);
  }
  peer.request(requests, replies, bytes_of(GetParameters::Request{.names = names}));
  while (std::chrono::steady_clock::now() < end) {
    for (const auto& reply : peer.take_replies(replies)) {
      GetParameters::Response response;
      if (decode(reply.bytes, response) == CdrError::none) return response.values;
    }
    std::this_thread::sleep_for(pause);
  }
  return {};
}

}  // namespace

TEST_CASE("articula run offers its loop to ROS 2, below a namespace") {
  FastDdsPeer peer(domain());
  const auto reader = peer.make_reader(topic_name("/left/joint_states"), dds_type_name<States>());
  const auto frames = peer.make_reader(topic_name("/tf"), dds_type_name<Frames>());
  Program program({"run", "ROBOT", CONTROLLERS, "--namespace", "/left", "--frame-prefix", "left/"});
  const auto states = newest<States>(peer, reader);
  REQUIRE(states);
  CHECK(states->name == std::vector<std::string>{"shoulder_active_joint", "elbow_active_joint"});
  const auto placed = newest<Frames>(peer, frames);
  REQUIRE(placed);
  REQUIRE(!placed->transforms.empty());
  CHECK(placed->transforms[0].child_frame_id.starts_with("left/"));
  CHECK(program.end().exit_code == 0);
}

TEST_CASE("numbers for a controller are those of its joints, in what the file commands") {
  const support::ScratchFile file("groups.yaml");
  std::ofstream(file.path())
      << "controller_manager:\n  ros__parameters:\n    update_rate: 100\n"
         "    arm: {type: position_controllers/JointGroupPositionController}\n"
         "    hand: {type: position_controllers/JointGroupPositionController}\n"
         "arm:\n  ros__parameters:\n    joints: [shoulder_active_joint]\n"
         "hand:\n  ros__parameters:\n    joints: [elbow_active_joint]\n";
  FastDdsPeer peer(domain());
  const auto states = peer.make_reader(topic_name("/joint_states"), dds_type_name<States>());
  const auto commands = peer.make_writer(topic_name("/hand/commands"), dds_type_name<Numbers>());
  Program program({"run", "ROBOT", file.path().string(), "--mock"});
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  std::optional<States> state;
  const auto arrived = [&] {
    return state && state->position.at(0) == 0 && std::abs(state->position.at(1) - 0.2) < 1e-9;
  };
  Numbers command;
  command.data = {0.2};
  while (!arrived() && std::chrono::steady_clock::now() < end) {
    peer.write(commands, bytes_of(command));
    state = newest<States>(peer, states);
  }
  CHECK(arrived());
  CHECK(program.end().exit_code == 0);
}

TEST_CASE("articula simulate is a robot behind topics, with a clock") {
  FastDdsPeer peer(domain());
  const auto states = peer.make_reader(topic_name("/robot_joint_states"), dds_type_name<States>());
  const auto clock = peer.make_reader(topic_name("/clock"), dds_type_name<Clock>());
  const auto commands =
      peer.make_writer(topic_name("/robot_joint_commands"), dds_type_name<States>());
  Program program({"simulate", "ROBOT"});
  const auto before = newest<Clock>(peer, clock);
  REQUIRE(before);
  States command;
  command.name = {"elbow_active_joint", "shoulder_active_joint"};
  command.position = {0.2, -0.1};
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  std::optional<States> state;
  // A drive's position settles to a hundredth of the way at the latest after some time constants.
  const auto arrived = [&] {
    return state && std::abs(state->position.at(0) + 0.1) < 1e-3 &&
           std::abs(state->position.at(1) - 0.2) < 2e-3;
  };
  while (!arrived() && std::chrono::steady_clock::now() < end) {
    peer.write(commands, bytes_of(command));
    state = newest<States>(peer, states);
  }
  CHECK(arrived());
  const auto after = newest<Clock>(peer, clock);
  REQUIRE(after);
  CHECK(after->clock.sec * 1e9 + after->clock.nanosec >
        before->clock.sec * 1e9 + before->clock.nanosec);
  CHECK(program.end().exit_code == 0);
}

TEST_CASE("parameters have the names and values of the file") {
  const support::ScratchFile file("hand.yaml");
  std::ofstream(file.path())
      << "controller_manager:\n  ros__parameters:\n    update_rate: 100\n"
         "    arm: {type: joint_trajectory_controller/JointTrajectoryController}\n"
         "    hand: {type: effort_controllers/GripperActionController}\n"
         "arm:\n  ros__parameters:\n    joints: [shoulder_active_joint]\n"
         "    command_interfaces: [effort]\n"
         "    gains: {shoulder_active_joint: {p: 20.0}}\n"
         "    constraints: {goal_time: 2.0, shoulder_active_joint: {trajectory: 0.3, goal: 0.1}}\n"
         "hand:\n  ros__parameters:\n    joint: elbow_active_joint\n"
         "    elbow_active_joint: {p: 10.0}\n"
         "    goal_tolerance: 0.02\n    stall_timeout: 0.5\n    allow_stalling: true\n";
  FastDdsPeer peer(domain());
  Program program({"run", "ROBOT", file.path().string()});
  const std::string constraint = "constraints.shoulder_active_joint.";
  const auto arm = parameters(
      peer, "/arm",
      {"gains.shoulder_active_joint.p", "constraints.goal_time",
       "constraints.stopped_velocity_tolerance", constraint + "trajectory", constraint + "goal"});
  REQUIRE(arm.size() == 5);
  CHECK(arm[0].double_value == 20);
  CHECK(arm[1].double_value == 2);
  CHECK(arm[2].double_value == 0.01);
  CHECK(arm[3].double_value == 0.3);
  CHECK(arm[4].double_value == 0.1);
  const auto hand = parameters(
      peer, "/hand", {"elbow_active_joint.p", "goal_tolerance", "stall_timeout", "allow_stalling"});
  REQUIRE(hand.size() == 4);
  CHECK(hand[0].double_value == 10);
  CHECK(hand[1].double_value == 0.02);
  CHECK(hand[2].double_value == 0.5);
  CHECK(hand[3].bool_value);
  const auto end = program.end();
  CHECK(end.exit_code == 0);
  CHECK(end.errors.find("gripper") == std::string::npos);
}
