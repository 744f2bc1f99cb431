// SPDX-License-Identifier: Apache-2.0
// The Q2D under control against an independent simulation: the planar arm in closed form, a PID as
// its definition says, Runge-Kutta with 20 steps per period.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

#include <algorithm>

#include "catch.hpp"
#include "robots/two_link_arm.hpp"

using namespace articula;

namespace {

using Vector = Eigen::Vector2d;

/// One joint's PID: integrate, clamp, add up, limit; the integral stays while it would push the
/// output further beyond its limit.
struct OtherPid {
  double p, i, d, clamp, integral = 0;

  double update(double error, double velocity, double limit, double dt) {
    const double advanced = std::clamp(integral + i * error * dt, -clamp, clamp);
    const double output = p * error + advanced - d * velocity;
    const bool winds_up =
        (output > limit && advanced > integral) || (output < -limit && advanced < integral);
    if (!winds_up) integral = advanced;
    return std::clamp(output, -limit, limit);
  }
};

/// The Q2D from rest at q = 0. It has no stops.
struct OtherQ2d {
  support::TwoLinkArm arm{};
  Vector q{0, 0}, v{0, 0};

  void hold(const Vector& effort, double duration, int steps) {
    const double h = duration / steps;
    const auto acceleration = [&](const Vector& position, const Vector& velocity) -> Vector {
      return arm.forward_dynamics(position, velocity, effort - arm.damping.cwiseProduct(velocity));
    };
    for (int k = 0; k < steps; ++k) {
      const Vector v1 = v, a1 = acceleration(q, v1);
      const Vector v2 = v + h / 2 * a1, a2 = acceleration(q + h / 2 * v1, v2);
      const Vector v3 = v + h / 2 * a2, a3 = acceleration(q + h / 2 * v2, v3);
      const Vector v4 = v + h * a3, a4 = acceleration(q + h * v3, v4);
      q += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
      v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
  }
};

constexpr double period = 1e-3;

Q2dSim arm_with(int substeps) { return Q2dSim(SimulatorOptions<2>{.substeps = substeps}); }

/// The largest distance of the positions over some seconds of a step to `target` [rad].
template <template <class> class Controller>
double step_deviation(const Vector& target, double seconds, int substeps) {
  Loop<Q2dSim, Controller> loop(arm_with(substeps));
  loop.reference().position = target;
  OtherQ2d other;
  OtherPid shoulder{2310, 4640, 0.299, 27.94}, elbow{339, 851, 0.351, 13.62};
  double largest = 0;
  for (int k = 0; k * period < seconds; ++k) {
    if (loop.update() != Status::ok) return 1;
    largest = std::max(largest, (loop.state().position - other.q).cwiseAbs().maxCoeff());
    const Vector error = target - other.q;
    other.hold({shoulder.update(error[0], other.v[0], other.arm.effort_limit[0], period),
                elbow.update(error[1], other.v[1], other.arm.effort_limit[1], period)},
               period, 20);
  }
  return largest;
}

/// The same under a constant effort.
double open_loop_deviation(const Vector& effort, double seconds, int substeps) {
  Loop<Q2dSim, Bypass> loop(arm_with(substeps));
  loop.reference().effort = effort;
  OtherQ2d other;
  double largest = 0;
  for (int k = 0; k * period < seconds; ++k) {
    if (loop.update() != Status::ok) return 1;
    largest = std::max(largest, (loop.state().position - other.q).cwiseAbs().maxCoeff());
    other.hold(effort, period, 20);
  }
  return largest;
}

// What the project asks of one Runge-Kutta step per period.
constexpr double promised = 1e-5;  // [rad]
// With 20 steps both simulations do the same arithmetic in another order.
constexpr double same_arithmetic = 1e-11;  // [rad]

}  // namespace

TEST_CASE("open-loop torque moves the Q2D as the independent simulation says") {
  // 3 s of 1 N m: the elbow turns by about 1 rad and stays clear of its stop.
  const double deviation = open_loop_deviation({1, 1}, 3, 1);
  WARN("largest deviation " << deviation << " rad");
  CHECK(deviation < promised);
  CHECK(open_loop_deviation({1, 1}, 3, 20) < same_arithmetic);
}

TEST_CASE("a small step of the reference gives the independent simulation's response") {
  const Vector target(0.01, 0.01);
  const double deviation = step_deviation<Pid>(target, 3, 1);
  WARN("largest deviation " << deviation << " rad");
  CHECK(deviation < promised);
  CHECK(step_deviation<Pid>(target, 3, 20) < same_arithmetic);
  CHECK(step_deviation<PidPlusGravity>(target, 3, 1) < promised);  // the axes are vertical
}

TEST_CASE("so does a large step, with the drives at their limits") {
  const Vector target(-1, 1);
  const double deviation = step_deviation<Pid>(target, 5, 1);
  WARN("largest deviation " << deviation << " rad");
  CHECK(deviation < promised);
  // Leaving the limit a period earlier or later is a matter of the last bit.
  CHECK(step_deviation<Pid>(target, 5, 20) < 1e-9);
}
