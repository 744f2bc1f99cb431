// SPDX-License-Identifier: Apache-2.0
/// @file Computed torque control: inverse dynamics with a PID on the errors.
#pragma once

#include "articula/control/laws/feedforward.hpp"
#include "articula/control/laws/friction_compensation.hpp"
#include "articula/control/laws/part_scope.hpp"
#include "articula/control/laws/pid_law.hpp"
#include "articula/control/laws/sum_controller.hpp"
#include "articula/dynamics/forward_dynamics.hpp"
#include "articula/dynamics/gravity.hpp"
#include "articula/dynamics/inverse_dynamics.hpp"
#include "articula/model/dynamic_robot.hpp"

#include <string_view>

namespace articula {

/// The effort that makes the rigid bodies accelerate as reference and feedback ask:
/// effort = M(q) (a_ref + PID(q_ref - q, v_ref - v)) + h(q, v), where the PID's output is an
/// acceleration.
/// @tparam R  the robot
template <Robot R>
class ComputedTorqueLaw {
  static_assert(detail::has_masses<R, ComputedTorqueLaw>);

 public:
  static constexpr int joint_count = articula::joint_count<R>;

  /// @param robot  its model does the work
  /// @param gains  of the feedback: proportional [1/s^2], integral [1/s^3], derivative [1/s],
  ///               clamps in rad/s^2 or m/s^2
  /// @throws std::invalid_argument naming joint, gain and value, see validate
  ComputedTorqueLaw(const R& robot, const JointPidGains<joint_count>& gains)
      : robot_(robot), feedback_(robot, gains) {}

  /// Forgets the integral. If a command was applied, the integrals begin with the acceleration that
  /// the effort would cause beyond a_ref, see PidLaw.
  /// @return  the effort that reference and integrals ask for if a command was applied, else 0
  ///          [N m or N], N x 1
  /// Real-time: yes.
  JointVector<joint_count> start(const ControlInput<joint_count>& in) noexcept {
    ControlInput<joint_count> inner{in.state, in.reference, in.period, in.applied};
    if (!in.applied.reached_drives()) return feedback_.start(inner);
    inner.applied.numbers =
        forward_dynamics(robot_, in.state.position, in.state.velocity, in.applied.numbers) -
        in.reference.acceleration;
    const JointVector<joint_count> acceleration =
        in.reference.acceleration + feedback_.start(inner);
    return inverse_dynamics(robot_, in.state.position, in.state.velocity, acceleration);
  }

  /// The effort [N m or N], N x 1. The feedback asks for accelerations, so its cut is the
  /// acceleration that was lost, M(q)^-1 cut at the position of the cut output. Through the coupling
  /// of the joints an effort may be cut off on the side that its own joint is not asked to go to.
  /// Real-time: yes.
  [[nodiscard]] JointVector<joint_count> output(const ControlInput<joint_count>& in) noexcept {
    ControlInput<joint_count> inner{in.state, in.reference, in.period, in.applied, in.cut};
    if ((in.cut.array() != 0).any()) {
      // M^-1 cut is the acceleration from rest that the cut causes beyond what carries the robot.
      const JointVector<joint_count> rest = JointVector<joint_count>::Zero();
      inner.cut = forward_dynamics(robot_, position_, rest, in.cut + gravity(robot_, position_));
    }
    position_ = in.state.position;
    const JointVector<joint_count> acceleration =
        in.reference.acceleration + feedback_.output(inner);
    return inverse_dynamics(robot_, in.state.position, in.state.velocity, acceleration);
  }

  /// Goes on with other gains of the feedback. Real-time: yes.
  void set_gains(const ValidPidGains<joint_count>& gains) noexcept { feedback_.set_gains(gains); }

  /// Calls function(feedback, scope): the PID, whose output is an acceleration.
  void for_each_part(auto&& function) const {
    function(feedback_, PartScope<joint_count>{.asks_acceleration = true});
  }

 private:
  [[no_unique_address]] R robot_;
  JointVector<joint_count> position_ = JointVector<joint_count>::Zero();  ///< q of the last cycle
  PidLaw<joint_count> feedback_;
};

/// Computed torque control (inverse dynamics control): with an exact model every joint's error
/// obeys e'' + d e' + p e = 0, whatever the others do.
/// effort = clamp(M(q) (a_ref + PID) + h(q, v) + D v + f sign(v) + effort_ref).
/// Uses all of the reference.   Source: [Siciliano et al. 2009, section 8.5.2].
/// @tparam R  the robot
template <Robot R>
class ComputedTorque : public EffortController<R, ComputedTorqueLaw<R>, FrictionCompensation<R>,
                                               EffortFeedforward<joint_count<R>>> {
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
  ComputedTorque(const R& robot, const JointPidGains<joint_count>& gains)
      : EffortController<R, ComputedTorqueLaw<R>, FrictionCompensation<R>,
                         EffortFeedforward<joint_count>>(robot, ComputedTorqueLaw<R>(robot, gains),
                                                         FrictionCompensation<R>(robot), {}) {}
  /// For a robot known at compile time.
  explicit ComputedTorque(const JointPidGains<joint_count>& gains)
    requires DescribedRobot<R>
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
