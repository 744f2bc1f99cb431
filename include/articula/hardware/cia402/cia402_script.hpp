// SPDX-License-Identifier: Apache-2.0
/// @file The requests that bring a CiA 402 drive to operation enabled, and release it.
#pragma once

#include "articula/hardware/can/can_codec.hpp"
#include "articula/hardware/canopen/canopen.hpp"
#include "articula/hardware/cia402/cia402.hpp"
#include "articula/hardware/cia402/cia402_drive.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace articula {

/// One step with a drive: mostly one request.
struct Cia402Step {
  enum class Action : unsigned char {
    write,
    expect_profile_402,
    skip_if_zero,      ///< `value` steps, if the object is zero or not there
    remember,          ///< the object's value
    write_remembered,  ///< what was remembered last
    command_node,      ///< network management, which is not answered
    set_up_pdos,       ///< all requests of Cia402PdoSetUp
    await_mode,        ///< for 100 ms; if the drive shows it, `value` steps are skipped
    read_state,
    advance_state,
    confirm_mode,
    expect_stop_option,  ///< that the drive stops when heartbeats stay away
    disarm,  ///< a write; in pre-operational, if the drive does not allow it in operation
  };
  canopen::ObjectAddress address{};
  Action action = Action::write;
  std::uint32_t value = 0;
  std::uint8_t size = 0;   ///< [bytes]; 0: the object is read
  bool optional = false;   ///< the drive may refuse
  bool impatient = false;  ///< no answer for 100 ms will do

  [[nodiscard]] constexpr canopen::Sdo request() const noexcept {
    const auto kind = size == 0 ? canopen::SdoKind::upload : canopen::SdoKind::download;
    return {kind, address, size == 0 ? 0 : value, size};
  }
};

/// The steps with one drive. Which of them are taken, the drive's answers decide; see Cia402SetUp.
class Cia402Script {
 public:
  static constexpr std::size_t capacity = 64;
  static constexpr canopen::ObjectAddress heartbeat_consumer{0x1016, 1};
  static constexpr canopen::ObjectAddress first_deadline{0x1400, 5};

  /// Steps from `begin` to the one before `end`.
  struct Part {
    std::size_t begin = 0;
    std::size_t end = 0;
  };

  /// @param drive     its node, watchdog and further objects
  /// @param mode      of operation
  /// @param period    of the loop [ms]
  /// @param deadline  longest time without commands or heartbeats that the drive is to accept [ms]
  /// @param sync      who sends SYNC
  Cia402Script(const Cia402Drive& drive, cia402::Mode mode, std::uint8_t period,
               std::uint16_t deadline, SyncProducer sync) noexcept {
    const bool beats = drive.watchdog == Cia402Watchdog::heartbeat;
    // A drive without power does no harm when it leaves operation. A node that has been stopped
    // does not answer until then.
    add({cia402::controlword, Action::write, cia402::disable_voltage, 2, true, true});
    command_node(canopen::NmtCommand::enter_pre_operational);
    add({{0x1000, 0}, Action::expect_profile_402});
    // How fast this object is read tells what its later readings prove, see Cia402Feedback.
    add({{canopen::identity, 0}, Action::remember, 0, 0, true});
    // The host sends no heartbeats during the set-up.
    if (beats) add({heartbeat_consumer, Action::write, 0, 4, true});
    write_if_there({0x1017, 0}, 100, 2);  // its own heartbeat every 100 ms
    if (sync == SyncProducer::host) clear_sync_counter();
    add({{}, Action::set_up_pdos});
    write_if_there(cia402::interpolation_period, period, 1);
    write_if_there(cia402::interpolation_exponent, 0xfd, 1);  // 10^-3 s
    // What the drive does when the host's heartbeat fails: it faults.
    // A drive that refuses that, or its own objects, may choose another stop.
    if (beats) write_if_there(cia402::abort_connection, 1, 2);
    for (const canopen::ObjectValue& own : drive.objects) {
      add({own.address, Action::write, own.value, own.size});
    }
    if (beats) {
      add({cia402::abort_connection, Action::expect_stop_option});
      add({heartbeat_consumer, Action::write, std::uint32_t{drive.host_node} << 16 | deadline, 4});
    }
    prepare_ = size_;
    prepare(mode);
    start_ = size_;
    command_node(canopen::NmtCommand::start);
    add({cia402::statusword, Action::read_state});
    add({cia402::controlword, Action::advance_state, 0, 2});
    add({cia402::mode_display, Action::confirm_mode});
    set_up_ = {0, size_};
    if (drive.watchdog == Cia402Watchdog::commands) {
      add({first_deadline, Action::disarm, 0, 2, true});
    }
    if (beats) add({heartbeat_consumer, Action::disarm, 0, 4, true});
    release_ = {set_up_.end, size_};
  }

  [[nodiscard]] const Cia402Step& operator[](std::size_t step) const noexcept {
    return steps_[step];
  }
  [[nodiscard]] const Part& set_up() const noexcept { return set_up_; }
  [[nodiscard]] const Part& release() const noexcept { return release_; }
  /// The step from which on the drive is made ready. Real-time: yes.
  [[nodiscard]] std::size_t prepare() const noexcept { return prepare_; }
  /// The step that starts the node; then come read_state, advance_state and confirm_mode.
  /// Real-time: yes.
  [[nodiscard]] std::size_t start() const noexcept { return start_; }

 private:
  using Action = Cia402Step::Action;

  void add(const Cia402Step& step) noexcept { steps_[size_++] = step; }
  void write_if_there(const canopen::ObjectAddress& address, std::uint32_t value,
                      std::uint8_t size) noexcept {
    add({address, Action::write, value, size, true});
  }
  void command_node(canopen::NmtCommand command) noexcept {
    add({{}, Action::command_node, static_cast<std::uint32_t>(command)});
  }

  /// The host's SYNC has no counter. A drive that expects one refuses SYNC, and lets the counter's
  /// object change only while the period of SYNC is 0 [CiA 301, 7.5.2.22].
  void clear_sync_counter() noexcept {
    constexpr canopen::ObjectAddress counter{0x1019, 0}, sync_period{0x1006, 0};
    add({counter, Action::skip_if_zero, 4});
    add({sync_period, Action::remember, 0, 0, true});
    write_if_there(sync_period, 0, 4);
    add({counter, Action::write, 0, 1});
    add({sync_period, Action::write_remembered, 0, 4, true});
  }

  /// Sets mode and target. Where the drive shows the mode only when it is enabled, it may yet be in
  /// another mode then, so the targets of the others are made safe, too.
  void prepare(cia402::Mode mode) noexcept {
    using cia402::Mode;
    add({cia402::controlword, Action::write, cia402::disable_voltage, 2});
    add({cia402::mode_of_operation, Action::write, static_cast<std::uint32_t>(mode), 1});
    set_target(mode, false);
    const std::size_t awaiting = size_;
    add({cia402::mode_display, Action::await_mode, 0, 0, false, true});
    for (const Mode other : {Mode::cyclic_synchronous_position, Mode::cyclic_synchronous_velocity,
                             Mode::cyclic_synchronous_torque}) {
      if (other != mode) set_target(other, true);
    }
    steps_[awaiting].value = static_cast<std::uint32_t>(size_ - awaiting - 1);
  }
  /// The target at which nothing moves.
  void set_target(cia402::Mode mode, bool optional) noexcept {
    const cia402::Target target = cia402::target_of(mode);
    if (mode != cia402::Mode::cyclic_synchronous_position) {
      return add({target.address, Action::write, 0, target.size, optional});
    }
    add({cia402::position_actual, Action::remember});
    add({target.address, Action::write_remembered, 0, target.size, optional});
  }

  std::array<Cia402Step, capacity> steps_{};
  std::size_t size_ = 0;
  std::size_t prepare_ = 0;
  std::size_t start_ = 0;
  Part set_up_{};
  Part release_{};
};

}  // namespace articula
