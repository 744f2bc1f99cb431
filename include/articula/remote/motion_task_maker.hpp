// SPDX-License-Identifier: Apache-2.0
/// @file The check of requests for motion before a loop gets them.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/reference/joint_range.hpp"
#include "articula/reference/trajectory/trajectory_point.hpp"
#include "articula/remote/engine/task.hpp"
#include "articula/remote/request.hpp"
#include "articula/remote/request_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace articula::remote {

/// Makes tasks of requests for motion: profiles, set-points, trajectories and signals. All
/// functions throw std::invalid_argument, naming joint, value and limit.
template <Robot R>
class MotionTaskMaker {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Wish = typename Task<R>::Wish;
  using Reference = JointReference<joint_count>;
  using Vector = JointVector<joint_count>;

  /// @param robot  stays where it is
  explicit MotionTaskMaker(const R& robot) : robot_(robot), check_(robot) {}

  /// @param present  the last reference that is known; likewise below
  [[nodiscard]] Wish make(const Go& go, const Reference&) const {
    if (go.positions.empty()) articula::detail::refuse({"go: no joint is named"});
    if (!(go.speed >= 0.01 && go.speed <= 1)) {
      articula::detail::refuse({"go: speed ", go.speed, " is not within 0.01 .. 1"});
    }
    task::Go<joint_count> wish{Vector::Constant(std::numeric_limits<double>::quiet_NaN()),
                               go.speed};
    for (const auto& [joint, value] : check_.numbers("go", go.positions)) {
      check_.check_position("go", joint, value);
      wish.target[joint] = value;
    }
    return wish;
  }

  [[nodiscard]] Wish make(const SetReference& set, const Reference&) const {
    task::Set<joint_count> wish;
    auto& [joints, positions, values] = wish.setting;
    for (const auto& [joint, value] : check_.numbers("set_reference", set.positions)) {
      check_.check_position("set_reference", joint, value);
      values.position[joint] = value;
      positions[joint] = joints[joint] = true;
    }
    for (const auto& [joint, value] : check_.numbers("set_reference", set.velocities)) {
      check_.check_size("set_reference", "velocity", joint, value,
                        check_.limits_of(joint).velocity);
      values.velocity[joint] = value;
      joints[joint] = true;
    }
    for (const auto& [joint, value] : check_.numbers("set_reference", set.efforts)) {
      check_.check_size("set_reference", "effort", joint, value, check_.limits_of(joint).effort);
      values.effort[joint] = value;
      joints[joint] = true;
    }
    for (int j = 0; j < joint_count; ++j) {
      if (joints[j]) return wish;
    }
    articula::detail::refuse({"set_reference: no joint is named"});
  }

  [[nodiscard]] Wish make(const PlayTrajectory& play, const Reference& present) const {
    task::Follow<R> wish{.trajectory = nullptr, .delay = play.delay};
    check_.check_efforts(play.trajectory);
    const auto& points = play.trajectory.points;
    if (!points.empty() && points.back().time_from_start == 0) {
      articula::detail::refuse(
          {"trajectory: time_from_start of the last point is 0 s: give the motion a time"});
    }
    Excess excess = excess_at_points(play.trajectory);
    if (!(excess.factor <= most_excess)) excess = {};  // refused by `arrange`
    wish.trajectory = arranged(slower(play.trajectory, excess.factor), present);
    const Excess between = excess_between_points(*wish.trajectory);
    if (between.factor > 1 + 1e-9) {  // rounding
      excess = {between.joint, excess.factor * between.factor};
      if (excess.factor > most_excess) {
        const double limit = check_.limits_of(excess.joint).velocity;
        check_.check_size("trajectory between its points", "velocity", excess.joint,
                          excess.factor * limit, limit);
      }
      wish.trajectory = arranged(slower(play.trajectory, excess.factor), present);
    }
    if (excess.factor > 1 + 1e-6) {
      wish.note = articula::detail::message_of(
          {"the trajectory takes ", excess.factor, " times as long, since joint '",
           check_.name_of(excess.joint), "' would exceed its velocity limit, ",
           check_.limits_of(excess.joint).velocity});
    }
    put_tolerances(play.path_tolerances, wish.tolerances.path_position,
                   wish.tolerances.path_velocity);
    put_tolerances(play.goal_tolerances, wish.tolerances.goal_position,
                   wish.tolerances.stopped_velocity);
    wish.tolerances.goal_time = play.goal_time;
    if (play.delay && !is_finite(*play.delay)) {
      articula::detail::refuse({"trajectory: delay ", *play.delay, " s is not a finite number"});
    }
    return wish;
  }

  [[nodiscard]] Wish make(const PlaySignals& play, const Reference& present) const {
    constexpr double longest = 86400;  // [s]
    if (!(play.duration > 0 && play.duration <= longest)) {
      articula::detail::refuse(
          {"signals: duration ", play.duration, " s is not within 0 .. ", longest});
    }
    if (play.signals.empty()) articula::detail::refuse({"signals: there is none"});
    std::vector<JointSignal> signals;
    for (const NamedSignal& own : play.signals) {
      signals.push_back({RequestCheck<R>::checked_name(own.joint), own.signal, own.target});
    }
    JointArray<bool, joint_count> joints{};
    for (const JointSignal& own : signals) joints[joint_index(robot_, own.joint)] = true;
    Vector around = joint_range(robot_).clamp(present.position);
    for (int j = 0; j < joint_count; ++j) {  // others may be outside their limits
      if (joints[j]) around[j] = present.position[j];
    }
    JointSignals<R> sum(robot_, signals, {.position = around, .effort = present.effort});
    Vector velocity = Vector::Zero(), effort = Vector::Zero(), begin = Vector::Zero();
    for (const JointSignal& own : signals) {
      const int joint = joint_index(robot_, own.joint);
      const SignalValue peak = std::visit([](const auto& s) { return s.peak(); }, own.signal);
      (own.target == SignalTarget::effort ? effort : velocity)[joint] +=
          own.target == SignalTarget::effort ? peak.value : peak.rate;
      const bool jumps = std::holds_alternative<StepSignal>(own.signal) ||
                         std::holds_alternative<SquareSignal>(own.signal);
      if (own.target == SignalTarget::position && !jumps) {
        begin[joint] += std::visit([](const auto& s) { return s.sample(0).value; }, own.signal);
      }
    }
    for (int j = 0; j < joint_count; ++j) {
      if (joints[j]) check_.check_signals(j, around[j], sum.lowest()[j], sum.highest()[j]);
      check_.check_size("signals", "velocity", j, velocity[j], check_.limits_of(j).velocity);
      if (std::abs(begin[j]) > 1e-9) {  // rounding of a phase
        articula::detail::refuse(
            {"signals: joint '", check_.name_of(j), "' would jump by ", begin[j],
             " at the start: choose offset and phase so that the signals begin at 0"});
      }
      check_.check_size("signals", "effort", j, effort[j], check_.limits_of(j).effort);
    }
    return task::Play<R>{joints, sum, play.duration};
  }

  [[nodiscard]] Wish make(const Stop& stop, const Reference&) const {
    if (stop.joints.empty()) return task::Stop{};
    task::StopJoints<joint_count> wish;
    for (const std::string& joint : stop.joints) {
      wish.joints[joint_index(robot_, RequestCheck<R>::checked_name(joint))] = true;
    }
    return wish;
  }

 private:
  using Path = Trajectory<R, trajectory_capacity>;

  /// A plan that uses all of a velocity limit exceeds it by rounding, or by a percent or so between
  /// its points, where the planner has not looked. Up to this factor it is followed more slowly.
  static constexpr double most_excess = 1.05;

  [[nodiscard]] std::unique_ptr<const Path> arranged(const NamedTrajectory& named,
                                                     const Reference& present) const {
    return std::make_unique<const Path>(arrange<trajectory_capacity>(
        robot_, named, {.allow_partial_joints = true, .allow_integration = true, .from = present}));
  }

  /// The joint that exceeds its velocity limit most, and the ratio of velocity and limit, >= 1.
  struct Excess {
    int joint = 0;
    double factor = 1;
  };
  /// Of velocities at points, and of mean velocities from one point to the next.
  [[nodiscard]] Excess excess_at_points(const NamedTrajectory& trajectory) const {
    Excess most;
    for (std::size_t k = 0; k < trajectory.joint_names.size(); ++k) {
      for (int j = 0; j < joint_count; ++j) {
        if (trajectory.joint_names[k] != check_.name_of(j)) continue;
        const auto include = [&](double velocity) {
          const double factor = std::abs(velocity) / check_.limits_of(j).velocity;
          if (factor > most.factor) most = {j, factor};
        };
        const NamedTrajectoryPoint* before = nullptr;
        for (const NamedTrajectoryPoint& point : trajectory.points) {
          if (k < point.velocities.size()) include(point.velocities[k]);
          if (before && k < std::min(point.positions.size(), before->positions.size())) {
            include((point.positions[k] - before->positions[k]) /
                    (point.time_from_start - before->time_from_start));
          }
          before = &point;
        }
      }
    }
    return most;
  }
  [[nodiscard]] Excess excess_between_points(const Path& trajectory) const {
    Excess most;
    const auto points = trajectory.points();
    for (std::size_t k = 1; k < points.size(); ++k) {
      const Vector anything = Vector::Zero();  // all extremes are of interest
      const auto peaks = segment_peaks(points[k - 1], points[k],
                                       {.lowest = anything,
                                        .highest = anything,
                                        .velocity = anything,
                                        .acceleration = anything});
      for (int j = 0; j < joint_count; ++j) {
        const double factor = peaks.velocity[j] / check_.limits_of(j).velocity;
        if (factor > most.factor) most = {j, factor};
      }
    }
    return most;
  }

  /// The same path in a longer time.
  [[nodiscard]] static NamedTrajectory slower(NamedTrajectory trajectory, double factor) {
    if (factor == 1) return trajectory;
    factor *= 1 + 1e-15;  // v / (v / limit) may be above the limit by rounding
    for (NamedTrajectoryPoint& point : trajectory.points) {
      point.time_from_start *= factor;
      for (double& velocity : point.velocities) velocity /= factor;
      for (double& acceleration : point.accelerations) acceleration /= factor * factor;
    }
    return trajectory;
  }

  void put_tolerances(const std::vector<NamedTolerance>& named, Vector& position,
                      Vector& velocity) const {
    for (const NamedTolerance& own : named) {
      const int joint = joint_index(robot_, RequestCheck<R>::checked_name(own.joint));
      position[joint] = own.position;
      velocity[joint] = own.velocity;
    }
  }

  const R& robot_;
  RequestCheck<R> check_;
};

}  // namespace articula::remote
