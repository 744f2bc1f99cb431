// SPDX-License-Identifier: Apache-2.0
// The Q2D in a browser: activate it, move it by sliders, pull at it with the mouse, switch its
// controller and change its gains. Ctrl-C ends the program, or the end of ARTICULA_VIEW_SECONDS.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

#include "view_options.hpp"

using namespace articula;

template <class R>
using Controllers = Switch<R, PidPlusGravity<R>, Pid<R>, ComputedTorque<R>>;

int main() {
  // `overruns` tolerates the overruns of a desktop machine; omit it for an arm.
  SupervisedLoop<Q2dSim, Controllers> arm(SupervisionOptions{.overruns = 1000});
  arm.request_activation();  // in a simulation nobody can be hurt
  return show(arm, view_options(arm.period()));
}
