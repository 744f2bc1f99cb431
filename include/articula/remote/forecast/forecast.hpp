// SPDX-License-Identifier: Apache-2.0
/// @file The futures of a loop with other gains, computed beside it.
#pragma once

#include "articula/control/switching/switch_board.hpp"
#include "articula/core/hardware.hpp"
#include "articula/futures/futures.hpp"
#include "articula/loop/command_history.hpp"
#include "articula/recording/cycle_record.hpp"
#include "articula/remote/engine/loop_traits.hpp"
#include "articula/remote/forecast/future_start.hpp"
#include "articula/remote/forecast/futures_question.hpp"
#include "articula/remote/forecast/joint_margins.hpp"
#include "articula/remote/gains/gain_parameters.hpp"

#include <algorithm>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace articula::remote {

/// Whether the futures of a loop can be simulated.
template <class LoopType, class R = typename LoopType::RobotType>
inline constexpr bool has_futures = false;
template <class LoopType, DynamicRobot R>
inline constexpr bool has_futures<LoopType, R> =
    std::copy_constructible<typename LoopType::ControllerType> &&
    Hardware<Simulator<R>, typename LoopType::Command>;

/// Answers questions for the futures of a loop, with a copy of its controller made at construction.
/// It does not touch the loop after that, so any thread may ask, and several at a time.
/// @tparam LoopType  a ControlLoop or SupervisedControlLoop
template <class LoopType>
class Forecast {
 public:
  using R = typename LoopType::RobotType;
  using ControllerType = typename LoopType::ControllerType;
  using Command = typename LoopType::Command;
  using Record = CycleRecordOf<LoopType>;
  static constexpr int joint_count = LoopType::joint_count;

  /// Before the loop runs.
  explicit Forecast(LoopType& loop)
      : robot_(std::as_const(loop).hardware().robot()), controller_(copy_of(loop)) {
    if constexpr (requires { loop.hardware().options().substeps; }) {
      simulation_ = loop.hardware().options();
    }
    simulation_.period = loop.period();
  }

  /// Simulates. The controller starts with the load that the last command carries.
  /// @param now       the last cycle of the loop; used if the question has no start
  /// @param gains     all gains of the loop
  /// @param controllers  all controllers of the loop
  /// @param question  for what
  /// @throws std::invalid_argument if a gain or an option is not valid, or this loop has no
  ///         futures; the message has the reason
  /// Real-time: no (allocates, throws).
  [[nodiscard]] FuturesAnswer answer(
      [[maybe_unused]] const Record& now, [[maybe_unused]] const std::vector<Parameter>& gains,
      [[maybe_unused]] const std::vector<ControllerInfo>& controllers,
      [[maybe_unused]] const FuturesQuestion& question) const {
    if constexpr (!has_futures<LoopType>) {
      articula::detail::refuse(
          {"futures: they need a controller that can be copied, and a robot with masses whose "
           "simulator takes its commands"});
    } else {
      const FutureOptions& options = question.options;
      validate(options, simulation_.period);
      const double cycles = options.count * options.horizon / simulation_.period;
      if (cycles > FuturesQuestion::most_cycles) {
        articula::detail::refuse(
            {"futures: ", cycles, " cycles in all are more than ", FuturesQuestion::most_cycles});
      }
      const long long positions = (options.samples + 1LL) * options.count * joint_count;
      if (positions > FuturesQuestion::most_positions) {
        articula::detail::refuse({"futures: ", positions, " positions in the answer are more than ",
                                  FuturesQuestion::most_positions});
      }
      FutureStart<Command> start = future_start(robot_, now, question, simulation_.period);
      ControllerType controller = controller_;
      set_gains(controller, gains);
      activate(controller, controllers);
      if (question.start) {
        start.history = relive<Command>(controller, question.history, simulation_.period);
      } else {
        CommandHistory<Command> history;
        history.start_with(start.command, start.state, Held::load);
        const auto input = history.input(start.state, start.reference_at(0), simulation_.period);
        start_controller(controller, input);  // a Switch makes them active
        start_controller(controller, input);  // and starts them as those that were active before
      }
      set_gains(controller, question.gains);  // as a running loop gets them
      FuturesAnswer answer{.time = question.start ? question.start->time : now.time,
                           .horizon = options.horizon,
                           .samples = options.samples};
      const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                          std::chrono::duration<double>(question.most_time));
      const auto goes_on = [&] {
        return !(question.stop && question.stop->requested()) && Clock::now() < end;
      };
      for (const auto& own : futures(robot_, controller, start, simulation_, options, goes_on)) {
        answer.futures.push_back(in_columns(own));
      }
      if (answer.futures.empty()) {
        articula::detail::refuse({"futures: none is complete within ", question.most_time,
                                  " s; ask for a shorter horizon"});
      }
      if constexpr (requires { start.command.effort; }) {
        answer.margins = margins_of(robot_, controller, start.state.position, simulation_.period);
      }
      return answer;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Nothing {};

  [[nodiscard]] static auto copy_of([[maybe_unused]] const LoopType& loop) {
    if constexpr (has_futures<LoopType>) {
      return ControllerType(loop.controller());
    } else {
      return Nothing{};
    }
  }

  template <class Gains>
  void set_gains(ControllerType& controller, const Gains& gains) const {
    if (gains.empty()) return;
    std::vector<ParameterValue> values;
    for (const auto& gain : gains) values.push_back({gain.name, gain.value});
    const GainParameters<R> parameters(robot_, controller);
    typename GainParameters<R>::Changes changes;
    for (const auto& change : parameters.change(values, changes)) change->apply();
  }

  /// Requests the controllers that are active in the loop.
  static void activate([[maybe_unused]] ControllerType& controller,
                       [[maybe_unused]] const std::vector<ControllerInfo>& controllers) {
    if constexpr (articula::detail::switch_size<ControllerType> > 0) {
      const auto is_active = [](const auto& list, const Name& name) {
        return std::any_of(list.begin(), list.end(), [&](const ControllerInfo& info) {
          return info.name == name && info.status == ControllerStatus::active;
        });
      };
      auto& own = switch_in(controller);
      std::vector<Name> start, stop;
      const auto before = own.list();
      for (const ControllerInfo& info : before) {
        const bool was = is_active(before, info.name), is = is_active(controllers, info.name);
        if (was && !is) stop.push_back(info.name);
        if (is && !was) start.push_back(info.name);
      }
      static_cast<void>(own.request({.stop = ControllerNames(std::span<const Name>(stop)),
                                     .start = ControllerNames(std::span<const Name>(start)),
                                     .strictness = Strictness::best_effort}));
    }
  }

  [[nodiscard]] static FutureTrajectory in_columns(const Future<joint_count>& future) {
    FutureTrajectory trajectory{.end = future.end};
    for (int j = 0; j < joint_count; ++j) {
      auto& column = trajectory.positions.emplace_back();
      for (const auto& position : future.positions) column.push_back(position[j]);
    }
    return trajectory;
  }

  R robot_;
  decltype(copy_of(std::declval<const LoopType&>())) controller_;
  SimulatorOptions<joint_count> simulation_{};
};

}  // namespace articula::remote
