// SPDX-License-Identifier: Apache-2.0
// Gains under which a joint chatters are known before it moves.
#include <articula/articula.hpp>
#include <articula/control/gain_notices.hpp>
#include <articula/robots/panda.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/robots/ur10.hpp>

#include "catch.hpp"
#include "test_controllers.hpp"
#include "test_robots.hpp"

#include <algorithm>
#include <cmath>
#include <string>

using namespace articula;
using Catch::Matchers::Contains;

namespace {

template <class R>
using Controllers = Switch<R, Pid<R>, PidPlusGravity<R>>;
template <class R>
using CarefulPid = Limited<R, Pid>;

template <int N>
JointPidGains<N> same(const PidGains& gains) {
  JointPidGains<N> all;
  all.fill(gains);
  return all;
}

/// The largest change of a joint's effort from cycle to cycle while it holds, in the last cycles.
double unrest(Loop<Simulator<Ur10>, PidPlusGravity>& loop, int joint) {
  loop.reference().position[joint] += 1e-4;
  double last = 0, most = 0;
  for (int k = 0; k < 2000; ++k) {
    REQUIRE(loop.update() == Status::ok);
    const double effort = loop.command().effort[joint];
    if (k > 1000) most = std::max(most, std::abs(effort - last));
    last = effort;
  }
  return most;
}

}  // namespace

TEST_CASE(
    "a UR10 with a laboratory's gains chatters at its last wrist, and the loop says so before") {
  PidGains gains{.proportional = 1000, .integral = 0.01, .derivative = 10};
  Loop<Simulator<Ur10>, PidPlusGravity> loop{PidPlusGravity<Ur10>(same<6>(gains))};
  const std::vector<std::string> notices = loop.notices();
  REQUIRE_FALSE(notices.empty());
  CAPTURE(notices);
  CHECK_THAT(notices.back(),
             Contains("joint 'wrist_3_joint' will chatter: its derivative gain is 10"));
  CHECK(unrest(loop, 5) > 50);  // from limit to limit

  auto calm = same<6>({.proportional = 1000, .integral = 0.01, .derivative = 10});
  for (int j = 0; j < 6; ++j) {
    const double inertia = equivalent_inertia(Ur10(), loop.state().position, j, OtherJoints::free);
    auto& g = calm[static_cast<std::size_t>(j)];
    g.derivative = std::min(g.derivative, 0.5 * inertia / 1e-3);
    g.proportional = std::min(g.proportional, g.derivative / 0.02);
  }
  Loop<Simulator<Ur10>, PidPlusGravity> still{PidPlusGravity<Ur10>(calm)};
  CHECK(still.notices().empty());
  CHECK(unrest(still, 5) < 1e-3);
}

TEST_CASE("the chattering gain is where a damped joint's velocity begins to grow") {
  for (const double inertia : {1e-3, 0.1, 10.0}) {
    for (const double damping : {0.0, 1e-9, 0.5, 100.0}) {
      const double most = chattering_gain(inertia, damping, 1e-3);
      const auto factor = [&](double d) {
        const double e = std::exp(-damping * 1e-3 / inertia);
        return e - d * (damping > 0 ? -std::expm1(-damping * 1e-3 / inertia) / damping
                                    : 1e-3 / inertia);
      };
      CHECK(factor(most) == Approx(-1));
    }
  }
}

TEST_CASE("notices come from within limits and switches, and not from drives' own loops") {
  const auto hard = same<2>({.derivative = 1e5});
  const Pid<Q2d> pid(hard);
  const JointVector<2> q(0.1, 0.2);
  CHECK(gain_notices(Q2d(), pid, q, 1e-3).size() == 2);
  CHECK(gain_notices(Q2d(), Controllers<Q2d>({}, pid, PidPlusGravity<Q2d>(hard)), q, 1e-3).size() ==
        4);
  CommandLimits<2> limits = command_limits(Q2d());
  limits.acceleration.setConstant(100);
  CHECK(gain_notices(Q2d(), CarefulPid<Q2d>(limits, pid), q, 1e-3).size() == 2);
  CHECK(gain_notices(Q2d(), PositionByVelocity<Q2d>(hard), q, 1e-3).empty());
  CHECK(
      gain_notices(Q2d(), VelocityByEffort<Q2d>(same<2>({.proportional = 1e5})), q, 1e-3).size() ==
      2);
  // A filter that is slow enough takes the noise of the derivative, and the chatter.
  const auto filtered = same<2>({.derivative = 1e3, .derivative_filter_time = 1});
  CHECK(gain_notices(Q2d(), Pid<Q2d>(filtered), q, 1e-3).empty());
}

TEST_CASE("the ready robots' own gains need no notice") {
  CHECK(Loop<Q2dSim, PidPlusGravity>().notices().empty());
  CHECK(Loop<Q2dSim, Bypass>().notices().empty());
}
