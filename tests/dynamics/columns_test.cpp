// SPDX-License-Identifier: Apache-2.0
// Several robots at once: column k of each result is what robot k alone gives.
#include <articula/dynamics/dynamics.hpp>
#include <articula/robots/q2d.hpp>

#include "catch.hpp"
#include "numbers.hpp"
#include "robots/random_robots.hpp"
#include "robots/test_robots.hpp"

#include <initializer_list>

using namespace articula;

namespace {

/// The same operations, of which compilers fuse some here and others there: some hundred roundings
/// of 1.1e-16 of the largest terms. For accelerations times the condition of the mass matrix, up to
/// 1e4.
constexpr double rounding = 1e-12;

template <int K, Robot R>
void check(const R& robot, support::Random& random, double angles) {
  constexpr int n = joint_count<R>;
  using Vectors = JointVectors<n, K>;
  const auto vectors = [&](double size) {
    Vectors values;
    for (int k = 0; k < K; ++k) values.col(k) = random.vector<n>(size);
    return values;
  };
  const Vectors q = vectors(angles), v = vectors(2), a = vectors(5), effort = vectors(20);
  const Vectors inverse = inverse_dynamics(robot, q, v, a), bias = nonlinear_effects(robot, q, v),
                weight = gravity(robot, q), forward = forward_dynamics(robot, q, v, effort);
  for (int k = 0; k < K; ++k) {
    CAPTURE(K, k, angles);
    const JointVector<n> own_q = q.col(k), own_v = v.col(k), own_a = a.col(k),
                         own_effort = effort.col(k);
    const auto close = [&](const Vectors& all, const JointVector<n>& one, double tolerance) {
      const JointVector<n> column = all.col(k);
      return (column - one).norm() <= tolerance * (1 + one.norm());
    };
    CHECK(close(inverse, inverse_dynamics(robot, own_q, own_v, own_a), rounding));
    CHECK(close(bias, nonlinear_effects(robot, own_q, own_v), rounding));
    CHECK(close(weight, gravity(robot, own_q), rounding));
    CHECK(close(forward, forward_dynamics(robot, own_q, own_v, own_effort), 1e4 * rounding));
  }
}

template <Robot R>
void check_all(const R& robot, support::Random& random, std::initializer_list<double> sizes) {
  for (const double angles : sizes) {
    check<2>(robot, random, angles);
    check<3>(robot, random, angles);
    check<4>(robot, random, angles);
    check<7>(robot, random, angles);
    check<8>(robot, random, angles);
    check<13>(robot, random, angles);
  }
}

}  // namespace

TEST_CASE("Robots known at compile time move side by side as they do alone") {
  const unsigned seed = 441;
  CAPTURE(seed);
  support::Random random(seed);
  for (int trial = 0; trial < 20; ++trial) {
    // Some so large that their sines are left to <cmath>.
    check_all(Q2d{}, random, {0.0, 3.0, 1e5, 1e9});
    check_all(support::TiltedQ2d{}, random, {0.0, 3.0, 1e5, 1e9});
  }
}

TEST_CASE("Models move side by side as they do alone") {
  const unsigned seed = 442;
  CAPTURE(seed);
  support::Random random(seed);
  for (int trial = 0; trial < 20; ++trial) {
    // Not large: what mimics another joint turns by a multiple of its position, which is rounded,
    // and prismatic joints would slide as far.
    check_all(support::random_robot(random, 1).model<1>(), random, {0.0, 3.0});
    check_all(support::random_robot(random, 4, support::Shape::tree, 1).model<3, 4>(), random,
              {0.0, 3.0});
  }
}

TEST_CASE("A robot with a state that is not finite disturbs none of its neighbours") {
  JointVectors<2, 8> q = JointVectors<2, 8>::Constant(0.3), v = q, effort = q;
  q(1, 2) = support::not_a_number;
  q(1, 5) = support::infinity;
  effort(0, 7) = support::infinity;
  const JointVectors<2, 8> a = forward_dynamics(Q2d{}, q, v, effort);
  const JointVector<2> alone = forward_dynamics(Q2d{}, JointVector<2>(0.3, 0.3),
                                                JointVector<2>(0.3, 0.3), JointVector<2>(0.3, 0.3));
  for (int k = 0; k < 8; ++k) {
    CAPTURE(k);
    if (k == 2 || k == 5 || k == 7) {
      CHECK_FALSE(a.col(k).allFinite());
    } else {
      CHECK((a.col(k) - alone).norm() <= rounding * alone.norm());
    }
  }
}
