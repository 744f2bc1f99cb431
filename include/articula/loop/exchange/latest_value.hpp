// SPDX-License-Identifier: Apache-2.0
/// @file The latest reference, gains or state, from one thread to another without waiting.
#pragma once

#include <array>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace articula {

/// Passes the latest value from one writing thread to one reading thread. For a reference that an
/// operator's thread sets while the loop runs:
///
///     LatestValue<JointReference<2>> target;
///     target.write(reference);                                 // operator's thread
///     if (target.update()) loop.reference() = target.value();  // control thread
///
/// A new value replaces one that was not read. Do not use it where every value matters: use
/// EventRing. Several writing threads need a mutex among them, or a LatestValue each.
///
/// Neither thread waits for the other (triple buffer). The writer fills its own slot and swaps it
/// for the shared one. The reader swaps its own for the shared one if that is newer. A swap is one
/// atomic exchange, a single instruction on x86-64 and ARMv8.1. It publishes a slot (release) and
/// takes over the other thread's (acquire), so no slot belongs to both.
/// @tparam T       type of the value
/// @tparam Atomic  std::atomic; tests put another type in its place
template <std::default_initializable T, template <class> class Atomic = std::atomic>
  requires std::is_copy_assignable_v<T>
class LatestValue {
 public:
  LatestValue() = default;

  /// @param initial  the value until the first `write`
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

  /// Takes over the latest value. For the reading thread.
  /// @return whether it is newer than the one before
  /// Real-time: yes. Wait-free.
  bool update() noexcept {
    // Needs no order: only the exchange takes a slot over.
    if ((shared_.load(std::memory_order_relaxed) & fresh) == 0) return false;
    front_ = shared_.exchange(front_, std::memory_order_acq_rel) & index;
    return true;
  }

  /// The value of the last `update`. For the reading thread; valid until the next `update`.
  /// Real-time: yes.
  [[nodiscard]] const T& value() const noexcept { return slots_[front_].value; }

 private:
  static constexpr unsigned index = 3;  ///< bits that number a slot
  static constexpr unsigned fresh = 4;  ///< the shared slot was written after the last take-over

  // Each slot and each index has a cache line of its own, 64 bytes on x86-64 and ARM. So the
  // threads do not slow each other down.
  struct alignas(64) Slot {
    T value{};
  };
  std::array<Slot, 3> slots_{};
  alignas(64) unsigned back_ = 0;            ///< the writer's slot
  alignas(64) Atomic<unsigned> shared_ = 1;  ///< the slot in between, and whether it is fresh
  alignas(64) unsigned front_ = 2;           ///< the reader's slot
};

}  // namespace articula
