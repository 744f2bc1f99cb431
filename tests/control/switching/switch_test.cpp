// SPDX-License-Identifier: Apache-2.0
// One of several controllers is active: who, what is answered to requests, what a failure leads to.
// That the command goes on smoothly is in bumpless_transfer_test.cpp.
#include <articula/control/bypass.hpp>
#include <articula/control/computed_torque.hpp>
#include <articula/control/forward_position.hpp>
#include <articula/control/forward_velocity.hpp>
#include <articula/control/joint_impedance.hpp>
#include <articula/control/limits/limited.hpp>
#include <articula/control/pid.hpp>
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/control/safety/standby.hpp>
#include <articula/control/switching/switch.hpp>
#include <articula/loop/loop.hpp>
#include <articula/robots/q2d.hpp>

#include <stdexcept>
#include <string>

#include "by_hand.hpp"
#include "catch.hpp"
#include "hardware/fake_hardware.hpp"
#include "numbers.hpp"
#include "robots/test_robots.hpp"
#include "test_controllers.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::infinity;
using support::not_a_number;
using support::TiltedQ2d;

namespace {

using Vector = JointVector<2>;
constexpr double dt = 1e-3;

/// Commands one effort, or whatever is put in its place, with the verdict that is set.
struct Moody {
  double effort = 0;
  Verdict verdict = Verdict::fine;
  int starts = 0;
  Vector cut = Vector::Zero();

  void start(const ControlInput<2>&) noexcept { ++starts; }
  Outcome<EffortCommand<2>> update(const ControlInput<2>& in) noexcept {
    cut = in.cut;
    return {{Vector::Constant(effort)}, verdict};
  }
};

using Three = support::ByHand<Switch<TiltedQ2d, Moody, Moody, Moody>>;
static_assert(Controller<Switch<TiltedQ2d, Moody, Moody, Moody>, 2>);
static_assert(Switching<Three>);
static_assert(Controller<Switch<Q2d, ForwardPosition<Q2d>, ForwardPosition<Q2d>>, 2>);

const SwitchOptions<2> abc{.names = {"a", "b", "c"}};

Three three(SwitchOptions<2> options = abc) { return Three(options, Moody{1}, Moody{2}, Moody{3}); }

/// Cycles until nothing is carried any more.
template <class C>
Vector settled(C& controller, const JointState<2>& state = {},
               const JointReference<2>& reference = {}) {
  for (int k = 0; k < 1000; ++k) static_cast<void>(controller.update(state, reference, dt));
  return controller.update(state, reference, dt).effort;
}

std::string states(const Three& controllers) {
  std::string text;
  for (const ControllerInfo& info : controllers.list()) {
    text += std::string(info.name.view()) + " " + std::string(to_string(info.status)) + "; ";
  }
  return text;
}

}  // namespace

TEST_CASE("controllers go by their own names, or by those that are given") {
  const Switch<Q2d, Bypass<Q2d>, Pid<Q2d>, Moody, Pid<Q2d>> own;
  CHECK(own.name_of(0) == "bypass");
  CHECK(own.name_of(1) == "pid");
  CHECK(own.name_of(2) == "controller_3");
  CHECK(own.name_of(3) == "pid_2");
  CHECK(own.active() == "bypass");
  CHECK(states(three()) == "a active; b inactive; c inactive; ");
  CHECK(three({.names = {"a", "b", "c"}, .active = "c"}).active() == "c");
  CHECK(three({.names = {"a", "b", "c"}, .active = Name()}).active().empty());

  CommandLimits<2> limits = command_limits(Q2d());
  limits.acceleration = {20, 20};
  using Careful = Limited<Q2d, PidPlusGravity<Q2d>>;
  const Switch<Q2d, Careful, Bypass<Q2d>> limited({}, Careful(limits), Bypass<Q2d>());
  CHECK(limited.name_of(0) == "pid_plus_gravity");
}

TEST_CASE("what makes no sense is refused at set-up, by name") {
  CHECK_THROWS_WITH(three({.names = {"a", "b"}}), Contains("2 names for 3 controllers"));
  CHECK_THROWS_WITH(three({.names = {"a", "b", "a"}}), Contains("two controllers are named 'a'"));
  CHECK_THROWS_WITH(three({.names = {"a", "", "c"}}), Contains("has no name"));
  CHECK_THROWS_WITH(three({.names = {"a", "b", "c"}, .active = "d"}),
                    Contains("no controller 'd'; controllers: a, b, c"));
  CHECK_THROWS_WITH(three({.names = {"pid", "gravity", "c"}, .active = "pidd"}),
                    Contains("no controller 'pidd'; did you mean 'pid'?"));
  CHECK_THROWS_WITH(three({.names = {"a", "b", "c"}, .fallbacks = {{"a", {"b", "x"}}}}),
                    Contains("no controller 'x'"));
  CHECK_THROWS_WITH(three({.names = {"a", "b", "c"}, .fallbacks = {{"y", {"b"}}}}),
                    Contains("no controller 'y'"));
  CHECK_THROWS_WITH(three({.names = {"a", "b", "c"}, .fallbacks = {{"a", {"a"}}}}),
                    Contains("its own fallback: 'a'"));
  for (const double bad : {0.0, -1.0, infinity, not_a_number}) {
    CAPTURE(bad);
    CHECK_THROWS_WITH(three({.slew = Vector(1, bad)}),
                      Contains("slew") && Contains("'elbow_active_joint'"));
    CHECK_THROWS_WITH(three({.damping_time = bad}), Contains("damping_time"));
  }
  // A joint without a limit has no default.
  using Free = Switch<Model<2>, Bypass<Model<2>>, Pid<Model<2>>>;
  const Model<2> arm = support::free_arm();
  const auto make = [&](const SwitchOptions<2>& options) {
    return Free(arm, options, Bypass<Model<2>>(arm), Pid<Model<2>>(arm, Q2d::pid_gains));
  };
  CHECK_THROWS_WITH(make({}), Contains("slew inf of joint 'shoulder_active_joint'"));
  CHECK(make({.slew = Vector(1, 1)}).slew() == Vector(1, 1));
}

TEST_CASE("a request is answered, and done with the next update") {
  struct Row {
    SwitchRequest request;
    SwitchAnswer answer;
    Name about;   // which controller the answer is about
    Name active;  // then
    int started, stopped;
  };
  using A = SwitchAnswer;
  constexpr auto best = Strictness::best_effort;
  // In each row "a" is active at first.
  const Row rows[] = {
      {{.stop = {"a"}, .start = {"b"}}, A::done, "", "b", 1, 1},
      {{.start = {"b"}, .replace = true}, A::done, "", "b", 1, 1},
      {{.stop = {"a"}}, A::done, "", "", 0, 1},
      {{.stop = {"a"}, .start = {"a"}}, A::done, "", "a", 1, 1},
      {{}, A::done, "", "a", 0, 0},
      {{.start = {"b"}}, A::occupied, "b", "a", 0, 0},
      {{.start = {"a"}}, A::already_active, "a", "a", 0, 0},
      {{.start = {"a"}, .replace = true}, A::already_active, "a", "a", 0, 0},
      {{.stop = {"b"}, .start = {"c"}}, A::not_active, "b", "a", 0, 0},
      {{.stop = {"a"}, .start = {"x"}}, A::unknown_name, "x", "a", 0, 0},
      {{.stop = {"x"}}, A::unknown_name, "x", "a", 0, 0},
      {{.stop = {""}}, A::unknown_name, "", "a", 0, 0},
      {{.stop = {"a"}, .start = {"b", "c"}}, A::occupied, "c", "a", 0, 0},
      {{.start = {"b", "c"}, .replace = true}, A::occupied, "c", "a", 0, 0},
      {{.stop = {"a", "a"}}, A::not_active, "a", "a", 0, 0},
      {{.stop = {"b", "a"}, .start = {"c"}, .strictness = best}, A::not_active, "b", "c", 1, 1},
      {{.stop = {"a"}, .start = {"x"}, .strictness = best}, A::unknown_name, "x", "", 0, 1},
      {{.stop = {"x"}, .start = {"b"}, .strictness = best}, A::unknown_name, "x", "a", 0, 0},
      {{.start = {"x", "b"}, .strictness = best, .replace = true}, A::unknown_name, "x", "b", 1, 1},
      {{.start = {"b", "c"}, .strictness = best, .replace = true}, A::occupied, "c", "b", 1, 1},
      {{.start = {"a"}, .strictness = best, .replace = true}, A::already_active, "a", "a", 0, 0},
  };
  int row_number = 0;
  for (const Row& row : rows) {
    CAPTURE(row_number++);
    Three controllers = three();
    controllers.start({});
    static_cast<void>(controllers.update({}, {}, dt));
    const SwitchOutcome outcome = controllers.request(row.request);
    CHECK(outcome.answer == row.answer);
    CHECK(outcome.controller == row.about);
    CHECK(outcome.started == row.started);
    CHECK(outcome.stopped == row.stopped);
    CHECK(controllers.active() == "a");
    static_cast<void>(controllers.update({}, {}, dt));
    CHECK(controllers.active() == row.active);
  }
  for (const auto answer :
       {A::done, A::unknown_name, A::already_active, A::not_active, A::occupied}) {
    CHECK_FALSE(to_string(answer).empty());
  }
  const auto names = [](auto... k) { return ControllerNames{std::to_string(k)...}; };
  const ControllerNames most = names(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16);
  CHECK(most.end() - most.begin() == ControllerNames::capacity);
  CHECK_THROWS_AS(names(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17),
                  std::length_error);
}

TEST_CASE("requests between two cycles add up, and one before the first start counts") {
  Three controllers = three();
  CHECK(controllers.request({.stop = {"a"}}).answer == SwitchAnswer::done);
  CHECK(controllers.request({.stop = {"a"}}).answer == SwitchAnswer::not_active);
  CHECK(controllers.request({.start = {"c"}}).answer == SwitchAnswer::done);
  controllers.start({});
  CHECK(controllers.active() == "c");
  CHECK(controllers.update({}, {}, dt).effort == Vector(3, 3));  // nothing to go on from
  CHECK(controllers.member<2>().starts == 1);

  // Nor is there anything to go on from after another start, whatever was given before.
  CHECK(controllers.request({.stop = {"c"}, .start = {"b"}}).answer == SwitchAnswer::done);
  CHECK(controllers.update({}, {}, dt).effort == Vector(3, 3));
  controllers.start({});
  CHECK(controllers.request({.stop = {"b"}, .start = {"a"}}).answer == SwitchAnswer::done);
  CHECK(controllers.update({}, {}, dt).effort == Vector(1, 1));
  CHECK(controllers.member<0>().starts == 1);
}

TEST_CASE("a fallback in the first cycle gives its own command") {
  Three controllers = three({.names = {"a", "b", "c"}, .fallbacks = {{"a", {"c"}}}});
  controllers.member<0>().effort = not_a_number;
  for (int k = 0; k < 2; ++k) {
    controllers.start({});
    CHECK(controllers.update({}, {}, dt).effort == Vector(3, 3));
    CHECK(controllers.request({.stop = {"c"}, .start = {"a"}}).answer == SwitchAnswer::done);
  }
}

TEST_CASE("no controller is started from a state that is none: the switch waits") {
  using OfThree = Switch<TiltedQ2d, Moody, Moody, Moody>;
  Loop loop{support::FakeHardware<TiltedQ2d>(), OfThree(abc, Moody{1}, Moody{2}, Moody{3})};
  OfThree& controllers = loop.controller();
  CHECK(loop.update() == Status::ok);
  CHECK(loop.command().effort == Vector(1, 1));
  CHECK(controllers.request({.stop = {"a"}, .start = {"b"}}).answer == SwitchAnswer::done);
  loop.hardware().measured.velocity[1] = infinity;
  CHECK(loop.update() == Status::non_finite_state);
  CHECK(controllers.active() == "a");
  CHECK(controllers.member<1>().starts == 0);
  loop.hardware().measured = {};
  for (int k = 0; k < 1000; ++k) CHECK(loop.update() == Status::ok);
  CHECK(loop.command().effort == Vector(2, 2));
}

TEST_CASE("a controller is started anew whenever it becomes active, and no other time") {
  Three controllers = three();
  controllers.start({});
  CHECK(controllers.member<0>().starts == 1);
  for (int k = 1; k <= 3; ++k) {
    CHECK(controllers.request({.start = {"b"}, .replace = true}).answer == SwitchAnswer::done);
    CHECK(settled(controllers) == Vector(2, 2));
    CHECK(controllers.member<1>().starts == k);
    CHECK(controllers.request({.start = {"a"}, .replace = true}).answer == SwitchAnswer::done);
    CHECK(settled(controllers) == Vector(1, 1));
    CHECK(controllers.member<0>().starts == 1 + k);
  }
  CHECK(controllers.request({.stop = {"a"}, .start = {"a"}}).answer == SwitchAnswer::done);
  static_cast<void>(settled(controllers));
  CHECK(controllers.member<0>().starts == 5);
  CHECK(controllers.member<2>().starts == 0);
}

TEST_CASE("with nothing active the command is the safe one that is declared") {
  JointState<2> state;
  state.position = {0.4, -0.3};
  state.velocity = {0.1, -0.2};
  Three controllers = three({.names = {"a", "b", "c"}, .active = Name(), .damping_time = 0.2});
  controllers.start(state);
  const Vector damping = damping_effort(TiltedQ2d(), state.position, state.velocity, 0.2);
  CHECK(controllers.update(state, {}, dt).effort == damping);
  // A decay within less than two periods would shake: it is that of two periods.
  const Vector slow = damping_effort(TiltedQ2d(), state.position, state.velocity, 0.5);
  REQUIRE((slow - damping).norm() > 1e-3);
  controllers.start(state);
  CHECK(controllers.update(state, {}, 0.25).effort == slow);
  controllers.start(state);
  CHECK(controllers.update(state, {}, 0.1).effort == damping);
  state.velocity = {1e9, -1e9};  // more than the drives can do
  controllers.start(state);
  CHECK(controllers.update(state, {}, dt).effort.cwiseAbs() == Vector(27.94, 13.62));
  state.velocity.setConstant(support::largest);  // the damping overflows
  CHECK(controllers.update(state, {}, dt).effort == Vector(0, 0));

  support::ByHand<Switch<Q2d, ForwardVelocity<Q2d>, ForwardVelocity<Q2d>>> velocities;
  JointReference<2> reference;
  reference.velocity = {1, -1};
  velocities.start({});
  CHECK(velocities.update({}, reference, dt).velocity == Vector(1, -1));
  CHECK(velocities.request({.stop = {"forward_velocity"}}).answer == SwitchAnswer::done);
  for (int k = 0; k < 200; ++k) static_cast<void>(velocities.update({}, reference, dt));
  CHECK(velocities.update({}, reference, dt).velocity == Vector(0, 0));

  // Positions: where the joints were told to be, not where they are.
  support::ByHand<Switch<Q2d, ForwardPosition<Q2d>, ForwardPosition<Q2d>>> positions;
  reference.position = {0.5, -0.5};
  state = {};
  positions.start(state);
  CHECK(positions.update(state, reference, dt).position == reference.position);
  CHECK(positions.request({.stop = {"forward_position"}}).answer == SwitchAnswer::done);
  reference.position = {1, 1};
  for (int k = 0; k < 10; ++k) {
    CHECK(positions.update(state, reference, dt).position == Vector(0.5, -0.5));
  }
}

TEST_CASE("a fallback takes over in the same cycle from a controller that fails") {
  const SwitchOptions<2> options{.names = {"a", "b", "c"}, .fallbacks = {{"a", {"b", "c"}}}};
  SECTION("by a command that is none, or by saying so") {
    for (const double bad : {not_a_number, infinity, -infinity, 1.0}) {
      CAPTURE(bad);
      Three controllers = three(options);
      controllers.start({});
      CHECK(controllers.update({}, {}, dt).effort == Vector(1, 1));
      controllers.member<0>().effort = bad;
      if (bad == 1.0) controllers.member<0>().verdict = Verdict::failed;
      CHECK(controllers.update({}, {}, dt).effort == Vector(1, 1));  // goes on from the last
      CHECK(states(controllers) == "a failed; b active; c inactive; ");
      CHECK(controllers.member<1>().starts == 1);
      CHECK(settled(controllers) == Vector(2, 2));
      // What has failed can be asked again.
      controllers.member<0>() = {};
      CHECK(controllers.request({.stop = {"b"}, .start = {"a"}}).answer == SwitchAnswer::done);
      CHECK(settled(controllers) == Vector(0, 0));
      CHECK(states(controllers) == "a active; b inactive; c inactive; ");
    }
  }
  SECTION("the first that does not fail as well") {
    Three controllers = three(options);
    controllers.start({});
    static_cast<void>(controllers.update({}, {}, dt));
    controllers.member<0>().effort = controllers.member<1>().effort = not_a_number;
    CHECK(controllers.update({}, {}, dt).effort == Vector(1, 1));
    CHECK(states(controllers) == "a failed; b failed; c active; ");
    CHECK(settled(controllers) == Vector(3, 3));
  }
  SECTION("in the very cycle in which it was asked for") {
    Three controllers = three({.names = {"a", "b", "c"}, .fallbacks = {{"b", {"c"}}}});
    controllers.start({});
    static_cast<void>(controllers.update({}, {}, dt));
    controllers.member<1>().effort = not_a_number;
    CHECK(controllers.request({.start = {"b"}, .replace = true}).answer == SwitchAnswer::done);
    CHECK(controllers.update({}, {}, dt).effort == Vector(1, 1));
    CHECK(states(controllers) == "a inactive; b failed; c active; ");
  }
}

TEST_CASE("without a fallback a failure is passed on, and what is good again goes on from safety") {
  for (const bool by_verdict : {false, true}) {
    CAPTURE(by_verdict);
    Three controllers = three({.names = {"a", "b", "c"}, .fallbacks = {{"a", {"b"}}}});
    JointState<2> state;
    state.position = {0.4, -0.3};
    controllers.start(state);
    static_cast<void>(controllers.update(state, {}, dt));
    controllers.member<1>().effort = not_a_number;  // nor does the fallback help
    controllers.member<0>().effort = by_verdict ? 1 : not_a_number;
    if (by_verdict) controllers.member<0>().verdict = Verdict::failed;
    const Vector weight = gravity(TiltedQ2d(), state.position);
    for (int k = 0; k < 2; ++k) {
      static_cast<void>(controllers.update(state, {}, dt));
      CHECK(controllers.verdict == Verdict::failed);
      controllers.apply(weight);  // as a loop does
    }
    CHECK(controllers.active() == "a");
    CHECK(controllers.list()[0].status == ControllerStatus::failed);
    controllers.member<0>() = {1};
    CHECK((controllers.update(state, {}, dt).effort - weight).norm() < 1e-12);  // rounding
    CHECK(controllers.list()[0].status == ControllerStatus::active);
    CHECK(settled(controllers, state) == Vector(1, 1));
  }
}

TEST_CASE("a degraded command counts where no fallback is better") {
  Three controllers = three({.names = {"a", "b", "c"}, .fallbacks = {{"a", {"b"}}}});
  controllers.start({});
  static_cast<void>(controllers.update({}, {}, dt));
  controllers.member<0>() = {1, Verdict::degraded};
  controllers.member<1>().verdict = Verdict::degraded;
  CHECK(controllers.update({}, {}, dt).effort == Vector(1, 1));
  CHECK(controllers.verdict == Verdict::degraded);
  CHECK(states(controllers) == "a failed; b failed; c inactive; ");
  controllers.member<1>().verdict = Verdict::fine;
  CHECK(settled(controllers) == Vector(2, 2));
  CHECK(controllers.verdict == Verdict::fine);
}

namespace {

using CarefulMoody = Limited<TiltedQ2d, Moody>;

CommandLimits<2> careful_limits() {
  CommandLimits<2> limits = command_limits(TiltedQ2d());
  limits.acceleration = {20, 40};
  return limits;
}

}  // namespace

TEST_CASE("a fallback takes over from a limited controller that fails, though that one brakes") {
  for (const bool by_verdict : {false, true}) {
    CAPTURE(by_verdict);
    using C = support::ByHand<Switch<TiltedQ2d, CarefulMoody, Moody>>;
    C controllers({.names = {"a", "b"}, .fallbacks = {{"a", {"b"}}}},
                  CarefulMoody(careful_limits()), Moody{2});
    controllers.start({});
    static_cast<void>(controllers.update({}, {}, dt));
    CHECK(controllers.verdict == Verdict::fine);
    controllers.member<0>().controller().effort = by_verdict ? 1 : not_a_number;
    if (by_verdict) controllers.member<0>().controller().verdict = Verdict::failed;
    // Not where the reference is to blame.
    JointReference<2> bad;
    bad.effort[0] = not_a_number;
    static_cast<void>(controllers.update({}, bad, dt));
    CHECK(controllers.active() == "a");
    CHECK(is_finite(controllers.update({}, {}, dt)));
    CHECK(controllers.active() == "b");
    CHECK(controllers.status_of(0) == ControllerStatus::failed);
    CHECK(controllers.verdict == Verdict::fine);
    CHECK(settled(controllers) == Vector(2, 2));
  }
}

TEST_CASE("without a fallback the limited controller brakes, and the verdict is degraded") {
  using C = support::ByHand<Switch<TiltedQ2d, CarefulMoody, Moody>>;
  // A fallback that fails as well must not be in the way of braking.
  C controllers({.names = {"a", "b"}, .fallbacks = {{"a", {"b"}}}}, CarefulMoody(careful_limits()),
                Moody{not_a_number});
  support::ByHand<CarefulMoody> alone(careful_limits());
  JointState<2> state;
  state.velocity = {1, -1};
  controllers.start(state);
  alone.start(state);
  controllers.member<0>().controller().effort = alone.controller().effort = not_a_number;
  for (int k = 0; k < 5; ++k) {
    const Vector braking = alone.update(state, {}, dt).effort;
    REQUIRE(braking.cwiseAbs().minCoeff() > 0.1);
    CHECK(controllers.update(state, {}, dt).effort == braking);
    CHECK(controllers.verdict == Verdict::degraded);
    state.velocity *= 0.9;
  }
  controllers.member<0>().controller().effort = 0;
  static_cast<void>(controllers.update(state, {}, dt));
  CHECK(controllers.verdict == Verdict::fine);
}

TEST_CASE("limits around a switch: what is good again goes on from the effort that braked") {
  for (const bool by_verdict : {false, true}) {
    CAPTURE(by_verdict);
    using One = support::ByHand<Limited<TiltedQ2d, Switch<TiltedQ2d, Moody>>>;
    One controllers(careful_limits());
    auto& member = controllers.controller().member<0>();
    JointState<2> state;
    state.velocity = {1, -1};
    controllers.start(state);
    member.effort = -1;
    for (int k = 0; k < 5; ++k) static_cast<void>(controllers.update(state, {}, dt));
    member.effort = by_verdict ? -1 : not_a_number;
    if (by_verdict) member.verdict = Verdict::failed;
    Vector braking;
    for (int k = 0; k < 5; ++k) braking = controllers.update(state, {}, dt).effort;
    CHECK(controllers.verdict == Verdict::degraded);
    member = {-1};
    const Vector own = Vector::Constant(-1);
    REQUIRE((braking - own).cwiseAbs().minCoeff() > 1);  // else there were nothing to jump
    CHECK((controllers.update(state, {}, dt).effort - braking).norm() < 1e-12);
    CHECK(controllers.verdict == Verdict::fine);
    const Vector step = controllers.controller().slew() * dt;
    const Vector next = controllers.update(state, {}, dt).effort;
    CHECK(((next - braking).cwiseAbs() - step).maxCoeff() < 1e-12);
  }
}

TEST_CASE("a state or reference that is not finite is no controller's failure") {
  using Two = Switch<TiltedQ2d, PidPlusGravity<TiltedQ2d>, Moody>;
  Loop loop{support::FakeHardware<TiltedQ2d>(),
            Two({.fallbacks = {{"pid_plus_gravity", {"controller_2"}}}})};
  CHECK(loop.update() == Status::ok);
  loop.reference().velocity[1] = not_a_number;
  CHECK(loop.update() == Status::non_finite_reference);
  loop.hardware().measured.position[0] = infinity;
  CHECK(loop.update() == Status::non_finite_state);
  CHECK(loop.controller().active() == "pid_plus_gravity");
  CHECK(loop.controller().list()[0].status == ControllerStatus::active);
  loop.hardware().measured = {};
  loop.reference() = {};
  CHECK(loop.update() == Status::ok);
}

TEST_CASE("commands are kept within the drives' limits, and the controller gets the cut") {
  Three controllers = three();
  controllers.start({});
  controllers.member<0>().effort = 30;
  CHECK(controllers.update({}, {}, dt).effort == Vector(27.94, 13.62));
  controllers.cut_off(Vector(1, 2));
  static_cast<void>(controllers.update({}, {}, dt));
  // What the switch took, and what was taken after it.
  const Vector cut = Vector(30 - 27.94, 30 - 13.62) + Vector(1, 2);
  CHECK((controllers.member<0>().cut - cut).norm() < 1e-14);
  CHECK(controllers.member<1>().cut == Vector(0, 0));
}

TEST_CASE("gains reach the one controller that takes them") {
  using Mixed = Switch<Q2d, PidPlusGravity<Q2d>, JointImpedance<Q2d>>;
  static_assert(TakesGains<Mixed, ValidPidGains<2>> && TakesGains<Mixed, ValidImpedanceGains<2>>);
  // Whose would they be? A torque for the one, an acceleration for the other.
  using Unclear = Switch<Q2d, PidPlusGravity<Q2d>, ComputedTorque<Q2d>>;
  static_assert(!TakesGains<Unclear, ValidPidGains<2>>);
  Mixed mixed({}, PidPlusGravity<Q2d>(), JointImpedance<Q2d>({}));
  const PidGains g{.proportional = 7};
  set_gains(mixed, ValidPidGains<2>({g, g}, joint_names(Q2d())));
  CHECK(mixed.member<PidPlusGravity<Q2d>>().part<PidLaw<2>>().gains()[1].proportional == 7);
  Unclear unclear;
  unclear.member<0>().set_gains(ValidPidGains<2>({g, g}, joint_names(Q2d())));
  CHECK(unclear.member<0>().part<PidLaw<2>>().gains()[0].proportional == 7);
}
