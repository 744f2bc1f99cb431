// SPDX-License-Identifier: Apache-2.0
/// @file The gains of a controller by their names, as recordings keep them.
#pragma once

#include "articula/model/robot.hpp"
#include "articula/recording/loop_change.hpp"
#include "articula/remote/gains/gain_parameters.hpp"

#include <vector>

namespace articula {

/// All gains that a controller has now. As the change of the first cycle they make a recording
/// complete: `recording.changes = {{.gains = gain_settings(robot, loop.controller())}}`.
/// @param robot  whose joints these are
/// Real-time: no (allocates).
template <Robot R, class C>
[[nodiscard]] std::vector<GainSetting> gain_settings(const R& robot, C& controller) {
  std::vector<GainSetting> settings;
  for (const remote::Parameter& gain : remote::GainParameters<R>(robot, controller).list()) {
    settings.push_back({gain.name, gain.value});
  }
  return settings;
}

/// Sets gains by their names, all or none.
/// @throws std::invalid_argument naming the gain and what is accepted
/// Real-time: no (allocates, throws).
template <Robot R, class C>
void set_gains(const R& robot, C& controller, const std::vector<GainSetting>& settings) {
  if (settings.empty()) return;
  std::vector<remote::ParameterValue> values;
  for (const GainSetting& gain : settings) values.push_back({gain.parameter, gain.value});
  const remote::GainParameters<R> gains(robot, controller);
  typename remote::GainParameters<R>::Changes holders;
  for (const auto& change : gains.change(values, holders)) change->apply();
}

}  // namespace articula
