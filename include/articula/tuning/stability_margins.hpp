// SPDX-License-Identifier: Apache-2.0
/// @file Gain, phase and delay margins of a control loop.
#pragma once

#include "articula/tuning/loop_gain.hpp"
#include "articula/tuning/polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace articula {

/// A frequency at which |L| = 1.
struct Crossover {
  double frequency = 0;     ///< w [rad/s]
  double phase_margin = 0;  ///< pi + phase of L(j w) [rad]
};

/// The margins of a control loop. A margin without limit is infinite.
struct StabilityMargins {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  bool stable = false;                ///< the closed loop is asymptotically stable
  std::vector<Crossover> crossovers;  ///< all, in ascending order
  double phase_margin = infinity;     ///< that of the crossover with the smallest [rad]
  /// A stable loop stays stable if all gains are multiplied by a factor between these two [1].
  double gain_margin = 1, gain_reduction_margin = 1;
  /// A stable loop stays stable if less than this is added to its delay [s]. Unstable: 0.
  double delay_margin = 0;
};

namespace detail {

/// A loop gain in units in which its crossovers are near 1, so that its polynomials neither
/// overflow nor underflow.
class ScaledLoop {
 public:
  explicit ScaledLoop(const LoopGain& loop) {
    const double inertia = loop.plant().inertia, rate = loop.plant().decay_rate();
    const auto& n = loop.numerator();
    const double g0 = n[0] / inertia, g1 = n[1] / inertia, g2 = n[2] / inertia;
    // The frequency at which |L| = 1 for one term of C alone, with the inertia or the damping
    // alone.
    unit_ = std::max({g2, std::sqrt(g1), std::cbrt(g0)});
    if (rate > unit_) unit_ = std::max(g1 / rate, std::sqrt(g0 / rate));
    if (!(unit_ > 0)) unit_ = rate;  // a derivative alone
    n0_ = g0 / unit_ / unit_ / unit_;
    n1_ = g1 / unit_ / unit_;
    n2_ = g2 / unit_;
    rate_ = rate / unit_;
    filter_ = loop.filter_time() * unit_;
    delay_ = loop.delay() * unit_;
    for (const double& x : {unit_, n0_, n1_, n2_, rate_, filter_, delay_}) require_moderate(x);
    // With x = w^2: |L|^2 = n / (x^2 a b)
    n_ = {{n0_ * n0_, n1_ * n1_ - 2 * n0_ * n2_, n2_ * n2_}};
    a_ = {{rate_ * rate_, 1}};
    b_ = {{1, filter_ * filter_}};
  }

  /// The loop's unit of frequency [rad/s].
  [[nodiscard]] double unit() const { return unit_; }

  /// The squares of the frequencies at which |L| = 1.
  [[nodiscard]] std::vector<double> crossovers() const {
    return positive_roots(x_ * x_ * a_ * b_ - n_);
  }

  /// Checks the crossovers: |L| is 1 there, and their number is odd if |L| falls from infinity to
  /// 0.
  /// @throws std::invalid_argument if not, because the gains are too far apart for the precision
  void require_found(const LoopGain& loop, const std::vector<double>& squares) const {
    const auto& n = loop.numerator();
    bool good = squares.size() % 2 == 1 || (n[0] == 0 && n[1] == 0);
    for (const double x : squares) {
      good = good && std::abs(loop.magnitude(unit_ * std::sqrt(x)) - 1) < 1e-6;
    }
    require_moderate(good ? 0 : StabilityMargins::infinity);
  }

  /// The squares of the frequencies at which |L| or the phase has an extremum. Between two of them
  /// both are monotone.
  [[nodiscard]] std::vector<double> turns() const {
    // |L|^2 = n / m
    const Polynomial m = x_ * x_ * a_ * b_;
    std::vector<double> all = positive_roots(n_.derivative() * m - n_ * m.derivative());
    // d phase/dw = n1 (n0 + n2 x)/n - rate/a - filter/b - delay
    const Polynomial slope = Polynomial{{n1_ * n0_, n1_ * n2_}} * a_ * b_ -
                             Polynomial{{rate_}} * n_ * b_ - Polynomial{{filter_}} * n_ * a_ -
                             Polynomial{{delay_}} * n_ * a_ * b_;
    for (const double x : positive_roots(slope)) all.push_back(x);
    return all;
  }

  /// Whether the closed loop without delay is stable. It applies the conditions of Hurwitz to s^2
  /// (s + rate) (1 + filter s) + n0 + n1 s + n2 s^2, divided by s if there is no integral term.
  [[nodiscard]] bool stable_without_delay() const {
    std::vector<double> c{n0_, n1_, rate_ + n2_, 1 + rate_ * filter_, filter_};
    if (n0_ == 0) c.erase(c.begin());
    while (c.back() == 0) c.pop_back();
    if (std::any_of(c.begin(), c.end(), [](double k) { return !(k > 0); })) return false;
    if (c.size() <= 3) return true;
    const double minor = c[2] * c[1] - c[3] * c[0];
    return c.size() == 4 ? minor > 0 : c[3] * minor > c[4] * c[1] * c[1];
  }

  /// The phase of L at frequency infinity without delay [rad].
  [[nodiscard]] double last_phase() const {
    constexpr double quarter = std::numbers::pi / 2;
    const double lead = n2_ > 0 ? 2 * quarter : n1_ > 0 ? quarter : 0;
    return lead - 3 * quarter - (filter_ > 0 ? quarter : 0);
  }

 private:
  double unit_ = 1, n0_ = 0, n1_ = 0, n2_ = 0, rate_ = 0, filter_ = 0, delay_ = 0;
  Polynomial n_, a_, b_, x_{{0, 1}};
};

/// The first and the last frequency within an interval at which the phase is an odd multiple of pi.
/// @param low, high  the interval, in which the phase is monotone; `high` may be infinite
[[nodiscard]] inline std::vector<double> phase_crossings(const LoopGain& loop,
                                                         const ScaledLoop& scaled, double low,
                                                         double high) {
  const auto turns_of = [](double phase) { return -(phase / std::numbers::pi + 1) / 2; };
  const double from = turns_of(low > 0 ? loop.phase(low) : loop.phase(1e-300));
  const bool open = !is_finite(high);
  const double to = !open              ? turns_of(loop.phase(high))
                    : loop.delay() > 0 ? std::numeric_limits<double>::infinity()
                                       : turns_of(scaled.last_phase());
  const double first = std::floor(std::min(from, to)) + 1, last = std::ceil(std::max(from, to)) - 1;
  std::vector<double> found;
  const auto find = [&](double level) {
    const auto before = [&](double w) { return (turns_of(loop.phase(w)) < level) == (from < to); };
    double end = open ? std::max(2 * low, scaled.unit()) : high;
    while (open && before(end)) require_moderate(end *= 2);
    found.push_back(bisect(low, end, before));
  };
  if (first <= last) {
    find(first);
    if (is_finite(last) && last != first) find(last);
  }
  return found;
}

}  // namespace detail

/// The margins of a loop, without a grid of frequencies. Crossovers are roots of a polynomial in
/// w^2. Between these and the extrema of |L| and of the phase, bisection finds each frequency at
/// which the phase is an odd multiple of pi.
///
/// A loop with delay counts as stable if it is stable without delay and its delay is less than the
/// first that makes it unstable. Longer delays can make a loop with three crossovers stable again;
/// such a loop counts as unstable. A phase margin below 1e-9 rad, the precision of the phase at a
/// crossover, counts as 0.
/// Source: [Åström, Murray 2021, section 10.3].
/// @param loop  joint, gains and delay
/// @throws std::invalid_argument if products of gains, inertia and delay overflow or underflow
/// Real-time: no (set-up; allocates).
[[nodiscard]] inline StabilityMargins stability_margins(const LoopGain& loop) {
  const detail::ScaledLoop scaled(loop);
  StabilityMargins margins;
  double longest = StabilityMargins::infinity;  // delay at the limit of stability
  const std::vector<double> crossovers = scaled.crossovers();
  scaled.require_found(loop, crossovers);
  for (const double x : crossovers) {
    const double w = scaled.unit() * std::sqrt(x), margin = std::numbers::pi + loop.phase(w);
    margins.crossovers.push_back({w, margin});
    margins.phase_margin = std::min(margins.phase_margin, margin);
    const double turn = 2 * std::numbers::pi, whole = margin + w * loop.delay();
    const double lag = whole - turn * std::floor(whole / turn);
    longest = std::min(longest, std::abs(std::remainder(whole, turn)) < 1e-9 ? 0 : lag / w);
  }
  margins.stable = scaled.stable_without_delay() && loop.delay() < longest;
  if (!margins.stable) return margins;

  margins.delay_margin = longest - loop.delay();
  margins.gain_margin = StabilityMargins::infinity;
  margins.gain_reduction_margin = 0;
  std::vector<double> limits = scaled.turns();
  limits.insert(limits.end(), crossovers.begin(), crossovers.end());
  std::sort(limits.begin(), limits.end());
  limits.push_back(StabilityMargins::infinity);
  double low = 0;
  for (const double x : limits) {
    const double high = scaled.unit() * std::sqrt(x);
    for (const double w : detail::phase_crossings(loop, scaled, low, high)) {
      const double factor = 1 / loop.magnitude(w);
      if (factor > 1) margins.gain_margin = std::min(margins.gain_margin, factor);
      if (factor < 1)
        margins.gain_reduction_margin = std::max(margins.gain_reduction_margin, factor);
    }
    low = high;
  }
  return margins;
}

/// The margins of a joint under a PID. Parameters and errors are those of LoopGain.
/// Real-time: no (set-up; allocates).
[[nodiscard]] inline StabilityMargins stability_margins(const JointPlant& plant,
                                                        const PidGains& gains, double delay = 0) {
  return stability_margins(LoopGain(plant, gains, delay));
}

}  // namespace articula
