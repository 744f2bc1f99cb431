// SPDX-License-Identifier: Apache-2.0
#include <articula/hardware/transmission/differential_transmission.hpp>
#include <articula/hardware/transmission/four_bar_transmission.hpp>
#include <articula/hardware/transmission/reversed_transmission.hpp>
#include <articula/hardware/transmission/simple_transmission.hpp>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::infinity;
using support::not_a_number;

namespace {

using One = JointVector<1>;
using Two = JointVector<2>;

double reduction(support::Random& random) {
  return (random.one_in(2) ? 1 : -1) * std::pow(10, random.number(-2, 3));
}

void draw(support::Random& random, SimpleTransmission& t) {
  t = {reduction(random), random.number(-3, 3)};
}
template <class T>
void draw(support::Random& random, T& t) {
  for (std::size_t k = 0; k < 2; ++k) {
    t.actuator_reduction[k] = reduction(random);
    t.joint_reduction[k] = reduction(random);
    t.joint_offset[k] = random.number(-3, 3);
  }
}
template <class T>
void draw(support::Random& random, Reversed<T>& t) {
  draw(random, t.transmission);
}

template <class T>
std::string refusal(const T& transmission) {
  try {
    validate(transmission, "wrist");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a simple transmission multiplies effort and divides motion") {
  const SimpleTransmission gear{.reduction = -50, .joint_offset = 0.25};
  CHECK(gear.joint_position(One(100.0))[0] == -1.75);
  CHECK(gear.joint_velocity(One(100.0))[0] == -2);
  CHECK(gear.joint_effort(One(0.5))[0] == -25);
  CHECK(gear.actuator_position(One(-1.75))[0] == 100);
  CHECK(gear.actuator_velocity(One(-2.0))[0] == 100);
  CHECK(gear.actuator_effort(One(-25.0))[0] == 0.5);
}

TEST_CASE("a differential adds and subtracts") {
  const DifferentialTransmission wrist{
      .actuator_reduction = {4, -2}, .joint_reduction = {0.5, 8}, .joint_offset = {1, -1}};
  // q_a/n = 3 and 1: their sum 4 over 2 m = 1, their difference 2 over 16.
  CHECK(wrist.joint_position(Two(12, -2)) == Two(5, -0.875));
  CHECK(wrist.joint_velocity(Two(12, -2)) == Two(4, 0.125));
  // n effort_a = 12 and 4
  CHECK(wrist.joint_effort(Two(3, -2)) == Two(8, 64));
  CHECK(wrist.actuator_position(Two(5, -0.875)) == Two(12, -2));
  CHECK(wrist.actuator_velocity(Two(4, 0.125)) == Two(12, -2));
  CHECK(wrist.actuator_effort(Two(8, 64)) == Two(3, -2));
}

TEST_CASE("a four-bar linkage moves its second joint past the first") {
  const FourBarTransmission arm{
      .actuator_reduction = {4, -2}, .joint_reduction = {0.5, 8}, .joint_offset = {1, -1}};
  // q_a1/(m n) = 6, q_a2/n = 1: (1 - 6)/8
  CHECK(arm.joint_position(Two(12, -2)) == Two(7, -1.625));
  CHECK(arm.joint_velocity(Two(12, -2)) == Two(6, -0.625));
  // 0.5 * 4 * 3 + (-2)(-2) and 8 (-2)(-2)
  CHECK(arm.joint_effort(Two(3, -2)) == Two(10, 32));
  CHECK(arm.actuator_position(Two(7, -1.625)) == Two(12, -2));
  CHECK(arm.actuator_velocity(Two(6, -0.625)) == Two(12, -2));
  CHECK(arm.actuator_effort(Two(10, 32)) == Two(3, -2));
}

TEMPLATE_TEST_CASE("transmissions lose neither power nor motion", "", SimpleTransmission,
                   DifferentialTransmission, FourBarTransmission, Reversed<SimpleTransmission>,
                   Reversed<DifferentialTransmission>, Reversed<FourBarTransmission>) {
  static_assert(Transmission<TestType>);
  constexpr int n = TestType::size;
  constexpr unsigned seed = 21;
  support::Random random(seed);
  for (int trial = 0; trial < 2000; ++trial) {
    CAPTURE(seed, trial);
    TestType t;
    draw(random, t);
    REQUIRE(refusal(t).empty());
    const JointVector<n> v_a = random.template vector<n>(10), effort = random.template vector<n>(9);
    const JointVector<n> v = t.joint_velocity(v_a), effort_a = t.actuator_effort(effort);
    // A few roundings of the terms, which cancel where they differ much.
    const double power =
        effort_a.cwiseAbs().dot(v_a.cwiseAbs()) + effort.cwiseAbs().dot(v.cwiseAbs());
    CHECK(std::abs(effort_a.dot(v_a) - effort.dot(v)) <= 1e-14 * power);

    const auto returns = [](const auto& there, const auto& back, const JointVector<n>& x) {
      const JointVector<n> y = there(x);
      // Reductions of 1e-2 to 1e3 in four places lose up to ten of sixteen digits.
      return (back(y) - x).norm() <= 1e-5 * (1 + x.norm());
    };
    const JointVector<n> x = random.template vector<n>(5);
    CHECK(returns([&](const auto& y) { return t.joint_position(y); },
                  [&](const auto& y) { return t.actuator_position(y); }, x));
    CHECK(returns([&](const auto& y) { return t.actuator_position(y); },
                  [&](const auto& y) { return t.joint_position(y); }, x));
    CHECK(returns([&](const auto& y) { return t.joint_velocity(y); },
                  [&](const auto& y) { return t.actuator_velocity(y); }, x));
    CHECK(returns([&](const auto& y) { return t.joint_effort(y); },
                  [&](const auto& y) { return t.actuator_effort(y); }, x));
    // Positions are the integral of velocities.
    const JointVector<n> step = t.joint_position(x + v_a) - t.joint_position(x);
    CHECK((step - v).norm() <= 1e-12 * (1 + v.norm() + t.joint_position(x).norm()));
  }
}

TEST_CASE("a figure that is no reduction or offset is refused, and named") {
  for (const double bad :
       {0.0, -0.0, not_a_number, infinity, -infinity, support::smallest, support::largest}) {
    CAPTURE(bad);
    std::ostringstream value;
    value << bad;
    const auto names_it = [&](const auto& t, const std::string& figure) {
      CHECK_THAT(refusal(t), Contains("wrist: " + figure + " " + value.str()));
    };
    names_it(SimpleTransmission{.reduction = bad}, "reduction");
    names_it(Reversed<SimpleTransmission>{{.reduction = bad}}, "reduction");
    names_it(DifferentialTransmission{.actuator_reduction = {1, bad}}, "actuator_reduction[1]");
    names_it(DifferentialTransmission{.joint_reduction = {bad, 1}}, "joint_reduction[0]");
    names_it(FourBarTransmission{.actuator_reduction = {bad, 1}}, "actuator_reduction[0]");
    names_it(FourBarTransmission{.joint_reduction = {1, bad}}, "joint_reduction[1]");
    if (is_finite(bad)) continue;
    names_it(SimpleTransmission{.joint_offset = bad}, "joint_offset");
    names_it(DifferentialTransmission{.joint_offset = {0, bad}}, "joint_offset[1]");
    names_it(FourBarTransmission{.joint_offset = {bad, 0}}, "joint_offset[0]");
  }
}

TEST_CASE("what is no number stays none") {
  const DifferentialTransmission wrist;
  CHECK(wrist.joint_position(Two(not_a_number, 1)).hasNaN());
  CHECK(wrist.actuator_effort(Two(1, not_a_number)).hasNaN());
  CHECK_FALSE(is_finite(SimpleTransmission{}.actuator_position(One(infinity))));
}

TEST_CASE("rotors are felt by the square of the reduction") {
  CHECK(reflected_inertia(SimpleTransmission{.reduction = -50}, One(1e-4))(0, 0) == Approx(0.25));
  // v_a = (n1 (m1 v1 + m2 v2), n2 (m1 v1 - m2 v2))
  const DifferentialTransmission even{.actuator_reduction = {10, -10}, .joint_reduction = {1, 2}};
  const JointMatrix<2> uncoupled = reflected_inertia(even, Two(1e-3, 1e-3));
  CHECK(uncoupled(0, 0) == Approx(0.2));
  CHECK(uncoupled(1, 1) == Approx(0.8));
  CHECK(uncoupled(0, 1) == 0);
  CHECK(reflected_inertia(even, Two(1e-3, 0))(0, 1) == Approx(0.2));
  // v_a = (m1 n1 v1, n2 (v1 + m2 v2))
  const FourBarTransmission arm{.actuator_reduction = {10, 20}, .joint_reduction = {2, 0.5}};
  const JointMatrix<2> coupled = reflected_inertia(arm, Two(1e-3, 1e-3));
  CHECK(coupled(0, 0) == Approx(0.4 + 0.4));
  CHECK(coupled(1, 1) == Approx(0.1));
  CHECK(coupled(0, 1) == Approx(0.2));
  CHECK(coupled(1, 0) == coupled(0, 1));
}

TEST_CASE("actuators' limits follow from those of their joints") {
  const JointLimits joint{.lower = -1, .upper = 2, .velocity = 3, .effort = 40};
  const JointLimits motor = actuator_limits(SimpleTransmission{-10, 0.5}, {joint})[0];
  CHECK(motor.lower == -15);
  CHECK(motor.upper == 15);
  CHECK(motor.velocity == 30);
  CHECK(motor.effort == 4);
  const JointLimits free = actuator_limits(SimpleTransmission{-10, 0.5}, {JointLimits{}})[0];
  CHECK(free.lower == -infinity);
  CHECK(free.upper == infinity);
  CHECK(free.effort == infinity);

  const FourBarTransmission arm{.actuator_reduction = {10, 20}, .joint_reduction = {2, -0.5}};
  const auto motors = actuator_limits(arm, {joint, JointLimits{.velocity = 1, .effort = 6}});
  CHECK(motors[0].lower == -20);
  CHECK(motors[0].upper == 40);
  CHECK(motors[0].velocity == 60);
  CHECK(motors[0].effort == Approx((40 + 6 / 0.5) / 20));
  CHECK(motors[1].lower == -infinity);
  CHECK(motors[1].velocity == Approx(20 * (3 + 0.5)));
  CHECK(motors[1].effort == Approx(6 / 0.5 / 20));
}
