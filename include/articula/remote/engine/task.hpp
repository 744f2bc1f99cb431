// SPDX-License-Identifier: Apache-2.0
/// @file Requests in the form in which a loop takes them: checked, of fixed size.
#pragma once

#include "articula/control/switching/switch_request.hpp"
#include "articula/core/status.hpp"
#include "articula/dynamics/forward_kinematics.hpp"
#include "articula/loop/exchange/latest_value.hpp"
#include "articula/recording/loop_change.hpp"
#include "articula/remote/engine/trajectory_clock.hpp"
#include "articula/remote/gains/gain_change.hpp"
#include "articula/remote/motion/reference_source.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace articula::remote {

/// What a loop is asked to do.
namespace task {

struct Activate {};
struct Deactivate {};
struct Acknowledge {};
template <int N>
struct Go {
  JointVector<N> target;  ///< [rad or m]; NaN for joints that have none
  double speed = 1;
};
template <int N>
struct Set {
  JointSetting<N> setting{};
};
template <Robot R>
struct Follow {
  /// Not null. It is large, and other tasks are not.
  std::unique_ptr<const Trajectory<R, trajectory_capacity>> trajectory;
  TrajectoryTolerances<articula::joint_count<R>> tolerances{
      .stopped_velocity =
          JointVector<articula::joint_count<R>>::Zero()};  ///< as `overridden` reads them
  std::optional<double> delay{};                           ///< [s]
  std::string note{};  ///< what the log shall say of it; empty: nothing
};
template <Robot R>
struct Play {
  JointArray<bool, articula::joint_count<R>> joints;  ///< that have signals
  JointSignals<R> signals;
  double duration = 0;  ///< [s]
};
struct Stop {};  ///< of all joints; it overtakes other tasks
template <int N>
struct StopJoints {
  JointArray<bool, N> joints{};
};
struct Switch {
  SwitchRequest request{};
  SwitchOutcome outcome{};  ///< filled in by the loop
};
struct SetGains {
  std::vector<std::unique_ptr<GainChange>> changes{};
  std::vector<GainSetting> settings{};  ///< the same by their names, for recordings
};
struct Pause {
  bool paused = true;
};
struct Step {
  int cycles = 1;
};
struct SetSpeed {
  double factor = 1;
};
template <int N>
struct Place {
  JointVector<N> position;  ///< [rad or m]
};
struct Pull {
  LinkIndex link{};
  Eigen::Vector3d point{0, 0, 0};  ///< in the link's frame [m]
  Eigen::Vector3d force{0, 0, 0};  ///< in the root link's frame [N]
};

struct SetTrajectorySpeed {
  double factor = 1;
};

}  // namespace task

/// What has become of a task.
enum class TaskEnd : unsigned char {
  open,              ///< It has not ended.
  done,              ///< It is done.
  expired,           ///< It came to the loop too late, which ignored it.
  outdated,          ///< An earlier change of the same gains was not done.
  operator_lost,     ///< Its operator was lost before the loop began it.
  not_active,        ///< The loop is not active; Task::status is its fault, if it is in one.
  in_fault,          ///< The loop is in fault: Task::status.
  no_fault,          ///< There is no fault to acknowledge.
  bad_reference,     ///< The present reference has a number that is not finite.
  refused,           ///< A trajectory: Task::outcome and Task::refusal.
  not_paused,        ///< Single steps are for paused simulations.
  replaced,          ///< Another request has taken its place, or one of its joints.
  stopped,           ///< A stop has ended it, or the loss of its operator.
  reset,             ///< The simulated robot was put elsewhere.
  failed,            ///< A trajectory: Task::outcome.
  loop_left_active,  ///< The loop became inactive, or went into the fault Task::status.
};

/// Tasks that the loop has not given back.
inline constexpr std::size_t most_tasks = 64;

/// A request on its way through the loop. The outside owns it, and leaves it alone until the loop
/// has given it back.
template <Robot R>
struct Task {
  static constexpr int joint_count = articula::joint_count<R>;
  using Wish = std::variant<task::Activate, task::Deactivate, task::Acknowledge,
                            task::Go<joint_count>, task::Set<joint_count>, task::Follow<R>,
                            task::Play<R>, task::Stop, task::Switch, task::SetGains, task::Pause,
                            task::Step, task::SetSpeed, task::Place<joint_count>, task::Pull,
                            task::SetTrajectorySpeed, task::StopJoints<joint_count>>;

  explicit Task(Wish own_wish) : wish(std::move(own_wish)) {}

  /// Of tasks that do not depend on who operates.
  static constexpr std::uint64_t no_operator = std::numeric_limits<std::uint64_t>::max();

  std::uint64_t number = 0;          ///< in the order in which they are handed over, from 1
  std::uint64_t sign = no_operator;  ///< the last sign of life of its operator, see OperatorWatch
  Wish wish;
  /// Set by whoever is first: the loop that begins the task, or the outside that gives it up.
  std::atomic<bool> claimed = false;
  // Of a trajectory, while the loop follows it:
  LatestValue<TrajectoryClock> clock{};    ///< from the loop for the outside
  TrajectoryBridge<joint_count> bridge{};  ///< into it; the loop sets it before the clock runs
  bool has_begun = false;                  ///< the bridge is set; for the loop
  // Filled in by the loop before it gives the task back:
  TaskEnd end = TaskEnd::open;
  std::uint64_t cycle = 0;  ///< the first one after the loop began it
  Status status = Status::ok;
  TrajectoryOutcome outcome = TrajectoryOutcome::idle;
  TrajectoryRefusal refusal{};
  JointArray<bool, joint_count> unfollowed{};  ///< that no controller moves to the positions
};

}  // namespace articula::remote
