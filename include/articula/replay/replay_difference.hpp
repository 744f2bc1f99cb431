// SPDX-License-Identifier: Apache-2.0
/// @file The first difference between a recording and its replay.
#pragma once

#include "articula/command/command_parts.hpp"
#include "articula/core/refuse.hpp"
#include "articula/core/status.hpp"
#include "articula/model/robot.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

namespace articula {

/// The first number in which a replay differs from its recording.
struct ReplayDifference {
  std::uint64_t cycle = 0;  ///< number of the record
  double time = 0;          ///< of the loop [s]
  std::string joint{};      ///< empty if the status or the time differs
  std::string quantity{};   ///< "effort" and the like of a command, "status", "time"
  double recorded = 0;      ///< of a status its number
  double computed = 0;
};

/// The difference in words, with all digits: "cycle 12, elbow: effort 0.5 was recorded, 0.25 is
/// computed". A status differs where ReplayOptions::supervision is another one than that of the
/// recorded loop. Real-time: no (allocates).
[[nodiscard]] inline std::string to_string(const ReplayDifference& difference) {
  const auto digits = [&](double value) {
    if (difference.quantity == "status") {
      return "'" + std::string(to_string(static_cast<Status>(static_cast<int>(value)))) + "'";
    }
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return std::string(text);
  };
  return detail::message_of({"cycle ", difference.cycle, difference.joint.empty() ? "" : ", ",
                             difference.joint, ": ", difference.quantity, " ",
                             digits(difference.recorded), " was recorded, ",
                             digits(difference.computed), " is computed"});
}

/// Whether two numbers have the same bits. Text has one NaN only, so any is like any other.
/// Real-time: yes.
[[nodiscard]] inline bool has_same_bits(double a, double b) noexcept {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

/// The first number in which two commands differ, if one does.
/// @param where  cycle and time, to which the difference is added
/// Real-time: no (allocates).
template <Robot R, class Command>
[[nodiscard]] std::optional<ReplayDifference> difference_of(const R& robot, ReplayDifference where,
                                                            const Command& recorded,
                                                            const Command& computed) {
  const auto was = parts_of(recorded), is = parts_of(computed);
  for (int j = 0; j < joint_count<R>; ++j) {
    for (std::size_t part = 0; part < was.size(); ++part) {
      where.recorded = (*was[part].values)[j];
      where.computed = (*is[part].values)[j];
      if (has_same_bits(where.recorded, where.computed)) continue;
      where.joint = joint_names(robot)[static_cast<std::size_t>(j)];
      where.quantity = to_string(was[part].quantity);
      return where;
    }
  }
  return std::nullopt;
}

}  // namespace articula
