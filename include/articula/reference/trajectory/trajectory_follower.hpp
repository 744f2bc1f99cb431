// SPDX-License-Identifier: Apache-2.0
/// @file Following trajectories: from the present command, watched, and without jumps.
#pragma once

#include "articula/core/joint_state.hpp"
#include "articula/core/refuse.hpp"
#include "articula/motion/motion_limits.hpp"
#include "articula/reference/speed_override.hpp"
#include "articula/reference/stop_and_return.hpp"
#include "articula/reference/trajectory/joint_tracks.hpp"
#include "articula/reference/trajectory/trajectory.hpp"
#include "articula/reference/trajectory/trajectory_bridge.hpp"
#include "articula/reference/trajectory/trajectory_tolerances.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>

namespace articula {

/// What a follower has besides its motion limits.
template <int N>
struct FollowerOptions {
  TrajectoryTolerances<N> tolerances{};  ///< of trajectories that bring none
  double speed_rate = 2;                 ///< how fast the speed override changes [1/s]
  double highest_speed = 1;              ///< of the speed override [1], see SpeedOverride
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
/// so that nothing is pushed against. A stop that would be longer than the way to a joint's limit
/// is as much harder as it takes to end there: between its points a trajectory may have higher
/// accelerations than stops. So no position limit is passed, to the last bit, and who begins beyond
/// one goes no further; nor does a stop get faster than the velocity limit, or than it began. The
/// reference's effort stays. The follower never lets go of the joints: all it makes is a reference,
/// and gravity is the controller's part.
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

  /// @param robot     whose joints these are
  /// @param position  where the joints are asked to be until the first trajectory, usually where
  ///                  they are measured [rad or m], N x 1
  /// @param limits    of stops, ways back and bridges
  /// @throws std::invalid_argument if a position is not finite, or a limit, a tolerance or the rate
  ///         is out of range; the message names joint and value
  TrajectoryFollower(const R& robot, const JointVector<joint_count>& position, const Limits& limits,
                     const FollowerOptions<joint_count>& options = {})
      : limits_(limits),
        set_tolerances_(options.tolerances),
        range_{joint_values(robot, [](const auto& joint) { return joint.limits.lower; }),
               joint_values(robot, [](const auto& joint) { return joint.limits.upper; }),
               JointVector<joint_count>::Zero()},
        speed_(options.speed_rate, options.highest_speed),
        rest_(robot, position, limits) {
    validate(robot, limits);
    validate(robot, options.tolerances);
    for (int j = 0; j < joint_count; ++j) {
      const JointProperties& joint = model_of(robot).joints[static_cast<std::size_t>(j)];
      if (!is_finite(position[j])) {
        detail::refuse({"trajectory follower: position ", position[j], " of joint '",
                        joint.name.view(), "' is not a finite number"});
      }
      range_.turn[j] = joint.type == JointType::continuous ? 2 * std::numbers::pi : 0;
    }
    reference_.position = position;
  }
  /// For a robot known at compile time.
  TrajectoryFollower(const JointVector<joint_count>& position, const Limits& limits,
                     const FollowerOptions<joint_count>& options = {})
    requires DescribedRobot<R>
      : TrajectoryFollower(R(), position, limits, options) {}

  /// Starts a trajectory in place of the one that is followed or waits.
  /// @param start_time  when its time 0 is, on the clock of sample() [s]; `now`: in motion at the
  ///                    last sample, at rest at the next one. In the future: what is followed
  ///                    goes on until then. In the past: points that lie in the past are left out.
  /// @return            active, or why it was refused and nothing has changed: old_header_timestamp
  ///                    if no point lies ahead, invalid_goal if tolerances or start time are no
  ///                    good or no point can be reached in time; refusal() has the figures
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
    const auto bridge = bridge_to(trajectory, own_time);
    if (begun && can_begin() && !bridge) return TrajectoryOutcome::invalid_goal;
    refusal_ = {};
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
      if (range_.turn[j] > 0) error[j] = std::remainder(error[j], range_.turn[j]);
    }
    const JointVector<joint_count> velocity_error = reference_.velocity - state.velocity;
    if (moves()) {
      if (!watched_) return outcome_;
      if (!within(error, tolerances_.path_position) ||
          !within(velocity_error, tolerances_.path_velocity)) {
        abort(TrajectoryOutcome::path_tolerance_violated, reference_.position - error);
      }
    } else if (!waiting_) {
      if (within(error, tolerances_.goal_position) &&
          within(velocity_error, tolerances_.stopped_velocity)) {
        outcome_ = TrajectoryOutcome::successful;
      } else if (tolerances_.goal_time > 0 && speed_.time() - arrival_ > tolerances_.goal_time) {
        abort(TrajectoryOutcome::goal_tolerance_violated, reference_.position - error);
      }
    }
    return outcome_;
  }

  /// What became of the last trajectory that was started. Real-time: yes.
  [[nodiscard]] TrajectoryOutcome outcome() const noexcept { return outcome_; }
  /// Why the last start() was refused, or why what it had accepted could not begin when it was due;
  /// `to_string(robot, follower.refusal())` is a line of it. Real-time: yes.
  [[nodiscard]] const TrajectoryRefusal& refusal() const noexcept { return refusal_; }
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

  /// A stop runs in real time, a trajectory in its own. A motion of the former that is beyond the
  /// limits in the latter, which may all but stand still, is not taken over: it would be beyond
  /// them when the speed rises.
  [[nodiscard]] bool can_begin() const noexcept {
    if (!rest_.moves()) return true;
    const Reference own = speed_.unapply(reference_);
    const auto keeps = [](double motion, double limit) {
      return std::abs(motion) <= limit * (1 + 1e-9);  // rounding
    };
    for (int j = 0; j < joint_count; ++j) {
      if (tracks_.follows(j)) continue;
      if (!keeps(own.velocity[j], limits_.velocity[j]) ||
          !keeps(own.acceleration[j], limits_.acceleration[j])) {
        return false;
      }
    }
    return speed_.speed() > 0;
  }

  [[nodiscard]] bool moves() const noexcept { return tracks_.any() || rest_.moves(); }

  /// The last sample in the trajectory's time.
  [[nodiscard]] Reference present() const noexcept {
    Reference own = speed_.unapply(reference_);
    // While the speed is all but 0, a division by its square would leave nothing but rounding.
    if (speed_.speed() > 0) take_over(own, own_, [&](int j) { return tracks_.follows(j); });
    return own;
  }

  [[nodiscard]] bool is_past(const TrajectoryType& trajectory, double own_time) noexcept {
    if (trajectory.duration() > own_time) return false;
    refusal_ = {.what = "the last point's time_from_start",
                .value = trajectory.duration(),
                .rule = "has passed"};
    return true;
  }

  [[nodiscard]] auto bridge_to(const TrajectoryType& trajectory, double own_time) noexcept {
    // A joint that is left out stays where the points have it, so that it limits no bridge.
    const auto left_out = [&](int j) { return trajectory.leaves_out(j); };
    Reference from = present();
    take_over(from, Reference{.position = trajectory.points().front().position}, left_out);
    return find_bridge(from, trajectory, own_time, limits_, range_, refusal_);
  }

  void begin(const TrajectoryType& trajectory, const Tolerances& tolerances,
             const TrajectoryBridge<joint_count>& bridge) noexcept {
    own_ = present();
    tracks_.begin(trajectory, bridge, speed_.time());
    tolerances_ = tolerances;
    speed_.restart(bridge.from.time_from_start);
    watched_ = true;
    if (rest_.moves()) let_rest(reference_, [&](int j) { return tracks_.follows(j); });
  }

  /// Lets the joints go on to rest from a reference.
  /// @param is_new  says of a joint whether it was not on its way to rest before: then it has none
  ///                to go, and rests where its stop ends, or does not move if it follows a track
  template <class IsNew>
  void let_rest(Reference from, IsNew is_new) noexcept {
    auto target = rest_.target();
    for (int j = 0; j < joint_count; ++j) {
      if (is_new(j)) target[j] = std::numeric_limits<double>::quiet_NaN();
      if (tracks_.follows(j)) from.velocity[j] = from.acceleration[j] = 0;
    }
    rest_.begin(from, target);
  }

  /// Sets the figures of those joints that a condition says to those of another reference.
  template <class Condition>
  static void take_over(Reference& to, const Reference& from, Condition condition) noexcept {
    for (int j = 0; j < joint_count; ++j) {
      if (!condition(j)) continue;
      to.position[j] = from.position[j];
      to.velocity[j] = from.velocity[j];
      to.acceleration[j] = from.acceleration[j];
      to.effort[j] = from.effort[j];
    }
  }

  void begin_waiting(double time) noexcept {
    const double start = waiting_->start_time == now ? time : waiting_->start_time;
    if (const auto bridge = bridge_to(waiting_->trajectory, time - start)) {
      refusal_ = {};
      begin(waiting_->trajectory, waiting_->tolerances, *bridge);
      waiting_.reset();
    } else {
      const bool late = is_past(waiting_->trajectory, time - start);
      abort(late ? TrajectoryOutcome::old_header_timestamp : TrajectoryOutcome::invalid_goal);
    }
  }

  /// Stops, and then goes to where the joints were measured, if that is known.
  void abort(TrajectoryOutcome outcome,
             const std::optional<JointVector<joint_count>>& measured = {}) noexcept {
    outcome_ = outcome;
    watched_ = false;
    waiting_.reset();
    tracks_.clear();
    rest_.begin(reference_, measured && is_finite(*measured) ? measured : std::nullopt);
  }

  void advance(double period) noexcept {
    speed_.advance(period);
    const auto lowest = range_.lower.cwiseMin(reference_.position).eval();
    const auto highest = range_.upper.cwiseMax(reference_.position).eval();
    for (double end = tracks_.first_end(); end <= speed_.time(); end = tracks_.first_end()) {
      const double speed = speed_.speed();
      const double after = speed > 0 ? std::min(period, (speed_.time() - end) / speed) : 0;
      end_tracks(end, rest_.advance(period - after));
      arrival_ = end;
      period = after;
    }
    reference_ = rest_.advance(period);
    if (tracks_.any()) {
      tracks_.sample(speed_.time(), own_);
      own_.position = own_.position.cwiseMax(lowest).cwiseMin(highest);  // rounding
      take_over(reference_, speed_.apply(own_), [&](int j) { return tracks_.follows(j); });
    }
    if (rest_.moves()) arrival_ = speed_.time();
  }

  /// The joints whose tracks end begin their stops; the others go on.
  void end_tracks(double end, Reference resting) noexcept {
    std::array<bool, static_cast<std::size_t>(joint_count)> followed{};
    for (int j = 0; j < joint_count; ++j)
      followed[static_cast<std::size_t>(j)] = tracks_.follows(j);
    Reference last;
    tracks_.end(end, last);
    const auto ends = [&](int j) {
      return followed[static_cast<std::size_t>(j)] && !tracks_.follows(j);
    };
    take_over(resting, speed_.apply(last), ends);
    let_rest(resting, ends);
  }

  Limits limits_;
  Tolerances set_tolerances_;
  Tolerances tolerances_{};
  JointRange<joint_count> range_;

  SpeedOverride speed_;  ///< its time is the trajectory's own
  JointTracks<R, Capacity> tracks_{};
  std::optional<Waiting> waiting_{};
  bool watched_ = false;  ///< the motion is a trajectory's, or the stop at its end

  StopAndReturn<R> rest_;  ///< of joints that follow no trajectory
  double arrival_ = 0;     ///< when the motion ended, in the trajectory's time

  bool clock_runs_ = false;
  double time_ = 0;
  Reference reference_{};
  Reference own_{};  ///< the same in the trajectory's time, of joints that follow one
  TrajectoryOutcome outcome_ = TrajectoryOutcome::idle;
  TrajectoryRefusal refusal_{};
};

}  // namespace articula
