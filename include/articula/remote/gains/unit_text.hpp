// SPDX-License-Identifier: Apache-2.0
/// @file Units of gains as text.
#pragma once

#include "articula/remote/gains/gain_fields.hpp"

#include <string>
#include <utility>
#include <vector>

namespace articula::remote {

/// A unit as powers of an effort, a position and a second.
struct UnitPowers {
  int effort = 0, position = 0, second = 0;

  friend UnitPowers operator+(const UnitPowers& a, const UnitPowers& b) {
    return {a.effort + b.effort, a.position + b.position, a.second + b.second};
  }
  friend UnitPowers operator*(int k, const UnitPowers& a) {
    return {k * a.effort, k * a.position, k * a.second};
  }
};

/// A unit in the way of "N m/(rad s)"; "1" if it has none.
/// @param prismatic  the joint has m and N instead of rad and N m
[[nodiscard]] inline std::string unit_text(const UnitPowers& unit, bool prismatic) {
  const auto product = [&](int side) {
    std::string text;
    int factors = 0;
    for (const auto& [symbol, power] : {std::pair{prismatic ? "N" : "N m", side * unit.effort},
                                        std::pair{"s", side > 0 ? side * unit.second : 0},
                                        std::pair{prismatic ? "m" : "rad", side * unit.position},
                                        std::pair{"s", side < 0 ? side * unit.second : 0}}) {
      if (power <= 0) continue;
      if (factors++ > 0) text += " ";
      text += symbol;
      if (power > 1) text += "^" + std::to_string(power);
    }
    return std::pair(text, factors);
  };
  const auto [above, count_above] = product(1);
  const auto [below, count_below] = product(-1);
  std::string numerator = count_above == 0 ? "1" : above;
  if (count_below == 0) return numerator;
  return numerator + "/" + (count_below == 1 ? below : "(" + below + ")");
}

/// The unit of a gain.
/// @param output, variable  of the law
[[nodiscard]] inline UnitPowers powers_of(const GainUnit& unit, const UnitPowers& output,
                                          const UnitPowers& variable) {
  return unit.output * output + unit.variable * variable +
         UnitPowers{0, unit.position, unit.second};
}

}  // namespace articula::remote
