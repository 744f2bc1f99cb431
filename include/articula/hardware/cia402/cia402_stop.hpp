// SPDX-License-Identifier: Apache-2.0
/// @file How the power is taken from a CiA 402 drive that process data may not reach.
#pragma once

#include "articula/hardware/can/can_batch.hpp"
#include "articula/hardware/cia402/cia402.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace articula {

/// Takes the power from one drive by access to its objects. A drive obeys process data in the
/// operational state alone, and after SYNC; its objects can be accessed in the pre-operational
/// state, too. In turn: controlword 0 is written, then the statusword is read. Where no answer
/// comes in time, the request is repeated, and the node is made pre-operational, in case it is in
/// the stopped state. A repeated request takes the late answer to the one before, so a drive whose
/// answers take longer than `patience` is stopped, too.
class Cia402Stop {
 public:
  /// Begins anew. Real-time: yes.
  void restart() noexcept { *this = {}; }

  static constexpr std::uint64_t patience = 10;  ///< until a request is repeated [cycles]

  /// The drive may still exert effort: appends the next frame, if one is due.
  /// @param node   the drive's
  /// @param cycle  number of this cycle, for the time to wait for an answer
  /// @param batch  receives the frame
  /// @return       how many frames there were
  /// Real-time: yes.
  std::size_t advance(std::uint8_t node, std::uint64_t cycle, CanBatch& batch) noexcept {
    const std::size_t before = batch.size();
    if (waits_) {
      if (cycle - asked_ < patience) return 0;
      batch.push_back(canopen::encode(canopen::NmtCommand::enter_pre_operational, node));
    }
    waits_ = true;
    asked_ = cycle;
    batch.push_back(canopen::encode_request(request(), node));
    return batch.size() - before;
  }

  /// The bus did not take the last frame. Real-time: yes.
  void withdraw() noexcept { waits_ = false; }

  /// Takes in the node's answer; one to another question is ignored.
  /// @return the statusword, if that is the answer
  /// Real-time: yes.
  [[nodiscard]] std::optional<std::uint16_t> take(const canopen::Sdo& answer) noexcept {
    if (!waits_ || answer.address != request().address) return {};
    waits_ = false;
    reading_ = !reading_;
    if (reading_ || answer.kind != canopen::SdoKind::upload) return {};
    return static_cast<std::uint16_t>(answer.value);
  }

 private:
  [[nodiscard]] canopen::Sdo request() const noexcept {
    if (reading_) return {canopen::SdoKind::upload, cia402::statusword, 0, 0};
    return {canopen::SdoKind::download, cia402::controlword, cia402::disable_voltage, 2};
  }

  bool reading_ = false;  ///< it is the statusword's turn
  bool waits_ = false;    ///< for an answer
  std::uint64_t asked_ = 0;
};

}  // namespace articula
