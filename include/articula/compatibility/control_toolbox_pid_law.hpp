// SPDX-License-Identifier: Apache-2.0
/// @file The PID laws of ROS's control_toolbox, with the same numbers.
#pragma once

#include "articula/control/laws/joint_pid.hpp"
#include "articula/control/laws/pid_gains.hpp"
#include "articula/control/laws/sampled_feedback.hpp"
#include "articula/core/control_input.hpp"
#include "articula/core/joint_array.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace articula {

/// The versions of ROS's control_toolbox whose laws differ.
enum class ControlToolbox : unsigned char {
  current,            ///< Kilted and later (5.7 to 6.3); Jazzy with another strategy than legacy
  jazzy,              ///< ROS 2 Jazzy, strategy legacy, antiwindup false: its parameters' defaults
  jazzy_antiwindup,   ///< ROS 2 Jazzy, legacy, antiwindup true: default of Gains made of 5 numbers
  humble,             ///< ROS 2 Humble, antiwindup false
  humble_antiwindup,  ///< ROS 2 Humble, antiwindup true
  noetic,             ///< ROS 1 Noetic, antiwindup false; the same law as humble
  noetic_antiwindup,  ///< ROS 1 Noetic, antiwindup true; the same law as humble_antiwindup
};

/// The PID of each of N joints as control_toolbox computes it, to the last bit where it matters.
/// Use it to compare with, or move from, a robot under ros_control or ros2_control. For new work
/// see PidLaw. With e = q_ref - q, e' = v_ref - v or (e - e_last)/dt, as `derivative_of` says:
///
///     current:  u  = p e + I + d e',   u' = clamp(u, output_clamp_min, output_clamp_max)
///               unless |e| <= error_deadband:
///                 none                     I <- I + dt i e
///                 back_calculation         I <- I + dt (i e + (u' - u)/T_t)       (i not 0)
///                 conditional_integration  I <- I + dt i e, unless u' != u and e u > 0
///               I <- clamp(I, integral_clamp_min, integral_clamp_max)
///               u' is returned; the integral is used first and advanced then
///     jazzy:    I <- I + dt i e, unless |e| <= error_deadband
///               u = p e + clamp(I, integral_clamp_min, integral_clamp_max) + d e'
///               with antiwindup, I itself is kept between the clamps, else it goes on
///               clamp(u, output_clamp_min, output_clamp_max) is returned
///     humble,   E <- E + dt e
///     noetic:   u = p e + clamp(i E, integral_clamp_min, integral_clamp_max) + d e'
///               with antiwindup, i E itself is kept between the clamps, else it goes on
///
/// e_last is 0 at the start, so that the first e' kicks. A period of 0 gives the last output again
/// (current, jazzy) or 0. An error or e' that is not finite gives NaN (current, jazzy) or 0. The
/// integral then stays. The other gains are not used, and what is cut off from the total has no
/// effect. Negative gains are taken, as control_toolbox takes them. Only the T_t that follows from
/// gains is that of their sizes, where theirs would be negative or none. Output clamps need not
/// have 0 between them.
/// Source: control_toolbox, pid.cpp of the branches named.
/// @tparam N  number of joints
template <int N>
class ControlToolboxPidLaw {
 public:
  /// @param version         whose law
  /// @param gains           of the N joints
  /// @param names           of the same joints, for the error message
  /// @param keeps_integral  of each joint, what ROS calls save_i_term: start() leaves the integral
  /// @throws std::invalid_argument naming joint, gain and value, see validate
  ControlToolboxPidLaw(ControlToolbox version, const JointPidGains<N>& gains,
                       const JointNames<N>& names, const JointArray<bool, N>& keeps_integral = {})
      : version_(version), gains_{gains}, keeps_integral_(keeps_integral) {
    validate(gains, names, GainSigns::any);
  }

  /// Forgets the past, but for the integrals of joints that keep them. Real-time: yes.
  void start(const ControlInput<N>&) noexcept {
    for (std::size_t i = 0; i < memories_.size(); ++i) {
      memories_[i] = {.integral = keeps_integral_[i] ? memories_[i].integral : 0};
    }
  }

  /// The output of each joint, N x 1. Real-time: yes. O(N).
  [[nodiscard]] JointVector<N> output(const ControlInput<N>& in) noexcept {
    JointVector<N> output;
    for (int j = 0; j < N; ++j) {
      const double error = in.reference.position[j] - in.state.position[j];
      const double rate = in.reference.velocity[j] - in.state.velocity[j];
      output[j] = sums_errors() ? legacy(gains_[j], memories_[j], error, rate, in.period)
                                : current(gains_[j], memories_[j], error, rate, in.period);
    }
    return output;
  }

  /// Goes on with other gains, none of them negative. Real-time: yes.
  void set_gains(const ValidPidGains<N>& gains) noexcept { gains_ = {gains.values()}; }

  [[nodiscard]] const JointPidGains<N>& gains() const noexcept { return gains_; }

  /// What becomes of one joint's measurements, see gain_notices. Real-time: yes.
  [[nodiscard]] SampledFeedback sampled_feedback(std::size_t joint) const noexcept {
    SampledFeedback feedback = SampledFeedback::of(gains_[joint]);
    feedback.filter_time = 0;  // it has none
    feedback.integral_lags = version_ == ControlToolbox::current;
    return feedback;
  }

  /// The integral terms that the next (current) or the last output (all others) contains
  /// [output], N x 1. Real-time: yes.
  [[nodiscard]] JointVector<N> integral() const noexcept {
    JointVector<N> terms;
    for (int j = 0; j < N; ++j) {
      const double factor = sums_errors() ? gains_[j].integral : 1;
      terms[j] = clamped(gains_[j], factor * memories_[j].integral);
    }
    return terms;
  }

 private:
  struct Memory {
    double integral = 0;  ///< I [output], or E [rad s or m s] where errors are summed up
    double last_error = 0;
    double last_output = 0;
  };

  /// True where the integral of the error is remembered, false where that of i times the error is.
  [[nodiscard]] bool sums_errors() const noexcept { return version_ >= ControlToolbox::humble; }
  /// True where the integral itself is kept between its clamps before it is used.
  [[nodiscard]] bool clamps_integral() const noexcept {
    return version_ == ControlToolbox::jazzy_antiwindup ||
           version_ == ControlToolbox::humble_antiwindup ||
           version_ == ControlToolbox::noetic_antiwindup;
  }

  [[nodiscard]] static double clamped(const PidGains& g, double integral) noexcept {
    return std::clamp(integral, g.integral_clamp_min, g.integral_clamp_max);
  }

  /// A step that overflows is not taken.
  static void advance(double& integral, double step) noexcept {
    if (is_finite(integral + step)) integral += step;
  }

  /// The laws that remember I: those of current and jazzy.
  [[nodiscard]] double current(const PidGains& g, Memory& memory, double error, double rate,
                               double period) const noexcept {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    if (!(period > epsilon)) return memory.last_output;
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (!is_finite(error)) return memory.last_output = none;
    if (g.derivative_of == DerivativeOf::error) rate = (error - memory.last_error) / period;
    memory.last_error = error;
    if (!is_finite(rate)) return memory.last_output = none;
    const bool first_used = version_ == ControlToolbox::current;
    const bool integrates = std::abs(error) > g.error_deadband;
    if (!first_used && integrates) {
      advance(memory.integral, g.integral * period * error);
      if (clamps_integral()) memory.integral = clamped(g, memory.integral);
    }
    const double integral = first_used ? memory.integral : clamped(g, memory.integral);
    const double wanted = g.proportional * error + integral + g.derivative * rate;
    const double output = std::clamp(wanted, g.output_clamp_min, g.output_clamp_max);
    if (first_used && integrates) {
      double step = g.integral * error;
      if (g.anti_windup == AntiWindup::back_calculation && g.integral != 0 && output != wanted) {
        step += (output - wanted) / JointPid::tracking_time(g);
      } else if (g.anti_windup == AntiWindup::conditional_integration &&
                 std::abs(wanted - output) > epsilon && error * wanted > 0) {
        step = 0;
      }
      advance(memory.integral, period * step);
    }
    if (first_used) memory.integral = clamped(g, memory.integral);
    return memory.last_output = output;
  }

  /// The laws that remember E: those of humble and noetic.
  [[nodiscard]] double legacy(const PidGains& g, Memory& memory, double error, double rate,
                              double period) const noexcept {
    if (!(period > 0) || !is_finite(error)) return 0;
    if (g.derivative_of == DerivativeOf::error) rate = (error - memory.last_error) / period;
    memory.last_error = error;
    if (!is_finite(rate)) return 0;
    advance(memory.integral, period * error);
    if (clamps_integral() && g.integral != 0) {
      const double a = g.integral_clamp_min / g.integral, b = g.integral_clamp_max / g.integral;
      memory.integral = std::clamp(memory.integral, std::min(a, b), std::max(a, b));
    }
    const double term = g.integral * memory.integral;
    return g.proportional * error + (clamps_integral() ? term : clamped(g, term)) +
           g.derivative * rate;
  }

  ControlToolbox version_;
  JointArray<PidGains, N> gains_;
  JointArray<bool, N> keeps_integral_;
  JointArray<Memory, N> memories_{};
};

}  // namespace articula
