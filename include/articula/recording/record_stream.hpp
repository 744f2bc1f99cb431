// SPDX-License-Identifier: Apache-2.0
/// @file Streams records from a real-time loop to files and sockets.
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

/// A type such as CsvWriter whose `write` takes records.
template <class W, class Record>
concept WriterOf = requires(W& writer, const Record& record) { writer.write(record); };

/// Passes records of a loop to sinks (files, sockets) on a thread of its own:
///
///     RecordStream stream(csv, mcap);
///     stream.push(record_of(loop, report));  // after each cycle
///
/// The loop never waits: if the ring is full, a record is dropped and counted. A sink that throws
/// receives no further records; the others do. To keep only the cycles around a fault, use
/// Recorder.
/// @tparam Record    type of the records
/// @tparam Capacity  of the ring, a power of two: at 1 kHz, 4096 records last for four seconds
template <class Record, std::size_t Capacity = 4096>
class RecordStream {
 public:
  using Sink = std::function<void(const Record&)>;

  /// Starts the thread. It inherits the scheduling of the calling thread, so create the stream
  /// before make_realtime.
  /// @param sinks  called with each record, in order
  explicit RecordStream(std::vector<Sink> sinks)
      : sinks_(std::move(sinks)), thread_([this] { work(); }) {}
  /// Likewise with writers as sinks, such as CsvWriter and McapRecordWriter. They must outlive the
  /// stream. Its type follows from the first one, if that has a type Record.
  /// @param writers  whose `write` takes a record
  template <WriterOf<Record>... Writers>
    requires(sizeof...(Writers) > 0)
  explicit RecordStream(Writers&... writers)
      : RecordStream(
            std::vector<Sink>{[&writers](const Record& record) { writers.write(record); }...}) {}
  ~RecordStream() { finish(); }
  RecordStream(const RecordStream&) = delete;
  RecordStream& operator=(const RecordStream&) = delete;

  /// Adds a record to the ring. For the loop's thread.
  /// @return false if the record was dropped
  /// Real-time: yes. Wait-free. One copy.
  bool push(const Record& record) noexcept { return ring_.push(record); }

  /// Number of dropped records. From any thread. Real-time: yes.
  [[nodiscard]] std::uint64_t dropped() const noexcept { return ring_.dropped(); }

  /// Waits until the sinks have all records, and ends the thread. Call it after the loop has ended
  /// and before the sinks are closed.
  /// @throws the exception of the first sink that failed
  /// Real-time: no (waits).
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
    // Polls the ring: to wake this thread, the loop would have to call the system.
    constexpr std::chrono::milliseconds pause(5);
    for (bool last = false;; last = closing_) {
      for (Record record; ring_.pop(record);) pass_on(record);
      if (last) return;
      if (!closing_) std::this_thread::sleep_for(pause);
    }
  }

  void pass_on(const Record& record) {
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
  std::thread thread_;  // last, since it uses the others
};

template <class Writer, class... Writers>
RecordStream(Writer&, Writers&...) -> RecordStream<typename Writer::Record>;

}  // namespace articula
