// SPDX-License-Identifier: Apache-2.0
/// @file A controller as the sum of its parts, held within the drives' limits.
#pragma once

#include "articula/control/laws/effort_law.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>

namespace articula {

namespace detail {

/// The lowest and highest values of each joint, N x 1.
template <int N>
struct CommandRange {
  JointVector<N> lowest, highest;
};

/// What a robot's joints can be asked for: efforts, velocities or positions.
template <class Command, Robot R>
[[nodiscard]] CommandRange<joint_count<R>> command_range(const R& robot) noexcept {
  constexpr int n = joint_count<R>;
  const auto limits = [&](double JointLimits::* limit) {
    return joint_values(robot, [&](const JointProperties& joint) { return joint.limits.*limit; });
  };
  if constexpr (std::same_as<Command, PositionCommand<n>>) {
    return {limits(&JointLimits::lower), limits(&JointLimits::upper)};
  } else {
    constexpr bool is_effort = requires(Command command) { command.effort; };
    const JointVector<n> highest =
        limits(is_effort ? &JointLimits::effort : &JointLimits::velocity);
    return {-highest, highest};
  }
}

}  // namespace detail

/// Adds up laws and limits the total: command = clamp(sum of parts), within what the joints of the
/// robot's description can do. Parts that remember are told what was cut off.
/// @tparam R     the robot
/// @tparam C     what is commanded: an EffortCommand, VelocityCommand or PositionCommand
/// @tparam Laws  the summands
template <Robot R, JointCommand<joint_count<R>> C, EffortLaw<joint_count<R>>... Laws>
class SumController {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Command = C;

  /// @param robot  whose limits hold
  /// @param laws   the parts, ready for use
  explicit SumController(const R& robot, Laws... laws)
      : range_(detail::command_range<C>(robot)), laws_(std::move(laws)...) {
    // A sum that overflows is limited to the largest number where the joint has no limit.
    constexpr double largest = std::numeric_limits<double>::max();
    range_.lowest = range_.lowest.cwiseMax(-largest);
    range_.highest = range_.highest.cwiseMin(largest);
  }

  /// Starts all parts anew. Real-time: yes.
  void start(const JointState<joint_count>& state) noexcept {
    for_each_law([&](auto& law) noexcept { law.start(state); });
  }

  /// The limited total for the coming period.
  /// @param state      measured joints
  /// @param reference  what they shall do
  /// @param period     time until the next update [s]
  /// Real-time: yes.
  [[nodiscard]] Command update(const JointState<joint_count>& state,
                               const JointReference<joint_count>& reference,
                               double period) noexcept {
    JointVector<joint_count> total = JointVector<joint_count>::Zero();
    for_each_law([&](auto& law) noexcept { total += law.effort(state, reference, period); });
    JointVector<joint_count> command;
    for (int j = 0; j < joint_count; ++j) {
      // A NaN stays one, for whoever looks for it, and does not turn into a limit. A sum that
      // overflows has a direction, as any that is too large.
      command[j] = std::clamp(total[j], range_.lowest[j], range_.highest[j]);
    }
    limited(total - command);
    return {command};
  }

  /// Lets the parts that can, such as a PID's integral, begin with what the last command holds
  /// beyond the other parts. After `start`. Real-time: yes.
  /// @param state      measured joints
  /// @param reference  what they shall do
  /// @param period     time until the next update [s]
  /// @param command    given last, N x 1
  /// @param is         what is known of it
  /// @return           what these parts begin with of it, N x 1
  JointVector<joint_count> prime(const JointState<joint_count>& state,
                                 const JointReference<joint_count>& reference, double period,
                                 const JointVector<joint_count>& command,
                                 LastCommand is = LastCommand::any) noexcept
    requires(Primable<Laws, joint_count> || ...)
  {
    JointVector<joint_count> rest = command;
    for_each_law([&](auto& law) noexcept {
      if constexpr (!Primable<decltype(law), joint_count>) {
        rest -= law.effort(state, reference, period);
        law.start(state);  // as if it had not been asked
      }
    });
    const JointVector<joint_count> left = rest;
    for_each_law([&](auto& law) noexcept {
      if constexpr (Primable<decltype(law), joint_count>) {
        rest -= detail::prime(law, state, reference, period, rest, is);
      }
    });
    return left - rest;
  }

  /// Tells the parts by how much the command was cut off: called by `update`, and by whoever limits
  /// the command further. Real-time: yes.
  /// @param excess  asked minus given, N x 1, in the unit of the command
  void limited(const JointVector<joint_count>& excess) noexcept {
    for_each_law([&](auto& law) noexcept {
      if constexpr (LimitAware<decltype(law), joint_count>) law.limited(excess);
    });
  }

  /// Goes on with other gains, in every part that takes them. Real-time: yes.
  template <class Gains>
    requires(TakesGains<Laws, Gains> || ...)
  void set_gains(const Gains& gains) noexcept {
    for_each_law([&](auto& law) noexcept {
      if constexpr (TakesGains<decltype(law), Gains>) law.set_gains(gains);
    });
  }

  /// Calls function(part) for each of the parts.
  void for_each_part(auto&& function) const {
    std::apply([&](const auto&... law) { (function(law), ...); }, laws_);
  }

  /// One of the parts, by its type.
  template <class Law>
  [[nodiscard]] const Law& part() const noexcept {
    return std::get<Law>(laws_);
  }

 private:
  void for_each_law(auto function) noexcept {
    [&]<std::size_t... I>(std::index_sequence<I...>) noexcept {
      (function(std::get<I>(laws_)), ...);
    }(std::index_sequence_for<Laws...>());
  }

  detail::CommandRange<joint_count> range_;
  std::tuple<Laws...> laws_;
};

/// A controller of efforts as the sum of its parts.
template <Robot R, class... Laws>
using EffortController = SumController<R, EffortCommand<joint_count<R>>, Laws...>;

/// A controller of velocity drives as the sum of its parts.
template <Robot R, class... Laws>
using VelocityController = SumController<R, VelocityCommand<joint_count<R>>, Laws...>;

/// A controller of position drives as the sum of its parts.
template <Robot R, class... Laws>
using PositionController = SumController<R, PositionCommand<joint_count<R>>, Laws...>;

}  // namespace articula
