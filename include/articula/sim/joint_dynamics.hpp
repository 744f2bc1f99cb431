// SPDX-License-Identifier: Apache-2.0
/// @file Motion of a robot's joints under efforts: rigid bodies, damping, dry friction and stops.
#pragma once

#include "articula/core/scalar.hpp"
#include "articula/dynamics/forward_dynamics.hpp"
#include "articula/sim/bounded_effort.hpp"
#include "articula/sim/crossing.hpp"
#include "articula/sim/runge_kutta.hpp"

#include <algorithm>
#include <concepts>
#include <limits>

namespace articula {

/// Advances a robot in time under the efforts of its drives. Between events the motion is smooth,
/// and Runge-Kutta integrates it. An event is a joint that reaches its stop or that dry friction
/// brings to rest. It is located in time to the last bits and handled, and the step continues from
/// there. Stops are inelastic: an impulse through the mass matrix, which cannot add energy, takes
/// the joint's velocity. The stop then holds the joint as long as efforts push against it. Dry
/// friction holds a resting joint exactly.
template <Robot R>
class JointDynamics {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Vector = JointVector<joint_count>;
  template <class S = double>
  using State = JointState<joint_count, S>;

  explicit JointDynamics(const R& robot)
      : robot_(robot), parents_(elimination_tree(model_of(robot).mechanism)) {}

  /// The motion after one step.
  /// @param motion  position and velocity at its beginning; positions within the joints' limits
  /// @param effort  callable with (q, v) -> efforts of the drives [N m or N], N x 1
  /// @param step    [s]
  /// Real-time: yes if `effort` is, which is called in each stage of each Runge-Kutta step. One
  /// such step, and some ten more for each event, at most some fifty.
  template <class Drives>
  [[nodiscard]] State<> advance(State<> motion, const Drives& effort, double step) const noexcept {
    double rest = step;
    for (int event = 0; event < most_events && rest > 0; ++event) {
      if (any_at_stop(motion)) motion = after_impact(motion, Rebound::yes);
      const Phase<> phase = phase_at(motion, effort);
      State<> next = smooth_step(phase, motion, effort, rest);
      const double excess_at_end = excess(phase, next);
      if (!(excess_at_end > 0)) return next;

      const auto excess_after = [&](double time) noexcept {
        const auto there = smooth_step(phase, motion, effort, time);
        const double past = excess(phase, there);
        if (past > 0) next = there;
        return past;
      };
      rest -= locate_crossing({0, excess(phase, motion)}, {rest, excess_at_end},
                              std::numeric_limits<double>::epsilon() * step, excess_after);
      motion = settle(phase, next);
    }
    if (rest > 0) {  // impacts between joints at stops follow each other at ever shorter times
      motion = after_impact(motion, Rebound::no);
      const Phase<> phase = phase_at(motion, effort);
      motion = settle(phase, smooth_step(phase, motion, effort, rest));
    }
    return motion;
  }

  /// The motion of several robots after one step, and the lanes in which it is wrong, because an
  /// event occurs in this step.
  template <PackedScalar Pack>
  struct SmoothStep {
    State<Pack> motion;
    MaskOf<Pack> event;
  };

  /// The motion of several robots after one step without events.
  /// @tparam Pack   a scalar with the numbers of several robots
  /// @param motion, effort, step  as above
  /// @return        the motion; robots with an event must be advanced each alone
  /// Real-time: yes if `effort` is. One Runge-Kutta step, none if all robots have an event.
  template <PackedScalar Pack, class Drives>
  [[nodiscard]] SmoothStep<Pack> advance_smoothly(const State<Pack>& motion, const Drives& effort,
                                                  double step) const noexcept {
    const Phase<Pack> phase = phase_at(motion, effort);
    MaskOf<Pack> event = mask_of<Pack>(false);
    for (int j = 0; j < joint_count; ++j) {
      const Pack& v = motion.velocity[j];
      event |= (at_lower(motion, j) & (v < 0)) | (at_upper(motion, j) & (v > 0));
    }
    if (all_of(event)) return {motion, event};
    const State<Pack> next = smooth_step(phase, motion, effort, step);
    return {next, event | (excess(phase, next) > 0)};
  }

 private:
  static constexpr int most_events = 8 * joint_count;

  /// Whether a joint at its stop may leave it when the impact of another joint throws it back.
  enum class Rebound { yes, no };

  /// What is constant between two events.
  template <class S = double>
  struct Phase {
    bool any_held = false;  ///< some joint is held still, of any robot
    /// Infinite for joints that are held, else 0
    EffortBounds<joint_count, S> holding;
    /// Friction efforts of the joints that slide [N m or N], N x 1
    JointVector<joint_count, S> sliding = JointVector<joint_count, S>::Zero();
  };

  [[nodiscard]] const auto& joint(int j) const noexcept { return model_of(robot_).joints[j]; }
  /// Whether a joint of any robot has dry friction.
  [[nodiscard]] bool has_friction(int j) const noexcept { return any_of(joint(j).friction != 0); }
  /// Whether a joint is at its stop.
  template <class S>
  [[nodiscard]] MaskOf<S> at_lower(const State<S>& m, int j) const noexcept {
    return m.position[j] <= joint(j).limits.lower;
  }
  template <class S>
  [[nodiscard]] MaskOf<S> at_upper(const State<S>& m, int j) const noexcept {
    return m.position[j] >= joint(j).limits.upper;
  }
  [[nodiscard]] bool any_at_stop(const State<>& m) const noexcept {
    bool any = false;
    for (int j = 0; j < joint_count; ++j) any = any || at_lower(m, j) || at_upper(m, j);
    return any;
  }

  /// The motion after impacts at the stops. Without rebound, all joints at a stop come to rest,
  /// which takes more energy.
  [[nodiscard]] State<> after_impact(State<> motion, Rebound rebound) const noexcept {
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
      const Vector momentum = product<joint_count>(m, motion.velocity);
      motion.velocity = hold_within_bounds<joint_count>(parents_, m, momentum, impulse).motion;
    }
    return motion;
  }

  /// Which joints are held from here on, and how friction acts on the others.
  template <class S, class Drives>
  [[nodiscard]] Phase<S> phase_at(const State<S>& motion, const Drives& effort) const noexcept {
    constexpr double infinity = JointLimits::infinity;
    Phase<S> phase;
    EffortBounds<joint_count, S> bounds;
    bool may_hold = false;
    for (int j = 0; j < joint_count; ++j) {
      const S &v = motion.velocity[j], friction = joint(j).friction;
      const MaskOf<S> rests = v == 0;
      if (any_of(not_of(rests))) {
        phase.sliding[j] = select(v > 0, S(-friction), friction);
        if (!any_of(rests)) continue;
        phase.sliding[j] = select(rests, S(0), phase.sliding[j]);
      }
      bounds.lower[j] =
          select(rests, select(at_upper(motion, j), S(-infinity), S(-friction)), S(0));
      bounds.upper[j] = select(rests, select(at_lower(motion, j), S(infinity), friction), S(0));
      may_hold = may_hold || any_of(bounds.binds(j));
    }
    if (!may_hold) return phase;
    const auto answer = held_within(bounds, phase, motion.position, motion.velocity, effort);
    for (int j = 0; j < joint_count; ++j) {
      const MaskOf<S> held = answer.held[j], is_free = not_of(held), binds = bounds.binds(j);
      phase.any_held = phase.any_held || any_of(held);
      phase.holding.upper[j] = select(held, S(infinity), S(0));
      phase.holding.lower[j] = -phase.holding.upper[j];
      phase.sliding[j] = select(is_free & binds, answer.effort[j], phase.sliding[j]);
    }
    return phase;
  }

  /// A Runge-Kutta step within one phase.
  template <class S, class Drives>
  [[nodiscard]] State<S> smooth_step(const Phase<S>& phase, const State<S>& motion,
                                     const Drives& effort, double step) const noexcept {
    if (phase.any_held) {
      return runge_kutta_step(motion, step, [&](const auto& q, const auto& v) noexcept {
        return held_within(phase.holding, phase, q, v, effort).motion;
      });
    }
    return runge_kutta_step(motion, step, [&](const auto& q, const auto& v) noexcept {
      return forward_dynamics(robot_, q, v, applied(phase, v, effort(q, v)));
    });
  }

  /// The efforts on the joints: of the drives, of friction where joints slide, and of damping.
  template <class S>
  [[nodiscard]] JointVector<joint_count, S> applied(
      const Phase<S>& phase, const JointVector<joint_count, S>& v,
      const JointVector<joint_count, S>& drives) const noexcept {
    return for_each_joint<joint_count, S>(
        [&](int j) noexcept { return drives[j] + phase.sliding[j] - joint(j).damping * v[j]; });
  }

  /// The accelerations with joints held still as far as bounds allow. The load on the joints is M
  /// times the acceleration without bounds, for which no further program has to be compiled. A
  /// robot of a pack without bounds has that acceleration itself, to the last bit.
  template <class S, class Drives>
  [[nodiscard]] BoundedEffort<joint_count, S> held_within(
      const EffortBounds<joint_count, S>& bounds, const Phase<S>& phase,
      const JointVector<joint_count, S>& q, const JointVector<joint_count, S>& v,
      const Drives& effort) const noexcept {
    using Numbers = JointVector<joint_count, S>;
    const Numbers free = forward_dynamics(robot_, q, v, applied(phase, v, Numbers(effort(q, v))));
    const auto m = mass_matrix(robot_, q);
    auto answer =
        hold_within_bounds<joint_count>(parents_, m, product<joint_count>(m, free), bounds);
    if constexpr (PackedScalar<S>) {
      MaskOf<S> is_bound = mask_of<S>(false);
      for (int j = 0; j < joint_count; ++j) is_bound |= bounds.binds(j);
      for (int j = 0; j < joint_count; ++j) {
        answer.motion[j] = select(is_bound, answer.motion[j], free[j]);
      }
    }
    return answer;
  }

  /// By robot, the largest of two kinds of numbers. One is the distance of a joint beyond its stop
  /// [rad or m]. The other is the power that friction would give to a joint that has turned back
  /// [W]. Positive after an event.
  template <class S>
  [[nodiscard]] S excess(const Phase<S>& phase, const State<S>& later) const noexcept {
    S most = -JointLimits::infinity;
    for (int j = 0; j < joint_count; ++j) {
      const auto include = [&](S x) noexcept {
        if (phase.any_held) x = select(phase.holding.upper[j] > 0, S(-JointLimits::infinity), x);
        most = select(most < x, x, most);  // processors have a maximum
      };
      include(joint(j).limits.lower - later.position[j]);
      include(later.position[j] - joint(j).limits.upper);
      if (has_friction(j)) include(later.velocity[j] * phase.sliding[j]);
    }
    return most;
  }

  /// Puts joints beyond their stop onto it, and joints that friction has turned back to rest.
  [[nodiscard]] State<> settle(const Phase<>& phase, State<> motion) const noexcept {
    for (int j = 0; j < joint_count; ++j) {
      motion.position[j] =
          std::clamp(motion.position[j], joint(j).limits.lower, joint(j).limits.upper);
      if (motion.velocity[j] * phase.sliding[j] > 0) motion.velocity[j] = 0;
    }
    return motion;
  }

  [[no_unique_address]] R robot_;
  JointArray<int, joint_count> parents_;
};

}  // namespace articula
