// SPDX-License-Identifier: Apache-2.0
/// @file Enabling one CiA 402 drive, and releasing it again.
#pragma once

#include "articula/hardware/can/can_batch.hpp"
#include "articula/hardware/can/can_codec.hpp"
#include "articula/hardware/canopen/canopen_sdo_client.hpp"
#include "articula/hardware/cia402/cia402_pdo_set_up.hpp"
#include "articula/hardware/cia402/cia402_script.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace articula {

/// Enables one drive by access to its objects, one request at a time, through the steps of
/// Cia402Script. It checks the profile, maps the process data, sets the mode, starts the node,
/// resets a fault and walks the state machine. All transfers are expedited. All functions but the
/// constructor are real-time.
///
/// Nothing moves meanwhile: the target is zero, or the drive's position. The node leaves the
/// operational state first, which drops an old command that may still wait for SYNC. The refusal of
/// a necessary value ends the set-up, unless the object has that value already.
class Cia402SetUp {
 public:
  Cia402SetUp() = default;
  /// @param drive     its node, watchdog and further objects
  /// @param mode      of operation
  /// @param period    of the loop [ms]
  /// @param deadline  of the watchdog: longest time without commands or heartbeats [ms]
  /// @param sync      sender of SYNC
  Cia402SetUp(const Cia402Drive& drive, cia402::Mode mode, std::uint8_t period,
              std::uint16_t deadline, SyncProducer sync)
      : mode_(mode),
        node_(drive.node),
        script_(drive, mode, period, deadline, sync),
        client_(drive.node),
        pdos_(drive, mode, period, deadline) {
    restart();
  }

  void restart() noexcept {
    begin(script_.set_up);
    pdos_.restart();
    abort_code_ = stop_option_refusal_ = 0;
    failed_object_ = {};
    lacks_watchdog_ = retried_ = false;
  }

  /// Begins to switch the watchdog of a disabled drive off. A failed set-up keeps its reason.
  void begin_release() noexcept { begin(script_.release); }

  /// Starts the node again after 100 ms with SYNC, and reads its state. For a drive whose feedback
  /// does not show that it is enabled: the start command may have been lost.
  /// @param has_sync  whether there is SYNC, without which no drive sends feedback
  void check_again(std::chrono::nanoseconds elapsed, bool has_sync) noexcept {
    if (step_ < end_) return;
    if (!has_sync) finished_ = elapsed;
    if (elapsed - finished_ < canopen::SdoClient::patience) return;
    step_ = script_.start;
    finished_ = std::chrono::nanoseconds(-1);
    checks_again_ = true;
  }

  /// Appends the next request, or repeats one without an answer for 100 ms.
  /// @param elapsed  time since the set-up, or the release, began
  [[nodiscard]] CanSetUp advance(std::chrono::nanoseconds elapsed, CanBatch& batch) noexcept {
    command_.reset();
    if (failed_) return CanSetUp::failed;
    while (step_ < end_ && (!client_.waiting() || client_.overdue(elapsed))) {
      const Cia402Step& step = script_[step_];
      if (std::exchange(begun_step_, step_) != step_) step_begun_ = elapsed;
      if (step.action == Action::command_node) {
        command_ = static_cast<canopen::NmtCommand>(step.value);
        batch.push_back(canopen::encode(*command_, node_));
        ++step_;
        continue;
      }
      if (step.impatient && elapsed - step_begun_ >= canopen::SdoClient::patience) {
        client_.restart();
        ++step_;
        continue;
      }
      if (std::exchange(leaves_operation_, false)) {
        batch.push_back(canopen::encode(canopen::NmtCommand::enter_pre_operational, node_));
      }
      client_.send(request(step), elapsed, batch);
    }
    if (step_ < end_) return CanSetUp::in_progress;
    if (finished_.count() < 0) finished_ = elapsed;
    return CanSetUp::done;
  }

  /// Processes the node's answer; an answer to another request is ignored.
  void take(const canopen::Sdo& answer) noexcept {
    if (step_ == end_ || !client_.take(answer)) return;
    const Cia402Step& step = script_[step_];
    if (step.action == Action::set_up_pdos) return take_for_pdos(answer);
    if (std::exchange(verifies_, false)) return step.is_met_by(answer) ? void(++step_) : fail();
    if (answer.kind == canopen::SdoKind::abort) return take_abort(step, answer);
    const bool shows_mode = (answer.value & 0xff) == static_cast<std::uint32_t>(mode_);
    switch (step.action) {
      case Action::expect: {
        const std::uint32_t value = answer.value & 0xffff;
        if (value >= step.value && value <= step.highest) break;
        abort_code_ = stop_option_refusal_;
        return fail();
      }
      case Action::skip_if_zero:
        if (answer.value == 0) step_ += step.value;
        break;
      case Action::await_mode:
        if (!shows_mode) return;  // some drives show it after a while
        step_ += step.value;
        break;
      case Action::remember:
        remembered_ = answer.value;
        break;
      case Action::read_state:
        return take_state(static_cast<std::uint16_t>(answer.value & 0xffff));
      case Action::advance_state:
        return void(step_ = script_.start + 1);  // reads the state
      case Action::confirm_mode:                 // some drives show the mode only now
        if (shows_mode) break;
        return void(step_ = script_.start + 1);
      default:
        break;
    }
    ++step_;
  }

  [[nodiscard]] const cia402::ProcessData& process_data() const noexcept {
    return pdos_.process_data();
  }
  /// The last command to the node that `advance` has appended in its last call, if it has.
  [[nodiscard]] const std::optional<canopen::NmtCommand>& command() const noexcept {
    return command_;
  }
  [[nodiscard]] bool ended() const noexcept { return failed_ || step_ == end_; }
  [[nodiscard]] bool failed() const noexcept { return failed_; }
  [[nodiscard]] bool lacks_watchdog() const noexcept { return lacks_watchdog_; }
  /// The code of the node's last refusal of something necessary; 0 without one.
  [[nodiscard]] std::uint32_t abort_code() const noexcept { return abort_code_; }
  /// The object of the current step, or at which the set-up has failed.
  [[nodiscard]] canopen::ObjectAddress object() const noexcept {
    if (failed_object_.index != 0) return failed_object_;
    return step_ < end_ ? request(script_[step_]).address : canopen::ObjectAddress{};
  }

 private:
  using Action = Cia402Step::Action;

  void begin(const Cia402Script::Part& part) noexcept {
    step_ = part.begin;
    end_ = part.end;
    begun_step_ = Cia402Script::capacity;
    finished_ = std::chrono::nanoseconds(-1);
    failed_ = verifies_ = resets_fault_ = checks_again_ = false;
    left_operation_ = leaves_operation_ = false;
    client_.restart();
  }
  void fail() noexcept {
    constexpr std::uint32_t present_device_state = 0x0800'0022;
    if (abort_code_ == present_device_state && !retried_) {
      restart();  // the command to leave operation may have been lost, or is not executed yet
      retried_ = true;
      return;
    }
    failed_object_ = client_.request().address;
    lacks_watchdog_ =
        failed_object_ == Cia402Script::heartbeat_consumer ||
        (failed_object_ == cia402::abort_connection && script_[step_].action == Action::expect);
    failed_ = true;
  }

  void take_for_pdos(const canopen::Sdo& answer) noexcept {
    pdos_.take(answer);
    if (pdos_.done()) ++step_;
    if (!pdos_.failed()) return;
    abort_code_ = pdos_.refusal().value;
    fail();
    if (!failed_) return;  // it tries again
    failed_object_ = pdos_.refusal().address;
    lacks_watchdog_ = pdos_.lacks_deadline();
  }

  void take_abort(const Cia402Step& step, const canopen::Sdo& answer) noexcept {
    if (step.action == Action::skip_if_zero) {
      step_ += step.value + 1;
    } else if (step.action == Action::disarm && !left_operation_) {
      left_operation_ = leaves_operation_ = true;  // and tries again
    } else if (step.optional) {
      if (step.address == cia402::abort_connection) stop_option_refusal_ = answer.value;
      ++step_;
    } else {
      abort_code_ = answer.value;
      if (step.action != Action::write) return fail();
      verifies_ = true;
    }
  }

  void take_state(std::uint16_t statusword) noexcept {
    state_ = cia402::state_of(statusword);
    if (state_ == cia402::State::operation_enabled) {
      step_ = script_.start + 3;
    } else if (std::exchange(checks_again_, false)) {
      step_ = script_.prepare;  // the drive was disabled, and its joint may have moved
    } else {
      // The rise of a bit resets a fault, so a second try needs a fall in between.
      resets_fault_ = state_ == cia402::State::fault && !resets_fault_;
      ++step_;
    }
  }

  [[nodiscard]] canopen::Sdo request(const Cia402Step& step) const noexcept {
    if (step.action == Action::set_up_pdos) return pdos_.request();
    if (verifies_) return canopen::read_request(step.address);
    canopen::Sdo request = step.request();
    if (step.action == Action::disarm && step.address == Cia402Script::first_deadline) {
      request.address.index =
          static_cast<std::uint16_t>(request.address.index + process_data().receive_number);
    }
    if (step.action == Action::write_remembered) request.value = remembered_;
    if (step.action == Action::advance_state) {
      const bool waits = !state_ || (state_ == cia402::State::fault && !resets_fault_);
      request.value = waits ? cia402::disable_voltage : cia402::towards_operation(*state_);
    }
    return request;
  }

  cia402::Mode mode_ = cia402::Mode::cyclic_synchronous_torque;
  std::uint8_t node_ = 0;
  Cia402Script script_{};
  canopen::SdoClient client_{};
  Cia402PdoSetUp pdos_{};
  std::size_t step_ = 0;
  std::size_t end_ = 0;
  std::size_t begun_step_ = Cia402Script::capacity;
  bool failed_ = false;
  bool lacks_watchdog_ = false;
  bool retried_ = false;           ///< the set-up has restarted after a refusal
  bool verifies_ = false;          ///< reads whether a refused value is right already
  bool resets_fault_ = false;      ///< the next controlword resets a fault
  bool checks_again_ = false;      ///< it was done, but feedback does not show that
  bool left_operation_ = false;    ///< the watchdog could not be switched off in operation
  bool leaves_operation_ = false;  ///< the command for that is due
  std::uint32_t abort_code_ = 0;
  std::uint32_t stop_option_refusal_ = 0;  ///< code of the refusal of 6007h; 0: none
  canopen::ObjectAddress failed_object_{};
  std::uint32_t remembered_ = 0;
  std::optional<cia402::State> state_{};
  std::optional<canopen::NmtCommand> command_{};
  std::chrono::nanoseconds step_begun_{};
  std::chrono::nanoseconds finished_{-1};
};

}  // namespace articula
