// SPDX-License-Identifier: Apache-2.0
/// @file A recorded run.
#pragma once

#include "articula/recording/cycle_record.hpp"
#include "articula/recording/loop_change.hpp"

#include <vector>

namespace articula {

/// The cycles of a run and what was changed in between.
/// @tparam N            number of joints
/// @tparam CommandType  of the loop
template <int N, class CommandType>
struct Recording {
  static constexpr int joint_count = N;
  using Command = CommandType;

  std::vector<CycleRecord<N, CommandType>> cycles{};  ///< in the order of time
  std::vector<LoopChange> changes{};                  ///< likewise
};

/// The recording type of a loop.
template <class LoopType>
using RecordingOf = Recording<LoopType::joint_count, typename LoopType::Command>;

}  // namespace articula
