// SPDX-License-Identifier: Apache-2.0
/// @file Reads waveforms for joints from a file. Needs the CMake target articula::config (yaml-cpp).
#pragma once

#include "articula/config/arrange_joints.hpp"
#include "articula/config/reader.hpp"
#include "articula/config/section.hpp"
#include "articula/config/source.hpp"
#include "articula/reference/joint_signals.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <string_view>
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
template <Robot R>
class SignalReader {
 public:
  SignalReader(const R& robot, const ConfigSections& all) : robot_(robot), file_(all.file) {
    config_.notes = all.notes;
  }

  [[nodiscard]] SignalConfig take() { return std::move(config_); }

  /// All waveforms of a section: a map by joint, a list, or the section itself is one.
  void read(const ConfigSection& section) {
    ConfigMap map(ConfigValue(file_, section.parameters, section.path), config_.notes);
    const ConfigNode& node = map.value().node();
    const bool is_one = !section.name.empty() || node.find("joint") || node.find("joint_name");
    if (is_one && !node.find("waveforms")) {
      const Joint joint = named_joint(map, section.name);
      read_signal(std::move(map), joint, SignalTarget::effort);
      return;
    }
    if (const auto type = map.find("type")) {
      static_cast<void>(type->word());
      map.note(*type, "not used: the types in the program decide what is commanded");
    }
    const ConfigValue waveforms = map.need("waveforms");
    const SignalTarget target = read_target(map, SignalTarget::effort);
    map.finish();
    if (waveforms.node().is_list()) {
      for (const ConfigValue& item : waveforms.list()) {
        ConfigMap one(item, config_.notes);
        const Joint joint = named_joint(one, "");
        read_signal(std::move(one), joint, target);
      }
      return;
    }
    const ConfigMap by_joint(waveforms, config_.notes);  // a map, or this throws
    for (const ConfigNode& item : by_joint.value().node().items) {
      const ConfigValue value = waveforms.at(item);
      const Joint joint{item.key, value.place()};
      if (!item.is_list()) {
        read_signal(ConfigMap(value, config_.notes), joint, target);
        continue;
      }
      for (const ConfigValue& each : value.list()) {
        read_signal(ConfigMap(each, config_.notes), joint, target);
      }
    }
  }

 private:
  struct Joint {
    std::string name;
    ConfigPlace place;
  };

  /// The joint that a waveform names itself.
  [[nodiscard]] static Joint named_joint(ConfigMap& map, const std::string& otherwise) {
    auto given = map.find("joint");
    if (const auto other = map.find("joint_name")) {
      if (given) other->refuse("a joint a second time", "one joint");
      given = other;
    }
    if (given) return {given->word(), given->place()};
    if (otherwise.empty()) static_cast<void>(map.need("joint"));
    return {otherwise, map.value().place()};
  }

  [[nodiscard]] static SignalTarget read_target(ConfigMap& map, SignalTarget otherwise) {
    const auto value = map.find("target");
    if (!value) return otherwise;
    return value->one_of({"effort", "torque", "position"}) == 2 ? SignalTarget::position
                                                                : SignalTarget::effort;
  }

  void read_signal(ConfigMap map, const Joint& joint, SignalTarget target) {
    const auto names = joint_names(robot_);
    const auto found = std::find(names.begin(), names.end(), joint.name);
    if (found == names.end()) {
      throw ConfigError(joint.place,
                        robot_text(robot_) + " has no free joint '" + shown(joint.name) + "'",
                        choice_text({names.begin(), names.end()}, joint.name));
    }
    target = read_target(map, target);
    const auto index = static_cast<Eigen::Index>(found - names.begin());
    const double limit = target == SignalTarget::effort ? effort_limits(robot_)[index]
                                                        : std::numeric_limits<double>::infinity();
    const Signal signal = read_shape(map, limit);
    map.finish();
    const auto fault = std::visit([](const auto& any) { return any.fault(); }, signal);
    if (!fault.empty()) map.value().refuse(std::string(fault), "a signal that can be evaluated");
    config_.signals.push_back({Name(joint.name), signal, target});
  }

  /// A number that must not be beyond what the drive can give: the loop would cut it off, and the
  /// signal would be another.
  [[nodiscard]] static double limited(const ConfigValue& value, double number, double limit) {
    if (std::abs(number) <= limit) return number;
    std::ostringstream reason, expected;
    reason << "an effort of " << std::abs(number) << " N m or N";
    expected << "at most the drive's limit, " << limit;
    value.refuse(reason.str(), expected.str());
  }

  [[nodiscard]] static Signal read_shape(ConfigMap& map, double limit) {
    const auto number = [&](std::string_view key) {
      const auto value = map.find(key);
      return value ? value->number() : 0;
    };
    const auto height = [&](std::string_view key) {
      const ConfigValue value = map.need(key);
      return limited(value, value.number(), limit);
    };
    std::size_t shape = 0;
    if (const auto type = map.find("type")) {
      shape = type->one_of({"sine", "sin", "sinusoid", "step", "ramp", "chirp"});
    }
    if (shape == 3) return StepSignal{.height = height("height"), .start = number("start")};
    if (shape == 4) {
      return RampSignal{.height = height("height"),
                        .duration = map.need("duration").positive(),
                        .start = number("start")};
    }
    if (shape == 5) {
      return ChirpSignal{.amplitude = height("amplitude"),
                         .first_frequency = frequency(map.need("first_frequency")),
                         .last_frequency = frequency(map.need("last_frequency")),
                         .duration = map.need("duration").positive(),
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
    const auto hertz = period || angular ? map.find("frequency") : map.need("frequency");
    if (period && angular) angular->refuse("a period is given, too", "one of them");
    if (hertz && (period || angular)) {
      hertz->refuse("a period or an angular frequency is given, too", "one of them");
    }
    if (period) return frequency(*period, 1 / period->positive());
    if (angular) return frequency(*angular, angular->positive() / (2 * std::numbers::pi));
    return frequency(*hertz);
  }
  [[nodiscard]] static double frequency(const ConfigValue& value) {
    return frequency(value, value.positive());
  }
  /// No joint follows a megahertz: a slip of the unit.
  [[nodiscard]] static double frequency(const ConfigValue& value, double hertz) {
    if (hertz > 1e6) value.refuse("at most 1e6 Hz");
    return hertz;
  }

  const R& robot_;
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
///         signal that cannot be evaluated, an effort beyond the drive's limit
/// Real-time: no (reads a file, allocates, throws).
template <Robot R>
[[nodiscard]] SignalConfig load_signals(const R& robot, const ConfigSource& source,
                                        std::string_view name = {}) {
  const detail::ConfigSections all = detail::find_sections(source);
  const auto relevant = [](const detail::ConfigSection& section) {
    return section.parameters.find("waveforms") != nullptr ||
           section.parameters.find("amplitude") != nullptr ||
           section.parameters.find("height") != nullptr;
  };
  detail::SignalReader<R> reader(robot, all);
  for (const auto& section : detail::chosen_sections(all, name, relevant, "section of waveforms")) {
    reader.read(section);
  }
  return reader.take();
}

}  // namespace articula
