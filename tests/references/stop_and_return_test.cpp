// SPDX-License-Identifier: Apache-2.0
#include <articula/reference/stop_and_return.hpp>
#include <articula/robots/q2d.hpp>

#include "catch.hpp"
#include "numbers.hpp"

using namespace articula;

using Vector = JointVector<2>;

TEST_CASE("from rest or from motion, it moves until it is where it should be") {
  const MotionLimits<2> limits{{2, 10}, {20, 50}, {400, 1000}};
  StopAndReturn<Q2d> rest({0.1, 0.2}, limits, Q2d());
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
  StopAndReturn<Q2d> stop({0, 0}, limits, Q2d());
  stop.begin(JointReference<2>{.position = {0.1, 0.2}}, Vector(1e6, 0.3));
  CHECK(stop.advance(60).position == Vector(shoulder, 0.3));
  // Who is beyond already is not pulled in by more than was asked, nor led further out.
  stop.begin(JointReference<2>{.position = {shoulder + 0.1, 0}}, Vector(shoulder + 0.2, 0));
  CHECK(stop.advance(60).position == Vector(shoulder + 0.1, 0));
}
