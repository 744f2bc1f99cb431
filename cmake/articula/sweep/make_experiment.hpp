// SPDX-License-Identifier: Apache-2.0
/// @file The closed loop of a sweep from a file. Compiled once for each number of joints.
#pragma once

#include "loops/listed_controllers.hpp"
#include "sweep_plan.hpp"

#include <articula/control/computed_torque.hpp>
#include <articula/control/pid.hpp>
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/urdf/urdf.hpp>

#include <memory>

namespace terminal {

template <int N>
AnyExperiment make_experiment(const SweepPlan& plan) {
  using Robot = articula::Model<N>;
  using Any = AnyController<Robot, articula::EffortCommand<N>, articula::Pid<Robot>,
                            articula::PidPlusGravity<Robot>, articula::ComputedTorque<Robot>>;
  const auto robot = std::make_shared<const Robot>(articula::load_urdf<N>(plan.robot.value()));
  const auto make = [robot, kind = plan.controllers.controllers.front().kind](
                        const articula::JointPidGains<N>& gains) -> Any {
    switch (kind) {
      case ControllerKind::pid:
        return {articula::Pid<Robot>(*robot, gains)};
      case ControllerKind::computed_torque:
        return {articula::ComputedTorque<Robot>(*robot, gains)};
      default:
        return {articula::PidPlusGravity<Robot>(*robot, gains)};
    }
  };
  return any_experiment(*robot, make, plan.loop());
}

}  // namespace terminal
