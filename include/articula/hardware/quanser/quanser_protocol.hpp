// SPDX-License-Identifier: Apache-2.0
/// @file The frames of the Quanser arm's joint modules, docs/quanser_protocol.md.
#pragma once

#include "articula/hardware/can/can_frame.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

/// The frames between host and joint modules, in the units of the bus. Encoding returns the frame.
/// Decoding accepts any frame and returns a value, or nothing if it is another frame. All functions
/// are real-time.
namespace articula::quanser {

// Identifiers; those of a module n = 1 .. 31 are the base plus n. Efforts have a higher priority
// than SYNC, so that a controller that sends by priority keeps the order.
inline constexpr std::uint32_t control_base = 0x040;
inline constexpr std::uint32_t effort_base = 0x080;
inline constexpr std::uint32_t sync_identifier = 0x100;
inline constexpr std::uint32_t position_base = 0x180;
inline constexpr std::uint32_t motion_base = 0x200;
inline constexpr std::uint32_t heartbeat_base = 0x280;
inline constexpr std::uint8_t last_node = 31;

/// Bits of a module's status.
enum StatusBit : std::uint8_t {
  enabled = 1 << 0,  ///< follows efforts
  faulty = 1 << 1,   ///< a fault is latched
  limited = 1 << 2,  ///< the effort is held at the module's limit
};

/// Bits of a module's latched faults.
enum FaultBit : std::uint8_t {
  command_timeout = 1 << 0,   ///< no new effort within the watchdog's time
  over_current = 1 << 1,      ///< motor current too high
  over_temperature = 1 << 2,  ///< module too hot
  encoder = 1 << 3,           ///< an encoder signal is missing, or a count is out of range
  supply = 1 << 4,            ///< supply voltage out of range
  over_speed = 1 << 5,        ///< motor too fast
  internal = 1 << 6,          ///< anything else
};

/// Host to one module: command to its power stage.
enum class Control : std::uint8_t {
  enable = 1,        ///< follow efforts, from zero on; refused while faulty
  disable = 2,       ///< exert no effort
  clear_faults = 3,  ///< exert no effort, and clear faults whose cause is gone
};

/// Host to one module: the effort from the SYNC with the same counter on.
struct Effort {
  std::int16_t millinewton_metres = 0;  ///< [1e-3 N m]
  std::uint8_t counter = 0;             ///< of the SYNC that puts it into force
};

/// Module to host, answers SYNC: positions of motor and load.
struct Position {
  std::int32_t motor_counts = 0;  ///< motor encoder, 24 bits
  std::int32_t load_counts = 0;   ///< load encoder, 24 bits
  std::uint8_t counter = 0;       ///< of the SYNC that is answered
  std::uint8_t status = 0;        ///< StatusBit, at the time of sending
};

/// Module to host, answers SYNC: velocity and effort of the joint.
struct Motion {
  std::int16_t milliradians_per_second = 0;  ///< [1e-3 rad/s]
  std::int16_t millinewton_metres = 0;       ///< measured effort [1e-3 N m]
  std::uint8_t counter = 0;                  ///< of the SYNC that is answered
  std::uint8_t faults = 0;                   ///< FaultBit, at the time of sending
};

/// Module to host, every 100 ms and at once after a reset.
struct Heartbeat {
  std::uint8_t status = 0;  ///< StatusBit
  std::uint8_t faults = 0;  ///< FaultBit
  std::uint16_t count = 0;  ///< heartbeats since the last reset, at most 65535
};

namespace detail {

/// -32768 marks a missing figure.
inline constexpr std::int16_t no_value = -32768;
inline constexpr std::int32_t largest_count = 0x7fffff;
/// Marks a missing count.
inline constexpr std::int32_t no_count = -largest_count - 1;

[[nodiscard]] constexpr bool is(const CanFrame& frame, std::uint32_t base,
                                std::uint8_t length) noexcept {
  return frame.length == length && node_after(base, last_node, frame) != 0;
}
/// Reserved bits are 0, and a module is not enabled while it is faulty.
[[nodiscard]] constexpr bool is_status(std::uint8_t bits) noexcept {
  return bits < 1 << 3 && (bits & (enabled | faulty)) != (enabled | faulty);
}
[[nodiscard]] constexpr bool is_faults(std::uint8_t bits) noexcept { return bits < 1 << 7; }

}  // namespace detail

/// The module's node number in a frame: 1 .. 31, or 0 if it is another frame.
[[nodiscard]] constexpr std::uint8_t node_of(const CanFrame& frame) noexcept {
  for (const std::uint32_t base :
       {control_base, effort_base, position_base, motion_base, heartbeat_base}) {
    if (const std::uint8_t node = node_after(base, last_node, frame)) return node;
  }
  return 0;
}

[[nodiscard]] constexpr CanFrame encode(Control control, std::uint8_t node) noexcept {
  return {
      .identifier = control_base + node, .length = 1, .data = {static_cast<std::uint8_t>(control)}};
}
[[nodiscard]] constexpr std::optional<Control> decode_control(const CanFrame& frame) noexcept {
  if (!detail::is(frame, control_base, 1)) return {};
  if (frame.data[0] < 1 || frame.data[0] > 3) return {};
  return static_cast<Control>(frame.data[0]);
}

[[nodiscard]] constexpr CanFrame encode(const Effort& effort, std::uint8_t node) noexcept {
  CanFrame frame{.identifier = effort_base + node, .length = 3, .data = {0, 0, effort.counter}};
  store_little_endian<0, 2>(frame.data, effort.millinewton_metres);
  return frame;
}
[[nodiscard]] constexpr std::optional<Effort> decode_effort(const CanFrame& frame) noexcept {
  if (!detail::is(frame, effort_base, 3)) return {};
  const Effort effort{load_little_endian<std::int16_t, 0>(frame.data), frame.data[2]};
  if (effort.millinewton_metres == detail::no_value) return {};
  return effort;
}

/// Host to all modules: begins cycle `counter`.
[[nodiscard]] constexpr CanFrame encode_sync(std::uint8_t counter) noexcept {
  return {.identifier = sync_identifier, .length = 1, .data = {counter}};
}
[[nodiscard]] constexpr std::optional<std::uint8_t> decode_sync(const CanFrame& frame) noexcept {
  if (frame.extended || frame.identifier != sync_identifier || frame.length != 1) return {};
  return frame.data[0];
}

[[nodiscard]] constexpr CanFrame encode(const Position& position, std::uint8_t node) noexcept {
  CanFrame frame{.identifier = position_base + node, .length = 8};
  store_little_endian<0, 3>(frame.data, position.motor_counts);
  store_little_endian<3, 3>(frame.data, position.load_counts);
  frame.data[6] = position.counter;
  frame.data[7] = position.status;
  return frame;
}
[[nodiscard]] constexpr std::optional<Position> decode_position(const CanFrame& frame) noexcept {
  if (!detail::is(frame, position_base, 8) || !detail::is_status(frame.data[7])) return {};
  const Position position{load_little_endian<std::int32_t, 0, 3>(frame.data),
                          load_little_endian<std::int32_t, 3, 3>(frame.data), frame.data[6],
                          frame.data[7]};
  const std::int32_t lowest = std::min(position.motor_counts, position.load_counts);
  if (lowest == detail::no_count) return {};
  return position;
}

[[nodiscard]] constexpr CanFrame encode(const Motion& motion, std::uint8_t node) noexcept {
  CanFrame frame{.identifier = motion_base + node, .length = 6};
  store_little_endian<0, 2>(frame.data, motion.milliradians_per_second);
  store_little_endian<2, 2>(frame.data, motion.millinewton_metres);
  frame.data[4] = motion.counter;
  frame.data[5] = motion.faults;
  return frame;
}
[[nodiscard]] constexpr std::optional<Motion> decode_motion(const CanFrame& frame) noexcept {
  if (!detail::is(frame, motion_base, 6) || !detail::is_faults(frame.data[5])) return {};
  const Motion motion{load_little_endian<std::int16_t, 0>(frame.data),
                      load_little_endian<std::int16_t, 2>(frame.data), frame.data[4],
                      frame.data[5]};
  if (motion.milliradians_per_second == detail::no_value) return {};
  if (motion.millinewton_metres == detail::no_value) return {};
  return motion;
}

[[nodiscard]] constexpr CanFrame encode(const Heartbeat& heartbeat, std::uint8_t node) noexcept {
  CanFrame frame{.identifier = heartbeat_base + node,
                 .length = 4,
                 .data = {heartbeat.status, heartbeat.faults}};
  store_little_endian<2, 2>(frame.data, heartbeat.count);
  return frame;
}
[[nodiscard]] constexpr std::optional<Heartbeat> decode_heartbeat(const CanFrame& frame) noexcept {
  if (!detail::is(frame, heartbeat_base, 4)) return {};
  if (!detail::is_status(frame.data[0]) || !detail::is_faults(frame.data[1])) return {};
  return Heartbeat{frame.data[0], frame.data[1], load_little_endian<std::uint16_t, 2>(frame.data)};
}

}  // namespace articula::quanser
