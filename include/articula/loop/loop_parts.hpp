// SPDX-License-Identifier: Apache-2.0
/// @file Compile-time messages for hardware and controllers that do not make a loop.
#pragma once

#include "articula/core/controller_check.hpp"
#include "articula/model/robot.hpp"

#include <concepts>
#include <exception>

namespace articula::detail {

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
  template <class...>
  using Controller = C;
};

/// The controller that a template makes for a hardware: of its robot, and of its scalar where that
/// is not double.
template <template <class...> class ControllerTemplate, class Robot, class S>
struct ControllerFor {
  using Type = ControllerTemplate<Robot, S>;
};
template <template <class...> class ControllerTemplate, class Robot>
struct ControllerFor<ControllerTemplate, Robot, double> {
  using Type = ControllerTemplate<Robot>;
};

/// A controller with the robot's own gains.
template <class C>
[[nodiscard]] C default_controller() {
  if constexpr (std::default_initializable<C>) {
    return C();
  } else {
    static_assert(
        std::default_initializable<C>,
        "this controller cannot be made by default: pass a controller, or add pid_gains to "
        "the robot if the controller takes its gains from there");
    std::terminate();
  }
}

}  // namespace articula::detail
