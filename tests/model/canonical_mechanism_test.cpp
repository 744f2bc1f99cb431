// SPDX-License-Identifier: Apache-2.0
#include "articula/model/canonical_mechanism.hpp"

#include "articula/dynamics/engine/body_placements.hpp"
#include "articula/dynamics/gravity.hpp"
#include "articula/dynamics/inverse_dynamics.hpp"
#include "articula/dynamics/kinetic_energy.hpp"
#include "articula/dynamics/mass_matrix.hpp"
#include "articula/dynamics/potential_energy.hpp"
#include "articula/robots/q2d.hpp"
#include "catch.hpp"
#include "numbers.hpp"
#include "robots/random_mechanism.hpp"

#include <cmath>

using namespace articula;  // NOLINT

namespace {

constexpr int n = 9;

// Some hundred operations on numbers up to about 1e4, each off by 1e-16 of its size.
Approx same(double value) { return Approx(value).epsilon(1e-11).margin(1e-10); }

struct State {
  JointArray<double, n> q, v, a;
};

State random_state(test::Randomness& random) {
  return {random.numbers<n>(-3, 3), random.numbers<n>(-2, 2), random.numbers<n>(-5, 5)};
}

}  // namespace

TEST_CASE("Axes that are all but parallel are not taken as parallel with tolerance 0") {
  for (const double angle : {1e-7, 1.1e-8, 1e-8, 3e-9, 1e-9, 1e-12}) {
    for (const bool opposite : {false, true}) {
      CAPTURE(angle, opposite);
      Mechanism<2> chain;
      chain.gravity = {0, -9.8, 0};
      const double turn = opposite ? 3.14159265358979324 - angle : angle;
      chain.bodies[0] = {.parent = -1, .placement = {rotation_from_rpy({0.1, 0.2, 0.3}), {}}};
      chain.bodies[1] = {.parent = 0,
                         .placement = {rotation_from_rpy({turn, 0, 0}), {0, 0.3, 0.4}}};
      for (Body& body : chain.bodies) {
        body.inertia = {2, {0.2, 0.6, 0.8}, {1.5, -0.1, -0.1, 1.2, -0.3, 0.9}};
      }
      const Mechanism<2> canonical = canonical_form(chain, 0).mechanism;
      const JointArray<double, 2> q{0.7, -1.1}, v{1, -2}, a{3, 4};
      const auto own = configuration_of<double, 2, 2>(chain, q);
      for (const auto& other : {configuration_of<double, 2, 2>(canonical, q),
                                configuration_of<double, 2, 2, Frames::resting>(canonical, q)}) {
        const auto effort = InverseDynamics::evaluate(chain, own, v, a);
        const auto other_effort = InverseDynamics::evaluate(canonical, other, v, a);
        // Some hundred roundings of numbers up to 50.
        for (std::size_t i = 0; i < 2; ++i) {
          CHECK(std::abs(other_effort[i] - effort[i]) <= 1e-13);
        }
      }
    }
  }
}

TEST_CASE("The canonical form of any tree moves as the tree itself") {
  test::Randomness random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Mechanism<n> tree = random.mechanism<n>();
    const CanonicalMechanism<n> canonical = canonical_form(tree);
    const State state = random_state(random);
    const auto configuration = configuration_of<double, n, n>(tree, state.q);
    const auto other = configuration_of<double, n, n>(canonical.mechanism, state.q);

    const auto effort = InverseDynamics::evaluate(tree, configuration, state.v, state.a);
    const auto other_effort =
        InverseDynamics::evaluate(canonical.mechanism, other, state.v, state.a);
    const auto gravity = Gravity::evaluate(tree, configuration);
    const auto other_gravity = Gravity::evaluate(canonical.mechanism, other);
    const auto matrix = MassMatrix::evaluate(tree, configuration);
    const auto other_matrix = MassMatrix::evaluate(canonical.mechanism, other);
    for (int i = 0; i < n; ++i) {
      CAPTURE(trial, i);
      CHECK(other_effort[i] == same(effort[i]));
      CHECK(other_gravity[i] == same(gravity[i]));
      for (int j = 0; j < n; ++j) CHECK(other_matrix[i][j] == same(matrix[i][j]));
    }
    CHECK(KineticEnergy::evaluate(canonical.mechanism, other, state.v) ==
          same(KineticEnergy::evaluate(tree, configuration, state.v)));
    const double of_base = -dot(tree.gravity, canonical.base.first_moment);
    CHECK(PotentialEnergy::evaluate(canonical.mechanism, other) + of_base ==
          same(PotentialEnergy::evaluate(tree, configuration)));
  }
}

TEST_CASE("The canonical form says where its frames are") {
  test::Randomness random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const Mechanism<n> tree = random.mechanism<n>();
    const CanonicalMechanism<n> canonical = canonical_form(tree);
    const auto q = random.numbers<n>(-3, 3);
    const auto old_frames = BodyPlacements::evaluate(tree, configuration_of<double, n, n>(tree, q));
    const auto new_frames = BodyPlacements::evaluate(
        canonical.mechanism, configuration_of<double, n, n>(canonical.mechanism, q));
    for (int i = 0; i < n; ++i) {
      const Placement<double> expected =
          old_frames[i] * canonical.frames[static_cast<std::size_t>(i)];
      const Vector3<double> difference = new_frames[i].translation - expected.translation;
      CHECK(std::sqrt(dot(difference, difference)) < 1e-13);
      for (int k = 0; k < 3; ++k) {
        const Vector3<double> turn = new_frames[i].rotation.column(k) - expected.rotation.column(k);
        CHECK(std::sqrt(dot(turn, turn)) < 1e-13);
      }
    }
  }
}

TEST_CASE("What a joint cannot feel is gone from its body") {
  test::Randomness random(3);
  const CanonicalMechanism<n> canonical = canonical_form(random.mechanism<n>());
  for (const Body& body : canonical.mechanism.bodies) {
    const auto& [mass, h, i] = body.inertia;
    if (body.prismatic) {
      CHECK(mass > 0);
      CHECK(i == Symmetric3<double>{});
    } else {
      CHECK(mass == 0);
      CHECK(h.z == 0);
      CHECK(i.zz == i.xx + i.yy);
    }
  }
}

TEST_CASE("Origins lie across the axis from the parent's origin") {
  test::Randomness random(4);
  const CanonicalMechanism<n> canonical = canonical_form(random.mechanism<n>());
  for (const Body& body : canonical.mechanism.bodies) {
    CHECK(std::abs(dot(body.placement.rotation.column(2), body.placement.translation)) < 1e-14);
  }
}

TEST_CASE("Frames on parallel axes are not turned against each other") {
  Mechanism<3> chain;
  for (std::size_t i = 0; i < 3; ++i) {
    chain.bodies[i].parent = static_cast<int>(i) - 1;
    chain.bodies[i].placement = {rotation_from_rpy({0, 0, 0.3}), {1, 0, 0}};
  }
  chain.bodies[2].placement.rotation = rotation_from_rpy({3.141592653589793, 0, 0.7});
  const auto bodies = canonical_form(chain).mechanism.bodies;
  CHECK(bodies[1].placement.rotation == Matrix3<double>::identity());
  CHECK(bodies[2].placement.rotation == Matrix3<double>{{{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}});
}

TEST_CASE("Right angles written with few digits are recognised within the tolerance") {
  Mechanism<1> arm;
  const Matrix3<double> quarter_turn{{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}}};
  const auto rotation = [&](double angle, auto... tolerance) {
    arm.bodies[0].placement.rotation = rotation_from_rpy({angle, 0, 0});
    return canonical_form(arm, tolerance...).mechanism.bodies[0].placement.rotation;
  };
  CHECK(rotation(1.5707963) == quarter_turn);
  CHECK_FALSE(rotation(1.570796) == quarter_turn);
  CHECK(rotation(1.570796, 1e-6) == quarter_turn);
  CHECK(rotation(1.5708, 1e-5) == quarter_turn);
  CHECK(rotation(1.5707963, 0.0) == rotation_from_rpy({1.5707963, 0, 0}));
  CHECK(rotation(0.3).rows[1].y == Approx(std::cos(0.3)).epsilon(1e-15));
}

TEST_CASE("An angle beyond the tolerance is not taken for a right one in part") {
  // Turned on, as by a joint that is locked, one small element is within the tolerance, another is
  // not.
  const Matrix3<double> turned = rotation_from_rpy({1.5708, 0, 0}) * rotation_from_rpy({0, 0, 0.2});
  REQUIRE(std::abs(turned.rows[1].x) < 1e-6);
  REQUIRE(std::abs(turned.rows[1].y) > 1e-6);
  Mechanism<1> arm;
  arm.bodies[0].placement.rotation = turned;
  const Matrix3<double> is = canonical_form(arm, 1e-6).mechanism.bodies[0].placement.rotation;
  for (int k = 0; k < 3; ++k) {
    const Vector3<double> off = is.column(k) - turned.column(k);
    CHECK(std::sqrt(dot(off, off)) < 1e-15);  // rounding
  }
}

TEST_CASE("The canonical form can be had at compile time") {
  constexpr Mechanism<1> pendulum{
      .bodies = {{{{.parent = -1,
                    .prismatic = false,
                    .placement = {},
                    .inertia = {2, {0.5, 0, 0.25}, {0.5, 0, 0, 1, 0, 0.75}}}}}},
      .couplings = {},
      .gravity = {0, 0, -9.81}};
  constexpr CanonicalMechanism<1> canonical = canonical_form(pendulum);
  STATIC_REQUIRE(canonical.mechanism.bodies[0].inertia.mass == 0);
  STATIC_REQUIRE(canonical.mechanism.bodies[0].inertia.moment.zz == 0.75);
  STATIC_REQUIRE(canonical.base.mass == 2);
}

TEST_CASE("A tolerance of right angles that is none is refused") {
  const auto& mechanism = model_of(Q2d()).mechanism;
  for (const double tolerance : {-1e-9, 0.11, 10.0, support::infinity, support::not_a_number}) {
    CAPTURE(tolerance);
    CHECK_THROWS_AS(canonical_form(mechanism, tolerance), std::invalid_argument);
  }
  CHECK_NOTHROW(canonical_form(mechanism, 0));
  CHECK_NOTHROW(canonical_form(mechanism, 0.1));
}
