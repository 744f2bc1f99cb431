// SPDX-License-Identifier: Apache-2.0
/// @file Parameters of ROS's controllers that have no effect in this library.
#pragma once

#include "articula/config/yaml/config_map.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// A parameter that has no effect, its type, and the reason.
struct UnusedParameter {
  enum class Kind : unsigned char { number, truth, word, words, text, any_map };
  std::string_view key;
  Kind kind;
  std::string_view reason;
};

/// Checks the types of parameters without effect, and adds a note on each.
/// @throws FileError if one has the wrong type
inline void take_unused(ConfigMap& map, const std::vector<UnusedParameter>& parameters) {
  for (const UnusedParameter& parameter : parameters) {
    const auto value = map.find(parameter.key);
    if (!value) continue;
    switch (parameter.kind) {
      case UnusedParameter::Kind::number:
        static_cast<void>(value->not_negative());
        break;
      case UnusedParameter::Kind::truth:
        static_cast<void>(value->truth());
        break;
      case UnusedParameter::Kind::word:
        static_cast<void>(value->word());
        break;
      case UnusedParameter::Kind::words:
        for (const ConfigValue& item : value->list()) static_cast<void>(item.word());
        break;
      case UnusedParameter::Kind::text:  // a word that may be missing
        if (value->node().is_map() || value->node().is_list()) value->refuse("a name");
        break;
      case UnusedParameter::Kind::any_map:
        if (!value->node().is_map()) value->refuse("a map");
        break;
    }
    map.note(*value, "not used: " + std::string(parameter.reason));
  }
}

/// Those of all controllers.
inline void take_unused_controller_parameters(ConfigMap& map) {
  using enum UnusedParameter::Kind;
  constexpr std::string_view interfaces = "the types in the program decide what is commanded";
  constexpr std::string_view topics = "nothing is published or received here";
  constexpr std::string_view loop = "a loop has one period and one thread";
  constexpr std::string_view gripper = "there is no gripper action here";
  constexpr std::string_view follower = "docs/references.md describes the follower";
  take_unused(map, {{"command_interfaces", words, interfaces},
                    {"state_interfaces", words, interfaces},
                    {"command_interface", word, interfaces},
                    {"interface_name", word, interfaces},
                    {"command_joints", words, interfaces},
                    {"reference_and_state_dof_names", words, interfaces},
                    {"use_external_measured_states", truth, topics},
                    {"publish_rate", number, topics},
                    {"state_publish_rate", number, topics},
                    {"action_monitor_rate", number, topics},
                    {"robot_description", word, topics},
                    {"use_sim_time", truth, topics},
                    {"qos_overrides", any_map, topics},
                    {"start_type_description_service", truth, topics},
                    {"update_rate", number, loop},
                    {"is_async", truth, loop},
                    {"async_parameters", any_map, loop},
                    {"params_file", word, "this file is all that is read"},
                    {"fallback_controllers", words, "see SupervisedLoop"},
                    {"set_current_state_as_first_setpoint", truth, "it always is"},
                    {"set_last_command_interface_value_as_state_on_activation", truth, follower},
                    {"start_with_holding", truth, "it always does"},
                    {"goal_tolerance", number, gripper},
                    {"max_effort", number, gripper},
                    {"max_effort_interface", text, gripper},
                    {"max_velocity", number, gripper},
                    {"max_velocity_interface", text, gripper},
                    {"use_effort_interface", truth, gripper},
                    {"use_speed_interface", truth, gripper},
                    {"default", truth, gripper},
                    {"stall_velocity_threshold", number, gripper},
                    {"stall_timeout", number, gripper},
                    {"allow_stalling", truth, gripper},
                    {"interpolate_from_desired_state", truth, follower},
                    {"open_loop_control", truth, follower},
                    {"allow_trajectory_replacement", truth, follower},
                    {"stop_trajectory_duration", number, follower},
                    {"cmd_timeout", number, follower},
                    {"speed_scaling", any_map, follower},
                    {"speed_scaling_interface_name", text, follower},
                    {"tf_prefix", text, topics},
                    {"positions_upsampling", any_map, follower}});
}

}  // namespace articula::detail
