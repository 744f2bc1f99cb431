// SPDX-License-Identifier: Apache-2.0
/// @file The session by which ROS operates a loop.
#pragma once

#include "articula/remote/port.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <utility>

namespace articula::ros2 {

/// Hands the requests of ROS's clients to a loop and their answers back. All of them are one
/// operator to the loop, with the same checks as others. It keeps the controls while requests or
/// trajectories are going on, and releases them some time later. In the thread that polls the
/// transport. Real-time: no (allocates, locks).
class LoopOperator {
 public:
  static constexpr const char* name = "ROS 2";  ///< as other clients see it

  using OnAnswer = std::function<void(const remote::Answer&)>;

  /// @param port      outlives this
  /// @param operates  whether it may take the controls
  /// @param release   time without requests after which it releases the controls
  LoopOperator(remote::Port& port, bool operates, std::chrono::nanoseconds release)
      : session_(port.connect(name, operates)), release_(release) {}

  /// Asks, and calls a function with the answer: in a later `update`, not in this call.
  /// @return its number
  std::uint64_t ask(const remote::Request& request, OnAnswer on_answer) {
    const std::uint64_t number = session_->ask(request);
    waiting_.emplace(number, std::move(on_answer));
    last_request_ = now_;
    return number;
  }
  /// The number of requests without an answer.
  [[nodiscard]] std::size_t waiting() const noexcept { return waiting_.size(); }

  /// Delivers answers, shows signs of life, releases the controls.
  /// @param now  of a clock that may jump
  void update(std::chrono::nanoseconds now) {
    now_ = now;
    last_request_ = std::min(last_request_, now);
    while (const auto answer = session_->answer()) {
      const auto found = waiting_.find(answer->request);
      if (found == waiting_.end()) continue;
      const OnAnswer on_answer = std::move(found->second);
      waiting_.erase(found);
      on_answer(*answer);
    }
    if (!session_->has_controls()) return;
    const bool is_idle = waiting_.empty() && now - last_request_ > release_;
    is_idle ? session_->release_controls() : session_->keep_alive();
  }

  /// The session, for its cycles and events.
  [[nodiscard]] remote::Session& session() noexcept { return *session_; }

 private:
  std::unique_ptr<remote::Session> session_;
  std::chrono::nanoseconds release_;
  std::chrono::nanoseconds now_{0};
  std::chrono::nanoseconds last_request_{0};
  std::map<std::uint64_t, OnAnswer> waiting_{};
};

}  // namespace articula::ros2
