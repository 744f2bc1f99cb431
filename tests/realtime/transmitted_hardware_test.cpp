// SPDX-License-Identifier: Apache-2.0
// No cycle touches the heap, with all that can be composed around a simulated robot: rotors, mimic
// joints, friction, stops, servos, noise, transmissions, limits and supervision.
#include <articula/articula.hpp>
#include <articula/hardware/transmission/differential_transmission.hpp>
#include <articula/hardware/transmission/four_bar_transmission.hpp>
#include <articula/hardware/transmission/reversed_transmission.hpp>
#include <articula/hardware/transmission/simple_transmission.hpp>
#include <articula/hardware/transmission/transmitted_hardware.hpp>

#include "allocation_guard.hpp"
#include "catch.hpp"
#include "numbers.hpp"
#include "robots/blueprint.hpp"

using namespace articula;
using articula::testing::heap_calls_in;

namespace {

using Arm = Model<3, 4>;
using Sim = Simulator<Arm>;
using Motors =
    TransmittedHardware<Sim, Arm, Reversed<DifferentialTransmission>, Reversed<SimpleTransmission>>;
using Geared = TransmittedHardware<Motors, Arm, SimpleTransmission, DifferentialTransmission>;

template <Robot R>
using Careful = Limited<R, ForwardPosition<R>>;

constexpr Link ball(const char* name) {
  return {.name = name,
          .mass = 1,
          .center_of_mass = {0.1, 0, 0},
          .inertia = {.xx = 0.01, .yy = 0.01, .zz = 0.01}};
}
constexpr Joint turning(const char* name, const char* parent, const char* child) {
  return {.name = name,
          .type = JointType::revolute,
          .parent = parent,
          .child = child,
          .axis = {0, 1, 0},
          .limits = {.lower = -0.5, .upper = 0.5, .velocity = 3, .effort = 8},
          .damping = 0.01,
          .friction = 0.05,
          .reflected_inertia = 0.02};
}

/// Three joints in a row and a fourth that mimics the last.
Arm arm() {
  support::Blueprint blueprint{.links = {ball("base"), ball("1"), ball("2"), ball("3"), ball("4")},
                               .joints = {turning("a", "base", "1"), turning("b", "1", "2"),
                                          turning("c", "2", "3"), turning("d", "2", "4")}};
  blueprint.joints[3].mimic = {.joint = "c", .multiplier = -0.5, .offset = 0.1};
  return blueprint.model<3, 4>();
}

SimulatorOptions<3> noisy(DriveModel drives) {
  SimulatorOptions<3> options{.drives = drives};
  options.encoder_resolution.setConstant(1e-5);
  options.velocity_noise.setConstant(1e-3);
  return options;
}

Geared geared(DriveModel drives) {
  const DifferentialTransmission wrist{.actuator_reduction = {50, -50}, .joint_offset = {0.1, 0.2}};
  const SimpleTransmission gear{.reduction = 100};
  return Geared(arm(),
                Motors(arm(), Sim(arm(), noisy(drives)),
                       {.joints = {"b", "c"}, .actuators = {"b", "c"}, .transmission = {wrist}},
                       {.joints = {"a"}, .actuators = {"a"}, .transmission = {gear}}),
                {.joints = {"a"}, .actuators = {"a"}, .transmission = gear},
                {.joints = {"b", "c"}, .actuators = {"b", "c"}, .transmission = wrist});
}

/// Half a second of steps, stops, saturation and numbers that are none.
template <class LoopType>
std::size_t heap_calls_of(LoopType loop) {
  double reached = 0;
  const std::size_t calls = heap_calls_in([&] {
    for (int k = 0; k < 500; ++k) {
      loop.reference().position.setConstant(k < 250 ? 3 : -0.2);
      loop.reference().velocity.setConstant(k < 250 ? 50 : -0.5);
      loop.reference().effort.setConstant(k % 100 < 50 ? 6 : -20);
      if (k % 50 == 7) loop.reference().position[0] = support::not_a_number;
      static_cast<void>(loop.update());
      const JointVector<4> all =
          moving_joint_positions(loop.hardware().robot(), loop.state().position);
      reached = std::fmax(reached, all.maxCoeff());
    }
  });
  CHECK(reached > 0.1);
  return calls;
}

template <class Command>
std::size_t heap_calls_of_writing(const Command& command) {
  Geared hardware = geared(DriveModel::servo);
  JointState<3> state;
  return heap_calls_in([&] {
    for (int k = 0; k < 50; ++k) {
      static_cast<void>(hardware.write(command));
      static_cast<void>(hardware.read(state));
    }
  });
}

}  // namespace

TEST_CASE("a loop over transmissions does not touch the heap, whatever its drives take") {
  const Arm robot = arm();
  for (const DriveModel drives : {DriveModel::servo, DriveModel::ideal}) {
    CHECK(heap_calls_of(Loop<Geared, Bypass>(geared(drives), Bypass<Arm>(robot))) == 0);
    CHECK(heap_calls_of(
              Loop<Geared, ForwardPosition>(geared(drives), ForwardPosition<Arm>(robot))) == 0);
    CHECK(heap_calls_of(
              Loop<Geared, ForwardVelocity>(geared(drives), ForwardVelocity<Arm>(robot))) == 0);
  }
}

TEST_CASE("a supervised loop with limits over transmissions does not touch the heap") {
  const Arm robot = arm();
  CommandLimits<3> limits = command_limits(robot);
  limits.acceleration.setConstant(20);
  SupervisedLoop<Geared, Careful> loop(geared(DriveModel::servo),
                                       Careful<Arm>(robot, limits, ForwardPosition<Arm>(robot)));
  int active = 0;
  const std::size_t calls = heap_calls_in([&] {
    for (int k = 0; k < 500; ++k) {
      if (loop.mode() == LoopMode::inactive) loop.request_activation();
      if (loop.mode() == LoopMode::fault) loop.acknowledge_fault();
      if (loop.mode() == LoopMode::active) ++active;
      loop.post({.position = JointVector<3>::Constant(k % 100 == 7 ? support::not_a_number : 0.2)});
      static_cast<void>(loop.update());
    }
  });
  CHECK(calls == 0);
  CHECK(active > 50);
}

TEST_CASE("springs and dampers of simulated drives do not touch the heap") {
  Sim sim(arm(), noisy(DriveModel::servo));
  MultiModeCommand<3> spring;
  spring.stiffness.setConstant(10);
  spring.damping.setConstant(0.1);
  spring.position.setConstant(0.3);
  CHECK(heap_calls_in([&] {
          for (int k = 0; k < 50; ++k) static_cast<void>(sim.write(spring));
        }) == 0);
  CHECK(sim.true_state().position.norm() > 0.01);
}

TEST_CASE("wild commands over transmissions do not touch the heap") {
  const auto all = [](double x) { return JointVector<3>::Constant(x); };
  for (const double wild : {support::not_a_number, support::infinity, support::largest}) {
    CHECK(heap_calls_of_writing(EffortCommand<3>{all(wild)}) == 0);
    CHECK(heap_calls_of_writing(PositionCommand<3>{all(wild)}) == 0);
    CHECK(heap_calls_of_writing(VelocityCommand<3>{all(-wild)}) == 0);
  }
}

TEST_CASE("the maps of transmissions do not touch the heap") {
  const FourBarTransmission linkage{.actuator_reduction = {80, 60}};
  const JointVector<2> x(1, 2);
  double volatile seen = 0;
  CHECK(heap_calls_in([&] {
          seen = (linkage.joint_position(x) + linkage.joint_velocity(x) + linkage.joint_effort(x) +
                  linkage.actuator_position(x) + linkage.actuator_velocity(x) +
                  linkage.actuator_effort(x) + reflected_inertia(linkage, x).diagonal())
                     .sum();
          seen = actuator_limits(linkage, {JointLimits{}, JointLimits{}})[1].effort;
        }) == 0);
  CHECK(seen == support::infinity);
}
