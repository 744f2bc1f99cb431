// SPDX-License-Identifier: Apache-2.0
// The reference that trajectories plan is the one that the loop then makes.
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "remote/remote_arm.hpp"

using namespace articula;
using namespace articula::remote;
using support::elbow;
using support::RemoteArm;
using support::shoulder;
using support::SupervisedArm;

namespace {

using Motions = std::vector<std::optional<JointMotion>>;

bool done(const Answer& answer) { return answer.verdict == support::Verdict::done; }

/// The Q2D with an elbow that turns without end.
struct Turning {
  static constexpr auto description = [] {
    auto own = Q2d::description;
    for (Joint& joint : own.joints) {
      if (joint.name != Name("elbow_active_joint")) continue;
      joint.type = JointType::continuous;
      joint.limits.lower = -std::numeric_limits<double>::infinity();
      joint.limits.upper = std::numeric_limits<double>::infinity();
    }
    return own;
  }();
  static constexpr auto pid_gains = Q2d::pid_gains;
};

/// Activates an arm whose joints are at rest.
template <class Arm>
void activate(Arm& arm) {
  REQUIRE(done(arm.ask(Activate{})));
  arm.cycles(10);
}

/// What is planned for some cycles after the last one.
template <class Arm>
Motions planned(Arm& arm, int cycles) {
  return arm.remote.planned(arm.loop.time() + cycles * arm.loop.period());
}

/// Whether a joint's present reference is what was planned for it, but for the rounding of times.
template <class Arm>
void check(Arm& arm, const Motions& plan, int joint, double rounding = 1e-10) {
  const auto& reference = std::as_const(arm.loop).reference();
  const auto& motion = plan.at(static_cast<std::size_t>(joint));
  REQUIRE(motion);
  CHECK(std::abs(motion->position - reference.position[joint]) < rounding);
  CHECK(std::abs(motion->velocity - reference.velocity[joint]) < rounding);
  CHECK(std::abs(motion->acceleration - reference.acceleration[joint]) < rounding);
}

}  // namespace

TEST_CASE("a trajectory is planned as it is followed then") {
  SupervisedArm arm;
  activate(arm);
  arm.session->ask(
      PlayTrajectory{{{shoulder},
                      {{.time_from_start = 0.4, .positions = {0.2}, .velocities = {0.7}},
                       {.time_from_start = 1, .positions = {0.5}, .velocities = {0}}}}});
  arm.cycles(200);
  for (const int ahead : {0, 1, 17, 300, 300}) {
    CAPTURE(ahead);
    const Motions plan = planned(arm, ahead);
    arm.cycles(ahead);
    CHECK(plan[0]->velocity > 0.1);
    CHECK(plan[0]->acceleration != 0);
    check(arm, plan, 0);
    check(arm, plan, 1);  // at rest
  }
  // It ends at rest.
  const Motions end = planned(arm, 2000);
  CHECK(end[0]->position == 0.5);
  CHECK(end[0]->velocity == 0);
  CHECK(planned(arm, -2)[0]->position == planned(arm, 0)[0]->position);  // the present
  CHECK_FALSE(arm.remote.planned(std::numeric_limits<double>::infinity())[0]);
}

TEST_CASE("a trajectory at another speed is planned at that speed, also while it changes") {
  SupervisedArm arm;
  activate(arm);
  arm.session->ask(
      PlayTrajectory{{{shoulder, elbow},
                      {{.time_from_start = 2, .positions = {0.5, -0.3}, .velocities = {0, 0}}}}});
  arm.cycles(100);
  REQUIRE(done(arm.ask(SetTrajectorySpeed{0.4})));
  for (const int ahead : {0, 10, 150, 400}) {  // the speed takes 0.3 s
    CAPTURE(ahead);
    const Motions plan = planned(arm, ahead);
    arm.cycles(ahead);
    CHECK(plan[0]->acceleration != 0);
    check(arm, plan, 0);
    check(arm, plan, 1);
  }
}

TEST_CASE("trajectories of different joints are planned each, also if one begins in motion") {
  SupervisedArm arm;
  activate(arm);
  arm.session->ask(PlayTrajectory{
      {{shoulder}, {{.time_from_start = 1, .positions = {0.5}, .velocities = {0}}}}});
  arm.cycles(200);
  arm.session->ask(
      PlayTrajectory{{{elbow}, {{.time_from_start = 1, .positions = {-0.4}, .velocities = {0}}}}});
  arm.cycles(100);
  arm.session->ask(PlayTrajectory{
      {{shoulder}, {{.time_from_start = 0.9, .positions = {0.1}, .velocities = {0}}}}});
  arm.cycles(50);
  for (const int ahead : {1, 100, 400}) {
    CAPTURE(ahead);
    const Motions plan = planned(arm, ahead);
    arm.cycles(ahead);
    check(arm, plan, 0);
    check(arm, plan, 1);
  }
}

TEST_CASE("other motions, trajectories that wait and loops that are not active plan nothing") {
  SupervisedArm arm;
  CHECK_FALSE(planned(arm, 10)[0]);
  activate(arm);
  CHECK(planned(arm, 10)[0]);
  REQUIRE(done(arm.ask(Go{{{elbow, 0.4}}})));
  arm.cycles(20);
  CHECK(planned(arm, 10)[0]);
  CHECK_FALSE(planned(arm, 10)[1]);
  arm.session->ask(PlayTrajectory{
      .trajectory = {{shoulder}, {{.time_from_start = 1, .positions = {0.5}}}}, .delay = 0.1});
  arm.cycles(20);
  CHECK_FALSE(planned(arm, 10)[0]);
  arm.cycles(100);
  CHECK(planned(arm, 10)[0]);
  REQUIRE(done(arm.ask(Stop{})));
  arm.cycles(2);
  CHECK_FALSE(planned(arm, 10)[0]);
  // A trajectory that another motion has ended says nothing any more.
  arm.session->ask(PlayTrajectory{{{shoulder}, {{.time_from_start = 1, .positions = {0.1}}}}});
  arm.cycles(20);
  arm.session->ask(Go{{{shoulder, 0.3}}});
  arm.cycles(1);
  CHECK_FALSE(planned(arm, 10)[0]);
  REQUIRE(done(arm.ask(Deactivate{})));
  CHECK_FALSE(planned(arm, 10)[0]);
}

TEST_CASE("a reference that the program of a plain loop moves is not planned") {
  support::PlainArm arm;
  arm.cycles(10);
  CHECK(planned(arm, 10)[0]);
  arm.loop.reference().velocity[0] = 0.1;
  arm.cycles(2);
  CHECK_FALSE(planned(arm, 10)[0]);
  CHECK(planned(arm, 10)[1]);
}

TEST_CASE("a continuous joint is planned on its own turn") {
  SimulatorOptions<2> simulation;
  const double turns = 6 * std::numbers::pi;
  simulation.initial_position = JointVector<2>(0, turns);
  RemoteArm<SupervisedLoop<Simulator<Turning>, PidPlusGravity>> arm({},
                                                                    Simulator<Turning>(simulation));
  activate(arm);
  arm.session->ask(PlayTrajectory{{{elbow}, {{.time_from_start = 1, .positions = {0.2}}}}});
  arm.cycles(100);
  const Motions plan = planned(arm, 300);
  arm.cycles(300);
  CHECK(plan[1]->position > turns);
  check(arm, plan, 1);
}
