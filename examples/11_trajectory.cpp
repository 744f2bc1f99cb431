// SPDX-License-Identifier: Apache-2.0
// Trajectories with tolerances on the Q2D: one is followed, one replaced on the way, one aborted.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

#include <cstdio>
#include <cstdlib>

using namespace articula;

namespace {

using Q2dLoop = Loop<Q2dSim, PidPlusGravity>;
using Follower = TrajectoryFollower<Q2d>;

/// Follows the trajectory for a number of cycles and prints the outcome.
void follow(const Trajectory<Q2d>& trajectory, const TrajectoryTolerances<2>& tolerances,
            Q2dLoop& loop, Follower& follower, int cycles) {
  if (follower.start(trajectory, tolerances) != TrajectoryOutcome::active) std::exit(1);
  for (int k = 0; k < cycles; ++k) {
    loop.reference() = follower.sample(loop.next_time());
    if (loop.update() != Status::ok) std::exit(1);
    follower.check(loop.state());
  }
  std::printf("%.1f s: %s at (%.2f, %.2f) rad\n", loop.next_time(),
              to_string(follower.outcome()).data(), loop.state().position[0],
              loop.state().position[1]);
}

}  // namespace

int main() {
  const JointVector<2> still(0, 0);
  const Trajectory<Q2d> there(
      {{.time_from_start = 1, .position = {-0.5, 0.5}, .velocity = JointVector<2>(-0.8, 0.8)},
       {.time_from_start = 2, .position = {-1, 1}, .velocity = still}});
  const Trajectory<Q2d> back({{.time_from_start = 2, .position = {0, 0}, .velocity = still}});

  // The limits of stops, and of the way into a trajectory that replaces another one.
  const MotionLimits<2> limits = motion_limits(Q2d(), {10, 30}, {200, 600});  // rad/s^2, rad/s^3
  const TrajectoryTolerances<2> wide{
      .path_position = {0.1, 0.1}, .goal_position = {0.01, 0.01}, .goal_time = 0.5};
  const TrajectoryTolerances<2> tight{.path_position = {0.002, 0.002}};  // too tight for the PID

  Q2dLoop loop;
  Follower follower(loop.state().position, limits);
  follow(there, wide, loop, follower, 3000);  // 3.0 s: successful at (-1.00, 1.00) rad
  follow(back, wide, loop, follower, 1000);   // 4.0 s: active at (-0.50, 0.50) rad
  follow(there, wide, loop, follower, 3000);  // 7.0 s: successful at (-1.00, 1.00) rad
  follow(back, tight, loop, follower, 3000);
  // 10.0 s: path tolerance violated at (-1.00, 0.99) rad: it stopped, and holds
}
