// SPDX-License-Identifier: Apache-2.0
// A controller of your own, in three forms: a function, a plain struct, and a struct for any robot.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

#include <cstdio>

using namespace articula;

/// A spring in each joint, and an integral, which is memory: effort = k (q_ref - q) + I - d v.
struct SpringWithIntegral {
  double stiffness = 50, damping = 5, integral_gain = 20;  // N m/rad, N m s/rad, N m/(rad s)
  JointVector<2> integral{0, 0};                           // N m

  /// Forgets the past. A controller without memory needs no start.
  void start(const ControlInput<2>&) noexcept { integral.setZero(); }

  EffortCommand<2> update(const ControlInput<2>& in) noexcept {
    // What limits took from the last command is not integrated.
    const JointVector<2> error = in.reference.position - in.state.position;
    for (int j = 0; j < 2; ++j) {
      if (in.cut[j] == 0) integral[j] += integral_gain * error[j] * in.period;
    }
    return {stiffness * error + integral - damping * in.state.velocity};
  }
};

/// For any robot: effort = k (q_ref - q) - d v.
template <class R>
struct SpringDamper {
  static constexpr int joint_count = articula::joint_count<R>;
  double stiffness = 50, damping = 5;  // N m/rad, N m s/rad

  EffortCommand<joint_count> update(const ControlInput<joint_count>& in) noexcept {
    return {stiffness * (in.reference.position - in.state.position) - damping * in.state.velocity};
  }
};
static_assert(Controller<SpringWithIntegral, 2> && Controller<SpringDamper<Q2d>, 2>);

/// The loop keeps efforts within the drives' limits: 50 N m for 1 rad are too much.
bool run(const char* name, auto& loop) {
  loop.reference().position = {1.0, -0.5};
  std::printf("%s\n", name);
  for (int k = 0; k <= 3000; ++k) {
    if (loop.update() != Status::ok) return false;
    if (k % 1000 > 0) continue;
    std::printf("%g s: (%.2f, %.2f) rad, (%.2f, %.2f) N m\n", loop.time(), loop.state().position[0],
                loop.state().position[1], loop.command().effort[0], loop.command().effort[1]);
  }
  return true;
}

int main() {
  Loop of_any_robot{Q2dSim(), SpringDamper<Q2d>()};  // or Loop<Q2dSim, SpringDamper>
  Loop of_this_robot{Q2dSim(), SpringWithIntegral{}};
  Loop of_a_function{Q2dSim(), [](const ControlInput<2>& in) noexcept {
                       return EffortCommand<2>{50 * (in.reference.position - in.state.position) -
                                               5 * in.state.velocity};
                     }};
  return run("spring and damper", of_any_robot) && run("with an integral", of_this_robot) &&
                 run("a function", of_a_function)
             ? 0
             : 1;
}
// spring and damper
// 0 s: (0.00, 0.00) rad, (27.94, -13.62) N m
// 1 s: (0.74, -0.50) rad, (11.31, -0.03) N m
// 2 s: (0.94, -0.50) rad, (2.65, -0.00) N m
// 3 s: (0.99, -0.50) rad, (0.62, -0.00) N m
// with an integral
// 0 s: (0.00, 0.00) rad, (27.94, -13.62) N m
// 1 s: (0.78, -0.52) rad, (14.02, -0.01) N m
// 2 s: (1.04, -0.52) rad, (3.57, 0.01) N m
// 3 s: (1.09, -0.51) rad, (0.07, 0.01) N m
// a function
// 0 s: (0.00, 0.00) rad, (27.94, -13.62) N m
// 1 s: (0.74, -0.50) rad, (11.31, -0.03) N m
// 2 s: (0.94, -0.50) rad, (2.65, -0.00) N m
// 3 s: (0.99, -0.50) rad, (0.62, -0.00) N m
