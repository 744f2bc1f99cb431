// SPDX-License-Identifier: Apache-2.0
/// @file
/// Proves that a piece of code does not touch the heap. For the programs of tests/realtime only:
/// linking allocation_guard.cpp replaces malloc and its kin in the whole program.
#pragma once

#include <cstddef>

namespace articula::testing {

/// While it lives and is armed, every call of malloc, calloc, realloc, free, aligned_alloc,
/// posix_memalign, memalign, operator new or operator delete by this thread is counted, also those
/// in shared libraries. The calls themselves succeed as ever. One guard at a time per thread.
///
///     AllocationGuard guard;
///     loop.update();
///     guard.disarm();                    // before CHECK, which allocates
///     CHECK(guard.violations() == 0);
class AllocationGuard {
 public:
  AllocationGuard() noexcept;
  ~AllocationGuard();
  AllocationGuard(const AllocationGuard&) = delete;
  AllocationGuard& operator=(const AllocationGuard&) = delete;

  void disarm() noexcept;

  /// How many forbidden calls were made while armed.
  std::size_t violations() const noexcept;

  /// The C function that was called first, say "malloc"; "none" where there was no call.
  const char* first_violation() const noexcept;
};

/// How often `function()` touches the heap: `CHECK(heap_calls_in([&] { loop.update(); }) == 0)`.
template <typename Function>
std::size_t heap_calls_in(Function&& function) {
  AllocationGuard guard;
  function();
  guard.disarm();
  return guard.violations();
}

}  // namespace articula::testing
