// SPDX-License-Identifier: Apache-2.0
// The bytes on the wire, both ways, as docs/quanser_protocol.md has them.
#include <articula/hardware/quanser/quanser_protocol.hpp>

#include "catch.hpp"

#include <initializer_list>

using namespace articula;

namespace {

constexpr CanFrame frame(std::uint32_t identifier, std::initializer_list<std::uint8_t> bytes) {
  CanFrame made;
  made.identifier = identifier;
  for (const std::uint8_t byte : bytes) made.data[made.length++] = byte;
  return made;
}

}  // namespace

TEST_CASE("golden frames, host to module") {
  CHECK(quanser::encode(quanser::Control::enable, 1) == frame(0x041, {0x01}));
  CHECK(quanser::encode(quanser::Control::disable, 2) == frame(0x042, {0x02}));
  CHECK(quanser::encode(quanser::Control::clear_faults, 31) == frame(0x05f, {0x03}));
  // 12.345 N m = 0x3039 mN m; -27.94 N m = 0x92dc
  CHECK(quanser::encode(quanser::Effort{12345, 7}, 1) == frame(0x081, {0x39, 0x30, 0x07}));
  CHECK(quanser::encode(quanser::Effort{-27940, 255}, 2) == frame(0x082, {0xdc, 0x92, 0xff}));
  CHECK(quanser::encode_sync(0xa5) == frame(0x100, {0xa5}));
}

TEST_CASE("golden frames, module to host") {
  const auto position =
      quanser::decode_position(frame(0x181, {0x01, 0x02, 0x03, 0xff, 0xff, 0xff, 0x2a, 0x05}));
  REQUIRE(position);
  CHECK(position->motor_counts == 0x030201);
  CHECK(position->load_counts == -1);
  CHECK(position->counter == 42);
  CHECK(position->status == (quanser::enabled | quanser::limited));

  const auto motion = quanser::decode_motion(frame(0x202, {0x18, 0xfc, 0xdc, 0x92, 0x2a, 0x41}));
  REQUIRE(motion);
  CHECK(motion->milliradians_per_second == -1000);
  CHECK(motion->millinewton_metres == -27940);
  CHECK(motion->counter == 42);
  CHECK(motion->faults == (quanser::command_timeout | quanser::internal));

  const auto heartbeat = quanser::decode_heartbeat(frame(0x29f, {0x02, 0x08, 0x34, 0x12}));
  REQUIRE(heartbeat);
  CHECK(heartbeat->status == quanser::faulty);
  CHECK(heartbeat->faults == quanser::encoder);
  CHECK(heartbeat->count == 0x1234);
}

TEST_CASE("what one end encodes the other end decodes") {
  for (const std::uint8_t node : {std::uint8_t{1}, std::uint8_t{31}}) {
    CAPTURE(int{node});
    for (const std::int32_t number : {-32767, -1, 0, 1, 12345, 32767}) {
      const auto small = static_cast<std::int16_t>(number);
      const auto effort = quanser::decode_effort(quanser::encode(quanser::Effort{small, 9}, node));
      REQUIRE(effort);
      CHECK(effort->millinewton_metres == number);
      CHECK(effort->counter == 9);
      const auto motion =
          quanser::decode_motion(quanser::encode(quanser::Motion{small, small, 9, 0x7f}, node));
      REQUIRE(motion);
      CHECK(motion->milliradians_per_second == number);
      CHECK(motion->millinewton_metres == number);
      const auto position = quanser::decode_position(
          quanser::encode(quanser::Position{number * 256, -number * 256, 9, 4}, node));
      REQUIRE(position);
      CHECK(position->motor_counts == number * 256);
      CHECK(position->load_counts == -number * 256);
    }
    for (const auto control :
         {quanser::Control::enable, quanser::Control::disable, quanser::Control::clear_faults}) {
      CHECK(quanser::decode_control(quanser::encode(control, node)) == control);
    }
    CHECK(quanser::node_of(quanser::encode(quanser::Effort{}, node)) == node);
  }
  CHECK(quanser::decode_sync(quanser::encode_sync(200)) == 200);
}

TEST_CASE("what makes no sense is no frame of the protocol") {
  using namespace quanser;
  CHECK_FALSE(decode_control(frame(0x041, {0x00})));
  CHECK_FALSE(decode_control(frame(0x041, {0x04})));
  CHECK_FALSE(decode_control(frame(0x041, {0x01, 0x00})));
  CHECK_FALSE(decode_control(frame(0x040, {0x01})));
  CHECK_FALSE(decode_control(frame(0x060, {0x01})));
  CHECK_FALSE(decode_effort(frame(0x081, {0x00, 0x80, 0x07})));  // -32768 stands for no value
  CHECK_FALSE(decode_effort(frame(0x081, {0x00, 0x00})));
  CHECK_FALSE(decode_sync(frame(0x100, {})));
  CHECK_FALSE(decode_sync(frame(0x100, {1, 2})));
  CHECK_FALSE(decode_position(frame(0x181, {0, 0, 0, 0, 0, 0, 0, 0x08})));  // reserved bit
  CHECK_FALSE(decode_position(frame(0x181, {0, 0, 0, 0, 0, 0, 0, 0x03})));  // enabled and faulty
  CHECK_FALSE(decode_position(frame(0x181, {0, 0, 0, 0, 0, 0, 0})));
  CHECK_FALSE(decode_position(frame(0x181, {0, 0, 0x80, 0, 0, 0, 0, 0})));  // no value, either
  CHECK_FALSE(decode_position(frame(0x181, {0, 0, 0, 0, 0, 0x80, 0, 0})));
  CHECK_FALSE(decode_motion(frame(0x201, {0x00, 0x80, 0, 0, 0, 0})));
  CHECK_FALSE(decode_motion(frame(0x201, {0, 0, 0x00, 0x80, 0, 0})));
  CHECK_FALSE(decode_motion(frame(0x201, {0, 0, 0, 0, 0, 0x80})));
  CHECK_FALSE(decode_heartbeat(frame(0x281, {0x08, 0, 0, 0})));
  CHECK_FALSE(decode_heartbeat(frame(0x281, {0, 0x80, 0, 0})));
  CanFrame extended = encode(Effort{}, 1);
  extended.extended = true;
  CHECK_FALSE(decode_effort(extended));
  CHECK(node_of(extended) == 0);
}

// The document's figure for an arm of two modules at 1 Mbit/s and 1 kHz: 735 of 1000 bits.
static_assert(worst_case_bits(quanser::encode_sync(0)) +
                  2 * (worst_case_bits(quanser::encode(quanser::Effort{}, 1)) +
                       worst_case_bits(quanser::encode(quanser::Position{}, 1)) +
                       worst_case_bits(quanser::encode(quanser::Motion{}, 1))) ==
              735);
