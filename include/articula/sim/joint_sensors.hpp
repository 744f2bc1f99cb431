// SPDX-License-Identifier: Apache-2.0
/// @file What encoders and noisy sensors make of a motion.
#pragma once

#include "articula/core/joint_state.hpp"
#include "articula/sim/normal_noise.hpp"
#include "articula/sim/simulator_options.hpp"

#include <cmath>

namespace articula {

/// Measures a motion as encoders and sensors would: noise first, then quantisation.
/// @tparam N  number of joints
template <int N>
class JointSensors {
 public:
  explicit JointSensors(const SimulatorOptions<N>& options)
      : period_(options.period),
        resolution_(options.encoder_resolution),
        position_noise_(options.position_noise),
        velocity_noise_(options.velocity_noise),
        effort_noise_(options.effort_noise),
        has_noise_(
            !(position_noise_.isZero(0) && velocity_noise_.isZero(0) && effort_noise_.isZero(0))),
        noise_(options.seed) {}

  /// The measurement of a state, one period after the one before.
  /// Real-time: yes. O(N).
  [[nodiscard]] JointState<N> measure(const JointState<N>& truth) noexcept {
    JointState<N> measured = truth;
    if (has_noise_) {
      for (int j = 0; j < N; ++j) {
        measured.position[j] += position_noise_[j] * noise_.next();
        measured.velocity[j] += velocity_noise_[j] * noise_.next();
        measured.effort[j] += effort_noise_[j] * noise_.next();
      }
    }
    for (int j = 0; j < N; ++j) {
      if (resolution_[j] == 0) continue;
      measured.position[j] = resolution_[j] * std::nearbyint(measured.position[j] / resolution_[j]);
      if (measured_before_)
        measured.velocity[j] = (measured.position[j] - last_position_[j]) / period_;
    }
    last_position_ = measured.position;
    measured_before_ = true;
    return measured;
  }

 private:
  double period_;
  JointVector<N> resolution_;
  JointVector<N> position_noise_;
  JointVector<N> velocity_noise_;
  JointVector<N> effort_noise_;
  bool has_noise_;
  bool measured_before_ = false;
  JointVector<N> last_position_ = JointVector<N>::Zero();
  NormalNoise noise_;
};

}  // namespace articula
