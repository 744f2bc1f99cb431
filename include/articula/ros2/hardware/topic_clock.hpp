// SPDX-License-Identifier: Apache-2.0
/// @file The time of a simulator that lives in ROS 2, as the clock of a loop.
#pragma once

#include "articula/loop/stop_flag.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <utility>

namespace articula::ros2 {

namespace detail {

/// The time that the messages of /clock tell, from the transport's thread to the loop's.
class ToldTime {
 public:
  using Time = std::chrono::nanoseconds;
  /// The time after the last message, if the transport fails.
  static constexpr Time end_of_time = Time::max() / 4;

  // For the transport's thread. Real-time: no (locks).

  /// Takes a message's time over. A time before the last one is that of a simulation that was reset.
  void take(Time told) {
    const Time step = is_known() ? std::max(told - told_, Time(0)) : Time(0);
    told_ = told;
    is_known_.store(true, std::memory_order_release);
    set(std::min(now() + step, end_of_time));
  }
  /// The time of the last message.
  [[nodiscard]] Time told() const noexcept { return told_; }
  /// No message will come any more.
  void end() { set(end_of_time); }

  // For any thread:

  /// The simulated time since the first message, resets left out. Real-time: yes.
  [[nodiscard]] Time now() const noexcept { return now_.load(std::memory_order_acquire); }
  /// Whether a message has come. Real-time: yes.
  [[nodiscard]] bool is_known() const noexcept { return is_known_.load(std::memory_order_acquire); }
  /// Waits until that time, or until the flag is set. Real-time: no (waits).
  void wait_until(Time due, const StopFlag* stop) {
    std::unique_lock lock(mutex_);
    // Nobody wakes up for the flag.
    while (now() < due && (stop == nullptr || !stop->requested())) {
      changed_.wait_for(lock, std::chrono::milliseconds(5));
    }
  }

 private:
  void set(Time now) {
    {
      const std::lock_guard lock(mutex_);
      now_.store(now, std::memory_order_release);
    }
    changed_.notify_all();
  }

  std::atomic<Time> now_{Time(0)};
  std::atomic<bool> is_known_ = false;
  Time told_{};  ///< by the last message
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
  TopicClock(std::shared_ptr<detail::ToldTime> time, const StopFlag* stop) noexcept
      : time_(std::move(time)), stop_(stop) {}

  /// The simulator's time. Real-time: yes.
  [[nodiscard]] Time now() const noexcept { return time_->now(); }
  /// Waits until the simulator's time is `due`, or the stop is requested. Real-time: no (waits).
  Time wait_until(Time due) const noexcept {
    time_->wait_until(due, stop_);
    return due;
  }

 private:
  std::shared_ptr<detail::ToldTime> time_;
  const StopFlag* stop_;
};

}  // namespace articula::ros2
