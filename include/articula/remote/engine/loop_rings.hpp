// SPDX-License-Identifier: Apache-2.0
/// @file The rings between a loop's thread and the threads outside.
#pragma once

#include "articula/loop/exchange/event_ring.hpp"
#include "articula/remote/engine/operator_watch.hpp"
#include "articula/remote/engine/remote_record.hpp"
#include "articula/remote/engine/task.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace articula::remote {

/// The rings between a loop and the outside, each with one writing and one reading side. Neither
/// side waits for the other.
/// @tparam R        the robot
/// @tparam Command  of the loop
template <Robot R, class Command>
struct LoopRings {
  using Record = RemoteRecord<joint_count<R>, Command>;
  static constexpr std::size_t reserved_tasks = 8;   ///< of all, only for Stop and Deactivate
  static constexpr std::size_t most_records = 1024;  ///< that were not taken yet

  explicit LoopRings(double operator_lifetime_in_periods) : watch(operator_lifetime_in_periods) {}

  // Written by the outside:
  EventRing<Task<R>*, most_tasks> tasks{};
  std::atomic<std::uint64_t> stop = 0;  ///< number of the last Stop, which overtakes motions
  OperatorWatch watch;

  // Written by the loop:
  EventRing<Record, most_records> records{};
  EventRing<ConditionChange<joint_count<R>>, 64> changes{};
  /// Changes of the controller that are made, each before the record of the cycle in which it has
  /// effect first, and before it has ended.
  EventRing<Task<R>*, most_tasks> changed{};
  EventRing<Task<R>*, most_tasks> ended{};
  std::atomic<std::uint64_t> updates = 0;  ///< calls of update(), a sign that the loop runs
};

}  // namespace articula::remote
