// SPDX-License-Identifier: Apache-2.0
/// @file Several controllers, of which one is active.
#pragma once

#include "articula/control/laws/effort_law.hpp"
#include "articula/control/safety/safe_command.hpp"
#include "articula/control/safety/standby.hpp"
#include "articula/control/safety/tells_failure.hpp"
#include "articula/control/switching/bumpless_transfer.hpp"
#include "articula/control/switching/switch_board.hpp"
#include "articula/control/switching/switch_options.hpp"
#include "articula/core/controller.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace articula {

/// Several controllers for the same joints, of which one is active, or none:
///
///     template <class R>
///     using Controllers = Switch<R, Bypass<R>, PidPlusGravity<R>, ComputedTorque<R>>;
///     Loop<Q2dSim, Controllers> loop;
///     loop.controller().request({.start = {"computed_torque"}, .replace = true});
///
/// - A request takes effect in the next update; from another thread it comes by a SwitchExchange.
/// - A controller that becomes active is started anew. If it was asked for, its integrals are
///   primed with the last command (Primable). So is the active one by `prime`.
/// - The command goes on from the last one: a difference is carried over and decays at the slew
///   (see BumplessTransfer), so that a switch changes no joint's command by more than slew * period
///   in a cycle. It holds for switches during the decay, for start, stop and fallback alike.
/// - Without an active controller the command is that of Standby.
/// - An active controller has failed if its command is not finite, although state and reference
///   are, or if it says so (TellsFailure). The first of its fallbacks that does not fail takes
///   over, within the same cycle. If none does, the command is not finite, so that whoever runs the
///   Switch acts on it: Loop writes the safe command, Limited brakes. The controller stays active;
///   a command that is good again goes on from that safe command, or from the one that is `given`.
///   The command of a controller that is safe in failure (SafeInFailure) passes, and `failed`
///   tells.
///
/// One cycle asks one controller, with the fallbacks after a failure as many more. All commands
/// are within what the robot's description allows, as SumController's are.
/// @tparam R            the robot
/// @tparam Controllers  one or more, all with the same type of command
template <Robot R, Controller<joint_count<R>>... Controllers>
class Switch {
 public:
  /// A finite command counts even where `failed` tells: it is a safe one.
  static constexpr bool safe_in_failure = true;
  /// Where the active controller brakes without a reference, it does; any other is not asked then.
  static constexpr bool brakes_without_reference = (BrakesWithoutReference<Controllers> || ...);
  static constexpr int joint_count = articula::joint_count<R>;
  static constexpr std::size_t controller_count = sizeof...(Controllers);
  using State = JointState<joint_count>;
  using Reference = JointReference<joint_count>;
  using Vector = JointVector<joint_count>;
  template <class C>
  using CommandOf = decltype(std::declval<C&>().update(std::declval<const State&>(),
                                                       std::declval<const Reference&>(), double()));
  using Command = CommandOf<std::tuple_element_t<0, std::tuple<Controllers...>>>;
  static_assert((std::same_as<CommandOf<Controllers>, Command> && ...),
                "the controllers of a Switch have the same type of command");

  /// The controllers as they are by default.
  explicit Switch(const SwitchOptions<joint_count>& options = {})
    requires DescribedRobot<R> && (std::default_initializable<Controllers> && ...)
      : Switch(options, Controllers()...) {}

  /// @param robot        whose joints these are
  /// @param options      names, fallbacks, how to begin
  /// @param controllers  ready for use
  /// @throws std::invalid_argument if there are too many or too few names, a name twice, empty or
  ///         unknown, a controller its own fallback, a slew (of which joint) or time no number > 0
  Switch(const R& robot, const SwitchOptions<joint_count>& options, Controllers... controllers)
      : controllers_(std::move(controllers)...),
        robot_(robot),
        transfer_(robot, options.slew.value_or(Transfer::default_slew(robot))),
        standby_(robot, options.damping_time) {
    std::size_t place = 0;
    board_.set_names(options.names, {detail::own_name<Controllers>(place++)...});
    for (const Fallback& fallback : options.fallbacks) {
      std::vector<std::size_t>& own = fallbacks_[board_.known(fallback.controller)];
      for (const Name& name : fallback.instead) {
        if (name == fallback.controller) board_.refuse("it is its own fallback: ", name);
        own.push_back(board_.known(name));
      }
    }
    const Name first = options.active.value_or(board_.entries[0].name);
    if (!first.empty()) board_.entries[board_.known(first)].active = true;
    set_active(board_.active_at(0));
  }
  /// For a robot known at compile time.
  explicit Switch(const SwitchOptions<joint_count>& options, Controllers... controllers)
    requires DescribedRobot<R>
      : Switch(R(), options, std::move(controllers)...) {}

  /// Begins anew with the controller that is active, or was asked for. Real-time: yes.
  void start(const State& state) noexcept {
    takes_over_ = active_ != board_.active_at(0);
    set_active(board_.active_at(0));
    visit(active_, [&](auto& controller) noexcept { controller.start(state); });
    transfer_.start();
    begun_ = false;
  }

  /// Goes on from a command that was given by others: the active controller's integrals begin with
  /// it, and what they do not take is carried over and decays. After `start`. Real-time: yes.
  /// @param state      measured joints
  /// @param reference  what they shall do
  /// @param period     time until the next update [s]
  /// @param command    given last, N x 1; one that is not finite is not gone on from
  /// @return           what is gone on from, N x 1
  Vector prime(const State& state, const Reference& reference, double period, const Vector& command,
               LastCommand is = LastCommand::any) noexcept {
    if (!is_finite(command)) return Vector::Zero();
    transfer_.set_given(command);
    begun_ = true;
    if (active_ == none) start_controller(none, state);
    transfer_.take_over();
    prime_active(state, reference, period, takes_over_ ? LastCommand::any : is);
    return transfer_.given();
  }

  /// The active controller's command, continued from the last one.
  /// Real-time: yes, if the controllers' are.
  [[nodiscard]] Command update(const State& state, const Reference& reference,
                               double period) noexcept {
    const std::size_t planned = board_.active_at(0);
    const bool switches = planned != active_ || (planned != none && board_.entries[planned].anew);
    const bool has_reference = is_finite(reference);
    if (switches && is_finite(state) && has_reference) {  // nothing can start from what is none
      set_active(planned);
      start_controller(planned, state);
      if (begun_) {
        transfer_.take_over();
        prime_active(state, reference, period, LastCommand::any);
      }
    }
    Answer answer = ask(active_, state, reference, period);
    if (answer.failed && is_finite(state) && has_reference) {
      fall_back(answer, state, reference, period);
    }
    begun_ = true;
    if (!answer.counts) return no_answer(state);
    if (active_ != none && !answer.failed) statuses_[active_] = ControllerStatus::active;
    const Vector excess = transfer_.excess(answer.command, state);
    if ((excess.array() != 0).any()) tell_active(excess);
    return last_ = transfer_.pass(answer.command, state, period);
  }

  /// Whether the active controller has failed in the last update, and no fallback took over.
  /// Real-time: yes.
  [[nodiscard]] bool failed() const noexcept {
    return active_ != none && statuses_[active_] == ControllerStatus::failed;
  }

  /// Asks for controllers to start and stop with the next update. In the thread of the update.
  /// Real-time: yes.
  SwitchOutcome request(const SwitchRequest& request) noexcept { return board_.plan(request); }

  /// The name of a controller, by its place in the list. Real-time: yes.
  [[nodiscard]] const Name& name_of(std::size_t controller) const noexcept {
    return board_.entries[controller].name;
  }
  /// What a controller is doing. Real-time: yes.
  [[nodiscard]] ControllerStatus status_of(std::size_t controller) const noexcept {
    return statuses_[controller];
  }
  /// The name of the active controller; empty if there is none. Real-time: yes.
  [[nodiscard]] Name active() const noexcept { return active_ == none ? Name() : name_of(active_); }
  /// All controllers and what they are doing. Real-time: yes.
  [[nodiscard]] std::array<ControllerInfo, controller_count> list() const noexcept {
    std::array<ControllerInfo, controller_count> all;
    for (std::size_t i = 0; i < controller_count; ++i) all[i] = {name_of(i), status_of(i)};
    return all;
  }
  /// How fast differences decay [unit of the command per s], N x 1: a switch changes the command by
  /// this times the period in a cycle at most. Real-time: yes.
  [[nodiscard]] const Vector& slew() const noexcept { return transfer_.slew(); }
  /// The difference that is still carried over, N x 1. Real-time: yes.
  [[nodiscard]] const Vector& carried() const noexcept { return transfer_.carried(); }

  /// Calls function(controller) for each of the controllers.
  void for_each_part(auto&& function) const {
    std::apply([&](const auto&... controller) { (function(controller), ...); }, controllers_);
  }

  /// One of the controllers, by its place in the list or its type.
  template <std::size_t I>
  [[nodiscard]] auto& member() noexcept {
    return std::get<I>(controllers_);
  }
  template <class C>
  [[nodiscard]] C& member() noexcept {
    return std::get<C>(controllers_);
  }
  template <class C>
  [[nodiscard]] const C& member() const noexcept {
    return std::get<C>(controllers_);
  }

  /// Tells the active controller what was cut off from the command afterwards. Real-time: yes.
  void limited(const Vector& excess) noexcept {
    transfer_.limited(excess);
    tell_active(excess);
  }

  /// Hears what was given in the end, which the next switch, or command after a failure, goes on
  /// from: N x 1, see numbers_of. After `limited`. Before the first update the active controller
  /// hears it, too. Real-time: yes.
  void given(const Vector& command) noexcept {
    transfer_.set_given(command);
    if (begun_) return;  // what is carried over is not the controller's own
    visit(active_, [&](auto& controller) noexcept {
      if constexpr (TakesGiven<decltype(controller), joint_count>) controller.given(command);
    });
  }

  /// Says at compile time that several controllers take such gains. (As it may throw, it is not
  /// what TakesGains asks for.)
  template <class Gains>
    requires(((TakesGains<Controllers, Gains> ? 1 : 0) + ...) > 1)
  void set_gains(const Gains&) {
    static_assert(
        sizeof(Gains) == 0,
        "several controllers take such gains: write member<C>().set_gains(gains) for the one "
        "that is meant");
  }

  /// Goes on with other gains of the one controller that takes them. Where several do, whose gains
  /// they are must be said: `member<C>().set_gains(gains)`. Real-time: yes.
  template <class Gains>
    requires(((TakesGains<Controllers, Gains> ? 1 : 0) + ...) == 1)
  void set_gains(const Gains& gains) noexcept {
    for_each([&](auto& controller) noexcept {
      if constexpr (TakesGains<decltype(controller), Gains>) controller.set_gains(gains);
    });
  }

  /// Who shall be active: for a composition of switches, such as Groups. Real-time: yes.
  [[nodiscard]] SwitchBoard<controller_count>& board() noexcept { return board_; }
  [[nodiscard]] const SwitchBoard<controller_count>& board() const noexcept { return board_; }

 private:
  using Transfer = BumplessTransfer<R, Command>;
  static constexpr std::size_t none = controller_count;

  /// Calls `function` with one of the controllers, or with the standby in place of none.
  void visit(std::size_t index, auto function) noexcept {
    if (index == none) return function(standby_);
    std::size_t i = 0;
    for_each([&](auto& controller) noexcept {
      if (i++ == index) function(controller);
    });
  }

  void for_each(auto function) noexcept {
    [&]<std::size_t... I>(std::index_sequence<I...>) noexcept {
      (function(std::get<I>(controllers_)), ...);
    }(std::index_sequence_for<Controllers...>());
  }

  void set_active(std::size_t index) noexcept {
    if (active_ != none && statuses_[active_] == ControllerStatus::active) {
      statuses_[active_] = ControllerStatus::inactive;
    }
    active_ = index;
    for (std::size_t i = 0; i < controller_count; ++i) {
      board_.entries[i].active = i == index;
      board_.entries[i].anew = false;
    }
    if (index != none) statuses_[index] = ControllerStatus::active;
  }

  void start_controller(std::size_t index, State state) noexcept {
    // What is held is what was commanded: a measured position would creep.
    if constexpr (std::same_as<Command, PositionCommand<joint_count>>) {
      if (index == none && begun_) state.position = transfer_.given();
    }
    visit(index, [&](auto& controller) noexcept { controller.start(state); });
  }

  void prime_active(const State& state, const Reference& reference, double period,
                    LastCommand is) noexcept {
    visit(active_, [&](auto& controller) noexcept {
      if constexpr (Primable<decltype(controller), joint_count>) {
        detail::prime(controller, state, reference, period, transfer_.given(), is);
      }
    });
  }

  /// What a controller said.
  struct Answer {
    Command command{};
    bool failed = false;  ///< it cannot control
    bool counts = false;  ///< the command can be passed on
  };

  [[nodiscard]] Answer ask(std::size_t index, const State& state, const Reference& reference,
                           double period) noexcept {
    Answer answer;
    visit(index, [&](auto& controller) noexcept {
      if (!BrakesWithoutReference<std::remove_cvref_t<decltype(controller)>> &&
          !is_finite(reference)) {
        return;
      }
      answer.command = controller.update(state, reference, period);
      const bool passable = Transfer::passable(answer.command, state);
      answer.failed = !passable || has_failed(controller);
      answer.counts = passable && command_counts(controller);
    });
    return answer;
  }

  /// Puts the answer of the first fallback that does not fail in place of a failed one.
  void fall_back(Answer& answer, const State& state, const Reference& reference,
                 double period) noexcept {
    if (active_ == none) return;
    statuses_[active_] = ControllerStatus::failed;
    for (const std::size_t fallback : fallbacks_[active_]) {
      start_controller(fallback, state);
      const Answer instead = ask(fallback, state, reference, period);
      if (!instead.failed) {
        answer = instead;
        if (begun_) transfer_.take_over();
        return set_active(fallback);
      }
      statuses_[fallback] = ControllerStatus::failed;
    }
  }

  /// No command: what follows goes on from the safe one that is written in its place.
  [[nodiscard]] Command no_answer(const State& state) noexcept {
    last_ = safe_command(robot_, state.position, last_);
    transfer_.set_given(numbers_of(last_, state));
    transfer_.take_over();
    return no_command<Command>();
  }

  void tell_active(const Vector& excess) noexcept {
    visit(active_, [&](auto& controller) noexcept {
      if constexpr (LimitAware<decltype(controller), joint_count>) controller.limited(excess);
    });
  }

  std::tuple<Controllers...> controllers_;
  [[no_unique_address]] R robot_;
  Transfer transfer_;
  Standby<R, Command> standby_;
  SwitchBoard<controller_count> board_{};
  std::array<std::vector<std::size_t>, controller_count> fallbacks_{};
  std::array<ControllerStatus, controller_count> statuses_{};
  std::size_t active_ = none;
  bool takes_over_ = false;  ///< at the start another controller became active
  bool begun_ = false;  ///< there was a command since the start, which the next one goes on from
  Command last_{};
};

}  // namespace articula
