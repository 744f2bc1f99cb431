// SPDX-License-Identifier: Apache-2.0
/// @file A queue of events from one thread to another, of which the control thread may be one.
#pragma once

#include <array>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace articula {

/// Passes every value from one writing thread to one reading thread, in order. For records of
/// cycles that a slower thread writes to a file:
///
///     EventRing<Record, 1024> ring;
///     ring.push(record);                        // control thread: never waits
///     while (ring.pop(record)) write(record);   // the other thread
///
/// Neither thread waits for the other. A value that does not fit is dropped and counted. If only
/// the latest value matters, use LatestValue. For several writing threads, use one ring for each.
/// Source: [Lamport 1977], the ring buffer of one producer and one consumer.
/// @tparam T         type of the values
/// @tparam Capacity  number of values in the ring, a power of two
/// @tparam Atomic    std::atomic; tests put another type in its place
template <std::default_initializable T, std::size_t Capacity,
          template <class> class Atomic = std::atomic>
  requires std::is_copy_assignable_v<T>
class EventRing {
 public:
  static_assert(Capacity > 0 && (Capacity & (Capacity - 1)) == 0,
                "EventRing: the capacity must be a power of two");
  static constexpr std::size_t capacity = Capacity;

  EventRing() = default;
  EventRing(const EventRing&) = delete;
  EventRing& operator=(const EventRing&) = delete;

  /// Appends a value. For the writing thread.
  /// @return false if the ring is full and the value was dropped
  /// Real-time: yes, if T's assignment is. Wait-free.
  bool push(const T& value) noexcept(std::is_nothrow_copy_assignable_v<T>) {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail - head_.load(std::memory_order_acquire) == Capacity) {
      dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return false;
    }
    slots_[tail % Capacity] = value;
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  /// Takes the oldest value. For the reading thread.
  /// @param value  receives it
  /// @return       false if the ring is empty; `value` is then unchanged
  /// Real-time: yes, if T's assignment is. Wait-free.
  [[nodiscard]] bool pop(T& value) noexcept(std::is_nothrow_copy_assignable_v<T>) {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) return false;
    value = slots_[head % Capacity];
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  /// Number of dropped values. For any thread. Real-time: yes.
  [[nodiscard]] std::uint64_t dropped() const noexcept {
    return dropped_.load(std::memory_order_relaxed);
  }

 private:
  // The counters never return to 0; their difference is right even after an overflow. Each side has
  // a cache line of its own, so that the threads do not slow each other down.
  alignas(64) Atomic<std::size_t> tail_ = 0;  ///< values pushed so far
  Atomic<std::uint64_t> dropped_ = 0;         ///< written by the pushing thread alone
  alignas(64) Atomic<std::size_t> head_ = 0;  ///< values popped so far
  alignas(64) std::array<T, Capacity> slots_{};
};

}  // namespace articula
