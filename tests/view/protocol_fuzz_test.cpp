// SPDX-License-Identifier: Apache-2.0
#include "articula/view/server/clients/broadcast.hpp"
#include "catch.hpp"
#include "fake_port.hpp"
#include "random.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

using namespace articula::view;
using support::Random;

namespace {

std::string number(std::uint32_t x) {
  std::string bytes;
  for (int i = 0; i < 4; ++i, x >>= 8) bytes += static_cast<char>(x & 255);
  return bytes;
}

struct Message {
  bool is_text = true;
  std::string bytes{};
};

/// Messages that are right, from which the others are made.
std::vector<Message> right_messages() {
  std::vector<Message> messages;
  for (
      const char* text :
      {R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":1},{"id":2,"channelId":4}]})",
       R"({"op":"subscribe","subscriptions":[{"id":3,"channelId":5},{"id":4,"channelId":7}]})",
       R"({"op":"unsubscribe","subscriptionIds":[1,2,3,4]})",
       R"({"op":"advertise","channels":[{"id":1,"topic":"/reference","encoding":"json","schemaName":"a"}]})",
       R"({"op":"advertise","channels":[{"id":2,"topic":"/joint_trajectory","encoding":"json"}]})",
       R"({"op":"unadvertise","channelIds":[1,2]})",
       R"({"op":"getParameters","parameterNames":["pid.elbow.p"],"id":"a"})",
       R"({"op":"setParameters","parameters":[{"name":"pid.elbow.p","value":1.5}],"id":"b"})",
       R"({"op":"subscribeParameterUpdates","parameterNames":[]})",
       R"({"op":"unsubscribeParameterUpdates","parameterNames":["pid.elbow.p"]})",
       R"({"op":"fetchAsset","uri":"package://arm/a.stl","requestId":1})",
       R"({"op":"subscribeConnectionGraph"})"}) {
    messages.push_back({true, text});
  }
  const auto call = [&](const char* json) {
    for (std::uint32_t id = 1; id <= services().size(); ++id) {
      messages.push_back({false, "\x02" + number(id) + number(9) + number(4) + "json" + json});
    }
  };
  for (
      const char* json :
      {"{}", R"({"positions":{"elbow":0.5,"shoulder":-1e3},"speed":0.5})",
       R"({"positions":{"elbow":0.5},"velocities":{"elbow":1},"efforts":{"elbow":2}})",
       R"({"values":{"pid.elbow.p":3}})",
       R"({"gains":{"pid.elbow.p":3},"count":3,"horizon":0.5,"samples":9,"seed":7})",
       R"({"mass":0.1,"friction":0.1,"delay":2,"position_noise":1e-3,"velocity_noise":1e-2})",
       R"({"paused":true})", R"({"factor":2})",
       R"({"start":["a"],"stop":["b"],"best_effort":true,"replace":false})",
       R"({"link":"base","point":[1,2,3],"force":[4,5,6]})",
       R"({"duration":1,"signals":[{"joint":"elbow","kind":"sine","amplitude":1,"frequency":2}]})",
       R"({"duration":1,"signals":[{"joint":"elbow","kind":"chirp","amplitude":1,"first_frequency":1,"last_frequency":2,"duration":3,"target":"effort"}]})",
       R"({"joint_names":["elbow"],"points":[{"positions":[1],"time_from_start":{"sec":1,"nanosec":5}}]})"}) {
    call(json);
  }
  messages.push_back(
      {false, "\x01" + number(1) + R"({"name":["elbow"],"position":[1],"effort":[2]})"});
  messages.push_back(
      {false,
       "\x01" + number(2) +
           R"({"header":{},"joint_names":["elbow"],"points":[{"positions":[1],"time_from_start":1}]})"});
  return messages;
}

/// Changes a message a little, or much.
void mutate(Random& random, Message& message, const std::vector<Message>& others) {
  static const std::vector<std::string> pieces{"{",
                                               "}",
                                               "[",
                                               "]",
                                               "\"",
                                               ":",
                                               ",",
                                               "null",
                                               "true",
                                               "-",
                                               "1e308",
                                               "1e-400",
                                               "4294967296",
                                               "\\u0000",
                                               "\\ud800",
                                               "\xff",
                                               "\xf0\x9f",
                                               "\"a\"",
                                               "{}",
                                               "[]",
                                               "1e999",
                                               "9223372036854775808",
                                               std::string(300, 'x'),
                                               std::string(40, '['),
                                               std::string(1, '\0')};
  std::string& bytes = message.bytes;
  const int changes = random.integer(0, 4);
  for (int i = 0; i < changes; ++i) {
    const auto size = static_cast<int>(bytes.size());
    const auto at = static_cast<std::size_t>(random.integer(0, size));
    switch (random.integer(0, 6)) {
      case 0:  // another byte
        if (at < bytes.size()) bytes[at] = static_cast<char>(random.integer(0, 255));
        break;
      case 1:  // one bit
        if (at < bytes.size()) {
          bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.integer(0, 7)));
        }
        break;
      case 2:  // cut
        bytes.resize(at);
        break;
      case 3:  // without a part
        bytes.erase(at, static_cast<std::size_t>(random.integer(1, 20)));
        break;
      case 4:  // with a piece
        bytes.insert(at, pieces[static_cast<std::size_t>(
                             random.integer(0, static_cast<int>(pieces.size()) - 1))]);
        break;
      case 5: {  // with the end of another message
        const auto& other = others[static_cast<std::size_t>(
            random.integer(0, static_cast<int>(others.size()) - 1))];
        bytes = bytes.substr(0, at) + other.bytes.substr(std::min(other.bytes.size(), at));
        break;
      }
      case 6:  // as the other kind
        message.is_text = !message.is_text;
        break;
      default:
        break;
    }
  }
}

Message random_bytes(Random& random) {
  Message message{random.one_in(2),
                  std::string(static_cast<std::size_t>(random.integer(0, 64)), 0)};
  for (char& c : message.bytes) c = static_cast<char>(random.integer(0, 255));
  if (!message.is_text && !message.bytes.empty()) message.bytes[0] = random.one_in(2) ? 1 : 2;
  return message;
}

}  // namespace

TEST_CASE("a million messages, right, wrong and random, do no harm") {
  const unsigned seed = 20261123;
  CAPTURE(seed);
  WARN("seed " << seed);
  Random random(seed);
  support::FakePort port;
  const articula::ViewOptions options{.operates = true, .queue_limit = 1 << 20};
  Broadcast broadcast(port);
  const std::vector<Message> right = right_messages();
  auto now = std::chrono::steady_clock::now();
  std::size_t asked = 0, frames = 0, longest = 0;
  constexpr int clients = 1000, messages = 1000;
  for (int c = 0; c < clients; ++c) {
    FuturesDesk futures(port);
    Client client(port, futures, broadcast.latest(), options, "fuzz");
    broadcast.add(client);
    for (int i = 0; i < messages; ++i) {
      Message message =
          right[static_cast<std::size_t>(random.integer(0, static_cast<int>(right.size()) - 1))];
      if (random.one_in(8)) {
        message = random_bytes(random);
      } else {
        mutate(random, message, right);
      }
      client.receive(message.is_text, message.bytes);
      if (i % 100 == 0) {
        now += std::chrono::milliseconds(100);
        broadcast.tick(now, 1'000'000'000);
      }
      while (const auto frame = client.take()) {
        ++frames;
        longest = std::max(longest, frame->size());
      }
      if (client.overflowed()) FAIL("an answer was lost");
    }
    broadcast.remove(client);
    asked += port.requests().size();
  }
  // Many were right, so that what is behind the first check was reached; and no answer grows large.
  CHECK(asked > static_cast<std::size_t>(clients));
  CHECK(frames > static_cast<std::size_t>(clients * messages) / 10);
  CHECK(longest < 1 << 20);
}
