// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/messages/rmw_dds_common.hpp"
#include "articula/ros2/names.hpp"
#include "catch.hpp"
#include "cyclone_peer.hpp"
#include "fast_dds_peer.hpp"
#include "support.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

using namespace articula::ros2;
using namespace articula::ros2::test;
using Catch::Matchers::Contains;

namespace {

constexpr QualityOfService reliable{.transient_local = false, .depth = 10};

template <class Layout>
using Info = rmw_dds_common::msg::ParticipantEntitiesInfo<Layout>;

// The last information that a peer has about the nodes of the transport.
template <class Layout>
struct Nodes {
  explicit Nodes(FastDdsPeer& used)
      : peer(&used),
        reader(used.make_reader("ros_discovery_info",
                                "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_", true)) {}
  bool update() {
    const std::vector<Bytes> messages = peer->take(reader);
    return !messages.empty() && decode(messages.back(), info) == CdrError::none;
  }
  FastDdsPeer* peer;
  std::size_t reader;
  Info<Layout> info{};
};

std::array<std::uint8_t, 16> first_16(const auto& data) {
  std::array<std::uint8_t, 16> bytes{};
  std::copy_n(data.begin(), 16, bytes.begin());
  return bytes;
}

bool waits_for(FastDdsTransport& transport, auto discovered) {
  return poll_until(transport, [&] { return !discovered().empty(); });
}

}  // namespace

TEST_CASE("peers learn nodes, their readers and writers, and the hashes of types") {
  talk_over_udp_only();
  FastDdsTransport transport({.domain = domain()});
  FastDdsPeer peer(domain());
  CyclonePeer cyclone(domain());
  Nodes<Jazzy> nodes(peer);
  auto writer = transport.advertise(text_topic("/text", reliable));
  transport.subscribe(text_topic("/commands", reliable), [](Sample) {});
  ServiceEndpoint service = trigger_service("/arm/trigger");
  service.node = "/arm/driver";
  transport.serve(service, [](Sample, const ReplySender&) {});
  REQUIRE(poll_until(transport, [&] { return nodes.update(); }));

  const auto& list = nodes.info.node_entities_info_seq;
  REQUIRE(list.size() == 2);
  CHECK(list[0].node_namespace.view() == "/arm");
  CHECK(list[0].node_name.view() == "driver");
  CHECK(list[1].node_namespace.view() == "/");
  CHECK(list[1].node_name.view() == "tester");
  for (const auto& node : list) {
    CHECK(node.reader_gid_seq.size() == 1);
    CHECK(node.writer_gid_seq.size() == 1);
  }

  const std::string hash = "typehash=" + std::string(type_hash<TextMessage>.view()) + ";";
  REQUIRE(waits_for(transport, [&] { return cyclone.writers("rt/text"); }));
  REQUIRE(waits_for(transport, [&] { return cyclone.readers("rt/commands"); }));
  REQUIRE(waits_for(transport, [&] { return cyclone.readers("rq/arm/triggerRequest"); }));
  REQUIRE(waits_for(transport, [&] { return cyclone.writers("rr/arm/triggerReply"); }));
  REQUIRE(waits_for(transport, [&] { return cyclone.participants(); }));
  const auto text = cyclone.writers("rt/text"), commands = cyclone.readers("rt/commands");
  CHECK(text.at(0).user_data == hash);
  CHECK(text.at(0).guid == list[1].writer_gid_seq[0].data);
  CHECK(commands.at(0).user_data == hash);
  CHECK(commands.at(0).guid == list[1].reader_gid_seq[0].data);
  // Exactly one reader and one writer, or clients of rmw_fastrtps wait for ever.
  const auto requests = cyclone.readers("rq/arm/triggerRequest"),
             replies = cyclone.writers("rr/arm/triggerReply");
  REQUIRE(requests.size() == 1);
  REQUIRE(replies.size() == 1);
  CHECK(requests[0].user_data == "typehash=" + service.hash + ";");
  CHECK(requests[0].guid == list[0].reader_gid_seq[0].data);
  CHECK(replies[0].guid == list[0].writer_gid_seq[0].data);

  const auto participants = cyclone.participants();
  const auto own = std::find_if(participants.begin(), participants.end(), [&](const auto& other) {
    return other.guid == nodes.info.gid.data;
  });
  REQUIRE(own != participants.end());
  CHECK(own->user_data == "enclave=/;");

  writer.reset();
  REQUIRE(poll_until(transport, [&] { return nodes.update(); }));
  CHECK(nodes.info.node_entities_info_seq[1].writer_gid_seq.empty());
}

TEST_CASE("Humble's identifiers have 24 bytes, and it has no hashes") {
  talk_over_udp_only();
  FastDdsTransport transport({.domain = domain()}, Distribution::humble);
  FastDdsPeer peer(domain());
  CyclonePeer cyclone(domain());
  Nodes<Humble> nodes(peer);
  TopicEndpoint topic = text_topic("/text", reliable);
  topic.hash.clear();
  const auto writer = transport.advertise(topic);
  REQUIRE(poll_until(transport, [&] { return nodes.update(); }));
  REQUIRE(waits_for(transport, [&] { return cyclone.writers("rt/text"); }));
  REQUIRE(waits_for(transport, [&] { return cyclone.writers("ros_discovery_info"); }));
  const auto text = cyclone.writers("rt/text"), info = cyclone.writers("ros_discovery_info");
  CHECK(text.at(0).user_data.empty());
  CHECK(info.at(0).user_data.empty());
  const auto& gid = nodes.info.node_entities_info_seq.at(0).writer_gid_seq.at(0).data;
  CHECK(first_16(gid) == text[0].guid);
  CHECK(std::all_of(gid.begin() + 16, gid.end(), [](auto byte) { return byte == 0; }));
}

TEST_CASE("with the default options all sockets are on loopback") {
  const FastDdsTransport transport({.domain = domain()});
  std::set<std::string> own;  // inodes of sockets
  for (const auto& file : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code closed;
    const std::string target = std::filesystem::read_symlink(file.path(), closed).string();
    if (target.starts_with("socket:[")) own.insert(target.substr(8, target.size() - 9));
  }
  std::ifstream sockets("/proc/self/net/udp");
  std::string line;
  std::size_t count = 0;
  while (std::getline(sockets, line)) {
    std::istringstream words(line);
    std::vector<std::string> column{std::istream_iterator<std::string>(words), {}};
    if (column.size() < 10 || !own.contains(column[9])) continue;
    ++count;
    CHECK(column[1].substr(0, 8) == "0100007F");  // 127.0.0.1
  }
  CHECK(count >= 3);  // for discovery, for users, for sending
}

TEST_CASE("without free ports there is no transport") {
  constexpr unsigned own_domain = 229;
  const auto hold = [](int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int held = socket(AF_INET, SOCK_DGRAM, 0);
    if (bind(held, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return held;
    close(held);
    return -1;
  };
  constexpr int first = 7400 + 250 * static_cast<int>(own_domain);
  std::vector<int> held;
  for (int port = first; port < first + 250; ++port) held.push_back(hold(port));
  CHECK_THROWS_WITH(FastDdsTransport({.domain = own_domain}),
                    Contains("domain 229; expected two free UDP ports from 64650 on"));
  for (const int socket : held) close(socket);
  CHECK_NOTHROW(FastDdsTransport({.domain = own_domain}));
}

TEST_CASE("a publisher whose quality of service does not match is told of, once") {
  FastDdsTransport transport({.domain = domain()});
  transport.subscribe(text_topic("/arm/text", reliable), [](Sample) {});
  FastDdsPeer peer(domain());
  const std::string type = dds_type_name(TextMessage::ros_type.view());
  (void)peer.make_writer(topic_name("/arm/text"), type);
  poll_for(transport, std::chrono::milliseconds(500));
  CHECK(transport.warnings().empty());
  (void)peer.make_writer(topic_name("/arm/text"), type, false, true);
  std::vector<std::string> warnings;
  CHECK(poll_until(transport, [&] { return !(warnings = transport.warnings()).empty(); }));
  CHECK(warnings ==
        std::vector<std::string>{"a publisher of /arm/text is not heard: its quality of service is "
                                 "best effort; expected reliable"});
  CHECK(transport.warnings().empty());
}

TEST_CASE("options out of their range are refused with what is expected") {
  const auto refused = [](const FastDdsOptions& options, const std::string& text) {
    CHECK_THROWS_WITH(FastDdsTransport(options), Contains(text));
  };
  refused({.domain = 233}, "domain is 233; expected 0 to 232");
  refused({.interfaces = {}}, "interfaces is empty");
  refused({.interfaces = {"192.0.2.77"}},
          "interfaces has '192.0.2.77'; expected IPv4 addresses of");
  refused({.interfaces = {"lo"}}, "127.0.0.1");
  refused({.interfaces = {"239.255.0.1"}}, "interfaces has '239.255.0.1'");
  refused({.peers = {"host"}}, "peers has 'host'");
  refused({.largest_message = 10}, "largest_message is 10; expected 1024 to");
  refused({.reply_patience = std::chrono::milliseconds(-1)}, "reply_patience is -1 ms");
}

TEST_CASE("names and messages that ROS does not have are refused") {
  FastDdsTransport transport({.domain = domain(), .largest_message = 1024});
  for (const char* name : {"", "text", "/", "/a//b", "/a/", "/a b", "/a\n", "/ä", "/a/1b"}) {
    CHECK_THROWS_WITH(transport.advertise(text_topic(name, reliable)),
                      Contains("is not a full name"));
  }
  CHECK_THROWS_WITH(transport.advertise(text_topic("/" + std::string(240, 'x'), reliable)),
                    Contains("at most 240 characters"));
  TopicEndpoint topic = text_topic("/text", reliable);
  topic.type = "std_msgs/String";
  CHECK_THROWS_WITH(transport.subscribe(topic, {}), Contains("the type 'std_msgs/String'"));
  CHECK_THROWS_WITH(
      transport.advertise(text_topic("/text", {.transient_local = false, .depth = 0})),
      Contains("the depth of /text is 0"));
  topic = text_topic("/text", reliable);
  topic.node = "tester";
  CHECK_THROWS_WITH(transport.advertise(topic), Contains("the node 'tester'"));

  transport.serve(trigger_service("/trigger"), [](Sample, const ReplySender&) {});
  CHECK_THROWS_WITH(transport.serve(trigger_service("/trigger"), {}),
                    Contains("the service /trigger is served already"));

  const auto writer = transport.advertise(text_topic("/text", reliable));
  CHECK_THROWS_WITH(writer->write(text_bytes(std::string(2000, 'x'))),
                    Contains("for rt/text; FastDdsOptions::largest_message is 1024"));
}
