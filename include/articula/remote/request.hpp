// SPDX-License-Identifier: Apache-2.0
/// @file The requests of programs outside the loop.
#pragma once

#include "articula/reference/joint_signals.hpp"
#include "articula/reference/trajectory/named_trajectory.hpp"
#include "articula/reference/trajectory/trajectory_outcome.hpp"
#include "articula/remote/gains/parameter.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace articula::remote {

/// A number for a joint.
struct JointValue {
  std::string joint{};
  double value = 0;
};

/// A signal on a joint.
struct NamedSignal {
  std::string joint{};
  Signal signal{};
  SignalTarget target = SignalTarget::position;
};

/// Activates a supervised loop.
struct Activate {};
/// Deactivates a supervised loop.
struct Deactivate {};
/// Acknowledges the fault of a supervised loop, which then is inactive.
struct AcknowledgeFault {};

// A request for motion moves the joints that it names. Others go on with what they do: the arm
// follows a trajectory while a request opens the gripper. A trajectory, and signals, end as a
// whole: if another request takes one of their joints, their other joints stop.

/// Moves the reference of some joints along a jerk-limited profile. Joints that are still on their
/// way by a request of this kind arrive together with them, at the new speed. Its answer comes when
/// the motion has begun.
struct Go {
  std::vector<JointValue> positions{};  ///< [rad or m]
  double speed = 1;                     ///< share of the velocity limits, 0.01 .. 1
};

/// Sets the reference of some joints at once, for references that another program computes.
/// Velocities and efforts that are not set are 0.
struct SetReference {
  std::vector<JointValue> positions{};   ///< [rad or m]
  std::vector<JointValue> velocities{};  ///< [rad/s or m/s]
  std::vector<JointValue> efforts{};     ///< [N m or N]
};

/// How far a joint may be from a trajectory. 0: as configured, -1: any distance.
struct NamedTolerance {
  std::string joint{};
  double position = 0;  ///< [rad or m]
  double velocity = 0;  ///< [rad/s or m/s]
};

/// Follows a trajectory from the present reference. Its answer comes when the trajectory has ended.
/// Up to four trajectories can be followed at once, each by joints of its own.
struct PlayTrajectory {
  NamedTrajectory trajectory{};
  std::vector<NamedTolerance> path_tolerances{};  ///< before the end
  std::vector<NamedTolerance> goal_tolerances{};  ///< at the end
  double goal_time =
      0;  ///< time to arrive after the last point [s]; 0: as configured, -1: unlimited
  /// When it begins, after the request has come to the loop [s]. Until then a trajectory of the
  /// same joints goes on; any other motion of theirs stops. Negative: the points before are
  /// skipped. Without it, the trajectory begins at once.
  std::optional<double> delay{};
};

/// How fast trajectories are followed, the present one and later ones. It holds until the next
/// request of this kind. Tolerances of time are in the trajectory's time.
struct SetTrajectorySpeed {
  double factor = 1;  ///< 0 (pause) .. 1 (as planned)
};

/// Adds signals to the present reference for a time. Then the reference moves back to where it was.
/// The answer comes when the signals have ended. One request of this kind replaces the other.
struct PlaySignals {
  std::vector<NamedSignal> signals{};
  double duration = 0;  ///< [s]
};

/// Ends motions of the reference by the fastest stop within the limits. Trajectories and signals of
/// which a joint stops end as a whole.
struct Stop {
  std::vector<std::string>
      joints{};  ///< that stop; empty: all, also those of requests on their way
};

/// Starts and stops controllers.
struct SwitchControllers {
  std::vector<std::string> start{};
  std::vector<std::string> stop{};
  bool best_effort = false;  ///< do what can be done, instead of all or nothing
  bool replace = false;      ///< stop what is active on the same joints
};

/// Sets gains, all or none of them.
struct SetParameters {
  std::vector<ParameterValue> values{};
};

/// Simulations: stops or continues the simulated time.
struct Pause {
  bool paused = true;
};
/// Simulations: makes some cycles while the time is stopped.
struct Step {
  int cycles = 1;
};
/// Simulations: the simulated time that passes in a second.
struct SetSpeed {
  double factor = 1;  ///< 0.01 .. 100
};
/// Simulations: puts the robot at rest into a position. Joints that are not listed are at 0, or at
/// the limit next to it.
struct Reset {
  std::vector<JointValue> positions{};  ///< [rad or m]
};
/// Simulations: a force on a point that is fixed to a link, until the next one. 0 ends it, and so
/// does the end of the session that asked for it.
struct Pull {
  std::string link{};
  std::array<double, 3> point{};  ///< in the link's frame [m]
  std::array<double, 3> force{};  ///< in the root link's frame [N]
};

/// Any of them.
using Request = std::variant<Activate, Deactivate, AcknowledgeFault, Go, SetReference,
                             PlayTrajectory, PlaySignals, Stop, SwitchControllers, SetParameters,
                             Pause, Step, SetSpeed, Reset, Pull, SetTrajectorySpeed>;

/// What has become of a request.
enum class Verdict : unsigned char {
  done,       ///< It is done.
  refused,    ///< It changed nothing; the text says why.
  failed,     ///< It was begun and did not come to its end; the text says why.
  timed_out,  ///< The loop did not take it in time, and will not do it any more.
};

/// The answer to the request of a number.
struct Answer {
  unsigned long long request = 0;
  Verdict verdict = Verdict::done;
  std::string text{};  ///< the reason of a refusal, or the outcome, as "goal reached"
  /// Of a trajectory, if it began or was refused for what it is; otherwise idle.
  TrajectoryOutcome outcome = TrajectoryOutcome::idle;
  unsigned long long cycle = 0;  ///< of the loop: the first one after it began the request; 0: none
};

}  // namespace articula::remote
