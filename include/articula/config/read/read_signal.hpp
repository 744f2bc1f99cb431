// SPDX-License-Identifier: Apache-2.0
/// @file The shape of one waveform in a configuration file.
#pragma once

#include "articula/config/read/robot_joints.hpp"
#include "articula/config/yaml/reader.hpp"
#include "articula/reference/signal.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

namespace articula::detail {

/// What stands below a joint of a section, where it should be the other way round: `waveforms` or
/// what only a waveform has. nullptr if there is none.
[[nodiscard]] inline const ConfigNode* misplaced_waveforms(const ConfigNode& section,
                                                           const RobotJoints& robot) {
  if (section.find("waveforms") != nullptr) return nullptr;
  for (const ConfigNode& item : section.items) {
    if (item.find("waveforms") != nullptr) return &item;
    const bool is_wave = item.find("amplitude") != nullptr || item.find("height") != nullptr;
    if (is_wave && robot.has(item.key)) return &item;
  }
  return nullptr;
}

/// A key of a section that was to be `waveforms`; nullptr if there is none.
[[nodiscard]] inline const ConfigNode* misspelt_waveforms(const ConfigNode& section) {
  if (section.find("waveforms") != nullptr) return nullptr;
  const auto found =
      std::find_if(section.items.begin(), section.items.end(),
                   [](const ConfigNode& item) { return is_near("waveforms", item.key); });
  return found == section.items.end() ? nullptr : &*found;
}

[[nodiscard]] inline std::string at_most(double limit) {
  std::ostringstream text;
  text << "at most the drive's limit, " << limit;
  return text.str();
}

/// Reads the shape of one waveform.
class SignalShapeReader {
 public:
  /// @param map    the waveform; what does not belong to its shape must have been asked for
  /// @param limit  of its values
  SignalShapeReader(ConfigMap& map, double limit) : map_(map), limit_(limit) {}

  /// @throws FileError if there is a key that the shape does not have, or a value out of range
  [[nodiscard]] Signal read() {
    std::size_t shape = 0;
    if (const auto type = map_.find("type")) {
      if (type->node().text.find('/') != std::string::npos) {
        static_cast<void>(type->word());
        map_.note(*type, "not used: a plugin's name, no waveform's; this one is a sine");
      } else {
        shape = type->one_of({"sine", "sin", "sinusoid", "step", "ramp", "chirp", "square"});
      }
    }
    switch (shape) {
      case 3:
        return step();
      case 4:
        return ramp();
      case 5:
        return chirp();
      case 6:
        return wave<SquareSignal>("a square");
      default:
        return wave<SineSignal>("a sine");
    }
  }

 private:
  [[nodiscard]] Signal step() {
    map_.allow_only({"height", "start"}, "the keys of a step: height, start [s]");
    return StepSignal{.height = height("height"), .start = number("start")};
  }
  [[nodiscard]] Signal ramp() {
    map_.allow_only({"height", "duration", "start"},
                    "the keys of a ramp: height, duration [s], start [s]; its rate is height / "
                    "duration");
    return RampSignal{
        .height = height("height"), .duration = positive("duration"), .start = number("start")};
  }
  [[nodiscard]] Signal chirp() {
    map_.allow_only({"amplitude", "first_frequency", "last_frequency", "duration", "start"},
                    "the keys of a chirp: amplitude, first_frequency and last_frequency [Hz], "
                    "duration [s], start [s]");
    return ChirpSignal{.amplitude = height("amplitude"),
                       .first_frequency = frequency(map_.expect("first_frequency")),
                       .last_frequency = frequency(map_.expect("last_frequency")),
                       .duration = positive("duration"),
                       .start = number("start")};
  }
  /// A sine or a square, which have the same keys.
  template <class Wave>
  [[nodiscard]] Signal wave(const std::string& name) {
    map_.allow_only({"amplitude", "frequency", "period", "angular_frequency", "phase", "offset"},
                    "the keys of " + name +
                        ": amplitude, frequency [Hz], period [s] or "
                        "angular_frequency [rad/s], phase [rad], offset");
    Wave wave{
        .amplitude = height("amplitude"), .frequency = any_frequency(), .phase = number("phase")};
    if (const auto offset = map_.find("offset")) {
      wave.offset = offset->number();
      static_cast<void>(limited(*offset, std::abs(wave.offset) + std::abs(wave.amplitude)));
    }
    return wave;
  }

  [[nodiscard]] double number(std::string_view key) {
    const auto value = map_.find(key);
    return value ? value->number() : 0;
  }
  [[nodiscard]] double positive(std::string_view key) {
    const auto value = map_.expect(key);
    return value ? value->positive() : 1;
  }
  [[nodiscard]] double height(std::string_view key) {
    const auto value = map_.expect(key);
    return value ? limited(*value, value->number()) : 0;
  }
  /// A number that must not be beyond what the drive can give: the loop would cut it off, and the
  /// signal would be another.
  [[nodiscard]] double limited(const ConfigValue& value, double number) const {
    if (std::abs(number) <= limit_) return number;
    std::ostringstream reason;
    reason << "an effort of " << std::abs(number) << " N m or N";
    value.refuse(reason.str(), at_most(limit_));
  }

  /// In hertz, as a period or as an angular frequency; one of them.
  [[nodiscard]] double any_frequency() {
    const auto period = map_.find("period"), angular = map_.find("angular_frequency");
    const auto hertz = period || angular ? map_.find("frequency") : map_.expect("frequency");
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

  ConfigMap& map_;
  double limit_;
};

}  // namespace articula::detail
