// SPDX-License-Identifier: Apache-2.0
/// @file The next second of many simulated robots under one controller.
#pragma once

#include "articula/control/safety/safe_command.hpp"
#include "articula/core/controller.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/scalar.hpp"
#include "articula/dynamics/varied_robot.hpp"
#include "articula/futures/future_end.hpp"
#include "articula/futures/future_options.hpp"
#include "articula/futures/varied_model.hpp"
#include "articula/loop/command_history.hpp"
#include "articula/sim/random_draw.hpp"
#include "articula/sim/simulator.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace articula {

/// One simulated future of N joints.
template <int N>
struct Future {
  std::vector<JointVector<N>> positions{};  ///< at the times of FutureOptions::samples [rad or m]
  FutureEnd end = FutureEnd::stable;
};

/// Where futures begin.
/// @tparam Command  of the controller
template <class Command>
struct FutureStart {
  JointState<Command::joint_count> state{};
  JointReference<Command::joint_count> reference{};  ///< held for the whole horizon
  Command command{};                                 ///< the last one
  /// Followed in place of `reference`, one in each cycle; the last one is held. Empty: none.
  std::vector<JointReference<Command::joint_count>> references{};
  /// What the controller knows of its last commands. Empty: that the last one carries the load.
  std::optional<CommandHistory<Command>> history{};

  /// The reference of a cycle of the future, from 0. Real-time: yes.
  [[nodiscard]] const JointReference<Command::joint_count>& reference_at(int cycle) const noexcept {
    if (references.empty()) return reference;
    return references[std::min(static_cast<std::size_t>(cycle), references.size() - 1)];
  }
};

namespace detail {

/// Counts how often drives swing from one effort limit to the other.
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <int N, class S = double>
class LimitSwings {
 public:
  explicit LimitSwings(const JointVector<N, S>& limits) : limits_(limits) {}

  void note(const JointVector<N, S>& effort) noexcept {
    using std::abs;
    for (int j = 0; j < N; ++j) {
      const MaskOf<S> at_limit = abs(effort[j]) >= limits_[j];
      if (!any_of(at_limit)) continue;
      const S side = select(effort[j] > 0, S(1), S(-1));
      replace_where(at_limit & (sides_[j] * side < 0), swings_[j], swings_[j] + 1);
      replace_where(at_limit, sides_[j], side);
    }
  }
  /// A motion from rest to rest needs one swing.
  [[nodiscard]] MaskOf<S> many() const noexcept {
    MaskOf<S> any = mask_of<S>(false);
    for (int j = 0; j < N; ++j) any = any | (swings_[j] >= 4);
    return any;
  }

 private:
  JointVector<N, S> limits_;
  JointVector<N, S> sides_ = JointVector<N, S>::Zero();
  JointVector<N, S> swings_ = JointVector<N, S>::Zero();
};

/// Goes on always.
struct ToTheEnd {
  constexpr bool operator()() const noexcept { return true; }
};

/// The number of cycles of a future, at least 1.
[[nodiscard]] inline int cycles_of(const FutureOptions& options, double period) noexcept {
  return std::max(1, static_cast<int>(std::lround(options.horizon / period)));
}

/// Simulates one future, as long as `goes_on()`.
template <Robot SimulatedRobot, class C, class Command>
[[nodiscard]] Future<Command::joint_count> simulate_future(Simulator<SimulatedRobot> simulator,
                                                           C controller,
                                                           const FutureStart<Command>& start,
                                                           const FutureOptions& options,
                                                           std::uint64_t key, const auto& goes_on) {
  constexpr int n = Command::joint_count;
  const FutureSpread& spread = options.spread;
  const std::uint64_t delay = random_bits(key, 0) % (static_cast<std::uint64_t>(spread.delay) + 1);
  const std::uint64_t noise = random_bits(key, 1);
  const bool is_noisy = spread.position_noise != 0 || spread.velocity_noise != 0;
  const int cycles = cycles_of(options, simulator.period()), samples = options.samples;
  const SimulatedRobot& robot = simulator.robot();
  JointVector<n> position = start.state.position;
  for (int j = 0; j < n; ++j) {  // noise may have measured it beyond a stop
    const JointLimits& limits = model_of(robot).joints[j].limits;
    position[j] = std::clamp(position[j], limits.lower, limits.upper);
  }
  simulator.set_state(position, start.state.velocity);
  CommandHistory<Command> history;
  history.start_with(start.command, start.state, Held::load);
  history.begin();
  if (start.history) history = *start.history;
  // The command of a cycle reaches the drives `delay` cycles later.
  std::vector<Command> sent(static_cast<std::size_t>(delay) + 1, start.command);
  LimitSwings<n> swings(effort_limits(robot));
  Future<n> future;
  future.positions.reserve(static_cast<std::size_t>(samples) + 1);
  future.positions.push_back(position);
  JointState<n> state;
  for (int cycle = 0, sample = 1; cycle < cycles; ++cycle) {
    if (cycle % 8 == 0 && !goes_on()) return future;
    const Status read = simulator.read(state);
    for (int j = 0; j < n && is_noisy; ++j) {
      const auto place = static_cast<std::uint64_t>(2 * (cycle * n + j));
      state.position[j] += spread.position_noise * random_noise(noise, place);
      state.velocity[j] += spread.velocity_noise * random_noise(noise, place + 1);
    }
    Outcome<Command> outcome;
    if (read == Status::ok) {
      outcome = update_controller(
          controller, history.input(state, start.reference_at(cycle), simulator.period()));
    }
    const bool controls = outcome.verdict != Verdict::failed;
    const Command command = controls ? within_effort_limits(robot, outcome.command) : Command{};
    if (!controls || !is_finite(command)) return future.end = FutureEnd::non_finite, future;
    sent[static_cast<std::size_t>(cycle) % sent.size()] = command;
    static_cast<void>(simulator.write(sent[static_cast<std::size_t>(cycle + 1) % sent.size()]));
    history.note_command(outcome, command, state);
    history.note_cycle(true, true, read, Status::ok);
    if (4 * cycle >= 3 * cycles) swings.note(simulator.true_state().effort);
    // Samples are at equal distances, the last one at the end.
    while (sample <= samples &&
           (cycle + 1LL) * samples >= static_cast<long long>(sample) * cycles) {
      future.positions.push_back(simulator.true_state().position);
      ++sample;
    }
  }
  if (!is_finite(simulator.true_state().position)) future.end = FutureEnd::non_finite;
  if (future.end == FutureEnd::stable && swings.many()) future.end = FutureEnd::unstable;
  return future;
}

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
/// Real-time: no (allocates).
template <DynamicRobot R, class C, class Command, class GoesOn = detail::ToTheEnd>
[[nodiscard]] Future<Command::joint_count> future_of(const R& robot, const C& controller,
                                                     const FutureStart<Command>& start,
                                                     SimulatorOptions<joint_count<R>> simulation,
                                                     const FutureOptions& options,
                                                     std::uint64_t number,
                                                     const GoesOn& goes_on = {}) {
  const std::uint64_t key = detail::random_bits(options.seed, number);
  simulation.initial_position.reset();
  simulation.initial_velocity.setZero();
  simulation.encoder_resolution.setZero();
  simulation.position_noise.setZero();
  simulation.velocity_noise.setZero();
  simulation.effort_noise.setZero();
  if (options.spread.mass == 0 && options.spread.friction == 0) {
    return detail::simulate_future(Simulator<R>(robot, simulation), controller, start, options, key,
                                   goes_on);
  }
  const auto model = varied_model(robot, options.spread, detail::random_bits(key, 2));
  if constexpr (DescribedRobot<R>) {
    if (const auto varied = detail::robot_of_kind<R>(model)) {
      return detail::simulate_future(Simulator<VariedRobot<R>>(*varied, simulation), controller,
                                     start, options, key, goes_on);
    }
  }
  using Varied = std::remove_cvref_t<decltype(model)>;
  return detail::simulate_future(Simulator<Varied>(model, simulation), controller, start, options,
                                 key, goes_on);
}

/// Simulates all futures of the options: those of the numbers 0 .. count - 1. Parameters as above.
/// Where `goes_on()` returns false, and then always, the result has the futures that are complete.
/// @throws std::invalid_argument if an option is out of its range, or the start is not finite
/// Real-time: no (allocates, throws).
template <DynamicRobot R, class C, class Command, class GoesOn = detail::ToTheEnd>
[[nodiscard]] std::vector<Future<Command::joint_count>> futures(
    const R& robot, const C& controller, const FutureStart<Command>& start,
    const SimulatorOptions<joint_count<R>>& simulation, const FutureOptions& options = {},
    const GoesOn& goes_on = {}) {
  validate(options, simulation.period);
  const auto finite = [](const auto& reference) { return is_finite(reference); };
  if (!is_finite(start.state) || !is_finite(start.reference) || !is_finite(start.command) ||
      !std::all_of(start.references.begin(), start.references.end(), finite)) {
    detail::refuse({"futures: the present state, reference or command is not finite"});
  }
  std::vector<Future<Command::joint_count>> all;
  all.reserve(static_cast<std::size_t>(options.count));
  for (int k = 0; k < options.count; ++k) {
    auto future = future_of(robot, controller, start, simulation, options,
                            static_cast<std::uint64_t>(k), goes_on);
    if (!goes_on()) break;
    all.push_back(std::move(future));
  }
  return all;
}

}  // namespace articula
