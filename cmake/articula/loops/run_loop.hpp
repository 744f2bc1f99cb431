// SPDX-License-Identifier: Apache-2.0
/// @file Runs a loop that files describe. Compiled once for each size of robots.
#pragma once

#include "listed_controllers.hpp"
#include "loop_plan.hpp"

#include <articula/articula.hpp>
#include <articula/config/load_pid_gains.hpp>
#include <articula/config/load_trajectory_tolerances.hpp>
#include <articula/hardware/mock/mock_hardware.hpp>
#include <articula/loop/realtime/run_realtime.hpp>
#include <articula/loop/realtime/stop_on_signal.hpp>
#include <articula/remote/remote.hpp>
#include <articula/urdf/urdf.hpp>
#include <articula/view/view.hpp>

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace terminal {

/// The controllers that robots of one kind of drives may have, and the hardware that stands for
/// them.
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

template <articula::Robot R>
struct Family<R, Drives::velocities> {
  using Command = articula::VelocityCommand<articula::joint_count<R>>;
  using Any =
      AnyController<R, Command, articula::ForwardVelocity<R>, articula::PositionByVelocity<R>>;

  static Any make(const R& robot, ControllerKind kind,
                  const articula::JointPidGains<articula::joint_count<R>>& gains) {
    if (kind == ControllerKind::position_by_velocity) {
      return {articula::PositionByVelocity<R>(robot, gains)};
    }
    return {articula::ForwardVelocity<R>(robot)};
  }
};

/// Runs a loop with this hardware.
template <Drives D, articula::Robot R, class Hardware>
LoopEnd run_with(const LoopPlan& plan, const R& robot, Hardware hardware) {
  constexpr int n = articula::joint_count<R>;
  using Own = Family<R, D>;
  using Controllers = ListedControllers<R, typename Own::Any>;
  std::vector<typename Controllers::Group> groups;
  for (const PlannedGroup& planned_group : plan.groups) {
    auto& group = groups.emplace_back();
    for (const std::string& joint : planned_group.joints) group.joints.emplace_back(joint);
    for (const std::size_t at : planned_group.controllers) {
      const PlannedController& planned = plan.controllers.controllers[at];
      articula::JointPidGains<n> gains{};
      if (traits_of(planned.kind).has_gains) {
        gains = articula::load_pid_gains(robot, plan.controllers.source, planned.section,
                                         articula::GainsOf::some_joints)
                    .gains;
      }
      group.names.emplace_back(planned.name);
      group.controllers.push_back(Own::make(robot, planned.kind, gains));
    }
  }
  // Simulated drives suffer no harm from a desktop's overruns.
  constexpr int any_number = 1000000;
  articula::SupervisedControlLoop<Hardware, Controllers> loop(
      std::move(hardware), Controllers(robot, groups), {.overruns = any_number},
      plan.controllers.period);
  articula::Remote remote(
      loop, {.tolerances = articula::load_all_tolerances(
                 robot, plan.controllers.source, sections_with_tolerances(plan.controllers)),
             .urdf = plan.urdf_text});
  articula::View view(remote, {.address = plan.address,
                               .port = plan.port,
                               .operates = !plan.is_read_only,
                               .token = plan.token,
                               .page_folder = plan.page_folder,
                               .mesh_folders = plan.mesh_folders});
  const std::shared_ptr<void> attached = plan.attach ? plan.attach(remote) : nullptr;
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

/// Runs a simulation or, of drives that close a loop of their own, a mock, which needs no masses.
template <Drives D, int N, int Bodies>
LoopEnd run_drives(const LoopPlan& plan) {
  const double period = plan.controllers.period;
  if constexpr (D != Drives::efforts) {
    if (plan.is_mock) {
      using R = articula::KinematicModel<N, Bodies>;
      using Mock = articula::MockHardware<R, typename Family<R, D>::Command>;
      const R robot = articula::load_kinematic_urdf<N, Bodies>(plan.robot);
      return run_with<D>(plan, robot, Mock(robot, {}, period));
    }
  }
  using R = articula::Model<N, Bodies>;
  const R robot = articula::load_urdf<N, Bodies>(plan.robot);
  return run_with<D>(
      plan, robot,
      articula::Simulator<R>(robot, {.period = period, .substeps = plan.controllers.substeps}));
}

template <int N, int Bodies>
LoopEnd run_loop(const LoopPlan& plan) {
  switch (plan.controllers.drives) {
    case Drives::efforts:
      return run_drives<Drives::efforts, N, Bodies>(plan);
    case Drives::velocities:
      return run_drives<Drives::velocities, N, Bodies>(plan);
    case Drives::positions:
      break;
  }
  return run_drives<Drives::positions, N, Bodies>(plan);
}

}  // namespace terminal
