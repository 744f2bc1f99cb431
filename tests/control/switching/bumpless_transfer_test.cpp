// SPDX-License-Identifier: Apache-2.0
// Whatever controllers follow each other, and however fast: a switch changes no joint's command by
// more than slew * period in a cycle, and integrals begin with the load.
#include <articula/control/bypass.hpp>
#include <articula/control/computed_torque.hpp>
#include <articula/control/drive_impedance.hpp>
#include <articula/control/forward_position.hpp>
#include <articula/control/forward_velocity.hpp>
#include <articula/control/joint_impedance.hpp>
#include <articula/control/laws/on_joints.hpp>
#include <articula/control/pid.hpp>
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/control/position_by_velocity.hpp>
#include <articula/control/safety/standby.hpp>
#include <articula/control/switching/switch.hpp>
#include <articula/loop/loop.hpp>
#include <articula/robots/q2d.hpp>

#include <array>
#include <cmath>
#include <string_view>

#include "by_hand.hpp"
#include "catch.hpp"
#include "hardware/fake_hardware.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using support::not_a_number;
using Arm = support::TiltedQ2d;

namespace {

using Vector = JointVector<2>;
using State = JointState<2>;
using Reference = JointReference<2>;
constexpr double dt = 1e-3;

/// A controller whose own commands can be looked up, and which can be made to fail.
template <class C>
struct Watched : C {
  using C::C;
  using Command = CommandOf<C, 2>;

  Command own{};
  int starts = 0;
  bool fails = false;

  void start(const ControlInput<2>& in) noexcept {
    ++starts;
    start_controller<C, 2>(*this, in);
  }
  Command update(const ControlInput<2>& in) noexcept {
    own = C::update(in);
    if (fails) own.*first_member() = Vector::Constant(not_a_number);
    return own;
  }

 private:
  static constexpr auto first_member() noexcept {
    if constexpr (requires(Command c) { c.effort; }) {
      return &Command::effort;
    } else if constexpr (requires(Command c) { c.velocity; }) {
      return &Command::velocity;
    } else {
      return &Command::position;
    }
  }
};

/// What a law begins with of a command, in its start.
Vector primed(PidLaw<2>& law, const Vector& last, Held held = Held::push) {
  return law.start({{}, {}, dt, {last, held}});
}

/// The number of a command that must not jump.
Vector number(const EffortCommand<2>& c, const State&) { return c.effort; }
Vector number(const VelocityCommand<2>& c, const State&) { return c.velocity; }
Vector number(const PositionCommand<2>& c, const State&) { return c.position; }
Vector number(const MultiModeCommand<2>& c, const State& state) {
  return c.stiffness.cwiseProduct(c.position - state.position) +
         c.damping.cwiseProduct(c.velocity - state.velocity) + c.effort;
}

PidGains random_gains(support::Random& random) {
  PidGains g{.proportional = std::pow(10, random.number(-1, 4)),
             .integral = random.one_in(4) ? 0 : std::pow(10, random.number(-2, 4)),
             .derivative = random.number(0, 10)};
  if (random.one_in(2)) g.integral_clamp_max = -(g.integral_clamp_min = -random.number(0, 30));
  if (random.one_in(4)) g.output_clamp_max = random.number(0, 20);
  if (random.one_in(4)) g.derivative_of = DerivativeOf::error;
  if (random.one_in(4)) g.derivative_filter_time = 0.01;
  if (random.one_in(4)) g.anti_windup = AntiWindup::back_calculation;
  if (random.one_in(4)) g.velocity_feedforward = random.number(-5, 5);
  return g;
}

JointPidGains<2> random_pair(support::Random& random) {
  const PidGains g = random_gains(random);
  return {g, random_gains(random)};
}

/// Switches at random under references and states that jump at random, and checks every step.
template <class Controllers>
void check_steps(Controllers controllers, support::Random& random, double size) {
  constexpr std::size_t count = Controllers::controller_count;
  const auto range = detail::command_range<typename Controllers::Command>(Arm());
  const Vector step = controllers.slew() * dt;
  State state;
  Reference reference;
  controllers.start(state);
  // What the standby wants: a constant, but for efforts.
  Standby<Arm, typename Controllers::Command> standby;
  const auto standby_own = [&](const State& now) {
    return number(standby.update({now, {}, dt}), now);
  };
  Vector own_before, given_before;
  int starts_before = 0;
  int switches = 0, decays = 0, failures = 0;
  for (int cycle = 0; cycle < 4000; ++cycle) {
    CAPTURE(cycle);
    if (random.one_in(30)) reference.position = random.vector<2>(size);
    if (random.one_in(30)) reference.velocity = random.vector<2>(size);
    if (random.one_in(30)) reference.effort = random.vector<2>(10 * size);
    if (random.one_in(30)) reference.acceleration = random.vector<2>(10 * size);
    if (random.one_in(30)) state.position = random.vector<2>(size);
    if (random.one_in(30)) state.velocity = random.vector<2>(size);

    // Often in the middle of a decay, sometimes after it.
    if (random.one_in(cycle % 1000 < 800 ? 20 : 200)) {
      const auto which = static_cast<std::size_t>(random.integer(0, count - 1));
      const Name name = controllers.name_of(which);
      if (random.one_in(4)) {
        static_cast<void>(controllers.request({.stop = {controllers.active()}}));
      } else {
        static_cast<void>(controllers.request({.start = {name}, .replace = true}));
      }
    }
    const bool fails = random.one_in(40);
    failures += fails ? 1 : 0;
    const Name active_before = controllers.active();
    controllers.template member<0>().fails = fails;
    const auto command = controllers.update(state, reference, dt);
    REQUIRE(is_finite(command));  // all others are fallbacks of the first

    int starts = 0;
    Vector own = standby_own(state);
    const auto look = [&](auto& member, std::size_t i) {
      starts += member.starts;
      if (controllers.list()[i].status != ControllerStatus::active) return;
      own = number(member.own, state);
      for (int j = 0; j < 2; ++j) own[j] = range.clamp(own[j], j);
    };
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (look(controllers.template member<I>(), I), ...);
    }(std::make_index_sequence<count>());
    const Vector given = number(command, state);
    const bool took_over = starts != starts_before || controllers.active() != active_before;
    if (cycle > 0) {
      for (int j = 0; j < 2; ++j) {
        CAPTURE(j, own[j], given[j], given_before[j]);
        const double change = std::abs(given[j] - given_before[j]);
        const double rounding = 1e-12 * (1 + std::abs(own[j]));
        if (took_over) {
          REQUIRE(change <= rounding);
        } else {
          REQUIRE(change <= std::abs(own[j] - own_before[j]) + step[j] + rounding);
        }
        REQUIRE(given[j] >= range.lowest[j] - rounding);
        REQUIRE(given[j] <= range.highest[j] + rounding);
      }
      switches += took_over ? 1 : 0;
      decays += !took_over && !controllers.carried().isZero(0) ? 1 : 0;
    }
    own_before = own;
    given_before = given;
    starts_before = starts;
  }
  CHECK(switches > 50);
  CHECK(decays > 100);
  CHECK(failures > 50);
}

}  // namespace

TEST_CASE("effort: no switch, start, stop or fallback makes a step beyond what is stated") {
  constexpr unsigned seed = 61;
  CAPTURE(seed);
  support::Random random(seed);
  using C = support::ByHand<
      Switch<Arm, Watched<PidPlusGravity<Arm>>, Watched<Pid<Arm>>, Watched<Bypass<Arm>>,
             Watched<ComputedTorque<Arm>>, Watched<JointImpedance<Arm>>>>;
  for (int k = 0; k < 12; ++k) {
    CAPTURE(k);
    SwitchOptions<2> options{.fallbacks = {{"pid_plus_gravity", {"pid"}}}};
    if (k % 2 == 1) options.slew = random.vector<2>(1).cwiseAbs() * 1000 + Vector(1, 1);
    const ImpedanceGains spring{.stiffness = random.number(0, 100), .damping = random.number(0, 9)};
    check_steps(C(options, Watched<PidPlusGravity<Arm>>(random_pair(random)),
                  Watched<Pid<Arm>>(random_pair(random)), {},
                  Watched<ComputedTorque<Arm>>(random_pair(random)),
                  Watched<JointImpedance<Arm>>({spring, spring})),
                random, k < 6 ? 0.02 : 1);
  }
}

TEST_CASE("velocity, position and springs in the drives: likewise") {
  constexpr unsigned seed = 62;
  CAPTURE(seed);
  support::Random random(seed);
  const auto spring = [&] {
    return ImpedanceGains{.stiffness = random.number(0, 100), .damping = random.number(0, 10)};
  };
  using Velocities =
      support::ByHand<Switch<Arm, Watched<ForwardVelocity<Arm>>, Watched<PositionByVelocity<Arm>>>>;
  using Positions =
      support::ByHand<Switch<Arm, Watched<ForwardPosition<Arm>>, Watched<ForwardPosition<Arm>>>>;
  using Spring = Watched<DriveImpedance<Arm>>;
  using Springs = support::ByHand<Switch<Arm, Spring, Spring, Spring>>;
  for (int k = 0; k < 6; ++k) {
    CAPTURE(k);
    check_steps(Velocities({.fallbacks = {{"forward_velocity", {"position_by_velocity"}}}}, {},
                           Watched<PositionByVelocity<Arm>>(random_pair(random))),
                random, 1);
    check_steps(Positions({.fallbacks = {{"forward_position", {"forward_position_2"}}}}), random,
                1);
  }
  for (int k = 0; k < 6; ++k) {
    CAPTURE(k);
    Springs springs({.fallbacks = {{"drive_impedance", {"drive_impedance_2"}}}},
                    Spring({spring(), spring()}), Spring({spring(), spring()}),
                    Spring({spring(), spring()}));
    springs.start({});
    // What the drives themselves would cut off is theirs: the total is looked at within the limits.
    const Vector limit = effort_limits(Arm()), step = springs.slew() * dt;
    State state;
    Reference reference;
    Vector before = Vector::Zero();
    for (int cycle = 0; cycle < 3000; ++cycle) {
      CAPTURE(cycle);
      const bool jumps = random.one_in(20);
      if (jumps) reference.position = random.vector<2>(1);
      if (jumps) state.velocity = random.vector<2>(1);
      const bool switches = !jumps && random.one_in(10);
      if (switches) {
        const Name name = springs.name_of(static_cast<std::size_t>(random.integer(0, 2)));
        static_cast<void>(random.one_in(3) ? springs.request({.stop = {springs.active()}})
                                           : springs.request({.start = {name}, .replace = true}));
      }
      springs.member<0>().fails = random.one_in(30);
      const auto command = springs.update(state, reference, dt);
      REQUIRE(is_finite(command));
      REQUIRE((command.effort.cwiseAbs() - limit).maxCoeff() <= 1e-12);
      const Vector total = number(command, state).cwiseMax(-limit).cwiseMin(limit);
      // In between nothing moves, so that all that changes is by the switch.
      if (cycle > 0 && !jumps) {
        REQUIRE(((total - before).cwiseAbs() - step).maxCoeff() <= 1e-12);
      }
      before = total;
    }
  }
}

TEST_CASE("a difference is gone after a while, and then commands pass to the last bit") {
  using C = support::ByHand<Switch<Arm, Bypass<Arm>, Pid<Arm>>>;
  C controllers({.slew = Vector(100, 50)});
  Pid<Arm> alone;
  Reference reference;
  reference.effort = {10, 10};
  controllers.start({});
  CHECK(controllers.update({}, reference, dt).effort == Vector(10, 10));
  JointPidGains<2> gains{};  // the spring alone
  gains[0].proportional = gains[1].proportional = 8;
  controllers.member<1>() = Pid<Arm>(gains);
  alone = Pid<Arm>(gains);
  CHECK(controllers.request({.stop = {"bypass"}, .start = {"pid"}}).answer == SwitchAnswer::done);
  reference.effort = {0, 0};
  reference.position = {1, 1};
  for (int k = 0; k < 10; ++k) {
    const Vector given = controllers.update({}, reference, dt).effort;
    CHECK((given - Vector(10 - 0.1 * k, 10 - 0.05 * k)).norm() < 1e-12);
  }
  for (int k = 0; k < 40; ++k) static_cast<void>(controllers.update({}, reference, dt));
  CHECK(controllers.carried().isZero(0));
  reference.position = {0.123456789, -0.987654321};
  CHECK(controllers.update({}, reference, dt).effort == alone.update({{}, reference, dt}).effort);
}

TEST_CASE("in a period of 0 nothing decays; a loop has none, nor one that is no number") {
  using C = support::ByHand<Switch<Arm, Bypass<Arm>, Bypass<Arm>>>;
  for (const double bad : {0.0, -1.0, not_a_number, support::infinity}) {
    C controllers;
    CHECK_THROWS_WITH((Loop{support::FakeHardware<Arm>(), Bypass<Arm>(), bad}),
                      Catch::Matchers::Contains("is not a positive number"));
    if (bad != 0) continue;
    Reference reference;
    reference.effort = {10, 10};
    controllers.start({});
    static_cast<void>(controllers.update({}, reference, dt));
    reference.effort = {5, 5};
    CHECK(controllers.request({.start = {"bypass_2"}, .replace = true}).answer ==
          SwitchAnswer::done);
    for (int k = 0; k < 3; ++k) {
      CHECK(controllers.update({}, reference, bad).effort == Vector(10, 10));
    }
  }
}

TEST_CASE("huge numbers are carried without an overflow") {
  const Model<2> arm = support::free_arm<Arm>();  // without limits
  using C = support::ByHand<Switch<Model<2>, Bypass<Model<2>>, Bypass<Model<2>>>>;
  C controllers(arm, {.slew = Vector(1, 1)}, Bypass<Model<2>>(arm), Bypass<Model<2>>(arm));
  Reference reference;
  controllers.start({});
  for (const double huge : {support::largest, -support::largest, 1e300, support::smallest, 0.0}) {
    reference.effort.setConstant(huge);
    CHECK(controllers
              .request({.start = {controllers.active() == "bypass" ? "bypass_2" : "bypass"},
                        .replace = true})
              .answer == SwitchAnswer::done);
    CHECK(is_finite(controllers.update({}, reference, dt)));
    CHECK(is_finite(controllers.update({}, reference, dt)));
  }
}

TEST_CASE("what was cut off afterwards counts: it is gone on from what was given") {
  using C = support::ByHand<Switch<Arm, Bypass<Arm>, Bypass<Arm>>>;
  C controllers;
  Reference reference;
  reference.effort = {10, -10};
  controllers.start({});
  static_cast<void>(controllers.update({}, reference, dt));
  controllers.cut_off(Vector(4, -3));
  controllers.cut_off(Vector(1, 0));  // by one limit after the other
  CHECK(controllers.request({.start = {"bypass_2"}, .replace = true}).answer == SwitchAnswer::done);
  CHECK(controllers.update({}, reference, dt).effort == Vector(5, -7));
}

TEST_CASE("an integral begins with the load, so that a held arm stays where it is") {
  // Without gravity compensation the integral is what carries the arm.
  using C = support::ByHand<Switch<Arm, JointImpedance<Arm>, Pid<Arm>>>;
  const Vector place(0.5, -0.4);
  const Vector weight = gravity(Arm(), place);
  REQUIRE(weight.norm() > 1);
  C controllers({}, JointImpedance<Arm>({{{100, 10}, {100, 10}}}), Pid<Arm>());
  State state;
  Reference reference;
  state.position = reference.position = place;
  controllers.start(state);
  CHECK(controllers.update(state, reference, dt).effort == weight);
  CHECK(controllers.request({.start = {"pid"}, .replace = true}).answer == SwitchAnswer::done);
  CHECK((controllers.update(state, reference, dt).effort - weight).norm() < 1e-12);
  CHECK((controllers.member<1>().part<PidLaw<2>>().integral() - weight).norm() < 1e-12);
  CHECK(controllers.carried().isZero(1e-12));
  CHECK((controllers.update(state, reference, dt).effort - weight).norm() < 1e-12);
}

TEST_CASE(
    "an integral takes over no more than its clamps allow, and nothing it could not give back") {
  JointPidGains<2> gains{
      PidGains{.integral = 100, .integral_clamp_min = -2, .integral_clamp_max = 3},
      PidGains{.proportional = 5}};
  PidLaw<2> law(gains, joint_names(Arm()));
  CHECK(primed(law, Vector(10, 10)) == Vector(3, 0));
  CHECK(primed(law, Vector(-10, -10)) == Vector(-2, 0));
  CHECK(primed(law, Vector(1, 1)) == Vector(1, 0));
  for (const double bad : {not_a_number, support::infinity}) {
    CHECK(primed(law, Vector(bad, bad)) == Vector(0, 0));
  }
  CHECK(primed(law, Vector(1, 1)) == Vector(1, 0));
  // Anti-windup takes back a step, not what it began with.
  static_cast<void>(law.output({{}, {}, dt, {}, Vector(1, 1)}));
  CHECK(law.integral() == Vector(1, 0));
  for (const Held held : {Held::nothing, Held::unsure}) {
    CHECK(primed(law, Vector(1, 1), held) == Vector(0, 0));
    CHECK(law.integral() == Vector(0, 0));
  }
}

TEST_CASE("an integral that could not take back soon what was no load begins with 0") {
  // The error that a wrong load makes is gone as exp(-t i/p).
  PidLaw<2> law({PidGains{.proportional = 1000, .integral = 100},
                 PidGains{.proportional = 1000, .integral = 99.9}},
                joint_names(Arm()));
  CHECK(primed(law, Vector(5, -5)) == Vector(5, 0));
  CHECK(law.integral() == Vector(5, 0));
  const PidGains alone{.integral = 1e-6};  // no p that it would have to outgrow
  PidLaw<2> slow({alone, alone}, joint_names(Arm()));
  CHECK(primed(slow, Vector(5, -5)) == Vector(5, -5));
  // A load is taken over, however slow the integral is.
  CHECK(primed(law, Vector(5, -5), Held::load) == Vector(5, -5));
}

namespace {

/// A law that remembers, and cannot be primed: it asks for one more each time.
struct Climbing {
  double effort_now = 0;

  void start(const ControlInput<2>&) noexcept { effort_now = 0; }
  Vector output(const ControlInput<2>&) noexcept { return Vector::Constant(++effort_now); }
};

}  // namespace

TEST_CASE("laws that are asked what they leave to an integral start as if they had not been") {
  JointPidGains<2> gains{};
  gains[0].integral = gains[1].integral = 10;
  EffortController<Arm, Climbing, PidLaw<2>> sum(Arm(), {}, PidLaw<2>(gains, joint_names(Arm())));
  sum.start({{}, {}, dt, {Vector(5, 5), Held::push}});
  CHECK(sum.part<PidLaw<2>>().integral() == Vector(4, 4));
  CHECK(sum.update({{}, {}, dt}).effort == Vector(5, 5));
  CHECK(sum.update({{}, {}, dt}).effort == Vector(6, 6));
}

TEST_CASE("in a sum the integral takes what the other laws leave, each joint by its own law") {
  JointPidGains<2> gains{};
  gains[0].integral = gains[1].integral = 10;
  gains[0].velocity_feedforward = 2;
  State state;
  state.position = {0.5, -0.4};
  state.velocity = {0.1, 0.2};
  Reference reference;
  reference.position = {0.6, -0.5};
  reference.velocity = {0.5, 0.25};
  reference.effort = {0.5, 0.25};
  const Vector last(6, 3), weight = gravity(Arm(), state.position);
  const Applied<2> applied{last, Held::push};

  PidPlusGravity<Arm> sum(gains);
  sum.start({state, reference, dt, applied});
  const Vector expected = last - weight - reference.effort - Vector(2 * 0.5, 0);
  CHECK((sum.part<PidLaw<2>>().integral() - expected).norm() < 1e-12);

  using Law = OnJoints<2, PidLaw<2>>;
  const std::array<std::string_view, 1> shoulder{"shoulder_active_joint"},
      elbow{"elbow_active_joint"};
  const PidLaw<2> law(gains, joint_names(Arm()));
  Law of_shoulder(Arm(), law, shoulder), of_elbow(Arm(), law, elbow);
  CHECK((of_shoulder.start({state, reference, dt, applied}) - Vector(last[0], 0)).norm() < 1e-12);
  EffortController<Arm, Law, Law> parts(Arm(), of_shoulder, of_elbow);
  parts.start({state, reference, dt, applied});
  // Without errors the next command is what it begins with.
  Reference here;
  here.position = state.position;
  here.velocity = reference.velocity;
  State at_speed = state;
  at_speed.velocity = reference.velocity;
  CHECK((parts.update({at_speed, here, dt}).effort - last).norm() < 1e-12);

  // The integral of computed torque is an acceleration: M I + h + what reference and friction ask.
  gains[0].velocity_feedforward = 0;
  ComputedTorque<Arm> computed(gains);
  computed.start({state, reference, dt, applied});
  reference.position = state.position;  // no error, so the next command is what it begins with
  CHECK((computed.update({state, reference, dt}).effort - last).norm() < 1e-12);
}
