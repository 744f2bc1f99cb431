// SPDX-License-Identifier: Apache-2.0
/// @file A robot with mimic joints against the same robot with these joints free and constrained by
/// hand: q_free = G q + c.
#include <articula/dynamics/dynamics.hpp>
#include <articula/sim/simulator.hpp>
#include <articula/urdf/urdf.hpp>

#include "catch.hpp"
#include "random.hpp"
#include "robots/energy.hpp"

using namespace articula;

namespace {

constexpr int joints = 2, bodies = 5;

const std::string file = URDF_FILES "/gripper.urdf";

/// The gripper, and the same with all joints free.
struct Pair {
  Model<joints, bodies> coupled = load_urdf<joints, bodies>(file);
  Model<bodies> free = [] {
    UrdfContents contents = *read_urdf(file);
    for (Joint& joint : contents.joints) joint.mimic = {};
    return load_urdf<bodies>(UrdfDescription(contents));
  }();
};

using Positions = JointVector<joints>;
using AllPositions = JointVector<bodies>;

/// In the order wrist, left_knuckle, left_slide, right_knuckle, right_curl; from the URDF by hand.
Eigen::Matrix<double, bodies, joints> coupling() {
  Eigen::Matrix<double, bodies, joints> G;
  G << 1, 0,  //
      0, 1,   //
      0, 0.04, 0, -0.75, 0, -1.5;
  return G;
}
AllPositions offset() { return {0, 0, 0, 0.05, 2 * 0.05 - 0.1}; }

}  // namespace

TEST_CASE("The joints of the gripper are where the hand-made coupling has them") {
  const Pair pair;
  CHECK(joint_names(pair.coupled) == std::array<std::string_view, 2>{"wrist", "left_knuckle"});
  CHECK(joint_names(pair.free) == std::array<std::string_view, 5>{"wrist", "left_knuckle",
                                                                  "left_slide", "right_knuckle",
                                                                  "right_curl"});
  const Positions q{0.4, 0.7};
  for (const char* link : {"palm", "left_finger", "left_tip", "right_finger", "right_tip"}) {
    CHECK((forward_kinematics(pair.coupled, q, link).matrix() -
           forward_kinematics(pair.free, AllPositions(coupling() * q + offset()), link).matrix())
              .norm() < 1e-15);
  }
}

TEST_CASE("Mimic joints are constraints without loss") {
  const Pair pair;
  const auto G = coupling();
  support::Random random(11);
  // Efforts are some N m, sums of some twenty products: 1e-12 is a thousand roundings.
  constexpr double tolerance = 1e-12;
  for (int sample = 0; sample < 200; ++sample) {
    CAPTURE(sample);
    const Positions q = random.vector<joints>(2), v = random.vector<joints>(3),
                    a = random.vector<joints>(10);
    const AllPositions Q = G * q + offset(), V = G * v, A = G * a;

    const Positions effort = inverse_dynamics(pair.coupled, q, v, a);
    CHECK((effort - G.transpose() * inverse_dynamics(pair.free, Q, V, A)).norm() < tolerance);
    CHECK((gravity(pair.coupled, q) - G.transpose() * gravity(pair.free, Q)).norm() < tolerance);
    CHECK(
        (nonlinear_effects(pair.coupled, q, v) - G.transpose() * nonlinear_effects(pair.free, Q, V))
            .norm() < tolerance);
    CHECK((mass_matrix(pair.coupled, q) - G.transpose() * mass_matrix(pair.free, Q) * G).norm() <
          tolerance);
    CHECK((forward_dynamics(pair.coupled, q, v, effort) - a).norm() < 1e-9 * (1 + a.norm()));
    CHECK(kinetic_energy(pair.coupled, q, v) ==
          Approx(kinetic_energy(pair.free, Q, V)).epsilon(1e-13));
    CHECK(potential_energy(pair.coupled, q) ==
          Approx(potential_energy(pair.free, Q)).epsilon(1e-13));
  }
}

TEST_CASE("Friction of mimic joints is felt with equal power") {
  const Pair pair;
  const auto G = coupling();
  support::Random random(12);
  for (int sample = 0; sample < 20; ++sample) {
    const Positions v = random.vector<joints>(3);
    const AllPositions V = G * v;
    CHECK(
        (friction_effort(pair.coupled, v) - G.transpose() * friction_effort(pair.free, V)).norm() <
        1e-14);
  }
}

TEST_CASE("A joint stays where the joints that mimic it may be") {
  const Pair pair;
  const JointLimits& limits = pair.coupled.joints[1].limits;
  // right_knuckle: -0.7 <= -0.75 q + 0.05 <= 0.25; right_curl allows |1.5 q| <= 3
  CHECK(limits.lower == Approx(-0.2));
  CHECK(limits.upper == Approx(0.9));
  CHECK(limits.velocity == Approx(1.5 / 0.75));
  CHECK(limits.effort == 5);

  UrdfContents narrow = *read_urdf(file);
  for (Joint& joint : narrow.joints) {
    if (joint.name.view() == "right_knuckle") joint.limits.lower = -0.4;
    if (joint.name.view() == "left_slide") joint.limits.velocity = 0.02;
  }
  const auto gripper = load_urdf<joints, bodies>(UrdfDescription(narrow));
  CHECK(gripper.joints[1].limits.upper == Approx(0.45 / 0.75));
  CHECK(gripper.joints[1].limits.velocity == Approx(0.5));
}

TEST_CASE("A gripper in simulation keeps its energy") {
  Model<joints, bodies> gripper = Pair{}.coupled;
  for (JointProperties& joint : gripper.joints) {
    joint.damping = joint.friction = 0;
    joint.limits = {};
  }
  Simulator<Model<joints, bodies>> simulator(gripper);
  const Positions push{0.3, 0.02};
  double unearned = 0;
  for (int k = 0; k < 500; ++k) unearned += support::unearned_energy(simulator, push);
  CHECK(std::abs(simulator.true_state().position[1]) > 0.01);
  CHECK(std::abs(unearned) < 1e-6);  // Runge-Kutta of fourth order, 0.5 s in steps of 1 ms
}

TEST_CASE("A gripper in simulation stops at its limits") {
  Simulator<Model<joints, bodies>> simulator(Pair{}.coupled);
  for (int k = 0; k < 2000; ++k) {
    CHECK(simulator.write({Positions{0.0, 4.0}}) == Status::ok);
    REQUIRE(support::within_limits(simulator));
  }
  CHECK(simulator.true_state().position[1] == Approx(0.9));
}
