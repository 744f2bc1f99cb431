// SPDX-License-Identifier: Apache-2.0
// Joints that no controller moves to the reference: a robot that is guided by hand.
#include <articula/control/composition/follows_position.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "catch.hpp"
#include "remote/remote_arm.hpp"

using namespace articula;
using namespace articula::remote;
using support::elbow;
using support::RemoteArm;
using support::shoulder;

namespace {

template <class R>
using Floating = EffortController<R, GravityCompensation<R>, FrictionCompensation<R>>;
template <class R>
using Controllers = Switch<R, PidPlusGravity<R>, Floating<R>>;
using GuidedLoop = SupervisedControlLoop<Q2dSim, Controllers<Q2d>>;
using GuidedArm = RemoteArm<GuidedLoop>;

Controllers<Q2d> controllers() {
  return Controllers<Q2d>({.names = {"pid_plus_gravity", "floating"}},
                          articula::detail::default_controller<PidPlusGravity<Q2d>>(),
                          Floating<Q2d>(Q2d(), {}, {}));
}

bool done(const Answer& answer) { return answer.verdict == support::Verdict::done; }

using Joints = JointArray<bool, 2>;
template <class C>
Joints following(const C& controller) {
  return joints_following_position<2>(controller);
}

struct OfUser {
  EffortCommand<2> update(const ControlInput<2>& in) const noexcept { return {in.state.velocity}; }
};
struct OfUserWithoutPosition : OfUser {
  static constexpr bool follows_position = false;
};

}  // namespace

TEST_CASE("a controller that starts after one that lets the arm float holds it where it is") {
  GuidedArm arm({}, Q2dSim(), controllers());
  REQUIRE(done(arm.ask(Activate{})));
  REQUIRE(done(arm.ask(SwitchControllers{{"floating"}, {"pid_plus_gravity"}})));
  const JointVector<2> before = arm.loop.state().position;
  REQUIRE(done(arm.ask(Pull{"tool_link", {}, {0, 3, 0}})));
  arm.cycles(500);
  REQUIRE(done(arm.ask(Pull{"tool_link"})));
  const JointVector<2> guided = arm.loop.state().position;
  REQUIRE((guided - before).norm() > 0.1);

  REQUIRE(done(arm.ask(SwitchControllers{{"pid_plus_gravity"}, {"floating"}})));
  const JointVector<2> start = arm.loop.state().position;
  const JointVector<2> reference = std::as_const(arm.loop).reference().position;
  CHECK((reference - start).norm() < 0.02);  // the arm has moved since by a cycle or two
  arm.cycles(2000);
  CHECK(std::as_const(arm.loop).reference().position == reference);
  CHECK((arm.loop.state().position - reference).norm() < 0.01);
}

TEST_CASE("the reference goes along with a joint that follows a velocity or an effort") {
  using Velocities = VelocityByEffort<Q2d>;
  using Both = Switch<Q2d, PidPlusGravity<Q2d>, Velocities>;
  constexpr PidGains gains{.proportional = 40};
  const SetReference velocity{.velocities = {{shoulder, 0.1}}};
  const PlaySignals effort{{{shoulder, StepSignal{3, 0}, SignalTarget::effort}}, 10};
  for (const Request& request : {Request(velocity), Request(effort)}) {
    RemoteArm<SupervisedControlLoop<Q2dSim, Both>> arm(
        {}, Q2dSim(),
        Both({.names = {"pid_plus_gravity", "velocities"}},
             articula::detail::default_controller<PidPlusGravity<Q2d>>(),
             Velocities(JointPidGains<2>{gains, gains})));
    REQUIRE(done(arm.ask(Activate{})));
    REQUIRE(done(arm.ask(SwitchControllers{{"velocities"}, {"pid_plus_gravity"}})));
    arm.session->ask(request);
    if (std::holds_alternative<PlaySignals>(request)) {
      REQUIRE(done(arm.ask(Pull{"tool_link", {}, {0, 3, 0}})));
    }
    arm.cycles(2000);
    const double before = arm.loop.state().position[0];
    REQUIRE(std::abs(before) > 0.02);
    arm.session->ask(SwitchControllers{{"pid_plus_gravity"}, {"velocities"}});
    double farthest = 0;
    for (int k = 0; k < 300; ++k) {
      arm.cycles(1);
      farthest = std::max(farthest, before - arm.loop.state().position[0]);
    }
    CHECK(farthest < 0.01);  // it does not go back to where the reference was set
  }
}

TEST_CASE("whoever asks for a position hears of joints that no controller moves there") {
  GuidedArm arm({}, Q2dSim(), controllers());
  REQUIRE(done(arm.ask(Activate{})));
  CHECK(arm.remote.situation().following == std::vector<bool>{true, true});
  const SetReference setting{.positions = {{shoulder, 0.01}}};
  CHECK(arm.ask(setting).text.empty());
  REQUIRE(done(arm.ask(SwitchControllers{{"floating"}, {"pid_plus_gravity"}})));
  CHECK(arm.remote.situation().following == std::vector<bool>{false, false});
  const std::string end = "no active controller moves to it: '" + std::string(shoulder) + "'";
  CHECK(arm.ask(setting).text == "the reference moves, but " + end);
  CHECK(arm.ask(SetReference{.efforts = {{shoulder, 1}}}).text.empty());
  const NamedTrajectory trajectory{{shoulder}, {{.time_from_start = 1, .positions = {0.1}}}};
  const auto asked = arm.session->ask(PlayTrajectory{trajectory});
  arm.cycles(1500);
  CHECK(arm.answer_to(asked).value().text == "goal reached, but " + end);
  const auto with_switch = arm.session->ask(PlayTrajectory{trajectory});
  arm.cycles(500);
  REQUIRE(done(arm.ask(SwitchControllers{{"pid_plus_gravity"}, {"floating"}})));
  arm.cycles(1500);
  CHECK(arm.answer_to(with_switch).value().text == "goal reached");
  REQUIRE(done(arm.ask(Deactivate{})));
  CHECK(arm.remote.situation().following == std::vector<bool>{false, false});
}

TEST_CASE("of settings that wait, each starts from the one before") {
  GuidedArm arm({}, Q2dSim(), controllers());
  REQUIRE(done(arm.ask(Activate{})));
  arm.session->ask(SetReference{.positions = {{shoulder, 0.05}}});
  arm.session->ask(SetReference{.efforts = {{shoulder, 1}}});
  arm.cycles(3);
  CHECK(std::as_const(arm.loop).reference().position[0] == 0.05);
  CHECK(std::as_const(arm.loop).reference().effort[0] == 1);
}

TEST_CASE("a controller that follows positions keeps its reference, whatever pulls at the arm") {
  GuidedArm arm({}, Q2dSim(), controllers());
  REQUIRE(done(arm.ask(Activate{})));
  const JointVector<2> reference = std::as_const(arm.loop).reference().position;
  REQUIRE(done(arm.ask(Pull{"tool_link", {}, {0, 3, 0}})));
  arm.cycles(500);
  REQUIRE(done(arm.ask(SwitchControllers{.start = {"pid_plus_gravity"}, .best_effort = true})));
  CHECK(std::as_const(arm.loop).reference().position == reference);
}

TEST_CASE("compositions follow positions as their active parts do") {
  constexpr Joints both{true, true}, none{false, false};
  CHECK(following(Bypass<Q2d>()) == none);
  CHECK(following(VelocityByEffort<Q2d>(
            JointPidGains<2>{PidGains{.proportional = 1}, PidGains{.proportional = 1}})) == none);
  CHECK(following(ForwardVelocity<Q2d>()) == none);
  CHECK(following(ForwardPosition<Q2d>()) == both);
  CHECK(following(articula::detail::default_controller<PidPlusGravity<Q2d>>()) == both);
  CHECK(following(OfUser()) == both);
  CHECK(following(OfUserWithoutPosition()) == none);

  Controllers<Q2d> switched = controllers();
  CHECK(following(switched) == both);
  const Groups<Q2d, Controllers<Q2d>, Floating<Q2d>> groups(
      {{{"upper", {shoulder}}, {"lower", {elbow}}}}, controllers(), Floating<Q2d>(Q2d(), {}, {}));
  CHECK(following(groups) == Joints{true, false});
}
