// SPDX-License-Identifier: Apache-2.0
// What a PID's gains can ask for beyond p, i and d.
#include <articula/control/laws/joint_pid.hpp>
#include <articula/control/laws/pid_law.hpp>
#include <articula/control/pid.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using support::infinity;
using support::not_a_number;

namespace {

constexpr double rounding = 1e-14;  // a handful of roundings

PidInput error_of(double error) { return {.error = error, .measured = -error}; }

double next_angle(double angle, double change) {
  return std::remainder(angle + change, 2 * std::numbers::pi);
}

}  // namespace

TEST_CASE("the output is clamped, in each direction at its own clamp") {
  const PidGains g{.proportional = 2, .output_clamp_min = -1, .output_clamp_max = 3};
  JointPid pid;
  CHECK(pid.update(g, error_of(0.5), 1e-3) == 1);
  CHECK(pid.update(g, error_of(50), 1e-3) == 3);
  CHECK(pid.update(g, error_of(-50), 1e-3) == -1);
}

TEST_CASE("back-calculation leads the integral to where the output is at its clamp") {
  const PidGains g{.proportional = 1,
                   .integral = 10,
                   .output_clamp_min = -1,
                   .output_clamp_max = 1,
                   .anti_windup = AntiWindup::back_calculation,
                   .tracking_time = 0.1};
  JointPid pid;
  constexpr double dt = 1e-3, error = 2;
  double expected = 0;
  for (int k = 0; k < 3000; ++k) {
    expected += 10 * error * dt;
    expected -= dt / 0.1 * std::max(0.0, 1 * error + expected - 1);
    CHECK(pid.update(g, error_of(error), dt) == 1);
    REQUIRE(pid.integral() == Approx(expected).epsilon(1e-12));
  }
  // In the end i e = (u - u')/T_t: the integral rests i e T_t above where the output is cut off,
  // less what one cycle adds.
  CHECK(pid.integral() == Approx(1 - error + 10 * error * (0.1 - dt)).epsilon(1e-9));
}

TEST_CASE("back-calculation follows what the caller cuts off, and never beyond it in a cycle") {
  PidGains g{.integral = 1, .anti_windup = AntiWindup::back_calculation, .tracking_time = 1e-6};
  JointPid pid;
  CHECK(pid.update(g, error_of(5), 1) == 5);
  pid.limit_windup(g, 2);
  CHECK(pid.integral() == 3);  // the whole of it, though dt is far above T_t
}

TEST_CASE("without anti-windup the integral goes on to its clamp") {
  const PidGains g{.integral = 1,
                   .integral_clamp_max = 4,
                   .output_clamp_max = 1,
                   .anti_windup = AntiWindup::none};
  JointPid pid;
  for (int k = 0; k < 10; ++k) static_cast<void>(pid.update(g, error_of(1), 1));
  CHECK(pid.integral() == 4);
}

TEST_CASE("conditional integration knows the output's own clamp") {
  const PidGains g{.proportional = 1, .integral = 1, .output_clamp_max = 0.5};
  JointPid pid;
  CHECK(pid.update(g, error_of(1), 0.1) == 0.5);
  CHECK(pid.integral() == 0);
  CHECK(pid.update(g, error_of(-1), 0.1) == Approx(-1.1).epsilon(rounding));
}

TEST_CASE("within the dead-band the integral rests, and the proportional term does not") {
  const PidGains g{.proportional = 1, .integral = 1, .error_deadband = 0.5};
  JointPid pid;
  for (const double error : {0.5, -0.5, 0.0}) {
    CHECK(pid.update(g, error_of(error), 1) == error);
    CHECK(pid.integral() == 0);
  }
  CHECK(pid.update(g, error_of(0.625), 1) == 1.25);
  CHECK(pid.update(g, error_of(0.25), 1) == 0.875);
}

TEST_CASE(
    "the derivative of the error is its change over the period, without a kick at the start") {
  const PidGains g{.derivative = 3, .derivative_of = DerivativeOf::error};
  JointPid pid;
  CHECK(pid.update(g, error_of(7), 0.5) == 0);
  CHECK(pid.update(g, error_of(8), 0.5) == 6);
  CHECK(pid.update(g, error_of(8), 0.5) == 0);
}

TEST_CASE("in a period of 0 the integral stays, and the derivative that is made of differences") {
  const PidGains g{.integral = 7, .derivative = 1, .derivative_of = DerivativeOf::error};
  JointPid pid;
  for (int k = 0; k < 3; ++k) static_cast<void>(pid.update(g, error_of(0.01 * k), 0.01));
  const double integral = pid.integral();
  CHECK(pid.update(g, error_of(0.03), 0) == Approx(1 + integral).epsilon(rounding));
  CHECK(pid.integral() == integral);
  // What has changed since the last cycle that took time.
  CHECK(pid.update(g, error_of(0.03), 0.01) - pid.integral() == Approx(1).epsilon(1e-12));
  pid.start();
  CHECK(pid.update(g, error_of(5), 0) == 0);  // nothing is left of it
}

TEST_CASE("the filter of the derivative is a low-pass of first order in backward Euler") {
  const PidGains g{.derivative = 1, .derivative_filter_time = 0.3};
  constexpr double dt = 0.1;
  JointPid pid;
  CHECK(pid.update(g, {.rate_error = 1}, dt) == 1);  // begins where the signal is
  double expected = 1;
  for (int k = 0; k < 50; ++k) {
    expected = (0.3 * expected + dt * 5) / (0.3 + dt);  // T_f (D - D_last)/dt + D = s
    CHECK(pid.update(g, {.rate_error = 5}, dt) == Approx(expected).epsilon(rounding));
  }
  CHECK(expected == Approx(5).epsilon(1e-5));
}

TEST_CASE("a filtered derivative of the error approaches the rate of a ramp") {
  const PidGains g{
      .derivative = 1, .derivative_of = DerivativeOf::error, .derivative_filter_time = 0.02};
  JointPid pid;
  double output = 0;
  for (int k = 0; k < 1000; ++k) output = pid.update(g, error_of(0.25e-3 * k), 1e-3);
  CHECK(output == Approx(0.25).epsilon(1e-9));
}

TEST_CASE("weights take the reference out of proportional and derivative terms") {
  PidGains g{.proportional = 2, .derivative = 1, .position_weight = 0.25, .velocity_weight = 0};
  PidLaw<1> law({g}, {"joint"});
  JointState<1> state;
  JointReference<1> reference;
  state.position[0] = reference.position[0] = 100;  // counted from here
  CHECK(law.output({state, reference, 1e-3})[0] == 0);
  reference.position[0] = 101;
  reference.velocity[0] = 1e3;
  CHECK(law.output({state, reference, 1e-3})[0] == 2 * 0.25);
  state.position[0] = 100.5;
  state.velocity[0] = 3;
  CHECK(law.output({state, reference, 1e-3})[0] == Approx(2 * (0.25 - 0.5) - 3).epsilon(rounding));

  g = {.derivative = 1, .derivative_of = DerivativeOf::error, .velocity_weight = 0};
  PidLaw<1> measured({g}, {"joint"});
  static_cast<void>(measured.output({state, reference, 0.5}));
  reference.position[0] = 200;  // no kick, though no velocity is measured
  state.position[0] = 101.5;
  CHECK(measured.output({state, reference, 0.5})[0] == -2);
}

TEST_CASE("feed-forward gains act on the reference's velocity and acceleration") {
  PidLaw<1> law({PidGains{.velocity_feedforward = 2, .acceleration_feedforward = 0.5}}, {"joint"});
  JointReference<1> reference;
  reference.velocity[0] = 3;
  reference.acceleration[0] = -4;
  CHECK(law.output({{}, reference, 1e-3})[0] == 4);
}

TEST_CASE("a continuous joint takes the short way round, another one does not") {
  const Model<1> wheel = support::single_joint(JointType::continuous);
  const Model<1> lever = support::single_joint(JointType::revolute);
  const JointPidGains<1> gains{PidGains{.proportional = 1}};
  PidLaw<1> turning(wheel, gains), swinging(lever, gains);
  JointState<1> state;
  JointReference<1> reference;
  constexpr unsigned seed = 5;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 1000; ++k) {
    state.position[0] = random.number(-100, 100);
    reference.position[0] = random.number(-100, 100);
    CAPTURE(state.position[0], reference.position[0]);
    const double error = reference.position[0] - state.position[0];
    const double way = turning.output({state, reference, 1e-3})[0];
    CHECK(std::abs(way) <= std::numbers::pi);
    CHECK(std::cos(way) == Approx(std::cos(error)).margin(1e-12));
    CHECK(std::sin(way) == Approx(std::sin(error)).margin(1e-12));
    CHECK(swinging.output({state, reference, 1e-3})[0] == error);
  }
}

TEST_CASE("the derivative of a continuous joint's error has no jump where the way changes") {
  PidLaw<1> law(support::single_joint(JointType::continuous),
                {PidGains{.derivative = 1, .derivative_of = DerivativeOf::error}});
  JointState<1> state;
  JointReference<1> reference;
  for (int k = 0; k < 10000; ++k) {
    reference.position[0] = next_angle(0, 0.01 * k);
    const double rate = law.output({state, reference, 0.01})[0];
    if (k > 0) REQUIRE(rate == Approx(1).epsilon(1e-9));
  }
}

TEST_CASE("a PID of the velocity has no kick when its reference steps, unless it is asked for") {
  for (const auto of : {DerivativeOf::measured_velocity, DerivativeOf::error}) {
    PidLaw<1, PidOf::velocity> law(
        {PidGains{.proportional = 10, .derivative = 0.25, .derivative_of = of}}, {"joint"});
    JointState<1> state;
    JointReference<1> reference;
    static_cast<void>(law.output({state, reference, 0.5}));
    reference.velocity[0] = 1;
    const double kick = of == DerivativeOf::error ? 0.5 : 0;
    CHECK(law.output({state, reference, 0.5})[0] == 10 + kick);
    CHECK(law.output({state, reference, 0.5})[0] == 10);
    state.velocity[0] = 0.5;  // and damping in both
    CHECK(law.output({state, reference, 0.5})[0] == 5 - 0.25);
  }
}

TEST_CASE("a PID of the velocity derives its variable by differences") {
  PidLaw<1, PidOf::velocity> law({PidGains{.proportional = 2, .integral = 3, .derivative = 0.5}},
                                 {"joint"});
  JointState<1> state;
  JointReference<1> reference;
  reference.position[0] = 1e9;  // not used
  reference.velocity[0] = 1;
  CHECK(law.output({state, reference, 0.5})[0] == 2 + 1.5);
  state.velocity[0] = 0.5;
  CHECK(law.output({state, reference, 0.5})[0] == 2 * 0.5 + 1.5 + 0.75 - 0.5);
}

TEST_CASE("new gains keep the integral's output") {
  const JointNames<1> names{"joint"};
  PidLaw<1> law({PidGains{.integral = 2}}, names);
  JointReference<1> reference;
  reference.position[0] = 1;
  static_cast<void>(law.output({{}, reference, 0.5}));
  law.set_gains({{PidGains{.proportional = 4, .integral = 100}}, names});
  CHECK(law.integral()[0] == 1);
  reference.position[0] = 0;
  CHECK(law.output({{}, reference, 0.5})[0] == 1);
  law.set_gains({{PidGains{.integral = 1, .integral_clamp_max = 0.25}}, names});
  reference.position[0] = 1;
  CHECK(law.output({{}, reference, 0.5})[0] == 0.25);
}

TEST_CASE("each new gain is refused where it makes no sense, naming joint, gain and value") {
  struct Bad {
    double PidGains::* member;
    std::string name;
    std::vector<double> values;
  };
  const std::vector<double> no_length{-1, infinity, not_a_number},
      no_number{infinity, not_a_number};
  const std::vector<double> no_weight{-0.1, 1.1, not_a_number};
  const Bad all[] = {{&PidGains::tracking_time, "tracking_time", no_length},
                     {&PidGains::error_deadband, "error_deadband", no_length},
                     {&PidGains::derivative_filter_time, "derivative_filter_time", no_length},
                     {&PidGains::position_weight, "position_weight", no_weight},
                     {&PidGains::velocity_weight, "velocity_weight", no_weight},
                     {&PidGains::velocity_feedforward, "velocity_feedforward", no_number},
                     {&PidGains::acceleration_feedforward, "acceleration_feedforward", no_number},
                     {&PidGains::output_clamp_min, "output_clamp_min", no_number},
                     {&PidGains::output_clamp_max, "output_clamp_max", {-infinity, not_a_number}}};
  for (const Bad& bad : all) {
    for (const double value : bad.values) {
      CAPTURE(bad.name, value);
      JointPidGains<2> gains{};
      gains[1].*bad.member = value;
      CHECK_THROWS_WITH(Pid<Q2d>(gains), Catch::Matchers::Contains("'elbow_active_joint'") &&
                                             Catch::Matchers::Contains(bad.name));
    }
  }
  JointPidGains<2> gains{};
  gains[0].anti_windup = static_cast<AntiWindup>(7);
  CHECK_THROWS_AS(Pid<Q2d>(gains), std::invalid_argument);
  gains = {};
  gains[0].derivative_of = static_cast<DerivativeOf>(7);
  CHECK_THROWS_AS(Pid<Q2d>(gains), std::invalid_argument);
}

TEST_CASE("hostile inputs leave nothing behind, whatever the gains") {
  constexpr unsigned seed = 6;
  CAPTURE(seed);
  support::Random random(seed);
  const double hostile[] = {not_a_number,     infinity,          -infinity,
                            support::largest, -support::largest, support::smallest};
  for (int k = 0; k < 2000; ++k) {
    CAPTURE(k);
    const PidGains g{.proportional = random.number(0, 10),
                     .integral = random.one_in(4) ? 0.0 : random.number(-10, 1e3),
                     .derivative = random.number(0, 1),
                     .integral_clamp_max = random.one_in(2) ? 5.0 : infinity,
                     .output_clamp_min = random.one_in(2) ? -1.0 : -infinity,
                     .anti_windup = static_cast<AntiWindup>(random.integer(0, 2)),
                     .derivative_of = static_cast<DerivativeOf>(random.integer(0, 1)),
                     .derivative_filter_time = random.one_in(2) ? 0.0 : 0.01,
                     .position_weight = random.one_in(2) ? 1.0 : 0.3,
                     .velocity_weight = random.one_in(2) ? 1.0 : 0.0};
    JointPid pid;
    pid.start();
    static_cast<void>(pid.update(g, error_of(0.1), 1e-3));
    PidInput wild = error_of(0.1);
    double* const members[] = {&wild.error, &wild.measured, &wild.rate_error};
    *members[random.integer(0, 2)] = hostile[random.integer(0, 5)];
    static_cast<void>(pid.update(g, wild, 1e-3, random.one_in(2) ? 6.28 : 0.0));
    pid.limit_windup(g, hostile[random.integer(0, 5)]);
    CHECK(is_finite(pid.integral()));
    // The cycle after may still take its derivative from the wild one.
    static_cast<void>(pid.update(g, error_of(0.1), 1e-3));
    CHECK(is_finite(pid.update(g, error_of(0.1), 1e-3)));
  }
}

TEST_CASE("a second start is like the first, whatever was before") {
  PidGains g{.proportional = 3, .integral = 2, .derivative = 1};
  g.derivative_of = DerivativeOf::error;
  g.derivative_filter_time = 0.01;
  g.position_weight = 0.5;
  g.velocity_weight = 0.25;
  JointPid first, second;
  for (int k = 0; k < 5; ++k) static_cast<void>(second.update(g, error_of(0.3 * k), 1e-3));
  first.start();
  second.start();
  for (int k = 0; k < 5; ++k) {
    const PidInput input{.error = 1 - 0.1 * k, .measured = 2 + 0.1 * k};
    CHECK(second.update(g, input, 1e-3) == first.update(g, input, 1e-3));
  }
}

TEST_CASE("an excess that overflowed takes the last step back, whatever the anti-windup") {
  for (const AntiWindup way :
       {AntiWindup::none, AntiWindup::back_calculation, AntiWindup::conditional_integration}) {
    for (const double excess : {infinity, -infinity, not_a_number}) {
      PidGains g{.proportional = 1, .integral = 1};
      g.anti_windup = way;
      JointPid pid;
      static_cast<void>(pid.update(g, error_of(1), 1e-3));
      const double before = pid.integral();
      static_cast<void>(pid.update(g, error_of(1), 1e-3));
      pid.limit_windup(g, excess);
      CHECK(pid.integral() == before);
    }
  }
}

TEST_CASE("new clamps of the integral take force in the next cycle, also where it rests") {
  for (const double error : {0.005, 0.0}) {
    CAPTURE(error);
    const JointNames<1> names{"joint"};
    PidGains g{.integral = 100, .error_deadband = error};
    PidLaw<1> law({g}, names);
    JointReference<1> reference;
    reference.position[0] = 1;
    static_cast<void>(law.output({{}, reference, 0.2}));
    CHECK(law.integral()[0] == 20);
    g.integral_clamp_max = 5;
    law.set_gains({{g}, names});
    reference.position[0] = error;
    CHECK(law.output({{}, reference, 0.2})[0] == 5);
    // Behind the other limit: what the clamp took is no step.
    CHECK(law.output({{}, reference, 0.2, {}, JointVector<1>(-1.0)})[0] == 5);
  }
}

TEST_CASE("an integral whose gain becomes 0 stays as a constant until the start") {
  const JointNames<1> names{"joint"};
  PidLaw<1> law({PidGains{.integral = 2}}, names);
  JointReference<1> reference;
  reference.position[0] = 1;
  static_cast<void>(law.output({{}, reference, 0.5}));
  law.set_gains({{PidGains{}}, names});
  reference.position[0] = -1;
  for (int k = 0; k < 10; ++k) CHECK(law.output({{}, reference, 0.5})[0] == 1);
  law.start({{}, {}, 0.5});
  CHECK(law.output({{}, reference, 0.5})[0] == 0);
}

TEST_CASE("a first measurement that is no number is not where the joint was at the start") {
  const PidGains gains[] = {
      {.proportional = 5, .position_weight = 0.3},
      {.proportional = 5, .derivative = 2, .derivative_of = DerivativeOf::error},
      {.proportional = 5,
       .derivative = 2,
       .derivative_of = DerivativeOf::error,
       .derivative_filter_time = 0.01,
       .position_weight = 0,
       .velocity_weight = 0.5}};
  for (const PidGains& g : gains) {
    for (const double wrong : {not_a_number, infinity, -infinity}) {
      JointPid pid, undisturbed;
      static_cast<void>(pid.update(g, error_of(wrong), 1e-3));
      for (const double error : {0.2, 0.3, 0.25}) {
        CHECK(pid.update(g, error_of(error), 1e-3) == undisturbed.update(g, error_of(error), 1e-3));
      }
    }
  }
}

TEST_CASE("after a measurement that is no number a derivative by differences is not wrong") {
  const PidGains g{.derivative = 1, .derivative_of = DerivativeOf::error};
  JointPid pid;
  for (int k = 0; k < 10; ++k) {  // a ramp of 1
    const double output = pid.update(g, error_of(k == 5 ? not_a_number : 1e-3 * k), 1e-3);
    if (k == 5) CHECK(std::isnan(output));
    if (k > 0 && k != 5) CHECK(output == Approx(1));  // not 2, though two cycles have passed
  }
}

TEST_CASE("a period of zero leaves a filtered derivative as it is, however large the rates are") {
  JointPid pid;
  const PidGains g{.derivative = 1, .derivative_filter_time = 0.1};
  const double before = pid.update(g, {.rate_error = -1e308}, 1e-3);
  CHECK(is_finite(before));
  CHECK(pid.update(g, {.rate_error = 1e308}, 0) == before);
}

TEST_CASE("the largest finite inputs give finite outputs that push the right way") {
  const double big = 1e308;
  const Model<1> robot = support::slider();  // without limits
  for (const double weight : {1.0, 0.5, 0.0}) {
    for (const auto of : {DerivativeOf::measured_velocity, DerivativeOf::error}) {
      const PidGains g{.proportional = 2000,
                       .integral = 500,
                       .derivative = 60,
                       .derivative_of = of,
                       .position_weight = weight,
                       .velocity_weight = weight,
                       .velocity_feedforward = 10,
                       .acceleration_feedforward = 10};
      Pid<Model<1>> pid(robot, {g});
      support::Random random(3);
      JointState<1> state;
      JointReference<1> reference;
      pid.start({state, reference, 1e-3});
      for (int k = 0; k < 1000; ++k) {
        for (auto* number : {&state.position, &state.velocity, &reference.position,
                             &reference.velocity, &reference.acceleration, &reference.effort}) {
          (*number)[0] = big * random.integer(-1, 1);
        }
        REQUIRE(is_finite(pid.update({state, reference, 1e-3})));
      }
    }
  }
  Pid<Model<1>> pid(robot, {{{.proportional = 2000, .derivative = 60}}});
  JointState<1> state;
  JointReference<1> reference;
  reference.position[0] = reference.velocity[0] = big;
  state.position[0] = state.velocity[0] = -big;
  CHECK(pid.update({state, reference, 1e-3}).effort[0] > 1e299);
  CHECK(pid.update({{}, {}, 1e-3}).effort[0] == 0);
}

TEST_CASE("a joint that turns for ever takes its way from angles that overflow, too") {
  const double turn = 2 * std::numbers::pi;
  CHECK(std::abs(JointPid::short_way(infinity, turn)) <= std::numbers::pi);
  CHECK(std::isnan(JointPid::short_way(not_a_number, turn)));
}
