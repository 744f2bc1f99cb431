// SPDX-License-Identifier: Apache-2.0
/// @file Measurements by encoders and noisy sensors.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/core/scalar.hpp"
#include "articula/sim/normal_noise.hpp"
#include "articula/sim/simulator_options.hpp"

#include <cmath>
#include <cstdint>

namespace articula {

/// Measures a motion as encoders and sensors would: first noise is added, then the position is
/// quantised.
/// @tparam S  type of a number: double, or a pack of robots, each of which has noise of its own
template <int N, class S = double>
class JointSensors {
 public:
  /// The same sensors for all robots of a pack, with the seeds `seed`, `seed` + 1 and so on.
  explicit JointSensors(const SimulatorOptions<N>& options)
      : period_(options.period),
        resolution_(options.encoder_resolution.template cast<S>()),
        position_noise_(options.position_noise.template cast<S>()),
        velocity_noise_(options.velocity_noise.template cast<S>()),
        effort_noise_(options.effort_noise.template cast<S>()),
        has_noise_(is_noisy(options)),
        has_encoder_(!options.encoder_resolution.isZero(0)) {
    std::uint64_t seed = options.seed;
    for (std::uint64_t& own : seeds_) own = seed++;
  }

  /// Sensors and seeds of each robot of a pack.
  explicit JointSensors(const JointArray<SimulatorOptions<N>, lanes<S>>& options)
      : JointSensors(options[0]) {
    has_noise_ = has_encoder_ = false;
    for (int k = 0; k < lanes<S>; ++k) {
      const SimulatorOptions<N>& own = options[k];
      set_lane(resolution_, k, own.encoder_resolution);
      set_lane(position_noise_, k, own.position_noise);
      set_lane(velocity_noise_, k, own.velocity_noise);
      set_lane(effort_noise_, k, own.effort_noise);
      has_noise_ = has_noise_ || is_noisy(own);
      has_encoder_ = has_encoder_ || !own.encoder_resolution.isZero(0);
      seeds_[k] = own.seed;
    }
  }

  /// The measurement of a state, one period after the last measurement.
  /// Real-time: yes. O(N).
  [[nodiscard]] JointState<N, S> measure(const JointState<N, S>& truth) noexcept {
    JointState<N, S> measured = truth;
    if (has_noise_) add_noise(measured);
    ++cycle_;
    if (!has_encoder_) return measured;
    for (int j = 0; j < N; ++j) {
      const auto is_exact = resolution_[j] == 0;
      if (all_of(is_exact)) continue;
      S steps = measured.position[j] / resolution_[j];
      for (int k = 0; k < lanes<S>; ++k) set_lane(steps, k, std::nearbyint(lane_of(steps, k)));
      measured.position[j] = select(is_exact, measured.position[j], S(resolution_[j] * steps));
      if (measured_before_) {
        const S change = (measured.position[j] - last_position_[j]) / period_;
        measured.velocity[j] = select(is_exact, measured.velocity[j], change);
      }
    }
    last_position_ = measured.position;
    measured_before_ = true;
    return measured;
  }

 private:
  [[nodiscard]] static bool is_noisy(const SimulatorOptions<N>& options) {
    return !(options.position_noise.isZero(0) && options.velocity_noise.isZero(0) &&
             options.effort_noise.isZero(0));
  }
  void add_noise(JointState<N, S>& state) const noexcept {
    for (int j = 0; j < N; ++j) {
      const auto [position, velocity] = normal_noise<S>(seeds_, cycle_, j, 1);
      state.position[j] += position_noise_[j] * position;
      state.velocity[j] += velocity_noise_[j] * velocity;
      if (all_of(effort_noise_[j] == 0)) continue;
      state.effort[j] += effort_noise_[j] * normal_noise<S>(seeds_, cycle_, j, 2).first;
    }
  }

  double period_;
  JointVector<N, S> resolution_;
  JointVector<N, S> position_noise_;
  JointVector<N, S> velocity_noise_;
  JointVector<N, S> effort_noise_;
  bool has_noise_;
  bool has_encoder_;
  bool measured_before_ = false;
  JointVector<N, S> last_position_ = JointVector<N, S>::Zero();
  JointArray<std::uint64_t, lanes<S>> seeds_{};
  std::uint64_t cycle_ = 0;  ///< number of the next measurement
};

}  // namespace articula
