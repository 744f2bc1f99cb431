// SPDX-License-Identifier: Apache-2.0
/// @file The parameters of one controller in a configuration file.
#pragma once

#include "articula/config/controller_config.hpp"
#include "articula/config/read_gains.hpp"
#include "articula/config/reader.hpp"
#include "articula/config/section.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

/// A parameter that ROS's controllers have and that has no effect here.
struct UnusedParameter {
  enum class Kind : unsigned char { number, truth, word, words, any_map };
  std::string_view key;
  Kind kind;
  std::string_view why;
};

/// Takes parameters that have no effect, if they are there: of the right type, and noted.
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
      case UnusedParameter::Kind::any_map:
        if (!value->node().is_map()) value->refuse("a map");
        break;
    }
    map.note(*value, "not used: " + std::string(parameter.why));
  }
}

inline void take_unused_controller_parameters(ConfigMap& map) {
  using enum UnusedParameter::Kind;
  constexpr std::string_view interfaces = "the types in the program decide what is commanded";
  constexpr std::string_view topics = "nothing is published or received here";
  constexpr std::string_view loop = "a loop has one period and one thread";
  constexpr std::string_view follower = "see docs/references.md for what the follower does";
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
                    {"update_rate", number, loop},
                    {"is_async", truth, loop},
                    {"async_parameters", any_map, loop},
                    {"params_file", word, "this file is all that is read"},
                    {"fallback_controllers", words, "see SupervisedLoop"},
                    {"set_current_state_as_first_setpoint", truth, "it always is"},
                    {"set_last_command_interface_value_as_state_on_activation", truth, follower},
                    {"interpolate_from_desired_state", truth, follower},
                    {"open_loop_control", truth, follower},
                    {"allow_trajectory_replacement", truth, follower},
                    {"stop_trajectory_duration", number, follower},
                    {"cmd_timeout", number, follower},
                    {"speed_scaling", any_map, follower},
                    {"positions_upsampling", any_map, follower}});
}

/// Names of joints, none of them twice.
[[nodiscard]] inline std::vector<ConfiguredJoint> read_joint_list(const ConfigValue& value) {
  constexpr std::size_t most = 1000;
  std::vector<ConfiguredJoint> joints;
  if (value.list().size() > most) value.refuse("at most 1000 names");
  for (const ConfigValue& item : value.list()) {
    const std::string name = item.word();
    for (const ConfiguredJoint& joint : joints) {
      if (joint.name == name)
        item.refuse("'" + shown(name) + "' a second time", "every joint once");
    }
    joints.push_back({.name = name, .place = item.place()});
  }
  if (joints.empty()) value.refuse("the names of joints");
  return joints;
}

[[nodiscard]] inline Vector3<double> read_vector(const ConfigValue& value,
                                                 std::vector<std::string>& notes) {
  if (value.node().is_list()) {
    const auto items = value.list();
    if (items.size() != 3) value.refuse("three numbers, or a map of x, y and z");
    return {items[0].number(), items[1].number(), items[2].number()};
  }
  if (!value.node().is_map()) value.refuse("a map of x, y and z, or three numbers");
  ConfigMap map(value, notes);
  const auto part = [&](std::string_view key) {
    const auto found = map.find(key);
    return found ? found->number() : 0;
  };
  const double x = part("x"), y = part("y"), z = map.need("z").number();
  map.finish();
  return {x, y, z};
}

/// Reads the parameters of one controller.
class ControllerReader {
 public:
  ControllerReader(const std::string& file, const ConfigSection& section)
      : map_(ConfigValue(file, section.parameters, section.path), config_.notes) {
    config_.name = section.name;
    config_.type = section.type;
    config_.place = map_.value().place();
    if (const auto type = map_.find("type")) config_.type = type->word();
    read_joints(section.name);
    read_all_gains();
    read_mechanics();
    read_trajectory();
    take_unused_controller_parameters(map_);
    map_.finish();
  }

  [[nodiscard]] ControllerConfig take() { return std::move(config_); }

 private:
  void read_joints(const std::string& section) {
    std::optional<ConfigValue> given;
    for (const std::string_view key : {"joints", "dof_names", "joint_names"}) {
      const auto value = map_.find(key);
      if (value && given) value->refuse("joints a second time", "one list of joints");
      if (value) given = value;
    }
    if (given) config_.joints = read_joint_list(*given);
    for (const std::string_view key : {"joint", "joint_name"}) {
      const auto value = map_.find(key);
      if (!value) continue;
      if (given) value->refuse("joints a second time", "'joints' or 'joint'");
      given = value;
      config_.joints = {{.name = value->word(), .place = value->place()}};
    }
    if (given) return;
    const ConfigNode& node = map_.value().node();
    if (const ConfigNode* gains = node.find("gains")) {
      const ConfigValue by_joint = map_.value().at(*gains);
      for (const ConfigNode& item : gains->items) {
        config_.joints.push_back({.name = item.key, .place = by_joint.at(item).place()});
      }
    } else if (!section.empty() && (node.find("p") != nullptr || node.find("pid") != nullptr)) {
      config_.joints = {{.name = section, .place = config_.place}};
    }
  }

  void give(ConfiguredJoint& joint, const PidGains& gains, const ConfigValue& where) {
    if (joint.gains)
      where.refuse("gains of '" + shown(joint.name) + "' a second time", "one place");
    joint.gains = gains;
  }

  void read_all_gains() {
    bool has_velocity = false;
    if (const auto value = map_.find("reference_and_state_interfaces")) {
      const auto items = value->list();
      for (const ConfigValue& item : items) static_cast<void>(item.word());
      has_velocity =
          items.size() == 2 && items[0].word() == "position" && items[1].word() == "velocity";
      if (items.empty() || items.size() > 2) value->refuse("one or two names of interfaces");
    }
    if (auto gains = map_.find_map("gains")) {
      for (ConfiguredJoint& joint : config_.joints) {
        if (const auto one = gains->find_map(joint.name)) {
          give(joint, read_gains(*one, joint.name, has_velocity), one->value());
        }
      }
      gains->finish();
    }
    const bool single = config_.joints.size() == 1;
    if (single && map_.value().node().find("p") != nullptr) {
      read_own_gains();
    } else if (single) {
      if (const auto pid = map_.find_map("pid")) {
        give(config_.joints[0], read_gains(*pid, config_.joints[0].name), pid->value());
      }
    }
    for (ConfiguredJoint& joint : config_.joints) {
      auto own = map_.find_map(joint.name);
      if (!own) continue;
      if (auto pid = own->find_map("pid")) {
        give(joint, read_gains(*pid, joint.name), pid->value());
        own->finish();
      } else {
        give(joint, read_gains(ConfigMap(own->value(), config_.notes), joint.name), own->value());
      }
    }
    read_matrices();
    if (auto feedforward = map_.find_map("velocity_ff")) {
      for (ConfiguredJoint& joint : config_.joints) {
        const auto value = feedforward->find(joint.name);
        if (value && !joint.gains)
          value->refuse("a factor without gains", "gains of the joint, too");
        if (value) joint.gains->velocity_feedforward = value->number();
      }
      feedforward->finish();
    }
  }

  /// A controller of one joint may have p, i, d and their like among its other parameters.
  void read_own_gains() {
    ConfigNode gains = map_.value().node();
    std::erase_if(gains.items, [](const ConfigNode& item) {
      return std::find(gain_keys.begin(), gain_keys.end(), item.key) == gain_keys.end();
    });
    for (const std::string_view key : gain_keys) static_cast<void>(map_.find(key));
    const ConfigPlace& place = config_.place;
    const ConfigMap own(ConfigValue(place.file, gains, place.key), config_.notes);
    give(config_.joints[0], read_gains(own, config_.joints[0].name), map_.value());
  }

  /// Kp and Kd of computed torque controllers: matrices by rows, of which the diagonal counts.
  void read_matrices() {
    const auto proportional = map_.find("Kp"), derivative = map_.find("Kd");
    if (!proportional && !derivative) return;
    if (!proportional) static_cast<void>(map_.need("Kp"));
    if (!derivative) static_cast<void>(map_.need("Kd"));
    const std::size_t n = config_.joints.size();
    const auto diagonal = [&](const ConfigValue& value) {
      const auto items = value.list();
      if (items.size() != n && items.size() != n * n) {
        value.refuse("a number for each of " + std::to_string(n) + " joints, or a matrix by rows");
      }
      const std::size_t step = items.size() == n ? 1 : n + 1;
      std::vector<double> numbers;
      for (std::size_t k = 0; k < items.size(); ++k) {
        const double number = items[k].number();
        if (k % step == 0) {
          numbers.push_back(number);
        } else if (number != 0) {
          items[k].refuse("0 off the diagonal, since every joint has a controller of its own");
        }
      }
      return numbers;
    };
    const auto p = diagonal(*proportional), d = diagonal(*derivative);
    for (std::size_t k = 0; k < n; ++k) {
      give(config_.joints[k], {.proportional = p[k], .derivative = d[k]}, *proportional);
    }
  }

  void read_mechanics() {
    if (const auto value = map_.find("gravity")) {
      config_.gravity = read_vector(*value, config_.notes);
      config_.gravity_place = value->place();
    }
    if (auto chain = map_.find_map("chain")) {
      if (const auto root = chain->find("root")) {
        config_.chain_root = root->word();
        config_.chain_root_place = root->place();
      }
      if (const auto tip = chain->find("tip")) {
        config_.chain_tip = tip->word();
        config_.chain_tip_place = tip->place();
      }
      chain->finish();
    }
    if (const auto value = map_.find("priority")) config_.priority = value->integer(0, 99);
  }

  void read_trajectory() {
    const auto read = [&](std::string_view key, bool& to) {
      if (const auto value = map_.find(key)) to = value->truth();
    };
    read("allow_partial_joints_goal", config_.allow_partial_joints);
    read("allow_integration_in_goal_trajectories", config_.allow_integration);
    read("allow_nonzero_velocity_at_trajectory_end", config_.trajectory.allow_motion_at_end);
    if (const auto value = map_.find("interpolation_method")) {
      const bool none = value->one_of({"splines", "none"}) == 1;
      config_.trajectory.interpolation = none ? Interpolation::none : Interpolation::splines;
    }
    auto constraints = map_.find_map("constraints");
    if (!constraints) return;
    const auto tolerance = [](ConfigMap& map, std::string_view key, double& to) {
      if (const auto value = map.find(key)) to = value->not_negative();
    };
    tolerance(*constraints, "stopped_velocity_tolerance", config_.stopped_velocity_tolerance);
    tolerance(*constraints, "goal_time", config_.goal_time);
    constexpr std::string_view stop = "a stop always keeps the motion limits";
    take_unused(*constraints, {{"decelerate_on_cancel", UnusedParameter::Kind::truth, stop}});
    for (ConfiguredJoint& joint : config_.joints) {
      auto own = constraints->find_map(joint.name);
      if (!own) continue;
      tolerance(*own, "trajectory", joint.path_tolerance);
      tolerance(*own, "goal", joint.goal_tolerance);
      take_unused(*own, {{"max_deceleration_on_cancel", UnusedParameter::Kind::number, stop}});
      own->finish();
    }
    constraints->finish();
  }

  static inline const std::vector<std::string_view> gain_keys = {
      "p", "i", "d", "i_clamp", "i_clamp_min", "i_clamp_max", "antiwindup", "publish_state"};

  ControllerConfig config_{};
  ConfigMap map_;
};

}  // namespace articula::detail
