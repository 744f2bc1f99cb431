// SPDX-License-Identifier: Apache-2.0
// Controllers that are switched, in a loop, under supervision, within limits, and in simulation.
#include <articula/articula.hpp>
#include <articula/hardware/mock/mock_hardware.hpp>
#include <articula/robots/q2d.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

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

/// Gravity compensation that breaks when it is told to.
template <class R>
struct Fragile {
  static constexpr std::string_view name = "fragile";
  bool broken = false;

  void start(const ControlInput<2>&) noexcept {}
  EffortCommand<2> update(const ControlInput<2>& in) noexcept {
    if (broken) return {Vector::Constant(not_a_number)};
    return {gravity(R(), in.state.position) + 20 * (in.reference.position - in.state.position)};
  }
};

template <class R>
using Controllers = Switch<R, Fragile<R>, PidPlusGravity<R>, ComputedTorque<R>>;
template <class R>
using Careful = Limited<R, Controllers<R>>;

Controllers<Arm> with_fallback() {
  return Controllers<Arm>({.fallbacks = {{"fragile", {"pid_plus_gravity"}}}});
}

SwitchRequest instead(const Name& name) { return {.start = {name}, .replace = true}; }

}  // namespace

TEST_CASE("in a loop a failure with a fallback is no failure") {
  Loop<Simulator<Arm>, Controllers> loop(with_fallback());
  for (int k = 0; k < 100; ++k) REQUIRE(loop.update() == Status::ok);
  const Vector before = loop.command().effort;
  loop.controller().member<0>().broken = true;
  REQUIRE(loop.update() == Status::ok);
  CHECK((loop.command().effort - before).norm() < 1e-12);
  CHECK(loop.controller().active() == "pid_plus_gravity");
  CHECK(loop.controller().list()[0].status == ControllerStatus::failed);
  loop.reference().position = {0.1, -0.1};
  for (int k = 0; k < 3000; ++k) REQUIRE(loop.update() == Status::ok);
  CHECK((loop.state().position - loop.reference().position).norm() < 1e-3);
}

TEST_CASE(
    "in a loop a failure without a fallback is the loop's, and what follows goes on smoothly") {
  Loop<Simulator<Arm>, Controllers> loop;
  for (int k = 0; k < 100; ++k) REQUIRE(loop.update() == Status::ok);
  loop.reference().position = {0.3, 0.3};
  for (int k = 0; k < 100; ++k) REQUIRE(loop.update() == Status::ok);
  loop.controller().member<0>().broken = true;
  CHECK(loop.update() == Status::non_finite_command);
  CHECK(loop.command().effort == gravity(Arm(), loop.state().position));
  const Vector safe = loop.command().effort;
  const Vector step = loop.controller().slew() * loop.period();
  SECTION("when it is good again") { loop.controller().member<0>().broken = false; }
  SECTION("when another is asked for") {
    CHECK(loop.controller().request(instead("computed_torque")).answer == SwitchAnswer::done);
  }
  REQUIRE(loop.update() == Status::ok);
  CHECK(((loop.command().effort - safe).cwiseAbs() - step).maxCoeff() < 1e-12);
}

namespace {

/// Passes the reference's effort, unless it is broken.
template <class R>
struct FragileBypass : Bypass<R> {
  bool broken = false;

  EffortCommand<2> update(const ControlInput<2>& in) noexcept {
    if (broken) return {Vector::Constant(not_a_number)};
    return Bypass<R>::update(in);
  }
};
template <class R>
using One = Switch<R, FragileBypass<R>>;
template <class R>
using Bypasses = Groups<R, FragileBypass<R>, FragileBypass<R>>;
template <class R>
using BypassAndPid = Switch<R, Bypass<R>, PidPlusGravity<R>>;

template <class R>
using OnePid = Switch<R, Pid<R>>;
template <class R>
using CarefulOnePid = Limited<R, OnePid<R>>;
template <class R>
using TwoPids = Groups<R, Pid<R>, OnePid<R>>;
template <class R>
using OneSpring = Switch<R, DriveImpedance<R>>;

CommandLimits<2> careful_limits() {
  CommandLimits<2> limits = command_limits(Arm());
  limits.acceleration = {200, 400};
  return limits;
}

TwoPids<Arm> two_pids() {
  return TwoPids<Arm>({{{"s", {"shoulder_active_joint"}}, {"e", {"elbow_active_joint"}}}}, {},
                      OnePid<Arm>());
}

template <class LoopType>
void have_no_reference(LoopType& loop, int cycles) {
  const auto kept = loop.reference();
  loop.reference().velocity[0] = not_a_number;
  for (int k = 0; k < cycles; ++k) CHECK(loop.update() == Status::non_finite_reference);
  loop.reference() = kept;
}

/// The integral carries the arm; after cycles without a reference it goes on carrying it.
template <template <class> class C>
void carries_on(C<Arm> controller) {
  Loop<Simulator<Arm>, C> loop(std::move(controller));
  loop.reference().position = {0.3, -0.7};
  for (int k = 0; k < 4000; ++k) REQUIRE(loop.update() == Status::ok);
  const Vector place = loop.state().position;
  have_no_reference(loop, 10);
  const Vector safe = loop.command().effort;
  REQUIRE(safe.cwiseAbs().minCoeff() > 0.1);
  double off = 0;
  for (int k = 0; k < 500; ++k) {
    REQUIRE(loop.update() == Status::ok);
    if (k == 0) CHECK((loop.command().effort - safe).cwiseAbs().maxCoeff() < 0.1);
    off = std::max(off, (loop.state().position - place).norm());
  }
  CHECK(off < 1e-4);  // without its load it sags by load/p = 3e-3 rad
}

}  // namespace

TEST_CASE("however many cycles were bad, a switch goes on from the command that was written") {
  for (const int bad : {1, 3, 4, 10}) {
    CAPTURE(bad);
    Loop<Simulator<Arm>, One> loop;
    loop.reference().effort = {12, 5};
    for (int k = 0; k < 5; ++k) REQUIRE(loop.update() == Status::ok);
    loop.controller().member<0>().broken = true;
    for (int k = 0; k < bad; ++k) CHECK(loop.update() == Status::non_finite_command);
    loop.controller().member<0>().broken = false;
    const Vector step = loop.controller().slew() * loop.period();
    Vector before = loop.command().effort;
    REQUIRE((before - loop.reference().effort).cwiseAbs().minCoeff() > 1);
    for (int k = 0; k < 200; ++k) {
      REQUIRE(loop.update() == Status::ok);
      REQUIRE(((loop.command().effort - before).cwiseAbs() - step).maxCoeff() < 1e-12);
      before = loop.command().effort;
    }
    CHECK(before == loop.reference().effort);
  }
}

TEST_CASE("after many cycles without a reference integrals in switches and groups carry on") {
  carries_on<Pid>(Pid<Arm>());
  carries_on<OnePid>(OnePid<Arm>());
  carries_on<CarefulOnePid>(CarefulOnePid<Arm>(careful_limits()));
  carries_on<TwoPids>(two_pids());
}

namespace {

template <class R>
using SlowBypass = Limited<R, Bypass<R>>;
template <class R>
using SwitchOfSlow = Switch<R, Limited<R, Bypass<R>>>;
template <class R>
using SlowSwitch = Limited<R, OnePid<R>>;
template <class R>
using GroupsOfSwitches = Groups<R, OnePid<R>, OnePid<R>>;
template <class R>
using GroupsOfSlow = Groups<R, Limited<R, Bypass<R>>, SwitchOfSlow<R>>;

const std::array<JointGroup, 2> both{
    {{"s", {"shoulder_active_joint"}}, {"e", {"elbow_active_joint"}}}};

CommandLimits<2> slow_limits() {
  CommandLimits<2> limits = careful_limits();
  limits.effort_rate = {1000, 500};  // 1 and 0.5 N m in a cycle
  return limits;
}

enum class Wrong { position, velocity, reference };

/// How far the effort changes in the cycle after so many bad ones, from what was written last, and
/// from what was written before them.
struct Steps {
  Vector from_last, from_good;
};

template <template <class> class C>
Steps steps_after(C<Arm> controller, Wrong what, int cycles) {
  // Drives that measure no effort.
  Loop<support::FakeHardware<Arm>, C> loop(std::move(controller));
  loop.reference().effort = {6, 3};
  for (int k = 0; k < 50; ++k) REQUIRE(loop.update() == Status::ok);
  const Vector good = loop.command().effort;
  REQUIRE(good.cwiseAbs().minCoeff() > 2);
  auto& measured = loop.hardware().measured;
  double& number = what == Wrong::position   ? measured.position[0]
                   : what == Wrong::velocity ? measured.velocity[0]
                                             : loop.reference().velocity[0];
  number = not_a_number;
  for (int k = 0; k < cycles; ++k) REQUIRE(loop.update() != Status::ok);
  number = 0;
  const Vector last = loop.command().effort;
  REQUIRE(loop.update() == Status::ok);
  CHECK_FALSE(loop.hardware().was_given_non_finite);
  return {(loop.command().effort - last).cwiseAbs(), (loop.command().effort - good).cwiseAbs()};
}

}  // namespace

TEST_CASE("efforts that may change slowly go on from what was written, however many were bad") {
  for (const Wrong what : {Wrong::position, Wrong::velocity, Wrong::reference}) {
    for (const int bad : {1, 3, 4, 100}) {
      CAPTURE(static_cast<int>(what), bad);
      const SlowBypass<Arm> slow(slow_limits());
      const SwitchOfSlow<Arm> switched({}, slow);
      const Steps all[] = {
          steps_after<SlowBypass>(slow, what, bad), steps_after<SwitchOfSlow>(switched, what, bad),
          steps_after<GroupsOfSlow>(GroupsOfSlow<Arm>(both, slow, switched), what, bad)};
      for (const Steps& steps : all) {
        // Few without a state are borne as if nothing had been: the command that was interrupted
        // goes on. Without a reference the limits brake, and go on from there.
        const bool borne = bad <= 3 && what != Wrong::reference;
        if (borne) CHECK(steps.from_good.maxCoeff() < 1e-12);
        if (!borne) CHECK((steps.from_last - slow_limits().effort_rate * 1e-3).maxCoeff() < 1e-12);
      }
    }
  }
}

TEST_CASE("after cycles without a reference no switch within limits or groups makes a step") {
  const Vector step = OnePid<Arm>().slew() * 1e-3;
  for (const int bad : {4, 100}) {
    CAPTURE(bad);
    const Wrong what = Wrong::reference;
    const Steps all[] = {
        steps_after<CarefulOnePid>(CarefulOnePid<Arm>(careful_limits()), what, bad),
        steps_after<SlowSwitch>(SlowSwitch<Arm>(slow_limits()), what, bad),
        steps_after<GroupsOfSwitches>(GroupsOfSwitches<Arm>(both, OnePid<Arm>(), OnePid<Arm>()),
                                      what, bad)};
    for (const Steps& steps : all) CHECK((steps.from_last - step).maxCoeff() < 1e-12);
  }
}

TEST_CASE("after many cycles without a reference a switch of springs goes on from the effort") {
  using Hardware = MockHardware<Arm, MultiModeCommand<2>>;
  Loop<Hardware, OneSpring> loop(OneSpring<Arm>({}, DriveImpedance<Arm>({{{20, 1}, {20, 1}}})));
  loop.reference().position = Vector(0.5, -0.5);
  for (int k = 0; k < 5; ++k) REQUIRE(loop.update() == Status::ok);
  have_no_reference(loop, 10);
  const Vector safe = numbers_of(loop.command(), loop.state());
  REQUIRE(loop.update() == Status::ok);
  const Vector next = numbers_of(loop.command(), loop.state());
  const Vector step = loop.controller().slew() * loop.period();
  CHECK(((next - safe).cwiseAbs() - step).maxCoeff() < 1e-12);
}

TEST_CASE("a group's failure is no other's, and the loop reports it") {
  Loop<Simulator<Arm>, Bypasses> loop(Bypasses<Arm>(
      {{{"s", {"shoulder_active_joint"}}, {"e", {"elbow_active_joint"}, 10}}}, {}, {}));
  loop.reference().effort = {12, 1};
  for (int k = 0; k < 20; ++k) REQUIRE(loop.update() == Status::ok);
  loop.controller().member<1>().broken = true;
  for (int k = 0; k < 10; ++k) {
    CHECK(loop.update() == Status::non_finite_command);
    const Vector own(0, loop.state().velocity[1]);  // its motion decays in 0.1 s
    const double safe = damping_effort(Arm(), loop.state().position, own, 0.1)[1];
    CHECK((loop.command().effort - Vector(12, safe)).norm() < 1e-12);  // rounding
  }
  loop.controller().member<1>().broken = false;
  CHECK(loop.update() == Status::ok);
  CHECK(loop.command().effort == Vector(12, 1));
}

TEST_CASE("a passing push is no load: a weak integral leaves it to the transfer") {
  const PidGains weak{.proportional = 1000, .integral = 0.01, .derivative = 10};
  using C = Loop<Simulator<Arm>, BypassAndPid>;
  C loop(BypassAndPid<Arm>({}, {}, PidPlusGravity<Arm>({weak, weak})));
  loop.reference().effort = {20, 8};
  for (int k = 0; k < 60; ++k) REQUIRE(loop.update() == Status::ok);
  loop.reference() = {};
  loop.reference().position = loop.state().position;
  CHECK(loop.controller().request(instead("pid_plus_gravity")).answer == SwitchAnswer::done);
  for (int k = 0; k < 5000; ++k) REQUIRE(loop.update() == Status::ok);
  CHECK(loop.controller().carried().isZero(0));
  // 20 N m that were taken for load would be an error of 0.02 rad, for days.
  CHECK((loop.state().position - loop.reference().position).norm() < 1e-4);
}

TEST_CASE("under supervision a fallback keeps the loop active, and without one there is a fault") {
  using MockLoop = SupervisedLoop<MockHardware<Arm>, Controllers>;
  for (const bool falls_back : {true, false}) {
    CAPTURE(falls_back);
    MockLoop loop(MockHardware<Arm>(), falls_back ? with_fallback() : Controllers<Arm>(),
                  SupervisionOptions{.bad_cycles = 3});
    // A request before activation takes effect with it.
    CHECK(loop.controller().request(instead("computed_torque")).answer == SwitchAnswer::done);
    loop.request_activation();
    CHECK(loop.update() == Status::inactive);
    REQUIRE(loop.mode() == LoopMode::active);
    CHECK(loop.controller().active() == "computed_torque");
    REQUIRE(loop.update() == Status::ok);
    CHECK(loop.controller().request(instead("fragile")).answer == SwitchAnswer::done);
    REQUIRE(loop.update() == Status::ok);
    loop.controller().member<0>().broken = true;
    for (int k = 0; k < 4; ++k) {
      CHECK(loop.update() == (falls_back ? Status::ok : Status::non_finite_command));
    }
    CHECK(loop.mode() == (falls_back ? LoopMode::active : LoopMode::fault));
    if (falls_back) continue;
    CHECK(loop.fault() == Status::non_finite_command);
    // Acknowledged, and activated with another controller.
    loop.acknowledge_fault();
    CHECK(loop.update() == Status::inactive);
    CHECK(loop.controller().request(instead("pid_plus_gravity")).answer == SwitchAnswer::done);
    loop.request_activation();
    CHECK(loop.update() == Status::inactive);
    CHECK(loop.update() == Status::ok);
    CHECK(loop.controller().active() == "pid_plus_gravity");
  }
}

TEST_CASE("limits around a switch hold whatever is switched, and a failure brakes") {
  constexpr unsigned seed = 81;
  CAPTURE(seed);
  support::Random random(seed);
  CommandLimits<2> limits = command_limits(Arm());
  limits.velocity = {0.5, 0.5};
  limits.acceleration = {20, 40};
  Loop<Simulator<Arm>, Careful> loop{Careful<Arm>(limits)};
  auto& controllers = loop.controller().controller();
  const char* const names[] = {"fragile", "pid_plus_gravity", "computed_torque"};
  int failures = 0;
  for (int k = 0; k < 4000; ++k) {
    CAPTURE(k);
    if (k % 200 == 0) loop.reference().position = random.vector<2>(0.5);
    if (random.one_in(50)) {
      static_cast<void>(controllers.request(instead(names[random.integer(0, 2)])));
    }
    if (random.one_in(200)) {
      static_cast<void>(controllers.request({.stop = {controllers.active()}}));
    }
    controllers.member<0>().broken = k > 2000 && k % 100 < 3;  // there is no fallback
    // The limits brake; the status reports the failure all the same.
    const Status status = loop.update();
    const bool failed =
        controllers.active() == "fragile" && controllers.status_of(0) == ControllerStatus::failed;
    REQUIRE(status == (failed ? Status::non_finite_command : Status::ok));
    failures += failed ? 1 : 0;
    // The model is exact but for the effort being held over a period.
    REQUIRE((loop.state().velocity.cwiseAbs() - limits.velocity).maxCoeff() < 1e-3);
  }
  CHECK(failures > 5);
  GainsExchange<PidGains, 2> exchange(Arm{});
  exchange.offer(Q2d::pid_gains);
  CHECK(exchange.apply(controllers.member<PidPlusGravity<Arm>>()));
}

TEST_CASE("a limited controller can be one of those that are switched") {
  using R = Arm;
  using CarefulPid = Limited<R, PidPlusGravity<R>>;
  CommandLimits<2> limits = command_limits(R());
  limits.acceleration = {20, 40};
  using C = support::ByHand<Switch<R, JointImpedance<R>, CarefulPid>>;
  C controllers({}, JointImpedance<R>({{{100, 10}, {100, 10}}}), CarefulPid(limits));
  Simulator<R> arm;
  JointState<2> state;
  JointReference<2> reference;
  Vector before = Vector::Zero();
  for (int k = 0; k < 4000; ++k) {
    CAPTURE(k);
    REQUIRE(arm.read(state) == Status::ok);
    if (k == 0) controllers.start(state);
    if (k == 1000) {
      CHECK(controllers.request(instead("pid_plus_gravity")).answer == SwitchAnswer::done);
    }
    if (k >= 2000) reference.position = {0.2, -0.2};
    const auto command = controllers.update(state, reference, 1e-3);
    if (k >= 1000 && k < 2000) {
      // It hangs in its springs before; the difference decays, and the PID pulls it back meanwhile.
      CHECK((command.effort - before).cwiseAbs().maxCoeff() < 0.5);
    }
    before = command.effort;
    REQUIRE(arm.write(command) == Status::ok);
  }
  CHECK((state.position - reference.position).norm() < 1e-3);
}

TEST_CASE("switching under load: a moving arm feels the next controller, not the switch") {
  constexpr unsigned seed = 82;
  CAPTURE(seed);
  support::Random random(seed);
  using C = Loop<Simulator<Arm>, Controllers>;
  const JointSignals<Arm> waves(
      {{"shoulder_active_joint", SineSignal{.amplitude = 0.2, .frequency = 0.5}},
       {"elbow_active_joint", SineSignal{.amplitude = 0.3, .frequency = 0.7}}});
  C loop;
  const Vector step = loop.controller().slew() * loop.period();
  const char* const names[] = {"pid_plus_gravity", "computed_torque"};
  REQUIRE(loop.controller().request(instead(names[0])).answer == SwitchAnswer::done);
  Vector before = Vector::Zero(), off = Vector::Zero();
  for (int k = 0; k < 8000; ++k) {
    CAPTURE(k);
    loop.reference() = waves.sample(loop.next_time());
    if (k > 1000 && random.one_in(k % 2000 < 1000 ? 300 : 20)) {
      static_cast<void>(loop.controller().request(instead(names[random.integer(0, 1)])));
    }
    REQUIRE(loop.update() == Status::ok);
    if (k > 1000) {
      // Under either controller alone the effort changes by less than a step in a cycle.
      REQUIRE(((loop.command().effort - before).cwiseAbs() - 2 * step).maxCoeff() < 0);
      off = off.cwiseMax((loop.state().position - loop.reference().position).cwiseAbs());
    }
    before = loop.command().effort;
  }
  CAPTURE(off[0], off[1]);
  CHECK(off.maxCoeff() < 0.03);
}
