// SPDX-License-Identifier: Apache-2.0
/// @file The quantities of a closed loop that vary from run to run.
#pragma once

#include "articula/core/name.hpp"
#include "articula/core/refuse.hpp"
#include "articula/sweep/sampling/sweep_parameter.hpp"

#include <array>
#include <limits>
#include <string>
#include <string_view>

namespace articula {

/// What varies: a property of the robot, of its drives and sensors, or of the controller.
enum class VariedQuantity : unsigned char {
  mass,                     ///< of the body that has a link, its inertia included: a factor [1]
  payload,                  ///< a point mass at the origin of a link [kg]
  damping,                  ///< of a joint: a factor [1]
  friction,                 ///< dry friction of a joint: a factor [1]
  added_friction,           ///< dry friction of a joint beside the described one [N m or N]
  added_reflected_inertia,  ///< of a joint's drive, beside the described one [kg m^2 or kg]
  effort_limit,        ///< of a joint's drive: a factor; the controller knows the described one [1]
  delay,               ///< of the commands, rounded to whole periods [s]
  lost_commands,       ///< share of the commands that do not arrive [1]
  position_noise,      ///< standard deviation of a joint's measurement [rad or m]
  velocity_noise,      ///< likewise [rad/s or m/s]
  encoder_resolution,  ///< of a joint [rad or m]
  initial_position,    ///< of a joint: its distance from that of the options [rad or m]
  proportional,        ///< gain of a joint: a factor [1]
  integral,            ///< likewise [1]
  derivative,          ///< likewise [1]
};

/// The subject of a quantity.
enum class VariedSubject : unsigned char { link, joint, loop };

/// The effect of a value on the described number. Factors apply first.
enum class VariedEffect : unsigned char { scales, adds, replaces };

struct VariedTraits {
  std::string_view name{};
  std::string_view unit{};
  VariedSubject subject = VariedSubject::joint;
  VariedEffect effect = VariedEffect::scales;
  bool of_all = true;  ///< may vary on all links or joints by one number
  double lowest = 0;
  double highest = std::numeric_limits<double>::infinity();
};

/// All quantities in the order of VariedQuantity.
inline constexpr auto varied_quantities = std::to_array<VariedTraits>({
    {.name = "mass", .unit = "1", .subject = VariedSubject::link, .lowest = 1e-3},
    {.name = "payload",
     .unit = "kg",
     .subject = VariedSubject::link,
     .effect = VariedEffect::adds,
     .of_all = false},
    {.name = "damping", .unit = "1"},
    {.name = "friction", .unit = "1"},
    {.name = "added_friction", .unit = "N m", .effect = VariedEffect::adds},
    {.name = "added_reflected_inertia", .unit = "kg m^2", .effect = VariedEffect::adds},
    {.name = "effort_limit", .unit = "1", .lowest = 1e-3},
    {.name = "delay",
     .unit = "s",
     .subject = VariedSubject::loop,
     .effect = VariedEffect::replaces,
     .highest = 10},
    {.name = "lost_commands",
     .unit = "1",
     .subject = VariedSubject::loop,
     .effect = VariedEffect::replaces,
     .highest = 1},
    {.name = "position_noise", .unit = "rad", .effect = VariedEffect::replaces},
    {.name = "velocity_noise", .unit = "rad/s", .effect = VariedEffect::replaces},
    {.name = "encoder_resolution", .unit = "rad", .effect = VariedEffect::replaces},
    {.name = "initial_position",
     .unit = "rad",
     .effect = VariedEffect::adds,
     .lowest = -std::numeric_limits<double>::infinity()},
    {.name = "proportional", .unit = "1"},
    {.name = "integral", .unit = "1"},
    {.name = "derivative", .unit = "1"},
});

[[nodiscard]] inline const VariedTraits& traits_of(VariedQuantity quantity) {
  const auto place = static_cast<std::size_t>(quantity);
  if (place >= varied_quantities.size()) {
    detail::refuse({"sweep: quantity ", place, " is no value of VariedQuantity, whose last is ",
                    varied_quantities.back().name, ", ", varied_quantities.size() - 1});
  }
  return varied_quantities[place];
}

/// A quantity that varies within a range.
struct Variation {
  VariedQuantity quantity = VariedQuantity::mass;
  Name where{};  ///< link or joint; empty: all of them by the same number
  double low = 0, high = 0;
  Spacing spacing = Spacing::linear;
  int levels = 11;  ///< in a grid

  /// The parameter of a sweep: named as "mass.elbow_passive_link", or "mass" where all vary.
  [[nodiscard]] SweepParameter parameter() const {
    const VariedTraits& traits = traits_of(quantity);
    std::string name(traits.name);
    if (!where.empty()) name.append(1, '.').append(where.view());
    return {name, std::string(traits.unit), low, high, spacing, levels};
  }
};

/// Refuses a variation out of its quantity's range.
/// @throws std::invalid_argument naming the variation, the value and what is accepted
/// Real-time: no (throws).
inline void validate(const Variation& variation) {
  const VariedTraits& traits = traits_of(variation.quantity);
  const SweepParameter parameter = variation.parameter();
  validate(parameter);
  if (!(variation.low >= traits.lowest && variation.high <= traits.highest)) {
    detail::refuse({"sweep: parameter '", parameter.name, "': its range ", variation.low, " .. ",
                    variation.high, " is not within ", traits.lowest, " .. ", traits.highest});
  }
  if (traits.subject == VariedSubject::loop && !variation.where.empty()) {
    detail::refuse({"sweep: parameter '", parameter.name, "': it is of the whole loop, not of '",
                    variation.where.view(), "'"});
  }
  if (!traits.of_all && variation.where.empty()) {
    detail::refuse({"sweep: parameter '", parameter.name, "' needs the name of a link"});
  }
}

}  // namespace articula
