// SPDX-License-Identifier: Apache-2.0
/// @file How one CiA 402 drive is brought to operation enabled, and released again.
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

namespace articula {

/// Brings one drive to operation enabled by access to its objects, one request at a time: checks
/// that it is a CiA 402 drive, maps the process data, sets the mode, starts the node, resets a
/// fault and walks the state machine. Nothing moves meanwhile: the target is zero, or the position
/// where the drive stands, before it is enabled; and a command of the past that may still wait for
/// SYNC in the drive is dropped, since the node leaves the operational state first. All objects are
/// accessed by expedited transfers; none of them is longer than four bytes.
///
/// Which requests these are is in Cia402Script. What drives need not have is left out where the
/// drive refuses it. What the drive refuses although it is needed ends the set-up, unless it has
/// the value already.
class Cia402SetUp {
 public:
  /// @param drive     its node, watchdog and further objects
  /// @param mode      of operation
  /// @param period    of the loop [ms]
  /// @param deadline  longest time without commands or heartbeats that the drive is to accept [ms]
  /// @param sync      who sends SYNC
  Cia402SetUp(const Cia402Drive& drive, cia402::Mode mode, std::uint8_t period,
              std::uint16_t deadline, SyncProducer sync)
      : mode_(mode),
        node_(drive.node),
        script_(drive, mode, period, deadline, sync),
        client_(drive.node),
        pdos_(drive, mode, period, deadline) {
    restart();
  }

  /// Begins anew. Real-time: yes.
  void restart() noexcept {
    begin(script_.set_up());
    pdos_.restart();
    abort_code_ = stop_option_refusal_ = 0;
    failed_object_ = {};
    lacks_watchdog_ = retried_ = false;
  }

  /// Begins to release the drive: takes its watchdog off. For a drive that is not enabled: if the
  /// node does not allow that in operation, it leaves operation. What the set-up has failed at is
  /// still known. Real-time: yes.
  void begin_release() noexcept { begin(script_.release()); }

  /// Starts the node again and looks at its state, where the drive does not show that it is enabled
  /// some time after it was: the command to start may have been lost. Real-time: yes.
  void doubt(std::chrono::nanoseconds elapsed) noexcept {
    if (step_ < end_ || elapsed - finished_ < canopen::SdoClient::patience) return;
    step_ = script_.start();
    finished_ = std::chrono::nanoseconds(-1);
    doubted_ = true;
  }

  /// Appends the next request, if the node has answered the one before; without an answer that one
  /// is repeated after 100 ms.
  /// @param elapsed  time since the set-up, or the release, began
  /// @param batch    receives the request
  /// Real-time: yes.
  [[nodiscard]] CanSetUp advance(std::chrono::nanoseconds elapsed, CanBatch& batch) noexcept {
    if (failed_) return CanSetUp::failed;
    while (step_ < end_ && (!client_.waiting() || client_.overdue(elapsed))) {
      const Cia402Step& step = script_[step_];
      if (step_ != begun_step_) {
        begun_step_ = step_;
        step_begun_ = elapsed;
      }
      if (step.action == Cia402Step::Action::command_node) {
        batch.push_back(canopen::encode(static_cast<canopen::NmtCommand>(step.value), node_));
        ++step_;
        continue;
      }
      if (step.impatient && elapsed - step_begun_ >= canopen::SdoClient::patience) {
        client_.restart();
        ++step_;
        continue;
      }
      if (leave_operation_due_) {
        leave_operation_due_ = false;
        batch.push_back(canopen::encode(canopen::NmtCommand::enter_pre_operational, node_));
      }
      client_.ask(request(step), elapsed, batch);
    }
    if (step_ < end_) return CanSetUp::in_progress;
    if (finished_.count() < 0) finished_ = elapsed;
    return CanSetUp::done;
  }

  /// Takes in the node's answer; one to another question is ignored. Real-time: yes.
  void take(const canopen::Sdo& answer) noexcept {
    if (step_ == end_ || !client_.take(answer)) return;
    using Action = Cia402Step::Action;
    const Cia402Step& step = script_[step_];
    if (step.action == Action::set_up_pdos) return take_for_pdos(answer);
    if (checking_) {
      checking_ = false;
      const std::uint32_t mask = ~std::uint32_t{0} >> (8 * (4 - step.size));
      const bool same =
          answer.kind == canopen::SdoKind::upload && (answer.value & mask) == (step.value & mask);
      return same ? advance_step() : fail();
    }
    if (answer.kind == canopen::SdoKind::abort) return take_abort(step, answer);
    switch (step.action) {
      case Action::expect_profile_402:
        if ((answer.value & 0xffff) != 402) return fail();
        break;
      case Action::expect_stop_option: {
        // 1 is a fault, 2 and 3 are stops; 0 goes on, and other values are the manufacturer's
        // [CiA 402-2, abort connection option code].
        const std::uint32_t option = answer.value & 0xffff;
        if (option >= 1 && option <= 3) break;
        abort_code_ = stop_option_refusal_;
        return fail();
      }
      case Action::skip_if_zero:
        if (answer.value == 0) step_ += step.value;
        break;
      case Action::await_mode:
        if (!shows_mode(answer)) return;  // some drives show it after a while
        step_ += step.value;
        break;
      case Action::remember:
        remembered_ = answer.value;
        break;
      case Action::read_state:
        return take_state(static_cast<std::uint16_t>(answer.value & 0xffff));
      case Action::advance_state:  // and look what came of it
        step_ = script_.start() + 1;
        return;
      case Action::confirm_mode:  // some drives show it only now
        if (!shows_mode(answer)) {
          step_ = script_.start() + 1;
          return;
        }
        break;
      default:
        break;
    }
    advance_step();
  }

  /// Where the drive's command and feedback lie, once the set-up is done. Real-time: yes.
  [[nodiscard]] const cia402::ProcessData& process_data() const noexcept {
    return pdos_.process_data();
  }
  /// The last step is done, or the set-up has failed. Real-time: yes.
  [[nodiscard]] bool ended() const noexcept { return failed_ || step_ == end_; }
  /// The drive has refused what is needed. Real-time: yes.
  [[nodiscard]] bool failed() const noexcept { return failed_; }
  /// The set-up has ended because the drive has no watchdog as was asked for. Real-time: yes.
  [[nodiscard]] bool lacks_watchdog() const noexcept { return lacks_watchdog_; }
  /// The code with which the node has aborted an access last; 0 if it has not. Real-time: yes.
  [[nodiscard]] std::uint32_t abort_code() const noexcept { return abort_code_; }
  /// The object that is being dealt with, or was when the set-up failed. Real-time: yes.
  [[nodiscard]] canopen::ObjectAddress object() const noexcept {
    if (failed_object_.index != 0) return failed_object_;
    return step_ < end_ ? request(script_[step_]).address : canopen::ObjectAddress{};
  }

 private:
  void begin(const Cia402Script::Part& part) noexcept {
    step_ = part.begin;
    end_ = part.end;
    begun_step_ = Cia402Script::capacity;
    finished_ = std::chrono::nanoseconds(-1);
    failed_ = checking_ = resetting_ = doubted_ = false;
    left_operation_ = leave_operation_due_ = false;
    client_.restart();
  }
  void advance_step() noexcept { ++step_; }
  void fail() noexcept {
    constexpr std::uint32_t present_device_state = 0x0800'0022;
    if (abort_code_ == present_device_state && !retried_) {
      // The command to leave operation may have been lost, or was not obeyed yet.
      restart();
      retried_ = true;
      return;
    }
    failed_object_ = client_.request().address;
    lacks_watchdog_ = failed_object_ == Cia402Script::heartbeat_consumer ||
                      script_[step_].action == Cia402Step::Action::expect_stop_option;
    failed_ = true;
  }
  [[nodiscard]] bool shows_mode(const canopen::Sdo& answer) const noexcept {
    return (answer.value & 0xff) == static_cast<std::uint32_t>(mode_);
  }

  void take_for_pdos(const canopen::Sdo& answer) noexcept {
    pdos_.take(answer);
    if (pdos_.done()) return advance_step();
    if (!pdos_.failed()) return;
    abort_code_ = pdos_.refusal().value;
    fail();
    if (!failed_) return;  // another try
    failed_object_ = pdos_.refusal().address;
    lacks_watchdog_ = pdos_.lacks_deadline();
  }

  void take_abort(const Cia402Step& step, const canopen::Sdo& answer) noexcept {
    using Action = Cia402Step::Action;
    if (step.action == Action::skip_if_zero) {
      step_ += step.value + 1;  // there is none
      return;
    }
    if (step.action == Action::disarm && !left_operation_) {
      left_operation_ = leave_operation_due_ = true;
      return;  // again, in another state of the node
    }
    if (step.optional) {
      if (step.address == cia402::abort_connection) stop_option_refusal_ = answer.value;
      return advance_step();
    }
    abort_code_ = answer.value;
    if (step.action != Action::write) return fail();
    checking_ = true;  // it may be right already
  }

  void take_state(std::uint16_t statusword) noexcept {
    state_ = cia402::state_of(statusword);
    if (state_ == cia402::State::operation_enabled) {
      step_ = script_.start() + 3;
      return;
    }
    if (doubted_) {  // it has let go, and may stand elsewhere by now
      doubted_ = false;
      step_ = script_.prepare();
      return;
    }
    // A fault is reset by the bit's rise, so a second try takes a fall in between.
    resetting_ = state_ == cia402::State::fault && !resetting_;
    advance_step();
  }

  [[nodiscard]] canopen::Sdo request(const Cia402Step& step) const noexcept {
    using Action = Cia402Step::Action;
    if (step.action == Action::set_up_pdos) return pdos_.request();
    canopen::Sdo made = step.request();
    if (checking_) return {canopen::SdoKind::upload, step.address, 0, 0};
    if (step.action == Action::disarm && step.address == Cia402Script::first_deadline) {
      made.address.index =
          static_cast<std::uint16_t>(made.address.index + process_data().receive_number);
    }
    if (step.action == Action::write_remembered) made.value = remembered_;
    if (step.action == Action::advance_state) {
      made.value = state_ ? cia402::towards_operation(*state_) : cia402::disable_voltage;
      if (state_ == cia402::State::fault && !resetting_) made.value = cia402::disable_voltage;
    }
    return made;
  }

  cia402::Mode mode_;
  std::uint8_t node_;
  Cia402Script script_;
  canopen::SdoClient client_;
  Cia402PdoSetUp pdos_;
  std::size_t step_ = 0;
  std::size_t end_ = 0;
  std::size_t begun_step_ = Cia402Script::capacity;
  bool failed_ = false;
  bool lacks_watchdog_ = false;
  bool retried_ = false;         ///< the set-up has begun anew after a refusal
  bool checking_ = false;        ///< whether what could not be written has the value already
  bool resetting_ = false;       ///< the controlword is to reset a fault
  bool doubted_ = false;         ///< it was done, but that does not show
  bool left_operation_ = false;  ///< the watchdog could not be taken off in operation
  bool leave_operation_due_ = false;
  std::uint32_t abort_code_ = 0;
  std::uint32_t stop_option_refusal_ = 0;  ///< code with which 6007h was refused; 0: it was not
  canopen::ObjectAddress failed_object_{};
  std::uint32_t remembered_ = 0;
  std::optional<cia402::State> state_{};
  std::chrono::nanoseconds step_begun_{};
  std::chrono::nanoseconds finished_{-1};
};

}  // namespace articula
