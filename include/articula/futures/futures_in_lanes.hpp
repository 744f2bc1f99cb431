// SPDX-License-Identifier: Apache-2.0
/// @file Futures of several robots at once, one in each lane of a pack.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/core/scalar.hpp"
#include "articula/futures/future_run.hpp"
#include "articula/lanes/lane_simulator.hpp"

#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

namespace articula::detail {

/// The most joints of robots whose futures are simulated in lanes. The code for lanes of a robot
/// with 47 joints takes longer to compile than a user saves (PR2: 47 s).
inline constexpr int most_joints_in_lanes = 12;

/// True if the futures of a robot are simulated in lanes. The robot must be known at compile time,
/// and its drives must take efforts.
template <class R, class Command>
inline constexpr bool has_futures_in_lanes = false;
template <DescribedRobot R, class Command>
inline constexpr bool has_futures_in_lanes<R, Command> =
    articula::joint_count<R> <= most_joints_in_lanes &&
    std::same_as<Command, EffortCommand<articula::joint_count<R>>>;

/// Simulates futures together, as long as `goes_on()`. Their robots are in lanes. Each has a
/// controller of its own, as that of a running loop need not be one over packs.
/// @param setups  of the robots, at most as many as lanes
/// @param runs    one for each setup
template <DescribedRobot R, class Run>
[[nodiscard]] std::vector<Future<joint_count<R>>> simulate_in_lanes(
    std::span<const LaneSetup<R>> setups, std::span<Run> runs, const auto& goes_on) {
  LaneSimulator<R> simulator(setups);
  typename LaneSimulator<R>::State state;
  typename LaneSimulator<R>::Command command{};
  std::vector<Future<joint_count<R>>> futures(runs.size());
  const auto end = [&](int lane) {
    const auto place = static_cast<std::size_t>(lane);
    futures[place] = runs[place].end(lane_of(simulator.true_state(), lane));
  };
  const auto for_each_moving = [&](const auto& function) {
    for (int k = 0; k < static_cast<int>(runs.size()); ++k) {
      if (is_true(simulator.moving(), k)) function(k, runs[static_cast<std::size_t>(k)]);
    }
  };
  for (int cycle = 0; cycle < runs.front().cycles() && any_of(simulator.moving()); ++cycle) {
    if (cycle % 8 == 0 && !goes_on()) break;
    static_cast<void>(simulator.read(state));
    for_each_moving([&](int lane, Run& run) {
      const JointState<joint_count<R>> own = lane_of(state, lane);
      const auto sent = run.update(own, is_finite(own) ? Status::ok : Status::non_finite_state);
      if (sent) {
        set_lane(command, lane, *sent);
      } else {
        end(lane);
        set_lane(command, lane, EffortCommand<joint_count<R>>());
        simulator.stop(lane);
      }
    });
    static_cast<void>(simulator.write(command));
    for_each_moving([&](int lane, Run& run) { run.note(lane_of(simulator.true_state(), lane)); });
  }
  for_each_moving([&](int lane, Run&) { end(lane); });
  return futures;
}

}  // namespace articula::detail
