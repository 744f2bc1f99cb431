// SPDX-License-Identifier: Apache-2.0
/// @file The closed loop of a sweep from a file. Compiled once for each number of joints.
#pragma once

#include "loops/listed_controllers.hpp"
#include "sweep_plan.hpp"

#include <articula/config/load_pid_gains.hpp>
#include <articula/control/computed_torque.hpp>
#include <articula/control/pid.hpp>
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/sweep/closed_loop_experiment.hpp>
#include <articula/urdf/urdf.hpp>

#include <memory>
#include <string>
#include <utility>

namespace terminal {

template <int N>
AnyExperiment make_experiment(const SweepPlan& plan) {
  using Robot = articula::Model<N>;
  using Any = AnyController<Robot, articula::EffortCommand<N>, articula::Pid<Robot>,
                            articula::PidPlusGravity<Robot>, articula::ComputedTorque<Robot>>;
  const auto robot = std::make_shared<const Robot>(articula::load_urdf<N>(plan.robot.value()));
  const PlannedController& planned = plan.controllers.controllers.front();
  const auto gains =
      articula::load_pid_gains(*robot, plan.controllers.source, planned.section).gains;
  const auto make = [robot, kind = planned.kind](const articula::JointPidGains<N>& own) -> Any {
    switch (kind) {
      case ControllerKind::pid:
        return {articula::Pid<Robot>(*robot, own)};
      case ControllerKind::computed_torque:
        return {articula::ComputedTorque<Robot>(*robot, own)};
      default:
        return {articula::PidPlusGravity<Robot>(*robot, own)};
    }
  };
  articula::ClosedLoopOptions<N> options;
  options.simulation.period = plan.controllers.period;
  options.simulation.substeps = plan.substeps;
  options.duration = plan.duration;
  options.disturbances = plan.disturbances;
  options.vary = plan.vary;
  articula::JointVector<N> start = articula::initial_position(*robot, options.simulation);
  for (const auto& [joint, position] : plan.start) {
    start[articula::joint_index(*robot, articula::Name(joint))] = position;
  }
  articula::JointVector<N> target = start;
  for (const auto& [joint, position] : plan.target) {
    target[articula::joint_index(*robot, articula::Name(joint))] = position;
  }
  options.simulation.initial_position = start;
  options.target = target;
  using Experiment = articula::ClosedLoopExperiment<Robot, decltype(make)>;
  const auto experiment =
      std::make_shared<const Experiment>(*robot, gains, make, std::move(options));
  return {experiment->parameters(), experiment->metrics(),
          [experiment](const articula::SweepRun& run, std::span<double> metrics) {
            return experiment->run(run, metrics);
          }};
}

}  // namespace terminal
