// SPDX-License-Identifier: Apache-2.0
/// @file Enabling the drives on a CAN bus, and stopping them.
#pragma once

#include "articula/core/status.hpp"
#include "articula/hardware/can/can_exchange.hpp"
#include "articula/hardware/can/can_fault_search.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace articula::detail {

/// Runs the codec's set-up until all drives are enabled and their feedback is young enough.
/// @param exchange  codec and open transport
/// @param options   period and time limit of the set-up
/// @return          what has failed; CanCause::none on success
/// Real-time: no (waits for the drives).
template <class Codec, class Transport>
[[nodiscard]] CanFault set_up_drives(CanExchange<Codec, Transport>& exchange,
                                     const CanHardwareOptions& options) noexcept {
  const std::uint64_t begun_before = exchange.begun_cycles();
  const auto begin = exchange.transport.now();
  for (;;) {
    const auto elapsed = exchange.transport.now() - begin;
    if (elapsed > options.set_up_time) break;
    CanBatch batch;
    const CanSetUp progress = exchange.codec.set_up(elapsed, batch);
    if (!batch.empty()) static_cast<void>(exchange.send(batch, options.set_up_period));
    if (progress == CanSetUp::failed) break;
    // The drives have a whole period from here on to answer, even if this step is late.
    exchange.wait_until(exchange.transport.now() + options.set_up_period);
    const bool is_young = std::ranges::all_of(exchange.codec.reports(), [&](const DriveReport& r) {
      return r.age < options.stale_after || r.age == DriveReport::never;
    });
    if (progress == CanSetUp::done && is_young) return {};
  }
  CanFault fault = find_activation_fault(exchange.codec.reports(), options.stale_after);
  if constexpr (requires { exchange.codec.set_up_fault(); }) {
    const CanFault own = exchange.codec.set_up_fault();
    if (own.joint >= 0 || fault.joint < 0) fault = own;
  }
  const bool no_cycle = PacedCanCodec<Codec> && exchange.begun_cycles() == begun_before;
  return no_cycle && fault.abort_code == 0 ? CanFault{CanCause::no_sync} : fault;
}

/// Disables the drives, then switches off their watchdogs where the codec can.
/// @return Status::ok when all drives have reported that they are off, else Status::hardware_fault
/// Real-time: no (waits for the drives).
template <class Codec, class Transport>
[[nodiscard]] Status stop_drives(CanExchange<Codec, Transport>& exchange,
                                 const CanHardwareOptions& options) noexcept {
  const auto all_off = [&] {
    if constexpr (requires { exchange.codec.all_off(); }) {
      return exchange.codec.all_off();
    } else {
      return std::ranges::all_of(exchange.codec.reports(), [&](const DriveReport& r) {
        return !r.enabled && r.age < options.stale_after;
      });
    }
  };
  Status status = Status::hardware_fault;
  // Two accesses stop a drive. Some drives answer each after 100 ms, and one answer may be lost.
  constexpr int most_periods = 300;
  for (int k = 0; k < most_periods && status != Status::ok; ++k) {
    CanBatch batch;
    exchange.codec.encode_stop(batch);
    const CanSending sending = exchange.send(batch, options.set_up_period);
    exchange.count(sending);
    if (sending != CanSending::backlog) {  // else the period has passed in `send`
      exchange.wait_until(exchange.transport.now() + options.set_up_period);
    }
    if (all_off()) status = Status::ok;
  }
  if constexpr (requires(CanBatch& batch) { exchange.codec.release({}, batch); }) {
    constexpr std::chrono::milliseconds patience{250};  // two accesses may be lost
    const auto begin = exchange.transport.now();
    for (auto tick = begin; tick - begin <= patience; tick += options.set_up_period) {
      CanBatch batch;
      if (exchange.codec.release(tick - begin, batch) == CanSetUp::done) break;
      // The watchdogs need commands until they are switched off.
      if (batch.empty()) exchange.codec.encode_stop(batch);
      exchange.count(exchange.send(batch, options.set_up_period));
      exchange.wait_until(tick + options.set_up_period);
    }
  }
  return status;
}

}  // namespace articula::detail
