// SPDX-License-Identifier: Apache-2.0
// Each request to a running loop is done, or refused with a reason.
#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "numbers.hpp"
#include "remote/remote_arm.hpp"

using namespace articula;
using namespace articula::remote;
using support::elbow;
using support::PlainArm;
using support::shoulder;
using support::SupervisedArm;

namespace {

/// Whether a request was refused with a text that has these words.
bool refused(const Answer& answer, const std::string& words) {
  CAPTURE(answer.text);
  CHECK(answer.verdict == support::Verdict::refused);
  const bool found = answer.text.find(words) != std::string::npos;
  CHECK(found);
  return found;
}
bool done(const Answer& answer) {
  CAPTURE(answer.text);
  CHECK(answer.verdict == support::Verdict::done);
  return answer.verdict == support::Verdict::done;
}

}  // namespace

TEST_CASE("a supervised loop is activated, deactivated, and acknowledges faults") {
  SupervisedArm arm;
  CHECK(arm.remote.situation().mode == LoopMode::inactive);
  CHECK(refused(arm.ask(Go{{{shoulder, 0.5}}}), "activate it first"));
  CHECK(refused(arm.ask(AcknowledgeFault{}), "no fault"));
  CHECK(done(arm.ask(Activate{})));
  CHECK(arm.remote.situation().mode == LoopMode::active);
  CHECK(done(arm.ask(Activate{})));
  CHECK(done(arm.ask(Deactivate{})));
  CHECK(arm.remote.situation().mode == LoopMode::inactive);
  CHECK(done(arm.ask(Deactivate{})));
}

TEST_CASE("requests are done in their order, also while the mode changes") {
  SupervisedArm arm;
  arm.session->ask(Activate{});
  arm.session->ask(Go{{{shoulder, 0.5}}});
  arm.session->ask(Deactivate{});
  arm.session->ask(Activate{});
  arm.cycles(20);
  for (int k = 0; k < 4; ++k) {
    const auto answer = arm.session->answer();
    REQUIRE(answer);
    CHECK(done(*answer));
  }
  CHECK(arm.remote.situation().mode == LoopMode::active);
  CHECK(arm.remote.situation().motion == "rest");
}

TEST_CASE("a loop without supervision is active, and refuses changes of mode") {
  PlainArm arm;
  CHECK(arm.remote.situation().mode == LoopMode::active);
  CHECK(refused(arm.ask(Activate{}), "no supervision"));
  CHECK(refused(arm.ask(Deactivate{}), "no supervision"));
  CHECK(refused(arm.ask(AcknowledgeFault{}), "no supervision"));
  CHECK(done(arm.ask(Go{{{shoulder, 0.5}}})));
  arm.cycles(3000);
  CHECK(arm.loop.reference().position[0] == 0.5);
  CHECK(std::abs(arm.loop.state().position[0] - 0.5) < 1e-2);
}

TEST_CASE("a go moves the named joints and leaves the others") {
  SupervisedArm arm;
  REQUIRE(done(arm.ask(Activate{})));
  REQUIRE(done(arm.ask(Go{{{elbow, -1.0}}, 0.5})));
  CHECK(arm.remote.situation().motion == "go");
  arm.cycles(5000);
  CHECK(arm.remote.situation().motion == "rest");
  CHECK(arm.loop.reference().position == JointVector<2>(0, -1));
  CHECK(arm.loop.reference().velocity == JointVector<2>(0, 0));
}

TEST_CASE("a go for one joint lets another one go on to its target") {
  SupervisedArm arm;
  REQUIRE(done(arm.ask(Activate{})));
  REQUIRE(done(arm.ask(Go{{{shoulder, 1.0}}})));
  arm.cycles(200);
  REQUIRE(done(arm.ask(Go{{{elbow, 1.0}}})));
  arm.cycles(5000);
  CHECK(arm.loop.reference().position == JointVector<2>(1, 1));
}

TEST_CASE("a go is refused with joint, value and limit") {
  SupervisedArm arm;
  REQUIRE(done(arm.ask(Activate{})));
  CHECK(refused(arm.ask(Go{}), "no joint is named"));
  CHECK(refused(arm.ask(Go{{{"knee", 0}}}), "'knee'"));
  CHECK(refused(
      arm.ask(Go{{{shoulder, 2}}}),
      "position 2 rad of joint 'shoulder_active_joint' is not within -1.5708 .. 1.5708 rad"));
  CHECK(refused(arm.ask(Go{{{shoulder, support::not_a_number}}}), "position nan"));
  CHECK(refused(arm.ask(Go{{{shoulder, 0}, {shoulder, 1}}}), "named twice"));
  CHECK(refused(arm.ask(Go{{{shoulder, 0}}, 0}), "speed 0 is not within"));
  CHECK(refused(arm.ask(Go{{{shoulder, 0}}, support::not_a_number}), "speed nan"));
  CHECK(arm.remote.situation().motion == "rest");
}

TEST_CASE("a stop ends a motion by the fastest stop within the limits") {
  SupervisedArm arm;
  REQUIRE(done(arm.ask(Activate{})));
  REQUIRE(done(arm.ask(Go{{{shoulder, 1.5}}})));
  arm.cycles(400);
  REQUIRE(arm.loop.reference().velocity[0] > 0.7);
  REQUIRE(done(arm.ask(Stop{})));
  CHECK(arm.remote.situation().motion == "stop");
  arm.cycles(1000);
  CHECK(arm.remote.situation().motion == "rest");
  CHECK(arm.loop.reference().velocity[0] == 0);
  CHECK(arm.loop.reference().position[0] < 1.5);
  CHECK(done(arm.ask(Stop{})));
}

TEST_CASE("a reference is set at once for the named joints") {
  SupervisedArm arm;
  REQUIRE(done(arm.ask(Activate{})));
  REQUIRE(done(arm.ask(SetReference{{{shoulder, 0.1}}, {{shoulder, 0.2}}, {{elbow, 0.3}}})));
  const auto& reference = std::as_const(arm.loop).reference();
  CHECK(reference.position == JointVector<2>(0.1, 0));
  CHECK(reference.velocity == JointVector<2>(0.2, 0));
  CHECK(reference.effort == JointVector<2>(0, 0.3));
  CHECK(arm.remote.situation().motion == "set");
  REQUIRE(done(arm.ask(SetReference{{{shoulder, 0.15}}})));
  CHECK(reference.position == JointVector<2>(0.15, 0));
  CHECK(reference.effort == JointVector<2>(0, 0.3));
  CHECK(refused(arm.ask(SetReference{}), "no joint is named"));
  CHECK(refused(arm.ask(SetReference{{{elbow, -2}}}),
                "position -2 rad of joint 'elbow_active_joint'"));
  CHECK(refused(arm.ask(SetReference{{}, {{shoulder, 3}}}), "velocity 3 rad/s of joint"));
  CHECK(refused(arm.ask(SetReference{{}, {}, {{shoulder, 28}}}),
                "is not within -27.94 .. 27.94 N m"));
}

TEST_CASE("a trajectory is answered at its end") {
  SupervisedArm arm;
  REQUIRE(done(arm.ask(Activate{})));
  const PlayTrajectory play{{{shoulder, elbow},
                             {{.time_from_start = 0.5, .positions = {0.3, -0.3}},
                              {.time_from_start = 1, .positions = {0.5, -0.5}}}}};
  arm.cycles(100);
  const double begin = arm.loop.time();
  const Answer answer = arm.ask(play, 2000);
  CHECK(done(answer));
  CHECK(answer.text == "goal reached");
  CHECK(std::abs(arm.loop.time() - begin - 1) < 0.01);
  CHECK(arm.loop.reference().position == JointVector<2>(0.5, -0.5));
  CHECK(arm.remote.situation().motion == "rest");
}

TEST_CASE(
    "the answer tells which points of a trajectory were left out, and a strong effort is refused") {
  SupervisedArm arm;
  REQUIRE(done(arm.ask(Activate{})));
  PlayTrajectory play{{{shoulder},
                       {{.time_from_start = 0.02, .positions = {0.2}},
                        {.time_from_start = 1, .positions = {0.5}}}}};
  const Answer answer = arm.ask(play, 2000);
  CHECK(done(answer));
  CHECK(answer.text.find("without 1 of its first points") != std::string::npos);
  play.trajectory.points = {{.time_from_start = 1, .positions = {0.4}, .effort = {28}}};
  CHECK(refused(arm.ask(play), "trajectory: effort 28 N m of joint 'shoulder_active_joint'"));
}

TEST_CASE("signals beyond the range of a joint are refused") {
  SupervisedArm arm;
  REQUIRE(done(arm.ask(Activate{})));
  REQUIRE(done(arm.ask(SetReference{{{shoulder, 1.5}}})));
  arm.cycles(2);  // the port knows the reference
  const auto answer_to = [&](const Signal& signal) {
    return arm.ask(PlaySignals{{{shoulder, signal}}, 0.05}, 2000);
  };
  CHECK(refused(answer_to(StepSignal{0.1, 0}), "signals: position 1.6 rad of joint"));
  CHECK(refused(answer_to(SquareSignal{0.1, 1}), "signals: position 1.6 rad of joint"));
  CHECK(refused(answer_to(StepSignal{-3.1, 0}), "signals: position -1.6 rad of joint"));
  CHECK(done(answer_to(StepSignal{-0.1, 0})));
  CHECK(done(answer_to(SineSignal{0.05, 1})));
  // Opposite steps cancel.
  CHECK(done(arm.ask(
      PlaySignals{{{shoulder, StepSignal{0.5, 0}}, {shoulder, StepSignal{-0.5, 0}}}, 0.05}, 2000)));
}

TEST_CASE(
    "a trajectory that another motion replaces fails, one that cannot be followed is refused") {
  SupervisedArm arm;
  REQUIRE(done(arm.ask(Activate{})));
  const auto number =
      arm.session->ask(PlayTrajectory{{{elbow}, {{.time_from_start = 1, .positions = {0.5}}}}});
  arm.cycles(300);
  CHECK(arm.remote.situation().motion == "trajectory");
  REQUIRE(arm.session->ask(Stop{}) == number + 1);
  arm.cycles(2);
  const auto first = arm.session->answer(), second = arm.session->answer();
  REQUIRE((first && second));
  CHECK(first->request == number);
  CHECK(first->verdict == support::Verdict::failed);
  CHECK(first->text == "a stop or the loss of its operator has ended it");
  CHECK(second->verdict == support::Verdict::done);
  arm.cycles(500);
  const auto why_ended = [&](const Request& request) {
    const auto of =
        arm.session->ask(PlayTrajectory{{{elbow}, {{.time_from_start = 1, .positions = {0.5}}}}});
    arm.cycles(100);
    arm.session->ask(request);
    arm.cycles(2000);
    return arm.answer_to(of).value().text;
  };
  CHECK(why_ended(Go{{{elbow, 0}}}) == "another request has ended it");
  CHECK(why_ended(Reset{{{elbow, 0.1}}}) == "a reset of the simulation has ended it");

  CHECK(refused(arm.ask(PlayTrajectory{{{elbow}, {{.positions = {0.5}}}}}),
                "give the motion a time"));
  CHECK(refused(arm.ask(PlayTrajectory{{{"knee"}, {{.time_from_start = 1, .positions = {0.5}}}}}),
                "'knee'"));
  CHECK(refused(arm.ask(PlayTrajectory{{{elbow}, {{.time_from_start = 1, .positions = {3}}}}}),
                "is outside"));
  CHECK(refused(arm.ask(PlayTrajectory{{{elbow}, {}}}), "no point"));
  // The mean velocity between the points is within the limit, the highest is half as much again.
  const PlayTrajectory fast{{{shoulder},
                             {{.time_from_start = 1, .positions = {0}, .velocities = {0}},
                              {.time_from_start = 1.5, .positions = {1}, .velocities = {0}}}}};
  CHECK(refused(arm.ask(fast),
                "velocity 3 rad/s of joint 'shoulder_active_joint' is not within -2.27 .. 2.27"));
  const auto& text =
      arm.ask(PlayTrajectory{{{elbow}, {{.time_from_start = 1e-3, .positions = {1}}}}});
  CHECK(text.verdict == support::Verdict::refused);
}

TEST_CASE("signals are played around the reference, which then returns") {
  SupervisedArm arm;
  REQUIRE(done(arm.ask(Activate{})));
  REQUIRE(done(arm.ask(Go{{{shoulder, 0.4}}})));
  arm.cycles(3000);
  const PlaySignals play{{{shoulder, StepSignal{0.2, 0.1}}, {elbow, SineSignal{0.1, 1}}}, 0.6};
  const auto number = arm.session->ask(play);
  arm.cycles(300);
  CHECK(arm.remote.situation().motion == "signals");
  CHECK(std::abs(arm.loop.reference().position[0] - 0.6) < 1e-12);
  CHECK(std::abs(arm.loop.reference().position[1] - 0.1 * std::sin(0.6 * std::numbers::pi)) < 1e-3);
  arm.cycles(310);
  const auto answer = arm.session->answer();
  REQUIRE(answer);
  CHECK(answer->request == number);
  CHECK(done(*answer));
  remote::Cycle cycle;
  do {
    REQUIRE(arm.session->next(cycle));
  } while (!(cycle.reference_position[1] > 0));  // NaN before the activation
  CHECK(answer->cycle == cycle.number);
  arm.cycles(2000);
  CHECK(arm.loop.reference().position.isApprox(JointVector<2>(0.4, 0), 1e-12));

  CHECK(refused(arm.ask(PlaySignals{{{shoulder, SineSignal{0.5, 5}}}, 1}),
                "is not within -2.27 .. 2.27"));
  CHECK(refused(arm.ask(PlaySignals{{{shoulder, SineSignal{0.5, 0.1}}}, 0}), "duration 0 s"));
  CHECK(refused(arm.ask(PlaySignals{{{shoulder, SineSignal{.frequency = 1, .offset = 1}}}, 1}),
                "would jump by 1 at the start"));
  CHECK(refused(arm.ask(PlaySignals{{}, 1}), "there is none"));
  CHECK(refused(arm.ask(PlaySignals{{{shoulder, StepSignal{50}, SignalTarget::effort}}, 1}),
                "effort 50"));
  CHECK(refused(arm.ask(PlaySignals{{{"knee", StepSignal{0.1}}}, 1}), "'knee'"));
}

TEST_CASE("a loop that does not run gives no answer in time, and does nothing later") {
  SupervisedArm arm({.answer_time = 0.01});
  REQUIRE(done(arm.ask(Activate{})));
  const auto number = arm.session->ask(Go{{{shoulder, 1}}});
  std::optional<Answer> answer;
  while (!(answer = arm.session->answer())) {
  }
  CHECK(answer->request == number);
  CHECK(answer->verdict == support::Verdict::timed_out);
  CHECK(answer->cycle == 0);
  arm.cycles(10);
  CHECK(arm.remote.situation().motion == "rest");
  CHECK(!arm.session->answer());
}

TEST_CASE("requests that nobody takes are refused when there are too many") {
  SupervisedArm arm;
  for (int k = 0; k < 64; ++k) arm.session->ask(Stop{});
  CHECK(!arm.session->answer());
  const auto number = arm.session->ask(Stop{});
  const auto answer = arm.session->answer();
  REQUIRE(answer);
  CHECK(answer->request == number);
  CHECK(refused(*answer, "too many requests"));
  arm.cycles(64);
  for (int k = 0; k < 64; ++k) CHECK(arm.session->answer());
}
