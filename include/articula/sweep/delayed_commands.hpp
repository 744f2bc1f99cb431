// SPDX-License-Identifier: Apache-2.0
/// @file Hardware whose commands arrive late, or are lost.
#pragma once

#include "articula/core/hardware.hpp"
#include "articula/core/refuse.hpp"
#include "articula/sim/lost_commands.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace articula {

/// A simulator whose drives get each command some periods later. Until the first one arrives, they
/// get a command of zeros. In the place of a lost command they get the one before. Without delay
/// and loss it is the simulator, to the last bit.
/// @tparam H        the simulator
/// @tparam Command  that is delayed
template <class H, class Command = EffortCommand<H::joint_count, ScalarOf<H>>>
class DelayedCommands {
 public:
  using RobotType = typename H::RobotType;
  using Scalar = ScalarOf<H>;
  static constexpr int joint_count = H::joint_count;

  /// @param simulator  behind the delay
  /// @param delay      0 .. 1 000 000 [periods]
  /// @param lost       commands that do not arrive
  /// @throws std::invalid_argument if the delay or the share of lost commands is out of range
  DelayedCommands(H simulator, int delay, const LostCommands& lost = {})
      : simulator_(std::move(simulator)), lost_(lost) {
    validate(lost);
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
    const std::size_t before = next_ == 0 ? waiting_.size() - 1 : next_ - 1;
    waiting_[next_] = lost_.contain(cycle_++) ? waiting_[before] : command;
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
  LostCommands lost_;
  std::uint64_t cycle_ = 0;
};

}  // namespace articula
