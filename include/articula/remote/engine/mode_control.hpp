// SPDX-License-Identifier: Apache-2.0
/// @file The modes of a remote loop, and the tasks that change them.
#pragma once

#include "articula/loop/supervision/loop_mode.hpp"
#include "articula/remote/engine/loop_traits.hpp"
#include "articula/remote/engine/task_returns.hpp"

#include <variant>

namespace articula::remote {

/// The modes of a loop: of a supervised one its own; a plain one is always active. In the loop's
/// thread. Real-time: yes, if the hardware's activation is.
/// @tparam LoopType  a ControlLoop or SupervisedControlLoop
template <class LoopType>
class ModeControl {
 public:
  using R = typename LoopType::RobotType;
  static constexpr bool supervised = is_supervised<LoopType>;

  ModeControl(LoopType& loop, TaskReturns<R>& returns) : loop_(loop), returns_(returns) {}

  [[nodiscard]] LoopMode mode() const noexcept {
    if constexpr (supervised) {
      return loop_.mode();
    } else {
      return LoopMode::active;
    }
  }
  /// The last fault; ok before the first.
  [[nodiscard]] Status fault() const noexcept {
    if constexpr (supervised) {
      return loop_.fault();
    } else {
      return Status::ok;
    }
  }
  [[nodiscard]] bool active() const noexcept { return mode() == LoopMode::active; }
  /// Whether the loop takes references: a supervised one after its first good active cycle.
  [[nodiscard]] bool takes_references() const noexcept { return takes_references_; }
  /// Whether a change of mode is under way.
  [[nodiscard]] bool changes() const noexcept { return waiting_ != nullptr; }

  void begin(Task<R>& own, task::Activate&) noexcept {
    if constexpr (supervised) {
      if (active()) return returns_.finish(own, TaskEnd::done);
      if (mode() == LoopMode::fault) return returns_.finish(own, TaskEnd::in_fault);
      activate(own);
    }
  }
  void begin(Task<R>& own, task::Deactivate&) noexcept {
    if constexpr (supervised) {
      if (mode() == LoopMode::inactive) return returns_.finish(own, TaskEnd::done);
      if (mode() == LoopMode::fault) return returns_.finish(own, TaskEnd::in_fault);
      loop_.request_deactivation();
      await(own);
    }
  }
  void begin(Task<R>& own, task::Acknowledge&) noexcept {
    if constexpr (supervised) {
      if (mode() != LoopMode::fault) return returns_.finish(own, TaskEnd::no_fault);
      loop_.acknowledge_fault();
      await(own);
    }
  }

  /// Activates a supervised loop that is inactive.
  void activate(Task<R>& own) noexcept {
    loop_.request_activation();
    takes_references_ = false;
    await(own);
  }

  /// Looks at the modes after a cycle.
  void note_cycle(Status status) noexcept {
    takes_references_ = active() && (takes_references_ || !supervised || status == Status::ok);
    if (waiting_ == nullptr || mode() == LoopMode::starting) return;
    const bool activates =
        std::holds_alternative<task::Activate>(waiting_->wish) ||
        std::holds_alternative<task::Place<LoopType::joint_count>>(waiting_->wish);
    const LoopMode wanted = activates ? LoopMode::active : LoopMode::inactive;
    if (activates && active() && !takes_references_) return;
    const TaskEnd other = mode() == LoopMode::fault ? TaskEnd::in_fault : TaskEnd::not_active;
    returns_.give_back(waiting_, mode() == wanted ? TaskEnd::done : other);
  }

  /// The loop has ended.
  void note_end() noexcept {
    takes_references_ = false;
    returns_.give_back(waiting_, TaskEnd::loop_left_active);
  }

 private:
  void await(Task<R>& own) noexcept {
    returns_.give_back(waiting_, TaskEnd::replaced);
    waiting_ = &own;
  }

  LoopType& loop_;
  TaskReturns<R>& returns_;
  bool takes_references_ = !supervised;
  Task<R>* waiting_ = nullptr;  ///< ends with a change of mode
};

}  // namespace articula::remote
