// SPDX-License-Identifier: Apache-2.0
#include <articula/reference/trajectory/trajectory_bridge.hpp>
#include <articula/robots/q2d.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::infinity;
using support::not_a_number;

namespace {

using Vector = JointVector<2>;
using Points = Trajectory<Q2d>;

const Vector zero = Vector::Zero();
const MotionLimits<2> limits{{2, 10}, {20, 50}, {400, 1000}};
const double quarter = std::numbers::pi / 2;
const JointRange<2> range{Vector(-quarter, -quarter), Vector(quarter, quarter), zero};

/// By how many of its limits a way goes beyond them at most, at 1000 times.
double excess(const TrajectoryBridge<2>& bridge) {
  const auto end = at_point(bridge.to);
  double most = 0;
  for (int i = 0; i <= 1000; ++i) {
    const double T = bridge.to.time_from_start - bridge.from.time_from_start;
    const auto r = interpolate(bridge.from, bridge.to, T * i / 1000);
    for (int j = 0; j < 2; ++j) {
      const double V = std::max(
          {limits.velocity[j], std::abs((*bridge.from.velocity)[j]), std::abs(end.velocity[j])});
      const double A = std::max({limits.acceleration[j], std::abs((*bridge.from.acceleration)[j]),
                                 std::abs(end.acceleration[j])});
      most = std::max({most, std::abs(r.velocity[j]) / V, std::abs(r.acceleration[j]) / A,
                       r.position[j] / range.upper[j], r.position[j] / range.lower[j]});
    }
  }
  return most - 1;
}

}  // namespace

// Found by looking at 2000 places: not above what is found by more than the promised 1e-10, not
// below by more than what lies between two of them, half of h^2/4 of the second derivative.
TEST_CASE("the peak of a polynomial is where it is highest") {
  constexpr unsigned seed = 5;
  CAPTURE(seed);
  support::Random random(seed);
  const auto check = [&](const auto& c) {
    double highest = -infinity, bend = 0;
    for (int i = 0; i <= 2000; ++i) {
      double value = 0;
      for (std::size_t k = c.size(); k-- > 0;) value = value * (i / 2000.0) + c[k];
      highest = std::max(highest, value);
    }
    for (std::size_t k = 2; k < c.size(); ++k) {
      bend += std::abs(c[k]) * static_cast<double>(k * (k - 1));
    }
    const double peak = polynomial_peak(c, -infinity);
    REQUIRE(peak >= highest - 1e-8);
    REQUIRE(peak <= highest + bend / 8 / 2000 / 2000 + 1e-7);
    const double limit = random.number(-20, 20);
    REQUIRE(polynomial_peak(c, limit) == Approx(std::max(peak, limit)).margin(1e-7));
  };
  for (int n = 0; n < 3000; ++n) {
    const auto number = [&] { return random.number(-10, 10); };
    check(std::array{number(), number()});
    check(std::array{number(), number(), number(), number()});
    check(std::array{number(), number(), number(), number(), number()});
    check(std::array{number(), number(), number(), number(), number(), number()});
  }
  // 4 s (1 - s), and 27/4 s (1 - s)^2, whose peak is at 1/3
  CHECK(polynomial_peak(std::array{0.0, 4.0, -4.0}, 0) == 1);
  CHECK(polynomial_peak(std::array{0.0, 6.75, -13.5, 6.75}, 0) == Approx(1).epsilon(1e-9));
  CHECK(polynomial_peak(std::array{3.0, 0.0, 0.0, 0.0, 0.0, 0.0}, -infinity) == 3);
  CHECK(polynomial_peak(std::array{3.0, 1.0}, infinity) == infinity);
  for (const double bad : {not_a_number, infinity, -infinity}) {
    CHECK(polynomial_peak(std::array{0.0, bad, 0.0}, 7) == infinity);
    CHECK(polynomial_peak(std::array{0.0, 0.0, bad}, 7) == infinity);
  }
  CHECK(polynomial_peak(std::array{0.0, 1e308, -2e307}, 0) >= 8e307);
}

// 1e-8: what the search tolerates, 1e-9 of the limit, and as much for what it measures
TEST_CASE("whatever a bridge leads from and to, all of it is within the limits") {
  constexpr unsigned seed = 3;
  CAPTURE(seed);
  support::Random random(seed);
  int found = 0, none = 0;
  for (int n = 0; n < 20'000; ++n) {
    JointReference<2> from{.position = random.vector<2>(1.5)};
    if (n % 2 == 0) {
      from.velocity = {random.number(-2.5, 2.5), random.number(-11, 11)};
      from.acceleration = {random.number(-22, 22), random.number(-55, 55)};
    }
    TrajectoryPoint<2> point{.time_from_start = random.number(0.05, 1.5),
                             .position = random.vector<2>(1.5)};
    if (random.one_in(2)) point.velocity = random.vector<2>(random.one_in(2) ? 2.2 : 0);
    if (random.one_in(2)) point.acceleration = random.vector<2>(random.one_in(2) ? 25 : 0);
    TrajectoryRefusal refusal;
    const auto bridge = find_bridge(from, Points({point}, {.allow_motion_at_end = true}), 0, limits,
                                    range, refusal);
    ++(bridge ? found : none);
    if (!bridge) {
      REQUIRE(!refusal.what.empty());
      REQUIRE(refusal.limit.has_value());
      continue;
    }
    CAPTURE(n);
    REQUIRE(excess(*bridge) <= 1e-8);
  }
  CHECK(found > 2000);
  CHECK(none > 2000);
}

TEST_CASE("a way that just keeps its limits is taken, a little faster it is refused") {
  // a cubic from rest to rest over 1 rad: highest velocity 1.5 / T, acceleration 6 / T^2
  const MotionLimits<2> wide{{100, 100}, {1000, 1000}, {1, 1}};
  const auto takes = [&](double T, const MotionLimits<2>& l) {
    TrajectoryRefusal refusal;
    const JointReference<2> rest;
    const Points there({{.time_from_start = T, .position = {1, 0}, .velocity = zero}});
    return find_bridge(rest, there, 0, l, range, refusal).has_value();
  };
  auto slow = wide, soft = wide;
  slow.velocity[0] = 1.5;
  soft.acceleration[0] = 6;
  for (const auto& l : {slow, soft}) {
    CHECK(takes(1, l));
    CHECK(takes(1.001, l));
    CHECK_FALSE(takes(0.9999, l));
  }
}

TEST_CASE("a way that swings out of the joint's limits is refused, with the figures") {
  // at 1.5 rad with 1.5 rad/s towards the limit of 1.57 rad; a tenth of the deceleration would do
  TrajectoryRefusal refusal;
  const Points back({{.time_from_start = 1, .position = {1, 0}, .velocity = zero}});
  JointReference<2> from{{1.5, 0}, {1.5, 0}};
  CHECK_FALSE(find_bridge(from, back, 0, limits, range, refusal));
  CHECK_THAT(to_string(Q2d(), refusal), Contains("before the last point the position") &&
                                            Contains("'shoulder_active_joint'") &&
                                            Contains("above its limit 1.5708"));
  const Points forth({{.time_from_start = 1, .position = {-1, 0}, .velocity = zero}});
  from = {{-1.5, 0}, {-1.5, 0}};
  CHECK_FALSE(find_bridge(from, forth, 0, limits, range, refusal));
  CHECK_THAT(to_string(Q2d(), refusal), Contains("below its limit -1.5708"));
  // From beyond the limits there is a way back, but none further out.
  from = {{1.7, 0}, {0, 0}};
  CHECK(find_bridge(from, back, 0, limits, range, refusal));
  from.velocity[0] = 0.5;
  CHECK_FALSE(find_bridge(from, back, 0, limits, range, refusal));
  // A joint that stands exactly at its limit, and one that goes there.
  from = {{quarter, 0}, {0, 0}};
  const Points edge({{.time_from_start = 2, .position = {quarter, -quarter}, .velocity = zero}});
  CHECK(find_bridge(from, edge, 0, limits, range, refusal));
}

TEST_CASE(
    "from motion, a bridge goes over into the trajectory without a jump of the acceleration") {
  const Points onward({{.time_from_start = 1, .position = {0.5, 0.5}, .velocity = Vector(0.3, 0)},
                       {.time_from_start = 2, .position = {-0.5, 1}, .velocity = zero}});
  TrajectoryRefusal refusal;
  const JointReference<2> from{{0.1, 0}, {0.2, 0.1}};
  const auto bridge = find_bridge(from, onward, 0, limits, range, refusal);
  REQUIRE(bridge);
  const auto before = interpolate(bridge->from, bridge->to, 1 - 1e-9);
  const auto after = onward.sample(1 + 1e-9);
  // 2e-9 s of a jerk below 100
  CHECK((before.acceleration - after.acceleration).norm() < 1e-6);
  CHECK((before.velocity - after.velocity).norm() < 1e-6);
  CHECK(after.acceleration.norm() > 1);
}
