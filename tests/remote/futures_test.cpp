// SPDX-License-Identifier: Apache-2.0
#include <articula/control/switching/switch.hpp>

#include "catch.hpp"
#include "remote_arm.hpp"

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>

using namespace articula;
using namespace articula::remote;
using support::PlainArm;
using support::SupervisedArm;

namespace {

const std::string shoulder_d = "pid_plus_gravity.shoulder_active_joint.d";

std::string refusal(Port& port, const FuturesQuestion& question) {
  try {
    static_cast<void>(port.futures(question));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

/// The value of a gain that the loop has.
double value_of(Port& port, const std::string& name) {
  for (const Parameter& parameter : port.parameters()) {
    if (parameter.name == name) return parameter.value;
  }
  return -1;
}

template <class R>
using Both = Switch<R, PidPlusGravity<R>, ComputedTorque<R>>;

}  // namespace

TEST_CASE("futures begin with the present state and follow the present reference") {
  PlainArm arm;
  arm.loop.reference().position << 0.3, -0.2;
  arm.cycles(40);
  const double time = arm.loop.time();
  const JointVector<2> position = arm.loop.state().position;
  arm.cycles(1);  // publishes the last one
  const auto answer = arm.remote.futures({.options = {.count = 20}});
  CHECK(answer.time == time);
  CHECK(answer.horizon == 1);
  REQUIRE(answer.futures.size() == 20);
  for (const FutureTrajectory& future : answer.futures) {
    REQUIRE(future.positions.size() == 2);
    REQUIRE(future.positions[0].size() == 51);
    CHECK(future.positions[0].front() == position[0]);
    CHECK(future.positions[0].back() == Approx(0.3).margin(0.05));
    CHECK(future.end == FutureEnd::stable);
  }
}

TEST_CASE("futures have the gains of the question, and the loop keeps its own") {
  SupervisedArm arm;
  REQUIRE(arm.ask(Activate{}).verdict == remote::Verdict::done);
  arm.cycles(10);
  const double before = value_of(arm.remote, shoulder_d);
  const FuturesQuestion question{.gains = {{shoulder_d, 1000}}, .options = {.count = 5}};
  const auto answer = arm.remote.futures(question);
  for (const FutureTrajectory& future : answer.futures) CHECK(future.end == FutureEnd::unstable);
  CHECK(value_of(arm.remote, shoulder_d) == before);
  CHECK(arm.loop.controller().part<PidLaw<2>>().gains()[0].derivative == before);
}

TEST_CASE("futures have the gains that were applied since the port was made") {
  SupervisedArm arm;
  REQUIRE(arm.ask(Activate{}).verdict == remote::Verdict::done);
  REQUIRE(arm.ask(SetParameters{{{shoulder_d, 1000}}}).verdict == remote::Verdict::done);
  arm.cycles(1);
  CHECK(arm.remote.futures({.options = {.count = 1}}).futures[0].end == FutureEnd::unstable);
}

TEST_CASE("the margins are those of the question's gains at the present position") {
  PlainArm arm;
  arm.cycles(10);
  const auto margins = arm.remote.futures({.options = {.count = 1}}).margins;
  REQUIRE(margins.size() == 2);
  CHECK(margins[0].controller == "pid_plus_gravity");
  CHECK(margins[0].joint == support::shoulder);
  const StabilityMargins own = stability_margins(
      joint_plant(Q2d(), arm.loop.state().position, 0, OtherJoints::free), Q2d::pid_gains[0], 5e-4);
  CHECK(margins[0].stable);
  CHECK(margins[0].gain_margin == own.gain_margin);
  CHECK(margins[0].phase_margin == own.phase_margin);
  CHECK(margins[0].delay_margin == own.delay_margin);
  const FuturesQuestion question{.gains = {{shoulder_d, 1000}}, .options = {.count = 1}};
  CHECK(arm.remote.futures(question).margins[0].phase_margin != own.phase_margin);
}

TEST_CASE("questions without an answer are refused with the reason") {
  SupervisedArm arm;
  CHECK(refusal(arm.remote, {}) == "futures: the loop is not active");
  REQUIRE(arm.ask(Activate{}).verdict == remote::Verdict::done);
  arm.cycles(2);
  CHECK(refusal(arm.remote, {.gains = {{shoulder_d, -1}}}).find(shoulder_d) != std::string::npos);
  CHECK(refusal(arm.remote, {.gains = {{"no.such.gain", 1}}}).find("no.such.gain") !=
        std::string::npos);
  CHECK(refusal(arm.remote, {.options = {.count = 1000, .horizon = 2}}).find("cycles in all") !=
        std::string::npos);
  CHECK(refusal(arm.remote, {.options = {.samples = 1000}}).find("positions") != std::string::npos);
  StopFlag stop;
  stop.request();
  CHECK(refusal(arm.remote, {.stop = &stop}).find("none is complete") != std::string::npos);
  CHECK(refusal(arm.remote, {.options = {.samples = 0}}).find("samples") != std::string::npos);
}

TEST_CASE("futures of a loop that switches are those of the controller that is active") {
  support::RemoteArm<SupervisedLoop<Q2dSim, Both>> arm;
  REQUIRE(arm.ask(Activate{}).verdict == remote::Verdict::done);
  const FuturesQuestion question{.gains = {{shoulder_d, 1000}}, .options = {.count = 1}};
  const auto end = [&] { return arm.remote.futures(question).futures[0].end; };
  const auto margins = [&] { return arm.remote.futures(question).margins[0].controller; };
  const std::string first = std::string(arm.remote.situation().controllers[0].name.view()),
                    second = std::string(arm.remote.situation().controllers[1].name.view());
  REQUIRE(arm.ask(SwitchControllers{.start = {second}, .replace = true}).verdict ==
          remote::Verdict::done);
  arm.cycles(10);
  CHECK(end() == FutureEnd::stable);
  CHECK(margins() == second);
  REQUIRE(arm.ask(SwitchControllers{.start = {first}, .replace = true}).verdict ==
          remote::Verdict::done);
  arm.cycles(10);
  CHECK(end() == FutureEnd::unstable);
  CHECK(margins() == first);
}

TEST_CASE("futures are computed beside a running loop") {
  SupervisedArm arm;
  REQUIRE(arm.ask(Activate{}).verdict == remote::Verdict::done);
  arm.cycles(2);
  std::atomic<int> answers = 0;
  std::thread asks([&] {
    for (int k = 0; k < 3; ++k) {
      answers += arm.remote.futures({.options = {.count = 10}}).futures.empty() ? 0 : 1;
    }
  });
  while (answers < 3) arm.cycles(1);
  asks.join();
  CHECK(arm.loop.mode() == LoopMode::active);
}
