// SPDX-License-Identifier: Apache-2.0
/// @file Functions of time that excite or move a joint: step, ramp, sine, square, chirp.
#pragma once

#include "articula/core/finite.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <string_view>
#include <variant>

namespace articula {

/// A signal at one moment. Its unit depends on the quantity that it drives: rad or m for a
/// position, N m or N for an effort.
struct SignalValue {
  double value = 0;         ///< [unit]
  double rate = 0;          ///< first derivative [unit/s]
  double acceleration = 0;  ///< second derivative [unit/s^2]
};

/// True if all members are finite. Real-time: yes.
[[nodiscard]] inline bool is_finite(const SignalValue& x) noexcept {
  return is_finite(x.value) && is_finite(x.rate) && is_finite(x.acceleration);
}

namespace detail {

[[nodiscard]] inline bool are_finite(std::initializer_list<double> values) noexcept {
  return std::all_of(values.begin(), values.end(), [](double x) { return is_finite(x); });
}

inline constexpr std::string_view not_finite = "a member is not a finite number";

}  // namespace detail

// Each signal has these functions, all `Real-time: yes`:
//
// - `sample(time)`: the value and its derivatives at a time [s];
// - `peak()`: bounds of their absolute values;
// - `fault()`: why the signal cannot be evaluated; empty if it can.

/// x(t) = height from `start` on, 0 before.
struct StepSignal {
  double height = 0;  ///< [unit]
  double start = 0;   ///< [s]

  [[nodiscard]] SignalValue sample(double time) const noexcept {
    return {time < start ? 0 : height};
  }
  [[nodiscard]] SignalValue peak() const noexcept { return {std::abs(height)}; }
  [[nodiscard]] std::string_view fault() const noexcept {
    return detail::are_finite({height, start}) ? "" : detail::not_finite;
  }
};

/// A straight line from 0 to `height`, constant before and after it.
struct RampSignal {
  double height = 0;    ///< [unit]
  double duration = 1;  ///< [s], > 0
  double start = 0;     ///< [s]

  [[nodiscard]] SignalValue sample(double time) const noexcept {
    const double share = (time - start) / duration;
    if (share <= 0) return {};
    if (share >= 1) return {height};
    return {height * share, height / duration};
  }
  [[nodiscard]] SignalValue peak() const noexcept {
    return {std::abs(height), std::abs(height / duration)};
  }
  [[nodiscard]] std::string_view fault() const noexcept {
    if (!detail::are_finite({height, duration, start})) return detail::not_finite;
    if (!(duration > 0)) return "the duration is not positive";
    return is_finite(height / duration) ? "" : "the slope is infinite";
  }
};

/// x(t) = offset + amplitude sin(2 pi frequency t + phase), at all times.
struct SineSignal {
  double amplitude = 0;  ///< [unit]
  double frequency = 0;  ///< [Hz]
  double phase = 0;      ///< [rad]
  double offset = 0;     ///< [unit]

  /// Whole turns are removed first, so that the value is as exact after a year as at the start.
  [[nodiscard]] SignalValue sample(double time) const noexcept {
    const double turns = frequency * time, omega = 2 * std::numbers::pi * frequency;
    const double angle = 2 * std::numbers::pi * (turns - std::floor(turns)) + phase;
    const double sine = amplitude * std::sin(angle);
    return {offset + sine, amplitude * omega * std::cos(angle), -sine * omega * omega};
  }
  [[nodiscard]] SignalValue peak() const noexcept {
    const double omega = 2 * std::numbers::pi * std::abs(frequency), size = std::abs(amplitude);
    return {std::abs(offset) + size, size * omega, size * omega * omega};
  }
  [[nodiscard]] std::string_view fault() const noexcept {
    if (!detail::are_finite({amplitude, frequency, phase, offset})) return detail::not_finite;
    return is_finite(peak()) ? ""
                             : "the sum of amplitude and offset or the acceleration is infinite";
  }
};

/// x(t) = offset + amplitude in the first half of each period, offset - amplitude in the second, at
/// all times. The first half is where the sine of the same frequency and phase is positive. The
/// value jumps.
struct SquareSignal {
  double amplitude = 0;  ///< [unit]
  double frequency = 0;  ///< [Hz]
  double phase = 0;      ///< [rad]
  double offset = 0;     ///< [unit]

  [[nodiscard]] SignalValue sample(double time) const noexcept {
    const double shift = phase / (2 * std::numbers::pi);
    const double turns = frequency * time + shift - std::floor(shift);
    // The time of an edge is often a product of rounded numbers. A time that close to an edge
    // counts as the edge, so that all halves have the same number of cycles.
    const double rounding = 4 * std::numeric_limits<double>::epsilon() * (1 + std::abs(turns));
    const double share = turns + rounding - std::floor(turns + rounding);
    return {offset + (share < 0.5 ? amplitude : -amplitude)};
  }
  [[nodiscard]] SignalValue peak() const noexcept {
    return {std::abs(offset) + std::abs(amplitude)};
  }
  [[nodiscard]] std::string_view fault() const noexcept {
    if (!detail::are_finite({amplitude, frequency, phase, offset})) return detail::not_finite;
    return is_finite(peak()) ? "" : "the sum of amplitude and offset is infinite";
  }
};

/// A sine whose frequency grows (or falls) exponentially, a logarithmic sweep [Farina 2000]: with
/// t from the start, w1 = 2 pi first_frequency, k = ln(last_frequency / first_frequency)/duration,
///
///     x(t) = amplitude sin((w1/k) (exp(k t) - 1)).
///
/// After `duration`, the last frequency continues to the next zero of the sine. Then x stays 0, so
/// that no effort remains. x does not jump. Its rate, the velocity of a position, jumps by
/// amplitude w1 at the start, and by 2 pi amplitude last_frequency at the end.
struct ChirpSignal {
  double amplitude = 0;        ///< [unit]
  double first_frequency = 1;  ///< [Hz], > 0
  double last_frequency = 1;   ///< [Hz], > 0
  double duration = 1;         ///< [s], > 0
  double start = 0;            ///< [s]

  [[nodiscard]] SignalValue sample(double time) const noexcept {
    const double t = time - start;
    if (t < 0) return {};
    const double growth = std::log(last_frequency / first_frequency) / duration;
    double angle = angle_at(std::min(t, duration), growth), slope = growth;
    double omega = 2 * std::numbers::pi * first_frequency * std::exp(growth * t);
    if (t > duration) {
      const double zero = std::numbers::pi * std::ceil(angle / std::numbers::pi);
      omega = 2 * std::numbers::pi * last_frequency;
      slope = 0;
      angle += omega * (t - duration);
      if (angle >= zero) return {};
    }
    const double sine = amplitude * std::sin(angle), cosine = amplitude * std::cos(angle);
    return {sine, omega * cosine, slope * omega * cosine - omega * omega * sine};
  }
  [[nodiscard]] SignalValue peak() const noexcept {
    const double omega = 2 * std::numbers::pi * std::max(first_frequency, last_frequency);
    const double growth = std::abs(std::log(last_frequency / first_frequency)) / duration;
    const double size = std::abs(amplitude);
    return {size, size * omega, size * omega * (growth + omega)};
  }
  [[nodiscard]] std::string_view fault() const noexcept {
    if (!detail::are_finite({amplitude, first_frequency, last_frequency, duration, start})) {
      return detail::not_finite;
    }
    if (!(first_frequency > 0) || !(last_frequency > 0)) return "a frequency is not positive";
    if (!(duration > 0)) return "the duration is not positive";
    const double omega = 2 * std::numbers::pi * std::max(first_frequency, last_frequency);
    const bool moderate = is_finite(peak()) && is_finite(omega * omega) &&
                          is_finite(omega * duration) &&
                          is_finite(std::log(last_frequency / first_frequency) / duration);
    return moderate ? "" : "the acceleration or the number of turns is infinite";
  }

 private:
  /// (w1/k) (exp(k t) - 1), and its limit w1 t where both frequencies are the same.
  [[nodiscard]] double angle_at(double t, double growth) const noexcept {
    const double omega = 2 * std::numbers::pi * first_frequency;
    return growth == 0 ? omega * t : omega * std::expm1(growth * t) / growth;
  }
};

/// A signal of any kind.
using Signal = std::variant<StepSignal, RampSignal, SineSignal, ChirpSignal, SquareSignal>;

}  // namespace articula
