// SPDX-License-Identifier: Apache-2.0
/// @file The layout of a CiA 402 drive's process data.
#pragma once

#include "articula/hardware/canopen/canopen_pdo_mapping.hpp"
#include "articula/hardware/cia402/cia402.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace articula::cia402 {

/// The target object of a mode.
[[nodiscard]] constexpr canopen::MappedObject mapped_target(Mode mode) noexcept {
  if (mode == Mode::cyclic_synchronous_position) return {target_position, 32};
  if (mode == Mode::cyclic_synchronous_velocity) return {target_velocity, 32};
  return {target_torque, 16};
}
inline constexpr canopen::MappedObject mapped_controlword{controlword, 16};
inline constexpr canopen::MappedObject mapped_statusword{statusword, 16};
inline constexpr canopen::MappedObject mapped_position{position_actual, 32};
inline constexpr canopen::MappedObject mapped_torque{torque_actual, 16};
inline constexpr canopen::MappedObject mapped_velocity{velocity_actual, 32};
inline constexpr canopen::MappedObject mapped_error_code{error_code, 16};

/// The host's frame without the command, and the first bytes of the command's parts.
struct ReceiveLayout {
  CanFrame frame{};
  std::uint8_t controlword = 0;
  std::uint8_t target = 2;
};

/// The first bytes of the parts of a drive's frame; `absent` for parts that are not in it. The
/// length is 0 if the frame is not used.
struct TransmitLayout {
  static constexpr std::uint8_t absent = canopen::PdoMapping::absent;
  std::uint8_t length = 0;
  std::uint8_t stream = 0;  ///< its index among the used frames
  std::uint8_t statusword = absent;
  std::uint8_t position = absent;
  std::uint8_t torque = absent;
  std::uint8_t velocity = absent;
  std::uint8_t error_code = absent;

  friend constexpr bool operator==(const TransmitLayout&, const TransmitLayout&) = default;
};

/// TPDO 1 and 2 of a drive that has all parts, as Cia402PdoSetUp maps them.
inline constexpr std::array<TransmitLayout, 2> usual_transmit{{
    {.length = 8, .stream = 0, .statusword = 0, .position = 2, .torque = 6},
    {.length = 6, .stream = 1, .velocity = 0, .error_code = 4},
}};

/// The process data of one drive.
struct ProcessData {
  static constexpr std::size_t most = 4;  ///< RPDOs, and TPDOs, with predefined identifiers
  std::uint8_t receive_number = 0;        ///< of the RPDO that is used, from 0
  ReceiveLayout receive{};
  std::array<TransmitLayout, most> transmit{};
  std::size_t stream_count = 0;  ///< number of used frames
  double sync_period = 1e-3;     ///< [s]
  bool is_usual = true;          ///< `transmit` is `usual_transmit`
  bool has_velocity = true;      ///< else velocity is the difference of two positions
};

/// The layout of the host's frame.
/// @param number   of the RPDO, from 0
/// @param node     1 .. 127
/// @param mode     of operation
/// @param mapping  of the RPDO
/// @return a layout of length 0 if controlword or target are missing, or if zero might not be a
///         safe value of another object; object 6060h gets the mode
/// Real-time: yes.
[[nodiscard]] constexpr ReceiveLayout receive_layout(std::size_t number, std::uint8_t node,
                                                     Mode mode,
                                                     const canopen::PdoMapping& mapping) noexcept {
  ReceiveLayout layout{
      {}, mapping.offset_of(mapped_controlword), mapping.offset_of(mapped_target(mode))};
  if (layout.controlword == canopen::PdoMapping::absent) return {};
  if (layout.target == canopen::PdoMapping::absent) return {};
  for (const canopen::MappedObject& object : mapping) {
    constexpr std::uint16_t last_dummy = 7;  // data types are placeholders for unused bytes
    const bool harmless = object == mapped_controlword || object == mapped_target(mode) ||
                          object.address.index <= last_dummy || object.address == target_torque ||
                          object.address == target_velocity || object.address == velocity_offset ||
                          object.address == torque_offset;
    if (object.address == mode_of_operation) {
      layout.frame.data[mapping.offset_of(object)] = static_cast<std::uint8_t>(mode);
    } else if (!harmless) {
      return {};
    }
  }
  layout.frame.identifier = canopen::receive_pdo_1_base +
                            canopen::pdo_spacing * static_cast<std::uint32_t>(number) + node;
  layout.frame.length = mapping.length();
  return layout;
}

/// The layout of a drive's frame; of length 0 if no part is in it. Real-time: yes.
[[nodiscard]] constexpr TransmitLayout transmit_layout(
    const canopen::PdoMapping& mapping) noexcept {
  const TransmitLayout layout{mapping.length(),
                              0,
                              mapping.offset_of(mapped_statusword),
                              mapping.offset_of(mapped_position),
                              mapping.offset_of(mapped_torque),
                              mapping.offset_of(mapped_velocity),
                              mapping.offset_of(mapped_error_code)};
  const bool of_use = (layout.statusword & layout.position & layout.torque & layout.velocity &
                       layout.error_code) != TransmitLayout::absent;
  return of_use ? layout : TransmitLayout{};
}

}  // namespace articula::cia402
