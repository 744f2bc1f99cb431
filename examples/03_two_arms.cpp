// SPDX-License-Identifier: Apache-2.0
// A torso moves its two arms in opposite phase: shoulders by 1 rad at 1 Hz, elbows bent by 1 rad.
// The signals keep the joints' limits at any amplitude. The loop runs at 100 Hz.
#include <articula/articula.hpp>
#include <articula/robots/two_arm_torso.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "support/plot.hpp"

using namespace articula;

int main() {
  constexpr double quarter = std::numbers::pi / 2;
  const JointReference<6> bent{.position = {0, 0, 1, 0, 0, 1}};
  const JointSignals<TwoArmTorso> waves(
      {{"left_shoulder_pitch_joint", SineSignal{.amplitude = 1, .frequency = 1, .phase = quarter}},
       {"right_shoulder_pitch_joint",
        SineSignal{.amplitude = 1, .frequency = 1, .phase = -quarter}}},
      bent);

  // The arms start at rest, so they start at an extreme of the waves.
  Loop<TwoArmTorsoSim, ComputedTorque> loop(TwoArmTorsoSim(
      {.period = 0.01, .substeps = 10, .initial_position = waves.sample(0).position}));
  Plot plot("two_arms",
            {"left shoulder [rad]", "right shoulder [rad]", "left elbow [rad]", "right elbow [rad]",
             "left shoulder effort [N m]", "right shoulder effort [N m]"});
  double off = 0, apart = 0;
  for (int k = 0; k <= 300; ++k) {
    loop.reference() = waves.sample(loop.next_time());
    if (loop.update() != Status::ok) return 1;
    const JointVector<6>&q = loop.state().position, &effort = loop.command().effort;
    plot.add(loop.time(), {q[0], q[3], q[2], q[5], effort[0], effort[3]});
    off = std::max(off, (loop.reference().position - q).cwiseAbs().maxCoeff());
    apart = std::max(apart, std::abs(q[0] - q[3]));
  }
  plot.save();
  std::printf("never off by more than %.2f rad, up to %.2f rad apart\n", off, apart);
}
// never off by more than 0.01 rad, up to 2.00 rad apart
