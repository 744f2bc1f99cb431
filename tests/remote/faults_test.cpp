// SPDX-License-Identifier: Apache-2.0
// Faults end motions, are told with their cure, and are acknowledged.
#include <articula/hardware/mock/mock_hardware.hpp>
#include <articula/loop/simulated_clock.hpp>

#include <string>

#include "catch.hpp"
#include "numbers.hpp"
#include "remote/remote_arm.hpp"

using namespace articula;
using namespace articula::remote;
using support::elbow;
using support::PlainArm;
using support::RemoteArm;
using support::shoulder;

namespace {

using MockArm = RemoteArm<SupervisedLoop<MockHardware<Q2d>, PidPlusGravity>>;

MockHardware<Q2d> failing(MockFaultKind kind, std::uint64_t first, std::uint64_t count) {
  return MockHardware<Q2d>({{kind, first, count}});
}

}  // namespace

TEST_CASE("a fault ends a trajectory, is told with its cure, and is acknowledged") {
  MockArm arm({}, failing(MockFaultKind::fails_to_read, 100, 10));
  REQUIRE(arm.ask(Activate{}).verdict == support::Verdict::done);
  const Answer answer =
      arm.ask(PlayTrajectory{{{elbow}, {{.time_from_start = 1, .positions = {0.5}}}}}, 200);
  CHECK(answer.verdict == support::Verdict::failed);
  CHECK(answer.text == "the loop is not active any more (hardware fault)");
  arm.cycles(20);
  const Situation now = arm.remote.situation();
  CHECK(now.mode == LoopMode::fault);
  CHECK(now.fault == Status::hardware_fault);
  CHECK(now.advice.find("check power") != std::string::npos);
  CHECK(now.motion == "rest");
  CHECK(arm.ask(Go{{{elbow, 1}}}).text ==
        "the loop is in fault (hardware fault): acknowledge it first");
  CHECK(arm.ask(Activate{}).verdict == support::Verdict::refused);
  CHECK(arm.ask(AcknowledgeFault{}).verdict == support::Verdict::done);
  CHECK(arm.remote.situation().mode == LoopMode::inactive);
  CHECK(arm.ask(Activate{}).verdict == support::Verdict::done);
  bool told = false;
  while (const auto event = arm.session->event()) {
    told = told || (event->level == Event::Level::error &&
                    event->text.find("fault: hardware fault. The hardware") == 0);
  }
  CHECK(told);
}

TEST_CASE("a fault for a limit names the joint, what was measured, and the limit") {
  support::SupervisedArm arm;
  REQUIRE(arm.ask(Activate{}).verdict == support::Verdict::done);
  arm.session->ask(Pull{.link = "elbow_active_link", .force = {0, 900, 0}});
  arm.cycles(200);
  const Situation now = arm.remote.situation();
  CHECK(now.fault == Status::limit_exceeded);
  INFO(now.advice);
  const auto named = now.advice.find("Measured: joint 'shoulder_active_joint': velocity ");
  CHECK(named != std::string::npos);
  CHECK(now.advice.find("is above the limit 2.27") > named);
  bool told = false;
  while (const auto event = arm.session->event()) {
    told = told || event->text == "fault: limit exceeded. " + now.advice;
  }
  CHECK(told);
}

TEST_CASE("an activation that fails is refused with the fault") {
  MockArm arm({}, failing(MockFaultKind::refuses_activation, 0, 1000));
  const Answer answer = arm.ask(Activate{});
  CHECK(answer.verdict == support::Verdict::refused);
  CHECK(answer.text == "the loop is in fault (hardware fault): acknowledge it first");
}

TEST_CASE("every fault has a cure") {
  for (int k = 1; k <= static_cast<int>(Status::inactive); ++k) {
    CHECK(!advice_on(static_cast<Status>(k)).empty());
  }
  CHECK(advice_on(Status::ok).empty());
}

TEST_CASE("the reference at rest outlives its lifetime, since the remote posts it") {
  RemoteArm<SupervisedLoop<Q2dSim, PidPlusGravity>> arm(
      {}, SupervisionOptions{.reference_lifetime = 0.01});
  REQUIRE(arm.ask(Activate{}).verdict == support::Verdict::done);
  arm.cycles(1000);
  CHECK(arm.loop.mode() == LoopMode::active);
}

TEST_CASE("a plain loop shows the status of its last cycle, and a bad reference is refused") {
  PlainArm arm;
  arm.cycles(3);
  arm.loop.reference().position[0] = support::not_a_number;
  arm.cycles(3);
  CHECK(arm.remote.situation().fault == Status::non_finite_reference);
  const Answer answer = arm.ask(Go{{{elbow, 1}}});
  CHECK(answer.verdict == support::Verdict::refused);
  CHECK(answer.text.find("not finite") != std::string::npos);
  arm.loop.reference() = {};
  arm.cycles(3);
  CHECK(arm.remote.situation().fault == Status::ok);
}

TEST_CASE("the end of a run answers what is under way") {
  MockArm arm;
  REQUIRE(arm.ask(Activate{}).verdict == support::Verdict::done);
  const auto number =
      arm.session->ask(PlayTrajectory{{{elbow}, {{.time_from_start = 1, .positions = {0.5}}}}});
  SimulatedClock clock;
  const RunReport report = arm.remote.run(clock, {.cycles = 100});
  CHECK(report.end == RunEnd::finished);
  CHECK(arm.loop.mode() == LoopMode::inactive);
  const auto answer = arm.session->answer();
  REQUIRE(answer);
  CHECK(answer->request == number);
  CHECK(answer->verdict == support::Verdict::failed);
}
