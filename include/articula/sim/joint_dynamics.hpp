// SPDX-License-Identifier: Apache-2.0
/// @file How a robot's joints move under efforts: rigid bodies, damping, dry friction and stops.
#pragma once

#include "articula/dynamics/forward_dynamics.hpp"
#include "articula/sim/bounded_effort.hpp"
#include "articula/sim/crossing.hpp"
#include "articula/sim/runge_kutta.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace articula {

/// Advances a robot in time under the efforts of its drives. Between events the motion is smooth
/// and is integrated by Runge-Kutta; an event (a joint reaches its stop, or comes to rest against
/// dry friction) is located in time to the last bits, dealt with, and the step goes on from there.
/// Stops are inelastic: a joint that arrives gives up its velocity by an impulse through the mass
/// matrix, which cannot add energy, and is then held for as long as it is pushed. Dry friction
/// holds a resting joint exactly.
/// @tparam R  the robot
template <Robot R>
class JointDynamics {
 public:
  static constexpr int joint_count = articula::joint_count<R>;

  explicit JointDynamics(const R& robot)
      : robot_(robot),
        lower_(joint_values(robot, [](const JointProperties& j) { return j.limits.lower; })),
        upper_(joint_values(robot, [](const JointProperties& j) { return j.limits.upper; })),
        damping_(joint_values(robot, [](const JointProperties& j) { return j.damping; })),
        friction_(joint_values(robot, [](const JointProperties& j) { return j.friction; })),
        parents_(elimination_tree(model_of(robot).mechanism)) {}

  /// The motion after one step under constant efforts.
  /// @param motion  position and velocity at its beginning; positions within the joints' limits
  /// @param effort  efforts of the drives [N m or N], N x 1
  /// @param step    [s]
  /// Real-time: yes. One Runge-Kutta step, and some ten more for each event, at most some fifty.
  [[nodiscard]] Motion<joint_count> advance(const Motion<joint_count>& motion,
                                            const JointVector<joint_count>& effort,
                                            double step) const noexcept {
    return advance(motion, [&effort](const auto&, const auto&) noexcept { return effort; }, step);
  }

  /// The motion after one step under efforts that depend on it.
  /// @param motion  as above
  /// @param effort  callable with (q, v) -> efforts of the drives [N m or N], N x 1
  /// @param step    [s]
  /// Real-time: yes if `effort` is, which is called in each stage of each Runge-Kutta step.
  template <class Drives>
    requires std::is_invocable_r_v<JointVector<joint_count>, const Drives&,
                                   const JointVector<joint_count>&, const JointVector<joint_count>&>
  [[nodiscard]] Motion<joint_count> advance(Motion<joint_count> motion, const Drives& effort,
                                            double step) const noexcept {
    double rest = step;
    for (int event = 0; event < most_events && rest > 0; ++event) {
      if (any_at_stop(motion)) motion = after_impact(motion, Rebound::yes);
      const Phase phase = phase_at(motion, effort);
      Motion<joint_count> next = smooth_step(phase, motion, effort, rest);
      const double excess_at_end = excess(phase, next);
      if (!(excess_at_end > 0)) return next;

      rest -=
          locate_crossing({0, excess(phase, motion)}, {rest, excess_at_end},
                          std::numeric_limits<double>::epsilon() * step, [&](double time) noexcept {
                            const auto there = smooth_step(phase, motion, effort, time);
                            const double past = excess(phase, there);
                            if (past > 0) next = there;
                            return past;
                          });
      motion = settle(phase, next);
    }
    if (rest > 0) {  // joints at stops jolt each other ever more often and less: that ends here
      motion = after_impact(motion, Rebound::no);
      const Phase phase = phase_at(motion, effort);
      motion = settle(phase, smooth_step(phase, motion, effort, rest));
    }
    return motion;
  }

 private:
  static constexpr int most_events = 8 * joint_count;

  /// Whether a joint at its stop may leave it when another one's impact throws it back.
  enum class Rebound { yes, no };

  /// What stays the same between two events.
  struct Phase {
    bool any_held = false;  ///< some joint is held still
    JointArray<bool, joint_count> held{};
    /// Friction efforts of the joints that slide [N m or N], N x 1
    JointVector<joint_count> sliding = JointVector<joint_count>::Zero();
  };

  [[nodiscard]] bool at_lower(const Motion<joint_count>& m, int j) const noexcept {
    return m.position[j] <= lower_[j];
  }
  [[nodiscard]] bool at_upper(const Motion<joint_count>& m, int j) const noexcept {
    return m.position[j] >= upper_[j];
  }
  [[nodiscard]] bool any_at_stop(const Motion<joint_count>& m) const noexcept {
    bool any = false;
    for (int j = 0; j < joint_count; ++j) any = any || at_lower(m, j) || at_upper(m, j);
    return any;
  }

  /// The velocity after all joints that run into their stops have hit them. Without rebound, all
  /// joints that are at a stop come to rest, which takes more energy.
  [[nodiscard]] Motion<joint_count> after_impact(Motion<joint_count> motion,
                                                 Rebound rebound) const noexcept {
    EffortBounds<joint_count> impulse;
    bool hits = false;
    for (int j = 0; j < joint_count; ++j) {
      const bool lower = at_lower(motion, j), upper = at_upper(motion, j);
      const bool either = (lower || upper) && rebound == Rebound::no;
      if (lower || either) impulse.upper[j] = JointLimits::infinity;
      if (upper || either) impulse.lower[j] = -JointLimits::infinity;
      hits = hits || (lower && motion.velocity[j] < 0) || (upper && motion.velocity[j] > 0);
    }
    if (hits) {
      const JointMatrix<joint_count> m = mass_matrix(robot_, motion.position);
      motion.velocity = hold_within_bounds<joint_count>(
                            parents_, m, product<joint_count>(m, motion.velocity), impulse)
                            .motion;
    }
    return motion;
  }

  /// Which joints are held from here on, and how friction acts on the others.
  template <class Drives>
  [[nodiscard]] Phase phase_at(const Motion<joint_count>& motion,
                               const Drives& effort) const noexcept {
    Phase phase;
    EffortBounds<joint_count> bounds;
    bool may_hold = false;
    for (int j = 0; j < joint_count; ++j) {
      if (motion.velocity[j] != 0) {
        phase.sliding[j] = motion.velocity[j] > 0 ? -friction_[j] : friction_[j];
        continue;
      }
      bounds.lower[j] = at_upper(motion, j) ? -JointLimits::infinity : -friction_[j];
      bounds.upper[j] = at_lower(motion, j) ? JointLimits::infinity : friction_[j];
      may_hold = may_hold || bounds.lower[j] < bounds.upper[j];
    }
    if (!may_hold) return phase;
    const auto answer = held_within(bounds, phase, motion.position, motion.velocity, effort);
    phase.held = answer.held;
    for (int j = 0; j < joint_count; ++j) {
      const bool held = answer.held[j];
      phase.any_held = phase.any_held || held;
      const bool breaks_away = !held && bounds.lower[j] < bounds.upper[j];
      if (breaks_away) phase.sliding[j] = answer.effort[j];
    }
    return phase;
  }

  /// A Runge-Kutta step within one phase.
  template <class Drives>
  [[nodiscard]] Motion<joint_count> smooth_step(const Phase& phase,
                                                const Motion<joint_count>& motion,
                                                const Drives& effort, double step) const noexcept {
    if (!phase.any_held) {
      return runge_kutta_step<joint_count>(
          motion, step, [&](const auto& q, const auto& v) noexcept {
            return forward_dynamics(robot_, q, v, applied(phase, v, effort(q, v)));
          });
    }
    EffortBounds<joint_count> bounds;
    for (int j = 0; j < joint_count; ++j) {
      if (!phase.held[j]) continue;
      bounds.lower[j] = -JointLimits::infinity;
      bounds.upper[j] = JointLimits::infinity;
    }
    return runge_kutta_step<joint_count>(motion, step, [&](const auto& q, const auto& v) noexcept {
      return held_within(bounds, phase, q, v, effort).motion;
    });
  }

  /// The efforts on the joints: of the drives, of friction where joints slide, and of damping.
  [[nodiscard]] JointVector<joint_count> applied(
      const Phase& phase, const JointVector<joint_count>& v,
      const JointVector<joint_count>& drives) const noexcept {
    return for_each_joint<joint_count>(
        [&](int j) noexcept { return drives[j] + phase.sliding[j] - damping_[j] * v[j]; });
  }

  /// The accelerations where friction and stops hold joints still as far as they can. What pulls on
  /// the joints is M times the acceleration that they would have without: another program, of the
  /// nonlinear effects, would be less to compute, but more to compile for every simulator.
  template <class Drives>
  [[nodiscard]] BoundedEffort<joint_count> held_within(const EffortBounds<joint_count>& bounds,
                                                       const Phase& phase,
                                                       const JointVector<joint_count>& q,
                                                       const JointVector<joint_count>& v,
                                                       const Drives& effort) const noexcept {
    const JointVector<joint_count> free =
        forward_dynamics(robot_, q, v, applied(phase, v, effort(q, v)));
    const JointMatrix<joint_count> m = mass_matrix(robot_, q);
    return hold_within_bounds<joint_count>(parents_, m, product<joint_count>(m, free), bounds);
  }

  /// How far a joint has passed its stop, or one that slid against friction has turned back, at
  /// most; positive after an event. [rad or m; W]
  [[nodiscard]] double excess(const Phase& phase, const Motion<joint_count>& later) const noexcept {
    double most = -JointLimits::infinity;
    for (int j = 0; j < joint_count; ++j) {
      if (phase.held[j]) continue;
      most = std::max({most, lower_[j] - later.position[j], later.position[j] - upper_[j]});
      if (phase.sliding[j] != 0) most = std::max(most, later.velocity[j] * phase.sliding[j]);
    }
    return most;
  }

  /// Puts joints that have just passed their stop onto it, and brings those that friction has
  /// stopped to rest.
  [[nodiscard]] Motion<joint_count> settle(const Phase& phase,
                                           Motion<joint_count> motion) const noexcept {
    for (int j = 0; j < joint_count; ++j) {
      motion.position[j] = std::clamp(motion.position[j], lower_[j], upper_[j]);
      if (motion.velocity[j] * phase.sliding[j] > 0) motion.velocity[j] = 0;
    }
    return motion;
  }

  [[no_unique_address]] R robot_;
  JointVector<joint_count> lower_;
  JointVector<joint_count> upper_;
  JointVector<joint_count> damping_;
  JointVector<joint_count> friction_;
  JointArray<int, joint_count> parents_;
};

}  // namespace articula
