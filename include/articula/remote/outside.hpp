// SPDX-License-Identifier: Apache-2.0
/// @file The side of a Remote in all threads but its loop's.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/remote/clients.hpp"
#include "articula/remote/engine/loop_side.hpp"
#include "articula/remote/engine/mutex.hpp"
#include "articula/remote/forecast/forecast.hpp"
#include "articula/remote/gains/gain_parameters.hpp"
#include "articula/remote/in_flight.hpp"
#include "articula/remote/planned_motions.hpp"
#include "articula/remote/published.hpp"
#include "articula/remote/remote_options.hpp"
#include "articula/remote/request_text.hpp"
#include "articula/remote/sheet/robot_sheet_of.hpp"
#include "articula/remote/task_maker.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace articula::remote {

/// The part of a Remote that the threads outside the loop share, under a mutex. Whoever asks
/// empties the rings of the loop and distributes what is in them.
/// @tparam LoopType  a ControlLoop or SupervisedControlLoop
template <class LoopType>
class Outside {
 public:
  using R = typename LoopType::RobotType;
  static constexpr int joint_count = LoopType::joint_count;
  using ControllerType = typename LoopType::ControllerType;
  using Rings = LoopRings<R, typename LoopType::Command>;

  /// @throws std::invalid_argument as Remote
  Outside(LoopType& loop, const RemoteOptions<joint_count>& options)
      : rings_(options.operator_lifetime / loop.period()),
        side_(loop, rings_, checked_limits(loop.hardware().robot(), options), options.tolerances,
              options.when_operator_is_lost),
        robot_(loop.hardware().robot()),
        sheet_(robot_sheet_of(loop, options.urdf, options.tolerances)),
        parameters_(robot_, loop.controller()),
        forecast_(loop),
        maker_(robot_, options.largest_force),
        published_(rings_, side_, robot_,
                   initial_position(robot_, SimulatorOptions<joint_count>{})),
        clients_(options.operator_lifetime, rings_.watch),
        in_flight_(robot_, rings_, options.answer_time) {
    if (!is_supervised<LoopType> && options.when_operator_is_lost == OperatorLoss::deactivate) {
      articula::detail::refuse(
          {"remote: when_operator_is_lost is deactivate, but the loop has no supervision: "
           "use SupervisedLoop"});
    }
  }

  /// The loop's part.
  [[nodiscard]] LoopSide<LoopType>& side() noexcept { return side_; }

  [[nodiscard]] const RobotSheet& sheet() const { return sheet_; }

  [[nodiscard]] Situation situation() {
    const std::lock_guard lock(mutex_);
    pump();
    return published_.situation(clients_.operator_name());
  }

  [[nodiscard]] std::vector<Parameter> parameters() {
    const std::lock_guard lock(mutex_);
    pump();
    return parameters_.list();
  }

  [[nodiscard]] Statistics statistics() {
    const std::lock_guard lock(mutex_);
    pump();
    return published_.statistics();
  }

  [[nodiscard]] FuturesAnswer futures(const FuturesQuestion& question) {
    const std::lock_guard forecast_lock(forecast_mutex_);  // they take one core, not all
    const auto now = [&] {
      const std::lock_guard lock(mutex_);
      pump();
      if (!question.start &&
          (published_.condition().mode != LoopMode::active || published_.last_cycle().cycle == 0)) {
        articula::detail::refuse({"futures: the loop is not active"});
      }
      return std::tuple(published_.last_cycle(), parameters_.list(), published_.controllers());
    }();
    return forecast_.answer(std::get<0>(now), std::get<1>(now), std::get<2>(now), question);
  }

  [[nodiscard]] std::vector<std::optional<JointMotion>> planned(double time) {
    const std::lock_guard lock(mutex_);
    pump();
    const LoopCondition<joint_count>& now = published_.condition();
    if (now.mode != LoopMode::active || !is_finite(time)) {
      return std::vector<std::optional<JointMotion>>(std::size_t{joint_count});
    }
    return planned_motions(in_flight_, now, published_.reference(), is_supervised<LoopType>,
                           std::max(time, published_.time()));
  }

  // Sessions, by their numbers:

  [[nodiscard]] std::uint64_t connect(std::string name, bool operates) {
    const std::lock_guard lock(mutex_);
    pump();
    return clients_.add(std::move(name), operates, published_.end());
  }
  void disconnect(std::uint64_t client) {
    const std::lock_guard lock(mutex_);
    clients_.remove(client, published_.time());
  }

  std::string take_controls(std::uint64_t client) {
    const std::lock_guard lock(mutex_);
    pump();
    return clients_.take_controls(client, published_.time());
  }
  void release_controls(std::uint64_t client) {
    const std::lock_guard lock(mutex_);
    pump();
    clients_.release_controls(client, published_.time());
  }
  [[nodiscard]] bool has_controls(std::uint64_t client) {
    const std::lock_guard lock(mutex_);
    pump();
    return clients_.has_controls(client);
  }
  void keep_alive(std::uint64_t client) {
    const std::lock_guard lock(mutex_);
    pump();
    clients_.note_sign(client);
  }

  std::uint64_t ask(std::uint64_t client, const Request& request) {
    const std::lock_guard lock(mutex_);
    pump();
    const std::uint64_t number = ++clients_.of(client).last_request;
    const std::string words = is_frequent(request) ? "" : in_words(request);
    const auto refuse = [&](std::string text, TrajectoryOutcome outcome = TrajectoryOutcome::idle) {
      Answer answer{number, Verdict::refused, std::move(text), outcome};
      log_outcome(clients_.of(client).name, words, answer);
      clients_.of(client).answers.push_back(std::move(answer));
      return number;
    };
    // Whoever may operate may stop, also without the controls.
    const bool stops = std::holds_alternative<Stop>(request);
    if (stops && clients_.of(client).operates) {
      clients_.note_sign(client);
    } else {
      std::string reason = clients_.take_controls(client, published_.time());
      if (!reason.empty()) return refuse(std::move(reason));
    }
    if (in_flight_.full(stops || std::holds_alternative<Deactivate>(request)))
      return refuse("too many requests are waiting for the loop");
    try {
      hand_over(client, number, words, request);
    } catch (const TrajectoryError& error) {
      return refuse(error.what(), error.outcome());
    } catch (const std::exception& error) {
      return refuse(error.what());
    }
    if (!words.empty()) tell(clients_.of(client).name + ": " + words);
    return number;
  }
  [[nodiscard]] std::optional<Answer> answer(std::uint64_t client) {
    const std::lock_guard lock(mutex_);
    pump();
    std::deque<Answer>& answers = clients_.of(client).answers;
    if (answers.empty()) return std::nullopt;
    Answer next = std::move(answers.front());
    answers.pop_front();
    return next;
  }
  [[nodiscard]] bool next(std::uint64_t client, Cycle& cycle) {
    const std::lock_guard lock(mutex_);
    std::uint64_t& number = clients_.of(client).next_cycle;
    if (number >= published_.end()) pump();
    return published_.next(number, cycle);
  }
  [[nodiscard]] std::optional<Event> event(std::uint64_t client) {
    const std::lock_guard lock(mutex_);
    pump();
    return clients_.next_event(client);
  }

 private:
  using Changes = typename GainParameters<R>::Changes;

  void hand_over(std::uint64_t client, std::uint64_t number, const std::string& words,
                 const Request& request) {
    Changes changes;
    typename Task<R>::Wish wish = maker_.make(request, published_.reference());
    if (const auto* follow = std::get_if<task::Follow<R>>(&wish); follow && !follow->note.empty()) {
      tell(clients_.of(client).name + ": " + follow->note);
    }
    if (const auto* set = std::get_if<SetParameters>(&request)) {
      std::vector<GainSetting> settings;
      for (const ParameterValue& own : set->values) settings.push_back({own.name, own.value});
      wish = task::SetGains{parameters_.change(set->values, changes), std::move(settings)};
    }
    in_flight_.hand_over(client, number, words, std::move(wish), std::move(changes));
  }

  void pump() {
    published_.collect(clients_);
    // After the records: the change of a cycle is in the ring before its record.
    in_flight_.collect([this](LoopChange change) { published_.note(std::move(change)); },
                       [this](std::uint64_t client, Answer answer, const std::string& words) {
                         if (auto* const found = clients_.find(client)) {
                           log_outcome(found->name, words, answer);
                           found->answers.push_back(std::move(answer));
                         }
                       },
                       [this] { return published_.controllers(); });
    clients_.watch_operator(published_.time());
  }
  void tell(std::string text, Event::Level level = Event::Level::info) {
    clients_.tell({published_.time(), level, std::move(text)});
  }
  /// An outcome that has something to say.
  void log_outcome(const std::string& client, const std::string& words, const Answer& answer) {
    if (words.empty() || answer.text.empty()) return;
    tell(client + ": " + words + ": " + answer.text,
         answer.verdict == Verdict::done ? Event::Level::info : Event::Level::warning);
  }

  Rings rings_;
  LoopSide<LoopType> side_;
  R robot_;
  RobotSheet sheet_;
  Mutex mutex_{};
  GainParameters<R> parameters_;
  Mutex forecast_mutex_{};
  Forecast<LoopType> forecast_;
  TaskMaker<LoopType> maker_;
  Published<LoopType> published_;
  Clients clients_;
  InFlight<R, typename LoopType::Command> in_flight_;
};

}  // namespace articula::remote
