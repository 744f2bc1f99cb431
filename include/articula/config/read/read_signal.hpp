// SPDX-License-Identifier: Apache-2.0
/// @file One waveform in a configuration file.
#pragma once

#include "articula/config/read/section.hpp"
#include "articula/config/yaml/config_map.hpp"
#include "articula/reference/signal.hpp"
#include "articula/text/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace articula::detail {

/// "at most the drive's limit, 13.62", for messages.
[[nodiscard]] inline std::string limit_text(double limit) {
  return "at most the drive's limit, " + rounded_text(limit);
}

class SignalShapeReader {
 public:
  /// @param map    the waveform; its keys that do not belong to the shape are known already
  /// @param limit  of its values [N m or N]
  SignalShapeReader(ConfigMap& map, double limit) : map_(map), limit_(limit) {}

  /// @throws FileError if a value has the wrong type or is out of range
  [[nodiscard]] Signal read() {
    std::string shape = "sine";
    if (const auto type = map_.find("type")) {
      const std::vector<std::string> shapes = {"sine", "sin",   "sinusoid", "step",
                                               "ramp", "chirp", "square"};
      if (has_plugin_type(map_.node())) {
        static_cast<void>(type->word());
        map_.note(*type, "not used: a plugin's name; the waveform is a sine");
      } else {
        shape = shapes[type->index_in(shapes)];
      }
    }
    if (shape == "step") return step();
    if (shape == "ramp") return ramp();
    if (shape == "chirp") return chirp();
    if (shape == "square") return wave<SquareSignal>();
    return wave<SineSignal>();
  }

 private:
  [[nodiscard]] Signal step() {
    StepSignal step{.height = height("height")};
    map_.read_number("start", step.start);
    return step;
  }
  [[nodiscard]] Signal ramp() {
    RampSignal ramp{.height = height("height"), .duration = positive("duration")};
    map_.read_number("start", ramp.start);
    return ramp;
  }
  [[nodiscard]] Signal chirp() {
    ChirpSignal chirp{.amplitude = height("amplitude"),
                      .first_frequency = frequency(map_.require("first_frequency")),
                      .last_frequency = frequency(map_.require("last_frequency")),
                      .duration = positive("duration")};
    map_.read_number("start", chirp.start);
    return chirp;
  }
  /// A sine or a square, which have the same keys.
  template <class Wave>
  [[nodiscard]] Signal wave() {
    Wave wave{.amplitude = height("amplitude"), .frequency = any_frequency()};
    map_.read_number("phase", wave.phase);
    if (const auto offset = map_.find("offset")) {
      wave.offset = offset->number();
      static_cast<void>(limited(*offset, std::abs(wave.offset) + std::abs(wave.amplitude)));
    }
    return wave;
  }

  [[nodiscard]] double positive(std::string_view key) {
    const auto value = map_.require(key);
    return value ? value->positive() : 1;
  }
  [[nodiscard]] double height(std::string_view key) {
    const auto value = map_.require(key);
    return value ? limited(*value, value->number()) : 0;
  }
  /// Refuses a number beyond the drive's limit, since the loop would saturate the signal.
  [[nodiscard]] double limited(const ConfigNode& value, double number) const {
    if (std::abs(number) <= limit_) return number;
    value.refuse("an effort of " + rounded_text(std::abs(number)) + " N m or N",
                 limit_text(limit_));
  }

  /// The frequency [Hz], given as such, as a period or as an angular frequency.
  [[nodiscard]] double any_frequency() {
    const auto value = map_.find_one_of({"frequency", "period", "angular_frequency"});
    if (!value) map_.require("frequency");
    const std::string key = value ? value->key : "";
    if (key == "period") return frequency(*value, 1 / value->positive());
    if (key != "angular_frequency") return frequency(value);
    return frequency(*value, value->positive() / (2 * std::numbers::pi));
  }
  [[nodiscard]] static double frequency(const ConfigNode* value) {
    return value ? frequency(*value, value->positive()) : 1;
  }
  /// Refuses frequencies that no joint can follow: the unit is probably wrong.
  [[nodiscard]] static double frequency(const ConfigNode& value, double hertz) {
    if (hertz > 1e6) value.refuse("at most 1e6 Hz");
    return hertz;
  }

  ConfigMap& map_;
  double limit_;
};

}  // namespace articula::detail
