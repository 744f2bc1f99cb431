// SPDX-License-Identifier: Apache-2.0
/// @file The input of one joint's PID.
#pragma once

namespace articula {

/// The input of one joint's PID in a cycle.
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <class S>
struct BasicPidInput {
  S error = 0;                   ///< e = r - y, of the variable that is controlled
  S measured = 0;                ///< y
  S rate_error = 0;              ///< c r' - y', of measured y', if that is so
  bool rate_is_measured = true;  ///< else the derivative is made of differences
  S velocity_reference = 0;      ///< v_ref, for the feed-forward
  S acceleration_reference = 0;  ///< a_ref, for the feed-forward
};

/// The input of one joint's PID of one robot.
using PidInput = BasicPidInput<double>;

}  // namespace articula
