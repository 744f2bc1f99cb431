// SPDX-License-Identifier: Apache-2.0
// A joint that feels no inertia at any position: efforts are known, accelerations are not.
#include <articula/dynamics/dynamics.hpp>

struct Spindle {
  static constexpr auto description = articula::RobotDescription{
      .name = "spindle",
      .links = std::to_array<articula::Link>(
          {{.name = "stand"},
           {.name = "needle", .mass = 1, .center_of_mass = {0, 0, 0.1}, .inertia = {}}}),
      .joints = std::to_array<articula::Joint>({{.name = "pivot",
                                                 .type = articula::JointType::continuous,
                                                 .parent = "stand",
                                                 .child = "needle",
                                                 .axis = {0, 0, 1}}}),
      .allow_unphysical = true};
};

int main() {
  const articula::JointVector<1> q(0.5);
#ifdef WITH_MISTAKE
  const double a = articula::forward_dynamics(Spindle(), q, q, q)[0];
#else
  const double a = articula::inverse_dynamics(Spindle(), q, q, q)[0];
#endif
  return a == 0 ? 0 : 1;
}
