// SPDX-License-Identifier: Apache-2.0
#include <articula/articula.hpp>
#include <articula/control/limits/limited.hpp>
#include <articula/robots/q2d.hpp>

using namespace articula;

template <class R>
using CarefulPid = Limited<R, PidPlusGravity<R>>;

extern "C" bool cycle(Loop<Q2dSim, CarefulPid>& loop) noexcept {
  return loop.update() == Status::ok;
}
