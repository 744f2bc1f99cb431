// SPDX-License-Identifier: Apache-2.0
/// @file The PID law of each joint, without limits on the total.
#pragma once

#include "articula/control/laws/joint_pid.hpp"
#include "articula/control/laws/pid_gains_lanes.hpp"
#include "articula/control/laws/sampled_feedback.hpp"
#include "articula/core/control_input.hpp"
#include "articula/core/joint_array.hpp"
#include "articula/core/scalar.hpp"
#include "articula/model/robot.hpp"

#include <concepts>
#include <cstddef>
#include <numbers>

namespace articula {

/// What a PID controls.
enum class PidOf : unsigned char {
  position,  ///< e = q_ref - q; on a continuous joint the short way round
  velocity,  ///< e = v_ref - v; no acceleration is measured, so its derivative is the change of -v,
             ///< or of the error where that is asked for
};

/// A PID for each of N joints, see JointPid. With the default gains beyond p, i, d and the
/// integral's clamps it is, for e = q_ref - q and the period dt,
///
///     I <- clamp(I + i e dt, integral_clamp_min, integral_clamp_max)
///     u  = p e + I + d (v_ref - v)
///
/// The derivative acts on measured velocity, so that a step of the reference position gives no
/// kick. While the total output is cut off by a limit, I does not grow in the direction that pushes
/// further.
/// @tparam N         number of joints
/// @tparam Variable  what is controlled; gains are per rad/s instead of rad where it is the
///                   velocity
/// @tparam S         type of a number: double, or a pack with the numbers of several robots. Gains
///                   are those of each lane, or PidGains for all lanes.
template <int N, PidOf Variable = PidOf::position, class S = double>
class PidLaw {
 public:
  static constexpr bool follows_position = Variable == PidOf::position;

  /// For joints that have two ends.
  /// @param gains  of the N joints
  /// @param names  of the same joints, for the error message
  /// @throws std::invalid_argument naming joint, gain and value, see validate
  PidLaw(const JointPidGains<N>& gains, const JointNames<N>& names) : PidLaw(valid(gains, names)) {}

  /// For a robot's joints, of which the continuous ones take the short way round.
  /// @throws std::invalid_argument naming joint, gain and value, see validate
  template <Robot R, PidGainsFor<N, S> Gains = JointPidGains<N>>
    requires(joint_count<R> == N)
  PidLaw(const R& robot, const Gains& gains) : PidLaw(valid(gains, joint_names(robot))) {
    if constexpr (Variable == PidOf::position) {
      for (std::size_t j = 0; j < turns_.size(); ++j) {
        const bool turns = model_of(robot).joints[j].type == JointType::continuous;
        turns_[j] = turns ? 2 * std::numbers::pi : 0;
      }
    }
  }

  /// Forgets the past. If a command was applied, the integrals begin with the load that it has
  /// carried. The outputs of p and d come on top of it. If it may have been a push, joints whose
  /// integral could not take that back soon begin with 0, see JointPid::prime.
  /// @return  the integral terms and feed-forwards if a command was applied, else 0, N x 1
  /// Real-time: yes. O(N).
  JointVector<N, S> start(const ControlInput<N, S>& in) noexcept {
    JointVector<N, S> share = JointVector<N, S>::Zero();
    for (int j = 0; j < N; ++j) {
      pids_[j].start();
      if (!in.applied.reached_drives()) continue;
      const BasicPidGains<S>& g = gains_[j];
      const S feedforward = g.velocity_feedforward * in.reference.velocity[j] +
                            g.acceleration_feedforward * in.reference.acceleration[j];
      pids_[j].prime(g, in.applied.numbers[j] - feedforward, in.applied.held);
      share[j] = pids_[j].integral() + feedforward;
    }
    return share;
  }

  /// The output u of each joint, N x 1. At first the integrals take back the cut of the last
  /// output, as each joint's gains say (AntiWindup).
  /// @param in  position and velocity of state and reference are used, and the reference's
  ///            acceleration by a feed-forward gain
  /// Real-time: yes. O(N).
  [[nodiscard, gnu::always_inline]] JointVector<N, S> output(
      const ControlInput<N, S>& in) noexcept {
    JointVector<N, S> output;
    for (int j = 0; j < N; ++j) {
      const BasicPidGains<S>& g = gains_[j];
      if (any_of(in.cut[j] != 0)) pids_[j].limit_windup(g, in.cut[j]);
      const S &q = in.state.position[j], &v = in.state.velocity[j];
      BasicPidInput<S> input{.velocity_reference = in.reference.velocity[j],
                             .acceleration_reference = in.reference.acceleration[j]};
      if constexpr (Variable == PidOf::position) {
        input.error = BasicJointPid<S>::short_way(in.reference.position[j] - q, turns_[j]);
        input.measured = q;
        input.rate_error = g.velocity_weight * in.reference.velocity[j] - v;
      } else {
        input.error = in.reference.velocity[j] - v;
        input.measured = v;
        input.rate_is_measured = false;
      }
      output[j] = pids_[j].update(g, input, in.period, turns_[j]);
    }
    return output;
  }

  /// Goes on with other gains. The integral terms are in units of the output. They stay as they
  /// are, also where i becomes 0, as far as the new clamps allow in the next cycle. The new gains'
  /// anti-windup takes back the cut of the last output. Real-time: yes.
  void set_gains(const ValidPidGains<N, S>& gains) noexcept { gains_ = gains; }

  [[nodiscard]] const JointPidGains<N, S>& gains() const noexcept { return gains_.values(); }

  /// What becomes of one joint's measurements, see gain_notices. Real-time: yes.
  [[nodiscard]] SampledFeedback sampled_feedback(std::size_t joint) const noexcept
    requires std::same_as<S, double>
  {
    SampledFeedback feedback = SampledFeedback::of(gains_[joint]);
    feedback.of_velocity = Variable == PidOf::velocity;
    return feedback;
  }

  /// The integral terms I in the last output [output], N x 1. Anti-windup changes them at the next
  /// output. Real-time: yes.
  [[nodiscard]] JointVector<N, S> integral() const noexcept {
    JointVector<N, S> terms;
    for (int j = 0; j < N; ++j) terms[j] = pids_[j].integral();
    return terms;
  }

 private:
  explicit PidLaw(const ValidPidGains<N, S>& gains) : gains_(gains) {}

  template <PidGainsFor<N, S> Gains>
  [[nodiscard]] static ValidPidGains<N, S> valid(const Gains& gains, const JointNames<N>& names) {
    if constexpr (std::same_as<Gains, JointPidGains<N, S>>) {
      return {gains, names};
    } else {
      return {in_all_lanes<S>(gains), names};
    }
  }

  ValidPidGains<N, S> gains_;
  JointArray<BasicJointPid<S>, N> pids_{};
  JointArray<double, N> turns_{};  ///< a full turn [rad], or 0
};

}  // namespace articula
