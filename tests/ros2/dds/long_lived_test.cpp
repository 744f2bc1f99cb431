// SPDX-License-Identifier: Apache-2.0
// Peers that have sent a lot before a transport begins: their numbers are high.
#include "catch.hpp"
#include "cyclone_peer.hpp"
#include "fast_dds_peer.hpp"
#include "support.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

using namespace articula::ros2;
using namespace articula::ros2::test;

namespace {

constexpr int before = 200'000;  // more than dds::WriterNumbers::longest_step

QualityOfService quality(bool best_effort) {
  return {.transient_local = false, .depth = 100, .best_effort = best_effort};
}

}  // namespace

TEST_CASE("a writer of another vendor that has written a lot is heard, also in fragments") {
  const bool best_effort = GENERATE(false, true);
  INFO(best_effort);
  CyclonePeer peer(domain());
  const int writer = peer.make_writer("rt/arm/text", false);
  for (int k = 0; k < before; ++k) peer.write(writer, "before");
  FastDdsTransport transport({.domain = domain()});
  std::vector<std::string> texts;
  transport.subscribe(text_topic("/arm/text", quality(best_effort)),
                      [&](Sample sample) { texts.push_back(text_of(sample)); });
  // A best-effort reader misses what is written before it knows the writer.
  REQUIRE(poll_until(transport, [&] {
    if (peer.matches_of_writer(writer) == 1) peer.write(writer, "probe");
    return !texts.empty();
  }));
  poll_for(transport, std::chrono::milliseconds(200));
  texts.clear();
  const std::string large(best_effort ? 1000 : 300'000, 'y');
  std::vector<std::string> sent{"one", large, "three"};
  for (int k = 0; k < 500; ++k) sent.push_back(std::to_string(k));
  for (const std::string& text : sent) {
    const std::size_t count = texts.size();
    peer.write(writer, text);
    REQUIRE(poll_until(transport, [&] { return texts.size() > count; }));
  }
  CHECK(texts == sent);
}

TEST_CASE("a writer of Fast DDS that has written a lot is heard") {
  talk_over_udp_only();
  FastDdsPeer peer(domain());
  const std::size_t writer = peer.make_writer("rt/arm/text", "std_msgs::msg::dds_::String_");
  for (int k = 0; k < before; ++k) peer.write(writer, text_bytes("before"));
  FastDdsTransport transport({.domain = domain()});
  std::vector<std::string> texts;
  transport.subscribe(text_topic("/arm/text", quality(false)),
                      [&](Sample sample) { texts.push_back(text_of(sample)); });
  REQUIRE(poll_until(transport, [&] { return peer.matches_of_writer(writer) == 1; }));
  std::vector<std::string> sent;
  for (int k = 0; k < 500; ++k) {
    sent.push_back(std::to_string(k));
    peer.write(writer, text_bytes(sent.back()));
    REQUIRE(poll_until(transport, [&] { return texts.size() >= sent.size(); }));
  }
  CHECK(texts == sent);
}

TEST_CASE("a client that has asked a lot gets replies with the numbers of its requests") {
  talk_over_udp_only();
  FastDdsPeer peer(domain());
  const std::size_t requests = peer.make_writer("rq/arm/triggerRequest",
                                                "std_srvs::srv::dds_::Trigger_Request_"),
                    replies = peer.make_reader("rr/arm/triggerReply",
                                               "std_srvs::srv::dds_::Trigger_Response_");
  const Bytes question = bytes_of(Trigger::Request{});
  std::int64_t number = 0;
  for (int k = 0; k < before; ++k) number = peer.request(requests, replies, question);
  CHECK(number == before);
  FastDdsTransport transport({.domain = domain()});
  transport.serve(trigger_service("/arm/trigger"), [&](Sample, const ReplySender& reply) {
    reply(bytes_of(Trigger::Response{.success = true, .message = "here"}));
  });
  REQUIRE(poll_until(transport, [&] {
    return peer.matches_of_writer(requests) == 1 && peer.matches_of_reader(replies) == 1;
  }));
  for (int k = 0; k < 3; ++k) {
    number = peer.request(requests, replies, question);
    std::vector<FastDdsPeer::Reply> answers;
    REQUIRE(poll_until(transport, [&] { return !(answers = peer.take_replies(replies)).empty(); }));
    CHECK(answers[0].sequence == number);
    CHECK(answers[0].is_mine);
  }
}
