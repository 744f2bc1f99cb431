// SPDX-License-Identifier: Apache-2.0
/// @file The waveforms of a section of a configuration file.
#pragma once

#include "articula/config/read/read_signal.hpp"
#include "articula/config/read/robot_joints.hpp"
#include "articula/config/read/section.hpp"
#include "articula/config/read/signal_bounds.hpp"
#include "articula/config/read/signal_config.hpp"
#include "articula/config/read/unused_parameters.hpp"
#include "articula/config/yaml/config_map.hpp"
#include "articula/core/finite.hpp"
#include "articula/reference/joint_signals.hpp"
#include "articula/text/characters.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/similar_word.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace articula::detail {

/// A joint of a section whose map has waveforms, where the section should have `waveforms` with the
/// joints in it; nullptr if there is none.
[[nodiscard]] inline const ConfigNode* misplaced_waveforms(const ConfigNode& section,
                                                           const RobotJoints& robot) {
  if (section.find("waveforms") != nullptr) return nullptr;
  for (const ConfigNode& item : section.items) {
    const bool is_wave = item.has_any({"amplitude", "height"}) && robot.has(item.key);
    if (is_wave || item.find("waveforms") != nullptr) return &item;
  }
  return nullptr;
}

/// A misspelt key `waveforms` of a section; nullptr if there is none.
[[nodiscard]] inline const ConfigNode* misspelt_waveforms(const ConfigNode& section) {
  if (section.find("waveforms") != nullptr) return nullptr;
  for (const ConfigNode& item : section.items) {
    if (is_near("waveforms", item.key)) return &item;
  }
  return nullptr;
}

/// Reads the waveforms of a robot's joints.
class SignalReader {
 public:
  /// @param efforts  limits of the drives, in the order of the joints [N m or N]
  SignalReader(const RobotJoints& robot, std::vector<double> efforts, const std::string& file)
      : robot_(robot), limits_(std::move(efforts)), drives_(limits_.size()), file_(file) {}

  [[nodiscard]] SignalConfig take() { return std::move(config_); }

  /// Reads all waveforms of a section: a map by joint, a list, or the section itself.
  void read(const ConfigSection& section) {
    config_.notes.insert(config_.notes.end(), section.notes.begin(), section.notes.end());
    ConfigMap map(ConfigValue(file_, section.parameters, section.path), config_.notes,
                  Inherited::may_be_unknown);
    const ConfigNode& node = map.value().node();
    if (const ConfigNode* joint = misplaced_waveforms(node, robot_)) {
      throw FileError(map.value().child(*joint).key_place(),
                      "waveforms below '" + shown(joint->key) + "'",
                      "'waveforms' in the section itself, and the joints below it: waveforms: {" +
                          shown(joint->key) + ": {amplitude: ..., frequency: ...}}");
    }
    if (const ConfigNode* misspelt = misspelt_waveforms(node)) {
      map.refuse_key(*misspelt, "'waveforms'");
    }
    const bool is_one =
        !section.name.empty() || node.has_any({"joint", "joint_name", "amplitude", "height"});
    if (is_one && node.find("waveforms") == nullptr) {
      read_section_signal(section.name, std::move(map));
    } else {
      read_section_signals(section.name, map);
    }
  }

  /// @throws FileError if there was no waveform, or the sum of a joint's waveforms exceeds the limit
  ///         of its drive
  void finish() {
    constexpr const char* wanted = "waveforms, such as <joint>: {amplitude: ..., frequency: ...}";
    for (const auto& [place, what] : empty_) {
      if (config_.signals.empty()) throw FileError(place, what, wanted);
      config_.notes.push_back(place.text() + "there is no waveform in it");
    }
    for (std::size_t j = 0; j < drives_.size(); ++j) {
      const SignalBounds bounds = bounds_of(drives_[j].signals);
      const double highest = std::max(bounds.high, -bounds.low);
      constexpr double rounding = 1e-12;  // of a sum, relative to it
      if (highest <= limits_[j] * (1 + rounding)) continue;
      throw FileError(drives_[j].last,
                      "the signals on joint '" + robot_.names[j] + "' add up to " +
                          rounded_text(highest) + " N m or N",
                      limit_text(limits_[j]));
    }
  }

 private:
  struct Joint {
    std::string name;
    FilePlace place;
  };
  /// The signals of a joint.
  struct Drive {
    std::vector<Signal> signals{};  ///< efforts
    FilePlace last{};               ///< of the last one of them
    SignalValue effort{};           ///< sum of the peaks of efforts
    SignalValue motion{};           ///< sum of the peaks of positions
  };

  /// Reads a section that is one waveform.
  void read_section_signal(const std::string& section, ConfigMap map) {
    const auto joint = named_joint(map);
    if (section.empty() && !joint) static_cast<void>(map.require("joint"));
    take_unused_controller_parameters(map);
    if (section.empty() && !joint) map.finish();
    const FilePlace place = map.value().place();
    read_signal(std::move(map), joint.value_or(Joint{section, place}), SignalTarget::effort);
  }

  /// Reads a section with `waveforms`.
  void read_section_signals(const std::string& section, ConfigMap& map) {
    if (const auto type = map.find("type")) {
      static_cast<void>(type->word());
      map.note(*type, "not used: the types in the program decide what is commanded");
    }
    const std::vector<Joint> joints = listed_joints(map);
    const auto waveforms = map.require("waveforms");
    const SignalTarget target = read_target(map, SignalTarget::effort);
    take_unused_controller_parameters(map);
    map.finish();
    const auto read_one = [&](ConfigMap one, const Joint& joint) {
      static_cast<void>(robot_.index(joint.name, joint.place));
      if (!joints.empty() && std::none_of(joints.begin(), joints.end(), [&](const Joint& each) {
            return each.name == joint.name;
          })) {
        throw FileError(joint.place,
                        "joint '" + shown(joint.name) + "' is not the section's, see line " +
                            std::to_string(joints.front().place.line),
                        "one of its joints");
      }
      read_signal(std::move(one), joint, target);
    };
    note_if_empty(*waveforms);
    if (waveforms->node().is_list()) {
      for (const ConfigValue& item : waveforms->list()) {
        ConfigMap one(item, config_.notes);
        auto joint = named_joint(one);
        if (!joint && joints.size() == 1) joint = joints.front();
        if (!joint && robot_.has(section)) joint = Joint{section, item.place()};
        if (!joint) {
          static_cast<void>(one.require("joint"));
          one.finish();
        }
        read_one(std::move(one), *joint);
      }
      return;
    }
    const ConfigMap by_joint(*waveforms, config_.notes);  // throws if it is no map
    for (const ConfigNode& item : by_joint.value().node().items) {
      const ConfigValue value = waveforms->child(item);
      const Joint joint{item.key, value.place()};
      static_cast<void>(robot_.index(joint.name, joint.place));  // before errors below the joint
      note_if_empty(value);
      const auto values = item.is_list() ? value.list() : std::vector{value};
      for (const ConfigValue& each : values) read_one(ConfigMap(each, config_.notes), joint);
    }
  }

  void note_if_empty(const ConfigValue& value) {
    const ConfigNode& node = value.node();
    const bool is_empty = node.items.empty() && (node.is_list() || node.is_map());
    if (is_empty)
      empty_.emplace_back(value.place(), node.is_list() ? "an empty list" : "an empty map");
  }

  /// The joint that a waveform or a section names.
  [[nodiscard]] static std::optional<Joint> named_joint(ConfigMap& map) {
    const auto value = map.find_one_of({"joint", "joint_name"});
    if (!value) return {};
    return Joint{value->name(), value->place()};
  }
  /// The joints beside `waveforms`; empty: any joint.
  [[nodiscard]] std::vector<Joint> listed_joints(ConfigMap& map) const {
    std::vector<Joint> joints;
    if (const auto value = map.find_one_of({"joint", "joint_name", "joints"})) {
      if (value->node().key == "joints") {
        for (const ConfigValue& item : value->list()) joints.push_back({item.name(), item.place()});
        if (joints.empty()) value->refuse("the names of joints");
      } else {
        joints.push_back({value->name(), value->place()});
      }
    }
    for (const Joint& joint : joints) static_cast<void>(robot_.index(joint.name, joint.place));
    return joints;
  }

  [[nodiscard]] static SignalTarget read_target(ConfigMap& map, SignalTarget otherwise) {
    const auto value = map.find("target");
    if (!value) return otherwise;
    const bool is_position = value->index_in({"effort", "torque", "position"}) == 2;
    return is_position ? SignalTarget::position : SignalTarget::effort;
  }

  void read_signal(ConfigMap map, const Joint& joint, SignalTarget target) {
    const std::size_t index = robot_.index(joint.name, joint.place);
    target = read_target(map, target);
    const bool effort = target == SignalTarget::effort;
    const double limit = effort ? limits_[index] : std::numeric_limits<double>::infinity();
    const Signal signal = SignalShapeReader(map, limit).read();
    map.finish();
    const auto fault = std::visit([](const auto& any) { return any.fault(); }, signal);
    if (!fault.empty()) map.value().refuse(std::string(fault), "a signal that can be evaluated");
    Drive& drive = drives_[index];
    SignalValue& sum = effort ? drive.effort : drive.motion;
    const SignalValue peak = std::visit([](const auto& any) { return any.peak(); }, signal);
    sum.value += peak.value;
    sum.rate += effort ? 0 : peak.rate;
    sum.acceleration += effort ? 0 : peak.acceleration;
    if (!is_finite(sum)) {
      map.value().refuse("the signals on joint '" + robot_.names[index] + "' add up to no number",
                         "signals whose sum is a number");
    }
    config_.signals.push_back({Name(joint.name), signal, target});
    if (!effort) return;
    drive.signals.push_back(signal);
    drive.last = map.value().place();
  }

  const RobotJoints& robot_;
  std::vector<double> limits_;
  std::vector<Drive> drives_;
  std::string file_;
  std::vector<std::pair<FilePlace, std::string>> empty_{};  ///< lists and maps without waveforms
  SignalConfig config_{};
};

}  // namespace articula::detail
