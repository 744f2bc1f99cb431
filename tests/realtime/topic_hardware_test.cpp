// SPDX-License-Identifier: Apache-2.0
// The loop's side of hardware over topics does not touch the heap.
#include <articula/robots/q2d.hpp>
#include <articula/ros2/hardware/topic_hardware.hpp>

#include "allocation_guard.hpp"
#include "catch.hpp"
#include "remote/memory_transport.hpp"

#include <string>

using namespace articula;
using articula::testing::heap_calls_in;

TEST_CASE("reading, writing and stopping over topics stay off the heap") {
  support::MemoryTransport transport;
  // The machine may be busy: figures stay good for long.
  const std::string clock = GENERATE(as<std::string>(), "", "/clock");
  ros2::TopicHardware<Q2d> arm(Q2d(), transport,
                               {.stale_after = 60, .silent_after = 60, .clock_topic = clock});
  if (!clock.empty()) {
    transport.publish(clock, support::bytes_of(ros2::rosgraph_msgs::msg::Clock{{1, 0}}));
  }
  ros2::sensor_msgs::msg::JointState<ros2::Jazzy> message;
  message.name = {"shoulder_active_joint", "elbow_active_joint"};
  message.position = {0.1, 0.2};
  transport.publish("/robot_joint_states", support::bytes_of(message));
  arm.exchange();
  REQUIRE(arm.activate() == Status::ok);
  JointState<2> state;
  Status read = Status::inactive, written = read, stopped = read;
  CHECK(heap_calls_in([&] {
          read = arm.read(state);
          written = arm.write({JointVector<2>{1, 2}});
          stopped = arm.deactivate();
        }) == 0);
  CHECK(read == Status::ok);
  CHECK(written == Status::ok);
  CHECK(stopped == Status::ok);
  CHECK(state.position == JointVector<2>{0.1, 0.2});
}
