// SPDX-License-Identifier: Apache-2.0
// Controllers for position, velocity, effort and multi-mode drives, and laws for groups of joints.
#include <articula/compatibility/control_toolbox_pid_law.hpp>
#include <articula/control/drive_impedance.hpp>
#include <articula/control/forward_position.hpp>
#include <articula/control/forward_velocity.hpp>
#include <articula/control/joint_impedance.hpp>
#include <articula/control/laws/on_joints.hpp>
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/control/position_by_velocity.hpp>
#include <articula/control/velocity_by_effort.hpp>
#include <articula/core/controller.hpp>
#include <articula/core/hardware.hpp>
#include <articula/loop/loop.hpp>
#include <articula/robots/q2d.hpp>

#include <array>
#include <numbers>
#include <string_view>

#include "catch.hpp"
#include "hardware/fake_hardware.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "robots/random_robots.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using support::TiltedQ2d;

namespace {

using Vector = JointVector<2>;
constexpr double dt = 1e-3;

static_assert(Controller<ForwardPosition<Q2d>, 2> && Controller<ForwardVelocity<Q2d>, 2>);
static_assert(Controller<PositionByVelocity<Q2d>, 2> && Controller<VelocityByEffort<Q2d>, 2>);
static_assert(Controller<JointImpedance<Q2d>, 2> && Controller<DriveImpedance<Q2d>, 2>);
static_assert(JointCommand<MultiModeCommand<2>, 2> && !JointCommand<MultiModeCommand<2>, 3>);
static_assert(TakesGains<PidPlusGravity<Q2d>, ValidPidGains<2>>);
static_assert(TakesGains<JointImpedance<Q2d>, ValidImpedanceGains<2>>);
static_assert(!TakesGains<JointImpedance<Q2d>, ValidPidGains<2>>);
static_assert(!TakesGains<PidPlusGravity<Q2d>, JointPidGains<2>>);  // they must be valid

JointReference<2> some_reference() {
  JointReference<2> reference;
  reference.position = {0.5, -0.25};
  reference.velocity = {0.75, -1};
  reference.acceleration = {100, 100};
  reference.effort = {0.5, 0.125};
  return reference;
}

/// Drives that follow velocities at once.
struct VelocityDrives : support::FakeHardware<TiltedQ2d, VelocityCommand<2>> {
  [[nodiscard]] Status write(const VelocityCommand<2>& command) noexcept {
    measured.velocity = command.velocity;
    measured.position += dt * command.velocity;
    return Status::ok;
  }
};

/// Drives that close a spring and a damper at ten times the loop's rate around a simulated arm.
struct SpringDrives {
  using RobotType = TiltedQ2d;
  static constexpr int joint_count = 2;

  Simulator<TiltedQ2d> arm{SimulatorOptions<2>{.period = dt / 10}};

  [[nodiscard]] const TiltedQ2d& robot() const noexcept { return arm.robot(); }
  [[nodiscard]] Status activate() noexcept { return Status::ok; }
  [[nodiscard]] Status deactivate() noexcept { return Status::ok; }
  [[nodiscard]] Status read(JointState<2>& state) noexcept { return arm.read(state); }
  [[nodiscard]] Status write(const MultiModeCommand<2>& c) noexcept {
    for (int k = 0; k < 10; ++k) {
      JointState<2> state;
      if (const Status status = arm.read(state); status != Status::ok) return status;
      const Vector effort = c.stiffness.cwiseProduct(c.position - state.position) +
                            c.damping.cwiseProduct(c.velocity - state.velocity) + c.effort;
      if (const Status status = arm.write({effort}); status != Status::ok) return status;
    }
    return Status::ok;
  }
};
static_assert(Hardware<SpringDrives, MultiModeCommand<2>>);

template <class R>
struct SpringsOfHundred : DriveImpedance<R> {
  SpringsOfHundred() : DriveImpedance<R>({{{100, 10}, {100, 10}}}) {}
};
template <class R>
struct Approach : PositionByVelocity<R> {
  Approach()
      : PositionByVelocity<R>({PidGains{.proportional = 10}, PidGains{.proportional = 10}}) {}
};

}  // namespace

TEST_CASE("position and velocity drives are given the reference, within the joints' limits") {
  ForwardPosition<Q2d> position;
  ForwardVelocity<Q2d> velocity;
  JointReference<2> reference = some_reference();
  CHECK(position.update({{}, reference, dt}).position == reference.position);
  CHECK(velocity.update({{}, reference, dt}).velocity == reference.velocity);
  reference.position = {100, -100};
  reference.velocity = {-1e308, 1e308};
  CHECK(position.update({{}, reference, dt}).position == Vector(1, -1) * std::numbers::pi / 2);
  CHECK(velocity.update({{}, reference, dt}).velocity == Vector(-2.27, 23.08));
}

TEST_CASE("position by velocity: v_ref and a PID whose output is a velocity") {
  PositionByVelocity<Q2d> controller(
      {PidGains{.proportional = 2}, PidGains{.proportional = 2, .integral = 1000}});
  JointReference<2> reference = some_reference();
  JointState<2> state;
  state.position = {0.25, -0.25};
  CHECK(controller.update({state, reference, dt}).velocity == Vector(0.75 + 2 * 0.25, -1));
  reference.position = {50, 100};  // its limit is that of the velocity; behind it nothing winds up
  CHECK(controller.update({state, reference, dt}).velocity == Vector(2.27, 23.08));
  reference.position = state.position;  // the last step is taken back, and no other follows
  static_cast<void>(controller.update({state, reference, dt}));
  CHECK(controller.part<PidLaw<2>>().integral()[1] == 0);

  Loop<VelocityDrives, Approach> loop;
  loop.reference().position = {0.5, -0.5};
  for (int k = 0; k < 2000; ++k) REQUIRE(loop.update() == Status::ok);
  CHECK((loop.state().position - Vector(0.5, -0.5)).cwiseAbs().maxCoeff() < 1e-8);  // exp(-20)
}

TEST_CASE("velocity by effort: the arm turns as fast as it is asked to") {
  const JointPidGains<2> gains{PidGains{.proportional = 50, .integral = 500},
                               PidGains{.proportional = 10, .integral = 200}};
  Simulator<TiltedQ2d> arm;
  VelocityByEffort<TiltedQ2d> controller(gains);
  JointState<2> state;
  JointReference<2> reference;
  reference.velocity = {0.25, -0.5};
  reference.position = {1e6, 1e6};  // not used
  for (int k = 0; k < 1500; ++k) {
    REQUIRE(arm.read(state) == Status::ok);
    REQUIRE(arm.write(controller.update({state, reference, dt})) == Status::ok);
  }
  CHECK(state.velocity[0] == Approx(0.25).epsilon(0.02));
  CHECK(state.velocity[1] == Approx(-0.5).epsilon(0.02));
}

TEST_CASE("joint impedance is spring, damper, weight and feed-forward") {
  JointImpedance<TiltedQ2d> controller({{{20, 2}, {10, 1}}});
  JointState<2> state;
  state.position = {0.25, 0.5};
  state.velocity = {0.5, -0.25};
  const JointReference<2> reference = some_reference();
  const Vector expected = Vector(20 * 0.25 + 2 * 0.25, 10 * -0.75 + 1 * -0.75) +
                          gravity(TiltedQ2d(), state.position) + reference.effort;
  CHECK((controller.update({state, reference, dt}).effort - expected).cwiseAbs().maxCoeff() <
        1e-13);
}

TEST_CASE("an impedance gives way to a push like its spring, in the controller or in the drives") {
  const JointImpedanceGains<2> gains{{{100, 10}, {100, 10}}};
  const Vector push(3, 1);
  Simulator<TiltedQ2d> arm;
  JointImpedance<TiltedQ2d> controller(gains);
  for (int k = 0; k < 4000; ++k) {
    JointState<2> state;
    REQUIRE(arm.read(state) == Status::ok);
    auto command = controller.update({state, {}, dt});
    command.effort += push;
    REQUIRE(arm.write(command) == Status::ok);
  }
  // The slower mode decays with some 2.5 1/s: exp(-10) of 0.03 rad.
  CHECK((arm.true_state().position - push / 100).cwiseAbs().maxCoeff() < 1e-5);

  Loop<SpringDrives, SpringsOfHundred> loop;
  loop.reference().effort = push;
  for (int k = 0; k < 4000; ++k) REQUIRE(loop.update() == Status::ok);
  CHECK((loop.state().position - push / 100).cwiseAbs().maxCoeff() < 1e-5);
}

TEST_CASE("drives are given springs, dampers, references and the effort to add") {
  DriveImpedance<TiltedQ2d> controller({{{20, 2}, {10, 1}}});
  JointState<2> state;
  state.position = {0.25, 0.5};
  JointReference<2> reference = some_reference();
  auto command = controller.update({state, reference, dt});
  CHECK(command.position == reference.position);
  CHECK(command.velocity == reference.velocity);
  CHECK(command.stiffness == Vector(20, 10));
  CHECK(command.damping == Vector(2, 1));
  CHECK(command.effort == gravity(TiltedQ2d(), state.position) + reference.effort);
  reference.effort = {1e9, -1e9};
  CHECK(controller.update({state, reference, dt}).effort == Vector(27.94, -13.62));
}

TEST_CASE("springs and dampers that are none are refused, naming joint, gain and value") {
  for (const double bad : {-1.0, support::infinity, support::not_a_number}) {
    CHECK_THROWS_WITH(JointImpedance<Q2d>({{{1, 1}, {bad, 1}}}),
                      Catch::Matchers::Contains("'elbow_active_joint'") &&
                          Catch::Matchers::Contains("stiffness"));
    CHECK_THROWS_WITH(DriveImpedance<Q2d>({{{1, bad}, {1, 1}}}),
                      Catch::Matchers::Contains("'shoulder_active_joint'") &&
                          Catch::Matchers::Contains("damping"));
  }
}

TEST_CASE("in a fault multi-mode drives hold by their last springs, or damp") {
  const MultiModeCommand<2> last{.position = {1, 1},
                                 .velocity = {1, 1},
                                 .stiffness = {20, 10},
                                 .damping = {2, 1},
                                 .effort = {5, 5}};
  const Vector place(0.3, -0.4);
  auto safe = safe_command(TiltedQ2d(), place, last);
  CHECK(safe.position == place);
  CHECK(safe.velocity == Vector(0, 0));
  CHECK(safe.stiffness == last.stiffness);
  CHECK(safe.damping == last.damping);
  CHECK(safe.effort == gravity(TiltedQ2d(), place));
  safe = safe_command(TiltedQ2d(), Vector::Constant(support::not_a_number), last);
  CHECK(is_finite(safe));
  CHECK(safe.stiffness == Vector(0, 0));
  CHECK(safe.damping == last.damping);
  CHECK(safe.velocity == Vector(0, 0));
  CHECK(safe.effort == Vector(0, 0));

  MultiModeCommand<2> wild = last;
  wild.effort = {1e9, -1e9};
  CHECK(within_effort_limits(TiltedQ2d(), wild).effort == Vector(27.94, -13.62));

  Loop<SpringDrives, SpringsOfHundred> loop;
  REQUIRE(loop.update() == Status::ok);
  loop.reference().velocity[0] = support::not_a_number;
  CHECK(loop.update() == Status::non_finite_reference);
  CHECK(is_finite(loop.command()));
  CHECK(loop.command().stiffness == Vector(100, 100));
}

TEST_CASE("each number of a multi-mode command counts when it is checked") {
  using Command = MultiModeCommand<2>;
  CHECK(is_finite(Command{}));
  for (auto member : {&Command::position, &Command::velocity, &Command::stiffness,
                      &Command::damping, &Command::effort}) {
    Command command;
    (command.*member)[1] = support::infinity;
    CHECK_FALSE(is_finite(command));
  }
}

TEST_CASE("on a random tree each joint can have a law of its own") {
  constexpr unsigned seed = 31;
  CAPTURE(seed);
  support::Random random(seed);
  const Model<5> robot = support::random_robot(random, 5).model<5>();
  const auto names = joint_names(robot);
  const std::array<std::string_view, 2> stiff{names[3], names[0]}, pid{names[1], names[4]};

  JointPidGains<5> pid_gains{};
  JointImpedanceGains<5> springs{};
  for (std::size_t i = 0; i < 5; ++i) {
    pid_gains[i] = {.proportional = random.number(1, 10), .integral = random.number(1, 10)};
    springs[i] = {random.number(1, 10), random.number(0, 1)};
  }
  const PidLaw<5> pid_law(robot, pid_gains);
  const ImpedanceLaw<5> spring_law({springs, names});
  using Springs = OnJoints<5, ImpedanceLaw<5>>;
  using Pids = OnJoints<5, PidLaw<5>>;
  EffortController<Model<5>, Springs, Pids> controller(robot, Springs(robot, spring_law, stiff),
                                                       Pids(robot, pid_law, pid));
  JointState<5> state;
  JointReference<5> reference;
  state.position = random.vector<5>(1);
  reference.position = random.vector<5>(1);
  reference.velocity = random.vector<5>(1);
  PidLaw<5> alone = pid_law;
  const JointVector<5> of_pid = alone.output({state, reference, dt});
  const JointVector<5> of_springs = spring_law.output({state, reference, dt});
  const JointVector<5> effort = controller.update({state, reference, dt}).effort;
  CHECK(effort[0] == of_springs[0]);
  CHECK(effort[1] == of_pid[1]);
  CHECK(effort[2] == 0);
  CHECK(effort[3] == of_springs[3]);
  CHECK(effort[4] == of_pid[4]);

  CHECK_THROWS_WITH(Pids(robot, pid_law, std::array<std::string_view, 1>{"no_such_joint"}),
                    Catch::Matchers::Contains("no_such_joint"));
  CHECK_THROWS_WITH(Pids(robot, pid_law, std::array<std::string_view, 2>{names[1], names[1]}),
                    Catch::Matchers::Contains("twice"));
}

TEST_CASE("a law of control_toolbox takes the place of the PID in any controller") {
  const ControlToolboxPidLaw<2> law(ControlToolbox::humble, Q2d::pid_gains, joint_names(Q2d()));
  EffortController<Q2d, ControlToolboxPidLaw<2>, EffortFeedforward<2>> controller(Q2d(), law, {});
  JointReference<2> reference;
  reference.position = {0.001, -0.001};
  const Vector expected(2310e-3 + 4640e-6, -(339e-3 + 851e-6));
  CHECK((controller.update({{}, reference, dt}).effort - expected).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("a NaN from a law stays one, so that the loop finds it") {
  PidPlusGravity<TiltedQ2d> controller;
  JointReference<2> reference;
  reference.effort[1] = support::not_a_number;
  const auto command = controller.update({{}, reference, dt});
  CHECK(is_finite(command.effort[0]));
  CHECK_FALSE(is_finite(command.effort[1]));
}
