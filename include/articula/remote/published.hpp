// SPDX-License-Identifier: Apache-2.0
/// @file The state that a loop publishes of itself, for those who watch.
#pragma once

#include "articula/command/command_parts.hpp"
#include "articula/control/switching/switch_board.hpp"
#include "articula/loop/duration_histogram.hpp"
#include "articula/loop/status_advice.hpp"
#include "articula/recording/loop_change.hpp"
#include "articula/remote/clients.hpp"
#include "articula/remote/cycle.hpp"
#include "articula/remote/engine/loop_side.hpp"
#include "articula/remote/engine/record_history.hpp"
#include "articula/remote/limit_excess.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <utility>
#include <vector>

namespace articula::remote {

/// The reading side of what a loop publishes: the last cycles, its condition, its controllers,
/// statistics. For the outside, not for several threads at a time.
/// @tparam LoopType  a ControlLoop or SupervisedControlLoop
template <class LoopType>
class Published {
 public:
  static constexpr int joint_count = LoopType::joint_count;
  using R = typename LoopType::RobotType;
  using Rings = typename LoopSide<LoopType>::Rings;
  using Record = typename Rings::Record;
  using Reference = JointReference<joint_count>;

  /// @param rings, side, robot  outlive this
  /// @param position            of the reference while none is known [rad or m], N x 1
  Published(Rings& rings, LoopSide<LoopType>& side, const R& robot,
            const JointVector<joint_count>& position)
      : rings_(rings),
        side_(side),
        robot_(robot),
        reference_{.position = position},
        condition_(side.condition()) {}

  /// Takes over what is new, and sends events to the clients.
  void collect(Clients& clients) {
    for (ConditionChange<joint_count> change; rings_.changes.pop(change);) note(change, clients);
    for (Record record; rings_.records.pop(record);) note(record, clients);
    if constexpr (switched) {
      while (const auto event = side_.switches().event()) {
        const bool failed = event->after == ControllerStatus::failed;
        clients.tell({time(), failed ? Event::Level::error : Event::Level::info,
                      "controller " + std::string(event->controller.view()) + ": " +
                          std::string(to_string(event->after))});
      }
    }
  }

  /// Of the last cycle [s].
  [[nodiscard]] double time() const { return last_.cycle.time; }
  [[nodiscard]] const LoopCondition<joint_count>& condition() const { return condition_; }
  /// The last cycle; before the first one all zeros.
  [[nodiscard]] const auto& last_cycle() const { return last_.cycle; }
  /// The last fault of a supervised loop. A plain loop has no mode that shows what is wrong: the
  /// status of its last cycle.
  [[nodiscard]] Status fault() const {
    return is_supervised<LoopType> ? condition_.fault : last_.cycle.status;
  }
  /// The last one that is finite.
  [[nodiscard]] const Reference& reference() const { return reference_; }

  [[nodiscard]] std::vector<ControllerInfo> controllers() const {
    if constexpr (switched) {
      std::vector<ControllerInfo> named;  // a place without a name has no controller
      for (const ControllerInfo& info : side_.switches().list()) {
        if (!info.name.empty()) named.push_back(info);
      }
      return named;
    } else {
      const bool active = condition_.mode == LoopMode::active;
      return {{articula::detail::own_name<typename LoopType::ControllerType>(0),
               active ? ControllerStatus::active : ControllerStatus::inactive}};
    }
  }

  [[nodiscard]] Situation situation(std::string operator_name) const {
    std::vector<std::string> motions;
    for (const MotionKind motion : condition_.motions) motions.emplace_back(to_string(motion));
    return {
        .mode = condition_.mode,
        .fault = fault(),
        .advice = advice(fault()),
        .motion = std::string(to_string(condition_.motion)),
        .joint_motions = std::move(motions),
        .following = std::vector<bool>(condition_.following.begin(), condition_.following.end()),
        .operator_name = std::move(operator_name),
        .controllers = controllers(),
        .paused = condition_.paused,
        .speed = condition_.speed,
        .trajectory_speed = condition_.trajectory_speed};
  }

  [[nodiscard]] Statistics statistics() const {
    return {.cycles = last_.cycle.cycle,
            .overruns = last_.overruns,
            .dropped = rings_.records.dropped(),
            .latency_median = seconds(latency_.percentile(0.5)),
            .latency_99 = seconds(latency_.percentile(0.99)),
            .latency_max = seconds(latency_.max()),
            .execution_median = seconds(execution_.percentile(0.5)),
            .execution_99 = seconds(execution_.percentile(0.99)),
            .execution_max = seconds(execution_.max())};
  }

  /// Takes over a change of the controller. The last ones are kept.
  void note(LoopChange change) {
    changes_.push_back(std::move(change));
    if (changes_.size() > kept_changes) changes_.pop_front();
  }

  /// The number of the next cycle to come, for readers.
  [[nodiscard]] std::uint64_t end() const { return history_.end(); }
  /// Copies the cycle of a number, or the oldest one that is kept, whose vectors are reused.
  /// @param[in,out] number  is moved on to the next one
  /// @return                whether there is one
  [[nodiscard]] bool next(std::uint64_t& number, Cycle& cycle) const {
    const Record* const record = history_.take(number);
    if (record == nullptr) return false;
    const auto copy = [](std::vector<double>& to, const JointVector<joint_count>& from) {
      to.assign(from.data(), from.data() + joint_count);
    };
    const auto& own = record->cycle;
    cycle.number = own.cycle;
    cycle.time = own.time;
    cycle.status = own.status;
    cycle.mode = record->mode;
    copy(cycle.position, own.state.position);
    copy(cycle.velocity, own.state.velocity);
    copy(cycle.effort, own.state.effort);
    copy(cycle.reference_position, own.reference.position);
    copy(cycle.reference_velocity, own.reference.velocity);
    copy(cycle.reference_acceleration, own.reference.acceleration);
    copy(cycle.reference_effort, own.reference.effort);
    const auto parts = parts_of(own.command);
    cycle.command.resize(parts.size());
    for (std::size_t k = 0; k < parts.size(); ++k) copy(cycle.command[k], *parts[k].values);
    cycle.latency = seconds(own.timing.latency);
    cycle.period = seconds(own.timing.period);
    cycle.update = seconds(own.timing.update);
    cycle.input = own.input;
    cycle.changes.clear();
    for (const LoopChange& change : changes_) {
      if (change.cycle == own.cycle) cycle.changes.push_back(change);
    }
    return true;
  }

 private:
  static constexpr std::size_t kept_records = 4096;
  static constexpr std::size_t kept_changes = 4096;
  static constexpr bool switched =
      articula::detail::switch_size<typename LoopType::ControllerType> > 0;

  [[nodiscard]] static double seconds(std::chrono::nanoseconds time) {
    return std::chrono::duration<double>(time).count();
  }
  [[nodiscard]] std::string advice(Status status) const {
    std::string text(advice_on(status));
    if (status == Status::limit_exceeded && !excess_.empty()) text += " Measured: " + excess_ + ".";
    return text;
  }
  [[nodiscard]] std::string in_words(Status status) const {
    std::string text(to_string(status));
    if (status != Status::ok) text += ". " + advice(status);
    return text;
  }

  void note(const ConditionChange<joint_count>& change, Clients& clients) {
    const LoopCondition<joint_count>& now = change.condition;
    if (now.mode == LoopMode::fault && condition_.mode != LoopMode::fault) {
      excess_ = limit_excess(robot_, change.state);
      clients.tell({change.time, Event::Level::error, "fault: " + in_words(now.fault)});
    } else if (now.mode != condition_.mode) {
      const std::string text = "mode: " + std::string(to_string(now.mode));
      clients.tell({change.time, Event::Level::info, text});
    }
    condition_ = now;
  }

  void note(const Record& record, Clients& clients) {
    const Status status = record.cycle.status;
    if (!is_supervised<LoopType> && status != last_.cycle.status) {
      const auto level = status == Status::ok ? Event::Level::info : Event::Level::error;
      clients.tell({record.cycle.time, level, "status: " + in_words(status)});
    }
    history_.add(record);
    last_ = record;
    if (is_finite(record.cycle.reference)) reference_ = record.cycle.reference;
    if (record.cycle.timing.update.count() == 0) return;
    latency_.add(record.cycle.timing.latency);
    execution_.add(record.cycle.timing.update);
  }

  Rings& rings_;
  LoopSide<LoopType>& side_;
  const R& robot_;
  std::string excess_{};  ///< of limits, when the last fault began
  RecordHistory<Record> history_{kept_records};
  std::deque<LoopChange> changes_{};
  Record last_{};
  Reference reference_;
  LoopCondition<joint_count> condition_;
  DurationHistogram latency_{};
  DurationHistogram execution_{};
};

}  // namespace articula::remote
