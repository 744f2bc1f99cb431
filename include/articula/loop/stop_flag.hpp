// SPDX-License-Identifier: Apache-2.0
/// @file A flag that requests the end of a run.
#pragma once

#include <atomic>

namespace articula {

/// Asks a running loop to end. `request` may be called by any thread and by a signal handler, which
/// std::stop_source does not promise.
class StopFlag {
 public:
  /// Real-time: yes.
  void request() noexcept { requested_.store(true, std::memory_order_relaxed); }
  /// Takes the request back, so that the flag can serve the next run. Real-time: yes.
  void clear() noexcept { requested_.store(false, std::memory_order_relaxed); }
  /// Real-time: yes.
  [[nodiscard]] bool requested() const noexcept {
    return requested_.load(std::memory_order_relaxed);
  }

 private:
  static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not lock");
  std::atomic<bool> requested_ = false;
};

}  // namespace articula
