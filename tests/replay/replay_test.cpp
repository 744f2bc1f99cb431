// SPDX-License-Identifier: Apache-2.0
#include <articula/hardware/mock/mock_hardware.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>

#include "catch.hpp"
#include "recorded_runs.hpp"

using namespace articula;
using support::recorded;
using support::reference_at;

namespace {

using PidLoop = Loop<Q2dSim, PidPlusGravity>;

/// The first difference in words; empty if there is none.
template <class LoopType, class... Options>
std::string difference(const RecordingOf<LoopType>& recording, const Options&... options) {
  Replay<LoopType> replay(recording, options...);
  const auto found = replay.run();
  return found ? to_string(*found) : "";
}

RecordingOf<PidLoop> saturated_run() {
  PidLoop loop(support::noisy_q2d());
  return recorded(loop, 3000,
                  [&](std::uint64_t, auto&) { loop.reference() = reference_at(loop.next_time()); });
}

/// Fails now and then, and counts, so that it has a memory.
template <class R>
struct Unreliable {
  std::uint64_t count = 0;

  void start(const ControlInput<2>&) noexcept { count = 0; }
  [[nodiscard]] Outcome<EffortCommand<2>> update(const ControlInput<2>& in) noexcept {
    ++count;
    EffortCommand<2> command{3 * (in.reference.position - in.state.position)};
    command.effort[0] += 1e-3 * static_cast<double>(count) + 0.1 * in.cut[0];
    if (count % 97 == 0) command.effort[1] = std::numeric_limits<double>::infinity();
    return {command, count % 61 == 0 ? Verdict::failed : Verdict::fine};
  }
};

}  // namespace

TEST_CASE("a run replayed through the same types gives the recorded commands to the last bit") {
  const auto recording = saturated_run();
  const JointVector<2> limits = effort_limits(Q2d());
  int saturated = 0;
  for (const auto& record : recording.cycles) {
    saturated += std::abs(record.command.effort[0]) == limits[0];
  }
  CHECK(saturated > 50);
  CHECK(difference<PidLoop>(recording) == "");
}

TEST_CASE("a gain that differs in its last bit is found, and where") {
  auto recording = saturated_run();
  JointPidGains<2> gains = Q2d::pid_gains;
  gains[1].derivative = std::nextafter(gains[1].derivative, 100.0);
  const Replay<PidLoop>::ControllerType other(gains);
  Replay<PidLoop> replay(recording, {.controller = other});
  const auto found = replay.run();
  REQUIRE(found);
  CHECK(found->joint == "elbow_active_joint");
  CHECK(found->quantity == "effort");
  CHECK(found->recorded != found->computed);
  CHECK(found->cycle >= 1);
  CHECK(found->cycle <= 3);
  CHECK(found->recorded == recording.cycles[found->cycle].command.effort[1]);
}

TEST_CASE("a record whose last bit is changed is found, and no other") {
  auto recording = saturated_run();
  double& number = recording.cycles[1234].command.effort[0];
  number = std::nextafter(number, 1e9);
  Replay<PidLoop> replay(recording);
  const auto found = replay.run();
  REQUIRE(found);
  CHECK(found->cycle == 1234);
  CHECK(found->joint == "shoulder_active_joint");
  CHECK_FALSE(replay.run());  // the rest
  CHECK(replay.is_done());
}

TEST_CASE("switches and changed gains are replayed") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    const auto recording = support::switched_run(seed, 0);
    REQUIRE(recording.changes.size() > 10);
    CHECK(difference<support::SwitchedLoop>(recording) == "");
  }
}

TEST_CASE("a recording that lacks a change of gains or a switch differs from there on") {
  const auto whole = support::switched_run(1, 0);
  int found = 0;
  for (std::size_t k = 0; k < whole.changes.size(); ++k) {
    auto recording = whole;
    const LoopChange left_out = recording.changes[k];
    recording.changes.erase(recording.changes.begin() + static_cast<std::ptrdiff_t>(k));
    Replay<support::SwitchedLoop> replay(recording);
    const auto difference = replay.run();
    if (!difference) continue;  // a switch to what is active, or gains of what is not
    ++found;
    CHECK(difference->cycle >= left_out.cycle);
  }
  CHECK(found > 10);
}

TEST_CASE("lost, late and broken cycles are replayed, and so is what follows them") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    const auto recording = support::switched_run(seed, 40);
    std::set<Status> seen;
    bool was_written_badly = false;
    for (const auto& record : recording.cycles) {
      seen.insert(record.status);
      was_written_badly = was_written_badly || record.input.write != Status::ok;
    }
    CHECK(seen.size() >= 5);
    CHECK(was_written_badly);
    CHECK(difference<support::SwitchedLoop>(recording) == "");
  }
}

TEST_CASE("a controller that fails is replayed with its memory") {
  using LoopType = Loop<support::HostileHardware<Q2dSim>, Unreliable>;
  LoopType loop(support::HostileHardware<Q2dSim>(support::noisy_q2d(), 3));
  loop.hardware().set_faults(60);
  int failures = 0;
  const auto recording = recorded(loop, 3000, [&](std::uint64_t, auto& so_far) {
    failures += so_far.cycles.back().status == Status::non_finite_command;
    loop.reference() = reference_at(loop.next_time());
  });
  CHECK(failures > 20);
  CHECK(difference<LoopType>(recording) == "");
}

TEST_CASE("position commands are replayed from the first measurement on, also if it is a bad one") {
  using Hardware = support::HostileHardware<MockHardware<Q2d, PositionCommand<2>>>;
  using LoopType = Loop<Hardware, ForwardPosition>;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    CAPTURE(seed);
    LoopType loop(Hardware(MockHardware<Q2d, PositionCommand<2>>(), seed, 0));
    loop.hardware().set_faults(2);
    const auto recording = recorded(loop, 100, [&](std::uint64_t cycle, auto&) {
      if (cycle > 3) loop.reference() = reference_at(loop.next_time());
    });
    CHECK(difference<LoopType>(recording) == "");
  }
}

TEST_CASE("the recorded reference is the one that the command was made from") {
  PidLoop loop;
  RecordingOf<PidLoop> recording;
  SimulatedClock clock;
  run(loop, clock, {.cycles = 500}, [&](PidLoop& running, const RunReport& report) {
    running.reference() = reference_at(running.next_time());  // of the next cycle
    recording.cycles.push_back(record_of(running, report));
    return true;
  });
  CHECK(recording.cycles[0].reference.position == JointVector<2>::Zero());
  CHECK(recording.cycles[10].reference.position == reference_at(0.01).position);
  CHECK(difference<PidLoop>(recording) == "");
}

TEST_CASE("a supervised loop is replayed with its requests, faults and overruns") {
  using Hardware = support::HostileHardware<Q2dSim>;
  using LoopType = SupervisedLoop<Hardware, support::ThreeControllers>;
  std::set<LoopMode> modes;
  std::set<Status> faults;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    support::Random random(seed);
    const SafeBehaviour behaviour = static_cast<SafeBehaviour>(random.integer(0, 2));
    const SupervisionOptions options{
        .behaviour = behaviour, .reference_lifetime = 0.05, .overruns = 2};
    LoopType loop(Hardware(support::noisy_q2d(), seed), options);
    loop.hardware().set_faults(seed % 3 == 0 ? 0 : 60);
    const auto recording = recorded(loop, 2000, [&](std::uint64_t cycle, auto& own) {
      modes.insert(loop.mode());
      faults.insert(loop.fault());
      if (random.one_in(20)) loop.request_activation();
      if (random.one_in(400)) loop.request_deactivation();
      if (random.one_in(40)) loop.acknowledge_fault();
      if (random.one_in(60)) {
        loop.missed_periods(static_cast<std::uint64_t>(random.integer(1, 40)));
        if (random.one_in(3)) loop.missed_periods(1);
      }
      if (!random.one_in(10) && cycle % 500 < 400) {
        JointReference<2> reference = reference_at(loop.time());
        if (random.one_in(100)) reference.effort[0] = std::nan("");
        loop.post(reference);
      }
      if (random.one_in(100)) {
        support::change(
            loop, own,
            {.cycle = cycle,
             .request = {.start = {random.one_in(2) ? "computed_torque" : "pid_plus_gravity"},
                         .replace = true}});
      }
    });
    CHECK(difference<LoopType>(
              recording, ReplayOptions<LoopType::ControllerType>{.supervision = options}) == "");
  }
  CHECK(modes.size() == 4);
  CHECK(faults.size() >= 5);
}

TEST_CASE("a supervised replay under other options differs") {
  using LoopType = SupervisedLoop<Q2dSim, PidPlusGravity>;
  LoopType loop{SupervisionOptions{.reference_lifetime = 0.1}};
  loop.request_activation();
  const auto recording = recorded(loop, 500, [&](std::uint64_t cycle, auto&) {
    if (cycle < 300) loop.post(reference_at(loop.time()));
  });
  using Options = ReplayOptions<LoopType::ControllerType>;
  CHECK(difference<LoopType>(recording, Options{.supervision = {.reference_lifetime = 0.1}}) == "");
  const std::string found =
      difference<LoopType>(recording, Options{.supervision = {.reference_lifetime = 0.2}});
  CHECK(found.find("status 'stale reference' was recorded, 'ok' is computed") != std::string::npos);
}

TEST_CASE("a recording with a gap is told from one without") {
  auto recording = saturated_run();
  recording.cycles.erase(recording.cycles.begin() + 700);
  CHECK(difference<PidLoop>(recording).starts_with("cycle 701: time 0.700"));
}

TEST_CASE("a simulator goes on from any cycle: with the same gains as it was, with others not") {
  PidLoop loop;  // without noise, the simulator's state is what is measured
  const auto recording = recorded(loop, 2000, [&](std::uint64_t, auto&) {
    loop.reference().position.setConstant(0.05 * std::sin(5 * loop.next_time()));
  });
  const auto what_if = [&](std::uint64_t cycle, double factor) {
    Replay<PidLoop> replay(recording);
    REQUIRE_FALSE(replay.run_until(cycle));
    replay.simulate(Q2dSim());
    CHECK(replay.is_done());
    auto gains = Q2d::pid_gains;
    gains[0].proportional *= factor;
    replay.loop().controller().set_gains(ValidGains<PidGains, 2>(gains, joint_names(Q2d())));
    int same = 0;
    for (std::size_t k = cycle; k < recording.cycles.size(); ++k) {
      replay.loop().reference() = recording.cycles[k].reference;
      CHECK(replay.loop().update() == Status::ok);
      same += replay.loop().command().effort == recording.cycles[k].command.effort &&
              replay.loop().state().position == recording.cycles[k].state.position &&
              replay.loop().time() == recording.cycles[k].time;
    }
    return same;
  };
  CHECK(what_if(1, 1) == 2000);
  CHECK(what_if(777, 1) == 2000 - 776);
  CHECK(what_if(777, 0.9) < 10);
}

TEST_CASE("what cannot be replayed is refused with the reason") {
  auto recording = saturated_run();
  const RecordingOf<PidLoop> empty;
  CHECK_THROWS_WITH(Replay<PidLoop>(empty), "replay: the recording is empty");
  auto middle = recording;
  middle.cycles.erase(middle.cycles.begin(), middle.cycles.begin() + 100);
  CHECK_THROWS_WITH(Replay<PidLoop>(middle),
                    "replay: the recording begins at 0.099 s, in the middle of its run; what the "
                    "controller remembered is not known");
  recording.changes = {{.cycle = 3, .request = {.start = {"pid"}}}};
  CHECK_THROWS_WITH(Replay<PidLoop>(recording).run(),
                    "replay: the recording switches controllers before cycle 3, but this loop has "
                    "none to switch");
  recording.changes = {{.cycle = 3, .gains = {{"pid.wrist.p", 1}}}};
  CHECK_THROWS_WITH(Replay<PidLoop>(recording).run(),
                    Catch::Contains("there is no parameter 'pid.wrist.p'"));
  recording.changes.clear();
  Replay<PidLoop> replay(recording);
  SimulatorOptions<2> slow;
  slow.period = 2e-3;
  CHECK_THROWS_WITH(replay.simulate(Q2dSim(slow)),
                    "replay: the simulator's period is 0.002 s, but that of the recorded loop is "
                    "0.001 s");
  replay.run();
  CHECK_THROWS_WITH(replay.simulate(Q2dSim()),
                    "replay: there is no record left from which to simulate");
}

TEST_CASE("the gains of a controller are recorded by their names and set again") {
  Loop<Q2dSim, support::ThreeControllers> loop;
  const auto gains = gain_settings(Q2d(), loop.controller());
  REQUIRE(gains.size() > 20);
  CHECK(gains[0].parameter == "pid_plus_gravity.shoulder_active_joint.p");
  CHECK(gains[0].value == Q2d::pid_gains[0].proportional);
  auto others = gains;
  others[0].value *= 0.5;
  set_gains(Q2d(), loop.controller(), others);
  CHECK(gain_settings(Q2d(), loop.controller()) == others);
}
