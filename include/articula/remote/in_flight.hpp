// SPDX-License-Identifier: Apache-2.0
/// @file The requests that a loop has and has not answered yet.
#pragma once

#include "articula/model/robot.hpp"
#include "articula/recording/loop_change.hpp"
#include "articula/remote/engine/loop_rings.hpp"
#include "articula/remote/gains/gain_parameters.hpp"
#include "articula/remote/task_answer.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace articula::remote {

/// The tasks that a loop has. They are handed over, taken back with an answer, or answered in its
/// stead when it does not take them in time. For the outside, not for several threads at a time.
/// @tparam R        the robot
/// @tparam Command  of the loop
template <Robot R, class Command>
class InFlight {
 public:
  using Rings = LoopRings<R, Command>;
  using Clock = std::chrono::steady_clock;
  using Changes = typename GainParameters<R>::Changes;

  /// @param robot        stays where it is
  /// @param rings        likewise
  /// @param answer_time  within which the loop must take a task [s]
  InFlight(const R& robot, Rings& rings, double answer_time)
      : robot_(robot), rings_(rings), answer_time_(answer_time) {}

  /// Whether the loop has as many tasks as it can. Some places are for those that end a motion.
  [[nodiscard]] bool full(bool ends_motion) const {
    return pending_.size() + (ends_motion ? 0 : Rings::reserved_tasks) >= most_tasks;
  }

  /// Hands a task over.
  /// @param client, request  whom to answer
  /// @param words            the request as the log lists it; empty: it does not
  /// @param changes          of gains, with their holders
  /// @pre                    not full()
  void hand_over(std::uint64_t client, std::uint64_t request, std::string words,
                 typename Task<R>::Wish wish, Changes changes) {
    for (const auto& [holder, change] : changes) holder->hand_over(*change);
    auto task = std::make_unique<Task<R>>(std::move(wish));
    Task<R>* const handed_over = task.get();
    handed_over->number = ++last_;
    // What makes the robot rest is done for an operator who is lost by then, too.
    const bool is_stop = std::holds_alternative<task::Stop>(handed_over->wish);
    if (is_stop) rings_.stop.store(last_, std::memory_order_release);
    if (!is_stop && !std::holds_alternative<task::Deactivate>(handed_over->wish) &&
        !std::holds_alternative<task::StopJoints<joint_count<R>>>(handed_over->wish)) {
      handed_over->sign = rings_.watch.last_sign();
    }
    pending_.push_back(
        {std::move(task), client, request, std::move(words), Clock::now(), std::move(changes)});
    rings_.tasks.push(handed_over);
  }

  /// Takes back what the loop has ended, and answers what it did not take in time.
  /// @param note         called with each change of the controller that the loop has made
  /// @param give         called with client, answer, and the words of the request
  /// @param controllers  a function that returns the ControllerInfo of each
  void collect(auto&& note, auto&& give, auto&& controllers) {
    std::vector<Task<R>*> all_ended;
    for (Task<R>* ended = nullptr; rings_.ended.pop(ended);) all_ended.push_back(ended);
    note_changes(note);  // of tasks that ended, all are there by now
    for (Task<R>* const ended : all_ended) {
      const auto found = std::find_if(pending_.begin(), pending_.end(),
                                      [&](const Pending& own) { return own.task.get() == ended; });
      if (found == pending_.end()) continue;
      for (const auto& [holder, change] : found->changes) {
        holder->settle(*change, ended->end == TaskEnd::done);
      }
      if (!found->answered) answer(*found, answer_to(robot_, *ended, controllers), give);
      pending_.erase(found);
    }
    check_times(give);
  }

  /// Calls function(trajectory, bridge, clock) for each trajectory that the loop follows.
  void for_each_followed(auto&& function) {
    for (Pending& own : pending_) {
      const auto* const follow = std::get_if<task::Follow<R>>(&own.task->wish);
      if (follow == nullptr) continue;
      own.task->clock.update();
      const TrajectoryClock& clock = own.task->clock.value();
      if (clock.own) function(*follow->trajectory, own.task->bridge, clock);
    }
  }

 private:
  struct Pending {
    std::unique_ptr<Task<R>> task;
    std::uint64_t client = 0;
    std::uint64_t request = 0;
    std::string words{};
    Clock::time_point since{};
    Changes changes{};
    bool answered = false;  ///< since the loop was late
  };

  void note_changes(auto& note) {
    for (Task<R>* changed = nullptr; rings_.changed.pop(changed);) {
      LoopChange change{.cycle = changed->cycle};
      if (const auto* gains = std::get_if<task::SetGains>(&changed->wish)) {
        change.gains = gains->settings;
      } else if (const auto* switched = std::get_if<task::Switch>(&changed->wish)) {
        change.request = switched->request;
      }
      note(std::move(change));
    }
  }

  static void answer(const Pending& own, Answer answer, auto& give) {
    answer.request = own.request;
    give(own.client, std::move(answer), own.words);
  }

  /// Who waits for the loop has an answer in time, also where it does not run any more.
  void check_times(auto& give) {
    const auto now = Clock::now();
    const auto is_late = [&](Clock::time_point since) {
      return std::chrono::duration<double>(now - since).count() > answer_time_;
    };
    if (const std::uint64_t updates = rings_.updates.load(); updates != updates_) {
      updates_ = updates;
      last_update_ = now;
    }
    const bool runs = !is_late(last_update_);
    for (Pending& own : pending_) {
      if (own.answered || !is_late(own.since)) continue;
      if (!own.task->claimed.exchange(true, std::memory_order_acq_rel)) {
        own.answered = true;
        answer(own,
               {.verdict = Verdict::timed_out,
                .text = "the loop did not take the request in time: does it run?"},
               give);
      } else if (!runs) {
        own.answered = true;
        answer(
            own,
            {.verdict = Verdict::failed,
             .text = "the loop stands still in this request, which may still go on: does it run?"},
            give);
      }
    }
  }

  const R& robot_;
  Rings& rings_;
  double answer_time_;  ///< [s]
  std::vector<Pending> pending_{};
  std::uint64_t last_ = 0;
  std::uint64_t updates_ = 0;
  Clock::time_point last_update_{};  ///< when they had changed
};

}  // namespace articula::remote
