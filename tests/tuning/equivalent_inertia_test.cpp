// SPDX-License-Identifier: Apache-2.0
#include <articula/dynamics/forward_dynamics.hpp>
#include <articula/dynamics/gravity.hpp>
#include <articula/robots/gripper_arm.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/tuning/carried_body.hpp>
#include <articula/tuning/equivalent_inertia.hpp>
#include <articula/tuning/joint_plant.hpp>

#include <Eigen/Dense>

#include <cmath>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::infinity;
using support::not_a_number;

namespace {

const JointVector<2> stretched(0, 0);

}  // namespace

TEST_CASE("what the Q2D's joints carry has the inertias that the course's case is about") {
  // Computed apart from this library; given to six decimals.
  const CarriedBody shoulder = carried_body(Q2d(), stretched, "shoulder_active_joint");
  const CarriedBody elbow = carried_body(Q2d(), stretched, "elbow_active_joint");
  CHECK(elbow.about_center == Approx(0.008201).margin(5e-7));
  CHECK(shoulder.about_center == Approx(0.077445).margin(5e-7));
  CHECK(shoulder.about_axis == Approx(0.211797).margin(5e-7));

  // The course divides the shoulder's first moment by a mass that counts the elbow's twice.
  const double off = shoulder.lever - shoulder.mass * shoulder.lever / (shoulder.mass + elbow.mass);
  CHECK(shoulder.about_center + shoulder.mass * off * off == Approx(0.087388).margin(5e-7));
}

TEST_CASE("a carried body's mass and lever are those of the links beyond the joint") {
  const auto& links = Q2d::description.links;
  const CarriedBody elbow = carried_body(Q2d(), JointVector<2>(0.4, -1), 1);
  const double m1 = links[4].mass, m2 = links[5].mass;
  CHECK(elbow.mass == Approx(m1 + m2).epsilon(1e-14));
  const auto& c1 = links[4].center_of_mass;
  const auto& c2 = links[5].center_of_mass;
  CHECK(elbow.lever ==
        Approx(std::hypot(m1 * c1.x + m2 * c2.x, m1 * c1.y + m2 * c2.y) / (m1 + m2)));
  CHECK(elbow.about_axis == Approx(elbow.about_center + elbow.mass * elbow.lever * elbow.lever));
}

TEST_CASE("a joint carries bodies on mimic joints, one that others mimic carries several") {
  const JointVector<7> q = JointVector<7>::Constant(0.2);
  // The flange, the gripper's base and two fingers of three links.
  CHECK(carried_body(GripperArm(), q, "joint_6").mass == Approx(0.15 + 0.3 + 2 * 0.095));
  CHECK_THROWS_WITH(carried_body(GripperArm(), q, "left_outer_knuckle_joint"),
                    Contains("'left_outer_knuckle_joint'") && Contains("mimicked"));
}

TEST_CASE("with the others locked, the drive accelerates the diagonal of the mass matrix") {
  support::Random random(4);
  for (int k = 0; k < 100; ++k) {
    const JointVector<2> q = random.vector<2>(3);
    CAPTURE(k, q.transpose());
    for (int j = 0; j < 2; ++j) {
      const double inertia = equivalent_inertia(Q2d(), q, j);
      CHECK(inertia == mass_matrix(Q2d(), q)(j, j));
      // ... which is what the joint carries, turned about its axis. 1e-13: some hundred roundings.
      CHECK(inertia == Approx(carried_body(Q2d(), q, j).about_axis).epsilon(1e-13));
    }
  }
}

TEST_CASE("with the others free, a unit effort accelerates the joint by 1/I") {
  support::Random random(5);
  const JointVector<2> rest(0, 0);
  const support::TiltedQ2d tilted{};  // weight must not matter
  for (int k = 0; k < 100; ++k) {
    const JointVector<2> q = random.vector<2>(3);
    CAPTURE(k, q.transpose());
    for (int j = 0; j < 2; ++j) {
      JointVector<2> effort = gravity(tilted, q);
      effort[j] += 1;
      const double acceleration = forward_dynamics(tilted, q, rest, effort)[j];
      const double inertia = equivalent_inertia(tilted, q, j, OtherJoints::free);
      CHECK(inertia * acceleration == Approx(1).epsilon(1e-12));  // gravity of some 10 N m cancels
      CHECK(inertia <= equivalent_inertia(tilted, q, j));
    }
  }
}

TEST_CASE("joints go by name as by index, in models as in described robots") {
  const JointVector<2> q(0.3, -0.8);
  const Model<2> model = support::model<Q2d>();
  for (const OtherJoints others : {OtherJoints::locked, OtherJoints::free}) {
    const double inertia = equivalent_inertia(Q2d(), q, 1, others);
    CHECK(equivalent_inertia(Q2d(), q, "elbow_active_joint", others) == inertia);
    CHECK(equivalent_inertia(model, q, "elbow_active_joint", others) == Approx(inertia));
    const JointPlant plant = joint_plant(model, q, "elbow_active_joint", others);
    CHECK(plant.inertia == Approx(inertia));
    CHECK(plant.time_constant == Approx(inertia / 2.6404));  // the description's damping
  }
  CHECK(carried_body(model, q, 0).about_axis == Approx(carried_body(Q2d(), q, 0).about_axis));
}

TEST_CASE("a sliding joint has a mass, and without damping an infinite time constant") {
  const Model<1> slider = support::slider();
  const JointPlant plant = joint_plant(slider, JointVector<1>(0.5), 0);
  CHECK(plant.inertia == 2);
  CHECK(plant.time_constant == infinity);
  CHECK(plant.decay_rate() == 0);
}

TEST_CASE("joints that are not there and positions that are not finite are refused by name") {
  for (int j : {-1, 2, 1000}) {
    CAPTURE(j);
    const std::string index = std::to_string(j);
    CHECK_THROWS_WITH(equivalent_inertia(Q2d(), stretched, j),
                      Contains("'q2d'") && Contains(index) && Contains("0 .. 1"));
    CHECK_THROWS_WITH(carried_body(Q2d(), stretched, j), Contains(index) && Contains("0 .. 1"));
    CHECK_THROWS_WITH(joint_plant(Q2d(), stretched, j), Contains(index) && Contains("0 .. 1"));
  }
  CHECK_THROWS_WITH(equivalent_inertia(Q2d(), stretched, "knee"), Contains("'knee'"));
  for (double bad : {not_a_number, infinity, -infinity}) {
    const JointVector<2> q(0, bad);
    CHECK_THROWS_WITH(equivalent_inertia(Q2d(), q, 0), Contains("'elbow_active_joint'"));
    CHECK_THROWS_WITH(carried_body(Q2d(), q, 0), Contains("'elbow_active_joint'"));
    CHECK_THROWS_WITH(joint_plant(Q2d(), q, 0), Contains("'elbow_active_joint'"));
  }
}

TEST_CASE("a joint that moves nothing is refused where that leaves nothing to compute") {
  Model<2> arm = support::model<Q2d>();
  for (auto* mechanism : {&arm.mechanism, &arm.canonical}) mechanism->bodies[1].inertia = {};
  CHECK(equivalent_inertia(arm, stretched, 1) == 0);
  CHECK_THROWS_WITH(equivalent_inertia(arm, stretched, 0, OtherJoints::free),
                    Contains("'elbow_active_joint'") && Contains("singular"));
  CHECK_THROWS_WITH(joint_plant(arm, stretched, 1),
                    Contains("'elbow_active_joint'") && Contains("inertia 0"));
  const CarriedBody nothing = carried_body(arm, stretched, 1);
  CHECK(nothing.mass == 0);
  CHECK(nothing.lever == 0);
  CHECK(nothing.about_axis == 0);
}

TEST_CASE("plants of nonsense are refused by member and value") {
  for (double bad : {0.0, -1.0, infinity, not_a_number}) {
    CAPTURE(bad);
    CHECK_THROWS_WITH(validate(JointPlant{.inertia = bad}), Contains("inertia"));
    CHECK_THROWS_WITH(damped_plant(bad, 1), Contains("inertia"));
  }
  for (double bad : {0.0, -1.0, -infinity, not_a_number, support::smallest}) {
    CAPTURE(bad);
    CHECK_THROWS_WITH(validate(JointPlant{.time_constant = bad}), Contains("time_constant"));
  }
  for (double bad : {-1.0, infinity, -infinity, not_a_number}) {
    CAPTURE(bad);
    CHECK_THROWS_WITH(damped_plant(1, bad), Contains("damping"));
  }
  CHECK(damped_plant(3, 6).time_constant == 0.5);
  CHECK(damped_plant(3, 0).time_constant == infinity);
}
