// SPDX-License-Identifier: Apache-2.0
/// @file The concept of a transport: access to a CAN bus.
#pragma once

#include "articula/core/status.hpp"
#include "articula/hardware/can/can_batch.hpp"
#include "articula/hardware/can/can_codec.hpp"
#include "articula/hardware/can/can_fault.hpp"

#include <chrono>
#include <concepts>
#include <cstddef>
#include <span>

namespace articula {

/// A frame with the time of its arrival.
struct ReceivedCanFrame {
  CanFrame frame{};
  std::chrono::nanoseconds time{};  ///< of arrival, by the transport's time stamps
};

/// The state of the link to the bus at the last access. `bus_off` and `gone` last until `open`, so
/// that a controller that returns at once does not hide the fault.
enum class CanLink : unsigned char {
  up,       ///< Frames can pass.
  down,     ///< The interface is switched off.
  bus_off,  ///< The controller has left the bus after too many errors.
  gone,     ///< The interface does not exist any more; only `open` may restore it.
};

/// The fault of a link; CanCause::none if it is up. Real-time: yes.
[[nodiscard]] constexpr CanCause cause_of(CanLink link) noexcept {
  if (link == CanLink::up) return CanCause::none;
  if (link == CanLink::down) return CanCause::link_down;
  return link == CanLink::bus_off ? CanCause::bus_off : CanCause::link_gone;
}

/// The result of sending a cycle's frames. Frames that were not taken are dropped, never sent
/// later.
enum class [[nodiscard]] CanSending : unsigned char {
  sent,         ///< All taken, and the frames of the cycle before have been on the bus.
  unconfirmed,  ///< All taken, but there is no sign that the frames before were on the bus.
  backlog,      ///< None taken: there is no sign yet that the frames of an earlier cycle have been
                ///< on the bus. `receive` processes that sign.
  congested,    ///< Not all taken: the queue is full.
  failed,       ///< Not all taken: the link is not up.
};

/// Access to a CAN bus. Example: SocketCan.
///
/// - `open(subscription)` makes it ready to receive these frames. A second call opens it again,
///   also after the interface was gone. It belongs to set-up and may wait.
/// - `receive(frames)` returns frames that have arrived, and never waits. Fewer frames than the
///   span holds mean that there are no more.
/// - `send(batch)` sends the frames of a cycle, and never waits. It drops frames that are not
///   taken.
/// - `wait(time)` waits until a frame arrives, at most that long. For set-up, and for loops that
///   the bus paces.
/// - `now()` is the time of a monotonic clock.
/// - `link()` is the state of the link.
/// @tparam T  the transport
template <class T>
concept CanTransport = requires(T transport, const T& constant, const CanSubscription& subscription,
                                std::span<ReceivedCanFrame> frames, const CanBatch& batch,
                                std::chrono::nanoseconds time) {
  { transport.open(subscription) } -> std::same_as<Status>;
  { transport.receive(frames) } noexcept -> std::same_as<std::size_t>;
  { transport.send(batch) } noexcept -> std::same_as<CanSending>;
  { transport.wait(time) } noexcept;
  { constant.now() } noexcept -> std::same_as<std::chrono::nanoseconds>;
  { constant.link() } noexcept -> std::same_as<CanLink>;
};

}  // namespace articula
