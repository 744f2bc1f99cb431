// SPDX-License-Identifier: Apache-2.0
// A transmission: the Q2D's two joints behind a differential of two motors. The drives measure at
// the motors. Here the same differential, reversed, simulates the motors. On a real arm `Motors` is
// the driver.
#include <articula/articula.hpp>
#include <articula/hardware/transmission/differential_transmission.hpp>
#include <articula/hardware/transmission/reversed_transmission.hpp>
#include <articula/hardware/transmission/transmitted_hardware.hpp>
#include <articula/robots/q2d.hpp>

#include <array>
#include <cstdio>

using namespace articula;

using Differential = DifferentialTransmission;
using Motors = TransmittedHardware<Q2dSim, Q2d, Reversed<Differential>>;  // a driver's place
using Arm = TransmittedHardware<Motors, Q2d, Differential>;               // the loop's hardware

int main() {
  const Differential differential{.actuator_reduction = {50, 50},  // n_1, n_2
                                  .joint_reduction = {1, 2},       // m_1, m_2
                                  .joint_offset = {0.1, 0}};       // [rad]
  const std::array<Name, 2> joints{"shoulder_active_joint", "elbow_active_joint"};

  // A motor has the name of one of its hardware's joints, here the simulator's.
  Motors motors(Q2dSim(), {.joints = joints,
                           .actuators = joints,
                           .transmission = Reversed<Differential>{differential}});
  Arm arm(motors, {.joints = joints,
                   .actuators = joints,
                   .transmission = differential,
                   .limits = {{{.effort = 0.5}, {.effort = 0.5}}}});  // of the motors [N m]
  Loop<Arm, PidPlusGravity> loop{arm};

  loop.reference().position = {0.5, -0.25};
  for (int k = 0; k < 4000; ++k) {
    if (loop.update() != Status::ok) return 1;
  }
  const JointVector<2> q = loop.state().position;
  const JointVector<2> motor = loop.hardware().actuator_state().position;
  std::printf("joints at (%.3f, %.3f) rad, motors at (%.2f, %.2f) rad\n", q[0], q[1], motor[0],
              motor[1]);
}
// joints at (0.500, -0.250) rad, motors at (-5.00, 45.00) rad
