// SPDX-License-Identifier: Apache-2.0
/// @file Following trajectories: from the present command, watched, and without jumps.
#pragma once

#include "articula/core/joint_state.hpp"
#include "articula/reference/jerk_limited_profile.hpp"
#include "articula/reference/speed_override.hpp"
#include "articula/reference/trajectory.hpp"
#include "articula/reference/trajectory_bridge.hpp"
#include "articula/reference/trajectory_tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace articula {

/// What a follower has besides its motion limits.
template <int N>
struct FollowerOptions {
  TrajectoryTolerances<N> tolerances{};  ///< of trajectories that bring none
  double speed_rate = 2;                 ///< how fast the speed override changes [1/s]
};

/// Follows one trajectory after the other, as ROS's joint trajectory controller does; what differs
/// is listed in docs/references.md.
///
///     TrajectoryFollower<Q2d> follower(loop.state().position, limits);
///     if (follower.start(trajectory) != TrajectoryOutcome::active) return 1;
///     while (follower.outcome() == TrajectoryOutcome::active) {
///       loop.reference() = follower.sample(loop.next_time());
///       if (loop.update() != Status::ok) return 1;
///       follower.check(loop.state());
///     }
///
/// Whatever happens, the reference's position and velocity go on without a jump, unless the points
/// of a trajectory themselves jump: a new trajectory is entered by a bridge (TrajectoryBridge); a
/// trajectory that is canceled ends in the fastest stop within the limits of acceleration and jerk;
/// one that leaves its tolerances likewise, and then goes back to where the joints were measured,
/// so that nothing is pushed against. The reference's effort stays. It never lets go of the
/// joints: all it makes is a reference, and gravity is the controller's part.
/// @tparam R         the robot
/// @tparam Capacity  most points of a trajectory
template <Robot R, int Capacity = 32>
class TrajectoryFollower {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  static constexpr double now = -std::numeric_limits<double>::infinity();
  using TrajectoryType = Trajectory<R, Capacity>;
  using Reference = JointReference<joint_count>;
  using Limits = MotionLimits<joint_count>;
  using Tolerances = TrajectoryTolerances<joint_count>;

  /// @param position  where the joints are asked to be until the first trajectory, usually where
  ///                  they are measured [rad or m], N x 1
  /// @param limits    of stops, ways back and bridges
  /// @throws std::invalid_argument if a position is not finite, or a limit, a tolerance or the rate
  ///         is out of range; the message names joint and value
  TrajectoryFollower(const JointVector<joint_count>& position, const Limits& limits,
                     const FollowerOptions<joint_count>& options = {},
                     const R& robot = described<R>())
      : limits_(limits),
        set_tolerances_(options.tolerances),
        speed_(options.speed_rate),
        rest_(JerkLimitedProfile<R>::move(position, position, limits)) {
    validate(limits, robot);
    validate(options.tolerances, robot);
    for (int j = 0; j < joint_count; ++j) {
      const JointProperties& joint = model_of(robot).joints[static_cast<std::size_t>(j)];
      if (!is_finite(position[j])) {
        detail::refuse("trajectory follower: position ", position[j], " of joint '",
                       joint.name.view(), "' is not a finite number");
      }
      turn_[j] = joint.type == JointType::continuous ? 2 * std::numbers::pi : 0;
    }
    reference_.position = position;
  }

  /// Starts a trajectory in place of the one that is followed or waits.
  /// @param start_time  when its time 0 is, on the clock of sample() [s]; `now`: in motion at the
  ///                    last sample, at rest at the next one. In the future: what is followed
  ///                    goes on until then. In the past: points that lie in the past are left out.
  /// @return            active, or why it was refused and nothing has changed: old_header_timestamp
  ///                    if no point lies ahead, invalid_goal if tolerances or start time are no
  ///                    good or no point can be reached in time
  /// Real-time: yes. O(N Capacity).
  [[nodiscard]] TrajectoryOutcome start(const TrajectoryType& trajectory,
                                        const Tolerances& tolerances,
                                        double start_time = now) noexcept {
    if (!is_valid(tolerances) || (start_time != now && !is_finite(start_time))) {
      return TrajectoryOutcome::invalid_goal;
    }
    const bool begun = start_time == now || (clock_runs_ && start_time <= time_);
    const double own_time = start_time == now || !clock_runs_ ? 0 : time_ - start_time;
    if (trajectory.duration() <= own_time) return TrajectoryOutcome::old_header_timestamp;
    const auto bridge = bridge_to(trajectory, own_time);
    if (begun && can_begin() && !bridge) return TrajectoryOutcome::invalid_goal;
    if (begun && can_begin() && moves()) {
      begin(trajectory, tolerances, *bridge);
      waiting_.reset();
    } else {
      waiting_.emplace(Waiting{trajectory, tolerances, start_time});
    }
    return outcome_ = TrajectoryOutcome::active;
  }
  /// The same with the tolerances of the options. Real-time: yes.
  [[nodiscard]] TrajectoryOutcome start(const TrajectoryType& trajectory) noexcept {
    return start(trajectory, set_tolerances_);
  }

  /// Ends what is followed or waits by the fastest stop. Real-time: yes.
  void cancel() noexcept {
    if (outcome_ == TrajectoryOutcome::active) abort(TrajectoryOutcome::canceled);
  }

  /// Asks for a speed: 1 as planned, 0 pause; see SpeedOverride. Real-time: yes.
  void set_speed(double speed) noexcept { speed_.set(speed); }
  /// The speed at this moment. Real-time: yes.
  [[nodiscard]] double speed() const noexcept { return speed_.speed(); }

  /// Moves on to a time and returns the reference there; to be called once a cycle, for what lies
  /// between two samples is left out. The first call sets the clock. A time that is not finite, or
  /// earlier than the one before, stands still.
  /// @param time  [s]
  /// Real-time: yes. O(N log Capacity), O(N Capacity) when a trajectory begins.
  [[nodiscard]] Reference sample(double time) noexcept {
    if (!is_finite(time)) return reference_;
    const double before = clock_runs_ ? time_ : time;
    double period = std::max(0.0, time - before);
    clock_runs_ = true;
    time_ = time;
    if (waiting_ && waiting_->start_time <= time && can_begin()) {
      const double until = waiting_->start_time == now && !moves()
                               ? period
                               : std::clamp(waiting_->start_time - before, 0.0, period);
      advance(until);
      period -= until;
      begin_waiting(before + until);
    }
    advance(period);
    return reference_;
  }

  /// Compares what was measured with the last sample; to be called once for each. On the way: a
  /// joint that is off by more than a path tolerance ends the trajectory. After it: all joints
  /// within the goal tolerances end it well; if they are not after goal_time, they never will be.
  /// NaN is out of tolerance wherever there is one.
  /// @param state  measured at the time of the last sample; position and velocity are used
  /// @return       outcome()
  /// Real-time: yes. O(N).
  TrajectoryOutcome check(const JointState<joint_count>& state) noexcept {
    if (outcome_ != TrajectoryOutcome::active) return outcome_;
    JointVector<joint_count> error = reference_.position - state.position;
    for (int j = 0; j < joint_count; ++j) {
      if (turn_[j] > 0) error[j] = std::remainder(error[j], turn_[j]);
    }
    const JointVector<joint_count> velocity_error = reference_.velocity - state.velocity;
    if (moves()) {
      if (!watched_) return outcome_;
      if (!within(error, tolerances_.path_position) ||
          !within(velocity_error, tolerances_.path_velocity)) {
        abort(TrajectoryOutcome::path_tolerance_violated, reference_.position - error);
      }
    } else if (!waiting_) {
      const double late = speed_.time() - trajectory_->duration() - rest_.duration();
      if (within(error, tolerances_.goal_position) &&
          within(velocity_error, tolerances_.stopped_velocity)) {
        outcome_ = TrajectoryOutcome::successful;
      } else if (tolerances_.goal_time > 0 && late > tolerances_.goal_time) {
        abort(TrajectoryOutcome::goal_tolerance_violated, reference_.position - error);
      }
    }
    return outcome_;
  }

  /// What became of the last trajectory that was started. Real-time: yes.
  [[nodiscard]] TrajectoryOutcome outcome() const noexcept { return outcome_; }
  /// The last sample. Real-time: yes.
  [[nodiscard]] const Reference& reference() const noexcept { return reference_; }

 private:
  struct Waiting {
    TrajectoryType trajectory;
    Tolerances tolerances;
    double start_time;
  };

  [[nodiscard]] static bool within(const JointVector<joint_count>& error,
                                   const JointVector<joint_count>& tolerance) noexcept {
    for (int j = 0; j < joint_count; ++j) {
      const bool good = is_finite(error[j]) && std::abs(error[j]) <= tolerance[j];
      if (tolerance[j] > 0 && !good) return false;
    }
    return true;
  }

  /// A stop runs in real time, a trajectory in its own. While the latter all but stands still, the
  /// motion of the former cannot be taken over.
  [[nodiscard]] bool can_begin() const noexcept {
    return following_ || !moves() || speed_.speed() >= 0.01;
  }

  [[nodiscard]] bool moves() const noexcept { return following_ || rest_time_ < rest_.duration(); }

  [[nodiscard]] auto bridge_to(const TrajectoryType& trajectory, double own_time) const noexcept {
    return find_bridge(speed_.unapply(reference_), trajectory, own_time, limits_, turn_);
  }

  void begin(const TrajectoryType& trajectory, const Tolerances& tolerances,
             const TrajectoryBridge<joint_count>& bridge) noexcept {
    trajectory_ = trajectory;
    tolerances_ = tolerances;
    bridge_ = bridge;
    speed_.restart(bridge.from.time_from_start);
    following_ = watched_ = true;
    way_back_.reset();
  }

  void begin_waiting(double time) noexcept {
    const double start = waiting_->start_time == now ? time : waiting_->start_time;
    if (const auto bridge = bridge_to(waiting_->trajectory, time - start)) {
      begin(waiting_->trajectory, waiting_->tolerances, *bridge);
      waiting_.reset();
    } else {
      const bool late = waiting_->trajectory.duration() <= time - start;
      abort(late ? TrajectoryOutcome::old_header_timestamp : TrajectoryOutcome::invalid_goal);
    }
  }

  /// Stops, and then goes to where the joints were measured, if that is known.
  void abort(TrajectoryOutcome outcome,
             const std::optional<JointVector<joint_count>>& measured = {}) noexcept {
    outcome_ = outcome;
    watched_ = false;
    waiting_.reset();
    way_back_ = measured && is_finite(*measured) ? measured : std::nullopt;
    rest_from(reference_);
  }

  void rest_from(const Reference& reference) noexcept {
    following_ = false;
    rest_ = JerkLimitedProfile<R>::stop(reference, limits_);
    rest_time_ = 0;
  }

  void advance(double period) noexcept {
    speed_.advance(period);
    if (following_) {
      const double beyond = speed_.time() - trajectory_->duration();
      if (beyond < 0) {
        reference_ = speed_.apply(bridge_->sample(*trajectory_, speed_.time()));
        return;
      }
      Reference last = at_point(trajectory_->points().back());
      last.position += bridge_->shift;
      rest_from(speed_.apply(last));
      period = speed_.speed() > 0 ? std::min(period, beyond / speed_.speed()) : 0;
    }
    rest_time_ += period;
    if (way_back_ && rest_time_ >= rest_.duration()) {
      rest_time_ -= rest_.duration();
      const Reference here = rest_.sample(rest_.duration());
      rest_ = JerkLimitedProfile<R>::move(here.position, *way_back_, limits_, here.effort);
      way_back_.reset();
    }
    reference_ = rest_.sample(rest_time_);
  }

  Limits limits_;
  Tolerances set_tolerances_;
  Tolerances tolerances_{};
  JointVector<joint_count> turn_ = JointVector<joint_count>::Zero();  ///< 2 pi where it is the same

  SpeedOverride speed_;  ///< its time is the trajectory's own
  std::optional<TrajectoryType> trajectory_{};
  std::optional<TrajectoryBridge<joint_count>> bridge_{};
  std::optional<Waiting> waiting_{};
  bool following_ = false;
  bool watched_ = false;  ///< the motion is a trajectory's, or the stop at its end

  JerkLimitedProfile<R> rest_;  ///< where there is no trajectory: the stop, or the way back
  double rest_time_ = 0;
  std::optional<JointVector<joint_count>> way_back_{};  ///< where to go after the stop

  bool clock_runs_ = false;
  double time_ = 0;
  Reference reference_{};
  TrajectoryOutcome outcome_ = TrajectoryOutcome::idle;
};

}  // namespace articula
