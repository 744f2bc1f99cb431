// SPDX-License-Identifier: Apache-2.0
// Only so many participants are new in a time, whatever a packet has in it.
#include <articula/ros2/dds/packets/hide_unknown.hpp>
#include <articula/ros2/dds/packets/participant_gate.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "catch.hpp"

using namespace articula::ros2;
using dds::ParticipantGate;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

using Bytes = std::vector<std::byte>;

void append(Bytes& bytes, std::initializer_list<unsigned> values) {
  for (const unsigned value : values) bytes.push_back(static_cast<std::byte>(value));
}
/// The prefix of a participant with a number.
void append_prefix(Bytes& bytes, std::uint32_t number) {
  append(bytes, {1, 15, 0, 0, 0, 0, 0, 0, number >> 24, number >> 16 & 255, number >> 8 & 255,
                 number & 255});
}
Bytes header(std::uint32_t number) {
  Bytes bytes;
  append(bytes, {'R', 'T', 'P', 'S', 2, 3, 1, 15});
  append_prefix(bytes, number);
  return bytes;
}
void append_data(Bytes& bytes, unsigned writer_kind, unsigned writer) {
  append(bytes, {0x15, 1, 20, 0});
  append(bytes, {0, 0, 16, 0, 0, 0, 0, 0, 0, writer >> 8, writer & 255, writer_kind});
  append(bytes, {0, 0, 0, 0, 1, 0, 0, 0});
}
/// What a participant sends of a reader.
/// @param owner        of the identity that it announces
/// @param reliability  1: best effort, 2: reliable
/// @param other        the identity is named twice
Bytes endpoint(std::uint32_t number, unsigned entity, std::uint32_t owner, unsigned reliability,
               unsigned other = 0) {
  Bytes list;
  for (const unsigned each : {entity, other}) {
    if (each == 0) continue;
    append(list, {0x5a, 0, 16, 0});
    append_prefix(list, owner);
    append(list, {0, 0, each, 7});
  }
  append(list, {0x1a, 0, 12, 0, reliability, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  append(list, {0x35, 0, 4, 0, 255, 255, 255, 255});  // a filter, which nobody needs
  append(list, {1, 0, 0, 0});
  Bytes bytes = header(number);
  append(bytes, {0x15, 5, static_cast<unsigned>(24 + list.size()), 0});
  append(bytes, {0, 0, 16, 0, 0, 0, 0, 0, 0, 0, 4, 0xc2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 3, 0, 0});
  bytes.insert(bytes.end(), list.begin(), list.end());
  REQUIRE(dds::is_well_formed(bytes));
  return bytes;
}
/// What a participant sends to be discovered.
Bytes announcement(std::uint32_t number) {
  Bytes bytes = header(number);
  append_data(bytes, 0xc2, 0x0100);
  REQUIRE(dds::is_well_formed(bytes));
  return bytes;
}

/// How many of the participants from first to last - 1 are let in at a time.
int admitted(ParticipantGate& gate, std::uint32_t first, std::uint32_t last,
             ParticipantGate::Time now) {
  int count = 0;
  for (std::uint32_t number = first; number < last; ++number) {
    count += gate.admits(announcement(number), now) ? 1 : 0;
  }
  return count;
}

constexpr ParticipantGate::Time start{std::chrono::hours(1)};

}  // namespace

TEST_CASE("so many participants may be new at once, and then one a second") {
  ParticipantGate gate;
  CHECK(admitted(gate, 0, 1000, start) == ParticipantGate::most_at_once);
  CHECK(admitted(gate, 1000, 2000, start + milliseconds(999)) == 0);
  CHECK(admitted(gate, 2000, 3000, start + seconds(1)) == 1);
  CHECK(admitted(gate, 3000, 4000, start + milliseconds(3500)) == 2);
  // Those that are known pass all the time.
  CHECK(admitted(gate, 0, ParticipantGate::most_at_once, start + milliseconds(3500)) ==
        ParticipantGate::most_at_once);
  // After a quiet time there is room for as many as at the beginning.
  CHECK(admitted(gate, 5000, 7000, start + std::chrono::hours(1)) == ParticipantGate::most_at_once);
}

TEST_CASE("who announces itself again comes in during a storm of ever new ones") {
  ParticipantGate gate;
  std::uint32_t other = 0;
  for (int second = 0; second < 20; ++second) {
    CHECK(admitted(gate, other, other + 1000, start + seconds(second)) <=
          ParticipantGate::most_at_once);
    other += 1000;
  }
  const std::uint32_t newcomer = 1'000'000;
  CHECK_FALSE(gate.admits(announcement(newcomer), start + seconds(19)));
  CHECK(admitted(gate, other, other + 3000, start + seconds(19)) == 0);
  CHECK(gate.admits(announcement(newcomer), start + seconds(19)));
  CHECK(gate.admits(announcement(newcomer), start + seconds(19)));
  // As many of them as of the first ones, and then one a second.
  int count = 0;
  for (int round = 0; round < 2; ++round) {
    count += admitted(gate, 2'000'000, 2'001'000, start + seconds(19));
  }
  CHECK(count == ParticipantGate::most_at_once - 1);
  CHECK(admitted(gate, 2'000'500, 2'001'000, start + seconds(20)) == 2);  // of each one
}

TEST_CASE("a storm without end lets in one participant a second, and those that stay pass") {
  ParticipantGate gate;
  REQUIRE(gate.admits(announcement(0), start));
  int count = 0;
  constexpr int length = 3000;  // [s], so that more come in than are kept
  std::uint32_t newcomer = 1;
  for (int second = 0; second < length; ++second) {
    const ParticipantGate::Time now = start + seconds(second);
    count += admitted(gate, newcomer, newcomer + 20, now);
    newcomer += 20;
    CHECK(gate.admits(announcement(0), now));
  }
  CHECK(count >= ParticipantGate::most_at_once + length - 2);
  CHECK(count <= ParticipantGate::most_at_once + length);
}

TEST_CASE("announcements of other sources in a packet count") {
  ParticipantGate gate;
  REQUIRE(admitted(gate, 0, 1000, start) == ParticipantGate::most_at_once);
  // A packet of a known participant with the announcement of another one.
  Bytes forwarded = announcement(5);
  append(forwarded, {0x0c, 1, 20, 0, 0, 0, 0, 0, 2, 3, 1, 15});
  append_prefix(forwarded, 6000);
  CHECK(gate.admits(forwarded, start));
  append_data(forwarded, 0xc2, 0x0100);
  REQUIRE(dds::is_well_formed(forwarded));
  CHECK_FALSE(gate.admits(forwarded, start));
}

TEST_CASE("readers and writers are of the participant that announces them, and do not change") {
  ParticipantGate gate;
  CHECK_FALSE(gate.admits(endpoint(1, 8, 1, 1), start));  // nobody knows the participant
  REQUIRE(gate.admits(announcement(1), start));
  CHECK(gate.admits(endpoint(1, 8, 1, 1), start));
  CHECK(gate.admits(endpoint(1, 8, 1, 1), start));
  CHECK(gate.admits(endpoint(1, 9, 1, 2), start));
  CHECK_FALSE(gate.admits(endpoint(1, 8, 1, 2), start));   // Fast DDS 2.9.1 would end the program
  CHECK_FALSE(gate.admits(endpoint(1, 10, 2, 1), start));  // of another participant
  CHECK_FALSE(gate.admits(endpoint(1, 10, 1, 1, 11), start));  // two identities
  CHECK_FALSE(gate.admits(endpoint(1, 0, 1, 1), start));       // none
  for (unsigned entity = 12; entity < 256; ++entity) {
    CHECK(gate.admits(endpoint(1, entity, 1, 1), start));
  }
}

TEST_CASE("who leaves names itself, and what it has") {
  ParticipantGate gate;
  REQUIRE(gate.admits(announcement(1), start));
  REQUIRE(gate.admits(endpoint(1, 8, 1, 1), start));
  // Inline: a key and a status; the payload is the identity alone.
  const auto leave = [](std::uint32_t owner, unsigned status) {
    Bytes bytes = header(1);
    append(bytes, {0x15, 11, 76, 0, 0, 0, 16, 0, 0, 0, 0, 0, 0, 0, 4, 0xc2});
    append(bytes, {0, 0, 0, 0, 2, 0, 0, 0, 0x70, 0, 16, 0});
    append_prefix(bytes, owner);
    append(bytes, {0, 0, 8, 7, 0x71, 0, 4, 0, 0, 0, 0, status, 1, 0, 0, 0, 0, 3, 0, 0});
    append(bytes, {0x5a, 0, 16, 0});
    append_prefix(bytes, 1);
    append(bytes, {0, 0, 8, 7, 1, 0, 0, 0});
    bytes[22] = static_cast<std::byte>(bytes.size() - 24);
    return bytes;
  };
  CHECK(dds::is_well_formed(leave(1, 3)));
  CHECK(gate.admits(leave(1, 3), start));
  CHECK_FALSE(gate.admits(leave(2, 3), start));  // another one's key
  // An identity alone announces nothing. Fast DDS takes any other status for an announcement.
  for (const unsigned status : {0U, 4U, 5U, 7U}) CHECK_FALSE(dds::is_well_formed(leave(1, status)));
}

TEST_CASE("parameters that nobody needs are hidden") {
  const Bytes packet = endpoint(1, 8, 1, 1);
  Bytes copy = packet;
  dds::hide_unknown(packet, copy);
  int changes = 0;
  for (std::size_t k = 0; k < packet.size(); ++k) {
    if (packet[k] == copy[k]) continue;
    ++changes;
    CHECK(packet[k] == std::byte{0x35});
    CHECK(copy[k] == std::byte{0});
  }
  CHECK(changes == 1);
  CHECK(dds::is_well_formed(copy));
}

TEST_CASE("packets that announce no participant pass") {
  ParticipantGate gate;
  REQUIRE(admitted(gate, 0, 1000, start) == ParticipantGate::most_at_once);
  CHECK(gate.admits(header(7000), start));
  Bytes message = header(7000);
  append_data(message, 0x03, 0x0001);  // of a topic
  append_data(message, 0xc2, 0x0004);  // of a reader or writer
  REQUIRE(dds::is_well_formed(message));
  CHECK(gate.admits(message, start));
}
