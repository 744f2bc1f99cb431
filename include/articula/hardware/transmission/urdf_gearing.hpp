// SPDX-License-Identifier: Apache-2.0
/// @file Transmissions with the figures of a URDF. Needs the CMake target articula::urdf (urdfdom).
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

namespace detail {

/// The name by which URDFs know a transmission.
template <class T>
inline constexpr std::string_view urdf_transmission = "";
template <>
inline constexpr std::string_view urdf_transmission<SimpleTransmission> = "SimpleTransmission";
template <>
inline constexpr std::string_view urdf_transmission<DifferentialTransmission> =
    "DifferentialTransmission";
template <>
inline constexpr std::string_view urdf_transmission<FourBarTransmission> =
    "FourBarLinkageTransmission";

}  // namespace detail

/// A transmission as a URDF's <transmission> has it. Joints and actuators stand by their roles
/// ("joint1", "actuator2"), or where none of them has one as in the file. The reduction of a simple
/// transmission is that of its actuator, as ROS 1 writes it, times that of its joint, as
/// ros2_control does. The type that the file names may be unknown here, but not another one of
/// these three.
///
///     TransmittedHardware<Drives, Arm, SimpleTransmission, ...> arm(
///         Drives(), gearing_of<SimpleTransmission>(urdf, "shoulder_transmission"), ...);
///
/// @tparam T           the transmission
/// @param description  what was read
/// @param name         of the <transmission>
/// @throws std::invalid_argument if there is none of that name, it is of another type, has another
///         number of joints or actuators, or their roles do not tell which is which; naming it and
///         them
/// Real-time: no (searches by name, throws).
template <Transmission T>
  requires(!detail::urdf_transmission<T>.empty())
[[nodiscard]] Gearing<T> gearing_of(const UrdfDescription& description, std::string_view name) {
  const std::string where = description.file + ": transmission '" + std::string(name) + "'";
  const auto found = std::ranges::find(description.transmissions, name, &UrdfTransmission::name);
  if (found == description.transmissions.end()) {
    detail::refuse({where, " does not exist"});
  }
  // "transmission_interface/SimpleTransmission": the last part counts.
  const std::string type = found->type.substr(found->type.find_last_of("/:") + 1);
  constexpr std::array known = {detail::urdf_transmission<SimpleTransmission>,
                                detail::urdf_transmission<DifferentialTransmission>,
                                detail::urdf_transmission<FourBarTransmission>};
  if (type != detail::urdf_transmission<T> && std::ranges::find(known, type) != known.end()) {
    detail::refuse({where, " is a ", type, ", not a ", detail::urdf_transmission<T>});
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
