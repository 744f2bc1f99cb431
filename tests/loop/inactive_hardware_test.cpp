// SPDX-License-Identifier: Apache-2.0
// Hardware that is not active is not ok: nothing winds up meanwhile, and nothing jumps afterwards.
#include <articula/articula.hpp>
#include <articula/hardware/can/can_hardware.hpp>
#include <articula/hardware/mock/mock_hardware.hpp>
#include <articula/hardware/quanser/quanser_codec.hpp>
#include <articula/hardware/quanser/simulated_quanser_drives.hpp>
#include <articula/hardware/transmission/simple_transmission.hpp>
#include <articula/hardware/transmission/transmitted_hardware.hpp>
#include <articula/loop/run.hpp>
#include <articula/loop/simulated_clock.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>
#include <articula/robots/q2d.hpp>

#include "catch.hpp"
#include "hardware/fake_can_bus.hpp"
#include "robots/test_robots.hpp"

#include <memory>
#include <utility>
#include <vector>

using namespace articula;

namespace {

using Vector = JointVector<2>;
using Mock = MockHardware<Q2d>;
using Transmitted = TransmittedHardware<Mock, Q2d, SimpleTransmission, SimpleTransmission>;
using Drives = SimulatedQuanserDrives<Q2d>;
using Bus = support::FakeCanBus<Drives>;
using Arm = CanHardware<Q2d, QuanserCodec<Q2d>, support::FakeCanTransport<Drives>>;

constexpr QuanserModules<2> modules{{
    {.node = 1, .gear_ratio = 100, .load_counts_per_turn = 65536},
    {.node = 2, .gear_ratio = -80, .load_counts_per_turn = 65536},
}};

template <class R>
using Careful = Limited<R, PidPlusGravity<R>>;

const Vector small_error(1e-3, -1e-3);

Transmitted transmitted() {
  const Name shoulder("shoulder_active_joint"), elbow("elbow_active_joint");
  return Transmitted(Mock(), {.joints = {shoulder}, .actuators = {shoulder}},
                     {.joints = {elbow}, .actuators = {elbow}});
}

/// Deactivates a loop's hardware, leaves an error there for 5000 cycles, and activates it again.
/// @return  the first effort, less what a new controller would have asked for
template <class LoopType>
Vector growth_while_inactive(LoopType& loop) {
  loop.reference().position = loop.state().position + small_error;
  for (int k = 0; k < 10; ++k) REQUIRE(loop.update() == Status::ok);
  REQUIRE(loop.hardware().deactivate() == Status::ok);
  for (int k = 0; k < 5000; ++k) REQUIRE(loop.update() == Status::inactive);
  REQUIRE(loop.hardware().activate() == Status::ok);
  REQUIRE(loop.update() == Status::ok);
  PidPlusGravity<Q2d> fresh;
  fresh.start({loop.state(), loop.reference(), loop.period()});
  return loop.command().effort -
         fresh.update({loop.state(), loop.reference(), loop.period()}).effort;
}

}  // namespace

TEST_CASE("what was not active winds up nothing: mock hardware, also behind transmissions") {
  Loop<Mock, PidPlusGravity> mock;
  CHECK(growth_while_inactive(mock) == Vector(0, 0));
  Loop<Transmitted, PidPlusGravity> behind(transmitted());
  CHECK(growth_while_inactive(behind) == Vector(0, 0));
}

TEST_CASE("what was not active winds up nothing: a simulated arm, which falls meanwhile") {
  Loop<Q2dSim, PidPlusGravity> loop;
  const Vector before = loop.state().position;
  CHECK(growth_while_inactive(loop) == Vector(0, 0));
  CHECK(loop.state().effort == Vector(0, 0));  // of the last cycle without drives
  CHECK(loop.state().position != before);
}

TEST_CASE("what was not active winds up nothing: drives on a bus, after a failed activation") {
  const auto bus = std::make_shared<Bus>(Drives(modules, {}));
  Loop<Arm, PidPlusGravity> loop{
      Arm{QuanserCodec<Q2d>(modules), support::FakeCanTransport<Drives>(bus)}};
  CHECK(growth_while_inactive(loop).norm() < 1e-12);

  REQUIRE(loop.hardware().deactivate() == Status::ok);
  bus->can_open = false;
  REQUIRE(loop.hardware().activate() == Status::hardware_fault);
  bus->can_open = true;
  const auto cause = loop.hardware().fault().cause;
  for (int k = 0; k < 10; ++k) REQUIRE(loop.update() == Status::inactive);
  CHECK(loop.hardware().fault().cause == cause);
  CHECK(cause == CanCause::link_gone);
  CHECK(bus->drives.effort() == Vector(0, 0));
}

TEST_CASE("a supervised loop whose drives are switched off behind its back is in fault") {
  SupervisedLoop<Mock, PidPlusGravity> loop;
  loop.request_activation();
  for (int k = 0; k < 3; ++k) static_cast<void>(loop.update());
  REQUIRE(loop.mode() == LoopMode::active);
  REQUIRE(loop.hardware().deactivate() == Status::ok);
  for (int k = 0; k < 4; ++k) CHECK(loop.update() == Status::inactive);
  CHECK(loop.mode() == LoopMode::fault);
  CHECK(loop.fault() == Status::inactive);
  loop.acknowledge_fault();
  static_cast<void>(loop.update());
  CHECK(loop.mode() == LoopMode::inactive);
}

TEST_CASE("a loop that has been run is not active until its hardware is") {
  Loop<Q2dSim, PidPlusGravity> loop;
  SimulatedClock clock;
  CHECK(run(loop, clock, {.cycles = 10}).status == Status::ok);
  const RunReport again = run(loop, clock, {.cycles = 10});
  CHECK(again.status == Status::inactive);
  CHECK(again.cycles == 1);
  REQUIRE(loop.hardware().activate() == Status::ok);
  CHECK(run(loop, clock, {.cycles = 10}).status == Status::ok);
}

TEST_CASE("limits of effort rates begin at the measured effort, not at one that nobody gave") {
  using support::TiltedQ2d;
  CommandLimits<2> limits = command_limits(TiltedQ2d());
  limits.acceleration.setConstant(1000);
  limits.effort_rate.setConstant(1000);  // 1 N m in a cycle
  Loop<Simulator<TiltedQ2d>, Careful> loop{
      Simulator<TiltedQ2d>(SimulatorOptions<2>{.initial_position = Vector(1, 0.5)}),
      Careful<TiltedQ2d>(limits)};
  REQUIRE(gravity(TiltedQ2d(), loop.state().position).cwiseAbs().maxCoeff() > 2);
  REQUIRE(loop.update() == Status::ok);
  REQUIRE(loop.hardware().deactivate() == Status::ok);
  REQUIRE(loop.update() == Status::inactive);
  REQUIRE(loop.hardware().activate() == Status::ok);
  REQUIRE(loop.update() == Status::ok);
  CHECK(loop.command().effort.cwiseAbs().maxCoeff() <= 1);
}

namespace {

/// Position drives that tell nothing while they are not active, and nothing new at first.
struct SilentDrives {
  using RobotType = Q2d;
  static constexpr int joint_count = 2;
  Vector position = Vector::Zero();
  bool active = false;
  int stale_cycles = 0;
  std::vector<Vector> written{};

  [[nodiscard]] Q2d robot() const noexcept { return {}; }
  [[nodiscard]] Status activate() noexcept {
    active = true;
    return Status::ok;
  }
  [[nodiscard]] Status deactivate() noexcept {
    active = false;
    return Status::ok;
  }
  [[nodiscard]] Status read(JointState<2>& state) noexcept {
    if (!active) return Status::inactive;
    if (stale_cycles-- > 0) return Status::stale_state;
    state = {.position = position};
    return Status::ok;
  }
  [[nodiscard]] Status write(const PositionCommand<2>& command) noexcept {
    if (!active) return Status::inactive;
    written.push_back(command.position);
    position = command.position;
    return Status::ok;
  }
};

}  // namespace

TEST_CASE("a position from before drives were inactive is not commanded afterwards") {
  Loop<SilentDrives, ForwardPosition> loop;
  loop.reference().position = {0.1, 0.1};
  for (int k = 0; k < 10; ++k) REQUIRE(loop.update() == Status::ok);
  REQUIRE(loop.hardware().deactivate() == Status::ok);
  for (int k = 0; k < 10; ++k) REQUIRE(loop.update() == Status::inactive);
  loop.hardware().position = {-0.5, -0.5};  // pushed
  loop.hardware().stale_cycles = 2;
  loop.hardware().written.clear();
  REQUIRE(loop.hardware().activate() == Status::ok);
  REQUIRE(loop.update() == Status::stale_state);
  REQUIRE(loop.update() == Status::stale_state);
  CHECK(loop.hardware().written.empty());
  CHECK(loop.hardware().position == Vector(-0.5, -0.5));
}
