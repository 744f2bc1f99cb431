// SPDX-License-Identifier: Apache-2.0
/// @file A difference between a recording and its replay.
#pragma once

#include "articula/core/refuse.hpp"

#include <cstdint>
#include <cstdio>
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
/// computed". Real-time: no (allocates).
[[nodiscard]] inline std::string to_string(const ReplayDifference& difference) {
  const auto digits = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return std::string(text);
  };
  return detail::message_of({"cycle ", difference.cycle, difference.joint.empty() ? "" : ", ",
                             difference.joint, ": ", difference.quantity, " ",
                             digits(difference.recorded), " was recorded, ",
                             digits(difference.computed), " is computed"});
}

}  // namespace articula
