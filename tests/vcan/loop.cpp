// SPDX-License-Identifier: Apache-2.0
// The whole path: controller, codec, SocketCAN, kernel, can_drives with the simulated arm, and
// back. Cycles follow each other as the drives answer, since no clock of a virtual machine keeps 1
// kHz; where the bus paces the loop by a clock, it is a slow one.
#include <articula/articula.hpp>
#include <articula/hardware/cia402/cia402_codec.hpp>
#include <articula/loop/realtime/hardware_clock.hpp>
#include <articula/loop/realtime/monotonic_clock.hpp>
#include <articula/loop/run.hpp>
#include <articula/robots/q2d_can.hpp>

#include "catch.hpp"
#include "drives_process.hpp"
#include "hardware/one_period_late.hpp"
#include "protocols.hpp"
#include "raw_peer.hpp"

#ifdef ARTICULA_ALLOCATION_GUARD
#include "allocation_guard.hpp"
#endif

#include <linux/can/error.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

using namespace articula;
using support::DrivesProcess;
using support::RawPeer;
using support::shell;
using namespace std::chrono_literals;

namespace {

using CanLoop = Loop<Q2dCan, PidPlusGravity>;

/// vcan0 as it should be, before and after.
struct Interface {
  Interface() { support::restore_interface(); }
  ~Interface() { support::restore_interface(); }
};

/// One cycle, and the wait for its feedback.
template <class AnyLoop>
Status paced_update(AnyLoop& loop, std::chrono::nanoseconds patience = 200ms) {
  const Status status = loop.update();
  static_cast<void>(loop.hardware().wait_for_feedback(patience));
  return status;
}

/// Cycles until something goes wrong; true if it did within some number of cycles.
template <class AnyLoop>
bool fails_within(AnyLoop& loop, int cycles) {
  for (int k = 0; k < cycles; ++k) {
    if (paced_update(loop, 5ms) == Status::hardware_fault) return true;
  }
  return false;
}

/// How far a loop over CAN strays from the one in this process.
/// @tparam InProcess  the arm there
template <class InProcess, class AnyLoop>
JointState<2> largest_difference(AnyLoop& over_can) {
  Loop<InProcess, PidPlusGravity> in_process;
  JointState<2> largest;
  for (int k = 0; k < 2000; ++k) {
    const double side = k < 1000 ? 1 : -1;
    over_can.reference().position = {-side, side};
    in_process.reference().position = {-side, side};
    REQUIRE(over_can.update() == Status::ok);
    // As long as it takes: a busy machine may let the drives wait for seconds.
    REQUIRE(over_can.hardware().wait_for_feedback(60s) == Status::ok);
    REQUIRE(in_process.update() == Status::ok);
    const JointState<2>&a = over_can.state(), &b = in_process.state();
    largest.position = largest.position.cwiseMax((a.position - b.position).cwiseAbs());
    largest.velocity = largest.velocity.cwiseMax((a.velocity - b.velocity).cwiseAbs());
  }
  CHECK(over_can.hardware().statistics().malformed == 0);
  return largest;
}

}  // namespace

// The bounds are those of tests/hardware, where they are explained: a kernel changes no bits.
TEST_CASE("the loop over vcan follows the loop in one process") {
  const Interface interface;
  const DrivesProcess drives;
  CanLoop loop(Q2dCan("vcan0"));
  const JointState<2> largest = largest_difference<Q2dSim>(loop);
  CHECK(largest.position.maxCoeff() < 4e-5);
  CHECK(largest.velocity.maxCoeff() < 5e-3);
}

TEST_CASE("the loop over CiA 402 drives on vcan follows the loop in one process") {
  const Interface interface;
  const DrivesProcess drives({"--lockstep", "--protocol=cia402"});
  using Arm = CanHardware<Q2d, Cia402Codec<Q2d>, SocketCan>;
  Loop<Arm, PidPlusGravity> loop(Arm(Cia402Codec<Q2d>(examples::q2d_cia402), SocketCan("vcan0")));
  const JointState<2> largest = largest_difference<support::OnePeriodLate<Q2dSim>>(loop);
  CHECK(largest.position.maxCoeff() < 4e-4);
  CHECK(largest.velocity.maxCoeff() < 6e-3);
}

TEST_CASE("candump sees the documented frames") {
  const Interface interface;
  const DrivesProcess drives;
  CanLoop loop(Q2dCan("vcan0"));
  shell("candump vcan0 -n 7 > cycle.txt & sleep 1");
  REQUIRE(paced_update(loop, 2s) == Status::ok);
  std::vector<std::string> lines;
  for (int patience = 0; lines.size() < 7 && patience < 50; ++patience) {
    support::sleep_milliseconds(100);
    lines.clear();
    std::ifstream file("cycle.txt");
    for (std::string line; std::getline(file, line);) lines.push_back(line);
  }
  REQUIRE(lines.size() >= 7);
  // "  vcan0  081   [3]  00 00 2A"; a heartbeat may be among them, and has taken a place then.
  std::string all;
  for (const std::string& line : lines) all += line + '\n';
  CAPTURE(all);
  const bool has_heartbeat = all.find("  28") != std::string::npos;
  std::size_t at = 0;
  int found = 0;
  for (const char* one : {"081   [3]", "082   [3]", "100   [1]", "181   [8]", "201   [6]",
                          "182   [8]", "202   [6]"}) {
    const std::size_t next = all.find(one, at);
    if (next == std::string::npos) continue;
    at = next;
    ++found;
  }
  CHECK(found >= (has_heartbeat ? 5 : 7));
}

TEST_CASE("a run ends with a safe command and the stop, in consecutive cycles on the wire") {
  const Interface interface;
  const DrivesProcess drives;
  CanLoop loop(Q2dCan("vcan0"));
  loop.reference().position = {-0.5, 0.5};
  const RawPeer peer;
  MonotonicClock clock;
  constexpr std::uint64_t cycles = 20;
  // Nothing is fetched between the last update and the end.
  const RunReport report =
      run(loop, clock, {.cycles = cycles}, [](auto& running, const RunReport& now) {
        return now.cycles == cycles || running.hardware().wait_for_feedback(2s) == Status::ok;
      });
  CHECK(report.status == Status::ok);

  std::vector<can_frame> host;
  for (const can_frame& frame : peer.receive_all()) {
    if (frame.can_id <= quanser::sync_identifier) host.push_back(frame);
  }
  // Two efforts and SYNC, or two stops and SYNC.
  const auto stop = std::ranges::find(host, quanser::control_base + 1, &can_frame::can_id);
  REQUIRE(stop - host.begin() == 3 * (cycles + 1));
  REQUIRE(host.end() - stop >= 3);
  const auto effort = [&](int frames_before) {
    const can_frame& frame = stop[-frames_before];
    return static_cast<std::int16_t>(frame.data[0] | frame.data[1] << 8);
  };
  CHECK(effort(6) != 0);
  CHECK(effort(3) == 0);
  CHECK(effort(2) == 0);
  for (int k : {0, 1}) {  // SYNC follows SYNC by one
    const auto sync = stop + 3 * k - 1;
    CHECK(sync->data[0] == static_cast<std::uint8_t>(sync[-3].data[0] + 1));
  }
}

TEST_CASE("garbage of cansend is counted and does nothing else") {
  const Interface interface;
  const DrivesProcess drives;
  CanLoop loop(Q2dCan("vcan0"));
  loop.reference().position = {-0.5, 0.5};
  for (int k = 0; k < 50; ++k) {
    shell(
        "cansend vcan0 181#; cansend vcan0 182#FFFFFFFFFFFFFFFF; cansend vcan0 201#0080000000FF;"
        "cansend vcan0 281#FFFFFFFF; cansend vcan0 12345678#DEADBEEF; cansend vcan0 181#R;"
        "cansend vcan0 081#008000; cansend vcan0 041#FF; cansend vcan0 100#");
    REQUIRE(paced_update(loop, 2s) == Status::ok);
  }
  CHECK(loop.hardware().statistics().malformed >= 4 * 50 - 4);
}

TEST_CASE("random frames of cangen leave a loop that can be activated again") {
  const Interface interface;
  const DrivesProcess drives;
  CanLoop loop(Q2dCan("vcan0"));
  shell("cangen vcan0 -g 1 -n 3000 &");
  const JointVector<2> limits = effort_limits(Q2d());
  for (int k = 0; k < 1000; ++k) {
    static_cast<void>(paced_update(loop, 5ms));
    CHECK(is_finite(loop.command()));
    CHECK((loop.command().effort.cwiseAbs().array() <= limits.array()).all());
  }
  shell("while pidof cangen > /dev/null; do sleep 0.1; done");
  CHECK(loop.hardware().activate() == Status::ok);
  CHECK(paced_update(loop, 2s) == Status::ok);
}

TEST_CASE("faults on the bus: found as documented, and gone after activation") {
  const Interface interface;
  std::optional<DrivesProcess> drives(std::in_place);
  CanLoop loop(Q2dCan("vcan0"));
  loop.reference().position = {-0.5, 0.5};
  for (int k = 0; k < 20; ++k) static_cast<void>(paced_update(loop, 5ms));
  const RawPeer peer;
  CanCause expected = CanCause::none;
  SECTION("interface down, and up") {
    shell("ip link set vcan0 down");
    CHECK(fails_within(loop, 1));
    shell("ip link set vcan0 up");
    expected = CanCause::link_down;
  }
  SECTION("interface deleted, and made again") {
    shell("ip link del vcan0");
    CHECK(fails_within(loop, 1));
    CHECK(loop.hardware().activate() == Status::hardware_fault);
    shell("ip link add vcan0 type vcan && ip link set vcan0 up");
    expected = CanCause::link_gone;
  }
  SECTION("bus-off") {
    REQUIRE(peer.send(CAN_ERR_FLAG | CAN_ERR_BUSOFF, std::vector<std::uint8_t>(8)));
    CHECK(fails_within(loop, 1));
    expected = CanCause::bus_off;
  }
  SECTION("bus-off, and back before anybody looks") {
    REQUIRE(peer.send(CAN_ERR_FLAG | CAN_ERR_BUSOFF, std::vector<std::uint8_t>(8)));
    REQUIRE(peer.send(CAN_ERR_FLAG | CAN_ERR_RESTARTED, std::vector<std::uint8_t>(8)));
    CHECK(fails_within(loop, 1));
    expected = CanCause::bus_off;
  }
  SECTION("the queue of the interface is full") {
    shell("tc qdisc add dev vcan0 root netem delay 10s limit 1");
    CHECK(fails_within(loop, 12));
    CHECK(fails_within(loop, 12));
    shell("tc qdisc del dev vcan0 root");
    expected = CanCause::not_sent;
  }
  SECTION("the drives are killed, and started again") {
    drives.reset();
    for (int k = 0; k < 25; ++k) static_cast<void>(paced_update(loop, 5ms));
    expected = CanCause::drive_silent;
    drives.emplace();
  }
  support::sleep_milliseconds(100);
  static_cast<void>(peer.receive_all());
  // It goes on as it is, whatever comes back: no effort goes out.
  for (int k = 0; k < 50; ++k) CHECK(paced_update(loop, 5ms) == Status::hardware_fault);
  if (expected != CanCause::not_sent) CHECK(loop.hardware().fault().cause == expected);
  for (const can_frame& frame : peer.receive_all()) {
    CHECK(frame.can_id != quanser::effort_base + 1);
    CHECK(frame.can_id != quanser::effort_base + 2);
  }
  REQUIRE(loop.hardware().activate() == Status::ok);
  CHECK(paced_update(loop, 2s) == Status::ok);
}

TEST_CASE("a loop that hangs: the drives let go by their own clock") {
  const Interface interface;
  const DrivesProcess drives({"--interface=vcan0"});  // not in lockstep
  CanLoop loop(Q2dCan("vcan0"));
  loop.reference().position = {-0.5, 0.5};
  static_cast<void>(paced_update(loop));
  support::sleep_milliseconds(200);
  CHECK(fails_within(loop, 3));
  CHECK(loop.hardware().fault().cause == CanCause::drive_fault);
  CHECK(loop.hardware().fault().code == quanser::command_timeout);
}

TEST_CASE("faults that the drives play") {
  const Interface interface;
  const auto [fault, cause, joint] = GENERATE(table<std::string, CanCause, int>({
      {"fault:2@0.5", CanCause::drive_fault, 1},
      {"restart:1@0.5", CanCause::drive_disabled, 0},
      {"silence:2@0.5+0.2", CanCause::drive_silent, 1},
      {"garbage:1@0.5+0.2", CanCause::drive_silent, 0},
      {"bus-off@0.5", CanCause::bus_off, -1},
  }));
  CAPTURE(fault);
  const DrivesProcess drives({"--lockstep", "--fault=" + fault});
  CanLoop loop(Q2dCan("vcan0"));
  loop.reference().position = {-0.5, 0.5};
  CHECK(fails_within(loop, 600));
  CHECK(loop.hardware().fault().cause == cause);
  CHECK(loop.hardware().fault().joint == joint);
  for (int k = 0; k < 300; ++k) CHECK(paced_update(loop, 5ms) == Status::hardware_fault);
  REQUIRE(loop.hardware().activate() == Status::ok);
  CHECK(paced_update(loop, 2s) == Status::ok);
}

// Loop and bus have different ideas of the period, 20 and 24 ms, so that it shows who paces whom.
TEST_CASE("the loop is paced by the drives' SYNC, which stops for a moment, then for long") {
  const Interface interface;
  const DrivesProcess drives({"--protocol=cia402", "--sync-period=0.024", "--fault=no-sync@6+0.12",
                              "--fault=no-sync@9+3"});
  using Codec = Cia402Codec<Q2d, EffortCommand<2>, SyncProducer::another_node>;
  using Arm = CanHardware<Q2d, Codec, SocketCan>;
  const CanHardwareOptions patience{
      .feedback_time = 10ms, .set_up_period = 20ms, .set_up_time = 20s};
  std::array<PidGains, 2> soft{PidGains{.proportional = 100}, PidGains{.proportional = 10}};
  Loop<Arm, PidPlusGravity> loop(
      Arm(Codec(examples::q2d_cia402, 24, 1000), SocketCan("vcan0", 60ms), patience),
      PidPlusGravity<Q2d>(soft), 20e-3);
  loop.reference().position = {-0.5, 0.5};
  const RawPeer peer;
  MonotonicClock monotonic;
  HardwareClock clock(loop.hardware(), monotonic, loop.period());

  // In pace: as many cycles of the loop as SYNC, but for those that a busy machine has let slip.
  const auto heard_before = loop.hardware().codec().begun_cycles();
  std::uint64_t ok = 0;
  constexpr std::uint64_t paced_cycles = 100;
  std::uint64_t heard = 0;
  bool recovered = false;
  CanCause cause = CanCause::none;
  const RunReport report = run(loop, clock, {.cycles = 2000}, [&](auto&, const RunReport& now) {
    if (now.cycles <= paced_cycles && now.status == Status::ok) ++ok;
    if (now.cycles == paced_cycles) {
      heard = loop.hardware().codec().begun_cycles() - heard_before;
    }
    const auto unpaced = loop.hardware().statistics().unpaced;
    recovered = recovered || (unpaced >= 3 && now.status == Status::ok);
    cause = loop.hardware().fault().cause;
    if (cause != CanCause::none) return false;
    static_cast<void>(peer.receive_all());
    return true;
  });
  CAPTURE(ok, heard, clock.timeouts(), clock.skipped(), report.cycles, to_string(cause));
  CHECK(ok >= paced_cycles * 9 / 10);
  CHECK(heard >= paced_cycles * 9 / 10);
  CHECK(heard <= paced_cycles * 11 / 10);
  CHECK(recovered);
  CHECK(cause == CanCause::no_sync);

  // Without SYNC the drives are stopped through their objects, which they confirm, and get no
  // command any more.
  CHECK(loop.hardware().deactivate() == Status::ok);
  bool stopped = false;
  for (const can_frame& frame : peer.receive_all()) {
    const auto controlword = static_cast<unsigned>(frame.data[0] | frame.data[1] << 8);
    if (frame.can_id == 0x201 || frame.can_id == 0x202) CHECK(controlword == 0);
    if (frame.can_id == 0x601 && frame.data[1] == 0x40 && frame.data[2] == 0x60) {
      stopped = frame.data[4] == 0;
    }
  }
  CHECK(stopped);
  CHECK(loop.hardware().activate() == Status::ok);  // it waits until SYNC is back
  CHECK(run(loop, clock, {.cycles = 20}, [](auto&, const RunReport&) { return true; }).end ==
        RunEnd::finished);
  CHECK(loop.hardware().fault().cause == CanCause::none);
}

TEST_CASE("a CiA 402 drive that is made to leave operation is stopped, and says so") {
  const Interface interface;
  const DrivesProcess drives({"--lockstep", "--protocol=cia402"});
  using Arm = CanHardware<Q2d, Cia402Codec<Q2d>, SocketCan>;
  Loop<Arm, PidPlusGravity> loop(Arm(Cia402Codec<Q2d>(examples::q2d_cia402), SocketCan("vcan0")));
  loop.reference().position = {-0.5, 0.5};
  for (int k = 0; k < 20; ++k) REQUIRE(paced_update(loop, 60s) == Status::ok);
  const auto statusword = [] {
    const RawPeer peer;
    REQUIRE(peer.send(0x602, {0x40, 0x41, 0x60, 0, 0, 0, 0, 0}));
    while (const auto frame = peer.receive(60'000)) {
      if (frame->can_id == 0x582) return frame->data[4] | frame->data[5] << 8;
    }
    return -1;
  };
  CHECK((statusword() & 0x6f) == 0x27);  // operation enabled
  shell("cansend vcan0 000#8002");
  REQUIRE(fails_within(loop, 100));
  CHECK(loop.hardware().fault().joint == 1);
  CHECK(loop.hardware().deactivate() == Status::ok);
  CHECK((statusword() & 0x4f) == 0x40);  // switch on disabled
  REQUIRE(loop.hardware().activate() == Status::ok);
  CHECK(paced_update(loop, 2s) == Status::ok);
}

#ifdef ARTICULA_ALLOCATION_GUARD
TEST_CASE("a cycle over vcan does not touch the heap") {
  const Interface interface;
  const DrivesProcess drives;
  CanLoop loop(Q2dCan("vcan0"));
  loop.reference().position = {-0.5, 0.5};
  Status status = Status::ok;
  CHECK(articula::testing::heap_calls_in([&] {
          for (int k = 0; k < 500 && status == Status::ok; ++k) status = paced_update(loop, 2s);
        }) == 0);
  CHECK(status == Status::ok);
}
#endif

TEST_CASE("1e5 cycles with delay, loss and all kinds of trouble: nothing stale on the wire",
          "[endurance]") {
  const Interface interface;
  // What a busy machine may take for an answer; twenty times as long without one is a fault.
  constexpr auto patience = 20ms;
  const auto disturb = [] {  // the jitter makes frames overtake each other
    shell("tc qdisc add dev vcan0 root netem delay 100us 50us loss 0.2%");
  };
  disturb();
  std::optional<DrivesProcess> drives(std::in_place);
  CanLoop loop(Q2dCan("vcan0"));
  std::optional<RawPeer> peer(std::in_place);
  const JointVector<2> limits = effort_limits(Q2d());

  std::array<JointVector<2>, 256> commanded{};  // by the counter on the wire
  std::uint64_t last_on_wire = 0, efforts = 0, faults = 0, oldest = 0, failed_at = 0;
  for (int k = 0; k < 100'000; ++k) {
    const double side = (k / 700) % 2 == 0 ? 1 : -1;
    loop.reference().position = {-side, side};
    const Status status = loop.update();
    const std::uint64_t cycle = loop.hardware().codec().cycle();
    commanded[cycle % 256] = loop.command().effort;
    static_cast<void>(loop.hardware().wait_for_feedback(patience));

    for (const can_frame& frame : peer->receive_all()) {
      const auto node = static_cast<int>(frame.can_id) - static_cast<int>(quanser::effort_base);
      if (node != 1 && node != 2) continue;
      ++efforts;
      const auto value = static_cast<std::int16_t>(frame.data[0] | frame.data[1] << 8);
      const std::uint64_t age = (cycle - frame.data[2]) & 0xff;
      const std::uint64_t number = cycle - age;
      oldest = std::max(oldest, age);
      REQUIRE(std::abs(value) <= 1e3 * limits[node - 1] + 0.5);
      REQUIRE(value == std::lround(1e3 * commanded[number % 256][node - 1]));
      REQUIRE(number >= last_on_wire);                   // nothing is sent again
      REQUIRE((failed_at == 0 || number <= failed_at));  // nothing after a fault
      last_on_wire = number;
    }

    // Trouble now and then; each kind twice.
    if (k % 10'000 == 5'000) {
      CAPTURE(k, to_string(loop.hardware().fault().cause), loop.hardware().fault().code);
      REQUIRE(failed_at == 0);  // delay and loss alone are no fault
      switch (k / 10'000 % 5) {
        case 0:
          shell("ip link set vcan0 down");
          break;
        case 1:
          shell("ip link del vcan0");
          break;
        case 2:
          drives->kill();
          break;
        case 3:  // which no bus loses, since a node's own controller says so; netem may lose one
          for (int sent = 0; sent < 3; ++sent) {
            REQUIRE(peer->send(CAN_ERR_FLAG | CAN_ERR_BUSOFF, std::vector<std::uint8_t>(8)));
          }
          break;
        default:
          shell("tc qdisc change dev vcan0 root netem delay 10s limit 2");
          break;
      }
    }
    if (failed_at == 0 && status == Status::hardware_fault &&
        loop.hardware().fault().cause != CanCause::none) {
      failed_at = cycle;
      ++faults;
    }
    if (k % 10'000 == 5'100) {  // help comes
      REQUIRE(failed_at != 0);
      support::restore_interface();
      disturb();
      if (k / 10'000 % 5 == 1) {
        peer.emplace();
        drives.emplace();
      }
      if (k / 10'000 % 5 == 2) drives.emplace();
      static_cast<void>(peer->receive_all());
      REQUIRE(loop.hardware().activate() == Status::ok);
      failed_at = 0;
      last_on_wire = loop.hardware().codec().cycle();
    }
  }
  const CanStatistics& statistics = loop.hardware().statistics();
  WARN(efforts << " efforts seen, the oldest " << oldest << " cycles old; " << faults
               << " faults; of " << statistics.cycles << " cycles " << statistics.not_sent
               << " not sent, " << statistics.unconfirmed << " unconfirmed, " << statistics.partial
               << " with partial feedback");
  CHECK(faults == 10);
  CHECK(efforts > 190'000);
  // At most one cycle waits in the queue for its confirmation time, in which a few more may pass.
  CHECK(oldest <= 4);
}
