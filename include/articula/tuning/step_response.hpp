// SPDX-License-Identifier: Apache-2.0
/// @file The step response of a PID and a joint.
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

/// How a step response is made.
struct StepOptions {
  double height = 1;     ///< of the step, from rest at 0 [rad or m]
  double duration = 1;   ///< [s], > 0
  double period = 1e-3;  ///< from one command to the next [s], > 0, at most 10^8 in `duration`
  double band = 0.02;    ///< of the settling time, a share of the step [1]
  double effort_limit = std::numeric_limits<double>::infinity();  ///< of the drive [N m or N], > 0
};

namespace detail {

/// I q'' + (I/T) q' = effort under an effort that is held for a period h, solved exactly, a = 1/T:
///
///     v <- e^(-a h) v + f effort/I,   q <- q + f v + g effort/I,
///     f = (1 - e^(-a h))/a,   g = (h - f)/a.
class HeldPlant {
 public:
  HeldPlant(const JointPlant& plant, double period) : inertia_(plant.inertia) {
    const double ah = period * plant.decay_rate();
    remains_ = std::exp(-ah);
    // Where a h is small, h - f cancels and the series is exact.
    const bool small = ah < 1e-3;
    f_ = period *
         (small ? 1 - ah / 2 * (1 - ah / 3 * (1 - ah / 4 * (1 - ah / 5))) : -std::expm1(-ah) / ah);
    g_ = period *
         (small ? period / 2 * (1 - ah / 3 * (1 - ah / 4 * (1 - ah / 5))) : (period - f_) / ah);
  }

  void advance(double effort) {
    const double push = effort / inertia_;
    position += f_ * velocity + g_ * push;
    velocity = remains_ * velocity + f_ * push;
  }

  double position = 0;  ///< q [rad or m]
  double velocity = 0;  ///< q' [rad/s or m/s]

 private:
  double inertia_, remains_, f_, g_;
};

}  // namespace detail

/// The metrics of a step of the reference from 0, with the joint at rest there before it. The loop
/// is simulated as it runs: the very JointPid, once in each period, on exact position and
/// velocity; the joint moves under the effort that is held in between, exactly (zero-order hold).
/// So sampling, clamps, weights, filter and the limit of the drive are in the result; a short
/// period gives the continuous loop.
/// @param plant    the joint
/// @param gains    of the PID
/// @param options  of the step
/// @return         all metrics; empty where undefined, all of them if the motion has overflowed
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
  detail::HeldPlant joint(plant, options.period);
  JointPid pid;
  pid.start();
  static_cast<void>(pid.update(gains, {}, options.period));  // at rest, before the step
  metrics.add(0, 0);
  for (long k = 0; k < static_cast<long>(count); ++k) {
    const double asked = pid.update(gains,
                                    {.error = options.height - joint.position,
                                     .measured = joint.position,
                                     .rate_error = -joint.velocity},
                                    options.period);
    const double effort = std::clamp(asked, -options.effort_limit, options.effort_limit);
    if (effort != asked) pid.limit_windup(gains, asked - effort);
    joint.advance(effort);
    metrics.add(static_cast<double>(k + 1) * options.period, joint.position);
  }
  return metrics;
}

}  // namespace articula
