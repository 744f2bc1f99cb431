// SPDX-License-Identifier: Apache-2.0
/// @file Runs a loop that files describe. Compiled once for each number of joints and kind of drives.
#pragma once

#include "listed_controllers.hpp"
#include "loop_plan.hpp"

#include <articula/articula.hpp>
#include <articula/config/load_pid_gains.hpp>
#include <articula/hardware/mock/mock_hardware.hpp>
#include <articula/loop/realtime/run_realtime.hpp>
#include <articula/loop/realtime/stop_on_signal.hpp>
#include <articula/remote/remote.hpp>
#include <articula/urdf/urdf.hpp>
#include <articula/view/view.hpp>

#include <cmath>
#include <utility>
#include <vector>

namespace terminal {

/// The controllers that robots of one kind of drives may have, and the hardware that stands for them.
template <articula::Robot R, Drives D>
struct Family;

template <articula::Robot R>
struct Family<R, Drives::efforts> {
  using Command = articula::EffortCommand<articula::joint_count<R>>;
  using Any =
      AnyController<R, Command, articula::Bypass<R>, articula::Pid<R>, articula::PidPlusGravity<R>,
                    articula::ComputedTorque<R>, articula::VelocityByEffort<R>>;

  static Any make(const R& robot, ControllerKind kind,
                  const articula::JointPidGains<articula::joint_count<R>>& gains) {
    using enum ControllerKind;
    switch (kind) {
      case pid:
        return {articula::Pid<R>(robot, gains)};
      case pid_plus_gravity:
        return {articula::PidPlusGravity<R>(robot, gains)};
      case computed_torque:
        return {articula::ComputedTorque<R>(robot, gains)};
      case velocity_by_effort:
        return {articula::VelocityByEffort<R>(robot, gains)};
      default:
        return {articula::Bypass<R>(robot)};
    }
  }
};

template <articula::Robot R>
struct Family<R, Drives::positions> {
  using Command = articula::PositionCommand<articula::joint_count<R>>;
  using Any = AnyController<R, Command, articula::ForwardPosition<R>>;

  static Any make(const R& robot, ControllerKind,
                  const articula::JointPidGains<articula::joint_count<R>>&) {
    return {articula::ForwardPosition<R>(robot)};
  }
};

/// Runs a loop with this hardware.
template <Drives D, articula::Robot R, class Hardware>
LoopEnd run_with(const LoopPlan& plan, const R& robot, Hardware hardware) {
  constexpr int n = articula::joint_count<R>;
  using Own = Family<R, D>;
  std::vector<articula::Name> names;
  std::vector<typename Own::Any> controllers;
  for (const PlannedController& planned : plan.controllers.controllers) {
    articula::JointPidGains<n> gains{};
    if (traits_of(planned.kind).has_gains) {
      gains = articula::load_pid_gains(robot, plan.controllers.file, planned.section).gains;
    }
    names.emplace_back(planned.name);
    controllers.push_back(Own::make(robot, planned.kind, gains));
  }
  using Controllers = ListedControllers<R, typename Own::Any>;
  // Simulated drives suffer no harm from a desktop's overruns.
  constexpr int any_number = 1000000;
  articula::SupervisedControlLoop<Hardware, Controllers> loop(
      std::move(hardware), Controllers(robot, names, controllers), {.overruns = any_number},
      plan.controllers.period);
  articula::Remote remote(loop, {.urdf = plan.urdf_text});
  articula::View view(remote, {.address = plan.address,
                               .port = plan.port,
                               .operates = !plan.is_read_only,
                               .token = plan.token,
                               .page_folder = plan.page_folder,
                               .mesh_folders = plan.mesh_folders});
  loop.request_activation();

  articula::StopFlag stop;
  const articula::StopOnSignal on_signal(stop);  // before anybody knows that it runs
  plan.ready(view.url());
  articula::RealtimeOptions options;
  options.thread.priority = plan.priority;
  options.thread.lock_memory = plan.priority > 0;
  options.thread.processors = plan.controllers.processors;
  options.run.stop = &stop;
  if (std::isfinite(plan.seconds)) {
    options.run.cycles =
        static_cast<std::uint64_t>(std::llround(plan.seconds / plan.controllers.period));
  }
  const articula::RunReport report = articula::run(remote, options, remote.each());
  return {report.cycles, report.overruns, std::string(articula::to_string(report.status))};
}

template <int N, Drives D>
LoopEnd run_loop(const LoopPlan& plan) {
  const articula::Model<N> robot = articula::load_urdf<N>(plan.robot);
  if constexpr (D == Drives::positions) {
    using Mock = articula::MockHardware<articula::Model<N>, articula::PositionCommand<N>>;
    if (plan.is_mock) return run_with<D>(plan, robot, Mock(robot, {}, plan.controllers.period));
  }
  return run_with<D>(
      plan, robot,
      articula::Simulator<articula::Model<N>>(
          robot, {.period = plan.controllers.period, .substeps = plan.controllers.substeps}));
}

}  // namespace terminal
