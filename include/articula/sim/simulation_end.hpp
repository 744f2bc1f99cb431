// SPDX-License-Identifier: Apache-2.0
/// @file The end of a simulation.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace articula {

/// How a simulation ends, of a run of a sweep or of a future.
enum class SimulationEnd : unsigned char {
  stable,
  unstable,    ///< a drive swings between its effort limits in the last quarter
  non_finite,  ///< the motion or the command has overflowed; the run ends there
  refused,  ///< the simulator or the controller does not accept the run's numbers; no time passed
};

/// All ends in the order of SimulationEnd, by name.
inline constexpr auto simulation_end_names =
    std::to_array<std::string_view>({"stable", "unstable", "non_finite", "refused"});

/// The name of an end. Real-time: yes.
[[nodiscard]] constexpr std::string_view to_string(SimulationEnd end) noexcept {
  return simulation_end_names[static_cast<std::size_t>(end)];
}

}  // namespace articula
