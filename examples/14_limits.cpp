// SPDX-License-Identifier: Apache-2.0
// Limits between controller and drives: a step that is far too large, and a position beyond the
// arm's range. The program counts the limited cycles and checks that the limits held.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

#include <cstdio>

#include "support/plot.hpp"

using namespace articula;

template <class R>
using Careful = Limited<R, PidPlusGravity<R>>;

int main() {
  CommandLimits<2> limits = command_limits(Q2d());  // the description's
  limits.velocity = {0.5, 2};                       // rad/s
  limits.acceleration = {10, 100};                  // rad/s^2
  Loop<Q2dSim, Careful> loop{Careful<Q2d>(limits)};
  Plot plot("limits", {"shoulder [rad]", "elbow [rad]", "shoulder [rad/s]", "elbow [rad/s]"});

  struct Counts {
    int position = 0, velocity = 0, acceleration = 0;
  } counts[2];
  JointVector<2> fastest(0, 0), hardest(0, 0), furthest(0, 0), last(0, 0);
  for (int k = 0; k < 6000; ++k) {
    loop.reference().position = k < 1500 ? JointVector<2>(0.5, -1) : JointVector<2>(-3, 1);  // rad
    if (loop.update() != Status::ok) return 1;
    const JointVector<2>&q = loop.state().position, &v = loop.state().velocity;
    furthest = furthest.cwiseMax(q.cwiseAbs());
    fastest = fastest.cwiseMax(v.cwiseAbs());
    hardest = hardest.cwiseMax((v - last).cwiseAbs() / loop.period());
    last = v;
    plot.add(loop.time(), {q[0], q[1], v[0], v[1]});
    for (std::size_t j = 0; j < 2; ++j) {
      const JointLimitReport& report = loop.controller().report()[j];
      counts[j].position += report.position;
      counts[j].velocity += report.velocity;
      counts[j].acceleration += report.acceleration;
    }
  }
  for (std::size_t j = 0; j < 2; ++j) {
    std::printf("%s: limited by position in %d cycles, by velocity in %d, by acceleration in %d\n",
                joint_names(Q2d())[j].data(), counts[j].position, counts[j].velocity,
                counts[j].acceleration);
  }
  std::printf("at most (%.4f, %.4f) rad, (%.3f, %.3f) rad/s, (%.2f, %.2f) rad/s^2\n", furthest[0],
              furthest[1], fastest[0], fastest[1], hardest[0], hardest[1]);
  plot.save();
  // The model predicts the motion at the beginning of each cycle. Within it the other joint adds a
  // small acceleration.
  const bool held = (furthest.array() <= limits.upper.array() + 1e-3).all() &&
                    (fastest.array() <= 1.01 * limits.velocity.array()).all() &&
                    (hardest.array() <= 1.05 * limits.acceleration.array()).all();
  return held ? 0 : 1;
}
// shoulder_active_joint: limited by position in 365 cycles, by velocity in 5072, by acceleration in
// 551 elbow_active_joint: limited by position in 0 cycles, by velocity in 1496, by acceleration in
// 82 at most (1.5708, 1.0054) rad, (0.500, 2.000) rad/s, (9.97, 99.30) rad/s^2
