// SPDX-License-Identifier: Apache-2.0
/// @file A transmission with actuators and joints exchanged.
#pragma once

#include "articula/hardware/transmission/transmission.hpp"

#include <string_view>

namespace articula {

/// A transmission with actuators and joints exchanged: its joints are the actuators of the one
/// inside. For the simulation of drives that count at the motor:
/// `TransmittedHardware<Simulator<Arm>, Arm, Reversed<SimpleTransmission>, ...>` is the motors'
/// side.
template <Transmission T>
struct Reversed {
  static constexpr int size = T::size;
  using Vector = JointVector<size>;  ///< size x 1

  T transmission{};

  [[nodiscard]] Vector joint_position(const Vector& x) const noexcept {
    return transmission.actuator_position(x);
  }
  [[nodiscard]] Vector joint_velocity(const Vector& x) const noexcept {
    return transmission.actuator_velocity(x);
  }
  [[nodiscard]] Vector joint_effort(const Vector& x) const noexcept {
    return transmission.actuator_effort(x);
  }
  [[nodiscard]] Vector actuator_position(const Vector& x) const noexcept {
    return transmission.joint_position(x);
  }
  [[nodiscard]] Vector actuator_velocity(const Vector& x) const noexcept {
    return transmission.joint_velocity(x);
  }
  [[nodiscard]] Vector actuator_effort(const Vector& x) const noexcept {
    return transmission.joint_effort(x);
  }
};

/// @throws std::invalid_argument as the transmission inside
/// Real-time: no (throws).
template <Transmission T>
void validate(const Reversed<T>& reversed, std::string_view where) {
  validate(reversed.transmission, where);
}

}  // namespace articula
