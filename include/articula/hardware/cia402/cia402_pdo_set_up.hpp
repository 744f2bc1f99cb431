// SPDX-License-Identifier: Apache-2.0
/// @file The set-up of one CiA 402 drive's process data.
#pragma once

#include "articula/hardware/canopen/canopen_pdo_set_up.hpp"
#include "articula/hardware/cia402/cia402_drive.hpp"
#include "articula/hardware/cia402/cia402_process_data.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace articula {

/// Configures the process data of one CiA 402 drive by requests, one after the other. RPDO 1 has
/// controlword and target, TPDO 1 has statusword, position and torque. TPDO 2 has velocity and
/// error code. Torque, velocity and error code are left out if the drive lacks them.
///
/// Mappings that the drive does not let change are used as they are. For the commands it is the
/// first of RPDO 1 to 4 with controlword and target. For the feedback it is each of TPDO 1 to 4
/// with an object that is not in one before. All functions are real-time.
class Cia402PdoSetUp {
 public:
  Cia402PdoSetUp() = default;
  /// @param drive     its node and watchdog
  /// @param mode      of operation
  /// @param period    of SYNC [ms]
  /// @param deadline  of the watchdog [ms]
  Cia402PdoSetUp(const Cia402Drive& drive, cia402::Mode mode, std::uint8_t period,
                 std::uint16_t deadline)
      : node_(drive.node),
        mode_(mode),
        deadline_(drive.watchdog == Cia402Watchdog::commands ? deadline : std::uint16_t{0}) {
    canopen::PdoMapping command;
    command.push_back(cia402::mapped_controlword);
    command.push_back(cia402::mapped_target(mode));
    process_data_.receive = cia402::receive_layout(0, node_, mode, command);
    std::ranges::copy(cia402::usual_transmit, process_data_.transmit.begin());
    process_data_.stream_count = 2;
    process_data_.sync_period = period * 1e-3;
    restart();
  }

  /// Starts again. The known process data stay until it is done.
  void restart() noexcept {
    next_ = {};
    next_.sync_period = process_data_.sync_period;
    missing_ = all_parts;
    any_fixed_ = done_ = failed_ = false;
    refusal_ = {};
    begin_receive(0);
  }

  [[nodiscard]] bool done() const noexcept { return done_; }
  [[nodiscard]] bool failed() const noexcept { return failed_; }
  [[nodiscard]] bool lacks_deadline() const noexcept { return pdo_.lacks_deadline(); }
  /// A refusal of something necessary.
  [[nodiscard]] const canopen::Sdo& refusal() const noexcept { return refusal_; }
  [[nodiscard]] const cia402::ProcessData& process_data() const noexcept { return process_data_; }
  [[nodiscard]] canopen::Sdo request() const noexcept { return pdo_.request(); }

  /// Processes the answer to the request.
  void take(const canopen::Sdo& answer) noexcept {
    pdo_.take(answer);
    if (!pdo_.done() && !pdo_.failed()) return;
    any_fixed_ = any_fixed_ || pdo_.fixed();
    if (refusal_.kind != canopen::SdoKind::abort || pdo_.failed()) refusal_ = pdo_.refusal();
    if (pdo_.failed()) {
      failed_ = true;
    } else if (receiving_) {
      end_receive();
    } else {
      end_transmit();
    }
  }

 private:
  struct Part {
    canopen::MappedObject object{};
    bool required = false;
    std::uint8_t usual_number = 0;  ///< of the first TPDO that may have it
  };
  static constexpr std::size_t part_count = 5;
  static constexpr std::array<Part, part_count> parts{{
      {cia402::mapped_statusword, true, 0},
      {cia402::mapped_position, true, 0},
      {cia402::mapped_torque, false, 0},
      {cia402::mapped_velocity, false, 1},
      {cia402::mapped_error_code, false, 1},
  }};
  // A bit for each part.
  static constexpr unsigned all_parts = (1U << part_count) - 1;
  static constexpr unsigned required_parts = 0b11;
  static constexpr unsigned velocity = 0b1000;

  void begin_receive(std::uint8_t number) noexcept {
    receiving_ = true;
    number_ = number;
    canopen::PdoTask task{.direction = canopen::PdoTask::Direction::receive,
                          .number = number,
                          .node = node_,
                          .may_map = number == 0,
                          .deadline = deadline_};
    task.add(cia402::mapped_controlword, true);
    task.add(cia402::mapped_target(mode_), true);
    pdo_.begin(task);
  }

  void end_receive() noexcept {
    next_.receive = cia402::receive_layout(number_, node_, mode_, pdo_.mapping());
    next_.receive_number = number_;
    if (next_.receive.frame.length > 0) {
      refusal_ = {};
      return begin_transmit(0);
    }
    failed_ = !any_fixed_ || number_ + 1U == cia402::ProcessData::most;
    if (!failed_) begin_receive(static_cast<std::uint8_t>(number_ + 1));
  }

  /// TPDOs 1 and 2 are mapped. The others are only read, if a mapping could not be changed.
  void begin_transmit(std::uint8_t number) noexcept {
    receiving_ = false;
    number_ = number;
    canopen::PdoTask task{.direction = canopen::PdoTask::Direction::transmit,
                          .number = number,
                          .node = node_,
                          .may_map = number < 2};
    for (std::size_t k = 0; k < part_count; ++k) {
      const bool missing = (missing_ >> k & 1U) != 0;
      if (missing && parts[k].usual_number <= number) {
        task.add(parts[k].object, parts[k].required);
      }
    }
    pdo_.begin(task);
  }

  void end_transmit() noexcept {
    next_.transmit[number_] = cia402::transmit_layout(pdo_.mapping());
    if (next_.transmit[number_].length > 0) {
      next_.transmit[number_].stream = static_cast<std::uint8_t>(next_.stream_count++);
    }
    for (std::size_t k = 0; k < part_count; ++k) {
      if (pdo_.mapping().contains(parts[k].object)) missing_ &= ~(1U << k);
    }
    const bool more = number_ < 1 || (any_fixed_ && missing_ != 0);
    if (more && number_ + 1U < cia402::ProcessData::most) {
      return begin_transmit(static_cast<std::uint8_t>(number_ + 1));
    }
    failed_ = (missing_ & required_parts) != 0;
    if (failed_) return;
    next_.has_velocity = (missing_ & velocity) == 0;
    next_.is_usual = next_.stream_count == 2 && next_.transmit[0] == cia402::usual_transmit[0] &&
                     next_.transmit[1] == cia402::usual_transmit[1];
    process_data_ = next_;
    done_ = true;
  }

  std::uint8_t node_ = 0;
  cia402::Mode mode_ = cia402::Mode::cyclic_synchronous_torque;
  std::uint16_t deadline_ = 0;
  canopen::PdoSetUp pdo_{};
  cia402::ProcessData process_data_{};
  cia402::ProcessData next_{};
  canopen::Sdo refusal_{};
  std::uint8_t number_ = 0;
  unsigned missing_ = all_parts;
  bool receiving_ = true;
  bool any_fixed_ = false;
  bool done_ = false;
  bool failed_ = false;
};

}  // namespace articula
