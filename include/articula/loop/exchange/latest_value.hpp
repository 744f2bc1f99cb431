// SPDX-License-Identifier: Apache-2.0
/// @file The latest value of something, handed from one thread to another.
#pragma once

#include <array>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace articula {

/// Hands the latest value from one writing to one reading thread: references, gains, states. Values
/// that nobody has read are replaced. Neither side ever waits for the other (triple buffer): the
/// writer fills a slot of its own and swaps it for the shared one, the reader swaps its own for the
/// shared one if that is newer. Each side takes one atomic exchange, which is one instruction on
/// x86-64 and ARMv8.1.
///
/// The swap publishes the slot (release) and takes the other side's finished one over (acquire), so
/// a slot is never in two hands.
/// @tparam T       what is handed over; its assignment must be fit for real time
/// @tparam Atomic  std::atomic, or what a test puts in its place
template <std::default_initializable T, template <class> class Atomic = std::atomic>
  requires std::is_copy_assignable_v<T>
class LatestValue {
 public:
  LatestValue() = default;

  /// @param initial  what is read until something is written
  explicit LatestValue(const T& initial) { slots_[front_].value = initial; }

  LatestValue(const LatestValue&) = delete;
  LatestValue& operator=(const LatestValue&) = delete;

  /// Publishes a value. For the writing thread.
  /// Real-time: yes, if T's assignment is. Wait-free.
  void write(const T& value) noexcept(std::is_nothrow_copy_assignable_v<T>) {
    slots_[back_].value = value;
    const unsigned returned = shared_.exchange(back_ | fresh, std::memory_order_acq_rel);
    back_ = returned & index;
  }

  /// Takes over the latest value, if there is one that was not taken over yet. For the reading
  /// thread.
  /// @return whether there was one
  /// Real-time: yes. Wait-free.
  bool update() noexcept {
    // Only a hint, for which no order is needed: the exchange settles it.
    if ((shared_.load(std::memory_order_relaxed) & fresh) == 0) return false;
    front_ = shared_.exchange(front_, std::memory_order_acq_rel) & index;
    return true;
  }

  /// The value that was last taken over. For the reading thread; valid until the next `update`.
  /// Real-time: yes.
  [[nodiscard]] const T& value() const noexcept { return slots_[front_].value; }

 private:
  static constexpr unsigned index = 3;  ///< bits that number a slot
  static constexpr unsigned fresh = 4;  ///< the shared slot was written after the last take-over

  // Each slot and each side's index has a cache line of its own, or the threads would slow each
  // other down. 64 bytes on the processors that robots have.
  struct alignas(64) Slot {
    T value{};
  };
  std::array<Slot, 3> slots_{};
  alignas(64) unsigned back_ = 0;            ///< the writer's slot
  alignas(64) Atomic<unsigned> shared_ = 1;  ///< the slot in between, and whether it is fresh
  alignas(64) unsigned front_ = 2;           ///< the reader's slot
};

}  // namespace articula
