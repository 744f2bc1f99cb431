// SPDX-License-Identifier: Apache-2.0
// What stops CiA 402 drives when the host is gone, and that nothing complains after a clean end.
#include <articula/articula.hpp>
#include <articula/hardware/can/can_hardware.hpp>
#include <articula/hardware/cia402/cia402_codec.hpp>
#include <articula/hardware/cia402/simulated_cia402_drives.hpp>
#include <articula/robots/q2d.hpp>

#include "catch.hpp"
#include "hardware/fake_can_bus.hpp"

#include <chrono>
#include <memory>

using namespace articula;
using namespace std::chrono_literals;

namespace {

using Drives = SimulatedCia402Drives<Q2d>;
using Bus = support::FakeCanBus<Drives>;
using Arm = CanHardware<Q2d, Cia402Codec<Q2d>, support::FakeCanTransport<Drives>>;

/// Two drives with the same watchdog.
constexpr Cia402DriveList<2> drives_with(Cia402Watchdog watchdog, std::uint8_t host_node = 127) {
  return {{{.node = 5,
            .rated_effort = 30,
            .position_scale = 1e5,
            .watchdog = watchdog,
            .host_node = host_node},
           {.node = 6,
            .rated_effort = 15,
            .position_scale = 1e5,
            .watchdog = watchdog,
            .host_node = host_node}}};
}

/// The drives, the second of which has the quirks, and the arm.
struct Bench {
  explicit Bench(Cia402Watchdog watchdog, const SimulatedCia402Quirks& quirks = {},
                 std::uint16_t deadline = 10)
      : bus(std::make_shared<Bus>(
            Drives(drives_with(watchdog), {}, {SimulatedCia402Quirks(), quirks}))),
        arm(Cia402Codec<Q2d>(drives_with(watchdog), 1, deadline),
            support::FakeCanTransport<Drives>(bus)) {
    // Counts emergency messages by their codes.
    bus->on_feedback = [this](CanFrame& frame) {
      if (const auto emergency = canopen::decode_emergency(frame)) {
        ++(emergency->code == 0x8250 ? lost_commands : other_emergencies);
        if (emergency->code == 0x8130) ++lost_heartbeats;
      }
      return true;
    };
  }
  ~Bench() {
    bus->on_feedback = bus->on_command = [](CanFrame&) { return true; };
  }

  void cycles(int count) {
    JointState<2> state;
    for (int k = 0; k < count; ++k) {
      reading = arm.read(state);
      static_cast<void>(arm.write({{3, -3}}));
    }
  }
  /// The host does not say anything any more, as after `kill -9`.
  /// @return periods until no drive exerts effort, at most 1000
  int fall_silent() {
    int periods = 0;
    while (bus->drives.effort() != JointVector<2>(0, 0) && ++periods < 1000) bus->silent_period();
    return periods;
  }
  [[nodiscard]] std::uint32_t value(std::uint16_t index, std::uint8_t subindex = 0) const {
    return bus->drives.node(1).value({index, subindex});
  }

  int lost_commands = 0, lost_heartbeats = 0, other_emergencies = 0;
  std::shared_ptr<Bus> bus;
  Arm arm;
  Status reading = Status::ok;
};

}  // namespace

TEST_CASE("a drive without the deadline for commands is refused, by name") {
  Bench bench(Cia402Watchdog::commands, {.has_deadline = false});
  CHECK(bench.arm.activate() == Status::hardware_fault);
  CHECK(bench.arm.fault().cause == CanCause::no_watchdog);
  CHECK(bench.arm.fault().joint == 1);
  CHECK(bench.arm.fault().object == canopen::ObjectAddress{0x1400, 5});
  CHECK(bench.arm.fault().abort_code == 0x0602'0000);
  CHECK_FALSE(bench.bus->drives.enabled(0));
  const std::string text = describe(bench.arm.fault());
  CAPTURE(text);
  CHECK(text.find("watchdog") != std::string::npos);
  CHECK(text.find("1400h,5") != std::string::npos);
}

TEST_CASE("a drive without the host's heartbeat as watchdog is refused, by name") {
  Bench bench(Cia402Watchdog::heartbeat, {.has_heartbeat_consumer = false});
  CHECK(bench.arm.activate() == Status::hardware_fault);
  CHECK(bench.arm.fault().cause == CanCause::no_watchdog);
  CHECK(bench.arm.fault().joint == 1);
  CHECK(bench.arm.fault().object == canopen::ObjectAddress{0x1016, 1});
}

TEST_CASE("a drive that would not stop without the host's heartbeat is refused, by name") {
  const auto refused = [](const SimulatedCia402Quirks& quirks, std::uint32_t abort_code) {
    Bench bench(Cia402Watchdog::heartbeat, quirks);
    CHECK(bench.arm.activate() == Status::hardware_fault);
    CHECK(bench.arm.fault().cause == CanCause::no_watchdog);
    CHECK(bench.arm.fault().joint == 1);
    CHECK(bench.arm.fault().object == cia402::abort_connection);
    CHECK(bench.arm.fault().abort_code == abort_code);
    CHECK_FALSE(bench.bus->drives.enabled(0));
    CHECK_FALSE(bench.bus->drives.enabled(1));
  };
  refused({.has_abort_connection = false}, 0x0602'0000);
  refused({.abort_connection_is_fixed = true, .abort_connection = 0}, 0x0601'0002);
  refused({.abort_connection_is_fixed = true, .abort_connection = 0xffff}, 0x0601'0002);
}

TEST_CASE("a drive whose stop without the host's heartbeat is fixed is used") {
  const auto option = GENERATE(as<std::uint16_t>(), 1, 2, 3);
  // Every request is repeated before its answer, so that each refusal comes twice.
  const auto answer_delay = std::chrono::milliseconds(GENERATE(0, 120));
  CAPTURE(option, answer_delay.count());
  Bench bench(Cia402Watchdog::heartbeat,
              {.abort_connection_is_fixed = true, .abort_connection = option});
  bench.bus->answer_delay = answer_delay;
  REQUIRE(bench.arm.activate() == Status::ok);
  CHECK(bench.value(0x6007) == option);
  bench.cycles(20);
  CHECK(bench.fall_silent() <= 11);
}

TEST_CASE("other watchdogs need no stop without the host's heartbeat") {
  const Cia402Watchdog watchdog = GENERATE(Cia402Watchdog::commands, Cia402Watchdog::none);
  CHECK(Bench(watchdog, {.has_abort_connection = false}).arm.activate() == Status::ok);
}

TEST_CASE("a drive's own objects choose its stop without the host's heartbeat, but not none") {
  for (const std::uint16_t option : {std::uint16_t{2}, std::uint16_t{0}}) {
    auto list = drives_with(Cia402Watchdog::heartbeat);
    list[1].objects = {{cia402::abort_connection, option, 2}};
    const auto bus = std::make_shared<Bus>(Drives(list));
    Arm arm{Cia402Codec<Q2d>(list), support::FakeCanTransport<Drives>(bus)};
    CAPTURE(option);
    CHECK(arm.activate() == (option == 2 ? Status::ok : Status::hardware_fault));
    CHECK(bus->drives.node(1).value(cia402::abort_connection) == option);
    if (option == 0) CHECK(arm.fault().cause == CanCause::no_watchdog);
  }
}

TEST_CASE("a drive without watchdog is used where that is said") {
  Bench bench(Cia402Watchdog::none, {.has_deadline = false, .has_heartbeat_consumer = false});
  REQUIRE(bench.arm.activate() == Status::ok);
  bench.cycles(10);
  CHECK(bench.reading == Status::ok);
  CHECK(bench.fall_silent() == 1000);  // which is what that means
}

TEST_CASE("each watchdog stops the drives within its deadline and one period") {
  const Cia402Watchdog watchdog = GENERATE(Cia402Watchdog::commands, Cia402Watchdog::heartbeat);
  const int deadline = GENERATE(4, 10, 50);
  CAPTURE(static_cast<int>(watchdog), deadline);
  // The drives do nothing of themselves when they leave operation, and have only this watchdog.
  const bool beats = watchdog == Cia402Watchdog::heartbeat;
  Bench bench(watchdog, {.has_deadline = !beats, .has_heartbeat_consumer = beats},
              static_cast<std::uint16_t>(deadline));
  REQUIRE(bench.arm.activate() == Status::ok);
  bench.cycles(200);
  REQUIRE(bench.reading == Status::ok);
  REQUIRE(bench.bus->drives.effort()[1] == Approx(-3));
  CHECK(bench.fall_silent() <= deadline + 1);
  bench.bus->silent_period();
  CHECK((beats ? bench.lost_heartbeats : bench.lost_commands) == 2);
  bench.cycles(beats ? 25 : 3);  // without heartbeats they have left operation, and are silent
  if (beats) CHECK(bench.arm.fault().cause != CanCause::none);
  if (!beats) CHECK(bench.arm.fault().cause == CanCause::drive_fault);
  CHECK(bench.arm.activate() == Status::ok);
  CHECK(bench.bus->drives.enabled(1));
}

TEST_CASE("the host's heartbeats come often enough for two to be lost, and no oftener") {
  Bench bench(Cia402Watchdog::heartbeat, {}, 12);
  REQUIRE(bench.arm.activate() == Status::ok);
  bench.bus->to_drives.clear();
  bench.cycles(400);
  const CanFrame beat = canopen::encode(canopen::NmtState::operational, 127);
  const auto& wire = bench.bus->to_drives;
  CHECK(std::count(wire.begin(), wire.end(), beat) == 100);
  CHECK(bench.value(0x1016, 1) == 0x007f'000c);
  // Two of three do not arrive.
  int number = 0;
  bench.bus->on_command = [&](CanFrame& frame) { return frame != beat || ++number % 3 == 0; };
  bench.cycles(400);
  CHECK(bench.reading == Status::ok);
  CHECK(bench.lost_heartbeats == 0);
}

TEST_CASE("nothing complains after a clean end") {
  const Cia402Watchdog watchdog = GENERATE(Cia402Watchdog::commands, Cia402Watchdog::heartbeat);
  const bool is_open = GENERATE(true, false);
  CAPTURE(static_cast<int>(watchdog), is_open);
  Bench bench(watchdog, {.is_open_in_operation = is_open});
  for (int turn = 0; turn < 2; ++turn) {
    REQUIRE(bench.arm.activate() == Status::ok);
    bench.cycles(20);
    CHECK(bench.reading == Status::ok);
    CHECK(bench.arm.deactivate() == Status::ok);
    CHECK(bench.value(0x1400, 5) == 0);
    CHECK(bench.value(0x1016, 1) == 0);
    for (int k = 0; k < 100; ++k) bench.bus->silent_period();
    bench.cycles(20);  // the loop goes on, inactive, and ends
    for (int k = 0; k < 100; ++k) bench.bus->silent_period();
    CHECK(bench.lost_commands == 0);
    CHECK(bench.lost_heartbeats == 0);
    CHECK(bench.other_emergencies == 0);
  }
}

TEST_CASE("nothing complains after an activation that failed") {
  Bench bench(Cia402Watchdog::commands, {.has_deadline = false});
  CHECK(bench.arm.activate() == Status::hardware_fault);
  for (int k = 0; k < 100; ++k) bench.bus->silent_period();
  CHECK(bench.lost_commands == 0);
  CHECK(bench.bus->drives.node(0).value({0x1400, 5}) == 0);
}

TEST_CASE("a drive that does not let go keeps its watchdog") {
  Bench bench(Cia402Watchdog::commands, {}, 1000);
  REQUIRE(bench.arm.activate() == Status::ok);
  bench.cycles(10);
  bench.bus->on_command = [](CanFrame& frame) {  // no command to let go reaches the second drive
    const auto request = canopen::decode_request(frame);
    const bool stops = request && request->address == cia402::controlword;
    const bool commands_node = frame.identifier == canopen::nmt_identifier;
    return frame.identifier != 0x206 && !(frame.identifier == 0x606 && stops) && !commands_node;
  };
  CHECK(bench.arm.deactivate() == Status::hardware_fault);
  CHECK(bench.bus->drives.enabled(1));
  CHECK(bench.value(0x1400, 5) == 1000);
  CHECK(bench.bus->drives.node(0).value({0x1400, 5}) == 0);
  CHECK(bench.fall_silent() < 1000);
  CHECK(bench.lost_commands == 1);
}

TEST_CASE("activation takes as long as it takes without a watchdog of the last one firing") {
  // The last host was killed: the drives still watch for its heartbeats.
  Bench bench(Cia402Watchdog::heartbeat);
  REQUIRE(bench.arm.activate() == Status::ok);
  bench.cycles(10);
  REQUIRE(bench.arm.activate() == Status::ok);  // without a deactivation
  CHECK(bench.lost_heartbeats == 0);
  bench.cycles(10);
  CHECK(bench.reading == Status::ok);
}

TEST_CASE("a host node that makes no sense is refused, by name") {
  using Catch::Matchers::Contains;
  const auto refused = [](Cia402DriveList<2> list, const char* words) {
    CHECK_THROWS_WITH(Cia402Codec<Q2d>(list), Contains("host_node") && Contains(words));
  };
  refused(drives_with(Cia402Watchdog::heartbeat, 0), "0 is not within 1 .. 127");
  refused(drives_with(Cia402Watchdog::heartbeat, 128), "128 is not within 1 .. 127");
  refused(drives_with(Cia402Watchdog::heartbeat, 6), "6 is the node of a drive");
  auto list = drives_with(Cia402Watchdog::heartbeat);
  list[1].host_node = 126;
  refused(list, "differs");
}
