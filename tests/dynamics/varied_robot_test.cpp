// SPDX-License-Identifier: Apache-2.0
// Robots with changed numbers by programs, against the same changed descriptions by the algorithms
// themselves, which run on a model in other frames. Efforts and accelerations of both agree to
// 1e-9 of their size: rounding, times the condition of the mass matrix.
#include "catch.hpp"

#include <articula/dynamics/dynamics.hpp>
#include <articula/dynamics/varied_robot.hpp>
#include <articula/robots/panda.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/robots/ur10.hpp>
#include <articula/sim/simulator.hpp>

#include <random>
#include <string>

using namespace articula;
using Catch::Matchers::Contains;

namespace {

constexpr unsigned seed = 18;

/// Masses, inertias and centres of mass of all links times factors; the centre of mass of a link
/// keeps its direction, so that no zero is lost.
template <class R>
auto changed(std::mt19937& engine, double spread) {
  std::uniform_real_distribution<double> factor(1 - spread, 1 + spread);
  auto description = R::description;
  for (Link& link : description.links) {
    const double scale = factor(engine);
    link.mass *= scale;
    link.center_of_mass = factor(engine) * link.center_of_mass;
    Symmetric3<double>& i = link.inertia;
    for (double* x : {&i.xx, &i.xy, &i.xz, &i.yy, &i.yz, &i.zz}) *x *= scale;
  }
  for (Joint& joint : description.joints) joint.origin = factor(engine) * joint.origin;
  return description;
}

template <class R>
void compare() {
  CAPTURE(seed);
  constexpr int n = joint_count<R>;
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> number(-3, 3);
  for (int robot = 0; robot < 20; ++robot) {
    const VariedRobot<R> varied(changed<R>(engine, robot < 10 ? 0.2 : 0.9));
    const auto model = detail::changed_model<R>(changed<R>(engine, 0));
    using Model = std::remove_cvref_t<decltype(model)>;
    const Model& same = varied;
    for (int state = 0; state < 10; ++state) {
      const auto random = [&] { return for_each_joint<n>([&](int) { return number(engine); }); };
      const JointVector<n> q = random(), v = random(), x = random();
      const auto agree = [&](const auto& a, const auto& b) {
        CAPTURE(robot, a, b);
        CHECK((a - b).norm() <= 1e-9 * (1 + b.norm()));
      };
      agree(inverse_dynamics(varied, q, v, x), inverse_dynamics(same, q, v, x));
      agree(gravity(varied, q), gravity(same, q));
      agree(mass_matrix(varied, q), mass_matrix(same, q));
      agree(forward_dynamics(varied, q, v, x), forward_dynamics(same, q, v, x));
      CHECK((forward_dynamics(varied, q, v, x) - forward_dynamics(model, q, v, x)).norm() > 1e-6);
    }
  }
}

/// The message of the error that a change of the description or model causes.
template <class R, class Changed>
std::string refusal(const Changed& robot) {
  try {
    VariedRobot<R>{robot};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("A varied Q2D has the dynamics of its changed description") { compare<Q2d>(); }
TEST_CASE("A varied UR10 has the dynamics of its changed description") { compare<Ur10>(); }
TEST_CASE("A varied Panda has the dynamics of its changed description") { compare<Panda>(); }

TEST_CASE("Numbers as inputs cost a program little") {
  constexpr auto constants = operations<ForwardDynamics, Panda>();
  constexpr auto inputs = operations<ForwardDynamics, WithInputNumbers<Panda>>();
  CHECK(inputs.cost() < 1.05 * constants.cost());
  CHECK(VariedRobot<Panda>::number_count == 55);
}

TEST_CASE("A varied robot has the inertia of its drives") {
  auto model = model_of(Q2d{});
  model.mechanism.bodies[0].reflected_inertia = 1;
  CHECK_THAT(refusal<Q2d>(model), Contains("reflected inertia of the body of joint "
                                           "'shoulder_active_joint' is 1") &&
                                      Contains("must stay 0"));
}

TEST_CASE("A varied robot that cannot exist or is of another kind is refused by name") {
  auto description = Q2d::description;
  description.links[5].mass = -1;
  CHECK_THAT(refusal<Q2d>(description),
             Contains("'elbow_passive_link'") && Contains("the mass is negative"));
  description = Q2d::description;
  description.gravity.x = 1;
  CHECK_THAT(refusal<Q2d>(description), Contains("gravity differs"));
  description = Q2d::description;
  description.joints[1].axis = {0, 1, 0};
  CHECK_THAT(refusal<Q2d>(description), Contains("the axis of joint"));
  auto arm = Ur10::description;
  for (Link& link : arm.links) link.center_of_mass.x += 0.1;
  CHECK_THAT(refusal<Ur10>(arm), Contains("first moment") && Contains("must stay 0"));
  auto model = model_of(Q2d{});
  model.mechanism.bodies[1].inertia.mass = -2;
  CHECK_THAT(refusal<Q2d>(model), Contains("'elbow_active_joint'") && Contains("the mass -2"));
  model = model_of(Q2d{});
  model.joints[0].friction = -1;
  CHECK_THAT(refusal<Q2d>(model), Contains("the friction -1"));
  model = model_of(Q2d{});
  model.joints[1].limits.lower = 4;
  CHECK_THAT(refusal<Q2d>(model), Contains("the limits 4 .."));
  CHECK(refusal<Q2d>(Q2d::description) == "accepted");
}
