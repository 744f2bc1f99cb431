// SPDX-License-Identifier: Apache-2.0
/// @file The gains of a PID controller.
#pragma once

#include "articula/control/laws/valid_gains.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <string_view>

namespace articula {

/// What an integral does while the output is cut off by a limit. With the output before and after,
/// u and u', and the integral term I:
enum class AntiWindup : unsigned char {
  none,                     ///< goes on, up to its clamps
  back_calculation,         ///< I <- I + dt (u' - u)/tracking_time: follows what was cut off
  conditional_integration,  ///< does not grow in the direction that pushes further
};

/// What the derivative term is made of. Only that of the error kicks when the reference steps.
enum class DerivativeOf : unsigned char {
  measured_velocity,  ///< v_ref - v, with v as measured; of a PID of the velocity: the change of -v
  error,              ///< the change of the error from one cycle to the next
};

/// Which signs p, i and d may have.
enum class GainSigns : unsigned char {
  not_negative,  ///< with a negative one a joint runs away from its reference
  any,           ///< whatever control_toolbox takes: output clamps without 0 between them, too
};

/// The gains of one joint's PID. The output is N m (or N) where it is an effort. ROS users know the
/// first of them as p, i, d, i_clamp_min and i_clamp_max. What the others do: see JointPid.
/// @tparam S  type of a number: double, or a pack with the numbers of several robots, which have
///            `anti_windup` and `derivative_of` in common
template <class S>
struct BasicPidGains {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  S proportional = 0;                ///< p [output per rad or m]
  S integral = 0;                    ///< i [output per rad s or m s]
  S derivative = 0;                  ///< d [output per rad/s or m/s]
  S integral_clamp_min = -infinity;  ///< lowest integral term [output]
  S integral_clamp_max = infinity;   ///< highest integral term [output]
  S output_clamp_min = -infinity;    ///< lowest output of the PID [output]
  S output_clamp_max = infinity;     ///< highest output of the PID [output]
  AntiWindup anti_windup = AntiWindup::conditional_integration;
  S tracking_time = 0;   ///< T_t of back-calculation [s]; 0: sqrt(d/i), or p/i where d is 0
  S error_deadband = 0;  ///< the integral rests while |e| is not above it [rad or m]
  DerivativeOf derivative_of = DerivativeOf::measured_velocity;
  S derivative_filter_time = 0;    ///< T_f of the derivative's low-pass [s]; 0: no filter
  S position_weight = 1;           ///< b, share of the reference in the proportional term
  S velocity_weight = 1;           ///< c, share of the reference in the derivative term; 0 for
                                   ///< the change of -v
  S velocity_feedforward = 0;      ///< f_v [output per rad/s or m/s]
  S acceleration_feedforward = 0;  ///< f_a [output per rad/s^2 or m/s^2]
};

/// The gains of one joint's PID of one robot.
using PidGains = BasicPidGains<double>;

/// The gains of N joints.
template <int N, class S = double>
using JointPidGains = std::array<BasicPidGains<S>, static_cast<std::size_t>(N)>;

/// Gains of N joints that have been checked.
template <int N, class S = double>
using ValidPidGains = ValidGains<BasicPidGains<S>, N>;

/// Refuses gains that make no controller. These are a gain that is not finite or negative, and
/// clamps that do not contain 0 (the joint would be pushed at rest). So are a time or dead-band
/// below 0, a weight outside 0 .. 1, and back-calculation without a T_t.
/// @param gains  of all joints
/// @param names  of the same joints, for the message
/// @param signs  which p, i and d may have; with `any` the output clamps need not contain 0
/// @throws std::invalid_argument naming joint, gain and value
/// Real-time: no (throws).
template <std::size_t N>
void validate(const std::array<PidGains, N>& gains, const std::array<std::string_view, N>& names,
              GainSigns signs = GainSigns::not_negative) {
  for (std::size_t i = 0; i < N; ++i) {
    const auto refuse = [&](detail::MessageParts parts) {
      detail::refuse({"PID gains of joint '", names[i], "': ", detail::message_of(parts)});
    };
    const auto check_finite = [&](std::string_view what, double value) {
      if (!is_finite(value)) refuse({what, " ", value, " is not finite"});
    };
    const auto check_not_negative = [&](std::string_view what, double value) {
      if (!is_finite(value) || value < 0) refuse({what, " ", value, " is not a number >= 0"});
    };
    const auto check_gain = [&](std::string_view what, double value) {
      check_finite(what, value);
      if (signs == GainSigns::not_negative) check_not_negative(what, value);
    };
    const auto check_weight = [&](std::string_view what, double value) {
      if (!(value >= 0 && value <= 1)) refuse({what, " ", value, " is not within 0 .. 1"});
    };
    const auto check_clamps = [&](std::string_view what, double low, double high) {
      if (!(low <= 0 && high >= 0)) {
        refuse({what, "_min ", low, " and ", what, "_max ", high, " do not have 0 between them"});
      }
    };
    const PidGains& g = gains[i];
    check_gain("proportional", g.proportional);
    check_gain("integral", g.integral);
    check_gain("derivative", g.derivative);
    check_clamps("integral_clamp", g.integral_clamp_min, g.integral_clamp_max);
    if (signs == GainSigns::not_negative) {
      check_clamps("output_clamp", g.output_clamp_min, g.output_clamp_max);
    } else if (!(g.output_clamp_min <= g.output_clamp_max)) {
      refuse({"output_clamp_min ", g.output_clamp_min, " is not below output_clamp_max ",
              g.output_clamp_max});
    }
    if (g.anti_windup > AntiWindup::conditional_integration) {
      refuse(
          {"anti_windup ", static_cast<int>(g.anti_windup),
           " is no value of AntiWindup: write none, back_calculation or conditional_integration"});
    }
    check_not_negative("tracking_time", g.tracking_time);
    if (g.anti_windup == AntiWindup::back_calculation && g.tracking_time == 0 && g.integral != 0 &&
        g.proportional == 0 && g.derivative == 0) {
      refuse({"tracking_time 0 with back_calculation, integral ", g.integral,
              " and neither proportional nor derivative: its default p/i or sqrt(d/i) is 0. Set a "
              "tracking_time > 0 [s], or choose conditional_integration"});
    }
    check_not_negative("error_deadband", g.error_deadband);
    if (g.derivative_of > DerivativeOf::error) {
      refuse({"derivative_of ", static_cast<int>(g.derivative_of),
              " is no value of DerivativeOf: write measured_velocity or error"});
    }
    check_not_negative("derivative_filter_time", g.derivative_filter_time);
    check_weight("position_weight", g.position_weight);
    check_weight("velocity_weight", g.velocity_weight);
    check_finite("velocity_feedforward", g.velocity_feedforward);
    check_finite("acceleration_feedforward", g.acceleration_feedforward);
  }
}

/// The gains of N joints from a list in place.
/// @throws std::invalid_argument if it is not as long as there are joints
/// Real-time: no (throws).
template <int N>
[[nodiscard]] JointPidGains<N> pid_gains_of(std::initializer_list<PidGains> list) {
  if (list.size() != static_cast<std::size_t>(N)) {
    detail::refuse({"PID gains: the list has ", list.size(), ", but there are ", N, " joints"});
  }
  JointPidGains<N> gains;
  std::copy(list.begin(), list.end(), gains.begin());
  return gains;
}

/// A robot that brings gains for its PID controllers along.
template <class R>
concept HasPidGains = requires { R::pid_gains; };

}  // namespace articula
