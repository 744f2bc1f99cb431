// SPDX-License-Identifier: Apache-2.0
// hold_within_bounds against all answers that are thinkable: every joint held, at its lower or at
// its upper bound.
#include <articula/sim/bounded_effort.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <utility>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"

using namespace articula;
using support::infinity;

namespace {

template <int N>
struct Problem {
  JointArray<int, N> parents = [] {
    JointArray<int, N> none;
    none.fill(-1);
    return none;
  }();
  JointMatrix<N> mass = JointMatrix<N>::Identity();
  JointVector<N> load = JointVector<N>::Zero();
  EffortBounds<N> bounds{};
};

/// A tree with a matrix that has its shape, L^T D L, and bounds of all kinds: none, friction, a
/// stop, a stop with friction, a weld.
template <int N>
Problem<N> random_problem(support::Random& random) {
  Problem<N> p;
  JointMatrix<N> l = JointMatrix<N>::Identity();
  JointVector<N> d;
  for (int k = 0; k < N; ++k) {
    d[k] = std::pow(10, random.number(-2, 1));
    int& parent = p.parents[k];
    parent = random.integer(-1, k - 1);
    for (int i = parent; i >= 0; i = p.parents[i]) {
      l(k, i) = random.number(-2, 2);
    }
    p.load[k] = random.number(-3, 3);
    const double friction = random.one_in(3) ? 0 : random.number(0, 2);
    p.bounds.lower[k] = random.one_in(4) ? -infinity : -friction;
    p.bounds.upper[k] = random.one_in(4) ? infinity : friction;
  }
  p.mass = l.transpose() * d.asDiagonal() * l;
  return p;
}

/// How badly an answer breaks the rules.
template <int N>
double violation(const Problem<N>& p, const JointVector<N>& motion, const JointVector<N>& effort) {
  double worst = (p.mass * motion - p.load - effort).cwiseAbs().maxCoeff();
  for (int j = 0; j < N; ++j) {
    const double lower = p.bounds.lower[j], upper = p.bounds.upper[j];
    worst = std::max({worst, lower - effort[j], effort[j] - upper});
    if (lower == upper) continue;
    // Off the lower bound it must not move up, and off the upper bound not down.
    worst = std::max(
        {worst, std::min(motion[j], effort[j] - lower), std::min(-motion[j], upper - effort[j])});
  }
  return worst;
}

/// The motion of the best of all 3^N thinkable answers, and how badly it breaks the rules.
template <int N>
std::pair<JointVector<N>, double> brute_force(const Problem<N>& p) {
  std::pair<JointVector<N>, double> best{JointVector<N>::Zero(), infinity};
  int patterns = 1;
  for (int j = 0; j < N; ++j) patterns *= 3;
  for (int pattern = 0; pattern < patterns; ++pattern) {
    JointMatrix<N> m = p.mass;
    JointVector<N> effort = JointVector<N>::Zero();
    bool thinkable = true;
    for (int j = 0, rest = pattern; j < N; ++j, rest /= 3) {
      if (rest % 3 == 0) {  // held: its effort is unknown, and its motion 0
        m.col(j) = -JointVector<N>::Unit(j);
      } else {
        effort[j] = rest % 3 == 1 ? p.bounds.lower[j] : p.bounds.upper[j];
        thinkable = thinkable && is_finite(effort[j]);
      }
    }
    if (!thinkable) continue;
    const JointVector<N> x = m.fullPivLu().solve(p.load + effort);
    JointVector<N> motion = x;
    for (int j = 0, rest = pattern; j < N; ++j, rest /= 3) {
      if (rest % 3 != 0) continue;
      motion[j] = 0;
      effort[j] = x[j];
    }
    const double worst = violation(p, motion, effort);
    if (worst < best.second) best = {motion, worst};
  }
  return best;
}

template <int N>
BoundedEffort<N> answer_to(const Problem<N>& p) {
  return hold_within_bounds<N>(p.parents, p.mass, p.load, p.bounds);
}

template <int N>
void compare_with_brute_force(int problems) {
  constexpr unsigned seed = 20;
  CAPTURE(N, seed);
  support::Random random(seed);
  // Efforts of about 1 with inertias down to 0.01, and the rounding of a solution between.
  constexpr double tolerance = 1e-9;
  for (int k = 0; k < problems; ++k) {
    const Problem<N> p = random_problem<N>(random);
    CAPTURE(k, p.mass, p.load.transpose(), p.bounds.lower.transpose(), p.bounds.upper.transpose());
    const auto [motion, worst] = brute_force(p);
    REQUIRE(worst < tolerance);
    const BoundedEffort<N> answer = answer_to(p);
    REQUIRE(violation<N>(p, answer.motion, answer.effort) < tolerance);
    REQUIRE((answer.motion - motion).cwiseAbs().maxCoeff() <
            tolerance * (1 + motion.cwiseAbs().maxCoeff()));
    for (int j = 0; j < N; ++j) {
      if (answer.held[j]) REQUIRE(answer.motion[j] == 0);
    }
  }
}

}  // namespace

TEST_CASE("the answer is the one that trying all sides finds") {
  compare_with_brute_force<1>(2000);
  compare_with_brute_force<2>(2000);
  compare_with_brute_force<3>(2000);
  compare_with_brute_force<4>(1000);
  compare_with_brute_force<5>(500);
}

TEST_CASE("large problems are solved as well") {
  constexpr unsigned seed = 21;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 2000; ++k) {
    CAPTURE(k);
    const Problem<12> p = random_problem<12>(random);
    const BoundedEffort<12> answer = answer_to(p);
    // The motions grow with the worse condition of twelve joints, and rounding with them.
    REQUIRE(violation<12>(p, answer.motion, answer.effort) <
            1e-9 * (1 + answer.motion.cwiseAbs().maxCoeff()));
  }
}

TEST_CASE("without bounds nothing is held") {
  Problem<2> p;
  p.mass << 2, 0.5, 0.5, 1;
  p.parents[1] = 0;
  p.load = {3, -1};
  const auto answer = answer_to(p);
  CHECK((p.mass * answer.motion - p.load).norm() < 1e-15);
  CHECK(answer.effort == Eigen::Vector2d(0, 0));
  CHECK_FALSE(answer.held[0]);
  CHECK_FALSE(answer.held[1]);
}

TEST_CASE("a load exactly at the bound is still held") {
  Problem<1> p;
  for (const double load : {2.0, -2.0}) {
    CAPTURE(load);
    p.load[0] = load;
    p.bounds = {JointVector<1>(-2.0), JointVector<1>(2.0)};
    const auto answer = answer_to(p);
    CHECK(answer.held[0]);
    CHECK(answer.motion[0] == 0);
    CHECK(answer.effort[0] == -load);
  }
}

TEST_CASE("beyond the bound the constraint gives all it has") {
  Problem<1> p;
  p.mass(0, 0) = 4;
  p.load[0] = 3;
  p.bounds = {JointVector<1>(-2.0), JointVector<1>(2.0)};
  const auto answer = answer_to(p);
  CHECK_FALSE(answer.held[0]);
  CHECK(answer.effort[0] == -2);
  CHECK(answer.motion[0] == 0.25);
}

TEST_CASE("no load, no motion, whatever the bounds") {
  for (const double bound : {0.0, support::smallest, 1.0, infinity}) {
    CAPTURE(bound);
    Problem<2> p;
    p.bounds.lower.setConstant(-bound);
    p.bounds.upper.setConstant(bound);
    CHECK(answer_to(p).motion == Eigen::Vector2d(0, 0));
  }
}

TEST_CASE("a joint held at its stop by another's impulse is found") {
  // Two joints at their lower stops: the impact of one pulls the other off, or presses it on.
  for (const double coupling : {0.9, -0.9}) {
    CAPTURE(coupling);
    Problem<2> p;
    p.parents[1] = 0;
    p.mass << 2, coupling, coupling, 1;
    p.bounds.upper.setConstant(infinity);
    p.load = p.mass * Eigen::Vector2d(-1, 0);
    const auto answer = answer_to(p);
    CHECK(answer.motion[0] == 0);
    CHECK(answer.motion[1] == Approx(coupling > 0 ? 0 : 0.9).margin(1e-15));
  }
}
