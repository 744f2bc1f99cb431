// SPDX-License-Identifier: Apache-2.0
/// @file One joint module of the Quanser arm: its place on the bus and its encoders.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/hardware/quanser/quanser_protocol.hpp"
#include "articula/model/robot.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string_view>

namespace articula {

/// One joint module: its place on the bus and its encoders.
struct QuanserModule {
  std::uint8_t node = 0;  ///< 1 .. 31, no two alike
  double motor_counts_per_turn =
      4096;                            ///< of the motor's encoder, per turn of the motor; < 0 if it
                                       ///< counts against the joint
  double gear_ratio = 1;               ///< turns of the motor per turn of the joint
  double load_counts_per_turn = 4096;  ///< of the load's encoder, per turn of the joint
  double position_at_zero = 0;         ///< q where both encoders count 0 [rad]
  /// Largest difference of both encoders that is plausible, at the joint [rad]: the greatest
  /// deflection of what lies between them, and the error of adjustment. A spring of stiffness K
  /// between motor and load bends by tau/K, and up to twice as far after a step of tau. Infinity:
  /// nothing is compared.
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

/// Refuses modules that cannot drive a robot: nodes out of range or used twice, scales that are not
/// finite or 0, a tolerance below a count, positions and efforts that do not fit into the frames.
/// @throws std::invalid_argument naming the joint, the value and the limit
/// Real-time: no (throws).
template <Robot R>
void validate(const R& robot, const QuanserModules<joint_count<R>>& modules) {
  for (std::size_t j = 0; j < modules.size(); ++j) {
    const QuanserModule& module = modules[j];
    const JointProperties& joint = model_of(robot).joints[j];
    const auto refuse = [&](detail::MessageParts parts) {
      detail::refuse({"joint module of '", joint.name.view(), "': ", detail::message_of(parts)});
    };
    if (joint.type == JointType::prismatic) {
      refuse({"the joint slides, and the protocol is for turns"});
    }
    if (module.node < 1 || module.node > quanser::last_node) {
      refuse({"node ", int{module.node}, " is not within 1 .. ", int{quanser::last_node}});
    }
    for (std::size_t other = 0; other < j; ++other) {
      if (modules[other].node == module.node) refuse({"node ", int{module.node}, " is used twice"});
    }
    const auto scale = [&](std::string_view what, double value) {
      if (is_finite(value) && value != 0) return;
      refuse({what, " ", value, " is not a number other than 0"});
    };
    scale("motor_counts_per_turn", module.motor_counts_per_turn);
    scale("gear_ratio", module.gear_ratio);
    scale("load_counts_per_turn", module.load_counts_per_turn);
    if (!is_finite(module.position_at_zero)) {
      refuse({"position_at_zero ", module.position_at_zero, " is not finite"});
    }
    const double counts = 1 / std::abs(module.motor_scale()) + 1 / std::abs(module.load_scale());
    if (!(module.encoder_tolerance > counts)) {
      refuse({"encoder_tolerance ", module.encoder_tolerance, " rad is not above ", counts,
              " rad, one count of each encoder"});
    }
    const double highest_effort = 32.767;  // N m, see Effort
    if (!(joint.limits.effort <= highest_effort)) {
      refuse({"the joint's effort limit ", joint.limits.effort, " N m is above the ",
              highest_effort, " N m that a frame can carry"});
    }
    for (const double limit : {joint.limits.lower, joint.limits.upper}) {
      if (!is_finite(limit)) continue;
      for (const double per_radian : {module.motor_scale(), module.load_scale()}) {
        const double highest = std::abs((limit - module.position_at_zero) * per_radian);
        if (highest <= quanser::detail::largest_count) continue;
        refuse({"the joint's limit ", limit, " rad is ", highest, " counts, above the ",
                quanser::detail::largest_count, " that a frame can carry"});
      }
    }
  }
}

}  // namespace articula
