// SPDX-License-Identifier: Apache-2.0
/// @file Commands that are lost on their way to simulated drives.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/sim/random_draw.hpp"

#include <cstdint>

namespace articula {

/// Which commands of a run do not arrive: each with the same probability, whatever happens to the
/// others. The drives keep the command before, as real ones do until their watchdog. Cycle and seed
/// decide, so a run loses the same commands whenever it is computed.
struct LostCommands {
  double share = 0;        ///< probability, 0 .. 1
  std::uint64_t seed = 1;  ///< of the run

  /// Whether the command of a cycle is lost. Real-time: yes.
  [[nodiscard]] constexpr bool contain(std::uint64_t cycle) const noexcept {
    constexpr std::uint32_t of_loss = 1;  // place in Philox's counter
    return share > 0 && detail::share_of_bits(detail::random_bits(seed, cycle, of_loss)) < share;
  }
};

/// @throws std::invalid_argument if the share is not within 0 .. 1
/// Real-time: no (throws).
inline void validate(const LostCommands& lost) {
  if (lost.share >= 0 && lost.share <= 1) return;
  detail::refuse({"lost commands: the share ", lost.share, " is not within 0 .. 1"});
}

}  // namespace articula
