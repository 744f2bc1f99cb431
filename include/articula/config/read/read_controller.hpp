// SPDX-License-Identifier: Apache-2.0
/// @file The parameters of one controller in a configuration file.
#pragma once

#include "articula/config/read/controller_config.hpp"
#include "articula/config/read/read_gains.hpp"
#include "articula/config/read/read_lists.hpp"
#include "articula/config/read/read_mechanics.hpp"
#include "articula/config/read/robot_joints.hpp"
#include "articula/config/read/section.hpp"
#include "articula/config/read/unused_parameters.hpp"
#include "articula/config/yaml/decimal_commas.hpp"
#include "articula/config/yaml/reader.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

/// Reads the parameters of one controller.
class ControllerReader {
 public:
  /// @param robot  whose joints they are; nullptr: of any robot
  /// @param signs  which its gains may have
  ControllerReader(const std::string& file, const ConfigSection& section, const RobotJoints* robot,
                   GainSigns signs = GainSigns::not_negative)
      : config_{.notes = section.notes},
        robot_(robot),
        map_(ConfigValue(file, section.parameters, section.path), config_.notes,
             Inherited::may_be_unknown),
        context_{.signs = signs} {
    config_.name = section.name;
    config_.type = section.type;
    config_.place = map_.value().place();
    if (const auto type = map_.find("type")) config_.type = type->word();
    read_joints(section.name);
    read_all_gains();
    read_mechanics(map_, config_);
    read_trajectory();
    take_unused_controller_parameters(map_);
    refuse_common_gains();
    if (config_.joints.empty() && map_.has_unknown()) static_cast<void>(map_.expect("joints"));
    map_.finish();
  }

  [[nodiscard]] ControllerConfig take() { return std::move(config_); }

 private:
  void read_joints(const std::string& section) {
    find_joints(section);
    if (robot_ == nullptr) return;
    for (const ConfiguredJoint& joint : config_.joints) {
      static_cast<void>(robot_->index(joint.name, joint.place));
    }
  }

  void find_joints(const std::string& section) {
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
      config_.joints = {{.name = value->name(), .place = value->place()}};
    }
    if (given) return;
    const ConfigNode& node = map_.value().node();
    if (const ConfigNode* gains = node.find("gains"); gains != nullptr && gains->is_map()) {
      const ConfigValue by_joint = map_.value().at(*gains);
      for (const ConfigNode& item : gains->items) {
        // Whose gains the controller gives itself are its joints, if it gives any.
        if (item.inherited && !gains->inherited) continue;
        config_.joints.push_back({.name = item.key, .place = by_joint.at(item).place()});
      }
    } else if (!section.empty() && (node.find("p") != nullptr || node.find("pid") != nullptr ||
                                    (robot_ != nullptr && robot_->has(section)))) {
      config_.joints = {{.name = section, .place = config_.place}};
    }
  }

  /// Takes the gains of a joint from a map, which must have no other keys.
  void give(ConfiguredJoint& joint, ConfigMap map) {
    refuse_second(joint, map.value());
    static_cast<void>(map.expect("p"));
    read_gains(map, joint, context_);
    map.finish();
  }
  static void refuse_second(const ConfiguredJoint& joint, const ConfigValue& where) {
    if (!joint.gains) return;
    where.refuse("gains of '" + shown(joint.name) + "' a second time", "one place");
  }
  /// Ends a map whose keys are joints. Without joints it is they that are missing. What a wildcard
  /// says about joints of other controllers is noted.
  /// @param kind  of what the map has for a joint; anything else is a slip
  void finish_by_joint(ConfigMap& map, ConfigNode::Kind kind = ConfigNode::Kind::map) {
    for (const ConfigNode& item : map.value().node().items) {
      const bool others = item.inherited && item.kind == kind && !map.knows(item.key);
      if (!others || config_.joints.empty()) continue;
      map.note(*map.find(item.key),
               "not used: joint '" + shown(item.key) + "' is not this controller's");
    }
    if (config_.joints.empty() && map.has_unknown()) {
      static_cast<void>(map_.expect("joints"));
    } else {
      map.finish();
    }
  }
  /// A list p, or one p or pid for several joints, is no gain.
  void refuse_common_gains() {
    for (const std::string_view key : {"p", "pid"}) {
      const ConfigNode* gain = map_.value().node().find(key);
      if (gain == nullptr || config_.joints.size() < 2 || map_.knows(key)) continue;
      map_.value().at(*gain).refuse(
          "gains of several joints at once",
          "those of each below its name, such as " + shown(config_.joints[0].name) + ": {p: ...}");
    }
  }

  void read_all_gains() {
    if (const auto value = map_.find("enable_feedforward")) context_.feedforward = value->truth();
    if (const auto value = map_.find("reference_and_state_interfaces")) {
      const auto items = value->list();
      for (const ConfigValue& item : items) static_cast<void>(item.word());
      context_.has_velocity =
          items.size() == 2 && items[0].word() == "position" && items[1].word() == "velocity";
      if (items.empty() || items.size() > 2) value->refuse("one or two names of interfaces");
    }
    if (auto gains = map_.find_map("gains")) {
      for (ConfiguredJoint& joint : config_.joints) {
        if (const auto one = gains->find_map(joint.name)) give(joint, *one);
      }
      finish_by_joint(*gains);
    }
    if (config_.joints.size() == 1) {
      if (const auto pid = map_.find_map("pid")) give(config_.joints[0], *pid);
    }
    for (ConfiguredJoint& joint : config_.joints) {
      if (auto own = map_.find_map(joint.name)) {
        if (auto pid = own->find_map("pid")) {
          give(joint, *pid);
          own->finish();
        } else {
          give(joint, *own);
        }
      }
    }
    if (config_.joints.size() == 1) read_own_gains(config_.joints[0]);
    read_matrices();
    if (auto feedforward = map_.find_map("velocity_ff")) {
      for (ConfiguredJoint& joint : config_.joints) {
        const auto value = feedforward->find(joint.name);
        if (value && !joint.gains)
          value->refuse("a factor without gains", "gains of the joint, too");
        if (value) joint.gains->velocity_feedforward = value->number();
      }
      finish_by_joint(*feedforward, ConfigNode::Kind::scalar);
    }
  }

  /// A controller of one joint may have p, i, d and their like among its other parameters.
  void read_own_gains(ConfiguredJoint& joint) {
    ConfiguredJoint own{.name = joint.name};
    const std::size_t before = map_.found();
    read_gains(map_, own, context_);
    if (map_.found() == before) return;
    refuse_second(joint, map_.value());
    static_cast<void>(map_.expect("p"));
    own.place = joint.place;
    joint = own;
  }

  /// Kp and Kd of computed torque controllers: matrices by rows, of which the diagonal counts.
  void read_matrices() {
    const auto proportional = map_.find("Kp"), derivative = map_.find("Kd");
    if (!proportional && derivative) static_cast<void>(map_.expect("Kp"));
    if (!derivative && proportional) static_cast<void>(map_.expect("Kd"));
    if (!proportional || !derivative) return;
    const std::size_t n = config_.joints.size();
    const auto diagonal = [&](const ConfigValue& value) {
      const auto items = value.list();
      refuse_length(value, n);
      const std::size_t step = items.size() == n ? 1 : n + 1;
      std::vector<double> numbers;
      for (std::size_t k = 0; k < items.size(); ++k) {
        if (k % step == 0) {
          numbers.push_back(items[k].not_negative());
        } else if (items[k].number() != 0) {
          items[k].refuse("0 off the diagonal, since every joint has a controller of its own");
        }
      }
      return numbers;
    };
    const auto p = diagonal(*proportional), d = diagonal(*derivative);
    for (std::size_t k = 0; k < n; ++k) {
      refuse_second(config_.joints[k], *proportional);
      config_.joints[k].gains = PidGains{.proportional = p[k], .derivative = d[k]};
    }
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
    finish_by_joint(*constraints);
  }

  ControllerConfig config_;
  const RobotJoints* robot_;
  ConfigMap map_;
  GainContext context_;
};

}  // namespace articula::detail
