// SPDX-License-Identifier: Apache-2.0
/// @file Hardware whose commands arrive late.
#pragma once

#include "articula/core/hardware.hpp"
#include "articula/core/refuse.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace articula {

/// A simulator whose drives get each command some periods later. Until the first one arrives, they
/// get a command of zeros. Without a delay it is the simulator, to the last bit.
/// @tparam H        the simulator
/// @tparam Command  that is delayed
template <class H, class Command>
class DelayedCommands {
 public:
  using RobotType = typename H::RobotType;
  using Scalar = ScalarOf<H>;
  static constexpr int joint_count = H::joint_count;

  /// @param simulator  behind the delay
  /// @param delay      0 .. 1 000 000 [periods]
  /// @throws std::invalid_argument if the delay is out of range
  DelayedCommands(H simulator, int delay) : simulator_(std::move(simulator)) {
    constexpr int longest = 1'000'000;
    if (delay < 0 || delay > longest) {
      detail::refuse({"delay: ", delay, " periods are not within 0 .. ", longest});
    }
    waiting_.resize(static_cast<std::size_t>(delay) + 1);
  }

  /// Real-time: yes.
  [[nodiscard]] Status activate() noexcept { return simulator_.activate(); }
  /// Real-time: yes.
  [[nodiscard]] Status deactivate() noexcept { return simulator_.deactivate(); }
  /// Real-time: yes.
  [[nodiscard]] Status read(JointState<joint_count, Scalar>& state) noexcept {
    return simulator_.read(state);
  }
  /// Real-time: yes.
  [[nodiscard]] Status write(const Command& command) noexcept {
    waiting_[next_] = command;
    next_ = next_ + 1 == waiting_.size() ? 0 : next_ + 1;
    return simulator_.write(waiting_[next_]);
  }
  [[nodiscard]] const RobotType& robot() const noexcept { return simulator_.robot(); }
  [[nodiscard]] double period() const noexcept { return simulator_.period(); }
  [[nodiscard]] H& simulator() noexcept { return simulator_; }
  [[nodiscard]] const H& simulator() const noexcept { return simulator_; }

 private:
  H simulator_;
  std::vector<Command> waiting_{};  ///< a ring; the place behind the newest has the oldest
  std::size_t next_ = 0;
};

}  // namespace articula
