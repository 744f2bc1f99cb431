// SPDX-License-Identifier: Apache-2.0
#include "catch.hpp"
#include "cyclone_peer.hpp"
#include "support.hpp"

#include <memory>
#include <string>
#include <vector>

using namespace articula::ros2;
using namespace articula::ros2::test;

namespace {
constexpr QualityOfService reliable{.transient_local = false, .depth = 10};
constexpr QualityOfService latched{.transient_local = true, .depth = 1};
}  // namespace

TEST_CASE("a peer of another vendor reads what is written, also in fragments") {
  FastDdsTransport transport({.domain = domain()});
  CyclonePeer peer(domain());
  const auto writer = transport.advertise(text_topic("/arm/text", reliable));
  const int reader = peer.make_reader("rt/arm/text", false);
  REQUIRE(poll_until(
      transport, [&] { return writer->readers() == 1 && peer.matches_of_reader(reader) == 1; }));
  const std::string large(300'000, 'x');
  for (const std::string& text : {std::string("one"), large, std::string()}) {
    writer->write(text_bytes(text));
  }
  std::vector<std::string> texts;
  REQUIRE(poll_until(transport, [&] {
    for (const std::string& text : peer.take(reader)) texts.push_back(text);
    return texts.size() == 3;
  }));
  CHECK(texts[0] == "one");
  CHECK(texts[1] == large);
  CHECK(texts[2].empty());
}

TEST_CASE("what a peer of another vendor writes arrives in its order, also in fragments") {
  FastDdsTransport transport({.domain = domain()});
  CyclonePeer peer(domain());
  std::vector<std::string> texts;
  transport.subscribe(text_topic("/arm/text", reliable),
                      [&](Sample sample) { texts.push_back(text_of(sample)); });
  const int writer = peer.make_writer("rt/arm/text", false);
  REQUIRE(poll_until(transport, [&] { return peer.matches_of_writer(writer) == 1; }));
  const std::string large(300'000, 'y');
  const std::vector<std::string> sent{"one", large, "three"};
  for (const std::string& text : sent) peer.write(writer, text);
  REQUIRE(poll_until(transport, [&] { return texts.size() >= 3; }));
  CHECK(texts == sent);
}

TEST_CASE("late readers get the last message of a transient local writer") {
  FastDdsTransport transport({.domain = domain()});
  CyclonePeer peer(domain());
  const auto latched_writer = transport.advertise(text_topic("/robot_description", latched));
  const auto volatile_writer = transport.advertise(text_topic("/states", reliable));
  for (const char* text : {"old", "new"}) {
    latched_writer->write(text_bytes(text));
    volatile_writer->write(text_bytes(text));
  }
  const int late = peer.make_reader("rt/robot_description", true);
  const int volatile_reader = peer.make_reader("rt/states", false);
  std::vector<std::string> texts;
  REQUIRE(poll_until(transport, [&] {
    for (const std::string& text : peer.take(late)) texts.push_back(text);
    return !texts.empty() && volatile_writer->readers() == 1 &&
           peer.matches_of_reader(volatile_reader) == 1;
  }));
  volatile_writer->write(text_bytes("after the match"));
  std::vector<std::string> states;
  REQUIRE(poll_until(transport, [&] {
    for (const std::string& text : peer.take(volatile_reader)) states.push_back(text);
    return !states.empty();
  }));
  CHECK(texts == std::vector<std::string>{"new"});
  CHECK(states == std::vector<std::string>{"after the match"});
}

TEST_CASE("late readers get no message whose lifespan is over") {
  FastDdsTransport transport({.domain = domain()});
  const auto writer = transport.advertise(text_topic(
      "/arm/log", {.transient_local = true, .depth = 10, .lifespan = std::chrono::seconds(1)}));
  writer->write(text_bytes("old"));
  poll_for(transport, std::chrono::milliseconds(1100));
  CyclonePeer peer(domain());
  const int reader = peer.make_reader("rt/arm/log", true);
  REQUIRE(poll_until(
      transport, [&] { return writer->readers() == 1 && peer.matches_of_reader(reader) == 1; }));
  writer->write(text_bytes("new"));
  std::vector<std::string> texts;
  REQUIRE(poll_until(transport, [&] {
    for (const std::string& text : peer.take(reader)) texts.push_back(text);
    return !texts.empty() && texts.back() == "new";
  }));
  CHECK(texts.size() == 1);
}

TEST_CASE("a late subscription gets the last message of a transient local peer") {
  FastDdsTransport transport({.domain = domain()});
  CyclonePeer peer(domain());
  const int writer = peer.make_writer("rt/robot_description", true);
  peer.write(writer, "urdf");
  poll_for(transport, std::chrono::milliseconds(50));
  std::vector<std::string> texts;
  transport.subscribe(text_topic("/robot_description", latched),
                      [&](Sample sample) { texts.push_back(text_of(sample)); });
  REQUIRE(poll_until(transport, [&] { return !texts.empty(); }));
  CHECK(texts == std::vector<std::string>{"urdf"});
}

TEST_CASE("two transports of one process meet in one domain") {
  FastDdsTransport left({.domain = domain()});
  FastDdsTransport right({.domain = domain()});
  std::vector<std::string> texts;
  right.subscribe(text_topic("/right/text", reliable),
                  [&](Sample sample) { texts.push_back("right: " + text_of(sample)); });
  right.subscribe(text_topic("/tf", reliable),
                  [&](Sample sample) { texts.push_back("tf: " + text_of(sample)); });
  const auto text = left.advertise(text_topic("/left/text", reliable));
  const auto tf = left.advertise(text_topic("/tf", reliable));
  REQUIRE(poll_until(left, [&] { return tf->readers() == 1; }));
  poll_for(right, std::chrono::milliseconds(100));
  text->write(text_bytes("left's own"));
  tf->write(text_bytes("everyone's"));
  REQUIRE(poll_until(right, [&] { return !texts.empty(); }));
  CHECK(texts == std::vector<std::string>{"tf: everyone's"});
  CHECK(text->readers() == 0);
}

TEST_CASE("a writer ends before or after its transport") {
  CyclonePeer peer(domain());
  const int reader = peer.make_reader("rt/arm/text", false);
  auto transport = std::make_unique<FastDdsTransport>(FastDdsOptions{.domain = domain()});
  auto writer = transport->advertise(text_topic("/arm/text", reliable));
  REQUIRE(poll_until(*transport, [&] { return peer.matches_of_reader(reader) == 1; }));
  writer.reset();
  REQUIRE(poll_until(*transport, [&] { return peer.matches_of_reader(reader) == 0; }));
  writer = transport->advertise(text_topic("/arm/text", reliable));
  transport.reset();
  CHECK(writer->readers() == 0);
  writer->write(text_bytes("nobody"));
  CHECK(peer.take(reader).empty());
}
