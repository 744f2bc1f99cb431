// SPDX-License-Identifier: Apache-2.0
/// @file The step response of a joint under a PID, sampled as in the loop.
#pragma once

#include "articula/control/laws/joint_pid.hpp"
#include "articula/control/laws/pid_gains.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/tuning/joint_plant.hpp"
#include "articula/tuning/step_metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

namespace articula {

/// The step, the sampling and the drive of a step response.
struct StepOptions {
  double height = 1;     ///< of the step, from rest at 0 [rad or m]
  double duration = 1;   ///< [s], > 0
  double period = 1e-3;  ///< from one command to the next [s], > 0, at most 10^8 in `duration`
  double band = 0.02;    ///< of the settling time, a share of the step [1]
  double effort_limit = std::numeric_limits<double>::infinity();  ///< of the drive [N m or N], > 0
};

/// The metrics of a step of the reference from 0, where the joint is at rest before. JointPid
/// computes the effort once per period from the exact position and velocity; the joint moves
/// exactly under the held effort (zero-order hold). The result includes sampling, clamps, weights,
/// filter and the limit of the drive. A short period gives the continuous loop.
/// @param plant    the joint
/// @param gains    of the PID
/// @param options  of the step
/// @return         all metrics; undefined ones are empty, all of them if the motion overflows
/// @throws std::invalid_argument naming the parameter and its value
/// Real-time: no (set-up).
[[nodiscard]] inline StepMetrics step_metrics(const JointPlant& plant, const PidGains& gains,
                                              const StepOptions& options = {}) {
  validate(plant);
  validate(std::array{gains}, std::array<std::string_view, 1>{"plant"});
  const auto check = [](std::string_view what, const double& value, bool may_be_infinite) {
    if (value > 0 && (is_finite(value) || may_be_infinite)) return;
    detail::refuse({"step response: ", what, " ", value, " is not a number > 0"});
  };
  check("duration", options.duration, false);
  check("period", options.period, false);
  check("effort_limit", options.effort_limit, true);
  const double count = std::ceil(options.duration / options.period * (1 - 1e-12));
  if (!(count <= 1e8)) {
    detail::refuse({"step response: duration ", options.duration,
                    " s is more than 10^8 periods of ", options.period, " s"});
  }
  StepMetrics metrics(0, options.height, options.band);
  const detail::HeldEffort held(plant, options.period);
  double position = 0, velocity = 0;
  JointPid pid;
  pid.start();
  static_cast<void>(pid.update(gains, {}, options.period));  // at rest, before the step
  metrics.add(0, 0);
  for (long k = 0; k < static_cast<long>(count); ++k) {
    const double asked = pid.update(
        gains, {.error = options.height - position, .measured = position, .rate_error = -velocity},
        options.period);
    const double effort = std::clamp(asked, -options.effort_limit, options.effort_limit);
    if (effort != asked) pid.limit_windup(gains, asked - effort);
    held.advance(position, velocity, effort);
    metrics.add(static_cast<double>(k + 1) * options.period, position);
  }
  return metrics;
}

}  // namespace articula
