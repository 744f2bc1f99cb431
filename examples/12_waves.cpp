// SPDX-License-Identifier: Apache-2.0
// Waves on two joints in opposite phase, with a second wave on one of them. A clock slows them to a
// pause.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

#include <cstdio>
#include <numbers>

using namespace articula;

int main() {
  const JointSignals<Q2d> waves({
      {"shoulder_active_joint", SineSignal{.amplitude = 0.2, .frequency = 0.3}},
      {"elbow_active_joint",
       SineSignal{.amplitude = 0.2, .frequency = 0.3, .phase = std::numbers::pi}},
      {"elbow_active_joint", SineSignal{.amplitude = 0.05, .frequency = 2}},
  });

  Loop<Q2dSim, PidPlusGravity> loop;
  SpeedOverride clock;
  JointVector<2> worst(0, 0);
  for (int k = 0; k <= 5000; ++k) {
    if (k == 4000) clock.set(0);  // the waves stop smoothly
    loop.reference() = clock.apply(waves.sample(clock.time()));
    if (loop.update() != Status::ok) return 1;
    clock.advance(loop.period());
    worst = worst.cwiseMax((loop.reference().position - loop.state().position).cwiseAbs());
    if (k % 1000 > 0) continue;
    std::printf("%g s: (%.2f, %.2f) rad\n", loop.time(), loop.state().position[0],
                loop.state().position[1]);
  }
  std::printf("never off by more than (%.2f, %.2f) rad\n", worst[0], worst[1]);
}
// 0 s: (0.00, 0.00) rad
// 1 s: (0.19, -0.20) rad
// 2 s: (-0.12, 0.11) rad
// 3 s: (-0.12, 0.11) rad
// 4 s: (0.19, -0.20) rad
// 5 s: (0.20, -0.20) rad
// never off by more than (0.01, 0.01) rad
