// SPDX-License-Identifier: Apache-2.0
// The whole path in memory: controller, codec, frames, joint modules, simulated arm, and back.
#include <articula/articula.hpp>
#include <articula/hardware/can/can_hardware.hpp>
#include <articula/hardware/quanser/quanser_codec.hpp>
#include <articula/hardware/quanser/simulated_quanser_drives.hpp>
#include <articula/loop/run.hpp>
#include <articula/loop/simulated_clock.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>
#include <articula/robots/q2d.hpp>

#include "catch.hpp"
#include "hardware/fake_can_bus.hpp"
#include "numbers.hpp"
#include "random.hpp"

#include <memory>
#include <optional>
#include <utility>

using namespace articula;

namespace {

using Drives = SimulatedQuanserDrives<Q2d>;
using Bus = support::FakeCanBus<Drives>;
using Arm = CanHardware<Q2d, QuanserCodec<Q2d>, support::FakeCanTransport<Drives>>;

// Encoders with a power of two of counts per turn, so that 1e-4 rad and less is a count.
constexpr QuanserModules<2> modules{{
    {.node = 1, .gear_ratio = 100, .load_counts_per_turn = 65536},
    {.node = 2, .gear_ratio = -80, .load_counts_per_turn = 65536, .position_at_zero = 0.25},
}};

std::shared_ptr<Bus> make_bus(const SimulatorOptions<2>& options = {}) {
  return std::make_shared<Bus>(Drives(modules, options));
}
Arm make_arm(const std::shared_ptr<Bus>& bus, const CanHardwareOptions& options = {}) {
  return Arm(QuanserCodec<Q2d>(modules), support::FakeCanTransport<Drives>(bus), options);
}

/// An activated arm, its bus, and the means to let cycles pass.
struct Bench {
  std::shared_ptr<Bus> bus = make_bus();
  Arm arm = make_arm(bus);
  JointState<2> state{};
  Status reading = Status::ok;
  Status writing = Status::ok;

  Bench() { REQUIRE(arm.activate() == Status::ok); }
  void cycle(const EffortCommand<2>& command = {{1, -1}}) {
    reading = arm.read(state);
    writing = arm.write(command);
  }
  void cycles(int count) {
    for (int k = 0; k < count; ++k) cycle();
  }
};

bool is_feedback_of(const CanFrame& frame, std::uint8_t node) {
  return quanser::node_of(frame) == node;
}

}  // namespace

TEST_CASE("the loop over CAN follows the loop in one process") {
  // What differs is the wire: positions in counts (1.5e-5 and 1.9e-5 rad), velocities in 1e-3
  // rad/s, efforts in 1e-3 N m. The loops are stable and well damped, so this is not amplified: 2
  // counts. Velocity: a count's worth of effort, 2310 N m/rad times 1.5e-5 rad, over the damping of
  // 30 N m s/rad, is 1.2e-3 rad/s, for the elbow 2.5e-3; and 1e-3 of the wire.
  const double position_bound = 4e-5, velocity_bound = 5e-3;
  const auto bus = make_bus();
  Loop<Arm, PidPlusGravity> over_can(make_arm(bus));
  Loop<Q2dSim, PidPlusGravity> in_process;
  double position_difference = 0, velocity_difference = 0;
  for (int k = 0; k < 3000; ++k) {
    const double side = (k / 1000) % 2 == 0 ? 1 : -1;
    over_can.reference().position = {-side, side};
    in_process.reference().position = {-side, side};
    REQUIRE(over_can.update() == Status::ok);
    REQUIRE(in_process.update() == Status::ok);
    const JointState<2>&a = over_can.state(), &b = in_process.state();
    position_difference =
        std::max(position_difference, (a.position - b.position).cwiseAbs().maxCoeff());
    velocity_difference =
        std::max(velocity_difference, (a.velocity - b.velocity).cwiseAbs().maxCoeff());
  }
  CAPTURE(position_difference, velocity_difference);
  CHECK(position_difference < position_bound);
  CHECK(velocity_difference < velocity_bound);
  CHECK(over_can.hardware().statistics().partial == 0);
  CHECK(over_can.hardware().statistics().malformed == 0);
}

TEST_CASE("each cycle has one effort frame for each module and ends with SYNC") {
  Bench bench;
  bench.bus->to_drives.clear();
  bench.cycle({{1.5, -2}});
  const auto& wire = bench.bus->to_drives;
  REQUIRE(wire.size() == 3);
  const auto counter = quanser::decode_sync(wire[2]);
  REQUIRE(counter);
  for (std::size_t j = 0; j < 2; ++j) {
    const auto effort = quanser::decode_effort(wire[j]);
    REQUIRE(effort);
    CHECK(quanser::node_of(wire[j]) == modules[j].node);
    CHECK(effort->counter == *counter);
    CHECK(effort->millinewton_metres == (j == 0 ? 1500 : -2000));
  }
  CHECK(bench.bus->drives.effort() == JointVector<2>(1.5, -2));
}

TEST_CASE("activation clears old faults and enables at zero effort") {
  const auto bus = make_bus();
  bus->drives.raise_fault(1, quanser::over_temperature);
  Arm arm = make_arm(bus);
  REQUIRE(arm.activate() == Status::ok);
  CHECK(bus->drives.enabled(0));
  CHECK(bus->drives.enabled(1));
  for (const CanFrame& frame : bus->to_drives) CHECK_FALSE(quanser::decode_effort(frame));
  JointState<2> state;
  CHECK(arm.read(state) == Status::ok);
  CHECK(std::abs(arm.codec().load_position()[1] - state.position[1]) < 1e-4);

  SECTION("the time until the first command does not matter") {
    for (int k = 0; k < 1000; ++k) bus->silent_period();
    CHECK(arm.read(state) == Status::ok);
    CHECK(arm.write({{1, 1}}) == Status::ok);
    CHECK(arm.read(state) == Status::ok);
    CHECK(bus->drives.effort() == JointVector<2>(1, 1));
  }
  SECTION("deactivation lets go") {
    CHECK(arm.deactivate() == Status::ok);
    CHECK_FALSE(bus->drives.enabled(0));
    CHECK_FALSE(bus->drives.enabled(1));
    state = {};
    CHECK(arm.write({{1, 1}}) == Status::inactive);
    CHECK(arm.read(state) == Status::inactive);
    CHECK(std::abs(arm.codec().load_position()[1] - state.position[1]) <
          1e-4);  // goes on reporting
    CHECK(bus->drives.effort() == JointVector<2>(0, 0));
  }
}

TEST_CASE("activation survives lost requests and tells who does not answer") {
  const auto bus = make_bus();
  SECTION("every second frame of the host is lost, at random") {
    const unsigned seed = 1;
    CAPTURE(seed);
    support::Random random(seed);
    bus->on_command = [&](CanFrame&) { return random.one_in(2); };
    Arm arm = make_arm(bus);
    CHECK(arm.activate() == Status::ok);
    bus->on_command = [](CanFrame&) { return true; };  // ends before `random` does
  }
  SECTION("one module is not there") {
    bus->on_feedback = [](CanFrame& frame) { return !is_feedback_of(frame, 2); };
    Arm arm = make_arm(bus);
    CHECK(arm.activate() == Status::hardware_fault);
    CHECK(arm.fault().cause == CanCause::no_activation);
    CHECK(arm.fault().joint == 1);
    CHECK(bus->drives.enabled(0) == false);  // nothing is left enabled
  }
  SECTION("there is no way to the bus") {
    bus->can_open = false;
    Arm arm = make_arm(bus);
    CHECK(arm.activate() == Status::hardware_fault);
    CHECK(arm.fault().cause == CanCause::link_gone);
  }
}

TEST_CASE("activation is not done while a request to clear faults may still be on its way") {
  Drives drives(modules, {});
  const auto answered = [&](const CanFrame& frame) {
    CanBatch answers;
    drives.receive(frame, answers);
    return answers;
  };
  for (const auto& module : modules) {  // left from before
    static_cast<void>(answered(quanser::encode(quanser::Control::enable, module.node)));
  }
  QuanserCodec<Q2d> codec(modules);
  codec.restart();
  CanBatch first;
  REQUIRE(codec.set_up(std::chrono::milliseconds(0), first) == CanSetUp::in_progress);
  // Its last frame, SYNC, overtakes the others, so that all modules answer that they are enabled.
  for (const CanFrame& frame : answered(*(first.end() - 1))) static_cast<void>(codec.decode(frame));
  CHECK(codec.reports()[0].enabled);
  CanSetUp progress = CanSetUp::in_progress;
  for (int milliseconds = 1; milliseconds < 200; ++milliseconds) {
    CanBatch batch;
    progress = codec.set_up(std::chrono::milliseconds(milliseconds), batch);
    if (milliseconds == 1) {  // now they arrive
      for (const CanFrame& frame : first) static_cast<void>(answered(frame));
      CHECK_FALSE(drives.enabled(0));
    }
    if (progress == CanSetUp::done) break;
    for (const CanFrame& frame : batch) {
      for (const CanFrame& answer : answered(frame)) static_cast<void>(codec.decode(answer));
    }
  }
  CHECK(progress == CanSetUp::done);
  CHECK(drives.enabled(0));
  CHECK(drives.enabled(1));
}

TEST_CASE("a drive that is moved from does not stop the arm") {
  Bench bench;
  {
    Arm other(std::move(bench.arm));
    CHECK(other.write({{1, 1}}) == Status::ok);
    CHECK(bench.bus->drives.enabled(0));
  }
  CHECK_FALSE(bench.bus->drives.enabled(0));  // the destructor has let go
}

TEST_CASE("missing feedback of one joint: the last is used, then it is stale, then a fault") {
  Bench bench;
  bench.cycles(10);
  const CanHardwareOptions options;
  bench.bus->on_feedback = [](CanFrame& frame) { return !is_feedback_of(frame, 2); };
  bench.cycle();  // takes in the last that came
  for (std::uint32_t age = 1; age <= options.silent_after; ++age) {
    CAPTURE(age);
    bench.cycle();
    if (age < options.stale_after) {
      CHECK(bench.reading == Status::ok);
    } else if (age < options.silent_after) {
      CHECK(bench.reading == Status::stale_state);
    } else {
      CHECK(bench.reading == Status::hardware_fault);
    }
  }
  CHECK(bench.arm.fault().cause == CanCause::drive_silent);
  CHECK(bench.arm.fault().joint == 1);
  CHECK(bench.bus->drives.effort() == JointVector<2>(0, 0));
  CHECK_FALSE(bench.bus->drives.enabled(0));

  SECTION("it stays so when the drive is back, until activation") {
    bench.bus->on_feedback = [](CanFrame&) { return true; };
    bench.cycles(5);
    CHECK(bench.reading == Status::hardware_fault);
    CHECK(bench.writing == Status::hardware_fault);
    CHECK(bench.bus->drives.effort() == JointVector<2>(0, 0));
    CHECK(bench.arm.activate() == Status::ok);
    bench.cycle();
    CHECK(bench.reading == Status::ok);
    CHECK(bench.bus->drives.effort() == JointVector<2>(1, -1));
  }
}

TEST_CASE("half of a joint's feedback is none") {
  Bench bench;
  bench.cycles(3);
  bench.bus->on_feedback = [](CanFrame& frame) {
    return frame.identifier != quanser::motion_base + 1;
  };
  bench.cycle();
  const double before = bench.state.position[0];
  bench.cycles(2);
  CHECK(bench.state.position[0] == before);
  CHECK(bench.arm.statistics().partial > 0);
}

TEST_CASE("feedback that comes late is used with its age, and old feedback not at all") {
  Bench bench;
  std::deque<CanFrame> held;
  int delay = 2;  // cycles of 4 frames
  bench.bus->on_feedback = [&](CanFrame& frame) {
    held.push_back(frame);
    if (held.size() <= static_cast<std::size_t>(4 * delay)) return false;
    frame = held.front();
    held.pop_front();
    return true;
  };
  bench.cycles(10);
  CHECK(bench.reading == Status::ok);
  CHECK(bench.arm.reports()[0].age == 2 + 1);  // the last cycle's write has begun one more
  delay = 15;
  bench.cycles(15);
  CHECK(bench.reading == Status::stale_state);
  bench.bus->on_feedback = [](CanFrame&) { return true; };
  bench.cycles(2);
  CHECK(bench.reading == Status::ok);
  for (const CanFrame& frame : held) bench.bus->to_host.push_back(frame);
  const auto outdated = bench.arm.statistics().outdated;
  bench.cycle();
  CHECK(bench.reading == Status::ok);
  CHECK(bench.arm.reports()[0].age <= 1);
  CHECK(bench.arm.statistics().outdated > outdated);
}

TEST_CASE("a late frame does not displace one that is newer") {
  std::optional<CanFrame> old;  // before the arm, whose destructor still sends
  Bench bench;
  bench.cycles(5);
  bench.bus->on_feedback = [&](CanFrame& frame) {
    if (frame.identifier != quanser::position_base + 1) return true;
    // Each POSITION is followed by that of the cycle before, and then by its own MOTION.
    bench.bus->to_host.push_back(frame);
    std::swap(frame, old ? *old : frame);
    if (!old) old = frame;
    return true;
  };
  const auto partial = bench.arm.statistics().partial;
  for (int k = 0; k < 10; ++k) {
    bench.cycle();
    CHECK(bench.reading == Status::ok);
    CHECK(bench.arm.reports()[0].age <= 1);
  }
  CHECK(bench.arm.statistics().partial == partial);
  CHECK(bench.arm.statistics().outdated >= 8);
}

TEST_CASE("a fault of a drive stops all of them until activation") {
  Bench bench;
  bench.cycles(10);
  bench.bus->drives.raise_fault(0, quanser::over_current);
  bench.cycles(2);
  CHECK(bench.reading == Status::hardware_fault);
  CHECK(bench.writing == Status::hardware_fault);
  CHECK(bench.arm.fault().cause == CanCause::drive_fault);
  CHECK(bench.arm.fault().joint == 0);
  CHECK(bench.arm.fault().code == quanser::over_current);
  CHECK(bench.bus->drives.effort() == JointVector<2>(0, 0));
  CHECK_FALSE(bench.bus->drives.enabled(1));
  CHECK(bench.arm.activate() == Status::ok);
  CHECK(bench.arm.fault().cause == CanCause::none);
}

TEST_CASE("a motor encoder that contradicts the load's is a fault where a tolerance is given") {
  const double tolerance = 0.1, difference = GENERATE(0.09, 0.11, -0.5, 0.5);
  const int joint = GENERATE(0, 1);
  CAPTURE(difference, joint);
  const auto index = static_cast<std::size_t>(joint);
  QuanserModules<2> checked = modules;
  checked[index].encoder_tolerance = tolerance;
  const auto bus = make_bus();
  const auto slip = [&](CanFrame& frame) {
    auto position = quanser::decode_position(frame);
    if (position && is_feedback_of(frame, modules[index].node)) {
      position->motor_counts +=
          static_cast<std::int32_t>(std::lround(difference * modules[index].motor_scale()));
      frame = quanser::encode(*position, modules[index].node);
    }
    return true;
  };
  Arm arm(QuanserCodec<Q2d>{checked}, support::FakeCanTransport<Drives>(bus));
  JointState<2> state;

  SECTION("while the arm moves") {
    REQUIRE(arm.activate() == Status::ok);
    for (int k = 0; k < 10; ++k) {
      CHECK(arm.read(state) == Status::ok);
      CHECK(arm.write({{1, -1}}) == Status::ok);
    }
    bus->on_feedback = slip;
    CHECK(arm.read(state) == Status::ok);
    CHECK(arm.write({{1, -1}}) == Status::ok);
    if (std::abs(difference) < tolerance) {
      CHECK(arm.read(state) == Status::ok);
      return;
    }
    CHECK(arm.read(state) == Status::hardware_fault);  // by the first frame that shows it
    CHECK(arm.fault().cause == CanCause::encoder_mismatch);
    CHECK(arm.fault().joint == joint);
    CHECK(arm.write({{1, -1}}) == Status::hardware_fault);
    CHECK(bus->drives.effort() == JointVector<2>(0, 0));
    CHECK_FALSE(bus->drives.enabled(0));
    CHECK_FALSE(bus->drives.enabled(1));
    bus->on_feedback = [](CanFrame&) { return true; };
    CHECK(arm.activate() == Status::ok);
    CHECK(arm.read(state) == Status::ok);
  }
  SECTION("at activation, which enables no module then") {
    bus->on_feedback = slip;
    const bool plausible = std::abs(difference) < tolerance;
    CHECK((arm.activate() == Status::ok) == plausible);
    if (plausible) return;
    CHECK(arm.fault().cause == CanCause::encoder_mismatch);
    CHECK(arm.fault().joint == joint);
    for (const CanFrame& frame : bus->to_drives) {
      CHECK(quanser::decode_control(frame) != quanser::Control::enable);
    }
  }
  SECTION("without a tolerance it is not looked for") {
    bus->on_feedback = slip;
    Arm unchecked = make_arm(bus);
    CHECK(unchecked.activate() == Status::ok);
    CHECK(unchecked.read(state) == Status::ok);
  }
}

TEST_CASE("a drive that restarts does not move until activation") {
  Bench bench;
  bench.cycles(10);
  bench.bus->drives.restart(1);
  bench.cycles(5);
  CHECK(bench.reading == Status::hardware_fault);
  CHECK(bench.arm.fault().cause == CanCause::drive_disabled);
  CHECK(bench.arm.fault().joint == 1);
  CHECK(bench.bus->drives.effort() == JointVector<2>(0, 0));
  CHECK(bench.arm.activate() == Status::ok);
}

TEST_CASE("a bus that takes no frames: the drives drop to zero, then it is a fault") {
  Bench bench;
  bench.cycles(10);
  REQUIRE(bench.bus->drives.effort() == JointVector<2>(1, -1));
  bench.bus->sending = GENERATE(CanSending::backlog, CanSending::congested, CanSending::failed);
  const auto on_wire = bench.bus->to_drives.size();
  const bool is_busy = bench.bus->sending != CanSending::failed;
  for (int k = 0; k < 11; ++k) {
    CAPTURE(k);
    bench.cycle();
    CHECK(bench.writing == (is_busy && k < 2 ? Status::ok : Status::hardware_fault));
    bench.bus->silent_period();
  }
  CHECK(bench.bus->drives.effort() == JointVector<2>(0, 0));  // 10 ms without efforts
  CHECK(bench.arm.fault().cause == CanCause::not_sent);
  CHECK(bench.bus->to_drives.size() == on_wire);
  bench.bus->sending = CanSending::sent;
  bench.cycles(5);
  CHECK(bench.bus->drives.effort() == JointVector<2>(0, 0));
  for (std::size_t i = on_wire; i < bench.bus->to_drives.size(); ++i) {
    CHECK_FALSE(quanser::decode_effort(bench.bus->to_drives[i]));  // nothing old, nothing new
  }
  CHECK(bench.arm.activate() == Status::ok);
}

TEST_CASE("a fault that writing finds has its cause in that cycle") {
  Bench bench;
  bench.cycles(3);
  SECTION("of the link") {
    bench.bus->sending = CanSending::failed;
    const auto [link, cause] = GENERATE(table<CanLink, CanCause>({
        {CanLink::down, CanCause::link_down},
        {CanLink::gone, CanCause::link_gone},
        {CanLink::bus_off, CanCause::bus_off},
    }));
    REQUIRE(bench.arm.read(bench.state) == Status::ok);
    bench.bus->link = link;
    CHECK(bench.arm.write({{1, 1}}) == Status::hardware_fault);
    CHECK(bench.arm.fault().cause == cause);
    bench.bus->link = CanLink::up;  // latched
    bench.bus->sending = CanSending::sent;
    bench.cycle();
    CHECK(bench.reading == Status::hardware_fault);
    CHECK(bench.arm.fault().cause == cause);
  }
  SECTION("of a bus that is busy, as long as it is") {
    bench.bus->sending = GENERATE(CanSending::congested, CanSending::backlog, CanSending::failed);
    while (bench.writing == Status::ok) {
      CHECK(bench.arm.fault().cause == CanCause::none);
      bench.cycle();
    }
    CHECK(bench.writing == Status::hardware_fault);
    CHECK(bench.arm.fault().cause == CanCause::not_sent);
    bench.bus->sending = CanSending::sent;
    bench.cycle();
    CHECK(bench.writing == Status::ok);
    CHECK(bench.arm.fault().cause == CanCause::none);
  }
}

TEST_CASE("a command is sent if the one before has been on the bus, seen or not") {
  Bench bench;
  bench.cycles(3);
  bench.bus->sending_time = std::chrono::nanoseconds(0);
  CHECK(bench.arm.write({{2, 2}}) == Status::ok);
  CHECK(bench.arm.write({{3, 3}}) == Status::ok);  // no reading in between
  CHECK(bench.bus->drives.effort() == JointVector<2>(3, 3));
  CHECK(bench.arm.statistics().not_sent == 0);
}

TEST_CASE("deactivation lets go as soon as the last command has been on the bus") {
  Bench bench;
  bench.cycles(3);
  const auto sending_time = std::chrono::microseconds(GENERATE(250, 1250, 2500));
  bench.bus->sending_time = sending_time;
  CHECK(bench.arm.write({{2, 2}}) == Status::ok);
  const auto written = bench.bus->time;
  CHECK(bench.arm.write({{0, 0}}) == Status::ok);  // dropped: the bus is not free
  CHECK(bench.bus->drives.effort() == JointVector<2>(2, 2));
  std::chrono::nanoseconds let_go{};
  bench.bus->on_command = [&](CanFrame& frame) {
    if (quanser::decode_control(frame) && let_go.count() == 0) let_go = bench.bus->time;
    return true;
  };
  CHECK(bench.arm.deactivate() == Status::ok);
  CHECK(let_go - written == sending_time);
}

TEST_CASE("a run ends with a safe command and the stop, in consecutive cycles on the wire") {
  const auto bus = make_bus();
  Loop<Arm, PidPlusGravity> loop(make_arm(bus));
  loop.reference().position = {-0.5, 0.5};
  bus->sending_time = std::chrono::nanoseconds(0);
  SimulatedClock clock;
  const RunReport report = run(loop, clock, {.cycles = 20});
  CHECK(report.status == Status::ok);
  // From the last frame back: SYNC and the stop of each module, SYNC and the safe efforts.
  const auto& wire = bus->to_drives;
  const auto stop = std::ranges::find_if(wire, [](const CanFrame& frame) {
    return quanser::decode_control(frame).has_value() &&
           quanser::decode_control(frame) == quanser::Control::disable;
  });
  REQUIRE(stop - wire.begin() >= 6);
  const auto before = stop - 6;  // two cycles of two efforts and SYNC
  REQUIRE(quanser::decode_effort(before[0]));
  CHECK(quanser::decode_effort(before[0])->millinewton_metres != 0);
  for (int j = 0; j < 2; ++j) {
    REQUIRE(quanser::decode_effort(before[3 + j]));
    CHECK(quanser::decode_effort(before[3 + j])->millinewton_metres == 0);
    CHECK(quanser::decode_control(stop[j]) == quanser::Control::disable);
  }
  CHECK(*quanser::decode_sync(before[5]) == *quanser::decode_sync(before[2]) + 1);
  CHECK(*quanser::decode_sync(stop[2]) == *quanser::decode_sync(before[5]) + 1);
}

TEST_CASE("a link that fails is a fault at once") {
  Bench bench;
  bench.cycles(3);
  const auto [link, cause] = GENERATE(table<CanLink, CanCause>({
      {CanLink::down, CanCause::link_down},
      {CanLink::gone, CanCause::link_gone},
      {CanLink::bus_off, CanCause::bus_off},
  }));
  bench.bus->link = link;
  bench.cycle();
  CHECK(bench.reading == Status::hardware_fault);
  CHECK(bench.arm.fault().cause == cause);
  bench.bus->link = CanLink::up;
  bench.cycle();
  CHECK(bench.reading == Status::hardware_fault);
  SECTION("also after deactivation") {
    static_cast<void>(bench.arm.deactivate());
    bench.bus->link = CanLink::down;
    bench.cycle();
    CHECK(bench.reading == Status::hardware_fault);
    CHECK(bench.arm.fault().cause == CanCause::link_down);
    bench.bus->link = CanLink::up;
    bench.cycle();
    CHECK(bench.reading == Status::inactive);
  }
  const int opened = bench.bus->opened;
  CHECK(bench.arm.activate() == Status::ok);
  CHECK(bench.bus->opened == opened + 1);
}

TEST_CASE("commands that stop coming drop the efforts to zero within 11 ms") {
  Bench bench;
  bench.cycles(10);
  int periods = 0;
  while (bench.bus->drives.effort() != JointVector<2>(0, 0)) {
    bench.bus->silent_period();
    REQUIRE(++periods <= 11);
  }
  CHECK(periods >= 10);
  bench.cycle();
  bench.cycle();
  CHECK(bench.arm.fault().cause == CanCause::drive_fault);
  CHECK(bench.arm.fault().code == quanser::command_timeout);
}

TEST_CASE("efforts for another cycle are not put into force") {
  Bench bench;
  bench.cycles(10);
  bench.bus->on_command = [](CanFrame& frame) {
    if (frame.identifier == quanser::sync_identifier) --frame.data[0];
    return true;
  };
  bench.cycle({{5, 5}});
  CHECK(bench.bus->drives.effort() == JointVector<2>(1, -1));
}

TEST_CASE("efforts that SYNC has overtaken are put into force when they come") {
  Drives drives(modules);
  CanBatch answers;
  drives.receive(quanser::encode(quanser::Control::enable, 1), answers);
  drives.receive(quanser::encode_sync(7), answers);
  CHECK(drives.effort()[0] == 0);
  drives.receive(quanser::encode(quanser::Effort{1000, 7}, 1), answers);
  CHECK(drives.effort()[0] == 1);
  drives.receive(quanser::encode(quanser::Effort{2000, 6}, 1), answers);
  drives.receive(quanser::encode_sync(8), answers);
  CHECK(drives.effort()[0] == 1);
}

TEST_CASE("commands that are not finite become zero effort") {
  Bench bench;
  bench.cycles(3);
  bench.bus->to_drives.clear();
  bench.cycle({{support::not_a_number, 5}});
  CHECK(bench.writing == Status::non_finite_command);
  CHECK(bench.bus->drives.effort() == JointVector<2>(0, 0));
  bench.cycle({{support::infinity, 5}});
  CHECK(bench.writing == Status::non_finite_command);
  CHECK(bench.bus->drives.effort() == JointVector<2>(0, 0));
  bench.cycle();
  CHECK(bench.writing == Status::ok);
}

TEST_CASE("efforts beyond the frame's range are held within it") {
  Bench bench;
  bench.bus->to_drives.clear();
  bench.cycle({{1e9, -support::largest}});
  CHECK(quanser::decode_effort(bench.bus->to_drives[0])->millinewton_metres == 32767);
  CHECK(quanser::decode_effort(bench.bus->to_drives[1])->millinewton_metres == -32767);
  CHECK(bench.bus->drives.effort() == JointVector<2>(27.94, -13.62));  // the modules limit again
}

TEST_CASE("a supervised loop goes through fault, acknowledgement and activation") {
  const auto bus = make_bus();
  SupervisedLoop<Arm, PidPlusGravity> loop(make_arm(bus));
  const auto cycles = [&](int count) {
    for (int k = 0; k < count; ++k) static_cast<void>(loop.update());
  };
  cycles(5);
  CHECK(bus->to_drives.empty());  // inactive: not a frame
  loop.request_activation();
  cycles(5);
  REQUIRE(loop.mode() == LoopMode::active);
  JointReference<2> there;
  there.position = {0.5, -0.5};
  loop.post(there);
  cycles(500);
  CHECK((loop.state().position - there.position).norm() < 0.1);

  SECTION("of a drive") { bus->drives.raise_fault(1, quanser::over_speed); }
  SECTION("of the link") {
    bus->link = CanLink::gone;
    bus->can_open = false;
  }
  const JointVector<2> before = bus->drives.simulator().true_state().position;
  cycles(50);
  REQUIRE(loop.mode() == LoopMode::fault);
  CHECK(loop.fault() == Status::hardware_fault);
  bus->can_open = true;
  loop.acknowledge_fault();
  cycles(1);
  REQUIRE(loop.mode() == LoopMode::inactive);
  CHECK(bus->drives.effort() == JointVector<2>(0, 0));
  loop.request_activation();
  cycles(100);
  REQUIRE(loop.mode() == LoopMode::active);
  // It holds where it stands: the old reference is not taken up. It has coasted meanwhile.
  CHECK((bus->drives.simulator().true_state().position - before).norm() < 0.1);
}

TEST_CASE("a flood of frames does not hold up a reading") {
  Bench bench;
  CanFrame garbage;
  garbage.identifier = quanser::position_base + 1;
  for (int k = 0; k < 10000; ++k) bench.bus->to_host.push_back(garbage);
  bench.cycle();
  CHECK(bench.arm.statistics().malformed == 8 * 32);
}

TEST_CASE("set-up refuses what makes no sense, by name") {
  using Catch::Matchers::Contains;
  const auto refuses = [](auto change, const char* word) {
    QuanserModules<2> wrong = modules;
    change(wrong[1]);
    CHECK_THROWS_WITH(QuanserCodec<Q2d>(wrong), Contains("elbow_active_joint") && Contains(word));
  };
  refuses([](QuanserModule& m) { m.node = 0; }, "node 0");
  refuses([](QuanserModule& m) { m.node = 32; }, "node 32");
  refuses([](QuanserModule& m) { m.node = 1; }, "twice");
  refuses([](QuanserModule& m) { m.gear_ratio = 0; }, "gear_ratio");
  refuses([](QuanserModule& m) { m.motor_counts_per_turn = support::infinity; }, "motor_counts");
  refuses([](QuanserModule& m) { m.load_counts_per_turn = support::not_a_number; }, "load_counts");
  refuses([](QuanserModule& m) { m.position_at_zero = support::not_a_number; }, "position_at_zero");
  refuses([](QuanserModule& m) { m.gear_ratio = 1e6; }, "counts");
  refuses([](QuanserModule& m) { m.encoder_tolerance = 1e-5; }, "encoder_tolerance");
  refuses([](QuanserModule& m) { m.encoder_tolerance = support::not_a_number; },
          "encoder_tolerance");
  const auto bus = make_bus();
  CHECK_THROWS_WITH(make_arm(bus, {.stale_after = 0}), Contains("stale_after 0"));
  CHECK_THROWS_WITH(make_arm(bus, {.silent_after = 1}), Contains("silent_after 1"));
  CHECK_THROWS_WITH(make_arm(bus, {.not_sent_after = 0}), Contains("not_sent_after 0"));
  CHECK_THROWS_WITH(make_arm(bus, {.set_up_period = std::chrono::seconds(0)}),
                    Contains("set_up_period"));
  CHECK_THROWS_WITH(make_arm(bus, {.set_up_time = std::chrono::seconds(0)}),
                    Contains("set_up_time"));
}
