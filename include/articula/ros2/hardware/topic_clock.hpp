// SPDX-License-Identifier: Apache-2.0
/// @file The time of a simulator in ROS 2, as the clock of a loop.
#pragma once

#include "articula/loop/stop_flag.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace articula::ros2 {

namespace detail {

/// The time that the messages of /clock tell, from the transport's thread to the loop's.
class ReceivedTime {
 public:
  using Time = std::chrono::nanoseconds;
  /// A longer step is no time that passes: the simulation was set to another time, or two programs
  /// send the topic.
  static constexpr Time longest_step = std::chrono::seconds(10);

  // For the transport's thread. Real-time: no (locks).

  /// Takes a message's time over. A step backwards, or a longer one, counts as a jump.
  void take(Time received) noexcept {
    const Time step = latest_ ? received - *latest_ : Time(0);
    latest_ = received;
    if (step < Time(0) || step > longest_step) {
      jumps_.fetch_add(1, std::memory_order_relaxed);
    } else {
      waiting_ += step;
    }
  }
  /// Lets the time that was taken pass: the loop then has what else came with it.
  void pass() {
    if (!latest_ || (is_known() && waiting_ == Time(0))) return;
    {
      const std::lock_guard lock(mutex_);
      passed_.store(passed_.load() + waiting_, std::memory_order_release);
      is_known_.store(true, std::memory_order_release);
    }
    waiting_ = Time(0);
    changed_.notify_all();
  }
  /// The time of the last message.
  [[nodiscard]] Time latest() const noexcept { return latest_.value_or(Time(0)); }
  /// No message will come any more: from here on the time is that of this host, so that who waits
  /// for it comes to know.
  void end() { ended_.store(host(), std::memory_order_release); }

  // For any thread:

  /// The simulated time since the first message, jumps left out. Real-time: yes, but for the clock
  /// after the end.
  [[nodiscard]] Time now() const noexcept {
    const Time ended = ended_.load(std::memory_order_acquire);
    const Time passed = passed_.load(std::memory_order_acquire);
    return ended == Time(0) ? passed : passed + (host() - ended);
  }
  /// Whether time passes: a message has come. Real-time: yes.
  [[nodiscard]] bool is_known() const noexcept { return is_known_.load(std::memory_order_acquire); }
  [[nodiscard]] std::uint64_t jumps() const noexcept {
    return jumps_.load(std::memory_order_relaxed);
  }
  /// Waits until that time, or until the flag is set. Real-time: no (waits).
  void wait_until(Time due, const StopFlag* stop) {
    // Nobody wakes up for the flag, nor for the host's time after the end.
    constexpr Time longest_sleep = std::chrono::milliseconds(5);
    std::unique_lock lock(mutex_);
    for (Time left = due - now(); left > Time(0) && (stop == nullptr || !stop->requested());
         left = due - now()) {
      const bool has_ended = ended_.load(std::memory_order_acquire) != Time(0);
      changed_.wait_for(lock, has_ended ? std::min(left, longest_sleep) : longest_sleep);
    }
  }

 private:
  static Time host() noexcept { return std::chrono::steady_clock::now().time_since_epoch(); }

  std::atomic<Time> passed_{Time(0)};
  std::atomic<Time> ended_{Time(0)};  ///< when, by the host's clock; 0: it goes on
  std::atomic<bool> is_known_ = false;
  std::atomic<std::uint64_t> jumps_ = 0;
  std::optional<Time> latest_{};  ///< by the last message
  Time waiting_{0};               ///< taken, and not passed yet
  std::mutex mutex_{};
  std::condition_variable changed_{};
};

}  // namespace detail

/// The simulated time of a TopicHardware, as a LoopClock: the loop makes its cycles as fast as the
/// simulator's time passes, and stands still while the simulator is paused.
///
///     StopFlag stop;
///     ros2::TopicClock clock = loop.hardware().clock(&stop);
///     run(loop, clock, {.stop = &stop});
///
/// The simulator sends /clock at least once a period. Of a longer step the loop makes the first and
/// the last cycle, and reports the others as missed.
class TopicClock {
 public:
  using Time = std::chrono::nanoseconds;

  /// @param time  of the hardware
  /// @param stop  ends a wait, which may last as long as the simulator is paused
  TopicClock(std::shared_ptr<detail::ReceivedTime> time, const StopFlag* stop) noexcept
      : time_(std::move(time)), stop_(stop) {}

  /// The simulator's time. Real-time: yes, but for the clock after the transport's end.
  [[nodiscard]] Time now() const noexcept { return time_->now(); }
  /// Waits until the simulator's time is `due`, or the stop is requested. Real-time: no (waits).
  Time wait_until(Time due) const noexcept {
    time_->wait_until(due, stop_);
    return due;
  }

 private:
  std::shared_ptr<detail::ReceivedTime> time_;
  const StopFlag* stop_;
};

}  // namespace articula::ros2
