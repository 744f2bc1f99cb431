// SPDX-License-Identifier: Apache-2.0
/// @file Controllers that users might write.
#pragma once

#include <articula/core/controller.hpp>
#include <articula/model/robot.hpp>

namespace support {

/// Asks every drive for the same effort, whatever happens, and counts its calls.
template <articula::Robot R>
struct ConstantEffort {
  static constexpr int n = articula::joint_count<R>;

  double effort = 0;
  int starts = 0;
  int updates = 0;

  void start(const articula::ControlInput<n>&) noexcept { ++starts; }
  articula::EffortCommand<n> update(const articula::ControlInput<n>&) noexcept {
    ++updates;
    return {articula::JointVector<n>::Constant(effort)};
  }
};

/// Hands the reference position to drives that close their own loop.
template <articula::Robot R>
struct PositionForward {
  static constexpr int n = articula::joint_count<R>;

  articula::PositionCommand<n> update(const articula::ControlInput<n>& in) noexcept {
    return {in.reference.position};
  }
};

/// Goes to the reference position with a speed proportional to the distance, for velocity drives.
template <articula::Robot R>
struct VelocityApproach {
  static constexpr int n = articula::joint_count<R>;

  double rate = 10;  // [1/s]

  articula::VelocityCommand<n> update(const articula::ControlInput<n>& in) noexcept {
    return {rate * (in.reference.position - in.state.position)};
  }
};

}  // namespace support
