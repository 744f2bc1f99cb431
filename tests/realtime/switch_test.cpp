// SPDX-License-Identifier: Apache-2.0
// Controllers that are switched, in groups, limited, primed and failing, under the allocation
// guard.
#include <articula/articula.hpp>
#include <articula/hardware/mock/mock_hardware.hpp>
#include <articula/robots/q2d.hpp>

#include "allocation_guard.hpp"
#include "by_hand.hpp"
#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "robots/test_robots.hpp"
#include "test_controllers.hpp"

using namespace articula;
using articula::testing::heap_calls_in;
using Arm = support::TiltedQ2d;

namespace {

template <class R>
using Controllers = Switch<R, support::ConstantEffort<R>, PidPlusGravity<R>, ComputedTorque<R>>;
template <class R>
using Careful = Limited<R, Controllers<R>>;
template <class R>
using Everything = Groups<R, Careful<R>, Controllers<R>>;

const SwitchOptions<2> options{.names = {"constant", "pid", "computed"},
                               .fallbacks = {{"constant", {"pid", "computed"}}}};
const ControllerNames names[] = {
    {"s/constant", "e/pid"}, {"s/pid"},    {"e/computed"},
    {"e/constant"},          {"nonsense"}, {"s/computed", "e/computed"}};

/// Everything composed: two groups with rates of their own, a limited switch in one of them.
Everything<Arm> everything() {
  CommandLimits<2> limits = command_limits(Arm());
  limits.acceleration = {20, 40};
  const Controllers<Arm> controllers(options, {}, PidPlusGravity<Arm>(Q2d::pid_gains),
                                     ComputedTorque<Arm>(Q2d::pid_gains));
  return Everything<Arm>({{{"s", {"shoulder_active_joint"}}, {"e", {"elbow_active_joint"}, 3}}},
                         Careful<Arm>(limits, controllers), controllers);
}

SwitchRequest random_request(support::Random& random) {
  SwitchRequest request;
  (random.one_in(4) ? request.stop : request.start) = names[random.integer(0, 5)];
  request.strictness = random.one_in(2) ? Strictness::strict : Strictness::best_effort;
  request.replace = !random.one_in(4);
  return request;
}

}  // namespace

TEST_CASE("switching does not touch the heap, with everything composed and hostile values") {
  constexpr unsigned seed = 91;
  CAPTURE(seed);
  support::Random random(seed);
  support::ByHand<Everything<Arm>> c = everything();
  SwitchExchange exchange(c);
  JointState<2> state;
  JointReference<2> reference;
  std::size_t calls = 0;
  int done = 0, events = 0, failures = 0;
  for (int k = 0; k < 3000; ++k) {
    const double size = random.one_in(20) ? 1e300 : random.one_in(3) ? 10 : 0.5;
    state.position = random.vector<2>(size);
    state.velocity = random.vector<2>(size);
    reference.position = random.vector<2>(size);
    reference.velocity = random.vector<2>(size);
    reference.effort = random.vector<2>(size);
    if (random.one_in(30)) reference.position[0] = support::not_a_number;
    if (random.one_in(30)) state.velocity[0] = support::not_a_number;
    const bool fails = random.one_in(5);
    const SwitchRequest request = random_request(random);
    calls += heap_calls_in([&] {
      const double bad = fails ? support::not_a_number : 1;
      c.member<0>().controller().member<0>().effort = bad;
      c.member<1>().member<0>().effort = bad;
      if (k % 100 == 0) c.start(state);
      if (k % 200 == 0) c.start(state, {}, {state.effort, Held::load});
      exchange.request(request);
      exchange.apply(c);
      c.cut_off(c.update(state, reference, k % 50 == 0 ? 2e-3 : 1e-3).effort);
      c.apply(reference.effort);
      failures += c.verdict != Verdict::fine ? 1 : 0;
      while (const auto outcome = exchange.outcome()) {
        done += outcome->outcome.answer == SwitchAnswer::done ? 1 : 0;
      }
      while (exchange.event()) ++events;
      static_cast<void>(exchange.list());
    });
  }
  CHECK(calls == 0);
  CHECK(done > 100);
  CHECK(events > 100);
  CHECK(failures > 10);
}

TEST_CASE("nor does it in a supervised loop") {
  constexpr unsigned seed = 92;
  CAPTURE(seed);
  support::Random random(seed);
  using Mock = MockHardware<Arm>;
  SupervisedLoop<Mock, Everything> loop(Mock(), everything(), {.bad_cycles = 2});
  SwitchExchange exchange(loop.controller());
  int faults = 0;
  for (int k = 0; k < 3000; ++k) {
    const SwitchRequest request = random_request(random);
    const bool fails = random.one_in(50);
    CHECK(heap_calls_in([&] {
            if (loop.mode() == LoopMode::inactive) loop.request_activation();
            if (loop.mode() == LoopMode::fault) {
              ++faults;
              loop.acknowledge_fault();
            }
            auto& elbow = loop.controller().member<1>();
            elbow.member<0>().effort = fails ? support::not_a_number : 1;
            if (k % 7 == 0) exchange.request(request);
            exchange.apply(loop.controller());
            static_cast<void>(loop.update());
          }) == 0);
  }
  CAPTURE(faults);
}

TEST_CASE("nor do velocities, positions and springs in the drives") {
  const auto heap_calls = [](auto controllers) {
    support::ByHand<decltype(controllers)> c = controllers;
    std::size_t calls = 0;
    for (std::size_t k = 0; k < 300; ++k) {
      JointReference<2> reference;
      reference.position.setConstant(static_cast<double>(k % 20));
      reference.velocity.setConstant(static_cast<double>(k % 30));
      calls += heap_calls_in([&] {
        if (k == 0) c.start({});
        if (k % 10 == 0) static_cast<void>(c.request({.stop = {c.active()}}));
        if (k % 10 == 5) static_cast<void>(c.request({.start = {c.name_of(k % 2)}}));
        static_cast<void>(c.update({}, reference, 1e-3));
      });
    }
    return calls;
  };
  const auto springs = DriveImpedance<Arm>({{{100, 1}, {100, 1}}});
  CHECK(heap_calls(Switch<Arm, ForwardVelocity<Arm>, ForwardVelocity<Arm>>()) == 0);
  CHECK(heap_calls(Switch<Arm, ForwardPosition<Arm>, ForwardPosition<Arm>>()) == 0);
  CHECK(heap_calls(Switch<Arm, DriveImpedance<Arm>, DriveImpedance<Arm>>({}, springs, springs)) ==
        0);
}
