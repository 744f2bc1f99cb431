// SPDX-License-Identifier: Apache-2.0
// Springs and dampers for drives that take only efforts.
#include <articula/articula.hpp>
#include <articula/hardware/transmission/host_springs.hpp>
#include <articula/robots/q2d.hpp>

#include "catch.hpp"
#include "numbers.hpp"

#include <cmath>

using namespace articula;
using support::not_a_number;

namespace {

using Vector = JointVector<2>;

/// Drives that take efforts, at a state of the test.
struct EffortDrives {
  using RobotType = Q2d;
  static constexpr int joint_count = 2;
  JointState<2> state{Vector(0.3, -0.2), Vector(0.5, 1), Vector(7, 8)};
  EffortCommand<2> written{};
  Status reading = Status::ok, writing = Status::ok;
  Status activate() { return Status::ok; }
  Status deactivate() { return Status::ok; }
  Status read(JointState<2>& into) noexcept {
    into = state;
    return reading;
  }
  Status write(const EffortCommand<2>& command) noexcept {
    written = command;
    return writing;
  }
  Q2d robot() const { return {}; }
};
using Springs = HostSprings<EffortDrives>;

static_assert(Hardware<Springs, MultiModeCommand<2>> && !Hardware<Springs>);
static_assert(Hardware<HostSprings<Q2dSim>, MultiModeCommand<2>>);
static_assert(!PacingHardware<Springs>);

}  // namespace

TEST_CASE("the effort of springs, dampers and command is written, within the joints' limits") {
  Springs arm;
  JointState<2> state;
  REQUIRE(arm.read(state) == Status::ok);
  CHECK(state.effort == Vector(7, 8));
  const MultiModeCommand<2> command{.position = {0.5, 0},
                                    .velocity = {0, 0.5},
                                    .stiffness = {10, 20},
                                    .damping = {1, 2},
                                    .effort = {0.25, -1}};
  REQUIRE(arm.write(command) == Status::ok);
  const Vector expected(10 * 0.2 - 1 * 0.5 + 0.25, 20 * 0.2 - 2 * 0.5 - 1);
  CHECK((arm.hardware().written.effort - expected).norm() < 1e-12);

  MultiModeCommand<2> stiff = command;
  stiff.stiffness = {1e6, -1e6};
  REQUIRE(arm.write(stiff) == Status::ok);
  const Vector limits = effort_limits(Q2d());
  CHECK(arm.hardware().written.effort == Vector(limits[0], -limits[1]));
}

TEST_CASE("the status of the drives is passed on, and a NaN reaches them") {
  Springs arm;
  JointState<2> state;
  arm.hardware().reading = Status::stale_state;
  CHECK(arm.read(state) == Status::stale_state);
  arm.hardware().writing = Status::inactive;
  CHECK(arm.write({}) == Status::inactive);
  CHECK(arm.write({.effort = {not_a_number, 1}}) == Status::inactive);
  CHECK(std::isnan(arm.hardware().written.effort[0]));
  CHECK(arm.hardware().written.effort[1] == 1);
}

TEST_CASE("an impedance in the host moves an arm to where drives with springs move it") {
  const JointImpedanceGains<2> gains{
      {{.stiffness = 60, .damping = 8}, {.stiffness = 30, .damping = 2}}};
  Loop<Q2dSim, DriveImpedance> drives{Q2dSim(), DriveImpedance<Q2d>(gains)};
  Loop<HostSprings<Q2dSim>, DriveImpedance> host{HostSprings<Q2dSim>(Q2dSim()),
                                                 DriveImpedance<Q2d>(gains)};
  drives.reference().position = host.reference().position = Vector(0.4, -0.3);
  for (int k = 0; k < 8000; ++k) {
    REQUIRE(drives.update() == Status::ok);
    REQUIRE(host.update() == Status::ok);
    // One period of delay at 1 kHz and this damping.
    REQUIRE((drives.state().position - host.state().position).norm() < 5e-3);
  }
  CHECK((host.state().position - Vector(0.4, -0.3)).norm() < 1e-3);
}
