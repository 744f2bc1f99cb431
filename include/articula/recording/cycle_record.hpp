// SPDX-License-Identifier: Apache-2.0
/// @file The data of one cycle of a loop.
#pragma once

#include "articula/core/joint_reference.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/core/status.hpp"
#include "articula/loop/cycle_input.hpp"
#include "articula/loop/run_report.hpp"

#include <cstdint>

namespace articula {

/// The state, reference, command, status and timing of one cycle, for Recorder, RecordStream and
/// their sinks, and what else its command depends on (see Replay). A plain value of about 50
/// doubles for six joints.
/// @tparam N            number of joints
/// @tparam CommandType  of the loop
template <int N, class CommandType>
struct CycleRecord {
  static constexpr int joint_count = N;
  using Command = CommandType;

  std::uint64_t cycle = 0;     ///< number of the cycle in its run, from 1
  double time = 0;             ///< of the loop [s]
  Status status = Status::ok;  ///< how the cycle ended
  JointState<N> state{};
  JointReference<N> reference{};  ///< from which the command was made
  Command command{};
  CycleTiming timing{};
  CycleInput input{};
};

/// The record type of a loop.
template <class LoopType>
using CycleRecordOf = CycleRecord<LoopType::joint_count, typename LoopType::Command>;

/// The record of the last cycle of a loop.
/// @param loop    a Loop or a SupervisedLoop
/// @param cycle   its number
/// @param status  how it ended
/// @param timing  of this cycle
/// Real-time: yes. O(N).
template <class LoopType>
[[nodiscard]] CycleRecordOf<LoopType> record_of(const LoopType& loop, std::uint64_t cycle,
                                                Status status, const CycleTiming& timing) noexcept {
  return {.cycle = cycle,
          .time = loop.time(),
          .status = status,
          .state = loop.state(),
          .reference = loop.followed(),
          .command = loop.command(),
          .timing = timing,
          .input = loop.input()};
}
/// The same of a run. Before a run it is the record of cycle 0: where the joints were when the loop
/// was made.
/// @param report  of the loop's run
/// Real-time: yes. O(N).
template <class LoopType>
[[nodiscard]] CycleRecordOf<LoopType> record_of(const LoopType& loop,
                                                const RunReport& report) noexcept {
  return record_of(loop, report.cycles, report.status, report.timing);
}

}  // namespace articula
