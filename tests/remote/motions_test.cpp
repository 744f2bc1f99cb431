// SPDX-License-Identifier: Apache-2.0
// Each joint follows a motion of its own.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "random.hpp"
#include "remote/remote_arm.hpp"

using namespace articula;
using namespace articula::remote;
using Catch::Matchers::Contains;
using support::elbow;
using support::shoulder;
using support::SupervisedArm;

namespace {

PlayTrajectory to(const std::string& joint, double position, double duration = 1) {
  return {{{joint}, {{.time_from_start = duration, .positions = {position}}}}};
}

bool done(const Answer& answer) { return answer.verdict == support::Verdict::done; }

/// An active arm, and its answers by the number of their request.
struct Arm : SupervisedArm {
  Arm() { REQUIRE(done(ask(Activate{}))); }

  const JointReference<2>& reference() { return std::as_const(loop).reference(); }
  std::vector<std::string> motions() { return remote.situation().joint_motions; }
};

using Motions = std::vector<std::string>;

}  // namespace

TEST_CASE("two trajectories of different joints are followed at once, each to its end") {
  Arm arm;
  const auto first = arm.session->ask(to(shoulder, 0.5, 1));
  arm.cycles(300);
  const auto second = arm.session->ask(to(elbow, -0.5, 0.5));
  arm.cycles(300);
  CHECK(arm.motions() == Motions{"trajectory", "trajectory"});
  CHECK_FALSE(arm.answer_to(first));
  arm.cycles(250);
  CHECK(done(arm.answer_to(second).value()));
  CHECK_FALSE(arm.answer_to(first));
  CHECK(arm.motions() == Motions{"trajectory", "rest"});
  arm.cycles(300);
  CHECK(done(arm.answer_to(first).value()));
  CHECK(arm.reference().position == JointVector<2>(0.5, -0.5));
  CHECK(arm.remote.situation().motion == "rest");
}

TEST_CASE("each joint moves as if the other one did nothing") {
  // The same trajectory of the shoulder, alone and while the elbow is moved in every way.
  Arm alone, beside;
  const PlayTrajectory play = to(shoulder, 0.8, 2);
  alone.session->ask(play);
  beside.session->ask(play);
  const Request others[] = {Go{{{elbow, 0.7}}}, Stop{{elbow}}, to(elbow, -0.3, 0.4),
                            SetReference{{{elbow, -0.2}}},
                            PlaySignals{{{elbow, SineSignal{0.05, 2}}}, 0.3}};
  for (const Request& other : others) {
    CHECK(beside.answer_to(beside.session->ask(other)) == std::nullopt);
    for (int k = 0; k < 390; ++k) {
      alone.cycles(1);
      beside.cycles(1);
      REQUIRE(alone.reference().position[0] == beside.reference().position[0]);
      REQUIRE(alone.reference().velocity[0] == beside.reference().velocity[0]);
      REQUIRE(alone.reference().acceleration[0] == beside.reference().acceleration[0]);
    }
  }
  CHECK(alone.remote.situation().motion == "trajectory");
  alone.cycles(100);
  beside.cycles(100);
  CHECK(alone.reference().position[0] == 0.8);
  CHECK(beside.reference().position[0] == 0.8);
}

TEST_CASE("a motion that takes a joint of a trajectory ends it, and its other joint stops") {
  Arm arm;
  const auto both = arm.session->ask(
      PlayTrajectory{{{shoulder, elbow}, {{.time_from_start = 1, .positions = {0.6, 0.6}}}}});
  arm.cycles(400);
  REQUIRE(arm.reference().velocity[0] > 0.3);
  CHECK(done(arm.ask(Go{{{elbow, 0}}})));
  CHECK(arm.answer_to(both).value().verdict == support::Verdict::failed);
  CHECK(arm.motions() == Motions{"stop", "go"});
  arm.cycles(3000);
  CHECK(arm.reference().velocity == JointVector<2>(0, 0));
  CHECK(arm.reference().position[0] < 0.6);
  CHECK(arm.reference().position[1] == 0);
}

TEST_CASE(
    "a trajectory that takes a joint of another one ends it, and has nothing to do with the rest") {
  Arm arm;
  const auto both = arm.session->ask(
      PlayTrajectory{{{shoulder, elbow}, {{.time_from_start = 2, .positions = {1.2, 0.6}}}}});
  arm.cycles(400);
  const auto own = arm.session->ask(to(elbow, -0.3, 0.5));
  arm.cycles(2);
  CHECK(arm.answer_to(both).value().verdict == support::Verdict::failed);
  CHECK(arm.motions() == Motions{"stop", "trajectory"});
  CHECK(done(arm.ask(Go{{{shoulder, 0}}})));
  arm.cycles(600);
  CHECK(done(arm.answer_to(own).value()));
  CHECK(arm.reference().position[1] == -0.3);
}

TEST_CASE("the speed of trajectories holds for those that begin later, beside others or alone") {
  Arm arm;
  const auto first = arm.session->ask(to(shoulder, 0.5));
  arm.cycles(300);
  CHECK(done(arm.ask(SetTrajectorySpeed{0})));
  arm.cycles(1000);
  const JointVector<2> paused = arm.reference().position;
  const auto second = arm.session->ask(to(elbow, 0.5));
  arm.cycles(1000);
  CHECK(arm.reference().position == paused);
  CHECK(done(arm.ask(SetTrajectorySpeed{1})));
  arm.cycles(2000);
  CHECK(done(arm.answer_to(first).value()));
  CHECK(done(arm.answer_to(second).value()));

  CHECK(done(arm.ask(SetTrajectorySpeed{0.5})));
  const auto third = arm.session->ask(to(elbow, 0, 1));
  arm.cycles(1990);
  CHECK_FALSE(arm.answer_to(third));
  arm.cycles(20);
  CHECK(done(arm.answer_to(third).value()));
}

TEST_CASE("a joint returns from signals whatever another joint does") {
  Arm alone, beside;
  const PlaySignals step{{{shoulder, StepSignal{0.3, 0}}}, 0.1};
  alone.session->ask(step);
  beside.session->ask(step);
  for (int k = 0; k < 20; ++k) {
    beside.session->ask(k % 2 == 0 ? Request(Go{{{elbow, 0.5}}}) : Request(Stop{{elbow}}));
    for (int c = 0; c < 50; ++c) {
      alone.cycles(1);
      beside.cycles(1);
      REQUIRE(alone.reference().position[0] == beside.reference().position[0]);
    }
  }
  CHECK(alone.reference().position[0] == 0);
  CHECK(alone.remote.situation().motion == "rest");
}

TEST_CASE("a joint leaves signals without leaving their range, however fast they are") {
  // A sine of 0.03 rad at 5 Hz accelerates by 30 rad/s^2, stops with the shoulder's limits by 9.
  const double amplitude = 0.03;
  const PlaySignals sine{{{shoulder, SineSignal{amplitude, 5}}}, 10};
  for (int cycles = 400; cycles < 600; cycles += 13) {
    for (const bool by_stop : {false, true}) {
      CAPTURE(cycles, by_stop);
      Arm arm;
      PlaySignals play = sine;
      if (!by_stop) play.duration = cycles * 1e-3;
      arm.session->ask(play);
      arm.cycles(cycles);
      if (by_stop) arm.session->ask(Stop{});
      double farthest = 0;
      for (int k = 0; k < 2000; ++k) {
        arm.cycles(1);
        farthest = std::max(farthest, std::abs(arm.reference().position[0]));
      }
      CHECK(farthest <= amplitude * (1 + 1e-12));
      CHECK(arm.reference().velocity.isZero(0));
      if (!by_stop) CHECK(std::abs(arm.reference().position[0]) < 1e-12);
    }
  }
}

TEST_CASE("a signal of effort leaves none behind") {
  Arm arm;
  const PlaySignals play{{{shoulder, StepSignal{2, 0}, SignalTarget::effort}}, 0.2};
  arm.session->ask(play);
  arm.cycles(100);
  CHECK(arm.reference().effort[0] == 2);
  arm.cycles(200);
  CHECK(arm.reference().effort[0] == 0);
  arm.session->ask(play);
  arm.cycles(100);
  CHECK(done(arm.ask(Go{{{shoulder, 0.2}}})));
  CHECK(arm.reference().effort[0] == 0);
}

TEST_CASE(
    "a go out of a trajectory that accelerates harder than profiles keeps the velocity limit") {
  const double limit = 2.27, rise = 0.05 * limit / 2;
  PlayTrajectory play;
  play.trajectory.joint_names = {shoulder};
  play.trajectory.points = {{1, {-0.5}, {0}, {0}},
                            {1.05, {rise - 0.5}, {limit}, {0}},
                            {1.5, {rise - 0.5 + 0.45 * limit}, {limit}, {0}},
                            {2, {rise - 0.5 + 0.7 * limit}, {0}, {0}}};
  for (int cycles = 1020; cycles < 1060; cycles += 4) {
    CAPTURE(cycles);
    Arm arm;
    arm.session->ask(play);
    arm.cycles(cycles);
    arm.session->ask(Go{{{shoulder, 1}}, 0.5});
    double highest = 0;
    for (int k = 0; k < 300; ++k) {
      arm.cycles(1);
      highest = std::max(highest, arm.reference().velocity[0]);
    }
    CHECK(highest <= limit * (1 + 1e-9));
    arm.cycles(4000);
    CHECK(arm.reference().position[0] == 1);
  }
}

TEST_CASE("references that wait are set in one cycle, and what is asked after them in the next") {
  Arm arm;
  std::vector<std::uint64_t> numbers;
  for (int k = 1; k <= 20; ++k) {
    numbers.push_back(arm.session->ask(SetReference{.positions = {{shoulder, 0.001 * k}}}));
  }
  numbers.push_back(arm.session->ask(SetReference{.positions = {{elbow, 0.125}}}));
  const auto later = arm.session->ask(SetSpeed{2});
  const auto last = arm.session->ask(SetReference{.positions = {{shoulder, 0.25}}});
  arm.cycles(1);
  for (const auto number : numbers) CHECK(done(arm.answer_to(number).value()));
  CHECK(arm.reference().position[0] == 0.02);
  CHECK(arm.reference().position[1] == 0.125);
  CHECK_FALSE(arm.answer_to(later));
  arm.cycles(1);
  CHECK(done(arm.answer_to(later).value()));
  CHECK_FALSE(arm.answer_to(last));
  arm.cycles(1);
  CHECK(done(arm.answer_to(last).value()));
  CHECK(arm.reference().position[0] == 0.25);
}

TEST_CASE("a joint that is not named may be outside its limits") {
  Arm arm;
  const double beyond = model_of(Q2d()).joints[1].limits.upper + 0.01;
  arm.loop.post({.position = {0, beyond}});
  static_cast<void>(arm.loop.update());
  arm.cycles(1);  // so that the Remote knows it
  REQUIRE(arm.reference().position[1] == beyond);
  CHECK(done(arm.ask(to(shoulder, 0.3), 1500)));
  CHECK(done(arm.ask(PlaySignals{{{shoulder, StepSignal{0.1, 0}}}, 0.1}, 1500)));
  CHECK(arm.reference().position[1] == beyond);
  CHECK(done(arm.ask(Stop{{elbow}})));
}

TEST_CASE("a stop of one joint of a trajectory stops all of them") {
  Arm arm;
  const auto both = arm.session->ask(
      PlayTrajectory{{{shoulder, elbow}, {{.time_from_start = 1, .positions = {0.6, 0.6}}}}});
  arm.cycles(400);
  CHECK(done(arm.ask(Stop{{elbow}})));
  CHECK(arm.answer_to(both).value().verdict == support::Verdict::failed);
  CHECK(arm.motions() == Motions{"stop", "stop"});
}

TEST_CASE("a plan of velocities for one joint does not ask what another one does") {
  Arm arm;
  CHECK(done(arm.ask(Go{{{shoulder, 1.4}}})));
  arm.cycles(300);
  REQUIRE(arm.reference().velocity[0] > 0.7);
  PlayTrajectory play;
  play.trajectory.joint_names = {elbow};
  play.trajectory.points = {{.time_from_start = 1, .velocities = {0.2}},
                            {.time_from_start = 3, .velocities = {0}}};
  CHECK(done(arm.ask(play, 4000)));
}

TEST_CASE("the reason of a refused trajectory is not that of the running one") {
  Arm arm;
  PlayTrajectory strict = to(elbow, 0.9, 1);
  strict.path_tolerances = {{elbow, 1e-3, -1}};  // [rad]; a PID controller lags by more
  const auto running = arm.session->ask(strict);
  arm.cycles(1);
  CHECK(arm.ask(to(elbow, 1, 1e-3)).verdict == support::Verdict::refused);
  arm.cycles(1000);
  CHECK(arm.answer_to(running).value().text == "trajectory: path tolerance violated");
}

TEST_CASE("a trajectory replaces two others without a jump") {
  Arm arm;
  const auto first = arm.session->ask(to(shoulder, 0.5)), second = arm.session->ask(to(elbow, 0.5));
  arm.cycles(400);
  const auto third = arm.session->ask(
      PlayTrajectory{{{elbow, shoulder}, {{.time_from_start = 2, .positions = {-0.2, -0.4}}}}});
  JointReference<2> before = arm.reference();
  for (int k = 0; k < 2100; ++k) {
    arm.cycles(1);
    for (int j = 0; j < 2; ++j) {
      // In a period of 1 ms, the position changes by the mean velocity, and that by at most 50
      // rad/s^2.
      const double v = arm.reference().velocity[j], v_before = before.velocity[j];
      const double step = arm.reference().position[j] - before.position[j];
      REQUIRE(std::abs(step - 0.5e-3 * (v + v_before)) < 1e-6);
      REQUIRE(std::abs(v - v_before) < 0.05);
    }
    before = arm.reference();
  }
  CHECK(arm.answer_to(first).value().verdict == support::Verdict::failed);
  CHECK(arm.answer_to(second).value().verdict == support::Verdict::failed);
  CHECK(done(arm.answer_to(third).value()));
  CHECK(arm.reference().position == JointVector<2>(-0.4, -0.2));
}

TEST_CASE("a trajectory that is refused leaves those that it would replace alone") {
  Arm arm;
  const auto first = arm.session->ask(to(shoulder, 0.5)), second = arm.session->ask(to(elbow, 0.5));
  arm.cycles(400);
  const Answer refused = arm.ask(
      PlayTrajectory{{{elbow, shoulder}, {{.time_from_start = 1e-3, .positions = {-0.2, -0.4}}}}});
  CHECK(refused.verdict == support::Verdict::refused);
  arm.cycles(700);
  CHECK(done(arm.answer_to(first).value()));
  CHECK(done(arm.answer_to(second).value()));
  CHECK(arm.reference().position == JointVector<2>(0.5, 0.5));
}

TEST_CASE("a trajectory of the same joints follows the last one until its time has come") {
  Arm arm;
  const auto first = arm.session->ask(to(shoulder, 0.5));
  arm.cycles(10);
  PlayTrajectory later = to(shoulder, 0, 1);
  later.delay = 0.5;
  const auto second = arm.session->ask(later);
  arm.cycles(300);
  CHECK(arm.answer_to(first).value().verdict == support::Verdict::failed);
  CHECK(arm.reference().velocity[0] > 0.3);
  arm.cycles(1500);
  CHECK(done(arm.answer_to(second).value()));
  CHECK(arm.reference().position == JointVector<2>(0, 0));
}

TEST_CASE("a stop of one joint leaves the other one, and names must be known") {
  Arm arm;
  const auto first = arm.session->ask(to(shoulder, 0.5)), second = arm.session->ask(to(elbow, 0.5));
  arm.cycles(300);
  CHECK(done(arm.ask(Stop{{elbow}})));
  CHECK(arm.answer_to(second).value().verdict == support::Verdict::failed);
  CHECK(arm.motions() == Motions{"trajectory", "stop"});
  arm.cycles(1000);
  CHECK(done(arm.answer_to(first).value()));
  CHECK(arm.reference().position[1] < 0.5);
  const Answer unknown = arm.ask(Stop{{"knee"}});
  CHECK(unknown.verdict == support::Verdict::refused);
  CHECK_THAT(unknown.text, Contains("knee"));
}

TEST_CASE("a joint far from its trajectory ends this one alone") {
  Arm arm;
  PlayTrajectory strict = to(elbow, 0.9, 1);
  strict.path_tolerances = {{elbow, 1e-4, -1}};  // [rad]; a PID controller lags by more
  const auto first = arm.session->ask(to(shoulder, 0.5)), second = arm.session->ask(strict);
  arm.cycles(100);
  arm.cycles(200);
  CHECK(arm.answer_to(second).value().outcome == TrajectoryOutcome::path_tolerance_violated);
  CHECK_FALSE(arm.answer_to(first));
  arm.cycles(1000);
  CHECK(done(arm.answer_to(first).value()));
  CHECK(arm.reference().position[0] == 0.5);
}

TEST_CASE("signals of other joints end the signals before") {
  Arm arm;
  const auto first = arm.session->ask(PlaySignals{{{shoulder, StepSignal{0.1, 0}}}, 5});
  arm.cycles(100);
  CHECK(arm.reference().position[0] == 0.1);
  const auto second = arm.session->ask(PlaySignals{{{elbow, StepSignal{0.1, 0}}}, 0.5});
  arm.cycles(100);
  CHECK(arm.answer_to(first).value().verdict == support::Verdict::failed);
  CHECK(arm.reference().position == JointVector<2>(0.1, 0.1));
  arm.cycles(2000);
  CHECK(done(arm.answer_to(second).value()));
  CHECK(arm.reference().position == JointVector<2>(0.1, 0));
}

TEST_CASE("a plan at the velocity limit is followed a little more slowly, and the log says so") {
  Arm arm;
  // Quintics between points of equal velocity that are a little farther apart than that velocity
  // takes them: in the middle, they are faster by 15/8 of the mean excess.
  const double limit = 2.27, excess = 0.01, step = 0.1;
  PlayTrajectory play;
  play.trajectory.joint_names = {shoulder};
  const double distance = limit * step * (1 + excess * 8 / 15);
  double position = -0.4;
  play.trajectory.points.push_back({1, {position}, {0}, {0}});
  play.trajectory.points.push_back({1.5, {position + 0.5 * limit / 2}, {limit}, {0}});
  position += 0.5 * limit / 2;
  play.trajectory.points.push_back({1.6, {position += distance}, {limit}, {0}});
  play.trajectory.points.push_back({2.1, {position += 0.5 * limit / 2}, {0}, {0}});
  SECTION("which is still within the limit") {
    while (arm.session->event()) {
    }
    const auto number = arm.session->ask(play);
    double highest = 0;
    for (int k = 0; k < 2300; ++k) {
      arm.cycles(1);
      highest = std::max(highest, arm.reference().velocity[0]);
    }
    CHECK(done(arm.answer_to(number).value()));
    CHECK(highest <= limit * (1 + 1e-9));
    CHECK(highest > limit * 0.99);
    CHECK(arm.reference().position[0] == position);
    bool told = false;
    while (const auto event = arm.session->event()) {
      INFO(event->text);
      told = told || event->text.find("velocity limit, 2.27") != std::string::npos;
    }
    CHECK(told);
  }
  SECTION("also one that exceeds it by rounding at a point only") {
    for (auto& point : play.trajectory.points) point.time_from_start *= 1.02;
    double above = limit;
    for (int k = 0; k < 300; ++k) {
      above = std::nextafter(above, 3);
      play.trajectory.points[1].velocities = {above};
      const auto number = arm.session->ask(play);
      arm.cycles(2);
      CHECK_FALSE(arm.answer_to(number));
    }
  }
  SECTION("and refused if it exceeds it by more than planners do") {
    for (auto& point : play.trajectory.points) point.time_from_start *= 0.94;
    CHECK_THAT(arm.ask(play).text, Contains("its limit is 2.27"));
  }
}
