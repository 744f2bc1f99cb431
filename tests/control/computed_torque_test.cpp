// SPDX-License-Identifier: Apache-2.0
#include <articula/control/computed_torque.hpp>
#include <articula/dynamics/mass_matrix.hpp>
#include <articula/loop/loop.hpp>

#include <Eigen/LU>

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "random.hpp"
#include "robots/test_robots.hpp"

using namespace articula;

namespace {

using Vector = JointVector<2>;
using TiltedSim = Simulator<Model<2>>;

/// The tilted Q2D with drives that never saturate, its joints rubbing as the option says.
Model<2> strong_arm(double friction = 0) {
  Model<2> robot = support::model<support::TiltedQ2d>();
  for (auto& joint : robot.joints) {
    joint.limits.effort = std::numeric_limits<double>::infinity();
    joint.friction = friction;
  }
  return robot;
}

/// What the joints shall do, at a time t.
struct Path {
  Vector start, amplitude, rate;

  [[nodiscard]] JointReference<2> at(double t) const {
    JointReference<2> r;
    const auto phase = (rate * t).array();
    r.position = start + Vector(amplitude.array() * phase.sin());
    r.velocity = amplitude.array() * rate.array() * phase.cos();
    r.acceleration = -amplitude.array() * rate.array().square() * phase.sin();
    return r;
  }
};

/// How far the error of a loop on the exact model strays from the solution of
/// e'' + 2 w e' + w^2 e = 0 for an initial error e(0) with e'(0) = 0, over half a second; infinity
/// if the loop fails.
Vector largest_deviation(const Path& path, const Vector& initial_error, double period) {
  constexpr double w = 20;
  const JointReference<2> start = path.at(0);
  const auto robot = strong_arm();
  SimulatorOptions<2> options{.period = period};
  options.initial_position = start.position - initial_error;
  options.initial_velocity = start.velocity;
  Loop<TiltedSim, ComputedTorque> loop(
      TiltedSim(robot, options),
      ComputedTorque<Model<2>>(robot, ComputedTorque<Model<2>>::critically_damped(w)));
  Vector largest = Vector::Zero();
  for (int k = 0; k * period < 0.5; ++k) {
    const double t = k * period;
    loop.reference() = path.at(t);
    if (loop.update() != Status::ok)
      return Vector::Constant(std::numeric_limits<double>::infinity());
    const Vector error = loop.reference().position - loop.state().position;
    const Vector expected = initial_error * (1 + w * t) * std::exp(-w * t);
    largest = largest.cwiseMax((error - expected).cwiseAbs());
  }
  return largest;
}

}  // namespace

TEST_CASE("errors decay as the linear equation says, up to the hold of the command") {
  const Path rest{.start = {0.3, -0.4}, .amplitude = {0, 0}, .rate = {1, 1}};
  const Path waves{.start = {0.3, -0.4}, .amplitude = {0.5, -0.7}, .rate = {3, 5}};
  const Vector error(0.05, -0.1);
  for (const Path& path : {rest, waves}) {
    CAPTURE(path.amplitude.transpose());
    // Holding the command delays it by half a period on average: an error of first order in it.
    const Vector coarse = largest_deviation(path, error, 2e-4);
    const Vector fine = largest_deviation(path, error, 1e-4);
    CAPTURE(coarse.transpose(), fine.transpose());
    for (int j = 0; j < 2; ++j) {
      CHECK(fine[j] < 1e-3);
      CHECK(coarse[j] / fine[j] == Approx(2).epsilon(0.05));
    }
  }
}

TEST_CASE("an error of one joint leaves the other alone") {
  const Path rest{.start = {0.3, -0.4}, .amplitude = {0, 0}, .rate = {1, 1}};
  const Vector coarse = largest_deviation(rest, {0.1, 0}, 1e-4);
  const Vector fine = largest_deviation(rest, {0.1, 0}, 5e-5);
  CAPTURE(coarse.transpose(), fine.transpose());
  CHECK(fine[1] < 2e-4);                                 // of an error of 0.1 rad in the other
  CHECK(coarse[1] / fine[1] == Approx(2).epsilon(0.1));  // the hold of the command, nothing else
}

TEST_CASE("the effort is M a + h + D v + f sign(v), plus feed-forward") {
  const auto robot = strong_arm(0.7);
  ComputedTorque<Model<2>> controller(robot, {PidGains{.proportional = 100, .derivative = 10},
                                              PidGains{.proportional = 50, .derivative = 5}});
  JointState<2> state;
  state.position = {0.2, -0.5};
  state.velocity = {-1.5, 2.5};
  JointReference<2> reference;
  reference.position = {0.3, -0.7};
  reference.velocity = {1, 1};
  reference.acceleration = {3, -4};
  reference.effort = {0.125, 0.25};
  const Vector a(3 + 100 * 0.1 + 10 * 2.5, -4 + 50 * -0.2 + 5 * -1.5);
  const Vector expected = mass_matrix(robot, state.position) * a +
                          nonlinear_effects(robot, state.position, state.velocity) +
                          Vector(29.7914 * -1.5 - 0.7, 2.6404 * 2.5 + 0.7) + reference.effort;
  const Vector effort = controller.update({state, reference, 1e-3}).effort;
  CHECK((effort - expected).cwiseAbs().maxCoeff() < 1e-12);  // of some 50 N m
}

// Through the coupling of the joints an effort may be limited on the side that its own joint is not
// asked to go to: in the second case the elbow's error is negative and its effort positive.
TEST_CASE("the effort is limited, and no integral winds up meanwhile") {
  const JointPidGains<2> gains{PidGains{.proportional = 400, .integral = 1e3},
                               PidGains{.proportional = 400, .integral = 1e3}};
  const Vector limit(27.94, 13.62);
  JointReference<2> near;
  near.position = {0.01, -0.01};
  for (const double elbow : {10.0, -10.0}) {
    CAPTURE(elbow);
    ComputedTorque<Q2d> controller(gains), fresh(gains);
    JointReference<2> far;
    far.position = {10, elbow};
    bool limited = true;
    for (int k = 0; k < 10; ++k) {
      limited = limited && controller.update({{}, far, 1e-3}).effort == limit;
    }
    CHECK(limited);
    CHECK(controller.update({{}, near, 1e-3}).effort == fresh.update({{}, near, 1e-3}).effort);
  }
}

TEST_CASE("the default is critically damped at 20 rad/s") {
  constexpr auto gains = ComputedTorque<Q2d>::critically_damped(20);
  for (const PidGains& g : gains) {
    CHECK(g.proportional == 400);
    CHECK(g.integral == 0);
    CHECK(g.derivative == 40);
  }
  ComputedTorque<Q2d> by_default, given(gains);
  JointReference<2> reference;
  reference.position = {0.01, -0.02};
  CHECK(by_default.update({{}, reference, 1e-3}).effort ==
        given.update({{}, reference, 1e-3}).effort);
}

TEST_CASE("an overflow is over in the next cycle") {
  ComputedTorque<Q2d> controller({PidGains{.proportional = 400, .integral = 1e3},
                                  PidGains{.proportional = 400, .integral = 1e3}});
  JointReference<2> wild, calm;
  wild.position = {1e308, -1e308};
  static_cast<void>(controller.update({{}, wild, 1e-3}));
  CHECK(is_finite(controller.update({{}, calm, 1e-3})));
}

// What was lost is an acceleration, M(q)^-1 excess, at the position of that cycle, whatever gravity
// does: an integral that pushed into the same direction takes its last step back, another keeps it.
TEST_CASE("integrals are told the acceleration that was lost") {
  const Model<2> robot = strong_arm();
  constexpr unsigned seed = 1;
  CAPTURE(seed);
  support::Random random(seed);
  constexpr double period = 1e-3;
  for (int k = 0; k < 1000; ++k) {
    ComputedTorqueLaw<Model<2>> law(robot, {PidGains{.integral = 1}, PidGains{.integral = 1}});
    JointState<2> state;
    state.position = random.vector<2>(3);
    const Vector error = random.vector<2>(3), excess = random.vector<2>(1);
    law.start({state, {}, 1e-3});
    JointReference<2> reference;
    reference.position = state.position + error;
    static_cast<void>(law.output({state, reference, period}));

    const Vector lost = mass_matrix(robot, state.position).inverse() * excess;
    Vector integral = error * period;
    for (int j = 0; j < 2; ++j) {
      if (lost[j] * integral[j] > 0) integral[j] = 0;
    }
    reference.position = state.position;  // no error: nothing is added
    const Vector expected = inverse_dynamics(robot, state.position, state.velocity, integral);
    // The integrals are some 1e-3 rad/s^2 and the efforts of gravity some 10 N m.
    CHECK((law.output({state, reference, period, {}, excess}) - expected).norm() < 1e-13);
  }
}
