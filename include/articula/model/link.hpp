// SPDX-License-Identifier: Apache-2.0
/// @file A link of a robot's description.
#pragma once

#include "articula/core/name.hpp"
#include "articula/model/inertia.hpp"

namespace articula {

/// A rigid link as URDF describes it. A link without mass and inertia is only a frame.
struct Link {
  Name name{};                            ///< unique among the links
  double mass = 0;                        ///< m [kg]
  Vector3<double> center_of_mass{};       ///< in the link frame [m], 3 x 1
  Symmetric3<double> inertia{};           ///< about the centre of mass [kg m^2], 3 x 3
  Vector3<double> inertia_orientation{};  ///< roll, pitch, yaw of the inertia's axes [rad], 3 x 1
};

/// The link's inertia about the origin of its frame.
[[nodiscard]] constexpr Inertia<double> inertia_of(const Link& link) noexcept {
  return moved({rotation_from_rpy(link.inertia_orientation), link.center_of_mass},
               Inertia<double>{link.mass, {}, link.inertia});
}

}  // namespace articula
