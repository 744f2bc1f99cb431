// SPDX-License-Identifier: Apache-2.0
/// @file How one CiA 402 drive is brought to operation enabled.
#pragma once

#include "articula/hardware/can_batch.hpp"
#include "articula/hardware/can_codec.hpp"
#include "articula/hardware/cia402.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace articula {

/// Brings one drive to operation enabled by access to its objects, one request at a time: checks
/// that it is a CiA 402 drive, maps the process data, sets the mode, starts the node, resets a
/// fault and walks the state machine. Nothing moves meanwhile: the target is zero, or the position
/// where the drive stands, before it is enabled; and a command of the past that may still wait for
/// SYNC in the drive is dropped, since the node leaves the operational state first. All objects are
/// accessed by expedited transfers; none of them is longer than four bytes.
class Cia402SetUp {
 public:
  /// @param node      1 .. 127
  /// @param mode      of operation
  /// @param period    of the loop [ms]
  /// @param deadline  longest time without commands that the drive is to accept [ms]
  Cia402SetUp(std::uint8_t node, cia402::Mode mode, std::uint8_t period, std::uint16_t deadline)
      : node_(node), mode_(mode) {
    const cia402::Target target = cia402::target_of(mode);
    const std::uint32_t receive = canopen::receive_pdo_1_base + node;
    const std::uint32_t transmit_1 = canopen::transmit_pdo_1_base + node;
    const std::uint32_t transmit_2 = canopen::transmit_pdo_2_base + node;
    // A process data object is switched off while it is changed [CiA 301, 7.5.2.36].
    constexpr std::uint32_t off = 0x8000'0000U;
    const auto entry = [](const canopen::ObjectAddress& object, std::uint32_t bits) {
      return std::uint32_t{object.index} << 16 | std::uint32_t{object.subindex} << 8 | bits;
    };
    const auto command = [](canopen::NmtCommand wanted) {
      return Step{{}, Action::command_node, static_cast<std::uint32_t>(wanted)};
    };
    // An enabled drive may keep its effort where it leaves the operational state.
    add({cia402::controlword, Action::try_to_write, cia402::disable_voltage, 2});
    add(command(canopen::NmtCommand::enter_pre_operational));
    add({{0x1000, 0}, Action::expect_profile_402});
    add({{0x1017, 0}, Action::write, 100, 2});  // heartbeat every 100 ms
    add({{0x1400, 1}, Action::write, off | receive, 4});
    add({{0x1400, 2}, Action::write, 1, 1});  // in force at SYNC
    add({{0x1400, 5}, Action::write_if_there, deadline, 2});
    add({{0x1600, 0}, Action::write, 0, 1});
    add({{0x1600, 1}, Action::write, entry(cia402::controlword, 16), 4});
    add({{0x1600, 2}, Action::write, entry(target.address, 8U * target.size), 4});
    add({{0x1600, 0}, Action::write, 2, 1});
    add({{0x1400, 1}, Action::write, receive, 4});
    add({{0x1800, 1}, Action::write, off | transmit_1, 4});
    add({{0x1800, 2}, Action::write, 1, 1});  // at every SYNC
    add({{0x1a00, 0}, Action::write, 0, 1});
    add({{0x1a00, 1}, Action::write, entry(cia402::statusword, 16), 4});
    add({{0x1a00, 2}, Action::write, entry(cia402::position_actual, 32), 4});
    add({{0x1a00, 3}, Action::write, entry(cia402::torque_actual, 16), 4});
    add({{0x1a00, 0}, Action::write, 3, 1});
    add({{0x1800, 1}, Action::write, transmit_1, 4});
    add({{0x1801, 1}, Action::write, off | transmit_2, 4});
    add({{0x1801, 2}, Action::write, 1, 1});
    add({{0x1a01, 0}, Action::write, 0, 1});
    add({{0x1a01, 1}, Action::write, entry(cia402::velocity_actual, 32), 4});
    add({{0x1a01, 2}, Action::write, entry(cia402::error_code, 16), 4});
    add({{0x1a01, 0}, Action::write, 2, 1});
    add({{0x1801, 1}, Action::write, transmit_2, 4});
    add({cia402::interpolation_period, Action::write_if_there, period, 1});
    add({cia402::interpolation_exponent, Action::write_if_there, 0xfd, 1});  // 10^-3 s
    prepare_ = count_;
    add({cia402::controlword, Action::write, cia402::disable_voltage, 2});
    add({cia402::mode_of_operation, Action::write, static_cast<std::uint32_t>(mode), 1});
    if (mode == cia402::Mode::cyclic_synchronous_position) {
      add({cia402::position_actual, Action::remember});
      add({target.address, Action::write_remembered, 0, target.size});
    } else {
      add({target.address, Action::write, 0, target.size});
    }
    add({cia402::mode_display, Action::expect_mode});
    start_ = count_;
    add(command(canopen::NmtCommand::start));
    add({cia402::statusword, Action::read_state});
    add({cia402::controlword, Action::advance_state, 0, 2});
  }

  /// Begins anew. Real-time: yes.
  void restart() noexcept {
    step_ = 0;
    waiting_ = false;
    failed_ = false;
    resetting_ = doubted_ = false;
    abort_code_ = 0;
  }

  /// Starts the node again and looks at its state, where the drive does not show that it is enabled
  /// some time after it was: the command to start may have been lost. Real-time: yes.
  void doubt(std::chrono::nanoseconds elapsed) noexcept {
    if (step_ < count_ || elapsed - asked_ < patience) return;
    step_ = start_;
    doubted_ = true;
  }

  /// Appends the next request, if the node has answered the one before; without an answer that one
  /// is repeated after 100 ms.
  /// @param elapsed  time since the set-up began
  /// @param batch    receives the request
  /// Real-time: yes.
  [[nodiscard]] CanSetUp advance(std::chrono::nanoseconds elapsed, CanBatch& batch) noexcept {
    if (failed_) return CanSetUp::failed;
    while (step_ < count_ && (!waiting_ || elapsed - asked_ >= patience)) {
      const Step& step = steps_[step_];
      if (step.action == Action::command_node) {
        batch.push_back(canopen::encode(static_cast<canopen::NmtCommand>(step.value), node_));
        ++step_;
        continue;
      }
      if (waiting_ && step.action == Action::try_to_write) {
        waiting_ = false;
        ++step_;
        continue;
      }
      batch.push_back(canopen::encode_request(request(step), node_));
      asked_ = elapsed;
      waiting_ = true;
    }
    return step_ == count_ ? CanSetUp::done : CanSetUp::in_progress;
  }

  /// Takes in the node's answer; one to another question is ignored. Real-time: yes.
  void take(const canopen::Sdo& answer) noexcept {
    if (step_ == count_ || !waiting_ || answer.address != steps_[step_].address) return;
    const Step& step = steps_[step_];
    waiting_ = false;
    if (answer.kind == canopen::SdoKind::abort) {
      abort_code_ = answer.value;
      failed_ = step.action != Action::write_if_there && step.action != Action::try_to_write;
      if (!failed_) ++step_;
      return;
    }
    if (answer.kind != request(step).kind) {
      waiting_ = true;  // an answer to something else that was asked of the same object
      return;
    }
    switch (step.action) {
      case Action::expect_profile_402:
        failed_ = (answer.value & 0xffff) != 402;
        if (failed_) return;
        break;
      case Action::expect_mode:  // shows the mode only after a while in some drives
        if (answer.value != static_cast<std::uint32_t>(mode_)) return;
        break;
      case Action::remember:
        remembered_ = answer.value;
        break;
      case Action::read_state:
        state_ = cia402::state_of(static_cast<std::uint16_t>(answer.value));
        if (state_ == cia402::State::operation_enabled) {
          step_ = count_ - 1;
        } else if (doubted_) {  // it has let go, and may stand elsewhere by now
          doubted_ = false;
          step_ = prepare_;
          return;
        }
        // A fault is reset by the bit's rise, so a second try takes a fall in between.
        resetting_ = state_ == cia402::State::fault && !resetting_;
        break;
      case Action::advance_state:  // and look what came of it
        step_ -= 1;
        return;
      case Action::write:
      case Action::write_if_there:
      case Action::try_to_write:
      case Action::write_remembered:
      case Action::command_node:
        break;
    }
    ++step_;
  }

  /// The code with which the node has aborted an access last; 0 if it has not. Real-time: yes.
  [[nodiscard]] std::uint32_t abort_code() const noexcept { return abort_code_; }
  /// The object that is being dealt with. Real-time: yes.
  [[nodiscard]] canopen::ObjectAddress object() const noexcept {
    return step_ < count_ ? steps_[step_].address : canopen::ObjectAddress{};
  }

 private:
  enum class Action : unsigned char {
    write,
    write_if_there,  ///< an object that drives need not have
    try_to_write,    ///< once; a node in the stopped state does not answer
    expect_profile_402,
    expect_mode,
    remember,
    write_remembered,
    command_node,  ///< network management, which is not answered
    read_state,
    advance_state,
  };
  struct Step {
    canopen::ObjectAddress address{};
    Action action = Action::write;
    std::uint32_t value = 0;
    std::uint8_t size = 0;
  };

  void add(const Step& step) noexcept { steps_[count_++] = step; }

  [[nodiscard]] canopen::Sdo request(const Step& step) const noexcept {
    std::uint32_t value = step.value;
    if (step.action == Action::write_remembered) value = remembered_;
    if (step.action == Action::advance_state) {
      value = state_ ? cia402::towards_operation(*state_) : cia402::disable_voltage;
      if (state_ == cia402::State::fault && !resetting_) value = cia402::disable_voltage;
    }
    const auto kind = step.size == 0 ? canopen::SdoKind::upload : canopen::SdoKind::download;
    return {kind, step.address, value, step.size};
  }

  static constexpr std::chrono::milliseconds patience{100};  ///< for an answer

  std::uint8_t node_;
  cia402::Mode mode_;
  std::array<Step, 40> steps_{};
  std::size_t count_ = 0;
  std::size_t step_ = 0;
  std::size_t prepare_ = 0;  ///< the step from which on the drive is made ready
  std::size_t start_ = 0;    ///< the step from which on the node is operational
  bool waiting_ = false;
  bool failed_ = false;
  bool resetting_ = false;  ///< the controlword is to reset a fault
  bool doubted_ = false;    ///< it was done, but that does not show
  std::uint32_t abort_code_ = 0;
  std::uint32_t remembered_ = 0;
  std::optional<cia402::State> state_{};
  std::chrono::nanoseconds asked_{};
};

}  // namespace articula
