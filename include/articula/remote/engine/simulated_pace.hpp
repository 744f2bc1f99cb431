// SPDX-License-Identifier: Apache-2.0
/// @file The pace of a simulation: paused, in single steps, slower or faster than real time.
#pragma once

namespace articula::remote {

/// How many cycles of a simulated loop belong to each period of real time. Real-time: yes.
class SimulatedPace {
 public:
  void pause(bool paused) noexcept {
    paused_ = paused;
    steps_ = 0;
    credit_ = 0;
  }
  /// @param factor  simulated time in a second, > 0
  void set_speed(double factor) noexcept {
    speed_ = factor;
    credit_ = 0;
  }
  /// Makes some cycles while paused.
  void step(int cycles) noexcept { steps_ += cycles; }

  /// The number of cycles of the next period.
  [[nodiscard]] int advance() noexcept {
    if (paused_ && steps_ == 0) return 0;
    credit_ += speed_;
    int cycles = static_cast<int>(credit_ + rounding);
    credit_ -= cycles;
    if (paused_) {
      cycles = cycles < steps_ ? cycles : steps_;
      steps_ -= cycles;
    }
    return cycles;
  }

  [[nodiscard]] bool paused() const noexcept { return paused_; }
  [[nodiscard]] double speed() const noexcept { return speed_; }
  /// The single steps that are still to be made.
  [[nodiscard]] int steps() const noexcept { return steps_; }
  /// Whether a cycle belongs to each period, as on a real robot.
  [[nodiscard]] bool is_real_time() const noexcept { return !paused_ && speed_ == 1; }

 private:
  static constexpr double rounding = 1e-9;  ///< ten tenths are one cycle
  bool paused_ = false;
  double speed_ = 1;
  int steps_ = 0;
  double credit_ = 0;  ///< cycles that are due, below 1
};

}  // namespace articula::remote
