// SPDX-License-Identifier: Apache-2.0
/// @file What urdfdom says goes into our error messages instead of the terminal.
#pragma once

#include <console_bridge/console.h>

#include <mutex>
#include <string>

namespace articula::detail {

/// While it lives, errors that urdfdom logs (through console_bridge, whose receiver is global) come
/// here. One at a time: another thread's waits.
class MessageCatcher {
 public:
  MessageCatcher()
      : lock_(receiver().mutex),
        previous_(console_bridge::getOutputHandler()),
        level_(console_bridge::getLogLevel()) {
    receiver().errors.clear();
    console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_ERROR);
    console_bridge::useOutputHandler(&receiver());
  }
  ~MessageCatcher() {
    console_bridge::useOutputHandler(previous_);
    console_bridge::setLogLevel(level_);
  }
  MessageCatcher(const MessageCatcher&) = delete;
  MessageCatcher& operator=(const MessageCatcher&) = delete;

  /// The errors so far, separated by semicolons.
  [[nodiscard]] const std::string& errors() const noexcept { return receiver().errors; }

 private:
  struct Receiver final : console_bridge::OutputHandler {
    void log(const std::string& text, console_bridge::LogLevel, const char*, int) override {
      if (!errors.empty()) errors += "; ";
      for (char c : text) errors += c == '\n' ? ' ' : c;
    }
    std::string errors{};
    std::mutex mutex{};
  };
  /// Lives to the end of the program, as console_bridge remembers the previous receiver.
  [[nodiscard]] static Receiver& receiver() {
    static Receiver& receiver = *new Receiver;
    return receiver;
  }

  std::lock_guard<std::mutex> lock_;
  console_bridge::OutputHandler* previous_;
  console_bridge::LogLevel level_;
};

}  // namespace articula::detail
