// SPDX-License-Identifier: Apache-2.0
/// @file Sending and receiving the frames of a codec over a transport.
#pragma once

#include "articula/core/status.hpp"
#include "articula/hardware/can/can_codec.hpp"
#include "articula/hardware/can/can_hardware_options.hpp"
#include "articula/hardware/can/can_transport.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace articula::detail {

/// A codec, its transport, and the counts of what passes between them.
/// @tparam Codec      language of the drives
/// @tparam Transport  access to the bus
template <CanCodec Codec, CanTransport Transport>
struct CanExchange {
  Codec codec;
  Transport transport;
  CanStatistics statistics{};
  std::chrono::nanoseconds feedback_time{};  ///< arrival of the newest accepted frame
  std::uint32_t dropped = 0;      ///< consecutive cycles whose frames the bus did not take
  std::uint32_t unconfirmed = 0;  ///< consecutive cycles without a sign that they were on the bus

  /// Cycles that another node has begun. Real-time: yes.
  [[nodiscard]] std::uint64_t begun_cycles() const noexcept {
    if constexpr (PacedCanCodec<Codec>) return codec.begun_cycles();
    return 0;
  }

  /// Decodes the frames that have arrived, at most 256. The rest stays for the next cycle, or the
  /// kernel drops and counts it. So a flood of frames does not delay the loop.
  /// Real-time: yes, but for the bus.
  void receive() noexcept {
    constexpr int most_rounds = 8;
    for (int round = 0; round < most_rounds; ++round) {
      std::array<ReceivedCanFrame, 32> frames;
      const std::size_t count = transport.receive(frames);
      for (std::size_t i = 0; i < count; ++i) {
        const CanDecoding decoding = codec.decode(frames[i].frame);
        statistics.count(decoding);
        if (decoding == CanDecoding::accepted) feedback_time = frames[i].time;
      }
      if (count < frames.size()) return;
    }
  }
  /// Receives until a condition holds.
  /// @param time       longest time to wait
  /// @param condition  callable without arguments
  /// @return           Status::ok, Status::stale_state after that time, or Status::hardware_fault
  ///                   while the link is not up
  /// Real-time: yes, but for the wait.
  template <class Condition>
  [[nodiscard]] Status receive_until(std::chrono::nanoseconds time, Condition condition) noexcept {
    const auto end = transport.now() + time;
    for (;;) {
      receive();
      if (condition()) return Status::ok;
      if (transport.link() != CanLink::up) return Status::hardware_fault;
      const auto rest = end - transport.now();
      if (rest.count() <= 0) return Status::stale_state;
      transport.wait(rest);
    }
  }
  /// Waits and receives until a time of the transport's clock. Real-time: no (waits).
  void wait_until(std::chrono::nanoseconds end) noexcept {
    for (auto now = transport.now(); now < end; now = transport.now()) {
      transport.wait(end - now);
      receive();
    }
  }

  /// Sends the frames of a cycle. On a backlog it receives first, because the sign that the earlier
  /// frames were on the bus may have arrived, and tries once more.
  /// @param patience  longest time to wait for the end of a backlog; zero: no wait
  /// Real-time: yes, but for the bus and the wait.
  CanSending send(const CanBatch& batch, std::chrono::nanoseconds patience = {}) noexcept {
    const auto attempt = [&] {
      const CanSending sending = transport.send(batch);
      if (sending != CanSending::backlog) return sending;
      receive();
      return transport.link() == CanLink::up ? transport.send(batch) : CanSending::failed;
    };
    const auto end = patience.count() > 0 ? transport.now() + patience : patience;
    CanSending sending = attempt();
    while (sending == CanSending::backlog && patience.count() > 0) {
      const auto rest = end - transport.now();
      if (rest.count() <= 0) break;
      transport.wait(rest);
      sending = attempt();
    }
    if constexpr (requires { codec.cancel_output(); }) {
      if (!is_taken(sending)) codec.cancel_output();
    }
    return sending;
  }
  /// Counts the result of a cycle's sending. Real-time: yes.
  void count(CanSending sending) noexcept {
    if (sending == CanSending::unconfirmed) ++statistics.unconfirmed;
    if (!is_taken(sending)) ++statistics.not_sent;
    dropped = is_taken(sending) ? 0 : dropped + 1;
    unconfirmed = sending == CanSending::sent ? 0 : unconfirmed + 1;
  }

  [[nodiscard]] static bool is_taken(CanSending sending) noexcept {
    return sending == CanSending::sent || sending == CanSending::unconfirmed;
  }
};

}  // namespace articula::detail
