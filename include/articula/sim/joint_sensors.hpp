// SPDX-License-Identifier: Apache-2.0
/// @file Measurements by encoders and noisy sensors.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/core/scalar.hpp"
#include "articula/sim/normal_noise.hpp"
#include "articula/sim/simulator_options.hpp"

#include <cmath>

namespace articula {

/// Measures a motion as encoders and sensors would: first noise is added, then the position is
/// quantised.
/// @tparam S  type of a number: double, or a pack of robots, each of which has noise of its own
template <int N, class S = double>
class JointSensors {
 public:
  explicit JointSensors(const SimulatorOptions<N>& options)
      : period_(options.period),
        resolution_(options.encoder_resolution),
        position_noise_(options.position_noise),
        velocity_noise_(options.velocity_noise),
        effort_noise_(options.effort_noise),
        has_noise_(
            !(position_noise_.isZero(0) && velocity_noise_.isZero(0) && effort_noise_.isZero(0))) {
    std::uint64_t seed = options.seed;
    for (NormalNoise& noise : noise_) noise = NormalNoise(seed++);
  }

  /// The measurement of a state, one period after the last measurement.
  /// Real-time: yes. O(N).
  [[nodiscard]] JointState<N, S> measure(const JointState<N, S>& truth) noexcept {
    JointState<N, S> measured = truth;
    if (has_noise_) {
      for (int j = 0; j < N; ++j) {
        measured.position[j] += position_noise_[j] * noise();
        measured.velocity[j] += velocity_noise_[j] * noise();
        measured.effort[j] += effort_noise_[j] * noise();
      }
    }
    for (int j = 0; j < N; ++j) {
      if (resolution_[j] == 0) continue;
      S steps = measured.position[j] / resolution_[j];
      for (int k = 0; k < lanes<S>; ++k) set_lane(steps, k, std::nearbyint(lane_of(steps, k)));
      measured.position[j] = resolution_[j] * steps;
      if (measured_before_) {
        measured.velocity[j] = (measured.position[j] - last_position_[j]) / period_;
      }
    }
    last_position_ = measured.position;
    measured_before_ = true;
    return measured;
  }

 private:
  [[nodiscard]] S noise() noexcept {
    S numbers(0);
    for (int k = 0; k < lanes<S>; ++k) set_lane(numbers, k, noise_[k].next());
    return numbers;
  }

  double period_;
  JointVector<N> resolution_;
  JointVector<N> position_noise_;
  JointVector<N> velocity_noise_;
  JointVector<N> effort_noise_;
  bool has_noise_;
  bool measured_before_ = false;
  JointVector<N, S> last_position_ = JointVector<N, S>::Zero();
  JointArray<NormalNoise, lanes<S>> noise_;
};

}  // namespace articula
