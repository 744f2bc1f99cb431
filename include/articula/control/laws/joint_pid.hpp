// SPDX-License-Identifier: Apache-2.0
/// @file The PID law of one joint.
#pragma once

#include "articula/control/laws/pid_gains.hpp"
#include "articula/core/control_input.hpp"
#include "articula/core/finite.hpp"

#include <algorithm>
#include <cmath>

namespace articula {

/// The input of one joint's PID in a cycle.
struct PidInput {
  double error = 0;                   ///< e = r - y, of the variable that is controlled
  double measured = 0;                ///< y
  double rate_error = 0;              ///< c r' - y', of measured y', if that is so
  bool rate_is_measured = true;       ///< else the derivative is made of differences
  double velocity_reference = 0;      ///< v_ref, for the feed-forward
  double acceleration_reference = 0;  ///< a_ref, for the feed-forward
};

/// The PID law of one joint, with all that its gains can ask for. In cycle k, dt after the last
/// one,
///
///     I   <- clamp(I + i e dt, integral_clamp_min, integral_clamp_max)   unless |e| <= dead-band
///     s    = c r' - y' as measured, or (c (r - r_last) - (y - y_last))/dt;
///            where y' is not measured and it is not that of the error, c = 0
///     D   <- D + dt/(T_f + dt) (s - D)
///     u    = p (b r - y) + I + d D + f_v v_ref + f_a a_ref
///     u'   = clamp(u, output_clamp_min, output_clamp_max)
///
/// I is in units of the output and is integrated before use (backward Euler), D is the low-pass
/// T_f D' + D = s in backward Euler. For weights b < 1 and c < 1, r and y are counted from where y
/// was at the start, so that a joint that is asked to stay gets no output. In a period of 0
/// differences tell nothing: I stays, and so does a D that is made of them or filtered. New clamps
/// take force with the next cycle; if i becomes 0, I stays as it is and is left as a constant until
/// the next start.
///
/// Nothing is remembered of an input that is not finite. Where terms of finite inputs overflow, the
/// output is a finite number of 1e300 or so.
///
/// By what the output is cut off, u - u', and what the caller cuts off later (`limit_windup`), the
/// integral is kept from winding up in one of three ways (AntiWindup): none; back-calculation,
///
///     I <- I - dt/T_t (u - u'),   T_t = sqrt(d/i), or p/i where d is 0, unless given;
///
/// or conditional integration: the last step of an integral that pushed further is taken back.
/// Source: [Åström, Hägglund 2006, sections 3.3 to 3.5].
class JointPid {
 public:
  /// Forgets the past: the integral is 0. Real-time: yes.
  void start() noexcept {
    integral_ = previous_integral_ = rate_ = 0;
    past_ = Past::none;
  }

  /// The slowest integral that begins with what may have been a push, see `prime` [s].
  static constexpr double slowest_primed = 10;

  /// Lets the integral begin with the output that was applied last, as far as its clamps allow.
  /// After `start`. If the output was a passing push and no load, the error is off by I/p. The
  /// integral takes that back with the time constant p/i. So the integral stays 0 where p/i is more
  /// than ten seconds and the output may have been a push. It stays 0 without an integral gain, and
  /// with an output that is not finite, too. Real-time: yes.
  /// @param held  push or load
  void prime(const PidGains& g, double output, Held held) noexcept {
    const bool soon = g.proportional <= slowest_primed * g.integral;
    if (g.integral == 0 || (held != Held::load && !soon) || !is_finite(output)) return;
    set_integral(g, output);
    previous_integral_ = integral_;
  }

  /// The output u'.
  /// @param g       that validate() accepts
  /// @param in      this cycle's input
  /// @param period  dt [s]
  /// @param turn    what the error is counted modulo: 2 pi for a joint that turns for ever, 0:
  ///                nothing
  /// Real-time: yes.
  [[nodiscard]] double update(const PidGains& g, const PidInput& in, double period,
                              double turn = 0) noexcept {
    if (past_ == Past::none) {
      origin_ = last_measured_ = in.measured;
      last_error_ = in.error;
    }
    const double rate = filtered(g, rate_of(g, in, period, turn), period);
    period_ = period;
    // The clamps may be new.
    integral_ = std::clamp(integral_, g.integral_clamp_min, g.integral_clamp_max);
    previous_integral_ = integral_;
    if (!(std::abs(in.error) <= g.error_deadband)) {
      set_integral(g, integral_ + g.integral * in.error * period);
    }
    const double proportional = weighted(g.position_weight, in.error, in.measured - origin_);
    const double output = g.proportional * proportional + integral_ + g.derivative * rate +
                          g.velocity_feedforward * in.velocity_reference +
                          g.acceleration_feedforward * in.acceleration_reference;
    const double within = std::clamp(output, g.output_clamp_min, g.output_clamp_max);
    const double excess = output - within;
    const bool unusual = excess != 0;  // also where it is NaN
    if (unusual && !is_finite(output)) return overflown(g, in, rate, period);
    remember(in, period);
    if (unusual) limit_windup(g, excess);
    return within;
  }

  /// Keeps the integral from winding up when an output was cut off (anti-windup).
  /// @param excess  the output minus what was left of it; that of an overflow may be anything
  /// Real-time: yes.
  void limit_windup(const PidGains& g, double excess) noexcept {
    if (!is_finite(excess)) {
      integral_ = previous_integral_;
    } else if (g.anti_windup == AntiWindup::conditional_integration) {
      const bool pushes_further = (excess > 0 && integral_ > previous_integral_) ||
                                  (excess < 0 && integral_ < previous_integral_);
      if (pushes_further) integral_ = previous_integral_;
    } else if (g.anti_windup == AntiWindup::back_calculation && g.integral != 0) {
      // A step beyond T_t would overshoot what it is to follow.
      set_integral(g, integral_ - std::min(1.0, period_ / tracking_time(g)) * excess);
    }
  }

  /// The integral term I [output]. Real-time: yes.
  [[nodiscard]] double integral() const noexcept { return integral_; }

  /// T_t [s] of back-calculation. Real-time: yes.
  [[nodiscard]] static double tracking_time(const PidGains& g) noexcept {
    if (g.tracking_time > 0) return g.tracking_time;
    if (g.derivative != 0) return std::sqrt(std::abs(g.derivative / g.integral));
    return std::abs(g.proportional / g.integral);
  }

  /// The difference of two angles, the short way round. Real-time: yes.
  /// @param turn  a full turn; 0: the difference as it is
  [[nodiscard]] static double short_way(double difference, double turn) noexcept {
    return turn > 0 ? std::remainder(bounded(1, difference), turn) : difference;
  }

 private:
  /// What is known of the cycle before.
  enum class Past : unsigned char {
    none,   ///< there was no good input since the start
    gap,    ///< its input was no number: a difference from before tells nothing
    known,  ///< its error and its measured value
  };

  /// A product that has overflowed, or one of its factors, as a number that leaves room for sums. A
  /// NaN stays one.
  [[nodiscard]] static double bounded(double factor, double value) noexcept {
    constexpr double huge = 1e300;
    return std::clamp(factor * std::clamp(value, -huge, huge), -huge, huge);
  }

  /// weight r - y = weight e - (1 - weight) y.
  [[nodiscard]] static double weighted(double weight, double error, double measured) noexcept {
    return weight == 1 ? error : weight * error - (1 - weight) * measured;
  }

  void remember(const PidInput& in, double period) noexcept {
    if (period > 0) {
      last_error_ = in.error;
      last_measured_ = in.measured;
    }
    past_ = Past::known;
  }

  /// The output where the sum of terms is no number: of inputs that are none, or of an overflow.
  [[nodiscard, gnu::cold]] double overflown(const PidGains& g, const PidInput& in, double rate,
                                            double period) noexcept {
    const bool is_difference =
        !in.rate_is_measured || g.derivative_of != DerivativeOf::measured_velocity;
    if (is_difference && !is_finite(rate)) rate = rate_;
    const double b = g.position_weight;
    const double proportional =
        bounded(b, in.error) - (b == 1 ? 0 : bounded(1 - b, in.measured - origin_));
    if (is_finite(in.error) && is_finite(in.measured)) {
      remember(in, period);
    } else if (past_ == Past::known) {
      past_ = Past::gap;
    }
    const double output = bounded(g.proportional, proportional) + bounded(1, integral_) +
                          bounded(g.derivative, rate) +
                          bounded(g.velocity_feedforward, in.velocity_reference) +
                          bounded(g.acceleration_feedforward, in.acceleration_reference);
    const double within = std::clamp(output, g.output_clamp_min, g.output_clamp_max);
    if (within != output) limit_windup(g, output - within);
    return within;
  }

  [[nodiscard]] double rate_of(const PidGains& g, const PidInput& in, double period,
                               double turn) const noexcept {
    if (in.rate_is_measured && g.derivative_of == DerivativeOf::measured_velocity) {
      return in.rate_error;
    }
    if (!(period > 0) || past_ == Past::gap) return rate_;
    const double weight = g.derivative_of == DerivativeOf::error ? g.velocity_weight : 0;
    return weighted(weight, short_way(in.error - last_error_, turn), in.measured - last_measured_) /
           period;
  }

  [[nodiscard]] double filtered(const PidGains& g, double rate, double period) noexcept {
    const double time = g.derivative_filter_time;
    if (time > 0 && !(period > 0)) return rate_;
    const bool unfiltered = past_ == Past::none || !(time > 0) || !is_finite(rate);
    const double next = unfiltered ? rate : rate_ + period / (time + period) * (rate - rate_);
    if (is_finite(next)) rate_ = next;  // an overflow is not to be remembered
    return next;
  }

  /// A step that overflows is not taken.
  void set_integral(const PidGains& g, double next) noexcept {
    next = std::clamp(next, g.integral_clamp_min, g.integral_clamp_max);
    if (is_finite(next)) integral_ = next;
  }

  double integral_ = 0;           ///< I [output]
  double previous_integral_ = 0;  ///< I before the last step [output]
  double rate_ = 0;               ///< D
  double last_error_ = 0;
  double last_measured_ = 0;
  double origin_ = 0;  ///< y at the start
  double period_ = 0;  ///< dt of the last update [s]
  Past past_ = Past::none;
};

}  // namespace articula
