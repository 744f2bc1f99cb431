// SPDX-License-Identifier: Apache-2.0
// A reference that is not finite brakes through the limits, not around them.
#include <articula/articula.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>
#include <articula/robots/q2d.hpp>

#include "by_hand.hpp"
#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "robots/test_robots.hpp"
#include "test_controllers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace articula;
using support::infinity;
using support::not_a_number;

namespace {

using Vector = JointVector<2>;
constexpr double dt = 1e-3;

/// An arm with weight, which hardly brakes by itself.
struct LightArm {
  static constexpr auto description = [] {
    auto light = support::TiltedQ2d::description;
    for (auto& joint : light.joints) joint.damping = std::min(joint.damping, 0.1);
    return light;
  }();
  static constexpr JointPidGains<2> pid_gains{
      {{.proportional = 2000, .integral = 500, .derivative = 60},
       {.proportional = 500, .integral = 100, .derivative = 8}}};
};

template <class R>
using PidOrBypass = Switch<R, PidPlusGravity<R>, Bypass<R>>;

template <class R>
using CarefulPid = Limited<R, PidPlusGravity<R>>;
template <class R>
using CarefulSwitch = Limited<R, PidOrBypass<R>>;
template <class R>
using SwitchOfCareful = Switch<R, CarefulPid<R>, Bypass<R>>;
template <class R>
using Parts = Groups<R, PidOrBypass<R>, PidPlusGravity<R>>;
template <class R>
using CarefulGroups = Limited<R, Parts<R>>;
template <class R>
using CarefulSprings = Limited<R, DriveImpedance<R>>;
template <class R>
using CarefulPositions = Limited<R, support::PositionForward<R>>;
template <class R>
using CarefulVelocities = Limited<R, support::VelocityApproach<R>>;
template <class R>
using GroupsOfCareful = Groups<R, CarefulPositions<R>, Switch<R, CarefulPositions<R>>>;

const std::array<JointGroup, 2> both{
    {{"s", {"shoulder_active_joint"}}, {"e", {"elbow_active_joint"}}}};

CommandLimits<2> limits() {
  CommandLimits<2> limits = command_limits(LightArm());
  limits.lower.setConstant(-1);
  limits.upper.setConstant(1);
  limits.velocity.setConstant(2);
  // The drives can give that in every posture: inertias are some 0.2 and 0.02 kg m^2.
  limits.acceleration = {20, 40};
  return limits;
}

template <template <class> class C>
Loop<Simulator<LightArm>, C> loop_of(C<LightArm> controller) {
  return {Simulator<LightArm>(SimulatorOptions<2>{.drives = DriveModel::ideal}),
          std::move(controller)};
}

double& any_number(JointReference<2>& reference, support::Random& random) {
  Vector* const members[] = {&reference.position, &reference.velocity, &reference.acceleration,
                             &reference.effort};
  return (*members[random.integer(0, 3)])[random.integer(0, 1)];
}

/// How far joints get beyond their limits, as shares of the way of a cycle at V, and of V and A.
struct Worst {
  double position = -infinity, velocity = 0, acceleration = 0;
};

/// Follows wild positions, of which now and then a number is none, for one to a hundred cycles.
template <template <class> class C>
Worst wild_run(C<LightArm> controller, unsigned seed) {
  support::Random random(seed);
  auto loop = loop_of<C>(std::move(controller));
  const CommandLimits<2> kept = limits();
  Worst worst;
  JointReference<2> wish;
  Vector last = Vector::Zero();
  int bad = 0;
  for (int k = 0; k < 20000; ++k) {
    if (random.one_in(100)) wish.position = random.vector<2>(3);
    if (bad == 0) loop.reference() = wish;
    if (bad == 0 && random.one_in(50)) {
      bad = random.one_in(2) ? 1 : random.integer(1, 100);
      const double wrong[] = {not_a_number, infinity, -infinity};
      any_number(loop.reference(), random) = wrong[random.integer(0, 2)];
    }
    const Status expected = bad > 0 ? Status::non_finite_reference : Status::ok;
    if (loop.update() != expected || !is_finite(loop.command())) return {infinity};
    bad = std::max(0, bad - 1);
    for (int j = 0; j < 2; ++j) {
      const double q = loop.state().position[j], v = loop.state().velocity[j];
      const double beyond = std::max(kept.lower[j] - q, q - kept.upper[j]);
      worst.position = std::max(worst.position, beyond / (kept.velocity[j] * dt));
      worst.velocity = std::max(worst.velocity, std::abs(v) / kept.velocity[j] - 1);
      const double a = std::abs(v - last[j]) / dt;
      worst.acceleration = std::max(worst.acceleration, a / kept.acceleration[j] - 1);
    }
    last = loop.state().velocity;
  }
  return worst;
}

template <template <class> class C>
void check_wild_runs(const C<LightArm>& controller, const Worst& bounds) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Worst worst = wild_run<C>(controller, seed);
    CAPTURE(seed, worst.position, worst.velocity, worst.acceleration);
    CHECK(worst.position > -100);  // it was near a limit
    CHECK(worst.position < bounds.position);
    CHECK(worst.velocity < bounds.velocity);
    CHECK(worst.acceleration < bounds.acceleration);
  }
}

// What is foreseen for a cycle is the acceleration at its beginning, as in limited_effort_test.
constexpr Worst by_model{.position = 0.5, .velocity = 1e-2, .acceleration = 0.05};
// Ideal drives do what they are sent; the rest is rounding, divided by the period twice.
constexpr Worst exactly{.position = 1e-9, .velocity = 1e-9, .acceleration = 1e-8};

}  // namespace

TEST_CASE("whichever references are no numbers, efforts keep the joints within their limits") {
  const CarefulPid<LightArm> careful(limits());
  check_wild_runs<CarefulPid>(careful, by_model);
  check_wild_runs<CarefulSwitch>(CarefulSwitch<LightArm>(limits()), by_model);
  const SwitchOfCareful<LightArm> switched({.slew = Vector(1e4, 1e4)}, careful, {});
  check_wild_runs<SwitchOfCareful>(switched, by_model);
  const Parts<LightArm> parts(both, PidOrBypass<LightArm>(), {});
  check_wild_runs<CarefulGroups>(CarefulGroups<LightArm>(limits(), parts), by_model);
}

TEST_CASE("whichever references are no numbers, springs keep the joints within their limits") {
  const DriveImpedance<LightArm> springs({{{400, 20}, {100, 4}}});
  // The drives' own springs and dampers act within the cycle.
  const Worst bounds{.position = 0.5, .velocity = 1e-2, .acceleration = 0.1};
  check_wild_runs<CarefulSprings>(CarefulSprings<LightArm>(limits(), springs), bounds);
}

TEST_CASE("whichever references are no numbers, positions and velocities keep all limits") {
  check_wild_runs<CarefulPositions>(CarefulPositions<LightArm>(limits()), exactly);
  const CarefulPositions<LightArm> careful(limits());
  const Switch<LightArm, CarefulPositions<LightArm>> switched({}, careful);
  check_wild_runs<GroupsOfCareful>(GroupsOfCareful<LightArm>(both, careful, switched), exactly);
  check_wild_runs<CarefulVelocities>(CarefulVelocities<LightArm>(limits()), exactly);
}

TEST_CASE("one number that is none brakes all joints within their limits, and they are held") {
  auto loop = loop_of<CarefulPid>(CarefulPid<LightArm>(limits()));
  loop.reference().position = {1, 1};
  while (loop.state().velocity.minCoeff() < 1) REQUIRE(loop.update() == Status::ok);
  loop.reference().position[1] = not_a_number;
  REQUIRE(loop.update() == Status::non_finite_reference);  // what it measures was asked for before
  const Vector speed = loop.state().velocity;
  const double longest = (speed.array() / limits().acceleration.array()).maxCoeff() / 0.8;
  Vector before = speed;
  for (int k = 0; k < 2 * longest / dt; ++k) {
    REQUIRE(loop.update() == Status::non_finite_reference);
    CHECK(loop.controller().report()[0].non_finite);
    const Vector v = loop.state().velocity;
    CHECK((v - before).maxCoeff() < 1e-6);
    CHECK(((before - v).array() / dt <= 1.05 * limits().acceleration.array()).all());
    before = v;
  }
  CHECK(loop.state().velocity.norm() < 1e-6);
  const Vector held = loop.state().position;
  for (int k = 0; k < 1000; ++k) REQUIRE(loop.update() == Status::non_finite_reference);
  CHECK((loop.state().position - held).norm() < 1e-6);

  // The integral has not wound up: what follows is what a new start from here gives.
  loop.reference().position = held;
  for (int k = 0; k < 500; ++k) {
    REQUIRE(loop.update() == Status::ok);
    REQUIRE((loop.state().position - held).norm() < 1e-4);
  }
}

TEST_CASE("a group without limits is held where its reference is no number, the others go on") {
  using Half = Groups<LightArm, CarefulPid<LightArm>, PidPlusGravity<LightArm>>;
  support::ByHand<Half> groups(both, CarefulPid<LightArm>(limits()), {});
  support::ByHand<Half> undisturbed = groups;
  JointState<2> state;
  state.position = {0.5, -0.4};
  JointReference<2> reference;
  reference.position = {0.6, -0.5};
  groups.start(state);
  undisturbed.start(state);
  const Vector good = undisturbed.update(state, reference, dt).effort;
  static_cast<void>(groups.update(state, reference, dt));
  reference.position[1] = not_a_number;
  for (int k = 0; k < 10; ++k) {
    const Vector given = groups.update(state, reference, dt).effort;
    reference.position[1] = -0.5;
    CHECK(given[0] == undisturbed.update(state, reference, dt).effort[0]);
    reference.position[1] = not_a_number;
    // At rest Standby carries the weight.
    CHECK(std::abs(given[1] - gravity(LightArm(), state.position)[1]) < 1e-12);
    CHECK(groups.verdict == Verdict::fine);
  }
  reference.position[1] = -0.5;
  CHECK(groups.update(state, reference, dt).effort[1] == Approx(good[1]));
}

TEST_CASE("controllers without limits get the safe command, as ever, and are not asked") {
  Loop<Simulator<LightArm>, PidOrBypass> loop;
  loop.reference().position = {0.3, 0.3};
  for (int k = 0; k < 50; ++k) REQUIRE(loop.update() == Status::ok);
  loop.reference().position[1] = not_a_number;
  for (int k = 0; k < 5; ++k) {
    CHECK(loop.update() == Status::non_finite_reference);
    CHECK(loop.command().effort == gravity(LightArm(), loop.state().position));
  }
  static_assert(!Brakes<PidOrBypass<LightArm>, 2>);
  static_assert(!Brakes<PidPlusGravity<LightArm>, 2>);
  static_assert(Brakes<GroupsOfCareful<LightArm>, 2>);
}

TEST_CASE("a supervised loop that damps keeps the limits, too, where a reference is not finite") {
  for (const int bad_cycles : {1, 3, 5, 10}) {
    for (double at = 0.5; at < 0.99; at += 0.04) {
      CAPTURE(bad_cycles, at);
      SupervisedLoop<Simulator<LightArm>, CarefulPid> loop{Simulator<LightArm>(),
                                                           CarefulPid<LightArm>(limits())};
      loop.request_activation();
      for (int k = 0; k < 3; ++k) static_cast<void>(loop.update());
      JointReference<2> reference;
      reference.position = {3, 3};
      double worst = -infinity;
      const auto go = [&](const JointReference<2>& posted) {
        loop.post(posted);
        static_cast<void>(loop.update());
        worst = std::max(worst, loop.state().position.maxCoeff() - 1);
      };
      while (loop.state().position[0] < at) go(reference);
      JointReference<2> bad = reference;
      bad.velocity[1] = not_a_number;
      for (int k = 0; k < bad_cycles; ++k) go(bad);
      for (int k = 0; k < 1000; ++k) go(reference);
      CHECK((loop.mode() == LoopMode::fault) == (bad_cycles > 3));
      CHECK(worst < 1e-5);  // as without supervision: what the foreseen motion leaves out
    }
  }
}
