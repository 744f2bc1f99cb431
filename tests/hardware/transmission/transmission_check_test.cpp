// SPDX-License-Identifier: Apache-2.0
#include <articula/hardware/transmission/differential_transmission.hpp>
#include <articula/hardware/transmission/four_bar_transmission.hpp>
#include <articula/hardware/transmission/reversed_transmission.hpp>
#include <articula/hardware/transmission/simple_transmission.hpp>
#include <articula/hardware/transmission/transmission_check.hpp>
#include <articula/hardware/transmission/transmitted_hardware.hpp>
#include <articula/robots/q2d.hpp>

#include <Eigen/LU>

#include <cmath>
#include <string>

#include "catch.hpp"
#include "random.hpp"

using namespace articula;
using Catch::Matchers::Contains;

namespace {

using Vector = JointVector<2>;
using Matrix = JointMatrix<2>;

/// A pair of tendons, of which each map is a figure of its own, so that each can be wrong.
struct Tendons {
  static constexpr int size = 2;
  Matrix rates{{3, 1}, {0, -2}};  ///< of the actuators per rate of the joints
  Matrix position_to_actuators = rates, position_to_joints = rates.inverse();
  Matrix velocity_to_actuators = rates, velocity_to_joints = rates.inverse();
  Matrix effort_to_actuators = rates.inverse().transpose(), effort_to_joints = rates.transpose();
  Vector offset{0.5, -20}, offset_back = offset;

  Vector joint_position(const Vector& a) const noexcept { return position_to_joints * a + offset; }
  Vector joint_velocity(const Vector& a) const noexcept { return velocity_to_joints * a; }
  Vector joint_effort(const Vector& a) const noexcept { return effort_to_joints * a; }
  Vector actuator_position(const Vector& j) const noexcept {
    return position_to_actuators * (j - offset_back);
  }
  Vector actuator_velocity(const Vector& j) const noexcept { return velocity_to_actuators * j; }
  Vector actuator_effort(const Vector& j) const noexcept { return effort_to_actuators * j; }
};
void validate(const Tendons&, std::string_view) {}

template <class T>
std::string refusal(const T& transmission) {
  try {
    detail::check_maps(transmission, "wrist");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

template <class T>
void draw(support::Random& random, T& t) {
  const auto reduction = [&] {
    return (random.one_in(2) ? 1 : -1) * std::pow(10, random.number(-3, 3));
  };
  for (std::size_t k = 0; k < 2; ++k) {
    t.actuator_reduction[k] = reduction();
    t.joint_reduction[k] = reduction();
    t.joint_offset[k] = random.number(-100, 100);
  }
}

}  // namespace

TEST_CASE("transmissions whose maps agree pass the check") {
  CHECK(refusal(Tendons()) == "");
  CHECK(refusal(SimpleTransmission{.reduction = -1e-100, .joint_offset = 1e6}) == "");
  CHECK(refusal(SimpleTransmission{.reduction = 1e100, .joint_offset = -1e6}) == "");
  for (unsigned seed = 1; seed <= 3000; ++seed) {
    CAPTURE(seed);
    support::Random random(seed);
    DifferentialTransmission differential;
    draw(random, differential);
    FourBarTransmission four_bar;
    draw(random, four_bar);
    REQUIRE(refusal(differential) == "");
    REQUIRE(refusal(four_bar) == "");
    REQUIRE(refusal(Reversed<DifferentialTransmission>{differential}) == "");
    REQUIRE(refusal(Reversed<FourBarTransmission>{four_bar}) == "");
  }
}

TEST_CASE("a map with a wrong sign, transposed or with a wrong offset is refused, and named") {
  Tendons t;
  t.position_to_joints.row(1) *= -1;
  CHECK_THAT(refusal(t), Contains("wrist: joint_position moves by 0.5 at row 1 for 1 at column 1; "
                                  "expected -0.5 as joint_velocity"));
  t = {};
  t.position_to_actuators.col(0) *= -1;
  CHECK_THAT(refusal(t), Contains("wrist: actuator_position moves by -3 at row 0"));
  t = {};
  t.offset_back = -t.offset;
  CHECK_THAT(refusal(t), Contains("joint_position after actuator_position is 1 at row 0"));
  t = {};
  t.effort_to_joints.transposeInPlace();
  CHECK_THAT(refusal(t), Contains("the power joint_effort . joint_velocity is"));
  t = {};
  t.velocity_to_joints *= -1;
  t.position_to_joints *= -1;
  CHECK_THAT(refusal(t), Contains("joint_velocity after actuator_velocity is -1 at row 0"));
  t = {};
  t.effort_to_joints *= -1;
  t.effort_to_actuators *= -1;  // inverse to each other, against the velocity
  CHECK_THAT(refusal(t), Contains("the power actuator_effort . actuator_velocity is -1 at row 0, "
                                  "column 0; expected 1"));
  t = {};
  t.effort_to_joints = t.rates;  // not transposed, as a pair
  t.effort_to_actuators = t.rates.inverse();
  CHECK_THAT(refusal(t), Contains("the power"));
}

TEST_CASE("hardware with a transmission whose maps do not agree is refused, with its joints") {
  using Arm = TransmittedHardware<Q2dSim, Q2d, Tendons>;
  Gearing<Tendons> gearing{.joints = {"shoulder_active_joint", "elbow_active_joint"},
                           .actuators = {"shoulder_active_joint", "elbow_active_joint"},
                           .transmission = {},
                           .limits = {}};
  CHECK_NOTHROW(Arm(Q2dSim(), gearing));
  gearing.transmission.effort_to_actuators.row(0) *= -1;
  CHECK_THROWS_WITH(Arm(Q2dSim(), gearing),
                    Contains("transmission of joint 'shoulder_active_joint' 'elbow_active_joint': "
                             "the power actuator_effort . actuator_velocity is"));
}
