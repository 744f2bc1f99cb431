// SPDX-License-Identifier: Apache-2.0
// The loop's side of a Remote does not touch the heap, whatever it is asked.
#include "allocation_guard.hpp"
#include "articula/remote/request_text.hpp"
#include "catch.hpp"
#include "remote/remote_arm.hpp"

using namespace articula;
using namespace articula::remote;
using articula::testing::heap_calls_in;
using support::elbow;
using support::shoulder;

namespace {

template <class R>
using Controllers = Switch<R, PidPlusGravity<R>, ComputedTorque<R>>;

/// The calls of the heap by the loop's side in some cycles after each request.
template <class Arm>
std::size_t heap_calls(Arm& arm, const std::vector<Request>& requests, bool supervised) {
  std::size_t calls = 0;
  RunReport report;
  for (const Request& request : requests) {
    arm.session->ask(request);
    calls += heap_calls_in([&] {
      for (int k = 0; k < 1500; ++k) {
        static_cast<void>(arm.remote.update());
        ++report.overruns;
        arm.remote.report(report);
        if (k == 100) arm.remote.missed_periods(1);
      }
    });
    const bool of_mode =
        std::holds_alternative<Activate>(request) || std::holds_alternative<Deactivate>(request);
    const auto answer = arm.session->answer();
    CAPTURE(name_of(request), answer ? answer->text : "no answer");
    CHECK(answer);
    if (answer) CHECK((answer->verdict == support::Verdict::done) == (supervised || !of_mode));
  }
  return calls;
}

const std::vector<Request> requests{
    Activate{},
    Go{{{shoulder, 0.5}}},
    Go{{{shoulder, -0.5}, {elbow, 0.5}}},
    SetReference{{{shoulder, 0.1}}, {{shoulder, 0.1}}, {{elbow, 1}}},
    PlayTrajectory{{{elbow}, {{.time_from_start = 0.5, .positions = {0.5}}}}},
    PlaySignals{{{shoulder, StepSignal{0.2, 0.1}}}, 0.2},
    Stop{{elbow}},
    Stop{},
    SwitchControllers{.start = {"computed_torque"}, .replace = true},
    SetParameters{{{"pid_plus_gravity." + shoulder + ".p", 1000}}},
    Pause{true},
    Step{3},
    Pause{false},
    SetSpeed{3},
    SetSpeed{1},
    Pull{"tool_link", {0.1, 0, 0}, {1, 2, 3}},
    Reset{},
    Deactivate{}};

}  // namespace

TEST_CASE("no request makes the loop's side touch the heap") {
  support::RemoteArm<SupervisedLoop<Q2dSim, Controllers>> supervised;
  CHECK(heap_calls(supervised, requests, true) == 0);
  support::RemoteArm<Loop<Q2dSim, Controllers>> plain;
  CHECK(heap_calls(plain, requests, false) == 0);
}

TEST_CASE("a run that pushes each cycle's record does not touch the heap, and none is lost") {
  support::RemoteArm<Loop<Q2dSim, Controllers>> arm;
  arm.ask(Go{{{shoulder, 0.5}}});
  struct Records {
    std::uint64_t count = 0;
    double time = 0, position = 0;
    bool in_order = true;
    void push(const CycleRecordOf<Loop<Q2dSim, Controllers>>& record) noexcept {
      in_order = in_order && (count == 0 || record.time > time);
      ++count;
      time = record.time;
      position = record.state.position[0];
    }
  } records;
  SimulatedClock clock;
  CHECK(heap_calls_in([&] {
          static_cast<void>(run(arm.remote, clock, {.cycles = 2000}, arm.remote.each(records)));
        }) == 0);
  CHECK(records.count == 2000);
  CHECK(records.in_order);
  CHECK(records.position == arm.remote.state().position[0]);
  CHECK(arm.remote.statistics().cycles > 0);  // the timing, too, is published
}

TEST_CASE("a lost operator and full rings do not make the loop's side touch the heap") {
  support::RemoteArm<SupervisedLoop<Q2dSim, Controllers>> arm;
  arm.ask(Activate{});
  arm.ask(Go{{{shoulder, 0.5}}});
  arm.session.reset();
  CHECK(heap_calls_in([&] { arm.cycles(3000); }) == 0);
  CHECK(heap_calls_in([&] { static_cast<void>(arm.remote.stop()); }) == 0);
}
