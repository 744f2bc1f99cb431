// SPDX-License-Identifier: Apache-2.0
/// @file The thread in which a TopicHardware with a transport of its own polls it.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/ros2/transport.hpp"

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace articula::ros2::detail {

/// Polls a transport and calls a function after each poll, at least every millisecond or so, and
/// once more at its end. An exception ends it early; then it calls another function, if there is
/// one.
class TopicThread {
 public:
  /// @throws std::invalid_argument if the transport is null
  explicit TopicThread(std::unique_ptr<Transport> transport) : transport_(std::move(transport)) {
    if (transport_ == nullptr) articula::detail::refuse({"topic hardware: there is no transport"});
  }
  TopicThread(const TopicThread&) = delete;
  TopicThread& operator=(const TopicThread&) = delete;
  ~TopicThread() { stop(); }

  [[nodiscard]] Transport& transport() noexcept { return *transport_; }
  /// Begins to poll.
  void start(std::function<void()> exchange, std::function<void()> failed = {}) {
    thread_ = std::thread([this, exchange = std::move(exchange), failed = std::move(failed)] {
      run(exchange);
      if (failed && !error().empty()) failed();
    });
  }
  /// Ends the thread, but not the transport.
  void stop() {
    runs_ = false;
    if (thread_.joinable()) thread_.join();
  }
  /// The exception that has ended the thread; else empty.
  [[nodiscard]] std::string error() const {
    const std::lock_guard lock(mutex_);
    return error_;
  }

 private:
  void run(const std::function<void()>& exchange) {
    try {
      while (runs_) {
        transport_->poll(std::chrono::milliseconds(1));
        exchange();
      }
      exchange();
    } catch (const std::exception& caught) {
      const std::lock_guard lock(mutex_);
      error_ = caught.what();
    }
  }

  std::unique_ptr<Transport> transport_;
  std::atomic<bool> runs_ = true;
  mutable std::mutex mutex_{};
  std::string error_{};  ///< under the mutex
  std::thread thread_{};
};

}  // namespace articula::ros2::detail
