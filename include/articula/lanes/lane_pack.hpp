// SPDX-License-Identifier: Apache-2.0
/// @file The scalar whose lanes simulate closed loops of a robot fastest.
#pragma once

#include "articula/model/robot.hpp"
#include "articula/symbolic/pack.hpp"
#include "articula/symbolic/wide_pack.hpp"

#include <type_traits>

namespace articula {

/// One number for each robot that LaneLoop simulates at once. The dynamics of up to three joints
/// are so few operations that they wait for each other: a pack of two registers takes a third less
/// time for each robot (Q2D; `benchmarks/run.sh lanes`). A UR10 takes as long in two as in one.
/// @tparam R  the kind of robot
template <DescribedRobot R>
using LanePack = std::conditional_t<joint_count<R> <= 3, symbolic::WidePack<2>, symbolic::Pack<>>;

}  // namespace articula
