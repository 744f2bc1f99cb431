// SPDX-License-Identifier: Apache-2.0
// Gains under which a joint shakes are known before it moves.
#include <articula/articula.hpp>
#include <articula/robots/panda.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/robots/ur10.hpp>
#include <articula/tuning/gain_notices.hpp>

#include "catch.hpp"
#include "robots/test_robots.hpp"
#include "test_controllers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

using namespace articula;
using Catch::Matchers::Contains;

namespace {

template <class R>
using Controllers = Switch<R, Pid<R>, PidPlusGravity<R>>;
template <class R>
using CarefulPid = Limited<R, Pid<R>>;

/// A composition of one's own.
template <class C>
struct Around {
  C controller;

  auto update(const ControlInput<2>& in) noexcept { return update_controller(controller, in); }
  static auto parts(auto& self) noexcept { return std::tie(self.controller); }
};
template <class R>
using Parts = Groups<R, Pid<R>, PidPlusGravity<R>>;

constexpr double period = 1e-3;

template <int N>
JointPidGains<N> same(const PidGains& gains) {
  JointPidGains<N> all;
  all.fill(gains);
  return all;
}

/// Gains of a UR10 whose other joints hold well.
JointPidGains<6> only_last_wrist(const PidGains& gains) {
  constexpr std::array<double, 6> inertia{8, 8, 2, 0.1, 0.1, 0};
  JointPidGains<6> all;
  for (std::size_t j = 0; j < 6; ++j) {
    all[j] = {.proportional = 400 * inertia[j], .derivative = 40 * inertia[j]};
  }
  all[5] = gains;
  return all;
}

/// How much a joint's effort changes in some cycles.
double swing(Loop<Simulator<Ur10>, PidPlusGravity>& loop, int joint, int cycles) {
  double low = 1e300, high = -1e300;
  for (int k = 0; k < cycles; ++k) {
    REQUIRE(loop.update() == Status::ok);
    low = std::min(low, loop.command().effort[joint]);
    high = std::max(high, loop.command().effort[joint]);
  }
  return high - low;
}

/// Whether the last wrist's effort goes on swinging after a step that is small enough for it to
/// stay linear at first.
bool keeps_shaking(const PidGains& gains) {
  Loop<Simulator<Ur10>, PidPlusGravity> loop{PidPlusGravity<Ur10>(only_last_wrist(gains))};
  loop.reference().position[5] += 1e-6;
  const double first = swing(loop, 5, 100);
  (void)swing(loop, 5, 1900);
  return swing(loop, 5, 500) > 0.1 * first;
}

const JointPlant last_wrist = joint_plant(Ur10(), JointVector<6>::Zero(), 5, OtherJoints::free);

/// A law of one joint in a loop with its plant. Returns how fast it is after so many cycles [1/dt],
/// from 1.
template <class Law>
double state_after(Law law, const JointPlant& plant, double dt, int cycles) {
  const double rate = plant.decay_rate(), e = std::exp(-rate * dt);
  const double f1 = rate > 0 ? -std::expm1(-rate * dt) / rate : dt;
  const double f2 = rate > 0 ? (dt - f1) / rate : dt * dt / 2;
  JointState<1> state;
  state.position[0] = 1;
  state.velocity[0] = 1 / dt;
  double size = 0;
  for (int k = 0; k < cycles; ++k) {
    const double u = law.output({state, {}, dt})[0] / plant.inertia, v = state.velocity[0];
    state.position[0] += f1 * v + f2 * u;
    state.velocity[0] = e * v + f1 * u;
    const double now = dt * std::abs(state.velocity[0]);
    if (k >= cycles - 50) size = std::max(size, now);
    if (!(now < 1e100)) return now;
  }
  return size;
}

}  // namespace

TEST_CASE("a UR10's last wrist shakes in simulation if and only if there is a notice") {
  struct Case {
    double p, i, d, filter;
    bool shakes;
  };
  // Undamped and unfiltered it comes to rest for p dt/2 < d < 2 I/dt = 1.01 N m s.
  const std::vector<Case> cases{
      {1000, 0, 10, 0, true},     {1000, 0.01, 10, 0, true},  {1000, 0, 1.1, 0, true},
      {1000, 0, 0.9, 0, false},   {1000, 0, 0.6, 0, false},   {1000, 0, 0.45, 0, true},
      {1000, 0, 0.1, 0, true},    {1000, 0, 0, 0, true},      {1000, 0, 10, 0.01, true},
      {1000, 0, 10, 0.1, true},   {1000, 0, 0.7, 0.01, true}, {50, 0, 0.5, 0, false},
      {50, 0, 10, 0.01, false},   {50, 0, 10, 0.05, true},    {200, 0, 0.5, 0, false},
      {200, 0, 0.5, 0.005, true}, {50, 0, 0.1, 0.001, false}, {1, 0, 1.2, 0, true},
      {1, 0, 0.9, 0, false},      {50, 0, 0.4, 0, false},     {50, 1e5, 0.4, 0, true},
      {50, 100, 0.4, 0, false}};
  for (const Case& c : cases) {
    PidGains gains{.proportional = c.p,
                   .integral = c.i,
                   .derivative = c.d,
                   .derivative_filter_time = c.filter};
    CAPTURE(c.p, c.i, c.d, c.filter);
    const auto notices = gain_notices(Ur10(), PidPlusGravity<Ur10>(only_last_wrist(gains)),
                                      JointVector<6>::Zero(), period);
    CAPTURE(notices);
    CAPTURE(spectral_radius(last_wrist, SampledFeedback::of(gains), period));
    CHECK(notices.size() == (c.shakes ? 1u : 0u));
    CHECK(keeps_shaking(gains) == c.shakes);
  }
}

TEST_CASE(
    "random gains make a UR10's last wrist shake if and only if the spectral radius is above 1") {
  const auto seed = GENERATE(1u, 20261122u);
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto power = [&](double low, double high) {
    return std::pow(10, std::uniform_real_distribution(std::log10(low), std::log10(high))(random));
  };
  int calm = 0, shaking = 0;
  for (int tries = 0; tries < 40; ++tries) {
    PidGains gains{.proportional = power(1, 2000), .derivative = power(0.01, 10)};
    if (tries % 2 == 1) gains.derivative_filter_time = power(1e-4, 0.1);
    if (tries % 3 == 2) gains.derivative_of = DerivativeOf::error;
    if (tries % 5 == 4) gains.integral = power(1, 1e4);
    const double radius = spectral_radius(last_wrist, SampledFeedback::of(gains), period);
    // Nearer to 1, what happens takes longer than the 2500 cycles of the simulation to be seen.
    if (std::abs(radius - 1) < 5e-3) continue;
    CAPTURE(gains.proportional, gains.integral, gains.derivative, gains.derivative_filter_time,
            tries, radius);
    CHECK(keeps_shaking(gains) == (radius > 1));
    ++(radius > 1 ? shaking : calm);
  }
  CHECK(calm >= 5);
  CHECK(shaking >= 5);
}

TEST_CASE("a law's state grows in a loop with a damped joint if the spectral radius is above 1") {
  const auto seed = GENERATE(2u, 20261123u);
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto power = [&](double low, double high) {
    return std::pow(10, std::uniform_real_distribution(std::log10(low), std::log10(high))(random));
  };
  const JointNames<1> name{"joint"};
  int calm = 0, shaking = 0;
  const auto check = [&](const auto& law, const JointPlant& plant, double dt) {
    const double radius = spectral_radius(plant, law.sampled_feedback(0), dt);
    constexpr int cycles = 4000;
    // Eigenvalues that meet let the state grow at first although it decays in the end; this far
    // from 1 the power 4000 outweighs that.
    if (std::abs(radius - 1) < 5e-3) return;
    CAPTURE(radius, plant.inertia, plant.time_constant, dt);
    const double size = state_after(law, plant, dt, cycles);
    CAPTURE(size);
    CHECK((size > 1) == (radius > 1));
    ++(radius > 1 ? shaking : calm);
  };
  for (int tries = 0; tries < 300; ++tries) {
    const double inertia = power(1e-3, 10), dt = power(1e-4, 1e-2);
    const double damping = tries % 4 == 0 ? 0 : power(1e-6, 10) * inertia / dt;
    const JointPlant plant = damped_plant(inertia, damping);
    const double unit = inertia / dt;
    PidGains gains{.proportional = power(0.01, 6) * unit / dt, .derivative = power(0.01, 3) * unit};
    if (tries % 2 == 1) gains.derivative_filter_time = power(0.1, 100) * dt;
    if (tries % 3 == 2) gains.derivative_of = DerivativeOf::error;
    if (tries % 5 == 4) gains.integral = power(0.001, 1) * gains.proportional / dt;
    CAPTURE(tries, gains.proportional, gains.integral, gains.derivative,
            gains.derivative_filter_time);
    check(PidLaw<1>(JointPidGains<1>{gains}, name), plant, dt);
    for (const ControlToolbox version :
         {ControlToolbox::current, ControlToolbox::jazzy, ControlToolbox::humble}) {
      check(ControlToolboxPidLaw<1>(version, JointPidGains<1>{gains}, name), plant, dt);
    }
    const JointImpedanceGains<1> impedance{ImpedanceGains{gains.proportional, gains.derivative}};
    check(ImpedanceLaw<1>({impedance, name}), plant, dt);
    PidGains of_velocity = gains;
    of_velocity.proportional *= dt;
    of_velocity.integral *= dt;
    of_velocity.derivative *= dt;
    check(PidLaw<1, PidOf::velocity>(JointPidGains<1>{of_velocity}, name), plant, dt);
  }
  CHECK(calm > 200);
  CHECK(shaking > 200);
}

TEST_CASE("the spectral radius of known loops") {
  const auto radius = [](double p, double d, double rate = 0) {
    const JointPlant plant{.inertia = 2, .time_constant = 1 / rate};
    return spectral_radius(plant, {.proportional = p, .derivative = d}, 0.5);
  };
  CHECK(radius(0, 0) == Approx(1).margin(1e-9));   // two eigenvalues of 1
  CHECK(radius(0, 12) == Approx(2).margin(1e-9));  // v <- (1 - d dt/I) v
  CHECK(radius(8, 4) == Approx(std::sqrt(0.5)));   // dead-beat is p 8, d 6; determinant here
  CHECK(radius(8, 6) == Approx(0).margin(1e-3));  // both eigenvalues 0, the fourth root of rounding
  CHECK(radius(8, 0) == Approx(std::sqrt(1.5)));  // sqrt(1 + p dt^2/(2 I)): never at rest
  CHECK(radius(0, 0, 1e-9) == Approx(1).margin(1e-9));
  CHECK(radius(1e300, 1e300) == std::numeric_limits<double>::infinity());
}

TEST_CASE("a notice says what is wrong with a joint's gains, and what helps does help") {
  const auto notice = [](const PidGains& gains) {
    const auto notices = gain_notices(Ur10(), PidPlusGravity<Ur10>(only_last_wrist(gains)),
                                      JointVector<6>::Zero(), period);
    REQUIRE(notices.size() == 1);
    return notices.front();
  };
  const std::string hard = notice({.proportional = 1000, .derivative = 10});
  CHECK_THAT(hard,
             Contains("joint 'wrist_3_joint' is unstable with the gains p 1000, d 10. With an "
                      "inertia of 0.000505849 kg m^2 and a period of 0.001 s, "));
  CHECK_THAT(hard, Contains("lower p and d, for example to 62.5 and 0.625, shorten the period, or "
                            "add the drive's reflected_inertia"));
  CHECK_FALSE(keeps_shaking({.proportional = 62.5, .derivative = 0.625}));

  const std::string soft = notice({.proportional = 1000, .derivative = 0.45});
  CHECK_THAT(soft, Contains("lower p, for example to 500, raise d, for example to 0.7587"));
  CHECK_FALSE(keeps_shaking({.proportional = 500, .derivative = 0.45}));
  CHECK_FALSE(keeps_shaking({.proportional = 1000, .derivative = 0.7587}));

  CHECK_THAT(notice({.proportional = 50, .integral = 1e5, .derivative = 0.4}), Contains("lower i"));
  CHECK_THAT(notice({.proportional = 50, .derivative = 0.4, .derivative_filter_time = 0.1}),
             Contains("shorten the derivative's filter"));
}

TEST_CASE(
    "a UR10 with a laboratory's gains shakes at its last wrist, and the loop says so before") {
  PidGains gains{.proportional = 1000, .integral = 0.01, .derivative = 10};
  Loop<Simulator<Ur10>, PidPlusGravity> loop{PidPlusGravity<Ur10>(same<6>(gains))};
  const std::vector<std::string> notices = loop.notices();
  REQUIRE_FALSE(notices.empty());
  CAPTURE(notices);
  CHECK_THAT(notices.back(),
             Contains("joint 'wrist_3_joint' is unstable with the gains p 1000, d 10, i 0.01."));
  loop.reference().position[5] += 1e-4;
  (void)swing(loop, 5, 1000);
  CHECK(swing(loop, 5, 1000) > 50);  // from limit to limit
}

TEST_CASE("notices come from all parts of a controller, and not from drives' own loops") {
  const auto hard = same<2>({.derivative = 1e5});
  const Pid<Q2d> pid(hard);
  const PidPlusGravity<Q2d> with_gravity(hard);
  const JointVector<2> q(0.1, 0.2);
  const auto count = [&](const auto& controller) {
    return gain_notices(Q2d(), controller, q, period).size();
  };
  CHECK(count(pid) == 2);
  CHECK(count(Controllers<Q2d>({}, pid, with_gravity)) == 4);
  CommandLimits<2> limits = command_limits(Q2d());
  limits.acceleration.setConstant(100);
  CHECK(count(CarefulPid<Q2d>(limits, pid)) == 2);
  CHECK(count(PositionByVelocity<Q2d>(hard)) == 0);
  CHECK(count(Around<PositionByVelocity<Q2d>>{PositionByVelocity<Q2d>(hard)}) == 0);
  CHECK(count(Around<Pid<Q2d>>{pid}) == 2);
  CHECK(count(VelocityByEffort<Q2d>(same<2>({.proportional = 1e5}))) == 2);
  JointImpedanceGains<2> impedance;
  impedance.fill({10, 1e5});
  CHECK(count(JointImpedance<Q2d>(impedance)) == 2);
  CHECK(count(ControlToolboxPidLaw<2>(ControlToolbox::humble, hard, joint_names(Q2d()))) == 2);

  // The gains of computed torque do not depend on inertias: d 2/dt is the limit.
  CHECK(count(ComputedTorque<Q2d>(same<2>({.proportional = 1, .derivative = 1990}))) == 0);
  CHECK(count(ComputedTorque<Q2d>(same<2>({.proportional = 1, .derivative = 2010}))) == 2);
}

TEST_CASE("a part is looked at for its own joints, and at its own rate") {
  const auto names = joint_names(Q2d());
  const JointVector<2> q(0.1, 0.2);
  const PidLaw<2> law(Q2d(), same<2>({.derivative = 1e5}));
  const std::array<std::string_view, 1> second{names[1]};
  const auto of_part = gain_notices(Q2d(), OnJoints<2, PidLaw<2>>(Q2d(), law, second), q, period);
  REQUIRE(of_part.size() == 1);
  CHECK_THAT(of_part.front(), Contains(std::string(names[1])));

  // Fine in every cycle, and too much in every tenth.
  JointPidGains<2> gains;
  for (int j = 0; j < 2; ++j) {
    const JointPlant plant = joint_plant(Q2d(), q, j, OtherJoints::free);
    gains[static_cast<std::size_t>(j)].derivative = 0.5 * plant.inertia / period;
  }
  const auto groups = [&](int divisor) {
    const Parts<Q2d> parts({{{"one", {Name(names[0])}}, {"other", {Name(names[1])}, divisor}}},
                           Pid<Q2d>(gains), PidPlusGravity<Q2d>(gains));
    return gain_notices(Q2d(), parts, q, period);
  };
  CHECK(groups(1).empty());
  REQUIRE(groups(10).size() == 1);
  CHECK_THAT(groups(10).front(), Contains(std::string(names[1])) && Contains("period of 0.01 s"));
}

TEST_CASE("joints without gains beside joints with gains are named") {
  const auto notices = [](const JointPidGains<6>& gains) {
    return gain_notices(Ur10(), PidPlusGravity<Ur10>(gains), JointVector<6>::Zero(), period);
  };
  const PidGains some{.proportional = 1, .derivative = 0.1};
  REQUIRE(notices({some, some, some, some}).size() == 1);
  CHECK(notices({some, some, some, some}).front() ==
        "the gains of joint 'wrist_2_joint' and 'wrist_3_joint' are 0. Remedy: give gains for each "
        "joint.");
  CHECK(notices({}).empty());
  CHECK(notices({some, some, some, some, some, PidGains{.derivative = 0.1}}).empty());
  // Each group has a controller for the whole robot, of which its own joints count.
  const auto names = joint_names(Q2d());
  const JointPidGains<2> first{some, {}}, second{PidGains{}, some};
  const Groups<Q2d, Pid<Q2d>, Pid<Q2d>> groups(
      {{{"one", {Name(names[0])}}, {"other", {Name(names[1])}}}}, Pid<Q2d>(first),
      Pid<Q2d>(second));
  CHECK(gain_notices(Q2d(), groups, JointVector<2>::Zero(), period).empty());
}

TEST_CASE("the ready robots' own gains need no notice") {
  CHECK(Loop<Q2dSim, PidPlusGravity>().notices().empty());
  CHECK(Loop<Q2dSim, Bypass>().notices().empty());
  CHECK(gain_notices(Q2d(), ComputedTorque<Q2d>(), JointVector<2>(0.1, 0.2), period).empty());
}
