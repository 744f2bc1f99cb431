// SPDX-License-Identifier: Apache-2.0
// The loop, and the view's function for it, which arm_view.cpp compiles.
#pragma once

#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/view/show.hpp>

using Arm = articula::Loop<articula::Q2dSim, articula::PidPlusGravity>;
extern template int articula::show(Arm&, const ShowOptions&, const Remote<Arm>::Options&);
