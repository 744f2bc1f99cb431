// SPDX-License-Identifier: Apache-2.0
/// @file The check of requests for motion before a loop gets them.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/reference/joint_range.hpp"
#include "articula/reference/trajectory/trajectory_point.hpp"
#include "articula/remote/engine/task.hpp"
#include "articula/remote/request.hpp"
#include "articula/remote/request_check.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace articula::remote {

/// Makes tasks of requests for motion: profiles, set-points, trajectories and signals. All functions
/// throw std::invalid_argument, naming joint, value and limit.
template <Robot R>
class MotionTaskMaker {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Wish = typename Task<R>::Wish;
  using Reference = JointReference<joint_count>;
  using Vector = JointVector<joint_count>;

  /// @param robot   stays where it is
  /// @param limits  of signals' velocities
  MotionTaskMaker(const R& robot, const MotionLimits<joint_count>& limits)
      : robot_(robot), check_(robot), limits_(limits) {}

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
    auto trajectory =
        std::make_unique<const Trajectory<R, trajectory_capacity>>(arrange<trajectory_capacity>(
            robot_, play.trajectory,
            {.allow_partial_joints = true, .allow_integration = true, .from = present}));
    const auto points = trajectory->points();
    for (std::size_t k = 1; k < points.size(); ++k) {
      const Vector anything = Vector::Zero();  // all extremes are of interest
      const auto peaks = segment_peaks(points[k - 1], points[k],
                                       {.lowest = anything,
                                        .highest = anything,
                                        .velocity = anything,
                                        .acceleration = anything});
      for (int j = 0; j < joint_count; ++j) {
        check_.check_size("trajectory between its points", "velocity", j, peaks.velocity[j],
                          check_.limits_of(j).velocity * (1 + 1e-9));  // rounding
      }
    }
    task::Follow<R> wish{.trajectory = std::move(trajectory), .delay = play.delay};
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
    JointSignals<R> sum(robot_, signals, {.position = present.position, .effort = present.effort});
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
      check_.check_size("signals", "velocity", j, velocity[j], limits_.velocity[j]);
      if (std::abs(begin[j]) > 1e-9) {  // rounding of a phase
        articula::detail::refuse(
            {"signals: joint '", check_.name_of(j), "' would jump by ", begin[j],
             " at the start: choose offset and phase so that the signals begin at 0"});
      }
      check_.check_size("signals", "effort", j, effort[j], check_.limits_of(j).effort);
    }
    return task::Play<R>{sum, play.duration};
  }

 private:
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
  MotionLimits<joint_count> limits_;
};

}  // namespace articula::remote
