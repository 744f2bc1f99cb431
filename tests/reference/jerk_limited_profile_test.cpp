// SPDX-License-Identifier: Apache-2.0
#include <articula/reference/jerk_limited_profile.hpp>
#include <articula/reference/reference_generator.hpp>
#include <articula/robots/q2d.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::infinity;
using support::not_a_number;

namespace {

static_assert(ReferenceGenerator<JerkLimitedProfile<Q2d>, 2>);

struct Limits {
  double V, A, J;
};

double log_uniform(support::Random& random, double low, double high) {
  return std::exp(random.number(std::log(low), std::log(high)));
}

Limits random_limits(support::Random& random) {
  return {log_uniform(random, 1e-2, 1e2), log_uniform(random, 1e-2, 1e2),
          log_uniform(random, 1e-2, 1e3)};
}

/// What is wrong with a motion, sampled at `count` equal steps; empty if nothing. Velocity and
/// acceleration are within their bounds to the last bit. With jerk within J, the trapezoidal rule
/// is off by at most J h^2 / 4 from acceleration to velocity, J h^3 / 12 from velocity to position;
/// what it must not exceed that by is rounding, some hundred units in the last place of what is
/// added up.
/// @param sample  the JointMotion at a time from 0 to T
template <class Sample>
std::string fault_of(const Sample& sample, double T, double V, double A, double J, int count) {
  constexpr double rounding = 1e-13;
  const double h = T / count;
  JointMotion last = sample(0.0);
  for (int k = 1; k <= count; ++k) {
    const JointMotion now = sample(k == count ? T : k * h);
    if (!(std::abs(now.velocity) <= V)) return "velocity";
    if (!(std::abs(now.acceleration) <= A)) return "acceleration";
    const double jerk_step = std::abs(now.acceleration - last.acceleration);
    if (!(jerk_step <= J * h + rounding * (A + J * T))) return "jerk";
    const double v_error =
        now.velocity - last.velocity - h * (now.acceleration + last.acceleration) / 2;
    if (!(std::abs(v_error) <= J * h * h / 4 + rounding * (V + A * T))) return "velocity integral";
    const double q_error = now.position - last.position - h * (now.velocity + last.velocity) / 2;
    const double size = std::abs(now.position) + std::abs(last.position) + V * T + A * T * T;
    if (!(std::abs(q_error) <= J * h * h * h / 12 + rounding * size)) return "position integral";
    last = now;
  }
  return last.velocity == 0 && last.acceleration == 0 ? "" : "does not rest";
}
std::string fault_of(const JerkMotion<7>& motion, double V, double A, double J, int count) {
  const auto sample = [&](double t) { return motion.sample(t); };
  return fault_of(sample, motion.duration(), V, A, J, count);
}

/// The integral of f over [0, T], where f is a polynomial of degree three at most between `kinks`:
/// by Simpson's rule from each to the next, which is exact.
double integral(double T, std::vector<double> kinks, const std::function<double(double)>& f) {
  for (double& kink : kinks) kink = std::clamp(kink, 0.0, T);
  kinks.push_back(T);
  std::sort(kinks.begin(), kinks.end());
  double sum = 0, last = 0;
  for (const double next : kinks) {
    sum += (next - last) / 6 * (f(last) + 4 * f((last + next) / 2) + f(next));
    last = next;
  }
  return sum;
}

/// The least T for which `enough(T)`, which then stays true, by bisection.
double least(double high, const std::function<bool(double)>& enough) {
  while (!enough(high)) high *= 2;
  double low = 0;
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (enough(middle) ? high : low) = middle;
  }
  return high;
}

/// The least time from rest to rest over D, found without its formulas: half of the time, the
/// acceleration can be as high as it could have risen and must fall again, until V is reached.
double least_rest_to_rest(double D, const Limits& l) {
  const auto envelope = [&](double T) {
    return [=](double t) { return std::min({l.J * t, l.A, l.J * (T - t)}); };
  };
  const auto kinks = [&](double T) { return std::vector{l.A / l.J, T / 2, T - l.A / l.J}; };
  const double to_V = least(1, [&](double T) { return integral(T, kinks(T), envelope(T)) >= l.V; });
  const auto distance = [&](double half) {
    const double T = std::min(half, to_V);
    const auto a = envelope(T);
    return integral(T, kinks(T), [&](double t) { return a(t) * (T - t); }) + (half - T) * l.V;
  };
  return 2 * least(1, [&](double half) { return distance(half) >= D / 2; });
}

/// The least time for a stop: within T, the acceleration lies between two envelopes, and the
/// velocity can lose all that is between their integrals.
double least_stop(double v, double a, const Limits& l) {
  return least(1, [&](double T) {
    if (T < std::abs(a) / l.J) return false;
    const std::vector kinks{(l.A - a) / l.J, (a - l.A) / l.J,   (l.A + a) / l.J,  -(l.A + a) / l.J,
                            T - l.A / l.J,   (T - a / l.J) / 2, (T + a / l.J) / 2};
    const double high = integral(T, kinks, [&](double t) {
      return std::min({a + l.J * t, std::max(l.A, a - l.J * t), l.J * (T - t)});
    });
    const double low = integral(T, kinks, [&](double t) {
      return std::max({a - l.J * t, std::min(-l.A, a + l.J * t), -l.J * (T - t)});
    });
    return low <= -v && -v <= high;
  });
}

const MotionLimits<2> limits{{2, 10}, {20, 50}, {400, 1000}};

}  // namespace

TEST_CASE("a million random motions and stops keep their limits") {
  constexpr unsigned seed = 20240611;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 500'000; ++k) {
    const auto l = random_limits(random);
    const double from = random.number(-10, 10);
    const double D = random.one_in(50) ? 0 : log_uniform(random, 1e-9, 1e4);
    const double to = from + (random.one_in(2) ? D : -D);
    const auto motion = rest_to_rest(from, to, l.V, l.A, l.J);
    const auto fault = fault_of(motion, l.V, l.A, l.J, 24);
    if (fault.empty() && motion.sample(0).position == from &&
        motion.sample(motion.duration()).position == to) {
      continue;
    }
    CAPTURE(k, fault, l.V, l.A, l.J, from, to);
    FAIL("rest to rest");
  }
  for (int k = 0; k < 500'000; ++k) {
    const auto l = random_limits(random);
    const JointMotion start{random.number(-10, 10), random.number(-3, 3) * l.V,
                            random.one_in(20) ? 0 : random.number(-2, 2) * l.A};
    // Only while the acceleration at the start fades may the velocity grow.
    const double a = start.acceleration;
    const double V = (std::abs(start.velocity) + a * a / 2 / l.J) * (1 + 1e-14);
    const double A = std::max(l.A, std::abs(a));
    const auto motion = fastest_stop(start, l.A, l.J);
    const auto fault = fault_of(motion, V, A, l.J, 24);
    const JointMotion first = motion.sample(0);
    if (fault.empty() && first.position == start.position && first.velocity == start.velocity &&
        first.acceleration == a) {
      continue;
    }
    CAPTURE(k, fault, l.V, l.A, l.J, start.position, start.velocity, a);
    FAIL("stop");
  }
}

// The bisection ends at the rounding of the integrals, from which the time is a root.
TEST_CASE("no motion from rest to rest is faster") {
  constexpr unsigned seed = 4711;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 3000; ++k) {
    const auto l = random_limits(random);
    const double D = log_uniform(random, 1e-4, 1e3);
    CAPTURE(k, l.V, l.A, l.J, D);
    REQUIRE(rest_to_rest(0, D, l.V, l.A, l.J).duration() ==
            Approx(least_rest_to_rest(D, l)).epsilon(1e-9));
  }
}

TEST_CASE("no stop is faster") {
  constexpr unsigned seed = 4712;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 3000; ++k) {
    const auto l = random_limits(random);
    const double v = random.number(-3, 3) * l.V;
    const double a = random.one_in(5) ? 0 : random.number(-2, 2) * l.A;
    CAPTURE(k, l.A, l.J, v, a);
    REQUIRE(fastest_stop({0, v, a}, l.A, l.J).duration() ==
            Approx(least_stop(v, a, l)).epsilon(1e-7));
  }
}

TEST_CASE("all positions of a motion lie in the range that it says, and reach its ends") {
  constexpr unsigned seed = 4713;
  CAPTURE(seed);
  support::Random random(seed);
  int turning = 0;
  for (int k = 0; k < 3000; ++k) {
    const auto l = random_limits(random);
    const auto motion = fastest_stop(
        {random.number(-1, 1), random.number(-1, 1) * l.V, random.number(-2, 2) * l.A}, l.A, l.J);
    const ValueRange range = motion.positions();
    const double first = motion.sample(0).position, last = motion.end().position;
    turning += range.lowest < std::min(first, last) || range.highest > std::max(first, last);
    constexpr int count = 2000;
    double lowest = first, highest = first, fastest = 0;
    for (int i = 0; i <= count; ++i) {
      const auto now = motion.sample(motion.duration() * i / count);
      lowest = std::min(lowest, now.position);
      highest = std::max(highest, now.position);
      fastest = std::max(fastest, std::abs(now.acceleration));
    }
    // What lies between two samples, h apart, is within a h^2 / 8 of them; the rest is rounding.
    const double h = motion.duration() / count, size = 1 + std::abs(first) + std::abs(last);
    const double between = fastest * h * h / 8 + 1e-13 * size;
    CAPTURE(k, l.A, l.J);
    REQUIRE(range.lowest <= lowest + 1e-13 * size);
    REQUIRE(range.highest >= highest - 1e-13 * size);
    REQUIRE(range.lowest >= lowest - between);
    REQUIRE(range.highest <= highest + between);
  }
  CHECK(turning > 300);
}

TEST_CASE("a stop that has to stay within a range does, and is no harder than it must be") {
  constexpr unsigned seed = 4714;
  CAPTURE(seed);
  support::Random random(seed);
  int same = 0, harder = 0;
  for (int k = 0; k < 20'000; ++k) {
    const auto l = random_limits(random);
    const double upper = log_uniform(random, 1e-6, 1e2), lower = -log_uniform(random, 1e-6, 1e2);
    const double a = random.one_in(3) ? 0 : random.number(-2, 2) * l.A;
    const JointMotion start{0, random.number(-1, 1) * l.V, a};
    const auto motion = stop_within(start, l.V, l.A, l.J, lower, upper);
    const ValueRange range = motion.positions();
    CAPTURE(k, l.A, l.J, start.velocity, start.acceleration, lower, upper);
    REQUIRE(range.lowest >= lower);
    REQUIRE(range.highest <= upper);
    REQUIRE(motion.end().velocity == 0);
    REQUIRE(motion.sample(0).velocity ==
            start.velocity);  // there was a way: it does not stand at once
    const auto free = stop_within(start, l.V, l.A, l.J, -infinity, infinity);
    if (free.positions().highest <= upper && free.positions().lowest >= lower) {
      ++same;
      REQUIRE(motion.duration() == free.duration());
      continue;
    }
    ++harder;
    if (a != 0) continue;
    // The way is v T/2 by symmetry, whatever k is; k is within 0.14 % of what uses all of it.
    const double way = start.velocity > 0 ? upper : -lower;
    REQUIRE(motion.duration() <= 2 * way / std::abs(start.velocity) * (1 + 1e-9));
    REQUIRE(motion.duration() >= 2 * way / std::abs(start.velocity) * (1 - 2e-3));
  }
  CAPTURE(same, harder);
  CHECK(same > 2000);
  CHECK(harder > 2000);
}

// sqrt, square and a few sums: 1e-14
TEST_CASE("no stop is faster than it began, or than its limit") {
  constexpr unsigned seed = 4715;
  CAPTURE(seed);
  support::Random random(seed);
  int dropped = 0;
  for (int k = 0; k < 20'000; ++k) {
    const auto l = random_limits(random);
    const JointMotion start{0, random.number(-1.5, 1.5) * l.V, random.number(-5, 5) * l.A};
    const double range = random.one_in(2) ? infinity : log_uniform(random, 1e-3, 1e2);
    const auto motion = stop_within(start, l.V, l.A, l.J, -range, range);
    const double most = std::max(l.V, std::abs(start.velocity)) * (1 + 1e-14);
    const double T = motion.duration();
    CAPTURE(k, l.V, l.A, l.J, start.velocity, start.acceleration, range);
    REQUIRE(motion.sample(0).velocity == start.velocity);
    double fastest = 0;
    for (int i = 0; i <= 50; ++i) {
      fastest = std::max(fastest, std::abs(motion.sample(T * i / 50).velocity));
    }
    REQUIRE(fastest <= most);
    const double a = motion.sample(0).acceleration;
    const double left =
        start.velocity + start.acceleration / 2 / l.J * std::abs(start.acceleration);
    if (std::abs(left) <= most / (1 + 1e-14)) {
      REQUIRE(a == start.acceleration);
    } else {
      ++dropped;
      REQUIRE(std::abs(a) < std::abs(start.acceleration));
      REQUIRE(a * start.acceleration >= 0);
    }
  }
  CHECK(dropped > 2000);
}

TEST_CASE("a stop at the very end of its range, and beyond it") {
  const auto at_once = stop_within({1, 0.5, 0}, 10, 2, 30, -1, 1);
  CHECK(at_once.duration() == 0);
  CHECK(at_once.sample(0).position == 1);
  CHECK(at_once.sample(0).velocity == 0);
  CHECK(stop_within({1, -0.5, 0}, 10, 2, 30, -1, 1).sample(0).velocity == -0.5);
  // From outside, outwards: nothing can be done but to stop as always.
  CHECK(stop_within({1.1, 0.5, 0}, 10, 2, 30, -1, 1).duration() ==
        fastest_stop({1.1, 0.5, 0}, 2, 30).duration());
  CHECK(stop_within({1.1, -5, 0}, 10, 2, 30, -1, 1).positions().lowest >= -1);
  // the least distance that there is from 1, and 2 / 9 of a microsecond
  CHECK(stop_within({1 - 0x1p-53, 9, 0}, 10, 1e-9, 1e-9, -1, 1).duration() == 0);
  CHECK(stop_within({1 - 1e-6, 9, 0}, 10, 1e-9, 1e-9, -1, 1).duration() ==
        Approx(2e-6 / 9).epsilon(2e-3));
  for (const double bad : {infinity, -infinity, not_a_number}) {
    CHECK(!is_finite(stop_within({bad, 1, 1}, 10, 1, 1, -1, 1).sample(0).position));
  }
}

TEST_CASE("each of the four kinds of motion has the duration of the textbook") {
  // V, A reached; A not V; V not A; neither
  CHECK(rest_to_rest(0, 10, 2, 4, 8).duration() == Approx(5 + 0.5 + 0.5).epsilon(1e-14));
  CHECK(rest_to_rest(0, 3, 9, 2, 4).duration() == Approx(0.5 + std::sqrt(0.25 + 6)).epsilon(1e-14));
  CHECK(rest_to_rest(0, 4, 1, 9, 4).duration() == Approx(4 + 2 * 0.5).epsilon(1e-14));
  CHECK(rest_to_rest(0, 2, 9, 9, 1).duration() == Approx(4 * 1.0).epsilon(1e-14));
}

TEST_CASE("distances of nothing, and next to nothing") {
  CHECK(rest_to_rest(1, 1, 1, 1, 1).duration() == 0);
  CHECK(rest_to_rest(1, 1, 1, 1, 1).sample(0).position == 1);
  for (const double D : {support::smallest, 1e-300, 1e-100, 1e-90, 1e-30, 1e-16}) {
    CAPTURE(D);
    for (const double size : {1e-9, 1.0, 1e9}) {
      const auto motion = rest_to_rest(0, D, size, size, size);
      CHECK(is_finite(motion.duration()));
      CHECK(motion.sample(infinity).position == D);
      CHECK(fault_of(motion, size, size, size, 100).empty());
    }
  }
}

TEST_CASE("a stop at rest, from the turning point and from beyond all limits") {
  CHECK(fastest_stop({3, 0, 0}, 1, 1).duration() == 0);
  CHECK(fastest_stop({3, 0, 0}, 1, 1).sample(1).position == 3);
  // the acceleration just takes the velocity away as it fades
  CHECK(fastest_stop({0, 0.5, -1}, 2, 1).duration() == Approx(1).epsilon(1e-14));
  // 10 m/s lose 4.5 while 3 m/s^2 fade to 0 -- but 2 too many, which are held back at 1
  const auto over = fastest_stop({0, 10, 3}, 1, 1);
  CHECK(fault_of(over, 14.5 * (1 + 1e-15), 3, 1, 1000).empty());
  CHECK(over.duration() == Approx(3 + 1 + (14.5 - 1) + 1).epsilon(1e-14));
  for (const double v : {support::smallest, 1e-300, 1e-100, 1e100, 1e300}) {
    CAPTURE(v);
    const auto motion = fastest_stop({0, v, 0}, 1, 1);
    CHECK(motion.sample(infinity).velocity == 0);
    CHECK(is_finite(motion.duration()));
  }
}

TEST_CASE("all joints arrive together, and the slowest is not held up") {
  const JerkLimitedProfile<Q2d> profile({0, 0}, {-1, 0.1}, limits);
  CHECK(profile.duration() == rest_to_rest(0, -1, 2, 20, 400).duration());
  CHECK(rest_to_rest(0, 0.1, 10, 50, 1000).duration() < profile.duration());
  const double T = profile.duration(), h = T / 5000;
  JointReference<2> last = profile.sample(0);
  CHECK(last.position == JointVector<2>(0, 0));
  for (double t = h; t < T; t += h) {
    const auto r = profile.sample(t);
    for (int j = 0; j < 2; ++j) {
      REQUIRE(std::abs(r.velocity[j]) <= limits.velocity[j]);
      REQUIRE(std::abs(r.acceleration[j]) <= limits.acceleration[j]);
      REQUIRE(std::abs(r.acceleration[j] - last.acceleration[j]) <=
              limits.jerk[j] * h * (1 + 1e-9));
      REQUIRE(r.velocity[j] * (j == 0 ? -1 : 1) >= 0);
    }
    last = r;
  }
  CHECK(profile.sample(0.99 * T).velocity[1] > 0);  // it has not arrived before
  const auto end = profile.sample(T);
  CHECK(end.position == JointVector<2>(-1, 0.1));
  CHECK(end.velocity.isZero(0));
  CHECK(profile.sample(1e300).position == end.position);
  CHECK(profile.sample(-1).position == JointVector<2>(0, 0));
}

TEST_CASE("times that are no numbers give no position") {
  const JerkLimitedProfile<Q2d> profile({0, 0}, {-1, 0.1}, limits), nowhere({0, 0}, {0, 0}, limits);
  for (const double t : {not_a_number, infinity, -infinity}) {
    CHECK(!is_finite(profile.sample(t)));
    CHECK(!is_finite(nowhere.sample(t)));
  }
}

// The slower of two joints keeps its pace; the other's is slower by the ratio of their times, and
// its jerk by the third power of that, which bounds the error of the trapezoidal rule.
TEST_CASE("all joints of random profiles keep their limits, and each derivative is one") {
  constexpr unsigned seed = 13;
  CAPTURE(seed);
  support::Random random(seed);
  int stretched = 0;
  for (int k = 0; k < 50'000; ++k) {
    MotionLimits<2> l;
    Limits own[2];
    JointVector<2> from, to;
    for (int j = 0; j < 2; ++j) {
      own[j] = random_limits(random);
      l.velocity[j] = own[j].V;
      l.acceleration[j] = own[j].A;
      l.jerk[j] = own[j].J;
      from[j] = random.number(-1.5, 1.5);
      to[j] = from[j] + log_uniform(random, 1e-6, 1e2) * (random.one_in(2) ? 1 : -1);
    }
    if (random.one_in(50)) to[1] = from[1];
    const auto profile = JerkLimitedProfile<Q2d>::move(from, to, l);
    const double T = profile.duration();
    for (int i = 0; i <= 8; ++i) {  // near the ends rounding would pass them
      const double near = T * std::pow(10, -2 * i);
      for (const double t : {near, T - near}) {
        const JointVector<2> there = profile.sample(t).position;
        const auto q = there.array();
        if ((q < from.cwiseMin(to).array()).any() || (q > from.cwiseMax(to).array()).any()) {
          FAIL("position, case " << k << " at " << t << " s");
        }
      }
    }
    for (int j = 0; j < 2; ++j) {
      const auto sample = [&](double t) {
        const auto r = profile.sample(t);
        return JointMotion{r.position[j], r.velocity[j], r.acceleration[j]};
      };
      const auto alone = rest_to_rest(from[j], to[j], own[j].V, own[j].A, own[j].J);
      const double pace = alone.duration() / T;
      stretched += pace > 0.01 && pace < 0.9;
      const double J = own[j].J * pace * pace * pace * (1 + 1e-9);  // rounding of the pace
      const auto fault = fault_of(sample, T, own[j].V, own[j].A, J, 48);
      if (fault.empty() && sample(0).position == from[j] && sample(T).position == to[j]) continue;
      CAPTURE(k, j, fault, own[j].V, own[j].A, own[j].J, from[j], to[j], pace);
      FAIL("profile");
    }
  }
  CHECK(stretched > 1000);
}

TEST_CASE("a stop goes on from the reference and keeps its effort") {
  const JointReference<2> from{{0.5, -0.5}, {1, -3}, {2, 4}, {7, 8}};
  const auto stop = JerkLimitedProfile<Q2d>::stop(from, limits);
  const auto first = stop.sample(0), last = stop.sample(stop.duration());
  CHECK(first.position == from.position);
  CHECK(first.velocity == from.velocity);
  CHECK(first.acceleration == from.acceleration);
  CHECK(first.effort == from.effort);
  CHECK(last.velocity.isZero(0));
  CHECK(last.effort == from.effort);
}

TEST_CASE("limits and positions that make no profile are refused by name") {
  using Profile = JerkLimitedProfile<Q2d>;
  const auto with = [](JointVector<2> MotionLimits<2>::* member, double value) {
    auto changed = limits;
    (changed.*member)[1] = value;
    return changed;
  };
  for (const double bad : {0.0, -1.0, 1e-10, 1e10, infinity, not_a_number}) {
    CAPTURE(bad);
    CHECK_THROWS_WITH(Profile({0, 0}, {0, 1}, with(&MotionLimits<2>::velocity, bad)),
                      Contains("velocity") && Contains("'elbow_active_joint'"));
    CHECK_THROWS_WITH(Profile({0, 0}, {0, 1}, with(&MotionLimits<2>::acceleration, bad)),
                      Contains("acceleration") && Contains("'elbow_active_joint'"));
    CHECK_THROWS_WITH(Profile({0, 0}, {0, 1}, with(&MotionLimits<2>::jerk, bad)),
                      Contains("jerk") && Contains("'elbow_active_joint'"));
  }
  CHECK_THROWS_WITH(Profile({0, 0}, {0, 1}, with(&MotionLimits<2>::velocity, 23.09)),
                    Contains("23.09") && Contains("23.08"));
  CHECK_THROWS_WITH(Profile({0, 0}, {0, 1.6}, limits), Contains("1.6") && Contains("1.5708"));
  CHECK_THROWS_WITH(Profile({0, 0}, {not_a_number, 0}, limits),
                    Contains("'shoulder_active_joint'"));
  CHECK_THROWS_WITH(Profile({0, infinity}, {0, 0}, limits), Contains("never arrives"));
  CHECK_NOTHROW(Profile({0, 1.7}, {0, 1}, limits));  // back from beyond a limit
}

TEST_CASE("a motion may be as fast as the description allows") {
  const MotionLimits<2> described = motion_limits(Q2d(), {20, 50}, {400, 1000});
  CHECK(described.velocity == JointVector<2>(2.27, 23.08));
  CHECK(described.acceleration == JointVector<2>(20, 50));
  CHECK(described.jerk == JointVector<2>(400, 1000));
  CHECK_NOTHROW(JerkLimitedProfile<Q2d>({0, 0}, {1, -1}, described));

  const Model<1> slider = support::slider();  // whose description limits no velocity
  const JointVector<1> one(1.0);
  CHECK_THROWS_WITH(validate(slider, motion_limits(slider, one, one)),
                    Contains("velocity inf of joint 'joint'"));
}
