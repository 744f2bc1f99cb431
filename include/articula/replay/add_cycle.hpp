// SPDX-License-Identifier: Apache-2.0
/// @file Recordings from what a port publishes.
#pragma once

#include "articula/command/command_parts.hpp"
#include "articula/core/refuse.hpp"
#include "articula/recording/recording.hpp"
#include "articula/remote/cycle.hpp"

#include <chrono>
#include <cmath>
#include <cstddef>
#include <vector>

namespace articula {

/// Appends a cycle that a session of a port has received, with the changes of the controller before
/// it. Replay can then compute it once more:
///
///     for (remote::Cycle cycle; session->next(cycle);) add_cycle(recording, cycle);
///
/// @param recording  of a loop with the same kind of command
/// @param cycle      of a loop with as many joints
/// @throws std::invalid_argument if the cycle has other joints or commands
/// Real-time: no (allocates, throws).
template <int N, class Command>
void add_cycle(Recording<N, Command>& recording, const remote::Cycle& cycle) {
  const auto vector = [](const std::vector<double>& values) {
    if (values.size() != static_cast<std::size_t>(N)) {
      detail::refuse({"recording: the cycle has ", values.size(), " joints, not ", N});
    }
    return JointVector<N>(Eigen::Map<const JointVector<N>>(values.data()));
  };
  const auto nanoseconds = [](double seconds) {
    return std::chrono::nanoseconds(std::llround(seconds * 1e9));
  };
  CycleRecord<N, Command> record{.cycle = cycle.number,
                                 .time = cycle.time,
                                 .status = cycle.status,
                                 .state = {.position = vector(cycle.position),
                                           .velocity = vector(cycle.velocity),
                                           .effort = vector(cycle.effort)},
                                 .reference = {.position = vector(cycle.reference_position),
                                               .velocity = vector(cycle.reference_velocity),
                                               .acceleration = vector(cycle.reference_acceleration),
                                               .effort = vector(cycle.reference_effort)},
                                 .timing = {.latency = nanoseconds(cycle.latency),
                                            .period = nanoseconds(cycle.period),
                                            .update = nanoseconds(cycle.update)},
                                 .input = cycle.input};
  const auto parts = parts_of(record.command);
  if (cycle.command.size() != parts.size()) {
    detail::refuse({"recording: the cycle has ", cycle.command.size(), " kinds of commands, not ",
                    parts.size()});
  }
  for (std::size_t k = 0; k < parts.size(); ++k) {
    *part_of(record.command, parts[k].quantity) = vector(cycle.command[k]);
  }
  recording.cycles.push_back(record);
  recording.changes.insert(recording.changes.end(), cycle.changes.begin(), cycle.changes.end());
}

}  // namespace articula
