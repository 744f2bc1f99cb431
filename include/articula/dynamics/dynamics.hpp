// SPDX-License-Identifier: Apache-2.0
/// @file All functions of kinematics and dynamics.
#pragma once

#include "articula/dynamics/forward_dynamics.hpp"
#include "articula/dynamics/forward_kinematics.hpp"
#include "articula/dynamics/friction_effort.hpp"
#include "articula/dynamics/gravity.hpp"
#include "articula/dynamics/inverse_dynamics.hpp"
#include "articula/dynamics/jacobian.hpp"
#include "articula/dynamics/kinetic_energy.hpp"
#include "articula/dynamics/mass_matrix.hpp"
#include "articula/dynamics/moving_joints.hpp"
#include "articula/dynamics/nonlinear_effects.hpp"
#include "articula/dynamics/potential_energy.hpp"
