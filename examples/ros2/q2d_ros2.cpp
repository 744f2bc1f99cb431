// SPDX-License-Identifier: Apache-2.0
// The Q2D as ROS 2 sees a robot under a controller_manager: `ros2 topic echo /joint_states`, `ros2
// control list_controllers`, `ros2 param set`, trajectories from MoveIt. Controllers and parameters
// have the names of the course. This program links no ROS. ROS_DOMAIN_ID names the domain, as for
// ROS programs. Ctrl-C ends the program.
#include <articula/articula.hpp>
#include <articula/loop/realtime/monotonic_clock.hpp>
#include <articula/loop/realtime/stop_on_signal.hpp>
#include <articula/remote/remote.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/ros2/bridge/bridge.hpp>
#include <articula/ros2/dds/domain_id.hpp>

#include <cstdio>
#include <exception>

using namespace articula;

template <class R>
using Controllers = Switch<R, Bypass<R>, PidPlusGravity<R>, ComputedTorque<R>>;

int main() try {
  ros2::BridgeOptions options{.distribution = ros2::Distribution::jazzy};
  options.dds.domain = ros2::domain_id();
  options.gain_prefix = "";  // `ros2 param set` names a gain shoulder_active_joint.p
  options.controllers["group_bypass"].type = "effort_controllers/JointGroupEffortController";

  // `overruns` tolerates the overruns of a desktop machine; omit it for an arm.
  SupervisedLoop<Q2dSim, Controllers> arm(
      Q2dSim(),
      Controllers<Q2d>(
          {.names = {"group_bypass", "pid_plus_gravity_controller", "computed_torque_controller"}}),
      SupervisionOptions{.overruns = 1000});
  arm.request_activation();  // in a simulation nobody can be hurt
  Remote remote(arm);
  const ros2::Bridge bridge(remote, options);

  std::printf("ROS 2 programs on this host see the Q2D in domain %u. Ctrl-C ends the program.\n",
              options.dds.domain);
  std::fflush(stdout);
  StopFlag stop;
  const StopOnSignal on_signal(stop);
  MonotonicClock clock;
  remote.run(clock, {.stop = &stop});
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
