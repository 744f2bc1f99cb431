// SPDX-License-Identifier: Apache-2.0
/// @file The answer to a request, from what its loop has made of it.
#pragma once

#include "articula/remote/engine/task.hpp"
#include "articula/remote/request.hpp"
#include "articula/text/similar_word.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace articula::remote {

/// Verdict and text on a task that the loop has given back. Real-time: no (allocates).
/// @param robot        whose joints the text names
/// @param controllers  a function that returns the ControllerInfo of each
template <Robot R>
[[nodiscard]] Answer answer_text(const R& robot, const Task<R>& task, auto&& controllers) {
  const std::string fault(to_string(task.status));
  const auto trajectory = [&] {
    std::string text(to_string(task.outcome));
    const std::string reason = to_string(robot, task.refusal);
    return reason.empty() ? text : text + ": " + reason;
  };
  std::string unfollowed;
  for (int j = 0; j < joint_count<R>; ++j) {
    if (!task.unfollowed[j]) continue;
    unfollowed += unfollowed.empty() ? ", but no active controller moves to it: '" : ", '";
    unfollowed += model_of(robot).joints[j].name.view();
    unfollowed += "'";
  }
  using enum TaskEnd;
  switch (task.end) {
    case done:
      if (const auto* own = std::get_if<task::Switch>(&task.wish)) {
        const SwitchOutcome& outcome = own->outcome;
        if (outcome.answer == SwitchAnswer::done) return {.verdict = Verdict::done};
        std::string text = "controller '" + std::string(outcome.controller.view()) +
                           "': " + std::string(to_string(outcome.answer));
        if (outcome.answer == SwitchAnswer::unknown_name) {
          const auto known = controllers();
          std::vector<std::string_view> names;
          for (const auto& each : known) names.push_back(each.name.view());
          text += articula::detail::choice_of(outcome.controller.view(), "controllers", names);
        }
        const bool strict = own->request.strictness == Strictness::strict;
        return {.verdict = strict ? Verdict::refused : Verdict::done, .text = text};
      }
      if (const auto* own = std::get_if<task::Follow<R>>(&task.wish)) {
        std::string text = "goal reached";
        const std::size_t first =
            next_point(own->trajectory->points(), task.bridge.from.time_from_start);
        if (task.has_begun && task.bridge.index > first) {
          text += ", without " + std::to_string(task.bridge.index - first) +
                  " of its first points: no motion within the limits reaches them in time";
        }
        return {.verdict = Verdict::done, .text = text + unfollowed};
      }
      return {.verdict = Verdict::done,
              .text = unfollowed.empty() ? "" : "the reference moves" + unfollowed};
    case not_active:
      return {.verdict = Verdict::refused, .text = "the loop is not active: activate it first"};
    case in_fault:
      return {.verdict = Verdict::refused,
              .text = "the loop is in fault (" + fault + "): acknowledge it first"};
    case no_fault:
      return {.verdict = Verdict::refused, .text = "there is no fault to acknowledge"};
    case bad_reference:
      return {.verdict = Verdict::refused,
              .text = "the present reference has a number that is not finite: reset it first"};
    case refused:
      return {.verdict = Verdict::refused, .text = "trajectory: " + trajectory()};
    case not_paused:
      return {.verdict = Verdict::refused,
              .text = "single steps need a paused simulation: pause it first"};
    case outdated:
      return {.verdict = Verdict::refused,
              .text = "an earlier change of the same gains was not done: ask again"};
    case operator_lost:
      return {.verdict = Verdict::refused,
              .text = "its operator was lost before the loop began the request"};
    case replaced:
      return {.verdict = Verdict::failed, .text = "another request has ended it"};
    case stopped:
      return {.verdict = Verdict::failed,
              .text = "a stop or the loss of its operator has ended it"};
    case reset:
      return {.verdict = Verdict::failed, .text = "a reset of the simulation has ended it"};
    case failed:
      return {.verdict = Verdict::failed, .text = "trajectory: " + trajectory()};
    case loop_left_active:
      return {.verdict = Verdict::failed,
              .text = "the loop is not active any more" +
                      (task.status == Status::ok ? std::string() : " (" + fault + ")")};
    case expired:
    case open:
      break;
  }
  return {.verdict = Verdict::timed_out,
          .text = "the loop did not take the request in time: does it run?"};
}

/// The answer to a task that the loop has given back. Real-time: no (allocates).
/// @param robot        whose joints the text names
/// @param controllers  a function that returns the ControllerInfo of each
template <Robot R>
[[nodiscard]] Answer answer_to(const R& robot, const Task<R>& task, auto&& controllers) {
  Answer answer = answer_text(robot, task, controllers);
  answer.outcome = task.outcome;
  answer.cycle = task.cycle;
  return answer;
}

}  // namespace articula::remote
