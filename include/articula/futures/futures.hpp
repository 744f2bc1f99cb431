// SPDX-License-Identifier: Apache-2.0
/// @file The next second of many simulated robots under one controller.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/dynamics/varied_robot.hpp"
#include "articula/futures/future.hpp"
#include "articula/futures/future_options.hpp"
#include "articula/futures/future_run.hpp"
#include "articula/futures/futures_in_lanes.hpp"
#include "articula/futures/varied_model.hpp"
#include "articula/sim/random_draw.hpp"
#include "articula/sim/simulator.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace articula {

namespace detail {

/// Goes on always.
struct ToTheEnd {
  constexpr bool operator()() const noexcept { return true; }
};

/// Simulates futures, of which as many as there are lanes at once. Parameters and exceptions are
/// those of `future_of`; all parameters outlive it.
template <DynamicRobot R, class C, class Command, class GoesOn>
class FutureSimulation {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Run = FutureRun<R, C, Command>;
  using Some = std::vector<Future<joint_count>>;

  /// How many futures are simulated at once.
  static constexpr int most_at_once = [] {
    if constexpr (has_futures_in_lanes<R, Command>) return LaneSimulator<R>::lane_count;
    return 1;
  }();

  FutureSimulation(const R& robot, const C& controller, const FutureStart<Command>& start,
                   const SimulatorOptions<joint_count>& simulation, const FutureOptions& options,
                   const GoesOn& goes_on)
      : robot_(robot),
        controller_(controller),
        start_(start),
        simulation_(simulation),
        options_(options),
        goes_on_(goes_on) {
    validate(options, simulation.period);
    const auto finite = [](const auto& reference) { return is_finite(reference); };
    if (!is_finite(start.state) || !is_finite(start.reference) || !is_finite(start.command) ||
        !std::all_of(start.references.begin(), start.references.end(), finite)) {
      refuse({"futures: the present state, reference or command is not finite"});
    }
    simulation_.initial_position = future_position(robot, start.state.position);
    simulation_.initial_velocity = start.state.velocity;
    simulation_.encoder_resolution.setZero();
    simulation_.position_noise.setConstant(options.spread.position_noise);
    simulation_.velocity_noise.setConstant(options.spread.velocity_noise);
    simulation_.effort_noise.setZero();
  }

  /// The futures with the numbers first .. first + count - 1, where count is at most most_at_once.
  [[nodiscard]] Some some(std::uint64_t first, int count) const {
    Some all(static_cast<std::size_t>(count));
    std::vector<bool> is_done(all.size());
    const bool are_alike = options_.spread.mass == 0 && options_.spread.friction == 0;
    if constexpr (has_futures_in_lanes<R, Command>) {
      if (!are_alike) simulate_together(first, all, is_done);
    }
    for (std::size_t k = 0; k < all.size(); ++k) {
      const std::uint64_t key = key_of(first + k);
      if (!is_done[k]) all[k] = are_alike ? alone(robot_, key) : alone(model_of_future(key), key);
    }
    return all;
  }

 private:
  [[nodiscard]] std::uint64_t key_of(std::uint64_t number) const {
    return random_bits(options_.seed, number);
  }
  [[nodiscard]] auto model_of_future(std::uint64_t key) const {
    return varied_model(robot_, options_.spread, random_bits(key, 2));
  }
  template <class SimulatedRobot>
  [[nodiscard]] SimulatorOptions<joint_count> simulation_of(const SimulatedRobot& robot,
                                                            std::uint64_t key) const {
    SimulatorOptions<joint_count> own = simulation_;
    own.seed = random_bits(key, 1);
    shorten_steps(robot, own);
    return own;
  }
  [[nodiscard]] Run run_of(std::uint64_t key) const {
    return Run(robot_, controller_, start_, options_, simulation_.period, key);
  }

  /// Simulates those robots in lanes that are of R's kind and need no shorter steps. So a future
  /// does not depend on the others.
  void simulate_together(std::uint64_t first, Some& all, std::vector<bool>& is_done) const {
    std::vector<std::size_t> indices;
    std::vector<LaneSetup<R>> setups;
    std::vector<Run> runs;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const std::uint64_t key = key_of(first + k);
      const auto model = model_of_future(key);
      const auto robot = robot_of_kind<R>(model);
      const auto simulation = simulation_of(model, key);
      if (!robot || simulation.substeps != simulation_.substeps) continue;
      indices.push_back(k);
      setups.push_back({*robot, simulation});
      runs.push_back(run_of(key));
    }
    if (indices.empty()) return;
    Some together = simulate_in_lanes<R, Run>(setups, runs, goes_on_);
    for (std::size_t k = 0; k < indices.size(); ++k) {
      all[indices[k]] = std::move(together[k]);
      is_done[indices[k]] = true;
    }
  }

  /// The future of one robot.
  template <class SimulatedRobot>
  [[nodiscard]] Future<joint_count> alone(const SimulatedRobot& robot, std::uint64_t key) const {
    Run run = run_of(key);
    Simulator<SimulatedRobot> simulator(robot, simulation_of(robot, key));
    JointState<joint_count> state;
    for (int cycle = 0; cycle < run.cycles(); ++cycle) {
      if (cycle % 8 == 0 && !goes_on_()) break;
      const Status read = simulator.read(state);
      const auto command = run.update(state, read);
      if (!command) break;
      static_cast<void>(simulator.write(*command));
      run.note(simulator.true_state());
    }
    return run.end(simulator.true_state());
  }

  const R& robot_;
  const C& controller_;
  const FutureStart<Command>& start_;
  SimulatorOptions<joint_count> simulation_;
  const FutureOptions& options_;
  const GoesOn& goes_on_;
};

}  // namespace detail

/// Simulates one robot of a spread under a controller:
///
///     PidPlusGravity<Q2d> proposed = controller;  // a copy, with other gains
///     const auto future = future_of(Q2d(), proposed, start, simulator_options, options, 7);
///
/// Without a spread, it is what the loop will do with this reference, to the last bit.
/// @param robot       as described
/// @param controller  goes on with the memory that it has; the copy is the future's own
/// @param start       where the future begins, finite
/// @param simulation  period, steps and drives; its start and sensors are not used
/// @param options     the spread and the times; see `validate`
/// @param number      of the future. The result depends on nothing else, so futures may be computed
///                    in any order and in several threads.
/// @param goes_on     asked every few cycles. The future ends early where it returns false.
/// @throws std::invalid_argument if an option is out of its range, the start is not finite, or the
///         robot of this number cannot be simulated
/// Real-time: no (allocates, throws).
template <DynamicRobot R, class C, class Command, class GoesOn = detail::ToTheEnd>
[[nodiscard]] Future<Command::joint_count> future_of(
    const R& robot, const C& controller, const FutureStart<Command>& start,
    const SimulatorOptions<joint_count<R>>& simulation, const FutureOptions& options,
    std::uint64_t number, const GoesOn& goes_on = {}) {
  const detail::FutureSimulation all(robot, controller, start, simulation, options, goes_on);
  return std::move(all.some(number, 1).front());
}

/// Simulates all futures of the options: those of the numbers 0 .. count - 1. Parameters as above.
/// Where `goes_on()` returns false, and then always, the result has the futures that are complete.
/// @throws std::invalid_argument as future_of
/// Real-time: no (allocates, throws).
template <DynamicRobot R, class C, class Command, class GoesOn = detail::ToTheEnd>
[[nodiscard]] std::vector<Future<Command::joint_count>> futures(
    const R& robot, const C& controller, const FutureStart<Command>& start,
    const SimulatorOptions<joint_count<R>>& simulation, const FutureOptions& options = {},
    const GoesOn& goes_on = {}) {
  const detail::FutureSimulation simulated(robot, controller, start, simulation, options, goes_on);
  std::vector<Future<Command::joint_count>> all;
  all.reserve(static_cast<std::size_t>(options.count));
  while (static_cast<int>(all.size()) < options.count) {
    const int left = options.count - static_cast<int>(all.size());
    auto some = simulated.some(all.size(), std::min(left, simulated.most_at_once));
    if (!goes_on()) break;
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace articula
