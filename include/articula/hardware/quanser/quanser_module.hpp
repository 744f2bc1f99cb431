// SPDX-License-Identifier: Apache-2.0
/// @file The description of one joint module of the Quanser arm: node and encoders.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/hardware/can/drive_checks.hpp"
#include "articula/hardware/quanser/quanser_protocol.hpp"
#include "articula/model/robot.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

namespace articula {

/// One joint module.
struct QuanserModule {
  std::uint8_t node = 0;                ///< 1 .. 31, different for each module
  double motor_counts_per_turn = 4096;  ///< of the motor's encoder, per turn of the motor; negative
                                        ///< if it counts against the joint
  double gear_ratio = 1;                ///< turns of the motor per turn of the joint
  double load_counts_per_turn = 4096;   ///< of the load's encoder, per turn of the joint
  double position_at_zero = 0;          ///< q where both encoders count 0 [rad]
  /// Largest plausible difference of the two encoders, at the joint [rad]: the greatest deflection
  /// between them plus the error of adjustment. A spring of stiffness K between motor and load
  /// deflects by tau/K, and by up to twice that after a step of tau. Infinity: no comparison.
  double encoder_tolerance = std::numeric_limits<double>::infinity();

  /// Counts of the motor's encoder per radian of the joint [1/rad]. Real-time: yes.
  [[nodiscard]] constexpr double motor_scale() const noexcept {
    return motor_counts_per_turn * gear_ratio / (2 * std::numbers::pi);
  }
  /// Counts of the load's encoder per radian of the joint [1/rad]. Real-time: yes.
  [[nodiscard]] constexpr double load_scale() const noexcept {
    return load_counts_per_turn / (2 * std::numbers::pi);
  }
};

/// Joint modules in the order of the joints.
template <int N>
using QuanserModules = std::array<QuanserModule, static_cast<std::size_t>(N)>;

/// Checks the modules of a robot: nodes, scales, tolerances, and the range of positions and
/// efforts.
/// @throws std::invalid_argument with the joint, the value and the limit
/// Real-time: no (throws).
template <Robot R>
void validate(const R& robot, const QuanserModules<joint_count<R>>& modules) {
  for (std::size_t j = 0; j < modules.size(); ++j) {
    const QuanserModule& module = modules[j];
    const detail::DriveChecks check{"joint module", model_of(robot).joints[j]};
    if (check.joint.type == JointType::prismatic) {
      check.refuse({"the joint is prismatic, and the protocol is for rotary joints"});
    }
    check.nodes(modules, j, quanser::last_node);
    check.scale("motor_counts_per_turn", module.motor_counts_per_turn);
    check.scale("gear_ratio", module.gear_ratio);
    check.scale("load_counts_per_turn", module.load_counts_per_turn);
    if (!is_finite(module.position_at_zero)) {
      check.refuse({"position_at_zero ", module.position_at_zero, " is not finite"});
    }
    const double counts = 1 / std::abs(module.motor_scale()) + 1 / std::abs(module.load_scale());
    if (!(module.encoder_tolerance > counts)) {
      check.refuse({"encoder_tolerance ", module.encoder_tolerance, " rad is not above ", counts,
                    " rad, one count of each encoder"});
    }
    check.effort(32.767);  // see quanser::Effort
    for (const double scale : {module.motor_scale(), module.load_scale()}) {
      check.position([&](double q) { return (q - module.position_at_zero) * scale; },
                     quanser::detail::largest_count, "counts");
    }
  }
}

}  // namespace articula
