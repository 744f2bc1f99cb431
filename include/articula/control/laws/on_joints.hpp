// SPDX-License-Identifier: Apache-2.0
/// @file A part of a controller for some of the joints.
#pragma once

#include "articula/control/laws/effort_law.hpp"
#include "articula/control/laws/part_scope.hpp"
#include "articula/model/robot.hpp"

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace articula {

/// A part of a controller that acts on some of a robot's joints, and on the others not at all. With
/// it each joint, or group of joints, of one robot can have its own law:
///
///     EffortController<Arm, OnJoints<7, PidLaw<7>>, OnJoints<7, ImpedanceLaw<7>>>
///
/// @tparam N    number of joints of the robot
/// @tparam Law  the part, for all N joints
template <int N, EffortLaw<N> Law>
class OnJoints {
 public:
  /// @param robot   whose joints these are
  /// @param law     the part
  /// @param joints  names of those that the part acts on
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

  /// Starts the part anew. Real-time: yes.
  void start(const JointState<N>& state) noexcept { law_.start(state); }

  /// The part's effort on its joints, 0 on the others, N x 1. Real-time: yes.
  [[nodiscard]] JointVector<N> effort(const JointState<N>& state,
                                      const JointReference<N>& reference, double period) noexcept {
    return chosen(law_.effort(state, reference, period));
  }

  /// Lets the part begin with what was given last on its joints. Real-time: yes.
  JointVector<N> prime(const JointState<N>& state, const JointReference<N>& reference,
                       double period, const JointVector<N>& effort,
                       LastCommand is = LastCommand::any) noexcept
    requires Primable<Law, N>
  {
    return chosen(detail::prime(law_, state, reference, period, chosen(effort), is));
  }

  /// Tells the part what was cut off on its joints. Real-time: yes.
  void limited(const JointVector<N>& excess) noexcept
    requires LimitAware<Law, N>
  {
    law_.limited(chosen(excess));
  }

  /// Goes on with other gains. Real-time: yes.
  template <class Gains>
    requires TakesGains<Law, Gains>
  void set_gains(const Gains& gains) noexcept {
    law_.set_gains(gains);
  }

  /// Calls function(part, scope).
  void for_each_part(auto&& function) const { function(law_, PartScope<N>{.joints = chosen_}); }

 private:
  /// What belongs to the part's joints; a NaN of another joint does not get through.
  [[nodiscard]] JointVector<N> chosen(const JointVector<N>& values) const noexcept {
    return (chosen_.array() != 0).select(values, JointVector<N>::Zero());
  }

  Law law_;
  JointVector<N> chosen_ = JointVector<N>::Zero();  ///< 1 for the part's joints
};

}  // namespace articula
