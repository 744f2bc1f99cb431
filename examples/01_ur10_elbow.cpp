// SPDX-License-Identifier: Apache-2.0
// A step of the UR10's elbow to 0.5 rad with a teaching lab's gains, the same on all six joints.
//
// With the public description alone, these gains are unstable at 1 kHz:
// - The last wrist joint has 0.0005 kg m^2, so its crossover is 19 000 rad/s. Its delay margin is
//   0.08 ms.
// - An effort that is held for a period is late by 0.5 ms on average.
// - The joint chatters at 60 rad/s between the limits of its drive. At 10 kHz it is quiet.
//
// The description omits the rotors of the drives. Through the gears of a wrist they have far more
// inertia than the links. Here each joint gets 0.1 kg m^2, the value of MuJoCo Menagerie's UR10e.
#include <articula/articula.hpp>
#include <articula/robots/ur10.hpp>

#include <cstdio>

#include "support/plot.hpp"

using namespace articula;

constexpr auto with_rotors(auto description, double inertia) {
  for (Joint& joint : description.joints) {
    if (joint.type != JointType::fixed) joint.reflected_inertia = inertia;
  }
  return description;
}

constexpr PidGains lab{.proportional = 1000, .integral = 0.01, .derivative = 10};

struct Arm {
  static constexpr auto description = with_rotors(Ur10::description, 0.1);  // kg m^2
  static constexpr JointPidGains<6> pid_gains{lab, lab, lab, lab, lab, lab};
};

/// The elbow's position after the motion [rad].
double step(auto loop, Plot& plot) {
  loop.reference().position[2] = 0.5;
  for (int k = 0; k <= 8000; ++k) {
    if (loop.update() != Status::ok) return -1;
    const JointVector<6>& q = loop.state().position;
    plot.add(loop.time(), {loop.reference().position[2], q[2], q[1], loop.command().effort[2]});
  }
  return loop.state().position[2];
}

int main() {
  const JointVector<6> zero = JointVector<6>::Zero();
  for (const char* joint : {"elbow_joint", "wrist_3_joint"}) {
    const auto bare = stability_margins(joint_plant(Ur10(), zero, joint), lab);
    const auto arm = stability_margins(joint_plant(Arm(), zero, joint), lab);
    std::printf("%s: delay margin %.2f ms, with rotors %.2f ms\n", joint, 1e3 * bare.delay_margin,
                1e3 * arm.delay_margin);
  }
  const std::vector<std::string> columns{"reference [rad]", "elbow [rad]", "shoulder lift [rad]",
                                         "elbow effort [N m]"};
  Plot alone("ur10_elbow", columns), with_gravity("ur10_elbow_gravity", columns);
  std::printf("PID: elbow at %.3f rad\n", step(Loop<Simulator<Arm>, Pid>(), alone));
  std::printf("PID and gravity: elbow at %.3f rad\n",
              step(Loop<Simulator<Arm>, PidPlusGravity>(), with_gravity));
  alone.save();
  with_gravity.save();
}
// elbow_joint: delay margin 9.81 ms, with rotors 9.82 ms
// wrist_3_joint: delay margin 0.08 ms, with rotors 7.12 ms
// PID: elbow at 0.524 rad
// PID and gravity: elbow at 0.500 rad
//
// In both plots the shoulder lift rings for seconds: for its inertia, d 10 is a phase margin of
// 5 degrees. Without gravity compensation the arm sags, because i 0.01 needs hours to lift it.
