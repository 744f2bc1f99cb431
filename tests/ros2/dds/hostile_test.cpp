// SPDX-License-Identifier: Apache-2.0
#include "catch.hpp"
#include "cyclone_peer.hpp"
#include "fast_dds_peer.hpp"
#include "support.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace articula::ros2;
using namespace articula::ros2::test;

namespace {

constexpr QualityOfService reliable{.transient_local = false, .depth = 100};

Bytes random_bytes(std::mt19937& random, std::size_t size) {
  Bytes bytes(size);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
  return bytes;
}

// Bytes that begin as a message of RTPS, with parts whose kinds and receivers exist.
Bytes random_packet(std::mt19937& random) {
  constexpr std::array<unsigned, 12> kinds{0x01, 0x06, 0x07, 0x08, 0x09, 0x0c,
                                           0x0e, 0x0f, 0x12, 0x13, 0x15, 0x16};
  // Readers and writers of the discovery of participants, writers and readers; of users.
  constexpr std::array<std::uint32_t, 8> entities{0x000100c7, 0x000100c2, 0x000003c2, 0x000003c7,
                                                  0x000004c2, 0x000004c7, 0x00000104, 0x00000203};
  Bytes bytes;
  const auto put = [&](std::initializer_list<unsigned> values) {
    for (const unsigned value : values) bytes.push_back(static_cast<std::byte>(value));
  };
  put({'R', 'T', 'P', 'S', 2, 3, 1, 0x0f});
  const Bytes prefix = random_bytes(random, 12);
  bytes.insert(bytes.end(), prefix.begin(), prefix.end());
  for (unsigned part = random() % 4; part < 4; ++part) {
    Bytes body = random_bytes(random, 4 * (random() % 40));
    if (random() % 2 == 0 && body.size() >= 12) {
      for (std::size_t at : {std::size_t{4}, std::size_t{8}}) {
        const std::uint32_t entity = entities[random() % entities.size()];
        for (std::size_t i = 0; i < 4; ++i) {
          body[at + i] = static_cast<std::byte>(entity >> (24 - 8 * i));
        }
      }
    }
    const std::size_t stated = random() % 8 == 0 ? random() % 65536 : body.size();
    put({kinds[random() % kinds.size()], static_cast<unsigned>(random() % 16),
         static_cast<unsigned>(stated % 256), static_cast<unsigned>(stated / 256)});
    bytes.insert(bytes.end(), body.begin(), body.end());
  }
  return bytes;
}

}  // namespace

TEST_CASE("a writer whose announcement comes in fragments holds up no other one") {
  FastDdsTransport transport({.domain = domain()});
  CyclonePeer peer(domain());
  std::vector<std::string> texts;
  const auto note = [&](Sample sample) { texts.push_back(text_of(sample)); };
  transport.subscribe(text_topic("/large", reliable), note);
  transport.subscribe(text_topic("/after", reliable), note);
  const int large = peer.make_writer("rt/large", false, 5000);
  const int after = peer.make_writer("rt/after", false);
  REQUIRE(poll_until(transport, [&] {
    return peer.matches_of_writer(large) == 1 && peer.matches_of_writer(after) == 1;
  }));
  peer.write(large, "not heard");
  peer.write(after, "heard");
  REQUIRE(poll_until(transport, [&] { return !texts.empty(); }));
  poll_for(transport, std::chrono::milliseconds(50));
  CHECK(texts == std::vector<std::string>{"heard"});
}

TEST_CASE("any bytes reach a topic's function as they are, and those after them, too") {
  talk_over_udp_only();
  FastDdsTransport transport({.domain = domain()});
  FastDdsPeer peer(domain());
  std::vector<Bytes> received;
  transport.subscribe(text_topic("/text", reliable),
                      [&](Sample sample) { received.emplace_back(sample.begin(), sample.end()); });
  const std::size_t writer = peer.make_writer("rt/text", "std_msgs::msg::dds_::String_");
  REQUIRE(poll_until(transport, [&] { return peer.matches_of_writer(writer) == 1; }));
  std::mt19937 random(1);
  std::vector<Bytes> sent;
  for (std::size_t size = 1; size <= 60; ++size) {
    sent.push_back(random_bytes(random, size));
    peer.write(writer, sent.back());
    sent.back().resize((size + 3) / 4 * 4);  // RTPS pads
  }
  REQUIRE(poll_until(transport, [&] { return received.size() >= sent.size(); }));
  CHECK(received == sent);
}

TEST_CASE("a message that is too large arrives nowhere, and others' messages arrive") {
  talk_over_udp_only();
  FastDdsTransport transport({.domain = domain(), .largest_message = 100'000});
  FastDdsPeer hostile(domain()), peer(domain());
  std::vector<std::size_t> sizes;
  transport.subscribe(text_topic("/text", reliable),
                      [&](Sample sample) { sizes.push_back(sample.size()); });
  const std::size_t large = hostile.make_writer("rt/text", "std_msgs::msg::dds_::String_");
  const std::size_t writer = peer.make_writer("rt/text", "std_msgs::msg::dds_::String_");
  REQUIRE(poll_until(transport, [&] {
    return hostile.matches_of_writer(large) == 1 && peer.matches_of_writer(writer) == 1;
  }));
  peer.write(writer, Bytes(100'000));  // the largest that is allowed
  REQUIRE(poll_until(transport, [&] { return sizes.size() == 1; }));
  hostile.write(large, Bytes(2'000'000));
  hostile.write(large, Bytes(100'004));
  peer.write(writer, Bytes(8));
  REQUIRE(poll_until(transport, [&] { return sizes.size() == 2; }));
  poll_for(transport, std::chrono::milliseconds(200));
  CHECK(sizes == std::vector<std::size_t>{100'000, 8});
}

TEST_CASE("peers that listen to the same group hear a topic") {
  talk_over_udp_only();
  FastDdsTransport transport({.domain = domain()});
  const auto writer = transport.advertise(text_topic("/text", reliable));
  FastDdsPeer::Options options;
  options.joins_group = true;
  FastDdsPeer first(domain(), options), second(domain(), options);
  const std::string type = "std_msgs::msg::dds_::String_";
  const std::size_t in_first = first.make_reader("rt/text", type),
                    in_second = second.make_reader("rt/text", type);
  // Fast DDS 2.9.1 would end the program at the second one.
  REQUIRE(poll_until(transport, [&] {
    return writer->readers() == 2 && first.matches_of_reader(in_first) == 1 &&
           second.matches_of_reader(in_second) == 1;
  }));
  for (int k = 0; k < 10; ++k) writer->write(text_bytes(std::to_string(k)));
  std::size_t heard_by_first = 0, heard_by_second = 0;
  CHECK(poll_until(transport, [&] {
    heard_by_first += first.take(in_first).size();
    heard_by_second += second.take(in_second).size();
    return heard_by_first == 10 && heard_by_second == 10;
  }));
}

TEST_CASE("requests of any bytes in both dialects do not keep a service from others") {
  talk_over_udp_only();
  FastDdsTransport transport({.domain = domain()});
  std::size_t requests = 0;
  ServiceEndpoint service = trigger_service("/arm/trigger");
  service.quality = reliable;
  transport.serve(service, [&](Sample, const ReplySender& reply) {
    ++requests;
    reply(bytes_of(Trigger::Response{.success = true, .message = "right"}));
    reply({});
  });
  std::mt19937 random(2);
  FastDdsPeer fast(domain()), cyclone(domain(), {.poses_as_cyclone = true});
  const auto request_type = "std_srvs::srv::dds_::Trigger_Request_",
             response_type = "std_srvs::srv::dds_::Trigger_Response_";
  // Those of Cyclone DDS without the 16 bytes of the dialect, padded, are no requests.
  std::size_t expected = 0;
  for (auto [peer, counted] : {std::pair(&fast, 2 * 40), std::pair(&cyclone, 2 * 24)}) {
    const std::size_t writer = peer->make_writer("rq/arm/triggerRequest", request_type);
    const std::size_t reader = peer->make_reader("rr/arm/triggerReply", response_type);
    REQUIRE(poll_until(transport, [&] {
      return peer->matches_of_writer(writer) == 1 && peer->matches_of_reader(reader) == 1;
    }));
    for (std::size_t size = 1; size <= 40; ++size) {
      peer->write(writer, random_bytes(random, size));  // names no reader
      peer->request(writer, reader, random_bytes(random, size));
      transport.poll(std::chrono::milliseconds(0));
    }
    // At most 100 requests wait for `poll`, so the next peer waits for these.
    expected += static_cast<std::size_t>(counted);
    REQUIRE(poll_until(transport, [&] { return requests == expected; }));
  }

  CyclonePeer client(domain());
  client.make_reply_reader("/arm/trigger");
  client.make_request_writer("/arm/trigger");
  REQUIRE(poll_until(transport, [&] { return client.finds_service(); }));
  client.request(5);
  std::optional<CyclonePeer::Reply> reply;
  REQUIRE(poll_until(transport, [&] { return (reply = client.take_reply()).has_value(); }));
  CHECK(reply->message == "right");
}

TEST_CASE("packets of any bytes do not keep the transport from its peers") {
  FastDdsTransport transport({.domain = domain()});
  std::vector<std::string> texts;
  transport.subscribe(text_topic("/text", reliable),
                      [&](Sample sample) { texts.push_back(text_of(sample)); });
  // The ports of the first participants of the domain, for discovery and for users in turn.
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  std::mt19937 random(3);
  for (unsigned i = 0; i < 5'000; ++i) {
    const Bytes packet = random_packet(random);
    for (unsigned port = 0; port < 16; ++port) {
      sockaddr_in to{};
      to.sin_family = AF_INET;
      to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      to.sin_port = htons(static_cast<std::uint16_t>(7410 + 250 * domain() + port));
      ::sendto(socket, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&to),
               sizeof to);
    }
    if (i % 100 == 0) transport.poll(std::chrono::milliseconds(1));
  }
  ::close(socket);
  CyclonePeer peer(domain());
  const int writer = peer.make_writer("rt/text", false);
  REQUIRE(poll_until(transport, [&] { return peer.matches_of_writer(writer) == 1; }));
  peer.write(writer, "still here");
  REQUIRE(poll_until(transport, [&] { return !texts.empty(); }));
  CHECK(texts == std::vector<std::string>{"still here"});
}
