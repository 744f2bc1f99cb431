// SPDX-License-Identifier: Apache-2.0
/// @file Runs of a sweep at once: a simulator in lanes, and a control loop of its own for each run.
#pragma once

#include "articula/core/controller.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/hardware.hpp"
#include "articula/core/scalar.hpp"
#include "articula/lanes/lane_simulator.hpp"
#include "articula/loop/control_loop.hpp"
#include "articula/loop/loop_parts.hpp"
#include "articula/sweep/delayed_commands.hpp"
#include "articula/sweep/run_watch.hpp"
#include "articula/sweep/varied_loop.hpp"
#include "articula/symbolic/pack.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <map>
#include <span>
#include <type_traits>
#include <vector>

namespace articula::detail {

/// True if the runs of a robot under a controller can be simulated in lanes: the robot is known at
/// compile time, and its drives take efforts.
template <class R, class C>
inline constexpr bool can_run_in_lanes = false;
template <DescribedRobot R, class C>
inline constexpr bool can_run_in_lanes<R, C> =
    std::same_as<typename CheckedController<C, articula::joint_count<R>, double>::Command,
                 EffortCommand<articula::joint_count<R>>>;

/// What all lanes have measured, and their commands.
template <int N, class S>
struct LaneExchange {
  JointState<N, S> measured{};
  EffortCommand<N, S> command{};
};

/// One lane as the hardware of a loop. The simulator moves when all loops have written.
template <DescribedRobot R, class S = symbolic::Pack<>>
class LanePort {
 public:
  using RobotType = VariedRobot<R>;
  static constexpr int joint_count = articula::joint_count<R>;
  using Exchange = LaneExchange<joint_count, S>;

  /// The arguments must outlive the port.
  LanePort(const VariedRobot<R>& robot, double period, Exchange& exchange, int lane) noexcept
      : robot_(&robot), period_(period), exchange_(&exchange), lane_(lane) {}

  [[nodiscard]] Status activate() noexcept { return Status::ok; }
  [[nodiscard]] Status deactivate() noexcept { return Status::ok; }
  /// Real-time: yes.
  [[nodiscard]] Status read(JointState<joint_count>& state) noexcept {
    state = lane_of(exchange_->measured, lane_);
    return is_finite(state) ? Status::ok : Status::non_finite_state;
  }
  /// Real-time: yes.
  [[nodiscard]] Status write(const EffortCommand<joint_count>& command) noexcept {
    const bool finite = is_finite(command);
    set_lane(exchange_->command.effort, lane_,
             finite ? command.effort : JointVector<joint_count>(JointVector<joint_count>::Zero()));
    return finite ? Status::ok : Status::non_finite_command;
  }
  [[nodiscard]] const VariedRobot<R>& robot() const noexcept { return *robot_; }
  [[nodiscard]] double period() const noexcept { return period_; }

 private:
  const VariedRobot<R>* robot_;
  double period_;
  Exchange* exchange_;
  int lane_;
};

/// Runs loops at once. Each gives what it gives alone; none changes a bit of another.
/// @param loops    as many as there are lanes, or fewer; their substeps are equal, each has a robot
/// @param make     makes the controller of gains
/// @return         what was watched in each
/// @throws std::invalid_argument if a loop cannot be simulated
template <DescribedRobot R, class Make>
[[nodiscard]] std::vector<RunWatch<R>> run_in_lanes(const RunPlan<R>& plan,
                                                    std::span<const VariedLoop<R>* const> loops,
                                                    const Make& make) {
  using S = symbolic::Pack<>;
  using Controller = std::remove_cvref_t<decltype(make(loops[0]->gains))>;
  constexpr int n = articula::joint_count<R>;
  using Port = DelayedCommands<LanePort<R>, EffortCommand<n>>;
  std::vector<LaneSetup<R>> setups;
  for (const VariedLoop<R>* each : loops) {
    setups.push_back({.robot = *each->robot, .simulation = each->simulation});
  }
  LaneSimulator<R, S> simulator(setups);
  LaneExchange<n, S> exchange;
  exchange.command.effort.setConstant(S(0));
  static_cast<void>(simulator.read(exchange.measured));
  std::vector<ControlLoop<Port, Controller>> arms;
  std::vector<RunWatch<R>> watches;
  arms.reserve(loops.size());
  watches.reserve(loops.size());
  for (std::size_t k = 0; k < loops.size(); ++k) {
    const VariedLoop<R>& own = *loops[k];
    const int lane = static_cast<int>(k);
    arms.emplace_back(Port(LanePort<R>(*own.robot, plan.period, exchange, lane), own.delay),
                      make(own.gains));
    watches.emplace_back(plan, lane_of(simulator.start(), lane), effort_limits(*own.robot));
  }
  const auto runs = [&](std::size_t k) { return is_true(simulator.moving(), static_cast<int>(k)); };
  const auto stop = [&](std::size_t k) {
    simulator.stop(static_cast<int>(k));
    set_lane(exchange.command.effort, static_cast<int>(k), JointVector<n>(JointVector<n>::Zero()));
  };
  for (int cycle = 0; any_of(simulator.moving()); ++cycle) {
    const double time = plan.time(cycle);
    const JointReference<n> reference = plan.signals->sample(time);
    for (std::size_t k = 0; k < arms.size(); ++k) {
      if (!runs(k)) continue;
      arms[k].reference() = reference;
      const JointState<n> truth = lane_of(simulator.true_state(), static_cast<int>(k));
      if (!watches[k].begin(cycle, truth, reference)) stop(k);
    }
    if (cycle == plan.cycles) break;
    for (std::size_t k = 0; k < arms.size(); ++k) {
      if (!runs(k)) continue;
      if (arms[k].update() == Status::ok) continue;
      watches[k].fail();
      stop(k);
    }
    if (plan.disturbances) {
      const JointVector<n> effort = plan.disturbances->sample(time).effort;
      for (std::size_t k = 0; k < arms.size(); ++k) {
        if (runs(k)) simulator.set_external_effort(static_cast<int>(k), effort);
      }
    }
    static_cast<void>(simulator.write(exchange.command));
    static_cast<void>(simulator.read(exchange.measured));
    for (std::size_t k = 0; k < arms.size(); ++k) {
      if (!runs(k) || !plan.is_last_quarter(cycle)) continue;
      watches[k].finish(cycle, lane_of(simulator.true_state(), static_cast<int>(k)));
    }
  }
  return watches;
}

/// Runs all loops that have a robot, as many at once as there are lanes. The loops of a pack have the
/// same substeps.
/// @param done  called with the index of a loop, and what was watched in it
/// @throws std::invalid_argument as above
template <DescribedRobot R, class Make, class Done>
void run_in_packs(const RunPlan<R>& plan, std::span<const VariedLoop<R>> loops, const Make& make,
                  const Done& done) {
  std::map<int, std::vector<std::size_t>> by_substeps;
  for (std::size_t k = 0; k < loops.size(); ++k) {
    if (loops[k].robot) by_substeps[loops[k].simulation.substeps].push_back(k);
  }
  constexpr std::size_t most = symbolic::Pack<>::lanes;
  for (const auto& [substeps, places] : by_substeps) {
    for (std::size_t begin = 0; begin < places.size(); begin += most) {
      const auto some = std::span(places).subspan(begin, std::min(most, places.size() - begin));
      std::vector<const VariedLoop<R>*> pack;
      for (const std::size_t place : some) pack.push_back(&loops[place]);
      const auto watches = run_in_lanes<R>(plan, pack, make);
      for (std::size_t k = 0; k < some.size(); ++k) done(some[k], watches[k]);
    }
  }
}

}  // namespace articula::detail
