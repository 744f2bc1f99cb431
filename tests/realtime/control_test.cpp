// SPDX-License-Identifier: Apache-2.0
// Control laws, controllers of all command interfaces, limits and the exchange of gains under the
// allocation guard.
#include <articula/compatibility/control_toolbox_pid_law.hpp>
#include <articula/control/bypass.hpp>
#include <articula/control/computed_torque.hpp>
#include <articula/control/drive_impedance.hpp>
#include <articula/control/forward_position.hpp>
#include <articula/control/forward_velocity.hpp>
#include <articula/control/joint_impedance.hpp>
#include <articula/control/laws/on_joints.hpp>
#include <articula/control/limits/limited.hpp>
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/control/position_by_velocity.hpp>
#include <articula/control/velocity_by_effort.hpp>
#include <articula/loop/exchange/gains_exchange.hpp>
#include <articula/loop/loop.hpp>
#include <articula/robots/q2d.hpp>

#include <array>
#include <string_view>

#include "allocation_guard.hpp"
#include "by_hand.hpp"
#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using articula::testing::heap_calls_in;

namespace {

bool volatile seen = false;  // the compiler cannot know who looks

/// All of a controller's functions, with states and references from calm to hostile.
template <int N, class C>
std::size_t heap_calls_of(const C& any_controller) {
  support::ByHand<C, N> controller = any_controller;
  support::Random random(3);
  JointState<N> state;
  JointReference<N> reference;
  std::size_t calls = 0;
  for (int k = 0; k < 500; ++k) {
    const double size = random.one_in(20) ? 1e300 : random.one_in(3) ? 10 : 0.5;
    state.position = random.vector<N>(size);
    state.velocity = random.vector<N>(size);
    reference.position = random.vector<N>(size);
    reference.velocity = random.vector<N>(size);
    reference.effort = random.vector<N>(size);
    if (random.one_in(30)) reference.position[0] = support::not_a_number;
    if (random.one_in(30)) state.velocity[0] = support::not_a_number;
    const double period = random.one_in(50) ? 2e-3 : 1e-3;
    calls += heap_calls_in([&] {
      if (k % 100 == 0) controller.start(state);
      seen = is_finite(controller.update(state, reference, period));
      if constexpr (requires { controller.report(); }) seen = controller.report()[0].any();
      if constexpr (TakesGains<C, ValidPidGains<N>>) set_gains(controller, ValidPidGains<N>());
    });
  }
  return calls;
}

template <class R>
using LimitedBypass = Limited<R, Bypass<R>>;
template <class R>
using LimitedPid = Limited<R, PidPlusGravity<R>>;
template <class R>
using LimitedPosition = Limited<R, ForwardPosition<R>>;
template <class R>
using LimitedVelocity = Limited<R, ForwardVelocity<R>>;
template <class R>
using LimitedSprings = Limited<R, DriveImpedance<R>>;

}  // namespace

TEST_CASE("no controller of any command interface touches the heap") {
  const auto robot = support::model<support::TiltedQ2d>();
  using R = Model<2>;
  const auto gains = Q2d::pid_gains;
  const JointImpedanceGains<2> springs{{{100, 1}, {100, 1}}};
  CHECK(heap_calls_of<2>(ForwardPosition<R>(robot)) == 0);
  CHECK(heap_calls_of<2>(ForwardVelocity<R>(robot)) == 0);
  CHECK(heap_calls_of<2>(PositionByVelocity<R>(robot, gains)) == 0);
  CHECK(heap_calls_of<2>(VelocityByEffort<R>(robot, gains)) == 0);
  CHECK(heap_calls_of<2>(JointImpedance<R>(robot, springs)) == 0);
  CHECK(heap_calls_of<2>(DriveImpedance<R>(robot, springs)) == 0);
  CHECK(heap_calls_of<2>(ComputedTorque<R>(robot, gains)) == 0);
}

TEST_CASE("nor do the laws that a controller can be put together from") {
  const auto robot = support::model<support::TiltedQ2d>();
  const std::array<std::string_view, 1> elbow{"elbow_active_joint"};
  for (const auto version :
       {ControlToolbox::current, ControlToolbox::jazzy, ControlToolbox::humble_antiwindup}) {
    using Law = OnJoints<2, ControlToolboxPidLaw<2>>;
    const ControlToolboxPidLaw<2> law(version, Q2d::pid_gains, joint_names(robot));
    CHECK(heap_calls_of<2>(EffortController<Model<2>, Law>(robot, Law(robot, law, elbow))) == 0);
  }
  JointPidGains<2> gains = Q2d::pid_gains;
  gains[0].anti_windup = AntiWindup::back_calculation;
  gains[1].derivative_of = DerivativeOf::error;
  gains[1].derivative_filter_time = 0.01;
  CHECK(heap_calls_of<2>(PidPlusGravity<Model<2>>(robot, gains)) == 0);
}

TEST_CASE("nor do limits, of any command") {
  const auto robot = support::model<support::TiltedQ2d>();
  using R = Model<2>;
  CommandLimits<2> limits = command_limits(robot);
  limits.acceleration.setConstant(20);
  limits.jerk.setConstant(1000);
  limits.soft_upper.setConstant(1);
  limits.soft_rate.setConstant(5);
  limits.effort_rate.setConstant(1000);
  const JointImpedanceGains<2> springs{{{100, 1}, {100, 1}}};
  CHECK(heap_calls_of<2>(LimitedBypass<R>(robot, limits, Bypass<R>(robot))) == 0);
  CHECK(heap_calls_of<2>(LimitedPid<R>(robot, limits, PidPlusGravity<R>(robot, Q2d::pid_gains))) ==
        0);
  CHECK(heap_calls_of<2>(LimitedPosition<R>(robot, limits, ForwardPosition<R>(robot))) == 0);
  CHECK(heap_calls_of<2>(LimitedVelocity<R>(robot, limits, ForwardVelocity<R>(robot))) == 0);
  CHECK(heap_calls_of<2>(LimitedSprings<R>(robot, limits, DriveImpedance<R>(robot, springs))) == 0);
}

TEST_CASE("nor does a loop with everything composed, whose gains change meanwhile") {
  CommandLimits<2> limits = command_limits(Q2d());
  limits.acceleration.setConstant(20);
  limits.jerk.setConstant(1000);
  Loop<Q2dSim, LimitedPid> loop{LimitedPid<Q2d>(limits)};
  GainsExchange<PidGains, 2> exchange(Q2d{});
  for (int k = 0; k < 50; ++k) {
    exchange.offer(Q2d::pid_gains);
    CHECK(heap_calls_in([&] {
            loop.reference().position.setConstant(k % 2 == 0 ? 3 : -3);
            seen = exchange.apply(loop.controller());
            for (int cycle = 0; cycle < 50; ++cycle) seen = loop.update() == Status::ok;
            seen = exchange.apply(loop.controller());
          }) == 0);
  }
}
