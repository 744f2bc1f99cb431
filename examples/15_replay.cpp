// SPDX-License-Identifier: Apache-2.0
// Replay. A run is recorded and computed once more: the same commands, to the last bit. Then a
// simulator goes on from the middle of the recording with other gains.
#include <articula/articula.hpp>
#include <articula/replay/replay.hpp>
#include <articula/robots/q2d.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdio>

using namespace articula;
using ArmLoop = Loop<Q2dSim, PidPlusGravity>;

int main() {
  // The run: a step, and in its middle other gains.
  ArmLoop loop;
  RecordingOf<ArmLoop> recording;
  recording.cycles.push_back(record_of(loop, RunReport()));  // where the joints were at first
  loop.reference().position = {-1.0, 1.0};
  SimulatedClock clock;
  run(loop, clock, {.cycles = 2000}, [&](ArmLoop& running, const RunReport& report) {
    recording.cycles.push_back(record_of(running, report));
    if (report.cycles == 800) {
      const LoopChange softer{.cycle = 801,
                              .gains = {{"pid_plus_gravity.elbow_active_joint.p", 8}}};
      set_gains(Q2d(), running.controller(), softer.gains);
      recording.changes.push_back(softer);
    }
    return true;
  });

  // Computed once more by a new loop of the same types.
  Replay<ArmLoop> replay(recording);
  const auto difference = replay.run();
  std::printf("%s\n", difference ? to_string(*difference).c_str() : "the same commands");

  // Without the change of gains it is not the same run.
  RecordingOf<ArmLoop> incomplete = recording;
  incomplete.changes.clear();
  const auto first = Replay<ArmLoop>(incomplete).run();
  std::printf("without the change: cycle %d, %s\n", static_cast<int>(first->cycle),
              first->joint.c_str());

  // What if the shoulder had been softer from cycle 100 on?
  Replay<ArmLoop> what_if(recording);
  what_if.run_until(100);
  what_if.simulate(Q2dSim());
  set_gains(Q2d(), what_if.loop().controller(), {{"pid_plus_gravity.shoulder_active_joint.p", 20}});
  double farthest = 0, was_farthest = 0;
  for (std::size_t k = 100; k <= 2000; ++k) {
    if (what_if.loop().update() != Status::ok) return 1;
    farthest = std::min(farthest, what_if.loop().state().position[0]);
    was_farthest = std::min(was_farthest, recording.cycles[k].state.position[0]);
  }
  std::printf("shoulder: as far as %.4f rad, and was %.4f rad\n", farthest, was_farthest);
}
// the same commands
// without the change: cycle 801, elbow_active_joint
// shoulder: as far as -1.0764 rad, and was -1.0012 rad
