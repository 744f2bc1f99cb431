// SPDX-License-Identifier: Apache-2.0
// A loop with gains and update rate from the YAML files of a course.
#include <articula/articula.hpp>
#include <articula/config/load_controller_manager.hpp>
#include <articula/config/load_pid_gains.hpp>
#include <articula/robots/q2d.hpp>

#include <cstdio>

#include "beside.hpp"

using namespace articula;

int main() try {
  const ControllerManagerConfig manager = load_controller_manager(beside("q2d_controllers.yaml"));
  const PidConfig<2> config = load_pid_gains(Q2d(), beside("pid_plus_gravity.yaml"));
  for (const std::string& note : config.notes) std::printf("%s\n", note.c_str());

  Loop<Q2dSim, PidPlusGravity> loop(Q2dSim({.period = manager.period()}),
                                    PidPlusGravity<Q2d>(config.gains));
  std::printf("%s at %g Hz, gravity %g m/s^2, priority %d\n", config.name.c_str(),
              manager.update_rate, config.gravity->z, config.priority.value_or(0));

  loop.reference().position = {-1.0, 1.0};  // rad
  while (loop.time() < 2) {
    if (loop.update() != Status::ok) return 1;
  }
  std::printf("(%.3f, %.3f) rad\n", loop.state().position[0], loop.state().position[1]);

  // A file for another robot is an error with file, line and column.
  return static_cast<int>(
      load_pid_gains(Q2d(), ConfigSource::text("joint: elbow", "slip")).gains.size());
} catch (const FileError& error) {
  std::printf("%s\n", error.what());
}
// pid_plus_gravity_controller at 1000 Hz, gravity -9.8 m/s^2, priority 99
// (-1.000, 1.000) rad
// slip:1:8: joint: robot 'q2d' has no joint 'elbow', expected one of
// shoulder_active_joint, elbow_active_joint
