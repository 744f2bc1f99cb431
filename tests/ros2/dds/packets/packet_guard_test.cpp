// SPDX-License-Identifier: Apache-2.0
// Numbers of messages without long steps, in both directions.
#include <articula/ros2/dds/packets/packet_guard.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "catch.hpp"

using namespace articula::ros2;
using dds::Budget;
using dds::PacketGuard;
using dds::WriterNumbers;

namespace {

using Bytes = std::vector<std::byte>;

constexpr std::uint64_t high = WriterNumbers::high, longest = WriterNumbers::longest,
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

TEST_CASE("numbers of writers that are found early stay as they are") {
  WriterNumbers numbers;
  Budget budget(longest, longest);
  for (std::uint64_t number = 1; number < 3 * high; ++number) {
    REQUIRE(numbers.of_message(number, budget, now) == number);
  }
  CHECK(numbers.of_message(5, budget, now) == 5);
  CHECK(numbers.acknowledge(2 * high) == 2 * high);
  CHECK(numbers.of_beginning(2 * high - 9, budget, now) == 2 * high - 9);
  CHECK(numbers.of_end(huge) == huge);
  CHECK_FALSE(numbers.of_message(0, budget, now));
}

TEST_CASE("the first heartbeat of a writer with high numbers decides their offset for good") {
  WriterNumbers numbers;
  Budget budget(longest, longest);
  CHECK_FALSE(numbers.of_message(huge + 9, budget, now));  // comes again
  CHECK_FALSE(numbers.of_gap(huge, huge + 5, budget, now));
  CHECK(numbers.of_beginning(huge, budget, now) == 1);
  CHECK(numbers.of_end(huge + 9) == 10);
  CHECK(numbers.of_message(huge + 9, budget, now) == 10);
  CHECK(numbers.of_message(huge, budget, now) == 1);
  CHECK_FALSE(numbers.of_message(huge - 1, budget, now));
  CHECK(numbers.acknowledge(11) == huge + 10);
  CHECK(numbers.original(10) == huge + 9);
}

TEST_CASE("numbers begin where Fast DDS was before the first heartbeat") {
  WriterNumbers numbers;
  Budget budget(longest, longest);
  CHECK(numbers.acknowledge(500) == 500);
  CHECK(numbers.of_beginning(huge, budget, now) == 500);
  CHECK(numbers.of_message(huge + 1, budget, now) == 501);
}

TEST_CASE("a writer without heartbeats gets its offset by a message, after a time") {
  WriterNumbers numbers;
  Budget budget(longest, longest);
  CHECK_FALSE(numbers.of_message(huge, budget, now));
  CHECK_FALSE(numbers.of_message(huge + 1, budget, now + WriterNumbers::patience / 2));
  const auto late = now + WriterNumbers::patience;
  CHECK(numbers.of_message(huge + 2, budget, late) == WriterNumbers::margin);
  CHECK(numbers.of_message(huge + 3, budget, late) == WriterNumbers::margin + 1);
}

TEST_CASE("heartbeats and messages lead on by what the budget has, and by what was acknowledged") {
  WriterNumbers numbers;
  Budget budget(longest, longest);
  REQUIRE(numbers.of_beginning(1, budget, now) == 1);
  CHECK(numbers.of_beginning(huge, budget, now) == longest + 1);
  CHECK(numbers.of_beginning(huge, budget, now) == longest + 1);  // nothing is left
  const auto later = now + std::chrono::seconds(1);
  CHECK(numbers.of_beginning(huge, budget, later) == longest + 1);  // nobody has got that far
  numbers.acknowledge(longest + 1);
  CHECK(numbers.of_beginning(huge, budget, later) == 2 * longest + 1);
  numbers.acknowledge(2 * longest + 1);
  CHECK(numbers.of_beginning(huge, budget, later) == 2 * longest + 1);
  CHECK_FALSE(numbers.of_message(huge, budget, later));
  CHECK(numbers.of_message(WriterNumbers::free_step, budget, later) == WriterNumbers::free_step);
}

TEST_CASE("a gap is so long that Fast DDS need not note many of its numbers") {
  WriterNumbers numbers;
  Budget budget(longest, longest);
  using Gap = WriterNumbers::Gap;
  const auto is = [](const std::optional<Gap>& gap, std::uint64_t begin, std::uint64_t end) {
    return gap && gap->begin == begin && gap->end == end;
  };
  numbers.acknowledge(11);
  CHECK(is(numbers.of_gap(11, 20, budget, now), 11, 20));
  CHECK(is(numbers.of_gap(11, 5000, budget, now), 11, 5000));  // leads on: nothing is noted
  CHECK(is(numbers.of_gap(12, 20, budget, now), 12, 20));      // behind a hole
  CHECK(is(numbers.of_gap(12, huge, budget, now), 12, 10 + ahead));
  CHECK_FALSE(numbers.of_gap(10 + ahead, huge, budget, now));
  CHECK_FALSE(numbers.of_gap(12, 12, budget, now));
  const auto most = numbers.of_gap(11, huge, budget, now);
  REQUIRE(most);
  CHECK(most->end < 11 + longest);  // what the budget has left
  CHECK(most->end > 11 + longest / 2);
  CHECK(is(numbers.of_gap(11, huge, budget, now), 11, 11 + WriterNumbers::free_step));
  CHECK(numbers.is_near(10 + ahead));
  CHECK_FALSE(numbers.is_near(11 + ahead));
}

TEST_CASE("packets of a writer that has been there for long have small numbers") {
  for (const bool little : {true, false}) {
    INFO(little);
    PacketGuard guard;
    introduce(guard);
    Bytes early = message(huge + 10, little);
    REQUIRE(guard.receive(early, now));
    CHECK(early[20] == padding);  // comes again
    Bytes heartbeat = with_two(0x07, huge, huge + 9, little);
    REQUIRE(guard.receive(heartbeat, now));
    CHECK(number_at(heartbeat, of_first, little) == 1);
    CHECK(number_at(heartbeat, of_second, little) == 10);
    Bytes next = message(huge + 10, little);
    REQUIRE(guard.receive(next, now));
    CHECK(number_at(next, of_message, little) == 11);
    for (const unsigned kind : {0x06U, 0x12U}) {
      Bytes answer = acknowledgement(4, little, kind);
      REQUIRE(PacketGuard::has_acknowledgement(answer));
      guard.send(answer);
      CHECK(number_at(answer, of_acknowledgement, little) == huge + 3);
    }
    // Fast DDS has all before 4.
    Bytes gap = with_two(0x08, huge + 3, huge + 3 + 1000, little);
    REQUIRE(guard.receive(gap, now));
    CHECK(number_at(gap, of_first, little) == 4);
    CHECK(number_at(gap, of_second, little) == 1004);
    Bytes far = with_two(0x08, huge + 3 + ahead, huge + 9 + ahead, little);
    CHECK(guard.receive(far, now));
    CHECK(far[20] == padding);
    PacketGuard::Guid guid{};
    for (std::size_t k = 0; k < prefix.size(); ++k) guid[k] = static_cast<std::byte>(prefix[k]);
    guid[14] = std::byte{1};
    guid[15] = std::byte{writer};
    CHECK(guard.original(guid, 11) == huge + 10);
    guid[14] = std::byte{2};
    CHECK(guard.original(guid, 11) == 11);  // nobody knows it
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
