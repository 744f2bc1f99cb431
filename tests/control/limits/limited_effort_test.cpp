// SPDX-License-Identifier: Apache-2.0
// Effort and multi-mode commands within their limits: simulated on random robots.
#include <articula/control/bypass.hpp>
#include <articula/control/drive_impedance.hpp>
#include <articula/control/limits/limited.hpp>
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/dynamics/inverse_dynamics.hpp>
#include <articula/loop/loop.hpp>
#include <articula/sim/simulator.hpp>

#include <algorithm>
#include <cmath>

#include "by_hand.hpp"
#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "robots/random_robots.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using support::infinity;
using support::not_a_number;

namespace {

template <class R>
using LimitedBypass = Limited<R, Bypass<R>>;
template <class R>
using LimitedPid = Limited<R, PidPlusGravity<R>>;
template <class R>
using LimitedImpedance = Limited<R, DriveImpedance<R>>;

/// Springs and dampers as a test wants them.
template <class R>
struct AnySprings {
  MultiModeCommand<joint_count<R>> command{};
  [[nodiscard]] MultiModeCommand<joint_count<R>> update(
      const ControlInput<joint_count<R>>&) noexcept {
    return command;
  }
};

constexpr double dt = 1e-3;

/// A random robot with drives that can give the accelerations A anywhere within the limits.
template <int N>
struct Case {
  Model<N> robot;
  CommandLimits<N> limits;
};

template <int N>
Case<N> random_case(support::Random& random) {
  Case<N> c{support::random_robot(random, N).template model<N>(), {}};
  for (int j = 0; j < N; ++j) {
    c.limits.lower[j] = random.number(-1, -0.2);
    c.limits.upper[j] = random.number(0.2, 1);
    c.limits.velocity[j] = random.number(0.5, 3);
    c.limits.acceleration[j] = random.number(3, 30);
    if (random.one_in(3)) c.limits.jerk[j] = c.limits.acceleration[j] * random.number(30, 300);
  }
  // The efforts that the limits can take, at random places and twice of it.
  JointVector<N> effort = JointVector<N>::Zero();
  for (int k = 0; k < 500; ++k) {
    JointVector<N> q, v, a;
    for (int j = 0; j < N; ++j) {
      q[j] = random.number(c.limits.lower[j], c.limits.upper[j]);
      v[j] = (random.one_in(2) ? 1 : -1) * c.limits.velocity[j];
      a[j] = (random.one_in(2) ? 1 : -1) * c.limits.acceleration[j];
    }
    effort = effort.cwiseMax(inverse_dynamics(c.robot, q, v, a).cwiseAbs());
  }
  for (int j = 0; j < N; ++j) {
    auto& joint = c.robot.joints[static_cast<std::size_t>(j)];
    joint.limits.effort = c.limits.effort[j] = 2 * effort[j];
    joint.damping = random.number(0, 0.02) * effort[j];
  }
  return c;
}

/// How far the joints of a simulated robot get beyond their limits under wild efforts, as shares of
/// the way of a cycle at V, and of V and A.
struct Worst {
  double position = 0, velocity = 0, acceleration = 0;
};

template <int N>
Worst wild_run(const Case<N>& c, support::Random& random, int cycles) {
  using R = Model<N>;
  Loop<Simulator<R>, LimitedBypass> loop(Simulator<R>(c.robot),
                                         LimitedBypass<R>(c.robot, c.limits, Bypass<R>(c.robot)));
  Worst worst;
  JointVector<N> last = JointVector<N>::Zero();
  for (int k = 0; k < cycles; ++k) {
    for (int j = 0; j < N; ++j) {
      const double size = random.one_in(1000) ? 1e6 : 2 * c.limits.effort[j];
      if (random.one_in(200)) loop.reference().effort[j] = random.number(-size, size);
    }
    if (loop.update() != Status::ok) return {infinity, infinity, infinity};
    for (int j = 0; j < N; ++j) {
      const double q = loop.state().position[j], v = loop.state().velocity[j];
      const double beyond = std::max(c.limits.lower[j] - q, q - c.limits.upper[j]);
      worst.position = std::max(worst.position, beyond / (c.limits.velocity[j] * dt));
      worst.velocity = std::max(worst.velocity, std::abs(v) / c.limits.velocity[j] - 1);
      const double a = std::abs(v - last[j]) / dt;
      worst.acceleration = std::max(worst.acceleration, a / c.limits.acceleration[j] - 1);
    }
    last = loop.state().velocity;
  }
  return worst;
}

template <int N>
void check_wild_runs(unsigned seed, int robots) {
  support::Random random(seed);
  for (int k = 0; k < robots; ++k) {
    CAPTURE(seed, N, k);
    const Case<N> c = random_case<N>(random);
    const Worst worst = wild_run(c, random, 4000);
    // The acceleration that is foreseen for a cycle is that at its beginning: what Coriolis efforts
    // and the posture change within it is a few percent of A, and of second order in the period.
    CHECK(worst.position < 0.5);
    CHECK(worst.velocity < 1e-2);
    CHECK(worst.acceleration < 0.05);
  }
}

/// The limits of a described arm, with an acceleration that its drives can give.
template <class R>
CommandLimits<2> limits_of(double acceleration) {
  CommandLimits<2> limits = command_limits(R());
  limits.acceleration.setConstant(acceleration);
  return limits;
}

JointReference<2> far_away() {
  JointReference<2> reference;
  reference.position = {3, -3};
  return reference;
}

}  // namespace

TEST_CASE("under wild efforts joints of random robots keep their limits and brake in time") {
  check_wild_runs<1>(21, 30);
  check_wild_runs<2>(22, 30);
  check_wild_runs<4>(23, 15);
}

TEST_CASE("the finer the cycle, the closer the limits are kept") {
  // Shown for one joint that is driven against its limit with all its drive has.
  for (const double period : {4e-3, 1e-3}) {
    Model<1> robot = support::slider();
    robot.joints[0].limits.effort = 100;
    CommandLimits<1> limits = command_limits(robot);
    limits.upper[0] = 0.5;
    limits.acceleration[0] = 20;
    support::ByHand<Limited<Model<1>, Bypass<Model<1>>>> controller(robot, limits,
                                                                    Bypass<Model<1>>(robot));
    Simulator<Model<1>> simulator(robot, {.period = period});
    JointState<1> state;
    JointReference<1> reference;
    reference.effort[0] = 100;
    static_cast<void>(simulator.read(state));
    controller.start(state);
    double furthest = 0, speed = 0;
    for (int k = 0; k * period < 2; ++k) {
      static_cast<void>(simulator.read(state));
      furthest = std::max(furthest, state.position[0]);
      speed = std::max(speed, state.velocity[0]);
      static_cast<void>(simulator.write(controller.update(state, reference, period)));
    }
    CAPTURE(period);
    CHECK(furthest <= 0.5 + 1e-12);  // on a rail the model is exact
    CHECK(furthest > 0.5 - 1e-6);
    // Speeds up with A and brakes with 0.8 A: v^2/2 (1/A + 1/(0.8 A)) is the way.
    CHECK(speed > 0.98 * std::sqrt(2 * 0.5 / (1.0 / 20 + 1.0 / 16)));
  }
}

TEST_CASE("a joint at its limit comes back as soon as the effort says so") {
  Model<1> robot = support::slider();
  CommandLimits<1> limits;
  limits.upper[0] = 0.5;
  limits.deceleration[0] = 10;
  support::ByHand<Limited<Model<1>, Bypass<Model<1>>>> controller(robot, limits,
                                                                  Bypass<Model<1>>(robot));
  JointState<1> state;
  state.position[0] = 0.5;
  controller.start(state);
  JointReference<1> reference;
  reference.effort[0] = 50;
  CHECK(controller.update(state, reference, dt).effort[0] == Approx(0).margin(1e-12));
  CHECK(controller.report()[0].position);
  CHECK(controller.report()[0].asked == 50);
  reference.effort[0] = -50;
  CHECK(controller.update(state, reference, dt).effort[0] == -50);
  CHECK_FALSE(controller.report()[0].any());
  state.position[0] = 0.7;  // pushed beyond it
  CHECK(controller.update(state, reference, dt).effort[0] == -50);
  reference.effort[0] = 50;
  CHECK(controller.update(state, reference, dt).effort[0] == Approx(0).margin(1e-12));
}

TEST_CASE("far from all limits efforts pass to the last bit") {
  constexpr unsigned seed = 24;
  CAPTURE(seed);
  support::Random random(seed);
  using support::TiltedQ2d;
  CommandLimits<2> limits = command_limits(TiltedQ2d());
  limits.deceleration = {1, 1};
  support::ByHand<LimitedBypass<TiltedQ2d>> controller(limits);
  JointState<2> state;
  for (int k = 0; k < 1000; ++k) {
    state.position = random.vector<2>(0.5);
    state.velocity = random.vector<2>(0.1);
    JointReference<2> reference;
    reference.effort = random.vector<2>(10);
    controller.start(state);
    CHECK(controller.update(state, reference, dt).effort == reference.effort);
    CHECK_FALSE(controller.report()[0].any());
    CHECK_FALSE(controller.report()[1].any());
  }
}

TEST_CASE("the limit of effort holds for the total, also where braking would take more") {
  constexpr unsigned seed = 25;
  CAPTURE(seed);
  support::Random random(seed);
  CommandLimits<2> limits = command_limits(support::TiltedQ2d());
  limits.effort = {5, 3};
  limits.acceleration = {30, 60};
  support::ByHand<LimitedPid<support::TiltedQ2d>> controller(limits);
  for (int k = 0; k < 2000; ++k) {
    JointState<2> state;
    state.position = random.vector<2>(2);
    state.velocity = random.vector<2>(10);
    JointReference<2> reference;
    reference.position = random.vector<2>(3);
    reference.effort = random.vector<2>(100);
    if (random.one_in(10)) controller.start(state);
    const JointVector<2> effort = controller.update(state, reference, dt).effort;
    CHECK(std::abs(effort[0]) <= 5);
    CHECK(std::abs(effort[1]) <= 3);
    for (std::size_t j = 0; j < 2; ++j) {
      CHECK(controller.report()[j].limited == effort[static_cast<int>(j)]);
    }
  }
}

TEST_CASE("efforts change no faster than asked for") {
  CommandLimits<2> limits = command_limits(Q2d());
  limits.deceleration = {50, 50};
  limits.effort_rate = {1000, 500};
  Loop<Simulator<Q2d>, LimitedPid> loop{LimitedPid<Q2d>(limits)};
  JointVector<2> last = JointVector<2>::Zero();
  for (int k = 0; k < 2000; ++k) {
    loop.reference().position = k % 400 < 200 ? JointVector<2>(1, -1) : JointVector<2>(-1, 1);
    REQUIRE(loop.update() == Status::ok);
    const JointVector<2> change = loop.command().effort - last;
    REQUIRE(std::abs(change[0]) <= 1 + 1e-12);
    REQUIRE(std::abs(change[1]) <= 0.5 + 1e-12);
    last = loop.command().effort;
    if (k == 0) CHECK(loop.controller().report()[0].effort_rate);
  }
}

TEST_CASE("after a start efforts change no faster than asked for from what was given last") {
  const Model<1> robot = support::slider();
  CommandLimits<1> limits;
  limits.effort[0] = 20;
  limits.effort_rate[0] = 1000;
  support::ByHand<Limited<Model<1>, Bypass<Model<1>>>> controller(robot, limits,
                                                                  Bypass<Model<1>>(robot));
  const JointVector<1> last(7.0);
  JointReference<1> reference;
  reference.effort[0] = 10;
  const JointState<1> state;  // no effort is measured
  for (const Held held : {Held::unsure, Held::push, Held::load}) {
    controller.start(state, reference, {last, held});
    CHECK(controller.update(state, reference, dt).effort[0] == 8);
    controller.cut_off(JointVector<1>(4.0));
    CHECK(controller.update(state, reference, dt).effort[0] == 5);
    controller.start(state);
    CHECK(controller.update(state, reference, dt).effort[0] == 1);  // from what is measured
  }
}

TEST_CASE("where efforts change slowly, a jerk that they can follow lets joints brake in time") {
  for (const bool jerk : {false, true}) {
    const Model<1> robot = support::slider();  // 2 kg
    CommandLimits<1> limits;
    limits.upper[0] = 1;
    limits.velocity[0] = 1;
    limits.acceleration[0] = 10;
    limits.effort[0] = 100;
    limits.effort_rate[0] = 1000;
    if (jerk) limits.jerk[0] = 1000.0 / 2;
    support::ByHand<Limited<Model<1>, Bypass<Model<1>>>> controller(robot, limits,
                                                                    Bypass<Model<1>>(robot));
    Simulator<Model<1>> simulator(robot);
    JointState<1> state;
    JointReference<1> reference;
    reference.effort[0] = 100;
    static_cast<void>(simulator.read(state));
    controller.start(state);
    double furthest = 0;
    for (int k = 0; k < 4000; ++k) {
      static_cast<void>(simulator.read(state));
      furthest = std::max(furthest, state.position[0]);
      static_cast<void>(simulator.write(controller.update(state, reference, dt)));
    }
    CAPTURE(jerk, furthest);
    // The effort's rate is the jerk, but comes last: it cuts off what the stop in hand counts on by
    // rounding.
    if (jerk) CHECK(furthest <= 1 + 1e-6);
    if (!jerk) CHECK(furthest > 1.001);  // as stated
    CHECK(state.position[0] > 0.99);
  }
}

TEST_CASE("a feedback comes to rest if the jerk limit is twice A p/d, and may not far below it") {
  const auto ends_at_rest = [](double w, double damping, double acceleration, double factor) {
    const Model<1> robot = support::slider();  // 2 kg
    const PidGains gains{.proportional = 2 * w * w, .derivative = 2 * 2 * damping * w};
    CommandLimits<1> limits;
    limits.acceleration[0] = acceleration;
    limits.jerk[0] = factor * acceleration * gains.proportional / gains.derivative;
    support::ByHand<Limited<Model<1>, PidPlusGravity<Model<1>>>> controller(
        robot, limits, PidPlusGravity<Model<1>>(robot, {gains}));
    Simulator<Model<1>> simulator(robot);
    JointState<1> state;
    JointReference<1> reference;
    reference.position[0] = 10 * acceleration / (w * w);  // ten times what A allows to ask for
    static_cast<void>(simulator.read(state));
    controller.start(state);
    for (int k = 0; k < 4000; ++k) {
      static_cast<void>(simulator.read(state));
      static_cast<void>(simulator.write(controller.update(state, reference, dt)));
    }
    return std::abs(state.position[0] / reference.position[0] - 1) < 0.01;
  };
  constexpr unsigned seed = 27;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 10; ++k) {
    const double w = random.number(15, 80), damping = random.number(0.5, 1.5);
    const double acceleration = std::pow(10, random.number(0, 2));
    CAPTURE(k, w, damping, acceleration);
    CHECK(ends_at_rest(w, damping, acceleration, 2));
  }
  CHECK_FALSE(ends_at_rest(40, 1, 3, 0.3));
}

TEST_CASE("the integral of a limited PID does not wind up") {
  CommandLimits<2> limits = limits_of<Q2d>(20);
  limits.lower.setConstant(-0.5);
  limits.upper.setConstant(0.5);
  Loop<Simulator<Q2d>, LimitedPid> loop{LimitedPid<Q2d>(limits)};
  loop.reference() = far_away();
  for (int k = 0; k < 3000; ++k) REQUIRE(loop.update() == Status::ok);
  CHECK((loop.state().position.cwiseAbs() - JointVector<2>(0.5, 0.5)).cwiseAbs().maxCoeff() < 1e-3);
  const auto& law = loop.controller().controller().part<PidLaw<2>>();
  for (int j = 0; j < 2; ++j) {
    // No more than one step, which the next cycle takes back.
    const double error = loop.reference().position[j] - loop.state().position[j];
    const double step = law.gains()[static_cast<std::size_t>(j)].integral * error * loop.period();
    CHECK(std::abs(law.integral()[j]) <= std::abs(step) * (1 + 1e-12));
  }
  // And the way back is open at once.
  loop.reference().position = {0, 0};
  for (int k = 0; k < 200; ++k) REQUIRE(loop.update() == Status::ok);
  CHECK(loop.state().position.cwiseAbs().maxCoeff() < 0.35);
}

TEST_CASE("a wrong number brakes the joints, and never passes") {
  for (const double wrong : {not_a_number, infinity, -infinity, 1e308}) {
    CAPTURE(wrong);
    const CommandLimits<2> limits = limits_of<support::TiltedQ2d>(20);
    support::ByHand<LimitedBypass<support::TiltedQ2d>> controller(limits);
    Simulator<support::TiltedQ2d> simulator(
        SimulatorOptions<2>{.initial_velocity = JointVector<2>(0.5, -0.5)});
    JointState<2> state;
    static_cast<void>(simulator.read(state));
    controller.start(state);
    JointReference<2> reference;
    reference.effort[1] = wrong;
    for (int k = 0; k < 200; ++k) {
      static_cast<void>(simulator.read(state));
      const auto command = controller.update(state, reference, dt);
      REQUIRE(is_finite(command));
      REQUIRE(simulator.write(command) == Status::ok);
    }
    if (std::isnan(wrong)) {  // Bypass cuts off what is too much
      CHECK(controller.report()[0].non_finite);
      CHECK(state.velocity.cwiseAbs().maxCoeff() < 1e-6);  // at rest, held against gravity
    }
    for (auto member :
         {&JointState<2>::position, &JointState<2>::velocity, &JointState<2>::effort}) {
      JointState<2> wild = state;
      (wild.*member)[0] = is_finite(wrong) ? wrong : support::largest;
      CHECK(is_finite(controller.update(wild, {}, dt)));
      CHECK(is_finite(controller.update(state, {}, dt)));
      controller.start(wild);
      CHECK(is_finite(controller.update(wild, {}, dt)));
    }
  }
}

TEST_CASE("efforts of a joint with position limits need to know how it brakes") {
  CHECK_THROWS_WITH(LimitedPid<Q2d>(command_limits(Q2d())),
                    Catch::Matchers::Contains("'shoulder_active_joint'") &&
                        Catch::Matchers::Contains("positions are limited (-1.5708 .. 1.5708)") &&
                        Catch::Matchers::Contains("set CommandLimits::acceleration"));
  CommandLimits<2> limits = command_limits(Q2d());
  limits.acceleration[0] = 20;
  CHECK_THROWS_WITH(LimitedPid<Q2d>(limits), Catch::Matchers::Contains("'elbow_active_joint'"));
  limits.deceleration[1] = 20;
  CHECK_NOTHROW(LimitedPid<Q2d>(limits));
}

TEST_CASE("multi-mode: the drives' springs keep the limit of the total") {
  constexpr unsigned seed = 26;
  CAPTURE(seed);
  support::Random random(seed);
  using R = support::TiltedQ2d;
  const CommandLimits<2> limits = limits_of<R>(100);
  for (int k = 0; k < 2000; ++k) {
    CAPTURE(k);
    const ImpedanceGains g{random.number(0, 1e4), random.number(0, 100)};
    support::ByHand<LimitedImpedance<R>> controller(limits, DriveImpedance<R>({g, g}));
    JointState<2> state;
    state.position = random.vector<2>(1.5);
    state.velocity = random.vector<2>(2);
    JointReference<2> reference;
    reference.position = random.vector<2>(2);
    reference.velocity = random.vector<2>(3);
    reference.effort = random.vector<2>(20);
    controller.start(state);
    const auto c = controller.update(state, reference, dt);
    for (int j = 0; j < 2; ++j) {
      const double total = c.stiffness[j] * (c.position[j] - state.position[j]) +
                           c.damping[j] * (c.velocity[j] - state.velocity[j]) + c.effort[j];
      CHECK(std::abs(total) <= limits.effort[j] * (1 + 1e-9));
      CHECK(total == Approx(controller.report()[static_cast<std::size_t>(j)].limited).margin(1e-9));
      CHECK(std::abs(c.effort[j]) <= limits.effort[j] * (1 + 1e-9));
      CHECK(c.stiffness[j] == g.stiffness);
      CHECK(c.damping[j] == g.damping);
    }
  }
}

TEST_CASE("multi-mode: what the drives' springs and dampers do within a cycle is foreseen") {
  const Model<1> robot = support::slider();  // 2 kg
  CommandLimits<1> limits;
  limits.velocity[0] = 0.4;
  limits.acceleration[0] = 1;
  limits.effort[0] = 100;
  const ImpedanceGains gains{.stiffness = 5000, .damping = 500};
  support::ByHand<LimitedImpedance<Model<1>>> controller(robot, limits,
                                                         DriveImpedance<Model<1>>(robot, {gains}));
  Simulator<Model<1>> simulator(robot);
  JointState<1> state;
  JointReference<1> reference;
  reference.position[0] = 0.5;
  static_cast<void>(simulator.read(state));
  controller.start(state);
  double hardest = 0, last = 0;
  for (int k = 0; k < 3000; ++k) {
    static_cast<void>(simulator.write(controller.update(state, reference, dt)));
    static_cast<void>(simulator.read(state));
    hardest = std::max(hardest, std::abs(state.velocity[0] - last) / dt);
    last = state.velocity[0];
  }
  CHECK(state.position[0] == Approx(0.5).epsilon(1e-3));
  // The acceleration is not quite constant within a cycle: (D dt/m)^2/12 is 0.005; it would be 0.13
  // more.
  CHECK(hardest <= 1.02);
}

TEST_CASE("multi-mode: what is within the limits passes, what is no number brakes") {
  using R = support::TiltedQ2d;
  CommandLimits<2> limits = command_limits(R());
  limits.deceleration = {50, 50};
  support::ByHand<LimitedImpedance<R>> controller(limits, DriveImpedance<R>({{{10, 1}, {10, 1}}}));
  JointState<2> state;
  JointReference<2> reference;
  reference.position = {0.1, -0.1};
  controller.start(state);
  auto c = controller.update(state, reference, dt);
  CHECK(c.position == reference.position);
  CHECK(c.effort == gravity(R(), state.position));
  CHECK_FALSE(controller.report()[0].any());
  reference.velocity[1] = not_a_number;
  c = controller.update(state, reference, dt);
  CHECK(is_finite(c));
  CHECK(c.stiffness == JointVector<2>(0, 0));
  CHECK(controller.report()[0].non_finite);
}

TEST_CASE("multi-mode: a negative spring or damper does not pass, and is reported") {
  const Model<1> robot = support::slider();
  CommandLimits<1> limits;
  limits.acceleration[0] = 1000;
  limits.effort[0] = 100;
  for (const double position : {1.0, 0.0}) {  // also where it pulls nothing
    for (const bool spring : {true, false}) {
      CAPTURE(position, spring);
      support::ByHand<Limited<Model<1>, AnySprings<Model<1>>>> controller(robot, limits, {});
      MultiModeCommand<1>& asked = controller.controller().command;
      asked.stiffness[0] = spring ? -10 : 10;
      asked.damping[0] = spring ? 1 : -1;
      asked.position[0] = asked.velocity[0] = position;
      controller.start({});
      const MultiModeCommand<1> given = controller.update({}, {}, dt);
      CHECK(given.stiffness[0] == (spring ? 0 : 10));
      CHECK(given.damping[0] == (spring ? 1 : 0));
      const JointLimitReport& report = controller.report()[0];
      CHECK(report.stiffness == spring);
      CHECK(report.damping == !spring);
      CHECK(report.any());
      asked.stiffness[0] = asked.damping[0] = 0;
      static_cast<void>(controller.update({}, {}, dt));
      CHECK_FALSE(controller.report()[0].any());
    }
  }
}
