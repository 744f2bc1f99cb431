// SPDX-License-Identifier: Apache-2.0
/// @file Drives that follow positions or velocities by loops of their own.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/dynamics/inverse_dynamics.hpp"
#include "articula/dynamics/mass_matrix.hpp"
#include "articula/sim/bounded_effort.hpp"

#include <algorithm>
#include <cmath>

namespace articula {

/// The efforts of drives that close a position or a velocity loop of their own. They ask for
///
///     a = 2 w (clamp(w/2 (q_ref - q), -V, V) - v)     position
///     a =   w (clamp(v_ref, -V, V) - v)               velocity
///
/// with the bandwidth w and the joint's velocity limit V, and give the effort that causes just that
/// acceleration: effort = M(q) a + h(q, v) + D v + f sign(v). So a joint follows its position
/// command as w^2/(s + w)^2, critically damped, and its velocity command as w/(s + w), whatever its
/// inertia, weight and friction, and as if it were alone. That is the cascaded control of
/// industrial drives with a perfect feed-forward, [Siciliano et al. 2009, section 8.5.2].
///
/// A drive gives no more than its effort limit. While one is at its limit, its joint lags behind,
/// or overshoots where it cannot brake as hard as it should, and the others still follow. Positions
/// are asked for within the joint's limits only, and a drive does not push on where its joint rests
/// at a stop. Where a joint has no velocity limit, V is 1e6 rad/s or m/s, so that a wish of any
/// size to one drive leaves the others theirs.
/// @tparam R  the robot
template <Robot R>
class ServoDrives {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Vector = JointVector<joint_count>;  ///< N x 1

  /// @param robot      whose joints are driven
  /// @param bandwidth  w [rad/s], N x 1, > 0
  ServoDrives(const R& robot, const Vector& bandwidth)
      : robot_(robot),
        bandwidth_(bandwidth),
        lower_(joint_values(robot, [](const JointProperties& j) { return j.limits.lower; })),
        upper_(joint_values(robot, [](const JointProperties& j) { return j.limits.upper; })),
        most_velocity_(
            joint_values(robot, [](const auto& j) { return std::min(j.limits.velocity, 1e6); })),
        most_effort_(effort_limits(robot)),
        damping_(joint_values(robot, [](const JointProperties& j) { return j.damping; })),
        friction_(joint_values(robot, [](const JointProperties& j) { return j.friction; })),
        parents_(elimination_tree(model_of(robot).mechanism)) {}

  /// What the drives give to reach positions.
  /// @param target  q_ref [rad or m], N x 1, finite
  /// @param q       where the joints are [rad or m], N x 1
  /// @param v       how fast they are [rad/s or m/s], N x 1
  /// @return        [N m or N], N x 1, within the limits; 0 if it would overflow
  /// Real-time: yes.
  [[nodiscard]] Vector effort_to_position(const Vector& target, const Vector& q,
                                          const Vector& v) const noexcept {
    const auto acceleration = for_each_joint<joint_count>([&](int j) noexcept {
      const double w = bandwidth_[j], reachable = std::clamp(target[j], lower_[j], upper_[j]);
      return 2 * w * (within_velocity_limit(j, w / 2 * (reachable - q[j])) - v[j]);
    });
    return effort_for(acceleration, q, v);
  }

  /// What the drives give to reach velocities.
  /// @param target  v_ref [rad/s or m/s], N x 1, finite
  /// @param q       where the joints are [rad or m], N x 1
  /// @param v       how fast they are [rad/s or m/s], N x 1
  /// @return        as effort_to_position
  /// Real-time: yes.
  [[nodiscard]] Vector effort_to_velocity(const Vector& target, const Vector& q,
                                          const Vector& v) const noexcept {
    const auto acceleration = for_each_joint<joint_count>([&](int j) noexcept {
      return bandwidth_[j] * (within_velocity_limit(j, target[j]) - v[j]);
    });
    return effort_for(acceleration, q, v);
  }

 private:
  [[nodiscard]] double within_velocity_limit(int j, double velocity) const noexcept {
    return std::clamp(velocity, -most_velocity_[j], most_velocity_[j]);
  }

  /// The effort for an acceleration a. If that is more than some drive can give, the joints move
  /// with another one, a', and M (a' - a) = effort - what was needed: drives hold a' - a at 0 as
  /// far as their limits let them, as friction holds joints still.
  [[nodiscard]] Vector effort_for(Vector a, const Vector& q, const Vector& v) const noexcept {
    Vector resistance;
    for (int j = 0; j < joint_count; ++j) {
      // Rounding may have a joint that rests at its stop leave it a little.
      constexpr double close = 1e-9;  // [rad or m, and per second]
      const bool pushes_on =
          (q[j] <= lower_[j] + close && a[j] < 0) || (q[j] >= upper_[j] - close && a[j] > 0);
      if (pushes_on && std::abs(v[j]) <= close) a[j] = 0;
      const double direction = v[j] != 0 ? v[j] : a[j];
      const double sign = direction > 0 ? 1 : direction < 0 ? -1 : 0;
      resistance[j] = damping_[j] * v[j] + friction_[j] * sign;
    }
    Vector needed = inverse_dynamics(robot_, q, v, a);
    bool within_limits = true;
    for (int j = 0; j < joint_count; ++j) {
      needed[j] += resistance[j];
      within_limits = within_limits && std::abs(needed[j]) <= most_effort_[j];
    }
    if (!is_finite(needed)) return Vector::Zero();
    if (within_limits) return needed;
    Vector given = hold_within_bounds<joint_count>(parents_, mass_matrix(robot_, q), -needed,
                                                   {-most_effort_, most_effort_})
                       .effort;
    for (int j = 0; j < joint_count; ++j) {
      given[j] = std::clamp(given[j], -most_effort_[j], most_effort_[j]);
    }
    return given;
  }

  [[no_unique_address]] R robot_;
  Vector bandwidth_;
  Vector lower_;
  Vector upper_;
  Vector most_velocity_;
  Vector most_effort_;
  Vector damping_;
  Vector friction_;
  JointArray<int, joint_count> parents_;
};

}  // namespace articula
