// SPDX-License-Identifier: Apache-2.0
// Messages that wait for others or for their fragments keep no other message away.
#include "catch.hpp"
#include "cyclone_peer.hpp"
#include "fast_dds_peer.hpp"
#include "support.hpp"

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

using namespace articula::ros2;
using namespace articula::ros2::test;

namespace {

constexpr QualityOfService quality{.transient_local = false, .depth = 5000};
const std::string type = "std_msgs::msg::dds_::String_";

// A transport and the texts that have come to it.
struct Listener {
  FastDdsTransport transport;
  std::vector<std::string> texts{};

  explicit Listener(std::size_t largest_message = 1 << 20)
      : transport({.domain = domain(), .largest_message = largest_message}) {
    transport.subscribe(text_topic("/text", quality),
                        [this](Sample sample) { texts.push_back(text_of(sample)); });
  }
  bool hears(FastDdsPeer& peer, std::size_t writer) {
    return poll_until(transport, [&] { return peer.matches_of_writer(writer) == 1; });
  }
};

std::vector<std::string> numbers(int count) {
  std::vector<std::string> texts;
  for (int k = 0; k < count; ++k) texts.push_back(std::to_string(k));
  return texts;
}

}  // namespace

TEST_CASE("while the first of many messages is missing, other writers are heard") {
  talk_over_udp_only();
  Listener listener;
  const auto loses = [](std::uint32_t message, std::uint32_t) { return message == 1; };
  FastDdsPeer losing(domain(), {.depth = 3000, .loses = loses}), other(domain());
  const std::size_t lost = losing.make_writer("rt/text", type),
                    heard = other.make_writer("rt/text", type);
  REQUIRE(listener.hears(losing, lost));
  REQUIRE(listener.hears(other, heard));
  for (int k = 0; k < 2000; ++k) {  // more than wait
    losing.write(lost, text_bytes("behind"));
    if (k % 20 == 0) poll_for(listener.transport, std::chrono::milliseconds(1));
  }
  CHECK(listener.texts.empty());
  const std::vector<std::string> sent = numbers(100);
  for (const std::string& text : sent) other.write(heard, text_bytes(text));
  poll_until(listener.transport, [&] { return listener.texts.size() >= sent.size(); });
  CHECK(listener.texts == sent);
}

TEST_CASE("all messages come in order if every tenth is lost at first") {
  talk_over_udp_only();
  Listener listener;
  std::set<std::uint32_t> were_lost;
  const auto loses = [&](std::uint32_t message, std::uint32_t) {
    return message % 10 == 1 && were_lost.insert(message).second;
  };
  FastDdsPeer peer(domain(), {.depth = 3000, .loses = loses});
  const std::size_t writer = peer.make_writer("rt/text", type);
  REQUIRE(listener.hears(peer, writer));
  const std::vector<std::string> sent = numbers(2000);
  for (const std::string& text : sent) peer.write(writer, text_bytes(text));
  poll_until(listener.transport, [&] { return listener.texts.size() >= sent.size(); });
  CHECK(listener.texts == sent);
}

TEST_CASE("messages of which a fragment never comes make room for others") {
  talk_over_udp_only();
  Listener listener;
  const auto loses = [](std::uint32_t, std::uint32_t fragment) { return fragment == 2; };
  FastDdsPeer losing(domain(), {.loses = loses}), other(domain());
  for (int k = 0; k < 12; ++k) {  // more bytes than the messages of a topic may take
    const std::size_t writer = losing.make_writer("rt/text", type);
    REQUIRE(listener.hears(losing, writer));
    losing.write(writer, text_bytes(std::string(1'000'000, 'x')));
  }
  poll_for(listener.transport, std::chrono::milliseconds(200));
  CHECK(listener.texts.empty());
  const std::size_t heard = other.make_writer("rt/text", type);
  REQUIRE(listener.hears(other, heard));
  const std::vector<std::string> sent{"small", std::string(1'000'000, 'y'), "last"};
  for (const std::string& text : sent) other.write(heard, text_bytes(text));
  poll_until(listener.transport, [&] { return listener.texts.size() >= sent.size(); });
  CHECK(listener.texts == sent);
}

TEST_CASE("a message that is too large is passed over, whole or in fragments") {
  talk_over_udp_only();
  const auto size = GENERATE(std::size_t{20'000}, std::size_t{200'000});
  Listener listener(10'000);
  FastDdsPeer fast(domain());
  CyclonePeer cyclone(domain());
  const std::size_t writer = fast.make_writer("rt/text", type);
  const int cyclone_writer = cyclone.make_writer("rt/text", false);
  REQUIRE(listener.hears(fast, writer));
  REQUIRE(poll_until(listener.transport,
                     [&] { return cyclone.matches_of_writer(cyclone_writer) == 1; }));
  for (const std::string& text :
       {std::string("one"), std::string(size, 'x'), std::string("three")}) {
    fast.write(writer, text_bytes(text));
    cyclone.write(cyclone_writer, text);
  }
  poll_until(listener.transport, [&] { return listener.texts.size() >= 4; });
  std::multiset<std::string> all(listener.texts.begin(), listener.texts.end());
  CHECK(all == std::multiset<std::string>{"one", "one", "three", "three"});
}
