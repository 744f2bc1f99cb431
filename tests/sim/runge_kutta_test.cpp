// SPDX-License-Identifier: Apache-2.0
// The order of the integration, and what free motion conserves.
#include <articula/dynamics/mass_matrix.hpp>
#include <articula/sim/simulator.hpp>

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "robots/energy.hpp"
#include "robots/test_robots.hpp"

using namespace articula;

namespace {

using Sim = Simulator<Model<2>>;

/// A free arm, thrown: by default so that its elbow turns by several radians in half a second.
Sim thrown(const Model<2>& arm, double period, const JointVector<2>& velocity = {6, -15}) {
  SimulatorOptions<2> options{.period = period};
  options.initial_position = {0.2, 0.7};
  options.initial_velocity = velocity;
  return Sim(arm, options);
}

/// Half a second of a constant push, with `look` at the simulator after each period.
template <class Look>
void half_second(Sim& simulator, const JointVector<2>& push, const Look& look) {
  const auto periods = std::lround(0.5 / simulator.period());
  for (long k = 0; k < periods; ++k) {
    static_cast<void>(simulator.write({push}));
    look(simulator);
  }
}

/// How far a quantity strays from its value at the start while the arm moves freely.
template <class Quantity>
double largest_drift(const Model<2>& arm, double period, const Quantity& quantity) {
  Sim simulator = thrown(arm, period);
  const double start = quantity(simulator);
  double largest = 0;
  half_second(simulator, {0, 0}, [&](const Sim& now) {
    largest = std::max(largest, std::abs(quantity(now) - start));
  });
  return largest;
}

double distance(const JointState<2>& a, const JointState<2>& b) {
  return std::hypot((a.position - b.position).norm(), (a.velocity - b.velocity).norm());
}

/// The first element of M v: the angular momentum about the shoulder's axis.
double momentum(const Sim& simulator) {
  const auto& state = simulator.true_state();
  return (mass_matrix(simulator.robot(), state.position) * state.velocity)[0];
}

// A fourth-order method: half the step leaves a sixteenth of the error, a little more or less, as
// terms of higher order fade.
constexpr double least_ratio = 15;

}  // namespace

TEST_CASE("a parabola is integrated exactly") {
  const JointState<1> start{JointVector<1>(1.0), JointVector<1>(2.0)};
  const auto end =
      runge_kutta_step<1>(start, 0.5, [](const auto&, const auto&) { return JointVector<1>(4.0); });
  CHECK(end.position[0] == 1 + 2 * 0.5 + 4 * 0.25 / 2);
  CHECK(end.velocity[0] == 2 + 4 * 0.5);
}

TEST_CASE("one step of an oscillation is its Taylor polynomial of fourth order") {
  const JointState<1> start{JointVector<1>(1.0), JointVector<1>(0.0)};
  const double h = 0.25;
  const auto end =
      runge_kutta_step<1>(start, h, [](const auto& q, const auto&) { return JointVector<1>(-q); });
  const double rounding = 1e-15;
  CHECK(end.position[0] == Approx(1 - h * h / 2 + h * h * h * h / 24).epsilon(rounding));
  CHECK(end.velocity[0] == Approx(-h + h * h * h / 6).epsilon(rounding));
}

TEST_CASE("half the step leaves a sixteenth of the error") {
  const auto end = [](double period) {
    Sim simulator = thrown(support::free_arm(), period, {3, -5});
    half_second(simulator, {0.4, -0.2}, [](const Sim&) {});
    return simulator.true_state();
  };
  const auto truth = end(0.5 / 1024);  // 8 times finer than the finer one: 1/4096 of its error
  const double coarse = distance(end(0.5 / 64), truth), fine = distance(end(0.5 / 128), truth);
  CAPTURE(coarse, fine);
  CHECK(fine > 1e-9);  // far above rounding
  CHECK(coarse / fine >= least_ratio);
}

TEST_CASE("energy is conserved without damping, and its drift falls with the fourth order") {
  const Model<2> level = support::free_arm(), tilted = support::free_arm<support::TiltedQ2d>();
  for (const Model<2>& arm : {level, tilted}) {
    CAPTURE(arm.name.view());
    const auto drift = [&](double period) {
      return largest_drift(arm, period, support::energy<Model<2>>);
    };
    const double coarse = drift(0.5 / 128), fine = drift(0.5 / 256);
    CAPTURE(coarse, fine);
    CHECK(fine > 1e-10);  // far above rounding
    CHECK(coarse / fine >= least_ratio);
    CHECK(drift(0.5 / 2048) < 1e-9);  // of some 7 J
  }
}

TEST_CASE("momentum is conserved, and its drift falls with the fourth order") {
  const Model<2> arm = support::free_arm();
  const double coarse = largest_drift(arm, 0.5 / 128, momentum);
  const double fine = largest_drift(arm, 0.5 / 256, momentum);
  CAPTURE(coarse, fine);
  CHECK(fine > 1e-10);
  CHECK(coarse / fine >= least_ratio);
  CHECK(largest_drift(arm, 0.5 / 2048, momentum) < 1e-9);  // of about 1 N m s
}

TEST_CASE("the drives' work is all the energy there is") {
  Sim simulator = thrown(support::free_arm<support::TiltedQ2d>(), 1e-4);
  for (int k = 0; k < 2000; ++k) {
    CAPTURE(k);
    // The energy drifts by less than 1e-9 in the 2000 steps of the test before, each 2.5 times
    // longer; what is left is the rounding of some 10 J.
    CHECK(std::abs(support::unearned_energy(simulator, {std::sin(0.02 * k), -0.3})) < 1e-12);
  }
}
