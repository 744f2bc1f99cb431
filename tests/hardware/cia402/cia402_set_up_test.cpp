// SPDX-License-Identifier: Apache-2.0
// Drives that lack something, or do it in their own way, as many real ones do.
#include <articula/articula.hpp>
#include <articula/hardware/can/can_hardware.hpp>
#include <articula/hardware/cia402/cia402_codec.hpp>
#include <articula/hardware/cia402/simulated_cia402_drives.hpp>
#include <articula/robots/q2d.hpp>

#include "catch.hpp"
#include "hardware/fake_can_bus.hpp"

#include <chrono>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

using namespace articula;
using namespace std::chrono_literals;

namespace {

using Drives = SimulatedCia402Drives<Q2d>;
using Bus = support::FakeCanBus<Drives>;
template <class Command>
using ArmOf = CanHardware<Q2d, Cia402Codec<Q2d, Command>, support::FakeCanTransport<Drives>>;

constexpr double units_per_radian = 1048576 / (2 * std::numbers::pi);
constexpr Cia402DriveList<2> drives{{
    {.node = 5, .rated_effort = 30, .position_scale = units_per_radian, .velocity_scale = 1e6},
    {.node = 6, .rated_effort = 15, .position_scale = units_per_radian, .velocity_scale = 1e6},
}};

/// Two drives, of which the second has the quirks, and the arm that uses them.
template <class Command = EffortCommand<2>>
struct Bench {
  explicit Bench(const SimulatedCia402Quirks& quirks, const Cia402DriveList<2>& list = drives,
                 const CanHardwareOptions& options = {})
      : bus(std::make_shared<Bus>(Drives(list, {}, {SimulatedCia402Quirks(), quirks}))),
        arm(Cia402Codec<Q2d, Command>(list), support::FakeCanTransport<Drives>(bus), options) {}

  /// Cycles with a command; true if each was ok.
  bool cycles(int count, const Command& command) {
    bool ok = true;
    for (int k = 0; k < count; ++k) {
      ok = arm.read(state) == Status::ok && ok;
      ok = arm.write(command) == Status::ok && ok;
    }
    return ok;
  }
  [[nodiscard]] std::uint32_t value(std::uint16_t index, std::uint8_t subindex = 0) const {
    return bus->drives.node(1).value({index, subindex});
  }

  std::shared_ptr<Bus> bus;
  ArmOf<Command> arm;
  JointState<2> state{};
};

/// Drives with this quirk are enabled, obey, say where they are, and let go.
template <class Command = EffortCommand<2>>
void check_drives(const SimulatedCia402Quirks& quirks) {
  Bench<Command> bench(quirks);
  REQUIRE(bench.arm.activate() == Status::ok);
  const JointVector<2> wanted(0.3, -0.2);
  Command command;
  if constexpr (std::same_as<Command, EffortCommand<2>>) {
    command.effort = {3, -3};
    CHECK(bench.cycles(200, command));
    CHECK((bench.bus->drives.effort() - command.effort).norm() < 1e-12);
  } else if constexpr (std::same_as<Command, PositionCommand<2>>) {
    command.position = wanted;
    CHECK(bench.cycles(2000, command));
    CHECK((bench.state.position - wanted).norm() < 1e-3);
  } else {
    command.velocity = wanted;
    CHECK(bench.cycles(300, command));
    CHECK((bench.state.velocity - wanted).norm() < 0.02);
  }
  const JointState<2>& truth = bench.bus->drives.simulator().true_state();
  // Feedback is one period old.
  CHECK((bench.state.position - truth.position).norm() < 5e-3);
  CHECK((bench.state.velocity - truth.velocity).norm() < 0.05);
  CHECK(bench.arm.statistics().malformed == 0);
  CHECK(bench.arm.deactivate() == Status::ok);
  CHECK_FALSE(bench.bus->drives.enabled(0));
  CHECK_FALSE(bench.bus->drives.enabled(1));
  CHECK(bench.arm.activate() == Status::ok);
}

/// The mappings that many drives come with, for torque commands: each RPDO and TPDO has one thing
/// beside controlword and statusword.
constexpr std::array<SimulatedCia402Quirks::FixedMapping, 8> usual_mappings{{
    {0x1600, {0x6040'0010}},
    {0x1601, {0x6040'0010, 0x6060'0008}},
    {0x1602, {0x6040'0010, 0x6060'0008, 0x6071'0010}},
    {0x1a00, {0x6041'0010}},
    {0x1a01, {0x6041'0010, 0x6061'0008}},
    {0x1a02, {0x6041'0010, 0x6064'0020}},
    {0x1a03, {0x6041'0010, 0x606c'0020}},
}};

}  // namespace

TEST_CASE("identifiers of process data keep the bit against remote requests") {
  Bench bench({.allows_remote_requests = false});
  REQUIRE(bench.arm.activate() == Status::ok);
  CHECK(bench.value(0x1800, 1) == 0x4000'0186);
  CHECK(bench.value(0x1801, 1) == 0x4000'0286);
  CHECK(bench.value(0x1400, 1) == 0x206);
  check_drives({.allows_remote_requests = false});
}

TEST_CASE("a drive may show its mode only when it is enabled") {
  check_drives<EffortCommand<2>>({.shows_mode_at_once = false});
  check_drives<PositionCommand<2>>({.shows_mode_at_once = false});
  check_drives<VelocityCommand<2>>({.shows_mode_at_once = false});
}

TEST_CASE("the targets of other modes are safe where a drive may yet be in one of them") {
  const auto bus = std::make_shared<Bus>(
      Drives(drives, {.initial_position = JointVector<2>(0.3, -0.2)},
             {SimulatedCia402Quirks(), SimulatedCia402Quirks{.shows_mode_at_once = false}}));
  CanBatch answers;
  for (const auto& [address, value, size] :
       {canopen::ObjectValue{cia402::target_velocity, 1000000, 4},
        canopen::ObjectValue{cia402::target_position, 5000000, 4}}) {
    bus->drives.receive(
        canopen::encode_request({canopen::SdoKind::download, address, value, size}, 6), answers);
  }
  ArmOf<EffortCommand<2>> arm{Cia402Codec<Q2d>(drives), support::FakeCanTransport<Drives>(bus)};
  REQUIRE(arm.activate() == Status::ok);
  CHECK(bus->drives.node(1).value(cia402::target_velocity) == 0);
  CHECK(bus->drives.node(1).target(cia402::target_position) ==
        bus->drives.node(1).target(cia402::position_actual));
}

TEST_CASE("a mode that is never shown ends the activation, and the drive is named") {
  Bench bench({}, drives, {.set_up_time = 1s});
  bench.bus->on_feedback = [](CanFrame& frame) {
    const auto answer = canopen::decode_answer(frame);
    if (frame.identifier == 0x586 && answer && answer->address == cia402::mode_display) {
      frame.data[4] = 1;  // profile position
    }
    return true;
  };
  CHECK(bench.arm.activate() == Status::hardware_fault);
  CHECK(bench.arm.fault().cause == CanCause::no_activation);
  CHECK(bench.arm.fault().joint == 1);
  CHECK_FALSE(bench.bus->drives.enabled(0));
  CHECK_FALSE(bench.bus->drives.enabled(1));
}

TEST_CASE("drives without torque, velocity or error code do without them") {
  check_drives({.has_error_code = false});
  check_drives({.has_torque = false});
  check_drives({.has_velocity = false});
  check_drives({.has_error_code = false, .has_torque = false, .has_velocity = false});
  check_drives<PositionCommand<2>>(
      {.has_error_code = false, .has_torque = false, .has_velocity = false});

  Bench bench({.has_error_code = false, .has_torque = false, .has_velocity = false});
  REQUIRE(bench.arm.activate() == Status::ok);
  CHECK(bench.value(0x1a00, 0) == 2);
  CHECK((bench.value(0x1801, 1) & 0x8000'0000U) != 0);  // nothing is left to send
  CHECK(bench.cycles(100, {{3, 3}}));
  CHECK(bench.state.effort[0] == Approx(3));
  CHECK(bench.state.effort[1] == 0);  // not measured
}

TEST_CASE("a fault of a drive without error code has the code of its emergency message") {
  Bench bench({.has_error_code = false});
  REQUIRE(bench.arm.activate() == Status::ok);
  CHECK(bench.cycles(10, {}));
  bench.bus->drives.raise_fault(1, 0x2310);
  CHECK_FALSE(bench.cycles(5, {}));
  CHECK(bench.arm.fault().cause == CanCause::drive_fault);
  CHECK(bench.arm.fault().joint == 1);
  CHECK(bench.arm.fault().code == 0x2310);
}

TEST_CASE("velocity from positions counts the cycles between them") {
  int number = 0;  // outlives the bench, whose last frames count too
  Bench<VelocityCommand<2>> bench({.has_velocity = false});
  REQUIRE(bench.arm.activate() == Status::ok);
  const VelocityCommand<2> steady{{0, 0.5}};
  CHECK(bench.cycles(500, steady));
  const double before = bench.state.velocity[1];
  CHECK(before == Approx(0.5).epsilon(0.05));
  bench.bus->on_feedback = [&](CanFrame& frame) {
    return frame.identifier != 0x186 || ++number % 23 != 0;
  };
  // A quantum of position is 6e-6 rad, so 6e-3 rad/s over a period. Until a lost frame is told from
  // a late one, the figure may be half or double.
  for (int k = 0; k < 100; ++k) {
    bench.cycles(1, steady);
    CHECK(bench.state.velocity[1] > 0.4 * before);
    CHECK(bench.state.velocity[1] < 2.1 * before);
  }
}

TEST_CASE("further objects are written before the drive is enabled") {
  Cia402DriveList<2> list = drives;
  list[1].objects = {{{0x6072, 0}, 1500, 2}, {{0x605a, 0}, 6, 2}, {{0x60c2, 1}, 2, 1}};
  Bench bench({}, list);
  bench.bus->on_command = [&](CanFrame& frame) {
    const auto request = canopen::decode_request(frame);
    const bool own = request && request->address == canopen::ObjectAddress{0x6072, 0};
    if (own) {
      CHECK(frame.identifier == 0x606);
      CHECK_FALSE(bench.bus->drives.enabled(1));
    }
    return true;
  };
  REQUIRE(bench.arm.activate() == Status::ok);
  CHECK(bench.value(0x6072) == 1500);
  CHECK(bench.value(0x605a) == 6);
  CHECK(bench.value(0x60c2, 1) == 2);  // instead of the loop's period
  bench.bus->on_command = [](CanFrame&) { return true; };
}

TEST_CASE("a further object that a drive refuses is named, with the drive and the code") {
  Cia402DriveList<2> list = drives;
  list[1].objects = {{{0x6072, 0}, 1500, 2}, {{0x2040, 3}, 1, 2}};
  Bench bench({}, list);
  CHECK(bench.arm.activate() == Status::hardware_fault);
  CHECK(bench.arm.fault().cause == CanCause::no_activation);
  CHECK(bench.arm.fault().joint == 1);
  CHECK(bench.arm.fault().object == canopen::ObjectAddress{0x2040, 3});
  CHECK(bench.arm.fault().abort_code == 0x0602'0000);
  const std::string text = describe(bench.arm.fault());
  CAPTURE(text);
  CHECK(text.find("joint 1") != std::string::npos);
  CHECK(text.find("2040h,3") != std::string::npos);
  CHECK(text.find("06020000h") != std::string::npos);
}

TEST_CASE("a read-only object is right if it has the value") {
  Cia402DriveList<2> list = drives;
  list[1].objects = {{{0x1000, 0}, 0x0002'0192, 4}};
  CHECK(Bench({}, list).arm.activate() == Status::ok);
  list[1].objects = {{{0x1000, 0}, 0x0003'0192, 4}};
  Bench bench({}, list);
  CHECK(bench.arm.activate() == Status::hardware_fault);
  CHECK(bench.arm.fault().abort_code == 0x0601'0002);
}

TEST_CASE("a list of further objects that makes no sense is refused") {
  using canopen::ObjectValues;
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(ObjectValues({{{0x6072, 0}, 1, 5}}), Contains("6072h,0") && Contains("size 5"));
  CHECK_THROWS_WITH(ObjectValues({{{0x6072, 0}, 1, 0}}), Contains("size 0"));
  using V = canopen::ObjectValue;
  const V one{{0x6072, 0}, 1, 2};
  CHECK_THROWS_WITH(ObjectValues({one, one, one, one, one, one, one, one, one, one, one, one, one,
                                  one, one, one, one, one, one, one, one, one, one, one, one}),
                    Contains("25 objects"));
}

TEST_CASE("activation waits until the drives follow their targets") {
  Bench bench({});
  auto since = bench.bus->time;
  bool follows = false;
  bench.bus->on_feedback = [&](CanFrame& frame) {
    if (frame.identifier != 0x186) return true;
    const bool enabled = (frame.data[0] & 0x6f) == 0x27;
    if (!enabled) since = bench.bus->time;
    follows = enabled && bench.bus->time - since > 50ms;
    if (!follows) frame.data[1] = static_cast<std::uint8_t>(frame.data[1] & ~0x10U);
    return true;
  };
  REQUIRE(bench.arm.activate() == Status::ok);
  CHECK(follows);
  bench.bus->on_feedback = [](CanFrame&) { return true; };
}

TEST_CASE("a drive that does not follow its target any more has let go") {
  Bench bench({});
  REQUIRE(bench.arm.activate() == Status::ok);
  CHECK(bench.cycles(10, {{3, 3}}));
  bench.bus->on_feedback = [](CanFrame& frame) {
    if (frame.identifier == 0x186)
      frame.data[1] = static_cast<std::uint8_t>(frame.data[1] & ~0x10U);
    return true;
  };
  CHECK_FALSE(bench.cycles(3, {{3, 3}}));
  CHECK(bench.arm.fault().cause == CanCause::drive_disabled);
  CHECK(bench.arm.fault().joint == 1);
  bench.bus->on_feedback = [](CanFrame&) { return true; };
}

TEST_CASE("a drive that never says that it follows its target does so, too") {
  check_drives({.shows_following = false});
}

TEST_CASE("a counter of SYNC that is expected is cleared, and the period stays") {
  Bench bench({.sync_counter = 10});
  REQUIRE(bench.arm.activate() == Status::ok);
  CHECK(bench.value(0x1019) == 0);
  CHECK(bench.value(0x1006) == 1000);
  CHECK(bench.value(0x1006) == 1000);
  check_drives({.sync_counter = 240});
}

TEST_CASE("what is read need not tell its size") {
  check_drives({.indicates_size = false});
  check_drives<PositionCommand<2>>({.indicates_size = false});
}

TEST_CASE("drives that take seconds to boot and to switch on are waited for") {
  check_drives({.boot_time = 6});
  check_drives({.transition_time = 2});  // three of them
  check_drives({.boot_time = 2, .transition_time = 1.5});
}

TEST_CASE("a drive that has not left operation is told once more") {
  Bench bench({.is_open_in_operation = false});
  REQUIRE(bench.arm.activate() == Status::ok);
  CHECK(bench.cycles(10, {}));
  bool lost = false;
  bench.bus->on_command = [&](CanFrame& frame) {
    const bool leaves = frame == canopen::encode(canopen::NmtCommand::enter_pre_operational, 6);
    return !leaves || std::exchange(lost, true);
  };
  CHECK(bench.arm.activate() == Status::ok);
  CHECK(lost);
  bench.bus->on_command = [](CanFrame&) { return true; };
}

TEST_CASE("mappings that cannot be changed are used as they are") {
  SECTION("those that would be mapped") {
    SimulatedCia402Quirks quirks;
    quirks.fixed_mappings = {{{0x1600, {0x6040'0010, 0x6071'0010}},
                              {0x1a00, {0x6041'0010, 0x6064'0020, 0x6077'0010}},
                              {0x1a01, {0x606c'0020, 0x603f'0010}}}};
    check_drives(quirks);
  }
  SECTION("in another order, with more in it") {
    SimulatedCia402Quirks quirks;
    quirks.fixed_mappings = {{{0x1600, {0x6071'0010, 0x6040'0010, 0x6060'0008}},
                              {0x1a00, {0x6061'0008, 0x6041'0010, 0x6077'0010}},
                              {0x1a01, {0x606c'0020, 0x6064'0020}}}};
    check_drives(quirks);
    Bench bench(quirks);
    REQUIRE(bench.arm.activate() == Status::ok);
    CHECK(bench.cycles(10, {{0, -3}}));
    CHECK(bench.value(0x6060) == 10);  // goes with the command
    CHECK(bench.state.effort[1] == Approx(-3));
  }
  SECTION("one thing in each") {
    SimulatedCia402Quirks quirks;
    quirks.fixed_mappings = usual_mappings;
    check_drives(quirks);
    Bench bench(quirks);
    REQUIRE(bench.arm.activate() == Status::ok);
    bench.bus->to_drives.clear();
    CHECK(bench.cycles(1, {{3, -3}}));
    REQUIRE(bench.bus->to_drives.size() == 3);
    const CanFrame& command = bench.bus->to_drives[1];  // RPDO 3: controlword, mode, target
    CHECK(command.identifier == 0x406);
    CHECK(command.length == 5);
    CHECK(command.data == std::array<std::uint8_t, 8>{0x0f, 0, 10, 0x38, 0xff});
    CHECK((bench.value(0x1800, 1) & 0x8000'0000U) == 0);  // has the statusword
    CHECK((bench.value(0x1801, 1) & 0x8000'0000U) != 0);  // has nothing of use beside it
    CHECK(bench.value(0x1402, 5) == 10);  // the watchdog is on the RPDO that is used
    CHECK(bench.arm.deactivate() == Status::ok);
    CHECK(bench.value(0x1402, 5) == 0);
  }
}

TEST_CASE("fixed mappings that do not do are refused, with the drive and the object") {
  SimulatedCia402Quirks quirks;
  SECTION("the target is missing") {
    quirks.fixed_mappings = usual_mappings;
    Bench<VelocityCommand<2>> bench(quirks);
    CHECK(bench.arm.activate() == Status::hardware_fault);
    CHECK(bench.arm.fault().joint == 1);
    CHECK(bench.arm.fault().object == canopen::ObjectAddress{0x1600, 0});
    CHECK(bench.arm.fault().abort_code == 0x0601'0002);
  }
  SECTION("the position is missing") {
    quirks.fixed_mappings = {{{0x1600, {0x6040'0010, 0x6071'0010}}, {0x1a00, {0x6041'0010}}}};
    Bench bench(quirks);
    CHECK(bench.arm.activate() == Status::hardware_fault);
    CHECK(bench.arm.fault().joint == 1);
    CHECK(bench.arm.fault().object == canopen::ObjectAddress{0x1a00, 0});
  }
  SECTION("zero would be put where that may do harm") {
    quirks.fixed_mappings = {{{0x1600, {0x6040'0010, 0x6071'0010, 0x6072'0010}},  // most torque
                              {0x1a00, {0x6041'0010, 0x6064'0020}}}};
    Bench bench(quirks);
    CHECK(bench.arm.activate() == Status::hardware_fault);
    CHECK(bench.arm.fault().object == canopen::ObjectAddress{0x1600, 0});
  }
}

TEST_CASE("activation of drives with quirks survives the loss of any one frame") {
  SimulatedCia402Quirks quirks;
  quirks.sync_counter = 10;
  quirks.fixed_mappings = usual_mappings;
  for (const bool of_the_host : {true, false}) {
    for (int lost = 0; lost < 400; ++lost) {
      CAPTURE(of_the_host, lost);
      Bench bench(quirks, drives, {.set_up_time = 2s});
      int number = 0;
      const auto all_but_one = [&](CanFrame&) { return number++ != lost; };
      (of_the_host ? bench.bus->on_command : bench.bus->on_feedback) = all_but_one;
      REQUIRE(bench.arm.activate() == Status::ok);
      const bool over = number <= lost;
      bench.bus->on_command = bench.bus->on_feedback = [](CanFrame&) { return true; };
      if (over) break;
      REQUIRE(lost < 399);  // the loop has not ended too early
    }
  }
}
