// SPDX-License-Identifier: Apache-2.0
/// @file Limits of efforts that keep the joints' motion within limits.
#pragma once

#include "articula/control/limits/limit_motion.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/core/refuse.hpp"
#include "articula/dynamics/engine/evaluate.hpp"
#include "articula/dynamics/engine/tree_factors.hpp"
#include "articula/dynamics/friction_effort.hpp"
#include "articula/dynamics/mass_matrix.hpp"
#include "articula/dynamics/nonlinear_effects.hpp"
#include "articula/model/robot.hpp"

#include <cmath>
#include <limits>

namespace articula {

/// The state of the effort limits of N joints between two cycles.
template <int N>
struct EffortLimitState {
  JointVector<N> effort = JointVector<N>::Zero();        ///< the last command [N m or N], N x 1
  JointVector<N> acceleration = JointVector<N>::Zero();  ///< its acceleration by the model, N x 1
};

/// The result of a step within effort limits.
template <int N>
struct EffortStep {
  EffortLimitState<N> next{};  ///< `next.effort` is the command
  LimitReport<N> report{};     ///< the limits that changed the request
};

/// Limits efforts so that the joints keep their limits of position, velocity, acceleration and jerk
/// in the coming cycle, as the model predicts. A constant effort makes
///
///     effort = m a + bias,   m = M(q) + D dt/2,   bias = h(q, v) + D v + f sign(v),
///
/// where damping acts at the velocity in the middle of the cycle. A joint whose acceleration a
/// violates a limit receives an acceleration a' that does not (limit_motion), and the effort for
/// it. The others keep their efforts. This is Gauss's principle of least constraint: limits act
/// like stops, on their own joint only. Holding one joint changes the motion of the others. So the
/// joint with the largest m_jj (a_j - a'_j)^2 is held first, and the rest is checked again.
///
/// The limits of effort come last: a drive that is too weak cannot brake. So A and B must be what
/// the drives can do in every posture, gravity included. As no model is exact, B should leave a
/// reserve; the default is 0.8 A.
///
/// The object is constant. The caller holds the state and passes it on from step to step.
template <Robot R>
class EffortLimiter {
  static_assert(detail::has_masses<R, EffortLimiter>);

 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Vector = JointVector<joint_count>;
  using State = EffortLimitState<joint_count>;

  /// @param robot   its model predicts the motion
  /// @param limits  that validate() accepts
  /// @throws std::invalid_argument if a joint with position limits has neither acceleration nor
  ///         deceleration limits, which determine when it must begin to brake
  EffortLimiter(const R& robot, const CommandLimits<joint_count>& limits)
      : robot_(robot),
        limits_(limits),
        parents_(elimination_tree(model_of(robot).mechanism)),
        damping_(joint_values(robot, [](const JointProperties& joint) { return joint.damping; })) {
    for (int j = 0; j < joint_count; ++j) {
      if (!is_finite(limits.deceleration[j]))
        limits_.deceleration[j] = 0.8 * limits.acceleration[j];
      joint_limits_[j] = limits_.of_joint(j);
      const bool has_ends = is_finite(limits.lower[j]) || is_finite(limits.upper[j]);
      const bool can_brake = is_finite(limits.acceleration[j]) || is_finite(limits.deceleration[j]);
      if (has_ends && !can_brake) {
        detail::refuse({"command limits of joint '", model_of(robot).joints[j].name.view(),
                        "': its positions are limited (", limits.lower[j], " .. ", limits.upper[j],
                        "), but not its acceleration: set CommandLimits::acceleration to what the "
                        "drive can do in every posture, or set deceleration"});
      }
    }
  }

  /// Limits the efforts of the coming cycle. Without a finite state they are zero. If the request
  /// is not finite, the joints brake.
  /// @param last    the state after the last cycle; at the start, `effort` alone
  /// @param state   measured joints
  /// @param asked   the request [N m or N], N x 1
  /// @param period  dt > 0 of the coming cycle [s]
  /// @param stiffness, damping  K and D of springs and dampers in the drives, which change the
  ///                effort within the cycle [N m/rad or N/m; N m s/rad or N s/m], N x 1
  /// Real-time: yes. O(N^3), O(N^4) at most where many joints meet their limits.
  [[nodiscard]] EffortStep<joint_count> limit(
      const State& last, const JointState<joint_count>& state, const Vector& asked, double period,
      const Vector& stiffness = Vector::Zero(),
      const Vector& damping = Vector::Zero()) const noexcept {
    EffortStep<joint_count> result;
    LimitReport<joint_count>& report = result.report;
    if (!is_finite(state)) {
      for (JointLimitReport& joint : report) joint.non_finite = true;
      return result;
    }
    const Vector rate = limits_.effort_rate * period;
    const Vector before = last.effort.cwiseMax(-limits_.effort).cwiseMin(limits_.effort);
    const Vector lowest = (before - rate).cwiseMax(-limits_.effort);
    const Vector highest = (before + rate).cwiseMin(limits_.effort);
    for (int j = 0; j < joint_count; ++j) {
      report[j].effort = std::abs(asked[j]) > limits_.effort[j];
      report[j].effort_rate = std::abs(asked[j] - before[j]) > rate[j];
    }
    Vector effort = asked.cwiseMax(lowest).cwiseMin(highest);

    const Vector& q = state.position;
    const Vector& v = state.velocity;
    Matrix m = mass_matrix(robot_, q);
    // Means over a cycle of constant acceleration a: v grows by a dt/2, q by v dt/2 + a dt^2/6.
    m.diagonal() += (damping_ + damping) * period / 2 + stiffness * period * period / 6;
    const Vector bias = nonlinear_effects(robot_, q, v) - friction_effort(robot_, v) +
                        stiffness.cwiseProduct(v) * period / 2;
    JointArray<StoppingMotion, joint_count> motions;
    for (int j = 0; j < joint_count; ++j) {
      // With a constant acceleration over the cycle, q + v dt/2 and v are motions in differences.
      motions[j] = detail::stop_from({q[j] + v[j] * period / 2, v[j], last.acceleration[j]},
                                     joint_limits_[j], period);
      detail::use_reserve(motions[j], joint_limits_[j]);
    }

    const bool brake = !is_finite(asked);
    Mask held;  // 1 for joints with a prescribed acceleration, 0 for those with a prescribed effort
    held.setConstant(brake);
    if (brake) effort.setZero();
    Vector acceleration = Vector::Zero();
    for (int j = 0; brake && j < joint_count; ++j) {
      const MotionStep step =
          limit_motion(motions[j], not_a_number, joint_limits_[j], period, {}, report[j]);
      report[j] = step.report;
      acceleration[j] = step.next.motion().acceleration;
    }
    Mask weak = Mask::Zero();  // 1 for joints that their drives cannot hold
    bool changed = brake;
    // Each round but the last holds one more joint, or releases some for good. Which drives are too
    // weak is known only after all joints that need it are held.
    for (int round = 0; round <= 2 * joint_count; ++round) {
      solve(m, bias, held, acceleration, effort);
      const int j = worst_joint(m, held + weak, motions, period, acceleration, report);
      if (j >= 0) {
        held[j] = 1;
        changed = true;
        continue;
      }
      const Vector within = effort.cwiseMax(lowest).cwiseMin(highest);
      const Mask beyond = held * (effort.array() != within.array()).template cast<double>();
      if ((beyond == 0).all()) break;
      weak += beyond;
      held -= beyond;
      effort = within;
    }
    if (!changed) effort = asked.cwiseMax(lowest).cwiseMin(highest);  // to the last bit
    for (int j = 0; j < joint_count; ++j) {
      report[j].effort = report[j].effort || weak[j] != 0;
      if (!is_finite(effort[j])) effort[j] = 0;
    }
    if (is_finite(acceleration)) result.next.acceleration = acceleration;
    result.next.effort = effort.cwiseMax(lowest).cwiseMin(highest);
    return result;
  }

 private:
  using Matrix = JointMatrix<joint_count>;
  using Mask = Eigen::Array<double, joint_count, 1>;
  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

  /// Solves effort = m a + bias, where a_j is prescribed for the joints that are held, and effort_j
  /// for the others.
  void solve(const Matrix& m, const Vector& bias, const Mask& held, Vector& acceleration,
             Vector& effort) const noexcept {
    JointRows<double, joint_count> system = detail::to_rows(m);
    JointArray<double, joint_count> right;
    for (int j = 0; j < joint_count; ++j) right[j] = effort[j] - bias[j];
    // Held joints leave the equations: what they cost the others goes to the right-hand side.
    for (int h = 0; h < joint_count; ++h) {
      if (held[h] == 0) continue;
      for (int i = 0; i < joint_count; ++i) {
        right[i] -= m(i, h) * acceleration[h];
        system[i][h] = system[h][i] = 0;
      }
    }
    for (int h = 0; h < joint_count; ++h) {
      if (held[h] == 0) continue;
      right[h] = acceleration[h];
      system[h][h] = 1;
    }
    const auto factors = factorise<double, joint_count>(parents_, system);
    acceleration =
        detail::to_vector(articula::solve<double, joint_count>(parents_, factors, right));
    for (int h = 0; h < joint_count; ++h) {
      if (held[h] == 0) continue;
      effort[h] = bias[h];
      for (int i = 0; i < joint_count; ++i) effort[h] += m(i, h) * acceleration[i];
    }
  }

  /// Finds the undecided joint that violates its limits most, and sets its acceleration to one that
  /// does not. Returns -1 if there is none.
  [[nodiscard]] int worst_joint(const Matrix& m, const Mask& decided,
                                const JointArray<StoppingMotion, joint_count>& motions,
                                double period, Vector& acceleration,
                                LimitReport<joint_count>& report) const noexcept {
    int worst = -1;
    double most = 0;
    MotionStep instead;
    for (int j = 0; j < joint_count; ++j) {
      if (decided[j] != 0) continue;
      const double velocity = motions[j].motion().velocity + acceleration[j] * period;
      const MotionStep step =
          limit_motion(motions[j], velocity, joint_limits_[j], period, {}, report[j]);
      if (step.granted) continue;
      const double change = acceleration[j] - step.next.motion().acceleration;
      const double weight = m(j, j) * change * change;
      if (worst >= 0 && !(weight > most)) continue;
      worst = j;
      most = weight;
      instead = step;
    }
    if (worst >= 0) {
      acceleration[worst] = instead.next.motion().acceleration;
      report[worst] = instead.report;
    }
    return worst;
  }

  [[no_unique_address]] R robot_;
  CommandLimits<joint_count> limits_;
  JointArray<int, joint_count> parents_;  ///< elimination tree of the mass matrix
  JointArray<JointCommandLimits, joint_count> joint_limits_{};
  Vector damping_;
};

}  // namespace articula
