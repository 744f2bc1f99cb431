// SPDX-License-Identifier: Apache-2.0
/// @file The steps that enable a CiA 402 drive and release it.
#pragma once

#include "articula/hardware/can/can_codec.hpp"
#include "articula/hardware/canopen/canopen.hpp"
#include "articula/hardware/cia402/cia402.hpp"
#include "articula/hardware/cia402/cia402_drive.hpp"
#include "articula/hardware/cia402/cia402_process_data.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace articula {

/// One step with a drive, in general one request.
struct Cia402Step {
  enum class Action : unsigned char {
    write,
    expect,            ///< checks that 16 bits are within `value` .. `highest`
    skip_if_zero,      ///< skips `value` steps if the object is zero or missing
    remember,          ///< stores the object's value
    write_remembered,  ///< writes the last stored value
    command_node,      ///< network management, which has no answer
    set_up_pdos,       ///< all requests of Cia402PdoSetUp
    await_mode,        ///< for 100 ms; skips `value` steps once the drive shows the mode
    read_state,        ///< reads the statusword
    advance_state,     ///< writes the next controlword
    confirm_mode,      ///< repeats read_state until the drive shows the mode
    disarm,            ///< writes, in the pre-operational state if the drive requires that
  };
  canopen::ObjectAddress address{};
  Action action = Action::write;
  std::uint32_t value = 0;
  std::uint8_t size = 0;      ///< [bytes]; 0: the object is read
  bool optional = false;      ///< the drive may refuse
  bool impatient = false;     ///< the step ends after 100 ms without an answer
  std::uint32_t highest = 0;  ///< for Action::expect

  [[nodiscard]] constexpr canopen::Sdo request() const noexcept {
    return size == 0 ? canopen::read_request(address)
                     : canopen::write_request(address, value, size);
  }
  /// Whether an answer shows that the object has the value already.
  [[nodiscard]] constexpr bool is_met_by(const canopen::Sdo& answer) const noexcept {
    const std::uint32_t mask = ~std::uint32_t{0} >> (8 * (4 - size));
    return answer.kind == canopen::SdoKind::upload && (answer.value & mask) == (value & mask);
  }
};

/// The steps with one drive. The drive's answers decide which of them are taken, see Cia402SetUp.
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

  Cia402Script() = default;
  /// Parameters as those of Cia402SetUp.
  Cia402Script(const Cia402Drive& drive, cia402::Mode mode, std::uint8_t period,
               std::uint16_t deadline, SyncProducer sync) noexcept {
    const bool beats = drive.watchdog == Cia402Watchdog::heartbeat;
    // A drive without power does no harm when it leaves operation. A stopped node answers only
    // after that.
    add({cia402::controlword, Action::write, cia402::disable_voltage, 2, true, true});
    command_node(canopen::NmtCommand::enter_pre_operational);
    add({{0x1000, 0}, Action::expect, 402, 0, false, false, 402});
    // The time of this answer bounds what later answers prove, see Cia402FeedbackAge.
    add({{canopen::identity, 0}, Action::remember, 0, 0, true});
    // The host sends no heartbeats during the set-up.
    if (beats) add({heartbeat_consumer, Action::write, 0, 4, true});
    write_if_present({0x1017, 0}, 100, 2);  // the drive's heartbeat every 100 ms
    if (sync == SyncProducer::host) clear_sync_counter();
    add({{}, Action::set_up_pdos});
    write_if_present(cia402::interpolation_period, period, 1);
    write_if_present(cia402::interpolation_exponent, 0xfd, 1);  // 10^-3 s
    // Without the host's heartbeat the drive faults. A drive that refuses this, or its own objects,
    // may choose another stop.
    if (beats) write_if_present(cia402::abort_connection, 1, 2);
    for (const canopen::ObjectValue& own : drive.objects) {
      add({own.address, Action::write, own.value, own.size});
    }
    if (beats) {
      // 1 is a fault, 2 and 3 are stops; 0 continues, and other values are the manufacturer's
      // [CiA 402-2, abort connection option code].
      add({cia402::abort_connection, Action::expect, 1, 0, false, false, 3});
      add({heartbeat_consumer, Action::write, std::uint32_t{drive.host_node} << 16 | deadline, 4});
    }
    prepare = size_;
    prepare_mode(mode);
    start = size_;
    command_node(canopen::NmtCommand::start);
    add({cia402::statusword, Action::read_state});
    add({cia402::controlword, Action::advance_state, 0, 2});
    add({cia402::mode_display, Action::confirm_mode});
    set_up = {0, size_};
    if (drive.watchdog == Cia402Watchdog::commands) {
      add({first_deadline, Action::disarm, 0, 2, true});
    }
    if (beats) add({heartbeat_consumer, Action::disarm, 0, 4, true});
    release = {set_up.end, size_};
  }

  [[nodiscard]] const Cia402Step& operator[](std::size_t step) const noexcept {
    return steps_[step];
  }

  Part set_up{};
  Part release{};
  std::size_t prepare = 0;  ///< the first step that prepares mode and target
  std::size_t start = 0;    ///< starts the node; read_state, advance_state and confirm_mode follow

 private:
  using Action = Cia402Step::Action;

  void add(const Cia402Step& step) noexcept { steps_[size_++] = step; }
  void write_if_present(const canopen::ObjectAddress& address, std::uint32_t value,
                        std::uint8_t size) noexcept {
    add({address, Action::write, value, size, true});
  }
  void command_node(canopen::NmtCommand command) noexcept {
    add({{}, Action::command_node, static_cast<std::uint32_t>(command)});
  }

  /// The host's SYNC has no counter. A drive that expects one ignores SYNC. It lets the counter's
  /// object change only while the period of SYNC is 0 [CiA 301, 7.5.2.22].
  void clear_sync_counter() noexcept {
    constexpr canopen::ObjectAddress counter{0x1019, 0}, sync_period{0x1006, 0};
    add({counter, Action::skip_if_zero, 4});
    add({sync_period, Action::remember, 0, 0, true});
    write_if_present(sync_period, 0, 4);
    add({counter, Action::write, 0, 1});
    add({sync_period, Action::write_remembered, 0, 4, true});
  }

  /// Sets mode and target. A drive that shows the mode only when enabled may still be in another
  /// mode until then. The targets of the other modes are therefore made safe, too.
  void prepare_mode(cia402::Mode mode) noexcept {
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
  /// Sets the target at which nothing moves.
  void set_target(cia402::Mode mode, bool optional) noexcept {
    const canopen::MappedObject target = cia402::mapped_target(mode);
    const bool is_position = mode == cia402::Mode::cyclic_synchronous_position;
    if (is_position) add({cia402::position_actual, Action::remember});
    add({target.address, is_position ? Action::write_remembered : Action::write, 0,
         static_cast<std::uint8_t>(target.bits / 8), optional});
  }

  std::array<Cia402Step, capacity> steps_{};
  std::size_t size_ = 0;
};

}  // namespace articula
