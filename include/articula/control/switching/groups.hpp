// SPDX-License-Identifier: Apache-2.0
/// @file Controllers for groups of a robot's joints, each at its own rate.
#pragma once

#include "articula/command/command_numbers.hpp"
#include "articula/control/composition/controller_tuple.hpp"
#include "articula/control/composition/part_scope.hpp"
#include "articula/control/safety/damping_effort.hpp"
#include "articula/control/safety/safe_command.hpp"
#include "articula/control/switching/group_state.hpp"
#include "articula/control/switching/joint_group.hpp"
#include "articula/control/switching/switch_board.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/scalar.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace articula {

/// Controllers for groups of a robot's joints, each at its own rate. Use them where an arm and a
/// gripper, or two arms, are controlled in different ways at the same time. Together they are one
/// controller:
///
///     template <class R>
///     using Parts = Groups<R, Switch<R, PidPlusGravity<R>, ComputedTorque<R>>, JointImpedance<R>>;
///     Parts<GripperArm> parts({{{"arm", {"joint_1", ...}}, {"gripper", {"left_knuckle"}, 10}}},
///                             arm_controllers, gripper_controller);
///
/// - Every joint belongs to one group.
/// - A group's controller is one for all joints of the robot; of its command only the numbers of
///   the group's joints are used. It gets the whole state. Its reference keeps the other joints at
///   their measured position and velocity, without acceleration and effort.
/// - The controller of a group with the divisor k is called in the first cycle and every k-th from
///   then on. Its period is k dt. In between its command is held.
/// - If a group's controller fails, its joints, and no others, get the safe command (see
///   safe_command). Efforts brake them as those of Standby do. The controller is called again in
///   the next cycle, with the time since the last call. The verdict on all is `degraded`.
/// - Controllers in a Switch, or a Limited one, have the group's name and theirs, "arm/pid".
///   A strict request may be about several groups.
///
/// For laws that differ from joint to joint OnJoints is enough.
/// @tparam R            the robot
/// @tparam Controllers  one per group, which satisfy Controller and have the same type of command;
///                      of packs, the first has a type `Scalar`
template <Robot R, class... Controllers>
class Groups : public ControllerTuple<Controllers...> {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  static constexpr std::size_t group_count = sizeof...(Controllers);
  /// How many controllers can be switched.
  static constexpr std::size_t controller_count =
      (detail::switch_size<Controllers> + ... + std::size_t{0});
  using Scalar = detail::ScalarOfAll<Controllers...>;
  using Input = ControlInput<joint_count, Scalar>;
  using Command = detail::CommandOfAll<articula::joint_count<R>, Controllers...>;

  /// @param robot        whose joints these are
  /// @param groups       of the joints
  /// @param controllers  one per group, in the same order
  /// @throws std::invalid_argument naming a joint in two groups, in none or not in the robot
  /// @throws std::invalid_argument naming a divisor below 1, or a name that is empty or used twice
  Groups(const R& robot, const std::array<JointGroup, group_count>& groups,
         Controllers... controllers)
      : ControllerTuple<Controllers...>(std::move(controllers)...), robot_(robot) {
    const JointArray<std::size_t, joint_count> owners = group_of_each_joint(robot, groups);
    for (std::size_t g = 0; g < group_count; ++g) {
      groups_[g].divisor = groups_[g].since = groups[g].divisor;
      for (int j = 0; j < joint_count; ++j) {
        groups_[g].joints[j] = owners[j] == g ? 1 : 0;
      }
    }
    std::size_t entry = 0;
    for_each_switch(*this, [&](const auto& own, std::size_t g) noexcept {
      for (const ControllerInfo& info : own.list()) {
        board_.entries[entry].name = info.name;
        board_.entries[entry++].group = static_cast<int>(g);
      }
    });
    for (auto& of : board_.entries) {
      const std::string group(groups[static_cast<std::size_t>(of.group)].name.view());
      of.name = std::string_view(group + "/" + std::string(of.name.view()));
    }
    board_.validate();
  }
  /// For a robot known at compile time.
  explicit Groups(const std::array<JointGroup, group_count>& groups, Controllers... controllers)
    requires DescribedRobot<R>
      : Groups(R(), groups, std::move(controllers)...) {}

  /// Starts all controllers. Real-time: yes, if the controllers' are.
  void start(const Input& in) noexcept {
    this->for_each([&](auto& controller, std::size_t g) noexcept {
      Group& group = groups_[g];
      group.start();
      const Reference own = group.reference(in);
      start_controller(controller, Input{in.state, own, group.divisor * in.period, in.applied});
    });
  }

  /// The command of all groups for the coming period. Real-time: yes, if the controllers' are.
  [[nodiscard]] Outcome<Command> update(const Input& in) noexcept { return cycle<true>(in); }

  /// Brakes the groups whose reference is not finite; the others go on. A group that cannot brake
  /// gets its safe command. Real-time: yes, if the controllers' are.
  [[nodiscard]] Outcome<Command> brake(const Input& in) noexcept
    requires detail::AnyBrakes<articula::joint_count<R>, Controllers...>
  {
    return cycle<false>(in);
  }

  /// Whether a group is active or has failed, by its index in the list. Real-time: yes.
  [[nodiscard]] ControllerStatus status_of(std::size_t group) const noexcept {
    return groups_[group].status;
  }

  /// Requests that controllers start and stop at the next call of their group. In the thread of the
  /// update. Real-time: yes.
  SwitchOutcome request(const SwitchRequest& request) noexcept {
    std::size_t entry = 0;
    for_each_switch(*this, [&](const auto& own, std::size_t) noexcept {
      for (const auto& of : own.board().entries) {
        board_.entries[entry].active = of.active;
        board_.entries[entry++].restart = of.restart;
      }
    });
    const SwitchOutcome outcome = board_.plan(request);
    entry = 0;
    for_each_switch(*this, [&](auto& own, std::size_t) noexcept {
      for (auto& of : own.board().entries) {
        of.active = board_.entries[entry].active;
        of.restart = board_.entries[entry++].restart;
      }
    });
    return outcome;
  }

  /// All controllers that can be switched, and what they are doing. Real-time: yes.
  [[nodiscard]] std::array<ControllerInfo, controller_count> list() const noexcept {
    std::array<ControllerInfo, controller_count> all;
    std::size_t entry = 0;
    for_each_switch(*this, [&](const auto& own, std::size_t) noexcept {
      for (const ControllerInfo& info : own.list()) {
        all[entry] = {board_.entries[entry].name, info.status};
        ++entry;
      }
    });
    return all;
  }

  /// The joints and the rate of a group; see HasParts. Real-time: yes.
  [[nodiscard]] PartScope<joint_count> part_scope(std::size_t group) const noexcept {
    return {.joints = groups_[group].joints, .divisor = groups_[group].divisor};
  }

 private:
  using Vector = JointVector<joint_count, Scalar>;
  using Reference = JointReference<joint_count, Scalar>;
  using Group = detail::GroupState<joint_count, Scalar>;

  /// @tparam has_reference  whether the reference of all joints is finite
  template <bool has_reference>
  [[nodiscard]] Outcome<Command> cycle(const Input& in) noexcept {
    this->for_each([&](auto& controller, std::size_t g) noexcept {
      Group& group = groups_[g];
      if (group.passes_cut) group.cut = group.select(in.cut);
      group.passes_cut = false;
      if (group.due || group.since >= group.divisor) {
        const Reference own = group.reference(in);
        const Input inner{in.state, own, group.since * in.period, in.applied, group.cut};
        const bool updates = has_reference || all_of(is_finite(own));
        const Outcome<Command> outcome =
            updates ? updated(controller, group, inner) : brake_controller(controller, inner);
        group.cut.setZero();
        group.passes_cut = outcome.verdict != Verdict::failed;
        if (updates) {
          group.status = outcome.verdict == Verdict::fine ? ControllerStatus::active
                                                          : ControllerStatus::failed;
        } else if (!group.passes_cut && group.braked_cycles <= detail::borne_cycles) {
          ++group.braked_cycles;
        }
        command_ = group.merged(group.passes_cut ? outcome.command : safe(group, in), command_);
        group.since = 0;
        group.due = outcome.verdict != Verdict::fine;
      }
      ++group.since;
    });
    const bool failed = std::any_of(groups_.begin(), groups_.end(), [](const Group& group) {
      return group.status == ControllerStatus::failed;
    });
    return {command_, failed ? Verdict::degraded : Verdict::fine};
  }

  /// A group's own outcome. After too many cycles without a call its controller is started again.
  template <class C>
  [[nodiscard]] Outcome<Command> updated(C& controller, Group& group, Input in) noexcept {
    if (group.braked_cycles > detail::borne_cycles) {
      in.applied = {numbers_of(command_, in.state), Held::load};
      start_controller(controller, in);
    }
    group.braked_cycles = 0;
    return update_controller(controller, in);
  }

  /// The safe command for a group that has failed. Other groups go on moving, so it is not enough
  /// to carry the weight. The motion of its own joints, and no others', decays as in Standby.
  [[nodiscard]] Command safe(const Group& group, const Input& in) const noexcept {
    Command command = safe_command(robot_, in.state.position, command_);
    if constexpr (std::same_as<Command, EffortCommand<joint_count, Scalar>>) {
      const double time = std::max(damping_time, 2 * in.period);
      const Vector effort =
          damping_effort(robot_, in.state.position, group.select(in.state.velocity), time);
      const MaskOf<Scalar> damps = is_finite(effort);
      for (int j = 0; j < joint_count; ++j) replace_where(damps, command.effort[j], effort[j]);
      command = within_effort_limits(robot_, command);
    }
    return command;
  }

  /// Calls function(switch, index) for every group that has one.
  static void for_each_switch(auto& groups, auto function) noexcept {
    groups.for_each([&](auto& controller, std::size_t g) noexcept {
      using C = std::remove_cvref_t<decltype(controller)>;
      if constexpr (detail::switch_size<C> != 0) function(switch_in(controller), g);
    });
  }

  static constexpr double damping_time = 0.1;  ///< that of Standby [s]

  [[no_unique_address]] R robot_;
  std::array<Group, group_count> groups_{};
  SwitchBoard<controller_count> board_{};
  Command command_{};
};

}  // namespace articula
