// SPDX-License-Identifier: Apache-2.0
/// @file Ends a loop on Ctrl-C. Linux and other POSIX systems.
#pragma once

#include "articula/loop/stop_flag.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>

namespace articula {

/// During its lifetime, SIGINT (Ctrl-C) and SIGTERM raise a stop flag. Its end restores the
/// previous signal handlers. A program has at most one at a time:
///
///     StopFlag stop;
///     StopOnSignal on_signal(stop);
///     run(loop, {.run = {.stop = &stop}});
class StopOnSignal {
 public:
  /// @param flag  raised by the signals; outlives this object
  /// @throws std::logic_error if there is another StopOnSignal
  /// @throws std::system_error if the system refuses the signal handlers
  explicit StopOnSignal(StopFlag& flag) {
    StopFlag* none = nullptr;
    if (!target().compare_exchange_strong(none, &flag)) {
      throw std::logic_error("StopOnSignal: there is another one; end it first");
    }
    struct sigaction action{};
    action.sa_handler = [](int) {
      if (StopFlag* raised = target().load()) raised->request();
    };
    if (sigaction(SIGINT, &action, &interrupt_) != 0 ||
        sigaction(SIGTERM, &action, &terminate_) != 0) {
      target().store(nullptr);
      throw std::system_error(errno, std::generic_category(), "StopOnSignal");
    }
  }
  ~StopOnSignal() {
    sigaction(SIGINT, &interrupt_, nullptr);
    sigaction(SIGTERM, &terminate_, nullptr);
    target().store(nullptr);
  }
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

 private:
  // A signal handler can only use globals. Constant initialisation needs neither guard nor lock.
  [[nodiscard]] static std::atomic<StopFlag*>& target() noexcept {
    static constinit std::atomic<StopFlag*> flag{nullptr};
    return flag;
  }

  struct sigaction interrupt_{};
  struct sigaction terminate_{};
};

}  // namespace articula
