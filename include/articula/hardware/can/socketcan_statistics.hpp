// SPDX-License-Identifier: Apache-2.0
/// @file The counters of a SocketCAN transport.
#pragma once

#include <cstdint>

namespace articula {

/// Counters of a SocketCAN transport since its construction.
struct SocketCanStatistics {
  std::uint64_t received = 0;        ///< frames of other nodes
  std::uint64_t sent = 0;            ///< frames that the kernel accepted
  std::uint64_t not_taken = 0;       ///< frames that the kernel did not accept
  std::uint64_t lost = 0;            ///< frames dropped because the receive queue was full
  std::uint64_t error_frames = 0;    ///< all reports of the controller
  std::uint64_t overflows = 0;       ///< reports of a buffer overflow in the controller
  std::uint64_t no_answers = 0;      ///< reports of no acknowledge or a send timeout
  std::uint64_t error_passives = 0;  ///< reports of the error-passive state
  std::uint64_t bus_offs = 0;        ///< reports of bus-off
  std::uint64_t restarts = 0;        ///< reports of the return from bus-off
};

}  // namespace articula
