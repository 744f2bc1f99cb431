// SPDX-License-Identifier: Apache-2.0
// Where the tolerance of the Quanser arm's encoders comes from: the arm with its springs free.
#include <articula/hardware/quanser/quanser_module.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/robots/q2d_modules.hpp>
#include <articula/sim/simulator.hpp>

#include "catch.hpp"

#include <algorithm>
#include <cmath>

using namespace articula;

namespace {

/// The Quanser arm with springs between motors and loads: joints 0 and 2 are driven, 1 and 3 bend.
struct FlexibleQ2d {
  static constexpr auto description = [] {
    auto flexible = Q2d::description;
    for (Joint& joint : flexible.joints) {
      if (joint.name != "shoulder_passive_joint" && joint.name != "elbow_passive_joint") continue;
      joint.type = JointType::revolute;
      joint.axis = {0, 0, 1};
      joint.limits = {.lower = -2, .upper = 2, .velocity = 100, .effort = 100};
    }
    return flexible;
  }();
};

/// The largest deflection of both springs when both joints go from 0 to `step` and back to `-step`.
double largest_deflection(double step, int return_at, double elbow_sign) {
  Simulator<FlexibleQ2d> arm({.substeps = 50});
  JointState<4> state;
  double largest = 0;
  MultiModeCommand<4> command;
  command.stiffness = {0, 9, 0, 4};  // the maker's figures, N m/rad
  for (int k = 0; k < return_at + 1000; ++k) {
    REQUIRE(arm.read(state) == Status::ok);
    const double target = k < return_at ? step : -step;
    for (const int j : {0, 1}) {
      const PidGains& gains = Q2d::pid_gains[static_cast<std::size_t>(j)];
      const int motor = 2 * j;
      const double reference = j == 0 ? target : elbow_sign * target;
      command.effort[motor] = std::clamp(gains.proportional * (reference - state.position[motor]) -
                                             gains.derivative * state.velocity[motor],
                                         gains.integral_clamp_min, gains.integral_clamp_max);
      largest = std::max(largest, std::abs(state.position[motor + 1]));
    }
    REQUIRE(arm.write(command) == Status::ok);
  }
  return largest;
}

}  // namespace

TEST_CASE("steps of 0.1 rad bend the arm's springs by less than the encoders may differ") {
  double largest = 0;
  for (int return_at = 300; return_at < 1300; return_at += 100) {
    for (const double sign : {-1.0, 1.0}) {
      largest = std::max(largest, largest_deflection(0.1, return_at, sign));
    }
  }
  CAPTURE(largest);
  CHECK(largest > 0.3);  // 0.33: the tolerance is no larger than it has to be
  for (const QuanserModule& module : q2d_modules) CHECK(module.encoder_tolerance > 1.1 * largest);
}
