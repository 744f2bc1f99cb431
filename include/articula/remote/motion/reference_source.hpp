// SPDX-License-Identifier: Apache-2.0
/// @file The sources of a remote loop's reference, of which each joint follows one.
#pragma once

#include "articula/remote/motion/go_motion.hpp"
#include "articula/remote/motion/joint_setting.hpp"
#include "articula/remote/motion/joint_sources.hpp"
#include "articula/remote/motion/motion_kind.hpp"
#include "articula/remote/motion/signal_motion.hpp"
#include "articula/remote/motion/trajectory_followers.hpp"

#include <algorithm>
#include <optional>

namespace articula::remote {

/// The sources of a loop's reference: a profile, a setting, a stop, signals, and some trajectories.
/// Each joint follows one of them, or rests. A request moves the joints that it names, and the
/// others go on. Signals and trajectories end as a whole: if another request takes one of their
/// joints, the rest of them stop. Each motion begins at the present reference, in motion or not, so
/// the reference does not jump. The exceptions are requests for a jump: a setting, a step, a
/// square.
///
/// In the loop's thread. Real-time: yes, all functions but the constructor.
template <Robot R>
class ReferenceSource {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Vector = JointVector<joint_count>;
  using Reference = JointReference<joint_count>;
  using Joints = JointArray<bool, joint_count>;
  using Followers = TrajectoryFollowers<R>;
  using Tolerances = TrajectoryTolerances<joint_count>;

  /// What a joint follows. The followers of trajectories come last.
  enum Source : int { none, profile, setting, stopping, signals, first_follower };
  static constexpr int source_count = first_follower + Followers::count;

  /// At rest.
  /// @param limits      of profiles and stops
  /// @param tolerances  of trajectories
  /// @throws std::invalid_argument naming joint, limit and value
  ReferenceSource(const R& robot, const MotionLimits<joint_count>& limits,
                  const Tolerances& tolerances)
      : followers_(robot, limits, tolerances),
        go_(robot, limits),
        stops_(robot, JointVector<joint_count>::Zero(), limits),
        signals_(robot, limits) {
    validate(robot, both_ways(limits));
  }

  /// What a joint follows.
  [[nodiscard]] MotionKind kind(int joint) const noexcept { return kind_of(sources_.of(joint)); }
  /// What was begun last, if a joint still follows it; otherwise what any joint follows.
  [[nodiscard]] MotionKind kind() const noexcept {
    if (leads(latest_)) return kind_of(latest_);
    for (int source = source_count - 1; source > none; --source) {
      if (leads(source)) return kind_of(source);
    }
    return MotionKind::rest;
  }
  /// Whether a joint follows a source.
  [[nodiscard]] bool leads(int source) const noexcept {
    return source != none && sources_.leads(source);
  }

  /// Places the reference of a joint that has no motion of its position: a joint at rest, or one
  /// with a setting or signals of effort alone.
  /// @return whether it is such a joint
  bool place(int joint, double position) noexcept {
    const int source = sources_.of(joint);
    if (source == setting) set_.position[joint] = position;
    if (source == signals) return signals_.place(joint, position);
    return source == none || source == setting;
  }

  /// Ends all motions at once: for loops that set their reference themselves.
  void rest() noexcept { sources_ = {}; }

  /// Ends the motions of some joints, each by its fastest stop.
  void stop(const Reference& from, Joints joints) noexcept {
    for (int j = 0; j < joint_count; ++j) joints[j] = joints[j] && sources_.of(j) != none;
    begin(stopping, joints, from);
  }

  /// Begins a motion to positions, see GoMotion.
  /// @param target  of the joints that move [rad or m], N x 1; NaN for the others
  void go(const Reference& from, Vector target, double speed) noexcept {
    Joints joints{};
    for (int j = 0; j < joint_count; ++j) {
      if (!is_finite(target[j]) && sources_.of(j) == profile) target[j] = go_.target()[j];
      joints[j] = is_finite(target[j]);
    }
    const Reference here = begin(profile, joints, from);
    go_.begin(with_motion_of(joints, here), target, speed);
  }

  /// Sets the reference of some joints. Of several settings in one period, each starts from the one
  /// before.
  void set(const Reference& from, const JointSetting<joint_count>& own) noexcept {
    const Joints were_set = sources_.joints_of(setting);
    begin(setting, own.joints, from);
    for (int j = 0; j < joint_count; ++j) {
      if (!own.joints[j]) continue;
      const double present = (were_set[j] ? set_ : from).position[j];
      const double position = own.positions[j] ? own.values.position[j] : present;
      set_motion(set_, j, {position, own.values.velocity[j], 0});
      set_.effort[j] = own.values.effort[j];
    }
  }

  /// A trajectory that has begun, or was refused.
  struct Begun {
    TrajectoryOutcome outcome = TrajectoryOutcome::active;
    TrajectoryRefusal refusal{};
    int source = none;  ///< its follower
  };
  /// Begins a trajectory of the joints that it does not leave out. A refused one changes nothing.
  /// @param tolerances  in addition to the configured ones, see `overridden`
  /// @param delay       until its time 0 [s]; without it, it begins at once
  [[nodiscard]] Begun follow(const Reference& from,
                             const Trajectory<R, trajectory_capacity>& trajectory,
                             const Tolerances& tolerances,
                             std::optional<double> delay = {}) noexcept {
    Joints joints{};
    for (int j = 0; j < joint_count; ++j) joints[j] = !trajectory.left_out()[j];
    const int source = source_for(joints), follower = source - first_follower;
    if (source == none) {
      return {TrajectoryOutcome::invalid_goal,
              {.what = "trajectories at once",
               .value = Followers::most + 1,
               .rule = "are more than",
               .limit = Followers::most}};
    }
    if (!leads(source)) {
      followers_.take_over(follower, with_motion_of(joints, without_signals(from)), time_);
    }
    const double start = delay ? time_ + *delay : Followers::Follower::now;
    const auto outcome = followers_.start(follower, trajectory, tolerances, start);
    if (outcome == TrajectoryOutcome::active) begin(source, joints, from);
    return {outcome, followers_.refusal(follower), source};
  }
  /// How fast trajectories are followed, see SpeedOverride.
  /// @param factor  0 (pause) .. 1 (as planned)
  void set_trajectory_speed(double factor) noexcept {
    trajectory_speed_ = factor;
    followers_.set_speed(factor);
  }
  [[nodiscard]] double trajectory_speed() const noexcept { return trajectory_speed_; }
  /// Where the present lies on the last trajectory of a source; none before its start.
  [[nodiscard]] auto progress(int source) const noexcept {
    return followers_.progress(source - first_follower);
  }
  /// What has become of the last trajectory of a source.
  [[nodiscard]] TrajectoryOutcome outcome(int source) const noexcept {
    return followers_.outcome(source - first_follower);
  }
  /// Why it has failed.
  [[nodiscard]] const TrajectoryRefusal& refusal(int source) const noexcept {
    return followers_.refusal(source - first_follower);
  }

  /// Begins signals, see SignalMotion. They end by a motion back. Others that play end.
  /// @param joints    that have signals
  /// @param own       valid until they have ended
  /// @param duration  [s]
  void play(const Reference& from, const Joints& joints, JointSignals<R>& own,
            double duration) noexcept {
    const Reference here = begin(stopping, sources_.joints_of(signals), from);
    begin(signals, joints, here);
    signals_.begin(with_motion_of(joints, here), own, duration);
  }

  /// The reference one period later.
  /// @param present  the reference of the last cycle
  [[nodiscard]] Reference next(const Reference& present, double period) noexcept {
    time_ += period;
    Reference reference = present;
    if (leads(profile)) {
      sources_.copy(profile, go_.advance(period), reference);
      if (!go_.moves()) let_rest(profile);
    }
    if (leads(setting)) {
      sources_.copy(setting, set_, reference);
      Joints resting = sources_.joints_of(setting);
      for (int j = 0; j < joint_count; ++j) resting[j] &= set_.velocity[j] == 0;
      sources_.give(resting, none);
    }
    if (leads(signals)) {
      Reference own;
      if (signals_.advance(period, own)) {
        sources_.copy(signals, own, reference);
      } else {
        const Joints ended = sources_.joints_of(signals);
        stop_joints(ended, without_signals(present), signals_.around().position);
        sources_.give(ended, stopping);
      }
    }
    if (leads(stopping)) {
      Joints resting = sources_.joints_of(stopping);
      sources_.copy(stopping, stops_.advance(period), reference);
      for (int j = 0; j < joint_count; ++j) resting[j] &= !stops_.moves(j);
      sources_.give(resting, none);
    }
    for (int source = first_follower; source < source_count; ++source) {
      if (!leads(source)) continue;
      sources_.copy(source, followers_.sample(source - first_follower, time_), reference);
    }
    return reference;
  }

  /// Compares the state that was measured for the last reference with the tolerances of
  /// trajectories.
  void check(const JointState<joint_count>& state) noexcept {
    for (int source = first_follower; source < source_count; ++source) {
      if (!leads(source)) continue;
      if (!followers_.check(source - first_follower, state, sources_.joints_of(source)))
        let_rest(source);
    }
  }

 private:
  [[nodiscard]] static constexpr MotionKind kind_of(int source) noexcept {
    constexpr MotionKind kinds[] = {MotionKind::rest, MotionKind::go, MotionKind::set,
                                    MotionKind::stop, MotionKind::signals};
    return source < first_follower ? kinds[source] : MotionKind::trajectory;
  }

  /// The follower for a trajectory of some joints: that of just these joints, if there is one, so
  /// that its present trajectory goes on until the new one begins. Otherwise one that has no joint.
  /// @return none if there would be more trajectories at once than are possible
  [[nodiscard]] int source_for(const Joints& joints) const noexcept {
    int unused = none, others = 0;
    for (int source = first_follower; source < source_count; ++source) {
      if (sources_.joints_of(source) == joints) return source;
      if (!leads(source)) {
        unused = source;
      } else if (!sources_.leads(source, joints)) {
        ++others;
      }
    }
    return others < Followers::most ? unused : int{none};
  }

  /// Gives joints to a source. Trajectories and signals of which it gets a joint end: their other
  /// joints stop.
  /// @return from, without signals
  Reference begin(int source, const Joints& joints, const Reference& from) noexcept {
    const Reference here = without_signals(from);
    Joints stop{};
    for (int other = signals; other < source_count; ++other) {
      if (other == source || !sources_.leads(other, joints)) continue;
      for (int j = 0; j < joint_count; ++j) stop[j] |= sources_.of(j) == other && !joints[j];
    }
    for (int j = 0; j < joint_count; ++j) stop[j] |= source == stopping && joints[j];
    stop_joints(stop, here);
    sources_.give(stop, stopping);
    sources_.give(joints, source);
    if (std::find(joints.begin(), joints.end(), true) != joints.end()) latest_ = source;
    return here;
  }

  /// Begins stops. Joints stop within the range of the signals that they follow, which may
  /// accelerate harder than the limits of stops. A joint that stops already keeps its range.
  void stop_joints(const Joints& joints, const Reference& from,
                   const Vector& back = JointStops<R>::nowhere()) noexcept {
    for (int j = 0; j < joint_count; ++j) {
      if (!joints[j] || sources_.of(j) == stopping) continue;
      const auto& range = sources_.of(j) == signals ? signals_.range() : stops_.range();
      stop_range_.lower[j] = range.lower[j];
      stop_range_.upper[j] = range.upper[j];
    }
    stops_.begin(joints, from, back, stop_range_);
  }

  /// A reference without the efforts that signals have added to it. What they have added to
  /// positions stays, since a joint cannot jump.
  [[nodiscard]] Reference without_signals(Reference from) const noexcept {
    for (int j = 0; j < joint_count; ++j) {
      if (sources_.of(j) == signals) from.effort[j] = signals_.around().effort[j];
    }
    return from;
  }

  /// A reference in which only some joints move.
  [[nodiscard]] static Reference with_motion_of(const Joints& joints, Reference from) noexcept {
    for (int j = 0; j < joint_count; ++j) {
      if (!joints[j]) from.velocity[j] = from.acceleration[j] = 0;
    }
    return from;
  }

  void let_rest(int source) noexcept { sources_.give(sources_.joints_of(source), none); }

  JointSources<joint_count, source_count> sources_{};
  int latest_ = none;  ///< the source that was begun last
  double time_ = 0;    ///< the clock of trajectories [s]
  Followers followers_;
  GoMotion<R> go_;
  Reference set_{};
  JointStops<R> stops_;
  JointRange<joint_count> stop_range_ = stops_.range();  ///< of the present stops
  SignalMotion<R> signals_;
  double trajectory_speed_ = 1;  ///< as asked for
};

}  // namespace articula::remote
