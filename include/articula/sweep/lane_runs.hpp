// SPDX-License-Identifier: Apache-2.0
/// @file Runs of a sweep at once, in the lanes of a pack.
#pragma once

#include "articula/control/laws/pid_gains_lanes.hpp"
#include "articula/core/controller.hpp"
#include "articula/core/controller_check.hpp"
#include "articula/core/scalar.hpp"
#include "articula/lanes/lane_loop.hpp"
#include "articula/lanes/lane_pack.hpp"
#include "articula/sweep/lane_loops.hpp"
#include "articula/sweep/loop_refused.hpp"
#include "articula/sweep/run_watch.hpp"
#include "articula/sweep/variation/varied_loop.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <map>
#include <span>
#include <type_traits>
#include <vector>

namespace articula::detail {

/// True if the runs of a robot under a controller can be simulated in lanes. The robot must be
/// known at compile time, and its drives must take efforts.
template <class R, class C>
inline constexpr bool can_run_in_lanes = false;
template <DescribedRobot R, class C>
inline constexpr bool can_run_in_lanes<R, C> =
    std::same_as<typename CheckedController<C, articula::joint_count<R>, double>::Command,
                 EffortCommand<articula::joint_count<R>>>;

/// True if a factory also makes one controller of efforts for all lanes, which cannot fail, of
/// gains that differ from lane to lane.
template <class Make, int N, class S>
concept MakesLaneController =
    requires(const Make& make, const JointPidGains<N, S>& gains,
             std::remove_cvref_t<decltype(make(gains))>& made, const ControlInput<N, S>& input) {
      { called(made, input) } -> std::same_as<EffortCommand<N, S>>;
    };

/// Robots in lanes under one controller.
template <DescribedRobot R, class Make, class S>
class LanesOfOneLoop {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Gains = JointPidGains<joint_count, S>;
  using Controller = std::remove_cvref_t<std::invoke_result_t<const Make&, const Gains&>>;
  using Loops = std::span<const VariedLoop<R>* const>;

  LanesOfOneLoop(const Loops& loops, const Make& make, double)
      : loop_(setups_of<R>(loops), make(gains_of(loops))) {}

  void set_reference(const JointReference<joint_count>& reference) noexcept {
    loop_.reference() = {in_all_lanes<S>(reference.position), in_all_lanes<S>(reference.velocity),
                         in_all_lanes<S>(reference.acceleration),
                         in_all_lanes<S>(reference.effort)};
  }
  /// One cycle of the lanes that move. A lane with a number that is not finite stops.
  void update() noexcept { loop_.update(); }
  [[nodiscard]] LaneSimulator<R, S>& simulator() noexcept { return loop_.simulator(); }

 private:
  [[nodiscard]] static Gains gains_of(const Loops& loops) {
    Gains gains = in_all_lanes<S>(loops[0]->gains);
    for (std::size_t k = 1; k < loops.size(); ++k) {
      set_lane(gains, static_cast<int>(k), loops[k]->gains);
    }
    return gains;
  }

  LaneControlLoop<R, Controller, S> loop_;
};

/// Runs loops at once. Each gives what it gives alone; none changes a bit of another.
/// @param loops    as many as there are lanes, or fewer; their substeps are equal, each has a robot
/// @param make     makes the controller of gains
/// @return         what was watched, the runs in the order of the loops
/// @throws LoopRefused if a loop cannot be simulated
template <DescribedRobot R, class Make, class S = LanePack<R>>
[[nodiscard]] RunWatch<R, S> run_in_lanes(const RunPlan<R>& plan,
                                          std::span<const VariedLoop<R>* const> loops,
                                          const Make& make) {
  constexpr int n = articula::joint_count<R>;
  using Arms = std::conditional_t<MakesLaneController<Make, n, S>, LanesOfOneLoop<R, Make, S>,
                                  LanesOfOwnLoops<R, Make, S>>;
  Arms arms = set_up([&] { return Arms(loops, make, plan.period); });
  LaneSimulator<R, S>& simulator = arms.simulator();
  RunWatch<R, S> watch(plan, simulator.start(), simulator.effort_limits());
  JointReference<n> reference;
  for (int cycle = 0; any_of(simulator.moving()); ++cycle) {
    const double time = plan.time(cycle);
    if (cycle == 0 || plan.has_signals) {
      reference = plan.signals->sample(time);
      arms.set_reference(reference);
    }
    const MaskOf<S> moves = simulator.moving(),
                    lost = moves &
                           not_of(watch.begin(cycle, simulator.true_state(), reference, moves));
    if (any_of(lost)) simulator.stop(lost);
    if (cycle == plan.cycles) break;
    if (plan.disturbances) {
      simulator.set_external_effort(in_all_lanes<S>(plan.disturbances->sample(time).effort));
    }
    const MaskOf<S> before = simulator.moving();
    arms.update();
    watch.fail(before & not_of(simulator.moving()));
    watch.finish(cycle, simulator.true_state());
  }
  return watch;
}

/// Runs loops at once, as run_in_lanes. If one of them cannot be simulated, they run one by one.
/// @param places   of the loops, as many as there are lanes, or fewer
/// @param done     called with the place of a loop, what was watched, and the lane
/// @param refused  called with the place of a loop that cannot be simulated
template <DescribedRobot R, class Make, class Done, class Refused>
void run_pack(const RunPlan<R>& plan, std::span<const VariedLoop<R>> loops,
              std::span<const std::size_t> places, const Make& make, const Done& done,
              const Refused& refused) {
  std::vector<const VariedLoop<R>*> pack;
  for (const std::size_t place : places) pack.push_back(&loops[place]);
  try {
    const auto watch = run_in_lanes<R>(plan, pack, make);
    for (std::size_t k = 0; k < places.size(); ++k) done(places[k], watch, static_cast<int>(k));
  } catch (const LoopRefused&) {
    if (places.size() == 1) return refused(places[0]);
    for (std::size_t k = 0; k < places.size(); ++k) {
      run_pack(plan, loops, places.subspan(k, 1), make, done, refused);
    }
  }
}

/// Runs all loops that have a robot, as many at once as there are lanes. The loops of a pack have
/// the same substeps. `done` and `refused` are those of run_pack.
template <DescribedRobot R, class Make, class Done, class Refused>
void run_in_packs(const RunPlan<R>& plan, std::span<const VariedLoop<R>> loops, const Make& make,
                  const Done& done, const Refused& refused) {
  std::map<int, std::vector<std::size_t>> by_substeps;
  for (std::size_t k = 0; k < loops.size(); ++k) {
    if (loops[k].robot) by_substeps[loops[k].simulation.substeps].push_back(k);
  }
  constexpr std::size_t most = lanes<LanePack<R>>;
  for (const auto& [substeps, places] : by_substeps) {
    for (std::size_t begin = 0; begin < places.size(); begin += most) {
      const auto some = std::span(places).subspan(begin, std::min(most, places.size() - begin));
      run_pack(plan, loops, some, make, done, refused);
    }
  }
}

}  // namespace articula::detail
