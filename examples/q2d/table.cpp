// SPDX-License-Identifier: Apache-2.0
#include "table.hpp"

#include <algorithm>
#include <array>
#include <iomanip>
#include <optional>
#include <ostream>
#include <sstream>

namespace articula::examples {

namespace {

constexpr std::size_t column_count = 10;
using Row = std::array<std::string, column_count>;

const Row names{"experiment", "controller", "joint", "rise",      "overshoot",
                "settling",   "steady",     "peak",  "saturated", "speed"};
const Row units{"",    "",     "", "10-90 % [s]", "[%]", "2 % [s]", "error [rad]", "effort [N m]",
                "[%]", "[s/s]"};
constexpr std::size_t text_columns = 3;  // the others hold numbers

/// @param format  std::fixed or std::scientific
std::string text(std::optional<double> value, std::ios_base& (*format)(std::ios_base&),
                 int digits) {
  if (!value) return "-";
  std::ostringstream out;
  out << format << std::setprecision(digits) << *value;
  return out.str();
}

std::optional<double> percent(std::optional<double> share) {
  if (share) *share *= 100;
  return share;
}

Row row_of(const Run& run, std::size_t i) {
  const JointResult& joint = run.result.joints[i];
  const bool follows_position = !(run.experiment.is_torque && run.controller == "bypass");
  return {
      run.experiment.name,
      run.controller,
      std::string(short_name(joint_names(Q2d())[i])),
      text(joint.step.rise_time(), std::fixed, 4),
      text(percent(joint.step.overshoot()), std::fixed, 2),
      text(joint.step.settling_time(), std::fixed, 4),
      text(follows_position ? std::optional(joint.end_error) : std::nullopt, std::scientific, 1),
      text(joint.peak_effort, std::fixed, 2),
      text(percent(joint.saturated_share), std::fixed, 1),
      text(run.result.speed, std::fixed, 0)};
}

}  // namespace

void print_table(std::ostream& out, const std::vector<Run>& runs) {
  std::vector<Row> rows{names, units};
  for (const Run& run : runs) {
    for (std::size_t i = 0; i < run.result.joints.size(); ++i) rows.push_back(row_of(run, i));
  }
  std::array<std::size_t, column_count> widths{};
  for (const Row& row : rows) {
    for (std::size_t c = 0; c < column_count; ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (r > 1 && rows[r][0] != rows[r - 1][0]) out << '\n';  // another experiment
    for (std::size_t c = 0; c < column_count; ++c) {
      out << (c == 0 ? "" : "  ") << (c < text_columns ? std::left : std::right)
          << std::setw(static_cast<int>(widths[c])) << rows[r][c];
    }
    out << '\n';
  }
}

}  // namespace articula::examples
