// SPDX-License-Identifier: Apache-2.0
// A controller of your own: a spring and a damper in each joint, in a loop.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

#include <cstdio>

using namespace articula;

/// effort = stiffness (q_ref - q) - damping v
template <class R>
struct SpringDamper {
  static constexpr int joint_count = articula::joint_count<R>;
  double stiffness = 50, damping = 5;  // N m/rad, N m s/rad

  void start(const JointState<joint_count>&) noexcept {}  // nothing to forget

  EffortCommand<joint_count> update(const JointState<joint_count>& state,
                                    const JointReference<joint_count>& reference,
                                    double /*period*/) noexcept {
    return {stiffness * (reference.position - state.position) - damping * state.velocity};
  }
};
static_assert(Controller<SpringDamper<Q2d>, 2>);

int main() {
  Loop<Q2dSim, SpringDamper> loop;
  loop.reference().position = {1.0, -0.5};
  for (int k = 0; k <= 3000; ++k) {
    if (loop.update() != Status::ok) return 1;
    if (k % 1000 > 0) continue;
    std::printf("%g s: (%.2f, %.2f) rad, (%.2f, %.2f) N m\n", loop.time(), loop.state().position[0],
                loop.state().position[1], loop.command().effort[0], loop.command().effort[1]);
  }
  // The loop limits the efforts to the drives' limits: 50 N m for 1 rad exceed them.
}
// 0 s: (0.00, 0.00) rad, (27.94, -13.62) N m
// 1 s: (0.74, -0.50) rad, (11.31, -0.03) N m
// 2 s: (0.94, -0.50) rad, (2.65, -0.00) N m
// 3 s: (0.99, -0.50) rad, (0.62, -0.00) N m
