// SPDX-License-Identifier: Apache-2.0
// Hardware over topics, over DDS on loopback, with a peer in ROS's place.
#include "articula/ros2/hardware/topic_hardware.hpp"

#include <articula/control/bypass.hpp>
#include <articula/loop/loop.hpp>
#include <articula/loop/run.hpp>
#include <articula/robots/q2d.hpp>

#include "articula/ros2/names.hpp"

#include "catch.hpp"
#include "fast_dds_peer.hpp"
#include "support.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

using namespace articula;
using namespace articula::ros2::test;
using States = ros2::sensor_msgs::msg::JointState<ros2::Jazzy>;

TEST_CASE("states come in and commands go out over DDS, and the end is a stop") {
  talk_over_udp_only();
  const bool best_effort = GENERATE(false, true);
  FastDdsPeer peer(domain());
  const std::string type = ros2::dds_type_name<States>();
  const auto states =
      peer.make_writer(ros2::topic_name("/robot_joint_states"), type, false, best_effort);
  const auto commands = peer.make_reader(ros2::topic_name("/robot_joint_commands"), type);
  States joints;
  joints.name = {"elbow_active_joint", "shoulder_active_joint"};
  joints.position = {0, 0};
  States command;
  const auto turn = [&] {  // the joints have the positions of the last command's velocities
    for (const Bytes& bytes : peer.take(commands)) {
      REQUIRE(ros2::decode(bytes, command) == ros2::CdrError::none);
      joints.position = {command.velocity[1], command.velocity[0]};
    }
    peer.write(states, bytes_of(joints));
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  };
  const auto is_over = [end = std::chrono::steady_clock::now() + std::chrono::seconds(10)] {
    return std::chrono::steady_clock::now() > end;
  };

  {
    ros2::TopicHardware<Q2d, VelocityCommand<2>> arm(
        std::make_unique<ros2::FastDdsTransport>(ros2::FastDdsOptions{.domain = domain()},
                                                 ros2::Distribution::jazzy),
        {.stale_after = 5, .silent_after = 5, .set_up_time = 0, .command_deadline = 5});
    CHECK(arm.problem() == "joint 'shoulder_active_joint': no recent state on /robot_joint_states");
    while (arm.activate() != Status::ok && !is_over()) turn();
    JointState<2> state;
    while (state.position != JointVector<2>{0.5, -0.25} && !is_over()) {
      REQUIRE(arm.write({JointVector<2>{0.5, -0.25}}) == Status::ok);
      turn();
      REQUIRE(arm.read(state) == Status::ok);
    }
    CHECK(state.position == JointVector<2>{0.5, -0.25});
    CHECK(command.name == std::vector<std::string>{"shoulder_active_joint", "elbow_active_joint"});
  }
  while (command.velocity != std::vector<double>{0, 0} && !is_over()) turn();
  CHECK(command.velocity == std::vector<double>{0, 0});
}

TEST_CASE("a loop keeps the pace of a simulator's clock over DDS") {
  talk_over_udp_only();
  FastDdsPeer peer(domain());
  const auto states = peer.make_writer(ros2::topic_name("/robot_joint_states"),
                                       ros2::dds_type_name<States>(), false, true);
  const auto times =
      peer.make_writer(ros2::topic_name("/clock"),
                       ros2::dds_type_name<ros2::rosgraph_msgs::msg::Clock>(), false, true);
  const auto commands =
      peer.make_reader(ros2::topic_name("/robot_joint_commands"), ros2::dds_type_name<States>());
  States joints;
  joints.name = {"shoulder_active_joint", "elbow_active_joint"};
  joints.position = {0, 0};
  std::atomic<bool> ends = false;
  std::uint64_t periods = 0;
  std::thread simulator([&] {  // a third of real time
    while (!ends) {
      ++periods;
      const auto time =
          ros2::to_message<ros2::builtin_interfaces::msg::Time>(std::chrono::milliseconds(periods));
      peer.write(times, bytes_of(ros2::rosgraph_msgs::msg::Clock{time}));
      peer.write(states, bytes_of(joints));
      static_cast<void>(peer.take(commands));
      std::this_thread::sleep_for(std::chrono::milliseconds(3));
    }
  });

  using Arm = ros2::TopicHardware<Q2d>;
  const auto start = std::chrono::steady_clock::now();
  Loop<Arm, Bypass> loop(
      Arm(std::make_unique<ros2::FastDdsTransport>(ros2::FastDdsOptions{.domain = domain()},
                                                   ros2::Distribution::jazzy),
          {.stale_after = 5, .silent_after = 5, .set_up_time = 30, .clock_topic = "/clock"}));
  ros2::TopicClock clock = loop.hardware().clock();
  const RunReport report = run(loop, clock, {.cycles = 200});
  const auto took = std::chrono::steady_clock::now() - start;
  ends = true;
  simulator.join();
  CHECK(report.status == Status::ok);
  CHECK(report.end == RunEnd::finished);
  CHECK(report.cycles == 200);
  CHECK(report.cycles + report.missed <= periods);
  CHECK(took >= std::chrono::milliseconds(3) * 200);
}
