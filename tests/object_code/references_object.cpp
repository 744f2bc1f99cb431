// SPDX-License-Identifier: Apache-2.0
#include <articula/reference/jerk_limited_profile.hpp>
#include <articula/reference/joint_signals.hpp>
#include <articula/reference/state_to_state_profile.hpp>
#include <articula/reference/trajectory/trajectory_follower.hpp>
#include <articula/robots/q2d.hpp>

using namespace articula;

JointReference<2> sample(const JointSignals<Q2d>& signals, double time) noexcept {
  return signals.sample(time);
}

JointReference<2> sample(const JerkLimitedProfile<Q2d>& profile, double time) noexcept {
  return profile.sample(time);
}

JointReference<2> plan(const JointReference<2>& from, const JointReference<2>& to,
                       const JointArray<MotionBounds, 2>& limits, double time) noexcept {
  const auto profile = StateToStateProfile<Q2d>::plan(from, to, limits, 1.0);
  return profile ? profile->sample(time) : from;
}

JointReference<2> cycle(TrajectoryFollower<Q2d>& follower, const JointState<2>& state,
                        double time) noexcept {
  follower.check(state);
  return follower.sample(time);
}

TrajectoryOutcome replace(TrajectoryFollower<Q2d>& follower, const Trajectory<Q2d>& trajectory,
                          double time) noexcept {
  follower.cancel();
  return follower.start(trajectory, {}, time);
}
