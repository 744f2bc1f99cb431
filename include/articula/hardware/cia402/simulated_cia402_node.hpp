// SPDX-License-Identifier: Apache-2.0
/// @file A simulated CANopen node of the profile CiA 402, without the motor.
#pragma once

#include "articula/hardware/can/can_batch.hpp"
#include "articula/hardware/cia402/cia402.hpp"
#include "articula/hardware/cia402/simulated_cia402_machine.hpp"
#include "articula/hardware/cia402/simulated_cia402_objects.hpp"

#include <array>
#include <cstdint>
#include <utility>

namespace articula {

/// A CANopen node of the profile CiA 402. It has objects, network management, process data, state
/// machine, heartbeat and emergency messages. It keeps the deadlines for commands and for the
/// host's heartbeat. It shares only the layout of frames with the codec, so each checks the other.
/// All functions are real-time.
class SimulatedCia402Node {
 public:
  SimulatedCia402Node() = default;

  /// @param node    1 .. 127
  /// @param period  of SYNC [s]
  /// @param quirks  deviations from the standard
  SimulatedCia402Node(std::uint8_t node, double period, const SimulatedCia402Quirks& quirks = {})
      : node_(node), period_(period), quirks_(quirks) {
    restart();
  }

  void restart() noexcept {
    objects_.restart(node_, quirks_);
    nmt_ = canopen::NmtState::boot_up;
    booting_ = quirks_.boot_time;
    machine_ = SimulatedCia402Machine(quirks_.transition_time);
    received_.fill({});
    commands_ = host_ = {};
    emergency_ = 0;
    since_heartbeat_ = 0;
  }

  /// Processes a frame from the bus.
  void receive(const CanFrame& frame, CanBatch& answers) noexcept {
    if (frame.extended || booting_ > 0) return;
    if (frame.identifier == canopen::nmt_identifier && frame.length == 2) {
      if (frame.data[1] == 0 || frame.data[1] == node_) manage(frame.data[0]);
    } else if (frame.identifier == canopen::sdo_request_base + node_) {
      if (nmt_ == canopen::NmtState::stopped) return;  // no access then [CiA 301, table 37]
      if (const auto request = canopen::decode_request(frame)) {
        answers.push_back(canopen::encode_answer(serve(*request), node_));
      }
    } else if (canopen::decode_heartbeat(frame) && objects_.is_heartbeat_of_host(frame)) {
      host_.feed();
    } else if (nmt_ == canopen::NmtState::operational) {
      for (std::uint16_t k = 0; k < Objects::pdo_count; ++k) {
        // A missing PDO has 0, which is the identifier of network management.
        if (frame.identifier == value(Objects::parameter(0x1400, k))) received_[k] = {true, frame};
      }
    }
  }

  /// SYNC: sends the measured figures, and puts the received process data into force.
  /// @param sync  a frame without the expected counter, or with an unexpected one, is ignored
  void take_sync(const CanFrame& sync, CanBatch& answers) noexcept {
    const bool has_counter = value(Objects::sync_counter) != 0;
    if (sync.length != (has_counter ? 1 : 0)) return;
    send_emergency(answers);
    report(answers);
    for (std::uint16_t k = 0; k < Objects::pdo_count; ++k) put_into_force(k);
  }

  /// Simulates a period: boot-up message, heartbeat, deadlines, emergency.
  void pass_period(CanBatch& answers) noexcept {
    if (booting_ > 0) booting_ -= period_;
    if (booting_ > period_ / 2) return;
    if (nmt_ == canopen::NmtState::boot_up) {
      booting_ = 0;
      answers.push_back(canopen::encode(nmt_, node_));
      nmt_ = canopen::NmtState::pre_operational;
    }
    if (machine_.pass(period_)) show_state();
    watch();
    send_emergency(answers);
    since_heartbeat_ += period_;
    const double interval = value({0x1017, 0}) * 1e-3;
    if (interval > 0 && since_heartbeat_ > interval - period_ / 2) {
      since_heartbeat_ = 0;
      answers.push_back(canopen::encode(nmt_, node_));
    }
  }

  /// Sets the measured figures, in the node's units.
  void show(std::int32_t position, std::int32_t velocity, std::int32_t torque) noexcept {
    objects_.set(cia402::position_actual, static_cast<std::uint32_t>(position));
    objects_.set(cia402::velocity_actual, static_cast<std::uint32_t>(velocity));
    objects_.set(cia402::torque_actual, static_cast<std::uint32_t>(torque) & 0xffff);
    show_state();
  }

  /// Faults with an error code that is not 0.
  void raise_fault(std::uint16_t code) noexcept {
    machine_.fault();
    objects_.set(cia402::error_code, code);
    emergency_ = code;
    show_state();
  }

  [[nodiscard]] bool enabled() const noexcept { return machine_.enabled(); }
  [[nodiscard]] cia402::Mode mode() const noexcept {
    return static_cast<cia402::Mode>(value(cia402::mode_display));
  }
  /// A target object, with its sign.
  [[nodiscard]] std::int32_t target(const canopen::ObjectAddress& address) const noexcept {
    const std::uint32_t bits = value(address);
    return address == cia402::target_torque
               ? static_cast<std::int32_t>(static_cast<std::int16_t>(bits))
               : static_cast<std::int32_t>(bits);
  }
  /// The value of any object; 0 without it.
  [[nodiscard]] std::uint32_t value(const canopen::ObjectAddress& address) const noexcept {
    return objects_.value(address);
  }

 private:
  using Objects = SimulatedCia402Objects;
  struct Received {
    bool is_new = false;
    CanFrame frame{};
  };
  /// The longest time between two frames, from the first frame on.
  struct Deadline {
    bool active = false;
    double silence = 0;  ///< [s]

    void feed() noexcept { *this = {true, 0}; }
    /// @return true once the limit is exceeded; a limit of 0 is none
    bool pass(double period, double limit) noexcept {
      silence += period;
      if (!active || limit <= 0 || silence <= limit + period / 2) return false;
      active = false;
      return true;
    }
  };

  void put_into_force(std::uint16_t number) noexcept {
    if (!std::exchange(received_[number].is_new, false)) return;
    const auto mapping = static_cast<std::uint16_t>(0x1600 + number);
    if (!objects_.unpack(mapping, received_[number].frame)) return;
    execute(static_cast<std::uint16_t>(value(cia402::controlword)));
    commands_.feed();
    deadline_ = value(Objects::parameter(0x1400, number, 5)) * 1e-3;
  }

  void send_emergency(CanBatch& answers) noexcept {
    if (emergency_ == 0) return;
    answers.push_back(
        canopen::encode(canopen::Emergency{std::exchange(emergency_, {}), 0x01}, node_));
  }

  void report(CanBatch& answers) noexcept {
    if (nmt_ != canopen::NmtState::operational) return;
    for (std::uint16_t k = 0; k < Objects::pdo_count; ++k) {
      const std::uint32_t identifier = value(Objects::parameter(0x1800, k));
      if (identifier == 0 || (identifier & Objects::off) != 0) continue;
      answers.push_back(objects_.pack(static_cast<std::uint16_t>(0x1a00 + k), identifier & 0x7ff));
    }
  }

  void watch() noexcept {
    if (commands_.pass(period_, deadline_)) {
      emergency_ = 0x8250;  // RPDO timeout [CiA 301, table 26]
      if (enabled()) raise_fault(emergency_);
    }
    if (host_.pass(period_, (value(Objects::heartbeat_consumer) & 0xffff) * 1e-3)) {
      emergency_ = 0x8130;  // heartbeat error
      if (nmt_ == canopen::NmtState::operational) leave_operation();
    }
  }

  void manage(std::uint8_t command) noexcept {
    switch (static_cast<canopen::NmtCommand>(command)) {
      case canopen::NmtCommand::start:
        return void(nmt_ = canopen::NmtState::operational);
      case canopen::NmtCommand::stop:
        leave_operation();
        nmt_ = canopen::NmtState::stopped;
        return;
      case canopen::NmtCommand::enter_pre_operational:
        return leave_operation();
      case canopen::NmtCommand::reset_node:
      case canopen::NmtCommand::reset_communication:
        return restart();
    }
  }

  /// Leaves the operational state with the reaction of object 6007h [CiA 402-2, abort connection
  /// option code]. 0 is none, 1 a fault, 2 and 3 a stop.
  void leave_operation() noexcept {
    nmt_ = canopen::NmtState::pre_operational;
    received_.fill({});
    commands_.active = false;  // the deadline for commands holds only in operation
    const std::uint32_t option = value(cia402::abort_connection);
    if (option == 1 && enabled()) raise_fault(0x8130);  // life guard error [CiA 301, table 26]
    if (option == 2 || option == 3) execute(cia402::disable_voltage);
  }

  [[nodiscard]] canopen::Sdo serve(const canopen::Sdo& request) noexcept {
    const canopen::Sdo answer = objects_.serve(request, nmt_ == canopen::NmtState::operational);
    if (answer.kind != canopen::SdoKind::download) return answer;
    for (std::uint16_t k = 0; k < Objects::pdo_count; ++k) {
      const std::uint32_t identifier = value(Objects::parameter(0x1400, k));
      // A frame for a process data object that is off is dropped.
      if ((identifier & Objects::off) != 0) received_[k] = {};
      if (request.address == Objects::parameter(0x1400, k, 5)) deadline_ = request.value * 1e-3;
    }
    if (request.address == Objects::heartbeat_consumer) host_.active = false;
    if (request.address == cia402::controlword) execute(static_cast<std::uint16_t>(request.value));
    show_state();
    return answer;
  }

  void execute(std::uint16_t controlword) noexcept {
    if (machine_.execute(controlword)) objects_.set(cia402::error_code, 0);
    show_state();
  }

  void show_state() noexcept {
    if (quirks_.shows_mode_at_once || enabled()) {
      objects_.set(cia402::mode_display, value(cia402::mode_of_operation));
    }
    objects_.set(cia402::statusword, machine_.statusword(quirks_.shows_following));
  }

  std::uint8_t node_ = 0;
  double period_ = 1e-3;
  SimulatedCia402Quirks quirks_{};
  SimulatedCia402Objects objects_{};
  canopen::NmtState nmt_ = canopen::NmtState::boot_up;
  SimulatedCia402Machine machine_{};
  std::array<Received, Objects::pdo_count> received_{};
  Deadline commands_{}, host_{};
  double deadline_ = 0;          ///< for commands [s]
  std::uint16_t emergency_ = 0;  ///< code of the next emergency message
  double booting_ = 0;           ///< remaining time [s]
  double since_heartbeat_ = 0;   ///< [s]
};

}  // namespace articula
