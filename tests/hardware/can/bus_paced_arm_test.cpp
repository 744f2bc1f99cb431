// SPDX-License-Identifier: Apache-2.0
// CiA 402 drives under a SYNC that another node sends: the bus paces the loop, in memory.
#include <articula/articula.hpp>
#include <articula/hardware/can/can_hardware.hpp>
#include <articula/hardware/cia402/cia402_codec.hpp>
#include <articula/hardware/cia402/simulated_cia402_drives.hpp>
#include <articula/loop/realtime/hardware_clock.hpp>
#include <articula/loop/run.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>
#include <articula/robots/q2d.hpp>

#include "catch.hpp"
#include "hardware/fake_can_bus.hpp"
#include "hardware/one_period_late.hpp"
#include "random.hpp"

#include <chrono>
#include <memory>
#include <numbers>
#include <type_traits>
#include <vector>

using namespace articula;
using namespace std::chrono_literals;
using std::chrono::nanoseconds;

namespace {

using Drives = SimulatedCia402Drives<Q2d>;
using Bus = support::FakeCanBus<Drives>;
template <SyncProducer Sync>
using ArmUnder =
    CanHardware<Q2d, Cia402Codec<Q2d, EffortCommand<2>, Sync>, support::FakeCanTransport<Drives>>;
using Arm = ArmUnder<SyncProducer::another_node>;

static_assert(PacedCanCodec<Cia402Codec<Q2d, EffortCommand<2>, SyncProducer::another_node>>);
static_assert(!PacedCanCodec<Cia402Codec<Q2d>>);
static_assert(PacingHardware<Arm> && Hardware<Arm>);
static_assert(!PacingHardware<ArmUnder<SyncProducer::host>>);  // it would wait for itself

constexpr double units_per_radian = 1048576 / (2 * std::numbers::pi);
constexpr Cia402DriveList<2> drives{{
    {.node = 5, .rated_effort = 30, .position_scale = units_per_radian, .velocity_scale = 1e6},
    {.node = 6, .rated_effort = 15, .position_scale = units_per_radian, .velocity_scale = 1e6},
}};

/// A bus on which another node sends SYNC every millisecond, and feedback takes 0.2 ms.
std::shared_ptr<Bus> make_bus() {
  const auto bus = std::make_shared<Bus>(Drives(drives));
  bus->sync = canopen::encode_sync();
  bus->sync_period = bus->next_sync = 1ms;
  bus->feedback_delay = 200us;
  return bus;
}
/// @param deadline  of the drives for commands [ms]
Arm make_arm(const std::shared_ptr<Bus>& bus, std::uint16_t deadline = 10) {
  return Arm(Cia402Codec<Q2d, EffortCommand<2>, SyncProducer::another_node>(drives, 1, deadline),
             support::FakeCanTransport<Drives>(bus));
}

/// The time of the bus, as a loop's own clock tells it.
struct BusClock {
  std::shared_ptr<Bus> bus;
  [[nodiscard]] nanoseconds now() noexcept { return bus->time; }
  nanoseconds wait_until(nanoseconds due) noexcept {
    if (due > bus->time) bus->pass(due - bus->time);
    return due;
  }
};
static_assert(LoopClock<BusClock>);

/// A loop on a bus, its clock, and what a run comes to.
struct Bench {
  std::shared_ptr<Bus> bus = make_bus();
  BusClock time{bus};
  Loop<Arm, PidPlusGravity> loop;
  HardwareClock<Arm, BusClock> clock;
  std::vector<nanoseconds> starts{};
  std::vector<Status> statuses{};

  explicit Bench(std::uint16_t deadline = 10)
      : loop(make_arm(bus, deadline)), clock(loop.hardware(), time, loop.period()) {}

  template <class Each>
  RunReport run(std::uint64_t cycles, Each each) {
    starts.clear();
    statuses.clear();
    return articula::run(loop, clock, {.cycles = cycles}, [&](auto&, const RunReport& report) {
      starts.push_back(bus->time);
      statuses.push_back(report.status);
      each(report);
      return true;
    });
  }
  RunReport run(std::uint64_t cycles) {
    return run(cycles, [](const RunReport&) {});
  }
};

/// How many cycles ended so.
std::ptrdiff_t count(const std::vector<Status>& statuses, Status status) {
  return std::count(statuses.begin(), statuses.end(), status);
}

}  // namespace

// The same bounds as for the loop that sends SYNC, see cia402_arm_test.cpp: it is the same loop,
// since a command is put into force by the SYNC after the feedback that it answers, either way.
TEST_CASE("the loop that the bus paces follows the loop in one process") {
  Bench bench;
  Loop<support::OnePeriodLate<Q2dSim>, PidPlusGravity> in_process;
  double position_difference = 0, velocity_difference = 0;
  const auto turn = [](auto& loop, std::uint64_t k) {
    const double side = (k / 1000) % 2 == 0 ? 1 : -1;
    loop.reference().position = {-side, side};
  };
  turn(bench.loop, 0);
  const RunReport report = bench.run(3000, [&](const RunReport& r) {
    turn(in_process, r.cycles - 1);
    REQUIRE(r.status == Status::ok);
    REQUIRE(in_process.update() == Status::ok);
    turn(bench.loop, r.cycles);
    const JointState<2>&a = bench.loop.state(), &b = in_process.state();
    position_difference =
        std::max(position_difference, (a.position - b.position).cwiseAbs().maxCoeff());
    velocity_difference =
        std::max(velocity_difference, (a.velocity - b.velocity).cwiseAbs().maxCoeff());
  });
  CHECK(position_difference < 4e-4);
  CHECK(velocity_difference < 6e-3);
  CHECK(bench.loop.hardware().statistics().partial <= 1);  // at construction
  CHECK(bench.loop.hardware().statistics().unpaced <= 1);
  CHECK(bench.clock.timeouts() == 0);
  CHECK(bench.clock.skipped() == 0);
  CHECK(report.missed == 0);
  CHECK(report.overruns == 0);
  CHECK(report.period.min() == 1ms);
  CHECK(report.period.max() == 1ms);
}

TEST_CASE("the host sends its commands and no SYNC, and cycles begin when feedback is there") {
  Bench bench;
  bench.bus->to_drives.clear();
  static_cast<void>(bench.run(5, [&](const RunReport&) {
    // SYNC is at whole milliseconds, and the loop has begun as soon as the feedback was there.
    CHECK(bench.bus->time % 1ms == 200us);
    REQUIRE(bench.bus->to_drives.size() == 2);
    CHECK(bench.bus->to_drives[0].identifier == 0x205);
    CHECK(bench.bus->to_drives[1].identifier == 0x206);
    bench.bus->to_drives.clear();
  }));
}

TEST_CASE("a SYNC that comes early and late by a fifth of the period paces the loop") {
  const unsigned seed = 4;
  CAPTURE(seed);
  support::Random random(seed);
  Bench bench;
  nanoseconds grid = bench.bus->next_sync;
  std::vector<nanoseconds> syncs;
  bench.bus->on_sync = [&] {
    if (bench.bus->time > 0ms) syncs.push_back(bench.bus->time);
    grid += 1ms;
    bench.bus->next_sync = grid + std::chrono::microseconds(random.integer(-200, 200));
    return true;
  };
  const RunReport report = bench.run(1000);
  bench.bus->on_sync = [] { return true; };
  CHECK(count(bench.statuses, Status::ok) == 1000);
  CHECK(report.missed == 0);
  CHECK(report.overruns == 0);
  CHECK(bench.clock.timeouts() == 0);
  CHECK(bench.loop.hardware().statistics().partial <= 1);
  REQUIRE(syncs.size() >= 1000);
  for (std::size_t k = 0; k < 1000; ++k) REQUIRE(bench.starts[k] == syncs[k] + 200us);
  // The jitter shows in the statistics: two fifths of a period, either way.
  CHECK(report.period.max() > 1300us);
  CHECK(report.period.min() < 700us);
}

TEST_CASE("SYNC that stays away: the loop goes on, and finds its pace again") {
  Bench bench;
  bench.loop.reference().position = {-0.5, 0.5};
  int silent = 0;
  const auto unpaced_before = bench.loop.hardware().statistics().unpaced;
  bench.bus->on_sync = [&] { return silent == 0 || --silent == 0; };
  // The SYNC of cycles 101 .. 105 is missing; the next one comes 0.3 ms off the grid.
  const RunReport report = bench.run(300, [&](const RunReport& r) {
    if (r.cycles == 100) silent = 6;
    if (r.cycles == 105) bench.bus->next_sync += 300us;
  });
  CHECK(report.cycles == 300);
  CHECK(bench.clock.timeouts() == 5);
  CHECK(bench.loop.hardware().statistics().unpaced == unpaced_before + 5);
  CHECK(report.latency.max() == 500us);  // half a period late, since it was waited for
  CHECK(report.missed == 0);
  // Cycles of the loop without SYNC make the figures old; the third one is too old.
  for (std::size_t k = 0; k < 300; ++k) {
    CAPTURE(k);
    CHECK(bench.statuses[k] == (k >= 103 && k < 105 ? Status::stale_state : Status::ok));
  }
  CHECK(bench.loop.hardware().fault().cause == CanCause::none);
  CHECK(bench.starts[99] % 1ms == 200us);
  CHECK(bench.starts[102] - bench.starts[101] == 1ms);  // meanwhile at the loop's own rate
  CHECK(bench.starts[200] % 1ms == 500us);              // and then in the new phase
  CHECK(bench.starts[200] - bench.starts[199] == 1ms);
}

TEST_CASE("SYNC that stays away for good is a fault, and the drives let go without it") {
  Bench bench(1000);  // their own deadline does not help
  bench.loop.reference().position = {-0.5, 0.5};
  bool silent = false;
  bench.bus->on_sync = [&] { return !silent; };
  std::uint64_t stopped_at = 0;
  static_cast<void>(bench.run(200, [&](const RunReport& r) {
    silent = r.cycles >= 100 && r.cycles < 150;
    if (r.cycles == 100) REQUIRE(bench.bus->drives.effort().norm() > 0);
    if (stopped_at == 0 && !bench.bus->drives.enabled(0)) stopped_at = r.cycles;
    if (r.cycles == 150) CHECK(bench.bus->drives.effort() == JointVector<2>(0, 0));
  }));
  const CanHardwareOptions options;
  CHECK(stopped_at == 100 + options.silent_after);
  CHECK_FALSE(bench.bus->drives.enabled(1));
  CHECK(bench.loop.hardware().fault().cause == CanCause::no_sync);
  CHECK(bench.loop.hardware().fault().joint == -1);
  // SYNC is back, the fault stays until activation.
  CHECK(bench.statuses.back() == Status::hardware_fault);
  CHECK(bench.bus->drives.effort() == JointVector<2>(0, 0));
  CHECK(bench.loop.hardware().activate() == Status::ok);
  static_cast<void>(bench.run(50));
  CHECK(count(bench.statuses, Status::ok) == 50);
}

TEST_CASE("drives let go by their own deadline when SYNC stays away") {
  Bench bench;
  bool silent = false;
  bench.bus->on_sync = [&] { return !silent; };
  static_cast<void>(bench.run(30, [&](const RunReport& r) {
    silent = r.cycles >= 5 && r.cycles < 18;
    if (r.cycles == 18) CHECK_FALSE(bench.bus->drives.enabled(0));
  }));
  CHECK(bench.loop.hardware().fault().cause == CanCause::drive_fault);
  CHECK(bench.loop.hardware().fault().code == 0x8250);
}

TEST_CASE("activation without SYNC fails and says so; deactivation lets go without it") {
  const auto bus = make_bus();
  bool silent = true;
  bus->on_sync = [&] { return !silent; };
  Arm arm = make_arm(bus, 1000);
  CHECK(arm.activate() == Status::hardware_fault);
  CHECK(arm.fault().cause == CanCause::no_sync);
  CHECK_FALSE(bus->drives.enabled(0));
  silent = false;
  REQUIRE(arm.activate() == Status::ok);
  CHECK(bus->drives.enabled(0));
  CHECK(arm.deactivate() == Status::ok);
  CHECK_FALSE(bus->drives.enabled(0));
  REQUIRE(arm.activate() == Status::ok);
  silent = true;
  CHECK(arm.deactivate() == Status::ok);  // the drives say so when asked
  CHECK_FALSE(bus->drives.enabled(0));
  CHECK_FALSE(bus->drives.enabled(1));
}

TEST_CASE("a cycle that takes too long leaves out the bus's cycles that it has used up") {
  Bench bench;
  const RunReport report = bench.run(20, [&](const RunReport& r) {
    if (r.cycles == 10) bench.bus->pass(2300us);
    if (r.cycles == 15) bench.bus->pass(900us);  // beyond the next SYNC, but not its feedback
  });
  CHECK(report.overruns == 1);
  CHECK(report.missed == 2);
  CHECK(bench.clock.skipped() >= 1);
  CHECK(bench.clock.timeouts() == 0);
  CHECK(bench.starts[10] - bench.starts[9] == 3ms);
  CHECK(bench.starts[15] - bench.starts[14] == 1ms);
  CHECK(count(bench.statuses, Status::ok) == 20);
}

TEST_CASE("SYNC at ten times its rate does not drive the loop faster than twice its own") {
  Bench bench;
  bench.bus->sync_period = 100us;
  bench.bus->feedback_delay = 20us;
  static_cast<void>(bench.run(100));
  for (std::size_t k = 1; k < 100; ++k) {
    REQUIRE(bench.starts[k] - bench.starts[k - 1] >= 500us);
  }
  CHECK(bench.clock.skipped() > 100);
}

TEST_CASE("a SYNC that comes just after the loop has gone on without it begins no cycle at once") {
  Bench bench;
  static_cast<void>(bench.run(30, [&](const RunReport& r) {
    if (r.cycles == 10) bench.bus->next_sync += 710us;
  }));
  CHECK(bench.clock.timeouts() == 1);
  CHECK(bench.clock.skipped() == 1);
  for (std::size_t k = 1; k < 30; ++k) {
    CAPTURE(k);
    CHECK(bench.starts[k] - bench.starts[k - 1] >= 500us);
    CHECK(bench.starts[k] - bench.starts[k - 1] <= 2ms);
  }
  CHECK(bench.starts[29] % 1ms == 910us);  // in its new phase
}

TEST_CASE("a drive that is silent does not shift the loop's pace") {
  Bench bench;
  bench.bus->on_feedback = [&](CanFrame& frame) {
    return bench.bus->time < 60ms || frame.identifier != 0x286;
  };
  const RunReport report = bench.run(100);
  CHECK(report.missed == 0);
  CHECK(bench.clock.timeouts() == 0);
  CHECK(bench.starts[99] - bench.starts[98] == 1ms);
  CHECK(bench.starts[99] % 1ms == CanHardwareOptions().feedback_time);
  CHECK(bench.loop.hardware().fault().cause == CanCause::drive_silent);
  CHECK(bench.loop.hardware().fault().joint == 1);
}

TEST_CASE("drives that answer another node's SYNC after the next one are late, and driven") {
  for (const auto delay : {1200us, 2200us, 3200us}) {
    CAPTURE(delay.count());
    const auto bus = make_bus();
    bus->feedback_delay = delay;
    bus->pass(500us);  // the host's cycles are half a period after SYNC
    Arm arm = make_arm(bus);
    const bool too_late = delay > 3ms;
    CHECK(arm.activate() == (too_late ? Status::hardware_fault : Status::ok));
    if (too_late) continue;
    JointState<2> state;
    for (int k = 0; k < 200; ++k) {
      bus->pass(1ms);
      REQUIRE(arm.read(state) == Status::ok);
      // Before the first marks are answered a drive may seem later than it is.
      const auto age = static_cast<std::uint32_t>(delay / 1ms);
      REQUIRE(arm.reports()[0].age >= age);
      if (k >= 20) REQUIRE(arm.reports()[0].age == age);
      REQUIRE(arm.write({{1, -1}}) == Status::ok);
    }
    CHECK(arm.deactivate() == Status::ok);
  }
}

TEST_CASE("drives that answer accesses after some cycles, and SYNC at once, are not late") {
  const int answer_delay = GENERATE(3, 5, 15, 30);  // [ms]
  const bool operational = GENERATE(false, true);   // they are, since a host that has died
  const bool start_is_lost = GENERATE(false, true);
  CAPTURE(answer_delay, operational, start_is_lost);
  const auto bus = make_bus();
  int to_lose = start_is_lost ? 1 : 0;
  Arm dead = make_arm(bus);
  if (operational) REQUIRE(dead.activate() == Status::ok);
  bus->answer_delay = std::chrono::milliseconds(answer_delay);
  bus->pass(500us);  // the host's cycles are half a period after SYNC
  bus->on_command = [&](CanFrame& frame) {
    const bool starts = frame == canopen::encode(canopen::NmtCommand::start, 6);
    return !starts || to_lose-- <= 0;
  };
  Arm arm = make_arm(bus);
  REQUIRE(arm.activate() == Status::ok);
  JointState<2> state;
  for (int k = 0; k < 100; ++k) {
    bus->pass(1ms);
    REQUIRE(arm.read(state) == Status::ok);
    REQUIRE(arm.reports()[0].age == 0);
    REQUIRE(arm.reports()[1].age == 0);
    REQUIRE(arm.write({{1, -1}}) == Status::ok);
  }
  CHECK(arm.deactivate() == Status::ok);
}

TEST_CASE("SYNC may have a counter, and no more than that") {
  Cia402Codec<Q2d, EffortCommand<2>, SyncProducer::another_node> codec(drives);
  CanFrame sync = canopen::encode_sync();
  CHECK(codec.decode(sync) == CanDecoding::accepted);
  sync.length = 1;
  sync.data[0] = 200;
  CHECK(codec.decode(sync) == CanDecoding::accepted);
  CHECK(codec.begun_cycles() == 2);
  sync.length = 2;
  CHECK(codec.decode(sync) == CanDecoding::malformed);
  sync.length = 0;
  sync.extended = true;
  CHECK(codec.decode(sync) == CanDecoding::foreign);
  CHECK(codec.begun_cycles() == 2);
  const CanSubscription subscription = codec.subscription();
  CHECK(std::count(subscription.identifiers.begin(), subscription.identifiers.end(), 0x080U) == 1);
  CHECK(subscription.last_of_cycle == 0x206);
  // Of the codec that sends SYNC itself, another's is nobody's.
  CHECK(Cia402Codec<Q2d>(drives).decode(canopen::encode_sync()) == CanDecoding::foreign);
}

TEST_CASE("drives that expect the counter of another node's SYNC keep it") {
  SimulatedCia402Quirks quirks;
  quirks.sync_counter = 10;
  const auto bus = std::make_shared<Bus>(Drives(drives, {}, {quirks, quirks}));
  bus->sync = canopen::encode_sync();
  bus->sync.length = 1;
  bus->sync_period = bus->next_sync = 1ms;
  Arm arm = make_arm(bus);
  CHECK(arm.activate() == Status::ok);
  CHECK(bus->drives.node(0).value({0x1019, 0}) == 10);
  CHECK(arm.deactivate() == Status::ok);
}

TEST_CASE("the host's heartbeat is a watchdog where another node sends SYNC, too") {
  Cia402DriveList<2> list = drives;
  for (Cia402Drive& drive : list) drive.watchdog = Cia402Watchdog::heartbeat;
  const auto bus = make_bus();
  Arm arm{Cia402Codec<Q2d, EffortCommand<2>, SyncProducer::another_node>(list),
          support::FakeCanTransport<Drives>(bus)};
  REQUIRE(arm.activate() == Status::ok);
  JointState<2> state;
  for (int k = 0; k < 50; ++k) {
    bus->pass(1ms);
    REQUIRE(arm.read(state) == Status::ok);
    REQUIRE(arm.write({{3, -3}}) == Status::ok);
  }
  // The RPDOs' identifier ends the cycle's output.
  CHECK(bus->to_drives.back().identifier == arm.codec().subscription().last_of_cycle);
  bus->pass(12ms);  // the host is gone, SYNC is not
  CHECK_FALSE(bus->drives.enabled(0));
  CHECK_FALSE(bus->drives.enabled(1));
}

TEST_CASE("a link that fails does not turn the wait into a busy one") {
  Bench bench;
  bench.bus->on_sync = [&] { return bench.bus->link == CanLink::up; };
  const RunReport report = bench.run(30, [&](const RunReport& r) {
    if (r.cycles == 10) bench.bus->link = CanLink::down;
  });
  bench.bus->on_sync = [] { return true; };
  CHECK(report.latency.max() == 500us);
  CHECK(bench.starts[29] - bench.starts[28] == 1ms);
  CHECK(bench.loop.hardware().fault().cause == CanCause::link_down);
}

TEST_CASE("the bus paces a supervised loop, too") {
  const auto bus = make_bus();
  BusClock time{bus};
  SupervisedLoop<Arm, PidPlusGravity> loop(make_arm(bus));
  HardwareClock clock(loop.hardware(), time, loop.period());
  loop.request_activation();
  LoopMode mode = LoopMode::inactive;
  const RunReport report = run(loop, clock, {.cycles = 100}, [&](auto&, const RunReport&) {
    mode = loop.mode();
    return true;
  });
  CHECK(mode == LoopMode::active);
  CHECK(report.status == Status::ok);
  CHECK_FALSE(bus->drives.enabled(0));
}
