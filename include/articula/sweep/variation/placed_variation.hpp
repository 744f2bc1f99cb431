// SPDX-License-Identifier: Apache-2.0
/// @file What a variation varies in a robot, and the checks of several of them.
#pragma once

#include "articula/control/laws/pid_gains.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"
#include "articula/model/vector3.hpp"
#include "articula/sweep/variation/joint_unit.hpp"
#include "articula/sweep/variation/variation.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace articula::detail {

/// A variation and the indices of what it varies: bodies or joints.
struct PlacedVariation {
  Variation variation{};
  std::vector<int> places{};
  Vector3<double> point{};  ///< of a payload, in the frame of its body [m]
};

/// Finds what a variation varies.
/// @throws std::invalid_argument naming the link or joint, if there is none or it does not move
template <DynamicRobot R>
[[nodiscard]] PlacedVariation placed(const R& robot, const Variation& variation) {
  validate(variation);
  const auto& model = model_of(robot);
  PlacedVariation result{.variation = variation};
  const VariedSubject subject = traits_of(variation.quantity).subject;
  if (subject == VariedSubject::loop) return result;
  if (variation.where.empty()) {
    const auto size =
        subject == VariedSubject::link ? model.mechanism.bodies.size() : model.joints.size();
    for (int k = 0; k < static_cast<int>(size); ++k) result.places.push_back(k);
    return result;
  }
  if (subject == VariedSubject::joint) {
    result.places.push_back(joint_index(robot, variation.where));
    return result;
  }
  const auto link = std::find_if(model.links.begin(), model.links.end(), [&](const auto& each) {
    return each.name.view() == variation.where.view();
  });
  if (link == model.links.end()) no_such_link(model, variation.where.view());
  if (link->body < 0) {
    refuse({"sweep: link '", variation.where.view(), "' of robot '", model.name.view(),
            "' does not move"});
  }
  result.places.push_back(link->body);
  result.point = link->placement.translation;
  return result;
}

/// The unit of a variation's values, of a joint that rotates or translates.
/// Real-time: no (allocates).
[[nodiscard]] std::string unit_of(const auto& model, const PlacedVariation& placed) {
  const VariedTraits& traits = traits_of(placed.variation.quantity);
  std::vector<JointType> types;
  if (traits.subject == VariedSubject::joint) {
    for (const int j : placed.places) types.push_back(model.joints[j].type);
  }
  return joint_unit(traits.unit, types);
}

/// Refuses a factor of numbers that are all 0: it would change nothing. (The factor 0 alone, which
/// removes them, is true of such numbers.)
/// @throws std::invalid_argument naming the variation
/// Real-time: no (throws).
template <class Loop>
void validate_factor(const Loop& nominal, const PlacedVariation& placed) {
  using enum VariedQuantity;
  const VariedQuantity quantity = placed.variation.quantity;
  const auto number = [&](int j) {
    const PidGains& gains = nominal.gains[static_cast<std::size_t>(j)];
    return quantity == damping        ? nominal.model.joints[j].damping
           : quantity == friction     ? nominal.model.joints[j].friction
           : quantity == proportional ? gains.proportional
           : quantity == integral     ? gains.integral
           : quantity == derivative   ? gains.derivative
                                      : 1;
  };
  const bool is_of_joints = traits_of(quantity).subject == VariedSubject::joint;
  const auto is_zero = [&](int j) { return number(j) == 0; };
  const bool removes = placed.variation.high == 0;
  if (is_of_joints && !removes &&
      std::all_of(placed.places.begin(), placed.places.end(), is_zero)) {
    refuse({"sweep: parameter '", placed.variation.parameter().name,
            "' is a factor of numbers that are 0, so it would change nothing",
            quantity == friction ? "; expected added_friction" : ""});
  }
}

/// Refuses two variations of one name, two that replace the same number, and two links that are one
/// body.
/// @throws std::invalid_argument naming both
/// Real-time: no (throws).
inline void validate_apart(std::span<const PlacedVariation> all) {
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Variation& own = all[k].variation;
    for (const PlacedVariation& other : all.first(k)) {
      if (other.variation.quantity != own.quantity) continue;
      const std::string name = own.parameter().name, other_name = other.variation.parameter().name;
      if (name == other_name) refuse({"sweep: parameter '", name, "' varies twice"});
      const bool shares_places =
          std::ranges::find_first_of(all[k].places, other.places) != all[k].places.end();
      if (traits_of(own.quantity).effect == VariedEffect::replaces && shares_places) {
        refuse({"sweep: parameters '", other_name, "' and '", name,
                "' are the same number of a joint; expected one of them"});
      }
      const bool name_links = traits_of(own.quantity).subject == VariedSubject::link &&
                              !own.where.empty() && !other.variation.where.empty();
      if (own.quantity == VariedQuantity::mass && name_links && shares_places) {
        refuse({"sweep: parameters '", other_name, "' and '", name,
                "' are of one body, whose links fixed joints join; expected one of them"});
      }
    }
  }
}

}  // namespace articula::detail
