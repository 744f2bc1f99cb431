// SPDX-License-Identifier: Apache-2.0
#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "robots/test_robots.hpp"

#include <articula/dynamics/friction_effort.hpp>

#include <cmath>

using namespace articula;
using Vector = JointVector<2>;

namespace {

Model<2> rubbing_arm() {
  Model<2> arm = support::model<Q2d>();
  arm.joints[0].damping = 3;
  arm.joints[0].friction = 0.5;
  arm.joints[1].damping = 0;
  arm.joints[1].friction = 2;
  return arm;
}

}  // namespace

TEST_CASE("friction works against each joint's own velocity") {
  const Model<2> arm = rubbing_arm();
  CHECK(friction_effort(arm, Vector(2, 1)) == Vector(-6.5, -2));
  CHECK(friction_effort(arm, Vector(-2, -1)) == Vector(6.5, 2));
  CHECK(friction_effort(arm, Vector(2, -1)) == Vector(-6.5, 2));
}

TEST_CASE("friction of a joint at rest is zero; at the slightest motion it is there") {
  const Model<2> arm = rubbing_arm();
  CHECK(friction_effort(arm, Vector::Zero()) == Vector::Zero());
  CHECK(friction_effort(arm, Vector(-0.0, -0.0)) == Vector::Zero());
  const double tiny = support::smallest;
  CHECK(friction_effort(arm, Vector(tiny, tiny)) == Vector(-0.5, -2));
  CHECK(friction_effort(arm, Vector(-tiny, -tiny)) == Vector(0.5, 2));
}

TEST_CASE("friction takes energy, never gives it") {
  const unsigned seed = 311;
  CAPTURE(seed);
  support::Random random(seed);
  const Model<2> arm = rubbing_arm();
  for (int k = 0; k < 1000; ++k) {
    const Vector v = random.vector<2>(std::pow(10, random.integer(-300, 300)));
    const Vector effort = friction_effort(arm, v);
    CAPTURE(v.transpose());
    for (int j = 0; j < 2; ++j) CHECK(std::signbit(effort[j]) != std::signbit(v[j]));
  }
}

TEST_CASE("the Q2D has the damping of its figures and no Coulomb friction") {
  CHECK(friction_effort(Q2d{}, Vector(1, 1)) == Vector(-29.7914, -2.6404));
  CHECK(friction_effort(Q2d{}, Vector(-0.5, 2)) == Vector(0.5 * 29.7914, -2 * 2.6404));
}

TEST_CASE("a velocity that is NaN stays visible") {
  const Vector effort = friction_effort(rubbing_arm(), Vector(support::not_a_number, 1));
  CHECK(std::isnan(effort[0]));
  CHECK(effort[1] == -2);
}
