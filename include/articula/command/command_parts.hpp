// SPDX-License-Identifier: Apache-2.0
/// @file The vectors of a command, with their names and quantities.
#pragma once

#include "articula/core/joint_command.hpp"

#include <array>
#include <concepts>
#include <string_view>

namespace articula {

/// What a number of a command stands for.
enum class CommandQuantity : unsigned char {
  position,   ///< [rad or m]
  velocity,   ///< [rad/s or m/s]
  effort,     ///< [N m or N]
  stiffness,  ///< [N m/rad or N/m]
  damping,    ///< [N m s/rad or N s/m]
};

/// The name of the member of a command. Real-time: yes.
[[nodiscard]] constexpr std::string_view to_string(CommandQuantity quantity) noexcept {
  switch (quantity) {
    case CommandQuantity::position:
      return "position";
    case CommandQuantity::velocity:
      return "velocity";
    case CommandQuantity::effort:
      return "effort";
    case CommandQuantity::stiffness:
      return "stiffness";
    case CommandQuantity::damping:
      return "damping";
  }
  return "unknown quantity";
}

/// One vector of a command.
/// @tparam N  number of joints
template <int N>
struct CommandPart {
  CommandQuantity quantity{};
  const JointVector<N>* values = nullptr;  ///< in the command, N x 1
};

/// The vectors of which a command is made, in the order of its members: one, but for the
/// MultiModeCommand, which has five.
/// @param command  outlives what is returned
/// Real-time: yes.
template <class Command>
  requires JointCommand<Command, Command::joint_count>
[[nodiscard]] constexpr auto parts_of(const Command& command) noexcept {
  constexpr int N = Command::joint_count;
  using Part = CommandPart<N>;
  if constexpr (std::same_as<Command, MultiModeCommand<N>>) {
    return std::array<Part, 5>{{{CommandQuantity::position, &command.position},
                                {CommandQuantity::velocity, &command.velocity},
                                {CommandQuantity::stiffness, &command.stiffness},
                                {CommandQuantity::damping, &command.damping},
                                {CommandQuantity::effort, &command.effort}}};
  } else if constexpr (std::same_as<Command, PositionCommand<N>>) {
    return std::array<Part, 1>{{{CommandQuantity::position, &command.position}}};
  } else if constexpr (std::same_as<Command, VelocityCommand<N>>) {
    return std::array<Part, 1>{{{CommandQuantity::velocity, &command.velocity}}};
  } else {
    return std::array<Part, 1>{{{CommandQuantity::effort, &command.effort}}};
  }
}

/// The vector of a quantity in a command, to be set; nullptr if the command has none.
/// Real-time: yes.
template <class Command>
  requires JointCommand<Command, Command::joint_count>
[[nodiscard]] constexpr JointVector<Command::joint_count>* part_of(
    Command& command, CommandQuantity quantity) noexcept {
  if constexpr (requires { command.position; }) {
    if (quantity == CommandQuantity::position) return &command.position;
  }
  if constexpr (requires { command.velocity; }) {
    if (quantity == CommandQuantity::velocity) return &command.velocity;
  }
  if constexpr (requires { command.stiffness; }) {
    if (quantity == CommandQuantity::stiffness) return &command.stiffness;
    if (quantity == CommandQuantity::damping) return &command.damping;
  }
  if constexpr (requires { command.effort; }) {
    if (quantity == CommandQuantity::effort) return &command.effort;
  }
  return nullptr;
}

}  // namespace articula
