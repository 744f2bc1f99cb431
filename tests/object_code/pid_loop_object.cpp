// SPDX-License-Identifier: Apache-2.0
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

using namespace articula;

extern "C" bool cycle(Loop<Q2dSim, Pid>& loop) noexcept { return loop.update() == Status::ok; }
