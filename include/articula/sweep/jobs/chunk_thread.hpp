// SPDX-License-Identifier: Apache-2.0
/// @file A thread that computes chunks of a sweep.
#pragma once

#include "articula/sweep/run_chunk.hpp"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace articula::detail {

/// The chunks that a rank has at once: one under way, and one to go on with.
inline constexpr int chunks_of_rank = 2;

/// Computes chunks, one after the other, while its owner does other things.
class ChunkThread {
 public:
  /// A chunk, or the exception that its computation has thrown.
  struct Outcome {
    ComputedChunk chunk{};
    std::exception_ptr thrown{};
  };

  /// @param compute  called in the thread
  explicit ChunkThread(std::function<ComputedChunk(const SweepChunk&)> compute)
      : compute_(std::move(compute)), thread_([this] { work(); }) {}
  ChunkThread(const ChunkThread&) = delete;
  ChunkThread& operator=(const ChunkThread&) = delete;
  /// Waits for the chunk under way; the others are dropped.
  ~ChunkThread() {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  void give(const SweepChunk& chunk) {
    {
      const std::lock_guard lock(mutex_);
      given_.push_back(chunk);
    }
    ++owed_;
    changed_.notify_all();
  }
  /// True if it has too few chunks to be busy for long.
  [[nodiscard]] bool wants_chunk() const noexcept { return owed_ < chunks_of_rank; }
  /// True if chunks were given and not taken.
  [[nodiscard]] bool owes_chunk() const noexcept { return owed_ > 0; }
  /// The next outcome, if there is one.
  [[nodiscard]] std::optional<Outcome> take() {
    const std::lock_guard lock(mutex_);
    if (done_.empty()) return {};
    Outcome outcome = std::move(done_.front());
    done_.pop_front();
    --owed_;
    return outcome;
  }
  /// Waits until there is an outcome, at most for a time.
  void wait(std::chrono::microseconds most) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, most, [this] { return !done_.empty(); });
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return ends_ || !given_.empty(); });
      if (ends_) return;
      const SweepChunk chunk = given_.front();
      given_.pop_front();
      lock.unlock();
      Outcome outcome;
      try {
        outcome.chunk = compute_(chunk);
      } catch (...) {
        outcome.thrown = std::current_exception();
      }
      lock.lock();
      done_.push_back(std::move(outcome));
      changed_.notify_all();
    }
  }

  std::function<ComputedChunk(const SweepChunk&)> compute_;
  std::mutex mutex_{};
  std::condition_variable changed_{};
  std::deque<SweepChunk> given_{};
  std::deque<Outcome> done_{};
  int owed_ = 0;  ///< chunks that were given and not taken
  bool ends_ = false;
  std::thread thread_;  // the last member: it uses all others
};

}  // namespace articula::detail
