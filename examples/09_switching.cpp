// SPDX-License-Identifier: Apache-2.0
// Switching under load. A constant torque moves the Q2D, then two controllers continue the motion,
// and then none is active. The effort makes no step.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "support/plot.hpp"

using namespace articula;

template <class R>
using Controllers = Switch<R, Bypass<R>, PidPlusGravity<R>, ComputedTorque<R>>;

int main() {
  Loop<Q2dSim, Controllers> loop;
  Plot plot("switching",
            {"shoulder [rad]", "elbow [rad]", "shoulder effort [N m]", "elbow effort [N m]"});

  loop.reference().effort = {8, -1};  // N m, for the bypass, which is active at first
  const auto request = [&](const SwitchRequest& changes) {
    const SwitchOutcome outcome = loop.controller().request(changes);
    if (outcome.answer != SwitchAnswer::done) std::puts("this cannot be switched");
  };
  JointReference<2> moving;  // continues at the same speed
  double largest = 0;        // change of the shoulder's effort in a cycle
  for (int k = 0; k < 4000; ++k) {
    const Name before = loop.controller().active();
    if (k == 1000) {
      moving.position = loop.state().position;
      moving.velocity = loop.state().velocity;
      request({.stop = {"bypass"}, .start = {"pid_plus_gravity"}});
    }
    if (k == 2000) request({.start = {"computed_torque"}, .replace = true});
    if (k == 3000) request({.stop = {"computed_torque"}});
    if (k >= 1000) {
      moving.position += loop.period() * moving.velocity;
      loop.reference() = moving;
    }
    const double last = loop.command().effort[0];
    if (loop.update() != Status::ok) return 1;
    const double effort = loop.command().effort[0];
    if (k > 0) largest = std::max(largest, std::abs(effort - last));
    plot.add(loop.time(), {loop.state().position[0], loop.state().position[1],
                           loop.command().effort[0], loop.command().effort[1]});
    const Name now = loop.controller().active();
    if (now == before) continue;
    std::printf("%g s: %s after %s, shoulder %.3f rad/s, %.3f N m after %.3f N m\n", loop.time(),
                now.empty() ? "none" : now.characters, before.characters, loop.state().velocity[0],
                effort, last);
  }
  std::printf("in all, no step beyond %.2f N m; stated: %.2f N m\n", largest,
              loop.controller().slew()[0] * loop.period());
  for (const ControllerInfo& info : loop.controller().list()) {
    std::printf("%s: %s\n", info.name.characters, to_string(info.status).data());
  }
  const SwitchOutcome outcome = loop.controller().request({.start = {"pid"}});
  std::printf("%s: %s\n", outcome.controller.characters, to_string(outcome.answer).data());
  plot.save();
}
// 1 s: pid_plus_gravity after bypass, shoulder 0.269 rad/s, 8.000 N m after 8.000 N m
// 2 s: computed_torque after pid_plus_gravity, shoulder 0.269 rad/s, 8.000 N m after 8.000 N m
// 3 s: none after computed_torque, shoulder 0.269 rad/s, 7.999 N m after 7.999 N m
// in all, no step beyond 0.28 N m; stated: 0.28 N m
// bypass: inactive
// pid_plus_gravity: inactive
// computed_torque: inactive
// pid: unknown name
