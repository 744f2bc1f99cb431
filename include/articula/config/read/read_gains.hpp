// SPDX-License-Identifier: Apache-2.0
/// @file The gains of one joint in a configuration file.
#pragma once

#include "articula/config/read/controller_config.hpp"
#include "articula/config/yaml/config_map.hpp"
#include "articula/control/laws/pid_gains.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace articula::detail {

/// Parameters of the controller on which the meaning of a joint's gains depends.
struct GainContext {
  bool has_velocity = false;          ///< the reference has velocities, for feedforward_gain
  std::optional<bool> feedforward{};  ///< enable_feedforward, if the file has it
  GainSigns signs = GainSigns::not_negative;
};

/// Reads a pair of clamps, `name`_min and `name`_max. A range without 0 would push a joint at rest.
/// @param around_zero  the range must have 0 in it
inline void read_clamps(ConfigMap& map, const std::string& name, double& low, double& high,
                        bool around_zero = true) {
  if (const auto value = map.find(name + "_min")) {
    low = value->number_or_infinity();
    if (around_zero && low > 0) value->refuse("a number <= 0, or -.inf");
  }
  if (const auto value = map.find(name + "_max")) {
    high = value->number_or_infinity();
    if (around_zero && high < 0) value->refuse("a number >= 0, or .inf");
    if (high < low) value->refuse("a number that is not below " + name + "_min");
  }
}

inline void read_all_clamps(ConfigMap& map, PidGains& gains, GainSigns signs) {
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
  read_clamps(map, "u_clamp", gains.output_clamp_min, gains.output_clamp_max,
              signs == GainSigns::not_negative);
  if (const auto saturation = map.find("saturation"); saturation && !saturation->truth()) {
    gains.output_clamp_min = -PidGains::infinity;
    gains.output_clamp_max = PidGains::infinity;
  }
}

/// Reads control_toolbox's anti-windup: a truth value in its older versions, a strategy in its
/// newer ones.
inline void read_anti_windup(ConfigMap& map, PidGains& gains) {
  if (const auto value = map.find("antiwindup"); value && !value->truth()) {
    map.note(*value,
             "not used: in ROS the integral grows beyond its clamps then, here it never does; "
             "ControlToolboxPidLaw computes as ROS does");
  }
  if (const auto value = map.find("antiwindup_strategy")) {
    constexpr std::array strategies = {AntiWindup::none, AntiWindup::back_calculation,
                                       AntiWindup::conditional_integration,
                                       AntiWindup::conditional_integration};
    const std::size_t index =
        value->index_in({"none", "back_calculation", "conditional_integration", "legacy"});
    gains.anti_windup = strategies[index];
    if (index == 3) map.note(*value, "not used: taken as conditional_integration");
  }
  map.read_not_negative("tracking_time_constant", gains.tracking_time);
}

/// Reads the gain of the velocity feed-forward of ROS's PID controller.
inline void read_feedforward(ConfigMap& map, PidGains& gains, const GainContext& context) {
  const auto value = map.find("feedforward_gain");
  const double gain = value ? value->number() : 0;
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

/// Reads parameters that other parts of the program decide.
inline void read_other_parameters(ConfigMap& map, ConfiguredJoint& joint) {
  if (const auto value = map.find_one_of({"angle_wraparound", "normalize_error"})) {
    joint.angle_wraparound = value->truth();
    joint.angle_wraparound_place = value->place;
  }
  for (const std::string_view key : {"save_i_term", "save_iterm"}) {
    const auto value = map.find(key);
    if (!value) continue;
    joint.keeps_integral = value->truth();
    if (joint.keeps_integral) {
      map.note(*value, "used by ControlToolboxPidLaw only: a start sets the integral to 0");
    }
  }
  for (const std::string_view key : {"activate_state_publisher", "publish_state"}) {
    const auto value = map.find(key);
    if (!value) continue;
    static_cast<void>(value->truth());
    map.note(*value, "not used");
  }
}

/// Reads the gains of one joint. Other keys of the map remain unknown.
inline void read_gains(ConfigMap& map, ConfiguredJoint& joint, const GainContext& context) {
  PidGains gains;
  const auto read_gain = [&](std::string_view key, double& gain) {
    context.signs == GainSigns::any ? map.read_number(key, gain) : map.read_not_negative(key, gain);
  };
  read_gain("p", gains.proportional);
  read_gain("i", gains.integral);
  read_gain("d", gains.derivative);
  read_all_clamps(map, gains, context.signs);
  read_anti_windup(map, gains);
  map.read_not_negative("error_deadband", gains.error_deadband);
  map.read_number("ff_velocity_scale", gains.velocity_feedforward);
  read_feedforward(map, gains, context);
  map.read_number("velocity_feedforward", gains.velocity_feedforward);
  map.read_number("acceleration_feedforward", gains.acceleration_feedforward);
  map.read_not_negative("derivative_filter_time", gains.derivative_filter_time);
  const auto read_weight = [&](std::string_view key, double& weight) {
    map.read_number(key, weight);
    if (weight < 0 || weight > 1) map.find(key)->refuse("a number from 0 to 1");
  };
  read_weight("position_weight", gains.position_weight);
  read_weight("velocity_weight", gains.velocity_weight);
  read_other_parameters(map, joint);
  try {
    validate<1>({gains}, {joint.name}, context.signs);
  } catch (const std::invalid_argument& error) {
    map.node().refuse(error.what(), "gains of a controller");
  }
  joint.gains = gains;
}

}  // namespace articula::detail
