// SPDX-License-Identifier: Apache-2.0
/// @file The stiffness and damping of a joint.
#pragma once

#include "articula/control/laws/valid_gains.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"

#include <array>
#include <cstddef>
#include <string_view>

namespace articula {

/// The spring and the damper that one joint shall feel like.
struct ImpedanceGains {
  double stiffness = 0;  ///< K [N m/rad or N/m]
  double damping = 0;    ///< D [N m s/rad or N s/m]
};

/// The springs and dampers of N joints.
template <int N>
using JointImpedanceGains = std::array<ImpedanceGains, static_cast<std::size_t>(N)>;

/// Springs and dampers of N joints that have been checked.
template <int N>
using ValidImpedanceGains = ValidGains<ImpedanceGains, N>;

/// Refuses what is not a spring or damper: numbers that are not finite, or below 0.
/// @throws std::invalid_argument naming joint, gain and value
/// Real-time: no (throws).
template <std::size_t N>
void validate(const std::array<ImpedanceGains, N>& gains,
              const std::array<std::string_view, N>& names) {
  for (std::size_t i = 0; i < N; ++i) {
    const auto check = [&](std::string_view what, double value) {
      if (is_finite(value) && value >= 0) return;
      detail::refuse(
          {"impedance of joint '", names[i], "': ", what, " ", value, " is not a number >= 0"});
    };
    check("stiffness", gains[i].stiffness);
    check("damping", gains[i].damping);
  }
}

}  // namespace articula
