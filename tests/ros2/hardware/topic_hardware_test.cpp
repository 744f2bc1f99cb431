// SPDX-License-Identifier: Apache-2.0
// A robot that lives behind topics is hardware of a loop.
#include "articula/ros2/hardware/topic_hardware.hpp"

#include <articula/control/pid_plus_gravity.hpp>
#include <articula/loop/loop.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/sim/simulator.hpp>

#include "catch.hpp"
#include "hand_clock.hpp"
#include "remote/memory_transport.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using namespace articula;
using ros2::TopicHardware;
using ros2::TopicHardwareOptions;
using support::HandClock;
using support::MemoryTransport;
using States = ros2::sensor_msgs::msg::JointState<ros2::Jazzy>;
using std::chrono::milliseconds;

namespace {

using Efforts = TopicHardware<Q2d, EffortCommand<2>, HandClock>;
using Positions = TopicHardware<Q2d, PositionCommand<2>, HandClock>;
using Velocities = TopicHardware<Q2d, VelocityCommand<2>, HandClock>;
static_assert(Hardware<Efforts>);
static_assert(Hardware<Positions, PositionCommand<2>>);
static_assert(Hardware<Velocities, VelocityCommand<2>>);
static_assert(!Hardware<Positions, EffortCommand<2>>);

const std::string shoulder = "shoulder_active_joint", elbow = "elbow_active_joint",
                  states_topic = "/robot_joint_states", commands_topic = "/robot_joint_commands";
const double no_number = std::numeric_limits<double>::quiet_NaN(),
             infinity = std::numeric_limits<double>::infinity();
const TopicHardwareOptions at_once{.set_up_time = 0};

States states_of(const JointState<2>& state) {
  States message;
  message.name = {shoulder, elbow};
  message.position = {state.position[0], state.position[1]};
  message.velocity = {state.velocity[0], state.velocity[1]};
  message.effort = {state.effort[0], state.effort[1]};
  return message;
}

// A hardware, and what its topics carry.
template <class H>
struct Bench {
  explicit Bench(const TopicHardwareOptions& options = at_once)
      : hardware(Q2d(), transport, options) {}
  void publish(const States& message) {
    transport.publish(states_topic, support::bytes_of(message));
  }
  void publish(double shoulder_position, double elbow_position) {
    publish(states_of({.position = {shoulder_position, elbow_position}}));
  }
  void activate() {
    publish(0.1, 0.2);
    hardware.exchange();
    REQUIRE(hardware.activate() == Status::ok);
  }
  Status read() { return hardware.read(state); }
  States sent() {
    const auto message = transport.last<States>(commands_topic);
    REQUIRE(message);
    return *message;
  }
  std::size_t count() { return transport.topics[commands_topic].count; }

  MemoryTransport transport{};
  H hardware;
  JointState<2> state{};
};

}  // namespace

TEST_CASE("a loop over topics controls a simulated arm as the loop around the simulator does") {
  MemoryTransport transport;
  Q2dSim arm;
  JointState<2> state;
  const auto measure = [&] {
    REQUIRE(arm.read(state) == Status::ok);
    transport.publish(states_topic, support::bytes_of(states_of(state)));
  };
  Efforts topics(Q2d(), transport, at_once);
  measure();
  topics.exchange();
  Loop<Efforts, PidPlusGravity> loop(std::move(topics));
  Loop<Q2dSim, PidPlusGravity> direct;
  bool same = true;
  for (int k = 0; k < 3000; ++k) {
    HandClock::time += milliseconds(1);
    measure();
    loop.reference().position = direct.reference().position = {0.5, -0.4};
    same = same && loop.update() == Status::ok && direct.update() == Status::ok;
    loop.hardware().exchange();
    const auto command = transport.last<States>(commands_topic);
    REQUIRE(command);
    REQUIRE(command->effort.size() == 2);
    REQUIRE(arm.write({{command->effort[0], command->effort[1]}}) == Status::ok);
    same = same && loop.state().position == direct.state().position;
  }
  CHECK(same);  // to the last bit
  CHECK((loop.state().position - JointVector<2>{0.5, -0.4}).norm() < 1e-3);
}

TEST_CASE("a command fills the field of its kind for all joints") {
  Bench<Efforts> efforts;
  efforts.activate();
  CHECK(efforts.hardware.write({JointVector<2>{1, -2}}) == Status::ok);
  CHECK(efforts.count() == 0);
  efforts.hardware.exchange();
  const States effort = efforts.sent();
  CHECK(effort.name == std::vector<std::string>{shoulder, elbow});
  CHECK(effort.effort == std::vector<double>{1, -2});
  CHECK(effort.position.empty());
  CHECK(effort.velocity.empty());
  CHECK(effort.header.stamp.sec > 0);
  efforts.hardware.exchange();
  CHECK(efforts.count() == 1);
  CHECK(efforts.transport.topics[commands_topic].endpoint.node == "/topic_based_ros2_control_q2d");

  Bench<Positions> positions;
  positions.activate();
  CHECK(positions.hardware.write({JointVector<2>{1, -2}}) == Status::ok);
  positions.hardware.exchange();
  CHECK(positions.sent().position == std::vector<double>{1, -2});
  CHECK(positions.sent().effort.empty());

  Bench<Velocities> velocities;
  velocities.activate();
  CHECK(velocities.hardware.write({JointVector<2>{1, -2}}) == Status::ok);
  velocities.hardware.exchange();
  CHECK(velocities.sent().velocity == std::vector<double>{1, -2});
}

TEST_CASE("states come by name, from one message or several") {
  Bench<Efforts> arm;
  CHECK(arm.read() == Status::inactive);
  States message;
  message.name = {"gripper", elbow};
  message.position = {7, 0.2};
  message.velocity = {7, 2};
  message.effort = {7, no_number};
  arm.publish(message);
  arm.hardware.exchange();
  CHECK(arm.hardware.activate() == Status::hardware_fault);
  CHECK(arm.hardware.problem() ==
        "joint 'shoulder_active_joint': no recent state on /robot_joint_states");
  message = {};
  message.name = {shoulder};
  message.position = {0.1};
  arm.publish(message);
  CHECK(arm.hardware.activate() == Status::ok);
  CHECK(arm.hardware.problem().empty());
  CHECK(arm.read() == Status::ok);
  CHECK(arm.state.position == JointVector<2>{0.1, 0.2});
  CHECK(arm.state.velocity == JointVector<2>{0, 2});
  CHECK(arm.state.effort == JointVector<2>{0, 0});
  message.name = {"gripper"};
  arm.publish(message);
  CHECK(arm.hardware.statistics().accepted == 2);
  CHECK(arm.hardware.statistics().foreign == 1);
}

TEST_CASE("a velocity that does not come is the difference of two positions") {
  Bench<Efforts> arm;
  arm.activate();
  States message = states_of({});
  message.velocity = {no_number, 3};
  message.position = {0.1, 0.2};
  message.header.stamp = {10, 0};
  arm.publish(message);
  message.position = {0.15, 0.2};
  message.header.stamp = {10, 10'000'000};
  arm.publish(message);
  CHECK(arm.read() == Status::ok);
  CHECK(std::abs(arm.state.velocity[0] - 5) < 1e-9);
  CHECK(arm.state.velocity[1] == 3);
  message.velocity.clear();  // the same stamp again: no time has passed
  arm.publish(message);
  CHECK(arm.read() == Status::ok);
  CHECK(std::abs(arm.state.velocity[0] - 5) < 1e-9);
}

TEST_CASE("messages of which a part is wrong are refused as a whole") {
  Bench<Efforts> arm;
  arm.activate();
  const States good = states_of({.position = {0.7, 0.7}});
  std::vector<States> bad(8, good);
  bad[0].position.pop_back();
  bad[1].velocity.pop_back();
  bad[2].effort.push_back(1);
  bad[3].name.pop_back();
  bad[4].position[1] = no_number;
  bad[5].velocity[1] = infinity;
  bad[6].effort[1] = -infinity;
  bad[7].name[1] = shoulder;
  for (const States& message : bad) arm.publish(message);
  const std::vector<std::byte> noise(40, std::byte{0x5a});
  arm.transport.publish(states_topic, noise);
  arm.hardware.exchange();
  CHECK(arm.read() == Status::ok);
  CHECK(arm.state.position == JointVector<2>{0.1, 0.2});
  CHECK(arm.hardware.statistics().malformed == 9);
  arm.publish(good);
  CHECK(arm.read() == Status::ok);
  CHECK(arm.state.position == JointVector<2>{0.7, 0.7});
}

TEST_CASE("states that stay away are stale, then a fault until the next activation") {
  Bench<Velocities> arm;
  arm.activate();
  HandClock::time += milliseconds(49);
  CHECK(arm.read() == Status::ok);
  HandClock::time += milliseconds(1);
  CHECK(arm.read() == Status::stale_state);
  CHECK(arm.hardware.write({JointVector<2>{1, 1}}) == Status::ok);
  arm.publish(0.3, 0.3);
  CHECK(arm.read() == Status::ok);
  States one_joint = states_of({});
  one_joint.name.resize(1);
  one_joint.position.resize(1);
  one_joint.velocity.clear();
  one_joint.effort.clear();
  for (int k = 0; k < 5; ++k) {  // the elbow is silent
    HandClock::time += milliseconds(100);
    arm.publish(one_joint);
  }
  CHECK(arm.read() == Status::hardware_fault);
  CHECK(arm.hardware.problem() ==
        "joint 'elbow_active_joint': no recent state on /robot_joint_states");
  CHECK(arm.hardware.write({JointVector<2>{1, 1}}) == Status::hardware_fault);
  arm.hardware.exchange();
  CHECK(arm.sent().velocity == std::vector<double>{0, 0});
  arm.publish(0.3, 0.3);
  CHECK(arm.read() == Status::hardware_fault);
  CHECK(arm.hardware.activate() == Status::ok);
  CHECK(arm.read() == Status::ok);
}

TEST_CASE("what is no command, the end, and a loop that stands still stop the joints") {
  Bench<Positions> arm;
  CHECK(arm.hardware.write({JointVector<2>{1, 1}}) == Status::inactive);
  arm.hardware.exchange();
  CHECK(arm.count() == 0);
  arm.activate();
  CHECK(arm.hardware.write({JointVector<2>{no_number, 1}}) == Status::non_finite_command);
  arm.hardware.exchange();
  CHECK(arm.sent().position == std::vector<double>{0.1, 0.2});

  CHECK(arm.hardware.write({JointVector<2>{1, 1}}) == Status::ok);
  arm.hardware.exchange();
  arm.publish(0.5, 0.6);
  HandClock::time += milliseconds(99);
  arm.hardware.exchange();
  CHECK(arm.sent().position == std::vector<double>{1, 1});
  HandClock::time += milliseconds(1);
  arm.hardware.exchange();
  CHECK(arm.sent().position == std::vector<double>{0.5, 0.6});
  CHECK(arm.hardware.statistics().missed_deadlines == 1);
  HandClock::time += milliseconds(1000);
  arm.hardware.exchange();
  CHECK(arm.count() == 3);

  arm.publish(0.5, 0.6);
  CHECK(arm.hardware.write({JointVector<2>{1, 1}}) == Status::ok);
  arm.hardware.exchange();
  CHECK(arm.hardware.deactivate() == Status::ok);
  arm.hardware.exchange();
  CHECK(arm.sent().position == std::vector<double>{0.5, 0.6});
  CHECK(arm.hardware.statistics().sent == 5);
}

TEST_CASE("activation waits for somebody who reads the commands") {
  Bench<Efforts> arm;
  arm.transport.topics[commands_topic].clients = 0;
  arm.publish(0, 0);
  arm.hardware.exchange();
  CHECK(arm.hardware.activate() == Status::hardware_fault);
  CHECK(arm.hardware.problem() == "nobody reads /robot_joint_commands");
}

TEST_CASE("wrapped positions are summed to whole turns") {
  using std::numbers::pi;
  Bench<Efforts> arm({.sum_wrapped_joint_states = true, .set_up_time = 0});
  arm.publish(1.9 * pi, 0);
  arm.publish(-1.9 * pi, -1.5 * pi);
  arm.publish(-1.8 * pi, 1.5 * pi);
  arm.hardware.exchange();
  CHECK(arm.hardware.activate() == Status::ok);
  CHECK(arm.read() == Status::ok);
  CHECK(std::abs(arm.state.position[0] - 2.2 * pi) < 1e-9);
  CHECK(std::abs(arm.state.position[1] + 2.5 * pi) < 1e-9);
}

TEST_CASE("options that make no sense are refused by name") {
  MemoryTransport transport;
  const auto refused = [&](const TopicHardwareOptions& options) {
    try {
      const Efforts arm(Q2d(), transport, options);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refused({.stale_after = 0}) ==
        "topic hardware: stale_after 0 s is not within 0 .. 1000000 s");
  CHECK(refused({.silent_after = 0.01}) ==
        "topic hardware: silent_after 0.01 s is less than stale_after 0.05 s");
  CHECK(refused({.set_up_time = no_number}).find("set_up_time") != std::string::npos);
  CHECK(refused({.joint_states_topic = "states"}) ==
        "topic hardware: joint_states_topic 'states' is no full name, as /arm/joint_states");
  CHECK_THROWS_AS(Efforts(std::unique_ptr<ros2::Transport>()), std::invalid_argument);
}

namespace {

// A transport at whose other end positions are the velocities that were sent.
class ObedientJoints final : public MemoryTransport {
 public:
  explicit ObedientJoints(std::vector<double>& last) : last_(last) {}
  void poll(std::chrono::microseconds longest) override {
    std::this_thread::sleep_for(longest);
    note_command();
    States message;
    message.name = {shoulder, elbow};
    message.position = last_;
    publish(states_topic, support::bytes_of(message));
    if (++polls_ == limit) throw std::runtime_error("the network is gone");
  }
  ~ObedientJoints() override { note_command(); }

  int limit = -1;  ///< polls after which it fails

 private:
  void note_command() {
    if (const auto command = last<States>(commands_topic)) last_ = command->velocity;
  }

  std::vector<double>& last_;
  int polls_ = 0;
};

using ThreadedArm = TopicHardware<Q2d, VelocityCommand<2>>;
// A busy machine may let the thread wait for long.
const TopicHardwareOptions patient{.stale_after = 5, .silent_after = 10, .command_deadline = 10};

}  // namespace

TEST_CASE("a thread of its own polls the transport until the end, and sends the stop") {
  std::vector<double> last{0.1, 0.2};
  {
    ThreadedArm arm(std::make_unique<ObedientJoints>(last), patient);
    REQUIRE(arm.activate() == Status::ok);
    JointState<2> state;
    for (int k = 0; k < 5000 && state.position != JointVector<2>{1, -1}; ++k) {
      REQUIRE(arm.write({JointVector<2>{1, -1}}) == Status::ok);
      REQUIRE(arm.read(state) == Status::ok);
      std::this_thread::sleep_for(milliseconds(1));
    }
    CHECK(state.position == JointVector<2>{1, -1});
    CHECK(arm.problem().empty());
  }
  CHECK(last == std::vector<double>{0, 0});
}

TEST_CASE("a transport that fails is the problem of the hardware") {
  std::vector<double> last{0.1, 0.2};
  auto transport = std::make_unique<ObedientJoints>(last);
  transport->limit = 1;
  ThreadedArm arm(std::move(transport), {.set_up_time = 0.05});
  CHECK(arm.activate() == Status::hardware_fault);  // the commands have no reader
  const std::string expected = "the network is gone";
  // A busy machine may let the thread wait for long.
  for (int k = 0; k < 60'000 && arm.problem() != expected; ++k) {
    std::this_thread::sleep_for(milliseconds(1));
  }
  CHECK(arm.problem() == expected);
}
