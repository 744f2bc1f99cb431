// SPDX-License-Identifier: Apache-2.0
/// @file Computed torque control: inverse dynamics with a PID on the errors.
#pragma once

#include "articula/control/composition/part_scope.hpp"
#include "articula/control/laws/feedforward.hpp"
#include "articula/control/laws/friction_compensation.hpp"
#include "articula/control/laws/pid_law.hpp"
#include "articula/control/laws/sum_controller.hpp"
#include "articula/dynamics/forward_dynamics.hpp"
#include "articula/dynamics/gravity.hpp"
#include "articula/dynamics/inverse_dynamics.hpp"
#include "articula/model/robot.hpp"

#include <string_view>

namespace articula {

/// The effort that makes the rigid bodies accelerate as reference and feedback ask. effort = M(q)
/// (a_ref + PID(q_ref - q, v_ref - v)) + h(q, v), where the PID's output is an acceleration.
/// @tparam R  the robot
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <Robot R, class S = double>
class ComputedTorqueLaw {
  static_assert(detail::has_masses<R, ComputedTorqueLaw>);

 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Vector = JointVector<joint_count, S>;
  using Input = ControlInput<joint_count, S>;

  /// @param robot  its model does the work
  /// @param gains  of the feedback: proportional [1/s^2], integral [1/s^3], derivative [1/s],
  ///               clamps in rad/s^2 or m/s^2
  /// @throws std::invalid_argument naming joint, gain and value, see validate
  template <PidGainsFor<joint_count, S> Gains = JointPidGains<joint_count>>
  ComputedTorqueLaw(const R& robot, const Gains& gains) : robot_(robot), feedback_(robot, gains) {}

  /// Forgets the integral. If a command was applied, the integrals begin with the acceleration that
  /// the effort would cause beyond a_ref, see PidLaw.
  /// @return  the effort that reference and integrals ask for if a command was applied, else 0
  ///          [N m or N], N x 1
  /// Real-time: yes.
  Vector start(const Input& in) noexcept {
    Input inner{in.state, in.reference, in.period, in.applied};
    if (!in.applied.reached_drives()) return feedback_.start(inner);
    inner.applied.numbers =
        forward_dynamics(robot_, in.state.position, in.state.velocity, in.applied.numbers) -
        in.reference.acceleration;
    const Vector acceleration = in.reference.acceleration + feedback_.start(inner);
    return inverse_dynamics(robot_, in.state.position, in.state.velocity, acceleration);
  }

  /// The effort [N m or N], N x 1. The feedback asks for accelerations. So its cut is the
  /// acceleration that was lost, M(q)^-1 cut at the position of the cut output. Through the
  /// coupling of the joints an effort may be cut off on the side that its own joint is not asked to
  /// go to.
  /// Real-time: yes.
  [[nodiscard]] Vector output(const Input& in) noexcept {
    Input inner{in.state, in.reference, in.period, in.applied};
    auto is_cut = in.cut[0] != 0;
    for (int j = 1; j < joint_count; ++j) is_cut = is_cut | (in.cut[j] != 0);
    if (any_of(is_cut)) {
      // M^-1 cut is the acceleration from rest that the cut causes beyond what carries the robot.
      const Vector load = in.cut + gravity(robot_, position_);
      const Vector lost = forward_dynamics(robot_, position_, Vector(Vector::Zero()), load);
      // Of a robot without a cut nothing is lost, not even by rounding.
      for (int j = 0; j < joint_count; ++j) inner.cut[j] = select(is_cut, lost[j], 0.0);
    }
    position_ = in.state.position;
    const Vector acceleration = in.reference.acceleration + feedback_.output(inner);
    return inverse_dynamics(robot_, in.state.position, in.state.velocity, acceleration);
  }

  /// The PID as a part, whose output is an acceleration; see HasParts.
  static auto parts(auto& self) noexcept { return std::tie(self.feedback_); }
  /// @copydoc parts
  /// Real-time: yes.
  [[nodiscard]] PartScope<joint_count> part_scope(std::size_t) const noexcept {
    return {.asks_acceleration = true};
  }

 private:
  [[no_unique_address]] R robot_;
  Vector position_ = Vector::Zero();  ///< q of the last cycle
  PidLaw<joint_count, PidOf::position, S> feedback_;
};

/// Computed torque control (inverse dynamics control). With an exact model every joint's error
/// obeys e'' + d e' + p e = 0, whatever the others do. effort = clamp(M(q) (a_ref + PID) + h(q, v)
/// + D v + f sign(v) + effort_ref). Uses all of the reference. Source: [Siciliano et al. 2009,
/// section 8.5.2].
/// @tparam R  the robot
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <Robot R, class S = double>
class ComputedTorque
    : public SumController<R, EffortCommand<joint_count<R>, S>, ComputedTorqueLaw<R, S>,
                           FrictionCompensation<R, S>, EffortFeedforward<joint_count<R>, S>> {
 public:
  static constexpr std::string_view name = "computed_torque";
  static constexpr int joint_count = articula::joint_count<R>;

  /// Critically damped errors that decay with exp(-20 t): 63 % of a step in about 0.1 s.
  ComputedTorque()
    requires DescribedRobot<R>
      : ComputedTorque(critically_damped(20)) {}

  /// @param robot  its model does the work
  /// @param gains  of the feedback: proportional [1/s^2], integral [1/s^3], derivative [1/s],
  ///               clamps in rad/s^2 or m/s^2
  /// @throws std::invalid_argument naming joint, gain and value, see validate
  template <PidGainsFor<joint_count, S> Gains = JointPidGains<joint_count>>
  ComputedTorque(const R& robot, const Gains& gains)
      : ComputedTorque::SumController(robot, {robot, gains}, FrictionCompensation<R, S>(robot),
                                      {}) {}
  /// For a robot known at compile time.
  explicit ComputedTorque(const JointPidGains<joint_count>& gains)
    requires DescribedRobot<R>
      : ComputedTorque(R(), gains) {}
  /// With gains of each lane.
  explicit ComputedTorque(const JointPidGains<joint_count, S>& gains)
    requires DescribedRobot<R> && PackedScalar<S>
      : ComputedTorque(R(), gains) {}

  /// Feedback gains for critically damped errors, the same for all joints: p = w^2, d = 2 w.
  /// @param bandwidth  w [rad/s], where every error decays as (1 + w t) exp(-w t)
  [[nodiscard]] static constexpr JointPidGains<joint_count> critically_damped(
      double bandwidth) noexcept {
    JointPidGains<joint_count> gains{};
    for (PidGains& g : gains) {
      g.proportional = bandwidth * bandwidth;
      g.derivative = 2 * bandwidth;
    }
    return gains;
  }
};

}  // namespace articula
