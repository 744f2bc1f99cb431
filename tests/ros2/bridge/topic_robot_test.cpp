// SPDX-License-Identifier: Apache-2.0
// A running loop is a robot behind topics.
#include "articula/ros2/hardware/topic_robot.hpp"

#include "bridged_arm.hpp"

#include <atomic>
#include <chrono>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace articula::ros2;
using support::bytes_of;
using support::elbow_joint;
using support::shoulder_joint;
using States = sensor_msgs::msg::JointState<Jazzy>;

namespace {

// A Q2D that takes efforts, its topics, and a clock that a test moves.
struct RobotBehindTopics {
  explicit RobotBehindTopics(const TopicRobotOptions& options = {},
                             std::unique_ptr<support::AnyLoop> own = support::bypass_arm())
      : loop(std::move(own)) {
    topics.emplace(loop->port(), transport, options);
    run(1);
  }
  void run(int milliseconds) {
    for (int k = 0; k < milliseconds; ++k) {
      loop->cycles(1);
      now += std::chrono::milliseconds(1);
      if (topics) topics->update(now);
    }
  }
  void command(const States& message) {
    transport.publish("/robot_joint_commands", bytes_of(message));
  }
  // The effort that the loop's reference has for a joint.
  double reference_effort(std::size_t joint) {
    while (watcher->next(cycle)) {
    }
    return cycle.reference_effort.at(joint);
  }

  articula::remote::Cycle cycle{};
  support::MemoryTransport transport{};
  std::unique_ptr<support::AnyLoop> loop;
  std::unique_ptr<articula::remote::Session> watcher = loop->port().connect("watcher", false);
  std::optional<TopicRobot> topics{};
  std::chrono::nanoseconds now{1'000'000'000};
};

}  // namespace

TEST_CASE("a robot behind topics publishes states and clock with the loop's time") {
  RobotBehindTopics arm;
  arm.run(20);
  const auto states = arm.transport.last<States>("/robot_joint_states");
  REQUIRE(states);
  CHECK(states->name == std::vector<std::string>{shoulder_joint, elbow_joint});
  CHECK(states->position.size() == 2);
  CHECK(states->velocity.size() == 2);
  CHECK(states->effort.size() == 2);
  // The time is that of the loop, which begins at 0, not that of the clock.
  CHECK(states->header.stamp.sec == 0);
  CHECK(states->header.stamp.nanosec > 0);
  const auto clock = arm.transport.last<rosgraph_msgs::msg::Clock>("/clock");
  REQUIRE(clock);
  CHECK(clock->clock.nanosec == states->header.stamp.nanosec);

  const std::size_t sent = arm.transport.topics.at("/robot_joint_states").count;
  arm.topics->update(arm.now);  // without a cycle
  CHECK(arm.transport.topics.at("/robot_joint_states").count == sent);
}

TEST_CASE("a robot behind topics needs no clock topic") {
  RobotBehindTopics arm({.publishes_clock = false});
  CHECK_FALSE(arm.transport.topics.contains("/clock"));
}

TEST_CASE("commands by name become the loop's reference, until none follows") {
  RobotBehindTopics arm;
  States command;
  command.name = {"a joint of another robot", elbow_joint, shoulder_joint};
  command.effort = {9, 0.25, 0.5};
  command.position = {9, 9, 9};  // which this loop does not command
  arm.command(command);
  arm.run(3);
  CHECK(arm.reference_effort(0) == 0.5);
  CHECK(arm.reference_effort(1) == 0.25);
  CHECK(arm.loop->port().situation().operator_name == "ROS 2 topics");

  command.effort[1] = std::numeric_limits<double>::quiet_NaN();
  command.effort[2] = 0.75;
  arm.command(command);
  arm.run(3);
  CHECK(arm.reference_effort(0) == 0.75);
  CHECK(arm.reference_effort(1) == 0.25);  // NaN leaves it

  arm.run(1010);  // command_lifetime is 1 s
  CHECK(arm.reference_effort(0) == 0);
  CHECK(arm.reference_effort(1) == 0);
  CHECK(arm.topics->statistics().expired == 1);
  arm.run(1010);
  CHECK(arm.loop->port().situation().operator_name.empty());
}

TEST_CASE("refused commands do not prolong the one before") {
  RobotBehindTopics arm;
  arm.command({.name = {shoulder_joint}, .effort = {0.5}});
  arm.run(3);
  REQUIRE(arm.reference_effort(0) == 0.5);
  for (int k = 0; k < 150; ++k) {
    arm.command({.name = {shoulder_joint}, .effort = {1000}});
    arm.run(10);
  }
  CHECK(arm.reference_effort(0) == 0);
  CHECK(arm.topics->statistics().expired == 1);
  CHECK(arm.topics->statistics().refused == 150);
}

TEST_CASE("a single command ends after its lifetime, also if the loop takes it late") {
  RobotBehindTopics arm;
  for (int round = 0; round < 2; ++round) {
    arm.command({.name = {shoulder_joint}, .effort = {0.5}});
    arm.topics->update(arm.now);  // before the loop makes a cycle
    arm.run(500);
    CHECK(arm.reference_effort(0) == 0.5);
    arm.run(1000);
    CHECK(arm.reference_effort(0) == 0);
    CHECK(arm.loop->port().situation().operator_name.empty());
    arm.run(2000);
  }
  CHECK(arm.topics->statistics().expired == 2);
}

TEST_CASE(
    "a stop of another client leaves the end of the command, and then the controls are free") {
  RobotBehindTopics arm;
  arm.command({.name = {shoulder_joint}, .effort = {0.5}});
  arm.run(10);
  REQUIRE(arm.reference_effort(0) == 0.5);
  arm.loop->port().connect("a stop", true)->ask(articula::remote::Stop{});  // needs no controls
  arm.run(1100);
  CHECK(arm.reference_effort(0) == 0);
  arm.run(1100);
  const auto other = arm.loop->port().connect("another client", true);
  CHECK(other->take_controls().empty());
}

TEST_CASE("a loop that stood still ends old commands when it goes on") {
  RobotBehindTopics arm;
  arm.command({.name = {shoulder_joint}, .effort = {0.5}});
  arm.run(3);
  for (int k = 0; k < 100; ++k) arm.command({.name = {shoulder_joint}, .effort = {0.75}});
  for (int k = 0; k < 2600; ++k) {
    arm.now += std::chrono::milliseconds(1);
    arm.topics->update(arm.now);
  }
  CHECK(arm.topics->statistics().refused == 68);  // 32 wait
  arm.run(1200);  // it takes those that wait; their lifetime begins then
  CHECK(arm.reference_effort(0) == 0);
  CHECK(arm.loop->port().situation().operator_name.empty());
}

TEST_CASE("a robot behind topics that is destroyed leaves no effort behind") {
  RobotBehindTopics arm;
  arm.command({.name = {shoulder_joint}, .effort = {0.5}});
  arm.run(3);
  REQUIRE(arm.reference_effort(0) == 0.5);
  arm.command({.name = {elbow_joint}, .effort = {0.25}});  // the loop has not taken it yet
  arm.topics.reset();
  arm.run(3);
  CHECK(arm.reference_effort(0) == 0);
  CHECK(arm.reference_effort(1) == 0);
  CHECK(arm.loop->port().situation().operator_name.empty());
}

TEST_CASE("a robot behind topics whose transport fails leaves no effort behind, and says so") {
  // One command, and later an error.
  struct Failing : support::MemoryTransport {
    void poll(std::chrono::microseconds) override {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (!std::exchange(has_begun, true)) {
        publish("/robot_joint_commands",
                bytes_of(States{.name = {shoulder_joint}, .effort = {0.5}}));
      }
      if (fails) throw std::runtime_error("the network is gone");
    }
    bool has_begun = false;
    std::atomic<bool> fails = false;
  };
  const auto loop = support::bypass_arm();
  const auto watcher = loop->port().connect("watcher", false);
  articula::remote::Cycle cycle{};
  const auto runs_until = [&](double effort) {
    for (int k = 0; k < 5000; ++k) {
      loop->cycles(1);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      while (watcher->next(cycle)) {
      }
      if (!cycle.reference_effort.empty() && cycle.reference_effort[0] == effort) return true;
    }
    return false;
  };
  auto transport = std::make_unique<Failing>();
  Failing& network = *transport;
  std::mutex mutex;
  std::string warning;
  {
    const TopicRobot topics(loop->port(), std::move(transport),
                            {.warn = [&](const std::string& text) {
                              const std::lock_guard lock(mutex);
                              warning = text;
                            }});
    REQUIRE(runs_until(0.5));
    network.fails = true;
    CHECK(runs_until(0));
  }
  CHECK(warning == "the topics have ended: the network is gone");
}

TEST_CASE("commands for a loop that is not active leave the controls to others") {
  std::vector<std::string> warnings;
  RobotBehindTopics arm({.warn = [&](const std::string& warning) { warnings.push_back(warning); }},
                        support::switched_arm());
  arm.command({.name = {shoulder_joint}, .effort = {0.5}});
  CHECK(arm.loop->port().situation().operator_name.empty());
  arm.run(3);
  CHECK(arm.topics->statistics().refused == 1);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("not active") != std::string::npos);
}

TEST_CASE("whoever watches a robot behind topics hears of commands that it does not read") {
  std::vector<std::string> warnings;
  RobotBehindTopics arm({.warn = [&](const std::string& warning) { warnings.push_back(warning); }});
  const auto warned = [&](const States& message) {
    arm.command(message);
    arm.run(1100);  // one warning a second
    return warnings.empty() ? "" : warnings.back();
  };
  const std::string topic = "/robot_joint_commands: ";
  CHECK(warned({.name = {"a", "b"}, .effort = {1, 1}}) ==
        topic + "a command names no joint of robot 'q2d'");
  CHECK(warned({.name = {shoulder_joint, elbow_joint}, .effort = {1}}) ==
        topic + "a command's fields differ in length, or it names a joint twice");
  CHECK(warnings.size() == 2);
}

TEST_CASE("commands that are wrong, foreign or refused change nothing") {
  std::vector<std::string> warnings;
  RobotBehindTopics arm({.warn = [&](const std::string& warning) { warnings.push_back(warning); }});
  const States good{.name = {shoulder_joint, elbow_joint}, .effort = {0.5, 0.25}};
  States shorter = good, twice = good, foreign = good, other_quantity = good;
  shorter.effort.pop_back();
  twice.name[1] = twice.name[0];
  foreign.name = {"a", "b"};
  other_quantity.position = good.effort;
  other_quantity.effort.clear();
  for (const States& message : {shorter, twice, foreign, other_quantity}) arm.command(message);
  arm.transport.publish("/robot_joint_commands", std::vector<std::byte>(3));
  arm.run(3);
  CHECK(arm.reference_effort(0) == 0);
  TopicRobotStatistics statistics = arm.topics->statistics();
  CHECK(statistics.malformed == 3);
  CHECK(statistics.foreign == 1);
  CHECK(statistics.refused == 1);
  CHECK(statistics.accepted == 0);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("quantities") != std::string::npos);

  const auto other = arm.loop->port().connect("another client", true);
  REQUIRE(other->take_controls().empty());
  arm.command(good);
  arm.run(3);
  CHECK(arm.reference_effort(0) == 0);
  CHECK(arm.topics->statistics().refused == 2);
  CHECK(warnings.size() == 1);  // within a second of the other
  arm.run(1000);
  arm.command(good);
  arm.run(3);
  REQUIRE(warnings.size() == 2);
  CHECK(warnings[1].find("another client") != std::string::npos);
  other->release_controls();
  arm.command(good);
  arm.run(3);
  CHECK(arm.reference_effort(0) == 0.5);
  CHECK(arm.topics->statistics().accepted == 1);
}

TEST_CASE("options of a robot behind topics are refused by name") {
  const auto loop = support::bypass_arm();
  support::MemoryTransport transport;
  const auto make = [&](const TopicRobotOptions& options) {
    const TopicRobot robot(loop->port(), transport, options);
  };
  CHECK_THROWS_WITH(make({.command_lifetime = 0}),
                    "topic robot: command_lifetime 0 s is not within 0 .. 1000000 s");
  CHECK_THROWS_WITH(make({.joint_states_topic = "states"}),
                    "topic robot: topic 'states' is no full name, as /arm/joint_states");
}
