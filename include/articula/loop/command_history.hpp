// SPDX-License-Identifier: Apache-2.0
/// @file The last commands of a loop: what reached the drives, and whether it held the joints.
#pragma once

#include "articula/command/command_numbers.hpp"
#include "articula/core/controller.hpp"
#include "articula/core/status.hpp"

namespace articula {

/// What the commands of a loop's last cycles have done, and whether the controller's memory still
/// fits the motion. ControlLoop keeps one; use it to write a loop of your own.
///
/// A cycle in which the controller's own command was written is good. The controller must start
/// after more than `borne_cycles` bad cycles in a row. It also must after one in which the hardware
/// could not be read or written. The motion that it remembers is over then.
/// @tparam Command  that the loop writes
/// @tparam S        type of a number, as that of the command
template <class Command, class S = typename detail::CommandScalar<Command>::Type>
class CommandHistory {
 public:
  static constexpr int joint_count = Command::joint_count;
  using State = JointState<joint_count, S>;
  using Input = ControlInput<joint_count, S>;

  /// What the last command has done. Real-time: yes.
  [[nodiscard]] Held held() const noexcept { return held_; }
  /// Whether the controller must start before its next call. Real-time: yes.
  [[nodiscard]] bool must_start() const noexcept { return bad_cycles_ > detail::borne_cycles; }

  /// Forgets the cycles before the first good state. Real-time: yes.
  void begin() noexcept {
    bad_cycles_ = 0;
    held_ = Held::load;
  }

  /// Lets the controller learn, as at its start, what the last command has done.
  /// @param command  the last one
  /// @param state    measured now
  /// @param held     what it has done; nothing for a cold start
  /// Real-time: yes.
  void start_with(const Command& command, const State& state, Held held) noexcept {
    applied_ = {};
    if (held != Held::nothing) applied_ = {numbers_of(command, state), held};
    cut_.setZero();
  }

  /// Notes the controller's command, and what was written in the end.
  /// @param own      of the controller
  /// @param written  within the drives' limits, or the safe command
  /// @param state    for which the controller was called
  /// Real-time: yes.
  void note_command(const Outcome<Command>& own, const Command& written,
                    const State& state) noexcept {
    applied_ = {numbers_of(written, state), Held::push};
    cut_.setZero();
    if constexpr (requires { written.effort; }) {
      if (own.verdict != Verdict::failed) cut_ = own.command.effort - written.effort;
    }
  }

  /// Notes how a cycle went.
  /// @param controls  the controller's own command was written
  /// @param known     the state was measured, and is finite
  /// @param read      the status of reading
  /// @param write     the status of writing
  /// Real-time: yes.
  void note_cycle(bool controls, bool known, Status read, Status write) noexcept {
    if (controls && write == Status::ok) return begin();
    if (!must_start()) ++bad_cycles_;
    const bool uncontrolled = read == Status::hardware_fault || read == Status::inactive;
    if (uncontrolled || write != Status::ok) bad_cycles_ = detail::borne_cycles + 1;
    const bool inactive = read == Status::inactive || write == Status::inactive;
    const bool lost = !known || write != Status::ok || held_ != Held::load;
    held_ = inactive ? Held::nothing : lost ? Held::unsure : Held::load;
  }

  /// The input of the controller's next call. Real-time: yes.
  [[nodiscard]] Input input(const State& state, const JointReference<joint_count, S>& reference,
                            double period) const noexcept {
    return {state, reference, period, applied_, cut_};
  }

 private:
  int bad_cycles_ = 0;                 ///< in a row, counted to one more than are borne
  Held held_ = Held::unsure;           ///< what the last command has done
  Applied<joint_count, S> applied_{};  ///< at the controller's last call
  JointVector<joint_count, S> cut_ = JointVector<joint_count, S>::Zero();  ///< likewise
};

}  // namespace articula
