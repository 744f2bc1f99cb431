// SPDX-License-Identifier: Apache-2.0
// The loop when all goes well, and its set-up when it does not.
#include <articula/articula.hpp>
#include <articula/hardware/can/can_fault.hpp>
#include <articula/robots/q2d.hpp>

#include <cmath>
#include <memory>
#include <string>

#include "catch.hpp"
#include "hardware/fake_hardware.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "robots/test_robots.hpp"
#include "test_controllers.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::FakeHardware;
using support::TiltedQ2d;

namespace {

using Vector = JointVector<2>;
using FakeQ2d = FakeHardware<Q2d>;

FakeQ2d joints_at(const Vector& position) {
  FakeQ2d hardware;
  hardware.measured.position = position;
  return hardware;
}

/// A controller as a user writes it: a spring and damper towards the reference.
template <Robot R>
class Impedance {
 public:
  static constexpr int n = joint_count<R>;

  explicit Impedance(double stiffness = 30, double damping = 1)
      : stiffness_(stiffness), damping_(damping) {}

  EffortCommand<n> update(const ControlInput<n>& in) noexcept {
    return {stiffness_ * (in.reference.position - in.state.position) -
            damping_ * in.state.velocity};
  }

 private:
  double stiffness_, damping_;
};
static_assert(Controller<Impedance<Q2d>, 2>);

/// Hardware that counts its activations where a test can see them after a failure.
struct Fussy : FakeQ2d {
  std::shared_ptr<int> activations = std::make_shared<int>(0);

  [[nodiscard]] Status activate() noexcept {
    ++*activations;
    return activation;
  }
};

}  // namespace

TEST_CASE("the program of the first page works as printed") {
  Loop<Q2dSim, PidPlusGravity> loop;
  loop.reference().position = {-1.0, 1.0};
  for (int k = 0; k < 2000; ++k) REQUIRE(loop.update() == Status::ok);
  // The drives' limits let the shoulder turn by at most 0.94 rad/s; after 2 s both have arrived.
  CHECK((loop.state().position - Vector(-1, 1)).cwiseAbs().maxCoeff() < 0.05);
}

TEST_CASE("the defaults are the simulated arm's: 1 kHz, and the course's gains") {
  Loop<Q2dSim, Pid> loop;
  CHECK(loop.period() == 1e-3);
  CHECK(loop.controller().part<PidLaw<2>>().gains()[0].proportional == 2310);
}

TEST_CASE("the reference starts as measured, and nothing moves") {
  SimulatorOptions<2> options;
  options.initial_position = {0.3, -0.4};
  Loop<Q2dSim, Pid> loop(Q2dSim{options});
  CHECK(loop.reference().position == Vector(0.3, -0.4));
  for (int k = 0; k < 100; ++k) {
    REQUIRE(loop.update() == Status::ok);
    CHECK(loop.command().effort == Vector(0, 0));
  }
  CHECK(loop.state().position == Vector(0.3, -0.4));
}

TEST_CASE("joints that move before the first update are held where they are then") {
  Loop<FakeQ2d, Pid> loop(joints_at({0.1, 0.2}));
  loop.hardware().measured.position = {0.15, 0.25};
  CHECK(loop.update() == Status::ok);
  CHECK(loop.reference().position == Vector(0.15, 0.25));
  CHECK(loop.command().effort == Vector(0, 0));  // no jump
}

TEST_CASE("a reference that was set before the first update is honoured") {
  Loop<FakeQ2d, Pid> loop(joints_at({0.1, 0.2}));
  loop.reference().position = {0.5, -0.5};
  loop.reference().velocity = {1, 2};
  CHECK(loop.update() == Status::ok);
  CHECK(loop.reference().position == Vector(0.5, -0.5));
  CHECK(loop.reference().velocity == Vector(1, 2));
}

TEST_CASE("a reference set for one joint leaves the other where it is") {
  Loop<FakeQ2d, Pid> loop(joints_at({0.1, 0.2}));
  loop.reference().position[1] = 0.7;
  loop.hardware().measured.position = {0.15, 0.25};
  CHECK(loop.update() == Status::ok);
  CHECK(loop.reference().position == Vector(0.15, 0.7));
}

TEST_CASE("a reference set to where the joints are is honoured while they stay there") {
  Loop<FakeQ2d, Pid> loop(joints_at({0.1, 0.2}));
  loop.reference().position = {0.1, 0.2};
  CHECK(loop.update() == Status::ok);
  CHECK(loop.reference().position == Vector(0.1, 0.2));
}

TEST_CASE("a reference is honoured also where the joints could not be read at the beginning") {
  FakeQ2d hardware = joints_at({0.1, 0.2});
  hardware.reading = Status::hardware_fault;
  Loop<FakeQ2d, Pid> loop(hardware);
  loop.reference().position[0] = 0.4;
  CHECK(loop.update() == Status::hardware_fault);
  loop.hardware().reading = Status::ok;
  CHECK(loop.update() == Status::ok);
  CHECK(loop.reference().position == Vector(0.4, 0.2));
}

TEST_CASE("after the first update the reference is the user's alone") {
  Loop<FakeQ2d, Pid> loop(joints_at({0.1, 0.2}));
  CHECK(loop.update() == Status::ok);
  loop.hardware().measured.position = {0.3, 0.4};
  CHECK(loop.update() == Status::ok);
  CHECK(loop.reference().position == Vector(0.1, 0.2));
}

TEST_CASE("the controller is started once, by the first good cycle") {
  FakeQ2d hardware;
  hardware.reading = Status::hardware_fault;
  Loop<FakeQ2d, support::ConstantEffort> loop(hardware, {.effort = 1});
  for (int k = 0; k < 3; ++k) CHECK(loop.update() == Status::hardware_fault);
  CHECK(loop.controller().starts == 0);
  loop.hardware().reading = Status::ok;
  for (int k = 0; k < 3; ++k) CHECK(loop.update() == Status::ok);
  CHECK(loop.controller().starts == 1);
  CHECK(loop.controller().updates == 3);
}

TEST_CASE("time counts the periods, and state and command belong to it") {
  Loop<FakeQ2d, support::ConstantEffort> loop(joints_at({0.1, 0.2}), {.effort = 1}, 0.25);
  CHECK(loop.period() == 0.25);
  CHECK(loop.time() == 0);
  CHECK(loop.state().position == Vector(0.1, 0.2));  // already before the first update
  for (int k = 0; k < 5; ++k) {
    loop.hardware().measured.position.setConstant(k);
    loop.controller().effort = k;
    CHECK(loop.update() == Status::ok);
    CHECK(loop.time() == 0.25 * k);
    CHECK(loop.state().position == Vector(k, k));
    CHECK(loop.command().effort == Vector(k, k));
    CHECK(loop.hardware().written.effort == Vector(k, k));
  }
  CHECK(loop.hardware().writes == 5);
}

TEST_CASE("time does not drift") {
  Loop<FakeQ2d, support::ConstantEffort> loop;
  for (int k = 0; k <= 100000; ++k) static_cast<void>(loop.update());
  CHECK(loop.time() == 100000 * 1e-3);
}

TEST_CASE("the state is that before the command acts") {
  Loop<Q2dSim, Bypass> loop;
  loop.reference().effort = {1, 1};
  CHECK(loop.update() == Status::ok);
  CHECK(loop.state().position == Vector(0, 0));
  CHECK(loop.hardware().true_state().position != Vector(0, 0));
  CHECK(loop.update() == Status::ok);
  CHECK(loop.state().effort == Vector(1, 1));
}

TEST_CASE("no controller gets more out of the drives than they can give") {
  for (const double effort : {1e9, -1e9, support::largest, -support::largest, 28.0}) {
    CAPTURE(effort);
    Loop<FakeQ2d, support::ConstantEffort> loop(FakeQ2d(), {.effort = effort});
    CHECK(loop.update() == Status::ok);
    const Vector limit(27.94, 13.62);
    CHECK(loop.hardware().written.effort == (effort > 0 ? limit : Vector(-limit)));
    CHECK(loop.command().effort == loop.hardware().written.effort);
  }
}

TEST_CASE("a user's controller runs in the loop") {
  Loop<Q2dSim, Impedance> loop{Impedance<Q2d>(100, 0)};
  loop.reference().position = {0.2, -0.1};
  for (int k = 0; k < 5000; ++k) REQUIRE(loop.update() == Status::ok);
  // The joints' damping over the stiffness: 0.3 s for the shoulder, exp(-5 / 0.3) is 6e-8.
  CHECK((loop.state().position - Vector(0.2, -0.1)).norm() < 1e-7);
}

TEST_CASE("position drives get the position, velocity drives the velocity") {
  Loop<FakeHardware<Q2d, PositionCommand<2>>, support::PositionForward> position;
  position.reference().position = {0.1, 0.2};
  CHECK(position.update() == Status::ok);
  CHECK(position.hardware().written.position == Vector(0.1, 0.2));

  Loop<FakeHardware<Q2d, VelocityCommand<2>>, support::VelocityApproach> velocity;
  velocity.reference().position = {0.1, 0.2};
  CHECK(velocity.update() == Status::ok);
  CHECK(velocity.hardware().written.velocity == Vector(1, 2));
}

TEST_CASE("a robot loaded at run time moves as the one known at compile time") {
  const Model<2> model = support::model<TiltedQ2d>();
  Loop<Simulator<TiltedQ2d>, PidPlusGravity> described;
  Loop<Simulator<Model<2>>, PidPlusGravity> loaded(
      Simulator<Model<2>>(model), PidPlusGravity<Model<2>>(model, TiltedQ2d::pid_gains));
  Loop<Simulator<TiltedQ2d>, ComputedTorque> described_torque;
  Loop<Simulator<Model<2>>, ComputedTorque> loaded_torque(
      Simulator<Model<2>>(model),
      ComputedTorque<Model<2>>(model, ComputedTorque<Model<2>>::critically_damped(20)));
  const auto follow = [](auto& one, auto& two) {
    one.reference().position = two.reference().position = Vector(0.4, -0.8);
    for (int k = 0; k < 2000; ++k) {
      REQUIRE(one.update() == Status::ok);
      REQUIRE(two.update() == Status::ok);
    }
    // A compiler may fold or fuse operations of one and not of the other: rounding.
    CHECK((one.state().position - two.state().position).norm() < 1e-12);
    CHECK((one.state().position - Vector(0.4, -0.8)).norm() < 0.1);
  };
  follow(described, loaded);
  follow(described_torque, loaded_torque);
}

TEST_CASE("a period that is not a positive number is refused before anything moves") {
  for (const double period : {0.0, -1e-3, support::not_a_number, support::infinity}) {
    CAPTURE(period);
    Fussy hardware;
    using FussyLoop = Loop<Fussy, support::ConstantEffort>;
    CHECK_THROWS_AS(FussyLoop(hardware, {}, period), std::invalid_argument);
    CHECK_THROWS_WITH(FussyLoop(hardware, {}, period), Contains("period"));
    CHECK(*hardware.activations == 0);
  }
}

TEST_CASE("the smallest period is a period") {
  Loop<FakeQ2d, Pid> loop(FakeQ2d(), Pid<Q2d>(), support::smallest);
  loop.reference().position = {1e-3, 1e-3};
  CHECK(loop.update() == Status::ok);
}

TEST_CASE("hardware that cannot be activated is refused") {
  Fussy hardware;
  hardware.activation = Status::hardware_fault;
  using FussyLoop = Loop<Fussy, support::ConstantEffort>;
  CHECK_THROWS_AS(FussyLoop(hardware, {}), std::runtime_error);
  CHECK_THROWS_WITH(FussyLoop(hardware, {}), Contains("activated"));
  CHECK(*hardware.activations == 2);
  // The loop has the hardware, so its message tells the hardware's fault.
  struct Drive : Fussy {
    [[nodiscard]] CanFault fault() const noexcept {
      return {.cause = CanCause::no_activation, .joint = 1};
    }
  };
  Drive drive;
  drive.activation = Status::hardware_fault;
  using DriveLoop = Loop<Drive, support::ConstantEffort>;
  CHECK_THROWS_WITH(DriveLoop(drive, {}), Contains("activated: ") && Contains(": joint 1"));
}

TEST_CASE("a simulator dictates the period") {
  using SimulatedLoop = Loop<Q2dSim, Pid>;
  const Q2dSim simulator(SimulatorOptions<2>{.period = 5e-4});
  CHECK(SimulatedLoop(simulator).period() == 5e-4);
  CHECK(SimulatedLoop(simulator, {}, 5e-4).period() == 5e-4);
  for (const double other : {1.0, 1e-3, 0.0, -5e-4, support::not_a_number, support::infinity}) {
    CAPTURE(other);
    CHECK_THROWS_AS(SimulatedLoop(simulator, {}, other), std::invalid_argument);
    CHECK_THROWS_WITH(SimulatedLoop(simulator, {}, other), Contains("hardware has 0.0005 s"));
  }
}
