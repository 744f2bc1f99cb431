// SPDX-License-Identifier: Apache-2.0
/// @file The options of a Remote.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/motion/motion_limits.hpp"
#include "articula/reference/trajectory/trajectory_tolerances.hpp"
#include "articula/remote/engine/operator_watch.hpp"

#include <optional>
#include <string>

namespace articula::remote {

/// The options of a Remote for a robot with N joints.
/// @tparam N  number of joints
template <int N>
struct RemoteOptions {
  double operator_lifetime = 1;  ///< after which a silent operator loses the controls [s]
  OperatorLoss when_operator_is_lost = OperatorLoss::stop;
  double answer_time = 1;  ///< within which the loop must take a request [s]

  /// Of profiles and stops. By default those of the robot's description, completed by
  /// default_motion_limits. A joint may be too weak for its velocity limit, see GoMotion.
  std::optional<MotionLimits<N>> limits{};
  /// Of trajectories. By default a trajectory has succeeded when its reference has arrived.
  TrajectoryTolerances<N> tolerances{.stopped_velocity = JointVector<N>::Zero()};
  double largest_force = 1000;  ///< of a pull, in each direction [N]
  /// The robot as a URDF document, for those who watch: the text of the file from which it was
  /// loaded. If empty, urdf_text makes one from the description.
  std::string urdf{};
};

/// The limits of the robot's description. Where it has none, the velocity is 1 rad/s or 1 m/s. The
/// acceleration reaches it in 0.25 s, and the jerk reaches the acceleration in 0.1 s.
/// Real-time: yes.
template <Robot R>
[[nodiscard]] MotionLimits<joint_count<R>> default_motion_limits(const R& robot) noexcept {
  MotionLimits<joint_count<R>> limits;
  for (int j = 0; j < joint_count<R>; ++j) {
    const JointLimits& own = model_of(robot).joints[j].limits;
    const double V = is_finite(own.velocity) ? own.velocity : 1;
    const double A = is_finite(own.acceleration) ? own.acceleration : V / 0.25;
    limits.velocity[j] = V;
    limits.acceleration[j] = A;
    limits.jerk[j] = is_finite(own.jerk) ? own.jerk : A / 0.1;
  }
  return limits;
}

/// Refuses options that make no sense.
/// @throws std::invalid_argument naming option and value
/// Real-time: no (throws).
template <int N>
void validate(const RemoteOptions<N>& options) {
  const auto positive = [](std::string_view name, double value) {
    if (!(value > 0))
      articula::detail::refuse({"remote: ", name, " ", value, " is not a number > 0"});
  };
  positive("operator_lifetime", options.operator_lifetime);
  positive("answer_time", options.answer_time);
  positive("largest_force", options.largest_force);
}

/// The limits of profiles that the options ask for.
/// @throws std::invalid_argument naming what makes no sense, in the options or in the limits
/// Real-time: no (throws).
template <Robot R>
[[nodiscard]] MotionLimits<joint_count<R>> checked_limits(
    const R& robot, const RemoteOptions<joint_count<R>>& options) {
  validate(options);
  const auto limits = options.limits.value_or(default_motion_limits(robot));
  validate(robot, limits);
  return limits;
}

}  // namespace articula::remote
