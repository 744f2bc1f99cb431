// SPDX-License-Identifier: Apache-2.0
// A torso with two arms in a browser: sliders, waves on a joint, key poses. Ctrl-C ends the
// program, or the end of ARTICULA_VIEW_SECONDS.
#include <articula/articula.hpp>
#include <articula/robots/two_arm_torso.hpp>

#include "view_options.hpp"

using namespace articula;

int main() {
  SupervisedLoop<TwoArmTorsoSim, ComputedTorque> arms(SupervisionOptions{.overruns = 1000});
  arms.request_activation();
  return show(arms, view_options(arms.period()));
}
