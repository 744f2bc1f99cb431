// SPDX-License-Identifier: Apache-2.0
/// @file A change of a loop between two of its recorded cycles.
#pragma once

#include "articula/control/switching/switch_request.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace articula {

/// A gain by its name, as Remote shows it: <controller>.<joint>.<gain>.
struct GainSetting {
  std::string parameter{};
  double value = 0;

  friend bool operator==(const GainSetting&, const GainSetting&) = default;
};

/// A change of a controller between two cycles. Records show its effect alone, so whoever makes it
/// records it: `recording.changes.push_back({report.cycles + 1, request})` after a cycle.
struct LoopChange {
  std::uint64_t cycle = 1;           ///< number of the first cycle in which it has effect
  SwitchRequest request{};           ///< of a Switch or Groups; empty: none
  std::vector<GainSetting> gains{};  ///< set together
};

/// Whether a request asks for anything.
[[nodiscard]] inline bool is_empty(const SwitchRequest& request) noexcept {
  return request.start.begin() == request.start.end() && request.stop.begin() == request.stop.end();
}

}  // namespace articula
