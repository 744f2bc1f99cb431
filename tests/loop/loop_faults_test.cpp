// SPDX-License-Identifier: Apache-2.0
// What a loop does when something is wrong: say so, and leave a safe command behind.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

#include "catch.hpp"
#include "hardware/fake_hardware.hpp"
#include "numbers.hpp"
#include "robots/test_robots.hpp"
#include "test_controllers.hpp"

using namespace articula;
using support::FakeHardware;
using support::infinity;
using support::not_a_number;
using support::TiltedQ2d;

namespace {

using Vector = JointVector<2>;
using FakeArm = FakeHardware<TiltedQ2d>;

/// Too heavy for its drives.
struct HeavyQ2d {
  static constexpr auto description = [] {
    auto heavy = Q2d::description;
    heavy.gravity = {1e4, 0, 0};
    return heavy;
  }();
};

const Vector place(0.3, -0.7);
const double wrong_numbers[] = {not_a_number, -not_a_number, infinity, -infinity};

FakeArm arm() {
  FakeArm hardware;
  hardware.measured.position = place;
  hardware.measured.velocity = {0.1, -0.2};
  return hardware;
}

Vector holding_effort() { return gravity(TiltedQ2d(), place); }

/// A loop that has done some good cycles, so that its integral is not zero.
template <template <class> class Controller>
Loop<FakeArm, Controller> running_loop() {
  Loop<FakeArm, Controller> loop(arm());
  loop.reference().position = place + Vector(1e-3, -1e-3);
  for (int k = 0; k < 10; ++k) REQUIRE(loop.update() == Status::ok);
  return loop;
}

/// Spoils one number of a loop for one cycle, at the hardware or at the reference.
template <class LoopType>
Status spoilt_cycle(LoopType& loop, double& number, double wrong) {
  const double good = number;
  number = wrong;
  const Status status = loop.update();
  number = good;
  return status;
}

template <template <class> class Controller>
void survives_wrong_states() {
  for (const double wrong : wrong_numbers) {
    for (int j = 0; j < 2; ++j) {
      for (auto member :
           {&JointState<2>::position, &JointState<2>::velocity, &JointState<2>::effort}) {
        CAPTURE(wrong, j, member == &JointState<2>::position);
        auto loop = running_loop<Controller>(), undisturbed = running_loop<Controller>();
        CHECK(spoilt_cycle(loop, (loop.hardware().measured.*member)[j], wrong) ==
              Status::non_finite_state);
        const Vector safe = member == &JointState<2>::position ? Vector(0, 0) : holding_effort();
        CHECK(loop.hardware().written.effort == safe);
        CHECK(loop.command().effort == safe);
        // The next cycle is as if nothing had happened.
        CHECK(loop.update() == Status::ok);
        CHECK(undisturbed.update() == Status::ok);
        CHECK(loop.command().effort == undisturbed.command().effort);
        CHECK_FALSE(loop.hardware().was_given_non_finite);
      }
    }
  }
}

template <template <class> class Controller>
void survives_wrong_references() {
  using Reference = JointReference<2>;
  for (const double wrong : wrong_numbers) {
    for (int j = 0; j < 2; ++j) {
      for (auto member : {&Reference::position, &Reference::velocity, &Reference::acceleration,
                          &Reference::effort}) {
        CAPTURE(wrong, j);
        auto loop = running_loop<Controller>(), undisturbed = running_loop<Controller>();
        CHECK(spoilt_cycle(loop, (loop.reference().*member)[j], wrong) ==
              Status::non_finite_reference);
        CHECK(loop.hardware().written.effort == holding_effort());
        CHECK(loop.update() == Status::ok);
        CHECK(undisturbed.update() == Status::ok);
        CHECK(loop.command().effort == undisturbed.command().effort);
        CHECK_FALSE(loop.hardware().was_given_non_finite);
      }
    }
  }
}

}  // namespace

TEST_CASE("the arm's holding effort is worth the name") {
  CHECK(holding_effort().cwiseAbs().minCoeff() > 0.1);
}

TEST_CASE("a wrong number in the state is survived by every controller") {
  survives_wrong_states<Bypass>();
  survives_wrong_states<Pid>();
  survives_wrong_states<PidPlusGravity>();
  survives_wrong_states<ComputedTorque>();
}

TEST_CASE("a wrong number in the reference is survived by every controller") {
  survives_wrong_references<Bypass>();
  survives_wrong_references<Pid>();
  survives_wrong_references<PidPlusGravity>();
  survives_wrong_references<ComputedTorque>();
}

TEST_CASE("a wrong number in the very first state does not become the reference") {
  FakeArm hardware = arm();
  hardware.measured.position[1] = not_a_number;
  Loop<FakeArm, Pid> loop(hardware);
  CHECK(loop.update() == Status::non_finite_state);
  CHECK(loop.hardware().written.effort == Vector(0, 0));
  loop.hardware().measured.position = place;
  CHECK(loop.update() == Status::ok);
  CHECK(loop.reference().position == place);
}

TEST_CASE("a wrong number of the controller never reaches the hardware") {
  for (const double wrong : wrong_numbers) {
    CAPTURE(wrong);
    Loop<FakeArm, support::ConstantEffort> loop(arm(), {.effort = 1});
    CHECK(loop.update() == Status::ok);
    loop.controller().effort = wrong;
    CHECK(loop.update() == Status::non_finite_command);
    CHECK(loop.hardware().written.effort == holding_effort());
    loop.controller().effort = 1;
    CHECK(loop.update() == Status::ok);
    CHECK(loop.hardware().written.effort == Vector(1, 1));
    CHECK_FALSE(loop.hardware().was_given_non_finite);
  }
}

TEST_CASE("a wrong number that a controller writes into an outcome is a failed command") {
  double wrong = 0;
  const auto control = [&](const ControlInput<2>& in) noexcept {
    Outcome<EffortCommand<2>> outcome(EffortCommand<2>{gravity(TiltedQ2d(), in.state.position)});
    outcome.command.effort[1] += wrong;
    return outcome;
  };
  struct Controller {
    decltype(control) control_;
    Outcome<EffortCommand<2>> update(const ControlInput<2>& in) noexcept { return control_(in); }
    Outcome<EffortCommand<2>> brake(const ControlInput<2>& in) noexcept { return control_(in); }
  };
  for (const double number : wrong_numbers) {
    for (const bool brakes : {false, true}) {
      CAPTURE(number, brakes);
      wrong = 0;
      ControlLoop loop{arm(), Controller{control}};
      REQUIRE(loop.update() == Status::ok);
      wrong = number;
      if (brakes) loop.reference().position[0] = not_a_number;
      CHECK(loop.update() == (brakes ? Status::non_finite_reference : Status::non_finite_command));
      CHECK(loop.command().effort == holding_effort());
      CHECK(loop.hardware().written.effort == holding_effort());
      CHECK_FALSE(loop.hardware().was_given_non_finite);
    }
  }
}

TEST_CASE("states at the ends of the numbers are survived") {
  for (const double huge : {support::largest, -support::largest, 1e300, support::smallest}) {
    CAPTURE(huge);
    auto loop = running_loop<PidPlusGravity>();
    auto torque = running_loop<ComputedTorque>();
    const auto survives = [&](auto& any) {
      for (auto member : {&JointState<2>::position, &JointState<2>::velocity}) {
        static_cast<void>(spoilt_cycle(any, (any.hardware().measured.*member)[0], huge));
        static_cast<void>(spoilt_cycle(any, (any.reference().position)[0], -huge));
      }
      CHECK(any.update() == Status::ok);
      CHECK_FALSE(any.hardware().was_given_non_finite);
      CHECK(any.hardware().written.effort.cwiseAbs()[0] <= 27.94);
      CHECK(any.hardware().written.effort.cwiseAbs()[1] <= 13.62);
    };
    survives(loop);
    survives(torque);
  }
}

// Measured and asked for at opposite ends, even the difference overflows.
TEST_CASE("an error that overflows is over in the next cycle") {
  auto loop = running_loop<PidPlusGravity>();
  loop.hardware().measured.position[0] = -support::largest;
  loop.reference().position[0] = support::largest;
  static_cast<void>(loop.update());
  loop.hardware().measured.position = place;
  loop.reference().position = place;
  CHECK(loop.update() == Status::ok);
  CHECK_FALSE(loop.hardware().was_given_non_finite);
}

TEST_CASE("joints that cannot be read get no effort, and no old position is trusted") {
  auto loop = running_loop<PidPlusGravity>();
  loop.hardware().reading = Status::hardware_fault;
  for (int k = 0; k < 3; ++k) {
    CHECK(loop.update() == Status::hardware_fault);
    CHECK(loop.hardware().written.effort == Vector(0, 0));
  }
  loop.hardware().reading = Status::ok;
  CHECK(loop.update() == Status::ok);
  CHECK(loop.hardware().written.effort != Vector(0, 0));
}

namespace {

/// A position and gains at which the integral soon holds most of the command.
template <Robot R>
struct Integrating : Pid<R> {
  Integrating()
      : Pid<R>({PidGains{.proportional = 10, .integral = 1000},
                PidGains{.proportional = 10, .integral = 1000}}) {}
};

/// One whose p/i is 100 s.
template <Robot R>
struct SlowlyIntegrating : Pid<R> {
  SlowlyIntegrating()
      : Pid<R>({PidGains{.proportional = 100, .integral = 1},
                PidGains{.proportional = 100, .integral = 1}}) {}
};
template <class R>
using SwitchedSlowlyIntegrating = Switch<R, SlowlyIntegrating<R>>;

template <class R>
using CarefulPosition = Limited<R, support::PositionForward<R>>;

/// Lets a loop have so many cycles with a status of the hardware, or a NaN in its reference.
template <class LoopType>
void have_bad_cycles(LoopType& loop, Status status, int count) {
  for (int k = 0; k < count; ++k) {
    if (status == Status::non_finite_reference) {
      CHECK(spoilt_cycle(loop, loop.reference().velocity[0], not_a_number) == status);
    } else {
      loop.hardware().reading = status;
      CHECK(loop.update() == status);
      loop.hardware().reading = Status::ok;
    }
  }
}

}  // namespace

TEST_CASE("few bad cycles in a row cost no integral") {
  for (const Status status : {Status::stale_state, Status::non_finite_reference}) {
    CAPTURE(to_string(status));
    auto loop = running_loop<Integrating>(), undisturbed = running_loop<Integrating>();
    for (int round = 0; round < 3; ++round) {
      have_bad_cycles(loop, status, decltype(loop)::borne_cycles);
      CHECK(loop.update() == Status::ok);
      CHECK(undisturbed.update() == Status::ok);
      CHECK(loop.command().effort == undisturbed.command().effort);
    }
  }
}

TEST_CASE("after many bad cycles, or one without hardware, the controller starts anew") {
  auto loop = running_loop<Integrating>();
  const auto fresh_command = [&] {
    Integrating<TiltedQ2d> fresh;
    fresh.start({loop.hardware().measured, loop.reference(), loop.period()});
    return fresh.update({loop.hardware().measured, loop.reference(), loop.period()}).effort;
  };
  SECTION("stale") { have_bad_cycles(loop, Status::stale_state, 4); }
  SECTION("stale for long") { have_bad_cycles(loop, Status::stale_state, 4000); }
  SECTION("not read") { have_bad_cycles(loop, Status::hardware_fault, 1); }
  SECTION("not written") {
    loop.hardware().writing = Status::hardware_fault;
    CHECK(loop.update() == Status::hardware_fault);
    loop.hardware().writing = Status::ok;
  }
  SECTION("not written because of another fault") {
    loop.hardware().writing = Status::hardware_fault;
    have_bad_cycles(loop, Status::stale_state, 1);
    loop.hardware().writing = Status::ok;
  }
  CHECK(loop.update() == Status::ok);
  CHECK(loop.command().effort == fresh_command());
  CHECK(loop.update() == Status::ok);  // and once
  CHECK(loop.command().effort != fresh_command());
}

TEST_CASE(
    "after many cycles without a reference control begins with the effort that held the arm") {
  auto loop = running_loop<Integrating>();
  loop.reference().position = place;
  have_bad_cycles(loop, Status::non_finite_reference, 10);
  REQUIRE(loop.command().effort == holding_effort());
  CHECK(loop.update() == Status::ok);
  CHECK((loop.command().effort - holding_effort()).norm() < 1e-12 * holding_effort().norm());
}

TEST_CASE("slow integrals begin with the effort that held the arm, too") {
  const auto check = [](auto loop) {
    loop.reference().position = place;
    have_bad_cycles(loop, Status::non_finite_reference, 10);
    CHECK(loop.update() == Status::ok);
    CHECK((loop.command().effort - holding_effort()).norm() < 1e-12 * holding_effort().norm());
  };
  check(running_loop<SlowlyIntegrating>());
  check(running_loop<SwitchedSlowlyIntegrating>());
}

TEST_CASE("limits begin at the measured state after a fault, not where they were before") {
  CommandLimits<2> limits = command_limits(TiltedQ2d());
  limits.velocity = {1, 1};
  limits.acceleration = {10, 10};
  using Hardware = FakeHardware<TiltedQ2d, PositionCommand<2>>;
  Hardware hardware;
  hardware.measured.position = place;
  Loop<Hardware, CarefulPosition> loop(hardware, CarefulPosition<TiltedQ2d>(limits));
  loop.reference().position = place + Vector(0.5, 0.5);
  for (int k = 0; k < 100; ++k) REQUIRE(loop.update() == Status::ok);
  // The arm is moved by hand while it cannot be read.
  have_bad_cycles(loop, Status::hardware_fault, 3);
  loop.hardware().measured.position = place - Vector(0.3, 0.3);
  CHECK(loop.update() == Status::ok);
  // Within the first cycle it goes from there as far as the acceleration allows.
  CHECK((loop.command().position - loop.hardware().measured.position).cwiseAbs().maxCoeff() < 1e-4);
}

TEST_CASE("the hardware's own report of a wrong number is passed on") {
  auto loop = running_loop<Pid>();
  loop.hardware().reading = Status::non_finite_state;
  CHECK(loop.update() == Status::non_finite_state);
}

TEST_CASE("a command that cannot be written is reported, but the first fault counts") {
  auto loop = running_loop<Pid>();
  loop.hardware().writing = Status::hardware_fault;
  CHECK(loop.update() == Status::hardware_fault);
  CHECK(spoilt_cycle(loop, loop.reference().position[0], not_a_number) ==
        Status::non_finite_reference);
  loop.hardware().writing = Status::ok;
  CHECK(loop.update() == Status::ok);
}

TEST_CASE("in a fault time goes on and the hardware is served") {
  auto loop = running_loop<Pid>();
  const int writes = loop.hardware().writes;
  const double time = loop.time();
  loop.reference().position[0] = not_a_number;
  for (int k = 0; k < 5; ++k) CHECK(loop.update() == Status::non_finite_reference);
  CHECK(loop.hardware().writes == writes + 5);
  CHECK(loop.time() == Approx(time + 5e-3));
}

TEST_CASE("the safe effort is limited too") {
  FakeHardware<HeavyQ2d> hardware;
  hardware.measured.position = place;
  Loop<FakeHardware<HeavyQ2d>, support::ConstantEffort> loop(hardware, {.effort = not_a_number});
  CHECK(loop.update() == Status::non_finite_command);
  CHECK(loop.hardware().written.effort.cwiseAbs() == Vector(27.94, 13.62));
}

TEST_CASE("position drives are told to stay where they are, or where they were sent") {
  using Hardware = FakeHardware<TiltedQ2d, PositionCommand<2>>;
  Hardware hardware;
  hardware.measured.position = place;
  Loop<Hardware, support::PositionForward> loop(hardware);
  loop.hardware().reading = Status::hardware_fault;
  CHECK(loop.update() == Status::hardware_fault);  // before any command: as at construction
  CHECK(loop.hardware().written.position == place);
  loop.hardware().reading = Status::ok;

  loop.reference().position = {0.5, 0.6};
  CHECK(loop.update() == Status::ok);
  CHECK(loop.hardware().written.position == Vector(0.5, 0.6));
  CHECK(spoilt_cycle(loop, loop.reference().position[0], infinity) == Status::non_finite_reference);
  CHECK(loop.hardware().written.position == place);

  CHECK(loop.update() == Status::ok);
  loop.hardware().reading = Status::hardware_fault;
  CHECK(loop.update() == Status::hardware_fault);
  CHECK(loop.hardware().written.position == Vector(0.5, 0.6));
  CHECK_FALSE(loop.hardware().was_given_non_finite);
}

TEST_CASE("position drives whose joints were never read are not sent anywhere") {
  using Hardware = FakeHardware<TiltedQ2d, PositionCommand<2>>;
  Hardware hardware;
  hardware.reading = Status::hardware_fault;
  Loop<Hardware, support::PositionForward> loop(hardware);
  CHECK(loop.update() == Status::hardware_fault);
  CHECK(loop.hardware().writes == 0);
}

TEST_CASE("velocity drives are told to stand still") {
  using Hardware = FakeHardware<TiltedQ2d, VelocityCommand<2>>;
  Loop<Hardware, support::VelocityApproach> loop;
  loop.reference().position = {0.5, 0.6};
  CHECK(loop.update() == Status::ok);
  CHECK(loop.hardware().written.velocity == Vector(5, 6));
  CHECK(spoilt_cycle(loop, loop.reference().velocity[1], not_a_number) ==
        Status::non_finite_reference);
  CHECK(loop.hardware().written.velocity == Vector(0, 0));
  CHECK(spoilt_cycle(loop, loop.hardware().measured.position[1], not_a_number) ==
        Status::non_finite_state);
  CHECK(loop.hardware().written.velocity == Vector(0, 0));
}

TEST_CASE("a simulated arm survives wrong numbers and goes on to its reference") {
  Loop<Simulator<TiltedQ2d>, PidPlusGravity> loop;
  const Vector target(0.2, -0.3);
  for (int k = 0; k < 4000; ++k) {
    loop.reference().position = target;
    if (k % 10 == 3) loop.reference().position[k % 2] = not_a_number;
    if (k % 10 == 7) loop.reference().velocity[k % 2] = infinity;
    const Status status = loop.update();
    REQUIRE((status == Status::ok) == (k % 10 != 3 && k % 10 != 7));
    loop.reference() = {};
    REQUIRE(is_finite(loop.state()));
  }
  CHECK((loop.state().position - target).cwiseAbs().maxCoeff() < 0.01);
}
