// SPDX-License-Identifier: Apache-2.0
/// @file The sources of a remote loop's reference, of which one at a time is active.
#pragma once

#include "articula/reference/joint_signals.hpp"
#include "articula/reference/trajectory/trajectory_follower.hpp"
#include "articula/remote/engine/go_motion.hpp"
#include "articula/remote/engine/motion_kind.hpp"
#include "articula/remote/engine/set_motion.hpp"

namespace articula::remote {

/// The largest number of points of a trajectory. Planners as MoveIt make ten a second, so this is a
/// motion of 100 s. A follower for six joints takes 600 kB with it.
inline constexpr int trajectory_capacity = 1024;

/// The sources of a loop's reference: rest, profile, setting, trajectory, signals, stop. One at a
/// time is active. Each begins at the present reference, in motion or not, so the reference does not
/// jump. The exceptions are requests for a jump: a setting, a step, a square.
///
/// In the loop's thread. Real-time: yes, all functions but the constructor.
template <Robot R>
class ReferenceSource {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Reference = JointReference<joint_count>;
  using Follower = TrajectoryFollower<R, trajectory_capacity>;
  using Signals = JointSignals<R>;
  using Tolerances = TrajectoryTolerances<joint_count>;

  /// At rest.
  /// @param limits      of profiles and stops
  /// @param tolerances  of trajectories
  /// @throws std::invalid_argument naming joint, limit and value
  ReferenceSource(const R& robot, const MotionLimits<joint_count>& limits,
                  const TrajectoryTolerances<joint_count>& tolerances)
      : tolerances_(tolerances),
        follower_(robot, JointVector<joint_count>::Zero(), limits, {.tolerances = tolerances}),
        stop_(robot, JointVector<joint_count>::Zero(), limits),
        go_(robot, limits),
        set_(robot, limits) {
    validate(robot, both_ways(limits));
  }

  [[nodiscard]] MotionKind kind() const noexcept { return kind_; }

  /// Ends any motion at once: for loops that set their reference themselves.
  void rest() noexcept { kind_ = MotionKind::rest; }

  /// Begins the fastest stop, and then a motion to a position, see StopAndReturn.
  void stop(const Reference& from,
            const JointVector<joint_count>& back = StopAndReturn<R>::unknown()) noexcept {
    stop_.begin(from, back);
    kind_ = MotionKind::stop;
  }

  /// Begins a motion to positions, see GoMotion. Joints without a number go on to the target of a
  /// present motion of this kind.
  void go(const Reference& from, JointVector<joint_count> target, double speed) noexcept {
    for (int j = 0; j < joint_count; ++j) {
      if (!is_finite(target[j]) && kind_ == MotionKind::go) target[j] = go_.target()[j];
    }
    go_.begin(from, target, speed);
    kind_ = MotionKind::go;
  }

  /// Sets the reference of some joints, see SetMotion.
  void set(const Reference& from, const JointSetting<joint_count>& setting) noexcept {
    if (kind_ != MotionKind::set) set_.begin(from);
    set_.set(from, setting);
    kind_ = MotionKind::set;
  }

  /// Begins a trajectory.
  /// @param tolerances  in addition to the configured ones, see `overridden`
  /// @param delay       until its time 0 [s]; without it, it begins at once
  /// @return active, or the reason of a refusal, see refusal(); the present motion then goes on
  [[nodiscard]] TrajectoryOutcome follow(const Reference& from,
                                         const Trajectory<R, trajectory_capacity>& trajectory,
                                         const Tolerances& tolerances,
                                         std::optional<double> delay = {}) noexcept {
    if (kind_ != MotionKind::trajectory) follower_.take_over(from, time_);
    const double start = delay ? time_ + *delay : Follower::now;
    const TrajectoryOutcome outcome =
        follower_.start(trajectory, overridden(tolerances_, tolerances), start);
    if (outcome == TrajectoryOutcome::active) kind_ = MotionKind::trajectory;
    return outcome;
  }
  /// How fast trajectories are followed, see SpeedOverride.
  /// @param factor  0 (pause) .. 1 (as planned)
  void set_trajectory_speed(double factor) noexcept {
    trajectory_speed_ = factor;
    follower_.set_speed(factor);
  }
  [[nodiscard]] double trajectory_speed() const noexcept { return trajectory_speed_; }
  /// Why the last trajectory was refused or has failed.
  [[nodiscard]] const TrajectoryRefusal& refusal() const noexcept { return follower_.refusal(); }

  /// Begins signals around a reference, after its stop if it moves. They end by a motion back.
  /// @param signals   valid until they have ended
  /// @param duration  [s]
  void play(const Reference& from, Signals& signals, double duration) noexcept {
    stop_.begin(from);
    signals_ = &signals;
    signals_->set_around({.position = from.position, .effort = from.effort});
    duration_ = duration;
    played_ = 0;
    kind_ = MotionKind::signals;
  }

  /// The reference one period later.
  /// @param present  the reference of the last cycle
  [[nodiscard]] Reference next(const Reference& present, double period) noexcept {
    time_ += period;
    switch (kind_) {
      case MotionKind::rest:
        break;
      case MotionKind::go: {
        const Reference reference = go_.advance(period);
        if (!go_.moves()) rest();
        return reference;
      }
      case MotionKind::set: {
        const Reference reference = set_.advance(period);
        if (!set_.moves()) rest();
        return reference;
      }
      case MotionKind::trajectory:
        return follower_.sample(time_);
      case MotionKind::signals: {
        if (stop_.moves()) {
          const Reference reference = stop_.advance(period);
          signals_->set_around(reference);
          return reference;
        }
        played_ += period;
        if (played_ < duration_) return signals_->sample(played_);
        stop(present, signals_->around().position);
        [[fallthrough]];
      }
      case MotionKind::stop: {
        const Reference reference = stop_.advance(period);
        if (!stop_.moves()) rest();
        return reference;
      }
    }
    return present;
  }

  /// Compares the state that was measured for the last reference with a trajectory's tolerances.
  /// @return the outcome of the trajectory; idle if none is followed
  [[nodiscard]] TrajectoryOutcome check(const JointState<joint_count>& state) noexcept {
    if (kind_ != MotionKind::trajectory) return TrajectoryOutcome::idle;
    const TrajectoryOutcome outcome = follower_.check(state);
    if (outcome != TrajectoryOutcome::active && !follower_.moves()) rest();
    return outcome;
  }

 private:
  MotionKind kind_ = MotionKind::rest;
  double time_ = 0;  ///< the clock of trajectories [s]
  Tolerances tolerances_;
  Follower follower_;
  StopAndReturn<R> stop_;
  GoMotion<R> go_;
  SetMotion<R> set_;
  Signals* signals_ = nullptr;
  double duration_ = 0;          ///< of the signals [s]
  double played_ = 0;            ///< since their beginning [s]
  double trajectory_speed_ = 1;  ///< as asked for
};

}  // namespace articula::remote
