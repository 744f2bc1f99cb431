// SPDX-License-Identifier: Apache-2.0
/// @file Hardware with transmissions between its joints and the actuators of other hardware.
#pragma once

#include "articula/command/drive_spring.hpp"
#include "articula/core/hardware.hpp"
#include "articula/core/joint_array.hpp"
#include "articula/core/refuse.hpp"
#include "articula/hardware/transmission/hardware_adapter.hpp"
#include "articula/hardware/transmission/transmission.hpp"
#include "articula/hardware/transmission/transmission_check.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace articula {

/// A transmission with the names of its joints and actuators, and the actuators' limits.
/// @tparam T  the transmission
template <Transmission T>
struct Gearing {
  static constexpr auto size = static_cast<std::size_t>(T::size);

  std::array<Name, size> joints{};     ///< of the robot, in the order of the transmission
  std::array<Name, size> actuators{};  ///< joints of the actuators' hardware, in that order
  T transmission{};
  std::array<JointLimits, size> limits{};  ///< of the actuators; `write` limits commands to them
};

/// A robot's joints, made of the hardware of its actuators and the transmissions between them. It
/// takes efforts, positions and velocities if the actuators' hardware does; and springs and dampers
/// if each joint has its own actuator.
///
///     TransmittedHardware<Drives, Arm, SimpleTransmission, DifferentialTransmission> arm(
///         Drives(),
///         {.joints = {"elbow"}, .actuators = {"elbow"}, .transmission = {.reduction = 101}},
///         {.joints = {"pitch", "roll"}, .actuators = {"pitch", "roll"}});
///
/// A NaN of an actuator reaches all joints of its transmission. Do not use this class for drives
/// that convert to the joints' units themselves, as Cia402Drive and QuanserModule do by their
/// scales.
/// @tparam ActuatorHardware  hardware with as many joints as the robot; its joints are the
///                           actuators
/// @tparam R                 the robot
/// @tparam Transmissions     have as many joints together as the robot
template <class ActuatorHardware, Robot R, Transmission... Transmissions>
class TransmittedHardware : public detail::HardwareAdapter<ActuatorHardware> {
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
  /// @throws std::invalid_argument with the joint or actuator and the value, if a name is unknown
  ///         or occurs twice, a figure is out of range, or a transmission's maps do not agree
  explicit TransmittedHardware(ActuatorHardware hardware, const Gearing<Transmissions>&... gearings)
    requires DescribedRobot<R>
      : TransmittedHardware(R(), std::move(hardware), gearings...) {}

  /// For a robot loaded at run time.
  /// @throws std::invalid_argument as above
  TransmittedHardware(const R& robot, ActuatorHardware hardware,
                      const Gearing<Transmissions>&... gearings)
      : Adapter(std::move(hardware)),
        robot_(robot),
        parts_(part_of(robot, this->hardware_.robot(), gearings)...) {
    check_duplicates();
  }

  /// Reads the actuators and converts their state to the joints.
  /// @param state  of the joints; unchanged after Status::hardware_fault
  /// @return       as the actuators' hardware
  /// Real-time: yes, if the actuators' read is.
  [[nodiscard]] Status read(JointState<joint_count>& state) noexcept {
    const Status status = this->hardware_.read(actuators_);
    if (status == Status::hardware_fault) return status;
    for_each_transmission([&](const auto& part) noexcept {
      const auto& [gearing, joints, actuators] = part;
      const auto& transmission = gearing.transmission;
      state.position(joints) = transmission.joint_position(actuators_.position(actuators));
      state.velocity(joints) = transmission.joint_velocity(actuators_.velocity(actuators));
      state.effort(joints) = transmission.joint_effort(actuators_.effort(actuators));
    });
    return status;
  }

  /// Converts a command to the actuators, limits it to their limits, and writes it. The total
  /// effort of springs and dampers at the actuators' last state keeps the limit, too, see
  /// limit_total.
  /// @param command  for the joints
  /// @return         as the actuators' hardware, which also refuses what is not finite
  /// Real-time: yes, if the actuators' write is.
  template <JointCommand<joint_count> Command>
    requires Hardware<ActuatorHardware, Command> &&
             (!std::same_as<Command, MultiModeCommand<joint_count>> ||
              joint_count == sizeof...(Transmissions))
  [[nodiscard]] Status write(const Command& command) noexcept {
    Command converted;
    for_each_transmission([&](const auto& part) noexcept {
      const auto& [gearing, joints, actuators] = part;
      const auto& transmission = gearing.transmission;
      if constexpr (requires { command.position; }) {
        converted.position(actuators) = transmission.actuator_position(command.position(joints));
      }
      if constexpr (requires { command.velocity; }) {
        converted.velocity(actuators) = transmission.actuator_velocity(command.velocity(joints));
      }
      if constexpr (requires { command.effort; }) {
        converted.effort(actuators) = transmission.actuator_effort(command.effort(joints));
      }
      if constexpr (requires { command.stiffness; }) {  // effort_a = share K rate q_a
        using One = JointVector<1>;
        const double rate = transmission.joint_velocity(One(1.0))[0];
        const double share = transmission.actuator_effort(One(1.0))[0];
        converted.stiffness(actuators) = share * rate * command.stiffness(joints);
        converted.damping(actuators) = share * rate * command.damping(joints);
      }
      for (std::size_t k = 0; k < actuators.size(); ++k) {
        const JointLimits& limits = gearing.limits[k];
        const int a = actuators[k];
        // std::clamp keeps a NaN.
        if constexpr (requires { command.position; }) {
          converted.position[a] = std::clamp(converted.position[a], limits.lower, limits.upper);
        }
        if constexpr (requires { command.velocity; }) {
          converted.velocity[a] =
              std::clamp(converted.velocity[a], -limits.velocity, limits.velocity);
        }
        if constexpr (requires { command.stiffness; }) {
          limit_total(converted, actuators_, a, limits.effort);
        }
        if constexpr (requires { command.effort; }) {
          converted.effort[a] = std::clamp(converted.effort[a], -limits.effort, limits.effort);
        }
      }
    });
    return this->hardware_.write(converted);
  }

  [[nodiscard]] const R& robot() const noexcept { return robot_; }
  /// What the actuators measured last. Real-time: yes.
  [[nodiscard]] const JointState<joint_count>& actuator_state() const noexcept {
    return actuators_;
  }

 private:
  using Adapter = detail::HardwareAdapter<ActuatorHardware>;

  /// A gearing with the indices of its joints and actuators.
  template <Transmission T>
  struct Part {
    Gearing<T> gearing;
    std::array<int, Gearing<T>::size> joints;
    std::array<int, Gearing<T>::size> actuators;
  };

  /// The index of a joint on one side of the transmission.
  template <Robot Side>
  [[nodiscard]] static int index_of(const Side& side, const Name& name, const char* role) {
    try {
      return joint_index(side, name.view());
    } catch (const std::invalid_argument& error) {
      detail::refuse({"transmissions: '", name.view(), "' is to be ", role, ": ", error.what()});
    }
  }

  template <Transmission T, Robot Actuators>
  [[nodiscard]] static Part<T> part_of(const R& robot, const Actuators& actuators,
                                       const Gearing<T>& gearing) {
    Part<T> part{gearing, {}, {}};
    std::string where = "transmission of joint";
    for (std::size_t k = 0; k < Gearing<T>::size; ++k) {
      part.joints[k] = index_of(robot, gearing.joints[k], "a joint of the transmission");
      part.actuators[k] = index_of(actuators, gearing.actuators[k],
                                   "an actuator, which is a joint of the hardware below");
      where += detail::message_of({" '", gearing.joints[k].view(), "'"});
      const JointLimits& limits = gearing.limits[k];
      const double lower = limits.lower, upper = limits.upper;
      const double velocity = limits.velocity, effort = limits.effort;
      constexpr double infinity = std::numeric_limits<double>::infinity();
      if (lower <= upper && lower < infinity && upper > -infinity && velocity >= 0 && effort >= 0) {
        continue;
      }
      detail::refuse({"limits of actuator '", gearing.actuators[k].view(), "': position ", lower,
                      " .. ", upper, ", velocity ", velocity, ", effort ", effort,
                      " leave no range; expected lower <= upper, velocity and effort >= 0"});
    }
    validate(gearing.transmission, where);
    detail::check_maps(gearing.transmission, where);
    return part;
  }

  void check_duplicates() const {
    JointArray<bool, joint_count> has_joint{}, has_actuator{};
    const auto add = [](auto& has, int index, const char* kind, const Name& name) {
      if (!std::exchange(has[index], true)) return;
      detail::refuse({"transmissions: ", kind, " '", name.view(), "' occurs twice"});
    };
    for_each_transmission([&](const auto& part) {
      for (std::size_t k = 0; k < part.joints.size(); ++k) {
        add(has_joint, part.joints[k], "joint", part.gearing.joints[k]);
        add(has_actuator, part.actuators[k], "actuator", part.gearing.actuators[k]);
      }
    });
  }

  template <class Action>
  void for_each_transmission(const Action& action) const
      noexcept(noexcept(action(std::get<0>(parts_)))) {
    constexpr bool calm = noexcept(action(std::get<0>(parts_)));
    [&]<std::size_t... I>(std::index_sequence<I...>) noexcept(calm) {
      (action(std::get<I>(parts_)), ...);
    }(std::index_sequence_for<Transmissions...>());
  }

  [[no_unique_address]] R robot_;
  std::tuple<Part<Transmissions>...> parts_;
  JointState<joint_count> actuators_{};
};

}  // namespace articula
