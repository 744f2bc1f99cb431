// SPDX-License-Identifier: Apache-2.0
/// @file Detects that the operator of a running loop is gone, as a watchdog does.
#pragma once

#include <atomic>
#include <cstdint>

namespace articula::remote {

/// What happens to the robot when its operator is lost.
enum class OperatorLoss : unsigned char {
  stop,        ///< The motion ends by the fastest stop, and the robot holds its position.
  deactivate,  ///< A supervised loop is deactivated.
};

/// A watchdog for the operator of a robot. A browser is closed, a network fails: the loop notices
/// it, ends the motion, and ignores tasks that are still under way.
///
///     OperatorWatch watch(500);        // lost after 500 periods of silence
///     watch.report_alive();            // outside: a sign of life from the operator
///     if (watch.look().lost) stop();   // loop, once a period
///
/// - The outside numbers the signs of life, of all operators together. Each task has the number of
///   the last sign before it.
/// - The outside gives a sign whenever it runs and knows of an operator that is not silent yet.
/// - The loop counts the periods without a sign. So it notices a silence even if all other threads
///   hang.
///
/// It notices no silent drive or sensor: hardware has limits on the age of its measurements. A
/// program that gives references itself, with no operator, needs no watch.
class OperatorWatch {
 public:
  /// The change since the period before.
  struct News {
    bool left = false;  ///< An operator has released the controls, or is lost.
    bool lost = false;  ///< An operator is lost.
  };

  /// @param lifetime  number of periods of the loop after which a silent operator is lost
  explicit OperatorWatch(double lifetime) : lifetime_(lifetime) {}

  /// The operator has given a sign of life. For the outside.
  void report_alive() noexcept { signs_.store(++last_sign_, std::memory_order_release); }
  /// The number of the last sign. For the outside.
  [[nodiscard]] std::uint64_t last_sign() const noexcept { return last_sign_; }
  /// The operator has released the controls. The motion goes on. For the outside.
  void report_release() noexcept { left_.store(last_sign_, std::memory_order_release); }
  /// The operator is lost. For the outside.
  void report_loss() noexcept {
    lost_.store(last_sign_, std::memory_order_release);
    report_release();
  }

  /// Counts a period. For the loop, after it has taken a task: so it knows of all losses before
  /// that task.
  /// Real-time: yes. Wait-free.
  [[nodiscard]] News look() noexcept {
    const std::uint64_t left = left_.load(std::memory_order_acquire);
    const std::uint64_t lost = lost_.load(std::memory_order_acquire);
    const std::uint64_t sign = signs_.load(std::memory_order_acquire);
    News news{.left = left != seen_left_, .lost = lost > void_};
    seen_left_ = left;
    if (news.lost) void_ = lost;
    if (sign != seen_sign_) {
      seen_sign_ = sign;
      silence_ = 0;
    } else if (sign > left && sign > void_ && ++silence_ > lifetime_) {
      void_ = sign;
      news = {.left = true, .lost = true};
    }
    return news;
  }
  /// Whether a task with this sign came from an operator who is lost. For the loop. Real-time: yes.
  [[nodiscard]] bool is_void(std::uint64_t sign) const noexcept { return sign <= void_; }
  /// Whether a task with this sign came from an operator who has left. For the loop.
  /// Real-time: yes.
  [[nodiscard]] bool has_left(std::uint64_t sign) const noexcept { return sign <= seen_left_; }

 private:
  double lifetime_;
  // The outside's:
  std::uint64_t last_sign_ = 0;
  // Between both:
  alignas(64) std::atomic<std::uint64_t> signs_ = 0;
  std::atomic<std::uint64_t> left_ = 0;  ///< who gave the signs up to this one operates no more
  std::atomic<std::uint64_t> lost_ = 0;  ///< and was lost
  // The loop's:
  alignas(64) std::uint64_t seen_sign_ = 0;
  std::uint64_t seen_left_ = 0;
  std::uint64_t void_ = 0;  ///< what came with signs up to this one is not done any more
  double silence_ = 0;      ///< [periods]
};

}  // namespace articula::remote
