// SPDX-License-Identifier: Apache-2.0
/// @file The side of a Remote in the thread of its loop.
#pragma once

#include "articula/loop/exchange/switch_exchange.hpp"
#include "articula/loop/run_report.hpp"
#include "articula/loop/stop.hpp"
#include "articula/remote/engine/loop_rings.hpp"
#include "articula/remote/engine/loop_traits.hpp"
#include "articula/remote/engine/mode_control.hpp"
#include "articula/remote/engine/motion_control.hpp"
#include "articula/remote/engine/simulation_control.hpp"
#include "articula/remote/engine/task_returns.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <variant>

namespace articula::remote {

/// The part of a Remote that runs in the loop's thread: takes tasks, makes the reference, makes the
/// loop's cycles and publishes them. It never waits for the outside: all that passes between them
/// is in rings.
/// @tparam LoopType  a ControlLoop or SupervisedControlLoop
template <class LoopType>
class LoopSide {
 public:
  using R = typename LoopType::RobotType;
  static constexpr int joint_count = LoopType::joint_count;
  using Rings = LoopRings<R, typename LoopType::Command>;

  /// @param loop       outlives this
  /// @param rings      likewise
  /// @param when_lost  what happens when the operator is lost
  /// @throws std::invalid_argument as ReferenceSource
  LoopSide(LoopType& loop, Rings& rings, const MotionLimits<joint_count>& limits,
           const TrajectoryTolerances<joint_count>& tolerances, OperatorLoss when_lost)
      : loop_(loop),
        rings_(rings),
        when_lost_(when_lost),
        modes_(loop, returns_),
        motions_(loop, returns_, modes_, limits, tolerances),
        simulation_(loop, returns_, modes_, motions_),
        switches_(switches_of(loop)) {}
  LoopSide(const LoopSide&) = delete;
  LoopSide& operator=(const LoopSide&) = delete;

  /// The present state of what changes seldom. In the loop's thread. Real-time: yes.
  [[nodiscard]] LoopCondition<joint_count> condition() const noexcept {
    return {modes_.mode(),
            modes_.fault(),
            motions_.kind(),
            motions_.kinds(),
            motions_.following(),
            simulation_.pace().paused(),
            simulation_.pace().speed(),
            motions_.trajectory_speed()};
  }
  /// The exchange with a Switch or Groups. Its reading side belongs to the outside.
  [[nodiscard]] auto& switches() noexcept { return switches_; }

  /// One period: a look whether there is a task, and the cycles that belong to the period.
  /// @return the status of the last cycle
  /// Real-time: yes, if the loop's update is.
  [[nodiscard]] Status update() noexcept {
    publish({});
    rings_.updates.store(++updates_, std::memory_order_relaxed);
    take();
    for (int due = simulation_.cycles_due(); due > 0; --due) {
      cycle();
      if (due > 1) publish({});
    }
    simulation_.note_cycles();
    tell();
    return status_;
  }

  /// Publishes the last cycle with its timing. Real-time: yes.
  void report(const RunReport& report) noexcept {
    overruns_ = report.overruns;
    publish(report.timing);
  }

  /// Real-time: yes.
  void missed_periods([[maybe_unused]] std::uint64_t periods) noexcept {
    if constexpr (requires { loop_.missed_periods(periods); }) {
      if (simulation_.pace().is_real_time()) loop_.missed_periods(periods);
    }
  }

  /// Ends control, as `stop(loop, status)`. Real-time: no (the hardware may take its time).
  [[nodiscard]] Status stop() noexcept {
    const Status stopped = articula::stop(loop_, status_);
    motions_.leave_active();
    modes_.note_end();
    simulation_.note_end();
    publish({});
    tell();
    return stopped;
  }

 private:
  /// Takes the next task, and begins it. References that wait are set in one cycle, so a client
  /// that is faster than the loop makes no queue. A period in which an operator is lost begins
  /// nothing. So the task of the next operator finds the loop as the loss leaves it.
  void take() noexcept {
    if (due_count_ == 0) take_due();
    const OperatorWatch::News news = rings_.watch.look();
    if (const std::uint64_t stop = rings_.stop.load(std::memory_order_acquire); stop > stopped_) {
      stopped_ = stop;
      motions_.stop();
    }
    if (news.left) simulation_.end_pull();
    if (news.lost) return lose_operator();
    for (std::size_t k = 0; k < due_count_; ++k) begin(*due_[k]);
    due_count_ = 0;
  }
  /// Takes one task, or all references that wait.
  void take_due() noexcept {
    while (has_next() && (due_count_ == 0 || (sets(*due_[0]) && sets(*next_)))) {
      due_[due_count_++] = std::exchange(next_, nullptr);
    }
  }
  [[nodiscard]] bool has_next() noexcept {
    // A change of mode takes some cycles, and what is asked after it is meant for the new mode.
    if (modes_.changes()) return false;
    if (next_ == nullptr) static_cast<void>(rings_.tasks.pop(next_));
    return next_ != nullptr;
  }
  [[nodiscard]] static bool sets(const Task<R>& task) noexcept {
    return std::holds_alternative<task::Set<joint_count>>(task.wish);
  }

  static constexpr bool switched =
      articula::detail::switch_size<typename LoopType::ControllerType> > 0;
  struct NoSwitches {};

  [[nodiscard]] static auto switches_of([[maybe_unused]] const LoopType& loop) {
    if constexpr (switched) {
      return SwitchExchange(loop.controller());
    } else {
      return NoSwitches{};
    }
  }

  void cycle() noexcept {
    motions_.steer();
    simulation_.act();
    status_ = loop_.update();
    if constexpr (switched) switches_.apply(loop_.controller());
    ++cycles_;
    unpublished_ = true;
    motions_.note_cycle();
    modes_.note_cycle(status_);
  }

  void lose_operator() noexcept {
    if constexpr (is_supervised<LoopType>) {
      if (when_lost_ == OperatorLoss::deactivate) return loop_.request_deactivation();
    }
    motions_.stop();
  }

  void begin(Task<R>& next) noexcept {
    if (next.claimed.exchange(true, std::memory_order_acq_rel)) {
      return returns_.finish(next, TaskEnd::expired);
    }
    if (rings_.watch.is_void(next.sign)) return returns_.finish(next, TaskEnd::operator_lost);
    next.cycle = cycles_ + 1;
    // std::visit could throw, if only in theory.
    [&]<std::size_t... I>(std::index_sequence<I...>) noexcept {
      ((next.wish.index() == I ? begin_own(next, *std::get_if<I>(&next.wish)) : void()), ...);
    }(std::make_index_sequence<std::variant_size_v<typename Task<R>::Wish>>());
    if (rings_.watch.has_left(next.sign)) simulation_.end_pull();
  }
  void begin_own(Task<R>& own, auto& wish) noexcept {
    if constexpr (requires { modes_.begin(own, wish); }) {
      modes_.begin(own, wish);
    } else if constexpr (requires { motions_.begin(own, wish); }) {
      using Own = std::remove_cvref_t<decltype(wish)>;
      constexpr bool stops =
          std::same_as<Own, task::Stop> || std::same_as<Own, task::StopJoints<joint_count>>;
      if (!stops && own.number < stopped_) return returns_.finish(own, TaskEnd::stopped);
      motions_.begin(own, wish);
    } else if constexpr (requires { simulation_.begin(own, wish); }) {
      simulation_.begin(own, wish);
    } else {
      begin(own, wish);
    }
  }
  void begin(Task<R>& own, [[maybe_unused]] task::Switch& wish) noexcept {
    if constexpr (switched) {
      wish.outcome = switch_in(loop_.controller()).request(wish.request);
      rings_.changed.push(&own);
    }
    returns_.finish(own, TaskEnd::done);
  }
  void begin(Task<R>& own, task::SetGains& wish) noexcept {
    for (const auto& change : wish.changes) {
      if (!change->fits()) return returns_.finish(own, TaskEnd::outdated);
    }
    for (const auto& change : wish.changes) change->apply();
    rings_.changed.push(&own);
    returns_.finish(own, TaskEnd::done);
  }

  void publish(const CycleTiming& timing) noexcept {
    if (!unpublished_) return;
    unpublished_ = false;
    rings_.records.push({.cycle = record_of(std::as_const(loop_), cycles_, status_, timing),
                         .mode = modes_.mode(),
                         .overruns = overruns_});
  }

  /// Hands over what has changed, and then the tasks that have ended, so that who has an answer
  /// sees its effect.
  void tell() noexcept {
    const LoopCondition<joint_count> now = condition();
    if (!told_ || !(now == condition_)) {
      condition_ = now;
      told_ = rings_.changes.push({loop_.time(), now, loop_.state()});
    }
    returns_.hand_to(rings_.ended, now.mode == LoopMode::fault ? now.fault : Status::ok);
  }

  LoopType& loop_;
  Rings& rings_;
  OperatorLoss when_lost_;
  TaskReturns<R> returns_{};
  ModeControl<LoopType> modes_;
  MotionControl<LoopType> motions_;
  SimulationControl<LoopType> simulation_;
  decltype(switches_of(std::declval<const LoopType&>())) switches_;
  Task<R>* next_ = nullptr;                 ///< out of the ring
  std::array<Task<R>*, most_tasks> due_{};  ///< of this period
  std::size_t due_count_ = 0;
  std::uint64_t stopped_ = 0;  ///< motions that were asked before this task are not begun
  Status status_ = Status::ok;
  std::uint64_t updates_ = 0;
  std::uint64_t cycles_ = 0;
  std::uint64_t overruns_ = 0;
  bool unpublished_ = false;
  LoopCondition<joint_count> condition_{};
  bool told_ = false;
};

}  // namespace articula::remote
