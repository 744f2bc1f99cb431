// SPDX-License-Identifier: Apache-2.0
#include <articula/sim/simulator.hpp>

#include <cmath>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using support::infinity;
using support::not_a_number;
using support::slider;

namespace {

static_assert(Hardware<Q2dSim> && Hardware<Simulator<Model<3>>>);
static_assert(Hardware<Q2dSim, PositionCommand<2>> && Hardware<Q2dSim, VelocityCommand<2>>);
static_assert(Hardware<Q2dSim, MultiModeCommand<2>> && !Hardware<Q2dSim, PositionCommand<3>>);

using SliderSim = Simulator<Model<1>>;
using Vector = JointVector<2>;

bool same(const JointState<2>& a, const JointState<2>& b) {
  return a.position == b.position && a.velocity == b.velocity && a.effort == b.effort;
}

template <class Simulator>
JointState<2> measured(Simulator& simulator) {
  JointState<2> state;
  REQUIRE(simulator.read(state) == Status::ok);
  return state;
}

EffortCommand<1> push(double effort) { return {JointVector<1>(effort)}; }

}  // namespace

TEST_CASE("the simulation starts where and as fast as it is told") {
  SimulatorOptions<2> options;
  options.initial_position = {0.25, -0.5};
  options.initial_velocity = {-1, 2};
  Q2dSim simulator(options);
  const JointState<2> state = measured(simulator);
  CHECK(state.position == Vector(0.25, -0.5));
  CHECK(state.velocity == Vector(-1, 2));
  CHECK(state.effort == Vector(0, 0));
  CHECK(simulator.time() == 0);
  CHECK(simulator.activate() == Status::ok);
  CHECK(simulator.deactivate() == Status::ok);
}

TEST_CASE("without a start position it is 0, or the nearest that the limits allow") {
  Q2dSim q2d;
  CHECK(measured(q2d).position == Vector(0, 0));
  Model<2> arm = support::model<Q2d>();
  arm.joints[0].limits.lower = 0.5;
  arm.joints[1].limits.upper = -0.25;
  Simulator<Model<2>> shifted(arm);
  CHECK(measured(shifted).position == Vector(0.5, -0.25));
}

TEST_CASE("a command is held for one period, and time goes on by it") {
  SliderSim simulator(slider(), {.period = 0.25});
  CHECK(simulator.period() == 0.25);
  REQUIRE(simulator.write(push(8)) == Status::ok);  // 4 m/s^2 for a quarter of a second
  CHECK(simulator.time() == 0.25);
  CHECK(simulator.true_state().position[0] == 4 * 0.0625 / 2);
  CHECK(simulator.true_state().velocity[0] == 1);
  CHECK(simulator.true_state().effort[0] == 8);
  REQUIRE(simulator.write(push(0)) == Status::ok);
  CHECK(simulator.true_state().position[0] == 4 * 0.0625 / 2 + 0.25);
  CHECK(simulator.true_state().velocity[0] == 1);
  CHECK(simulator.time() == 0.5);
}

TEST_CASE("sub-steps are the same as as many short periods") {
  Q2dSim coarse(SimulatorOptions<2>{.period = 4e-3, .substeps = 4});
  Q2dSim fine(SimulatorOptions<2>{.period = 4e-3 / 4});
  for (int k = 0; k < 50; ++k) {
    const EffortCommand<2> command{{std::sin(0.1 * k), 3 * std::cos(0.2 * k)}};
    CHECK(coarse.write(command) == Status::ok);
    for (int i = 0; i < 4; ++i) CHECK(fine.write(command) == Status::ok);
  }
  CHECK(coarse.true_state().position.norm() > 1e-3);
  CHECK(same(coarse.true_state(), fine.true_state()));
}

TEST_CASE("drives give no more than their limits") {
  for (const double side : {1.0, -1.0}) {
    Q2dSim strong, limited;
    CHECK(strong.write({Vector(side * 1e9, side * -1e300)}) == Status::ok);
    CHECK(limited.write({Vector(side * 27.94, side * -13.62)}) == Status::ok);
    CHECK(same(strong.true_state(), limited.true_state()));
    CHECK(measured(strong).effort == Vector(side * 27.94, side * -13.62));
  }
}

TEST_CASE("a command that is no number is refused, and the drives give nothing for a period") {
  for (const double bad : {not_a_number, infinity, -infinity}) {
    SliderSim simulator(slider(), {.period = 0.25});
    static_cast<void>(simulator.write(push(8)));
    CHECK(simulator.write(push(bad)) == Status::non_finite_command);
    CHECK(simulator.true_state().velocity[0] == 1);
    CHECK(simulator.true_state().effort[0] == 0);
    CHECK(simulator.time() == 0.5);
    CHECK(simulator.write(push(8)) == Status::ok);
    CHECK(simulator.true_state().velocity[0] == 2);
  }
}

TEST_CASE("a motion that overflows is reported") {
  SliderSim simulator(slider(), {.period = 1});
  static_cast<void>(simulator.write(push(support::largest)));
  for (int k = 0; k < 3; ++k) static_cast<void>(simulator.write(push(support::largest)));
  JointState<1> state;
  CHECK(simulator.read(state) == Status::non_finite_state);
}

TEST_CASE("two runs are the same to the last bit, noise included") {
  constexpr unsigned seed = 3;
  CAPTURE(seed);
  SimulatorOptions<2> options{.substeps = 2};
  options.encoder_resolution = {1e-4, 0};
  options.position_noise = {1e-4, 1e-3};
  options.velocity_noise = {1e-2, 1e-2};
  options.effort_noise = {0.1, 0.1};
  Q2dSim one(options), two(options);
  support::Random random(seed);
  for (int k = 0; k < 5000; ++k) {
    const EffortCommand<2> command{random.vector<2>(30)};
    static_cast<void>(one.write(command));
    static_cast<void>(two.write(command));
    REQUIRE(same(measured(one), measured(two)));
    REQUIRE(same(one.true_state(), two.true_state()));
  }
}

TEST_CASE("a copy goes on as the original does") {
  SimulatorOptions<2> options;
  options.position_noise.setConstant(1e-3);
  Q2dSim original(options);
  for (int k = 0; k < 7; ++k) static_cast<void>(original.write({Vector(1, 1)}));
  Q2dSim copy = original;
  for (int k = 0; k < 7; ++k) {
    static_cast<void>(original.write({Vector(1, 1)}));
    static_cast<void>(copy.write({Vector(1, 1)}));
  }
  CHECK(same(measured(original), measured(copy)));
}

TEST_CASE("reading does not change what is read") {
  SimulatorOptions<2> options;
  options.position_noise.setConstant(1e-3);
  Q2dSim simulator(options);
  CHECK(same(measured(simulator), measured(simulator)));
}

TEST_CASE("a run-time model moves as the robot known at compile time") {
  Q2dSim described;
  Simulator<Model<2>> loaded(support::model<Q2d>());
  for (int k = 0; k < 2000; ++k) {
    const EffortCommand<2> command{{20 * std::sin(0.01 * k), 10 * std::cos(0.03 * k)}};
    static_cast<void>(described.write(command));
    static_cast<void>(loaded.write(command));
  }
  // The compiler may fuse or fold operations of one and not of the other; stops amplify nothing.
  CHECK((described.true_state().position - loaded.true_state().position).norm() < 1e-12);
  CHECK((described.true_state().velocity - loaded.true_state().velocity).norm() < 1e-10);
  CHECK(described.true_state().position.norm() > 0.01);
}
