// SPDX-License-Identifier: Apache-2.0
/// @file The parameters of one controller, from a section to a ControllerConfig.
#pragma once

#include "articula/config/read/controller_config.hpp"
#include "articula/config/read/read_gains.hpp"
#include "articula/config/read/read_mechanics.hpp"
#include "articula/config/read/robot_joints.hpp"
#include "articula/config/read/section.hpp"
#include "articula/config/read/unused_parameters.hpp"
#include "articula/config/yaml/config_map.hpp"
#include "articula/text/characters.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

class ControllerReader {
 public:
  /// @param robot  the robot with the joints; nullptr: any robot
  /// @param signs  allowed signs of gains
  ControllerReader(const ConfigSection& section, const RobotJoints* robot, GainSigns signs)
      : config_{.notes = section.notes},
        robot_(robot),
        map_(section.parameters, config_.notes, Inherited::may_be_unknown),
        context_{.signs = signs} {
    config_.name = section.name;
    config_.type = section.type;
    config_.place = map_.node().place;
    if (const auto type = map_.find("type")) config_.type = type->word();
    read_joints(section.name);
    read_all_gains();
    read_mechanics(map_, config_);
    read_trajectory();
    read_gripper();
    take_unused_controller_parameters(map_);
    refuse_common_gains();
    if (config_.joints.empty() && map_.has_unknown()) map_.require("joints");
    map_.finish();
  }

  [[nodiscard]] ControllerConfig take() { return std::move(config_); }

 private:
  void read_joints(const std::string& section) {
    const ConfigNode& node = map_.node();
    const ConfigNode* gains = node.find("gains");
    if (const auto value =
            map_.find_one_of({"joints", "dof_names", "joint_names", "joint", "joint_name"})) {
      config_.joints = read_joint_names(*value);
    } else if (gains != nullptr && gains->is_map()) {
      for (const ConfigNode& item : gains->items) {
        // The joints are those of the controller's own gains, if it has any.
        if (item.inherited && !gains->inherited) continue;
        config_.joints.push_back({.name = item.key, .place = item.place});
      }
    } else if (!section.empty() &&
               (node.has_any({"p", "pid"}) || (robot_ != nullptr && robot_->has(section)))) {
      config_.joints = {{.name = section, .place = config_.place}};
    }
    for (const ConfiguredJoint& joint : config_.joints) {
      if (robot_ != nullptr) static_cast<void>(robot_->index(joint.name, joint.place));
    }
  }

  /// Reads the gains of a joint from a map that has no other keys.
  void read_joint_gains(ConfiguredJoint& joint, ConfigMap map) {
    refuse_second(joint, map.node());
    map.require("p");
    read_gains(map, joint, context_);
    map.finish();
  }
  static void refuse_second(const ConfiguredJoint& joint, const ConfigNode& value) {
    if (!joint.gains) return;
    value.refuse("gains of '" + shown(joint.name) + "' a second time", "one place");
  }
  /// Finishes a map whose keys are joints. A note names values of other controllers' joints that
  /// come from wildcards. If the controller has no joints, the missing key is `joints`.
  /// @param kind  of a joint's value
  void finish_by_joint(ConfigMap& map, ConfigNode::Kind kind = ConfigNode::Kind::map) {
    for (const ConfigNode& item : map.node().items) {
      const bool is_other = item.inherited && item.kind == kind && !map.knows(item.key);
      if (!is_other || config_.joints.empty()) continue;
      map.note(*map.find(item.key),
               "not used: joint '" + shown(item.key) + "' is not this controller's");
    }
    if (config_.joints.empty() && map.has_unknown()) {
      map_.require("joints");
    } else {
      map.finish();
    }
  }
  /// Refuses a list p, and one p or pid for several joints.
  void refuse_common_gains() {
    for (const std::string_view key : {"p", "pid"}) {
      const ConfigNode* gain = map_.node().find(key);
      if (gain == nullptr || config_.joints.size() < 2 || map_.knows(key)) continue;
      gain->refuse("gains of several joints at once",
                   "gains of each joint below its name, such as " + shown(config_.joints[0].name) +
                       ": {p: ...}");
    }
  }

  void read_all_gains() {
    if (const auto value = map_.find("enable_feedforward")) context_.feedforward = value->truth();
    if (const auto value = map_.find("reference_and_state_interfaces")) {
      const auto items = value->list();
      if (items.empty() || items.size() > 2) value->refuse("one or two names of interfaces");
      const std::string first = items.front().word(), last = items.back().word();
      context_.has_velocity = first == "position" && last == "velocity";
    }
    if (auto gains = map_.find_map("gains")) {
      config_.gain_prefix = "gains.";
      for (ConfiguredJoint& joint : config_.joints) {
        if (const auto one = gains->find_map(joint.name)) read_joint_gains(joint, *one);
      }
      finish_by_joint(*gains);
    }
    if (config_.joints.size() == 1) {
      if (const auto pid = map_.find_map("pid")) read_joint_gains(config_.joints[0], *pid);
    }
    for (ConfiguredJoint& joint : config_.joints) {
      auto own = map_.find_map(joint.name);
      if (!own) continue;
      if (auto pid = own->find_map("pid")) {
        read_joint_gains(joint, *pid);
        own->finish();
      } else {
        read_joint_gains(joint, *own);
      }
    }
    if (config_.joints.size() == 1) read_own_gains(config_.joints[0]);
    read_matrices();
    if (auto feedforward = map_.find_map("velocity_ff")) {
      for (ConfiguredJoint& joint : config_.joints) {
        const auto value = feedforward->find(joint.name);
        if (!value) continue;
        if (!joint.gains) value->refuse("a factor without gains", "gains of the joint, too");
        joint.gains->velocity_feedforward = value->number();
      }
      finish_by_joint(*feedforward, ConfigNode::Kind::scalar);
    }
  }

  /// Reads p, i, d and the like among the other parameters of a controller of one joint.
  void read_own_gains(ConfiguredJoint& joint) {
    ConfiguredJoint own{.name = joint.name};
    const std::size_t before = map_.found();
    read_gains(map_, own, context_);
    if (map_.found() == before) return;
    refuse_second(joint, map_.node());
    map_.require("p");
    own.place = joint.place;
    joint = own;
  }

  /// Reads Kp and Kd of computed torque controllers.
  void read_matrices() {
    const auto proportional = map_.find("Kp"), derivative = map_.find("Kd");
    if (!proportional && derivative) map_.require("Kp");
    if (!derivative && proportional) map_.require("Kd");
    if (!proportional || !derivative) return;
    const std::size_t n = config_.joints.size();
    const auto p = read_diagonal(*proportional, n), d = read_diagonal(*derivative, n);
    for (std::size_t k = 0; k < n; ++k) {
      refuse_second(config_.joints[k], *proportional);
      config_.joints[k].gains = PidGains{.proportional = p[k], .derivative = d[k]};
    }
  }

  void read_trajectory() {
    map_.read_truth("allow_partial_joints_goal", config_.allow_partial_joints);
    map_.read_truth("allow_integration_in_goal_trajectories", config_.allow_integration);
    map_.read_truth("allow_nonzero_velocity_at_trajectory_end",
                    config_.trajectory.allow_motion_at_end);
    if (const auto value = map_.find("interpolation_method")) {
      const bool none = value->index_in({"splines", "none"}) == 1;
      config_.trajectory.interpolation = none ? Interpolation::none : Interpolation::splines;
    }
    auto constraints = map_.find_map("constraints");
    if (!constraints) return;
    constraints->read_not_negative("stopped_velocity_tolerance",
                                   config_.stopped_velocity_tolerance);
    constraints->read_not_negative("goal_time", config_.goal_time);
    constexpr std::string_view stop = "a stop always keeps the motion limits";
    take_unused(*constraints, {{UnusedParameters::Kind::truth, stop, {"decelerate_on_cancel"}}});
    for (ConfiguredJoint& joint : config_.joints) {
      auto own = constraints->find_map(joint.name);
      if (!own) continue;
      own->read_not_negative("trajectory", joint.path_tolerance);
      own->read_not_negative("goal", joint.goal_tolerance);
      take_unused(*own, {{UnusedParameters::Kind::number, stop, {"max_deceleration_on_cancel"}}});
      own->finish();
    }
    finish_by_joint(*constraints);
  }

  void read_gripper() {
    ConfiguredGripper& gripper = config_.gripper;
    const bool is_gripper = config_.type.ends_with("/GripperActionController");
    const auto note_on = [&](const ConfigNode& value) {
      map_.note(value, is_gripper ? gripper_note : "not used: the controller is no gripper's");
    };
    for (const auto& [key, number] :
         {std::pair("goal_tolerance", &gripper.goal_tolerance),
          std::pair("stall_velocity_threshold", &gripper.stall_velocity_threshold),
          std::pair("stall_timeout", &gripper.stall_timeout)}) {
      map_.read_not_negative(key, *number);
      if (const auto value = map_.find(key)) note_on(*value);
    }
    map_.read_truth("allow_stalling", gripper.allow_stalling);
    if (const auto value = map_.find("allow_stalling")) note_on(*value);
  }

  ControllerConfig config_;
  const RobotJoints* robot_;
  ConfigMap map_;
  GainContext context_;
};

}  // namespace articula::detail
