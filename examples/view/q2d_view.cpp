// SPDX-License-Identifier: Apache-2.0
// The Q2D in a browser: activate it, move it by sliders, pull at it with the mouse, switch its
// controller and change its gains. Ctrl-C ends the program, or the end of ARTICULA_VIEW_SECONDS.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/view/show.hpp>

#include <cstdint>
#include <cstdlib>

using namespace articula;

template <class R>
using Controllers = Switch<R, PidPlusGravity<R>, Pid<R>, ComputedTorque<R>>;

int main() {
  // `overruns` tolerates the overruns of a desktop machine; omit it for an arm.
  SupervisedLoop<Q2dSim, Controllers> arm(SupervisionOptions{.overruns = 1000});
  arm.request_activation();  // in a simulation nobody can be hurt

  ShowOptions options{.opens_browser = true};
  if (const char* seconds = std::getenv("ARTICULA_VIEW_SECONDS")) {
    options.run.cycles = static_cast<std::uint64_t>(std::atof(seconds) / arm.period());
  }
  if (const char* port = std::getenv("ARTICULA_VIEW_PORT")) {
    options.view.port = static_cast<std::uint16_t>(std::atoi(port));
  }
  return show(arm, options);
}
