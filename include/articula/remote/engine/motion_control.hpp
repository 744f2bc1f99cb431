// SPDX-License-Identifier: Apache-2.0
/// @file The motions of a remote loop's reference, and the tasks that begin and end them.
#pragma once

#include "articula/control/composition/follows_position.hpp"
#include "articula/core/finite.hpp"
#include "articula/remote/engine/mode_control.hpp"
#include "articula/remote/engine/task_returns.hpp"
#include "articula/remote/motion/reference_source.hpp"

#include <array>
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
  /// What each joint does.
  [[nodiscard]] JointArray<MotionKind, joint_count> kinds() const noexcept {
    JointArray<MotionKind, joint_count> kinds{};
    for (int j = 0; j < joint_count; ++j) kinds[j] = source_.kind(j);
    return kinds;
  }
  /// The joints that an active controller moves to the position of the reference.
  [[nodiscard]] JointArray<bool, joint_count> following() const noexcept {
    if (!modes_.active()) return {};
    return joints_following_position<joint_count>(loop_.controller());
  }
  /// As asked for.
  [[nodiscard]] double trajectory_speed() const noexcept { return source_.trajectory_speed(); }

  /// Makes the reference of the next cycle. A supervised loop gets it in each cycle, so that the
  /// lifetime of its references guards against nothing but the silence of this thread. Of a plain
  /// loop, the reference stays as it is at rest, so a program may set it itself.
  void steer() noexcept {
    if (!modes_.active()) return;
    const Reference& present = reference();
    if constexpr (is_supervised<LoopType>) {
      loop_.post(modes_.takes_references() ? along(source_.next(present, loop_.period()))
                                           : present);
    } else if (source_.kind() != MotionKind::rest) {
      loop_.reference() = source_.next(present, loop_.period());
    }
  }

  /// Looks at the motions after a cycle.
  void note_cycle() noexcept {
    if (!modes_.active()) return leave_active();
    source_.check(loop_.state());
    if (!source_.leads(Source::signals)) {
      returns_.give_back(waiting(Source::signals), TaskEnd::done);
    }
    for (int source = Source::first_follower; source < Source::source_count; ++source) {
      Task<R>*& own = waiting(source);
      if (own == nullptr) continue;
      const TrajectoryOutcome outcome = source_.outcome(source);
      if (outcome == TrajectoryOutcome::active) {
        note_progress(*own, source);
        continue;
      }
      own->clock.write({});
      own->outcome = outcome;
      own->refusal = source_.refusal(source);
      const bool good = outcome == TrajectoryOutcome::successful;
      if (good) note_unfollowed(*own);
      returns_.give_back(own, good ? TaskEnd::done : TaskEnd::failed);
    }
  }

  /// The loop is not active: its reference is its own.
  void leave_active() noexcept {
    source_.rest();
    for (Task<R>*& own : waiting_) returns_.give_back(own, TaskEnd::loop_left_active);
  }

  /// Ends all motions by a stop.
  void stop() noexcept {
    Joints all;
    all.fill(true);
    stop(all);
  }
  /// Ends all motions at once, since the robot is put elsewhere.
  void abandon() noexcept {
    source_.rest();
    give_back_ended(TaskEnd::reset);
  }

  void begin(Task<R>& own, task::Go<joint_count>& wish) noexcept {
    if (!can_begin(own)) return;
    const auto follows = following();
    for (int j = 0; j < joint_count; ++j) {
      own.unfollowed[j] = is_finite(wish.target[j]) && !follows[j];
    }
    source_.go(reference(), wish.target, wish.speed);
    finish(own);
  }
  void begin(Task<R>& own, task::Set<joint_count>& wish) noexcept {
    if (!can_begin(own)) return;
    const auto follows = following();
    for (int j = 0; j < joint_count; ++j) {
      own.unfollowed[j] = wish.setting.positions[j] && !follows[j];
    }
    source_.set(reference(), wish.setting);
    finish(own);
  }
  void begin(Task<R>& own, task::Follow<R>& wish) noexcept {
    if (!can_begin(own)) return;
    const auto begun = source_.follow(reference(), *wish.trajectory, wish.tolerances, wish.delay);
    own.outcome = begun.outcome;
    own.refusal = begun.refusal;
    if (own.outcome != TrajectoryOutcome::active) return returns_.finish(own, TaskEnd::refused);
    await(own, begun.source);
  }
  void begin(Task<R>& own, task::Play<R>& wish) noexcept {
    if (!can_begin(own)) return;
    source_.play(reference(), wish.joints, wish.signals, wish.duration);
    await(own, Source::signals);
  }
  void begin(Task<R>& own, task::SetTrajectorySpeed& wish) noexcept {
    source_.set_trajectory_speed(wish.factor);
    returns_.finish(own, TaskEnd::done);
  }
  void begin(Task<R>& own, task::Stop&) noexcept {
    stop();
    returns_.finish(own, TaskEnd::done);
  }
  void begin(Task<R>& own, task::StopJoints<joint_count>& wish) noexcept {
    stop(wish.joints);
    returns_.finish(own, TaskEnd::done);
  }

 private:
  using Reference = JointReference<joint_count>;
  using Source = ReferenceSource<R>;
  using Joints = typename Source::Joints;

  [[nodiscard]] const Reference& reference() const noexcept {
    return std::as_const(loop_).reference();
  }

  /// The reference of a joint whose controller does not follow its position goes along with the
  /// measurement, unless it moves. So a controller that does and starts later holds the joint where
  /// it is.
  [[nodiscard]] Reference along(Reference own) noexcept {
    const auto follows = following();
    const JointVector<joint_count>& measured = loop_.state().position;
    for (int j = 0; j < joint_count; ++j) {
      if (follows[j] || !is_finite(measured[j])) continue;
      if (source_.place(j, measured[j])) own.position[j] = measured[j];
    }
    return own;
  }

  [[nodiscard]] bool can_begin(Task<R>& own) noexcept {
    const bool finite = is_finite(reference());
    if (modes_.active() && finite) return true;
    const bool faulty = modes_.mode() == LoopMode::fault;
    const TaskEnd inactive = faulty ? TaskEnd::in_fault : TaskEnd::not_active;
    returns_.finish(own, modes_.active() ? TaskEnd::bad_reference : inactive);
    return false;
  }

  /// Tells the outside where a trajectory is.
  void note_progress(Task<R>& own, int source) noexcept {
    const auto progress = source_.progress(source);
    if (!progress) return;
    if (!own.has_begun) own.bridge = progress->bridge;
    own.has_begun = true;
    own.clock.write({loop_.time(), progress->clock});
  }

  /// Notes the joints of a trajectory that no controller has moved to its end.
  void note_unfollowed(Task<R>& own) noexcept {
    const auto* const wish = std::get_if<task::Follow<R>>(&own.wish);
    if (wish == nullptr) return;
    const auto follows = following();
    for (int j = 0; j < joint_count; ++j) {
      own.unfollowed[j] = !wish->trajectory->left_out()[j] && !follows[j];
    }
  }

  void stop(const Joints& joints) noexcept {
    source_.stop(reference(), joints);
    give_back_ended(TaskEnd::stopped);
  }

  /// The task that ends with the motion from a source.
  [[nodiscard]] Task<R>*& waiting(int source) noexcept {
    return waiting_[static_cast<std::size_t>(source)];
  }
  /// Ends the tasks whose motion moves no joint any more.
  void give_back_ended(TaskEnd end) noexcept {
    for (int source = 0; source < Source::source_count; ++source) {
      if (!source_.leads(source)) returns_.give_back(waiting(source), end);
    }
  }
  /// A task has begun a motion, and ends with it.
  void await(Task<R>& own, int source) noexcept {
    returns_.give_back(waiting(source), TaskEnd::replaced);
    give_back_ended(TaskEnd::replaced);
    waiting(source) = &own;
  }
  /// A task has begun a motion, and ends now.
  void finish(Task<R>& own) noexcept {
    give_back_ended(TaskEnd::replaced);
    returns_.finish(own, TaskEnd::done);
  }

  LoopType& loop_;
  TaskReturns<R>& returns_;
  const ModeControl<LoopType>& modes_;
  Source source_;
  std::array<Task<R>*, Source::source_count> waiting_{};  ///< end with their motion, by source
};

}  // namespace articula::remote
