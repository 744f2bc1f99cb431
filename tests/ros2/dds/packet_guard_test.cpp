// SPDX-License-Identifier: Apache-2.0
// Numbers of messages without leaps, in both directions.
#include <articula/ros2/dds/packets/packet_guard.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "catch.hpp"

using namespace articula::ros2;
using dds::PacketGuard;
using dds::WriterNumbers;

namespace {

using Bytes = std::vector<std::byte>;

constexpr std::uint64_t step = WriterNumbers::longest_step, margin = WriterNumbers::margin,
                        ahead = WriterNumbers::ahead, huge = std::uint64_t{1} << 50;
constexpr PacketGuard::Time now{std::chrono::hours(1)};
constexpr std::byte padding{0x01};
constexpr unsigned writer = 3;  // of a participant, best effort or reliable

void append(Bytes& bytes, const std::vector<unsigned>& values) {
  for (const unsigned value : values) bytes.push_back(static_cast<std::byte>(value));
}
void append_number(Bytes& bytes, std::uint64_t value, bool little) {
  bytes.resize(bytes.size() + 8);
  dds::detail::put_sequence(bytes, bytes.size() - 8, little, value);
}
const std::vector<unsigned> prefix{1, 15, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9};

Bytes header() {
  Bytes bytes;
  append(bytes, {'R', 'T', 'P', 'S', 2, 3, 1, 15});
  append(bytes, prefix);
  return bytes;
}
void append_part(Bytes& bytes, unsigned kind, bool little, const Bytes& body) {
  const unsigned size = static_cast<unsigned>(body.size());
  append(bytes, {kind, little ? 1U : 0U, little ? size : 0, little ? 0 : size});
  bytes.insert(bytes.end(), body.begin(), body.end());
}
/// A writer is announced by a participant.
void introduce(PacketGuard& guard) {
  Bytes participant = header();
  append(participant, {0x15, 1, 20, 0, 0, 0, 16, 0, 0, 0, 0, 0, 0, 1, 0, 0xc2});
  append_number(participant, 1, true);
  REQUIRE(guard.receive(participant, now));
  Bytes own = header();
  append(own, {0x15, 5, 48, 0, 0, 0, 16, 0, 0, 0, 0, 0, 0, 0, 3, 0xc2});
  append_number(own, 1, true);
  append(own, {0, 3, 0, 0, 0x5a, 0, 16, 0});
  append(own, prefix);
  append(own, {0, 0, 1, writer, 1, 0, 0, 0});
  REQUIRE(guard.receive(own, now));
}
/// The parts of a packet have their numbers in these places.
Bytes message(std::uint64_t number, bool little) {
  Bytes body;
  append(body, {0, 0, little ? 16U : 0, little ? 0 : 16U, 0, 0, 0, 0, 0, 0, 1, writer});
  append_number(body, number, little);
  Bytes bytes = header();
  append_part(bytes, 0x15, little, body);
  return bytes;
}
Bytes with_two(unsigned kind, std::uint64_t first, std::uint64_t second, bool little) {
  Bytes body;
  append(body, {0, 0, 0, 0, 0, 0, 1, writer});
  append_number(body, first, little);
  append_number(body, second, little);
  append(body, {0, 0, 0, 0});
  Bytes bytes = header();
  append_part(bytes, kind, little, body);
  return bytes;
}
/// What Fast DDS sends to the participant.
Bytes acknowledgement(std::uint64_t next, bool little, unsigned kind = 0x06) {
  Bytes bytes;
  append(bytes, {'R', 'T', 'P', 'S', 2, 3, 1, 15, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7});
  Bytes destination;
  append(destination, prefix);
  append_part(bytes, 0x0e, little, destination);
  Bytes body;
  append(body, {0, 0, 2, 4, 0, 0, 1, writer});
  append_number(body, next, little);
  append(body, {0, 0, 0, 0, 1, 0, 0, 0});
  append_part(bytes, kind, little, body);
  return bytes;
}
std::uint64_t number_at(const Bytes& bytes, std::size_t at, bool little) {
  return dds::detail::sequence_at(bytes, at, little);
}
constexpr std::size_t of_message = 36, of_first = 32, of_second = 40, of_acknowledgement = 48;

}  // namespace

TEST_CASE("numbers that lead on stay as they are") {
  WriterNumbers numbers;
  for (const std::uint64_t number : {std::uint64_t{1}, std::uint64_t{2}, step, 2 * step, step}) {
    CHECK(numbers.of_message(number) == number);
    CHECK(numbers.acknowledge(number) == number);
  }
  CHECK(numbers.of_beginning(3) == 3);
  CHECK(numbers.of_end(huge) == huge);
  CHECK_FALSE(numbers.of_message(0));
}

TEST_CASE("behind a leap the numbers go on, and return as they were") {
  WriterNumbers numbers;
  REQUIRE(numbers.of_message(7) == 7);
  CHECK(numbers.of_beginning(huge) == 7 + margin);
  CHECK(numbers.of_end(huge + 5) == 7 + margin + 5);
  CHECK(numbers.of_message(huge + 6) == 7 + margin + 6);
  CHECK(numbers.of_message(huge - margin + 1) == 8);  // what comes late
  CHECK_FALSE(numbers.of_message(8));                 // from before the leap
  CHECK(numbers.of_beginning(8) == 1);
  CHECK(numbers.original(7 + margin + 6) == huge + 6);
  CHECK(numbers.acknowledge(7 + margin) == huge);
  CHECK(numbers.of_message(~std::uint64_t{0}).value() <= 2 * (7 + margin + step));
}

TEST_CASE("a reader that finds a writer again begins with small numbers") {
  WriterNumbers numbers;
  numbers.match(true);
  numbers.match(true);
  REQUIRE(numbers.of_message(step) == step);
  REQUIRE(numbers.of_message(2 * step) == 2 * step);
  numbers.match(false);
  CHECK(numbers.of_message(2 * step + 1) == 2 * step + 1);  // for the other reader
  numbers.match(false);
  CHECK(numbers.of_beginning(3 * step) == margin);
  CHECK(numbers.original(margin) == 3 * step);
  numbers.match(true);
  CHECK(numbers.of_message(3 * step + 1) == margin + 1);
}

TEST_CASE("a gap is so long that Fast DDS need not note many of its numbers") {
  WriterNumbers numbers;
  REQUIRE(numbers.of_message(10) == 10);
  numbers.acknowledge(11);
  CHECK(numbers.of_gap(11, 20) == 20);
  CHECK(numbers.of_gap(11, huge) == 11 + step);  // leads on: nothing is noted
  CHECK(numbers.of_gap(12, 20) == 20);           // behind a hole
  CHECK(numbers.of_gap(12, huge) == 10 + ahead);
  CHECK_FALSE(numbers.of_gap(10 + ahead, huge));
  CHECK_FALSE(numbers.of_gap(12, 12));
  CHECK(numbers.is_near(10 + ahead));
  CHECK_FALSE(numbers.is_near(11 + ahead));
}

TEST_CASE("packets of a writer that has been there for long have small numbers") {
  for (const bool little : {true, false}) {
    INFO(little);
    PacketGuard guard;
    introduce(guard);
    Bytes heartbeat = with_two(0x07, huge, huge + 9, little);
    REQUIRE(guard.receive(heartbeat, now));
    CHECK(number_at(heartbeat, of_first, little) == margin);
    CHECK(number_at(heartbeat, of_second, little) == margin + 9);
    Bytes next = message(huge + 10, little);
    REQUIRE(guard.receive(next, now));
    CHECK(number_at(next, of_message, little) == margin + 10);
    Bytes old = message(9, little);
    CHECK(guard.receive(old, now));
    CHECK(old[20] == padding);
    for (const unsigned kind : {0x06U, 0x12U}) {
      Bytes answer = acknowledgement(margin + 3, little, kind);
      REQUIRE(PacketGuard::has_acknowledgement(answer));
      guard.send(answer);
      CHECK(number_at(answer, of_acknowledgement, little) == huge + 3);
    }
    // Fast DDS has all before margin + 3.
    Bytes gap = with_two(0x08, huge + 3, huge + 3 + 2 * step, little);
    REQUIRE(guard.receive(gap, now));
    CHECK(number_at(gap, of_first, little) == margin + 3);
    CHECK(number_at(gap, of_second, little) == margin + 3 + step);
    Bytes far = with_two(0x08, huge + 3 + ahead, huge + 9 + ahead, little);
    CHECK(guard.receive(far, now));
    CHECK(far[20] == padding);
    PacketGuard::Guid guid{};
    for (std::size_t k = 0; k < prefix.size(); ++k) guid[k] = static_cast<std::byte>(prefix[k]);
    guid[14] = std::byte{1};
    guid[15] = std::byte{writer};
    CHECK(guard.original(guid, margin + 10) == huge + 10);
    guid[14] = std::byte{2};
    CHECK(guard.original(guid, margin + 10) == margin + 10);  // nobody knows it
  }
}

TEST_CASE("messages of discovery that are far ahead are hidden, and the rest of a packet is not") {
  for (const bool open : {false, true}) {  // the last part leaves its length out
    PacketGuard guard;
    introduce(guard);
    Bytes bytes = header();
    for (const std::uint64_t number : {std::uint64_t{2}, 2 + ahead}) {
      Bytes body;
      append(body, {0, 0, 16, 0, 0, 0, 0, 0, 0, 0, 3, 0xc2});
      append_number(body, number, true);
      append_part(bytes, 0x15, true, body);
    }
    if (open) bytes[46] = std::byte{0};
    REQUIRE(guard.receive(bytes, now));
    CHECK(bytes[20] == std::byte{0x15});
    CHECK(bytes[44] == padding);
    CHECK(bytes[46] == std::byte{20});  // or else readers would go on within it
    CHECK(dds::is_well_formed(bytes));
  }
}

TEST_CASE("numbers of writers that nobody knows stay as they are") {
  PacketGuard guard;
  for (Bytes bytes : {message(huge, true), with_two(0x07, huge, huge, true),
                      with_two(0x08, huge, huge + 1, true)}) {
    const Bytes before = bytes;
    CHECK(guard.receive(bytes, now));
    CHECK(bytes == before);
  }
  Bytes answer = acknowledgement(5, true);
  const Bytes before = answer;
  guard.send(answer);
  CHECK(answer == before);
}
