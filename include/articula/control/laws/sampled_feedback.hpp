// SPDX-License-Identifier: Apache-2.0
/// @file The linear part of a law that is computed once per period.
#pragma once

#include "articula/control/laws/pid_gains.hpp"

#include <string_view>

namespace articula {

/// What a law makes of one joint's measured position or velocity: the linear part of a PID.
struct SampledFeedback {
  double proportional = 0;         ///< p [output per rad or m; of the velocity: per rad/s or m/s]
  double integral = 0;             ///< i [p per s]
  double derivative = 0;           ///< d [p times s]
  double filter_time = 0;          ///< T_f of the derivative's low-pass [s]; 0: no filter
  bool of_velocity = false;        ///< y is the velocity, else the position
  bool takes_differences = false;  ///< the derivative is made of differences of y, see JointPid
  bool integral_lags = false;      ///< the integral is used first and advanced then
  std::string_view proportional_name = "p", derivative_name = "d";  ///< what users call them

  /// What users call a gain.
  [[nodiscard]] std::string_view name_of(double SampledFeedback::* gain) const noexcept {
    if (gain == &SampledFeedback::integral) return "i";
    return gain == &SampledFeedback::derivative ? derivative_name : proportional_name;
  }

  /// Of a PID's gains. The integral counts where its clamps leave it room.
  [[nodiscard]] static SampledFeedback of(const PidGains& g) noexcept {
    return {.proportional = g.proportional,
            .integral = g.integral_clamp_min < g.integral_clamp_max ? g.integral : 0,
            .derivative = g.derivative,
            .filter_time = g.derivative_filter_time,
            .takes_differences = g.derivative_of == DerivativeOf::error};
  }
};

}  // namespace articula
