// SPDX-License-Identifier: Apache-2.0
// The arm with a gripper in a browser. One slider closes both fingers: their other five joints
// mimic the joint of the drive. Ctrl-C ends the program, or the end of ARTICULA_VIEW_SECONDS.
#include <articula/articula.hpp>
#include <articula/robots/gripper_arm.hpp>

#include "view_options.hpp"

using namespace articula;

int main() {
  // Steps of 0.1 ms suit the light fingers. `overruns` tolerates those of a desktop machine.
  SupervisedLoop<GripperArmSim, ComputedTorque> arm(GripperArmSim({.substeps = 10}),
                                                    SupervisionOptions{.overruns = 1000});
  arm.request_activation();
  return show(arm, view_options(arm.period()));
}
