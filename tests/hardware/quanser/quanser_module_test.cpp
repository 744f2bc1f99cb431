// SPDX-License-Identifier: Apache-2.0
// The simulated joint modules do what docs/quanser_protocol.md says.
#include <articula/hardware/can/can_hardware.hpp>
#include <articula/hardware/quanser/quanser_codec.hpp>
#include <articula/hardware/quanser/simulated_quanser_drives.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/robots/q2d_modules.hpp>

#include "catch.hpp"
#include "hardware/fake_can_bus.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

using namespace articula;
using quanser::Control;

namespace {

/// A wheel that turns without end, so that its counts leave their range.
struct Wheel {
  static constexpr RobotDescription description{
      .name = "wheel",
      .links = std::to_array<Link>(
          {{.name = "base"},
           {.name = "rim", .mass = 1, .inertia = {.xx = 0.01, .yy = 0.01, .zz = 0.01}}}),
      .joints = std::to_array<Joint>({{.name = "axle",
                                       .type = JointType::continuous,
                                       .parent = "base",
                                       .child = "rim",
                                       .axis = {0, 0, 1},
                                       .limits = {.velocity = 100, .effort = 10}}})};
};

/// What the module of a joint has answered to SYNC.
struct Answer {
  std::optional<quanser::Position> position{};
  std::optional<quanser::Motion> motion{};
};

/// Drives without a bus, and a host that counts its cycles.
template <class R>
struct Modules {
  SimulatedQuanserDrives<R> drives;
  std::uint8_t counter = 0;

  void control(Control what, std::uint8_t node = 1) { send(quanser::encode(what, node)); }
  void effort(std::int16_t millinewton_metres) {
    const auto next = static_cast<std::uint8_t>(counter + 1);
    send(quanser::encode(quanser::Effort{millinewton_metres, next}, 1));
  }
  /// The answer of module 1.
  Answer sync() {
    CanBatch answers;
    drives.receive(quanser::encode_sync(++counter), answers);
    Answer answer;
    for (const CanFrame& frame : answers) {
      if (quanser::node_of(frame) != 1) continue;
      if (const auto position = quanser::decode_position(frame)) answer.position = position;
      if (const auto motion = quanser::decode_motion(frame)) answer.motion = motion;
    }
    return answer;
  }
  void send(const CanFrame& frame) {
    CanBatch answers;
    drives.receive(frame, answers);
  }
};

Modules<Q2d> arm_modules() { return {SimulatedQuanserDrives<Q2d>(q2d_modules)}; }

}  // namespace

TEST_CASE("a module answers SYNC while it is disabled and while it is faulty") {
  Modules<Q2d> modules = arm_modules();
  Answer answer = modules.sync();
  REQUIRE(answer.position);
  REQUIRE(answer.motion);
  CHECK(answer.position->counter == modules.counter);
  CHECK(answer.position->status == 0);
  modules.drives.raise_fault(0, quanser::supply);
  answer = modules.sync();
  REQUIRE(answer.position);
  REQUIRE(answer.motion);
  CHECK(answer.position->status == quanser::faulty);
  CHECK(answer.motion->faults == quanser::supply);
}

TEST_CASE("a disabled module drops efforts, and one that came before CONTROL 1 does not count") {
  Modules<Q2d> modules = arm_modules();
  modules.effort(1000);
  static_cast<void>(modules.sync());
  CHECK(modules.drives.effort()[0] == 0);
  modules.effort(1000);
  modules.control(Control::enable);
  static_cast<void>(modules.sync());
  CHECK(modules.drives.enabled(0));
  CHECK(modules.drives.effort()[0] == 0);
  modules.effort(1000);
  static_cast<void>(modules.sync());
  CHECK(modules.drives.effort()[0] == 1);
}

TEST_CASE("CONTROL 1 to an enabled module changes neither the effort nor the watchdog") {
  Modules<Q2d> modules = arm_modules();
  modules.control(Control::enable);
  modules.effort(1000);
  static_cast<void>(modules.sync());
  int periods = 1;
  while (modules.drives.enabled(0)) {
    CHECK(modules.drives.effort()[0] == 1);
    modules.control(Control::enable);
    static_cast<void>(modules.sync());
    REQUIRE(++periods < 20);
  }
  CHECK(periods == 11);  // 10 ms in force
}

TEST_CASE("CONTROL 1 to a faulty module changes nothing") {
  Modules<Q2d> modules = arm_modules();
  modules.drives.raise_fault(0, quanser::over_current);
  modules.control(Control::enable);
  CHECK_FALSE(modules.drives.enabled(0));
  CHECK(modules.sync().motion->faults == quanser::over_current);
}

TEST_CASE("CONTROL 2 and 3 to a disabled module are no error") {
  Modules<Q2d> modules = arm_modules();
  modules.control(GENERATE(Control::disable, Control::clear_faults));
  CHECK(modules.sync().position->status == 0);
  CHECK(modules.sync().motion->faults == 0);
}

TEST_CASE("CONTROL 3 leaves a fault whose cause lasts") {
  Modules<Q2d> modules = arm_modules();
  modules.control(Control::enable);
  modules.drives.hold_fault(0, quanser::over_temperature);
  modules.drives.raise_fault(0, quanser::over_current);
  CHECK(modules.sync().motion->faults == (quanser::over_temperature | quanser::over_current));
  modules.control(Control::clear_faults);
  CHECK(modules.sync().motion->faults == quanser::over_temperature);
  modules.drives.restart(0);
  CHECK(modules.sync().motion->faults == quanser::over_temperature);
  modules.drives.hold_fault(0, 0);  // it has cooled down
  CHECK(modules.sync().motion->faults == quanser::over_temperature);
  modules.control(Control::clear_faults);
  CHECK(modules.sync().motion->faults == 0);
  modules.control(Control::enable);
  CHECK(modules.drives.enabled(0));
}

TEST_CASE("the host does not enable a module while the cause of its fault lasts") {
  using Drives = SimulatedQuanserDrives<Q2d>;
  const auto bus = std::make_shared<support::FakeCanBus<Drives>>(Drives(q2d_modules));
  using Transport = support::FakeCanTransport<Drives>;
  CanHardware<Q2d, QuanserCodec<Q2d>, Transport> arm(QuanserCodec<Q2d>{q2d_modules}, Transport(bus),
                                                     {.set_up_time = std::chrono::seconds(1)});
  bus->drives.hold_fault(1, quanser::over_temperature);
  CHECK(arm.activate() == Status::hardware_fault);
  CHECK(arm.fault().cause == CanCause::no_activation);
  CHECK(arm.fault().joint == 1);
  CHECK(arm.fault().code == quanser::over_temperature);
  for (const CanFrame& frame : bus->to_drives) {
    CHECK(quanser::decode_control(frame) != Control::enable);
  }
  bus->drives.hold_fault(1, 0);
  CHECK(arm.activate() == Status::ok);
}

TEST_CASE("status and faults are those of the time of sending") {
  Modules<Q2d> modules = arm_modules();
  modules.control(Control::enable);
  modules.effort(1000);
  CHECK(modules.sync().position->status == quanser::enabled);
  // The tenth SYNC without an effort finds the watchdog run out; its answer says so.
  for (int k = 0; k < 9; ++k) CHECK(modules.sync().motion->faults == 0);
  const Answer answer = modules.sync();
  CHECK(answer.position->status == quanser::faulty);
  CHECK(answer.motion->faults == quanser::command_timeout);
}

TEST_CASE("a fault that MOTION has before POSITION counts") {
  QuanserCodec<Q2d> codec(q2d_modules);
  CanBatch batch;
  codec.encode({}, batch);
  const auto counter = static_cast<std::uint8_t>(codec.cycle());
  const CanFrame position =
      quanser::encode(quanser::Position{0, 0, counter, quanser::enabled}, q2d_modules[0].node);
  const CanFrame motion =
      quanser::encode(quanser::Motion{0, 0, counter, quanser::over_speed}, q2d_modules[0].node);
  CHECK(codec.decode(position) == CanDecoding::accepted);
  CHECK(codec.decode(motion) == CanDecoding::accepted);
  CHECK(codec.reports()[0].fault == quanser::over_speed);
}

TEST_CASE("the host takes answers to the last 128 SYNC, and none older than what it has") {
  QuanserCodec<Q2d> codec(q2d_modules);
  const auto begin_cycles = [&](int count) {
    for (int k = 0; k < count; ++k) {
      CanBatch batch;
      codec.encode({}, batch);
    }
  };
  const auto answer = [&](std::uint64_t cycle) {
    const auto counter = static_cast<std::uint8_t>(cycle);
    const CanFrame motion = quanser::encode(quanser::Motion{0, 0, counter, 0}, 1);
    static_cast<void>(codec.decode(quanser::encode(quanser::Position{0, 0, counter, 0}, 1)));
    return codec.decode(motion);
  };
  begin_cycles(300);
  CHECK(answer(300 - 128) == CanDecoding::outdated);
  CHECK(answer(300 - 127) == CanDecoding::accepted);
  CHECK(codec.reports()[0].age == 127);
  CHECK(answer(300 - 2) == CanDecoding::accepted);
  CHECK(codec.reports()[0].age == 2);
  CHECK(answer(300 - 2) == CanDecoding::outdated);
  CHECK(answer(300 - 3) == CanDecoding::outdated);
  CHECK(answer(300) == CanDecoding::accepted);
}

TEST_CASE("a count beyond its range stays at the end, with a fault as long as it lasts") {
  constexpr QuanserModules<1> wheel{{{.node = 1, .gear_ratio = 100}}};
  const double side = GENERATE(-1.0, 1.0);
  const double end = side * quanser::detail::largest_count / wheel[0].motor_scale();
  SimulatorOptions<1> options;
  options.initial_position = JointVector<1>(end - side * 1e-3);
  Modules<Wheel> modules{SimulatedQuanserDrives<Wheel>(wheel, options)};
  modules.control(Control::enable);
  Answer answer = modules.sync();
  CHECK(answer.motion->faults == 0);
  CHECK(std::abs(answer.position->motor_counts) < quanser::detail::largest_count);
  for (int k = 0; k < 100 && modules.drives.enabled(0); ++k) {
    modules.effort(static_cast<std::int16_t>(side * 10'000));
    answer = modules.sync();
    REQUIRE(answer.position);
    REQUIRE(answer.motion);
  }
  CHECK_FALSE(modules.drives.enabled(0));
  CHECK(modules.drives.effort()[0] == 0);
  CHECK(answer.position->motor_counts == static_cast<int>(side) * quanser::detail::largest_count);
  CHECK(answer.position->status == quanser::faulty);
  CHECK(answer.motion->faults == quanser::encoder);
  modules.control(Control::clear_faults);
  CHECK(modules.sync().motion->faults == quanser::encoder);
}

TEST_CASE("a velocity or an effort beyond its range is held at the end, and is no fault") {
  constexpr QuanserModules<1> wheel{{{.node = 1}}};
  Modules<Wheel> modules{SimulatedQuanserDrives<Wheel>(wheel)};
  modules.control(Control::enable);
  Answer answer;
  for (int k = 0; k < 40; ++k) {  // 1000 rad/s^2 for 40 ms
    modules.effort(10'000);
    answer = modules.sync();
  }
  REQUIRE(answer.motion);
  CHECK(answer.motion->milliradians_per_second == 32767);
  CHECK(answer.motion->faults == 0);
}

TEST_CASE("the watchdog is at least 10 ms by the clock at every period, the longest is 5 ms") {
  const double period = GENERATE(1e-3, 2e-3, 3e-3, 4e-3, 5e-3);
  CAPTURE(period);
  SimulatorOptions<2> options;
  options.period = period;
  options.substeps = 10;
  Modules<Q2d> modules{SimulatedQuanserDrives<Q2d>(q2d_modules, options)};
  modules.control(Control::enable);
  modules.effort(1000);
  static_cast<void>(modules.sync());
  int in_force = 1;
  for (; modules.drives.enabled(0); ++in_force) static_cast<void>(modules.sync());
  const double time = (in_force - 1) * period;
  CHECK(time > 10e-3 - 1e-9);
  CHECK(time < 10e-3 + period);
  using Catch::Matchers::Contains;
  options.period = 6e-3;
  CHECK_THROWS_WITH(SimulatedQuanserDrives<Q2d>(q2d_modules, options),
                    Contains("0.006") && Contains("0.005"));
}
