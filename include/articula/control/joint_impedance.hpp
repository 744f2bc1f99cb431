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
template <int N>
class ImpedanceLaw {
 public:
  explicit ImpedanceLaw(const ValidImpedanceGains<N>& gains) : gains_(gains) {}

  /// The effort [N m or N], N x 1. Real-time: yes.
  [[nodiscard]] JointVector<N> output(const ControlInput<N>& in) const noexcept {
    JointVector<N> effort;
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

 private:
  ValidImpedanceGains<N> gains_;
};

/// Joint impedance control: the robot, relieved of its weight, gives way to pushes as if each joint
/// hung on a spring and a damper. effort = clamp(K (q_ref - q) + D (v_ref - v) + g(q) +
/// effort_ref). Uses the reference's position, velocity and effort.
/// Source: [Siciliano et al. 2009, section 8.5.1], PD control with gravity compensation.
/// @tparam R  the robot
template <Robot R>
class JointImpedance
    : public EffortController<R, ImpedanceLaw<joint_count<R>>, GravityCompensation<R>,
                              EffortFeedforward<joint_count<R>>> {
 public:
  static constexpr std::string_view name = "joint_impedance";
  static constexpr int joint_count = articula::joint_count<R>;

  /// @param robot  whose weight is carried and whose effort limits hold
  /// @param gains  of each joint
  /// @throws std::invalid_argument naming joint, gain and value, see validate
  JointImpedance(const R& robot, const JointImpedanceGains<joint_count>& gains)
      : EffortController<R, ImpedanceLaw<joint_count>, GravityCompensation<R>,
                         EffortFeedforward<joint_count>>(
            robot, ImpedanceLaw<joint_count>({gains, joint_names(robot)}),
            GravityCompensation<R>(robot), {}) {}
  /// For a robot known at compile time.
  explicit JointImpedance(const JointImpedanceGains<joint_count>& gains)
    requires DescribedRobot<R>
      : JointImpedance(R(), gains) {}
};

}  // namespace articula
