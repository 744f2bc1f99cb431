// SPDX-License-Identifier: Apache-2.0
/// @file Following trajectories within tolerances, from the present reference and without jumps.
#pragma once

#include "articula/core/joint_state.hpp"
#include "articula/reference/trajectory/trajectory_motion.hpp"
#include "articula/reference/trajectory/trajectory_tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace articula {

/// Options of a TrajectoryFollower.
template <int N>
struct FollowerOptions {
  TrajectoryTolerances<N> tolerances{};  ///< of trajectories started without tolerances
  double speed_rate = 2;                 ///< rate of the speed override [1/s]
  double highest_speed = 1;              ///< of the speed override [1], see SpeedOverride
};

/// Follows one trajectory after the other, as ROS's joint trajectory controller does.
/// docs/references.md lists the differences.
///
///     TrajectoryFollower<Q2d> follower(loop.state().position, limits);
///     if (follower.start(trajectory) != TrajectoryOutcome::active) return 1;
///     while (follower.outcome() == TrajectoryOutcome::active) {
///       loop.reference() = follower.sample(loop.next_time());
///       if (loop.update() != Status::ok) return 1;
///       follower.check(loop.state());
///     }
///
/// The position and velocity of the reference never jump, unless the points of a trajectory do:
///
/// - A new trajectory begins with a bridge from the present reference (TrajectoryBridge).
/// - A canceled trajectory ends in the fastest stop within the limits of acceleration and jerk.
/// - A trajectory that leaves its tolerances ends likewise. Then the reference returns to the
///   measured position, so that the joints do not push against an obstacle.
/// - A stop that would pass a position limit is as much harder as necessary (JointStops): between
///   its points, a trajectory may accelerate harder than stops.
///
/// So no sample passes a position limit, to the last bit. A joint that begins outside its limits
/// moves no further out. Stops keep the velocity limit and the reference's effort. The controller
/// holds the joints and compensates gravity. For motions that need neither tolerances nor
/// replacement, sample a Trajectory directly.
/// @tparam Capacity  largest number of points of a trajectory
template <Robot R, int Capacity = 32>
class TrajectoryFollower {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  static constexpr double now = -std::numeric_limits<double>::infinity();
  using TrajectoryType = Trajectory<R, Capacity>;
  using Reference = JointReference<joint_count>;
  using Limits = MotionLimits<joint_count>;
  using Tolerances = TrajectoryTolerances<joint_count>;

  /// @param position  reference until the first trajectory, usually the measured position [rad or
  ///                  m], N x 1
  /// @param limits    of stops, returns and bridges
  /// @throws std::invalid_argument if a position is not finite, or a limit, a tolerance or the rate
  ///         is out of range; the message names joint and value
  TrajectoryFollower(const R& robot, const JointVector<joint_count>& position, const Limits& limits,
                     const FollowerOptions<joint_count>& options = {})
      : default_tolerances_(options.tolerances),
        motion_(robot, position, limits, SpeedOverride(options.speed_rate, options.highest_speed)) {
    validate(robot, limits);
    validate(robot, options.tolerances);
    for (int j = 0; j < joint_count; ++j) {
      if (is_finite(position[j])) continue;
      detail::refuse({"trajectory follower: position ", position[j], " of joint '",
                      model_of(robot).joints[j].name.view(), "' is not a finite number"});
    }
  }
  /// For a robot known at compile time.
  TrajectoryFollower(const JointVector<joint_count>& position, const Limits& limits,
                     const FollowerOptions<joint_count>& options = {})
    requires DescribedRobot<R>
      : TrajectoryFollower(R(), position, limits, options) {}

  /// Starts a trajectory. It replaces the one that is being followed or waits.
  /// @param start_time  the trajectory's time 0 on the clock of sample() [s]. `now`: the time of
  ///                    the last sample if the reference moves, of the next one if it rests. In the
  ///                    future: the present trajectory continues until then. In the past: points
  ///                    that lie in the past are skipped.
  /// @return            active, or the reason for a refusal, which changes nothing; refusal() has
  ///                    the numbers. old_header_timestamp: all points lie in the past.
  ///                    invalid_goal: tolerances or start time are invalid, or no point can be
  ///                    reached in time.
  /// Real-time: yes. O(N Capacity).
  [[nodiscard]] TrajectoryOutcome start(const TrajectoryType& trajectory,
                                        const Tolerances& tolerances,
                                        double start_time = now) noexcept {
    refusal_ = refusal_of(tolerances);
    if (!refusal_.what.empty()) return TrajectoryOutcome::invalid_goal;
    if (start_time != now && !is_finite(start_time)) {
      refusal_ = {.what = "start_time", .value = start_time, .rule = "is not a finite number"};
      return TrajectoryOutcome::invalid_goal;
    }
    const bool begun = start_time == now || (clock_runs_ && start_time <= time_);
    const double own_time = start_time == now || !clock_runs_ ? 0 : time_ - start_time;
    if (is_past(trajectory, own_time)) return TrajectoryOutcome::old_header_timestamp;
    const auto bridge = motion_.bridge_to(trajectory, own_time, refusal_);
    if (begun && motion_.can_begin() && !bridge) return TrajectoryOutcome::invalid_goal;
    refusal_ = {};
    if (begun && motion_.can_begin() && motion_.moves()) {
      begin(trajectory, tolerances, *bridge);
      waiting_.reset();
    } else {
      waiting_.emplace(trajectory, tolerances, start_time);  // no copy on the stack
    }
    return outcome_ = TrajectoryOutcome::active;
  }
  /// The same with the tolerances of the options. Real-time: yes.
  [[nodiscard]] TrajectoryOutcome start(const TrajectoryType& trajectory) noexcept {
    return start(trajectory, default_tolerances_);
  }

  /// Goes on from the reference of another source: drops what was followed, and begins the fastest
  /// stop. A trajectory that is started then begins from there, without a jump, at the requested
  /// speed.
  /// @param reference  finite
  /// @param time       of that reference, on the clock of sample() [s]
  /// Real-time: yes. O(N).
  void take_over(const Reference& reference, double time) noexcept {
    outcome_ = TrajectoryOutcome::idle;
    watched_ = false;
    waiting_.reset();
    motion_.take_over(reference);
    clock_runs_ = true;
    time_ = time;
  }

  /// Ends the present or waiting trajectory by the fastest stop. Real-time: yes.
  void cancel() noexcept {
    if (outcome_ == TrajectoryOutcome::active) abort(TrajectoryOutcome::canceled);
  }

  /// Requests a speed: 1 as planned, 0 pause; see SpeedOverride. Real-time: yes.
  void set_speed(double speed) noexcept { motion_.speed().set(speed); }
  /// The present speed. Real-time: yes.
  [[nodiscard]] double speed() const noexcept { return motion_.speed().speed(); }

  /// Moves on to a time and returns the reference there. Call it once a cycle: the reference skips
  /// what lies between two samples. The first call sets the clock. A time that is not finite, or
  /// earlier than the one before, changes nothing.
  /// @param time  [s]
  /// Real-time: yes. O(N log Capacity), O(N Capacity) when a trajectory begins.
  [[nodiscard]] Reference sample(double time) noexcept {
    if (!is_finite(time)) return reference();
    const double before = clock_runs_ ? time_ : time;
    double period = std::max(0.0, time - before);
    clock_runs_ = true;
    time_ = time;
    if (waiting_ && waiting_->start_time <= time && motion_.can_begin()) {
      const double until = waiting_->start_time == now && !motion_.moves()
                               ? period
                               : std::clamp(waiting_->start_time - before, 0.0, period);
      motion_.advance(until);
      period -= until;
      begin_waiting(before + until);
    }
    motion_.advance(period);
    return reference();
  }

  /// Compares a measured state with the last sample. Call it once for each sample. Before the end
  /// of the trajectory, a joint outside its path tolerance aborts it. After the end, the trajectory
  /// succeeds once all joints are within the goal tolerances, and fails after goal_time. NaN is out
  /// of tolerance.
  /// @param state  measured at the time of the last sample; position and velocity are used
  /// @return       outcome()
  /// Real-time: yes. O(N).
  TrajectoryOutcome check(const JointState<joint_count>& state) noexcept {
    if (outcome_ != TrajectoryOutcome::active) return outcome_;
    JointVector<joint_count> error = reference().position - state.position;
    for (int j = 0; j < joint_count; ++j) {
      const double turn = motion_.range().turn[j];
      if (turn > 0) error[j] = std::remainder(error[j], turn);
    }
    const JointVector<joint_count> velocity_error = reference().velocity - state.velocity;
    if (motion_.moves()) {
      if (watched_ && (!within_tolerance(error, tolerances_.path_position) ||
                       !within_tolerance(velocity_error, tolerances_.path_velocity))) {
        refusal_ = {};  // of another trajectory
        abort(TrajectoryOutcome::path_tolerance_violated, reference().position - error);
      }
    } else if (!waiting_) {
      if (within_tolerance(error, tolerances_.goal_position) &&
          within_tolerance(velocity_error, tolerances_.stopped_velocity)) {
        outcome_ = TrajectoryOutcome::successful;
      } else if (tolerances_.goal_time > 0 && motion_.time_at_rest() > tolerances_.goal_time) {
        refusal_ = {};
        abort(TrajectoryOutcome::goal_tolerance_violated, reference().position - error);
      }
    }
    return outcome_;
  }

  /// The outcome of the last trajectory that was started. Real-time: yes.
  [[nodiscard]] TrajectoryOutcome outcome() const noexcept { return outcome_; }
  /// The reason for the last refusal by start(), or for the failure of a waiting trajectory to
  /// begin. `to_string(robot, follower.refusal())` formats it. Real-time: yes.
  [[nodiscard]] const TrajectoryRefusal& refusal() const noexcept { return refusal_; }
  /// Where the last sample lies on the present trajectory.
  struct Progress {
    SpeedOverride clock{};                   ///< the trajectory's own time
    TrajectoryBridge<joint_count> bridge{};  ///< into the trajectory
  };
  /// None while the trajectory waits for its start. Real-time: yes.
  [[nodiscard]] std::optional<Progress> progress() const noexcept {
    if (waiting_) return std::nullopt;
    return Progress{motion_.speed(), motion_.bridge()};
  }
  /// Whether the reference moves. Real-time: yes.
  [[nodiscard]] bool moves() const noexcept { return motion_.moves(); }
  /// The last sample. Real-time: yes.
  [[nodiscard]] const Reference& reference() const noexcept { return motion_.reference(); }

 private:
  struct Waiting {
    TrajectoryType trajectory;
    Tolerances tolerances;
    double start_time;
  };

  [[nodiscard]] bool is_past(const TrajectoryType& trajectory, double own_time) noexcept {
    if (trajectory.duration() > own_time) return false;
    refusal_ = {.what = "the last point's time_from_start",
                .value = trajectory.duration(),
                .rule = "has passed"};
    return true;
  }

  void begin(const TrajectoryType& trajectory, const Tolerances& tolerances,
             const TrajectoryBridge<joint_count>& bridge) noexcept {
    motion_.begin(trajectory, bridge);
    tolerances_ = tolerances;
    watched_ = true;
  }

  void begin_waiting(double time) noexcept {
    const double start = waiting_->start_time == now ? time : waiting_->start_time;
    if (const auto bridge = motion_.bridge_to(waiting_->trajectory, time - start, refusal_)) {
      refusal_ = {};
      begin(waiting_->trajectory, waiting_->tolerances, *bridge);
      waiting_.reset();
    } else {
      const bool late = is_past(waiting_->trajectory, time - start);
      abort(late ? TrajectoryOutcome::old_header_timestamp : TrajectoryOutcome::invalid_goal);
    }
  }

  /// Stops, and then returns to the measured position, if it is known.
  void abort(TrajectoryOutcome outcome,
             const JointVector<joint_count>& measured = JointStops<R>::nowhere()) noexcept {
    outcome_ = outcome;
    watched_ = false;
    waiting_.reset();
    motion_.stop(is_finite(measured) ? measured : JointStops<R>::nowhere());
  }

  Tolerances default_tolerances_;
  Tolerances tolerances_{};
  TrajectoryMotion<R, Capacity> motion_;
  std::optional<Waiting> waiting_{};
  bool watched_ = false;  ///< the motion is that of a trajectory, or the stop at its end
  bool clock_runs_ = false;
  double time_ = 0;
  TrajectoryOutcome outcome_ = TrajectoryOutcome::idle;
  TrajectoryRefusal refusal_{};
};

}  // namespace articula
