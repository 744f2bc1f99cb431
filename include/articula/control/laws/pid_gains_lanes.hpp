// SPDX-License-Identifier: Apache-2.0
/// @file PID gains that differ from lane to lane.
#pragma once

#include "articula/control/laws/pid_gains.hpp"
#include "articula/core/scalar.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>

namespace articula {

/// The members of BasicPidGains that are numbers.
template <class S>
inline constexpr auto pid_gain_numbers = std::to_array<S BasicPidGains<S>::*>({
    &BasicPidGains<S>::proportional,
    &BasicPidGains<S>::integral,
    &BasicPidGains<S>::derivative,
    &BasicPidGains<S>::integral_clamp_min,
    &BasicPidGains<S>::integral_clamp_max,
    &BasicPidGains<S>::output_clamp_min,
    &BasicPidGains<S>::output_clamp_max,
    &BasicPidGains<S>::tracking_time,
    &BasicPidGains<S>::error_deadband,
    &BasicPidGains<S>::derivative_filter_time,
    &BasicPidGains<S>::position_weight,
    &BasicPidGains<S>::velocity_weight,
    &BasicPidGains<S>::velocity_feedforward,
    &BasicPidGains<S>::acceleration_feedforward,
});

/// The gains of one lane. Real-time: yes.
template <class S>
[[nodiscard]] PidGains lane_of(const BasicPidGains<S>& gains, int lane) noexcept {
  PidGains own{.anti_windup = gains.anti_windup, .derivative_of = gains.derivative_of};
  for (std::size_t i = 0; i < pid_gain_numbers<S>.size(); ++i) {
    own.*pid_gain_numbers<double>[i] = lane_of(gains.*pid_gain_numbers<S>[i], lane);
  }
  return own;
}

/// Replaces the numbers of one lane, and `anti_windup` and `derivative_of` of all lanes. Real-time:
/// yes.
template <class S>
void set_lane(BasicPidGains<S>& gains, int lane, const PidGains& own) noexcept {
  gains.anti_windup = own.anti_windup;
  gains.derivative_of = own.derivative_of;
  for (std::size_t i = 0; i < pid_gain_numbers<S>.size(); ++i) {
    set_lane(gains.*pid_gain_numbers<S>[i], lane, own.*pid_gain_numbers<double>[i]);
  }
}
/// @copydoc set_lane(BasicPidGains<S>&, int, const PidGains&)
template <class S, std::size_t N>
void set_lane(std::array<BasicPidGains<S>, N>& gains, int lane,
              const std::array<PidGains, N>& own) noexcept {
  for (std::size_t j = 0; j < N; ++j) set_lane(gains[j], lane, own[j]);
}

/// The same gains in all lanes. Real-time: yes.
template <class S, std::size_t N>
[[nodiscard]] std::array<BasicPidGains<S>, N> in_all_lanes(
    const std::array<PidGains, N>& own) noexcept {
  std::array<BasicPidGains<S>, N> gains;
  for (int k = 0; k < lanes<S>; ++k) set_lane(gains, k, own);
  return gains;
}

/// Refuses the gains of any lane as those of one robot.
/// @throws std::invalid_argument naming joint, gain and value
/// Real-time: no (throws).
template <PackedScalar S, std::size_t N>
void validate(const std::array<BasicPidGains<S>, N>& gains,
              const std::array<std::string_view, N>& names,
              GainSigns signs = GainSigns::not_negative) {
  for (int k = 0; k < lanes<S>; ++k) {
    std::array<PidGains, N> own;
    for (std::size_t j = 0; j < N; ++j) own[j] = lane_of(gains[j], k);
    validate(own, names, signs);
  }
}

/// The gains of N joints, the same in all lanes or of each lane.
template <class G, int N, class S>
concept PidGainsFor = std::same_as<G, JointPidGains<N>> || std::same_as<G, JointPidGains<N, S>>;

}  // namespace articula
