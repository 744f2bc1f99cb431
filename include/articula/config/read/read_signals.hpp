// SPDX-License-Identifier: Apache-2.0
/// @file The waveforms of a section of a configuration file.
#pragma once

#include "articula/config/read/read_mechanics.hpp"
#include "articula/config/read/read_signal.hpp"
#include "articula/config/read/robot_joints.hpp"
#include "articula/config/read/section.hpp"
#include "articula/config/read/unused_parameters.hpp"
#include "articula/config/yaml/config_map.hpp"
#include "articula/reference/joint_signals.hpp"
#include "articula/reference/signal_bounds.hpp"
#include "articula/text/characters.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/similar_word.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace articula {

/// Waveforms from a file.
struct SignalConfig {
  std::vector<JointSignal> signals{};  ///< for JointSignals
  /// Parameters without effect in this library, one line each with file, line and key.
  std::vector<std::string> notes{};
};

namespace detail {

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

class SignalReader {
 public:
  /// @param efforts  limits of the drives, in the order of the joints [N m or N]
  SignalReader(const RobotJoints& robot, std::vector<double> efforts)
      : robot_(robot), limits_(std::move(efforts)), drives_(limits_.size()) {}

  [[nodiscard]] SignalConfig take() { return std::move(config_); }

  /// Reads all waveforms of a section: a map by joint, a list, or the section itself.
  void read(const ConfigSection& section) {
    config_.notes.insert(config_.notes.end(), section.notes.begin(), section.notes.end());
    ConfigMap map(section.parameters, config_.notes, Inherited::may_be_unknown);
    const ConfigNode& node = map.node();
    if (const ConfigNode* joint = misplaced_waveforms(node, robot_)) {
      throw FileError(joint->key_place, "waveforms below '" + shown(joint->key) + "'",
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

  /// @throws FileError if there was no waveform, or the sum of a joint's waveforms exceeds the
  ///         limit of its drive
  void finish() {
    constexpr const char* wanted = "waveforms, such as <joint>: {amplitude: ..., frequency: ...}";
    for (const auto& [place, what] : empty_) {
      if (config_.signals.empty()) throw FileError(place, what, wanted);
      config_.notes.push_back(place.text() + "there is no waveform in it");
    }
    for (std::size_t j = 0; j < drives_.size(); ++j) {
      const ValueRange bounds = signal_bounds(drives_[j].signals);
      const double highest = std::max(bounds.highest, -bounds.lowest);
      constexpr double rounding = 1e-12;  // of a sum, relative to it
      if (highest <= limits_[j] * (1 + rounding)) continue;
      throw FileError(drives_[j].last,
                      "the signals on joint '" + robot_.names[j] + "' add up to " +
                          rounded_text(highest) + " N m or N",
                      limit_text(limits_[j]));
    }
  }

 private:
  struct Drive {
    std::vector<Signal> signals{};  ///< efforts
    FilePlace last{};               ///< of the last one of them
    SignalValue effort{};           ///< sum of the peaks of efforts
    SignalValue motion{};           ///< sum of the peaks of positions
  };

  /// Reads a section that is one waveform.
  void read_section_signal(const std::string& section, ConfigMap map) {
    const auto joint = named_joint(map);
    if (section.empty() && !joint) map.require("joint");
    take_unused_controller_parameters(map);
    if (section.empty() && !joint) map.finish();
    const FilePlace place = map.node().place;
    read_signal(std::move(map), joint.value_or(ConfiguredJoint{.name = section, .place = place}),
                SignalTarget::effort);
  }

  /// Reads a section with `waveforms`.
  void read_section_signals(const std::string& section, ConfigMap& map) {
    if (const auto type = map.find("type")) {
      static_cast<void>(type->word());
      map.note(*type, "not used: the types in the program decide what is commanded");
    }
    const std::vector<ConfiguredJoint> joints = listed_joints(map);
    const auto waveforms = map.require("waveforms");
    const SignalTarget target = read_target(map, SignalTarget::effort);
    take_unused_controller_parameters(map);
    map.finish();
    const auto read_one = [&](ConfigMap one, const ConfiguredJoint& joint) {
      static_cast<void>(robot_.index(joint.name, joint.place));
      if (!joints.empty() && std::none_of(joints.begin(), joints.end(), [&](const auto& each) {
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
    if (waveforms->is_list()) {
      for (const ConfigNode& item : waveforms->list()) {
        ConfigMap one(item, config_.notes);
        auto joint = named_joint(one);
        if (!joint && joints.size() == 1) joint = joints.front();
        if (!joint && robot_.has(section)) joint = {.name = section, .place = item.place};
        if (!joint) {
          one.require("joint");
          one.finish();
        }
        read_one(std::move(one), *joint);
      }
      return;
    }
    const ConfigMap by_joint(*waveforms, config_.notes);  // throws if it is no map
    for (const ConfigNode& item : waveforms->items) {
      const ConfiguredJoint joint{.name = item.key, .place = item.place};
      static_cast<void>(robot_.index(joint.name, joint.place));  // before errors below the joint
      note_if_empty(item);
      const std::span values = item.is_list() ? std::span(item.items) : std::span(&item, 1);
      for (const ConfigNode& each : values) read_one(ConfigMap(each, config_.notes), joint);
    }
  }

  void note_if_empty(const ConfigNode& node) {
    if (!node.items.empty() || !(node.is_list() || node.is_map())) return;
    empty_.emplace_back(node.place, node.is_list() ? "an empty list" : "an empty map");
  }

  /// The joint that a waveform or a section names.
  [[nodiscard]] static std::optional<ConfiguredJoint> named_joint(ConfigMap& map) {
    const auto value = map.find_one_of({"joint", "joint_name"});
    if (!value) return {};
    return read_joint_names(*value).front();
  }
  /// The joints beside `waveforms`; empty: any joint.
  [[nodiscard]] std::vector<ConfiguredJoint> listed_joints(ConfigMap& map) const {
    std::vector<ConfiguredJoint> joints;
    if (const auto value = map.find_one_of({"joint", "joint_name", "joints"})) {
      joints = read_joint_names(*value);
    }
    for (const auto& joint : joints) static_cast<void>(robot_.index(joint.name, joint.place));
    return joints;
  }

  [[nodiscard]] static SignalTarget read_target(ConfigMap& map, SignalTarget otherwise) {
    const auto value = map.find("target");
    if (!value) return otherwise;
    const bool is_position = value->index_in({"effort", "torque", "position"}) == 2;
    return is_position ? SignalTarget::position : SignalTarget::effort;
  }

  void read_signal(ConfigMap map, const ConfiguredJoint& joint, SignalTarget target) {
    const std::size_t index = robot_.index(joint.name, joint.place);
    target = read_target(map, target);
    const bool effort = target == SignalTarget::effort;
    const double limit = effort ? limits_[index] : std::numeric_limits<double>::infinity();
    const Signal signal = SignalShapeReader(map, limit).read();
    map.finish();
    const auto fault = std::visit([](const auto& any) { return any.fault(); }, signal);
    if (!fault.empty()) map.node().refuse(std::string(fault), "a signal that can be evaluated");
    Drive& drive = drives_[index];
    SignalValue& sum = effort ? drive.effort : drive.motion;
    const SignalValue peak = std::visit([](const auto& any) { return any.peak(); }, signal);
    sum.value += peak.value;
    sum.rate += effort ? 0 : peak.rate;
    sum.acceleration += effort ? 0 : peak.acceleration;
    if (!is_finite(sum)) {
      map.node().refuse("the signals on joint '" + robot_.names[index] + "' add up to no number",
                        "signals whose sum is a number");
    }
    config_.signals.push_back({Name(joint.name), signal, target});
    if (!effort) return;
    drive.signals.push_back(signal);
    drive.last = map.node().place;
  }

  const RobotJoints& robot_;
  std::vector<double> limits_;
  std::vector<Drive> drives_;
  std::vector<std::pair<FilePlace, std::string>> empty_{};  ///< lists and maps without waveforms
  SignalConfig config_{};
};

}  // namespace detail
}  // namespace articula
