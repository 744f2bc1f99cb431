// SPDX-License-Identifier: Apache-2.0
// Drives behind an adapter that takes its time: their answers come later than one period.
#include <articula/articula.hpp>
#include <articula/hardware/can/can_hardware.hpp>
#include <articula/hardware/cia402/cia402_codec.hpp>
#include <articula/hardware/cia402/simulated_cia402_drives.hpp>
#include <articula/hardware/quanser/quanser_codec.hpp>
#include <articula/hardware/quanser/simulated_quanser_drives.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>
#include <articula/robots/q2d.hpp>

#include "catch.hpp"
#include "hardware/fake_can_bus.hpp"

#include <chrono>
#include <memory>

using namespace articula;
using namespace std::chrono_literals;

namespace {

struct Quanser {
  using Drives = SimulatedQuanserDrives<Q2d>;
  using Codec = QuanserCodec<Q2d>;
  static constexpr QuanserModules<2> list{{
      {.node = 1, .gear_ratio = 100, .load_counts_per_turn = 65536},
      {.node = 2, .gear_ratio = 80, .load_counts_per_turn = 65536},
  }};
};

struct Cia402 {
  using Drives = SimulatedCia402Drives<Q2d>;
  using Codec = Cia402Codec<Q2d>;
  static constexpr Cia402DriveList<2> list{{
      {.node = 5, .rated_effort = 30, .position_scale = 1e5, .velocity_scale = 1e6},
      {.node = 6, .rated_effort = 15, .position_scale = 1e5, .velocity_scale = 1e6},
  }};
};

/// A supervised loop at 1 kHz on a bus with delays.
template <class Protocol>
struct Bench {
  using Drives = typename Protocol::Drives;
  using Codec = typename Protocol::Codec;
  using Bus = support::FakeCanBus<Drives>;
  using Arm = CanHardware<Q2d, Codec, support::FakeCanTransport<Drives>>;

  std::shared_ptr<Bus> bus = std::make_shared<Bus>(Drives(Protocol::list));
  SupervisedLoop<Arm, PidPlusGravity> loop{
      Arm(Codec(Protocol::list), support::FakeCanTransport<Drives>(bus))};

  /// @param delay  each way; the later frames of a cycle take 0.27 ms more
  explicit Bench(std::chrono::nanoseconds delay) {
    bus->command_delay = bus->feedback_delay = delay;
    pass_feedback();
  }
  void pass_feedback() {
    bus->on_feedback = [this, delay = bus->command_delay, number = 0](CanFrame&) mutable {
      bus->feedback_delay = delay + (++number % 2 == 0 ? 270us : 0us);
      return true;
    };
  }
  Status cycle() {
    const Status status = loop.update();
    bus->pass(1ms);
    return status;
  }
  void cycles(int count) {
    for (int k = 0; k < count; ++k) static_cast<void>(cycle());
  }
};

}  // namespace

// With 400 and 870 us each way the frames of one cycle come on both sides of a SYNC. 1200 us make
// figures that are two cycles old, which is the oldest that counts as fresh.
TEMPLATE_TEST_CASE("drives that answer late are enabled, driven, stopped and enabled again", "",
                   Quanser, Cia402) {
  const std::chrono::microseconds delay = GENERATE(400us, 700us, 870us, 1200us);
  CAPTURE(delay.count());
  Bench<TestType> bench(delay);
  auto& loop = bench.loop;
  loop.request_activation();
  bench.cycles(10);
  REQUIRE(loop.mode() == LoopMode::active);
  for (int k = 0; k < 300; ++k) REQUIRE(bench.cycle() == Status::ok);
  JointState<2> state;
  CHECK(loop.hardware().read(state) == Status::ok);
  std::uint32_t age = 0;
  for (const DriveReport& report : loop.hardware().reports()) age = std::max(age, report.age);
  CHECK(age == (2 * delay + 270us) / 1ms);

  bench.bus->on_feedback = [](CanFrame&) { return false; };
  bench.cycles(40);
  REQUIRE(loop.mode() == LoopMode::fault);
  bench.pass_feedback();
  loop.acknowledge_fault();
  bench.cycles(1);
  CHECK(loop.mode() == LoopMode::inactive);
  CHECK_FALSE(bench.bus->drives.enabled(0));
  loop.request_activation();
  bench.cycles(10);
  CHECK(loop.mode() == LoopMode::active);
  CHECK(loop.stop() == Status::ok);
  CHECK_FALSE(bench.bus->drives.enabled(0));
  CHECK_FALSE(bench.bus->drives.enabled(1));
}

TEST_CASE("a drive that answers an access late is stopped by the first acknowledge") {
  const int answer_delay = GENERATE(0, 13, 15, 20, 95);  // [ms]
  CAPTURE(answer_delay);
  Bench<Cia402> bench(0us);
  auto& loop = bench.loop;
  bench.bus->on_feedback = [](CanFrame&) { return true; };
  bench.bus->answer_delay = std::chrono::milliseconds(answer_delay);
  loop.request_activation();
  bench.cycles(10);
  REQUIRE(loop.mode() == LoopMode::active);
  bench.bus->accept(canopen::encode(canopen::NmtCommand::enter_pre_operational, 5));
  bench.cycles(50);
  REQUIRE(loop.mode() == LoopMode::fault);
  loop.acknowledge_fault();
  bench.cycles(1);
  CHECK(loop.mode() == LoopMode::inactive);
  CHECK_FALSE(bench.bus->drives.enabled(0));
  CHECK_FALSE(bench.bus->drives.enabled(1));
  CHECK(loop.hardware().deactivate() == Status::ok);
}

TEST_CASE("drives behind a queue as long as any are not activated") {
  const auto sync = GENERATE(SyncProducer::host, SyncProducer::another_node);
  const int lag = GENERATE(3, 20, 40, 63, 64, 70, 99, 100, 101, 150, 277);  // [cycles]
  const bool operational = GENERATE(false, true);  // they are, since a host that has died
  CAPTURE(sync == SyncProducer::host, lag, operational);
  const auto check = [&]<SyncProducer Sync> {
    using Drives = Cia402::Drives;
    const auto bus = std::make_shared<support::FakeCanBus<Drives>>(Drives(Cia402::list));
    using Codec = Cia402Codec<Q2d, EffortCommand<2>, Sync>;
    if (Sync == SyncProducer::another_node) {
      bus->sync = canopen::encode_sync();
      bus->sync_period = bus->next_sync = 1ms;
    }
    using Arm = CanHardware<Q2d, Codec, support::FakeCanTransport<Drives>>;
    const auto make_arm = [&] {
      return Arm(Codec(Cia402::list), support::FakeCanTransport<Drives>(bus));
    };
    Arm dead = make_arm(), arm = make_arm();
    if (operational) REQUIRE(dead.activate() == Status::ok);
    bus->feedback_delay = bus->answer_delay = std::chrono::milliseconds(lag) + 500us;
    CHECK(arm.activate() == Status::hardware_fault);
    CHECK(arm.fault().joint == 0);
    CHECK_FALSE(bus->drives.enabled(0));
    CHECK_FALSE(bus->drives.enabled(1));
  };
  if (sync == SyncProducer::host) return check.operator()<SyncProducer::host>();
  check.operator()<SyncProducer::another_node>();
}

TEST_CASE("a queue that gets shorter during the set-up does not make old feedback new") {
  const int end = GENERATE(range(3600, 4000, 25));  // of the long queue [ms]
  const int rest = GENERATE(4, 19);                 // the lag after that [cycles]
  CAPTURE(end, rest);
  Bench<Cia402> bench(0us);
  auto& bus = *bench.bus;
  auto& arm = bench.loop.hardware();
  bus.on_feedback = [](CanFrame&) { return true; };
  bus.feedback_delay = 80'500us;  // of answers to accesses as well, in one queue
  bus.on_command = [&](CanFrame&) {
    if (bus.time >= std::chrono::milliseconds(end)) {
      bus.feedback_delay = std::chrono::milliseconds(rest) + 500us;
    }
    return true;
  };
  int good = 0;
  if (arm.activate() == Status::ok) {
    JointState<2> state;
    for (int k = 0; k < 100; ++k) {
      bus.pass(1ms);
      good += arm.read(state) == Status::ok ? 1 : 0;
      static_cast<void>(arm.write({{1, -1}}));
    }
  }
  CHECK(good == 0);
}

TEST_CASE("slow drives that are ready at different times are enabled") {
  const int answer_delay = GENERATE(60, 80, 95, 120);            // [ms]
  const double transition = GENERATE(0.0, 0.1, 0.25, 0.3, 0.5);  // of the second drive [s]
  CAPTURE(answer_delay, transition);
  using Drives = Cia402::Drives;
  const SimulatedCia402Quirks slow{.has_velocity = false, .transition_time = transition};
  const auto bus = std::make_shared<support::FakeCanBus<Drives>>(
      Drives(Cia402::list, {}, {SimulatedCia402Quirks(), slow}));
  bus->answer_delay = std::chrono::milliseconds(answer_delay);
  CanHardware<Q2d, Cia402Codec<Q2d>, support::FakeCanTransport<Drives>> arm{
      Cia402Codec<Q2d>(Cia402::list), support::FakeCanTransport<Drives>(bus)};
  CHECK(arm.activate() == Status::ok);
}

TEST_CASE("a queue that comes back is not taken for lost feedback") {
  const int before = GENERATE(6, 30);          // cycles of lag during the set-up
  const int rest = GENERATE(range(0, 45, 3));  // from the drives' enabling to the queue's end [ms]
  CAPTURE(before, rest);
  std::chrono::nanoseconds enabled{};
  Bench<Cia402> bench(0us);
  auto& bus = *bench.bus;
  auto& arm = bench.loop.hardware();
  bus.on_feedback = [](CanFrame&) { return true; };
  bus.feedback_delay = std::chrono::milliseconds(before) + 500us;  // of answers as well
  bus.on_command = [&](CanFrame&) {
    const bool are = bus.drives.enabled(0) && bus.drives.enabled(1);
    if (are && enabled.count() == 0) enabled = bus.time;
    const bool ends = enabled.count() > 0 && bus.time - enabled >= std::chrono::milliseconds(rest);
    if (ends) bus.feedback_delay = 0us;
    return true;
  };
  if (arm.activate() != Status::ok) return;
  bus.on_command = [](CanFrame&) { return true; };
  JointState<2> state;
  const auto cycles = [&](int count) {
    Status last = Status::ok;
    for (int k = 0; k < count; ++k) {
      bus.pass(1ms);
      last = arm.read(state);
      static_cast<void>(arm.write({{1, -1}}));
    }
    return last;
  };
  bus.feedback_delay = 0us;
  CHECK(cycles(500) == Status::ok);
  bus.feedback_delay = 4500us;
  CHECK(cycles(100) == Status::hardware_fault);
}

TEST_CASE("a drive that does not get the command to leave operation gets it again") {
  const int lag = GENERATE(0, 6, 20);  // [cycles]
  CAPTURE(lag);
  using Codec = Cia402Codec<Q2d, EffortCommand<2>, SyncProducer::another_node>;
  using Drives = Cia402::Drives;
  using Arm = CanHardware<Q2d, Codec, support::FakeCanTransport<Drives>>;
  const auto bus = std::make_shared<support::FakeCanBus<Drives>>(Drives(Cia402::list));
  bus->sync = canopen::encode_sync();
  bus->sync_period = bus->next_sync = 1ms;
  const auto make_arm = [&] {
    return Arm(Codec(Cia402::list), support::FakeCanTransport<Drives>(bus));
  };
  int to_lose = 2;
  Arm dead = make_arm(), arm = make_arm();
  REQUIRE(dead.activate() == Status::ok);
  bus->pass(500us);
  bus->feedback_delay = bus->answer_delay = std::chrono::milliseconds(lag);
  bus->on_command = [&](CanFrame& frame) {
    const auto command = canopen::NmtCommand::enter_pre_operational;
    const bool leaves =
        frame == canopen::encode(command, 5) || frame == canopen::encode(command, 6);
    return !leaves || to_lose-- <= 0;
  };
  CHECK(arm.activate() == (lag == 0 ? Status::ok : Status::hardware_fault));
  CHECK(to_lose < 0);
}

TEMPLATE_TEST_CASE("drives that answer too late for reading are not activated", "", Quanser,
                   Cia402) {
  Bench<TestType> bench(1700us);  // the feedback is three cycles old
  CHECK(bench.loop.hardware().activate() == Status::hardware_fault);
  CHECK(bench.loop.hardware().fault().cause == CanCause::no_activation);
  CHECK_FALSE(bench.bus->drives.enabled(0));
  CHECK_FALSE(bench.bus->drives.enabled(1));
}
