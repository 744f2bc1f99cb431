// SPDX-License-Identifier: Apache-2.0
// A loop keeps the pace of a simulator that lives behind topics.
#include "articula/ros2/hardware/topic_clock.hpp"

#include <articula/control/pid_plus_gravity.hpp>
#include <articula/loop/loop.hpp>
#include <articula/loop/loop_clock.hpp>
#include <articula/loop/run.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/ros2/hardware/topic_hardware.hpp>

#include "catch.hpp"
#include "hand_clock.hpp"
#include "remote/memory_transport.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

using namespace articula;
using ros2::TopicClock;
using ros2::TopicHardware;
using support::HandClock;
using support::MemoryTransport;
using States = ros2::sensor_msgs::msg::JointState<ros2::Jazzy>;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

static_assert(LoopClock<TopicClock>);

namespace {

using Arm = TopicHardware<Q2d>;
using HandArm = TopicHardware<Q2d, EffortCommand<2>, HandClock>;
const ros2::TopicHardwareOptions simulated{.set_up_time = 0, .clock_topic = "/clock"};

void publish_states(MemoryTransport& transport, double elbow = 0.2) {
  States message;
  message.name = {"shoulder_active_joint", "elbow_active_joint"};
  message.position = {0.1, elbow};
  transport.publish("/robot_joint_states", support::bytes_of(message));
}
void publish_time(MemoryTransport& transport, nanoseconds time) {
  const ros2::rosgraph_msgs::msg::Clock message{
      ros2::to_message<ros2::builtin_interfaces::msg::Time>(time)};
  transport.publish("/clock", support::bytes_of(message));
}

// A clock that tells how often somebody has waited for it.
struct CountingClock {
  [[nodiscard]] nanoseconds now() const noexcept { return clock.now(); }
  nanoseconds wait_until(nanoseconds due) noexcept {
    ++waits;
    return clock.wait_until(due);
  }
  TopicClock clock;
  std::atomic<int> waits = 0;
};

// A simulator that runs a millisecond in each poll until it fails.
class FailingSimulator final : public MemoryTransport {
 public:
  void poll(std::chrono::microseconds longest) override {
    std::this_thread::sleep_for(longest);
    publish_time(*this, milliseconds(++polls_));
    publish_states(*this);
    if (polls_ == 300) throw std::runtime_error("the network is gone");
  }

 private:
  int polls_ = 0;
};

}  // namespace

TEST_CASE("nothing is older than by the simulator's clock") {
  MemoryTransport transport;
  HandArm arm(Q2d(), transport, simulated);
  JointState<2> state;
  const auto sent = [&] {
    const auto message = transport.last<States>("/robot_joint_commands");
    REQUIRE(message);
    return *message;
  };
  publish_states(transport);
  arm.exchange();
  CHECK(arm.activate() == Status::hardware_fault);
  CHECK(arm.problem() == "no time on /clock");

  int now = 100'000;
  const auto pass = [&](int simulated_time, int host_time) {
    HandClock::time += milliseconds(host_time);
    publish_time(transport, milliseconds(now += simulated_time));
    arm.exchange();
  };
  pass(0, 1000);
  CHECK(arm.activate() == Status::hardware_fault);  // the states are older than the first time
  publish_states(transport);
  REQUIRE(arm.activate() == Status::ok);
  CHECK(arm.write({JointVector<2>{1, 2}}) == Status::ok);
  arm.exchange();
  CHECK(sent().effort == std::vector<double>{1, 2});
  CHECK(sent().header.stamp.sec == 100);
  SECTION("a pause of the simulator") {
    pass(0, 10'000);
    CHECK(arm.read(state) == Status::ok);
  }
  SECTION("a long step of the clock, in which nothing else could come") {
    pass(700, 1);
    CHECK(arm.read(state) == Status::ok);
  }
  SECTION("a slow simulator") {
    pass(49, 490);
    CHECK(arm.read(state) == Status::ok);
    pass(1, 10);
    CHECK(arm.read(state) == Status::stale_state);
  }
  SECTION("a fast one") {
    pass(490, 49);
    CHECK(arm.read(state) == Status::ok);
    pass(10, 1);
    CHECK(arm.read(state) == Status::stale_state);
  }
  if (arm.read(state) == Status::ok) {
    CHECK(sent().effort == std::vector<double>{1, 2});
    CHECK(arm.statistics().missed_deadlines == 0);
  }
  pass(100, 100);
  CHECK(arm.read(state) == Status::stale_state);
  CHECK(sent().effort == std::vector<double>{0, 0});
  CHECK(arm.statistics().missed_deadlines == 1);
  publish_states(transport);
  CHECK(arm.read(state) == Status::ok);
  pass(500, 500);
  CHECK(arm.read(state) == Status::hardware_fault);
}

TEST_CASE("no time passes when the simulator's clock is set") {
  MemoryTransport transport;
  HandArm arm(Q2d(), transport, simulated);
  const TopicClock clock = arm.clock();
  for (const int time : {5'000, 5'001, 0, 7, 10'007, 20'008, 20'009}) {
    publish_time(transport, milliseconds(time));
  }
  arm.exchange();
  // 1, then 7 from the reset on, 10 000 at once, and 1 after a jump of 10 001.
  CHECK(clock.now() == milliseconds(1 + 7 + 10'000 + 1));
  CHECK(arm.statistics().clock_jumps == 2);

  // Numbers that are no times.
  nanoseconds last = clock.now();
  for (int k = 0; k < 20; ++k) {
    for (const std::int32_t second : {INT32_MAX, INT32_MIN, 0, -1}) {
      const ros2::rosgraph_msgs::msg::Clock message{{second, UINT32_MAX}};
      transport.publish("/clock", support::bytes_of(message));
      arm.exchange();
      CHECK(clock.now() >= last);
      last = clock.now();
    }
  }
  // A simulator and a bag in turn.
  for (int k = 0; k < 10; ++k) {
    publish_time(transport, milliseconds(100'000 + k));
    publish_time(transport, milliseconds(5'000 + k));
    arm.exchange();
  }
  CHECK(clock.now() == last);
  publish_time(transport, milliseconds(5'010));
  arm.exchange();
  CHECK(clock.now() == last + milliseconds(1));
}

TEST_CASE("a loop makes a cycle for each period of the simulator, and stands still with it") {
  MemoryTransport transport;
  Arm arm(Q2d(), transport, simulated);
  publish_time(transport, milliseconds(5000));
  publish_states(transport);
  arm.exchange();
  Loop<Arm, PidPlusGravity> loop(std::move(arm));
  loop.reference().position = {0.1, 0.2};
  StopFlag stop;
  CountingClock clock{loop.hardware().clock(&stop)};
  std::atomic<int> cycles = 0;
  const auto reaches = [&](int count) {
    for (int k = 0; k < 20'000 && clock.waits <= count; ++k) {
      std::this_thread::sleep_for(milliseconds(1));
    }
    return cycles == count && clock.waits == count + 1;
  };
  RunReport report;
  std::thread thread([&] {
    report = run(loop, clock, {.stop = &stop}, [&](auto&, const RunReport& now) {
      cycles = static_cast<int>(now.cycles);
      return now.status == Status::ok;
    });
  });
  REQUIRE(reaches(0));
  const auto tell = [&](int time) {
    publish_time(transport, milliseconds(5000 + time));
    publish_states(transport, 1e-3 * time);
    loop.hardware().exchange();
  };
  for (int k = 1; k <= 100; ++k) {
    tell(k);
    REQUIRE(reaches(k));
    REQUIRE(loop.state().position[1] == 1e-3 * k);  // of the same moment
  }
  std::this_thread::sleep_for(milliseconds(100));  // longer than the deadline of a command
  CHECK(cycles == 100);
  tell(100);
  CHECK(loop.hardware().statistics().missed_deadlines == 0);

  tell(110);  // a message for ten periods
  REQUIRE(reaches(102));
  tell(111);
  REQUIRE(reaches(103));
  stop.request();  // in the midst of a pause
  thread.join();
  CHECK(report.end == RunEnd::stopped);
  CHECK(report.status == Status::ok);
  CHECK(report.missed == 8);
}

TEST_CASE("a loop whose transport fails goes on at the host's pace, in a fault") {
  Loop<Arm, PidPlusGravity> loop(
      Arm(std::make_unique<FailingSimulator>(), {.clock_topic = "/clock"}));
  loop.reference().position = {0.1, 0.2};
  TopicClock clock = loop.hardware().clock();
  Status status = Status::ok;
  const RunReport report = run(loop, clock, {}, [&, faults = 0](auto&, const auto& now) mutable {
    status = now.status;
    return status != Status::hardware_fault || ++faults < 10;
  });
  CHECK(report.end == RunEnd::declined);
  CHECK(status == Status::hardware_fault);
  CHECK(loop.hardware().problem() == "the network is gone");
}

TEST_CASE("without a topic there is no clock, and its name is a full one") {
  MemoryTransport transport;
  CHECK_THROWS_WITH(Arm(Q2d(), transport).clock(),
                    "topic hardware: there is no clock_topic, as /clock");
  CHECK_THROWS_WITH(Arm(Q2d(), transport, {.clock_topic = "clock"}),
                    "topic hardware: clock_topic 'clock' is no full name, as /arm/joint_states");
}
