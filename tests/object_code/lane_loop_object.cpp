// SPDX-License-Identifier: Apache-2.0
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/lanes/lane_loop.hpp>
#include <articula/robots/q2d.hpp>

using namespace articula;

extern "C" void cycle(LaneLoop<Q2d, PidPlusGravity>& loop) noexcept { loop.update(); }
