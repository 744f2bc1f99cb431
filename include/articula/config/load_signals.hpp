// SPDX-License-Identifier: Apache-2.0
/// @file Reads waveforms for joints from a file. Needs the CMake target articula::config (yaml-cpp).
#pragma once

#include "articula/config/reader.hpp"
#include "articula/config/robot_joints.hpp"
#include "articula/config/section.hpp"
#include "articula/config/signal_bounds.hpp"
#include "articula/config/source.hpp"
#include "articula/config/unused_parameters.hpp"
#include "articula/reference/joint_signals.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
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
    const Signal signal = read_shape(map, limit);
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

  [[nodiscard]] static std::string at_most(double limit) {
    std::ostringstream text;
    text << "at most the drive's limit, " << limit;
    return text.str();
  }

  /// A number that must not be beyond what the drive can give: the loop would cut it off, and the
  /// signal would be another.
  [[nodiscard]] static double limited(const ConfigValue& value, double number, double limit) {
    if (std::abs(number) <= limit) return number;
    std::ostringstream reason;
    reason << "an effort of " << std::abs(number) << " N m or N";
    value.refuse(reason.str(), at_most(limit));
  }

  [[nodiscard]] static Signal read_shape(ConfigMap& map, double limit) {
    const auto number = [&](std::string_view key) {
      const auto value = map.find(key);
      return value ? value->number() : 0;
    };
    const auto height = [&](std::string_view key) {
      const auto value = map.expect(key);
      return value ? limited(*value, value->number(), limit) : 0;
    };
    const auto positive = [&](std::string_view key) {
      const auto value = map.expect(key);
      return value ? value->positive() : 1;
    };
    std::size_t shape = 0;
    if (const auto type = map.find("type")) {
      if (type->node().text.find('/') != std::string::npos) {
        static_cast<void>(type->word());
        map.note(*type, "not used: a plugin's name, no waveform's; this one is a sine");
      } else {
        shape = type->one_of({"sine", "sin", "sinusoid", "step", "ramp", "chirp"});
      }
    }
    if (shape == 3) return StepSignal{.height = height("height"), .start = number("start")};
    if (shape == 4) {
      return RampSignal{
          .height = height("height"), .duration = positive("duration"), .start = number("start")};
    }
    if (shape == 5) {
      return ChirpSignal{.amplitude = height("amplitude"),
                         .first_frequency = frequency(map.expect("first_frequency")),
                         .last_frequency = frequency(map.expect("last_frequency")),
                         .duration = positive("duration"),
                         .start = number("start")};
    }
    SineSignal sine{.amplitude = height("amplitude"),
                    .frequency = read_frequency(map),
                    .phase = number("phase")};
    if (const auto offset = map.find("offset")) {
      sine.offset = offset->number();
      static_cast<void>(limited(*offset, std::abs(sine.offset) + std::abs(sine.amplitude), limit));
    }
    return sine;
  }

  /// In hertz, as a period or as an angular frequency; one of them.
  [[nodiscard]] static double read_frequency(ConfigMap& map) {
    const auto period = map.find("period"), angular = map.find("angular_frequency");
    const auto hertz = period || angular ? map.find("frequency") : map.expect("frequency");
    if (period && angular) angular->refuse("a period is given, too", "one of them");
    if (hertz && (period || angular)) {
      hertz->refuse("a period or an angular frequency is given, too", "one of them");
    }
    if (period) return frequency(*period, 1 / period->positive());
    if (angular) return frequency(*angular, angular->positive() / (2 * std::numbers::pi));
    return frequency(hertz);
  }
  [[nodiscard]] static double frequency(const std::optional<ConfigValue>& value) {
    return value ? frequency(*value, value->positive()) : 1;
  }
  /// No joint follows a megahertz: a slip of the unit.
  [[nodiscard]] static double frequency(const ConfigValue& value, double hertz) {
    if (hertz > 1e6) value.refuse("at most 1e6 Hz");
    return hertz;
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
///         signal that cannot be evaluated, an effort beyond the drive's limit,
///         alone or with the joint's others
/// Real-time: no (reads a file, allocates, throws).
template <Robot R>
[[nodiscard]] SignalConfig load_signals(const R& robot, const ConfigSource& source,
                                        std::string_view name = {}) {
  detail::ConfigSections all = detail::find_sections(source);
  const detail::RobotJoints joints = detail::joints_of(robot);
  const auto relevant = [&](const detail::ConfigSection& section) {
    const auto has = [&](const char* key) { return section.parameters.find(key) != nullptr; };
    return has("waveforms") || has("amplitude") || has("height") ||
           detail::is_joint(section, joints);
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
