// SPDX-License-Identifier: Apache-2.0
#include <articula/articula.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>
#include <articula/remote/engine/loop_side.hpp>
#include <articula/robots/q2d.hpp>

using namespace articula;
using namespace articula::remote;

template <class R>
using Controllers = Switch<R, PidPlusGravity<R>, ComputedTorque<R>>;
using Plain = LoopSide<Loop<Q2dSim, PidPlusGravity>>;
using Supervised = LoopSide<SupervisedLoop<Q2dSim, Controllers>>;

Status update(Plain& side) noexcept { return side.update(); }
Status update(Supervised& side) noexcept { return side.update(); }
void report(Supervised& side, const RunReport& report) noexcept { side.report(report); }
void missed(Supervised& side) noexcept { side.missed_periods(1); }
