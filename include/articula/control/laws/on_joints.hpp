// SPDX-License-Identifier: Apache-2.0
/// @file A law that acts on some of the joints.
#pragma once

#include "articula/control/composition/part_scope.hpp"
#include "articula/control/laws/control_law.hpp"
#include "articula/control/laws/valid_gains.hpp"
#include "articula/model/robot.hpp"

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace articula {

/// A law that acts on some of a robot's joints only. With it each joint of a robot, or each group
/// of joints, can have its own law:
///
///     EffortController<Arm, OnJoints<7, PidLaw<7>>, OnJoints<7, ImpedanceLaw<7>>>
///
/// @tparam N    number of joints of the robot
/// @tparam Law  for all N joints
/// @tparam S    type of a number: double, or a pack with the numbers of several robots
template <int N, class Law, class S = double>
  requires ControlLaw<Law, N, S>
class OnJoints {
 public:
  /// @param robot   whose joints these are
  /// @param law     for all joints
  /// @param joints  names of those that the law acts on
  /// @throws std::invalid_argument if the robot has no such joint, or one is named twice
  template <Robot R>
    requires(joint_count<R> == N)
  OnJoints(const R& robot, Law law, std::span<const std::string_view> joints)
      : law_(std::move(law)) {
    for (const std::string_view name : joints) {
      const int j = joint_index(robot, name);
      if (chosen_[j] != 0) {
        throw std::invalid_argument("joint '" + std::string(name) + "' is named twice");
      }
      chosen_[j] = 1;
    }
  }

  /// Starts the law with what was applied on its joints.
  /// @return  the law's share of that, N x 1, if it has one
  /// Real-time: yes, if the law's is.
  auto start(const ControlInput<N, S>& in) noexcept
    requires detail::StartsLaw<Law, N, S>
  {
    const ControlInput<N, S> own{
        in.state, in.reference, in.period, {chosen(in.applied.numbers), in.applied.held}};
    if constexpr (detail::SharesApplied<Law, N, S>) {
      return chosen(law_.start(own));
    } else {
      law_.start(own);
    }
  }

  /// The law's output on its joints, 0 on the others, N x 1. Real-time: yes, if the law's is.
  [[nodiscard]] JointVector<N, S> output(const ControlInput<N, S>& in) noexcept {
    return chosen(law_.output({in.state, in.reference, in.period, in.applied, chosen(in.cut)}));
  }

  /// The law as a part, and its joints; see HasParts.
  static auto parts(auto& self) noexcept { return std::tie(self.law_); }
  /// @copydoc parts
  /// Real-time: yes.
  [[nodiscard]] PartScope<N> part_scope(std::size_t) const noexcept { return {.joints = chosen_}; }

 private:
  /// The values of the law's joints; a NaN of another joint does not get through.
  [[nodiscard]] JointVector<N, S> chosen(const JointVector<N, S>& values) const noexcept {
    return for_each_joint<N, S>([&](int j) noexcept { return chosen_[j] != 0 ? values[j] : S(0); });
  }

  Law law_;
  JointVector<N> chosen_ = JointVector<N>::Zero();  ///< 1 for the law's joints
};

}  // namespace articula
