// SPDX-License-Identifier: Apache-2.0
/// @file The gains of one joint in a configuration file.
#pragma once

#include "articula/config/read/controller_config.hpp"
#include "articula/config/yaml/reader.hpp"
#include "articula/control/laws/pid_gains.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace articula::detail {

/// What else decides what the gains of a joint mean.
struct GainContext {
  bool has_velocity = false;          ///< of the reference, which feedforward_gain then multiplies
  std::optional<bool> feedforward{};  ///< enable_feedforward, where the controller says it
  GainSigns signs = GainSigns::not_negative;
};

/// A pair of clamps: `name`_min and `name`_max. Without 0 between them a joint would be pushed at
/// rest.
/// @param around_zero  0 must be between them
inline void read_clamps(ConfigMap& map, const std::string& name, double& low, double& high,
                        bool around_zero = true) {
  if (const auto value = map.find(name + "_min")) {
    low = value->number_or_infinity();
    if (around_zero && low > 0) value->refuse("a number <= 0, or -.inf");
  }
  if (const auto value = map.find(name + "_max")) {
    high = value->number_or_infinity();
    if (around_zero && high < 0) value->refuse("a number >= 0, or .inf");
    if (high < low) value->refuse("a number that is not below that of " + name + "_min");
  }
}

/// control_toolbox's antiwindup, a truth value in its older versions, a strategy in the newer ones.
inline void read_anti_windup(ConfigMap& map, PidGains& gains) {
  if (const auto value = map.find("antiwindup")) {
    if (!value->truth()) {
      map.note(*value,
               "not used: ROS lets the integral grow behind its clamps then, here it never "
               "does; ControlToolboxPidLaw computes what ROS does");
    }
  }
  if (const auto value = map.find("antiwindup_strategy")) {
    constexpr std::array strategies = {AntiWindup::none, AntiWindup::back_calculation,
                                       AntiWindup::conditional_integration,
                                       AntiWindup::conditional_integration};
    const std::size_t which =
        value->one_of({"none", "back_calculation", "conditional_integration", "legacy"});
    gains.anti_windup = strategies[which];
    if (which == 3) map.note(*value, "not used: taken as conditional_integration");
  }
}

/// Whether the error of a turning joint is that of the short way round. Here the joint's type says
/// it.
inline void read_short_way(ConfigMap& map, ConfiguredJoint& joint) {
  for (const std::string_view key : {"angle_wraparound", "normalize_error"}) {
    const auto value = map.find(key);
    if (!value) continue;
    if (joint.short_way) value->refuse("the same a second time", "one of them");
    joint.short_way = value->truth();
    joint.short_way_place = value->place();
  }
}

/// The gain of the feed-forward of ROS's PID controller, which a switch of its own may turn off.
inline void read_feedforward(ConfigMap& map, PidGains& gains, const GainContext& context) {
  const auto value = map.find("feedforward_gain");
  if (!value) return;
  const double gain = value->number();
  if (gain == 0) return;
  if (context.feedforward == false) {
    map.note(*value, "not used: enable_feedforward is false");
    return;
  }
  if (!context.has_velocity) {
    value->refuse("0, or position and velocity in reference_and_state_interfaces");
  }
  gains.velocity_feedforward = gain;
  if (!context.feedforward) {
    map.note(*value,
             "no enable_feedforward is given: true here, as in ROS without that parameter; "
             "Humble and Jazzy take false");
  }
}

/// Reads the gains of one joint.
/// @param map    what else is in it stays unknown; who needs p expects it
/// @param joint  receives them
inline void read_gains(ConfigMap& map, ConfiguredJoint& joint, const GainContext& context) {
  PidGains gains;
  const bool any_sign = context.signs == GainSigns::any;
  const auto read = [&](std::string_view key, double& to) {
    if (const auto value = map.find(key)) to = value->number();
  };
  const auto read_not_negative = [&](std::string_view key, double& to) {
    if (const auto value = map.find(key)) to = value->not_negative();
  };
  const auto read_gain = [&](std::string_view key, double& to) {
    any_sign ? read(key, to) : read_not_negative(key, to);
  };
  read_gain("p", gains.proportional);
  read_gain("i", gains.integral);
  read_gain("d", gains.derivative);

  if (const auto clamp = map.find("i_clamp")) {
    gains.integral_clamp_max = clamp->number_or_infinity();
    if (gains.integral_clamp_max < 0) clamp->refuse("a number >= 0");
    gains.integral_clamp_min = -gains.integral_clamp_max;
  }
  read_clamps(map, "i_clamp", gains.integral_clamp_min, gains.integral_clamp_max);
  if (gains.integral != 0 && gains.integral_clamp_max == PidGains::infinity &&
      gains.integral_clamp_min == -PidGains::infinity) {
    map.note(*map.find("i"),
             "no i_clamp is given: none here, as from ROS 2 Jazzy on; ROS 1 and Humble "
             "take 0, that is no integral");
  }
  read_clamps(map, "u_clamp", gains.output_clamp_min, gains.output_clamp_max, !any_sign);
  if (const auto saturation = map.find("saturation"); saturation && !saturation->truth()) {
    gains.output_clamp_min = -PidGains::infinity;
    gains.output_clamp_max = PidGains::infinity;
  }
  read_anti_windup(map, gains);
  read_not_negative("tracking_time_constant", gains.tracking_time);
  read_not_negative("error_deadband", gains.error_deadband);

  read("ff_velocity_scale", gains.velocity_feedforward);
  read_feedforward(map, gains, context);
  read("velocity_feedforward", gains.velocity_feedforward);
  read("acceleration_feedforward", gains.acceleration_feedforward);
  read_not_negative("derivative_filter_time", gains.derivative_filter_time);
  const auto read_weight = [&](std::string_view key, double& to) {
    if (const auto value = map.find(key)) {
      to = value->number();
      if (to < 0 || to > 1) value->refuse("a number from 0 to 1");
    }
  };
  read_weight("position_weight", gains.position_weight);
  read_weight("velocity_weight", gains.velocity_weight);

  read_short_way(map, joint);
  for (const std::string_view key : {"save_i_term", "save_iterm"}) {
    const auto value = map.find(key);
    if (!value) continue;
    joint.keeps_integral = value->truth();
    if (joint.keeps_integral) {
      map.note(*value, "not used, but by ControlToolboxPidLaw: a start sets the integral to 0");
    }
  }
  for (const std::string_view key : {"activate_state_publisher", "publish_state"}) {
    if (const auto value = map.find(key)) {
      static_cast<void>(value->truth());
      map.note(*value, "not used");
    }
  }
  try {
    validate<1>({gains}, {joint.name}, context.signs);
  } catch (const std::invalid_argument& error) {
    map.value().refuse(error.what(), "gains of a controller");
  }
  joint.gains = gains;
}

}  // namespace articula::detail
