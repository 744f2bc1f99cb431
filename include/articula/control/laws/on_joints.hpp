// SPDX-License-Identifier: Apache-2.0
/// @file A law that acts on some of the joints.
#pragma once

#include "articula/control/laws/control_law.hpp"
#include "articula/control/laws/part_scope.hpp"
#include "articula/control/laws/valid_gains.hpp"
#include "articula/model/robot.hpp"

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace articula {

/// A law that acts on some of a robot's joints only. With it each joint of a robot, or each group of
/// joints, can have its own law:
///
///     EffortController<Arm, OnJoints<7, PidLaw<7>>, OnJoints<7, ImpedanceLaw<7>>>
///
/// @tparam N    number of joints of the robot
/// @tparam Law  for all N joints
template <int N, ControlLaw<N> Law>
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
  auto start(const ControlInput<N>& in) noexcept
    requires detail::StartsLaw<Law, N>
  {
    const ControlInput<N> own{
        in.state, in.reference, in.period, {chosen(in.applied.numbers), in.applied.held}};
    if constexpr (detail::SharesApplied<Law, N>) {
      return chosen(law_.start(own));
    } else {
      law_.start(own);
    }
  }

  /// The law's output on its joints, 0 on the others, N x 1. Real-time: yes, if the law's is.
  [[nodiscard]] JointVector<N> output(const ControlInput<N>& in) noexcept {
    return chosen(law_.output({in.state, in.reference, in.period, in.applied, chosen(in.cut)}));
  }

  /// Goes on with other gains. Real-time: yes.
  template <class Gains>
    requires TakesGains<Law, Gains>
  void set_gains(const Gains& gains) noexcept {
    law_.set_gains(gains);
  }

  /// Calls function(law, scope).
  void for_each_part(auto&& function) const { function(law_, PartScope<N>{.joints = chosen_}); }

 private:
  /// The values of the law's joints; a NaN of another joint does not get through.
  [[nodiscard]] JointVector<N> chosen(const JointVector<N>& values) const noexcept {
    return (chosen_.array() != 0).select(values, JointVector<N>::Zero());
  }

  Law law_;
  JointVector<N> chosen_ = JointVector<N>::Zero();  ///< 1 for the law's joints
};

}  // namespace articula
