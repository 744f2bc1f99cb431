// SPDX-License-Identifier: Apache-2.0
/// @file A simulated robot that looks like hardware.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/hardware.hpp"
#include "articula/dynamics/friction_effort.hpp"
#include "articula/model/dynamic_robot.hpp"
#include "articula/sim/joint_dynamics.hpp"
#include "articula/sim/joint_sensors.hpp"
#include "articula/sim/servo_drives.hpp"
#include "articula/sim/simulator_options.hpp"

#include <algorithm>
#include <cstdint>

namespace articula {

/// A robot in simulation, to be controlled like the real one. `write` holds the command for one
/// period and moves the robot that far in time (zero-order hold); `read` measures where it is then.
/// Drives take efforts, positions, velocities or springs and dampers, and may be given another kind
/// of command in every period. They give at most the joints' effort limits; the measured effort is
/// what they give at that moment, so limited and without friction. Joints have their damping, dry
/// friction and stops (see JointDynamics). Velocity limits are kept under position and velocity
/// commands; under the others they are the controller's to keep. Drives are active until
/// `deactivate`; drives that are not give no effort, and the robot falls. The same options and commands give
/// the same motion to the last bit. docs/simulator.md has it all.
/// @tparam R  the robot
template <Robot R>
class Simulator {
  static_assert(detail::has_masses<R, Simulator>);

 public:
  using RobotType = R;
  static constexpr int joint_count = articula::joint_count<R>;

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
    truth_.position = initial_position(robot, options);
    truth_.velocity = options.initial_velocity;
    measured_ = sensors_.measure(truth_);
  }

  /// Real-time: yes.
  [[nodiscard]] Status activate() noexcept {
    active_ = true;
    return Status::ok;
  }
  /// Real-time: yes.
  [[nodiscard]] Status deactivate() noexcept {
    active_ = false;
    return Status::ok;
  }

  /// The measurement at this moment. Reading twice gives the same.
  /// @param state  receives it
  /// @return       Status::ok, Status::non_finite_state if the motion has overflowed, or
  ///               Status::inactive after `deactivate`
  /// Real-time: yes.
  [[nodiscard]] Status read(JointState<joint_count>& state) noexcept {
    state = measured_;
    if (!is_finite(measured_)) return Status::non_finite_state;
    return active_ ? Status::ok : Status::inactive;
  }

  /// Holds efforts for one period.
  /// @param command  efforts [N m or N], cut off at the drives' limits
  /// @return         Status::ok, or Status::non_finite_command if a NaN or infinity was refused and
  ///                 the drives gave no effort instead; Status::inactive after `deactivate`,
  ///                 when they give none either
  /// Real-time: yes. Costs `substeps` Runge-Kutta steps, and more where a joint reaches a stop or
  /// comes to rest against dry friction.
  [[nodiscard]] Status write(const EffortCommand<joint_count>& command) noexcept {
    const bool finite = is_finite(command), accepted = finite && active_;
    truth_.effort = for_each_joint<joint_count>([&](int j) noexcept {
      return accepted ? std::clamp(command.effort[j], -limits_[j], limits_[j]) : 0.0;
    });
    advance(options_.substeps, [this](const auto&, const auto&) noexcept { return truth_.effort; });
    return accepted ? Status::ok : finite ? Status::inactive : Status::non_finite_command;
  }

  /// Holds another command for one period: positions or velocities for drives that are servos or
  /// ideal as the options say; or springs and dampers, which act without delay or sampling, so that
  /// `substeps` must suit them.
  /// @param command  beyond the joints' limits, the limits
  /// @return         as above
  /// Real-time: yes. Costs as above, with `servo_substeps` for servos; each step takes the inverse
  /// dynamics as well.
  template <JointCommand<joint_count> Command>
  [[nodiscard]] Status write(const Command& command) noexcept {
    const bool finite = is_finite(command);
    if (!finite || !active_) {
      const Status without_effort = write(EffortCommand<joint_count>{});
      return finite ? without_effort : Status::non_finite_command;
    }
    follow(command);
    return Status::ok;
  }

  /// The exact state at this moment, as no sensor sees it. Real-time: yes.
  [[nodiscard]] const JointState<joint_count>& true_state() const noexcept { return truth_; }
  /// Simulated time [s]. Real-time: yes.
  [[nodiscard]] double time() const noexcept {
    return static_cast<double>(periods_) * options_.period;
  }
  /// Time from one command to the next [s]. Real-time: yes.
  [[nodiscard]] double period() const noexcept { return options_.period; }
  [[nodiscard]] const SimulatorOptions<joint_count>& options() const noexcept { return options_; }
  [[nodiscard]] const R& robot() const noexcept { return robot_; }

 private:
  void follow(const PositionCommand<joint_count>& command) noexcept {
    if (options_.drives == DriveModel::ideal) return move_to(command.position);
    advance(servo_substeps_, [&](const auto& q, const auto& v) noexcept {
      return servo_.effort_to_position(command.position, q, v);
    });
  }
  void follow(const VelocityCommand<joint_count>& command) noexcept {
    if (options_.drives == DriveModel::ideal) {
      return move_to(truth_.position + command.velocity * options_.period);
    }
    advance(servo_substeps_, [&](const auto& q, const auto& v) noexcept {
      return servo_.effort_to_velocity(command.velocity, q, v);
    });
  }
  void follow(const MultiModeCommand<joint_count>& command) noexcept {
    advance(options_.substeps,
            [&](const auto& q, const auto& v) noexcept { return spring_effort(command, q, v); });
  }

  /// Moves on by one period.
  /// @param steps   Runge-Kutta steps that it takes
  /// @param effort  callable with (q, v) -> efforts of the drives
  template <class Drives>
  void advance(int steps, const Drives& effort) noexcept {
    Motion<joint_count> motion{truth_.position, truth_.velocity};
    const double step = options_.period / steps;
    for (int k = 0; k < steps; ++k) motion = dynamics_.advance(motion, effort, step);
    finish(motion, effort(motion.position, motion.velocity));
  }

  /// Moves on by one period with ideal drives: at an even speed, as far as the limits of position
  /// and velocity allow. The effort is what the mean acceleration takes, without limit.
  void move_to(const JointVector<joint_count>& target) noexcept {
    const auto limit = [this](double JointLimits::* which) {
      return joint_values(robot_, [&](const JointProperties& j) { return j.limits.*which; });
    };
    const JointVector<joint_count> farthest = limit(&JointLimits::velocity) * options_.period;
    Motion<joint_count> motion;
    motion.position = target.cwiseMin(truth_.position + farthest)
                          .cwiseMax(truth_.position - farthest)
                          .cwiseMax(limit(&JointLimits::lower))
                          .cwiseMin(limit(&JointLimits::upper));
    motion.velocity = (motion.position - truth_.position) / options_.period;
    finish(motion, inverse_dynamics(robot_, motion.position, motion.velocity,
                                    (motion.velocity - truth_.velocity) / options_.period) -
                       friction_effort(robot_, motion.velocity));
  }

  /// effort = K (q_ref - q) + D (v_ref - v) + effort_ref, cut off at the drives' limits; 0 for a
  /// drive where it overflows.
  [[nodiscard]] JointVector<joint_count> spring_effort(
      const MultiModeCommand<joint_count>& command, const JointVector<joint_count>& q,
      const JointVector<joint_count>& v) const noexcept {
    JointVector<joint_count> effort = command.stiffness.cwiseProduct(command.position - q) +
                                      command.damping.cwiseProduct(command.velocity - v) +
                                      command.effort;
    for (int j = 0; j < joint_count; ++j) {
      effort[j] = is_finite(effort[j]) ? std::clamp(effort[j], -limits_[j], limits_[j]) : 0;
    }
    return effort;
  }

  void finish(const Motion<joint_count>& motion, const JointVector<joint_count>& effort) noexcept {
    truth_ = {motion.position, motion.velocity, effort};
    measured_ = sensors_.measure(truth_);
    ++periods_;
  }

  [[no_unique_address]] R robot_;
  SimulatorOptions<joint_count> options_;
  JointDynamics<R> dynamics_;
  ServoDrives<R> servo_;
  int servo_substeps_ = 1;
  JointVector<joint_count> limits_;
  JointSensors<joint_count> sensors_;
  JointState<joint_count> truth_{};
  JointState<joint_count> measured_{};
  std::uint64_t periods_ = 0;
  bool active_ = true;
};

}  // namespace articula
