// SPDX-License-Identifier: Apache-2.0
// The SocketCAN transport on a kernel's vcan0, with echo; `ip` and `tc` make the trouble.
#include <linux/can/error.h>

#include <articula/hardware/can/socketcan.hpp>

#include "catch.hpp"
#include "raw_peer.hpp"

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <thread>

#include <sys/time.h>

using namespace articula;
using support::RawPeer;
using support::shell;
using namespace std::chrono_literals;

namespace {

// Frames 181 and 281 matter, cycles are two frames long and end with 100.
const CanSubscription subscription{
    .identifiers = {0x181, 0x281}, .last_of_cycle = 0x100, .frames_per_cycle = 2};

// So long that a slow machine gets its checks done meanwhile.
constexpr auto confirmation_time = 100ms;

CanFrame frame(std::uint32_t identifier, std::uint8_t first_byte = 0) {
  CanFrame made;
  made.identifier = identifier;
  made.length = 1;
  made.data[0] = first_byte;
  return made;
}
CanBatch cycle(std::uint8_t number) {
  CanBatch batch;
  batch.push_back(frame(0x081, number));
  batch.push_back(frame(0x100, number));
  return batch;
}

struct Bench {
  Bench() {
    support::restore_interface();
    REQUIRE(transport.open(subscription) == Status::ok);
  }
  ~Bench() { support::restore_interface(); }

  /// Gives own frames time to come back, and fetches what has come.
  std::size_t receive(std::chrono::milliseconds time = 20ms) {
    std::this_thread::sleep_for(time);
    return transport.receive(received);
  }

  SocketCan transport = [] {
    support::restore_interface();
    return SocketCan("vcan0", confirmation_time);
  }();
  std::array<ReceivedCanFrame, 64> received{};
};

}  // namespace

TEST_CASE("an interface that does not exist is refused by name") {
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(SocketCan("none0"), Contains("none0") && Contains("no such interface"));
  CHECK_THROWS_WITH(SocketCan(""), Contains("not a valid name"));
  CHECK_THROWS_WITH(SocketCan("a-name-that-is-too-long"), Contains("not a valid name"));
  CHECK_THROWS_AS(SocketCan("lo"), std::runtime_error);  // not a CAN interface
  CHECK_THROWS_WITH(SocketCan("vcan0", 0ms), Contains("confirmation_time"));
}

TEST_CASE("frames pass both ways, with time stamps, and only those that were asked for") {
  Bench bench;
  const RawPeer peer;
  CHECK(bench.transport.send(cycle(7)) == CanSending::sent);
  const auto first = peer.receive(100), second = peer.receive(100);
  REQUIRE(first);
  REQUIRE(second);
  CHECK(first->can_id == 0x081);
  CHECK(second->can_id == 0x100);
  CHECK(second->data[0] == 7);

  CHECK(peer.send(0x181, {1, 2, 3}));
  CHECK(peer.send(0x182, {4}));
  CHECK(peer.send(0x181 | CAN_EFF_FLAG, {5}));
  CHECK(peer.send(0x181 | CAN_RTR_FLAG, {}));
  CHECK(peer.send(0x281, {6}));
  REQUIRE(bench.receive() == 2);
  CHECK(bench.received[0].frame.identifier == 0x181);
  CHECK(bench.received[0].frame.length == 3);
  CHECK(bench.received[0].frame.data == std::array<std::uint8_t, 8>{1, 2, 3});
  CHECK(bench.received[1].frame.identifier == 0x281);
  CHECK(bench.received[1].time >= bench.received[0].time);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  CHECK(now - bench.received[0].time < 10s);
  CHECK(now - bench.received[0].time > 0s);
}

TEST_CASE("an own cycle is confirmed, and the next is sent") {
  Bench bench;
  for (std::uint8_t k = 0; k < 10; ++k) {
    CHECK(bench.transport.send(cycle(k)) == CanSending::sent);
    CHECK(bench.receive() == 0);  // own frames do not show
  }
  CHECK(bench.transport.statistics().sent == 20);
}

TEST_CASE("while a cycle waits in the queue nothing is sent, and nothing is sent late") {
  Bench bench;
  const RawPeer peer;
  shell("tc qdisc add dev vcan0 root netem delay 400ms");
  CHECK(bench.transport.send(cycle(1)) == CanSending::sent);
  CHECK(bench.transport.send(cycle(2)) == CanSending::backlog);
  CHECK(bench.transport.send(cycle(3)) == CanSending::backlog);
  CHECK(bench.receive(confirmation_time + 20ms) == 0);  // not confirmed: counts as lost
  CHECK(bench.transport.send(cycle(4)) == CanSending::unconfirmed);
  CHECK(bench.transport.send(cycle(5)) == CanSending::backlog);
  std::this_thread::sleep_for(800ms);
  std::vector<int> seen;
  for (const can_frame& one : peer.receive_all()) {
    if (one.can_id == 0x100) seen.push_back(one.data[0]);
  }
  CHECK(seen == std::vector<int>{1, 4});
  shell("tc qdisc del dev vcan0 root");
  bench.receive();
  CHECK(bench.transport.send(cycle(6)) == CanSending::sent);
}

TEST_CASE("a full queue refuses, and what it refuses is dropped") {
  Bench bench;
  const RawPeer peer;
  shell("tc qdisc add dev vcan0 root netem delay 200ms limit 1");
  CHECK(bench.transport.send(cycle(1)) == CanSending::congested);  // one of two frames fits
  CHECK(bench.transport.statistics().not_taken == 1);
  std::this_thread::sleep_for(400ms);
  CHECK(peer.receive_all().size() == 1);
  shell("tc qdisc del dev vcan0 root");
  CHECK(bench.transport.send(cycle(2)) == CanSending::sent);
  std::this_thread::sleep_for(50ms);
  CHECK(peer.receive_all().size() == 2);  // only what is new
}

TEST_CASE("the interface goes down and comes back") {
  Bench bench;
  shell("ip link set vcan0 down");
  CHECK(bench.receive() == 0);
  CHECK(bench.transport.link() == CanLink::down);
  CHECK(bench.transport.send(cycle(1)) == CanSending::failed);
  CHECK(bench.transport.link() == CanLink::down);
  // Waiting on it is no busy loop: it takes its time.
  const auto begin = std::chrono::steady_clock::now();
  bench.transport.wait(50ms);
  CHECK(std::chrono::steady_clock::now() - begin >= 49ms);

  shell("ip link set vcan0 up");
  CHECK(bench.transport.send(cycle(2)) == CanSending::sent);
  CHECK(bench.transport.link() == CanLink::up);
  const RawPeer peer;
  CHECK(peer.send(0x181, {1}));
  CHECK(bench.receive() == 1);
}

TEST_CASE("the interface is deleted and made again") {
  Bench bench;
  shell("ip link del vcan0");
  CHECK(bench.receive() == 0);
  CHECK(bench.transport.link() == CanLink::gone);
  CHECK(bench.transport.send(cycle(1)) == CanSending::failed);
  CHECK(bench.transport.open(subscription) == Status::hardware_fault);
  CHECK(std::string(bench.transport.error()) == "no such interface");
  CHECK(bench.transport.send(cycle(1)) == CanSending::failed);
  CHECK(bench.receive() == 0);
  bench.transport.wait(1ms);

  shell("ip link add vcan0 type vcan && ip link set vcan0 up");
  CHECK(bench.transport.open(subscription) == Status::ok);
  CHECK(bench.transport.link() == CanLink::up);
  const RawPeer peer;
  CHECK(peer.send(0x181, {1}));
  CHECK(peer.send(0x182, {1}));
  CHECK(bench.receive() == 1);  // the filters are there again
  CHECK(bench.transport.send(cycle(2)) == CanSending::sent);
  CHECK(peer.receive(100));
}

TEST_CASE("opening while the interface is down works, sending when it is up") {
  Bench bench;
  shell("ip link set vcan0 down");
  CHECK(bench.transport.open(subscription) == Status::ok);
  CHECK(bench.transport.send(cycle(1)) == CanSending::failed);
  shell("ip link set vcan0 up");
  CHECK(bench.transport.send(cycle(2)) == CanSending::sent);
}

TEST_CASE("the controller's reports are counted, and bus-off shows until the socket is opened") {
  Bench bench;
  const RawPeer peer;
  CHECK(peer.send(CAN_ERR_FLAG | 0x004, {0, 0x20, 0, 0, 0, 0, 0, 0}));
  CHECK(peer.send(CAN_ERR_FLAG | 0x004, {0, 0x01, 0, 0, 0, 0, 0, 0}));
  CHECK(peer.send(CAN_ERR_FLAG | 0x020, {0, 0, 0, 0, 0, 0, 0, 0}));
  CHECK(bench.receive() == 0);
  CHECK(bench.transport.link() == CanLink::up);
  CHECK(peer.send(CAN_ERR_FLAG | 0x040, {0, 0, 0, 0, 0, 0, 0, 0}));
  CHECK(bench.receive() == 0);
  CHECK(bench.transport.link() == CanLink::bus_off);
  CHECK(peer.send(CAN_ERR_FLAG | 0x100, {0, 0, 0, 0, 0, 0, 0, 0}));
  CHECK(bench.receive() == 0);
  CHECK(bench.transport.link() == CanLink::bus_off);
  const SocketCanStatistics& statistics = bench.transport.statistics();
  CHECK(statistics.error_frames == 5);
  CHECK(statistics.restarts == 1);
  CHECK(statistics.error_passives == 1);
  CHECK(statistics.overflows == 1);
  CHECK(statistics.no_answers == 1);
  CHECK(statistics.bus_offs == 1);
  CHECK(bench.transport.open(subscription) == Status::ok);
  CHECK(bench.transport.link() == CanLink::up);
}

TEST_CASE("frames for which there was no room are counted") {
  Bench bench;
  const RawPeer peer;
  const RawPeer witness;
  const int flood = 3000;
  for (int k = 0; k < flood; ++k) {
    REQUIRE(peer.send(0x181, {static_cast<std::uint8_t>(k & 0xff)}));
    // The kernel drops frames uncounted before any socket, if over a thousand wait for delivery.
    REQUIRE(witness.receive(10'000));
  }
  std::size_t received = 0, batch = 0;
  do {
    received += batch = bench.receive(0ms);
  } while (batch > 0);
  CHECK(received < flood);
  CHECK(peer.send(0x181, {1}));  // the count comes with the next frame
  REQUIRE(witness.receive(10'000));
  received += bench.receive();
  CHECK(received + bench.transport.statistics().lost == flood + 1);
}

TEST_CASE("a signal ends the wait for a frame, and does not prolong it") {
  const Bench bench;
  struct sigaction action{};
  action.sa_handler = [](int) {};
  REQUIRE(::sigaction(SIGALRM, &action, nullptr) == 0);
  const itimerval once{{0, 0}, {0, 50'000}};
  REQUIRE(::setitimer(ITIMER_REAL, &once, nullptr) == 0);
  const auto begin = std::chrono::steady_clock::now();
  SocketCan transport("vcan0");
  transport.wait(10s);
  CHECK(std::chrono::steady_clock::now() - begin < 10s);
}

TEST_CASE("opening anew leaves nothing of the past") {
  Bench bench;
  const RawPeer peer;
  CHECK(peer.send(0x181, {1}));
  CHECK(bench.transport.open(subscription) == Status::ok);
  CHECK(bench.receive() == 0);
  SocketCan other = std::move(bench.transport);
  CHECK(other.send(cycle(1)) == CanSending::sent);
  bench.transport = std::move(other);
  CHECK(peer.send(0x181, {2}));
  CHECK(bench.receive() == 1);
}
