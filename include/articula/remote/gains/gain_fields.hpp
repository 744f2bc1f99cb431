// SPDX-License-Identifier: Apache-2.0
/// @file The gains in each gains struct: names, units, ranges.
#pragma once

#include "articula/control/laws/impedance_gains.hpp"
#include "articula/control/laws/pid_gains.hpp"

#include <array>
#include <limits>
#include <string_view>

namespace articula::remote {

/// The powers that make up the unit of a gain.
struct GainUnit {
  int output = 0;    ///< of the law's output, such as N m
  int variable = 0;  ///< of the quantity that the law controls, such as rad
  int position = 0;  ///< of rad or m
  int second = 0;    ///< of s
};

/// One gain of a gains struct G.
template <class G>
struct GainField {
  std::string_view name{};  ///< as ros2_controllers call it, if they have it
  double G::* member = nullptr;
  GainUnit unit{};
  double lowest = 0;   ///< of what is accepted
  double highest = 0;  ///< likewise
  std::string_view description{};
};

/// The gains of G that can be changed while a loop runs. Specialise it for gains of your own.
template <class G>
inline constexpr std::array<GainField<G>, 0> gain_fields{};

template <>
inline constexpr auto gain_fields<PidGains> = [] {
  constexpr double most = std::numeric_limits<double>::infinity();
  using F = GainField<PidGains>;
  using G = PidGains;
  return std::to_array<F>({
      {"p", &G::proportional, {1, -1, 0, 0}, 0, most, "Output for an error."},
      {"i", &G::integral, {1, -1, 0, -1}, 0, most, "Output for the integral of the error."},
      {"d", &G::derivative, {1, -1, 0, 1}, 0, most, "Output for the rate of the error."},
      {"i_clamp_min", &G::integral_clamp_min, {1}, -most, 0, "Lowest integral term."},
      {"i_clamp_max", &G::integral_clamp_max, {1}, 0, most, "Highest integral term."},
      {"u_clamp_min", &G::output_clamp_min, {1}, -most, 0, "Lowest output."},
      {"u_clamp_max", &G::output_clamp_max, {1}, 0, most, "Highest output."},
      {"tracking_time_constant",
       &G::tracking_time,
       {0, 0, 0, 1},
       0,
       most,
       "Time in which back-calculation reduces the integral; 0 chooses it from the gains."},
      {"error_deadband",
       &G::error_deadband,
       {0, 1},
       0,
       most,
       "Error up to which the integral rests."},
      {"derivative_filter_time",
       &G::derivative_filter_time,
       {0, 0, 0, 1},
       0,
       most,
       "Time constant of the derivative's low-pass; 0 is no filter."},
      {"position_weight",
       &G::position_weight,
       {},
       0,
       1,
       "Share of the reference in the proportional term."},
      {"velocity_weight",
       &G::velocity_weight,
       {},
       0,
       1,
       "Share of the reference in the derivative term."},
      {"velocity_feedforward",
       &G::velocity_feedforward,
       {1, 0, -1, 1},
       -most,
       most,
       "Output for the velocity of the reference."},
      {"acceleration_feedforward",
       &G::acceleration_feedforward,
       {1, 0, -1, 2},
       -most,
       most,
       "Output for the acceleration of the reference."},
  });
}();

template <>
inline constexpr auto gain_fields<ImpedanceGains> = [] {
  constexpr double most = std::numeric_limits<double>::infinity();
  return std::to_array<GainField<ImpedanceGains>>({
      {"stiffness", &ImpedanceGains::stiffness, {1, -1}, 0, most, "Of the joint's spring."},
      {"damping", &ImpedanceGains::damping, {1, -1, 0, 1}, 0, most, "Of the joint's damper."},
  });
}();

}  // namespace articula::remote
