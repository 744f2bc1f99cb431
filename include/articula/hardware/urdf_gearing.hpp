// SPDX-License-Identifier: Apache-2.0
/// @file Transmissions with the figures of a URDF. Needs the CMake target articula::urdf (urdfdom).
#pragma once

#include "articula/hardware/differential_transmission.hpp"
#include "articula/hardware/four_bar_transmission.hpp"
#include "articula/hardware/simple_transmission.hpp"
#include "articula/hardware/transmitted_hardware.hpp"
#include "articula/model/urdf/description.hpp"

#include <algorithm>
#include <concepts>
#include <string>
#include <string_view>
#include <vector>

namespace articula {

/// A transmission as a URDF's <transmission> has it. Joints and actuators stand by their roles ("joint1",
/// "actuator2"), or where they have none as in the file. The reduction of a simple transmission is that
/// of its actuator, as ROS 1 writes it, times that of its joint, as ros2_control does. The type that
/// the file names is not looked at: which one it is, is said here, where the compiler must know.
///
///     TransmittedHardware<Drives, Arm, SimpleTransmission, ...> arm(
///         Drives(), gearing_of<SimpleTransmission>(urdf, "shoulder_transmission"), ...);
///
/// @tparam T           the transmission
/// @param description  what was read
/// @param name         of the <transmission>
/// @throws std::invalid_argument if there is none of that name, or it has another number of joints or
///         actuators, naming it and them
/// Real-time: no (searches by name, throws).
template <Transmission T>
requires std::same_as<T, SimpleTransmission> || std::same_as<T, DifferentialTransmission> ||
    std::same_as<T, FourBarTransmission>
[[nodiscard]] Gearing<T> gearing_of(const UrdfDescription& description, std::string_view name) {
  const std::string where = description.file + ": transmission '" + std::string(name) + "'";
  const auto found = std::ranges::find(description.transmissions, name, &UrdfTransmission::name);
  if (found == description.transmissions.end()) {
    throw std::invalid_argument(where + " does not exist");
  }
  const auto in_order = [&](std::vector<UrdfTransmissionEnd> ends, const char* kind) {
    if (ends.size() != Gearing<T>::size) {
      throw std::invalid_argument(where + " has " + std::to_string(ends.size()) + " " + kind +
                                  "s instead of " + std::to_string(Gearing<T>::size));
    }
    std::ranges::stable_sort(ends, {}, &UrdfTransmissionEnd::role);
    return ends;
  };
  const auto joints = in_order(found->joints, "joint");
  const auto actuators = in_order(found->actuators, "actuator");

  Gearing<T> gearing;
  for (std::size_t k = 0; k < Gearing<T>::size; ++k) {
    gearing.joints[k] = std::string_view(joints[k].name);
    gearing.actuators[k] = std::string_view(actuators[k].name);
    if constexpr (std::same_as<T, SimpleTransmission>) {
      gearing.transmission = {actuators[k].mechanical_reduction * joints[k].mechanical_reduction,
                              joints[k].offset};
    } else {
      gearing.transmission.actuator_reduction[k] = actuators[k].mechanical_reduction;
      gearing.transmission.joint_reduction[k] = joints[k].mechanical_reduction;
      gearing.transmission.joint_offset[k] = joints[k].offset;
    }
  }
  validate(gearing.transmission, where);
  return gearing;
}

}  // namespace articula
