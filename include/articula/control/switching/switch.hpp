// SPDX-License-Identifier: Apache-2.0
/// @file Switching between controllers without a step of the command.
#pragma once

#include "articula/control/switching/bumpless_transfer.hpp"
#include "articula/control/switching/controller_selector.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <utility>

namespace articula {

/// Several controllers for the same joints, of which one is active, or none. Use it where a robot
/// changes its control mode, or needs a second controller for the case that the first one fails:
///
///     template <class R>
///     using Controllers = Switch<R, Bypass<R>, PidPlusGravity<R>, ComputedTorque<R>>;
///     Loop<Q2dSim, Controllers> loop;
///     loop.controller().request({.start = {"computed_torque"}, .replace = true});
///
/// - A request takes effect in the next update; from another thread it comes by a SwitchExchange.
/// - A controller that becomes active is started. If it was requested, it starts with the last
///   command, so that its integrals begin there.
/// - The command goes on from the last one: a difference is carried over and decays at the slew
///   (see BumplessTransfer). So a switch changes no joint's command by more than slew * period in a
///   cycle. It holds for switches during the decay, for start, stop and fallback alike.
/// - Without an active controller the command is that of Standby.
/// - If the active controller's verdict is not fine, the first of its fallbacks whose verdict is
///   takes over, within the same cycle. If none does, the active controller's outcome is passed on,
///   and it stays active. After a failed cycle the command goes on from what was applied instead.
///
/// One cycle calls one controller, with the fallbacks after a failure as many more. All commands
/// are within what the robot's description allows, as SumController's are. For controllers that act
/// on different joints at the same time see Groups.
///
/// The robots of a pack switch together. The difference that is carried over, and its decay, are
/// those of each robot. A verdict that is not fine is that of all robots.
/// @tparam R            the robot
/// @tparam Controllers  one or more, which satisfy Controller and have the same type of command; of
///                      packs, the first has a type `Scalar`
template <Robot R, class... Controllers>
class Switch : public ControllerSelector<R, Controllers...> {
  using Selector = ControllerSelector<R, Controllers...>;
  using Selector::none;

 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using typename Selector::Command;
  using typename Selector::Scalar;
  using Input = ControlInput<joint_count, Scalar>;
  using Vector = JointVector<joint_count, Scalar>;

  /// The controllers as they are by default.
  Switch()
    requires DescribedRobot<R> && (std::default_initializable<Controllers> && ...)
      : Switch(SwitchOptions<articula::joint_count<R>>()) {}
  /// @copydoc Switch()
  explicit Switch(const SwitchOptions<articula::joint_count<R>>& options)
    requires DescribedRobot<R> && (std::default_initializable<Controllers> && ...)
      : Switch(options, Controllers()...) {}

  /// @param robot        whose joints these are
  /// @param options      names, fallbacks, how to begin
  /// @param controllers  ready for use
  /// @throws std::invalid_argument if there are too many or too few names, or a name twice, empty
  ///         or unknown
  /// @throws std::invalid_argument if a controller is its own fallback, or a slew (of which joint)
  ///         or time is no number > 0
  Switch(const R& robot, const SwitchOptions<articula::joint_count<R>>& options,
         Controllers... controllers)
      : Selector(robot, options, std::move(controllers)...),
        transfer_(robot, options.slew.value_or(Transfer::default_slew(robot))) {}
  /// For a robot known at compile time.
  explicit Switch(const SwitchOptions<articula::joint_count<R>>& options,
                  Controllers... controllers)
    requires DescribedRobot<R>
      : Switch(R(), options, std::move(controllers)...) {}

  /// Starts the controller that is active, or was requested. If a command was applied, the next one
  /// goes on from it. Real-time: yes, if the controllers' are.
  void start(const Input& in) noexcept {
    Input inner{in.state, in.reference, in.period, in.applied};
    const bool changes = this->planned() != this->active_index();
    // The load of another controller may have been a push for this one.
    if (changes) inner.applied.held = std::min(inner.applied.held, Held::push);
    this->activate(this->planned());
    transfer_.start();
    begun_ = in.applied.reached_drives();
    own_counts_ = false;
    if (in.applied.held != Held::nothing) transfer_.set_applied(in.applied.numbers);
    if (begun_) transfer_.take_over();
    start_one(this->active_index(), inner);
  }

  /// The active controller's command, continued from the last one.
  /// Real-time: yes, if the controllers' are.
  [[nodiscard]] Outcome<Command> update(const Input& in) noexcept {
    Input inner = inner_input(in);
    if (this->switches()) {
      this->activate(this->planned());
      inner.cut.setZero();
      inner.applied = {transfer_.applied(),
                       begun_ ? Held::push : std::min(in.applied.held, Held::unsure)};
      start_one(this->active_index(), inner);
      if (begun_) transfer_.take_over();
    }
    Outcome<Command> outcome = update_one(this->active_index(), inner);
    this->set_status(this->active_index(), outcome.verdict == Verdict::fine
                                               ? ControllerStatus::active
                                               : ControllerStatus::failed);
    if (outcome.verdict != Verdict::fine) fall_back(outcome, in);
    return passed(outcome, in);
  }

  /// Lets the active controller brake, if it can. Real-time: yes, if the controllers' are.
  [[nodiscard]] Outcome<Command> brake(const Input& in) noexcept
    requires detail::AnyBrakes<articula::joint_count<R>, Controllers...>
  {
    Outcome<Command> outcome;
    const Input inner = inner_input(in);
    this->visit(this->active_index(),
                [&](auto& controller) noexcept { outcome = brake_controller(controller, inner); });
    return passed(outcome, in);
  }

  /// How fast differences decay [unit of the command per s], N x 1. In a cycle a switch changes the
  /// command by this times the period at most. Real-time: yes.
  [[nodiscard]] const JointVector<joint_count>& slew() const noexcept { return transfer_.slew(); }
  /// The difference that is still carried over, N x 1. Real-time: yes.
  [[nodiscard]] const Vector& carried() const noexcept { return transfer_.carried(); }

 private:
  using Transfer = BumplessTransfer<R, Command>;

  void start_one(std::size_t index, const Input& in) noexcept {
    this->visit(index, [&](auto& controller) noexcept { start_controller(controller, in); });
  }

  [[nodiscard]] Outcome<Command> update_one(std::size_t index, const Input& in) noexcept {
    Outcome<Command> outcome;
    this->visit(index, [&](auto& controller) noexcept {
      outcome = update_controller(controller, in);
      if (!Transfer::passable(outcome.command, in.state)) outcome.verdict = Verdict::failed;
    });
    return outcome;
  }

  /// The active controller's input. The next command goes on from what was applied in the end; in
  /// calls without a loop, from the last command.
  [[nodiscard]] Input inner_input(const Input& in) noexcept {
    if (in.applied.held != Held::nothing) transfer_.set_applied(in.applied.numbers);
    Input inner{in.state, in.reference, in.period, in.applied};
    if (own_counts_) inner.cut = clip_ + in.cut;
    return inner;
  }

  /// Puts the outcome of the first fallback whose verdict is fine in place of another.
  void fall_back(Outcome<Command>& outcome, const Input& in) noexcept {
    if (this->active_index() == none) return;
    Input fresh{in.state, in.reference, in.period, in.applied};
    fresh.applied.held = std::min(in.applied.held, Held::unsure);
    for (const std::size_t fallback : this->fallbacks_of(this->active_index())) {
      start_one(fallback, fresh);
      const Outcome<Command> instead = update_one(fallback, fresh);
      if (instead.verdict == Verdict::fine) {
        outcome = instead;
        if (begun_) transfer_.take_over();
        return this->activate(fallback);
      }
      this->set_status(fallback, ControllerStatus::failed);
    }
  }

  /// The outcome with the transferred command.
  [[nodiscard]] Outcome<Command> passed(const Outcome<Command>& own, const Input& in) noexcept {
    begun_ = true;
    own_counts_ = own.verdict != Verdict::failed;
    if (!own_counts_) {
      transfer_.take_over();
      return {};
    }
    clip_ = transfer_.excess(own.command, in.state);
    return {transfer_.pass(own.command, in.state, in.period), own.verdict};
  }

  Transfer transfer_;
  Vector clip_ = Vector::Zero();  ///< of the active controller's last command, by the transfer
  bool own_counts_ = false;       ///< the last command was the active controller's
  bool begun_ = false;  ///< there was a command since the start, which the next one goes on from
};

}  // namespace articula
