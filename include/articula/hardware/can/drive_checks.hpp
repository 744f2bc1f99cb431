// SPDX-License-Identifier: Apache-2.0
/// @file Checks of a drive's description that all protocols share.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace articula::detail {

/// Checks of one drive's description against its joint. Each check throws std::invalid_argument
/// with the joint, the value and the limit. Real-time: no (throws).
struct DriveChecks {
  std::string_view kind;         ///< of the drive, for messages
  const JointProperties& joint;  ///< that the drive moves

  [[noreturn]] void refuse(MessageParts parts) const {
    detail::refuse({kind, " of '", joint.name.view(), "': ", message_of(parts)});
  }
  void node(std::string_view name, int node, int last) const {
    if (node < 1 || node > last) refuse({name, " ", node, " is not within 1 .. ", last});
  }
  /// The node of drive j is in range, and no drive before has it.
  template <class Drives>
  void nodes(const Drives& drives, std::size_t j, int last) const {
    node("node", drives[j].node, last);
    for (std::size_t other = 0; other < j; ++other) {
      if (drives[other].node == drives[j].node) {
        refuse({"node ", int{drives[j].node}, " is used twice"});
      }
    }
  }
  void scale(std::string_view name, double value) const {
    if (!is_finite(value) || value == 0) {
      refuse({name, " ", value, " is not a number other than 0"});
    }
  }
  /// The joint's effort limit is within the range of a frame.
  void effort(double highest) const {
    if (joint.limits.effort <= highest) return;
    refuse({"the joint's effort limit ", joint.limits.effort, " N m is above the ", highest,
            " N m of a frame's range"});
  }
  /// The joint's position limits are within the range of a frame.
  /// @param units_of  callable with a position, in the drive's units
  template <class Units>
  void position(Units units_of, std::int32_t highest, std::string_view unit) const {
    for (const double limit : {joint.limits.lower, joint.limits.upper}) {
      const double units = std::abs(units_of(limit));
      if (!is_finite(limit) || units <= highest) continue;
      refuse({"the joint's limit ", limit, " is ", units, " ", unit, ", above the ", highest,
              " of a frame's range"});
    }
  }
};

}  // namespace articula::detail
