// SPDX-License-Identifier: Apache-2.0
/// @file What a SocketCAN transport counts.
#pragma once

#include <cstdint>

namespace articula {

/// What a SocketCAN transport has counted since it was made.
struct SocketCanStatistics {
  std::uint64_t received = 0;      ///< frames of others
  std::uint64_t sent = 0;          ///< frames that the kernel took
  std::uint64_t not_taken = 0;     ///< frames that the kernel did not take
  std::uint64_t lost = 0;          ///< frames that the receive queue had no room for
  std::uint64_t error_frames = 0;  ///< reports of the controller
  std::uint64_t overflows = 0;     ///< of these, that a buffer of the controller has run over
  std::uint64_t no_answers = 0;    ///< of these, that nobody acknowledged or sending took too long
  std::uint64_t error_passives = 0;  ///< of these, that the controller became error-passive
  std::uint64_t bus_offs = 0;        ///< of these, that the controller left the bus
  std::uint64_t restarts = 0;        ///< of these, that it is back
};

}  // namespace articula
