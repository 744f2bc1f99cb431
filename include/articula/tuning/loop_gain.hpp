// SPDX-License-Identifier: Apache-2.0
/// @file The frequency response of a joint under a PID.
#pragma once

#include "articula/control/laws/pid_gains.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/tuning/joint_plant.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string_view>

namespace articula {

/// The loop gain of a joint under a PID, from error to position:
///
///     L(s) = C(s) P(s) exp(-s delay),   C(s) = p + i/s + d s/(1 + T_f s).
///
/// It holds within the clamps. It does not depend on the weights of the reference, b and c, nor on
/// the choice of the derivative. T_f is derivative_filter_time.
/// Source: [Åström, Murray 2021, sections 10.1 and 11.1].
class LoopGain {
 public:
  /// @param plant  the joint
  /// @param gains  of the PID; p, i, d >= 0, at least one of them > 0
  /// @param delay  from measurement to effort [s], >= 0: half a period for an effort that is held
  ///               for a period, and the time that its computation takes
  /// @throws std::invalid_argument naming the parameter and its value
  /// Real-time: no (set-up).
  LoopGain(const JointPlant& plant, const PidGains& gains, double delay = 0)
      : plant_(plant), delay_(delay), filter_time_(gains.derivative_filter_time) {
    validate(plant);
    const auto check = [](std::string_view what, const double& value) {
      if (is_finite(value) && value >= 0) return;
      detail::refuse({"loop gain: ", what, " ", value, " is not a finite number >= 0"});
    };
    check("proportional", gains.proportional);
    check("integral", gains.integral);
    check("derivative", gains.derivative);
    check("derivative_filter_time", gains.derivative_filter_time);
    check("delay", delay);
    if (gains.proportional == 0 && gains.integral == 0 && gains.derivative == 0) {
      detail::refuse({"loop gain: proportional, integral and derivative are all 0"});
    }
    // C(s) = (n0 + n1 s + n2 s^2) / (s (1 + T_f s))
    numerator_ = {gains.integral, gains.proportional + gains.integral * filter_time_,
                  gains.derivative + gains.proportional * filter_time_};
  }

  /// |L|. Real-time: no.
  /// @param frequency  w [rad/s], > 0
  [[nodiscard]] double magnitude(double frequency) const {
    const double w = frequency;
    const auto& [n0, n1, n2] = numerator_;
    return std::hypot(n1, n0 / w - n2 * w) / plant_.inertia / w /
           std::hypot(w, plant_.decay_rate()) / std::hypot(1.0, filter_time_ * w);
  }

  /// The phase of L [rad], continuous in the frequency. With an integral term it starts at -pi, or
  /// at -3 pi/2 without damping. Real-time: no.
  /// @param frequency  w [rad/s], > 0
  [[nodiscard]] double phase(double frequency) const {
    const double w = frequency;
    const auto& [n0, n1, n2] = numerator_;
    return std::atan2(n1, n0 / w - n2 * w) - std::numbers::pi - std::atan2(w, plant_.decay_rate()) -
           std::atan(filter_time_ * w) - delay_ * w;
  }

  /// L(j w). Real-time: no.
  /// @param frequency  w [rad/s], > 0
  [[nodiscard]] std::complex<double> operator()(double frequency) const {
    return std::polar(magnitude(frequency), phase(frequency));
  }

  [[nodiscard]] const JointPlant& plant() const noexcept { return plant_; }
  [[nodiscard]] double delay() const noexcept { return delay_; }
  [[nodiscard]] double filter_time() const noexcept { return filter_time_; }
  /// n0, n1, n2 of C(s) = (n0 + n1 s + n2 s^2) / (s (1 + T_f s)).
  [[nodiscard]] const std::array<double, 3>& numerator() const noexcept { return numerator_; }

 private:
  JointPlant plant_;
  double delay_;
  double filter_time_;
  std::array<double, 3> numerator_{};
};

}  // namespace articula
