// SPDX-License-Identifier: Apache-2.0
/// @file Reads waveforms for joints from a file. Needs the CMake target articula::config (yaml-cpp).
#pragma once

#include "articula/config/chosen_sections.hpp"
#include "articula/config/read_signal.hpp"
#include "articula/config/reader.hpp"
#include "articula/config/robot_joints.hpp"
#include "articula/config/signal_bounds.hpp"
#include "articula/config/source.hpp"
#include "articula/config/unused_parameters.hpp"
#include "articula/reference/joint_signals.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace articula {

/// Waveforms from a file.
struct SignalConfig {
  std::vector<JointSignal> signals{};  ///< for JointSignals
  /// What the file says and nothing here does, one line each with file, line and key.
  std::vector<std::string> notes{};
};

namespace detail {

/// Reads the waveforms of a robot's joints.
class SignalReader {
 public:
  /// @param efforts  highest ones of the drives, in the order of the joints
  SignalReader(const RobotJoints& robot, std::vector<double> efforts, const std::string& file)
      : robot_(robot), limits_(std::move(efforts)), drives_(limits_.size()), file_(file) {}

  [[nodiscard]] SignalConfig take() { return std::move(config_); }

  /// All waveforms of a section: a map by joint, a list, or the section itself is one.
  void read(const ConfigSection& section) {
    ConfigMap map(ConfigValue(file_, section.parameters, section.path), config_.notes);
    const ConfigNode& node = map.value().node();
    if (const ConfigNode* joint = misplaced_waveforms(node, robot_)) {
      throw ConfigError(
          {file_, joint->key_mark.line, joint->key_mark.column, map.value().at(*joint).place().key},
          "waveforms below '" + shown(joint->key) + "'",
          "'waveforms' in the section itself, and the joints below it: waveforms: {" +
              shown(joint->key) + ": {amplitude: ..., frequency: ...}}");
    }
    const bool is_one = !section.name.empty() || node.find("joint") || node.find("joint_name");
    if (is_one && !node.find("waveforms")) {
      take_unused_controller_parameters(map);
      const auto joint = named_joint(map);
      read_signal(std::move(map), joint.value_or(Joint{section.name, map.value().place()}),
                  SignalTarget::effort);
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
      for (const ConfigValue& each : value.list()) {
        read_one(ConfigMap(each, config_.notes), joint);
      }
    }
  }

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

 private:
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

  /// The joint that a waveform or a section names itself.
  [[nodiscard]] static std::optional<Joint> named_joint(ConfigMap& map) {
    auto given = map.find("joint");
    if (const auto other = map.find("joint_name")) {
      if (given) other->refuse("a joint a second time", "one joint");
      given = other;
    }
    if (!given) return {};
    return Joint{given->word(), given->place()};
  }
  /// The joints that stand beside waveforms; none: any.
  [[nodiscard]] std::vector<Joint> listed_joints(ConfigMap& map) const {
    std::vector<Joint> joints;
    if (const auto one = named_joint(map)) joints.push_back(*one);
    if (const auto list = map.find("joints")) {
      if (!joints.empty()) list->refuse("joints a second time", "'joints' or 'joint'");
      for (const ConfigValue& item : list->list()) joints.push_back({item.word(), item.place()});
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
  SignalConfig config_{};
};

}  // namespace detail

/// Reads waveforms for a robot's joints, as the PR2's controller tutorial has them:
///
///     waveforms:
///       r_shoulder_pan_joint: {type: sine, amplitude: 2.0, frequency: 0.5}   # N m, Hz
///
///     const SignalConfig config = load_signals(Pr2(), "pr2_waveforms.yaml");
///     const JointSignals<Pr2> waves(config.signals);
///
/// Waveforms are efforts unless `target: position` says otherwise. Layouts and keys:
/// docs/configuration.md.
/// @param robot   whose joints they are for
/// @param source  a file, or a ConfigSource::text
/// @param name    of the section; need not be given where all waveforms of the file are meant
/// @throws ConfigError with file, line, key and what was expected: an unknown joint or key, a
///         signal that cannot be evaluated, an effort beyond the drive's limit, alone or summed up
/// Real-time: no (reads a file, allocates, throws).
template <Robot R>
[[nodiscard]] SignalConfig load_signals(const R& robot, const ConfigSource& source,
                                        std::string_view name = {}) {
  detail::ConfigSections all = detail::find_sections(source);
  const detail::RobotJoints joints = detail::joints_of(robot);
  const auto relevant = [&](const detail::ConfigSection& section) {
    const auto has = [&](const char* key) { return section.parameters.find(key) != nullptr; };
    return has("waveforms") || has("amplitude") || has("height") ||
           detail::is_joint(section, joints) ||
           detail::misplaced_waveforms(section.parameters, joints) != nullptr;
  };
  const auto limits = effort_limits(robot);
  detail::SignalReader reader(joints, {limits.data(), limits.data() + limits.size()}, all.file);
  for (const auto& section :
       detail::chosen_sections(all, name, relevant, "section of waveforms", all.notes)) {
    reader.read(section);
  }
  reader.check_sums();
  SignalConfig config = reader.take();
  config.notes.insert(config.notes.begin(), all.notes.begin(), all.notes.end());
  return config;
}

}  // namespace articula
