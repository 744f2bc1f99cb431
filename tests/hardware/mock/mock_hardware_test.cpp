// SPDX-License-Identifier: Apache-2.0
#include <articula/control/pid.hpp>
#include <articula/hardware/mock/mock_hardware.hpp>
#include <articula/loop/loop.hpp>
#include <articula/robots/q2d.hpp>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "catch.hpp"
#include "test_controllers.hpp"

using namespace articula;
using Kind = MockFaultKind;

static_assert(Hardware<MockHardware<Q2d>>);
static_assert(Hardware<MockHardware<Q2d, PositionCommand<2>>, PositionCommand<2>>);
static_assert(Hardware<MockHardware<Q2d, VelocityCommand<2>>, VelocityCommand<2>>);
static_assert(Hardware<MockHardware<Q2d, MultiModeCommand<2>>, MultiModeCommand<2>>);
static_assert(!Hardware<MockHardware<Q2d>, PositionCommand<2>>);

TEST_CASE("joints do at once what they are told") {
  JointState<2> state;
  SECTION("positions") {
    MockHardware<Q2d, PositionCommand<2>> hardware({}, 0.5);
    REQUIRE(hardware.activate() == Status::ok);
    CHECK(hardware.write({JointVector<2>{1, -2}}) == Status::ok);
    CHECK(hardware.read(state) == Status::ok);
    CHECK(state.position == JointVector<2>{1, -2});
    CHECK(state.velocity == JointVector<2>{2, -4});
  }
  SECTION("velocities") {
    MockHardware<Q2d, VelocityCommand<2>> hardware({}, 0.5);
    REQUIRE(hardware.activate() == Status::ok);
    for (int k = 0; k < 2; ++k) CHECK(hardware.write({JointVector<2>{1, -2}}) == Status::ok);
    CHECK(hardware.read(state) == Status::ok);
    CHECK(state.position == JointVector<2>{1, -2});
    CHECK(state.velocity == JointVector<2>{1, -2});
  }
  SECTION("efforts") {
    MockHardware<Q2d> hardware;
    REQUIRE(hardware.activate() == Status::ok);
    CHECK(hardware.write({JointVector<2>{1, -2}}) == Status::ok);
    CHECK(hardware.read(state) == Status::ok);
    CHECK(state.effort == JointVector<2>{1, -2});
    CHECK(state.position.isZero(0));
  }
  SECTION("springs, dampers and efforts") {
    MockHardware<Q2d, MultiModeCommand<2>> hardware({}, 0.5);
    REQUIRE(hardware.activate() == Status::ok);
    MultiModeCommand<2> command{.position = {1, 7}, .velocity = {3, -2}};
    command.stiffness = {10, 0};
    command.damping = {1, 1};
    command.effort = {0.5, -0.5};
    for (int k = 0; k < 2; ++k) CHECK(hardware.write(command) == Status::ok);
    CHECK(hardware.read(state) == Status::ok);
    CHECK(state.position == JointVector<2>{1, -2});
    CHECK(state.velocity == JointVector<2>{0, -2});
    CHECK(state.effort == JointVector<2>{0.5, -0.5});
    command.damping.setZero();
    command.stiffness.setZero();
    CHECK(hardware.write(command) == Status::ok);
    CHECK(hardware.read(state) == Status::ok);
    CHECK(state.position == JointVector<2>{1, -2});
    CHECK(state.velocity.isZero(0));
    command.stiffness[1] = std::nan("");
    CHECK(hardware.write(command) == Status::non_finite_command);
  }
}

TEST_CASE("inactive hardware follows no command, active hardware none that is not finite") {
  MockHardware<Q2d> hardware;
  CHECK(hardware.write({JointVector<2>{1, 1}}) == Status::inactive);
  REQUIRE(hardware.activate() == Status::ok);
  CHECK(hardware.write({JointVector<2>{1, std::nan("")}}) == Status::non_finite_command);
  CHECK(hardware.written().effort.isZero(0));
  CHECK(hardware.deactivate() == Status::ok);
  CHECK(hardware.write({JointVector<2>{1, 1}}) == Status::inactive);
  CHECK(hardware.writes() == 3);
}

TEST_CASE("faults come at their readings, to their joints, and go") {
  MockHardware<Q2d> hardware({{Kind::measures_position, 1, 2, 0, 7.0},
                              {Kind::measures_velocity, 2, 1, 1, 8.0},
                              {Kind::measures_nan, 4, 1, 1},
                              {Kind::fails_to_read, 5, 1},
                              {Kind::fails_to_write, 6, 1},
                              {Kind::goes_silent, 7, 1, 1}});
  JointState<2> moved;
  moved.position = {0.1, 0.2};
  hardware.set_state(moved);
  REQUIRE(hardware.activate() == Status::ok);
  JointState<2> state;
  const EffortCommand<2> command{JointVector<2>{1, 1}};

  CHECK(hardware.read(state) == Status::ok);  // 0
  CHECK(state.position == moved.position);
  CHECK(hardware.read(state) == Status::ok);  // 1
  CHECK(state.position == JointVector<2>{7, 0.2});
  CHECK(hardware.read(state) == Status::ok);  // 2
  CHECK(state.position == JointVector<2>{7, 0.2});
  CHECK(state.velocity == JointVector<2>{0, 8});
  CHECK(hardware.read(state) == Status::ok);  // 3
  CHECK(state.position == moved.position);
  CHECK(hardware.read(state) == Status::ok);  // 4
  CHECK(state.position[0] == 0.1);
  CHECK(std::isnan(state.position[1]));
  CHECK(hardware.read(state) == Status::hardware_fault);  // 5
  CHECK(hardware.write(command) == Status::ok);
  CHECK(hardware.read(state) == Status::ok);  // 6
  CHECK(hardware.write(command) == Status::hardware_fault);
  moved.position = {0.3, 0.4};
  hardware.set_state(moved);
  CHECK(hardware.read(state) == Status::stale_state);  // 7
  CHECK(state.position == JointVector<2>{0.3, 0.2});
  CHECK(hardware.read(state) == Status::ok);  // 8
  CHECK(state.position == moved.position);
  CHECK(hardware.readings() == 9);
}

TEST_CASE("the script may refuse activation") {
  MockHardware<Q2d> hardware({{Kind::refuses_activation, 0, 2}});
  JointState<2> state;
  CHECK(hardware.activate() == Status::hardware_fault);
  CHECK_FALSE(hardware.active());
  for (int k = 0; k < 3; ++k) CHECK(hardware.read(state) == Status::inactive);
  CHECK(hardware.activate() == Status::ok);
  CHECK_THROWS_AS((Loop<MockHardware<Q2d>, Pid>(MockHardware<Q2d>({{Kind::refuses_activation}}))),
                  std::runtime_error);
}

TEST_CASE("a loop drives mock hardware as any other") {
  Loop<MockHardware<Q2d, PositionCommand<2>>, support::PositionForward> loop;
  loop.reference().position = {0.5, -0.5};
  CHECK(loop.update() == Status::ok);
  CHECK(loop.update() == Status::ok);
  CHECK(loop.state().position == JointVector<2>{0.5, -0.5});
}

TEST_CASE("scripts and periods that make no sense are refused by name") {
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(MockHardware<Q2d>({{Kind::goes_silent, 0, 1, 2}}),
                    Contains("fault 0: joint 2 is not between -1 and 1"));
  CHECK_THROWS_WITH(MockHardware<Q2d>({{}, {Kind::goes_silent, 0, 1, -2}}),
                    Contains("fault 1: joint -2"));
  CHECK_THROWS_WITH(MockHardware<Q2d>({}, 0), Contains("period 0 s"));
}
