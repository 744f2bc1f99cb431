// SPDX-License-Identifier: Apache-2.0
/// @file The joints of one group of Groups, and its rate.
#pragma once

#include "articula/control/switching/switch_request.hpp"
#include "articula/core/control_input.hpp"

namespace articula::detail {

/// One group of joints between two cycles.
/// @tparam N  number of joints of the robot
/// @tparam S  type of a number
template <int N, class S>
struct GroupState {
  using Vector = JointVector<N, S>;

  JointVector<N> joints = JointVector<N>::Zero();  ///< 1 for the group's joints
  Vector cut = Vector::Zero();  ///< of the controller's command in the cycle of its last call
  int divisor = 1;
  int since = 1;            ///< cycles since the last call
  int braked_cycles = 0;    ///< in a row without a reference or brake
  bool due = false;         ///< it is called in the next cycle, whatever the divisor
  bool passes_cut = false;  ///< it was called in the last cycle, and its command was used
  ControllerStatus status = ControllerStatus::active;

  /// The values of the group's joints, and others for the other joints, N x 1. Real-time: yes.
  [[nodiscard]] Vector select(const Vector& values,
                              const Vector& others = Vector::Zero()) const noexcept {
    return (joints.array() != 0).select(values, others);
  }

  /// The reference of the group's joints; the other joints are to stay as they are measured.
  /// Real-time: yes.
  [[nodiscard]] JointReference<N, S> reference(const ControlInput<N, S>& in) const noexcept {
    const auto& [position, velocity, acceleration, effort] = in.reference;
    return {select(position, in.state.position), select(velocity, in.state.velocity),
            select(acceleration), select(effort)};
  }

  /// A command of all joints with the group's own part in it. Real-time: yes.
  template <class Command>
  [[nodiscard]] Command merged(const Command& own, Command all) const noexcept {
    const auto take = [&](auto member) { all.*member = select(own.*member, all.*member); };
    if constexpr (requires { own.position; }) take(&Command::position);
    if constexpr (requires { own.velocity; }) take(&Command::velocity);
    if constexpr (requires { own.effort; }) take(&Command::effort);
    if constexpr (requires { own.stiffness; }) {
      take(&Command::stiffness);
      take(&Command::damping);
    }
    return all;
  }

  /// Begins with a call in the next cycle. Real-time: yes.
  void start() noexcept {
    since = divisor;
    braked_cycles = 0;
    passes_cut = false;
    cut.setZero();
    status = ControllerStatus::active;
  }
};

}  // namespace articula::detail
