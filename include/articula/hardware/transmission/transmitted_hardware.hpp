// SPDX-License-Identifier: Apache-2.0
/// @file The joints of a robot behind the transmissions of its actuators.
#pragma once

#include "articula/control/laws/drive_spring.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/hardware.hpp"
#include "articula/core/refuse.hpp"
#include "articula/hardware/transmission/transmission.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace articula {

/// Which actuators drive which joints through a transmission, and what the actuators can do.
/// @tparam T  the transmission
template <Transmission T>
struct Gearing {
  static constexpr auto size = static_cast<std::size_t>(T::size);

  std::array<Name, size> joints{};  ///< of the robot, in the order of the transmission
  std::array<Name, size>
      actuators{};  ///< by the names that the actuators' hardware has for its joints
  T transmission{};
  std::array<JointLimits, size>
      limits{};  ///< of the actuators; commands are cut off there, see write
};

/// The joints of a robot, made of the hardware of its actuators and the transmissions between them,
/// put together by the compiler. It is hardware for commands of effort, position and velocity, as
/// far as the actuators' hardware is; and for springs and dampers where each joint has its own
/// actuator.
///
///     TransmittedHardware<Drives, Arm, SimpleTransmission, DifferentialTransmission> arm(
///         Drives(),
///         {.joints = {"elbow"}, .actuators = {"elbow"}, .transmission = {.reduction = 101}},
///         {.joints = {"pitch", "roll"}, .actuators = {"pitch", "roll"}});
///
/// What goes wrong below is passed on: a figure that is no number reaches all joints of its
/// transmission.
/// @tparam ActuatorHardware  hardware with as many joints as the robot; its joints are the
///                           actuators
/// @tparam R                 the robot
/// @tparam Transmissions     which together have as many joints as the robot
template <class ActuatorHardware, Robot R, Transmission... Transmissions>
class TransmittedHardware {
 public:
  using RobotType = R;
  static constexpr int joint_count = articula::joint_count<R>;
  static_assert((Transmissions::size + ... + 0) == joint_count,
                "the transmissions must have as many joints together as the robot");
  static_assert(articula::joint_count<typename ActuatorHardware::RobotType> == joint_count,
                "there must be as many actuators as joints");

  /// For a robot known at compile time.
  /// @param hardware  of the actuators
  /// @param gearings  one for each of the transmissions
  /// @throws std::invalid_argument naming the joint or actuator and the value, if a name is unknown
  ///         or there twice, or a figure is out of range
  explicit TransmittedHardware(ActuatorHardware hardware, const Gearing<Transmissions>&... gearings)
    requires DescribedRobot<R>
      : TransmittedHardware(R(), std::move(hardware), gearings...) {}

  /// For a robot loaded at run time.
  /// @throws std::invalid_argument as above
  TransmittedHardware(const R& robot, ActuatorHardware hardware,
                      const Gearing<Transmissions>&... gearings)
      : robot_(robot),
        hardware_(std::move(hardware)),
        parts_(part_of(robot, hardware_.robot(), gearings)...) {
    check_that_none_is_there_twice();
  }

  [[nodiscard]] Status activate() { return hardware_.activate(); }
  [[nodiscard]] Status deactivate() { return hardware_.deactivate(); }

  /// What the joints do, as the actuators measure it.
  /// @param state  receives it; is left alone after Status::hardware_fault
  /// @return       as the actuators' hardware
  /// Real-time: yes, if the actuators' read is.
  [[nodiscard]] Status read(JointState<joint_count>& state) noexcept {
    const Status status = hardware_.read(actuators_);
    if (status == Status::hardware_fault) return status;
    for_each_part([&](const auto& part) noexcept {
      const auto& [gearing, joints, actuators] = part;
      const auto& transmission = gearing.transmission;
      state.position(joints) = transmission.joint_position(actuators_.position(actuators));
      state.velocity(joints) = transmission.joint_velocity(actuators_.velocity(actuators));
      state.effort(joints) = transmission.joint_effort(actuators_.effort(actuators));
    });
    return status;
  }

  /// Hands over what the actuators have to do for the joints' command. Beyond an actuator's limit,
  /// the limit. Of springs and dampers the total effort at the actuators' last state keeps it, too:
  /// their references are drawn towards that state.
  /// @param command  for the joints
  /// @return         as the actuators' hardware, which also sees what is not finite
  /// Real-time: yes, if the actuators' write is.
  template <JointCommand<joint_count> Command>
    requires Hardware<ActuatorHardware, Command> &&
             (!std::same_as<Command, MultiModeCommand<joint_count>> ||
              joint_count == sizeof...(Transmissions))
  [[nodiscard]] Status write(const Command& command) noexcept {
    Command given;
    for_each_part([&](const auto& part) noexcept {
      const auto& [gearing, joints, actuators] = part;
      const auto& transmission = gearing.transmission;
      if constexpr (requires { command.position; }) {
        given.position(actuators) = transmission.actuator_position(command.position(joints));
      }
      if constexpr (requires { command.velocity; }) {
        given.velocity(actuators) = transmission.actuator_velocity(command.velocity(joints));
      }
      if constexpr (requires { command.effort; }) {
        given.effort(actuators) = transmission.actuator_effort(command.effort(joints));
      }
      if constexpr (requires { command.stiffness; }) {  // effort_a = share K rate q_a
        using One = JointVector<1>;
        const double rate = transmission.joint_velocity(One(1.0))[0];
        const double share = transmission.actuator_effort(One(1.0))[0];
        given.stiffness(actuators) = share * rate * command.stiffness(joints);
        given.damping(actuators) = share * rate * command.damping(joints);
      }
      for (std::size_t k = 0; k < actuators.size(); ++k) {
        const JointLimits& limits = gearing.limits[k];
        const int a = actuators[k];
        // A NaN stays one.
        if constexpr (requires { command.position; }) {
          given.position[a] = std::clamp(given.position[a], limits.lower, limits.upper);
        }
        if constexpr (requires { command.velocity; }) {
          given.velocity[a] = std::clamp(given.velocity[a], -limits.velocity, limits.velocity);
        }
        if constexpr (requires { command.stiffness; }) {
          const double total = spring_pull(given, actuators_)[a] + given.effort[a];
          const double most = std::max(std::abs(total), std::abs(given.effort[a]));
          if (is_finite(total) && most > limits.effort) {
            set_total(given, actuators_, a, std::clamp(total, -limits.effort, limits.effort),
                      limits.effort);
          }
        }
        if constexpr (requires { command.effort; }) {
          given.effort[a] = std::clamp(given.effort[a], -limits.effort, limits.effort);
        }
      }
    });
    return hardware_.write(given);
  }

  /// The actuators' own period [s], where they have one. Real-time: yes.
  [[nodiscard]] double period() const noexcept
    requires requires(const ActuatorHardware& h) { h.period(); }
  {
    return hardware_.period();
  }
  /// Waits for the actuators' own cycle, where they have one. Real-time: yes, but for the wait.
  [[nodiscard]] Status wait_for_cycle(std::chrono::nanoseconds timeout) noexcept
    requires PacingHardware<ActuatorHardware>
  {
    return hardware_.wait_for_cycle(timeout);
  }

  [[nodiscard]] const R& robot() const noexcept { return robot_; }
  /// The actuators' hardware. Real-time: yes.
  [[nodiscard]] ActuatorHardware& hardware() noexcept { return hardware_; }
  [[nodiscard]] const ActuatorHardware& hardware() const noexcept { return hardware_; }
  /// What the actuators measured last. Real-time: yes.
  [[nodiscard]] const JointState<joint_count>& actuator_state() const noexcept {
    return actuators_;
  }

 private:
  /// A gearing, and by which indices its joints and actuators go.
  template <Transmission T>
  struct Part {
    Gearing<T> gearing;
    std::array<int, Gearing<T>::size> joints;
    std::array<int, Gearing<T>::size> actuators;
  };

  /// The index of a joint, or why there is none and on which side of the transmission.
  template <Robot Side>
  [[nodiscard]] static int index_of(const Side& side, const Name& name, const char* what) {
    try {
      return joint_index(side, name.view());
    } catch (const std::invalid_argument& error) {
      detail::refuse({"transmissions: '", name.view(), "' is to be ", what, ": ", error.what()});
    }
  }

  template <Transmission T, Robot Actuators>
  [[nodiscard]] static Part<T> part_of(const R& robot, const Actuators& actuators,
                                       const Gearing<T>& gearing) {
    Part<T> part{gearing, {}, {}};
    for (std::size_t k = 0; k < Gearing<T>::size; ++k) {
      part.joints[k] = index_of(robot, gearing.joints[k], "a joint of the transmission");
      part.actuators[k] = index_of(actuators, gearing.actuators[k],
                                   "an actuator, which is a joint of the hardware below");
      const JointLimits& limits = gearing.limits[k];
      const double lower = limits.lower, upper = limits.upper;
      const double velocity = limits.velocity, effort = limits.effort;
      constexpr double infinity = std::numeric_limits<double>::infinity();
      if (lower <= upper && lower < infinity && upper > -infinity && velocity >= 0 && effort >= 0) {
        continue;
      }
      detail::refuse({"limits of actuator '", gearing.actuators[k].view(), "': position ", lower,
                      " .. ", upper, ", velocity ", velocity, ", effort ", effort,
                      " leave nothing to do"});
    }
    std::string where = "transmission of joint";
    for (const Name& joint : gearing.joints) where += detail::message_of({" '", joint.view(), "'"});
    validate(gearing.transmission, where);
    return part;
  }

  void check_that_none_is_there_twice() const {
    std::array<bool, static_cast<std::size_t>(joint_count)> has_joint{}, has_actuator{};
    const auto add = [](auto& has, int index, const char* kind, const Name& name) {
      if (!std::exchange(has[static_cast<std::size_t>(index)], true)) return;
      detail::refuse({"transmissions: ", kind, " '", name.view(), "' is there twice"});
    };
    const auto add_part = [&](const auto& part) {
      for (std::size_t k = 0; k < part.joints.size(); ++k) {
        add(has_joint, part.joints[k], "joint", part.gearing.joints[k]);
        add(has_actuator, part.actuators[k], "actuator", part.gearing.actuators[k]);
      }
    };
    std::apply([&](const auto&... part) { (add_part(part), ...); }, parts_);
  }

  template <class Action>
  void for_each_part(const Action& action) const noexcept {
    std::apply([&](const auto&... part) noexcept { (action(part), ...); }, parts_);
  }

  [[no_unique_address]] R robot_;
  ActuatorHardware hardware_;
  std::tuple<Part<Transmissions>...> parts_;
  JointState<joint_count> actuators_{};
};

}  // namespace articula
