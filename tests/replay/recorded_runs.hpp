// SPDX-License-Identifier: Apache-2.0
/// @file Runs whose recordings the tests replay.
#pragma once

#include <articula/articula.hpp>
#include <articula/replay/replay.hpp>
#include <articula/robots/q2d.hpp>

#include <cmath>
#include <cstdint>

#include "hardware/hostile_hardware.hpp"
#include "random.hpp"

namespace support {

using namespace articula;

template <class R>
using ThreeControllers = Switch<R, PidPlusGravity<R>, ComputedTorque<R>, Bypass<R>>;

/// A simulator whose sensors have noise, so that no two states are alike.
[[nodiscard]] inline Q2dSim noisy_q2d() {
  SimulatorOptions<2> options;
  options.position_noise.setConstant(1e-4);
  options.velocity_noise.setConstant(1e-2);
  options.effort_noise.setConstant(1e-2);
  return Q2dSim(options);
}

/// Steps that saturate the drives, and sines.
[[nodiscard]] inline JointReference<2> reference_at(double t) {
  JointReference<2> reference;
  reference.position = {std::fmod(t, 1) < 0.5 ? -1.2 : 1.2, 0.7 * std::sin(9 * t)};
  reference.velocity[1] = 6.3 * std::cos(9 * t);
  return reference;
}

/// Records cycles of a loop without supervision, the first measurement before them.
/// @param before  called with the number of the cycle that comes, for references and changes
template <class LoopType, class Before>
[[nodiscard]] RecordingOf<LoopType> recorded(LoopType& loop, int cycles, Before before) {
  RecordingOf<LoopType> recording;
  recording.cycles.push_back(record_of(loop, RunReport()));
  for (int k = 1; k <= cycles; ++k) {
    const auto number = static_cast<std::uint64_t>(k);
    before(number, recording);
    const Status status = loop.update();
    recording.cycles.push_back(record_of(loop, number, status, CycleTiming()));
  }
  return recording;
}

/// Changes a loop in the cycle that comes and records that.
template <class LoopType>
void change(LoopType& loop, RecordingOf<LoopType>& recording, const LoopChange& what) {
  recording.changes.push_back(what);
  set_gains(loop.hardware().robot(), loop.controller(), what.gains);
  if (is_empty(what.request)) return;
  if constexpr (articula::detail::switch_size<typename LoopType::ControllerType> > 0) {
    static_cast<void>(switch_in(loop.controller()).request(what.request));
  }
}

/// A run with switches and changed gains on hardware with noise and, if asked for, faults.
/// @param faults  one in so many accesses to the hardware; 0: none
[[nodiscard]] inline auto switched_run(unsigned seed, int faults) {
  using Hardware = HostileHardware<Q2dSim>;
  using LoopType = Loop<Hardware, ThreeControllers>;
  LoopType loop(Hardware(noisy_q2d(), seed));
  loop.hardware().set_faults(faults);
  Random random(seed);
  const double nan = std::nan("");
  return recorded(loop, 4000, [&](std::uint64_t cycle, RecordingOf<LoopType>& recording) {
    loop.reference() = reference_at(loop.next_time());
    if (faults > 0 && random.one_in(50)) loop.reference().velocity[0] = nan;
    if (random.one_in(200)) {
      const auto active = static_cast<std::size_t>(random.integer(0, 2));
      change(loop, recording,
             {.cycle = cycle,
              .request = {.start = {loop.controller().list()[active].name}, .replace = true}});
    }
    if (random.one_in(200)) {
      change(loop, recording,
             {.cycle = cycle,
              .gains = {{"pid_plus_gravity.shoulder_active_joint.p", random.number(20, 60)},
                        {"computed_torque.elbow_active_joint.i", random.number(0, 20)}}});
    }
  });
}

/// The loop type of that run on any hardware.
using SwitchedLoop = Loop<Q2dSim, ThreeControllers>;

}  // namespace support
