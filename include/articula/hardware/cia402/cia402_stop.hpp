// SPDX-License-Identifier: Apache-2.0
/// @file Stopping a CiA 402 drive by access to its objects.
#pragma once

#include "articula/hardware/can/can_batch.hpp"
#include "articula/hardware/cia402/cia402.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace articula {

/// Switches one drive off by access to its objects. Process data need the operational state and
/// SYNC; access to objects works in the pre-operational state, too. All functions are real-time.
///
/// It writes controlword 0 and reads the statusword, in turn. Without an answer in time it repeats
/// the request and makes the node pre-operational, in case that it is stopped. A late answer to the
/// first request counts for the repeated one, so slow drives are stopped as well.
class Cia402Stop {
 public:
  static constexpr std::uint64_t patience = 10;  ///< time until a request is repeated [cycles]

  /// Clears the state.
  void restart() noexcept { *this = {}; }

  /// Appends the next frames, if some are due.
  /// @param node   of the drive
  /// @param cycle  number of this cycle
  /// @param batch  receives the frames
  /// @return       number of frames appended
  std::size_t advance(std::uint8_t node, std::uint64_t cycle, CanBatch& batch) noexcept {
    const std::size_t before = batch.size();
    if (waits_) {
      if (cycle - requested_ < patience) return 0;
      batch.push_back(canopen::encode(canopen::NmtCommand::enter_pre_operational, node));
    }
    waits_ = true;
    requested_ = cycle;
    batch.push_back(canopen::encode_request(request(), node));
    return batch.size() - before;
  }

  /// Notes that the bus did not take the last frame.
  void cancel_request() noexcept { waits_ = false; }

  /// Processes an answer of the node; an answer to another request is ignored.
  /// @return the statusword, if the answer has it
  [[nodiscard]] std::optional<std::uint16_t> take(const canopen::Sdo& answer) noexcept {
    if (!waits_ || answer.address != request().address) return {};
    waits_ = false;
    reading_ = !reading_;
    if (reading_ || answer.kind != canopen::SdoKind::upload) return {};
    return static_cast<std::uint16_t>(answer.value);
  }

 private:
  [[nodiscard]] canopen::Sdo request() const noexcept {
    return reading_ ? canopen::read_request(cia402::statusword)
                    : canopen::write_request(cia402::controlword, cia402::disable_voltage, 2);
  }

  bool reading_ = false;  ///< the statusword is next
  bool waits_ = false;    ///< for an answer
  std::uint64_t requested_ = 0;
};

}  // namespace articula
