// SPDX-License-Identifier: Apache-2.0
/// @file The source of reference that each joint follows.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/core/joint_reference.hpp"
#include "articula/motion/joint_motion.hpp"

#include <array>
#include <cstddef>

namespace articula::remote {

/// The source that each joint follows, by a number. 0 is none: the joint rests. All functions are
/// real-time.
/// @tparam N      number of joints
/// @tparam Count  number of sources, with none
template <int N, int Count>
class JointSources {
 public:
  using Joints = JointArray<bool, N>;

  [[nodiscard]] int of(int joint) const noexcept { return source_[joint]; }
  /// Whether any joint follows a source; of 0, whether one rests.
  [[nodiscard]] bool leads(int source) const noexcept {
    return leading_[static_cast<std::size_t>(source)];
  }
  /// Whether one of some joints does.
  [[nodiscard]] bool leads(int source, const Joints& some) const noexcept {
    const Joints joints = joints_of(source);
    for (int j = 0; j < N; ++j) {
      if (some[j] && joints[j]) return true;
    }
    return false;
  }
  /// The joints that follow a source.
  [[nodiscard]] Joints joints_of(int source) const noexcept {
    Joints joints{};
    for (int j = 0; j < N; ++j) joints[j] = source_[j] == source;
    return joints;
  }

  /// Lets joints follow a source.
  void give(const Joints& joints, int source) noexcept {
    for (int j = 0; j < N; ++j) {
      if (joints[j]) source_[j] = source;
    }
    leading_.fill(false);
    for (const int leader : source_) leading_[static_cast<std::size_t>(leader)] = true;
  }
  /// Copies the reference of the joints that follow a source.
  void copy(int source, const JointReference<N>& from, JointReference<N>& to) const noexcept {
    for (int j = 0; j < N; ++j) {
      if (source_[j] != source) continue;
      set_motion(to, j, motion_of(from, j));
      to.effort[j] = from.effort[j];
    }
  }

 private:
  JointArray<int, N> source_{};
  /// By source, since `leads` is asked in each cycle. At first all joints rest.
  std::array<bool, static_cast<std::size_t>(Count)> leading_{true};
};

}  // namespace articula::remote
