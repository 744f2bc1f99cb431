// SPDX-License-Identifier: Apache-2.0
// The inertia of the drives' rotors, as the joints feel it, in all equations of motion.
#include "articula/dynamics/dynamics.hpp"

#include "articula/hardware/transmission/four_bar_transmission.hpp"
#include "articula/robots/q2d.hpp"
#include "catch.hpp"
#include "robots/random_robots.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace articula;

namespace {

/// The Q2D with the rotors of its harmonic drives.
struct GearedQ2d {
  static constexpr auto description = [] {
    auto geared = Q2d::description;
    geared.name = "geared_q2d";
    geared.gravity = {3, 0, -9};
    geared.joints[1].reflected_inertia = 0.25;
    geared.joints[3].reflected_inertia = 0.0625;
    return geared;
  }();
};

struct LevelGearedQ2d {
  static constexpr auto description = [] {
    auto geared = GearedQ2d::description;
    geared.gravity = Q2d::description.gravity;
    return geared;
  }();
};

/// The Q2D behind a four-bar transmission of 50 and 40 with rotors of 4e-5 and 2e-5 kg m^2: A^T
/// diag(J) A with A = {50, 0; 40, 40}.
struct FourBarQ2d {
  static constexpr auto description = [] {
    auto driven = Q2d::description;
    driven.name = "four_bar_q2d";
    driven.joints[1].reflected_inertia = 0.132;
    driven.joints[3].reflected_inertia = 0.032;
    driven.joints[3].shared_rotors = {"shoulder_active_joint", 0.032};
    return driven;
  }();
};

/// 2 kg on a massless rod of 0.5 m, which hangs from a horizontal axis behind a gear of 40 : 1 with
/// a rotor of 1e-3 kg m^2.
support::Blueprint pendulum() {
  return {.gravity = {0, 0, -10},
          .links = {{.name = "stand"},
                    {.name = "rod",
                     .mass = 2,
                     .center_of_mass = {0, 0, -0.5},
                     .inertia = {.xx = 0.02, .yy = 0.03, .zz = 0.025}}},
          .joints = {{.name = "pivot",
                      .type = JointType::continuous,
                      .parent = "stand",
                      .child = "rod",
                      .axis = {0, 1, 0},
                      .reflected_inertia = 40 * 40 * 1e-3}}};
}

}  // namespace

TEST_CASE("a pendulum behind a gear is as computed by hand") {
  const Model<1> model = pendulum().model<1>();
  const double whole = 0.03 + 2 * 0.25 + 1.6;  // kg m^2: own, of the point, of the rotor
  const JointVector<1> q(0.7), v(-3), a(5);
  const double weight = 2 * 10 * 0.5 * std::sin(0.7);
  // A handful of roundings of numbers up to 20.
  CHECK(mass_matrix(model, q)(0, 0) == Approx(whole).epsilon(1e-14));
  CHECK(inverse_dynamics(model, q, v, a)[0] == Approx(whole * 5 + weight).epsilon(1e-14));
  CHECK(forward_dynamics(model, q, v, JointVector<1>(2.0))[0] ==
        Approx((2 - weight) / whole).epsilon(1e-14));
  CHECK(nonlinear_effects(model, q, v)[0] == Approx(weight).epsilon(1e-14));
  CHECK(gravity(model, q)[0] == Approx(weight).epsilon(1e-14));
  CHECK(kinetic_energy(model, q, v) == Approx(whole * 9 / 2).epsilon(1e-14));
}

TEST_CASE("a robot known at compile time has the rotors, and only on the diagonal") {
  auto bare = support::blueprint_of(GearedQ2d::description);
  for (Joint& joint : bare.joints) joint.reflected_inertia = 0;
  const Model<2> without = bare.model<2>();
  const Model<2> loaded = support::blueprint_of(GearedQ2d::description).model<2>();
  constexpr unsigned seed = 5;
  CAPTURE(seed);
  support::Random random(seed);
  const JointMatrix<2> rotors = JointVector<2>(0.25, 0.0625).asDiagonal();
  for (int trial = 0; trial < 100; ++trial) {
    const JointVector<2> q = random.vector<2>(3), v = random.vector<2>(3), a = random.vector<2>(9);
    const GearedQ2d robot;
    const JointMatrix<2> m = mass_matrix(without, q) + rotors;
    CHECK((mass_matrix(robot, q) - m).norm() < 1e-13);
    CHECK((mass_matrix(loaded, q) - m).norm() < 1e-13);
    const JointVector<2> effort = inverse_dynamics(without, q, v, a) + rotors * a;
    CHECK((inverse_dynamics(robot, q, v, a) - effort).norm() < 1e-12);
    CHECK((inverse_dynamics(loaded, q, v, a) - effort).norm() < 1e-12);
    CHECK((forward_dynamics(robot, q, v, effort) - a).norm() < 1e-11);
    CHECK((forward_dynamics(loaded, q, v, effort) - a).norm() < 1e-11);
    CHECK((nonlinear_effects(robot, q, v) - nonlinear_effects(without, q, v)).norm() < 1e-13);
    CHECK((gravity(robot, q) - gravity(without, q)).norm() < 1e-13);
    CHECK(kinetic_energy(robot, q, v) == Approx(v.dot(m * v) / 2).epsilon(1e-13));
    CHECK(kinetic_energy(loaded, q, v) == Approx(v.dot(m * v) / 2).epsilon(1e-13));
  }
}

TEST_CASE("the rotors of mimic joints are felt by the square of their multipliers") {
  constexpr unsigned seed = 6;
  CAPTURE(seed);
  support::Random random(seed);
  for (int robot = 0; robot < 50; ++robot) {
    CAPTURE(robot);
    support::Blueprint blueprint = support::random_robot(random, 5, support::Shape::tree, 2);
    const Model<3, 5> without = blueprint.model<3, 5>();
    JointVector<3> felt = JointVector<3>::Zero();
    for (Joint& joint : blueprint.joints) {
      if (joint.type == JointType::fixed) continue;
      joint.reflected_inertia = random.one_in(3) ? 0 : random.number(0, 2);
      const bool mimics = !joint.mimic.joint.empty();
      const double multiplier = mimics ? joint.mimic.multiplier : 1;
      felt[joint_index(without, mimics ? joint.mimic.joint.view() : joint.name.view())] +=
          multiplier * multiplier * joint.reflected_inertia;
    }
    const Model<3, 5> geared = blueprint.model<3, 5>();
    const JointVector<3> q = random.vector<3>(3), v = random.vector<3>(2), a = random.vector<3>(5);
    const JointMatrix<3> m = mass_matrix(without, q) + JointMatrix<3>(felt.asDiagonal());
    // Efforts are some hundred N m; a mass matrix may be conditioned like 1e4.
    CHECK((mass_matrix(geared, q) - m).norm() < 1e-11);
    const JointVector<3> effort = inverse_dynamics(geared, q, v, a);
    CHECK((effort - inverse_dynamics(without, q, v, a) - felt.cwiseProduct(a)).norm() < 1e-10);
    CHECK((forward_dynamics(geared, q, v, effort) - a).norm() < 1e-8);
    CHECK(kinetic_energy(geared, q, v) == Approx(v.dot(m * v) / 2).epsilon(1e-12));
  }
}

TEST_CASE("rotors that two joints share stand off the diagonal, also between branches") {
  constexpr unsigned seed = 7;
  CAPTURE(seed);
  support::Random random(seed);
  for (int robot = 0; robot < 100; ++robot) {
    CAPTURE(robot);
    support::Blueprint blueprint = support::random_robot(random, 5, support::Shape::tree, 2);
    const Model<3, 5> without = blueprint.model<3, 5>();
    std::vector<Joint*> free;
    for (Joint& joint : blueprint.joints) {
      if (joint.type != JointType::fixed && joint.mimic.joint.empty()) free.push_back(&joint);
    }
    REQUIRE(free.size() == 3);
    std::shuffle(free.begin(), free.end(), std::minstd_rand(static_cast<unsigned>(robot)));
    // One rotor for both joints in every third robot: the rotors' matrix is singular then.
    const double n = random.number(-2, 2), m = random.number(0.5, 2), own = random.integer(0, 2);
    free[0]->reflected_inertia = n * n + own;
    free[1]->reflected_inertia = m * m + own;
    free[0]->shared_rotors = {free[1]->name, n * m};
    REQUIRE(blueprint.fault().rule == Rule::none);
    const int i = joint_index(without, free[0]->name.view());
    const int j = joint_index(without, free[1]->name.view());
    JointMatrix<3> rotors = JointMatrix<3>::Zero();
    rotors(i, i) = free[0]->reflected_inertia;
    rotors(j, j) = free[1]->reflected_inertia;
    rotors(i, j) = rotors(j, i) = n * m;

    const Model<3, 5> geared = blueprint.model<3, 5>();
    const JointVector<3> q = random.vector<3>(3), v = random.vector<3>(2), a = random.vector<3>(5);
    // Tolerances as above.
    const JointMatrix<3> matrix = mass_matrix(without, q) + rotors;
    CHECK((mass_matrix(geared, q) - matrix).norm() < 1e-11);
    const JointVector<3> effort = inverse_dynamics(geared, q, v, a);
    CHECK((effort - inverse_dynamics(without, q, v, a) - rotors * a).norm() < 1e-10);
    CHECK((forward_dynamics(geared, q, v, effort) - a).norm() < 1e-8);
    CHECK(kinetic_energy(geared, q, v) == Approx(v.dot(matrix * v) / 2).epsilon(1e-12));
  }
}

TEST_CASE("the rotors of a four-bar transmission in a robot known at compile time") {
  const FourBarTransmission linkage{.actuator_reduction = {50, 40}};
  const JointMatrix<2> rotors = reflected_inertia(linkage, JointVector<2>(4e-5, 2e-5));
  const FourBarQ2d robot;
  for (const Joint& joint : FourBarQ2d::description.joints) {
    if (joint.name == Name("elbow_active_joint")) {
      CHECK(joint.shared_rotors.inertia == Approx(rotors(0, 1)).epsilon(1e-14));
    }
  }
  support::Random random(8);
  const JointVector<2> q = random.vector<2>(3), v = random.vector<2>(3), a = random.vector<2>(9);
  const JointVector<2> effort = inverse_dynamics(Q2d{}, q, v, a) + rotors * a;
  CHECK((inverse_dynamics(robot, q, v, a) - effort).norm() < 1e-12);
  CHECK((forward_dynamics(robot, q, v, effort) - a).norm() < 1e-11);
  CHECK((mass_matrix(robot, q) - mass_matrix(Q2d{}, q) - rotors).norm() < 1e-13);
}

TEST_CASE("rotors that cannot be shared are refused") {
  support::Random random(9);
  const support::Blueprint bare = support::random_robot(random, 3, support::Shape::chain, 0);
  const auto rule = [&](const auto& change) {
    support::Blueprint robot = bare;
    std::vector<Joint*> moving;
    for (Joint& joint : robot.joints) {
      if (joint.type == JointType::fixed) continue;
      joint.reflected_inertia = 2;
      moving.push_back(&joint);
    }
    change(*moving[0], *moving[1], *moving[2], robot.joints);
    return robot.fault().rule;
  };
  using Joints = std::vector<Joint>;
  const auto pair = [&](int from, int to) {
    return rule([&](Joint& a, Joint& b, Joint& c, Joints&) {
      Joint* const joints[] = {&a, &b, &c};
      a.shared_rotors = {b.name, 1};
      joints[from]->shared_rotors = {joints[to]->name, 0.5};
    });
  };
  CHECK(pair(0, 1) == Rule::none);
  CHECK(pair(0, 2) == Rule::none);
  CHECK(pair(1, 0) == Rule::rotors_are_shared_twice);
  CHECK(pair(1, 2) == Rule::rotors_are_shared_twice);
  CHECK(pair(2, 0) == Rule::rotors_are_shared_twice);
  CHECK(pair(2, 1) == Rule::rotors_are_shared_twice);
  const auto shared = [&](double inertia) {
    return rule([&](Joint& a, Joint& b, Joint&, Joints&) { a.shared_rotors = {b.name, inertia}; });
  };
  CHECK(shared(-2) == Rule::none);
  CHECK(shared(2 * (1 + 1e-15)) == Rule::none);  // one rotor, rounded
  CHECK(shared(2.0001) == Rule::shared_inertia_is_too_large);
  CHECK(shared(-2.0001) == Rule::shared_inertia_is_too_large);
  CHECK(rule([](Joint& a, Joint& b, Joint&, Joints&) {
          a.reflected_inertia = b.reflected_inertia = 0;
          a.shared_rotors = {b.name, 1e-170};
        }) == Rule::shared_inertia_is_too_large);
  const auto weld = [](Joint& joint) {
    joint = {.name = joint.name, .parent = joint.parent, .child = joint.child};
  };
  constexpr Rule nobody = Rule::rotors_are_shared_with_no_free_joint;
  CHECK(rule([](Joint& a, Joint&, Joint&, Joints&) { a.shared_rotors = {a.name, 1}; }) == nobody);
  CHECK(rule([](Joint& a, Joint&, Joint&, Joints&) { a.shared_rotors = {"", 1}; }) == nobody);
  CHECK(rule([&](Joint& a, Joint& b, Joint&, Joints&) {
          weld(a);
          a.shared_rotors = {b.name, 1};
        }) == nobody);
  CHECK(rule([&](Joint& a, Joint& b, Joint&, Joints&) {
          weld(b);
          a.shared_rotors = {b.name, 1};
        }) == nobody);
  CHECK(rule([](Joint& a, Joint& b, Joint& c, Joints&) {
          b.mimic.joint = c.name;
          a.shared_rotors = {b.name, 1};
        }) == nobody);
}

TEST_CASE("a rotor of any use is taken, a negative one is not") {
  support::Blueprint huge = pendulum();
  huge.joints[0].reflected_inertia = 1e50;
  REQUIRE(huge.fault().rule == Rule::none);
  const Model<1> model = huge.model<1>();
  CHECK(inverse_dynamics(model, JointVector<1>(0.0), JointVector<1>(0.0), JointVector<1>(1.0))[0] ==
        1e50);
  huge.joints[0].reflected_inertia = -1e-300;
  CHECK(huge.fault().rule == Rule::reflected_inertia_is_negative);
}

TEST_CASE("rotors cost one multiplication and one addition per joint at most") {
  constexpr auto bare = operations<InverseDynamics, Q2d>();
  constexpr auto geared = operations<InverseDynamics, LevelGearedQ2d>();
  CHECK(geared.multiplications <= bare.multiplications + 2);
  CHECK(geared.additions <= bare.additions + 2);
}
