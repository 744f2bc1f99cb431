// SPDX-License-Identifier: Apache-2.0
#include <articula/control/switching/switch.hpp>

#include "catch.hpp"
#include "remote/remote_arm.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

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

constexpr FutureSpread no_spread{
    .mass = 0, .friction = 0, .delay = 0, .position_noise = 0, .velocity_noise = 0};

/// A question for the recorded cycle `first`, with the references of the cycles from there on.
FuturesQuestion from_recorded(const std::vector<Cycle>& cycles, std::size_t first, int count) {
  FuturesQuestion question{
      .options = {.spread = no_spread, .count = 1, .horizon = 1e-3 * count, .samples = count}};
  const Cycle& at = cycles[first];
  question.start = {at.time, at.position, at.velocity, at.effort};
  // Back to a cycle in which no drive is at its limit.
  const auto effort = effort_limits(Q2d());
  std::size_t before = first - 1;
  while (std::abs(cycles[before].command[0][0]) >= effort[0]) --before;
  for (; before < first; ++before) {
    const Cycle& own = cycles[before];
    question.history.push_back({{own.time, own.position, own.velocity, own.effort},
                                {own.reference_position, own.reference_velocity,
                                 own.reference_acceleration, own.reference_effort},
                                own.command});
  }
  for (std::size_t k = first; k < first + static_cast<std::size_t>(count); ++k) {
    const Cycle& own = cycles[k];
    question.references.push_back({own.reference_position, own.reference_velocity,
                                   own.reference_acceleration, own.reference_effort});
  }
  return question;
}
/// The largest distance of a future from what was recorded [rad].
double distance(const FuturesAnswer& answer, const std::vector<Cycle>& cycles, std::size_t first) {
  double most = 0;
  for (std::size_t j = 0; j < 2; ++j) {
    const std::vector<double>& own = answer.futures.at(0).positions.at(j);
    for (std::size_t k = 0; k < own.size(); ++k) {
      most = std::max(most, std::abs(own[k] - cycles.at(first + k).position[j]));
    }
  }
  return most;
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
  const auto answer = arm.remote.futures({.options = {.count = 5}});
  CHECK(answer.time == time);
  CHECK(answer.horizon == 1);
  REQUIRE(answer.futures.size() == 5);
  for (const FutureTrajectory& future : answer.futures) {
    REQUIRE(future.positions.size() == 2);
    REQUIRE(future.positions[0].size() == 51);
    CHECK(future.positions[0].front() == position[0]);
    CHECK(future.positions[0].back() == Approx(0.3).margin(0.05));
    CHECK(future.end == SimulationEnd::stable);
  }
}

TEST_CASE("futures have the gains of the question, and the loop keeps its own") {
  SupervisedArm arm;
  REQUIRE(arm.ask(Activate{}).verdict == remote::Verdict::done);
  arm.cycles(10);
  const double before = value_of(arm.remote, shoulder_d);
  const FuturesQuestion question{.gains = {{shoulder_d, 1000}}, .options = {.count = 5}};
  const auto answer = arm.remote.futures(question);
  for (const FutureTrajectory& future : answer.futures)
    CHECK(future.end == SimulationEnd::unstable);
  CHECK(value_of(arm.remote, shoulder_d) == before);
  CHECK(arm.loop.controller().part<PidLaw<2>>().gains()[0].derivative == before);
}

TEST_CASE("futures have the gains that were applied since the port was made") {
  SupervisedArm arm;
  REQUIRE(arm.ask(Activate{}).verdict == remote::Verdict::done);
  REQUIRE(arm.ask(SetParameters{{{shoulder_d, 1000}}}).verdict == remote::Verdict::done);
  arm.cycles(1);
  CHECK(arm.remote.futures({.options = {.count = 1}}).futures[0].end == SimulationEnd::unstable);
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
  CHECK(end() == SimulationEnd::stable);
  CHECK(margins() == second);
  REQUIRE(arm.ask(SwitchControllers{.start = {first}, .replace = true}).verdict ==
          remote::Verdict::done);
  arm.cycles(10);
  CHECK(end() == SimulationEnd::unstable);
  CHECK(margins() == first);
}

TEST_CASE(
    "futures from a recorded cycle are the recorded motion, or another one with other gains") {
  SupervisedArm arm;
  REQUIRE(arm.ask(Activate{}).verdict == remote::Verdict::done);
  REQUIRE(arm.ask(Go{{{support::shoulder, 0.4}, {support::elbow, -0.3}}}).verdict ==
          remote::Verdict::done);
  arm.cycles(600);
  std::vector<Cycle> cycles;
  for (Cycle cycle; arm.session->next(cycle);) cycles.push_back(cycle);
  const std::size_t first = cycles.size() - 500;
  REQUIRE(std::abs(cycles[first].position[0] - cycles.back().position[0]) > 0.1);
  FuturesQuestion question = from_recorded(cycles, first, 400);
  REQUIRE(arm.ask(Deactivate{}).verdict == remote::Verdict::done);  // needs no active loop
  const auto same = arm.remote.futures(question);
  CHECK(same.time == cycles[first].time);
  // A hundredth of the controller's own error in this motion, which is some milliradians.
  CHECK(distance(same, cycles, first) < 3e-5);
  question.gains = {{"pid_plus_gravity.shoulder_active_joint.p", 200}};
  CHECK(distance(arm.remote.futures(question), cycles, first) > 0.01);
  // Every tenth reference says as much of a smooth motion.
  FuturesQuestion coarse = from_recorded(cycles, first, 400);
  coarse.reference_step = 0.01;
  for (std::size_t k = 0; k < 40; ++k) coarse.references[k] = coarse.references[10 * k];
  coarse.references.resize(40);
  double fastest = 0;
  for (const Cycle& own : cycles) {
    for (const double v : own.reference_velocity) fastest = std::max(fastest, std::abs(v));
  }
  CHECK(distance(arm.remote.futures(coarse), cycles, first) < 0.01 * fastest);  // held for 10 ms
}

TEST_CASE("a test step moves the futures of an arm that rests") {
  SupervisedArm arm;
  REQUIRE(arm.ask(Activate{}).verdict == remote::Verdict::done);
  arm.cycles(2);
  FuturesQuestion question{.options = {.spread = no_spread, .count = 1}};
  const auto end = [&](std::size_t joint) {
    return arm.remote.futures(question).futures[0].positions[joint].back();
  };
  CHECK(end(0) == Approx(0).margin(1e-6));
  question.steps = {{support::shoulder, 0.1}};
  CHECK(end(0) == Approx(0.1).margin(0.01));
  CHECK(end(1) == Approx(0).margin(0.01));
  question.steps = {{support::elbow, 2}};
  CHECK(refusal(arm.remote, question).find("to 2, which is not within its limits") !=
        std::string::npos);
  question.steps = {{"wrist", 0.1}};
  CHECK(refusal(arm.remote, question).find("wrist") != std::string::npos);
}

TEST_CASE("starts and references that do not fit are refused with what was expected") {
  PlainArm arm;
  arm.cycles(6);
  std::vector<Cycle> cycles;
  for (Cycle cycle; arm.session->next(cycle);) cycles.push_back(cycle);
  const FuturesQuestion good = from_recorded(cycles, 1, 2);
  CHECK(refusal(arm.remote, good).empty());
  const auto with = [&](auto&& change) {
    FuturesQuestion question = good;
    change(question);
    return refusal(arm.remote, question);
  };
  CHECK(with([](auto& x) { x.start->velocity.pop_back(); }) ==
        "futures: start: velocity has 1 numbers; expected one for each of 2 joints");
  CHECK(with([](auto& x) { x.start->position[0] = std::numeric_limits<double>::quiet_NaN(); }) ==
        "futures: start: position is not finite");
  CHECK(with([](auto& x) { x.history[0].command.clear(); }).find("command has 0") !=
        std::string::npos);
  CHECK(with([](auto& x) { x.references[1].position.clear(); }).find("a reference's position") !=
        std::string::npos);
  CHECK(with([](auto& x) { x.reference_step = 1e-9; }).find("reference_step") != std::string::npos);
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
