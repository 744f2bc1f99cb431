// SPDX-License-Identifier: Apache-2.0
/// @file Transmissions with the parameters of a URDF. Needs the CMake target articula::urdf
/// (urdfdom).
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/hardware/transmission/differential_transmission.hpp"
#include "articula/hardware/transmission/four_bar_transmission.hpp"
#include "articula/hardware/transmission/simple_transmission.hpp"
#include "articula/hardware/transmission/transmitted_hardware.hpp"
#include "articula/urdf/description.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace articula {

/// The gearing of a URDF's <transmission>. Joints and actuators are sorted by their roles
/// ("joint1", "actuator2"); without roles they keep the order of the file. The reduction of a
/// simple transmission is that of its actuator (ROS 1) times that of its joint (ros2_control). The
/// type in the file may be unknown, but not another one of the three known types.
///
///     TransmittedHardware<Drives, Arm, SimpleTransmission, ...> arm(
///         Drives(), gearing_of<SimpleTransmission>(urdf, "shoulder_transmission"), ...);
///
/// @tparam T           the transmission
/// @param description  from read_urdf
/// @param name         of the <transmission>
/// @throws std::invalid_argument with the name, if the transmission does not exist or has another
///         type
/// @throws std::invalid_argument likewise, if it has another number of joints or actuators, or if
///         their roles are incomplete
/// Real-time: no (searches by name, throws).
template <Transmission T>
  requires requires { T::urdf_name; }
[[nodiscard]] Gearing<T> gearing_of(const UrdfDescription& description, std::string_view name) {
  const std::string where = description->file + ": transmission '" + std::string(name) + "'";
  const auto found = std::ranges::find(description->transmissions, name, &UrdfTransmission::name);
  if (found == description->transmissions.end()) {
    std::string known;
    for (const auto& each : description->transmissions) known += " '" + each.name + "'";
    detail::refuse({where, " does not exist; the file has", known.empty() ? " none" : known});
  }
  // The last part of, for example, "transmission_interface/SimpleTransmission".
  const std::string type = found->type.substr(found->type.find_last_of("/:") + 1);
  constexpr std::array known = {SimpleTransmission::urdf_name, DifferentialTransmission::urdf_name,
                                FourBarTransmission::urdf_name};
  if (type != T::urdf_name && std::ranges::find(known, type) != known.end()) {
    detail::refuse({where, " is a ", type, ", not a ", T::urdf_name});
  }
  const auto in_order = [&](std::vector<UrdfTransmissionEnd> ends, const char* kind) {
    if (ends.size() != Gearing<T>::size) {
      detail::refuse({where, " has ", ends.size(), " ", kind, "s instead of ", Gearing<T>::size});
    }
    std::ranges::stable_sort(ends, {}, &UrdfTransmissionEnd::role);
    const bool none = ends.back().role.empty();
    const bool twice =
        std::ranges::adjacent_find(ends, {}, &UrdfTransmissionEnd::role) != ends.end();
    if (!none && (ends.front().role.empty() || twice)) {
      detail::refuse({where, ": each ", kind, " must have a role of its own, or none"});
    }
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
