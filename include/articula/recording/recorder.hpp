// SPDX-License-Identifier: Apache-2.0
/// @file The last cycles before and after a fault.
#pragma once

#include <array>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace articula {

/// Keeps the last records in memory of fixed size, as an aeroplane's recorder does. Triggered, it
/// goes on for some records more and then freezes, and any other thread may read it in peace until
/// it lets it go on. Neither waits for the other: a record that comes while it is frozen is
/// counted, not kept.
/// @tparam Record    what is kept; its assignment must be fit for real time
/// @tparam Capacity  how many
template <std::default_initializable Record, std::size_t Capacity>
class Recorder {
 public:
  static_assert(Capacity > 0, "a recorder holds at least one record");

  /// @param after  how many records are kept after the trigger, 0 .. Capacity - 1; more count as
  ///               Capacity - 1, so that the record of the trigger is always there
  explicit Recorder(std::size_t after = 0) : after_(after < Capacity ? after : Capacity - 1) {}
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Keeps a record; the oldest makes room. For the loop's thread.
  /// @param record   what is kept
  /// @param trigger  whether this one is a reason to freeze, such as `status != Status::ok`
  /// Real-time: yes. Wait-free. One copy.
  void add(const Record& record, bool trigger = false) noexcept {
    if (frozen_.load(std::memory_order_acquire)) {
      missed_.store(missed_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return;
    }
    if (released_) {  // the other thread has let it go on: what it has read is gone
      count_ = 0;
      released_ = false;
    }
    records_[count_ % Capacity] = record;
    ++count_;
    const bool asked = asked_.exchange(false, std::memory_order_relaxed);
    if (!triggered_ && (trigger || asked)) {
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

  /// Triggers with the next record, from any thread. Real-time: yes.
  void trigger() noexcept { asked_.store(true, std::memory_order_relaxed); }

  /// Whether it can be read. From any thread. Real-time: yes.
  [[nodiscard]] bool frozen() const noexcept { return frozen_.load(std::memory_order_acquire); }

  /// How many records came while it was frozen. From any thread. Real-time: yes.
  [[nodiscard]] std::uint64_t missed() const noexcept {
    return missed_.load(std::memory_order_relaxed);
  }

  /// Calls `sink(record)` for each, the oldest first. Only while it is frozen, or when the loop has
  /// ended. Real-time: as sink.
  template <class Sink>
  void for_each(Sink&& sink) const {
    for (std::size_t i = count_ < Capacity ? 0 : count_ - Capacity; i < count_; ++i) {
      sink(records_[i % Capacity]);
    }
  }

  /// Lets a frozen recorder go on, empty. For the thread that has read it. Real-time: yes.
  void resume() noexcept { frozen_.store(false, std::memory_order_release); }

 private:
  std::size_t after_;
  std::size_t count_ = 0;  ///< records since it went on last
  std::size_t rest_ = 0;   ///< records still to come after the trigger
  bool triggered_ = false;
  bool released_ = false;
  std::atomic<bool> asked_ = false;
  std::atomic<bool> frozen_ = false;
  std::atomic<std::uint64_t> missed_ = 0;  ///< written by the loop's thread alone
  std::array<Record, Capacity> records_{};
};

}  // namespace articula
