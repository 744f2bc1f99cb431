// SPDX-License-Identifier: Apache-2.0
/// @file The input of one cycle of a loop beside state and reference.
#pragma once

#include "articula/core/status.hpp"

#include <cstdint>

namespace articula {

/// What a supervised loop can be asked to do.
enum class LoopRequest : unsigned char { none, activation, deactivation, acknowledgement };

/// What came into a cycle beside the state and the reference. With these, the command of the cycle
/// can be computed once more: see Replay. A loop without supervision knows `read` and `write`
/// alone.
struct CycleInput {
  Status read = Status::ok;  ///< the hardware's answer to `read`; under supervision with the limits
  Status write = Status::ok;                ///< the hardware's answer to `write`
  LoopRequest request = LoopRequest::none;  ///< that was taken
  Status change = Status::ok;               ///< the hardware's answer to `activate` or `deactivate`
  bool posted = false;                      ///< a reference came, whether it was taken or not
  std::uint32_t overruns = 0;               ///< reports of missed periods since the last cycle
  std::uint64_t missed = 0;                 ///< missed periods in them

  friend bool operator==(const CycleInput&, const CycleInput&) = default;
};

}  // namespace articula
