// SPDX-License-Identifier: Apache-2.0
/// @file Joint impedance control: a spring and a damper in each joint.
#pragma once

#include "articula/control/laws/feedforward.hpp"
#include "articula/control/laws/gravity_compensation.hpp"
#include "articula/control/laws/impedance_gains.hpp"
#include "articula/control/laws/sampled_feedback.hpp"
#include "articula/control/laws/sum_controller.hpp"

#include <string_view>

namespace articula {

/// A spring and a damper between each of N joints and its reference:
/// effort = K (q_ref - q) + D (v_ref - v).
/// @tparam N  number of joints
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <int N, class S = double>
class ImpedanceLaw {
 public:
  explicit ImpedanceLaw(const ValidImpedanceGains<N>& gains) : gains_(gains) {}

  /// The effort [N m or N], N x 1. Real-time: yes.
  [[nodiscard]] JointVector<N, S> output(const ControlInput<N, S>& in) const noexcept {
    JointVector<N, S> effort;
    for (int j = 0; j < N; ++j) {
      effort[j] = gains_[j].stiffness * (in.reference.position[j] - in.state.position[j]) +
                  gains_[j].damping * (in.reference.velocity[j] - in.state.velocity[j]);
    }
    return effort;
  }

  /// What becomes of one joint's measurements, see gain_notices. Real-time: yes.
  [[nodiscard]] SampledFeedback sampled_feedback(std::size_t joint) const noexcept {
    return {.proportional = gains_[joint].stiffness,
            .derivative = gains_[joint].damping,
            .proportional_name = "stiffness",
            .derivative_name = "damping"};
  }

  /// Goes on with other springs and dampers. Real-time: yes.
  void set_gains(const ValidImpedanceGains<N>& gains) noexcept { gains_ = gains; }

  [[nodiscard]] const JointImpedanceGains<N>& gains() const noexcept { return gains_.values(); }

 private:
  ValidImpedanceGains<N> gains_;
};

/// Joint impedance control. The robot, relieved of its weight, gives way to pushes as if each joint
/// hung on a spring and a damper. effort = clamp(K (q_ref - q) + D (v_ref - v) + g(q) +
/// effort_ref). Uses the reference's position, velocity and effort.
/// Source: [Siciliano et al. 2009, section 8.5.1], PD control with gravity compensation.
/// @tparam R  the robot
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <Robot R, class S = double>
class JointImpedance
    : public SumController<R, EffortCommand<joint_count<R>, S>, ImpedanceLaw<joint_count<R>, S>,
                           GravityCompensation<R, S>, EffortFeedforward<joint_count<R>, S>> {
 public:
  static constexpr std::string_view name = "joint_impedance";
  static constexpr int joint_count = articula::joint_count<R>;

  /// @param robot  whose weight is carried and whose effort limits hold
  /// @param gains  of each joint
  /// @throws std::invalid_argument naming joint, gain and value, see validate
  JointImpedance(const R& robot, const JointImpedanceGains<joint_count>& gains)
      : JointImpedance::SumController(robot,
                                      ImpedanceLaw<joint_count, S>({gains, joint_names(robot)}),
                                      GravityCompensation<R, S>(robot), {}) {}
  /// For a robot known at compile time.
  explicit JointImpedance(const JointImpedanceGains<joint_count>& gains)
    requires DescribedRobot<R>
      : JointImpedance(R(), gains) {}
};

}  // namespace articula
