// SPDX-License-Identifier: Apache-2.0
/// @file Parameters of ROS's controllers that have no effect in this library.
#pragma once

#include "articula/config/yaml/config_map.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// Parameters that have no effect, their type, and the reason.
struct UnusedParameters {
  enum class Kind : unsigned char { number, truth, word, words, text, any_map };
  Kind kind;
  std::string_view reason;
  std::vector<std::string_view> keys;
};

/// @throws FileError if a value has the wrong type
inline void check_kind(const ConfigNode& value, UnusedParameters::Kind kind) {
  using enum UnusedParameters::Kind;
  if (kind == number) static_cast<void>(value.not_negative());
  if (kind == truth) static_cast<void>(value.truth());
  if (kind == word) static_cast<void>(value.word());
  if (kind == words) {
    for (const ConfigNode& item : value.list()) static_cast<void>(item.word());
  }
  if (kind == text && (value.is_map() || value.is_list())) value.refuse("a name");
  if (kind == any_map && !value.is_map()) value.refuse("a map");
}

/// Checks the types of parameters without effect, and adds a note on each.
/// @throws FileError if one has the wrong type
inline void take_unused(ConfigMap& map, const std::vector<UnusedParameters>& all) {
  for (const UnusedParameters& parameters : all) {
    for (const std::string_view key : parameters.keys) {
      const auto value = map.find(key);
      if (!value) continue;
      check_kind(*value, parameters.kind);
      map.note(*value, "not used: " + std::string(parameters.reason));
    }
  }
}

/// Those of all controllers.
inline void take_unused_controller_parameters(ConfigMap& map) {
  using enum UnusedParameters::Kind;
  constexpr std::string_view interfaces = "the types in the program decide what is commanded";
  constexpr std::string_view topics = "articula has its own topics and rates";
  constexpr std::string_view loop = "a loop has one period and one thread";
  constexpr std::string_view limits = "the robot's limits of effort and velocity hold";
  constexpr std::string_view follower = "docs/references.md describes the follower";
  take_unused(
      map, {{words,
             interfaces,
             {"command_interfaces", "state_interfaces", "command_joints",
              "reference_and_state_dof_names"}},
            {word, interfaces, {"command_interface", "interface_name"}},
            {truth,
             topics,
             {"use_external_measured_states", "use_sim_time", "start_type_description_service"}},
            {number, topics, {"publish_rate", "state_publish_rate", "action_monitor_rate"}},
            {word, topics, {"robot_description"}},
            {any_map, topics, {"qos_overrides"}},
            {text, topics, {"tf_prefix"}},
            {number, loop, {"update_rate"}},
            {truth, loop, {"is_async"}},
            {any_map, loop, {"async_parameters"}},
            {word, "this file is all that is read", {"params_file"}},
            {word, "the program decides which controller is active", {"state"}},
            {words, "see SupervisedLoop", {"fallback_controllers"}},
            {truth, "it always is", {"set_current_state_as_first_setpoint"}},
            {truth, "it always does", {"start_with_holding"}},
            {number, limits, {"max_effort", "max_velocity"}},
            {text, limits, {"max_effort_interface", "max_velocity_interface"}},
            {truth, limits, {"use_effort_interface", "use_speed_interface"}},
            {truth, "MoveIt alone reads it", {"default"}},
            {truth,
             follower,
             {"interpolate_from_desired_state", "open_loop_control", "allow_trajectory_replacement",
              "set_last_command_interface_value_as_state_on_activation"}},
            {number, follower, {"stop_trajectory_duration", "cmd_timeout"}},
            {any_map, follower, {"speed_scaling", "positions_upsampling"}},
            {text, follower, {"speed_scaling_interface_name"}}});
}

}  // namespace articula::detail
