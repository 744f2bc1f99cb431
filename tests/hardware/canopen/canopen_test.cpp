// SPDX-License-Identifier: Apache-2.0
// The bytes on the wire, as CiA 301 and 402 have them.
#include <articula/hardware/canopen/canopen.hpp>
#include <articula/hardware/canopen/canopen_pdo_mapping.hpp>
#include <articula/hardware/canopen/canopen_sdo_client.hpp>
#include <articula/hardware/cia402/cia402.hpp>

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

TEST_CASE("golden frames of network management, SYNC, heartbeat and emergency") {
  using namespace canopen;
  CHECK(encode(NmtCommand::start, 5) == frame(0x000, {0x01, 0x05}));
  CHECK(encode(NmtCommand::enter_pre_operational, 0) == frame(0x000, {0x80, 0x00}));
  CHECK(encode_sync() == frame(0x080, {}));
  CHECK(decode_heartbeat(frame(0x705, {0x05})) == NmtState::operational);
  CHECK(decode_heartbeat(frame(0x77f, {0x00})) == NmtState::boot_up);
  CHECK_FALSE(decode_heartbeat(frame(0x705, {0x85})));  // node guarding's toggle bit
  CHECK_FALSE(decode_heartbeat(frame(0x705, {})));
  const auto emergency = decode_emergency(frame(0x085, {0x10, 0x82, 0x11, 0, 0, 0, 0, 0}));
  REQUIRE(emergency);
  CHECK(emergency->code == 0x8210);
  CHECK(emergency->register_bits == 0x11);
  CHECK_FALSE(decode_emergency(frame(0x080, {0, 0, 0, 0, 0, 0, 0, 0})));
}

TEST_CASE("golden frames of expedited access to objects") {
  using namespace canopen;
  CHECK(encode_request({SdoKind::download, {0x6060, 0}, 10, 1}, 2) ==
        frame(0x602, {0x2f, 0x60, 0x60, 0x00, 0x0a, 0, 0, 0}));
  CHECK(encode_request({SdoKind::download, {0x6040, 0}, 0x000f, 2}, 2) ==
        frame(0x602, {0x2b, 0x40, 0x60, 0x00, 0x0f, 0, 0, 0}));
  CHECK(encode_request({SdoKind::download, {0x1400, 1}, 0x8000'0202, 4}, 2) ==
        frame(0x602, {0x23, 0x00, 0x14, 0x01, 0x02, 0x02, 0x00, 0x80}));
  CHECK(encode_request({SdoKind::upload, {0x6041, 0}, 0, 0}, 127) ==
        frame(0x67f, {0x40, 0x41, 0x60, 0x00, 0, 0, 0, 0}));

  const auto written = decode_answer(frame(0x582, {0x60, 0x60, 0x60, 0x00, 0, 0, 0, 0}));
  REQUIRE(written);
  CHECK(written->kind == SdoKind::download);
  CHECK(written->address == ObjectAddress{0x6060, 0});
  const auto read = decode_answer(frame(0x582, {0x4b, 0x41, 0x60, 0x00, 0x37, 0x02, 0xcc, 0xcc}));
  REQUIRE(read);
  CHECK(read->kind == SdoKind::upload);
  CHECK(read->value == 0x0237);  // what lies beyond the size does not count
  CHECK(read->size == 2);
  // The node does not tell how many of the four bytes count: the host knows the object's size.
  const auto untold = decode_answer(frame(0x582, {0x42, 0x41, 0x60, 0x00, 0x37, 0x02, 0xcc, 0xcc}));
  REQUIRE(untold);
  CHECK(untold->kind == SdoKind::upload);
  CHECK(untold->value == 0xcccc'0237);
  CHECK(untold->size == 0);
  CHECK(encode_answer({SdoKind::upload, {0x6041, 0}, 0x0237, 0}, 2) ==
        frame(0x582, {0x42, 0x41, 0x60, 0x00, 0x37, 0x02, 0, 0}));
  CHECK(decode_request(frame(0x602, {0x22, 0x40, 0x60, 0x00, 0x0f, 0, 0, 0}))->size == 0);
  const auto refused = decode_answer(frame(0x582, {0x80, 0x60, 0x60, 0, 0x11, 0, 0x09, 0x06}));
  REQUIRE(refused);
  CHECK(refused->kind == SdoKind::abort);
  CHECK(refused->value == 0x0609'0011);
  CHECK_FALSE(decode_answer(frame(0x582, {0x41, 0x08, 0x10, 0, 0x10, 0, 0, 0})));  // segmented
  CHECK_FALSE(decode_answer(frame(0x582, {0x60, 0x60, 0x60})));
}

TEST_CASE("what one end of an access encodes the other end decodes") {
  using namespace canopen;
  for (std::uint8_t size = 1; size <= 4; ++size) {
    const std::uint32_t value = 0xa1b2c3d4U >> (8 * (4 - size));
    const auto request =
        decode_request(encode_request({SdoKind::download, {0x1234, 5}, value, size}, 9));
    REQUIRE(request);
    CHECK(request->kind == SdoKind::download);
    CHECK(request->address == ObjectAddress{0x1234, 5});
    CHECK(request->value == value);
    CHECK(request->size == size);
    const auto answer =
        decode_answer(encode_answer({SdoKind::upload, {0x1234, 5}, value, size}, 9));
    REQUIRE(answer);
    CHECK(answer->value == value);
    CHECK(answer->size == size);
  }
  const auto upload = decode_request(encode_request({SdoKind::upload, {0x1234, 5}, 0, 0}, 9));
  REQUIRE(upload);
  CHECK(upload->kind == SdoKind::upload);
}

TEST_CASE("a mapping knows its frame") {
  using namespace canopen;
  PdoMapping mapping;
  CHECK(mapping.push_back({{0x6041, 0}, 16}));
  CHECK(mapping.push_back({{0x6061, 0}, 8}));
  CHECK(mapping.push_back({{0x6064, 0}, 32}));
  CHECK(mapping.length() == 7);
  CHECK(mapping.offset_of({{0x6064, 0}, 32}) == 3);
  CHECK_FALSE(mapping.contains({{0x6064, 0}, 16}));   // of another size
  CHECK_FALSE(mapping.push_back({{0x6077, 0}, 16}));  // no room
  CHECK_FALSE(mapping.push_back({{0x60fd, 0}, 1}));   // parts of bytes
  CHECK(MappedObject{{0x6064, 0}, 32}.entry() == 0x6064'0020);
  CHECK(MappedObject::of_entry(0x60c2'0108) == MappedObject{{0x60c2, 1}, 8});
}

TEST_CASE("statuswords tell the states of the profile") {
  using cia402::State;
  CHECK(cia402::state_of(0x0000) == State::not_ready_to_switch_on);
  CHECK(cia402::state_of(0x0250) == State::switch_on_disabled);
  CHECK(cia402::state_of(0x0231) == State::ready_to_switch_on);
  CHECK(cia402::state_of(0x0233) == State::switched_on);
  CHECK(cia402::state_of(0x1637) == State::operation_enabled);
  CHECK(cia402::state_of(0x0217) == State::quick_stop_active);
  CHECK(cia402::state_of(0x021f) == State::fault_reaction_active);
  CHECK(cia402::state_of(0x0218) == State::fault);
  CHECK_FALSE(cia402::state_of(0x0001));
  for (unsigned bits = 0; bits <= 0xffff; ++bits) {
    const auto statusword = static_cast<std::uint16_t>(bits);
    REQUIRE(cia402::in_operation(statusword) ==
            (cia402::state_of(statusword) == State::operation_enabled));
  }
}

TEST_CASE("each state has its way to operation enabled") {
  using namespace cia402;
  CHECK(towards_operation(State::fault) == 0x80);
  CHECK(towards_operation(State::switch_on_disabled) == 0x06);
  CHECK(towards_operation(State::ready_to_switch_on) == 0x07);
  CHECK(towards_operation(State::switched_on) == 0x0f);
  CHECK(towards_operation(State::fault_reaction_active) == 0x00);
}

TEST_CASE("the second answer to a repeated request does not count for the next one") {
  using namespace std::chrono_literals;
  canopen::SdoClient client(5);
  CanBatch batch;
  const canopen::ObjectAddress object{0x6077, 0};
  const canopen::Sdo abort{canopen::SdoKind::abort, object, 0x0602'0000, 4};
  client.send(canopen::read_request(object), 0ms, batch);
  CHECK(client.overdue(100ms));
  client.send(canopen::read_request(object), 100ms, batch);
  CHECK(client.take(abort));
  client.send(canopen::write_request(object, 1, 2), 120ms, batch);
  CHECK_FALSE(client.take(abort));
  CHECK(client.waiting());
  CHECK(client.take(abort));
  // Another object in between: the second answer has come before.
  client.send(canopen::read_request(object), 200ms, batch);
  client.send(canopen::read_request(object), 300ms, batch);
  CHECK(client.take(abort));
  client.send(canopen::read_request({0x1000, 0}), 320ms, batch);
  client.send(canopen::read_request(object), 340ms, batch);
  CHECK(client.take(abort));
}
