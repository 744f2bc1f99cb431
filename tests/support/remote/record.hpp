// SPDX-License-Identifier: Apache-2.0
/// @file A record whose numbers are all different.
#pragma once

#include <articula/core/joint_command.hpp>
#include <articula/recording/cycle_record.hpp>

namespace support {

[[nodiscard]] inline articula::CycleRecord<2, articula::EffortCommand<2>> some_record() {
  using std::chrono::microseconds;
  articula::CycleRecord<2, articula::EffortCommand<2>> record;
  record.cycle = 12;
  record.time = 0.1 + 0.2;
  record.status = articula::Status::overrun;
  record.state = {{1.0 / 3, -0.2}, {3.5, 4.5}, {5.5, 6.5}};
  record.reference = {{1.25, 2.25}, {3.25, 4.25}, {5.25, 6.0 / 7}, {7.25, 8.25}};
  record.command.effort = {1e-17, -13.62};
  record.timing = {microseconds(3), microseconds(1003), microseconds(20)};
  return record;
}

}  // namespace support
