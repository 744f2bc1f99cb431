// SPDX-License-Identifier: Apache-2.0
/// @file The PID law of one joint.
#pragma once

#include "articula/control/laws/pid_gains.hpp"
#include "articula/control/laws/pid_input.hpp"
#include "articula/core/control_input.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/scalar.hpp"

#include <cmath>

namespace articula {

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
/// I is in units of the output and is integrated before use (backward Euler). D is the low-pass
/// T_f D' + D = s in backward Euler. For weights b < 1 and c < 1, r and y are counted from where y
/// was at the start. So a joint that is asked to stay gets no output. In a period of 0 differences
/// tell nothing: I stays, and so does a D that is made of them or filtered. New clamps take force
/// with the next cycle. If i becomes 0, I stays as it is and is left as a constant until the next
/// start.
///
/// Nothing is remembered of an input that is not finite. Where terms of finite inputs overflow, the
/// output is a finite number of 1e300 or so.
///
/// The clamps cut off u - u' of the output, and the caller may cut off more (`limit_windup`). By
/// that the integral is kept from winding up in one of three ways (AntiWindup): none;
/// back-calculation,
///
///     I <- I - dt/T_t (u - u'),   T_t = sqrt(d/i), or p/i where d is 0, unless set;
///
/// or conditional integration: the last step of an integral that pushed further is taken back.
/// Source: [Åström, Hägglund 2006, sections 3.3 to 3.5].
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <class S>
class BasicJointPid {
 public:
  using Input = BasicPidInput<S>;
  using Gains = BasicPidGains<S>;

  /// Forgets the past: the integral is 0. Real-time: yes.
  void start() noexcept {
    integral_ = previous_integral_ = rate_ = 0;
    begun_ = gap_ = mask_of<S>(false);
  }

  /// The slowest integral that begins with what may have been a push, see `prime` [s].
  static constexpr double slowest_primed = 10;

  /// Lets the integral begin with the output that was applied last, as far as its clamps allow.
  /// After `start`. If the output was a passing push and no load, the error is off by I/p. The
  /// integral takes that back with the time constant p/i. So the integral stays 0 where p/i is more
  /// than ten seconds and the output may have been a push. It stays 0 without an integral gain, and
  /// with an output that is not finite, too. Real-time: yes.
  /// @param held  push or load
  void prime(const Gains& g, const S& output, Held held) noexcept {
    const MaskOf<S> soon = g.proportional <= slowest_primed * g.integral;
    const MaskOf<S> primed = (g.integral != 0) & (mask_of<S>(held == Held::load) | soon);
    if (!any_of(primed)) return;
    set_integral(g, select(primed & is_finite(output), output, integral_));
    previous_integral_ = integral_;
  }

  /// The output u'.
  /// @param g       that validate() accepts
  /// @param in      this cycle's input
  /// @param period  dt [s]
  /// @param turn    what the error is counted modulo: 2 pi for a joint that turns for ever, 0:
  ///                nothing
  /// Real-time: yes.
  [[nodiscard]] S update(const Gains& g, const Input& in, double period, double turn = 0) noexcept {
    using std::abs;
    if (!all_of(begun_)) {
      replace_where(!begun_, origin_, in.measured);
      replace_where(!begun_, last_measured_, in.measured);
      replace_where(!begun_, last_error_, in.error);
    }
    const S rate = filtered(g, rate_of(g, in, period, turn), period);
    period_ = period;
    // The clamps may be new.
    integral_ = clamp(integral_, g.integral_clamp_min, g.integral_clamp_max);
    previous_integral_ = integral_;
    S next = integral_ + g.integral * in.error * period;
    replace_where(abs(in.error) <= g.error_deadband, next, integral_);
    set_integral(g, next);
    const S proportional = weighted(g.position_weight, in.error, in.measured - origin_);
    const S output = g.proportional * proportional + integral_ + g.derivative * rate +
                     g.velocity_feedforward * in.velocity_reference +
                     g.acceleration_feedforward * in.acceleration_reference;
    const S within = clamp(output, g.output_clamp_min, g.output_clamp_max);
    const S excess = output - within;
    if (any_of(excess != 0)) {  // also where it is NaN
      if (!all_of(is_finite(output))) return overflown(g, in, rate, output, period);
      limit_windup(g, excess);
    }
    remember(in, period);
    return within;
  }

  /// Keeps the integral from winding up when an output was cut off (anti-windup).
  /// @param excess  the output minus what was left of it; that of an overflow may be anything; 0
  ///                changes nothing
  /// Real-time: yes.
  void limit_windup(const Gains& g, const S& excess) noexcept {
    if (g.anti_windup == AntiWindup::conditional_integration) {
      const auto rises = integral_ > previous_integral_, falls = integral_ < previous_integral_;
      const auto above = excess > 0, below = excess < 0;
      replace_where((above & rises) | (below & falls), integral_, previous_integral_);
    } else if (g.anti_windup == AntiWindup::back_calculation && any_of(g.integral != 0)) {
      // A step beyond T_t would overshoot what it is to follow.
      const S ratio = period_ / tracking_time(g), share = select(ratio < 1, ratio, S(1));
      set_integral(g, select(g.integral != 0, integral_ - share * excess, integral_));
    }
    replace_where(!is_finite(excess), integral_, previous_integral_);
  }

  /// The integral term I [output]. Real-time: yes.
  [[nodiscard]] const S& integral() const noexcept { return integral_; }

  /// T_t [s] of back-calculation. Real-time: yes.
  [[nodiscard]] static S tracking_time(const Gains& g) noexcept {
    if constexpr (PackedScalar<S>) {
      const S of_gains = select(g.derivative != 0, sqrt(abs(g.derivative / g.integral)),
                                abs(g.proportional / g.integral));
      return select(g.tracking_time > 0, g.tracking_time, of_gains);
    } else {
      if (g.tracking_time > 0) return g.tracking_time;
      if (g.derivative != 0) return std::sqrt(std::abs(g.derivative / g.integral));
      return std::abs(g.proportional / g.integral);
    }
  }

  /// The difference of two angles, the short way round. Real-time: yes.
  /// @param turn  a full turn; 0: the difference as it is
  [[nodiscard]] static S short_way(const S& difference, double turn) noexcept {
    if (!(turn > 0)) return difference;
    S rest = bounded(1, difference);
    for (int k = 0; k < lanes<S>; ++k) {
      set_lane(rest, k, std::remainder(lane_of(rest, k), turn));
    }
    return rest;
  }

 private:
  /// A product that has overflowed, or one of its factors, as a number that leaves room for sums. A
  /// NaN stays one.
  [[nodiscard]] static S bounded(const S& factor, const S& value) noexcept {
    constexpr double huge = 1e300;
    return clamp(factor * clamp(value, -huge, huge), -huge, huge);
  }

  /// weight r - y = weight e - (1 - weight) y.
  [[nodiscard]] static S weighted(const S& weight, const S& error, const S& measured) noexcept {
    const MaskOf<S> whole = weight == 1;
    if (all_of(whole)) return error;
    return select(whole, error, S(weight * error - (1 - weight) * measured));
  }

  void remember(const Input& in, double period) noexcept {
    if (period > 0) {
      last_error_ = in.error;
      last_measured_ = in.measured;
    }
    begun_ = mask_of<S>(true);
    gap_ = mask_of<S>(false);
  }

  /// The output where a sum of terms is no number: of inputs that are none, or of an overflow.
  /// @param sum  of the terms, which stays where it is finite
  [[nodiscard, gnu::cold, gnu::noinline]] S overflown(const Gains& g, const Input& in, S rate,
                                                      const S& sum, double period) noexcept {
    if (!in.rate_is_measured || g.derivative_of != DerivativeOf::measured_velocity) {
      replace_where(!is_finite(rate), rate, rate_);
    }
    const S& b = g.position_weight;
    const S measured = select(b == 1, S(0), bounded(1 - b, in.measured - origin_));
    const S bounded_sum = bounded(g.proportional, bounded(b, in.error) - measured) +
                          bounded(1, integral_) + bounded(g.derivative, rate) +
                          bounded(g.velocity_feedforward, in.velocity_reference) +
                          bounded(g.acceleration_feedforward, in.acceleration_reference);
    const auto usual = is_finite(sum);
    const S output = select(usual, sum, bounded_sum);
    const S within = clamp(output, g.output_clamp_min, g.output_clamp_max);
    limit_windup(g, output - within);

    const auto has_error = is_finite(in.error), has_value = is_finite(in.measured);
    const MaskOf<S> known = usual | (has_error & has_value), begun = begun_;
    Input last = in;
    replace_where(!known, last.error, last_error_);
    replace_where(!known, last.measured, last_measured_);
    remember(last, period);
    gap_ = begun & !known;
    begun_ = begun | known;
    return within;
  }

  [[nodiscard]] S rate_of(const Gains& g, const Input& in, double period,
                          double turn) const noexcept {
    if (in.rate_is_measured && g.derivative_of == DerivativeOf::measured_velocity) {
      return in.rate_error;
    }
    if (!(period > 0)) return rate_;
    const S weight = g.derivative_of == DerivativeOf::error ? g.velocity_weight : S(0);
    const S error = short_way(in.error - last_error_, turn);
    return select(gap_, rate_, weighted(weight, error, in.measured - last_measured_) / period);
  }

  [[nodiscard]] S filtered(const Gains& g, const S& rate, double period) noexcept {
    const S& time = g.derivative_filter_time;
    const MaskOf<S> filters = time > 0;
    S next = rate;
    if (any_of(filters)) {
      if (period > 0) {
        const MaskOf<S> goes_on = filters & begun_ & is_finite(rate);
        replace_where(goes_on, next, rate_ + period / (time + period) * (rate - rate_));
      } else {
        replace_where(filters, next, rate_);
      }
    }
    replace_where(is_finite(next), rate_, next);  // an overflow is not to be remembered
    return next;
  }

  /// A step that overflows is not taken.
  void set_integral(const Gains& g, S next) noexcept {
    next = clamp(next, g.integral_clamp_min, g.integral_clamp_max);
    replace_where(is_finite(next), integral_, next);
  }

  S integral_ = 0;           ///< I [output]
  S previous_integral_ = 0;  ///< I before the last step [output]
  S rate_ = 0;               ///< D
  S last_error_ = 0;
  S last_measured_ = 0;
  S origin_ = 0;                         ///< y at the start
  MaskOf<S> begun_ = mask_of<S>(false);  ///< there was a good input since the start
  MaskOf<S> gap_ = mask_of<S>(false);    ///< the last one was no number: differences tell nothing
  double period_ = 0;                    ///< dt of the last update [s]
};

/// The PID law of one joint of one robot.
using JointPid = BasicJointPid<double>;

}  // namespace articula
