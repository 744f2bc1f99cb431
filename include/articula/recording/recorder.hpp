// SPDX-License-Identifier: Apache-2.0
/// @file Keeps the cycles before and after a fault in memory.
#pragma once

#include <array>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace articula {

/// Keeps the last records in a ring of fixed size, as a flight recorder does:
///
///     Recorder<CycleRecordOf<Loop>, 2000> recorder(500);  // 1.5 s before a fault, 0.5 s after
///     recorder.add(record_of(loop, report), status != Status::ok);  // after each cycle
///     if (recorder.frozen()) { recorder.for_each(write); recorder.resume(); }  // another thread
///
/// After a trigger it takes `after` more records and freezes, until another thread has read it and
/// calls `resume`. Neither thread waits for the other: records added while it is frozen are counted
/// and lost. To keep all cycles, use RecordStream.
/// @tparam Record    type of the records; real-time if its assignment is
/// @tparam Capacity  number of records
template <std::default_initializable Record, std::size_t Capacity>
class Recorder {
 public:
  static_assert(Capacity > 0, "a recorder holds at least one record");

  /// @param after  number of records after the one of the trigger; at most Capacity - 1, so that
  ///               the record of the trigger is kept
  explicit Recorder(std::size_t after = 0) : after_(after < Capacity ? after : Capacity - 1) {}
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Adds a record in place of the oldest one. For the loop's thread.
  /// @param trigger  whether to freeze after this record and `after` more
  /// Real-time: yes. Wait-free. One copy.
  void add(const Record& record, bool trigger = false) noexcept {
    if (frozen_.load(std::memory_order_acquire)) {
      missed_.store(missed_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return;
    }
    if (released_) {  // the other thread has read the records
      count_ = 0;
      released_ = false;
    }
    records_[count_ % Capacity] = record;
    ++count_;
    const bool requested = requested_.exchange(false, std::memory_order_relaxed);
    if (!triggered_ && (trigger || requested)) {
      triggered_ = true;
      rest_ = after_;
    } else if (triggered_) {
      --rest_;
    }
    if (triggered_ && rest_ == 0) {
      triggered_ = false;
      released_ = true;
      frozen_.store(true, std::memory_order_release);
    }
  }

  /// Triggers at the next record. From any thread. Real-time: yes.
  void trigger() noexcept { requested_.store(true, std::memory_order_relaxed); }

  /// Whether `for_each` may be called. From any thread. Real-time: yes.
  [[nodiscard]] bool frozen() const noexcept { return frozen_.load(std::memory_order_acquire); }

  /// Number of records that were added while it was frozen. From any thread. Real-time: yes.
  [[nodiscard]] std::uint64_t missed() const noexcept {
    return missed_.load(std::memory_order_relaxed);
  }

  /// Calls `sink(record)` for each, the oldest first. Only while it is frozen, or after the loop
  /// has ended. Real-time: yes, if sink is.
  template <class Sink>
  void for_each(Sink&& sink) const {
    for (std::size_t i = count_ < Capacity ? 0 : count_ - Capacity; i < count_; ++i) {
      sink(records_[i % Capacity]);
    }
  }

  /// Empties a frozen recorder and lets it record again. For the reading thread. Real-time: yes.
  void resume() noexcept { frozen_.store(false, std::memory_order_release); }

 private:
  std::size_t after_;
  std::size_t count_ = 0;  ///< records since the start or the last `resume`
  std::size_t rest_ = 0;   ///< records left until it freezes
  bool triggered_ = false;
  bool released_ = false;
  std::atomic<bool> requested_ = false;
  std::atomic<bool> frozen_ = false;
  std::atomic<std::uint64_t> missed_ = 0;  ///< written by the loop's thread alone
  std::array<Record, Capacity> records_{};
};

}  // namespace articula
