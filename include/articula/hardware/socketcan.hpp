// SPDX-License-Identifier: Apache-2.0
/// @file The way to a CAN bus through Linux. CMake target: articula::socketcan.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/hardware/can_error_frame.hpp"
#include "articula/hardware/can_transport.hpp"

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
#include <vector>

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

namespace articula {

/// What a SocketCAN transport has counted since it was made.
struct SocketCanStatistics {
  std::uint64_t received = 0;      ///< frames of others
  std::uint64_t sent = 0;          ///< frames that the kernel took
  std::uint64_t not_taken = 0;     ///< frames that the kernel did not take, or was not offered
  std::uint64_t lost = 0;          ///< frames that the receive queue had no room for
  std::uint64_t error_frames = 0;  ///< reports of the controller
  std::uint64_t overflows = 0;     ///< of these, that a buffer of the controller has run over
  std::uint64_t no_answers = 0;    ///< of these, that nobody acknowledged or sending took too long
  std::uint64_t error_passives = 0;  ///< of these, that the controller became error-passive
  std::uint64_t bus_offs = 0;        ///< of these, that the controller left the bus
};

/// A raw CAN socket of Linux that never waits and never sends late.
///
/// The kernel's queue may hold frames back for long: behind other traffic, or on a bus where nobody
/// answers. So the frame that ends a cycle's output is received back when it has been on the bus,
/// and until then nothing new is sent; what the loop computes meanwhile is dropped. If there is no
/// such sign for the confirmation time, the frame counts as lost and the next cycle is sent, with
/// CanSending::unconfirmed as answer. So at most one cycle per confirmation time waits in a queue.
///
/// Errors show in the answers and in `link()`. After the interface has been down, sending works
/// again by itself; after it has been deleted and made again, it takes `open`.
class SocketCan {
 public:
  /// @param interface          name of the interface, such as "can0"
  /// @param confirmation_time  longest time that a cycle may take to get onto the bus before it
  ///                           counts as lost; a few periods of the loop
  /// @throws std::invalid_argument if there can be no interface of that name, or the time is not
  ///         positive
  /// @throws std::runtime_error if there is none now, or the kernel has no CAN
  /// Real-time: no (system calls, allocates).
  explicit SocketCan(std::string interface,
                     std::chrono::nanoseconds confirmation_time = std::chrono::milliseconds(3))
      : interface_(std::move(interface)), confirmation_time_(confirmation_time) {
    if (confirmation_time.count() <= 0) {
      detail::refuse(
          {"socketcan: confirmation_time ", confirmation_time.count(), " ns is not positive"});
    }
    if (interface_.empty() || interface_.size() >= IF_NAMESIZE) {
      detail::refuse({"socketcan: '", interface_, "' is no name of an interface"});
    }
    if (open({}) != Status::ok) {
      throw std::runtime_error("socketcan: interface '" + interface_ + "': " + error_);
    }
  }

  SocketCan(SocketCan&& other) noexcept { *this = std::move(other); }
  SocketCan& operator=(SocketCan&& other) noexcept {
    if (this == &other) return *this;
    close();
    interface_ = std::move(other.interface_);
    confirmation_time_ = other.confirmation_time_;
    error_ = other.error_;
    socket_ = std::exchange(other.socket_, -1);
    link_ = other.link_;
    tracked_ = other.tracked_;
    last_of_cycle_ = other.last_of_cycle_;
    awaiting_ = other.awaiting_;
    sent_at_ = other.sent_at_;
    lost_before_ = other.lost_before_;
    statistics_ = other.statistics_;
    return *this;
  }
  ~SocketCan() { close(); }

  /// Opens the socket anew, so that nothing of the past is left in it: binds it to the interface as
  /// it is now and asks the kernel for the subscribed frames, the end of each own cycle, and
  /// reports of errors.
  /// @return Status::hardware_fault if that fails, and error() tells what
  /// Real-time: no (system calls, allocates).
  [[nodiscard]] Status open(const CanSubscription& subscription) noexcept try {
    close();
    link_ = CanLink::gone;
    socket_ = ::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
    if (socket_ < 0) return refuse("socket");
    ifreq request{};
    std::memcpy(request.ifr_name, interface_.c_str(), interface_.size());
    if (::ioctl(socket_, SIOCGIFINDEX, &request) < 0) return refuse("no such interface");

    std::vector<can_filter> filters;
    const auto listen_to = [&](std::uint32_t identifier) {
      filters.push_back({identifier, CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG});
    };
    for (const std::uint32_t identifier : subscription.identifiers) listen_to(identifier);
    last_of_cycle_ = subscription.last_of_cycle;
    tracked_ = subscription.frames_per_cycle > 0;
    if (tracked_) listen_to(last_of_cycle_);
    const auto bytes = static_cast<socklen_t>(filters.size() * sizeof(can_filter));
    if (::setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(), bytes) < 0) {
      return refuse("CAN_RAW_FILTER");
    }
    const can_err_mask_t errors = CAN_ERR_MASK;
    const int on = 1;
    // What is queued is charged to the socket, about 1 KiB a frame: little more than one cycle
    // fits. The kernel doubles the number and does not go below some five frames.
    const int queue =
        static_cast<int>(std::max<std::size_t>(subscription.frames_per_cycle, 4) * 512);
    if (!set(SOL_CAN_RAW, CAN_RAW_ERR_FILTER, errors)) return refuse("CAN_RAW_ERR_FILTER");
    if (!set(SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, tracked_ ? 1 : 0)) return refuse("own frames");
    if (!set(SOL_SOCKET, SO_TIMESTAMPNS, on)) return refuse("SO_TIMESTAMPNS");
    if (!set(SOL_SOCKET, SO_RXQ_OVFL, on)) return refuse("SO_RXQ_OVFL");
    if (tracked_ && !set(SOL_SOCKET, SO_SNDBUF, queue)) return refuse("SO_SNDBUF");

    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = request.ifr_ifindex;
    if (::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) < 0) {
      return refuse("bind");
    }
    link_ = CanLink::up;
    awaiting_ = false;
    lost_before_ = 0;
    return Status::ok;
  } catch (...) {
    return refuse("out of memory");
  }

  /// Fetches frames that have arrived, by one system call, or a few where there are many. Reports
  /// of the controller and own frames are dealt with here. Real-time: yes, but for the bus.
  [[nodiscard]] std::size_t receive(std::span<ReceivedCanFrame> frames) noexcept {
    constexpr std::size_t most = 32;
    constexpr std::size_t control_size =
        CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t));
    std::array<can_frame, most> raw;
    std::array<iovec, most> vectors;
    std::array<mmsghdr, most> messages;
    alignas(cmsghdr) std::array<std::array<std::byte, control_size>, most> controls;
    std::size_t count = 0;
    constexpr int most_calls = 4;  // own frames and reports do not count, and may be many
    for (int call = 0; call < most_calls && count < frames.size(); ++call) {
      const std::size_t wanted = std::min(most, frames.size() - count);
      for (std::size_t i = 0; i < wanted; ++i) {
        vectors[i] = {&raw[i], sizeof(can_frame)};
        messages[i] = {};
        messages[i].msg_hdr.msg_iov = &vectors[i];
        messages[i].msg_hdr.msg_iovlen = 1;
        messages[i].msg_hdr.msg_control = controls[i].data();
        messages[i].msg_hdr.msg_controllen = control_size;
      }
      const int got = ::recvmmsg(socket_, messages.data(), static_cast<unsigned>(wanted),
                                 MSG_DONTWAIT, nullptr);
      if (got < 0) {
        note_error(errno);
        // An error of the interface is told once, before the frames that came earlier.
        if (errno == ENETDOWN) continue;
        return count;
      }
      for (int i = 0; i < got; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (messages[k].msg_len != sizeof(can_frame)) continue;
        if (take(raw[k], messages[k].msg_hdr, frames[count])) ++count;
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
      statistics_.not_taken += batch.size();
      return link_ == CanLink::up ? CanSending::backlog : CanSending::failed;
    }
    if (batch.empty()) return CanSending::sent;
    std::array<can_frame, CanBatch::capacity> raw{};
    std::array<iovec, CanBatch::capacity> vectors;
    std::array<mmsghdr, CanBatch::capacity> messages;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      raw[i].can_id = batch[i].identifier | (batch[i].extended ? CAN_EFF_FLAG : 0);
      raw[i].can_dlc = batch[i].length;
      std::memcpy(raw[i].data, batch[i].data.data(), 8);
      vectors[i] = {&raw[i], sizeof(can_frame)};
      messages[i] = {};
      messages[i].msg_hdr.msg_iov = &vectors[i];
      messages[i].msg_hdr.msg_iovlen = 1;
    }
    const int result =
        ::sendmmsg(socket_, messages.data(), static_cast<unsigned>(batch.size()), MSG_DONTWAIT);
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
    // Once a frame is taken, the kernel does not tell why the next one was not.
    if (taken > 0 || errno == ENOBUFS || errno == EAGAIN) return CanSending::congested;
    note_error(errno);
    return CanSending::failed;
  }

  /// Waits for a frame, or a signal. Real-time: no (waits).
  void wait(std::chrono::nanoseconds time) noexcept {
    if (time.count() <= 0) return;
    const timespec limit{static_cast<time_t>(time.count() / 1'000'000'000),
                         static_cast<long>(time.count() % 1'000'000'000)};
    pollfd entry{socket_, POLLIN, 0};
    const int ready = ::ppoll(&entry, 1, &limit, nullptr);
    if (ready < 0 && errno == EINTR) return;
    // On a broken interface poll returns at once; the caller's loop must not become a busy one.
    if (ready != 0 && (entry.revents & POLLIN) == 0) ::nanosleep(&limit, nullptr);
  }

  /// Real-time: yes (reads the clock).
  [[nodiscard]] std::chrono::nanoseconds now() const noexcept {
    return std::chrono::steady_clock::now().time_since_epoch();
  }
  /// Real-time: yes.
  [[nodiscard]] CanLink link() const noexcept { return link_; }
  /// What `open` failed at. Real-time: yes.
  [[nodiscard]] const char* error() const noexcept { return error_; }
  [[nodiscard]] const std::string& interface() const noexcept { return interface_; }
  [[nodiscard]] const SocketCanStatistics& statistics() const noexcept { return statistics_; }

 private:
  template <class T>
  [[nodiscard]] bool set(int level, int option, const T& value) const noexcept {
    return ::setsockopt(socket_, level, option, &value, sizeof(value)) == 0;
  }

  void close() noexcept {
    if (socket_ >= 0) ::close(std::exchange(socket_, -1));
  }

  Status refuse(const char* what) noexcept {
    const bool no_can = socket_ < 0 && (errno == EAFNOSUPPORT || errno == EPROTONOSUPPORT);
    error_ = no_can ? "the kernel has no CAN" : what;
    close();
    return Status::hardware_fault;
  }

  void note_error(int error) noexcept {
    if (error == ENETDOWN) link_ = CanLink::down;
    if (error == ENODEV || error == ENXIO || error == EBADF) link_ = CanLink::gone;
  }

  /// Takes in a message of the kernel.
  /// @return true if it is a frame of another participant, which is in `received` then
  [[nodiscard]] bool take(const can_frame& raw, const msghdr& header,
                          ReceivedCanFrame& received) noexcept {
    received = {};
    for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr;
         part = CMSG_NXTHDR(const_cast<msghdr*>(&header), part)) {
      if (part->cmsg_level != SOL_SOCKET) continue;
      if (part->cmsg_type == SO_TIMESTAMPNS) {
        timespec stamp;
        std::memcpy(&stamp, CMSG_DATA(part), sizeof(stamp));
        received.time =
            std::chrono::seconds(stamp.tv_sec) + std::chrono::nanoseconds(stamp.tv_nsec);
      } else if (part->cmsg_type == SO_RXQ_OVFL) {
        std::uint32_t lost;  // since the socket exists, modulo 2^32
        std::memcpy(&lost, CMSG_DATA(part), sizeof(lost));
        statistics_.lost += lost - lost_before_;
        lost_before_ = lost;
      }
    }
    if ((raw.can_id & CAN_ERR_FLAG) != 0) {
      take_error(raw);
      return false;
    }
    if ((header.msg_flags & MSG_CONFIRM) != 0) {  // an own frame has been on the bus
      awaiting_ = false;
      return false;
    }
    if ((raw.can_id & CAN_RTR_FLAG) != 0 || raw.can_dlc > 8) return false;
    ++statistics_.received;
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
    if (report.bus_off) {
      ++statistics_.bus_offs;
      link_ = CanLink::bus_off;
    } else if (link_ == CanLink::bus_off && (report.restarted || report.recovered)) {
      link_ = CanLink::up;
    }
  }

  std::string interface_;
  std::chrono::nanoseconds confirmation_time_{};
  const char* error_ = "";
  int socket_ = -1;
  CanLink link_ = CanLink::gone;
  bool tracked_ = false;  ///< own cycles are followed
  std::uint32_t last_of_cycle_ = 0;
  bool awaiting_ = false;  ///< the end of the last cycle sent has not been on the bus yet
  std::chrono::nanoseconds sent_at_{};
  std::uint32_t lost_before_ = 0;
  SocketCanStatistics statistics_{};
};

}  // namespace articula
