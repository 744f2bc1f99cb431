// SPDX-License-Identifier: Apache-2.0
/// @file One CANopen node of the profile CiA 402, without the motor.
#pragma once

#include "articula/hardware/can_batch.hpp"
#include "articula/hardware/cia402.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace articula {

/// One CANopen node of the profile CiA 402: object dictionary with an expedited server, network
/// management, process data that follow their mapping objects, state machine, heartbeat and
/// emergency messages, and the deadline for commands. It is written from the standard's point of
/// view and shares nothing with the codec but the layout of frames, so each checks the other.
class SimulatedCia402Node {
 public:
  SimulatedCia402Node() = default;

  /// @param node    1 .. 127
  /// @param period  of SYNC [s]
  SimulatedCia402Node(std::uint8_t node, double period) : node_(node), period_(period) {
    restart();
  }

  /// As after switching on. Real-time: yes.
  void restart() noexcept {
    objects_ = factory_objects;
    const auto with_node = [&](const canopen::ObjectAddress& address, std::uint32_t base) {
      find(address)->value = 0x8000'0000U | (base + node_);
    };
    with_node({0x1400, 1}, canopen::receive_pdo_1_base);
    with_node({0x1800, 1}, canopen::transmit_pdo_1_base);
    with_node({0x1801, 1}, canopen::transmit_pdo_2_base);
    nmt_ = canopen::NmtState::boot_up;
    state_ = cia402::State::switch_on_disabled;
    last_controlword_ = 0;
    has_received_ = supervised_ = emergency_due_ = false;
    silence_ = since_heartbeat_ = 0;
  }

  /// Takes a frame from the bus. Real-time: yes.
  void receive(const CanFrame& frame, CanBatch& answers) noexcept {
    if (frame.extended) return;
    if (frame.identifier == canopen::nmt_identifier && frame.length == 2) {
      if (frame.data[1] == 0 || frame.data[1] == node_) manage(frame.data[0]);
    } else if (frame.identifier == canopen::sdo_request_base + node_) {
      if (nmt_ == canopen::NmtState::stopped) return;  // no access then [CiA 301, table 37]
      if (const auto request = canopen::decode_request(frame)) {
        answers.push_back(canopen::encode_answer(serve(*request), node_));
      }
    } else if (nmt_ == canopen::NmtState::operational && frame.identifier == value({0x1400, 1})) {
      received_ = frame;
      has_received_ = true;
    }
  }

  /// SYNC: the process data that have come are put into force. Real-time: yes.
  void put_into_force() noexcept {
    if (!has_received_) return;
    has_received_ = false;
    std::size_t length = 0;
    for_each_mapped(0x1600, [&](const Object& object) { length += object.size; });
    if (received_.length < length) return;  // too short: not applied [CiA 301, 7.2.2]
    std::size_t offset = 0;
    for_each_mapped(0x1600, [&](Object& object) {
      object.value = 0;
      for (std::size_t k = 0; k < object.size; ++k) {
        object.value |= std::uint32_t{received_.data[offset++]} << (8 * k);
      }
    });
    obey(static_cast<std::uint16_t>(value(cia402::controlword)));
    supervised_ = true;
    silence_ = 0;
  }

  /// Lets a period pass: boot-up message, heartbeat, deadline, emergency. Real-time: yes.
  void pass_period(CanBatch& answers) noexcept {
    if (nmt_ == canopen::NmtState::boot_up) {
      answers.push_back(canopen::encode(nmt_, node_));
      nmt_ = canopen::NmtState::pre_operational;
    }
    silence_ += period_;
    const double deadline = value({0x1400, 5}) * 1e-3;
    const bool late = supervised_ && deadline > 0 && silence_ > deadline + period_ / 2;
    if (late && enabled()) raise_fault(0x8250);  // RPDO timeout [CiA 301, table 26]
    if (emergency_due_) {
      emergency_due_ = false;
      answers.push_back(canopen::encode(
          canopen::Emergency{static_cast<std::uint16_t>(value(cia402::error_code)), 0x01}, node_));
    }
    since_heartbeat_ += period_;
    const double interval = value({0x1017, 0}) * 1e-3;
    if (interval > 0 && since_heartbeat_ > interval - period_ / 2) {
      since_heartbeat_ = 0;
      answers.push_back(canopen::encode(nmt_, node_));
    }
  }

  /// SYNC: the process data that are to be sent. Real-time: yes.
  void report(CanBatch& answers) noexcept {
    if (nmt_ != canopen::NmtState::operational) return;
    for (const std::uint16_t pdo : {std::uint16_t{0}, std::uint16_t{1}}) {
      const std::uint32_t identifier = value({static_cast<std::uint16_t>(0x1800 + pdo), 1});
      if ((identifier & 0x8000'0000U) != 0) continue;
      CanFrame frame;
      frame.identifier = identifier & 0x7ff;
      for_each_mapped(static_cast<std::uint16_t>(0x1a00 + pdo), [&](const Object& object) {
        for (std::size_t k = 0; k < object.size && frame.length < 8; ++k) {
          frame.data[frame.length++] = static_cast<std::uint8_t>(object.value >> (8 * k) & 0xff);
        }
      });
      answers.push_back(frame);
    }
  }

  /// The joint as the node is to show it, in its units. Real-time: yes.
  void show(std::int32_t position, std::int32_t velocity, std::int32_t torque) noexcept {
    find(cia402::position_actual)->value = static_cast<std::uint32_t>(position);
    find(cia402::velocity_actual)->value = static_cast<std::uint32_t>(velocity);
    find(cia402::torque_actual)->value = static_cast<std::uint32_t>(torque) & 0xffff;
    show_state();
  }

  /// Faults with an error code that is not 0. Real-time: yes.
  void raise_fault(std::uint16_t code) noexcept {
    state_ = cia402::State::fault;
    supervised_ = false;
    find(cia402::error_code)->value = code;
    emergency_due_ = true;
    show_state();
  }

  [[nodiscard]] bool enabled() const noexcept { return state_ == cia402::State::operation_enabled; }
  [[nodiscard]] cia402::State state() const noexcept { return state_; }
  [[nodiscard]] cia402::Mode mode() const noexcept {
    return static_cast<cia402::Mode>(value(cia402::mode_display));
  }
  /// A target object, with its sign. Real-time: yes.
  [[nodiscard]] std::int32_t target(const canopen::ObjectAddress& address) const noexcept {
    const std::uint32_t bits = value(address);
    return address == cia402::target_torque
               ? static_cast<std::int32_t>(static_cast<std::int16_t>(bits))
               : static_cast<std::int32_t>(bits);
  }
  /// Any object's value; 0 if there is none at the address. Real-time: yes.
  [[nodiscard]] std::uint32_t value(const canopen::ObjectAddress& address) const noexcept {
    for (const Object& object : objects_) {
      if (object.address == address) return object.value;
    }
    return 0;
  }

 private:
  struct Object {
    canopen::ObjectAddress address{};
    std::uint8_t size = 0;  ///< [bytes]
    bool writable = false;
    std::uint32_t value = 0;
  };

  static constexpr auto factory_objects = std::to_array<Object>({
      {{0x1000, 0}, 4, false, 0x0002'0192},  // servo drive of the profile 402
      {{0x1017, 0}, 2, true, 0},
      {{0x1400, 1}, 4, true, 0},
      {{0x1400, 2}, 1, true, 255},
      {{0x1400, 5}, 2, true, 0},
      {{0x1600, 0}, 1, true, 0},
      {{0x1600, 1}, 4, true, 0},
      {{0x1600, 2}, 4, true, 0},
      {{0x1600, 3}, 4, true, 0},
      {{0x1800, 1}, 4, true, 0},
      {{0x1800, 2}, 1, true, 255},
      {{0x1a00, 0}, 1, true, 0},
      {{0x1a00, 1}, 4, true, 0},
      {{0x1a00, 2}, 4, true, 0},
      {{0x1a00, 3}, 4, true, 0},
      {{0x1801, 1}, 4, true, 0},
      {{0x1801, 2}, 1, true, 255},
      {{0x1a01, 0}, 1, true, 0},
      {{0x1a01, 1}, 4, true, 0},
      {{0x1a01, 2}, 4, true, 0},
      {{0x1a01, 3}, 4, true, 0},
      {cia402::abort_connection, 2, true, 0},
      {cia402::error_code, 2, false, 0},
      {cia402::controlword, 2, true, 0},
      {cia402::statusword, 2, false, 0x40},
      {cia402::mode_of_operation, 1, true, 0},
      {cia402::mode_display, 1, false, 0},
      {cia402::position_actual, 4, false, 0},
      {cia402::velocity_actual, 4, false, 0},
      {cia402::target_torque, 2, true, 0},
      {cia402::torque_actual, 2, false, 0},
      {cia402::target_position, 4, true, 0},
      {cia402::interpolation_period, 1, true, 1},
      {cia402::interpolation_exponent, 1, true, 0xfd},
      {cia402::target_velocity, 4, true, 0},
  });

  [[nodiscard]] Object* find(const canopen::ObjectAddress& address) noexcept {
    const auto at = std::ranges::find(objects_, address, &Object::address);
    return at == objects_.end() ? nullptr : &*at;
  }

  /// Calls function(object) for each object that a process data object is made of.
  template <class Function>
  void for_each_mapped(std::uint16_t mapping, Function function) noexcept {
    const std::uint32_t count = std::min(value({mapping, 0}), std::uint32_t{3});
    for (std::uint8_t k = 1; k <= count; ++k) {
      const std::uint32_t entry = value({mapping, k});
      Object* const object = find(
          {static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8 & 0xff)});
      if (object) function(*object);
    }
  }

  void manage(std::uint8_t command) noexcept {
    switch (static_cast<canopen::NmtCommand>(command)) {
      case canopen::NmtCommand::start:
        nmt_ = canopen::NmtState::operational;
        return;
      case canopen::NmtCommand::stop:
      case canopen::NmtCommand::enter_pre_operational:
        nmt_ = command == static_cast<std::uint8_t>(canopen::NmtCommand::stop)
                   ? canopen::NmtState::stopped
                   : canopen::NmtState::pre_operational;
        has_received_ = supervised_ = false;  // commands are watched in operation alone
        react_to_abort();
        return;
      case canopen::NmtCommand::reset_node:
      case canopen::NmtCommand::reset_communication:
        return restart();
    }
  }

  /// What the node does when it leaves the operational state, as object 6007h says
  /// [CiA 402-2, abort connection option code]: 0 nothing, 1 a fault, 2 and 3 a stop.
  void react_to_abort() noexcept {
    const std::uint32_t option = value(cia402::abort_connection);
    if (option == 1 && enabled()) raise_fault(0x8130);  // life guard error [CiA 301, table 26]
    if (option == 2 || option == 3) obey(cia402::disable_voltage);
  }

  /// The answer of the object dictionary's server; abort codes of [CiA 301, table 22].
  [[nodiscard]] canopen::Sdo serve(const canopen::Sdo& request) noexcept {
    const auto abort = [&](std::uint32_t code) {
      return canopen::Sdo{canopen::SdoKind::abort, request.address, code, 4};
    };
    Object* const object = find(request.address);
    if (!object) return abort(0x0602'0000);  // object does not exist
    if (request.kind == canopen::SdoKind::upload) {
      return {request.kind, request.address, object->value, object->size};
    }
    if (!object->writable) return abort(0x0601'0002);             // read only
    if (request.size != object->size) return abort(0x0607'0010);  // length does not match
    if (is_locked(request)) return abort(0x0800'0022);            // present device state
    object->value = request.value;
    // What has come for a process data object that is switched off is dropped.
    if ((value({0x1400, 1}) & 0x8000'0000U) != 0) has_received_ = false;
    if (request.address == cia402::controlword) obey(static_cast<std::uint16_t>(request.value));
    if (request.address == cia402::mode_of_operation) {
      find(cia402::mode_display)->value = request.value;
    }
    return {request.kind, request.address, 0, 0};
  }

  /// Mapping objects are locked while their process data object is switched on, and its entries
  /// while their number is not 0.
  [[nodiscard]] bool is_locked(const canopen::Sdo& request) const noexcept {
    const std::uint16_t index = request.address.index;
    if (index != 0x1600 && index != 0x1a00 && index != 0x1a01) return false;
    const auto parameters = static_cast<std::uint16_t>(index - 0x0200);
    const bool on = (value({parameters, 1}) & 0x8000'0000U) == 0;
    return on || (request.address.subindex > 0 && value({index, 0}) != 0);
  }

  /// The state machine [CiA 402-2, controlword].
  void obey(std::uint16_t word) noexcept {
    using cia402::State;
    const bool reset = (word & 0x80) != 0 && (last_controlword_ & 0x80) == 0;
    last_controlword_ = word;
    if (state_ == State::fault) {
      if (reset) {
        state_ = State::switch_on_disabled;
        find(cia402::error_code)->value = 0;
      }
    } else if ((word & 0x06) != 0x06) {  // no voltage, or quick stop
      state_ = State::switch_on_disabled;
    } else if ((word & 0x01) == 0) {
      state_ = State::ready_to_switch_on;
    } else if ((word & 0x08) == 0) {
      if (state_ == State::ready_to_switch_on || enabled()) state_ = State::switched_on;
    } else if (state_ == State::switched_on) {
      state_ = State::operation_enabled;
    }
    if (!enabled()) supervised_ = false;
    show_state();
  }

  void show_state() noexcept {
    std::uint32_t bits = 0x40;
    if (state_ == cia402::State::ready_to_switch_on) bits = 0x21;
    if (state_ == cia402::State::switched_on) bits = 0x33;
    if (enabled()) bits = 0x37;
    if (state_ == cia402::State::fault) bits = 0x08;
    constexpr std::uint32_t remote = 0x200;
    find(cia402::statusword)->value = bits | remote;
  }

  std::uint8_t node_ = 0;
  double period_ = 1e-3;
  std::array<Object, factory_objects.size()> objects_ = factory_objects;
  canopen::NmtState nmt_ = canopen::NmtState::boot_up;
  cia402::State state_ = cia402::State::switch_on_disabled;
  std::uint16_t last_controlword_ = 0;
  CanFrame received_{};
  bool has_received_ = false;
  bool supervised_ = false;  ///< commands have come since operation was enabled
  bool emergency_due_ = false;
  double silence_ = 0;          ///< since the last command [s]
  double since_heartbeat_ = 0;  ///< [s]
};

}  // namespace articula
