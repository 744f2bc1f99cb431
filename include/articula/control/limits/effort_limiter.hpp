// SPDX-License-Identifier: Apache-2.0
/// @file Efforts under which the joints keep their limits.
#pragma once

#include "articula/control/limits/joint_limiter.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/core/refuse.hpp"
#include "articula/dynamics/friction_effort.hpp"
#include "articula/dynamics/mass_matrix.hpp"
#include "articula/dynamics/nonlinear_effects.hpp"
#include "articula/model/dynamic_robot.hpp"

#include <Eigen/Cholesky>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace articula {

/// Efforts under which the joints keep their limits of position, velocity, acceleration and jerk in
/// the coming cycle, as the model foresees it: a constant effort makes
///
///     effort = m a + bias,   m = M(q) + D dt/2,   bias = h(q, v) + D v + f sign(v),
///
/// where damping acts at the velocity in the middle of the cycle. A joint whose acceleration a
/// breaks a limit is given one that does not, a' (JointLimiter), and the effort for it; the others
/// keep their efforts. That is Gauss's principle of least constraint: limits act like stops, on
/// their joint and on no other. As one joint held back changes what the others do, the joint that
/// breaks its limit most, by m_jj (a_j - a'_j)^2, is held back first, and the rest is looked at
/// again.
///
/// The limits of effort come last: what a drive cannot give cannot brake either. So A and B must be
/// what the drives can do in every posture, gravity included. No model is exact, so B should leave
/// a reserve; it is 0.8 A where it is not given.
/// @tparam R  the robot
template <Robot R>
class EffortLimiter {
  static_assert(detail::has_masses<R, EffortLimiter>);

 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Vector = JointVector<joint_count>;

  /// @param limits  that validate() accepts
  /// @param robot   its model foresees the motion
  /// @throws std::invalid_argument if a joint with position limits has neither acceleration nor
  ///         deceleration limited: nobody knows then when it must begin to brake
  EffortLimiter(const R& robot, const CommandLimits<joint_count>& limits)
      : robot_(robot),
        limits_(limits),
        damping_(joint_values(robot, [](const JointProperties& joint) { return joint.damping; })) {
    for (int j = 0; j < joint_count; ++j) {
      CommandLimits<joint_count> with_reserve = limits;
      if (!is_finite(limits.deceleration[j])) {
        with_reserve.deceleration[j] = 0.8 * limits.acceleration[j];
      }
      limiters_[index(j)] = JointLimiter(with_reserve, j);
      const bool has_ends = is_finite(limits.lower[j]) || is_finite(limits.upper[j]);
      const bool can_brake = is_finite(limits.acceleration[j]) || is_finite(limits.deceleration[j]);
      if (has_ends && !can_brake) {
        detail::refuse({"command limits of joint '", joint_names(robot)[index(j)],
                        "': its positions are limited (", limits.lower[j], " .. ", limits.upper[j],
                        "), but not how hard it brakes: give CommandLimits::acceleration, which "
                        "its drive can do in every posture, or deceleration"});
      }
    }
  }

  /// Begins anew from what is measured. Real-time: yes.
  void start(const JointState<joint_count>& state, double period) noexcept {
    set_period(period);
    effort_ = state.effort.cwiseMax(-limits_.effort).cwiseMin(limits_.effort);
    acceleration_.setZero();
  }

  /// Goes on from an effort that was given in place of the last one, or by others, N x 1; not from
  /// one that is not finite. Real-time: yes.
  void given(const Vector& effort) noexcept {
    if (is_finite(effort)) effort_ = effort.cwiseMax(-limits_.effort).cwiseMin(limits_.effort);
  }

  /// Goes on with cycles of another length [s]. Real-time: yes.
  void set_period(double period) noexcept {
    for (JointLimiter& limiter : limiters_) limiter.start({}, period);
    period_ = period;
  }

  /// The effort for the coming cycle. Without a good state it is zero; without a good wish the
  /// joints brake.
  /// @param state   measured joints
  /// @param asked   the wish [N m or N], N x 1
  /// @param report  what changed it is added here
  /// @param stiffness, damping  K and D of springs and dampers in the drives, which change the
  ///                effort within the cycle [N m/rad or N/m; N m s/rad or N s/m], N x 1
  /// Real-time: yes. O(N^3), O(N^4) at most where many joints meet their limits.
  [[nodiscard]] Vector limit(const JointState<joint_count>& state, const Vector& asked,
                             LimitReport<joint_count>& report,
                             const Vector& stiffness = Vector::Zero(),
                             const Vector& damping = Vector::Zero()) noexcept {
    if (!is_finite(state)) {
      for (JointLimitReport& joint : report) joint.non_finite = true;
      effort_.setZero();
      acceleration_.setZero();
      return effort_;
    }
    const Vector rate = limits_.effort_rate * period_;
    const Vector lowest = (effort_ - rate).cwiseMax(-limits_.effort);
    const Vector highest = (effort_ + rate).cwiseMin(limits_.effort);
    for (int j = 0; j < joint_count; ++j) {
      report[index(j)].effort = std::abs(asked[j]) > limits_.effort[j];
      report[index(j)].effort_rate = std::abs(asked[j] - effort_[j]) > rate[j];
    }
    Vector effort = asked.cwiseMax(lowest).cwiseMin(highest);

    const Vector& q = state.position;
    const Vector& v = state.velocity;
    Matrix m = mass_matrix(robot_, q);
    // Means over a cycle of constant acceleration a: v grows by a dt/2, q by v dt/2 + a dt^2/6.
    m.diagonal() += (damping_ + damping) * period_ / 2 + stiffness * period_ * period_ / 6;
    const Vector bias = nonlinear_effects(robot_, q, v) - friction_effort(robot_, v) +
                        stiffness.cwiseProduct(v) * period_ / 2;
    for (int j = 0; j < joint_count; ++j) {
      // With a constant acceleration over the cycle, q + v dt/2 and v are motions in differences.
      limiters_[index(j)].measured(
          CommandMotion{q[j] + v[j] * period_ / 2, v[j], acceleration_[j]});
    }

    const bool brake = !is_finite(asked);
    Mask held;  // 1 for the joints whose acceleration is given, 0 for those whose effort is
    held.setConstant(brake);
    if (brake) effort.setZero();
    Vector acceleration = Vector::Zero();
    for (int j = 0; brake && j < joint_count; ++j) {
      static_cast<void>(
          limiters_[index(j)].move(std::numeric_limits<double>::quiet_NaN(), report[index(j)]));
      acceleration[j] = limiters_[index(j)].motion().acceleration;
    }
    Mask weak = Mask::Zero();  // 1 for the joints whose drive cannot hold them
    bool changed = brake;
    // Each round but the last holds a joint or gives some up, and none is held again. Only when all
    // are held that must be does it show whose drive is too weak.
    for (int round = 0; round <= 2 * joint_count; ++round) {
      solve(m, bias, held, acceleration, effort);
      const int j = worst_joint(m, held + weak, v, acceleration, report);
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
      report[index(j)].effort = report[index(j)].effort || weak[j] != 0;
      if (!is_finite(effort[j])) effort[j] = 0;
    }
    acceleration_ = is_finite(acceleration) ? acceleration : Vector(Vector::Zero());
    effort_ = effort.cwiseMax(lowest).cwiseMin(highest);
    return effort_;
  }

 private:
  using Matrix = JointMatrix<joint_count>;
  using Mask = Eigen::Array<double, joint_count, 1>;

  [[nodiscard]] static constexpr std::size_t index(int j) noexcept {
    return static_cast<std::size_t>(j);
  }

  /// Solves effort = m a + bias, where a_j is given for the joints that are held, and effort_j for
  /// the others.
  static void solve(const Matrix& m, const Vector& bias, const Mask& held, Vector& acceleration,
                    Vector& effort) noexcept {
    const Vector free = 1 - held;
    const Vector given = held * acceleration.array();
    Matrix system = free.asDiagonal() * m * free.asDiagonal();
    system.diagonal().array() += held;
    const Vector right = given + free.cwiseProduct(effort - bias - m * given);
    acceleration = system.llt().solve(right);
    const Vector all = m * acceleration + bias;
    effort = (held != 0).select(all.array(), effort.array());
  }

  /// The joint that breaks its limits most, put to the acceleration that does not; -1: none does.
  [[nodiscard]] int worst_joint(const Matrix& m, const Mask& decided, const Vector& v,
                                Vector& acceleration,
                                LimitReport<joint_count>& report) const noexcept {
    int worst = -1;
    double most = 0, instead = 0;
    JointLimitReport reason;
    for (int j = 0; j < joint_count; ++j) {
      if (decided[j] != 0) continue;
      JointLimiter trial = limiters_[index(j)];
      JointLimitReport why = report[index(j)];
      if (trial.move(v[j] + acceleration[j] * period_, why)) continue;
      const double granted = trial.motion().acceleration;
      const double change = acceleration[j] - granted;
      const double weight = m(j, j) * change * change;
      if (worst >= 0 && !(weight > most)) continue;
      worst = j;
      most = weight;
      instead = granted;
      reason = why;
    }
    if (worst >= 0) {
      acceleration[worst] = instead;
      report[index(worst)] = reason;
    }
    return worst;
  }

  [[no_unique_address]] R robot_;
  CommandLimits<joint_count> limits_;
  Vector damping_;
  std::array<JointLimiter, static_cast<std::size_t>(joint_count)> limiters_{};
  Vector effort_ = Vector::Zero();        ///< that was given last
  Vector acceleration_ = Vector::Zero();  ///< that it causes by the model
  double period_ = 1e-3;
};

}  // namespace articula
