// SPDX-License-Identifier: Apache-2.0
/// @file How the power is taken from a CiA 402 drive that process data may not reach.
#pragma once

#include "articula/hardware/can_batch.hpp"
#include "articula/hardware/cia402.hpp"

#include <cstdint>
#include <optional>

namespace articula {

/// Takes the power from one drive by access to its objects. A drive obeys process data in the
/// operational state alone, and after SYNC; its objects can be accessed in the pre-operational
/// state, too. In turn: controlword 0 is written, then the statusword is read. Where no answer
/// comes, the node is made pre-operational, in case it is in the stopped state, and all begins
/// anew.
class Cia402Stop {
 public:
  /// Begins anew. Real-time: yes.
  void restart() noexcept { *this = {}; }

  /// One cycle in which the drive may still exert effort: appends the next frame, if one is due.
  /// @param node   the drive's
  /// @param batch  receives the frame
  /// @return       true if there was one
  /// Real-time: yes.
  bool advance(std::uint8_t node, CanBatch& batch) noexcept {
    constexpr std::uint32_t patience = 10;  // cycles
    if (waits_) {
      if (++waited_ < patience) return false;
      waits_ = reading_ = false;
      return batch.push_back(canopen::encode(canopen::NmtCommand::enter_pre_operational, node));
    }
    waits_ = true;
    waited_ = 0;
    return batch.push_back(canopen::encode_request(request(), node));
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
  std::uint32_t waited_ = 0;
};

}  // namespace articula
