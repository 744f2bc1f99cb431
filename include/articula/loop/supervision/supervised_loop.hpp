// SPDX-License-Identifier: Apache-2.0
/// @file The supervised loop of a controller template.
#pragma once

#include "articula/loop/loop.hpp"
#include "articula/loop/supervision/supervised_control_loop.hpp"

namespace articula {

/// A SupervisedControlLoop whose controller is made from the hardware's robot, see Loop.
/// @tparam HardwareType        satisfies Hardware
/// @tparam ControllerTemplate  makes a Controller of the hardware's robot
template <class HardwareType, template <class> class ControllerTemplate>
class SupervisedLoop
    : public SupervisedControlLoop<
          HardwareType, ControllerTemplate<typename detail::RobotOf<HardwareType>::Type>> {
 public:
  using SupervisedLoop::SupervisedControlLoop::SupervisedControlLoop;
};

}  // namespace articula
