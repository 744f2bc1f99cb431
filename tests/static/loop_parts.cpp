// SPDX-License-Identifier: Apache-2.0
// What a loop is made of has to fit.
#include <articula/control/forward_position.hpp>
#include <articula/control/limits/limited.hpp>
#include <articula/control/pid.hpp>
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/control/switching/groups.hpp>
#include <articula/control/switching/switch.hpp>
#include <articula/hardware/mock/mock_hardware.hpp>
#include <articula/loop/exchange/gains_exchange.hpp>
#include <articula/loop/loop.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/robots/ur10.hpp>

#include <array>
#include <concepts>

using namespace articula;

#ifdef UPDATE_MAY_THROW
#define UPDATE_NOEXCEPT
#else
#define UPDATE_NOEXCEPT noexcept
#endif
#ifdef START_MAY_THROW
#define START_NOEXCEPT
#else
#define START_NOEXCEPT noexcept
#endif
#ifdef WRITE_MAY_THROW
#define WRITE_NOEXCEPT
#else
#define WRITE_NOEXCEPT noexcept
#endif
#ifdef POSITION_CONTROLLER
template <int N>
using Command = PositionCommand<N>;
#elif defined(CONTROLLER_OF_ANOTHER_SIZE)
template <int N>
using Command = EffortCommand<N + 1>;
#elif defined(UPDATE_GIVES_A_VECTOR)
template <int N>
using Command = JointVector<N>;
#else
template <int N>
using Command = EffortCommand<N>;
#endif

template <Robot R>
struct Limp {
  static constexpr int N = joint_count<R>;
#ifdef START_OF_A_STATE
  void start(const JointState<N>&) noexcept {}
#else
  void start(const ControlInput<N>&) START_NOEXCEPT {}
#endif
#ifdef PARTS_OF_ONE_OBJECT
  auto parts() noexcept { return std::tie(*this); }
#endif
#ifdef BRAKE_MAY_THROW
  Command<N> brake(const ControlInput<N>&) { return {}; }
#endif
#ifdef UPDATE_OF_A_STATE
  Command<N> update(const JointState<N>&, const JointReference<N>&, double) noexcept { return {}; }
#else
  Command<N> update(const ControlInput<N>&) UPDATE_NOEXCEPT { return {}; }
#endif
};

struct Drives {
  using RobotType = Q2d;
  static constexpr int joint_count = 2;
  [[nodiscard]] const Q2d& robot() const noexcept { return robot_; }
  Status activate() { return Status::ok; }
  Status deactivate() { return Status::ok; }
#ifndef HARDWARE_WITHOUT_READ
  Status read(JointState<2>&) noexcept { return Status::ok; }
#endif
  Status write(const EffortCommand<2>&) WRITE_NOEXCEPT { return Status::ok; }

  Q2d robot_;
};

/// The Q2D as somebody describes it who has no gains for it yet.
struct Bare {
  static constexpr auto description = Q2d::description;
};
struct BareDrives : Drives {
  using RobotType = Bare;
  [[nodiscard]] const Bare& robot() const noexcept { return bare_; }

  Bare bare_;
};

/// No template: for this arm alone.
struct LimpArm : Limp<Q2d> {};

template <class R>
using TwoPids = Switch<R, Pid<R>, PidPlusGravity<R>>;

int main() {
  Loop of_one_robot{Drives(), LimpArm()};
  Loop of_any_robot{Drives(), Limp<Q2d>(), 2e-3};
  static_assert(std::same_as<decltype(of_one_robot)::ControllerType, LimpArm>);
  static_assert(std::same_as<decltype(of_any_robot)::ControllerType, Limp<Q2d>>);
#ifdef CONTROLLER_OF_ANOTHER_ROBOT
  Loop mistake{Drives(), Pid<Ur10>(JointPidGains<6>())};
#endif
#ifdef FUNCTION_MAY_THROW
  Loop mistake{Drives(), [](const ControlInput<2>&) { return EffortCommand<2>(); }};
#endif
#ifdef FUNCTION_OF_A_STATE
  Loop mistake{Drives(), [](const JointState<2>&) noexcept { return EffortCommand<2>(); }};
#endif
  Loop of_a_function{Drives(), [](const ControlInput<2>&) noexcept { return EffortCommand<2>(); }};
  static_assert(Controller<decltype(of_a_function)::ControllerType, 2>);
#ifdef MOCK_OF_EFFORTS
  Loop<MockHardware<Q2d>, ForwardPosition> mistake;
#endif
#ifdef LIMITED_WITHOUT_CONTROLLER
  Limited<Bare, PidPlusGravity<Bare>> mistake(command_limits(Bare()));
#endif
  // A part of a composition has to be a controller, too.
  const auto rest = [](const ControlInput<2>&) noexcept { return EffortCommand<2>(); };
#ifdef PART_MAY_THROW
  const auto part = [](const ControlInput<2>&) { return EffortCommand<2>(); };
#elif defined(PART_OF_A_STATE)
  const auto part = [](const JointState<2>&) noexcept { return EffortCommand<2>(); };
#else
  const auto part = rest;
#endif
#if !defined(IN_SWITCH) && !defined(IN_GROUPS)
  CommandLimits<2> limits = command_limits(Q2d());
  limits.acceleration = {20, 20};
  Limited careful(Q2d(), limits, part);
  static_assert(Controller<decltype(careful), 2>);
#endif
#if !defined(IN_LIMITED) && !defined(IN_GROUPS)
  Switch<Q2d, decltype(rest), decltype(part)> either(Q2d(), {}, rest, part);
  static_assert(Controller<decltype(either), 2>);
#endif
#if !defined(IN_LIMITED) && !defined(IN_SWITCH)
  Groups groups(Q2d(),
                std::array{JointGroup{"a", {"shoulder_active_joint"}},
                           JointGroup{"b", {"elbow_active_joint"}}},
                rest, part);
  static_assert(Controller<decltype(groups), 2>);
#endif
#ifdef ROBOT_AS_HARDWARE
  Loop<Q2d, PidPlusGravity> mistake;
#endif
#ifdef SUPERVISED_ROBOT
  SupervisedLoop<Q2d, PidPlusGravity> mistake;
#endif
#ifdef HARDWARE_WITHOUT_ROBOT
  Loop<int, PidPlusGravity> mistake;
#endif
  GainsExchange<PidGains, 2> exchange(Q2d{});
  TwoPids<Q2d> two;
#ifdef GAINS_OF_NOBODY
  set_gains(two, ValidPidGains<2>());
#endif
#ifdef EXCHANGE_WITH_NOBODY
  exchange.apply(two);
#endif
#ifdef SWITCH_OF_NOBODY
  static_cast<void>(switch_in(two.member<0>()).list());
#endif
  exchange.apply(two.member<0>());
  TwoPids<Q2d>().member<Pid<Q2d>>().set_gains(ValidPidGains<2>());
#ifdef WITHOUT_GAINS
  Loop<BareDrives, PidPlusGravity> mistake;
#endif
#ifdef HARDWARE_WITHOUT_GAINS
  Loop<BareDrives, PidPlusGravity> mistake{BareDrives()};
#endif
  Loop<Drives, Limp> loop;
#ifdef STATUS_IGNORED
#pragma GCC diagnostic error "-Wunused-result"
  loop.update();
#else
  return loop.update() == Status::ok ? 0 : 1;
#endif
}
