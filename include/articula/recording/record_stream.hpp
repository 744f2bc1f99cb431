// SPDX-License-Identifier: Apache-2.0
/// @file Records on their way to files and sockets.
#pragma once

#include "articula/loop/exchange/event_ring.hpp"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

namespace articula {

/// Takes records from a loop and hands them to sinks (files, sockets) on a thread of its own. The
/// loop never waits: records that find the ring full are dropped and counted. A sink that throws
/// gets nothing more; the others go on.
/// @tparam Record    what is streamed
/// @tparam Capacity  of the ring in between, a power of two: at 1 kHz, 4096 records bridge a pause
///                   of four seconds
template <class Record, std::size_t Capacity = 4096>
class RecordStream {
 public:
  using Sink = std::function<void(const Record&)>;

  /// Starts the thread. It has the scheduling of the thread that calls this, so make the stream
  /// before that one becomes real-time.
  /// @param sinks  called with each record, in order
  explicit RecordStream(std::vector<Sink> sinks)
      : sinks_(std::move(sinks)), thread_([this] { work(); }) {}
  ~RecordStream() { finish(); }
  RecordStream(const RecordStream&) = delete;
  RecordStream& operator=(const RecordStream&) = delete;

  /// Sends a record on its way. For the loop's thread.
  /// @return false if it was dropped
  /// Real-time: yes. Wait-free. One copy.
  bool push(const Record& record) noexcept { return ring_.push(record); }

  /// How many records were dropped. From any thread. Real-time: yes.
  [[nodiscard]] std::uint64_t dropped() const noexcept { return ring_.dropped(); }

  /// Waits until all that was pushed has been handed on, and ends. To be called when the loop has
  /// ended, before the sinks are closed.
  /// @throws what the first sink that failed has thrown
  /// Real-time: no.
  void close() {
    finish();
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  }

 private:
  void finish() {
    closing_ = true;
    if (thread_.joinable()) thread_.join();
  }

  void work() {
    // Looks again and again, since waking a thread up would be a system call of the loop's.
    constexpr std::chrono::milliseconds pause(5);
    for (bool last = false;; last = closing_) {
      for (Record record; ring_.pop(record);) hand_on(record);
      if (last) return;
      if (!closing_) std::this_thread::sleep_for(pause);
    }
  }

  void hand_on(const Record& record) {
    for (Sink& sink : sinks_) {
      if (!sink) continue;
      try {
        sink(record);
      } catch (...) {
        if (!error_) error_ = std::current_exception();
        sink = nullptr;
      }
    }
  }

  std::vector<Sink> sinks_;
  EventRing<Record, Capacity> ring_;
  std::atomic<bool> closing_ = false;
  std::exception_ptr error_;
  std::thread thread_;  // last: it uses the others
};

}  // namespace articula
