// SPDX-License-Identifier: Apache-2.0
/// @file The error frames of SocketCAN: reports of a CAN controller about itself.
#pragma once

#include <array>
#include <cstdint>

namespace articula {

/// A controller's report about itself in an error frame.
struct CanErrorReport {
  bool bus_off = false;    ///< the controller has left the bus
  bool restarted = false;  ///< the controller is back after bus-off
  bool passive = false;    ///< its error counters are above 127
  bool recovered = false;  ///< its error counters are low again
  bool overflow = false;   ///< its receive or transmit buffer has overflowed
  bool no_answer = false;  ///< no node acknowledges its frames, or sending timed out
};

/// Decodes an error frame of SocketCAN [Linux, include/uapi/linux/can/error.h]. Unknown bits are
/// ignored.
/// @param classes  identifier of the frame without its flags, which has a bit per class of errors
/// @param data     payload
/// Real-time: yes.
[[nodiscard]] constexpr CanErrorReport decode_error_frame(
    std::uint32_t classes, const std::array<std::uint8_t, 8>& data) noexcept {
  constexpr std::uint32_t transmit_timeout = 0x001, controller = 0x004, no_acknowledge = 0x020,
                          bus_off = 0x040, restarted = 0x100;
  constexpr std::uint8_t overflows = 0x01 | 0x02, passives = 0x10 | 0x20, active = 0x40;
  const auto has = [&](std::uint32_t error_class) { return (classes & error_class) != 0; };
  const std::uint8_t state = has(controller) ? data[1] : std::uint8_t{0};
  return {.bus_off = has(bus_off),
          .restarted = has(restarted),
          .passive = (state & passives) != 0,
          .recovered = (state & active) != 0,
          .overflow = (state & overflows) != 0,
          .no_answer = has(transmit_timeout) || has(no_acknowledge)};
}

}  // namespace articula
