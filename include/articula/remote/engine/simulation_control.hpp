// SPDX-License-Identifier: Apache-2.0
/// @file The pace of a simulated loop, its resets and pulls, and the tasks for them.
#pragma once

#include "articula/remote/engine/link_pull.hpp"
#include "articula/remote/engine/mode_control.hpp"
#include "articula/remote/engine/motion_control.hpp"
#include "articula/remote/engine/simulated_pace.hpp"
#include "articula/remote/engine/task_returns.hpp"

namespace articula::remote {

/// What only a simulation can do. Of other loops, each period has one cycle, and none of these
/// tasks come. In the loop's thread. Real-time: yes.
/// @tparam LoopType  a ControlLoop or SupervisedControlLoop
template <class LoopType>
class SimulationControl {
 public:
  using R = typename LoopType::RobotType;
  static constexpr int joint_count = LoopType::joint_count;
  static constexpr bool simulated = is_simulated<LoopType>;

  SimulationControl(LoopType& loop, TaskReturns<R>& returns, ModeControl<LoopType>& modes,
                    MotionControl<LoopType>& motions)
      : loop_(loop), returns_(returns), modes_(modes), motions_(motions) {}

  [[nodiscard]] const SimulatedPace& pace() const noexcept { return pace_; }

  /// The number of cycles of this period. A change of mode takes cycles, also while paused.
  [[nodiscard]] int cycles_due() noexcept {
    if constexpr (!simulated) return 1;
    const int due = pace_.advance();
    return due == 0 && modes_.changes() ? 1 : due;
  }

  /// Lets the pull act in the next cycle.
  void act() noexcept {
    if constexpr (simulated) {
      if (!pull_.acts()) return;
      auto& hardware = loop_.hardware();
      hardware.set_external_effort(pull_.effort(hardware.robot(), hardware.true_state().position));
    }
  }

  /// Ends the single steps that are made.
  void note_cycles() noexcept {
    if (pace_.steps() == 0) returns_.give_back(waiting_, TaskEnd::done);
  }
  /// The loop has ended.
  void note_end() noexcept { returns_.give_back(waiting_, TaskEnd::loop_left_active); }

  void end_pull() noexcept { pull({}); }

  void begin(Task<R>& own, task::Pause& wish) noexcept {
    returns_.give_back(waiting_, TaskEnd::replaced);
    pace_.pause(wish.paused);
    returns_.finish(own, TaskEnd::done);
  }
  void begin(Task<R>& own, task::Step& wish) noexcept {
    if (!pace_.paused()) return returns_.finish(own, TaskEnd::not_paused);
    returns_.give_back(waiting_, TaskEnd::replaced);
    pace_.pause(true);
    pace_.step(wish.cycles);
    waiting_ = &own;
  }
  void begin(Task<R>& own, task::SetSpeed& wish) noexcept {
    pace_.set_speed(wish.factor);
    returns_.finish(own, TaskEnd::done);
  }
  void begin(Task<R>& own, task::Pull& wish) noexcept {
    pull(wish);
    returns_.finish(own, TaskEnd::done);
  }
  void begin(Task<R>& own, [[maybe_unused]] task::Place<joint_count>& wish) noexcept {
    if constexpr (simulated) {
      const JointVector<joint_count> rest = JointVector<joint_count>::Zero();
      auto& hardware = loop_.hardware();
      motions_.abandon();
      if constexpr (is_supervised<LoopType>) {
        const bool was_active = modes_.active() || modes_.mode() == LoopMode::starting;
        static_cast<void>(loop_.stop());
        hardware.set_state(wish.position, rest);
        if (was_active) return modes_.activate(own);
      } else {
        // A cycle without hardware makes the loop start its controller again, without a memory.
        static_cast<void>(hardware.deactivate());
        static_cast<void>(loop_.update());
        hardware.set_state(wish.position, rest);
        static_cast<void>(hardware.activate());
        loop_.reference() = {.position = wish.position};
      }
      returns_.finish(own, TaskEnd::done);
    }
  }

 private:
  void pull([[maybe_unused]] const task::Pull& wish) noexcept {
    if constexpr (simulated) {
      pull_.set(wish.link, wish.point, wish.force);
      if (!pull_.acts()) {
        loop_.hardware().set_external_effort(JointVector<joint_count>::Zero());
      }
    }
  }

  LoopType& loop_;
  TaskReturns<R>& returns_;
  ModeControl<LoopType>& modes_;
  MotionControl<LoopType>& motions_;
  SimulatedPace pace_{};
  LinkPull<R> pull_{};
  Task<R>* waiting_ = nullptr;  ///< ends with the last single step
};

}  // namespace articula::remote
