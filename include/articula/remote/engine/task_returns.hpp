// SPDX-License-Identifier: Apache-2.0
/// @file The tasks that a loop has ended and not handed back yet.
#pragma once

#include "articula/remote/engine/task.hpp"

#include <array>
#include <cstddef>

namespace articula::remote {

/// Collects the tasks that end in a period, so that they are handed back after the cycles in which
/// they have their effect. In the loop's thread. Real-time: yes.
template <Robot R>
class TaskReturns {
 public:
  /// Ends a task.
  void finish(Task<R>& own, TaskEnd end) noexcept {
    own.end = end;
    ending_[count_++] = &own;
  }
  /// Ends a task that was waited for, if there is one.
  void give_back(Task<R>*& waiting, TaskEnd end) noexcept {
    if (waiting == nullptr) return;
    finish(*waiting, end);
    waiting = nullptr;
  }
  /// Hands all of them over.
  /// @param fault  the fault in which the loop is; ok if it is in none
  void hand_to(auto& ring, Status fault) noexcept {
    for (std::size_t k = 0; k < count_; ++k) {
      ending_[k]->status = fault;
      ring.push(ending_[k]);
    }
    count_ = 0;
  }

 private:
  std::array<Task<R>*, most_tasks> ending_{};
  std::size_t count_ = 0;
};

}  // namespace articula::remote
