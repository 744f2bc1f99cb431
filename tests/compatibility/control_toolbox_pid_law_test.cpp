// SPDX-License-Identifier: Apache-2.0
// The laws of control_toolbox: figures computed elsewhere, from the same formulas in another
// language.
#include <articula/compatibility/control_toolbox_pid_law.hpp>
#include <articula/control/laws/pid_law.hpp>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"

using namespace articula;

namespace {

/// The course's shoulder, its derivative being that of the error.
constexpr PidGains course{.proportional = 2310,
                          .integral = 4640,
                          .derivative = 0.299,
                          .integral_clamp_min = -27.94,
                          .integral_clamp_max = 27.94,
                          .anti_windup = AntiWindup::none,
                          .derivative_of = DerivativeOf::error};

ControlToolboxPidLaw<1> law_of(ControlToolbox version, const PidGains& gains = course) {
  return {version, {gains}, {"shoulder"}};
}

double output(ControlToolboxPidLaw<1>& law, double error, double period = 1e-3) {
  JointReference<1> reference;
  reference.position[0] = error;
  return law.output({{}, reference, period})[0];
}

std::string printed(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

std::vector<std::string> first_outputs(ControlToolbox version) {
  auto law = law_of(version);
  std::vector<std::string> outputs;
  for (int k = 0; k < 3; ++k) outputs.push_back(printed(output(law, 0.01)));
  return outputs;
}

/// How many cycles after the error has changed its sign the integral term stays at its clamp.
int cycles_at_the_clamp(ControlToolbox version) {
  auto law = law_of(version);
  for (int k = 0; k < 2000; ++k) static_cast<void>(output(law, 0.01));
  CHECK(law.integral()[0] == 27.94);
  for (int k = 1;; ++k) {
    const double before = law.integral()[0];
    static_cast<void>(output(law, -0.01));
    // The current law uses the term that it had before, the others the one that they have now.
    const double used = version == ControlToolbox::current ? before : law.integral()[0];
    if (used < 27.94) return k;
  }
}

}  // namespace

TEST_CASE("the first outputs for a constant error") {
  using Texts = std::vector<std::string>;
  for (const auto version : {ControlToolbox::noetic, ControlToolbox::noetic_antiwindup,
                             ControlToolbox::humble, ControlToolbox::humble_antiwindup,
                             ControlToolbox::jazzy, ControlToolbox::jazzy_antiwindup}) {
    CHECK(first_outputs(version) == Texts{"26.1364", "23.1928", "23.2392"});
  }
  CHECK(first_outputs(ControlToolbox::current) == Texts{"26.09", "23.1464", "23.1928"});
}

TEST_CASE("the integral reaches its clamp after 0.602 s") {
  for (const auto version :
       {ControlToolbox::noetic, ControlToolbox::humble, ControlToolbox::jazzy}) {
    auto law = law_of(version);
    int cycles = 0;
    for (; law.integral()[0] < 27.94; ++cycles) static_cast<void>(output(law, 0.01));
    CHECK(cycles == 603);  // 0.602 s after the first
  }
}

TEST_CASE("how long the integral stays at its clamp when the error changes its sign") {
  CHECK(cycles_at_the_clamp(ControlToolbox::humble) == 1398);
  CHECK(cycles_at_the_clamp(ControlToolbox::noetic) == 1398);
  CHECK(cycles_at_the_clamp(ControlToolbox::humble_antiwindup) == 1);
  CHECK(cycles_at_the_clamp(ControlToolbox::noetic_antiwindup) == 1);
  CHECK(cycles_at_the_clamp(ControlToolbox::jazzy) == 1398);
  CHECK(cycles_at_the_clamp(ControlToolbox::jazzy_antiwindup) == 1);
  CHECK(cycles_at_the_clamp(ControlToolbox::current) == 2);
}

TEST_CASE("our own law has humble's outputs without the kick, and no windup") {
  PidGains g = course;
  g.anti_windup = AntiWindup::conditional_integration;
  PidLaw<1> law({g}, {"shoulder"});
  JointReference<1> reference;
  reference.position[0] = 0.01;
  const char* const expected[] = {"23.1464", "23.1928", "23.2392"};
  for (const char* text : expected) {
    CHECK(printed(law.output({{}, reference, 1e-3})[0]) == text);
  }
  for (int k = 3; k < 2000; ++k) static_cast<void>(law.output({{}, reference, 1e-3}));
  CHECK(law.integral()[0] == 27.94);
  reference.position[0] = -0.01;
  static_cast<void>(law.output({{}, reference, 1e-3}));
  CHECK(law.integral()[0] < 27.94);
}

TEST_CASE("the default tracking time is sqrt(d/i), or p/i without a derivative") {
  CHECK(JointPid::tracking_time(course) == Approx(8.03e-3).margin(5e-6));  // the digits given
  PidGains pi = course;
  pi.derivative = 0;
  CHECK(JointPid::tracking_time(pi) == 2310.0 / 4640);
}

TEST_CASE("the current law's ways against windup") {
  PidGains g{.proportional = 10,
             .integral = 100,
             .output_clamp_min = -1,
             .output_clamp_max = 1,
             .anti_windup = AntiWindup::none,
             .tracking_time = 0.5};
  SECTION("none") {
    auto law = law_of(ControlToolbox::current, g);
    CHECK(output(law, 2, 0.1) == 1);
    CHECK(law.integral()[0] == Approx(20).epsilon(1e-15));  // 0.1 s x 100 x 2
  }
  SECTION("back-calculation") {
    g.anti_windup = AntiWindup::back_calculation;
    auto law = law_of(ControlToolbox::current, g);
    CHECK(output(law, 2, 0.1) == 1);
    CHECK(law.integral()[0] == Approx(20 + 0.1 * (1 - 20) / 0.5).epsilon(1e-15));
  }
  SECTION("conditional integration") {
    g.anti_windup = AntiWindup::conditional_integration;
    auto law = law_of(ControlToolbox::current, g);
    CHECK(output(law, 2, 0.1) == 1);
    CHECK(law.integral()[0] == 0);
    CHECK(output(law, 0.05, 0.1) == 0.5);  // not cut off: goes on
    CHECK(law.integral()[0] == 0.5);
  }
  SECTION("within the dead-band nothing is added") {
    g.error_deadband = 0.1;
    auto law = law_of(ControlToolbox::current, g);
    static_cast<void>(output(law, 0.1, 0.1));
    CHECK(law.integral()[0] == 0);
    static_cast<void>(output(law, 0.11, 0.1));
    CHECK(law.integral()[0] > 0);
  }
  SECTION("conditional integration rests only where the error pushes further") {
    g.anti_windup = AntiWindup::conditional_integration;
    g.derivative = 100;
    auto law = law_of(ControlToolbox::current, g);
    JointState<1> state;
    JointReference<1> reference;
    reference.position[0] = -0.01;
    reference.velocity[0] = 1;  // 100 - 0.1 is cut off, while the error asks for less
    CHECK(law.output({state, reference, 0.1})[0] == 1);
    CHECK(law.integral()[0] == Approx(0.1 * 100 * -0.01).epsilon(1e-15));
  }
}

TEST_CASE("the given derivative is used where it is asked for") {
  PidGains g = course;
  g.derivative_of = DerivativeOf::measured_velocity;
  for (const auto version : {ControlToolbox::current, ControlToolbox::humble}) {
    auto law = law_of(version, g);
    JointReference<1> reference;
    JointState<1> state;
    state.velocity[0] = 2;
    reference.velocity[0] = 3;
    CHECK(law.output({state, reference, 1e-3})[0] == 0.299);
  }
}

TEST_CASE("what each does with a period of 0 and with an error that is no number") {
  for (const double wrong : {support::not_a_number, support::infinity, -support::infinity}) {
    CAPTURE(wrong);
    auto current = law_of(ControlToolbox::current);
    const double last = output(current, 0.01);
    CHECK(output(current, 0.02, 0) == last);
    CHECK(std::isnan(output(current, wrong)));
    CHECK(is_finite(output(current, 0.01)));  // nothing is left of it

    auto humble = law_of(ControlToolbox::humble);
    static_cast<void>(output(humble, 0.01));
    CHECK(output(humble, 0.02, 0) == 0);
    CHECK(output(humble, wrong) == 0);
    CHECK(humble.integral()[0] == Approx(0.0464).epsilon(1e-15));
  }
}

TEST_CASE("start forgets the past") {
  for (const auto version : {ControlToolbox::current, ControlToolbox::jazzy,
                             ControlToolbox::humble_antiwindup, ControlToolbox::noetic}) {
    auto law = law_of(version);
    const double first = output(law, 0.01);
    static_cast<void>(output(law, 0.01));
    law.start({{}, {}, 1e-3});
    CHECK(output(law, 0.01) == first);
  }
}

TEST_CASE(
    "without output clamps and dead-band Jazzy has Humble's numbers, Noetic has them always") {
  constexpr unsigned seed = 3;
  CAPTURE(seed);
  support::Random random(seed);
  using enum ControlToolbox;
  ControlToolboxPidLaw<1> laws[][3] = {
      {law_of(humble), law_of(noetic), law_of(jazzy)},
      {law_of(humble_antiwindup), law_of(noetic_antiwindup), law_of(jazzy_antiwindup)}};
  for (int k = 0; k < 5000; ++k) {
    const double error = random.number(-0.02, 0.05), period = random.number(1e-4, 2e-3);
    for (auto& [h, n, j] : laws) {
      const double expected = output(h, error, period);
      REQUIRE(output(n, error, period) == expected);
      // i E and the sum of i e dt round differently, some 1e-16 of 40 N m in each cycle.
      REQUIRE(output(j, error, period) == Approx(expected).margin(1e-10));
    }
  }
}

TEST_CASE("start leaves the integrals of joints that keep them") {
  for (const auto version : {ControlToolbox::current, ControlToolbox::jazzy, ControlToolbox::humble,
                             ControlToolbox::noetic_antiwindup}) {
    CAPTURE(static_cast<int>(version));
    ControlToolboxPidLaw<2> law(version, {course, course}, {"shoulder", "elbow"}, {true, false});
    JointReference<2> reference;
    reference.position = JointVector<2>::Constant(0.01);
    for (int k = 0; k < 10; ++k) static_cast<void>(law.output({{}, reference, 1e-3}));
    const double kept = law.integral()[0];
    REQUIRE(kept == Approx(0.464).epsilon(1e-12));  // 10 cycles of 0.0464 N m
    law.start({{}, {}, 1e-3});
    CHECK(law.integral()[0] == kept);
    CHECK(law.integral()[1] == 0);
    const auto next = law.output({{}, reference, 1e-3});
    // Both have the kick of e/dt again, since all else is forgotten.
    CHECK(next[0] - next[1] == Approx(kept).epsilon(1e-12));
  }
}

TEST_CASE("its gains are checked too") {
  PidGains g = course;
  g.integral = support::not_a_number;
  CHECK_THROWS_WITH(law_of(ControlToolbox::current, g), Catch::Matchers::Contains("'shoulder'") &&
                                                            Catch::Matchers::Contains("integral"));
}

TEST_CASE("output clamps without 0 between them are kept, and taken by these laws alone") {
  PidGains g{.proportional = 1, .output_clamp_min = 2, .output_clamp_max = 5};
  for (const auto version :
       {ControlToolbox::current, ControlToolbox::jazzy, ControlToolbox::jazzy_antiwindup}) {
    auto law = law_of(version, g);
    CHECK(output(law, 0) == 2);
    CHECK(output(law, 3) == 3);
    CHECK(output(law, 9) == 5);
  }
  CHECK_THROWS_WITH(PidLaw<1>({g}, {"shoulder"}), Catch::Matchers::Contains("output_clamp_min 2"));
  g.output_clamp_max = 1;
  CHECK_THROWS_WITH(law_of(ControlToolbox::current, g),
                    Catch::Matchers::Contains("'shoulder'") &&
                        Catch::Matchers::Contains("output_clamp_min 2 is not below"));
  g.output_clamp_max = support::not_a_number;
  CHECK_THROWS_WITH(law_of(ControlToolbox::humble, g),
                    Catch::Matchers::Contains("output_clamp_min 2 is not below"));
}

TEST_CASE("Jazzy has a dead-band and output clamps, and stands still where Humble gives 0") {
  PidGains g{.proportional = 10,
             .integral = 100,
             .integral_clamp_min = -1,
             .integral_clamp_max = 1,
             .output_clamp_min = -4,
             .output_clamp_max = 4,
             .error_deadband = 0.1};
  for (const auto version : {ControlToolbox::jazzy, ControlToolbox::jazzy_antiwindup}) {
    CAPTURE(static_cast<int>(version));
    auto law = law_of(version, g);
    CHECK(output(law, 0.1, 0.1) == 1);   // within the dead-band nothing is added
    CHECK(output(law, 0.2, 0.1) == 3);   // p e + the clamp: 100 x 0.2 x 0.1 is 2
    CHECK(output(law, 0.35, 0.1) == 4);  // of 3.5 + 1
    CHECK(output(law, -0.2, 0) == 4);    // a period of 0: the last output again
    CHECK(std::isnan(output(law, support::not_a_number, 0.1)));
    // 2 + 3.5 - 2 are left of the sum, 1 - 2 of the term that is kept between the clamps.
    const bool keeps = version == ControlToolbox::jazzy_antiwindup;
    CHECK(output(law, -0.2, 0.1) == Approx(keeps ? -3 : -1));
  }
}

TEST_CASE("a velocity that is no number changes nothing but one output") {
  for (const auto version :
       {ControlToolbox::current, ControlToolbox::humble, ControlToolbox::humble_antiwindup,
        ControlToolbox::noetic, ControlToolbox::noetic_antiwindup}) {
    for (const auto way :
         {AntiWindup::none, AntiWindup::back_calculation, AntiWindup::conditional_integration}) {
      for (const double wrong : {support::not_a_number, support::infinity, -support::infinity}) {
        PidGains g = course;
        g.output_clamp_min = -30;
        g.output_clamp_max = 30;
        g.anti_windup = way;
        g.derivative_of = DerivativeOf::measured_velocity;
        auto law = law_of(version, g);
        JointState<1> state;
        JointReference<1> reference;
        reference.position[0] = 1e-3;
        static_cast<void>(law.output({state, reference, 1e-3}));
        const double before = law.integral()[0];
        state.velocity[0] = wrong;
        const double output = law.output({state, reference, 1e-3})[0];
        CAPTURE(static_cast<int>(version), static_cast<int>(way), wrong);
        CHECK((version == ControlToolbox::current ? std::isnan(output) : output == 0));
        CHECK(law.integral()[0] == before);
        state.velocity[0] = 0;
        CHECK(is_finite(law.output({state, reference, 1e-3})));
      }
    }
  }
}

TEST_CASE(
    "an error that is too large for numbers costs that cycle, and the next one's derivative") {
  for (const auto version : {ControlToolbox::current, ControlToolbox::humble_antiwindup}) {
    for (const auto way :
         {AntiWindup::none, AntiWindup::back_calculation, AntiWindup::conditional_integration}) {
      for (const auto derivative : {DerivativeOf::error, DerivativeOf::measured_velocity}) {
        for (const double clamp : {27.94, support::infinity}) {
          PidGains g = course;
          g.integral_clamp_max = -(g.integral_clamp_min = -clamp);
          g.output_clamp_max = -(g.output_clamp_min = -clamp);
          g.anti_windup = way;
          g.derivative_of = derivative;
          auto law = law_of(version, g);
          static_cast<void>(output(law, 0.01));
          static_cast<void>(output(law, 1e306));
          CHECK(is_finite(law.integral()));
          static_cast<void>(output(law, 0.01));
          CHECK(is_finite(output(law, 0.01)));
          CHECK(is_finite(law.integral()));
        }
      }
    }
  }
}

TEST_CASE("negative gains are taken, as control_toolbox takes them") {
  PidGains g = course;
  g.proportional = -2;
  g.integral = -100;
  g.derivative = 0;
  for (const auto version :
       {ControlToolbox::humble_antiwindup, ControlToolbox::noetic_antiwindup}) {
    auto law = law_of(version, g);
    CHECK(output(law, 0.1, 0.1) == Approx(-0.2 - 1).epsilon(1e-15));
    for (int k = 0; k < 100; ++k) static_cast<void>(output(law, 0.1, 0.1));
    CHECK(law.integral()[0] == Approx(-27.94).epsilon(1e-15));  // the sum's clamps change places
    static_cast<void>(output(law, -0.1, 0.1));
    CHECK(law.integral()[0] == Approx(-26.94).epsilon(1e-12));
  }
  auto current = law_of(ControlToolbox::current, g);
  static_cast<void>(output(current, 0.1, 0.1));
  CHECK(current.integral()[0] == Approx(-1).epsilon(1e-15));
  // Of gains with different signs sqrt(d/i) is no number: that of their sizes is, sqrt(1 / 100).
  g.derivative = 1;
  g.anti_windup = AntiWindup::back_calculation;
  g.derivative_of = DerivativeOf::measured_velocity;
  g.output_clamp_max = -(g.output_clamp_min = -0.1);
  auto tracking = law_of(ControlToolbox::current, g);
  CHECK(output(tracking, 0.1, 0.01) == -0.1);  // of -0.2
  CHECK(tracking.integral()[0] == Approx(0.01 * (-10 + 0.1 / 0.1)).epsilon(1e-14));
}
