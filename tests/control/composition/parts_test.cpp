// SPDX-License-Identifier: Apache-2.0
#include <articula/control/computed_torque.hpp>
#include <articula/control/joint_impedance.hpp>
#include <articula/control/laws/on_joints.hpp>
#include <articula/control/limits/limited.hpp>
#include <articula/control/pid.hpp>
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/control/switching/switch.hpp>
#include <articula/loop/exchange/gains_exchange.hpp>
#include <articula/loop/exchange/switch_exchange.hpp>
#include <articula/loop/loop.hpp>
#include <articula/remote/gains/gain_parameters.hpp>
#include <articula/robots/q2d.hpp>

#include "catch.hpp"

#include <string>
#include <string_view>
#include <tuple>
#include <variant>

using namespace articula;

namespace {

/// A composition as docs/your_own_controller.md has it: what a loop asks of it, and `parts`.
template <class C>
struct HalfEfforts {
  C controller;

  void start(const ControlInput<2>& in) noexcept { start_controller(controller, in); }
  Outcome<EffortCommand<2>> update(const ControlInput<2>& in) noexcept {
    auto outcome = update_controller(controller, in);
    outcome.command.effort *= 0.5;
    return outcome;
  }
  static auto parts(auto& self) noexcept { return std::tie(self.controller); }
};

/// A controller of one of several kinds.
struct EitherController {
  std::variant<Pid<Q2d>, JointImpedance<Q2d>> kind{Pid<Q2d>()};

  EffortCommand<2> update(const ControlInput<2>&) noexcept { return {}; }
  static auto parts(auto& self) noexcept { return std::tie(self.kind); }
};

const Q2d robot;
const PidGains seven{.proportional = 7};
const ValidPidGains<2> sevens({seven, seven}, joint_names(Q2d()));

struct BesideVariant {
  Pid<Q2d> own{};
  std::variant<Pid<Q2d>> other{};
  static auto parts(auto& self) noexcept { return std::tie(self.own, self.other); }
};

/// Functions `parts` that are none.
struct OfOneObject : Pid<Q2d> {
  auto parts() noexcept { return std::tie(*this); }
};
struct OfNonConstant : Pid<Q2d> {
  static auto parts(OfNonConstant& self) noexcept { return std::tie(self); }
};
struct OfCopies : Pid<Q2d> {
  static auto parts(auto& self) noexcept { return std::make_tuple(self); }
};
struct OfNoTuple : Pid<Q2d> {
  static auto& parts(auto& self) noexcept { return self; }
};
static_assert(detail::PartsFit<Pid<Q2d>> && detail::PartsFit<HalfEfforts<Pid<Q2d>>>);
static_assert(!detail::PartsFit<OfOneObject> && !detail::PartsFit<OfNonConstant>);
static_assert(!detail::PartsFit<OfCopies> && !detail::PartsFit<OfNoTuple>);

}  // namespace

TEST_CASE("gains reach the law in compositions of one's own") {
  CommandLimits<2> limits = command_limits(robot);
  limits.acceleration = {20, 40};
  HalfEfforts<Limited<Q2d, Pid<Q2d>>> half{{limits, Pid<Q2d>()}};
  static_assert(TakesGains<decltype(half), ValidPidGains<2>>);
  static_assert(!TakesGains<decltype(half), ValidImpedanceGains<2>>);
  static_assert(!TakesGains<const decltype(half), ValidPidGains<2>>);
  set_gains(half, sevens);
  CHECK(half.controller.controller().part<PidLaw<2>>().gains()[1].proportional == 7);

  GainsExchange<PidGains, 2> exchange(Q2d{});
  exchange.offer({PidGains{.proportional = 8}, PidGains{.proportional = 9}});
  CHECK(exchange.apply(half));
  CHECK(half.controller.controller().part<PidLaw<2>>().gains()[1].proportional == 9);
}

TEST_CASE("a variant among the parts is the controller that it holds") {
  EitherController either;
  remote::GainParameters parameters(robot, either);
  REQUIRE(parameters.list().size() > 0);
  either.kind = JointImpedance<Q2d>({});
  remote::GainParameters others(robot, either);
  CHECK(others.list().size() > 0);
  CHECK(others.list().front().name != parameters.list().front().name);
  // Which gains it takes is known only while it runs.
  static_assert(!TakesGains<EitherController, ValidPidGains<2>>);
}

TEST_CASE("a switch in compositions of one's own takes requests") {
  using Two = Switch<Q2d, PidPlusGravity<Q2d>, ComputedTorque<Q2d>>;
  ControlLoop<Q2dSim, HalfEfforts<HalfEfforts<Two>>> loop;
  SwitchExchange exchange(loop.controller());
  static_assert(std::same_as<decltype(exchange), SwitchExchange<2>>);
  CHECK(switch_in(loop.controller()).list()[1].name == Name("computed_torque"));
  const auto outcome =
      switch_in(loop.controller()).request({.start = {"computed_torque"}, .replace = true});
  CHECK(outcome.answer == SwitchAnswer::done);
}

TEST_CASE("joints, rate and unit of parts reach through compositions") {
  const std::string_view elbow[] = {"elbow_active_joint"};
  HalfEfforts<EffortController<Q2d, OnJoints<2, PidLaw<2>>>> half{
      EffortController<Q2d, OnJoints<2, PidLaw<2>>>(
          Q2d(),
          OnJoints<2, PidLaw<2>>(Q2d(), PidLaw<2>(robot, JointPidGains<2>{seven, seven}), elbow))};
  remote::GainParameters parameters(robot, half);
  REQUIRE(!parameters.list().empty());
  for (const auto& value : parameters.list()) {
    CHECK(value.name.find("elbow_active_joint") != std::string::npos);
  }
}

TEST_CASE("gains of a part do not reach into a variant beside it") {
  BesideVariant both;
  set_gains(both, sevens);
  CHECK(both.own.part<PidLaw<2>>().gains()[0].proportional == 7);
  CHECK(std::get<0>(both.other).part<PidLaw<2>>().gains()[0].proportional != 7);
}
