// SPDX-License-Identifier: Apache-2.0
// Sinusoidal torques from a YAML file act on some joints of a PR2. Springs carry its arms.
#include <articula/articula.hpp>
#include <articula/config/load_signals.hpp>
#include <articula/robots/pr2.hpp>

#include <cstdio>

#include "beside.hpp"
#include "support/plot.hpp"

using namespace articula;

/// The reference's effort, added to the gravity effort.
template <class R>
using Counterbalanced =
    EffortController<R, GravityCompensation<R>, EffortFeedforward<joint_count<R>>>;

int main() {
  const Pr2 pr2;
  const JointSignals<Pr2> waves(load_signals(pr2, beside("pr2_waveforms.yaml")).signals);

  const JointVector<20> middle = joint_values(pr2, [](const JointProperties& joint) {
    const bool bounded = joint.type != JointType::continuous;
    return bounded ? (joint.limits.lower + joint.limits.upper) / 2 : 0;
  });
  Loop<Simulator<Pr2>, Counterbalanced> loop(Simulator<Pr2>({.initial_position = middle}),
                                             Counterbalanced<Pr2>(pr2, {}, {}));
  Plot plot("pr2_waveforms", {"head [rad]", "right shoulder [rad]", "left shoulder [rad]",
                              "right elbow [rad]", "right shoulder [N m]", "right elbow [N m]"});
  const int head = joint_index(pr2, "head_pan_joint");
  const int right = joint_index(pr2, "r_shoulder_pan_joint");
  const int left = joint_index(pr2, "l_shoulder_pan_joint");
  const int elbow = joint_index(pr2, "r_elbow_flex_joint");
  for (int k = 0; k <= 8000; ++k) {
    loop.reference().effort = waves.sample(loop.next_time()).effort;
    if (loop.update() != Status::ok) return 1;
    const auto& q = loop.state().position;
    const auto& torque = loop.reference().effort;
    if (k % 10 == 0) {
      plot.add(loop.time(), {q[head], q[right], q[left], q[elbow], torque[right], torque[elbow]});
    }
    if (k % 1000 > 0) continue;
    std::printf("%g s: head %.2f, shoulders %.2f and %.2f, elbow %.2f rad\n", loop.time(), q[head],
                q[right], q[left], q[elbow]);
  }
  plot.save();
}
// 0 s: head 0.00, shoulders -0.79 and 0.79, elbow -1.16 rad
// 1 s: head 0.61, shoulders -0.43 and 0.47, elbow -0.58 rad
// 2 s: head 0.02, shoulders -0.04 and 0.05, elbow -1.01 rad
// 3 s: head 0.61, shoulders -0.36 and 0.35, elbow -0.47 rad
// 4 s: head 0.02, shoulders -0.79 and 0.76, elbow -1.02 rad
// 5 s: head 0.61, shoulders -0.45 and 0.48, elbow -0.44 rad
// 6 s: head 0.02, shoulders -0.04 and 0.06, elbow -0.96 rad
// 7 s: head 0.61, shoulders -0.34 and 0.35, elbow -0.59 rad
// 8 s: head 0.02, shoulders -0.80 and 0.77, elbow -1.11 rad
