// SPDX-License-Identifier: Apache-2.0
/// @file The PID law of each joint, without limits on the total.
#pragma once

#include "articula/control/laws/joint_pid.hpp"
#include "articula/control/laws/sampled_feedback.hpp"
#include "articula/core/joint_reference.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/model/robot.hpp"

#include <array>
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
template <int N, PidOf Variable = PidOf::position>
class PidLaw {
 public:
  /// For joints that have two ends.
  /// @param gains  of the N joints
  /// @param names  of the same joints, for the error message
  /// @throws std::invalid_argument naming joint, gain and value, see validate
  PidLaw(const JointPidGains<N>& gains, const JointNames<N>& names)
      : PidLaw(ValidPidGains<N>(gains, names)) {}

  /// For a robot's joints, of which the continuous ones take the short way round.
  /// @throws std::invalid_argument naming joint, gain and value, see validate
  template <Robot R>
    requires(joint_count<R> == N)
  PidLaw(const R& robot, const JointPidGains<N>& gains)
      : PidLaw(ValidPidGains<N>(gains, joint_names(robot))) {
    if constexpr (Variable == PidOf::position) {
      for (std::size_t i = 0; i < turns_.size(); ++i) {
        const bool turns = model_of(robot).joints[i].type == JointType::continuous;
        turns_[i] = turns ? 2 * std::numbers::pi : 0;
      }
    }
  }

  /// Forgets the past. Real-time: yes.
  void start(const JointState<N>&) noexcept {
    for (JointPid& pid : pids_) pid.start();
  }

  /// The output u of each joint, N x 1.
  /// @param state      position and velocity are used
  /// @param reference  position and velocity are used, acceleration by a feed-forward gain
  /// @param period     dt [s]
  /// Real-time: yes. O(N).
  [[nodiscard]] JointVector<N> effort(const JointState<N>& state,
                                      const JointReference<N>& reference, double period) noexcept {
    JointVector<N> output;
    for (int j = 0; j < N; ++j) {
      const auto i = static_cast<std::size_t>(j);
      const PidGains& g = gains_[i];
      PidInput in{.velocity_reference = reference.velocity[j],
                  .acceleration_reference = reference.acceleration[j]};
      if constexpr (Variable == PidOf::position) {
        in.error = JointPid::short_way(reference.position[j] - state.position[j], turns_[i]);
        in.measured = state.position[j];
        in.rate_error = g.velocity_weight * reference.velocity[j] - state.velocity[j];
      } else {
        in.error = reference.velocity[j] - state.velocity[j];
        in.measured = state.velocity[j];
        in.rate_is_measured = false;
      }
      output[j] = pids_[i].update(g, in, period, turns_[i]);
    }
    return output;
  }

  /// Lets the integrals begin with the effort that was given last: the load that it has carried.
  /// What p and d ask for comes on top of it. If it may have been a push, joints whose integral
  /// could not take that back soon begin with 0, see JointPid::prime.
  /// @return  the integral terms and feed-forwards, N x 1
  /// Real-time: yes. O(N).
  JointVector<N> prime(const JointState<N>&, const JointReference<N>& reference, double,
                       const JointVector<N>& effort, LastCommand is = LastCommand::any) noexcept {
    JointVector<N> share;
    for (int j = 0; j < N; ++j) {
      const auto i = static_cast<std::size_t>(j);
      const PidGains& g = gains_[i];
      const double feedforward = g.velocity_feedforward * reference.velocity[j] +
                                 g.acceleration_feedforward * reference.acceleration[j];
      pids_[i].prime(g, effort[j] - feedforward, is);
      share[j] = pids_[i].integral() + feedforward;
    }
    return share;
  }

  /// Keeps the integrals from winding up behind a limit, as each joint's gains say.
  /// @param excess  total minus limited total, N x 1
  /// Real-time: yes. O(N).
  void limited(const JointVector<N>& excess) noexcept {
    for (int j = 0; j < N; ++j) {
      const auto i = static_cast<std::size_t>(j);
      if (excess[j] != 0) pids_[i].limited(gains_[i], excess[j]);
    }
  }

  /// Goes on with other gains. The integral terms, being in units of the output, stay as they are,
  /// as far as the new clamps allow in the next cycle; also where i becomes 0. Real-time: yes.
  void set_gains(const ValidPidGains<N>& gains) noexcept { gains_ = gains; }

  [[nodiscard]] const JointPidGains<N>& gains() const noexcept { return gains_.values(); }

  /// What becomes of one joint's measurements, see gain_notices. Real-time: yes.
  [[nodiscard]] SampledFeedback sampled_feedback(std::size_t joint) const noexcept {
    SampledFeedback feedback = SampledFeedback::of(gains_[joint]);
    feedback.of_velocity = Variable == PidOf::velocity;
    return feedback;
  }

  /// The integral terms I [output], N x 1. Real-time: yes.
  [[nodiscard]] JointVector<N> integral() const noexcept {
    JointVector<N> terms;
    for (int j = 0; j < N; ++j) terms[j] = pids_[static_cast<std::size_t>(j)].integral();
    return terms;
  }

 private:
  explicit PidLaw(const ValidPidGains<N>& gains) : gains_(gains) { start({}); }

  ValidPidGains<N> gains_;
  std::array<JointPid, static_cast<std::size_t>(N)> pids_{};
  std::array<double, static_cast<std::size_t>(N)> turns_{};  ///< a full turn [rad], or 0
};

}  // namespace articula
