// SPDX-License-Identifier: Apache-2.0
// No cycle of a loop touches the heap, whichever controller runs and whatever goes wrong.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

#include "allocation_guard.hpp"
#include "catch.hpp"
#include "hardware/fake_hardware.hpp"
#include "numbers.hpp"
#include "robots/test_robots.hpp"
#include "test_controllers.hpp"

using namespace articula;
using articula::testing::heap_calls_in;
using support::not_a_number;

namespace {

/// Some tenths of a second of all that happens: steps, saturation, stops, wrong numbers.
template <class LoopType>
void stir(LoopType& loop) {
  for (int k = 0; k < 800; ++k) {
    loop.reference().position.setConstant(k < 400 ? 3 : -3);
    loop.reference().effort.setConstant(k < 400 ? 20 : -20);
    if (k % 50 == 7) loop.reference().position[0] = not_a_number;
    if (k % 50 == 9) loop.reference().effort[0] = support::largest;
    static_cast<void>(loop.update());
  }
}

/// The Q2D with little damping, dry friction and narrow limits: every stop and every rest is met.
Model<2> rattling_arm() {
  Model<2> arm = support::model<support::TiltedQ2d>();
  for (auto& joint : arm.joints) {
    joint.damping = 0.1;
    joint.friction = 0.5;
    joint.limits.lower = -0.2;
    joint.limits.upper = 0.3;
  }
  return arm;
}

SimulatorOptions<2> noisy() {
  SimulatorOptions<2> options{.substeps = 2};
  options.encoder_resolution = {1e-4, 0};
  options.position_noise.setConstant(1e-4);
  options.velocity_noise.setConstant(1e-2);
  options.effort_noise.setConstant(1e-1);
  return options;
}

template <template <class> class Controller>
std::size_t heap_calls_on_q2d() {
  Loop<Q2dSim, Controller> loop;
  return heap_calls_in([&] { stir(loop); });
}

template <template <class> class Controller>
std::size_t heap_calls_with_noise() {
  Loop<Q2dSim, Controller> loop{Q2dSim(noisy())};
  return heap_calls_in([&] { stir(loop); });
}

/// A run-time model, whose link frames lie on the heap: none may be copied.
std::size_t heap_calls_on_model(auto controller_of) {
  const Model<2> arm = rattling_arm();
  auto loop = controller_of(Simulator<Model<2>>(arm, noisy()), arm);
  bool stopped = false;
  const std::size_t calls = heap_calls_in([&] {
    stir(loop);
    stopped = loop.hardware().true_state().position.maxCoeff() <= -0.2;
  });
  CHECK(stopped);
  return calls;
}

}  // namespace

TEST_CASE("no controller's loop touches the heap") {
  CHECK(heap_calls_on_q2d<Bypass>() == 0);
  CHECK(heap_calls_on_q2d<Pid>() == 0);
  CHECK(heap_calls_on_q2d<PidPlusGravity>() == 0);
  CHECK(heap_calls_on_q2d<ComputedTorque>() == 0);
}

TEST_CASE("nor with encoders and noise") {
  CHECK(heap_calls_with_noise<Bypass>() == 0);
  CHECK(heap_calls_with_noise<Pid>() == 0);
  CHECK(heap_calls_with_noise<PidPlusGravity>() == 0);
  CHECK(heap_calls_with_noise<ComputedTorque>() == 0);
}

TEST_CASE("nor on a run-time model with stops and dry friction") {
  const auto gains = Q2d::pid_gains;
  using Sim = Simulator<Model<2>>;
  CHECK(heap_calls_on_model([](Sim sim, const Model<2>& arm) {
          return Loop<Sim, Bypass>(std::move(sim), Bypass<Model<2>>(arm));
        }) == 0);
  CHECK(heap_calls_on_model([&](Sim sim, const Model<2>& arm) {
          return Loop<Sim, Pid>(std::move(sim), Pid<Model<2>>(arm, gains));
        }) == 0);
  CHECK(heap_calls_on_model([&](Sim sim, const Model<2>& arm) {
          return Loop<Sim, PidPlusGravity>(std::move(sim), PidPlusGravity<Model<2>>(arm, gains));
        }) == 0);
  CHECK(heap_calls_on_model([&](Sim sim, const Model<2>& arm) {
          return Loop<Sim, ComputedTorque>(std::move(sim), ComputedTorque<Model<2>>(arm, gains));
        }) == 0);
}

TEST_CASE("nor when state, command or hardware fail") {
  Loop<support::FakeHardware<support::TiltedQ2d>, support::ConstantEffort> loop;
  CHECK(heap_calls_in([&] {
          for (int k = 0; k < 100; ++k) {
            loop.hardware().measured.position[0] = k % 5 == 0 ? not_a_number : 0.5;
            loop.controller().effort = k % 7 == 0 ? not_a_number : 1e9;
            loop.hardware().reading = k % 3 == 0 ? Status::hardware_fault : Status::ok;
            loop.hardware().writing = k % 4 == 0 ? Status::hardware_fault : Status::ok;
            static_cast<void>(loop.update());
          }
        }) == 0);
}
