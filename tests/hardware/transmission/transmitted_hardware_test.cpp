// SPDX-License-Identifier: Apache-2.0
#include <articula/control/bypass.hpp>
#include <articula/control/forward_position.hpp>
#include <articula/hardware/mock/mock_hardware.hpp>
#include <articula/hardware/transmission/differential_transmission.hpp>
#include <articula/hardware/transmission/four_bar_transmission.hpp>
#include <articula/hardware/transmission/reversed_transmission.hpp>
#include <articula/hardware/transmission/simple_transmission.hpp>
#include <articula/hardware/transmission/transmitted_hardware.hpp>
#include <articula/loop/loop.hpp>
#include <articula/robots/q2d.hpp>

#include <cmath>
#include <functional>

#include "catch.hpp"
#include "hardware/fake_hardware.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::infinity;
using support::not_a_number;
using Vector = JointVector<2>;

namespace {

constexpr const char *shoulder = "shoulder_active_joint", *elbow = "elbow_active_joint";

using Simple = Gearing<SimpleTransmission>;
const Simple shoulder_gear{.joints = {shoulder},
                           .actuators = {shoulder},
                           .transmission = {.reduction = -100, .joint_offset = 0.5}};
const Simple elbow_gear{.joints = {elbow}, .actuators = {elbow}, .transmission = {.reduction = 50}};

template <class Command>
using Fake = support::FakeHardware<Q2d, Command>;
template <class Actuators>
using Geared = TransmittedHardware<Actuators, Q2d, SimpleTransmission, SimpleTransmission>;
template <class Actuators>
using Differential = TransmittedHardware<Actuators, Q2d, DifferentialTransmission>;

// It is hardware for what its actuators take; springs need an actuator of their own.
static_assert(Hardware<Geared<Q2dSim>> && Hardware<Geared<Q2dSim>, PositionCommand<2>>);
static_assert(Hardware<Geared<Q2dSim>, VelocityCommand<2>>);
static_assert(Hardware<Geared<Q2dSim>, MultiModeCommand<2>>);
static_assert(!Hardware<Differential<Q2dSim>, MultiModeCommand<2>>);
static_assert(Hardware<Differential<Q2dSim>, PositionCommand<2>>);
static_assert(!Hardware<Geared<Fake<EffortCommand<2>>>, PositionCommand<2>>);

/// Drives with a cycle of their own, which cannot be copied.
struct PacingDrives : Fake<EffortCommand<2>> {
  PacingDrives() = default;
  PacingDrives(PacingDrives&&) = default;
  std::chrono::nanoseconds asked{};
  [[nodiscard]] double period() const noexcept { return 0.004; }
  [[nodiscard]] Status wait_for_cycle(std::chrono::nanoseconds timeout) noexcept {
    asked = timeout;
    return Status::stale_state;
  }
};
static_assert(PacingHardware<Geared<PacingDrives>> && !PacingHardware<Geared<Q2dSim>>);

std::string refusal(const std::function<void()>& make) {
  try {
    make();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::string refusal(const Simple& first, const Simple& second) {
  return refusal([&] { Geared<Q2dSim>(Q2dSim(), first, second); });
}

}  // namespace

TEST_CASE("joints are where their actuators put them, in the robot's order") {
  Fake<EffortCommand<2>> drives;
  drives.measured = {{100, 25}, {-200, 10}, {0.25, 2}};
  Geared<Fake<EffortCommand<2>>> arm(drives, elbow_gear, shoulder_gear);  // in any order
  JointState<2> state;
  REQUIRE(arm.read(state) == Status::ok);
  CHECK(state.position == Vector(-0.5, 0.5));
  CHECK(state.velocity == Vector(2, 0.2));
  CHECK(state.effort == Vector(-25, 100));
  CHECK(arm.actuator_state().position == Vector(100, 25));
  REQUIRE(arm.write(EffortCommand<2>{Vector(-25, 100)}) == Status::ok);
  CHECK(arm.hardware().written.effort == Vector(0.25, 2));
}

TEST_CASE("actuators may be wired in another order") {
  Fake<EffortCommand<2>> drives;
  drives.measured.position = {100, 25};
  Simple first = shoulder_gear, second = elbow_gear;
  std::swap(first.actuators, second.actuators);
  Geared<Fake<EffortCommand<2>>> arm(drives, first, second);
  JointState<2> state;
  REQUIRE(arm.read(state) == Status::ok);
  CHECK(state.position == Vector(0.25, 2));
  REQUIRE(arm.write(EffortCommand<2>{Vector(100, 50)}) == Status::ok);
  CHECK(arm.hardware().written.effort == Vector(1, -1));
}

TEST_CASE("positions, velocities, springs and dampers go to the actuators") {
  Geared<Fake<PositionCommand<2>>> by_position({}, shoulder_gear, elbow_gear);
  REQUIRE(by_position.write(PositionCommand<2>{Vector(1, 2)}) == Status::ok);
  CHECK(by_position.hardware().written.position == Vector(-50, 100));
  Geared<Fake<VelocityCommand<2>>> by_velocity({}, shoulder_gear, elbow_gear);
  REQUIRE(by_velocity.write(VelocityCommand<2>{Vector(1, 2)}) == Status::ok);
  CHECK(by_velocity.hardware().written.velocity == Vector(-100, 100));

  Geared<Fake<MultiModeCommand<2>>> springs({}, shoulder_gear, elbow_gear);
  MultiModeCommand<2> command{{1, 2}, {3, 4}, {500, 600}, {7, 8}, {9, 10}};
  REQUIRE(springs.write(command) == Status::ok);
  // The drives' law at the motors gives the joints' law at the joints.
  const MultiModeCommand<2>& given = springs.hardware().written;
  const Vector q(0.3, -0.4), v(-1, 2);
  const Vector at_joints = command.stiffness.cwiseProduct(command.position - q) +
                           command.damping.cwiseProduct(command.velocity - v) + command.effort;
  Vector at_motors;
  for (int j = 0; j < 2; ++j) {
    using One = JointVector<1>;
    const SimpleTransmission& gear = (j == 0 ? shoulder_gear : elbow_gear).transmission;
    const double q_a = gear.actuator_position(One(q[j]))[0];
    const double v_a = gear.actuator_velocity(One(v[j]))[0];
    const double effort_a = given.stiffness[j] * (given.position[j] - q_a) +
                            given.damping[j] * (given.velocity[j] - v_a) + given.effort[j];
    at_motors[j] = gear.joint_effort(One(effort_a))[0];
  }
  CHECK((at_motors - at_joints).norm() < 1e-10);
  CHECK((given.stiffness.array() > 0).all());
}

TEST_CASE("what goes wrong below is passed on") {
  Geared<Fake<EffortCommand<2>>> arm({}, shoulder_gear, elbow_gear);
  JointState<2> state{Vector(7, 7), Vector(7, 7), Vector(7, 7)};
  arm.hardware().reading = Status::hardware_fault;
  CHECK(arm.read(state) == Status::hardware_fault);
  CHECK(state.position == Vector(7, 7));
  arm.hardware().reading = Status::stale_state;
  CHECK(arm.read(state) == Status::stale_state);
  CHECK(state.position == Vector(0.5, 0));
  arm.hardware().writing = Status::hardware_fault;
  CHECK(arm.write(EffortCommand<2>{}) == Status::hardware_fault);
  arm.hardware().activation = Status::hardware_fault;
  CHECK(arm.activate() == Status::hardware_fault);
  CHECK(arm.deactivate() == Status::ok);
}

TEST_CASE("what is no number arrives as none, and stops the loop's trust") {
  Differential<Fake<EffortCommand<2>>> wrist(
      {}, {.joints = {shoulder, elbow}, .actuators = {shoulder, elbow}});
  wrist.hardware().measured.position = {not_a_number, 1};
  JointState<2> state;
  static_cast<void>(wrist.read(state));
  CHECK(state.position.hasNaN());
  for (const double bad : {not_a_number, infinity, -infinity}) {
    static_cast<void>(wrist.write(EffortCommand<2>{Vector(1, bad)}));
    CHECK_FALSE(is_finite(wrist.hardware().written));
  }
}

TEST_CASE("actuators get no more than they can take") {
  Simple weak = shoulder_gear;
  weak.limits[0] = {.lower = -10, .upper = 20, .velocity = 30, .effort = 0.5};
  for (const double side : {1.0, -1.0}) {
    Geared<Fake<EffortCommand<2>>> efforts({}, weak, elbow_gear);
    static_cast<void>(efforts.write(EffortCommand<2>{Vector(side * 1e6, side * 1e6)}));
    CHECK(efforts.hardware().written.effort == Vector(side * -0.5, side * 2e4));
    Geared<Fake<VelocityCommand<2>>> velocities({}, weak, elbow_gear);
    static_cast<void>(velocities.write(VelocityCommand<2>{Vector(side * 5, side)}));
    CHECK(velocities.hardware().written.velocity == Vector(side * -30, side * 50));
    Geared<Fake<PositionCommand<2>>> positions({}, weak, elbow_gear);
    static_cast<void>(positions.write(PositionCommand<2>{Vector(side * 5, side)}));
    CHECK(positions.hardware().written.position == Vector(side > 0 ? -10 : 20, side * 50));
  }
}

TEST_CASE("springs and dampers keep the actuators' limit of effort at their last state") {
  constexpr unsigned seed = 3;
  CAPTURE(seed);
  support::Random random(seed);
  Simple weak = shoulder_gear;
  weak.limits[0] = {.effort = 0.5};
  using Springs = Fake<MultiModeCommand<2>>;
  for (int k = 0; k < 1000; ++k) {
    CAPTURE(k);
    Springs drives;
    drives.measured.position = random.vector<2>(50);
    drives.measured.velocity = random.vector<2>(50);
    Geared<Springs> arm(drives, weak, elbow_gear);
    JointState<2> state;
    REQUIRE(arm.read(state) == Status::ok);
    MultiModeCommand<2> wild;
    wild.position = random.vector<2>(3);
    wild.velocity = random.vector<2>(3);
    for (int j = 0; j < 2; ++j) {
      wild.stiffness[j] = random.number(0, 1e3);
      wild.damping[j] = random.number(0, 100);
      wild.effort[j] = random.number(-200, 200);
    }
    REQUIRE(arm.write(wild) == Status::ok);
    const MultiModeCommand<2>& given = arm.hardware().written;
    const Vector total = spring_pull(given, arm.actuator_state()) + given.effort;
    CHECK(std::abs(total[0]) <= 0.5 * (1 + 1e-9));
    CHECK(std::abs(given.effort[0]) <= 0.5);
    CHECK((given.stiffness.array() >= 0).all());
    // What is asked for at the joints, as far as the limit lets it.
    const Vector asked = spring_pull(wild, state) + wild.effort;
    CHECK(total[0] == Approx(std::clamp(asked[0] / -100, -0.5, 0.5)).margin(1e-9));
    CHECK(total[1] == Approx(asked[1] / 50).margin(1e-9));  // without limit
  }
  Springs lost;
  lost.measured.position = {not_a_number, 0};
  Geared<Springs> arm(lost, weak, elbow_gear);
  JointState<2> state;
  static_cast<void>(arm.read(state));
  MultiModeCommand<2> command;
  command.stiffness = {1e3, 0};
  command.effort = {1e3, 0};
  static_cast<void>(arm.write(command));
  CHECK(is_finite(arm.hardware().written));
  CHECK(arm.hardware().written.effort[0] == -0.5);
}

TEST_CASE("every joint and actuator is there once, or it is named") {
  CHECK(refusal(shoulder_gear, elbow_gear).empty());
  CHECK_THAT(refusal(shoulder_gear, shoulder_gear), Contains("joint 'shoulder_active_joint'"));
  Simple wrong = elbow_gear;
  wrong.actuators = {shoulder};
  CHECK_THAT(refusal(shoulder_gear, wrong),
             Contains("actuator 'shoulder_active_joint' occurs twice"));
  wrong.actuators = {"motor"};
  CHECK_THAT(refusal(shoulder_gear, wrong),
             Contains("'motor' is to be an actuator, which is a joint of the hardware below"));
  CHECK_THAT(refusal(shoulder_gear, {}), Contains("'' is to be a joint of the transmission"));
  wrong = elbow_gear;
  wrong.transmission.reduction = 0;
  CHECK_THAT(refusal(shoulder_gear, wrong),
             Contains("joint 'elbow_active_joint'") && Contains("reduction 0"));
}

TEST_CASE("limits of actuators that leave nothing to do are refused, and named") {
  for (const JointLimits& limits :
       {JointLimits{.lower = 1, .upper = -1}, JointLimits{.lower = not_a_number},
        JointLimits{.velocity = -1}, JointLimits{.effort = not_a_number},
        JointLimits{.lower = infinity, .upper = infinity},
        JointLimits{.lower = -infinity, .upper = -infinity}}) {
    Simple wrong = elbow_gear;
    wrong.limits[0] = limits;
    CHECK_THAT(refusal(shoulder_gear, wrong), Contains("limits of actuator 'elbow_active_joint'"));
  }
}

TEST_CASE("the actuators' period and cycle are the joints'") {
  Loop<Geared<PacingDrives>, Bypass> loop(
      Geared<PacingDrives>(PacingDrives(), shoulder_gear, elbow_gear));
  CHECK(loop.period() == 0.004);
  CHECK(loop.hardware().wait_for_cycle(std::chrono::microseconds(7)) == Status::stale_state);
  CHECK(loop.hardware().hardware().asked == std::chrono::microseconds(7));
}

TEST_CASE("a simulated robot behind its motors' side and back is the robot") {
  using Motors =
      TransmittedHardware<Q2dSim, Q2d, Reversed<SimpleTransmission>, Reversed<SimpleTransmission>>;
  const Motors motors(
      Q2dSim(),
      {.joints = {shoulder}, .actuators = {shoulder}, .transmission = {shoulder_gear.transmission}},
      {.joints = {elbow}, .actuators = {elbow}, .transmission = {elbow_gear.transmission}});
  Geared<Motors> arm(motors, shoulder_gear, elbow_gear);
  Q2dSim direct;
  JointState<2> geared, plain;
  for (int k = 0; k < 300; ++k) {
    const Vector effort(10 * std::sin(0.01 * k), 5 * std::cos(0.03 * k));
    REQUIRE(arm.write(EffortCommand<2>{effort}) == Status::ok);
    REQUIRE(direct.write({effort}) == Status::ok);
    REQUIRE(arm.read(geared) == Status::ok);
    REQUIRE(direct.read(plain) == Status::ok);
    // Offset and reductions cost a few roundings of numbers up to 100.
    CHECK((geared.position - plain.position).norm() < 1e-13);
    CHECK((geared.velocity - plain.velocity).norm() < 1e-11);
    CHECK((geared.effort - plain.effort).norm() < 1e-12);
  }
}

TEST_CASE("a run-time model behind a four-bar linkage is controlled as any robot") {
  using Drives = MockHardware<Model<2>, PositionCommand<2>>;
  using Arm = TransmittedHardware<Drives, Model<2>, FourBarTransmission>;
  const Model<2> model = support::model<Q2d>();
  const FourBarTransmission linkage{.actuator_reduction = {80, 60}, .joint_offset = {0.1, -0.2}};
  Loop<Arm, ForwardPosition> loop(
      Arm(model, Drives(model, {}, 1e-3),
          {.joints = {shoulder, elbow}, .actuators = {shoulder, elbow}, .transmission = linkage}),
      ForwardPosition<Model<2>>(model));
  loop.reference().position = {0.3, -0.7};
  REQUIRE(loop.update() == Status::ok);
  CHECK((loop.hardware().hardware().written().position - Vector(16, 60 * (0.2 - 0.5))).norm() <
        1e-12);
  REQUIRE(loop.update() == Status::ok);
  CHECK((loop.state().position - Vector(0.3, -0.7)).norm() < 1e-15);
}
