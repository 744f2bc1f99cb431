// SPDX-License-Identifier: Apache-2.0
/// @file Compile-time messages for hardware and controllers that do not fit a loop.
#pragma once

#include "articula/core/controller.hpp"
#include "articula/model/robot.hpp"

#include <concepts>
#include <exception>

namespace articula::detail {

/// What is asserted of a type that can be called.
/// @tparam N  number of joints
template <class C, int N, bool = HasUpdate<C, N> || IsCallable<C, N>>
struct CheckedUpdate {
  using Command = CommandOf<C, N>;
  static_assert(update_is_noexcept<C, N>(), "update of the controller must be noexcept");
  static_assert(JointCommand<Command, N>,
                "update of the controller must return a command for N joints by value, such as "
                "EffortCommand<N>, or an Outcome of one, see core/controller.hpp");
};
template <class C, int N>
struct CheckedUpdate<C, N, false> {
  using Command = EffortCommand<N>;  // so that the message below is the first
  static_assert(HasUpdate<C, N>,
                "the controller has no update(const ControlInput<N>&) for the N joints of this "
                "robot, see core/controller.hpp");
};

/// Asserts all that the concept Controller demands, one thing at a time.
/// @tparam N  number of joints
template <class C, int N>
struct CheckedController : CheckedUpdate<C, N> {
  static_assert(StartFits<C, N>,
                "start of the controller must take a const ControlInput<N>& for the N joints of "
                "this robot, see core/controller.hpp");
  static_assert(start_is_noexcept<C, N>(), "start of the controller must be noexcept");
};

/// Hardware that is written such commands, whatever else it may lack.
template <class H, class Command>
concept TakesCommand = requires(H hardware, const Command& command) { hardware.write(command); };

/// The robot of a hardware.
template <class H, bool = requires { typename H::RobotType; }>
struct RobotOf {
  using Type = typename H::RobotType;
};
template <class H>
struct RobotOf<H, false> {
  using Type = H;  // so that the messages below are the first
  static_assert(!Robot<H>,
                "this is a robot, not its hardware: write Loop<Simulator<R>, ...> for a "
                "simulated one, such as Q2dSim for Q2d");
  static_assert(Robot<H>, "the hardware has no RobotType, see core/hardware.hpp");
};

/// The same controller for every robot: for a controller that is no template.
template <class C>
struct OfAnyRobot {
  template <class>
  using Controller = C;
};

/// A controller with the robot's own gains.
template <class C>
[[nodiscard]] C default_controller() {
  if constexpr (std::default_initializable<C>) {
    return C();
  } else {
    static_assert(std::default_initializable<C>,
                  "this controller has no default gains for this robot: add pid_gains to the "
                  "robot, or pass a controller");
    std::terminate();
  }
}

}  // namespace articula::detail
