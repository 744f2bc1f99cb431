// SPDX-License-Identifier: Apache-2.0
/// @file Prepares a thread for real time: memory, stack, processors, priority. Linux.
#pragma once

#include "articula/core/refuse.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace articula {

/// Settings of the operating system for a real-time thread.
struct ThreadOptions {
  int priority = 80;                ///< SCHED_FIFO, 1 (low) .. 99; 0: scheduling is not changed
  std::vector<int> processors{};    ///< numbers of those it may run on; empty: not changed
  bool lock_memory = true;          ///< locks all present and future memory of the program
  std::size_t stack_size = 262144;  ///< part of the stack that is touched in advance [bytes]

  bool strict = false;  ///< whether a refusal of the system is an error, not a warning

  /// Receives a line for each setting that the system refuses. The default writes it to standard
  /// error.
  std::function<void(const std::string&)> warn = [](const std::string& refusal) {
    static_cast<void>(std::fprintf(stderr, "warning: %s\n", refusal.c_str()));
  };
};

namespace detail {

/// Touches the stack page by page, so that later accesses cause no page fault.
[[gnu::noinline]] inline char touch_stack(std::size_t size) {
  constexpr std::size_t frame = 4096;
  volatile char page[frame];
  page[0] = 0;
  page[frame - 1] = 0;
  // Uses the page after the call, or the compiler would turn the recursion into a loop.
  return size > frame ? static_cast<char>(touch_stack(size - frame) + page[0]) : page[0];
}

}  // namespace detail

/// Applies the options to the calling thread: locked memory, touched stack, processors, priority.
/// They stay in force after the run.
/// @throws std::invalid_argument if an option is out of range; the message names it, its value and
///         the limit
/// @throws std::system_error if the system refuses a setting and the options are strict
/// Real-time: no (set-up).
inline void make_realtime(const ThreadOptions& options) {
  if (options.priority < 0 || options.priority > 99) {
    detail::refuse({"real-time thread: priority ", options.priority, " is not between 0 and 99"});
  }
  for (const int processor : options.processors) {
    if (processor < 0 || processor >= CPU_SETSIZE) {
      detail::refuse(
          {"real-time thread: processor ", processor, " is not between 0 and ", CPU_SETSIZE - 1});
    }
  }
  rlimit stack{};
  if (getrlimit(RLIMIT_STACK, &stack) == 0 && options.stack_size > stack.rlim_cur / 2) {
    detail::refuse({"real-time thread: stack_size ", options.stack_size,
                    " is more than half of the stack, ", stack.rlim_cur});
  }

  const auto refused = [&](int error, std::string_view what, std::string_view remedy) {
    const std::string message = detail::message_of({"real-time thread: ", what});
    if (options.strict) {
      const std::string text = detail::message_of({message, remedy});
      throw std::system_error(error, std::generic_category(), text);
    }
    const std::string reason = std::generic_category().message(error);
    if (options.warn) options.warn(detail::message_of({message, ": ", reason, remedy}));
  };
  if (options.lock_memory && mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    refused(errno, "memory cannot be locked", " (needs CAP_IPC_LOCK or a higher ulimit -l)");
  }
  static_cast<void>(detail::touch_stack(options.stack_size));
  if (!options.processors.empty()) {
    cpu_set_t set;
    CPU_ZERO(&set);
    for (const int processor : options.processors) {
      CPU_SET(static_cast<std::size_t>(processor), &set);
    }
    const int error = pthread_setaffinity_np(pthread_self(), sizeof set, &set);
    if (error != 0) refused(error, "none of the processors can be used", "");
  }
  if (options.priority > 0) {
    sched_param parameters{};
    parameters.sched_priority = options.priority;
    const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
    if (error != 0) {
      refused(error,
              detail::message_of({"SCHED_FIFO priority ", options.priority, " is not granted"}),
              " (needs CAP_SYS_NICE or a higher ulimit -r)");
    }
  }
}

}  // namespace articula
