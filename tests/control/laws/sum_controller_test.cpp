// SPDX-License-Identifier: Apache-2.0
// The controllers as sums of parts, and the limits of the total.
#include <articula/control/bypass.hpp>
#include <articula/control/pid.hpp>
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/core/controller.hpp>
#include <articula/core/finite.hpp>

#include <cmath>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using support::infinity;
using support::TiltedQ2d;

namespace {

static_assert(Controller<Bypass<Q2d>, 2> && Controller<Pid<Q2d>, 2> &&
              Controller<PidPlusGravity<Q2d>, 2>);

JointReference<1> reference_of(double position, double effort = 0) {
  JointReference<1> reference;
  reference.position[0] = position;
  reference.effort[0] = effort;
  return reference;
}

/// A PID on a slider whose drive gives at most 1 N.
Pid<Model<1>> limited_pid(const PidGains& gains) {
  Model<1> robot = support::slider();
  robot.joints[0].limits.effort = 1;
  return Pid<Model<1>>(robot, {gains});
}

double integral(const Pid<Model<1>>& pid) { return pid.part<PidLaw<1>>().integral()[0]; }

}  // namespace

TEST_CASE("bypass passes the reference's effort on, within the drives' limits") {
  Bypass<Q2d> bypass;
  JointReference<2> reference;
  reference.position.setConstant(100);  // not used, nor are the other members
  reference.effort = {1.5, -2.5};
  CHECK(bypass.update({{}, reference, 1e-3}).effort == Eigen::Vector2d(1.5, -2.5));
  reference.effort = {27.95, -13.63};
  CHECK(bypass.update({{}, reference, 1e-3}).effort == Eigen::Vector2d(27.94, -13.62));
  reference.effort = {-1e308, 1e308};
  CHECK(bypass.update({{}, reference, 1e-3}).effort == Eigen::Vector2d(-27.94, 13.62));
}

TEST_CASE("a drive without limit gives what is asked for, one with limit 0 nothing") {
  Model<1> robot = support::slider();
  CHECK(Bypass<Model<1>>(robot).update({{}, reference_of(0, 1e300), 1e-3}).effort[0] == 1e300);
  robot.joints[0].limits.effort = 0;
  CHECK(Bypass<Model<1>>(robot).update({{}, reference_of(0, 1e300), 1e-3}).effort[0] == 0);
}

TEST_CASE("PID plus gravity is a PID plus the gravity effort") {
  constexpr unsigned seed = 2;
  CAPTURE(seed);
  support::Random random(seed);
  Pid<TiltedQ2d> pid;
  PidPlusGravity<TiltedQ2d> both;
  for (int k = 0; k < 1000; ++k) {
    CAPTURE(k);
    JointState<2> state;
    JointReference<2> reference;
    state.position = random.vector<2>(1);
    state.velocity = random.vector<2>(1);
    reference.position = state.position + random.vector<2>(1e-3);  // far from the limits
    reference.velocity = random.vector<2>(1);
    reference.effort = random.vector<2>(1);
    const JointVector<2> sum =
        pid.update({state, reference, 1e-3}).effort + gravity(TiltedQ2d(), state.position);
    // Up to 10 N m are added in another order.
    CHECK((both.update({state, reference, 1e-3}).effort - sum).cwiseAbs().maxCoeff() < 1e-13);
  }
  CHECK(gravity(TiltedQ2d(), Eigen::Vector2d(0.5, 0.5)).cwiseAbs().minCoeff() > 0.1);
}

TEST_CASE("on vertical axes gravity compensation does nothing") {
  Pid<Q2d> pid;
  PidPlusGravity<Q2d> both;
  JointReference<2> reference;
  reference.position = {0.003, -0.005};
  const JointVector<2> difference =
      pid.update({{}, reference, 1e-3}).effort - both.update({{}, reference, 1e-3}).effort;
  // Rounding of 7 N m: clang may fuse a product and a sum of constants here and not there.
  CHECK(difference.norm() < 1e-14);
  CHECK(gravity(Q2d(), Eigen::Vector2d(0.3, -0.7)) == Eigen::Vector2d(0, 0));
}

TEST_CASE("the total is limited, not its parts") {
  auto pid = limited_pid({.proportional = 1000});
  CHECK(pid.update({{}, reference_of(1, -999.5), 1e-3}).effort[0] == 0.5);
  CHECK(pid.update({{}, reference_of(1, -2000), 1e-3}).effort[0] == -1);
  CHECK(pid.update({{}, reference_of(1), 1e-3}).effort[0] == 1);
}

TEST_CASE("the integral does not wind up in either direction, and unwinds at once") {
  for (const double side : {1.0, -1.0}) {
    CAPTURE(side);
    auto pid = limited_pid({.proportional = 10, .integral = 1});
    for (int k = 0; k < 1000; ++k) {
      CHECK(pid.update({{}, reference_of(side), 0.1}).effort[0] == side);
      CHECK(std::abs(integral(pid)) <= 0.1);  // a step, which the next cycle takes back
    }
    // Not limited any more, it grows; limited on the other side, it grows too.
    static_cast<void>(pid.update({{}, reference_of(side * 0.05), 0.1}));
    CHECK(integral(pid) == Approx(side * 0.005).epsilon(1e-14));
    static_cast<void>(pid.update({{}, reference_of(side * 0.05, side * -100), 0.1}));
    CHECK(integral(pid) == Approx(side * 0.01).epsilon(1e-14));
  }
}

TEST_CASE("the integral stops at the limit of the total, short of its clamp") {
  auto pid = limited_pid({.integral = 1, .integral_clamp_min = -50, .integral_clamp_max = 50});
  for (int k = 0; k < 100; ++k) {
    CHECK(pid.update({{}, reference_of(1), 0.0625}).effort[0] <= 1);
    CHECK(integral(pid) <= 1 + 0.0625);  // with a step, which the next cycle takes back
  }
  CHECK(pid.update({{}, reference_of(-1), 0.0625}).effort[0] == 1 - 0.0625);  // no delay
}

TEST_CASE("start makes the next command independent of the past") {
  auto pid = limited_pid({.proportional = 0.5, .integral = 1});
  const double fresh = pid.update({{}, reference_of(0.1), 0.1}).effort[0];
  for (int k = 0; k < 5; ++k) static_cast<void>(pid.update({{}, reference_of(0.1), 0.1}));
  pid.start({{}, {}, 1e-3});
  CHECK(pid.update({{}, reference_of(0.1), 0.1}).effort[0] == fresh);
}

TEST_CASE("the largest references leave a command within the limits and nothing behind") {
  const JointVector<2> limit(27.94, 13.62);
  JointReference<2> calm;
  calm.position.setConstant(1e-3);
  for (const double huge : {support::largest, -support::largest, 1e200, -1e200}) {
    CAPTURE(huge);
    Pid<Q2d> pid, fresh;
    JointReference<2> wild;
    wild.position.setConstant(huge);
    CHECK(pid.update({{}, wild, 1e-3}).effort == (huge > 0 ? limit : JointVector<2>(-limit)));
    CHECK(pid.update({{}, calm, 1e-3}).effort == fresh.update({{}, calm, 1e-3}).effort);
  }
}

// Without any limit an overflow reaches the drive, where the loop stops it; the integral must not
// keep it.
TEST_CASE("an overflow of an unlimited drive is over in the next cycle") {
  Pid<Model<1>> pid(support::slider(), {PidGains{.proportional = 1, .integral = 1e3}});
  static_cast<void>(pid.update({{}, reference_of(support::largest), 1.0}));
  CHECK(is_finite(pid.update({{}, reference_of(0), 1e-3})));
}

namespace {

/// A law of somebody else, which takes back what was cut off and has no `start`.
struct Tracking {
  JointVector<2> integral{0, 0};

  JointVector<2> output(const ControlInput<2>& in) noexcept {
    integral -= 0.1 * in.cut;
    return in.reference.position + integral;
  }
};

/// Gives the reference's velocity on the first joint, of whatever size.
struct Push {
  JointVector<2> output(const ControlInput<2>& in) noexcept {
    return {in.reference.velocity[0], 0};
  }
};

}  // namespace

TEST_CASE("a law whose neighbour gives NaN or overflows for one cycle has nothing of it later") {
  for (const double bad : {support::not_a_number, support::infinity, -support::infinity}) {
    CAPTURE(bad);
    EffortController<Q2d, Tracking, Push> controller{Q2d(), {}, {}};
    JointReference<2> reference;
    reference.position = {0.5, 100};  // the second joint's limit cuts this
    reference.velocity = {bad, 0};
    const auto command = controller.update({{}, reference, 1e-3});
    CHECK(command.effort[1] == 13.62);
    reference.velocity.setZero();
    reference.position.setConstant(0.25);
    CHECK(controller.update({{}, reference, 1e-3}).effort == JointVector<2>(0.25, 0.25));
  }
}
