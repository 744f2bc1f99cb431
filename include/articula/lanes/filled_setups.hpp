// SPDX-License-Identifier: Apache-2.0
/// @file The setups of all lanes, checked.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/lanes/lane_setup.hpp"
#include "articula/sim/simulator_options.hpp"

#include <cstddef>
#include <span>
#include <stdexcept>
#include <vector>

namespace articula::detail {

/// The setups of all lanes, checked. Those that stand still get the first one.
/// @throws std::invalid_argument naming lane, option, value and limit
/// Real-time: no (throws).
template <DescribedRobot R>
[[nodiscard]] std::vector<LaneSetup<R>> filled_setups(std::span<const LaneSetup<R>> setups,
                                                      int lane_count) {
  if (setups.empty() || setups.size() > static_cast<std::size_t>(lane_count)) {
    refuse({"lanes: ", setups.size(), " setups are not within 1 .. ", lane_count});
  }
  const auto& first = setups.front().simulation;
  for (std::size_t k = 0; k < setups.size(); ++k) {
    const auto& [robot, options, delay, lost] = setups[k];
    const auto refuse = [k](MessageParts parts) {
      detail::refuse({"lane ", k, ": ", message_of(parts)});
    };
    if (options.period != first.period || options.substeps != first.substeps) {
      refuse({"period ", options.period, " s with ", options.substeps,
              " substeps differs from lane 0, which has ", first.period, " s with ",
              first.substeps});
    }
    if (delay < 0 || delay > 1'000'000) {
      refuse({"delay ", delay, " is not within 0 .. 1 000 000 cycles"});
    }
    try {
      validate(robot, options);
      validate(lost);
    } catch (const std::invalid_argument& error) {
      refuse({error.what()});
    }
  }
  std::vector<LaneSetup<R>> all(setups.begin(), setups.end());
  all.resize(static_cast<std::size_t>(lane_count), setups.front());
  return all;
}

}  // namespace articula::detail
