// SPDX-License-Identifier: Apache-2.0
// What a port publishes is a recording that a replay reproduces to the last bit.
#include <articula/replay/add_cycle.hpp>

#include <cstddef>
#include <memory>
#include <string>

#include "catch.hpp"
#include "recorded_runs.hpp"
#include "remote/remote_arm.hpp"

using namespace articula;
using namespace articula::remote;
using support::elbow;
using support::RemoteArm;
using support::shoulder;

namespace {

template <class R>
using TwoControllers = Switch<R, PidPlusGravity<R>, ComputedTorque<R>>;
using SwitchedArm = RemoteArm<SupervisedLoop<Q2dSim, TwoControllers>>;
using SwitchedLoop = SupervisedLoop<Q2dSim, TwoControllers>;
using PlainLoop = Loop<Q2dSim, PidPlusGravity>;

/// Takes all that a session has received.
template <class LoopType>
void take(Session& session, RecordingOf<LoopType>& recording) {
  for (Cycle cycle; session.next(cycle);) add_cycle(recording, cycle);
}

/// The first difference in words; empty if there is none.
template <class LoopType>
std::string difference(const RecordingOf<LoopType>& recording) {
  Replay<LoopType> replay(recording);
  const auto found = replay.run();
  CHECK(replay.is_done());
  return found ? to_string(*found) : "";
}

/// Motions, set-points, gains, seven cycles in a period, single steps and a pull.
/// @param p  the first of the gains
template <class Arm>
void operate(Arm& arm, const std::string& controller, double p) {
  CHECK(arm.ask(Go{{{shoulder, 0.5}, {elbow, -0.4}}}).verdict == support::Verdict::done);
  arm.cycles(150);
  CHECK(arm.ask(SetParameters{{{controller + "." + shoulder + ".p", p},
                               {controller + "." + elbow + ".d", 1.5}}})
            .verdict == support::Verdict::done);
  arm.cycles(200);
  CHECK(arm.ask(SetReference{{{shoulder, 0.45}}, {}, {{elbow, 0.1}}}).verdict ==
        support::Verdict::done);
  arm.cycles(100);
  CHECK(arm.ask(SetSpeed{7}).verdict == support::Verdict::done);  // seven cycles in each period
  CHECK(arm.ask(Go{{{shoulder, -0.5}}}).verdict == support::Verdict::done);
  CHECK(arm.ask(SetParameters{{{controller + "." + shoulder + ".p", 1.2 * p}}}).verdict ==
        support::Verdict::done);
  arm.cycles(20);
  CHECK(arm.ask(SetSpeed{1}).verdict == support::Verdict::done);
  CHECK(arm.ask(Pause{}).verdict == support::Verdict::done);
  CHECK(arm.ask(SetParameters{{{controller + "." + shoulder + ".p", 1.3 * p}}}).verdict ==
        support::Verdict::done);
  CHECK(arm.ask(Step{3}).verdict == support::Verdict::done);
  CHECK(arm.ask(Pause{false}).verdict == support::Verdict::done);
  CHECK(arm.ask(Pull{"tool_link", {0, 0, 0}, {0, 20, 0}}).verdict == support::Verdict::done);
  arm.cycles(100);
}

/// An operated run of a loop that switches, from its first cycle on.
RecordingOf<SwitchedLoop> operated_run() {
  RecordingOf<SwitchedLoop> recording;
  SwitchedArm arm({}, support::noisy_q2d());
  CHECK(arm.ask(Activate{}).verdict == support::Verdict::done);
  operate(arm, "pid_plus_gravity", 100);
  CHECK(arm.ask(SwitchControllers{{"computed_torque"}, {"pid_plus_gravity"}}).verdict ==
        support::Verdict::done);
  operate(arm, "computed_torque", 200);
  CHECK(arm.ask(Deactivate{}).verdict == support::Verdict::done);
  arm.cycles(10);
  CHECK(arm.ask(SwitchControllers{.start = {"pid_plus_gravity"}, .replace = true}).verdict ==
        support::Verdict::done);
  CHECK(arm.ask(Activate{}).verdict == support::Verdict::done);
  CHECK(arm.ask(Go{{{shoulder, 0.2}}}).verdict == support::Verdict::done);
  arm.cycles(300);
  take<SwitchedLoop>(*arm.session, recording);
  return recording;
}

}  // namespace

TEST_CASE("a run that was operated through a port is replayed to the last bit") {
  const auto recording = operated_run();
  CHECK(recording.cycles.size() > 1500);
  CHECK(recording.changes.size() == 8);
  CHECK(difference<SwitchedLoop>(recording) == "");
}

TEST_CASE("each change through a port is in the record of the first cycle that has it") {
  const auto whole = operated_run();
  int found = 0;
  for (std::size_t k = 0; k < whole.changes.size(); ++k) {
    CAPTURE(k);
    auto early = whole, late = whole, lacking = whole;
    --early.changes[k].cycle;
    ++late.changes[k].cycle;
    lacking.changes.erase(lacking.changes.begin() + static_cast<std::ptrdiff_t>(k));
    const bool is_active =
        whole.cycles[whole.changes[k].cycle - whole.cycles.front().cycle].status == Status::ok;
    CHECK(Replay<SwitchedLoop>(lacking).run());
    if (!is_active) continue;  // what changes in an inactive loop acts from the activation on
    found += Replay<SwitchedLoop>(early).run() ? 1 : 0;
    found += Replay<SwitchedLoop>(late).run() ? 1 : 0;
  }
  CHECK(found >= 10);  // of 14: a cycle whose commands are at their limits shows nothing
}

TEST_CASE("a plain loop that was operated through a port is replayed to the last bit") {
  RemoteArm<PlainLoop> arm({}, support::noisy_q2d());
  operate(arm, "pid_plus_gravity", 100);
  RecordingOf<PlainLoop> recording;
  take<PlainLoop>(*arm.session, recording);
  CHECK(recording.cycles.size() > 600);
  CHECK(difference<PlainLoop>(recording) == "");
}

TEST_CASE("a recording that begins while a supervised loop is inactive is replayed") {
  SwitchedArm arm({}, support::noisy_q2d());
  CHECK(arm.ask(Activate{}).verdict == support::Verdict::done);
  CHECK(arm.ask(Go{{{shoulder, 0.5}}}).verdict == support::Verdict::done);
  arm.cycles(333);
  const auto in_motion = arm.remote.connect("begins in a motion", false);
  arm.cycles(10);
  CHECK(arm.ask(Deactivate{}).verdict == support::Verdict::done);
  const auto at_rest = arm.remote.connect("begins at rest", false);
  arm.cycles(5);
  CHECK(arm.ask(Activate{}).verdict == support::Verdict::done);
  operate(arm, "pid_plus_gravity", 100);
  RecordingOf<SwitchedLoop> recording, other;
  take<SwitchedLoop>(*at_rest, recording);
  REQUIRE(recording.cycles.size() > 600);
  CHECK(recording.cycles.front().time > 0.3);
  CHECK(difference<SwitchedLoop>(recording) == "");
  take<SwitchedLoop>(*in_motion, other);
  CHECK_THROWS_WITH(Replay<SwitchedLoop>(other), Catch::Contains("in the middle of its run"));
  recording.cycles.erase(recording.cycles.begin() + 200);
  const auto gap = Replay<SwitchedLoop>(recording).run();
  REQUIRE(gap);
  CHECK(gap->quantity == "time");
}

TEST_CASE("a cycle of another robot is not added to a recording") {
  Recording<2, EffortCommand<2>> recording;
  Cycle cycle{.position = {1}, .velocity = {1}, .effort = {1}};
  CHECK_THROWS_WITH(add_cycle(recording, cycle), "recording: the cycle has 1 joints, not 2");
  CHECK(recording.cycles.empty());
}
