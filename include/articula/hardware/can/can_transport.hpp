// SPDX-License-Identifier: Apache-2.0
/// @file What a transport is: the way to a CAN bus.
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

/// A frame from the bus.
struct ReceivedCanFrame {
  CanFrame frame{};
  std::chrono::nanoseconds time{};  ///< when it arrived, by the transport's time stamps
};

/// How the way to the bus is, as far as was seen at the last access. `bus_off` and `gone` last until
/// `open`, so that a controller that comes back at once does not hide that it was away.
enum class CanLink : unsigned char {
  up,       ///< Frames can pass.
  down,     ///< The interface is switched off.
  bus_off,  ///< The controller has left the bus after too many errors.
  gone,     ///< The interface does not exist any more; only `open` may bring it back.
};

/// Why nothing passes over a link; CanCause::none if something can. Real-time: yes.
[[nodiscard]] constexpr CanCause cause_of(CanLink link) noexcept {
  switch (link) {
    case CanLink::up:
      return CanCause::none;
    case CanLink::down:
      return CanCause::link_down;
    case CanLink::bus_off:
      return CanCause::bus_off;
    case CanLink::gone:
      return CanCause::link_gone;
  }
  return CanCause::link_gone;
}

/// What became of a cycle's frames. What was not taken is dropped, never sent later.
enum class [[nodiscard]] CanSending : unsigned char {
  sent,         ///< All taken, and those of the cycle before have been on the bus.
  unconfirmed,  ///< All taken, but there is no sign that those before ever got onto the bus.
  backlog,      ///< None taken: there is no sign yet that those of an earlier cycle have been on
                ///< the bus. `receive` takes that sign in.
  congested,    ///< Not all taken: the queue is full.
  failed,       ///< Not all taken: the link is not up.
};

/// The way to a CAN bus.
///
/// - `open(subscription)` makes it ready to receive these frames; called again, it starts anew,
///   also after the interface was gone. Belongs to set-up and may take its time.
/// - `receive(frames)` fetches frames that have arrived, and never waits. Fewer than asked for
///   means that there are no more.
/// - `send(batch)` hands over the frames of a cycle, and never waits. A frame that is not taken is
///   dropped.
/// - `wait(time)` waits until a frame arrives, at most that long. For set-up, and for loops that
///   the bus paces.
/// - `now()` is the time since an arbitrary beginning, which never goes back.
/// - `link()` tells how the way is.
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
