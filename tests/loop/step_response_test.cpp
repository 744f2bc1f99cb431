// SPDX-License-Identifier: Apache-2.0
// The controllers on the Q2D reach their target. Bounds come from the design of each controller.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

#include <algorithm>

#include "catch.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using support::TiltedQ2d;

namespace {

using Vector = JointVector<2>;

/// What a step from `start` to `target` shows.
struct StepResponse {
  Vector error;                    ///< at the end, absolute
  double overshoot;                ///< the largest, in parts of the step
  double peak_effort;              ///< the largest, in parts of the limit
  JointVector<2> cycles_at_limit;  ///< whose command is the drive's limit
  bool always_ok;
};

template <class R, template <class> class Controller>
StepResponse step(const Vector& start, const Vector& target, double seconds) {
  SimulatorOptions<2> options;
  options.initial_position = start;
  Loop<Simulator<R>, Controller> loop{Simulator<R>(options)};
  loop.reference().position = target;
  StepResponse response{
      .error = {}, .overshoot = 0, .peak_effort = 0, .cycles_at_limit = {0, 0}, .always_ok = true};
  while (loop.time() < seconds) {
    response.always_ok = response.always_ok && loop.update() == Status::ok;
    const Vector beyond = (loop.state().position - target).cwiseQuotient(target - start);
    response.overshoot = std::max(response.overshoot, beyond.maxCoeff());
    const Vector effort = loop.command().effort.cwiseAbs().cwiseQuotient(effort_limits(R()));
    response.peak_effort = std::max(response.peak_effort, effort.maxCoeff());
    response.cycles_at_limit += (effort.array() >= 1).cast<double>().matrix();
  }
  response.error = (loop.state().position - target).cwiseAbs();
  return response;
}

}  // namespace

TEST_CASE("the PIDs make a small step") {
  for (const auto& response : {step<Q2d, Pid>({-0.01, -0.01}, {0.01, 0.01}, 5),
                               step<Q2d, PidPlusGravity>({-0.01, -0.01}, {0.01, 0.01}, 5)}) {
    CHECK(response.always_ok);
    CHECK(response.peak_effort <= 1);
    // The shoulder alone, 0.3 kg m^2 under p = 2310 and a damping of 30, is damped to 0.57 of the
    // critical: 11 % overshoot, and the integral and the other joint add to it.
    CHECK(response.overshoot < 0.25);
    CHECK(response.error.maxCoeff() < 1e-4);  // what exp(-2 t) leaves of the overshoot after 5 s
    // 2310 N m/rad times 0.02 rad are 46 N m, more than the shoulder's 27.94; docs/tuning.md.
    CHECK(response.cycles_at_limit == Vector(16, 0));
  }
}

TEST_CASE("the PIDs make a large step at the limit of the drives, without winding up") {
  for (const auto& response :
       {step<Q2d, Pid>({0, 0}, {-1, 1}, 8), step<Q2d, PidPlusGravity>({0, 0}, {-1, 1}, 8)}) {
    CHECK(response.always_ok);
    CHECK(response.peak_effort == 1);
    CHECK(response.overshoot < 0.02);  // an integral wound up to its clamp would bring some 10 %
    CHECK(response.error.maxCoeff() < 1e-3);
  }
}

TEST_CASE(
    "a tilted arm sags until the integral carries it, or not at all with gravity compensation") {
  const Vector place(0.6, 0.6);
  SimulatorOptions<2> options;
  options.initial_position = place;
  Loop<Simulator<TiltedQ2d>, Pid> without{Simulator<TiltedQ2d>(options)};
  Loop<Simulator<TiltedQ2d>, PidPlusGravity> with{Simulator<TiltedQ2d>(options)};
  double sag = 0, motion = 0;
  while (with.time() < 8) {
    REQUIRE(without.update() == Status::ok);
    REQUIRE(with.update() == Status::ok);
    sag = std::max(sag, (without.state().position - place).cwiseAbs().maxCoeff());
    motion = std::max(motion, (with.state().position - place).cwiseAbs().maxCoeff());
  }
  CHECK(sag > 5e-4);      // some N m on a spring of p
  CHECK(motion < 1e-12);  // rounding
  CHECK((without.state().position - place).cwiseAbs().maxCoeff() < 1e-6);  // exp(-2 t) of it
}

TEST_CASE("computed torque makes a small step as critically damped as it is told") {
  for (const auto& response : {step<Q2d, ComputedTorque>({-0.01, -0.01}, {0.01, 0.01}, 1),
                               step<TiltedQ2d, ComputedTorque>({-0.01, -0.01}, {0.01, 0.01}, 1)}) {
    CHECK(response.always_ok);
    CHECK(response.peak_effort < 1);
    CHECK(response.overshoot < 0.01);         // critical damping has none, the hold a little
    CHECK(response.error.maxCoeff() < 1e-8);  // (1 + 20) exp(-20) of 0.02 rad is 1e-9
  }
}

TEST_CASE("computed torque makes a large step through saturation") {
  const auto response = step<Q2d, ComputedTorque>({0, 0}, {-1, 1}, 5);
  CHECK(response.always_ok);
  CHECK(response.peak_effort == 1);
  CHECK(response.error.maxCoeff() < 1e-6);
}

TEST_CASE("open-loop torque ends in the speed at which damping takes it all") {
  Loop<Q2dSim, Bypass> loop;
  loop.reference().effort = {1, 1};
  while (loop.time() < 3) REQUIRE(loop.update() == Status::ok);
  CHECK(loop.state().velocity[0] == Approx(1 / 29.7914).epsilon(0.01));
  CHECK(loop.state().velocity[1] == Approx(1 / 2.6404).epsilon(0.01));
}
