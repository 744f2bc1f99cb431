// SPDX-License-Identifier: Apache-2.0
/// @file Controllers for groups of a robot's joints, each at its own rate.
#pragma once

#include "articula/control/laws/command_numbers.hpp"
#include "articula/control/laws/effort_law.hpp"
#include "articula/control/laws/part_scope.hpp"
#include "articula/control/safety/damping_effort.hpp"
#include "articula/control/safety/resume.hpp"
#include "articula/control/safety/safe_command.hpp"
#include "articula/control/safety/tells_failure.hpp"
#include "articula/control/switching/joint_group.hpp"
#include "articula/control/switching/switch_board.hpp"
#include "articula/core/controller.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/name.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace articula {

/// Controllers for groups of a robot's joints, each at its own rate. Together they are one
/// controller:
///
///     template <class R>
///     using Parts = Groups<R, Switch<R, PidPlusGravity<R>, ComputedTorque<R>>, JointImpedance<R>>;
///     Parts<GripperArm> parts({{{"arm", {"joint_1", ...}}, {"gripper", {"left_knuckle"}, 10}}},
///                             arm_controllers, gripper_controller);
///
/// - Every joint belongs to one group.
/// - A group's controller is one for all joints of the robot; what counts of its command is what it
///   says for its own. It sees the whole state, and a reference that asks nothing of the other
///   joints: their position and velocity as measured, no acceleration, no effort.
/// - The controller of a group with the divisor k is asked in the first cycle and every k-th from
///   then on, with the period k dt. In between its command is held.
/// - A group has failed if its command is not finite although state and reference are, or if its
///   controller says so (TellsFailure). Its joints, and no others, get the safe command (see
///   safe_command), or the controller's own if that is safe. Efforts brake them as those of Standby
///   do. `failed` and `status_of` tell; Loop reports it. The controller is asked again in the next
///   cycle, with the time since the last one.
/// - Controllers in a Switch, or a Limited one, go by the group's name and theirs, "arm/pid".
///   A strict request may be about several groups.
/// @tparam R            the robot
/// @tparam Controllers  one per group, all with the same type of command
template <Robot R, Controller<joint_count<R>>... Controllers>
class Groups {
 public:
  /// The command counts even where `failed` tells: a group's failure is no other's.
  static constexpr bool safe_in_failure = true;
  /// Where a group's controller brakes without a reference, it does. Then a group whose controller
  /// does not gets its safe command where its own reference is not finite.
  static constexpr bool brakes_without_reference = (BrakesWithoutReference<Controllers> || ...);
  static constexpr int joint_count = articula::joint_count<R>;
  static constexpr std::size_t group_count = sizeof...(Controllers);
  /// How many controllers can be switched.
  static constexpr std::size_t controller_count =
      (detail::switch_size<Controllers> + ... + std::size_t{0});
  using State = JointState<joint_count>;
  using Reference = JointReference<joint_count>;
  using Vector = JointVector<joint_count>;
  template <class C>
  using CommandOf = decltype(std::declval<C&>().update(std::declval<const State&>(),
                                                       std::declval<const Reference&>(), double()));
  using Command = CommandOf<std::tuple_element_t<0, std::tuple<Controllers...>>>;
  static_assert((std::same_as<CommandOf<Controllers>, Command> && ...),
                "the controllers of Groups have the same type of command");

  /// @param robot        whose joints these are
  /// @param groups       of the joints
  /// @param controllers  one per group, in the same order
  /// @throws std::invalid_argument naming the joint that the robot does not have, that is in two
  ///         groups or in none, the divisor below 1, the name that is empty or there twice
  Groups(const R& robot, const std::array<JointGroup, group_count>& groups,
         Controllers... controllers)
      : controllers_(std::move(controllers)...), robot_(robot) {
    const std::array<std::size_t, static_cast<std::size_t>(joint_count)> owners =
        group_of_each_joint(robot, groups);
    for (std::size_t g = 0; g < group_count; ++g) {
      parts_[g].divisor = parts_[g].since = groups[g].divisor;
      for (int j = 0; j < joint_count; ++j) {
        parts_[g].chosen[j] = owners[static_cast<std::size_t>(j)] == g ? 1 : 0;
      }
    }
    std::size_t entry = 0;
    for_each_switch([&](const auto& own, std::size_t g) noexcept {
      for (const ControllerInfo& info : own.list()) {
        board_.entries[entry].name = info.name;
        board_.entries[entry++].place = static_cast<int>(g);
      }
    });
    for (auto& of : board_.entries) {
      const std::string group(groups[static_cast<std::size_t>(of.place)].name.view());
      of.name = std::string_view(group + "/" + std::string(of.name.view()));
    }
    board_.validate();
  }
  /// For a robot known at compile time.
  explicit Groups(const std::array<JointGroup, group_count>& groups, Controllers... controllers)
    requires DescribedRobot<R>
      : Groups(R(), groups, std::move(controllers)...) {}

  /// Starts all controllers anew. Real-time: yes.
  void start(const State& state) noexcept {
    for (Part& part : parts_) {
      part.wait = 0;
      part.since = part.divisor;
      part.unasked = 0;
      part.status = ControllerStatus::active;
    }
    for_each([&](auto& controller, std::size_t) noexcept { controller.start(state); });
  }

  /// The command of all groups for the coming period.
  /// Real-time: yes, if the controllers' are.
  [[nodiscard]] Command update(const State& state, const Reference& reference,
                               double period) noexcept {
    const bool usable = is_finite(state) && is_finite(reference);
    const bool has_safe = usable || (brakes_without_reference && is_finite(state));
    bool complete = true;
    for_each([&](auto& controller, std::size_t g) noexcept {
      Part& part = parts_[g];
      part.updated = part.wait == 0;
      if (part.updated) {
        const Command own = ask(controller, part, state, of_group(part, state, reference), period);
        part.since = 0;
        Command next = merged(own, part);
        const bool counts = is_finite(next) && command_counts(controller);
        const bool well = counts && !has_failed(controller);
        if (usable) part.status = well ? ControllerStatus::active : ControllerStatus::failed;
        if (!counts) next = merged(safe(part, state, period), part);
        if (counts || has_safe) command_ = next;
        if constexpr (TakesGiven<decltype(controller), joint_count>) {
          if (!counts && has_safe) controller.given(numbers_of(command_, state));
        }
        complete = complete && (counts || has_safe);
        if (well) part.wait = part.divisor;
      }
      ++part.since;
      if (part.wait > 0) --part.wait;
    });
    return complete ? command_ : no_command<Command>();
  }

  /// Whether a group has failed when it was asked last. Real-time: yes.
  [[nodiscard]] bool failed() const noexcept {
    return std::any_of(parts_.begin(), parts_.end(),
                       [](const Part& p) { return p.status == ControllerStatus::failed; });
  }
  /// Whether a group is active or has failed, by its place in the list. Real-time: yes.
  [[nodiscard]] ControllerStatus status_of(std::size_t group) const noexcept {
    return parts_[group].status;
  }

  /// Lets the groups' controllers begin with what was given last, those that can. After `start`.
  /// Real-time: yes.
  /// @return  what they begin with of it, N x 1
  Vector prime(const State& state, const Reference& reference, double period, const Vector& command,
               LastCommand is = LastCommand::any) noexcept
    requires(Primable<Controllers, joint_count> || ...)
  {
    Vector share = Vector::Zero();
    for_each([&](auto& controller, std::size_t g) noexcept {
      if constexpr (Primable<decltype(controller), joint_count>) {
        const Part& part = parts_[g];
        // What the others are given counts, too: by the model it moves this group's joints.
        share +=
            chosen(part, detail::prime(controller, state, of_group(part, state, reference),
                                       static_cast<double>(part.divisor) * period, command, is));
      }
    });
    return share;
  }

  /// Tells the controllers that were asked in this cycle what was cut off. Real-time: yes.
  void limited(const Vector& excess) noexcept {
    for_each([&](auto& controller, std::size_t g) noexcept {
      if constexpr (LimitAware<decltype(controller), joint_count>) {
        const Part& part = parts_[g];
        const bool own = part.updated && part.status != ControllerStatus::failed;
        if (own) controller.limited(chosen(part, excess));
      }
    });
  }

  /// Tells the controllers that want to know what was given in the end. Real-time: yes.
  void given(const Vector& command) noexcept {
    for_each([&](auto& controller, std::size_t) noexcept {
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
        "several controllers take such gains: write member<I>().set_gains(gains) for the one "
        "that is meant");
  }

  /// Goes on with other gains of the one group that takes them. Where several do, whose gains they
  /// are must be said: `member<I>().set_gains(gains)`. Real-time: yes.
  template <class Gains>
    requires(((TakesGains<Controllers, Gains> ? 1 : 0) + ...) == 1)
  void set_gains(const Gains& gains) noexcept {
    for_each([&](auto& controller, std::size_t) noexcept {
      if constexpr (TakesGains<decltype(controller), Gains>) controller.set_gains(gains);
    });
  }

  /// Asks for controllers to start and stop when their group is asked next. In the thread of the
  /// update. Real-time: yes.
  SwitchOutcome request(const SwitchRequest& request) noexcept {
    std::size_t entry = 0;
    for_each_switch([&](const auto& own, std::size_t) noexcept {
      for (const auto& of : own.board().entries) {
        board_.entries[entry].active = of.active;
        board_.entries[entry++].anew = of.anew;
      }
    });
    const SwitchOutcome outcome = board_.plan(request);
    entry = 0;
    for_each_switch([&](auto& own, std::size_t) noexcept {
      for (auto& of : own.board().entries) {
        of.active = board_.entries[entry].active;
        of.anew = board_.entries[entry++].anew;
      }
    });
    return outcome;
  }

  /// All controllers that can be switched, and what they are doing. Real-time: yes.
  [[nodiscard]] std::array<ControllerInfo, controller_count> list() const noexcept {
    std::array<ControllerInfo, controller_count> all;
    std::size_t entry = 0;
    for_each_switch([&](const auto& own, std::size_t) noexcept {
      for (const ControllerInfo& info : own.list()) {
        all[entry] = {board_.entries[entry].name, info.status};
        ++entry;
      }
    });
    return all;
  }

  /// Calls function(controller, scope) for each of the controllers.
  void for_each_part(auto&& function) const {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      const auto scope = [](const Part& part) {
        return PartScope<joint_count>{.joints = part.chosen, .divisor = part.divisor};
      };
      (function(std::get<I>(controllers_), scope(parts_[I])), ...);
    }(std::index_sequence_for<Controllers...>());
  }

  /// The controller of a group, by the group's place in the list.
  template <std::size_t I>
  [[nodiscard]] auto& member() noexcept {
    return std::get<I>(controllers_);
  }

 private:
  struct Part {
    Vector chosen = Vector::Zero();  ///< 1 for the group's joints
    int divisor = 1;
    int wait = 0;          ///< cycles until it is asked again
    int since = 1;         ///< cycles since it was asked
    int unasked = 0;       ///< times in a row that there was no reference to ask it about
    bool updated = false;  ///< it was asked in the last cycle
    ControllerStatus status = ControllerStatus::active;
  };

  [[nodiscard]] static Vector chosen(const Part& part, const Vector& values,
                                     const Vector& others = Vector::Zero()) noexcept {
    return (part.chosen.array() != 0).select(values, others);
  }

  [[nodiscard]] static Reference of_group(const Part& part, const State& state,
                                          const Reference& reference) noexcept {
    return {chosen(part, reference.position, state.position),
            chosen(part, reference.velocity, state.velocity), chosen(part, reference.acceleration),
            chosen(part, reference.effort)};
  }

  /// A group's own command. Without a reference a controller that cannot brake is not asked.
  template <class C>
  [[nodiscard]] Command ask(C& controller, Part& part, const State& state,
                            const Reference& reference, double period) noexcept {
    const double since = static_cast<double>(part.since) * period;
    if (!BrakesWithoutReference<C> && !is_finite(reference)) {
      if (part.unasked <= detail::borne_cycles) ++part.unasked;
      return no_command<Command>();
    }
    if (part.unasked > detail::borne_cycles && is_finite(state)) {
      detail::resume(controller, state, reference, since, numbers_of(command_, state));
    }
    part.unasked = 0;
    return controller.update(state, reference, since);
  }

  /// What is given, which is finite, with a group's own part in it.
  [[nodiscard]] Command merged(const Command& own, const Part& part) const noexcept {
    Command all = command_;
    const auto take = [&](auto member) { all.*member = chosen(part, own.*member, all.*member); };
    if constexpr (requires { own.position; }) take(&Command::position);
    if constexpr (requires { own.velocity; }) take(&Command::velocity);
    if constexpr (requires { own.effort; }) take(&Command::effort);
    if constexpr (requires { own.stiffness; }) {
      take(&Command::stiffness);
      take(&Command::damping);
    }
    return all;
  }

  /// The safe command for a group that has failed. Others go on moving, so it is not enough to
  /// carry its weight: the motion of its own joints, and no others', decays as in Standby.
  [[nodiscard]] Command safe(const Part& part, const State& state, double period) const noexcept {
    Command command = safe_command(robot_, state.position, command_);
    if constexpr (std::same_as<Command, EffortCommand<joint_count>>) {
      const double time = is_finite(period) ? std::max(damping_time, 2 * period) : damping_time;
      const Vector effort =
          damping_effort(robot_, state.position, chosen(part, state.velocity), time);
      if (is_finite(effort)) command = articula::limited(robot_, Command{effort});
    }
    return command;
  }

  void for_each(auto function) noexcept {
    [&]<std::size_t... I>(std::index_sequence<I...>) noexcept {
      (function(std::get<I>(controllers_), I), ...);
    }(std::index_sequence_for<Controllers...>());
  }

  /// Calls function(switch, group) for every group that has one.
  void for_each_switch(auto function) noexcept { visit_switches(controllers_, function); }
  void for_each_switch(auto function) const noexcept { visit_switches(controllers_, function); }

  static void visit_switches(auto& controllers, auto& function) noexcept {
    const auto look = [&](auto& controller, std::size_t g) noexcept {
      using C = std::remove_cvref_t<decltype(controller)>;
      if constexpr (detail::switch_size < C >> 0) function(switch_in(controller), g);
    };
    [&]<std::size_t... I>(std::index_sequence<I...>) noexcept {
      (look(std::get<I>(controllers), I), ...);
    }(std::index_sequence_for<Controllers...>());
  }

  static constexpr double damping_time = 0.1;  ///< that of Standby [s]

  std::tuple<Controllers...> controllers_;
  [[no_unique_address]] R robot_;
  std::array<Part, group_count> parts_{};
  SwitchBoard<controller_count> board_{};
  Command command_{};
};

}  // namespace articula
