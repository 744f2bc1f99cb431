// SPDX-License-Identifier: Apache-2.0
/// @file The futures of a loop with other gains, computed beside it.
#pragma once

#include "articula/control/laws/part_scope.hpp"
#include "articula/control/laws/sampled_feedback.hpp"
#include "articula/control/switching/switch_board.hpp"
#include "articula/core/hardware.hpp"
#include "articula/futures/futures.hpp"
#include "articula/loop/command_history.hpp"
#include "articula/recording/cycle_record.hpp"
#include "articula/remote/engine/loop_traits.hpp"
#include "articula/remote/futures_question.hpp"
#include "articula/remote/gains/gain_parameters.hpp"
#include "articula/tuning/stability_margins.hpp"

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

  /// Simulates. The reference stays where it is now, with velocity 0, and the controller starts with
  /// the load that its last command carries.
  /// @param now       the last cycle of the loop
  /// @param gains     all gains of the loop
  /// @param controllers  all controllers of the loop
  /// @param question  for what
  /// @throws std::invalid_argument if a gain or an option is not valid, or this loop has no futures;
  ///         the message has the reason
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
      ControllerType controller = with_gains(gains, question.gains);
      FutureStart<Command> start{now.state, {}, now.command};
      start.reference.position = now.reference.position;
      start.reference.effort = now.reference.effort;
      CommandHistory<Command> history;
      history.start_with(start.command, start.state, Held::load);
      const auto input = history.input(start.state, start.reference, simulation_.period);
      activate(controller, controllers);
      start_controller(controller, input);  // a Switch makes them active
      start_controller(controller, input);  // and starts them here as those that were active before
      FuturesAnswer answer{
          .time = now.time, .horizon = options.horizon, .samples = options.samples};
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
        add_margins(controller, {}, own_name<ControllerType>(0), start.state.position,
                    answer.margins);
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

  [[nodiscard]] ControllerType with_gains(const std::vector<Parameter>& gains,
                                          const std::vector<ParameterValue>& others) const {
    ControllerType controller = controller_;
    std::vector<ParameterValue> values;
    for (const Parameter& gain : gains) values.push_back({gain.name, gain.value});
    values.insert(values.end(), others.begin(), others.end());
    if (values.empty()) return controller;
    const GainParameters<R> parameters(robot_, controller);
    typename GainParameters<R>::Changes changes;
    for (const auto& change : parameters.change(values, changes)) change->apply();
    return controller;
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

  template <class Part>
  [[nodiscard]] static std::string own_name(std::size_t place) {
    return std::string(articula::detail::own_name<Part>(place).view());
  }

  [[nodiscard]] static FutureTrajectory in_columns(const Future<joint_count>& future) {
    FutureTrajectory trajectory{.end = future.end};
    for (int j = 0; j < joint_count; ++j) {
      auto& column = trajectory.positions.emplace_back();
      for (const auto& position : future.positions) column.push_back(position[j]);
    }
    return trajectory;
  }

  /// Adds the margins of a part of a controller, and of the parts that it consists of.
  template <class Part>
  void add_margins(const Part& part, const PartScope<joint_count>& scope,
                   const std::string& controller, const JointVector<joint_count>& q,
                   std::vector<JointMargins>& margins) const {
    if constexpr (requires { part.sampled_feedback(std::size_t{}); }) {
      for (int j = 0; j < joint_count; ++j) {
        const SampledFeedback law = part.sampled_feedback(static_cast<std::size_t>(j));
        if (scope.joints[j] == 0 || law.of_velocity) continue;
        try {
          const JointPlant plant =
              scope.asks_acceleration ? JointPlant{} : joint_plant(robot_, q, j, OtherJoints::free);
          const StabilityMargins own =
              stability_margins(plant,
                                {.proportional = law.proportional,
                                 .integral = law.integral,
                                 .derivative = law.derivative,
                                 .derivative_filter_time = law.filter_time},
                                scope.divisor * simulation_.period / 2);
          margins.push_back({controller, std::string(model_of(robot_).joints[j].name.view()),
                             own.stable, own.gain_margin, own.phase_margin, own.delay_margin});
        } catch (const std::invalid_argument&) {
          continue;  // gains that are all 0 make no loop
        }
      }
    } else if constexpr (requires { part.for_each_part([](const auto&...) {}); }) {
      std::size_t place = 0;
      part.for_each_part([&](const auto& own, const PartScope<joint_count>& inner = {}) {
        using Own = std::remove_cvref_t<decltype(own)>;
        const std::size_t number = place++;
        std::string name = controller;
        if constexpr (requires { part.name_of(number); }) {
          if (part.list()[number].status != ControllerStatus::active) return;
          name = part.name_of(number).view();
        } else if constexpr (requires { Part::group_count; }) {
          name = own_name<Own>(number);
        }
        this->add_margins(own, scope.of(inner), name, q, margins);
      });
    }
  }

  R robot_;
  decltype(copy_of(std::declval<const LoopType&>())) controller_;
  SimulatorOptions<joint_count> simulation_{};
};

}  // namespace articula::remote
