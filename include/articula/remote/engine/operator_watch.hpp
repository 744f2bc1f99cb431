// SPDX-License-Identifier: Apache-2.0
/// @file Whether the operator of a loop is still there.
#pragma once

#include <atomic>
#include <cstdint>

namespace articula::remote {

/// What happens to the robot when its operator is lost.
enum class OperatorLoss : unsigned char {
  stop,        ///< The motion ends by the fastest stop, and the robot holds its position.
  deactivate,  ///< A supervised loop is deactivated.
};

/// Tells a loop whether its operator is still there. The outside numbers the signs of life, of all
/// operators together; each task bears the number of the sign with which it came. The loop counts
/// the periods without a sign, so that it needs nobody else to notice a silence.
class OperatorWatch {
 public:
  /// What the loop has to do about its operator.
  struct News {
    bool left = false;  ///< An operator has released the controls, or is lost.
    bool lost = false;  ///< An operator is lost.
  };

  /// @param lifetime  in periods of the loop, after which a silent operator is lost
  explicit OperatorWatch(double lifetime) : lifetime_(lifetime) {}

  /// The operator has given a sign of life. For the outside.
  void report_alive() noexcept { signs_.store(++last_sign_, std::memory_order_release); }
  /// The number of the last sign. For the outside.
  [[nodiscard]] std::uint64_t last_sign() const noexcept { return last_sign_; }
  /// Nobody operates; the motion goes on. For the outside.
  void report_release() noexcept { left_.store(last_sign_, std::memory_order_release); }
  /// The operator is lost. For the outside.
  void report_loss() noexcept {
    lost_.store(last_sign_, std::memory_order_release);
    report_release();
  }

  /// One period later. For the loop, after it has taken a task: then it knows of all losses before
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
  /// Whether a task with this sign came from an operator who has left. For the loop. Real-time: yes.
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
