// SPDX-License-Identifier: Apache-2.0
#include <articula/tuning/step_metrics.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include "catch.hpp"
#include "numbers.hpp"

using articula::StepMetrics;
using Catch::Matchers::Contains;
using support::infinity;
using support::not_a_number;

namespace {

constexpr double period = 1e-3;  // [s]
// Samples are joined by straight lines: with |x''| <= 100 1/s^2 that is off by at most
// 100 period^2 / 8 = 1.3e-5, and crossings by that over their slope, above 0.13 1/s here.
constexpr double time_tolerance = 1e-4;  // [s]

/// Metrics of share(t), the response to a unit step, scaled to a step from `start` to `target`.
template <class Share>
StepMetrics observe(double start, double target, double duration, const Share& share) {
  StepMetrics metrics(start, target);
  for (int k = 0; k * period <= duration; ++k) {
    metrics.add(k * period, start + (target - start) * share(k * period));
  }
  return metrics;
}

double first_order(double t) { return 1 - std::exp(-t / 0.1); }

/// Damping ratio 0.5, natural frequency 10 rad/s.
double second_order(double t) {
  const double s = std::sqrt(0.75);
  return 1 - std::exp(-5 * t) * (std::cos(10 * s * t) + 0.5 / s * std::sin(10 * s * t));
}

}  // namespace

TEST_CASE("a first-order response rises in T ln 9, settles in T ln 50 and does not overshoot") {
  const StepMetrics metrics = observe(0, 1, 2, first_order);
  CHECK(metrics.rise_time().value() == Approx(0.1 * std::log(9)).margin(time_tolerance));
  CHECK(metrics.settling_time().value() == Approx(0.1 * std::log(50)).margin(time_tolerance));
  CHECK(metrics.overshoot().value() == 0);
}

TEST_CASE("a second-order response overshoots by exp(-pi zeta / sqrt(1 - zeta^2))") {
  const StepMetrics metrics = observe(0, 1, 3, second_order);
  const double expected = std::exp(-std::numbers::pi * 0.5 / std::sqrt(0.75));
  CHECK(metrics.overshoot().value() == Approx(expected).margin(2e-5));
  // The response crosses 0.1 at w t = 0.48823 and 0.9 at 2.12580, and is in the band of 2 % for
  // good from 8.07634 on.
  CHECK(metrics.rise_time().value() == Approx(0.163757).margin(time_tolerance));
  CHECK(metrics.settling_time().value() == Approx(0.807634).margin(time_tolerance));
}

TEST_CASE("metrics do not depend on where a step begins, how high it is and which way it goes") {
  const StepMetrics unit = observe(0, 1, 3, second_order);
  const StepMetrics down = observe(0.01, -1.5, 3, second_order);
  CHECK(down.rise_time().value() == Approx(unit.rise_time().value()));
  CHECK(down.overshoot().value() == Approx(unit.overshoot().value()));
  CHECK(down.settling_time().value() == Approx(unit.settling_time().value()));
}

TEST_CASE("settling time counts from the step, not from time 0") {
  StepMetrics metrics(0, 1);
  metrics.add(5.0, 0);
  metrics.add(6.0, 1);
  CHECK(metrics.settling_time().value() == Approx(0.98));
  CHECK(metrics.rise_time().value() == Approx(0.8));
}

TEST_CASE(
    "a response that comes into the band from above settles where it crosses the upper edge") {
  StepMetrics metrics(0, 1);
  metrics.add(0, 0);
  metrics.add(1, 1.5);
  metrics.add(2, 1);
  CHECK(metrics.settling_time().value() == Approx(1.96));  // at 1.02
}

TEST_CASE("a response that leaves the band again has not settled") {
  StepMetrics metrics(0, 1);
  for (double share : {0.0, 1.0, 1.0, 1.5}) metrics.add(share, share);
  CHECK(metrics.rise_time());
  CHECK_FALSE(metrics.settling_time());
}

TEST_CASE("what does not arrive has neither rise time nor overshoot nor settling time") {
  for (double height : {0.0, 0.5, -3.0}) {
    const StepMetrics metrics = observe(0, 1, 1, [&](double t) { return height * t; });
    CHECK_FALSE(metrics.rise_time());
    CHECK_FALSE(metrics.overshoot());
    CHECK_FALSE(metrics.settling_time());
  }
}

TEST_CASE("without a step nothing is defined") {
  const StepMetrics metrics = observe(0.3, 0.3, 1, first_order);
  CHECK_FALSE(metrics.rise_time());
  CHECK_FALSE(metrics.overshoot());
  CHECK_FALSE(metrics.settling_time());
  CHECK_FALSE(StepMetrics(0, 1).rise_time());
}

TEST_CASE("the peak and what remains are in the unit of the position") {
  StepMetrics metrics(1, -1);
  for (double share : {0.0, 0.5, 1.25, 1.1, 0.95}) metrics.add(10 + share, 1 - 2 * share);
  // Earlier than the sample before: the list above goes back in time.
  CHECK_FALSE(metrics.peak());

  StepMetrics ordered(1, -1);
  double time = 10;
  for (double share : {0.0, 0.5, 1.25, 1.1, 0.95}) ordered.add(time++, 1 - 2 * share);
  CHECK(ordered.peak().value() == Approx(-1.5));
  CHECK(ordered.peak_time().value() == 2);
  CHECK(ordered.overshoot().value() == Approx(0.25));
  CHECK(ordered.steady_error().value() == Approx(-0.1));  // it is at -0.9
}

TEST_CASE("the band of the settling time can be chosen") {
  StepMetrics wide(0, 1, 0.05), narrow(0, 1, 0.01);
  for (int k = 0; k <= 2000; ++k) {
    wide.add(k * period, first_order(k * period));
    narrow.add(k * period, first_order(k * period));
  }
  CHECK(wide.settling_time().value() == Approx(0.1 * std::log(20)).margin(time_tolerance));
  CHECK(narrow.settling_time().value() == Approx(0.1 * std::log(100)).margin(time_tolerance));
}

TEST_CASE("a sample that is not finite or goes back in time leaves nothing defined") {
  struct Sample {
    double time, position;
  };
  for (const Sample bad : {Sample{0.5, not_a_number}, Sample{0.5, infinity}, Sample{0.5, -infinity},
                           Sample{not_a_number, 0.5}, Sample{infinity, 0.5}, Sample{-1, 0.5}}) {
    CAPTURE(bad.time, bad.position);
    StepMetrics metrics(0, 1);
    metrics.add(0, 0);
    metrics.add(0.1, 1);
    CHECK(metrics.settling_time());
    metrics.add(bad.time, bad.position);
    metrics.add(2, 1);
    CHECK_FALSE(metrics.rise_time());
    CHECK_FALSE(metrics.overshoot());
    CHECK_FALSE(metrics.peak());
    CHECK_FALSE(metrics.peak_time());
    CHECK_FALSE(metrics.settling_time());
    CHECK_FALSE(metrics.steady_error());
  }
}

TEST_CASE("steps and bands that make no sense are refused by name and value") {
  constexpr double huge = std::numeric_limits<double>::max();
  CHECK_THROWS_WITH(StepMetrics(not_a_number, 1), Contains("nan to 1"));
  CHECK_THROWS_WITH(StepMetrics(0, infinity), Contains("0 to inf"));
  CHECK_THROWS_AS(StepMetrics(-huge, huge), std::invalid_argument);
  for (double band : {0.0, -0.1, 1.0, not_a_number, infinity}) {
    CAPTURE(band);
    CHECK_THROWS_WITH(StepMetrics(0, 1, band), Contains("band"));
  }
}
