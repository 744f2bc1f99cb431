// SPDX-License-Identifier: Apache-2.0
/// @file The motions of a remote loop's reference, and the tasks that begin and end them.
#pragma once

#include "articula/remote/engine/mode_control.hpp"
#include "articula/remote/engine/reference_source.hpp"
#include "articula/remote/engine/task_returns.hpp"

#include <utility>
#include <variant>

namespace articula::remote {

/// Makes the reference of a loop. In the loop's thread. Real-time: yes.
/// @tparam LoopType  a ControlLoop or SupervisedControlLoop
template <class LoopType>
class MotionControl {
 public:
  using R = typename LoopType::RobotType;
  static constexpr int joint_count = LoopType::joint_count;

  /// @throws std::invalid_argument as ReferenceSource
  MotionControl(LoopType& loop, TaskReturns<R>& returns, const ModeControl<LoopType>& modes,
                const MotionLimits<joint_count>& limits,
                const TrajectoryTolerances<joint_count>& tolerances)
      : loop_(loop),
        returns_(returns),
        modes_(modes),
        source_(loop.hardware().robot(), limits, tolerances) {}

  [[nodiscard]] MotionKind kind() const noexcept { return source_.kind(); }
  /// As asked for.
  [[nodiscard]] double trajectory_speed() const noexcept { return source_.trajectory_speed(); }

  /// Makes the reference of the next cycle. A supervised loop gets it in each cycle, so that the
  /// lifetime of its references guards against nothing but the silence of this thread. Of a plain
  /// loop, the reference stays as it is at rest, so a program may set it itself.
  void steer() noexcept {
    if (!modes_.active()) return;
    const Reference& present = reference();
    if constexpr (is_supervised<LoopType>) {
      loop_.post(modes_.takes_references() ? source_.next(present, loop_.period()) : present);
    } else if (source_.kind() != MotionKind::rest) {
      loop_.reference() = source_.next(present, loop_.period());
    }
  }

  /// Looks at the motion after a cycle.
  void note_cycle() noexcept {
    if (!modes_.active()) return leave_active();
    const TrajectoryOutcome outcome = source_.check(loop_.state());
    if (waiting_ == nullptr) return;
    if (std::holds_alternative<task::Follow<R>>(waiting_->wish)) {
      if (outcome == TrajectoryOutcome::active) return;
      waiting_->outcome = outcome;
      waiting_->refusal = source_.refusal();
      const bool good = outcome == TrajectoryOutcome::successful;
      returns_.give_back(waiting_, good ? TaskEnd::done : TaskEnd::failed);
    } else if (source_.kind() != MotionKind::signals) {
      returns_.give_back(waiting_, TaskEnd::done);
    }
  }

  /// The loop is not active: its reference is its own.
  void leave_active() noexcept {
    source_.rest();
    returns_.give_back(waiting_, TaskEnd::loop_left_active);
  }

  /// Ends the motion by a stop.
  void stop() noexcept {
    returns_.give_back(waiting_, TaskEnd::replaced);
    if (source_.kind() != MotionKind::rest) source_.stop(reference());
  }
  /// Ends the motion at once, since the robot is put elsewhere.
  void abandon() noexcept {
    returns_.give_back(waiting_, TaskEnd::replaced);
    source_.rest();
  }

  void begin(Task<R>& own, task::Go<joint_count>& wish) noexcept {
    if (!can_begin(own)) return;
    source_.go(reference(), wish.target, wish.speed);
    replace(own, TaskEnd::done);
  }
  void begin(Task<R>& own, task::Set<joint_count>& wish) noexcept {
    if (!can_begin(own)) return;
    source_.set(reference(), wish.setting);
    replace(own, TaskEnd::done);
  }
  void begin(Task<R>& own, task::Follow<R>& wish) noexcept {
    if (!can_begin(own)) return;
    own.outcome = source_.follow(reference(), *wish.trajectory, wish.tolerances, wish.delay);
    own.refusal = source_.refusal();
    if (own.outcome != TrajectoryOutcome::active) return returns_.finish(own, TaskEnd::refused);
    replace(own, TaskEnd::open);
  }
  void begin(Task<R>& own, task::Play<R>& wish) noexcept {
    if (!can_begin(own)) return;
    source_.play(reference(), wish.signals, wish.duration);
    replace(own, TaskEnd::open);
  }
  void begin(Task<R>& own, task::SetTrajectorySpeed& wish) noexcept {
    source_.set_trajectory_speed(wish.factor);
    returns_.finish(own, TaskEnd::done);
  }
  void begin(Task<R>& own, task::Stop&) noexcept {
    stop();
    returns_.finish(own, TaskEnd::done);
  }

 private:
  using Reference = JointReference<joint_count>;

  [[nodiscard]] const Reference& reference() const noexcept {
    return std::as_const(loop_).reference();
  }

  [[nodiscard]] bool can_begin(Task<R>& own) noexcept {
    const bool finite = is_finite(reference());
    if (modes_.active() && finite) return true;
    const bool faulty = modes_.mode() == LoopMode::fault;
    const TaskEnd inactive = faulty ? TaskEnd::in_fault : TaskEnd::not_active;
    returns_.finish(own, modes_.active() ? TaskEnd::bad_reference : inactive);
    return false;
  }

  /// A task has begun a motion.
  /// @param end  of the task; open if it ends with the motion
  void replace(Task<R>& own, TaskEnd end) noexcept {
    returns_.give_back(waiting_, TaskEnd::replaced);
    if (end == TaskEnd::open) {
      waiting_ = &own;
    } else {
      returns_.finish(own, end);
    }
  }

  LoopType& loop_;
  TaskReturns<R>& returns_;
  const ModeControl<LoopType>& modes_;
  ReferenceSource<R> source_;
  Task<R>* waiting_ = nullptr;  ///< ends with the motion
};

}  // namespace articula::remote
