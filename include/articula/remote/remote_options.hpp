// SPDX-License-Identifier: Apache-2.0
/// @file The options of a Remote.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/motion/motion_limits.hpp"
#include "articula/reference/trajectory/trajectory_tolerances.hpp"
#include "articula/remote/engine/operator_watch.hpp"

#include <algorithm>
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

  /// Of profiles and stops. Default: default_motion_limits.
  std::optional<MotionLimits<N>> limits{};
  /// Of trajectories. By default a trajectory has succeeded when its reference has arrived.
  TrajectoryTolerances<N> tolerances{.stopped_velocity = JointVector<N>::Zero()};
  double largest_force = 1000;  ///< of a pull, in each direction [N]
  /// The robot as a URDF document, for those who watch: the text of the file from which it was
  /// loaded. If empty, urdf_text makes one from the description.
  std::string urdf{};
};

/// Limits of motions that the robot of a description can follow.
///
/// - The velocity V is its limit, or 1 rad/s or 1 m/s without one. At V, four fifths of the effort
///   limit E are enough against damping d and friction f: V <= (0.8 E - f) / d. The rest is for
///   acceleration and gravity.
/// - The acceleration is its limit, or reaches the velocity limit in 0.25 s.
/// - The jerk is its limit, or reaches the acceleration in 0.1 s.
///
/// Real-time: yes.
template <Robot R>
[[nodiscard]] MotionLimits<joint_count<R>> default_motion_limits(const R& robot) noexcept {
  MotionLimits<joint_count<R>> limits;
  for (int j = 0; j < joint_count<R>; ++j) {
    const JointProperties& joint = model_of(robot).joints[j];
    const JointLimits& own = joint.limits;
    const double V = is_finite(own.velocity) ? own.velocity : 1;
    const double A = is_finite(own.acceleration) ? own.acceleration : V / 0.25;
    const double sustained = (0.8 * own.effort - joint.friction) / joint.damping;
    limits.velocity[j] = sustained > 0 ? std::min(V, sustained) : V;  // NaN and infinity bound none
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

}  // namespace articula::remote
