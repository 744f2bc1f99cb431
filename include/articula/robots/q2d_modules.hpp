// SPDX-License-Identifier: Apache-2.0
/// @file The joint modules of the Quanser arm.
#pragma once

#include "articula/hardware/quanser/quanser_module.hpp"

namespace articula {

/// The joint modules of the Quanser arm, shoulder then elbow: docs/quanser_protocol.md. Encoders
/// with 4096 counts per turn behind gears of 100 and 80; the load's encoders have 65536 counts per
/// turn. These figures are our own: check them on your arm, see docs/hardware.md.
///
/// Motor and load may differ by 0.4 rad. Where a joint is not locked, it has a torsion spring
/// between them. The springs have 9 N m/rad in the shoulder and 4 N m/rad in the elbow (the maker's
/// figures, not measured). In simulation, steps of 0.1 rad under the course's gains twist these
/// springs by at most 0.33 rad. With locked joints 0.05 rad is enough; steps of 1 rad with free
/// springs need 0.8 rad.
inline constexpr QuanserModules<2> q2d_modules{{
    {.node = 1,
     .motor_counts_per_turn = 4096,
     .gear_ratio = 100,
     .load_counts_per_turn = 65536,
     .encoder_tolerance = 0.4},
    {.node = 2,
     .motor_counts_per_turn = 4096,
     .gear_ratio = 80,
     .load_counts_per_turn = 65536,
     .encoder_tolerance = 0.4},
}};

}  // namespace articula
