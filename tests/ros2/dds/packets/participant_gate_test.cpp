// SPDX-License-Identifier: Apache-2.0
// Only so many participants are new in a time, whatever a packet has in it.
#include <articula/ros2/dds/packets/discovery_filter.hpp>
#include <articula/ros2/dds/packets/participant_gate.hpp>

#include <algorithm>
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
constexpr std::byte gap{0x08};

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
/// The name of a topic in an announcement: four letters, and what follows their end.
Bytes topic(std::uint32_t number, unsigned behind = 0) {
  Bytes list;
  append(list, {5, 0, 12, 0, 6, 0, 0, 0});
  for (int k = 0; k < 4; ++k) append(list, {'a' + (number >> (4 * k) & 15)});
  append(list, {0, behind, 0, 0});
  return list;
}
/// An address in an announcement.
Bytes address(std::uint32_t number) {
  Bytes list;
  append(list, {0x2f, 0, 24, 0, 1, 0, 0, 0, number & 255, number >> 8, 0, 0});
  append(list, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 127, 0, 0, 1});
  return list;
}

/// What a participant sends of a reader.
/// @param owner        of the identity that it announces
/// @param reliability  1: best effort, 2: reliable
/// @param other        the identity is named twice
/// @param further      parameters
Bytes endpoint(std::uint32_t number, unsigned entity, std::uint32_t owner, unsigned reliability,
               unsigned other = 0, const Bytes& further = {}) {
  Bytes list = further;
  for (const unsigned each : {entity, other}) {
    if (each == 0) continue;
    append(list, {0x5a, 0, 16, 0});
    append_prefix(list, owner);
    append(list, {0, each >> 8, each & 255, 7});
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
/// What participant 1 sends at the end of a reader: inline a key and a status, then an identity.
/// @param owner  of the key
Bytes farewell(std::uint32_t owner, unsigned status, unsigned entity = 8) {
  Bytes bytes = header(1);
  append(bytes, {0x15, 11, 76, 0, 0, 0, 16, 0, 0, 0, 0, 0, 0, 0, 4, 0xc2});
  append(bytes, {0, 0, 0, 0, 2, 0, 0, 0, 0x70, 0, 16, 0});
  append_prefix(bytes, owner);
  append(bytes, {0, entity >> 8, entity & 255, 7, 0x71, 0, 4, 0, 0, 0, 0, status, 1, 0, 0, 0});
  append(bytes, {0, 3, 0, 0, 0x5a, 0, 16, 0});
  append_prefix(bytes, 1);
  append(bytes, {0, entity >> 8, entity & 255, 7, 1, 0, 0, 0});
  bytes[22] = static_cast<std::byte>(bytes.size() - 24);
  return bytes;
}
/// What a participant sends to be discovered.
Bytes announcement(std::uint32_t number) {
  Bytes bytes = header(number);
  append_data(bytes, 0xc2, 0x0100);
  REQUIRE(dds::is_well_formed(bytes));
  return bytes;
}

/// What a participant sends to be discovered, with a lease [s]. Its seconds begin at byte 52.
/// @param builtin  the readers and writers that it has for discovery; 1: a writer of announcements
Bytes leased(std::uint32_t number, unsigned seconds, unsigned builtin = 0x3f) {
  Bytes bytes = header(number);
  append(bytes, {0x15, 5, 68, 0});
  append(bytes, {0, 0, 16, 0, 0, 1, 0, 0xc7, 0, 1, 0, 0xc2, 0, 0, 0, 0, 7, 0, 0, 0});
  append(bytes, {0, 3, 0, 0, 0x02, 0, 8, 0, seconds & 255, seconds >> 8, 0, 0, 0, 0, 0, 0});
  append(bytes, {0x50, 0, 16, 0});
  append_prefix(bytes, number);
  append(bytes, {0, 0, 1, 0xc1, 0x58, 0, 4, 0, builtin, 0, 0, 0, 1, 0, 0, 0});
  REQUIRE(dds::is_well_formed(bytes));
  return bytes;
}

bool admits(ParticipantGate& gate, Bytes packet, ParticipantGate::Time now) {
  return gate.admits(packet, now);
}
/// Whether all that the packet announces passes.
bool passes(ParticipantGate& gate, Bytes packet, ParticipantGate::Time now) {
  const Bytes before = packet;
  dds::filter_discovery(packet);
  return gate.admits(packet, now) && packet.at(20) == before.at(20);
}

/// How many of the participants from first to last - 1 are let in at a time.
int admitted(ParticipantGate& gate, std::uint32_t first, std::uint32_t last,
             ParticipantGate::Time now) {
  int count = 0;
  for (std::uint32_t number = first; number < last; ++number) {
    count += admits(gate, announcement(number), now) ? 1 : 0;
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
  CHECK_FALSE(admits(gate, announcement(newcomer), start + seconds(19)));
  CHECK(admitted(gate, other, other + 3000, start + seconds(19)) == 0);
  CHECK(admits(gate, announcement(newcomer), start + seconds(19)));
  CHECK(admits(gate, announcement(newcomer), start + seconds(19)));
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
  REQUIRE(admits(gate, announcement(0), start));
  int count = 0;
  constexpr int length = 3000;  // [s], so that more come in than are kept
  std::uint32_t newcomer = 1;
  for (int second = 0; second < length; ++second) {
    const ParticipantGate::Time now = start + seconds(second);
    count += admitted(gate, newcomer, newcomer + 20, now);
    newcomer += 20;
    CHECK(admits(gate, announcement(0), now));
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
  CHECK(admits(gate, forwarded, start));
  append_data(forwarded, 0xc2, 0x0100);
  REQUIRE(dds::is_well_formed(forwarded));
  CHECK_FALSE(admits(gate, forwarded, start));
}

TEST_CASE("readers and writers are of the participant that announces them, and do not change") {
  ParticipantGate gate;
  CHECK_FALSE(passes(gate, endpoint(1, 8, 1, 1), start));  // nobody knows the participant
  REQUIRE(admits(gate, announcement(1), start));
  CHECK(passes(gate, endpoint(1, 8, 1, 1), start));
  CHECK(passes(gate, endpoint(1, 8, 1, 1), start));
  CHECK(passes(gate, endpoint(1, 9, 1, 2), start));
  CHECK_FALSE(passes(gate, endpoint(1, 8, 1, 2), start));   // Fast DDS 2.9.1 would end the program
  CHECK_FALSE(passes(gate, endpoint(1, 10, 2, 1), start));  // of another participant
  CHECK_FALSE(passes(gate, endpoint(1, 10, 1, 1, 11), start));  // two identities
  CHECK_FALSE(passes(gate, endpoint(1, 0, 1, 1), start));       // none
  for (unsigned entity = 12; entity < 128; ++entity) {
    CHECK(passes(gate, endpoint(1, entity, 1, 1), start));
  }
}

TEST_CASE("who leaves names itself, and what it has") {
  ParticipantGate gate;
  REQUIRE(admits(gate, announcement(1), start));
  REQUIRE(admits(gate, endpoint(1, 8, 1, 1), start));
  CHECK(dds::is_well_formed(farewell(1, 3)));
  CHECK(passes(gate, farewell(1, 3), start));
  CHECK_FALSE(passes(gate, farewell(2, 3), start));  // another one's key
  // An identity alone announces nothing. Fast DDS takes any other status for an announcement.
  for (const unsigned status : {0U, 4U, 5U, 7U}) {
    Bytes packet = farewell(1, status);
    dds::filter_discovery(packet);
    CHECK(packet.at(20) == gap);
  }
}

TEST_CASE("a participant may open and close many readers") {
  ParticipantGate gate;
  REQUIRE(admits(gate, announcement(1), start));
  for (unsigned reader = 1; reader < 10'000; ++reader) {
    INFO(reader);
    REQUIRE(passes(gate, endpoint(1, reader, 1, 1), start));
    REQUIRE(passes(gate, farewell(1, 3, reader), start));
  }
  // Fast DDS may see messages in another order, so an end allows no change.
  CHECK_FALSE(passes(gate, endpoint(1, 1, 1, 2), start));
}

TEST_CASE("leases end in the gate, and not in Fast DDS") {
  ParticipantGate gate;
  auto now = start;
  Bytes packet = leased(1, 10);
  REQUIRE(gate.admits(packet, now));
  const Bytes endless = {std::byte{0xff}, std::byte{0xff}, std::byte{0xff}, std::byte{0x7f}};
  CHECK(std::equal(endless.begin(), endless.end(), packet.begin() + 52));
  REQUIRE(admits(gate, leased(2, 300), now));
  // Leases of 10 s end 4 s late, for a standstill of this program.
  for (int k = 0; k < 14; ++k) REQUIRE(admits(gate, header(2), now += seconds(1)));
  CHECK(gate.farewells().empty());
  REQUIRE(admits(gate, header(1), now));  // any packet renews the lease
  for (int k = 0; k < 14; ++k) REQUIRE(admits(gate, header(2), now += seconds(1)));
  CHECK(gate.farewells().empty());
  REQUIRE(admits(gate, header(2), now += seconds(1)));
  const auto farewells = gate.farewells();
  REQUIRE(farewells.size() == 1);
  REQUIRE(admits(gate, header(2), now += seconds(1)));
  CHECK(gate.farewells().empty());  // once
  // The packet is what the participant would have sent, with the number after its announcement.
  REQUIRE(dds::is_well_formed(farewells[0]));
  CHECK(std::equal(packet.begin(), packet.begin() + 20, farewells[0].begin()));
  dds::for_each_part(farewells[0], [&](std::uint32_t kind, std::uint32_t flags, dds::Packet part) {
    CHECK(kind == dds::detail::message_part);
    const auto message = dds::detail::discovery_of(part, flags);
    REQUIRE(message);
    CHECK(message->ends);
    CHECK(message->number == 8);
    CHECK(dds::KnownEndpoints::is_of(dds::prefix_at(farewells[0], 8), *message));
    return true;
  });
  // It may come back, and its new lease ends, too.
  REQUIRE(admits(gate, leased(1, 10), now));
  for (int k = 0; k < 15; ++k) REQUIRE(admits(gate, header(2), now += seconds(1)));
  CHECK(gate.farewells().size() == 1);
}

TEST_CASE("Fast DDS gets participants alone that it can end") {
  ParticipantGate gate;
  CHECK_FALSE(admits(gate, leased(1, 10, 0x3e), start));  // it would ignore the farewell
  Bytes without_lease = leased(2, 10);
  without_lease[48] = std::byte{0x60};  // another parameter; Fast DDS would end it at once
  without_lease[49] = std::byte{0x80};
  REQUIRE(dds::is_well_formed(without_lease));
  CHECK_FALSE(admits(gate, without_lease, start));
  CHECK(admits(gate, leased(1, 10), start));
  CHECK(admits(gate, leased(2, 10), start));
}

TEST_CASE("the writers of a participant that returns begin anew, as in Fast DDS") {
  ParticipantGate gate;
  constexpr std::uint32_t writer = 0x000003c2;
  constexpr std::uint64_t high = 1 << 20;
  const auto beginning = [&](std::uint32_t number, std::uint64_t original) {
    dds::Budget budget(dds::WriterNumbers::longest, dds::WriterNumbers::longest);
    dds::KnownEndpoints* const known = gate.endpoints_of(dds::prefix_at(header(number), 8));
    REQUIRE(known != nullptr);
    return known->numbers_of(writer)->of_beginning(original, budget, start);
  };
  for (const std::uint32_t number : {1U, 2U, 3U}) {
    REQUIRE(admits(gate, leased(number, 10), start));
    CHECK(beginning(number, 1) == 1);
    gate.endpoints_of(dds::prefix_at(header(number), 8))->numbers_of(writer)->acknowledge(high + 1);
    CHECK(beginning(number, high) == high);
  }
  // 1 leaves, which its lease ends for Fast DDS, too; the lease of 2 ends, and 3 stays.
  Bytes end = dds::detail::farewell(dds::prefix_at(header(1), 8), 8);
  REQUIRE(gate.admits(end, start));
  for (int k = 1; k <= 15; ++k) REQUIRE(admits(gate, header(3), start + seconds(k)));
  CHECK(gate.farewells().size() == 2);
  for (const std::uint32_t number : {1U, 2U, 3U}) {
    REQUIRE(admits(gate, leased(number, 10), start + seconds(15)));
  }
  CHECK(beginning(1, 2 * high) == 1);
  CHECK(beginning(2, 2 * high) == 1);
  CHECK(beginning(3, high) == high);
  for (const std::uint32_t number : {1U, 2U, 3U}) {  // announcements are repeated
    REQUIRE(admits(gate, leased(number, 10), start + seconds(16)));
  }
  CHECK(beginning(1, 2 * high + 1) == 2);
}

TEST_CASE("while this program stands still for a while, no lease ends") {
  ParticipantGate gate;
  REQUIRE(admits(gate, leased(1, 10), start));
  REQUIRE(admits(gate, leased(2, 10), start));
  // Cyclone DDS sends something each 8 s, which may wait behind others' announcements.
  for (int k = 1; k <= 8; ++k) REQUIRE(admits(gate, header(2), start + seconds(k)));
  REQUIRE(admits(gate, header(2), start + seconds(8 + 16)));
  CHECK(gate.farewells().empty());
  REQUIRE(admits(gate, header(1), start + seconds(8 + 16)));
  for (const int second : {39, 54, 69}) {
    REQUIRE(admits(gate, header(2), start + seconds(second)));
    CHECK(gate.farewells().empty());
  }
  REQUIRE(admits(gate, header(2), start + seconds(72)));
  CHECK(gate.farewells().size() == 1);
}

TEST_CASE("after a standstill in which all peers have forgotten this program, it forgets them") {
  ParticipantGate gate;
  REQUIRE(admits(gate, leased(1, 300), start));
  REQUIRE(admits(gate, leased(2, 300), start));
  REQUIRE(admits(gate, header(1), start + seconds(17)));
  CHECK(gate.farewells().size() == 2);
  REQUIRE(admits(gate, leased(1, 300), start + seconds(17)));
  CHECK(gate.farewells().empty());
}

TEST_CASE("an end that Fast DDS may not believe leaves the lease") {
  ParticipantGate gate;
  REQUIRE(admits(gate, leased(1, 10), start));
  Bytes end = dds::detail::farewell(dds::prefix_at(header(1), 8), 3);  // before the announcement
  REQUIRE(gate.admits(end, start));
  for (int k = 1; k <= 15; ++k) REQUIRE(admits(gate, header(2), start + seconds(k)));
  CHECK(gate.farewells().size() == 1);
}

TEST_CASE("one participant does not fill a topic") {
  ParticipantGate gate;
  constexpr unsigned most = dds::KnownEndpoints::most_of_topic;
  for (const std::uint32_t participant : {1U, 2U}) {
    REQUIRE(admits(gate, announcement(participant), start));
    for (unsigned own = 1; own <= most; ++own) {
      REQUIRE(passes(gate, endpoint(participant, own, participant, 1, 0, topic(7)), start));
    }
  }
  const auto reader = [](unsigned entity, const Bytes& name) {
    return endpoint(1, entity, 1, 1, 0, name);
  };
  CHECK_FALSE(passes(gate, reader(most + 1, topic(7)), start));
  CHECK_FALSE(passes(gate, reader(most + 2, topic(7, 1)), start));  // the same name, to Fast DDS
  Bytes two = topic(8);
  const Bytes last = topic(7);
  two.insert(two.end(), last.begin(), last.end());
  CHECK_FALSE(passes(gate, reader(most + 3, two), start));  // Fast DDS takes the last one
  CHECK(passes(gate, reader(most + 4, topic(8)), start));
  CHECK(passes(gate, reader(most, topic(7)), start));  // which is there
  REQUIRE(passes(gate, farewell(1, 3, 5), start));
  REQUIRE(passes(gate, farewell(1, 3, 5), start));  // again
  CHECK(passes(gate, reader(most + 1, topic(7)), start));
  CHECK_FALSE(passes(gate, reader(5, topic(7)), start));
}

TEST_CASE("a participant has so many addresses, and no more") {
  ParticipantGate gate;
  REQUIRE(admits(gate, announcement(1), start));
  constexpr unsigned most = dds::KnownEndpoints::most_addresses;
  const auto at = [&](unsigned entity, unsigned number) {
    return passes(gate, endpoint(1, entity, 1, 1, 0, address(number)), start);
  };
  for (unsigned number = 0; number < most; ++number) REQUIRE(at(1, number));
  CHECK_FALSE(at(1, most));
  CHECK_FALSE(at(2, most));
  CHECK(at(2, 3));
}

TEST_CASE("an endpoint that is announced again and again takes the room of its participant alone") {
  ParticipantGate gate;
  for (const std::uint32_t participant : {1U, 2U}) {
    REQUIRE(admits(gate, announcement(participant), start));
  }
  const auto announced = [&](unsigned number) {
    Bytes packet = endpoint(1, 1, 1, 1);
    packet.at(40) = static_cast<std::byte>(number & 255);
    packet.at(41) = static_cast<std::byte>(number >> 8);
    return passes(gate, packet, start);
  };
  unsigned number = 1;
  while (number < 65'000 && announced(number)) ++number;
  CHECK(number > 20'000);
  CHECK(number < dds::KnownEndpoints::most_memory / 1024);
  CHECK(announced(number - 1));  // it is sent again because it was lost
  CHECK(passes(gate, endpoint(2, 1, 2, 1), start));
}

TEST_CASE("announcements find no room at last, until silent participants are forgotten") {
  ParticipantGate gate;
  std::uint32_t participant = 1;
  std::size_t readers = 0;
  for (bool room = true; room; ++participant) {
    REQUIRE(admits(gate, announcement(participant), start));
    for (unsigned own = 1; own < 5000 && room; ++own) {
      room = passes(gate, endpoint(participant, own, participant, 1, 0, topic(own)), start);
      if (room) ++readers;
    }
  }
  CHECK(readers > 200'000);
  CHECK(readers < ParticipantGate::most_memory / 1024);
  // One that announces itself again takes no more room.
  CHECK(passes(gate, endpoint(1, 1, 1, 1, 0, topic(1)), start));
  // A packet of any kind is a sign of life, by which Fast DDS keeps a participant.
  CHECK(admits(gate, header(2), start + seconds(200)));
  const auto later = start + seconds(400);
  CHECK(admits(gate, announcement(9999), later));
  CHECK(passes(gate, endpoint(9999, 1, 9999, 1), later));
  CHECK_FALSE(passes(gate, endpoint(2, 1, 2, 2), later));  // still known, as best effort
  CHECK(admits(gate, announcement(1), later));
  CHECK(passes(gate, endpoint(1, 1, 1, 2), later));
}

TEST_CASE("a message that is refused becomes a gap, so that those after it arrive") {
  for (const bool little : {true, false}) {
    INFO(little);
    Bytes packet = header(1);
    const auto part = [&](unsigned kind, unsigned size) {
      append(packet, {kind, little ? 1U : 0U, little ? size : 0, little ? 0 : size});
    };
    // A fragment of discovery: reader, writer, number 0x1ffffffff, then what fragments have.
    part(0x16, 36);
    append(packet, {0, 0, little ? 28U : 0, little ? 0 : 28U, 0, 0, 3, 0xc7, 0, 0, 3, 0xc2});
    append(packet, little ? std::initializer_list<unsigned>{1, 0, 0, 0, 255, 255, 255, 255}
                          : std::initializer_list<unsigned>{0, 0, 0, 1, 255, 255, 255, 255});
    append(packet, {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 9, 9, 9, 9});
    part(0x55, 4);
    append(packet, {7, 7, 7, 7});
    REQUIRE(dds::is_well_formed(packet));
    Bytes expected = packet;
    expected[20] = gap;
    const std::vector<unsigned> rest =
        little ? std::vector<unsigned>{0,   0,   3, 0xc7, 0, 0, 3, 0xc2, 1, 0, 0, 0, 255, 255,
                                       255, 255, 2, 0,    0, 0, 0, 0,    0, 0, 0, 0, 0,   0}
               : std::vector<unsigned>{0,   0,   3, 0xc7, 0, 0, 3, 0xc2, 0, 0, 0, 1, 255, 255,
                                       255, 255, 0, 0,    0, 2, 0, 0,    0, 0, 0, 0, 0,   0};
    for (std::size_t k = 0; k < rest.size(); ++k) expected[24 + k] = std::byte(rest[k]);
    dds::filter_discovery(packet);
    CHECK(packet == expected);
    CHECK(dds::is_well_formed(packet));
  }
}

TEST_CASE("parameters that nobody needs are hidden") {
  const Bytes packet = endpoint(1, 8, 1, 1);
  Bytes copy = packet;
  dds::filter_discovery(copy);
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
  CHECK(admits(gate, header(7000), start));
  Bytes message = header(7000);
  append_data(message, 0x03, 0x0001);  // of a topic
  REQUIRE(dds::is_well_formed(message));
  CHECK(admits(gate, message, start));
}
