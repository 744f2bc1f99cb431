// SPDX-License-Identifier: Apache-2.0
/// @file Drives that follow positions or velocities by control loops of their own.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/scalar.hpp"
#include "articula/dynamics/inverse_dynamics.hpp"
#include "articula/dynamics/mass_matrix.hpp"
#include "articula/sim/bounded_effort.hpp"

#include <algorithm>
#include <cmath>

namespace articula {

/// The efforts of drives that close a position or a velocity loop of their own. The loops command
/// the acceleration
///
///     a = 2 w (clamp(w/2 (q_ref - q), -V, V) - v)     position
///     a =   w (clamp(v_ref, -V, V) - v)               velocity
///
/// with the bandwidth w and the joint's velocity limit V. The drives give the effort that causes
/// this acceleration: effort = M(q) a + h(q, v) + D v + f sign(v). So a joint follows its position
/// command as w^2/(s + w)^2, critically damped, and its velocity command as w/(s + w). This is
/// independent of its inertia, weight and friction and of the other joints. This is the cascaded
/// control of industrial drives with a perfect feed-forward, [Siciliano et al. 2009, section
/// 8.5.2].
///
/// A drive gives no more than its effort limit. While one is at its limit, its joint lags behind,
/// or overshoots where it cannot brake as hard as it should. The others still follow. Position
/// commands are clamped to the joint's limits, and a drive does not push where its joint rests at a
/// stop. Where a joint has no velocity limit, V is 1e6 rad/s or m/s. So a command of any size to
/// one drive leaves the others their share.
///
/// All functions take a pack of robots as well as one robot: S is double or a pack.
template <Robot R>
class ServoDrives {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  template <class S>
  using Vector = JointVector<joint_count, S>;  ///< N x 1

  /// @param robot      whose joints are driven
  /// @param bandwidth  w [rad/s], N x 1, > 0
  ServoDrives(const R& robot, const Vector<double>& bandwidth)
      : robot_(robot),
        bandwidth_(bandwidth),
        parents_(elimination_tree(model_of(robot).mechanism)) {}

  /// The efforts towards commanded positions.
  /// @param target  q_ref [rad or m], N x 1, finite
  /// @param q       joint positions [rad or m], N x 1
  /// @param v       joint velocities [rad/s or m/s], N x 1
  /// @return        [N m or N], N x 1, within the limits; 0 if it would overflow
  /// Real-time: yes.
  template <class S>
  [[nodiscard]] Vector<S> effort_to_position(const Vector<S>& target, const Vector<S>& q,
                                             const Vector<S>& v) const noexcept {
    return effort_for(for_each_joint<joint_count, S>([&](int j) noexcept {
                        const double w = bandwidth_[j];
                        const S reachable =
                            clamp(target[j], joint(j).limits.lower, joint(j).limits.upper);
                        const S velocity = within_velocity_limit(j, S(w / 2 * (reachable - q[j])));
                        return 2 * w * (velocity - v[j]);
                      }),
                      q, v);
  }

  /// The efforts towards commanded velocities.
  /// @param target  v_ref [rad/s or m/s], N x 1, finite
  /// @param q       joint positions [rad or m], N x 1
  /// @param v       joint velocities [rad/s or m/s], N x 1
  /// @return        as effort_to_position
  /// Real-time: yes.
  template <class S>
  [[nodiscard]] Vector<S> effort_to_velocity(const Vector<S>& target, const Vector<S>& q,
                                             const Vector<S>& v) const noexcept {
    return effort_for(for_each_joint<joint_count, S>([&](int j) noexcept {
                        return bandwidth_[j] * (within_velocity_limit(j, target[j]) - v[j]);
                      }),
                      q, v);
  }

 private:
  [[nodiscard]] const JointProperties& joint(int j) const noexcept {
    return model_of(robot_).joints[j];
  }
  template <class S>
  [[nodiscard]] S within_velocity_limit(int j, const S& velocity) const noexcept {
    const double most = std::min(joint(j).limits.velocity, 1e6);
    return clamp(velocity, -most, most);
  }

  /// The efforts for accelerations a. If one exceeds the limit of its drive, the joints move with
  /// other accelerations a', and M (a' - a) = effort - needed effort. The drives keep a' - a at 0
  /// as far as their limits allow, as friction holds joints still.
  template <class S>
  [[nodiscard]] Vector<S> effort_for(Vector<S> a, const Vector<S>& q,
                                     const Vector<S>& v) const noexcept {
    using std::abs;
    const auto resistance = for_each_joint<joint_count, S>([&](int j) noexcept {
      // Rounding may move a joint that rests at its stop by a little.
      constexpr double close = 1e-9, free = JointLimits::infinity;  // [rad or m, and per second]
      const auto& [name, type, limits, damping, friction] = joint(j);
      const S lowest = select(q[j] <= limits.lower + close, S(0), S(-free));
      const S highest = select(q[j] >= limits.upper - close, S(0), S(free));
      a[j] = select(abs(v[j]) <= close, clamp(a[j], lowest, highest), a[j]);
      const S direction = select(v[j] != 0, v[j], a[j]);
      const S sign = select(direction > 0, S(1), select(direction < 0, S(-1), S(0)));
      return damping * v[j] + friction * sign;
    });
    Vector<S> needed = inverse_dynamics(robot_, q, v, a);
    bool within_limits = true;
    for (int j = 0; j < joint_count; ++j) {
      needed[j] += resistance[j];
      within_limits = within_limits && all_of(abs(needed[j]) <= joint(j).limits.effort);
    }
    if (within_limits) return needed;
    for (int k = 0; k < lanes<S>; ++k) {
      set_lane(needed, k, within_effort_limits(lane_of(needed, k), lane_of(q, k)));
    }
    return needed;
  }

  [[nodiscard]] Vector<double> within_effort_limits(const Vector<double>& needed,
                                                    const Vector<double>& q) const noexcept {
    if (!is_finite(needed)) return Vector<double>::Zero();
    const Vector<double> most = effort_limits(robot_);
    if ((needed.array().abs() <= most.array()).all()) return needed;
    const auto bounded =
        hold_within_bounds<joint_count>(parents_, mass_matrix(robot_, q), -needed, {-most, most});
    return for_each_joint<joint_count>(
        [&](int j) noexcept { return std::clamp(bounded.effort[j], -most[j], most[j]); });
  }

  [[no_unique_address]] R robot_;
  Vector<double> bandwidth_;
  JointArray<int, joint_count> parents_;
};

}  // namespace articula
