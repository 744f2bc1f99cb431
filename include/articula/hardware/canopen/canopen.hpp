// SPDX-License-Identifier: Apache-2.0
/// @file The CANopen frames that hosts of drives use.
#pragma once

#include "articula/hardware/can/can_frame.hpp"
#include "articula/hardware/can/object_address.hpp"

#include <cstdint>
#include <optional>

/// Network management, SYNC, heartbeat, emergency, and expedited access to the object dictionary
/// [CiA 301]. Encoding returns the frame. Decoding accepts any frame and returns a value, or
/// nothing if it is another frame. All functions are real-time.
namespace articula::canopen {

// Identifiers of the predefined connection set; those of a node n = 1 .. 127 are the base plus n.
inline constexpr std::uint32_t nmt_identifier = 0x000;
inline constexpr std::uint32_t sync_identifier = 0x080;
inline constexpr std::uint32_t emergency_base = 0x080;
inline constexpr std::uint32_t transmit_pdo_1_base = 0x180;  ///< node to host
inline constexpr std::uint32_t receive_pdo_1_base = 0x200;   ///< host to node
inline constexpr std::uint32_t transmit_pdo_2_base = 0x280;  ///< node to host
inline constexpr std::uint32_t transmit_pdo_3_base = 0x380;  ///< node to host
inline constexpr std::uint32_t transmit_pdo_4_base = 0x480;  ///< node to host
inline constexpr std::uint32_t sdo_answer_base = 0x580;      ///< node to host
inline constexpr std::uint32_t sdo_request_base = 0x600;     ///< host to node
inline constexpr std::uint32_t heartbeat_base = 0x700;       ///< node to all
inline constexpr std::uint32_t pdo_spacing = 0x100;          ///< from one PDO's base to the next
inline constexpr std::uint8_t last_node = 127;
inline constexpr std::uint16_t identity = 0x1018;  ///< object of every node

/// A network management command [CiA 301, 7.2.8].
enum class NmtCommand : std::uint8_t {
  start = 0x01,
  stop = 0x02,
  enter_pre_operational = 0x80,
  reset_node = 0x81,
  reset_communication = 0x82,
};

/// A node's network management state, as in its heartbeat.
enum class NmtState : std::uint8_t {
  boot_up = 0x00,
  stopped = 0x04,
  operational = 0x05,
  pre_operational = 0x7f,
};

/// The kind of an access to an object, or of its answer.
enum class SdoKind : std::uint8_t {
  download,  ///< write
  upload,    ///< read
  abort,     ///< an answer whose value is an abort code
};

/// Expedited access to one object: a request to a node, or its answer.
struct Sdo {
  SdoKind kind = SdoKind::upload;
  ObjectAddress address{};
  std::uint32_t value = 0;  ///< little-endian bits; 0 beyond the size
  std::uint8_t size = 0;    ///< bytes of the value, 1 .. 4; 0: there is no value, or the node does
                            ///< not give its size
};

/// A request to read an object.
[[nodiscard]] constexpr Sdo read_request(const ObjectAddress& address) noexcept {
  return {SdoKind::upload, address, 0, 0};
}
/// A request to write an object of `size` bytes.
[[nodiscard]] constexpr Sdo write_request(const ObjectAddress& address, std::uint32_t value,
                                          std::uint8_t size) noexcept {
  return {SdoKind::download, address, value, size};
}

/// An emergency message: the error of a node.
struct Emergency {
  std::uint16_t code = 0;          ///< error code; 0: an error is gone
  std::uint8_t register_bits = 0;  ///< object 1001h
};

namespace detail {

[[nodiscard]] constexpr bool is(const CanFrame& frame, std::uint32_t base,
                                std::uint8_t length) noexcept {
  return frame.length == length && node_after(base, last_node, frame) != 0;
}
[[nodiscard]] constexpr ObjectAddress address_in(const CanFrame& frame) noexcept {
  return {load_little_endian<std::uint16_t, 1>(frame.data), frame.data[3]};
}

[[nodiscard]] constexpr CanFrame sdo_frame(std::uint32_t identifier, std::uint8_t command,
                                           const ObjectAddress& address,
                                           std::uint32_t value) noexcept {
  CanFrame frame{.identifier = identifier, .length = 8, .data = {command, 0, 0, address.subindex}};
  store_little_endian<1, 2>(frame.data, address.index);
  store_little_endian<4, 4>(frame.data, value);
  return frame;
}

/// Command byte of an expedited transfer. Bit 0: the size is indicated. Bits 2 and 3: number of
/// empty bytes then.
[[nodiscard]] constexpr std::uint8_t expedited(std::uint8_t specifier, std::uint8_t size) noexcept {
  if (size == 0) return static_cast<std::uint8_t>(specifier | 0x02);
  return static_cast<std::uint8_t>(specifier | (4 - size) << 2 | 0x03);
}

/// The value of a frame, if its command byte indicates one.
[[nodiscard]] constexpr std::optional<Sdo> with_value(const CanFrame& frame, std::uint8_t specifier,
                                                      SdoKind kind) noexcept {
  const std::uint8_t command = frame.data[0];
  if ((command & 0xf2) != (specifier | 0x02)) return {};
  Sdo sdo{kind, address_in(frame), load_little_endian<std::uint32_t, 4>(frame.data), 0};
  if ((command & 0x01) == 0) return sdo;  // the size is not indicated
  sdo.size = static_cast<std::uint8_t>(4 - (command >> 2 & 3));
  // Bytes beyond the size may have any value [CiA 301, 7.2.4.3.3: "do not care"].
  if (sdo.size < 4) sdo.value &= (std::uint32_t{1} << (8 * sdo.size)) - 1;
  return sdo;
}

}  // namespace detail

/// A command to one node, or with node 0 to all. [CiA 301, 7.2.8.3.1]
[[nodiscard]] constexpr CanFrame encode(NmtCommand command, std::uint8_t node) noexcept {
  return {.identifier = nmt_identifier,
          .length = 2,
          .data = {static_cast<std::uint8_t>(command), node}};
}

/// SYNC without counter. [CiA 301, 7.2.5]
[[nodiscard]] constexpr CanFrame encode_sync() noexcept { return {.identifier = sync_identifier}; }

/// A request to read or write an object. [CiA 301, 7.2.4.3.3 and 7.2.4.3.6]
[[nodiscard]] constexpr CanFrame encode_request(const Sdo& sdo, std::uint8_t node) noexcept {
  const std::uint8_t command =
      sdo.kind == SdoKind::download ? detail::expedited(0x20, sdo.size) : std::uint8_t{0x40};
  return detail::sdo_frame(sdo_request_base + node, command, sdo.address, sdo.value);
}

/// A node's answer to a request.
[[nodiscard]] constexpr CanFrame encode_answer(const Sdo& sdo, std::uint8_t node) noexcept {
  std::uint8_t command = 0x80;
  if (sdo.kind == SdoKind::download) command = 0x60;
  if (sdo.kind == SdoKind::upload) command = detail::expedited(0x40, sdo.size);
  return detail::sdo_frame(sdo_answer_base + node, command, sdo.address, sdo.value);
}

/// Decodes a request, at the node.
[[nodiscard]] constexpr std::optional<Sdo> decode_request(const CanFrame& frame) noexcept {
  if (!detail::is(frame, sdo_request_base, 8)) return {};
  if (frame.data[0] != 0x40) return detail::with_value(frame, 0x20, SdoKind::download);
  return read_request(detail::address_in(frame));
}

/// Decodes a node's answer, at the host. Segmented transfers are not supported: the objects that
/// the codec accesses have at most four bytes.
[[nodiscard]] constexpr std::optional<Sdo> decode_answer(const CanFrame& frame) noexcept {
  if (!detail::is(frame, sdo_answer_base, 8)) return {};
  const ObjectAddress address = detail::address_in(frame);
  if (frame.data[0] == 0x60) return Sdo{SdoKind::download, address, 0, 0};
  if (frame.data[0] == 0x80) {
    return Sdo{SdoKind::abort, address, load_little_endian<std::uint32_t, 4>(frame.data), 4};
  }
  return detail::with_value(frame, 0x40, SdoKind::upload);
}

/// A node's heartbeat. [CiA 301, 7.2.8.3.2.2]
[[nodiscard]] constexpr CanFrame encode(NmtState state, std::uint8_t node) noexcept {
  return {
      .identifier = heartbeat_base + node, .length = 1, .data = {static_cast<std::uint8_t>(state)}};
}
[[nodiscard]] constexpr std::optional<NmtState> decode_heartbeat(const CanFrame& frame) noexcept {
  if (!detail::is(frame, heartbeat_base, 1)) return {};
  for (const NmtState state :
       {NmtState::boot_up, NmtState::stopped, NmtState::operational, NmtState::pre_operational}) {
    if (frame.data[0] == static_cast<std::uint8_t>(state)) return state;
  }
  return {};
}

/// A node's emergency message. [CiA 301, 7.2.7]
[[nodiscard]] constexpr CanFrame encode(const Emergency& emergency, std::uint8_t node) noexcept {
  CanFrame frame{
      .identifier = emergency_base + node, .length = 8, .data = {0, 0, emergency.register_bits}};
  store_little_endian<0, 2>(frame.data, emergency.code);
  return frame;
}
[[nodiscard]] constexpr std::optional<Emergency> decode_emergency(const CanFrame& frame) noexcept {
  if (!detail::is(frame, emergency_base, 8)) return {};
  return Emergency{load_little_endian<std::uint16_t, 0>(frame.data), frame.data[2]};
}

}  // namespace articula::canopen
