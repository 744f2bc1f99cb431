// SPDX-License-Identifier: Apache-2.0
/// @file The control loop of a controller template: the shortest way to a running robot.
#pragma once

#include "articula/loop/control_loop.hpp"

namespace articula {

/// A ControlLoop whose controller is made from the hardware's robot:
///
///     Loop<Q2dSim, PidPlusGravity> loop;
///     loop.reference().position = {-1.0, 1.0};
///     while (loop.update() == Status::ok) { ... }
///
/// The second argument is a template. A plain struct `Mine`, a type such as `Pid<Q2d>`, or a
/// function does not fit there; two spellings take one:
///
///     Loop loop{Q2dSim(), Mine{}};      // deduced from the values
///     ControlLoop<Q2dSim, Mine> loop;   // by name, for a member of a class
///
/// @tparam HardwareType        satisfies Hardware
/// @tparam ControllerTemplate  makes a Controller of the hardware's robot; for hardware of several
///                             robots, of the robot and the type of a number
template <class HardwareType, template <class...> class ControllerTemplate>
class Loop
    : public ControlLoop<
          HardwareType, typename detail::ControllerFor<ControllerTemplate,
                                                       typename detail::RobotOf<HardwareType>::Type,
                                                       ScalarOf<HardwareType>>::Type> {
 public:
  using Loop::ControlLoop::ControlLoop;
};

/// A loop of a controller that is no template.
template <class HardwareType, class C>
Loop(HardwareType, C) -> Loop<HardwareType, detail::OfAnyRobot<C>::template Controller>;
/// @copydoc Loop(HardwareType, C)
template <class HardwareType, class C>
Loop(HardwareType, C, double) -> Loop<HardwareType, detail::OfAnyRobot<C>::template Controller>;

}  // namespace articula
