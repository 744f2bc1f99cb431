// SPDX-License-Identifier: Apache-2.0
/// @file Ending a loop by Ctrl-C. Linux and other POSIX systems.
#pragma once

#include "articula/loop/stop_flag.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>

namespace articula {

/// While it lives, SIGINT (Ctrl-C) and SIGTERM raise a stop flag. Afterwards they do what they did
/// before. One at a time.
class StopOnSignal {
 public:
  /// @param flag  raised by the signals; outlives this object
  /// @throws std::logic_error if there is one already
  /// @throws std::system_error if the system refuses
  explicit StopOnSignal(StopFlag& flag) {
    StopFlag* none = nullptr;
    if (!target().compare_exchange_strong(none, &flag)) {
      throw std::logic_error("StopOnSignal: there is one already");
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
  /// A signal handler can be given nothing but a global. Constant initialisation: no guard, no
  /// lock.
  [[nodiscard]] static std::atomic<StopFlag*>& target() noexcept {
    static constinit std::atomic<StopFlag*> flag{nullptr};
    return flag;
  }

  struct sigaction interrupt_{};
  struct sigaction terminate_{};
};

}  // namespace articula
