// SPDX-License-Identifier: Apache-2.0
#include <articula/reference/joint_stops.hpp>
#include <articula/robots/q2d.hpp>

#include <algorithm>

#include "catch.hpp"
#include "numbers.hpp"

using namespace articula;

using Vector = JointVector<2>;

TEST_CASE("from rest or from motion, it moves until it is where it should be") {
  const MotionLimits<2> limits{{2, 10}, {20, 50}, {400, 1000}};
  JointStops<Q2d> rest(Q2d(), {0.1, 0.2}, limits);
  CHECK_FALSE(rest.moves());
  CHECK(rest.advance(1).position == Vector(0.1, 0.2));
  for (const double v : {0.0, 1.0}) {
    const JointReference<2> from{{0.1, 0.2}, {v, -v}, {0, 0}, {3, 4}};
    rest.begin(from);
    CHECK(rest.moves() == (v > 0));
    rest.begin(from, Vector(0.1, support::not_a_number));  // not known
    CHECK(rest.moves() == (v > 0));
    rest.begin(from, Vector(-0.5, 0.5));
    CHECK(rest.moves());
    static_cast<void>(rest.advance(1e-3));
    CHECK(rest.moves());
    const auto end = rest.advance(5);
    CHECK_FALSE(rest.moves());
    CHECK(end.position == Vector(-0.5, 0.5));
    CHECK(end.velocity.isZero(0));
    CHECK(end.effort == Vector(3, 4));
  }
}

TEST_CASE("a measurement beyond the joints' limits does not lead there") {
  const MotionLimits<2> limits{{2, 10}, {20, 50}, {400, 1000}};
  const double shoulder = Q2d::description.joints[1].limits.upper;
  JointStops<Q2d> stop(Q2d(), {0, 0}, limits);
  stop.begin(JointReference<2>{.position = {0.1, 0.2}}, Vector(1e6, 0.3));
  CHECK(stop.advance(60).position == Vector(shoulder, 0.3));
  // Who is beyond already is not pulled in by more than was asked, nor led further out.
  stop.begin(JointReference<2>{.position = {shoulder + 0.1, 0}}, Vector(shoulder + 0.2, 0));
  CHECK(stop.advance(60).position == Vector(shoulder + 0.1, 0));
}

TEST_CASE("a stop that would lead beyond the joints' limits ends at them") {
  const MotionLimits<2> limits{{2, 10}, {20, 50}, {400, 1000}};
  const double shoulder = Q2d::description.joints[1].limits.upper;
  JointStops<Q2d> stop(Q2d(), {0, 0}, limits);
  // 2 rad/s take 0.14 m at these limits; the elbow's stop is what it always is
  const JointReference<2> from{{shoulder - 0.05, 0}, {2, -1}, {1, 0}};
  stop.begin(from);
  CHECK(stop.advance(0).velocity == from.velocity);
  double furthest = 0;
  for (int k = 0; k < 1000; ++k) furthest = std::max(furthest, stop.advance(1e-3).position[0]);
  CHECK(furthest <= shoulder);
  CHECK(furthest > shoulder - 1e-3);  // 0.2 % of the way and as much more
  CHECK_FALSE(stop.moves());
  const auto alone = fastest_stop({0, -1, 0}, 50, 1000);
  CHECK(stop.advance(0).position[1] == alone.end().position);
}
