// SPDX-License-Identifier: Apache-2.0
#include <articula/control/laws/pid_law.hpp>
#include <articula/control/pid.hpp>
#include <articula/control/pid_plus_gravity.hpp>

#include "catch.hpp"
#include "numbers.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using support::infinity;
using support::largest;
using support::smallest;

namespace {

PidLaw<1> law_with(const PidGains& gains) { return PidLaw<1>({gains}, {"joint"}); }

/// The output for one joint with the reference at `position` and `velocity`, measured at 0, 0.
double output(PidLaw<1>& law, double position, double velocity, double period) {
  JointReference<1> reference;
  reference.position[0] = position;
  reference.velocity[0] = velocity;
  return law.output({{}, reference, period})[0];
}

JointVector<1> one(double x) { return JointVector<1>::Constant(x); }

/// Tells a law what was cut off from its last output, and asks for nothing more.
template <int N>
void cut_off(PidLaw<N>& law, const JointVector<N>& cut) {
  static_cast<void>(law.output({{}, {}, 0.125, {}, cut}));
}

constexpr PidGains gains{.proportional = 2,
                         .integral = 3,
                         .derivative = 0.5,
                         .integral_clamp_min = -0.4,
                         .integral_clamp_max = 0.7};

// A handful of roundings.
constexpr double rounding = 1e-14;

}  // namespace

TEST_CASE("each term of the PID is what its gain says") {
  PidLaw<2> law({gains, {.proportional = 7}}, {"a", "b"});
  JointState<2> state;
  state.position = {0.25, 1.0};
  state.velocity = {1.0, 9.0};
  state.effort = {1e6, 1e6};  // not used
  JointReference<2> reference;
  reference.position = {0.75, 3.0};
  reference.velocity = {3.0, -9.0};
  reference.acceleration = {1e6, 1e6};  // not used
  reference.effort = {1e6, 1e6};        // not used

  const JointVector<2> u = law.output({state, reference, 0.1});
  CHECK(u[0] == Approx(2 * 0.5 + 3 * 0.5 * 0.1 + 0.5 * 2.0).epsilon(rounding));
  CHECK(u[1] == 14.0);
  CHECK(law.integral()[0] == Approx(0.15).epsilon(rounding));
  CHECK(law.integral()[1] == 0.0);
}

TEST_CASE("the integral is advanced before it is used, and clamped in units of the output") {
  auto law = law_with(gains);
  for (int k = 1; k <= 4; ++k) {
    CAPTURE(k);
    CHECK(output(law, 0.5, 0, 0.1) == Approx(1.0 + 0.15 * k).epsilon(rounding));
  }
  CHECK(output(law, 0.5, 0, 0.1) == 1.0 + 0.7);  // would be 0.75
  CHECK(output(law, 0.5, 0, 0.1) == 1.0 + 0.7);
  CHECK(output(law, -0.5, 0, 0.1) == Approx(-1.0 + 0.55).epsilon(rounding));
  for (int k = 0; k < 20; ++k) static_cast<void>(output(law, -0.5, 0, 0.1));
  CHECK(law.integral()[0] == -0.4);
}

TEST_CASE("the integral grows with the period") {
  auto fast = law_with(gains), slow = law_with(gains);
  for (int k = 0; k < 10; ++k) static_cast<void>(output(fast, 0.01, 0, 0.001));
  static_cast<void>(output(slow, 0.01, 0, 0.01));
  CHECK(fast.integral()[0] == Approx(slow.integral()[0]).epsilon(rounding));
}

TEST_CASE("a step of the reference position gives no derivative kick") {
  auto law = law_with({.derivative = 5});
  CHECK(output(law, 0, 0, 1e-3) == 0.0);
  CHECK(output(law, 100, 0, 1e-3) == 0.0);
  CHECK(output(law, 100, 2, 1e-3) == 10.0);
}

TEST_CASE("start forgets the integral") {
  auto law = law_with(gains);
  static_cast<void>(output(law, 1, 0, 0.1));
  law.start({{}, {}, 1e-3});
  CHECK(law.integral()[0] == 0.0);
  CHECK(output(law, 0, 0, 0.1) == 0.0);
}

TEST_CASE("while the total is limited the integral moves only away from the limit") {
  for (const double side : {1.0, -1.0}) {
    CAPTURE(side);
    auto law = law_with({.integral = 1});
    static_cast<void>(output(law, side, 0, 0.125));
    cut_off(law, one(0));
    CHECK(law.integral()[0] == side * 0.125);

    static_cast<void>(output(law, side, 0, 0.125));
    cut_off(law, one(side * 1e-9));  // pushes further: taken back
    CHECK(law.integral()[0] == side * 0.125);

    static_cast<void>(output(law, side, 0, 0.125));
    cut_off(law, one(side * -1e-9));  // the other limit: kept
    CHECK(law.integral()[0] == side * 0.25);

    static_cast<void>(output(law, -side, 0, 0.125));
    cut_off(law, one(side * 1e-9));  // comes back from the limit: kept
    CHECK(law.integral()[0] == side * 0.125);
  }
}

TEST_CASE("an excess too small to be multiplied still stops the integral") {
  auto law = law_with({.integral = 1});
  static_cast<void>(output(law, 1e-160, 0, 1e-3));
  cut_off(law, one(1e-200));
  CHECK(law.integral()[0] == 0.0);
}

TEST_CASE("joints do not share their integrals") {
  PidLaw<2> law({gains, gains}, {"a", "b"});
  JointReference<2> reference;
  reference.position = {0.1, -0.1};
  static_cast<void>(law.output({{}, reference, 0.1}));
  cut_off<2>(law, {1.0, 1.0});  // pushes joint a further, and joint b back
  CHECK(law.integral()[0] == 0.0);
  CHECK(law.integral()[1] == Approx(-0.03).epsilon(rounding));
}

TEST_CASE("a period of zero leaves the integral alone") {
  auto law = law_with(gains);
  CHECK(output(law, 0.5, 0, 0) == 1.0);
  CHECK(law.integral()[0] == 0.0);
}

TEST_CASE("denormal errors and the largest numbers are no trouble") {
  auto law = law_with(gains);
  CHECK(output(law, smallest, 0, 1e-3) == 2 * smallest);
  CHECK(output(law, largest, 0, 1e-3) == 1e300);  // cut off by whoever limits the total
  CHECK(law.integral()[0] == 0.7);
  CHECK(output(law, 0, 0, 1e-3) == 0.7);
}

// Finite inputs may overflow inside. The cycle that did must not spoil those that follow.
TEST_CASE("an overflow does not poison the integral") {
  JointState<1> state;
  state.position[0] = -largest;
  JointReference<1> reference;
  reference.position[0] = largest;  // the error is infinite

  for (const double integral_gain : {0.0, 1.0, 1e3}) {
    for (const double clamp : {1.0, 1e308, infinity}) {
      for (const double excess : {infinity, support::not_a_number}) {
        CAPTURE(integral_gain, clamp, excess);
        auto law = law_with({.proportional = 1,
                             .integral = integral_gain,
                             .integral_clamp_min = -clamp,
                             .integral_clamp_max = clamp});
        static_cast<void>(law.output({state, reference, 1e-3}));
        cut_off(law, one(excess));
        CHECK(is_finite(law.integral()[0]));
        CHECK(is_finite(output(law, 0, 0, 1e-3)));
      }
    }
  }
}

TEST_CASE("gains may be a list in place, with the braces of an array or without") {
  using support::TiltedQ2d;
  const JointPidGains<2> list{{{.proportional = 5}, {.proportional = 6, .derivative = 1}}};
  const Pid<TiltedQ2d> named(list);
  const Pid<TiltedQ2d> listed({{.proportional = 5}, {.proportional = 6, .derivative = 1}});
  const Pid<TiltedQ2d> braced({{{.proportional = 5}, {.proportional = 6, .derivative = 1}}});
  const PidPlusGravity<TiltedQ2d> other({{.proportional = 5}, {.proportional = 6}});
  for (const auto& pid : {named, listed, braced}) {
    CHECK(pid.part<PidLaw<2>>().gains()[0].proportional == 5);
    CHECK(pid.part<PidLaw<2>>().gains()[1].derivative == 1);
  }
  CHECK(other.part<PidLaw<2>>().gains()[1].proportional == 6);
  CHECK_THROWS_WITH(Pid<TiltedQ2d>({{.proportional = 5}}),
                    Catch::Matchers::Contains("the list has 1, but there are 2 joints"));
}
