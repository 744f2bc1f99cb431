// SPDX-License-Identifier: Apache-2.0
#include "catch.hpp"
#include "cyclone_peer.hpp"
#include "fast_dds_peer.hpp"
#include "support.hpp"

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

using namespace articula::ros2;
using namespace articula::ros2::test;

namespace {

// Answers each request with the count of requests.
struct Server {
  explicit Server(FastDdsTransport& transport, const std::string& service = "/arm/trigger") {
    transport.serve(trigger_service(service), [this](Sample request, const ReplySender& reply) {
      requests.emplace_back(request.begin(), request.end());
      const Trigger::Response response{.success = true, .message = std::to_string(requests.size())};
      reply(bytes_of(response));
      reply(bytes_of(Trigger::Response{.message = "a second reply"}));  // has no effect
    });
  }
  std::vector<Bytes> requests{};
};

Trigger::Response response_of(const Bytes& bytes) {
  Trigger::Response response;
  CHECK(decode(bytes, response) == CdrError::none);
  return response;
}

struct FastClient {
  explicit FastClient(FastDdsPeer& used, const std::string& service = "/arm/trigger")
      : peer(&used),
        requests(
            used.make_writer("rq" + service + "Request", "std_srvs::srv::dds_::Trigger_Request_")),
        replies(
            used.make_reader("rr" + service + "Reply", "std_srvs::srv::dds_::Trigger_Response_")) {}
  // As rmw_fastrtps: one reader and one writer of the server, no more.
  [[nodiscard]] bool is_ready() const {
    return peer->matches_of_writer(requests) == 1 && peer->matches_of_reader(replies) == 1;
  }
  FastDdsPeer* peer;
  std::size_t requests;
  std::size_t replies;
};

}  // namespace

TEST_CASE("one service answers clients of both dialects, and each client gets its replies alone") {
  talk_over_udp_only();
  FastDdsTransport transport({.domain = domain()});
  Server server(transport);
  CyclonePeer cyclone(domain());
  cyclone.make_reply_reader("/arm/trigger");
  cyclone.make_request_writer("/arm/trigger");
  FastDdsPeer fast(domain());
  const FastClient client(fast), other(fast);
  REQUIRE(poll_until(
      transport, [&] { return cyclone.finds_service() && client.is_ready() && other.is_ready(); }));

  cyclone.request(7);
  std::optional<CyclonePeer::Reply> reply;
  REQUIRE(poll_until(transport, [&] { return (reply = cyclone.take_reply()).has_value(); }));
  CHECK(reply->client == cyclone.client());
  CHECK(reply->sequence == 7);
  CHECK(reply->success);
  CHECK(reply->message == "1");

  const Bytes request = bytes_of(Trigger::Request{});
  const std::int64_t number = fast.request(client.requests, client.replies, request);
  std::vector<FastDdsPeer::Reply> replies;
  REQUIRE(poll_until(transport,
                     [&] { return !(replies = fast.take_replies(client.replies)).empty(); }));
  REQUIRE(replies.size() == 1);
  CHECK(replies[0].is_mine);
  CHECK(replies[0].sequence == number);
  CHECK(response_of(replies[0].bytes).message == "2");

  // The service saw the same message in both dialects.
  REQUIRE(server.requests.size() == 2);
  for (Bytes& bytes : server.requests) {
    bytes.resize(5);          // without padding
    bytes[3] = std::byte{0};  // by which Cyclone DDS notes the padding
  }
  CHECK(server.requests[0] == request);
  CHECK(server.requests[1] == request);

  poll_for(transport, std::chrono::milliseconds(100));
  CHECK_FALSE(cyclone.take_reply().has_value());
  CHECK(fast.take_replies(client.replies).empty());
  CHECK(fast.take_replies(other.replies).empty());
}

TEST_CASE("a new client gets its first reply although others got many before") {
  talk_over_udp_only();
  FastDdsTransport transport({.domain = domain()});
  Server server(transport);
  FastDdsPeer fast(domain());
  const FastClient client(fast);
  REQUIRE(poll_until(transport, [&] { return client.is_ready(); }));
  for (int round = 0; round < 5; ++round) {
    for (int i = 0; i < 5; ++i) {
      fast.request(client.requests, client.replies, bytes_of(Trigger::Request{}));
    }
    std::size_t replies = 0;
    REQUIRE(poll_until(transport,
                       [&] { return (replies += fast.take_replies(client.replies).size()) == 5; }));
    CyclonePeer cyclone(domain());
    cyclone.make_reply_reader("/arm/trigger");
    cyclone.make_request_writer("/arm/trigger");
    REQUIRE(poll_until(transport, [&] { return cyclone.finds_service(); }));
    cyclone.request(round);
    std::optional<CyclonePeer::Reply> reply;
    REQUIRE(poll_until(transport, [&] { return (reply = cyclone.take_reply()).has_value(); }));
    CHECK(reply->sequence == round);
  }
}

TEST_CASE("a reply waits for the reader of its client") {
  FastDdsTransport transport(
      {.domain = domain(), .reply_patience = std::chrono::milliseconds(5000)});
  Server server(transport);
  CyclonePeer cyclone(domain());
  cyclone.make_request_writer("/arm/trigger");
  // As rmw_cyclonedds: a client asks when it knows the writer of replies, too.
  REQUIRE(poll_until(transport, [&] {
    return cyclone.finds_service() && !cyclone.writers("rr/arm/triggerReply").empty();
  }));
  cyclone.request(1);
  REQUIRE(poll_until(transport, [&] { return !server.requests.empty(); }));
  poll_for(transport, std::chrono::milliseconds(50));
  cyclone.make_reply_reader("/arm/trigger");
  std::optional<CyclonePeer::Reply> reply;
  REQUIRE(poll_until(transport, [&] { return (reply = cyclone.take_reply()).has_value(); }));
  CHECK(reply->sequence == 1);
}

TEST_CASE("clients that never have a reader delay no other, and their replies are forgotten") {
  talk_over_udp_only();
  FastDdsTransport transport(
      {.domain = domain(), .waiting_replies = 3, .reply_patience = std::chrono::milliseconds(100)});
  Server server(transport);
  CyclonePeer cyclone(domain());
  cyclone.make_request_writer("/arm/trigger");
  FastDdsPeer fast(domain());
  const FastClient client(fast);
  REQUIRE(poll_until(transport, [&] { return cyclone.finds_service() && client.is_ready(); }));
  for (int i = 0; i < 20; ++i) cyclone.request(i);
  const auto begin = std::chrono::steady_clock::now();
  fast.request(client.requests, client.replies, bytes_of(Trigger::Request{}));
  REQUIRE(poll_until(transport, [&] { return !fast.take_replies(client.replies).empty(); }));
  // Far below the sum of the patience with all of them.
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(1));
  REQUIRE(poll_until(transport, [&] { return server.requests.size() >= 10; }));
  poll_for(transport, std::chrono::milliseconds(150));
  cyclone.make_reply_reader("/arm/trigger");
  poll_for(transport, std::chrono::milliseconds(200));
  CHECK_FALSE(cyclone.take_reply().has_value());
}

TEST_CASE("errors of a service's function pass through poll, and the next request is served") {
  talk_over_udp_only();
  FastDdsTransport transport({.domain = domain(), .largest_message = 1024});
  FastDdsPeer fast(domain());
  const FastClient client(fast);
  std::size_t requests = 0;
  transport.serve(trigger_service("/arm/trigger"), [&](Sample, const ReplySender& reply) {
    const std::size_t size = ++requests == 1 ? 2000 : 1000;
    reply(bytes_of(Trigger::Response{.message = std::string(size, 'x')}, 4096));
  });
  REQUIRE(poll_until(transport, [&] { return client.is_ready(); }));
  std::string error;
  for (int i = 0; i < 2; ++i) {
    fast.request(client.requests, client.replies, bytes_of(Trigger::Request{}));
  }
  const auto poll = [&] {
    try {
      transport.poll(std::chrono::milliseconds(5));
    } catch (const std::invalid_argument& refusal) {
      error = refusal.what();
    }
    return requests == 2;
  };
  for (int i = 0; i < 1000 && !poll(); ++i) {
  }
  CHECK(error.find("largest_message is 1024") != std::string::npos);
  REQUIRE(poll_until(transport, [&] { return !fast.take_replies(client.replies).empty(); }));
}

TEST_CASE("a reply may be sent after others, and after the transport it is dropped") {
  talk_over_udp_only();
  std::vector<ReplySender> senders;
  FastDdsPeer fast(domain());
  const FastClient client(fast);
  {
    FastDdsTransport transport({.domain = domain()});
    transport.serve(trigger_service("/arm/trigger"),
                    [&](Sample, ReplySender reply) { senders.push_back(std::move(reply)); });
    REQUIRE(poll_until(transport, [&] { return client.is_ready(); }));
    std::vector<std::int64_t> numbers;
    for (int i = 0; i < 3; ++i) {
      numbers.push_back(
          fast.request(client.requests, client.replies, bytes_of(Trigger::Request{})));
    }
    REQUIRE(poll_until(transport, [&] { return senders.size() == 3; }));
    senders[1](bytes_of(Trigger::Response{.message = "second"}));
    senders[0](bytes_of(Trigger::Response{.message = "first"}));
    std::vector<FastDdsPeer::Reply> replies;
    REQUIRE(poll_until(transport, [&] {
      for (auto& reply : fast.take_replies(client.replies)) replies.push_back(reply);
      return replies.size() == 2;
    }));
    CHECK(replies[0].sequence == numbers[1]);
    CHECK(replies[1].sequence == numbers[0]);
  }
  senders[2](bytes_of(Trigger::Response{.message = "late"}));
}
