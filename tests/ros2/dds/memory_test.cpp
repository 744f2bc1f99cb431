// SPDX-License-Identifier: Apache-2.0
#include "catch.hpp"
#include "fast_dds_peer.hpp"
#include "support.hpp"

#include <unistd.h>

#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

using namespace articula::ros2;
using namespace articula::ros2::test;

namespace {

// Sanitizers keep freed memory.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool memory_is_meaningful = false;
#elif defined(__has_feature)
constexpr bool memory_is_meaningful = !__has_feature(address_sanitizer);
#else
constexpr bool memory_is_meaningful = true;
#endif

// Resident memory of this process in MiB.
double resident() {
  std::ifstream file("/proc/self/statm");
  std::size_t size = 0, pages = 0;
  file >> size >> pages;
  return static_cast<double>(pages) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

void check_growth(double before, double limit) {
  const double growth = resident() - before;
  CAPTURE(growth, limit);
  if (memory_is_meaningful) CHECK(growth < limit);
}

}  // namespace

TEST_CASE("while nobody polls, a topic keeps the last messages of its depth alone") {
  talk_over_udp_only();
  FastDdsTransport transport({.domain = domain()});
  FastDdsPeer peer(domain());
  std::vector<std::size_t> sizes;
  transport.subscribe(text_topic("/text", {.transient_local = false, .depth = 7}),
                      [&](Sample sample) { sizes.push_back(sample.size()); });
  const std::size_t writer = peer.make_writer("rt/text", "std_msgs::msg::dds_::String_");
  REQUIRE(poll_until(transport, [&] { return peer.matches_of_writer(writer) == 1; }));
  Bytes message(20'000);
  for (int i = 0; i < 200; ++i) peer.write(writer, message);
  const double before = resident();
  for (int i = 0; i < 4000; ++i) peer.write(writer, message);  // 80 MB
  const Bytes last(4);
  peer.write(writer, last);
  check_growth(before, 16);
  transport.poll(std::chrono::milliseconds(0));
  CHECK(sizes.size() == 7);
  // The peer sends again what its history still has of the lost ones, at most 100 messages.
  REQUIRE(poll_until(transport, [&] { return sizes.back() == last.size(); }));
  CHECK(sizes.size() < 200);
}

TEST_CASE("20,000 messages and 20,000 requests take no memory") {
  talk_over_udp_only();
  FastDdsTransport transport({.domain = domain()});
  FastDdsPeer peer(domain());
  std::size_t requests = 0;
  ServiceEndpoint service = trigger_service("/arm/trigger");
  service.quality.depth = 100;
  transport.serve(service, [&](Sample, const ReplySender& reply) {
    ++requests;
    reply(bytes_of(Trigger::Response{.success = true, .message = "done"}));
  });
  const auto topic = transport.advertise(text_topic("/text", quality_of_service::states));
  const std::size_t texts = peer.make_reader("rt/text", "std_msgs::msg::dds_::String_");
  const std::size_t requester =
      peer.make_writer("rq/arm/triggerRequest", "std_srvs::srv::dds_::Trigger_Request_");
  const std::size_t replies =
      peer.make_reader("rr/arm/triggerReply", "std_srvs::srv::dds_::Trigger_Response_");
  REQUIRE(poll_until(transport, [&] {
    return peer.matches_of_writer(requester) == 1 && peer.matches_of_reader(replies) == 1 &&
           topic->readers() == 1;
  }));
  const Bytes request = bytes_of(Trigger::Request{});
  const std::vector<std::byte> text = text_bytes(std::string(200, 'x'));
  std::size_t answered = 0, read = 0;
  const auto exchange = [&](std::size_t count) {
    constexpr std::size_t at_once = 50;
    for (const std::size_t end = answered + count; answered < end;) {
      const std::size_t goal = answered + at_once;
      for (std::size_t i = 0; i < at_once; ++i) {
        peer.request(requester, replies, request);
        topic->write(text);
        read += peer.take(texts).size();
      }
      if (!poll_until(transport, [&] {
            answered += peer.take_replies(replies).size();
            return answered >= goal;
          })) {
        return false;
      }
    }
    return true;
  };
  REQUIRE(exchange(1'000));
  const double before = resident();
  REQUIRE(exchange(19'000));
  check_growth(before, 4);
  CHECK(requests == 20'000);
  CHECK(read > 10'000);  // its history has one message, so fast ones are lost
}

TEST_CASE("requests of clients that read no replies take no memory") {
  talk_over_udp_only();
  FastDdsTransport transport(
      {.domain = domain(), .reply_patience = std::chrono::milliseconds(100'000)});
  FastDdsPeer cyclone(domain(), true);
  std::size_t requests = 0;
  transport.serve(trigger_service("/arm/trigger"), [&](Sample, const ReplySender& reply) {
    ++requests;
    reply(bytes_of(Trigger::Response{.message = std::string(10'000, 'x')}, 20'000));
  });
  const std::size_t requester =
      cyclone.make_writer("rq/arm/triggerRequest", "std_srvs::srv::dds_::Trigger_Request_");
  REQUIRE(poll_until(transport, [&] { return cyclone.matches_of_writer(requester) == 1; }));
  const Bytes request(25, std::byte{1});
  const auto ask = [&](std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t goal = requests + 1;
      cyclone.write(requester, request);
      if (!poll_until(transport, [&] { return requests >= goal; })) return false;
    }
    return true;
  };
  REQUIRE(ask(200));
  const double before = resident();
  REQUIRE(ask(5'000));  // 50 MB of replies
  check_growth(before, 4);
}
