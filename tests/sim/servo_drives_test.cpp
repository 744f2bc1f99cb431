// SPDX-License-Identifier: Apache-2.0
// The simulator's drives under position and velocity commands, as servos.
#include <articula/dynamics/gravity.hpp>
#include <articula/sim/simulator.hpp>

#include "catch.hpp"
#include "numbers.hpp"
#include "robots/energy.hpp"
#include "robots/random_robots.hpp"
#include "robots/test_robots.hpp"

#include <cmath>

using namespace articula;
using support::infinity;
using support::not_a_number;

namespace {

using Vector = JointVector<2>;
using Arm = Model<2>;

/// The tilted Q2D with dry friction, and with less damping than its drives could hardly overcome.
Arm sticky_arm() {
  Arm arm = support::model<support::TiltedQ2d>();
  for (JointProperties& joint : arm.joints) {
    joint.damping = 0.1;
    joint.friction = 0.5;
  }
  return arm;
}

SimulatorOptions<2> servos(double period, const Vector& bandwidth) {
  SimulatorOptions<2> options{.period = period};
  options.servo_bandwidth = bandwidth;
  return options;
}

/// (1 + w t) exp(-w t): what is left of a step after the time t.
double rest_of_step(double w, double t) { return (1 + w * t) * std::exp(-w * t); }

}  // namespace

TEST_CASE("positions are followed with the stated bandwidth, whatever the control rate") {
  const Vector w(50, 120), step(0.01, -0.004);
  for (const double period : {1e-3, 4e-3, 0.02}) {
    CAPTURE(period);
    Simulator<Arm> simulator(sticky_arm(), servos(period, w));
    while (simulator.time() < 0.2 - period / 2) {
      REQUIRE(simulator.write(PositionCommand<2>{step}) == Status::ok);
      for (int j = 0; j < 2; ++j) {
        // Runge-Kutta at 0.2/w is off by 3e-6 of the step in each of some ten steps.
        const double expected = step[j] * (1 - rest_of_step(w[j], simulator.time()));
        CHECK(std::abs(simulator.true_state().position[j] - expected) < 3e-5 * std::abs(step[j]));
      }
    }
  }
}

TEST_CASE("velocities are followed with the stated bandwidth, whatever the control rate") {
  const Vector w(50, 120), target(0.3, -2);
  for (const double period : {1e-3, 4e-3, 0.02}) {
    CAPTURE(period);
    Simulator<Arm> simulator(sticky_arm(), servos(period, w));
    while (simulator.time() < 0.2 - period / 2) {
      REQUIRE(simulator.write(VelocityCommand<2>{target}) == Status::ok);
      for (int j = 0; j < 2; ++j) {
        const double expected = target[j] * (1 - std::exp(-w[j] * simulator.time()));
        CHECK(std::abs(simulator.true_state().velocity[j] - expected) < 3e-5 * std::abs(target[j]));
      }
    }
  }
}

TEST_CASE("the effort is what the drives apply") {
  Simulator<Arm> simulator(support::model<support::TiltedQ2d>());
  for (int k = 0; k < 2000; ++k) {
    REQUIRE(simulator.write(PositionCommand<2>{Vector(0.3, -0.7)}) == Status::ok);
    const auto& effort = simulator.true_state().effort;
    REQUIRE((effort.array().abs() <= effort_limits(simulator.robot()).array()).all());
  }
  const JointState<2>& rest = simulator.true_state();
  CHECK((rest.position - Vector(0.3, -0.7)).norm() < 1e-12);
  CHECK((rest.effort - gravity(simulator.robot(), rest.position)).norm() < 1e-9);
  CHECK(rest.effort.norm() > 0.5);
}

TEST_CASE("speed stays within the velocity limits") {
  for (const bool by_position : {true, false}) {
    Simulator<Arm> simulator(sticky_arm());
    double fastest = 0;
    for (int k = 0; k < 500; ++k) {
      const Vector target = by_position ? Vector(1.5, 0) : Vector(100, 0);
      const Status status = by_position ? simulator.write(PositionCommand<2>{target})
                                        : simulator.write(VelocityCommand<2>{target});
      REQUIRE(status == Status::ok);
      fastest = std::fmax(fastest, simulator.true_state().velocity[0]);
    }
    // Q2D's shoulder: 2.27 rad/s, which is held until the command is near.
    CHECK(fastest <= 2.27 * (1 + 1e-12));
    CHECK(fastest == Approx(2.27).epsilon(0.01).margin(0));
  }
}

TEST_CASE("a drive at its limit gives it all, and the other joint does not feel it") {
  Arm arm = support::model<support::TiltedQ2d>();
  arm.joints[0].limits.effort = 16;
  Simulator<Arm> simulator(arm, servos(1e-3, {100, 100}));
  int at_limit = 0;
  for (int k = 0; k < 300; ++k) {
    REQUIRE(simulator.write(PositionCommand<2>{Vector(0.1, 0.02)}) == Status::ok);
    const JointState<2>& state = simulator.true_state();
    REQUIRE(std::abs(state.effort[0]) <= 16);
    if (std::abs(state.effort[0]) == 16) ++at_limit;
    const double expected = 0.02 * (1 - rest_of_step(100, simulator.time()));
    REQUIRE(std::abs(state.position[1] - expected) < 1e-6);
  }
  CHECK(at_limit > 3);
}

TEST_CASE("a wish too large for numbers leaves the other drives theirs") {
  Arm arm = support::free_arm();
  arm.joints[0].limits.effort = 20;  // no limit of velocity
  for (const double wish : {1e308, -1e308, 1e200}) {
    CAPTURE(wish);
    for (const bool by_position : {true, false}) {
      Simulator<Arm> simulator(arm, servos(1e-3, {100, 100}));
      for (int k = 0; k < 200; ++k) {
        const Status status = by_position ? simulator.write(PositionCommand<2>{Vector(wish, 0.5)})
                                          : simulator.write(VelocityCommand<2>{Vector(wish, 0.5)});
        REQUIRE(status == Status::ok);
        REQUIRE(std::abs(simulator.true_state().effort[0]) == 20);  // as far as it can
      }
      const JointState<2>& state = simulator.true_state();
      CHECK(state.velocity[0] * wish > 0);
      // After 20/w what is left of the step is exp(-20), but for the other joint's turning.
      CHECK((by_position ? state.position : state.velocity)[1] == Approx(0.5).epsilon(1e-4));
    }
  }
}

TEST_CASE("commands beyond a stop end at the stop, without pushing") {
  Arm arm = sticky_arm();
  arm.joints[1].limits.upper = 0.5;
  for (const bool by_position : {true, false}) {
    CAPTURE(by_position);
    Simulator<Arm> simulator(arm);
    for (int k = 0; k < 2000; ++k) {
      const Status status = by_position ? simulator.write(PositionCommand<2>{Vector(0.2, 100)})
                                        : simulator.write(VelocityCommand<2>{Vector(0.1, 100)});
      REQUIRE(status == Status::ok);
      REQUIRE(support::within_limits(simulator));
    }
    const JointState<2>& state = simulator.true_state();
    CHECK(std::abs(state.position[1] - 0.5) < 1e-12);
    if (by_position) CHECK(std::abs(state.position[0] - 0.2) < 1e-12);
    if (!by_position) CHECK(std::abs(state.velocity[0] - 0.1) < 1e-12);
    CHECK(std::abs(state.effort[1] - gravity(arm, state.position)[1]) <
          0.51);  // less than friction
    static_cast<void>(simulator.write(PositionCommand<2>{Vector(0.2, 0.4)}));
    CHECK(simulator.true_state().position[1] < 0.5);
  }
}

TEST_CASE("a joint without friction rests at its stop while its drive is told to go on") {
  Arm arm = support::model<support::TiltedQ2d>();
  for (JointProperties& joint : arm.joints) joint.damping = joint.friction = 0;
  Simulator<Arm> simulator(arm);
  const VelocityCommand<2> onwards{{2, 0}};
  for (int k = 0; k < 3000; ++k) REQUIRE(simulator.write(onwards) == Status::ok);
  const JointState<2> before = simulator.true_state();
  REQUIRE(before.position[0] == arm.joints[0].limits.upper);
  for (int k = 0; k < 1000; ++k) {
    REQUIRE(simulator.write(onwards) == Status::ok);
    const JointState<2>& now = simulator.true_state();
    REQUIRE(std::abs(now.velocity[0]) <= 1e-9);  // what the drives take for standing still
    REQUIRE(std::abs(now.velocity[1]) <= 1e-9);
    // What the weight takes, and no more: it would be the drive's limit.
    REQUIRE((now.effort - before.effort).cwiseAbs().maxCoeff() < 1e-6);
  }
}

TEST_CASE("a drive too weak for its friction stays, and one too weak for its load gives way") {
  Model<1> slider = support::slider();
  slider.joints[0].friction = 3;
  slider.joints[0].limits.effort = 2;
  Simulator<Model<1>> stuck(slider);
  for (int k = 0; k < 50; ++k) {
    static_cast<void>(stuck.write(PositionCommand<1>{JointVector<1>(1.0)}));
  }
  CHECK(stuck.true_state().position[0] == 0);
  CHECK(stuck.true_state().effort[0] == 2);

  Model<1> lift = support::single_joint(JointType::prismatic, {0, 0, 1});  // 19.6 N
  lift.joints[0].limits.effort = 9.6;
  Simulator<Model<1>> falling(lift, {.period = 0.1});
  for (int k = 0; k < 10; ++k) {
    static_cast<void>(falling.write(PositionCommand<1>{JointVector<1>(0.0)}));
  }
  CHECK(falling.true_state().position[0] == Approx(-2.5));  // half of (9.6 - 19.6) N / 2 kg, 1 s
}

TEST_CASE("drives without effort or speed do not move") {
  Model<1> slider = support::slider();
  slider.joints[0].limits.effort = 0;
  Simulator<Model<1>> limp(slider);
  slider.joints[0].limits = {.velocity = 0};
  Simulator<Model<1>> slow(slider);
  for (int k = 0; k < 20; ++k) {
    for (Simulator<Model<1>>* simulator : {&limp, &slow}) {
      REQUIRE(simulator->write(PositionCommand<1>{JointVector<1>(1.0)}) == Status::ok);
      REQUIRE(simulator->write(VelocityCommand<1>{JointVector<1>(1.0)}) == Status::ok);
      REQUIRE(simulator->true_state().position[0] == 0);
    }
  }
}

TEST_CASE("rotors make the motion of a given effort slower, and servos as fast as ever") {
  support::Blueprint rail{
      .links = {{.name = "rail"},
                {.name = "body", .mass = 2, .inertia = {.xx = 2, .yy = 2, .zz = 2}}},
      .joints = {{.name = "joint",
                  .type = JointType::prismatic,
                  .parent = "rail",
                  .child = "body",
                  .reflected_inertia = 6}}};
  Simulator<Model<1>> simulator(rail.model<1>(), {.period = 0.25});
  static_cast<void>(simulator.write({JointVector<1>(8.0)}));
  CHECK(simulator.true_state().velocity[0] == Approx(8 / (2 + 6.0) * 0.25));
  Simulator<Model<1>> servo(rail.model<1>());
  for (int k = 0; k < 20; ++k) {
    static_cast<void>(servo.write(PositionCommand<1>{JointVector<1>(0.1)}));
  }
  CHECK(servo.true_state().position[0] == Approx(0.1 * (1 - rest_of_step(100, 0.02))));
}

TEST_CASE("commands that are no numbers are refused, and the drives give nothing for a period") {
  for (const double bad : {not_a_number, infinity, -infinity}) {
    Q2dSim servo, limp;
    CHECK(servo.write(PositionCommand<2>{Vector(0.1, bad)}) == Status::non_finite_command);
    CHECK(servo.write(VelocityCommand<2>{Vector(bad, 0.1)}) == Status::non_finite_command);
    static_cast<void>(limp.write({}));
    static_cast<void>(limp.write({}));
    CHECK(servo.true_state().position == limp.true_state().position);
    CHECK(servo.true_state().effort == Vector(0, 0));
    CHECK(servo.time() == limp.time());
  }
}

TEST_CASE("two runs under all kinds of commands are the same to the last bit") {
  constexpr unsigned seed = 7;
  CAPTURE(seed);
  Simulator<Arm> one(sticky_arm()), two(sticky_arm());
  support::Random random(seed);
  for (int k = 0; k < 400; ++k) {
    const Vector target = random.vector<2>(3);
    for (Simulator<Arm>* simulator : {&one, &two}) {
      if (k % 3 == 0) static_cast<void>(simulator->write(PositionCommand<2>{target}));
      if (k % 3 == 1) static_cast<void>(simulator->write(VelocityCommand<2>{target}));
      if (k % 3 == 2) static_cast<void>(simulator->write({target}));
    }
    REQUIRE(one.true_state().position == two.true_state().position);
    REQUIRE(one.true_state().velocity == two.true_state().velocity);
    REQUIRE(one.true_state().effort == two.true_state().effort);
  }
}

TEST_CASE("wild commands to random robots leave them within their limits") {
  constexpr unsigned seed = 8;
  support::Random random(seed);
  for (int robot = 0; robot < 60; ++robot) {
    CAPTURE(seed, robot);
    Model<3, 4> model =
        support::random_robot(random, 4, support::Shape::tree, 1).template model<3, 4>();
    for (JointProperties& joint : model.joints) {
      joint.limits = {.lower = random.number(-2, 0),
                      .upper = random.number(0, 2),
                      .velocity = random.one_in(2) ? infinity : random.number(0, 10),
                      .effort = std::pow(10, random.number(-1, 3))};
      joint.friction = random.one_in(2) ? 0 : random.number(0, 5);
      joint.damping = random.one_in(2) ? 0 : random.number(0, 0.1);
    }
    SimulatorOptions<3> options;
    for (int j = 0; j < 3; ++j) options.servo_bandwidth[j] = std::pow(10, random.number(0, 3));
    Simulator<Model<3, 4>> simulator(model, options);
    for (int k = 0; k < 40; ++k) {
      JointVector<3> target = random.vector<3>(3);
      if (k % 7 == 3) target[0] = random.one_in(2) ? support::largest : -support::largest;
      if (k % 5 == 2) target[1] = support::smallest;
      if (k / 10 % 2 == 0) {
        REQUIRE(simulator.write(PositionCommand<3>{target}) == Status::ok);
      } else {
        REQUIRE(simulator.write(VelocityCommand<3>{target}) == Status::ok);
      }
      REQUIRE(support::within_limits(simulator));
      REQUIRE(is_finite(simulator.true_state()));
      REQUIRE((simulator.true_state().effort.array().abs() <= effort_limits(model).array()).all());
    }
  }
}
