// SPDX-License-Identifier: Apache-2.0
/// @file The record that a remote loop publishes in each cycle.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/loop/supervision/loop_mode.hpp"
#include "articula/recording/cycle_record.hpp"
#include "articula/remote/motion/motion_kind.hpp"

#include <cstdint>

namespace articula::remote {

/// A cycle as it is handed to the outside.
/// @tparam N  number of joints
template <int N, class Command>
struct RemoteRecord {
  CycleRecord<N, Command> cycle{};
  LoopMode mode = LoopMode::active;
  std::uint64_t overruns = 0;  ///< of the run until this cycle
};

/// The state of a loop that changes seldom.
/// @tparam N  number of joints
template <int N>
struct LoopCondition {
  LoopMode mode = LoopMode::active;
  Status fault = Status::ok;             ///< the last one
  MotionKind motion = MotionKind::rest;  ///< that was begun last
  JointArray<MotionKind, N> motions{};   ///< of each joint
  JointArray<bool, N> following{};       ///< joints that a controller moves to the position
  bool paused = false;
  double speed = 1;
  double trajectory_speed = 1;

  friend bool operator==(const LoopCondition&, const LoopCondition&) = default;
};

/// A new state, its time, and what was measured then.
template <int N>
struct ConditionChange {
  double time = 0;  ///< of the loop [s]
  LoopCondition<N> condition{};
  JointState<N> state{};
};

}  // namespace articula::remote
