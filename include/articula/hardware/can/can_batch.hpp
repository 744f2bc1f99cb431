// SPDX-License-Identifier: Apache-2.0
/// @file The frames of one cycle's output, without heap memory.
#pragma once

#include "articula/core/inline_sequence.hpp"
#include "articula/hardware/can/can_frame.hpp"

namespace articula {

/// At most 64 frames in the order of their sending, without heap memory.
using CanBatch = InlineSequence<CanFrame, 64>;

}  // namespace articula
