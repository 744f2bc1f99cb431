// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/dds/packets/packet_check.hpp"
#include "catch.hpp"
#include "fast_dds_peer.hpp"
#include "support.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <random>
#include <string>
#include <tuple>
#include <utility>
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

// How many messages and requests the long exchange has: ARTICULA_SOAK, or a short one.
std::size_t soak() {
  const char* const text = std::getenv("ARTICULA_SOAK");  // NOLINT(concurrency-mt-unsafe)
  return text == nullptr ? 20'000 : static_cast<std::size_t>(std::strtoull(text, nullptr, 10));
}

// How many mutilated packets are sent: ARTICULA_MUTILATED, or some.
std::uint32_t mutilated() {
  const char* const text = std::getenv("ARTICULA_MUTILATED");  // NOLINT(concurrency-mt-unsafe)
  return text == nullptr ? 150'000 : static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10));
}

// What a participant sends to be discovered, as the standard of RTPS has it (9.6.2.2).
// `further` is a parameter more. Nobody listens at the usual port.
Bytes announcement(std::uint32_t number, std::uint32_t lease_seconds, const Bytes& further = {},
                   std::uint32_t port = 9) {
  Bytes bytes;
  const auto put = [&](std::initializer_list<unsigned> values) {
    for (const unsigned value : values) bytes.push_back(static_cast<std::byte>(value));
  };
  const auto put_number = [&](std::uint32_t value) {
    for (int i = 0; i < 4; ++i, value >>= 8) bytes.push_back(static_cast<std::byte>(value & 0xff));
  };
  const auto put_prefix = [&] {
    put({0x01, 0x0f, 0xab, 0xcd});
    put_number(number);
    put({0, 0, 0, 1});
  };
  const auto put_parameter = [&](unsigned id, unsigned size) { put({id, 0, size, 0}); };
  const auto put_locator = [&](unsigned id) {
    put_parameter(id, 24);
    put_number(1);  // UDPv4
    put_number(port);
    put({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 127, 0, 0, 1});
  };
  put({'R', 'T', 'P', 'S', 2, 3, 0x01, 0x0f});
  put_prefix();
  const std::size_t start = bytes.size();
  put({0x15, 0x05, 0, 0, 0, 0, 16, 0});  // DATA, little endian, with a payload
  put({0x00, 0x01, 0x00, 0xc7, 0x00, 0x01, 0x00, 0xc2});
  put_number(0);
  put_number(1);
  put({0x00, 0x03, 0x00, 0x00});  // a list of parameters, little endian
  put_parameter(0x15, 4);
  put({2, 3, 0, 0});
  put_parameter(0x16, 4);
  put({0x01, 0x0f, 0, 0});
  put_parameter(0x50, 16);
  put_prefix();
  put({0, 0, 1, 0xc1});
  put_locator(0x32);
  put_locator(0x31);
  put_parameter(0x02, 8);
  put_number(lease_seconds);
  put_number(0);
  put_parameter(0x58, 4);
  put_number(0x3f);
  bytes.insert(bytes.end(), further.begin(), further.end());
  put_parameter(0x01, 0);
  const std::size_t length = bytes.size() - start - 4;
  bytes[start + 2] = static_cast<std::byte>(length % 256);
  bytes[start + 3] = static_cast<std::byte>(length / 256);
  return bytes;
}

// Sends packets to where the first participants of the domain expect announcements. Those of a
// process have successive ports, also after the end of earlier ones.
class Announcer {
 public:
  explicit Announcer(unsigned participants = 8)
      : participants_(participants), socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    sockaddr_in own = address(0);
    socklen_t size = sizeof own;
    ::bind(socket_, reinterpret_cast<const sockaddr*>(&own), size);
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&own), &size);
    port_ = ntohs(own.sin_port);
  }
  Announcer(const Announcer&) = delete;
  Announcer& operator=(const Announcer&) = delete;
  ~Announcer() { ::close(socket_); }
  // `port` is the place among the ports of the domain: 10 for announcements, 11 for messages.
  void send(const Bytes& packet, unsigned port = 10) const {
    for (unsigned k = 0; k < participants_; ++k) {
      const sockaddr_in to = address(7400 + 250 * domain() + port + 2 * k);
      ::sendto(socket_, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&to),
               sizeof to);
    }
  }
  [[nodiscard]] std::uint32_t port() const { return port_; }
  // How many packets have come since the last call.
  [[nodiscard]] std::size_t received() const {
    std::size_t count = 0;
    char byte = 0;
    while (::recv(socket_, &byte, 1, 0) > 0) ++count;
    return count;
  }

 private:
  static sockaddr_in address(unsigned port) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    place.sin_port = htons(static_cast<std::uint16_t>(port));
    return place;
  }
  unsigned participants_;
  int socket_;
  std::uint32_t port_ = 0;
};

// Announces participants, with some bytes of each packet changed or with none.
void announce_all(const Announcer& announcer, FastDdsTransport& transport, std::uint32_t first,
                  std::uint32_t last, bool changes_bytes) {
  std::mt19937 random(first);
  for (std::uint32_t number = first; number < last; ++number) {
    Bytes packet = announcement(number, 1);
    for (auto changes = changes_bytes ? 1 + random() % 4 : 0; changes > 0; --changes) {
      packet[8 + random() % (packet.size() - 8)] = static_cast<std::byte>(random());
    }
    announcer.send(packet);
    if (number % 20 == 0) transport.poll(std::chrono::milliseconds(1));
  }
}

}  // namespace

TEST_CASE("packets are well-formed if all their parts are within them") {
  const Bytes packet = announcement(1, 1);
  REQUIRE(dds::is_well_formed(packet));
  for (std::size_t size = 0; size < packet.size(); ++size) {
    CAPTURE(size);
    // After its header a packet may have no part.
    CHECK(dds::is_well_formed(dds::Packet(packet).first(size)) == (size == 20));
  }
  const auto with = [&](std::size_t at, unsigned value) {
    Bytes changed = packet;
    changed.at(at) = static_cast<std::byte>(value);
    return dds::is_well_formed(changed);
  };
  CHECK_FALSE(with(0, 'X'));    // no RTPS
  CHECK_FALSE(with(22, 16));    // shorter than its fields; Fast DDS 2.9.1 copies 4 GiB
  CHECK_FALSE(with(23, 0xff));  // longer than the packet
  CHECK_FALSE(with(26, 0xff));  // a payload that begins behind the end
  CHECK_FALSE(with(26, 8));     // a payload that begins in the fields
  CHECK_FALSE(with(50, 0xff));  // a parameter longer than the packet
  CHECK_FALSE(with(50, 3));     // one that does not end at a multiple of four
  CHECK(with(20, 0x55));        // unknown parts are skipped
  // A fragment of a long list of parameters ends anywhere in it.
  Bytes fragment(packet.begin(), packet.begin() + 20);
  for (const unsigned byte :
       {0x16U, 0x01U, 44U,   0U,    0U,    0U,    28U,   0U,    0x00U, 0x01U, 0x00U, 0xc7U,
        0x00U, 0x01U, 0x00U, 0xc2U, 0U,    0U,    0U,    0U,    1U,    0U,    0U,    0U,
        4U,    0U,    0U,    0U,    1U,    0U,    64U,   0U,    204U,  0U,    0U,    0U,
        0x00U, 0x03U, 0x00U, 0x00U, 0x50U, 0x00U, 0x10U, 0x00U, 1U,    2U,    3U,    4U}) {
    fragment.push_back(static_cast<std::byte>(byte));
  }
  CHECK_FALSE(dds::is_well_formed(fragment));   // of participants: nobody sees what is in it
  fragment.at(35) = static_cast<std::byte>(3);  // of a topic
  CHECK(dds::is_well_formed(fragment));
  fragment.at(26) = static_cast<std::byte>(0xff);  // as above: its payload begins behind the end
  CHECK_FALSE(dds::is_well_formed(fragment));
  fragment.at(26) = static_cast<std::byte>(28);
  REQUIRE(dds::is_well_formed(fragment));
  const auto fragment_with = [&](std::size_t at, unsigned value) {
    Bytes changed = fragment;
    changed.at(at) = static_cast<std::byte>(value);
    return dds::is_well_formed(changed);
  };
  CHECK_FALSE(fragment_with(21, 0x05));  // of a key
  CHECK_FALSE(fragment_with(44, 0));     // the fragment before the first
  CHECK_FALSE(fragment_with(44, 3));     // shorter than it says
  CHECK_FALSE(fragment_with(44, 5));     // behind the end of the message
  CHECK_FALSE(fragment_with(48, 2));     // two in a part
  CHECK_FALSE(fragment_with(50, 63));    // so tiny that Fast DDS 2.9.1 hangs for some
  CHECK_FALSE(fragment_with(52, 205));   // shorter than the last one
  Bytes empty(fragment.begin(), fragment.end() - 12);
  empty.at(22) = static_cast<std::byte>(32);
  CHECK_FALSE(dds::is_well_formed(empty));  // Fast DDS 2.9.1 ends the program for some
  Bytes whole = fragment;
  whole.at(44) = static_cast<std::byte>(1);
  whole.at(52) = static_cast<std::byte>(12);
  CHECK_FALSE(dds::is_well_formed(whole));  // a message that needs no fragments
}

TEST_CASE("fragments that are asked for have numbers from 1") {
  Bytes packet = announcement(1, 1);
  packet.resize(20);
  // Reader, writer, number, first fragment, bits, a bit, count.
  for (const unsigned byte :
       {0x12U, 1U, 32U, 0U, 0U, 0U, 1U, 7U, 0U, 0U, 1U, 3U, 0U, 0U,   0U, 0U, 1U, 0U,
        0U,    0U, 1U,  0U, 0U, 0U, 1U, 0U, 0U, 0U, 0U, 0U, 0U, 128U, 1U, 0U, 0U, 0U}) {
    packet.push_back(static_cast<std::byte>(byte));
  }
  CHECK(dds::is_well_formed(packet));
  packet.at(40) = std::byte{0};  // Fast DDS 2.9.1 reads before the message, or sends it for ever
  CHECK_FALSE(dds::is_well_formed(packet));
  for (const std::size_t at : {40U, 41U, 42U, 43U}) packet.at(at) = std::byte{0xff};
  CHECK_FALSE(dds::is_well_formed(packet));  // the fragments after it have no number
}

TEST_CASE("numbers of messages are possible ones") {
  // Kinds of parts, and where their numbers begin.
  for (const auto& [kind, size, places] :
       {std::tuple<unsigned, unsigned, std::vector<std::size_t>>{0x07, 28, {8, 16}},
        {0x08, 28, {8, 16}},
        {0x06, 24, {8}},
        {0x13, 24, {8}},
        {0x15, 20, {12}}}) {
    CAPTURE(kind);
    Bytes packet = announcement(1, 1);
    packet.resize(20);
    for (const unsigned byte : {kind, 1U, size, 0U}) {
      packet.push_back(static_cast<std::byte>(byte));
    }
    packet.resize(packet.size() + size);
    if (kind == 0x15) packet.at(26) = std::byte{16};  // where what follows the fields begins
    CHECK(dds::is_well_formed(packet));
    for (const std::size_t place : places) {
      CAPTURE(place);
      Bytes changed = packet;
      std::byte& highest = changed.at(24 + place + 3);
      highest = std::byte{0x3f};
      CHECK(dds::is_well_formed(changed));
      // After 0x7fffffffffffffff Fast DDS 2.9.1 has no number, and ends the program.
      for (const unsigned impossible : {0x40U, 0x7fU, 0x80U, 0xffU}) {
        highest = static_cast<std::byte>(impossible);
        CHECK_FALSE(dds::is_well_formed(changed));
      }
    }
  }
}

TEST_CASE("a part of statistics is the last one, and parts end at a multiple of four") {
  Bytes packet = announcement(1, 1);
  packet.resize(20);
  const auto add = [&](unsigned kind, unsigned size) {
    for (const unsigned byte : {kind, 1U, size, 0U}) packet.push_back(static_cast<std::byte>(byte));
    packet.resize(packet.size() + size);
  };
  add(0x55, 4);
  add(0x80, 56);
  CHECK(dds::is_well_formed(packet));
  add(0x01, 4);  // Fast DDS 2.9.1 would end the program
  CHECK_FALSE(dds::is_well_formed(packet));
  packet.resize(20);
  add(0x55, 6);
  CHECK(dds::is_well_formed(packet));
  add(0x55, 4);
  CHECK_FALSE(dds::is_well_formed(packet));
}

TEST_CASE("discovery is small and whole") {
  Bytes large(4 + 8192, std::byte{0});  // a parameter that is hidden
  large[0] = std::byte{0x35};
  large[3] = std::byte{0x20};
  CHECK_FALSE(dds::is_well_formed(announcement(1, 1, large)));  // of a participant
  large.resize(4 + 4096);
  large[3] = std::byte{0x10};
  CHECK(dds::is_well_formed(announcement(1, 1, large)));
}

TEST_CASE("texts in messages of discovery are within their parameters") {
  const auto good = [](std::uint32_t id, const std::vector<std::uint32_t>& words) {
    Bytes value(4 * words.size());
    for (std::size_t k = 0; k < value.size(); ++k) {
      value[k] = static_cast<std::byte>(words[k / 4] >> (8 * (k % 4)));
    }
    return dds::detail::worth_of(id, value, true) != dds::detail::Worth::broken;
  };
  constexpr std::uint32_t huge = 0xffffffff;  // Fast DDS 2.9.1 takes 4 GiB for it
  for (const std::uint32_t id : {0x05U, 0x07U, 0x62U, 0x2cU, 0x2dU, 0x2eU}) {
    CHECK(good(id, {3, 0}));
    CHECK(good(id, {4, 0}));
    CHECK_FALSE(good(id, {5, 0}));
    CHECK_FALSE(good(id, {huge, 0}));
    CHECK_FALSE(good(id, {}));
    CHECK_FALSE(good(id, {3, 0, 0}));  // bytes after it: Fast DDS 2.9.1 keeps the message for ever
  }
  std::vector<std::uint32_t> name(64);  // 256 bytes; likewise for one more word
  name[0] = 4 * 63;
  CHECK(good(0x05, name));
  name[0] += 4;
  name.push_back(0);
  CHECK_FALSE(good(0x05, name));
  CHECK(good(0x2c, name));
  CHECK(good(0x29, {2, 1, 0, 4, 0}));
  CHECK_FALSE(good(0x29, {3, 1, 0, 4, 0}));
  CHECK_FALSE(good(0x29, {1, 1, 0, 4, 0}));
  CHECK_FALSE(good(0x29, {huge, 1, 0}));
  CHECK(good(0x59, {huge}));  // properties are hidden
  CHECK(good(0x73, {2, 0}));
  CHECK_FALSE(good(0x73, {3, 0}));
  CHECK(good(0x1a, {1, 2, 3}));
  CHECK(good(0x1a, {1, 2}));  // of another size: hidden
  CHECK(good(0x35, {huge}));  // unknown, and hidden
}

TEST_CASE("a storm of announced and mutilated participants takes no memory, and peers stay") {
  talk_over_udp_only();
  FastDdsTransport transport({.domain = domain()});
  FastDdsPeer peer(domain());
  std::size_t received = 0;
  transport.subscribe(text_topic("/text", {.transient_local = false, .depth = 10}),
                      [&](Sample) { ++received; });
  const std::size_t writer = peer.make_writer("rt/text", "std_msgs::msg::dds_::String_");
  REQUIRE(poll_until(transport, [&] { return peer.matches_of_writer(writer) == 1; }));
  // Topics of a type and names that nobody here knows.
  for (int i = 0; i < 100; ++i) {
    peer.make_writer("rt/foreign" + std::to_string(i), "foreign_msgs::msg::dds_::Thing_");
  }
  const Announcer announcer(1);  // not to the peers, which have no guard
  const auto announce = [&](std::uint32_t first, std::uint32_t last, bool changes_bytes) {
    announce_all(announcer, transport, first, last, changes_bytes);
  };
  announce(0, 600, false);  // more than are noted, so that their memory is there
  const double before = resident();
  announce(600, 5'000, false);
  // Those that came later are not noted.
  check_growth(before, 24);
  // Who comes when the storm's leases are over is found: of 1 s, 4 s late, and checked each 3 s. Fast
  // DDS 2.9.1 never looks at a participant again whose first announcement it had no room for.
  poll_for(transport, std::chrono::seconds(9));
  FastDdsPeer newcomer(domain());
  const std::size_t late = newcomer.make_writer("rt/text", "std_msgs::msg::dds_::String_");
  REQUIRE(poll_until(transport, [&] { return newcomer.matches_of_writer(late) == 1; }));

  announce(0, 5'000, true);
  check_growth(before, 24);
  received = 0;
  peer.write(writer, text_bytes("still here"));
  REQUIRE(poll_until(transport, [&] { return received > 0; }));
}

TEST_CASE("who is silent gets nothing after its lease, wherever others announce themselves") {
  FastDdsTransport transport({.domain = domain()});
  const Announcer silent, other;
  silent.send(announcement(1, 1, {}, silent.port()));
  REQUIRE(poll_until(transport, [&] { return silent.received() > 0; }));
  // Fast DDS looks for no participants at the port of messages. The lease is 1 s, and ends 4 s late.
  other.send(announcement(2, 10));
  for (int k = 0; k < 800; ++k) {
    other.send(announcement(2, 10), 11);
    poll_for(transport, std::chrono::milliseconds(10));
  }
  CHECK(poll_until(transport, [&] {
    poll_for(transport, std::chrono::seconds(1));
    return silent.received() == 0;
  }));
}

TEST_CASE("parameters that say more than they have take no memory, and statistics end no program") {
  talk_over_udp_only();
  FastDdsTransport transport({.domain = domain()});
  const Announcer announcer;
  announce_all(announcer, transport, 0, 100, false);
  const double before = resident();
  std::uint32_t number = 1000;
  for (const unsigned id : {0x05U, 0x07U, 0x29U, 0x2cU, 0x35U, 0x59U, 0x62U, 0x69U, 0x70U, 0x72U,
                            0x73U, 0x75U, 0x1001U, 0x1002U, 0x1006U}) {
    for (const unsigned first : {0xffU, 0xfeU, 0x7fU, 0x03U}) {
      Bytes further(24, std::byte{0xff});
      const unsigned head[] = {id & 0xff, id >> 8, 20, 0, first};
      for (std::size_t k = 0; k < std::size(head); ++k)
        further[k] = static_cast<std::byte>(head[k]);
      announcer.send(announcement(++number, 1, further));
      transport.poll(std::chrono::milliseconds(1));
    }
  }
  Bytes statistics = announcement(++number, 1);
  statistics.resize(20);
  for (const auto& [kind, size] : {std::pair(0x80U, 56U), std::pair(0x01U, 4U)}) {
    for (const unsigned byte : {kind, 1U, size, 0U}) {
      statistics.push_back(static_cast<std::byte>(byte));
    }
    statistics.resize(statistics.size() + size);
  }
  announcer.send(statistics);
  poll_for(transport, std::chrono::seconds(1));
  check_growth(before, 16);  // a text of one of them takes 400 MiB a second
}

TEST_CASE("mutilated announcements without end take no memory") {
  // No peer is in this process: those of Fast DDS keep something of each participant for ever.
  talk_over_udp_only();
  FastDdsTransport transport({.domain = domain()});
  const Announcer announcer;
  announce_all(announcer, transport, 0, 600, false);
  const double before = resident();
  announce_all(announcer, transport, 600, mutilated(), true);
  check_growth(before, 8);  // 26 MiB if Fast DDS gets to see them all
}

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
  // The socket may still have 8 MiB of the 84. The peer sends again what its history has of the lost
  // ones, at most 100 messages.
  REQUIRE(poll_until(transport, [&] { return sizes.back() == last.size(); }));
  CHECK(sizes.size() < 600);
}

TEST_CASE("many thousand messages and requests take no memory") {
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
  REQUIRE(soak() % 50 == 0);
  REQUIRE(exchange(1'000));
  const double before = resident();
  REQUIRE(exchange(soak() - 1'000));
  check_growth(before, 4);
  CHECK(requests == soak());
  CHECK(read > soak() / 2);  // its history has one message, so fast ones are lost
}

TEST_CASE("requests of clients that read no replies take no memory") {
  talk_over_udp_only();
  FastDdsTransport transport(
      {.domain = domain(), .reply_patience = std::chrono::milliseconds(100'000)});
  FastDdsPeer cyclone(domain(), {.poses_as_cyclone = true});
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
