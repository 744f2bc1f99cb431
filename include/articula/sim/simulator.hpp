// SPDX-License-Identifier: Apache-2.0
/// @file A simulated robot with the interface of hardware.
#pragma once

#include "articula/command/command_numbers.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/hardware.hpp"
#include "articula/dynamics/friction_effort.hpp"
#include "articula/model/robot.hpp"
#include "articula/sim/joint_dynamics.hpp"
#include "articula/sim/joint_sensors.hpp"
#include "articula/sim/servo_drives.hpp"
#include "articula/sim/simulator_options.hpp"

#include <cstdint>

namespace articula {

/// A robot in simulation, to be controlled like the real one. `write` holds the command for one
/// period and advances the robot by this time (zero-order hold); `read` measures the joints then.
///
/// - Drives take efforts, positions, velocities, or springs and dampers. The kind of command may
///   change from one period to the next.
/// - Drives give at most the joints' effort limits. The measured effort is what they give at that
///   moment: limited, and without friction.
/// - Joints have damping, dry friction and stops, see JointDynamics.
/// - Velocity limits hold under position and velocity commands. Under the others they are the
///   controller's responsibility.
/// - Drives are active until `deactivate`. Inactive drives give no effort, and the robot falls.
/// - The same options and commands give the same motion to the last bit.
///
/// docs/simulator.md has the details. `Simulator<R, symbolic::Pack<>>` simulates several robots at
/// once, with a command for each. Steps without events are computed for all robots together. A step
/// with an event (a stop, friction that brings a joint to rest) is computed for each robot alone.
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <Robot R, class S = double>
class Simulator {
  static_assert(detail::has_masses<R, Simulator>);

 public:
  using RobotType = R;
  using Scalar = S;
  static constexpr int joint_count = articula::joint_count<R>;
  using State = JointState<joint_count, S>;

  /// A robot known at compile time.
  /// @throws std::invalid_argument if the options cannot be simulated; the message names joint,
  ///         value, limit
  explicit Simulator(const SimulatorOptions<joint_count>& options = {})
    requires DescribedRobot<R>
      : Simulator(R(), options) {}

  /// A robot loaded at run time.
  /// @throws std::invalid_argument as above
  explicit Simulator(const R& robot, const SimulatorOptions<joint_count>& options = {})
      : robot_(robot),
        options_(options),
        dynamics_(robot),
        servo_(robot, options.servo_bandwidth),
        limits_(effort_limits(robot)),
        sensors_(options) {
    validate(robot, options);
    servo_substeps_ = static_cast<int>(servo_substeps(options));
    truth_.position = initial_position(robot, options).template cast<S>();
    truth_.velocity = options.initial_velocity.template cast<S>();
    measured_ = sensors_.measure(truth_);
  }

  /// Real-time: yes.
  [[nodiscard]] Status activate() noexcept { return active_ = true, Status::ok; }
  /// Real-time: yes.
  [[nodiscard]] Status deactivate() noexcept { return active_ = false, Status::ok; }

  /// The measurement at this moment. Reading twice gives the same.
  /// @param state  receives it
  /// @return       Status::ok, Status::non_finite_state if the motion has overflowed, or
  ///               Status::inactive after `deactivate`
  /// Real-time: yes.
  [[nodiscard]] Status read(State& state) noexcept {
    state = measured_;
    if (!all_of(is_finite(state))) return Status::non_finite_state;
    return active_ ? Status::ok : Status::inactive;
  }

  /// Holds efforts for one period.
  /// @param command  efforts [N m or N], clamped to the drives' limits
  /// @return         Status::ok; Status::inactive after `deactivate`; Status::non_finite_command if
  ///                 a number is NaN or infinite. Unless Status::ok the drives give no effort.
  /// Real-time: yes. Costs `substeps` Runge-Kutta steps, and more where a joint reaches a stop or
  /// comes to rest against dry friction.
  [[nodiscard]] Status write(const EffortCommand<joint_count, S>& command) noexcept {
    const bool finite = all_of(is_finite(command)), accepted = finite && active_;
    const Vector limited = for_each_joint<joint_count, S>([&](int j) noexcept {
      return accepted ? clamp(command.effort[j], -limits_[j], limits_[j]) : S(0);
    });
    advance(options_.substeps, limited,
            [](const auto& effort, const auto&, const auto&) noexcept { return effort; });
    return accepted ? Status::ok : finite ? Status::inactive : Status::non_finite_command;
  }

  /// Holds another command for one period. Drives follow positions and velocities as servos or
  /// ideally, see SimulatorOptions::drives. Springs and dampers act without delay or sampling, so
  /// `substeps` must suit them.
  /// @param command  a PositionCommand, VelocityCommand or MultiModeCommand; positions and
  ///                 velocities are clamped to the joints' limits
  /// @return         as above
  /// Real-time: yes. Costs as above, with `servo_substeps` for servos; each step takes the inverse
  /// dynamics as well.
  template <template <int, class> class Command>
  [[nodiscard]] Status write(const Command<joint_count, S>& command) noexcept {
    const bool finite = all_of(is_finite(command));
    if (!finite || !active_) {
      const Status without_effort = write(EffortCommand<joint_count, S>{});
      return finite ? without_effort : Status::non_finite_command;
    }
    follow(command);
    return Status::ok;
  }

  /// Moves the joints to another state at this moment, as for a new attempt.
  /// @param position  finite, within the joints' limits [rad or m], N x 1
  /// @param velocity  finite [rad/s or m/s], N x 1
  /// Real-time: yes.
  void set_state(const JointVector<joint_count, S>& position,
                 const JointVector<joint_count, S>& velocity) noexcept {
    truth_ = {position, velocity, JointVector<joint_count, S>::Zero()};
    sensors_ = JointSensors<joint_count, S>(options_);
    measured_ = sensors_.measure(truth_);
  }

  /// Efforts that act on the joints beside the drives', as of a hand that pulls: from now on, until
  /// others are set. No sensor measures them as the drives' efforts.
  /// @param effort  finite [N m or N], N x 1
  /// Real-time: yes.
  void set_external_effort(const JointVector<joint_count, S>& effort) noexcept {
    external_ = effort;
  }

  /// The exact state at this moment, without sensors. Real-time: yes.
  [[nodiscard]] const State& true_state() const noexcept { return truth_; }
  /// Simulated time [s]. Real-time: yes.
  [[nodiscard]] double time() const noexcept {
    return static_cast<double>(periods_) * options_.period;
  }
  /// Time from one command to the next [s]. Real-time: yes.
  [[nodiscard]] double period() const noexcept { return options_.period; }
  [[nodiscard]] const SimulatorOptions<joint_count>& options() const noexcept { return options_; }
  [[nodiscard]] const R& robot() const noexcept { return robot_; }

 private:
  using Vector = JointVector<joint_count, S>;

  void follow(const PositionCommand<joint_count, S>& command) noexcept {
    if (options_.drives == DriveModel::ideal) return move_to(command.position);
    advance(servo_substeps_, command.position,
            [this](const auto& target, const auto& q, const auto& v) noexcept {
              return servo_.effort_to_position(target, q, v);
            });
  }
  void follow(const VelocityCommand<joint_count, S>& command) noexcept {
    if (options_.drives == DriveModel::ideal) {
      return move_to(truth_.position + command.velocity * S(options_.period));
    }
    advance(servo_substeps_, command.velocity,
            [this](const auto& target, const auto& q, const auto& v) noexcept {
              return servo_.effort_to_velocity(target, q, v);
            });
  }
  void follow(const MultiModeCommand<joint_count, S>& command) noexcept {
    advance(options_.substeps, command,
            [this](const auto& springs, const auto& q, const auto& v) noexcept {
              return this->spring_effort(springs, {q, v});
            });
  }

  /// Advances by one period.
  /// @param steps    number of Runge-Kutta steps
  /// @param command  of all robots
  /// @param drives   callable with (command, q, v) -> efforts of the drives
  template <class Command, class Drives>
  void advance(int steps, const Command& command, const Drives& drives) noexcept {
    const double step = options_.period / steps;
    const auto effort = [&](const auto& q, const auto& v) noexcept {
      return JointVector<joint_count, S>(drives(command, q, v) + external_);
    };
    for (int i = 0; i < steps; ++i) {
      if constexpr (!PackedScalar<S>) {
        truth_ = dynamics_.advance(truth_, effort, step);
      } else {
        const auto [next, event] = dynamics_.advance_smoothly(truth_, effort, step);
        const State before = truth_;
        truth_ = next;
        if (!any_of(event)) continue;
        for (int k = 0; k < lanes<S>; ++k) {
          if (!is_true(event, k)) continue;
          const auto own_command = lane_of(command, k);
          const JointVector<joint_count> own_external = lane_of(external_, k);
          const JointState<joint_count> own = dynamics_.advance(
              lane_of(before, k),
              [&](const auto& q, const auto& v) noexcept {
                return JointVector<joint_count>(drives(own_command, q, v) + own_external);
              },
              step);
          set_lane(truth_.position, k, own.position);
          set_lane(truth_.velocity, k, own.velocity);
        }
      }
    }
    finish(drives(command, truth_.position, truth_.velocity));
  }

  /// Advances by one period with ideal drives: at constant speed, within the limits of position and
  /// velocity. The effort is that of the mean acceleration, without limit.
  void move_to(const Vector& target) noexcept {
    Vector acceleration;
    for (int j = 0; j < joint_count; ++j) {
      const JointLimits& limits = model_of(robot_).joints[j].limits;
      const double farthest = limits.velocity * options_.period;
      const S q = truth_.position[j], v = truth_.velocity[j];
      const S reached = clamp(target[j], S(q - farthest), S(q + farthest));
      truth_.position[j] = clamp(reached, limits.lower, limits.upper);
      truth_.velocity[j] = (truth_.position[j] - q) / options_.period;
      acceleration[j] = (truth_.velocity[j] - v) / options_.period;
    }
    finish(inverse_dynamics(robot_, truth_.position, truth_.velocity, acceleration) -
           friction_effort(robot_, truth_.velocity) - external_);
  }

  /// effort = K (q_ref - q) + D (v_ref - v) + effort_ref, clamped to the drives' limits; 0 for a
  /// drive where it overflows.
  template <class T>
  [[nodiscard]] JointVector<joint_count, T> spring_effort(
      const MultiModeCommand<joint_count, T>& command,
      const JointState<joint_count, T>& state) const noexcept {
    JointVector<joint_count, T> effort = numbers_of(command, state);
    for (int j = 0; j < joint_count; ++j) {
      effort[j] = select(is_finite(effort[j]), clamp(effort[j], -limits_[j], limits_[j]), T(0));
    }
    return effort;
  }

  /// Ends a period in which the joints have moved.
  void finish(const Vector& effort) noexcept {
    truth_.effort = effort;
    measured_ = sensors_.measure(truth_);
    ++periods_;
  }

  [[no_unique_address]] R robot_;
  SimulatorOptions<joint_count> options_;
  JointDynamics<R> dynamics_;
  ServoDrives<R> servo_;
  int servo_substeps_ = 1;
  JointVector<joint_count> limits_;
  JointSensors<joint_count, S> sensors_;
  JointVector<joint_count, S> external_ = JointVector<joint_count, S>::Zero();
  State truth_{};
  State measured_{};
  std::uint64_t periods_ = 0;
  bool active_ = true;
};

}  // namespace articula
