// SPDX-License-Identifier: Apache-2.0
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

using namespace articula;

extern "C" bool cycle(Loop<Simulator<Q2d, symbolic::Pack<>>, PidPlusGravity>& loop) noexcept {
  return loop.update() == Status::ok;
}
