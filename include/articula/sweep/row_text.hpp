// SPDX-License-Identifier: Apache-2.0
/// @file One run of a sweep as a line of CSV.
#pragma once

#include "articula/sim/simulation_end.hpp"
#include "articula/sweep/sweep_result.hpp"

#include <charconv>
#include <string>

namespace articula {

/// Appends a run as a line of CSV: number, seed, end, parameters, metrics. Each number reads back
/// as the same double; an undefined metric is nan.
/// Real-time: no (allocates).
inline void append_row(std::string& text, const SweepRow& row) {
  char digits[32];
  const auto add = [&](auto number, char before) {
    if (before != 0) text += before;
    text.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
  };
  add(row.number, '\0');
  add(row.seed, ',');
  text += ',';
  text += to_string(row.end);
  for (const auto* values : {&row.parameters, &row.metrics}) {
    for (const double value : *values) add(value, ',');
  }
  text += '\n';
}

}  // namespace articula
