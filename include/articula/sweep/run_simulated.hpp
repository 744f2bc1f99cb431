// SPDX-License-Identifier: Apache-2.0
/// @file One run of a sweep, with a simulator of its own.
#pragma once

#include "articula/loop/control_loop.hpp"
#include "articula/sim/simulator.hpp"
#include "articula/sweep/delayed_commands.hpp"
#include "articula/sweep/loop_refused.hpp"
#include "articula/sweep/run_watch.hpp"
#include "articula/sweep/variation/varied_loop.hpp"

#include <type_traits>

namespace articula::detail {

/// The loop of one run, with a simulator of its own.
/// @param robot  which is simulated
/// @param make   makes the controller of gains
/// @throws LoopRefused if it cannot be simulated
template <DynamicRobot R, Robot Simulated, class Make>
[[nodiscard]] auto simulated_loop(const Simulated& robot, const VariedLoop<R>& own,
                                  const Make& make) {
  using Controller = std::remove_cvref_t<decltype(make(own.gains))>;
  using Command = typename CheckedController<Controller, articula::joint_count<R>, double>::Command;
  using Delayed = DelayedCommands<Simulator<Simulated>, Command>;
  return set_up([&] {
    return ControlLoop(Delayed(Simulator<Simulated>(robot, own.simulation), own.delay, own.lost),
                       make(own.gains));
  });
}

/// Runs one loop.
/// @param plan  must outlive the result
/// @return      what was watched
/// @throws as simulated_loop
template <DynamicRobot R, Robot Simulated, class Make>
[[nodiscard]] RunWatch<R> run_simulated(const RunPlan<R>& plan, const Simulated& robot,
                                        const VariedLoop<R>& own, const Make& make) {
  ControlLoop arm = simulated_loop(robot, own, make);
  auto& simulator = arm.hardware().simulator();
  RunWatch<R> watch(plan, simulator.true_state().position, effort_limits(robot));
  for (int cycle = 0;; ++cycle) {
    const double time = plan.time(cycle);
    arm.reference() = plan.signals->sample(time);
    if (!watch.begin(cycle, simulator.true_state(), arm.reference())) break;
    if (cycle == plan.cycles) break;
    if (plan.disturbances) simulator.set_external_effort(plan.disturbances->sample(time).effort);
    if (arm.update() != Status::ok) {
      watch.fail(true);
      break;
    }
    watch.finish(cycle, simulator.true_state());
  }
  return watch;
}

}  // namespace articula::detail
