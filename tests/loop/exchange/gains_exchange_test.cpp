// SPDX-License-Identifier: Apache-2.0
#include <articula/control/joint_impedance.hpp>
#include <articula/control/limits/limited.hpp>
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/loop/exchange/gains_exchange.hpp>
#include <articula/loop/loop.hpp>
#include <articula/robots/q2d.hpp>

#include <atomic>
#include <thread>

#include "catch.hpp"
#include "numbers.hpp"

using namespace articula;

namespace {

template <class R>
using CarefulPid = Limited<R, PidPlusGravity<R>>;

JointPidGains<2> all(double x) {
  const PidGains g{.proportional = x, .integral = x, .derivative = x};
  return {g, g};
}

}  // namespace

TEST_CASE("new gains are there in the next cycle, and nothing else changes") {
  Loop<Q2dSim, PidPlusGravity> loop;
  GainsExchange<PidGains, 2> exchange(Q2d{});
  CHECK_FALSE(exchange.apply(loop.controller()));
  loop.reference().position = {1e-3, -1e-3};
  for (int k = 0; k < 100; ++k) REQUIRE(loop.update() == Status::ok);
  const auto integral = loop.controller().part<PidLaw<2>>().integral();
  exchange.offer(all(7));
  exchange.offer(all(8));  // the last one counts
  CHECK(loop.controller().part<PidLaw<2>>().gains()[0].proportional == 2310);
  CHECK(exchange.apply(loop.controller()));
  CHECK_FALSE(exchange.apply(loop.controller()));
  CHECK(loop.controller().part<PidLaw<2>>().gains()[0].proportional == 8);
  CHECK(loop.controller().part<PidLaw<2>>().integral() == integral);
}

TEST_CASE("a bad set is refused as a whole, with the reason") {
  PidPlusGravity<Q2d> controller;
  GainsExchange<PidGains, 2> exchange(Q2d{});
  JointPidGains<2> gains = all(9);
  gains[1].derivative = support::not_a_number;
  CHECK_THROWS_WITH(exchange.offer(gains), Catch::Matchers::Contains("'elbow_active_joint'") &&
                                               Catch::Matchers::Contains("derivative nan"));
  CHECK_FALSE(exchange.apply(controller));
  CHECK(controller.part<PidLaw<2>>().gains()[0].proportional == 2310);
}

TEST_CASE("whatever takes gains can be given them") {
  GainsExchange<PidGains, 2> pid(Q2d{});
  pid.offer(all(5));
  CommandLimits<2> limits = command_limits(Q2d());
  limits.deceleration = {20, 20};
  CarefulPid<Q2d> careful(limits);
  CHECK(pid.apply(careful));
  CHECK(careful.controller().part<PidLaw<2>>().gains()[1].integral == 5);

  GainsExchange<ImpedanceGains, 2> impedance(Q2d{});
  JointImpedance<Q2d> springs({});
  impedance.offer({{{10, 0}, {20, 0}}});
  CHECK(impedance.apply(springs));
  JointReference<2> reference;
  reference.position = {0.5, 0.25};
  CHECK(springs.update({{}, reference, 1e-3}).effort == JointVector<2>(5, 5));
  CHECK_THROWS_AS(impedance.offer({{{-1, 0}, {20, 0}}}), std::invalid_argument);
}

TEST_CASE("gains that another thread offers are never mixed") {
  PidPlusGravity<Q2d> controller(all(0));
  GainsExchange<PidGains, 2> exchange(Q2d{});
  std::atomic<bool> done = false;
  std::thread other([&] {
    for (int k = 1; k <= 20000; ++k) exchange.offer(all(k));
    done = true;
  });
  bool mixed = false;
  double last = 0;
  const auto look = [&] {
    exchange.apply(controller);
    const auto& gains = controller.part<PidLaw<2>>().gains();
    for (const PidGains& g : gains) {
      mixed = mixed || g.proportional != gains[0].proportional || g.integral != g.proportional ||
              g.derivative != g.proportional;
    }
    mixed = mixed || gains[0].proportional < last;
    last = gains[0].proportional;
  };
  while (!done) look();
  look();
  other.join();
  CHECK_FALSE(mixed);
  CHECK(last == 20000);
}
