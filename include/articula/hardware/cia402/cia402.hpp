// SPDX-License-Identifier: Apache-2.0
/// @file The drive profile CiA 402: its objects, modes and state machine.
#pragma once

#include "articula/core/joint_command.hpp"
#include "articula/hardware/canopen/canopen.hpp"

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>

namespace articula::cia402 {

// Objects of the profile [CiA 402-2, CiA 402-3].
inline constexpr canopen::ObjectAddress abort_connection{0x6007, 0};
inline constexpr canopen::ObjectAddress error_code{0x603f, 0};
inline constexpr canopen::ObjectAddress controlword{0x6040, 0};
inline constexpr canopen::ObjectAddress statusword{0x6041, 0};
inline constexpr canopen::ObjectAddress mode_of_operation{0x6060, 0};
inline constexpr canopen::ObjectAddress mode_display{0x6061, 0};
inline constexpr canopen::ObjectAddress position_actual{0x6064, 0};
inline constexpr canopen::ObjectAddress velocity_actual{0x606c, 0};
inline constexpr canopen::ObjectAddress target_torque{0x6071, 0};
inline constexpr canopen::ObjectAddress torque_actual{0x6077, 0};
inline constexpr canopen::ObjectAddress target_position{0x607a, 0};
inline constexpr canopen::ObjectAddress velocity_offset{0x60b1, 0};
inline constexpr canopen::ObjectAddress torque_offset{0x60b2, 0};
inline constexpr canopen::ObjectAddress interpolation_period{0x60c2, 1};
inline constexpr canopen::ObjectAddress interpolation_exponent{0x60c2, 2};
inline constexpr canopen::ObjectAddress target_velocity{0x60ff, 0};

/// A cyclic mode of operation, as in object 6060h.
enum class Mode : std::uint8_t {
  cyclic_synchronous_position = 8,
  cyclic_synchronous_velocity = 9,
  cyclic_synchronous_torque = 10,
};

/// The mode for a type of command.
template <class Command>
inline constexpr Mode mode_of =
    std::same_as<Command, PositionCommand<Command::joint_count>> ? Mode::cyclic_synchronous_position
    : std::same_as<Command, VelocityCommand<Command::joint_count>>
        ? Mode::cyclic_synchronous_velocity
        : Mode::cyclic_synchronous_torque;

/// States of a drive [CiA 402-2, state machine].
enum class State : std::uint8_t {
  not_ready_to_switch_on,
  switch_on_disabled,
  ready_to_switch_on,
  switched_on,
  operation_enabled,
  quick_stop_active,
  fault_reaction_active,
  fault,
};

/// The state in a statusword; nothing if its bits are no state of the profile.
/// @param bits  of the statusword
/// Real-time: yes.
[[nodiscard]] constexpr std::optional<State> state_of(std::uint16_t bits) noexcept {
  struct Pattern {
    unsigned mask, bits;
    State state;
  };
  constexpr std::array<Pattern, 8> patterns{{{0x4f, 0x00, State::not_ready_to_switch_on},
                                             {0x4f, 0x40, State::switch_on_disabled},
                                             {0x4f, 0x0f, State::fault_reaction_active},
                                             {0x4f, 0x08, State::fault},
                                             {0x6f, 0x21, State::ready_to_switch_on},
                                             {0x6f, 0x23, State::switched_on},
                                             {0x6f, 0x27, State::operation_enabled},
                                             {0x6f, 0x07, State::quick_stop_active}}};
  for (const Pattern& pattern : patterns) {
    if ((bits & pattern.mask) == pattern.bits) return pattern.state;
  }
  return {};
}

/// Whether the state in a statusword is State::operation_enabled. Real-time: yes.
[[nodiscard]] constexpr bool in_operation(std::uint16_t bits) noexcept {
  return (bits & 0x6f) == 0x27;
}

/// Whether a drive may exert effort in a state: it follows commands, or brakes. Real-time: yes.
[[nodiscard]] constexpr bool may_exert(State state) noexcept {
  return state == State::operation_enabled || state == State::quick_stop_active ||
         state == State::fault_reaction_active;
}

/// Bit of the statusword: in the cyclic modes the drive follows the target
/// [CiA 402-2, cyclic synchronous modes]. Some drives never set it.
inline constexpr std::uint16_t follows_target = 0x1000;

// Values of the controlword.
inline constexpr std::uint16_t disable_voltage = 0x00;
inline constexpr std::uint16_t shutdown = 0x06;
inline constexpr std::uint16_t switch_on = 0x07;
inline constexpr std::uint16_t enable_operation = 0x0f;
inline constexpr std::uint16_t fault_reset = 0x80;

/// The controlword for the next transition towards operation enabled; disable_voltage in states
/// that the drive leaves by itself. Real-time: yes.
[[nodiscard]] constexpr std::uint16_t towards_operation(State state) noexcept {
  if (state == State::switch_on_disabled) return shutdown;
  if (state == State::ready_to_switch_on) return switch_on;
  if (state == State::fault) return fault_reset;
  const bool is_on = state == State::switched_on || state == State::operation_enabled;
  return is_on ? enable_operation : disable_voltage;
}

}  // namespace articula::cia402
