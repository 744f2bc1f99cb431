// SPDX-License-Identifier: Apache-2.0
/// @file The transport over SocketCAN of Linux. CMake target: articula::socketcan.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/hardware/can/can_error_frame.hpp"
#include "articula/hardware/can/can_socket.hpp"
#include "articula/hardware/can/can_transport.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

namespace articula {

/// Counters of a SocketCAN transport since its construction.
struct SocketCanStatistics {
  std::uint64_t received = 0;        ///< frames of other nodes
  std::uint64_t sent = 0;            ///< frames that the kernel accepted
  std::uint64_t not_taken = 0;       ///< frames that the kernel did not accept
  std::uint64_t lost = 0;            ///< frames dropped because the receive queue was full
  std::uint64_t error_frames = 0;    ///< all reports of the controller
  std::uint64_t overflows = 0;       ///< reports of a buffer overflow in the controller
  std::uint64_t no_answers = 0;      ///< reports of no acknowledge or a send timeout
  std::uint64_t error_passives = 0;  ///< reports of the error-passive state
  std::uint64_t bus_offs = 0;        ///< reports of bus-off
  std::uint64_t restarts = 0;        ///< reports of the return from bus-off
};

/// A raw CAN socket of Linux that never waits and never sends late.
///
/// The kernel's queue may delay frames: behind other traffic, or on a bus without other nodes. The
/// kernel therefore returns the last frame of a cycle's output to `receive` once it was on the bus.
/// Until then `send` returns CanSending::backlog and sends nothing. Without that sign for the
/// confirmation time, the frame counts as lost; the next `send` returns CanSending::unconfirmed. At
/// most one cycle per confirmation time waits in the queue.
///
/// Errors show in the results and in `link()`. After the interface was down, sending works again by
/// itself. After bus-off, or if the interface was deleted and created again, call `open`.
class SocketCan {
 public:
  /// @param interface          name of the interface, such as "can0"
  /// @param confirmation_time  time after which a cycle that was not on the bus counts as lost; a
  ///                           few periods of the loop
  /// @throws std::invalid_argument if the name is invalid or the time is not positive
  /// @throws std::runtime_error if the interface does not exist, or the kernel has no CAN
  /// Real-time: no (system calls, allocates).
  explicit SocketCan(std::string interface,
                     std::chrono::nanoseconds confirmation_time = std::chrono::milliseconds(3))
      : interface_(std::move(interface)), confirmation_time_(confirmation_time) {
    if (confirmation_time.count() <= 0) {
      detail::refuse(
          {"socketcan: confirmation_time ", confirmation_time.count(), " ns is not positive"});
    }
    if (interface_.empty() || interface_.size() >= IF_NAMESIZE) {
      detail::refuse({"socketcan: '", interface_, "' is not a valid name of an interface"});
    }
    if (open({}) != Status::ok) {
      throw std::runtime_error("socketcan: interface '" + interface_ + "': " + error_);
    }
  }

  /// Opens a new socket, without frames of the past, and binds it to the interface. It receives the
  /// subscribed frames, the end of each own cycle, and error frames.
  /// @return Status::ok, or Status::hardware_fault; error() has the reason then
  /// Real-time: no (system calls, allocates).
  [[nodiscard]] Status open(const CanSubscription& subscription) noexcept {
    const char* failure = nullptr;
    try {
      failure = socket_.open(interface_, subscription);
    } catch (...) {
      failure = "out of memory";
    }
    if (failure != nullptr) {
      error_ = failure;
      link_ = CanLink::gone;
      socket_.close();
      return Status::hardware_fault;
    }
    link_ = CanLink::up;
    last_of_cycle_ = subscription.last_of_cycle;
    tracked_ = subscription.frames_per_cycle > 0;
    awaiting_ = false;
    lost_before_ = 0;
    return Status::ok;
  }

  /// Returns frames that have arrived, by one system call, or a few where there are many. It
  /// processes error frames and own frames itself. Real-time: yes, but for the bus.
  [[nodiscard]] std::size_t receive(std::span<ReceivedCanFrame> frames) noexcept {
    std::array<detail::RawCanMessage, detail::CanSocket::most> messages;
    std::size_t count = 0;
    constexpr int most_calls = 4;  // own and error frames do not count, and may be many
    for (int call = 0; call < most_calls && count < frames.size(); ++call) {
      const std::size_t wanted = std::min(messages.size(), frames.size() - count);
      const int got = socket_.receive(std::span(messages).first(wanted));
      if (got < 0) {
        note_error(errno);
        // The kernel reports an error of the interface once, before frames that arrived earlier.
        if (errno == ENETDOWN) continue;
        return count;
      }
      for (int i = 0; i < got; ++i) {
        if (take(messages[static_cast<std::size_t>(i)], frames[count])) ++count;
      }
      if (static_cast<std::size_t>(got) < wanted) return count;
    }
    return count;
  }

  /// Sends the frames of a cycle, by one system call. Real-time: yes, but for the bus.
  [[nodiscard]] CanSending send(const CanBatch& batch) noexcept {
    const auto now = this->now();
    const bool late = awaiting_ && now - sent_at_ >= confirmation_time_;
    if (awaiting_ && !late) {
      return link_ == CanLink::up ? CanSending::backlog : CanSending::failed;
    }
    if (batch.empty()) return CanSending::sent;
    const int result = socket_.send(batch);
    const std::size_t taken = result > 0 ? static_cast<std::size_t>(result) : 0;
    statistics_.sent += taken;
    statistics_.not_taken += batch.size() - taken;
    if (taken == batch.size()) {
      if (link_ == CanLink::down) link_ = CanLink::up;
      const CanFrame& last = batch[batch.size() - 1];
      awaiting_ = tracked_ && !last.extended && last.identifier == last_of_cycle_;
      sent_at_ = now;
      return late ? CanSending::unconfirmed : CanSending::sent;
    }
    // If the kernel has taken a frame, it gives no reason for not taking the next one.
    if (taken > 0 || errno == ENOBUFS || errno == EAGAIN) return CanSending::congested;
    note_error(errno);
    return CanSending::failed;
  }

  /// Waits for a frame, or a signal. Real-time: no (waits).
  void wait(std::chrono::nanoseconds time) noexcept { socket_.wait(time); }

  /// Real-time: yes (reads the clock).
  [[nodiscard]] std::chrono::nanoseconds now() const noexcept {
    return std::chrono::steady_clock::now().time_since_epoch();
  }
  /// Real-time: yes.
  [[nodiscard]] CanLink link() const noexcept { return link_; }
  /// The reason why `open` has failed. Real-time: yes.
  [[nodiscard]] const char* error() const noexcept { return error_; }
  [[nodiscard]] const std::string& interface() const noexcept { return interface_; }
  [[nodiscard]] const SocketCanStatistics& statistics() const noexcept { return statistics_; }

 private:
  void note_error(int error) noexcept {
    if (error == ENETDOWN && link_ == CanLink::up) link_ = CanLink::down;
    if (error == ENODEV || error == ENXIO || error == EBADF) link_ = CanLink::gone;
  }

  /// Processes a message of the kernel.
  /// @return true if it is a frame of another node, which `received` holds then
  [[nodiscard]] bool take(const detail::RawCanMessage& message,
                          ReceivedCanFrame& received) noexcept {
    const can_frame& raw = message.frame;
    if (!message.whole) return false;
    if (message.has_lost) {
      statistics_.lost += message.lost - lost_before_;
      lost_before_ = message.lost;
    }
    if ((raw.can_id & CAN_ERR_FLAG) != 0) {
      take_error(raw);
      return false;
    }
    if (message.own) {
      awaiting_ = false;
      return false;
    }
    if ((raw.can_id & CAN_RTR_FLAG) != 0 || raw.can_dlc > 8) return false;
    ++statistics_.received;
    received = {.time = message.time};
    received.frame.extended = (raw.can_id & CAN_EFF_FLAG) != 0;
    received.frame.identifier =
        raw.can_id & (received.frame.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
    received.frame.length = raw.can_dlc;
    std::memcpy(received.frame.data.data(), raw.data, raw.can_dlc);
    return true;
  }

  void take_error(const can_frame& raw) noexcept {
    std::array<std::uint8_t, 8> data;
    std::memcpy(data.data(), raw.data, data.size());
    const CanErrorReport report = decode_error_frame(raw.can_id & CAN_ERR_MASK, data);
    ++statistics_.error_frames;
    if (report.overflow) ++statistics_.overflows;
    if (report.no_answer) ++statistics_.no_answers;
    if (report.passive) ++statistics_.error_passives;
    if (report.restarted) ++statistics_.restarts;
    if (report.bus_off) {
      ++statistics_.bus_offs;
      link_ = CanLink::bus_off;  // until `open`: a restart may follow before the next access
    }
  }

  std::string interface_;
  std::chrono::nanoseconds confirmation_time_{};
  const char* error_ = "";
  detail::CanSocket socket_{};
  CanLink link_ = CanLink::gone;
  bool tracked_ = false;  ///< the last frame of each own cycle is awaited
  std::uint32_t last_of_cycle_ = 0;
  bool awaiting_ = false;  ///< the last frame of the last cycle was not on the bus yet
  std::chrono::nanoseconds sent_at_{};
  std::uint32_t lost_before_ = 0;
  SocketCanStatistics statistics_{};
};

}  // namespace articula
