// SPDX-License-Identifier: Apache-2.0
/// @file The mutex of programs with threads, and of those without.
#pragma once

#include <mutex>

namespace articula::remote {

#if !defined(__wasi__) || defined(_REENTRANT)
using Mutex = std::mutex;
#else
/// WebAssembly without threads has no std::mutex and needs none.
struct Mutex {
  void lock() noexcept {}
  void unlock() noexcept {}
};
#endif

}  // namespace articula::remote
