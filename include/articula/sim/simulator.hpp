// SPDX-License-Identifier: Apache-2.0
/// @file A simulated robot that looks like hardware.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/hardware.hpp"
#include "articula/sim/joint_dynamics.hpp"
#include "articula/sim/joint_sensors.hpp"
#include "articula/sim/simulator_options.hpp"

namespace articula {

/// A robot in simulation, to be controlled like the real one. `write` holds the command for one
/// period and moves the robot that far in time (zero-order hold); `read` measures where it is then.
/// Drives give at most the joints' effort limits; joints have their damping, dry friction and stops
/// (see JointDynamics). Velocity limits are not imposed: they are the controller's to keep. The
/// same options and commands give the same motion to the last bit.
/// @tparam R  the robot
template <Robot R>
class Simulator {
 public:
  using RobotType = R;
  static constexpr int joint_count = articula::joint_count<R>;

  /// A robot known at compile time.
  /// @throws std::invalid_argument if the options cannot be simulated; the message names joint,
  ///         value, limit
  explicit Simulator(const SimulatorOptions<joint_count>& options = {}) requires DescribedRobot<R>
      : Simulator(R(), options) {}

  /// A robot loaded at run time.
  /// @throws std::invalid_argument as above
  explicit Simulator(const R& robot, const SimulatorOptions<joint_count>& options = {})
      : robot_(robot),
        options_(options),
        dynamics_(robot),
        limits_(effort_limits(robot)),
        sensors_(options) {
    validate(robot, options);
    truth_.position = initial_position(robot, options);
    truth_.velocity = options.initial_velocity;
    measured_ = sensors_.measure(truth_);
  }

  [[nodiscard]] Status activate() noexcept { return Status::ok; }
  [[nodiscard]] Status deactivate() noexcept { return Status::ok; }

  /// The measurement at this moment. Reading twice gives the same.
  /// @param state  receives it
  /// @return       Status::ok, or Status::non_finite_state if the motion has overflowed
  /// Real-time: yes.
  [[nodiscard]] Status read(JointState<joint_count>& state) noexcept {
    state = measured_;
    return is_finite(measured_) ? Status::ok : Status::non_finite_state;
  }

  /// Holds a command for one period.
  /// @param command  efforts [N m or N], cut off at the drives' limits
  /// @return         Status::ok, or Status::non_finite_command if a NaN or infinity was refused and
  ///                 the drives gave no effort instead
  /// Real-time: yes. Costs `substeps` Runge-Kutta steps, and more where a joint reaches a stop or
  /// comes to rest against dry friction.
  [[nodiscard]] Status write(const EffortCommand<joint_count>& command) noexcept {
    const bool accepted = is_finite(command);
    truth_.effort.setZero();
    if (accepted) truth_.effort = command.effort.cwiseMin(limits_).cwiseMax(-limits_);
    Motion<joint_count> motion{truth_.position, truth_.velocity};
    const double step = options_.period / options_.substeps;
    for (int k = 0; k < options_.substeps; ++k)
      motion = dynamics_.advance(motion, truth_.effort, step);
    truth_.position = motion.position;
    truth_.velocity = motion.velocity;
    measured_ = sensors_.measure(truth_);
    ++periods_;
    return accepted ? Status::ok : Status::non_finite_command;
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
  [[no_unique_address]] R robot_;
  SimulatorOptions<joint_count> options_;
  JointDynamics<R> dynamics_;
  JointVector<joint_count> limits_;
  JointSensors<joint_count> sensors_;
  JointState<joint_count> truth_{};
  JointState<joint_count> measured_{};
  std::uint64_t periods_ = 0;
};

}  // namespace articula
