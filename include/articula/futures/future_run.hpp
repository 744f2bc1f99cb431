// SPDX-License-Identifier: Apache-2.0
/// @file A future while it is simulated.
#pragma once

#include "articula/control/safety/safe_command.hpp"
#include "articula/core/controller.hpp"
#include "articula/core/finite.hpp"
#include "articula/futures/future.hpp"
#include "articula/futures/future_options.hpp"
#include "articula/futures/limit_swings.hpp"
#include "articula/model/robot.hpp"
#include "articula/sim/random_draw.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace articula::detail {

/// The number of cycles of a future, at least 1.
[[nodiscard]] inline int cycles_of(const FutureOptions& options, double period) noexcept {
  return std::max(1, static_cast<int>(std::lround(options.horizon / period)));
}

/// Where the joints of a future start: noise may have measured them beyond a stop.
template <Robot R>
[[nodiscard]] JointVector<joint_count<R>> future_position(
    const R& robot, JointVector<joint_count<R>> position) noexcept {
  for (int j = 0; j < joint_count<R>; ++j) {
    const JointLimits& limits = model_of(robot).joints[j].limits;
    position[j] = std::clamp(position[j], limits.lower, limits.upper);
  }
  return position;
}

/// All of a future but its robot: controller, delay of the commands, and samples. Its
/// robot is simulated alone or in a lane:
///
///     for (int cycle = 0; cycle < run.cycles(); ++cycle) {
///       const auto command = run.update(state, read);  // measured
///       if (!command) break;
///       simulator.write(*command);
///       run.note(simulator.true_state());
///     }
///     Future<2> future = run.end(simulator.true_state());
///
/// @tparam R        the robot as described, which has the drives' limits
/// @tparam C        the controller
/// @tparam Command  of the controller
template <Robot R, class C, class Command>
class FutureRun {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using State = JointState<joint_count>;

  /// @param start    outlives the run
  /// @param options  outlive the run
  /// @param key      of this future's random numbers
  FutureRun(const R& robot, const C& controller, const FutureStart<Command>& start,
            const FutureOptions& options, double period, std::uint64_t key)
      : robot_(robot),
        controller_(controller),
        start_(start),
        options_(options),
        period_(period),
        cycles_(cycles_of(options, period)),
        swings_(effort_limits(robot)) {
    const auto delays = static_cast<std::uint64_t>(options.spread.delay) + 1;
    sent_.assign(static_cast<std::size_t>(random_bits(key, 0) % delays) + 1, start.command);
    history_.start_with(start.command, start.state, Held::load);
    history_.begin();
    if (start.history) history_ = *start.history;
    future_.positions.reserve(static_cast<std::size_t>(options.samples) + 1);
    future_.positions.push_back(future_position(robot, start.state.position));
  }

  [[nodiscard]] int cycles() const noexcept { return cycles_; }

  /// One cycle of the controller.
  /// @param state  measured
  /// @return       what reaches the drives; none if the future ends here
  [[nodiscard]] std::optional<Command> update(const State& state, Status read) noexcept {
    Outcome<Command> outcome;
    if (read == Status::ok) {
      outcome = update_controller(controller_,
                                  history_.input(state, start_.reference_at(cycle_), period_));
    }
    const bool controls = outcome.verdict != Verdict::failed;
    const Command command = controls ? within_effort_limits(robot_, outcome.command) : Command{};
    if (!controls || !is_finite(command)) {
      future_.end = SimulationEnd::non_finite;
      return std::nullopt;
    }
    // The command of a cycle reaches the drives as many cycles later as the delay has.
    sent_[static_cast<std::size_t>(cycle_) % sent_.size()] = command;
    history_.note_command(outcome, command, state);
    history_.note_cycle(true, true, read, Status::ok);
    return sent_[static_cast<std::size_t>(cycle_ + 1) % sent_.size()];
  }

  /// Notes the true state at the end of the cycle.
  void note(const State& truth) {
    if (4 * cycle_ >= 3 * cycles_) swings_.note(truth.effort);
    ++cycle_;
    // Samples are at equal distances, the last one at the end.
    const long long samples = options_.samples;
    for (; sample_ <= samples && cycle_ * samples >= sample_ * cycles_; ++sample_) {
      future_.positions.push_back(truth.position);
    }
  }

  /// The future, whose last true state this is.
  [[nodiscard]] Future<joint_count> end(const State& truth) {
    if (!is_finite(truth.position)) future_.end = SimulationEnd::non_finite;
    if (future_.end == SimulationEnd::stable && swings_.many())
      future_.end = SimulationEnd::unstable;
    return std::move(future_);
  }

 private:
  [[no_unique_address]] R robot_;
  C controller_;
  const FutureStart<Command>& start_;
  const FutureOptions& options_;
  double period_;
  int cycles_;
  std::vector<Command> sent_{};
  CommandHistory<Command> history_{};
  LimitSwings<joint_count> swings_;
  Future<joint_count> future_{};
  int cycle_ = 0;
  long long sample_ = 1;
};

}  // namespace articula::detail
