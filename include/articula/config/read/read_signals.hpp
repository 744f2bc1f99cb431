// SPDX-License-Identifier: Apache-2.0
/// @file The waveforms of a section of a configuration file.
#pragma once

#include "articula/config/read/read_signal.hpp"
#include "articula/config/read/robot_joints.hpp"
#include "articula/config/read/section.hpp"
#include "articula/config/read/signal_bounds.hpp"
#include "articula/config/read/signal_config.hpp"
#include "articula/config/read/unused_parameters.hpp"
#include "articula/config/yaml/reader.hpp"
#include "articula/core/finite.hpp"
#include "articula/reference/joint_signals.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace articula::detail {

/// Reads the waveforms of a robot's joints.
class SignalReader {
 public:
  /// @param efforts  highest ones of the drives, in the order of the joints
  SignalReader(const RobotJoints& robot, std::vector<double> efforts, const std::string& file)
      : robot_(robot), limits_(std::move(efforts)), drives_(limits_.size()), file_(file) {}

  [[nodiscard]] SignalConfig take() { return std::move(config_); }

  /// All waveforms of a section: a map by joint, a list, or the section itself is one.
  void read(const ConfigSection& section) {
    config_.notes.insert(config_.notes.end(), section.notes.begin(), section.notes.end());
    ConfigMap map(ConfigValue(file_, section.parameters, section.path), config_.notes,
                  Inherited::may_be_unknown);
    const ConfigNode& node = map.value().node();
    if (const ConfigNode* joint = misplaced_waveforms(node, robot_)) {
      throw ConfigError(
          {file_, joint->key_mark.line, joint->key_mark.column, map.value().at(*joint).place().key},
          "waveforms below '" + shown(joint->key) + "'",
          "'waveforms' in the section itself, and the joints below it: waveforms: {" +
              shown(joint->key) + ": {amplitude: ..., frequency: ...}}");
    }
    if (const ConfigNode* slip = misspelt_waveforms(node)) {
      throw ConfigError(
          {file_, slip->key_mark.line, slip->key_mark.column, map.value().at(*slip).place().key},
          "unknown key '" + shown(slip->key) + "'", "'waveforms'");
    }
    const bool has_joint = node.find("joint") || node.find("joint_name");
    const bool is_shape = node.find("amplitude") || node.find("height");
    const bool is_one = !section.name.empty() || has_joint || is_shape;
    if (is_one && !node.find("waveforms")) {
      if (section.name.empty() && !has_joint) static_cast<void>(map.expect("joint"));
      take_unused_controller_parameters(map);
      const auto named = named_joint(map);
      if (section.name.empty() && !named) map.finish();
      const Joint joint = named.value_or(Joint{section.name, map.value().place()});
      read_signal(std::move(map), joint, SignalTarget::effort);
      return;
    }
    if (const auto type = map.find("type")) {
      static_cast<void>(type->word());
      map.note(*type, "not used: the types in the program decide what is commanded");
    }
    const std::vector<Joint> joints = listed_joints(map);
    const auto waveforms = map.expect("waveforms");
    const SignalTarget target = read_target(map, SignalTarget::effort);
    take_unused_controller_parameters(map);
    map.finish();
    const auto read_one = [&](ConfigMap one, const Joint& joint) {
      const bool listed = std::any_of(joints.begin(), joints.end(),
                                      [&](const Joint& each) { return each.name == joint.name; });
      static_cast<void>(robot_.index(joint.name, joint.place));
      if (!joints.empty() && !listed) {
        throw ConfigError(joint.place,
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
        if (!joint && robot_.has(section.name)) joint = Joint{section.name, item.place()};
        if (!joint) {
          static_cast<void>(one.expect("joint"));
          one.finish();
        }
        read_one(std::move(one), *joint);
      }
      return;
    }
    const ConfigMap by_joint(*waveforms, config_.notes);  // a map, or this throws
    for (const ConfigNode& item : by_joint.value().node().items) {
      const ConfigValue value = waveforms->at(item);
      const Joint joint{item.key, value.place()};
      static_cast<void>(robot_.index(joint.name, joint.place));  // before what is below it
      if (!item.is_list()) {
        read_one(ConfigMap(value, config_.notes), joint);
        continue;
      }
      note_if_empty(value);
      for (const ConfigValue& each : value.list()) {
        read_one(ConfigMap(each, config_.notes), joint);
      }
    }
  }

  /// @throws ConfigError if there was no waveform at all, or those of a joint are beyond its drive
  void finish() {
    constexpr const char* wanted = "waveforms, such as <joint>: {amplitude: ..., frequency: ...}";
    for (const auto& [place, what] : empty_) {
      if (config_.signals.empty()) throw ConfigError(place, what, wanted);
      config_.notes.push_back(file_ + ":" + std::to_string(place.line) + ": " + place.key +
                              ": there is no waveform in it");
    }
    check_sums();
  }

 private:
  /// What was read on one joint adds up, and the loop would cut off what the drive cannot give.
  void check_sums() const {
    for (std::size_t j = 0; j < drives_.size(); ++j) {
      const SignalBounds bounds = bounds_of(drives_[j].signals);
      const double highest = std::max(bounds.high, -bounds.low);
      constexpr double rounding = 1e-12;  // of a sum, against its size
      if (highest <= limits_[j] * (1 + rounding)) continue;
      std::ostringstream reason;
      reason << "the signals on joint '" << robot_.names[j] << "' add up to " << highest
             << " N m or N";
      throw ConfigError(drives_[j].last, reason.str(), at_most(limits_[j]));
    }
  }

  struct Joint {
    std::string name;
    ConfigPlace place;
  };
  /// What a joint's drive has to do.
  struct Drive {
    std::vector<Signal> signals{};
    ConfigPlace last{};
    SignalValue effort{};  ///< sum of the peaks
    SignalValue motion{};  ///< likewise
  };

  /// @return false if the sum overflows
  [[nodiscard]] static bool add_peak(SignalValue& sum, const Signal& signal, bool value_only) {
    const SignalValue peak = std::visit([](const auto& any) { return any.peak(); }, signal);
    sum.value += peak.value;
    if (!value_only) {
      sum.rate += peak.rate;
      sum.acceleration += peak.acceleration;
    }
    return is_finite(sum);
  }

  void note_if_empty(const ConfigValue& value) {
    const ConfigNode& node = value.node();
    if ((node.is_list() || node.is_map()) && node.items.empty()) {
      empty_.emplace_back(value.place(), node.is_list() ? "an empty list" : "an empty map");
    }
  }

  /// The joint that a waveform or a section names itself.
  [[nodiscard]] static std::optional<Joint> named_joint(ConfigMap& map) {
    auto given = map.find("joint");
    if (const auto other = map.find("joint_name")) {
      if (given) other->refuse("a joint a second time", "one joint");
      given = other;
    }
    if (!given) return {};
    return Joint{given->name(), given->place()};
  }
  /// The joints that stand beside waveforms; none: any.
  [[nodiscard]] std::vector<Joint> listed_joints(ConfigMap& map) const {
    std::vector<Joint> joints;
    if (const auto one = named_joint(map)) joints.push_back(*one);
    if (const auto list = map.find("joints")) {
      if (!joints.empty()) list->refuse("joints a second time", "'joints' or 'joint'");
      for (const ConfigValue& item : list->list()) joints.push_back({item.name(), item.place()});
      if (joints.empty()) list->refuse("the names of joints");
    }
    for (const Joint& joint : joints) static_cast<void>(robot_.index(joint.name, joint.place));
    return joints;
  }

  [[nodiscard]] static SignalTarget read_target(ConfigMap& map, SignalTarget otherwise) {
    const auto value = map.find("target");
    if (!value) return otherwise;
    return value->one_of({"effort", "torque", "position"}) == 2 ? SignalTarget::position
                                                                : SignalTarget::effort;
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
    if (!add_peak(effort ? drives_[index].effort : drives_[index].motion, signal, effort)) {
      map.value().refuse("the signals on joint '" + robot_.names[index] + "' add up to no number",
                         "signals whose sum is a number");
    }
    config_.signals.push_back({Name(joint.name), signal, target});
    if (effort) {
      drives_[index].signals.push_back(signal);
      drives_[index].last = map.value().place();
    }
  }

  const RobotJoints& robot_;
  std::vector<double> limits_;
  std::vector<Drive> drives_;
  std::string file_;
  std::vector<std::pair<ConfigPlace, std::string>> empty_{};  ///< lists and maps of no waveforms
  SignalConfig config_{};
};

}  // namespace articula::detail
