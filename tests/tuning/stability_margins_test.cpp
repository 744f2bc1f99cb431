// SPDX-License-Identifier: Apache-2.0
#include <articula/robots/q2d.hpp>
#include <articula/tuning/stability_margins.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using std::numbers::pi;
using support::infinity;
using support::not_a_number;

namespace {

constexpr double degree = pi / 180;

/// L(j w) by complex arithmetic, from the transfer functions as they are written.
std::complex<double> by_formula(const JointPlant& plant, const PidGains& g, double delay,
                                double w) {
  const std::complex<double> s(0, w);
  const std::complex<double> c =
      g.proportional + g.integral / s + g.derivative * s / (1.0 + g.derivative_filter_time * s);
  return c / plant.inertia / (s * (s + plant.decay_rate())) * std::exp(-s * delay);
}

/// The largest real part of the closed loop's poles without delay: the roots of
/// s^3 + (1/T + d/I) s^2 + (p/I) s + i/I, without i divided by s, by simultaneous iteration from
/// points on no symmetry of the roots (Durand, Kerner).
double fastest_growth(const JointPlant& plant, const PidGains& g) {
  std::vector<double> c{g.integral / plant.inertia, g.proportional / plant.inertia,
                        plant.decay_rate() + g.derivative / plant.inertia, 1};
  if (c[0] == 0) c.erase(c.begin());
  std::vector<std::complex<double>> roots;
  for (std::size_t i = 0; i + 1 < c.size(); ++i) {
    roots.push_back(std::pow(std::complex<double>(4, 9), static_cast<double>(i)));
  }
  for (int k = 0; k < 500; ++k) {
    for (std::size_t i = 0; i < roots.size(); ++i) {
      std::complex<double> step = 0;
      for (std::size_t j = c.size(); j-- > 0;) step = step * roots[i] + c[j];
      for (std::size_t j = 0; j < roots.size(); ++j) {
        if (j != i) step /= roots[i] - roots[j];
      }
      roots[i] -= step;
    }
  }
  double growth = -infinity;
  for (const auto& root : roots) growth = std::max(growth, root.real());
  return growth;
}

struct JointLoop {
  JointPlant plant;
  PidGains gains;
};

/// Loops of moderate size, stable or not, with and without damping, filter and each of the gains.
JointLoop random_loop(support::Random& random) {
  JointLoop loop;
  loop.plant.inertia = random.number(0.1, 10);
  if (!random.one_in(4)) loop.plant.time_constant = random.number(0.05, 5);
  loop.gains.proportional = random.number(0.1, 100);
  if (!random.one_in(4)) loop.gains.integral = random.number(0.1, 300);
  if (!random.one_in(4)) loop.gains.derivative = random.number(0.01, 30);
  return loop;
}

}  // namespace

TEST_CASE("the course's gains have the margins that were computed elsewhere") {
  // With the course's inertias; the crossover is that which its gains were designed for.
  const JointPlant elbow{.inertia = 0.008201, .time_constant = 0.004};
  const JointPlant shoulder{.inertia = 0.087388, .time_constant = 0.005};
  const LoopGain elbow_loop(elbow, Q2d::pid_gains[1]), shoulder_loop(shoulder, Q2d::pid_gains[0]);
  const double elbow_crossover = 2 * pi / 0.004 / 10.97;
  const double shoulder_crossover = 2 * pi / 0.005 / 10.97;
  CHECK(elbow_loop.magnitude(elbow_crossover) == Approx(1.010).margin(1e-3));
  CHECK(shoulder_loop.magnitude(shoulder_crossover) == Approx(1.001).margin(5e-4));
  CHECK(180 + elbow_loop.phase(elbow_crossover) / degree == Approx(67.6).margin(0.05));
  CHECK(180 + shoulder_loop.phase(shoulder_crossover) / degree == Approx(60.0).margin(0.05));

  // At the crossover itself the elbow has a tenth of a degree less.
  const StabilityMargins margins = stability_margins(elbow_loop);
  CHECK(margins.stable);
  REQUIRE(margins.crossovers.size() == 1);
  CHECK(margins.phase_margin / degree == Approx(67.5).margin(0.05));
  CHECK(margins.gain_margin == infinity);
  CHECK(margins.delay_margin ==
        Approx(margins.phase_margin / margins.crossovers[0].frequency).epsilon(1e-12));
}

TEST_CASE("a PD on an undamped inertia has the margins of the closed form") {
  // |L| = 1: I^2 w^4 = p^2 + d^2 w^2; phase margin atan(d w/p).
  const double inertia = 0.5, p = 20, d = 3;
  const double u =
      (d * d + std::sqrt(d * d * d * d + 4 * inertia * inertia * p * p)) / (2 * inertia * inertia);
  const double w = std::sqrt(u), margin = std::atan(d * w / p);
  const JointPlant plant{.inertia = inertia};
  const PidGains gains{.proportional = p, .derivative = d};
  const StabilityMargins margins = stability_margins(plant, gains);
  REQUIRE(margins.crossovers.size() == 1);
  CHECK(margins.crossovers[0].frequency == Approx(w).epsilon(1e-13));
  CHECK(margins.phase_margin == Approx(margin).epsilon(1e-13));
  CHECK(margins.gain_margin == infinity);
  CHECK(margins.gain_reduction_margin == 0);
  CHECK(margins.delay_margin == Approx(margin / w).epsilon(1e-13));

  const StabilityMargins late = stability_margins(plant, gains, 0.4 * margin / w);
  CHECK(late.stable);
  CHECK(late.phase_margin == Approx(0.6 * margin).epsilon(1e-13));
  CHECK(late.delay_margin == Approx(0.6 * margin / w).epsilon(1e-13));
  CHECK_FALSE(stability_margins(plant, gains, 1.001 * margin / w).stable);
}

TEST_CASE("an integral on an undamped inertia must not be too fast") {
  // Hurwitz: d p > I i. All gains may shrink to I i/(d p).
  const JointPlant plant{.inertia = 0.5};
  PidGains gains{.proportional = 20, .integral = 40, .derivative = 3};
  const StabilityMargins margins = stability_margins(plant, gains);
  CHECK(margins.stable);
  CHECK(margins.gain_reduction_margin == Approx(0.5 * 40 / (3 * 20)).epsilon(1e-12));
  CHECK(margins.gain_margin == infinity);
  gains.integral = 119;
  CHECK(stability_margins(plant, gains).stable);
  gains.integral = 121;
  const StabilityMargins unstable = stability_margins(plant, gains);
  CHECK_FALSE(unstable.stable);
  CHECK(unstable.phase_margin < 0);
  CHECK(unstable.gain_margin == 1);
  CHECK(unstable.gain_reduction_margin == 1);
  CHECK(unstable.delay_margin == 0);
}

TEST_CASE("what neither grows nor decays is not stable") {
  const JointPlant plant{.inertia = 0.5};
  CHECK_FALSE(stability_margins(plant, {.proportional = 20}).stable);
  CHECK_FALSE(
      stability_margins(plant, {.proportional = 20, .integral = 120, .derivative = 3}).stable);
  CHECK_FALSE(stability_margins(plant, {.derivative = 3}).stable);  // the position is left alone
  CHECK_FALSE(stability_margins({.inertia = 0.5, .time_constant = 1}, {.derivative = 0.1}).stable);
  CHECK_FALSE(stability_margins(plant, {.integral = 3}).stable);
}

TEST_CASE(
    "magnitude and phase are those of the transfer functions, and |L| = 1 at crossovers only") {
  support::Random random(21);
  for (int k = 0; k < 300; ++k) {
    JointLoop loop = random_loop(random);
    if (random.one_in(2)) loop.gains.derivative_filter_time = random.number(0, 0.3);
    const double delay = random.one_in(2) ? random.number(0, 0.1) : 0;
    const LoopGain gain(loop.plant, loop.gains, delay);
    CAPTURE(k, loop.plant.inertia, loop.plant.time_constant, loop.gains.proportional,
            loop.gains.integral, loop.gains.derivative, loop.gains.derivative_filter_time, delay);
    // 1e-11: some ten roundings, more where the parts of C cancel.
    for (double w = 1e-3; w < 1e4; w *= 3) {
      const std::complex<double> expected = by_formula(loop.plant, loop.gains, delay, w);
      CHECK(std::abs(gain(w) - expected) <= 1e-11 * std::abs(expected));
    }
    std::size_t found = 0;
    const auto& crossovers = stability_margins(gain).crossovers;
    double before = gain.magnitude(1e-4);
    for (double w = 1e-4; w < 1e5; w *= 1.001) {
      const double after = gain.magnitude(w);
      if ((before > 1) != (after > 1)) {
        REQUIRE(found < crossovers.size());
        CHECK(crossovers[found].frequency == Approx(w).epsilon(2e-3));
        CHECK(gain.magnitude(crossovers[found].frequency) == Approx(1).epsilon(1e-10));
        ++found;
      }
      before = after;
    }
    CHECK(found == crossovers.size());
  }
}

TEST_CASE("stable is what has its poles on the left, and margins are where it ends") {
  support::Random random(22);
  int stable = 0, raised = 0, lowered = 0;
  for (int k = 0; k < 1000; ++k) {
    const JointLoop loop = random_loop(random);
    CAPTURE(k, loop.plant.inertia, loop.plant.time_constant, loop.gains.proportional,
            loop.gains.integral, loop.gains.derivative);
    const StabilityMargins margins = stability_margins(loop.plant, loop.gains);
    const double growth = fastest_growth(loop.plant, loop.gains);
    if (std::abs(growth) < 1e-6) continue;  // eigenvalues are not exact
    CHECK(margins.stable == (growth < 0));
    if (!margins.stable) continue;
    CHECK(margins.phase_margin > 0);
    ++stable;
    const auto stable_with = [&](double factor) {
      PidGains g = loop.gains;
      g.proportional *= factor;
      g.integral *= factor;
      g.derivative *= factor;
      return fastest_growth(loop.plant, g) < 0;
    };
    // A loop without delay that bears more gain bears any; less of it may be too little.
    CHECK(margins.gain_margin == infinity);
    CHECK(stable_with(1e3));
    if (margins.gain_reduction_margin > 0) {
      ++lowered;
      CHECK(stable_with(margins.gain_reduction_margin * 1.001));
      CHECK_FALSE(stable_with(margins.gain_reduction_margin * 0.999));
    } else {
      CHECK(stable_with(1e-3));
    }
    // With delay: the gain at which the delay margin is used up.
    const double delay = margins.delay_margin * random.number(0.1, 0.9);
    const StabilityMargins late = stability_margins(loop.plant, loop.gains, delay);
    CHECK(late.stable);
    CHECK(late.delay_margin == Approx(margins.delay_margin - delay).epsilon(1e-9));
    if (!(late.gain_margin < infinity)) continue;
    ++raised;
    const auto late_with = [&](double factor) {
      PidGains g = loop.gains;
      g.proportional *= factor;
      g.integral *= factor;
      g.derivative *= factor;
      return stability_margins(loop.plant, g, delay).stable;
    };
    CHECK(late_with(late.gain_margin * 0.999));
    CHECK_FALSE(late_with(late.gain_margin * 1.001));
    if (late.gain_reduction_margin > 0) {
      CHECK(late_with(late.gain_reduction_margin * 1.001));
      CHECK_FALSE(late_with(late.gain_reduction_margin * 0.999));
    }
  }
  CHECK(stable > 300);
  CHECK(raised > 300);
  CHECK(lowered > 30);
}

TEST_CASE("a loop can cross over three times") {
  // |L| falls through 1 where i and d s^2 cancel, and comes back before it falls for good.
  const JointPlant plant{.inertia = 1, .time_constant = 1};
  const PidGains gains{.proportional = 0.2, .integral = 2, .derivative = 5};
  const StabilityMargins margins = stability_margins(plant, gains);
  REQUIRE(margins.crossovers.size() == 3);
  CHECK(margins.stable == (fastest_growth(plant, gains) < 0));
}

TEST_CASE("a filter of the derivative takes phase away") {
  const JointPlant plant{.inertia = 0.5};
  PidGains gains{.proportional = 20, .derivative = 3};
  const double without = stability_margins(plant, gains).phase_margin;
  gains.derivative_filter_time = 0.02;
  const StabilityMargins margins = stability_margins(plant, gains);
  CHECK(margins.stable);
  CHECK(margins.phase_margin < without);
  // Hurwitz on I s^2 (1 + T_f s) + p (1 + T_f s) + d s: stable while I d > 0, at any T_f.
  gains.derivative_filter_time = 100;
  CHECK(stability_margins(plant, gains).stable);
}

TEST_CASE("sampled at 1 kHz, the UR10's lightest wrist joint is unstable with a lab's gains") {
  const JointPlant wrist{.inertia = 0.000526462289415};
  const PidGains lab{.proportional = 1000, .integral = 0.01, .derivative = 10};
  CHECK(stability_margins(wrist, lab).delay_margin == Approx(8.24e-5).epsilon(1e-3));
  CHECK_FALSE(stability_margins(wrist, lab, 0.5e-3).stable);
  CHECK(stability_margins(wrist, lab, 0.5e-4).stable);
}

TEST_CASE("loops of nonsense are refused by name and value") {
  const JointPlant plant{.inertia = 1, .time_constant = 1};
  const PidGains good{.proportional = 1, .integral = 1, .derivative = 1};
  for (double bad : {-1.0, infinity, -infinity, not_a_number}) {
    CAPTURE(bad);
    PidGains gains = good;
    gains.proportional = bad;
    CHECK_THROWS_WITH(stability_margins(plant, gains), Contains("proportional"));
    gains = good;
    gains.integral = bad;
    CHECK_THROWS_WITH(stability_margins(plant, gains), Contains("integral"));
    gains = good;
    gains.derivative = bad;
    CHECK_THROWS_WITH(stability_margins(plant, gains), Contains("derivative"));
    gains = good;
    gains.derivative_filter_time = bad;
    CHECK_THROWS_WITH(stability_margins(plant, gains), Contains("derivative_filter_time"));
    CHECK_THROWS_WITH(stability_margins(plant, good, bad), Contains("delay"));
    CHECK_THROWS_WITH(stability_margins({.inertia = bad}, good), Contains("inertia"));
  }
  CHECK_THROWS_WITH(stability_margins(plant, PidGains{}), Contains("all 0"));
}

TEST_CASE(
    "figures of any size give right crossovers or are refused, sensible ones are never refused") {
  support::Random random(23);
  for (const double size : {6.0, 20.0, 100.0, 300.0}) {
    int refused = 0;
    for (int k = 0; k < 1000; ++k) {
      const auto any = [&] { return std::pow(10, random.number(-size, size)); };
      const JointPlant plant{.inertia = any(),
                             .time_constant = random.one_in(3) ? infinity : any()};
      const PidGains gains{.proportional = any(),
                           .integral = random.one_in(3) ? 0 : any(),
                           .derivative = random.one_in(3) ? 0 : any(),
                           .derivative_filter_time = random.one_in(2) ? 0 : any()};
      const double delay = random.one_in(2) ? 0 : any();
      CAPTURE(size, k, plant.inertia, plant.time_constant, gains.proportional, gains.integral,
              gains.derivative, gains.derivative_filter_time, delay);
      try {
        const LoopGain loop(plant, gains, delay);
        const StabilityMargins margins = stability_margins(loop);
        CHECK(margins.crossovers.size() % 2 == 1);  // from infinity at 0 to 0 at infinity
        for (const Crossover& c : margins.crossovers) {
          CHECK(loop.magnitude(c.frequency) == Approx(1).epsilon(1e-6));  // far terms may cancel
        }
        CHECK_FALSE(std::isnan(margins.phase_margin));
        CHECK(margins.gain_margin >= 1);
        CHECK(margins.gain_reduction_margin <= 1);
        CHECK(margins.delay_margin >= 0);
      } catch (const std::invalid_argument& refusal) {
        CHECK_THAT(refusal.what(), Contains("too large or too small") || Contains("not a"));
        ++refused;
      }
    }
    if (size == 6) CHECK(refused == 0);
  }
}
