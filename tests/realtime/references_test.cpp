// SPDX-License-Identifier: Apache-2.0
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/loop/loop.hpp>
#include <articula/reference/jerk_limited_profile.hpp>
#include <articula/reference/joint_signals.hpp>
#include <articula/reference/set_point.hpp>
#include <articula/reference/state_to_state_profile.hpp>
#include <articula/reference/trajectory/trajectory_follower.hpp>
#include <articula/robots/q2d.hpp>

#include "allocation_guard.hpp"
#include "catch.hpp"

using namespace articula;
using articula::testing::heap_calls_in;
using enum TrajectoryOutcome;

namespace {

const MotionLimits<2> limits{{2, 10}, {20, 50}, {400, 1000}};
using Vector = JointVector<2>;

}  // namespace

TEST_CASE("sampling does not touch the heap") {
  const SetPoint<Q2d> pose({0, 1});
  const JointSignals<Q2d> signals(
      {{"shoulder_active_joint", SineSignal{.amplitude = 0.5, .frequency = 1}},
       {"shoulder_active_joint", StepSignal{.height = 0.1, .start = 1}},
       {"elbow_active_joint", RampSignal{.height = 0.1, .duration = 1}},
       {"elbow_active_joint", SquareSignal{.amplitude = 1, .frequency = 2}, SignalTarget::effort},
       {"elbow_active_joint", ChirpSignal{.amplitude = 1, .last_frequency = 5},
        SignalTarget::effort}});
  const JerkLimitedProfile<Q2d> profile({0, 0}, {1, -1}, limits);
  const Trajectory<Q2d> trajectory(
      {{.time_from_start = 1, .position = {0, 0}}, {.time_from_start = 2, .position = {1, -1}}});
  SpeedOverride clock;
  double sum = 0;
  CHECK(heap_calls_in([&] {
          clock.set(0.5);
          for (int k = 0; k < 2500; ++k) {
            clock.advance(1e-3);
            const double t = clock.time();
            sum += pose.sample(t).position[1] + signals.sample(t).position[0] +
                   profile.sample(t).position[0] + trajectory.sample(t).position[0] +
                   clock.apply(signals.sample(t)).velocity[0];
          }
        }) == 0);
  CHECK(sum != 0);
}

TEST_CASE("planning a motion from the present one does not touch the heap") {
  const auto directed = both_ways(limits);
  JointReference<2> from;
  double sum = 0;
  CHECK(heap_calls_in([&] {
          for (int k = 0; k < 100; ++k) {
            const JointReference<2> to{{0.01 * k, -0.01 * k}, {0.1, 0.2}};
            const auto profile = StateToStateProfile<Q2d>::plan(from, to, directed, 0.1);
            from = profile->sample(0.05);
            sum += profile->duration();
          }
        }) == 0);
  CHECK(sum > 9);  // 100 durations of 0.1 s or more
}

TEST_CASE("following, replacing, canceling and aborting do not touch the heap") {
  Loop<Q2dSim, PidPlusGravity> loop;
  TrajectoryFollower<Q2d> follower(loop.state().position, limits,
                                   {.tolerances = {.path_position = {0.5, 0.5}}});
  const Trajectory<Q2d> there({{.time_from_start = 0.5, .position = {-0.5, 0.5}},
                               {.time_from_start = 1, .position = {-1, 1}}});
  const Trajectory<Q2d> back(
      {{.time_from_start = 1, .position = {0, 0}, .velocity = Vector(0, 0)}});
  int good = 0;
  const auto run = [&](int cycles) {
    for (int k = 0; k < cycles; ++k) {
      loop.reference() = follower.sample(loop.next_time());
      good += loop.update() == Status::ok;
      follower.check(loop.state());
    }
  };
  const Trajectory<Q2d> too_soon({{.time_from_start = 1e-3, .position = {0, 0}}});
  TrajectoryOutcome outcomes[6];
  TrajectoryRefusal refusals[2];
  CHECK(heap_calls_in([&] {
          outcomes[0] = follower.start(there);
          run(300);
          outcomes[4] = follower.start(there, {.path_velocity = {-1, 0}});
          refusals[0] = follower.refusal();
          outcomes[5] = follower.start(too_soon);
          refusals[1] = follower.refusal();
          outcomes[1] = follower.start(back, {.path_position = {1, 1}}, loop.time() + 0.2);
          run(600);
          follower.set_speed(0.5);
          run(100);
          follower.cancel();
          run(500);
          outcomes[2] = follower.start(there);
          run(200);
          outcomes[3] = follower.check({{9, 9}, {0, 0}, {0, 0}});
          run(500);
        }) == 0);
  CHECK(good == 2200);
  CHECK(outcomes[0] == active);
  CHECK(outcomes[1] == active);
  CHECK(outcomes[2] == active);
  CHECK(outcomes[3] == path_tolerance_violated);
  CHECK(outcomes[4] == invalid_goal);
  CHECK(refusals[0].what == "path_velocity");
  CHECK(outcomes[5] == invalid_goal);
  CHECK(refusals[1].joint == 0);
}
