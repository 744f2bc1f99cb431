// SPDX-License-Identifier: Apache-2.0
/// @file The beginning of a question's futures, and the reference that they follow.
#pragma once

#include "articula/command/command_parts.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/futures/futures.hpp"
#include "articula/loop/command_history.hpp"
#include "articula/model/robot.hpp"
#include "articula/recording/cycle_record.hpp"
#include "articula/reference/joint_range.hpp"
#include "articula/remote/forecast/futures_question.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::remote {

namespace detail {

/// Numbers of a question as a vector of joints.
/// @throws std::invalid_argument if there are too few, too many, or one is not finite
template <int N>
[[nodiscard]] JointVector<N> joint_vector(std::string_view what,
                                          const std::vector<double>& values) {
  if (values.size() != static_cast<std::size_t>(N)) {
    articula::detail::refuse({"futures: ", what, " has ", values.size(),
                              " numbers; expected one for each of ", N, " joints"});
  }
  const JointVector<N> vector = Eigen::Map<const JointVector<N>>(values.data());
  if (!is_finite(vector)) articula::detail::refuse({"futures: ", what, " is not finite"});
  return vector;
}

template <int N>
[[nodiscard]] JointState<N> joint_state(const std::string& what, const FuturesState& from) {
  return {.position = joint_vector<N>(what + ": position", from.position),
          .velocity = joint_vector<N>(what + ": velocity", from.velocity),
          .effort = joint_vector<N>(what + ": effort", from.effort)};
}

template <class Command>
[[nodiscard]] Command command_of(const std::vector<std::vector<double>>& from) {
  Command command;
  const auto parts = parts_of(command);
  if (from.size() != parts.size()) {
    articula::detail::refuse({"futures: history: command has ", from.size(),
                              " quantities; the loop's commands have ", parts.size()});
  }
  for (std::size_t k = 0; k < parts.size(); ++k) {
    *part_of(command, parts[k].quantity) =
        joint_vector<Command::joint_count>("history: command", from[k]);
  }
  return command;
}

template <int N>
[[nodiscard]] JointReference<N> joint_reference(const FuturesReference& from) {
  const auto or_zero = [](std::string_view what, const std::vector<double>& values) {
    return values.empty() ? JointVector<N>(JointVector<N>::Zero()) : joint_vector<N>(what, values);
  };
  return {.position = joint_vector<N>("a reference's position", from.position),
          .velocity = or_zero("a reference's velocity", from.velocity),
          .acceleration = or_zero("a reference's acceleration", from.acceleration),
          .effort = or_zero("a reference's effort", from.effort)};
}

/// The reference of each cycle up to that of the last one, which is held at rest.
template <int N>
[[nodiscard]] std::vector<JointReference<N>> references_of(const FuturesQuestion& question,
                                                           double period) {
  const double step = question.reference_step == 0 ? period : question.reference_step;
  if (!(step >= period && step <= question.options.horizon)) {
    articula::detail::refuse({"futures: reference_step ", step, " s is not within ", period, " .. ",
                              question.options.horizon, " s, from the period to the horizon"});
  }
  std::vector<JointReference<N>> points;
  for (const FuturesReference& own : question.references) {
    points.push_back(joint_reference<N>(own));
  }
  const int cycles = articula::detail::cycles_of(question.options, period);
  std::vector<JointReference<N>> references;
  for (int cycle = 0; cycle <= cycles; ++cycle) {
    const double place = cycle * (period / step);
    const auto before = static_cast<std::size_t>(place);
    if (before + 1 >= points.size()) break;
    const double share = place - static_cast<double>(before);
    const JointReference<N>&from = points[before], &to = points[before + 1];
    if (share == 0) {  // as it is, to the last bit
      references.push_back(from);
    } else {
      const auto between = [share](const JointVector<N>& a, const JointVector<N>& b) {
        return for_each_joint<N>([&](int j) noexcept { return a[j] + share * (b[j] - a[j]); });
      };
      references.push_back({.position = between(from.position, to.position),
                            .velocity = between(from.velocity, to.velocity),
                            .acceleration = between(from.acceleration, to.acceleration),
                            .effort = between(from.effort, to.effort)});
    }
  }
  references.push_back(points.back());
  references.back().velocity.setZero();
  references.back().acceleration.setZero();
  return references;
}

/// What a test step adds to the position of the reference.
/// @param lowest, highest  position of the reference of each joint without it
template <Robot R>
[[nodiscard]] JointVector<joint_count<R>> offsets_of(const R& robot,
                                                     const std::vector<FuturesStep>& steps,
                                                     const JointVector<joint_count<R>>& lowest,
                                                     const JointVector<joint_count<R>>& highest) {
  JointVector<joint_count<R>> offsets = JointVector<joint_count<R>>::Zero();
  for (const FuturesStep& step : steps) {
    const int j = joint_index(robot, step.joint);
    offsets[j] += step.height;
    const auto& limits = model_of(robot).joints[static_cast<std::size_t>(j)].limits;
    const double low = lowest[j] + offsets[j], high = highest[j] + offsets[j];
    if (!(low >= limits.lower && high <= limits.upper)) {
      articula::detail::refuse({"futures: a step of ", step.height, " takes the reference of ",
                                step.joint, " to ", low < limits.lower ? low : high,
                                ", which is not within its limits ", limits.lower, " .. ",
                                limits.upper});
    }
  }
  return offsets;
}

}  // namespace detail

/// The start of a question's futures: that of the question, or else the last cycle of the loop.
/// @param robot     whose loop is asked
/// @param now       the last cycle of the loop
/// @param question  with options that `validate` accepts
/// @param period    of the loop [s]
/// @throws std::invalid_argument naming what the question lacks or has too much of, a joint that
///         the robot has not, or a step beyond a limit
/// Real-time: no (allocates, throws).
template <Robot R, class Command>
[[nodiscard]] FutureStart<Command> future_start(const R& robot,
                                                const CycleRecord<joint_count<R>, Command>& now,
                                                const FuturesQuestion& question, double period) {
  constexpr int n = joint_count<R>;
  FutureStart<Command> start{.state = now.state, .command = now.command};
  start.reference.position = now.reference.position;
  start.reference.effort = now.reference.effort;
  if (question.start) {
    if (question.history.empty()) {
      articula::detail::refuse({"futures: a start needs a history of at least one cycle"});
    }
    start.state = detail::joint_state<n>("start", *question.start);
    start.reference = {.position = start.state.position};
    start.command = detail::command_of<Command>(question.history.back().command);
  }
  if (!question.references.empty()) start.references = detail::references_of<n>(question, period);
  if (question.steps.empty()) return start;
  const JointVector<n> first = start.reference_at(0).position;
  JointRange<n> used{first, first, JointVector<n>::Zero()};
  for (const auto& reference : start.references) used = used.extended_to(reference.position);
  const JointVector<n> offsets = detail::offsets_of(robot, question.steps, used.lower, used.upper);
  start.reference.position += offsets;
  for (auto& reference : start.references) reference.position += offsets;
  return start;
}

/// Starts a controller so that it commands at a state what was recorded there.
/// Real-time: no.
template <class Command, class C, int N>
void start_as_recorded(C& controller, const Command& command, const JointState<N>& state,
                       const JointReference<N>& reference, double period) {
  const auto start = [&](C& own, const Command& load) {
    CommandHistory<Command> past;
    past.start_with(load, state, Held::load);
    const auto input = past.input(state, reference, period);
    start_controller(own, input);  // a Switch makes the requested ones active
    start_controller(own, input);  // and starts them here as those that were active before
    return update_controller(own, input).command;
  };
  // An integral starts with the whole load, and its output adds the other terms: they go off it.
  C trial = controller;
  Command computed = start(trial, command), load = command;
  for (const auto& part : parts_of(computed)) {
    auto& own = *part_of(load, part.quantity);
    if (is_finite(*part.values)) own = 2 * own - *part.values;
  }
  static_cast<void>(start(controller, load));
}

/// Lets a controller take part in the recorded cycles before the futures begin.
/// @param controller  starts at the first of them
/// @param history     not empty
/// @param period      of the loop [s]
/// @return            what the controller then knows of its last commands
/// @throws std::invalid_argument as future_start
/// Real-time: no (allocates, throws).
template <class Command, class C>
[[nodiscard]] CommandHistory<Command> relive(C& controller,
                                             const std::vector<FuturesCycle>& history,
                                             double period) {
  constexpr int n = Command::joint_count;
  CommandHistory<Command> past;
  bool has_started = false;
  for (const FuturesCycle& cycle : history) {
    const auto state = detail::joint_state<n>("history", cycle.state);
    const auto reference = detail::joint_reference<n>(cycle.reference);
    const auto command = detail::command_of<Command>(cycle.command);
    Outcome<Command> outcome;
    outcome.command = command;
    if (std::exchange(has_started, true)) {
      outcome = update_controller(controller, past.input(state, reference, period));
    } else {
      start_as_recorded(controller, command, state, reference, period);
    }
    past.note_command(outcome, command, state);
    past.note_cycle(true, true, Status::ok, Status::ok);
  }
  return past;
}

}  // namespace articula::remote
