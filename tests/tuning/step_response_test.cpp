// SPDX-License-Identifier: Apache-2.0
#include <articula/tuning/step_response.hpp>

#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "numbers.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::infinity;
using support::not_a_number;

namespace {

// Half a period of delay at 10 rad/s and 10 us is a phase of 5e-5 rad; metrics change by as much.
constexpr double period = 1e-5;     // [s]
constexpr double tolerance = 2e-4;  // share of the step, or [s] of about one second

/// Damping ratio 0.5 and natural frequency 10 rad/s, whoever gives the damping.
struct Case {
  JointPlant plant;
  PidGains gains;
};
const Case by_controller{{.inertia = 2}, {.proportional = 200, .derivative = 20}};
const Case by_plant{{.inertia = 2, .time_constant = 0.1}, {.proportional = 200}};

}  // namespace

TEST_CASE("a second-order loop has the step metrics of the textbook") {
  for (const auto& [plant, gains] : {by_controller, by_plant}) {
    const StepMetrics metrics =
        step_metrics(plant, gains, {.height = -0.3, .duration = 3, .period = period});
    const double overshoot = std::exp(-std::numbers::pi * 0.5 / std::sqrt(0.75));
    CHECK(metrics.overshoot().value() == Approx(overshoot).margin(tolerance));
    CHECK(metrics.peak().value() == Approx(-0.3 * (1 + overshoot)).margin(tolerance));
    CHECK(metrics.peak_time().value() ==
          Approx(std::numbers::pi / 10 / std::sqrt(0.75)).margin(1e-3));  // flat at the peak
    // The response crosses 0.1 at w t = 0.48823 and 0.9 at 2.12580, and is in the band of 2 % for
    // good from 8.07634 on.
    CHECK(metrics.rise_time().value() == Approx(0.163757).margin(tolerance));
    CHECK(metrics.settling_time().value() == Approx(0.807634).margin(tolerance));
    CHECK(std::abs(metrics.steady_error().value()) < 1e-6);  // 0.3 exp(-5 * 3) = 1e-7
  }
}

TEST_CASE("a derivative of the error adds a zero, as in loops that are drawn with unity feedback") {
  // y/r = (d s + p)/(I s^2 + d s + p): y = 1 - exp(-5 t) (cos(b t) - 5/b sin(b t)), b = sqrt(75).
  auto [plant, gains] = by_controller;
  gains.derivative_of = DerivativeOf::error;
  const double b = std::sqrt(75.0);
  double highest = 0;
  for (double t = 0; t < 1; t += 1e-5) {
    highest = std::max(highest, 1 - std::exp(-5 * t) * (std::cos(b * t) - 5 / b * std::sin(b * t)));
  }
  const StepMetrics metrics = step_metrics(plant, gains, {.duration = 3, .period = period});
  CHECK(metrics.overshoot().value() == Approx(highest - 1).margin(2 * tolerance));
}

TEST_CASE("between two commands the joint moves as its differential equation says") {
  // At t, constant effort u from rest: v = (u/I) T (1 - e^(-t/T)), q = (u/I) T (t - T (1 -
  // e^(-t/T))).
  for (const long double time_constant : {1e-6L, 1e-3L, 0.1L, 1.0L, 1e3L, 1e7L, 1e12L}) {
    const JointPlant plant{.inertia = 3, .time_constant = static_cast<double>(time_constant)};
    for (const double step : {1e-5, 1e-3, 0.1}) {
      CAPTURE(plant.time_constant, step);
      const detail::HeldEffort held(plant, step);
      double reached = 0, speed = 0;
      for (int k = 0; k < 100; ++k) held.advance(reached, speed, 6);
      const long double t = 100 * static_cast<long double>(step), x = t / time_constant;
      // x - (1 - e^-x), by its series where it cancels: the next term is x/6 of the last one here.
      const long double rest = x < 1e-4L ? x * x / 2 - x * x * x / 6 : x + std::expm1(-x);
      const double velocity = static_cast<double>(-2 * time_constant * std::expm1(-x));
      const double position = static_cast<double>(2 * time_constant * time_constant * rest);
      CHECK(speed == Approx(velocity).epsilon(1e-12));   // a hundred steps
      CHECK(reached == Approx(position).epsilon(1e-8));  // x^4/24 of x^2/2 at x = 1e-4
    }
  }
  const detail::HeldEffort undamped({.inertia = 3}, 0.1);
  double reached = 0, speed = 0;
  for (int k = 0; k < 100; ++k) undamped.advance(reached, speed, 6);
  CHECK(speed == Approx(20).epsilon(1e-13));
  CHECK(reached == Approx(100).epsilon(1e-13));
}

TEST_CASE("a drive at its limit gives a constant acceleration") {
  // So much gain that the effort is at its limit until the target is reached: q = L t^2/(2 I).
  const JointPlant plant{.inertia = 2};
  const PidGains gains{.proportional = 1e9};
  const StepMetrics metrics =
      step_metrics(plant, gains, {.height = 0.5, .period = period, .effort_limit = 4});
  CHECK(metrics.rise_time().value() ==
        Approx(std::sqrt(1.8 * 2 * 0.5 / 4) - std::sqrt(0.2 * 2 * 0.5 / 4)).margin(tolerance));
  PidGains clamped = gains;
  clamped.output_clamp_min = -4;
  clamped.output_clamp_max = 4;
  CHECK(step_metrics(plant, clamped, {.height = 0.5, .period = period}).rise_time() ==
        metrics.rise_time());
}

TEST_CASE("sampling too slowly is seen") {
  // Held for h, a damping d changes the velocity by the factor 1 - d h/I: it must be above -1.
  const JointPlant wrist{.inertia = 0.000526462289415};
  const PidGains lab{.proportional = 1000, .integral = 0.01, .derivative = 10};
  CHECK_FALSE(step_metrics(wrist, lab, {.period = 1e-3}).settling_time());
  CHECK_FALSE(step_metrics(wrist, lab, {.period = 1.06e-4}).settling_time());
  CHECK(step_metrics(wrist, lab, {.period = 1.03e-4}).settling_time());
}

TEST_CASE("a motion that overflows leaves no metrics") {
  const StepMetrics metrics =
      step_metrics({.inertia = 1e-9}, {.proportional = 1, .derivative = 1}, {.period = 1});
  const StepMetrics longer = step_metrics({.inertia = 1e-9}, {.proportional = 1, .derivative = 1},
                                          {.duration = 100, .period = 1});
  CHECK(metrics.peak());
  CHECK_FALSE(longer.peak());
  CHECK_FALSE(longer.overshoot());
  CHECK_FALSE(longer.steady_error());
}

TEST_CASE("steps of nonsense are refused by name and value") {
  const auto& [plant, gains] = by_controller;
  for (double bad : {0.0, -1.0, infinity, not_a_number}) {
    CAPTURE(bad);
    CHECK_THROWS_WITH(step_metrics(plant, gains, {.duration = bad}), Contains("duration"));
    CHECK_THROWS_WITH(step_metrics(plant, gains, {.period = bad}), Contains("period"));
    CHECK_THROWS_WITH(step_metrics(plant, gains, {.band = bad}), Contains("band"));
    CHECK_THROWS_WITH(step_metrics({.inertia = bad}, gains), Contains("inertia"));
  }
  for (double bad : {0.0, -1.0, -infinity, not_a_number}) {
    CHECK_THROWS_WITH(step_metrics(plant, gains, {.effort_limit = bad}), Contains("effort_limit"));
  }
  for (double bad : {infinity, not_a_number}) {
    CHECK_THROWS_AS(step_metrics(plant, gains, {.height = bad}), std::invalid_argument);
    CHECK_THROWS_WITH(step_metrics(plant, {.proportional = bad}), Contains("proportional"));
  }
  CHECK_THROWS_WITH(step_metrics(plant, gains, {.duration = 1e9}), Contains("duration 1e+09"));
  CHECK_FALSE(step_metrics(plant, gains, {.height = 0}).overshoot());  // no step, no metrics
}
