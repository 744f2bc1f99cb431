// SPDX-License-Identifier: Apache-2.0
/// @file A check that the maps of a transmission agree with each other.
#pragma once

#include "articula/core/joint_vector.hpp"
#include "articula/core/refuse.hpp"
#include "articula/hardware/transmission/transmission.hpp"

#include <cmath>
#include <string_view>

namespace articula::detail {

/// Refuses a product of two linear maps that is not the identity.
/// @param what  names the product in the message
template <int N>
void check_inverse(std::string_view where, std::string_view what, const JointMatrix<N>& left,
                   const JointMatrix<N>& right) {
  for (int row = 0; row < N; ++row) {
    for (int column = 0; column < N; ++column) {
      const double expected = row == column ? 1 : 0;
      const double element = left.row(row).dot(right.col(column).transpose());
      // Terms of any size may cancel, each rounded. 1e-9 is far above rounding and far below a
      // wrong gear.
      const double scale =
          expected + left.row(row).cwiseAbs().dot(right.col(column).cwiseAbs().transpose());
      if (std::abs(element - expected) <= 1e-9 * scale) continue;
      refuse({where, ": ", what, " is ", element, " at row ", row, ", column ", column,
              "; expected ", expected, " (see the concept Transmission)"});
    }
  }
}

/// Refuses positions whose differences are not those of the velocities.
/// @param what     names the map in the message
/// @param at_zero  positions where those of the other side are zero
/// @param unit     positions where those of the other side are the unit vector of `column`
/// @param rate     velocities for that unit vector
template <int N>
void check_rate(std::string_view where, std::string_view what, int column,
                const JointVector<N>& at_zero, const JointVector<N>& unit,
                const JointVector<N>& rate) {
  for (int row = 0; row < N; ++row) {
    const double moved = unit[row] - at_zero[row];
    // An offset is rounded in the difference, so that it adds its share.
    const double scale = std::abs(rate[row]) + 1e-3 * std::abs(at_zero[row]);
    if (std::abs(moved - rate[row]) <= 1e-9 * scale) continue;
    refuse({where, ": ", what, "_position moves by ", moved, " at row ", row, " for 1 at column ",
            column, "; expected ", rate[row], " as ", what, "_velocity (see the concept ",
            "Transmission)"});
  }
}

/// Refuses a transmission whose maps are not inverse to each other or do not keep the power: a
/// wrong sign in one of them would turn a drive's feedback around.
/// @param transmission  between actuators and joints
/// @param where         names it in the message
/// @throws std::invalid_argument with the map, its value and the expected one
/// Real-time: no.
template <Transmission T>
void check_maps(const T& transmission, std::string_view where) {
  constexpr int N = T::size;
  using Vector = JointVector<N>;
  const Vector actuators_at_zero = transmission.actuator_position(Vector::Zero());
  const Vector joints_at_zero = transmission.joint_position(Vector::Zero());
  JointMatrix<N> actuator_velocity, joint_velocity;  // a column for each unit vector
  JointMatrix<N> actuator_effort, joint_effort;      // a row for each
  for (int j = 0; j < N; ++j) {
    const Vector unit = Vector::Unit(j);
    actuator_velocity.col(j) = transmission.actuator_velocity(unit);
    joint_velocity.col(j) = transmission.joint_velocity(unit);
    actuator_effort.row(j) = transmission.actuator_effort(unit);
    joint_effort.row(j) = transmission.joint_effort(unit);
    check_rate<N>(where, "actuator", j, actuators_at_zero, transmission.actuator_position(unit),
                  actuator_velocity.col(j));
    check_rate<N>(where, "joint", j, joints_at_zero, transmission.joint_position(unit),
                  joint_velocity.col(j));
  }
  check_inverse<N>(where, "joint_velocity after actuator_velocity", joint_velocity,
                   actuator_velocity);
  check_inverse<N>(where, "the power actuator_effort . actuator_velocity", actuator_effort,
                   actuator_velocity);
  check_inverse<N>(where, "the power joint_effort . joint_velocity", joint_effort, joint_velocity);
  // The positions of the joints where those of the actuators are those of joints at zero.
  const Vector returned = transmission.joint_position(actuators_at_zero);
  const Vector scale =
      joint_velocity.cwiseAbs() * actuators_at_zero.cwiseAbs() + joints_at_zero.cwiseAbs();
  for (int j = 0; j < N; ++j) {
    if (std::abs(returned[j]) <= 1e-9 * scale[j]) continue;
    refuse({where, ": joint_position after actuator_position is ", returned[j], " at row ", j,
            " for joints at 0; expected 0 (see the concept Transmission)"});
  }
}

}  // namespace articula::detail
