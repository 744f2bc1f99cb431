// SPDX-License-Identifier: Apache-2.0
/// @file The end of a simulated future.
#pragma once

namespace articula {

/// How a future ends.
enum class FutureEnd : unsigned char {
  stable,
  unstable,    ///< a drive swings between its effort limits in the last quarter
  non_finite,  ///< the motion or the command has overflowed; the trajectory ends there
};

}  // namespace articula
