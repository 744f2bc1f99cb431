// SPDX-License-Identifier: Apache-2.0
// Fragments of which several come in one part of a packet, as Cyclone DDS sends them.
#include <articula/ros2/dds/packets/split_fragments.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "catch.hpp"
#include "cyclone_peer.hpp"
#include "support.hpp"

using namespace articula::ros2;
using namespace articula::ros2::test;

namespace {

using Bytes = std::vector<std::byte>;

void append(Bytes& bytes, const std::vector<unsigned>& values) {
  for (const unsigned value : values) bytes.push_back(static_cast<std::byte>(value));
}
void append_number(Bytes& bytes, std::size_t size, std::uint32_t value, bool little) {
  for (std::size_t k = 0; k < size; ++k) {
    bytes.push_back(static_cast<std::byte>(value >> (8 * (little ? k : size - 1 - k)) & 255U));
  }
}
std::byte content(std::size_t place) { return static_cast<std::byte>(place * 7 % 251); }

/// Fragments of a message in one part.
struct Run {
  std::uint32_t first = 3, count = 4, size = 100, total = 570;
  std::size_t lacks = 0;  ///< bytes
  unsigned writer = 3;    ///< the last byte of its entity
  bool little = true;
};
/// A packet with a time, fragments, and a heartbeat.
Bytes packet_of(const Run& run) {
  Bytes packet;
  append(packet, {'R', 'T', 'P', 'S', 2, 3, 1, 15, 1, 15, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9});
  append(packet, {0x09, 1, 8, 0, 1, 2, 3, 4, 5, 6, 7, 8});
  Bytes body;
  append(body, {0, 0});
  append_number(body, 2, 28, run.little);
  append(body, {0, 0, 0, 4, 0, 0, 1, run.writer});
  append_number(body, 4, 0, run.little);
  append_number(body, 4, 5, run.little);
  append_number(body, 4, run.first, run.little);
  append_number(body, 2, run.count, run.little);
  append_number(body, 2, run.size, run.little);
  append_number(body, 4, run.total, run.little);
  const std::size_t begin = (run.first - 1) * std::size_t{run.size};
  const std::size_t end = std::min<std::size_t>(begin + run.count * run.size, run.total);
  for (std::size_t k = begin; k + run.lacks < end; ++k) body.push_back(content(k));
  body.resize((body.size() + 3) / 4 * 4);
  append(packet, {0x16, run.little ? 1U : 0U});
  append_number(packet, 2, static_cast<std::uint32_t>(body.size()), run.little);
  packet.insert(packet.end(), body.begin(), body.end());
  append(packet, {0x07, 1, 28, 0, 0, 0, 0, 4, 0, 0, 1, 3, 0, 0, 0, 0, 1, 0, 0, 0});
  append(packet, {0, 0, 0, 0, 5, 0, 0, 0, 1, 0, 0, 0});
  return packet;
}

}  // namespace

TEST_CASE("fragments of one part get parts of their own, and other parts stay") {
  for (const Run& run : std::vector<Run>{{}, {.little = false}, {.size = 101}}) {
    const bool little = run.little;
    const Bytes packet = packet_of(run);
    CHECK_FALSE(dds::is_well_formed(packet));
    const auto split = dds::split_fragments(packet);
    REQUIRE(split);
    REQUIRE(dds::is_well_formed(*split));
    std::vector<std::uint32_t> kinds, numbers;
    dds::for_each_part(*split, [&](std::uint32_t kind, std::uint32_t, dds::Packet part) {
      kinds.push_back(kind);
      if (kind != dds::detail::fragment_part) return true;
      numbers.push_back(dds::detail::number_at(part, 20, 4, little));
      CHECK(dds::detail::number_at(part, 24, 2, little) == 1);
      const std::size_t begin = (numbers.back() - 1) * std::size_t{run.size};
      const std::size_t length = std::min<std::size_t>(run.size, run.total - begin);
      REQUIRE(part.size() == 32 + (length + 3) / 4 * 4);
      for (std::size_t k = 0; k < length; ++k) CHECK(part[32 + k] == content(begin + k));
      return true;
    });
    CHECK(kinds == std::vector<std::uint32_t>{0x09, 0x16, 0x16, 0x16, 0x16, 0x07});
    CHECK(numbers == std::vector<std::uint32_t>{3, 4, 5, 6});
  }
}

TEST_CASE("packets whose fragments are alone, or not as they say, stay as they are") {
  for (const Run& run : std::vector<Run>{{.count = 1},
                                         {.count = 0},
                                         {.count = 5},  // the message has six
                                         {.lacks = 40},
                                         {.size = 4, .total = 40},
                                         {.writer = 0xc2}}) {
    CAPTURE(run.first, run.count, run.size, run.lacks);
    CHECK_FALSE(dds::split_fragments(packet_of(run)));
  }
  Bytes packet = packet_of({});
  const std::size_t count = 20 + 12 + 4 + 24;
  packet[count + 1] = std::byte{0xff};  // 65,284 fragments
  CHECK_FALSE(dds::split_fragments(packet));
  for (const auto first : {std::byte{0}, std::byte{0xff}}) {  // no number, and the last one
    packet = packet_of({});
    for (std::size_t k = 0; k < 4; ++k) packet[count - 4 + k] = first;
    CHECK_FALSE(dds::split_fragments(packet));
  }
  packet = packet_of({});
  for (std::size_t size = 0; size < packet.size(); ++size) {  // cut anywhere
    const auto split = dds::split_fragments(std::span(packet).first(size));
    CHECK((!split || dds::is_well_formed(*split)));
  }
}

TEST_CASE("large messages of Cyclone DDS are heard although nobody asks for them again") {
  FastDdsTransport transport({.domain = domain()});
  CyclonePeer peer(domain());
  std::vector<std::string> texts;
  transport.subscribe(text_topic("/arm/text", quality_of_service::sensor_data),
                      [&](Sample sample) { texts.push_back(text_of(sample)); });
  const int writer = peer.make_writer("rt/arm/text", false);
  REQUIRE(poll_until(transport, [&] { return peer.matches_of_writer(writer) == 1; }));
  const std::string large(30'000, 'y');  // 23 fragments
  REQUIRE(poll_until(transport, [&] {
    peer.write(writer, large);  // a busy machine may lose some
    poll_for(transport, std::chrono::milliseconds(50));
    return !texts.empty();
  }));
  CHECK(texts[0] == large);
}
