// SPDX-License-Identifier: Apache-2.0
#include <articula/reference/joint_signals.hpp>
#include <articula/reference/reference_generator.hpp>
#include <articula/reference/set_point.hpp>
#include <articula/robots/q2d.hpp>

#include <numbers>
#include <vector>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "slope.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::infinity;
using support::not_a_number;

namespace {

static_assert(ReferenceGenerator<SetPoint<Q2d>, 2>);
static_assert(ReferenceGenerator<JointSignals<Q2d>, 2>);

constexpr double pi = std::numbers::pi;
const Name shoulder = "shoulder_active_joint", elbow = "elbow_active_joint";

/// Rate and acceleration are the derivatives of the value. See slope() for its accuracy; a signal
/// of 5 Hz changes on the scale of 0.03 s, which makes its fifth derivative 3e7.
template <class S>
void check_derivatives(const S& signal, double time) {
  CAPTURE(time);
  const auto value = [&](double h) { return signal.sample(time + h).value; };
  const auto rate = [&](double h) { return signal.sample(time + h).rate; };
  CHECK(signal.sample(time).rate == Approx(support::slope(value)).margin(2e-5));
  CHECK(signal.sample(time).acceleration == Approx(support::slope(rate)).margin(1e-3));
}

}  // namespace

TEST_CASE("a step rises at its start") {
  const StepSignal step{.height = 2, .start = 1};
  CHECK(step.sample(0.999).value == 0);
  CHECK(step.sample(1).value == 2);
  CHECK(step.sample(1).rate == 0);
}

TEST_CASE("a ramp is a straight line to its height") {
  const RampSignal ramp{.height = -3, .duration = 2, .start = 1};
  CHECK(ramp.sample(0).value == 0);
  CHECK(ramp.sample(0).rate == 0);
  CHECK(ramp.sample(2).value == -1.5);
  CHECK(ramp.sample(2).rate == -1.5);
  CHECK(ramp.sample(3).value == -3);
  CHECK(ramp.sample(3).rate == 0);
  CHECK(ramp.sample(1e9).value == -3);
}

TEST_CASE("a sine has amplitude, frequency, phase and offset") {
  const SineSignal sine{.amplitude = 2, .frequency = 0.5, .phase = pi / 6, .offset = 1};
  CHECK(sine.sample(0).value == Approx(2));
  CHECK(sine.sample(1).value == Approx(0).margin(1e-15));
  CHECK(sine.sample(2).value == Approx(2));
  CHECK(sine.sample(0).rate == Approx(2 * pi * std::cos(pi / 6)));
  for (const double t : {-1.3, 0.0, 0.7, 12.1}) check_derivatives(sine, t);
  // whole turns are exact: after 1e9 of them the phase is still what it was
  const SineSignal fast{.amplitude = 1, .frequency = 1};
  CHECK(fast.sample(1e9 + 0.25).value == Approx(1).epsilon(1e-12));
}

TEST_CASE("a chirp sweeps exponentially and ends at zero without a jump") {
  const ChirpSignal chirp{
      .amplitude = 0.5, .first_frequency = 0.5, .last_frequency = 5, .duration = 4, .start = 1};
  CHECK(chirp.sample(0.5).value == 0);
  CHECK(chirp.sample(1).value == 0);
  CHECK(chirp.sample(1).rate == Approx(0.5 * 2 * pi * 0.5));
  // K (exp(t/L) - 1) with K = w0 T / ln(w1/w0), L = T / ln(w1/w0)
  const double K = 2 * pi * 0.5 * 4 / std::log(10.0), L = 4 / std::log(10.0);
  for (const double t : {0.1, 1.0, 2.5, 3.9}) {
    CHECK(chirp.sample(1 + t).value == Approx(0.5 * std::sin(K * (std::exp(t / L) - 1))));
    check_derivatives(chirp, 1 + t);
  }
  double last = chirp.sample(5).value;
  for (double t = 5; t < 6; t += 1e-4) {
    const double value = chirp.sample(t).value;
    REQUIRE(std::abs(value - last) <= 0.5 * 2 * pi * 5 * 1.01e-4);
    last = value;
  }
  CHECK(chirp.sample(5.11).value == 0);  // half a turn of 5 Hz later at the latest
  CHECK(chirp.sample(5.11).rate == 0);

  const ChirpSignal falling{.amplitude = 1, .first_frequency = 5, .last_frequency = 0.5};
  for (const double t : {0.1, 0.5, 0.9}) check_derivatives(falling, t);
  const ChirpSignal level{.amplitude = 1, .first_frequency = 2, .last_frequency = 2};
  CHECK(level.sample(0.3).value == Approx(std::sin(2 * pi * 2 * 0.3)));
}

TEST_CASE("signals of a joint add up, around what was given") {
  const JointReference<2> around{{0.1, 0.2}, {0, 0}, {0, 0}, {0, 5}};
  const JointSignals<Q2d> signals({{shoulder, SineSignal{.amplitude = 0.5, .frequency = 1}},
                                   {elbow, StepSignal{.height = 3}, SignalTarget::effort},
                                   {shoulder, RampSignal{.height = 0.4, .duration = 2}}},
                                  around);
  const auto r = signals.sample(0.25);
  CHECK(r.position[0] == Approx(0.1 + 0.5 + 0.05));
  CHECK(r.velocity[0] == Approx(0.2));
  CHECK(r.acceleration[0] == Approx(-0.5 * 4 * pi * pi));
  CHECK(r.position[1] == 0.2);
  CHECK(r.velocity[1] == 0);
  CHECK(r.effort == JointVector<2>(0, 8));
}

TEST_CASE("positions are kept within the limits of the joints") {
  const JointSignals<Q2d> signals({{shoulder, SineSignal{.amplitude = 2, .frequency = 1}}});
  const auto high = signals.sample(0.25), low = signals.sample(0.75),
             between = signals.sample(1.05);
  CHECK(high.position[0] == pi / 2);
  CHECK(high.velocity[0] == 0);
  CHECK(high.acceleration[0] == 0);
  CHECK(low.position[0] == -pi / 2);
  CHECK(between.position[0] == Approx(2 * std::sin(0.1 * pi)));
  CHECK(between.velocity[0] != 0);
}

TEST_CASE("times that are no numbers give no position") {
  const JointSignals<Q2d> signals({{shoulder, StepSignal{.height = 1}}});
  for (const double t : {not_a_number, infinity, -infinity}) CHECK(!is_finite(signals.sample(t)));
  CHECK(is_finite(signals.sample(support::largest)));
}

TEST_CASE("signals that cannot be evaluated are refused by name") {
  const auto refuses = [](const Signal& signal, const char* why) {
    CHECK_THROWS_WITH(JointSignals<Q2d>({{shoulder, StepSignal{}}, {elbow, signal}}),
                      Contains("number 2") && Contains("'elbow_active_joint'") && Contains(why));
  };
  for (const double bad : {not_a_number, infinity, -infinity}) {
    refuses(StepSignal{.height = bad}, "finite");
    refuses(StepSignal{.start = bad}, "finite");
    refuses(RampSignal{.height = bad}, "finite");
    refuses(RampSignal{.duration = bad}, "finite");
    refuses(RampSignal{.start = bad}, "finite");
    refuses(SineSignal{.amplitude = bad}, "finite");
    refuses(SineSignal{.frequency = bad}, "finite");
    refuses(SineSignal{.phase = bad}, "finite");
    refuses(SineSignal{.offset = bad}, "finite");
    refuses(ChirpSignal{.amplitude = bad}, "finite");
    refuses(ChirpSignal{.first_frequency = bad}, "finite");
    refuses(ChirpSignal{.last_frequency = bad}, "finite");
    refuses(ChirpSignal{.duration = bad}, "finite");
    refuses(ChirpSignal{.start = bad}, "finite");
  }
  refuses(RampSignal{.duration = 0}, "duration");
  refuses(RampSignal{.height = 1e300, .duration = 1e-300}, "slope");
  refuses(SineSignal{.amplitude = 1, .frequency = 1e200}, "acceleration");
  refuses(SineSignal{.amplitude = 1e308, .offset = 1e308}, "offset");
  refuses(ChirpSignal{.first_frequency = 0}, "frequency");
  refuses(ChirpSignal{.last_frequency = -1}, "frequency");
  refuses(ChirpSignal{.duration = -1}, "duration");
  refuses(ChirpSignal{.amplitude = 1, .last_frequency = 1e200}, "acceleration");
}

TEST_CASE("signals whose sum overflows are refused by name") {
  const auto refuses = [](const Signal& signal, SignalTarget target) {
    CHECK_NOTHROW(JointSignals<Q2d>({{elbow, signal, target}, {shoulder, signal, target}}));
    CHECK_THROWS_WITH(
        JointSignals<Q2d>(
            {{shoulder, StepSignal{}}, {elbow, signal, target}, {elbow, signal, target}}),
        Contains("number 3") && Contains("'elbow_active_joint'") && Contains("overflow"));
  };
  for (const auto target : {SignalTarget::effort, SignalTarget::position}) {
    refuses(StepSignal{.height = -1e308}, target);
    refuses(RampSignal{.height = 1e308}, target);
    refuses(SineSignal{.offset = 1e308}, target);
  }
  refuses(RampSignal{.height = 1, .duration = 1e-308}, SignalTarget::position);
  refuses(SineSignal{.amplitude = 3, .frequency = 1e153}, SignalTarget::position);
  refuses(ChirpSignal{.amplitude = 3, .first_frequency = 1e153, .last_frequency = 1e153},
          SignalTarget::position);
  CHECK_THROWS_WITH(JointSignals<Q2d>({{elbow, StepSignal{.height = 1e308}, SignalTarget::effort}},
                                      {{0, 0}, {0, 0}, {0, 0}, {0, 1e308}}),
                    Contains("number 1") && Contains("overflow"));
}

TEST_CASE("no signal exceeds its peak") {
  constexpr unsigned seed = 16;
  CAPTURE(seed);
  support::Random random(seed);
  const auto check = [&](const auto& signal) {
    const SignalValue peak = signal.peak();
    for (int k = 0; k < 1000; ++k) {
      const SignalValue x = signal.sample(random.number(-1, 3));
      // 1e-15: where a sine is 1, its products round up
      REQUIRE(std::abs(x.value) <= peak.value * (1 + 1e-15));
      REQUIRE(std::abs(x.rate) <= peak.rate * (1 + 1e-15));
      REQUIRE(std::abs(x.acceleration) <= peak.acceleration * (1 + 1e-15));
    }
  };
  for (int k = 0; k < 50; ++k) {
    const double a = random.number(-2, 2), f = random.number(0.1, 9), g = random.number(0.1, 9);
    const double T = random.number(0.1, 2);
    check(StepSignal{.height = a});
    check(RampSignal{.height = a, .duration = T});
    check(SineSignal{.amplitude = a, .frequency = random.number(-9, 9), .offset = a - f});
    check(ChirpSignal{.amplitude = a, .first_frequency = f, .last_frequency = g, .duration = T});
    check(SquareSignal{.amplitude = a, .frequency = random.number(-9, 9), .offset = a - f});
  }
}

TEST_CASE("a square is the sign of the sine, and its halves have the same number of cycles") {
  const SquareSignal square{.amplitude = 2, .frequency = 0.7, .phase = 0.3, .offset = 1};
  const SineSignal sine{.amplitude = 1, .frequency = 0.7, .phase = 0.3};
  for (int k = -1000; k < 1000; ++k) {
    const double t = 0.0123 * k, s = sine.sample(t).value;
    if (std::abs(s) < 1e-9) continue;  // an edge, on either side of which it may be by rounding
    CHECK(square.sample(t).value == (s > 0 ? 3 : -1));
    CHECK(square.sample(t).rate == 0);
    CHECK(square.sample(t).acceleration == 0);
  }
  for (const double frequency : {2.5, 0.1, 5.0, 12.5}) {
    const SquareSignal wave{.amplitude = 1, .frequency = frequency};
    const int half = static_cast<int>(std::lround(500 / frequency));  // cycles of 1 ms
    for (int k = 0; k < 100 * half; ++k) {
      CAPTURE(frequency, k);
      REQUIRE(wave.sample(k * 1e-3).value == (k / half % 2 == 0 ? 1 : -1));
    }
  }
  CHECK(SquareSignal{.amplitude = 1e308, .offset = 1e308}.fault() ==
        "the sum of amplitude and offset is infinite");
}

TEST_CASE("unknown joints, too many signals and impossible poses are refused") {
  CHECK_THROWS_WITH(JointSignals<Q2d>({{"wrist", StepSignal{}}}), Contains("'wrist'"));
  CHECK_THROWS_WITH(JointSignals<Q2d>({{"tool_link", StepSignal{}}}), Contains("'tool_link'"));
  const std::vector<JointSignal> three(3, {shoulder, StepSignal{}});
  CHECK_THROWS_WITH((JointSignals<Q2d, 2>(three)), Contains("3") && Contains("capacity, 2"));
  CHECK_NOTHROW(JointSignals<Q2d, 3>(three));
  CHECK_NOTHROW(JointSignals<Q2d>(std::vector<JointSignal>()));
  CHECK_THROWS_WITH(JointSignals<Q2d>(three, {{0, 2}}), Contains("'elbow_active_joint'"));
  CHECK_THROWS_WITH(JointSignals<Q2d>(three, {{0, 0}, {not_a_number, 0}}), Contains("not finite"));
}

TEST_CASE("a set-point is what it says, or refused by name") {
  const SetPoint<Q2d> pose({-1, 1});
  CHECK(pose.sample(0).position == JointVector<2>(-1, 1));
  CHECK(pose.sample(7).velocity.isZero(0));
  CHECK_THROWS_WITH(SetPoint<Q2d>({-1, 1.6}),
                    Contains("'elbow_active_joint'") && Contains("1.6") && Contains("1.5708"));
  CHECK_THROWS_WITH(SetPoint<Q2d>({not_a_number, 0}), Contains("'shoulder_active_joint'"));
}
