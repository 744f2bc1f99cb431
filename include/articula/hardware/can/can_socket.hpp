// SPDX-License-Identifier: Apache-2.0
/// @file The system calls of a raw CAN socket of Linux.
#pragma once

#include "articula/hardware/can/can_batch.hpp"
#include "articula/hardware/can/can_codec.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

namespace articula::detail {

/// A message of a raw CAN socket: a frame or an error frame, and what the kernel adds to it.
struct RawCanMessage {
  can_frame frame{};
  std::chrono::nanoseconds time{};  ///< of arrival, by the system's clock
  std::uint32_t lost = 0;  ///< frames dropped by a full queue since the socket exists, modulo 2^32
  bool has_lost = false;   ///< `lost` is valid
  bool own = false;        ///< sent by this socket, and on the bus now
  bool whole = false;      ///< has the length of a frame
};

/// The system calls of a raw CAN socket.
class CanSocket {
 public:
  static constexpr std::size_t most = 32;  ///< the most messages of one call of `receive`

  CanSocket() = default;
  CanSocket(CanSocket&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}
  CanSocket& operator=(CanSocket&& other) noexcept {
    if (this == &other) return *this;
    close();
    socket_ = std::exchange(other.socket_, -1);
    return *this;
  }
  ~CanSocket() { close(); }

  void close() noexcept {
    if (socket_ >= 0) ::close(std::exchange(socket_, -1));
  }

  /// Opens a new socket and binds it to the interface. It receives the subscribed frames, the end
  /// of each own cycle, and error frames.
  /// @return what has failed; nullptr on success
  /// @throws std::bad_alloc if there is no memory
  /// Real-time: no (system calls, allocates).
  [[nodiscard]] const char* open(const std::string& interface,
                                 const CanSubscription& subscription) {
    close();
    socket_ = ::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
    if (socket_ < 0) {
      const bool no_can = errno == EAFNOSUPPORT || errno == EPROTONOSUPPORT;
      return no_can ? "the kernel has no CAN" : "socket";
    }
    ifreq request{};
    std::memcpy(request.ifr_name, interface.c_str(), interface.size());
    if (::ioctl(socket_, SIOCGIFINDEX, &request) < 0) return "no such interface";

    const bool tracked = subscription.frames_per_cycle > 0;
    std::vector<can_filter> filters;
    const auto listen_to = [&](std::uint32_t identifier) {
      filters.push_back({identifier, CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG});
    };
    for (const std::uint32_t identifier : subscription.identifiers) listen_to(identifier);
    if (tracked) listen_to(subscription.last_of_cycle);
    const auto bytes = static_cast<socklen_t>(filters.size() * sizeof(can_filter));
    if (::setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(), bytes) < 0) {
      return "CAN_RAW_FILTER";
    }
    const can_err_mask_t errors = CAN_ERR_MASK;
    const int on = 1;
    // The kernel charges about 1 KiB per queued frame to the socket. Little more than one cycle
    // fits: the kernel doubles this number, and allows at least some five frames.
    const int queue =
        static_cast<int>(std::max<std::size_t>(subscription.frames_per_cycle, 4) * 512);
    if (!set(SOL_CAN_RAW, CAN_RAW_ERR_FILTER, errors)) return "CAN_RAW_ERR_FILTER";
    if (!set(SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, tracked ? 1 : 0)) return "own frames";
    if (!set(SOL_SOCKET, SO_TIMESTAMPNS, on)) return "SO_TIMESTAMPNS";
    if (!set(SOL_SOCKET, SO_RXQ_OVFL, on)) return "SO_RXQ_OVFL";
    if (tracked && !set(SOL_SOCKET, SO_SNDBUF, queue)) return "SO_SNDBUF";

    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = request.ifr_ifindex;
    const bool bound =
        ::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
    return bound ? nullptr : "bind";
  }

  /// Returns messages that have arrived, by one system call, and never waits.
  /// @return their number; -1 with errno if there are none
  /// Real-time: yes, but for the kernel.
  [[nodiscard]] int receive(std::span<RawCanMessage> received) const noexcept {
    constexpr std::size_t control_size =
        CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t));
    std::array<iovec, most> vectors;
    std::array<mmsghdr, most> messages;
    alignas(cmsghdr) std::array<std::array<std::byte, control_size>, most> controls;
    const std::size_t wanted = std::min(most, received.size());
    for (std::size_t i = 0; i < wanted; ++i) {
      vectors[i] = {&received[i].frame, sizeof(can_frame)};
      messages[i] = {};
      messages[i].msg_hdr.msg_iov = &vectors[i];
      messages[i].msg_hdr.msg_iovlen = 1;
      messages[i].msg_hdr.msg_control = controls[i].data();
      messages[i].msg_hdr.msg_controllen = control_size;
    }
    const int got =
        ::recvmmsg(socket_, messages.data(), static_cast<unsigned>(wanted), MSG_DONTWAIT, nullptr);
    for (int i = 0; i < got; ++i) {
      const auto k = static_cast<std::size_t>(i);
      received[k].whole = messages[k].msg_len == sizeof(can_frame);
      copy_additions(messages[k].msg_hdr, received[k]);
    }
    return got;
  }

  /// Sends frames by one system call, and never waits.
  /// @return number of frames that the kernel has taken; -1 with errno if none
  /// Real-time: yes, but for the kernel.
  [[nodiscard]] int send(const CanBatch& batch) const noexcept {
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
    return ::sendmmsg(socket_, messages.data(), static_cast<unsigned>(batch.size()), MSG_DONTWAIT);
  }

  /// Waits for a message, or a signal. Real-time: no (waits).
  void wait(std::chrono::nanoseconds time) const noexcept {
    if (time.count() <= 0) return;
    const timespec limit{static_cast<time_t>(time.count() / 1'000'000'000),
                         static_cast<long>(time.count() % 1'000'000'000)};
    pollfd entry{socket_, POLLIN, 0};
    const int ready = ::ppoll(&entry, 1, &limit, nullptr);
    if (ready < 0 && errno == EINTR) return;
    // On a broken interface ppoll returns at once. Sleeping keeps the caller's loop from spinning.
    if (ready != 0 && (entry.revents & POLLIN) == 0) ::nanosleep(&limit, nullptr);
  }

 private:
  template <class T>
  [[nodiscard]] bool set(int level, int option, const T& value) const noexcept {
    return ::setsockopt(socket_, level, option, &value, sizeof(value)) == 0;
  }

  /// Copies the kernel's additions into a message.
  static void copy_additions(const msghdr& header, RawCanMessage& message) noexcept {
    message.time = {};
    message.has_lost = false;
    message.own = (header.msg_flags & MSG_CONFIRM) != 0;
    for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr;
         part = CMSG_NXTHDR(const_cast<msghdr*>(&header), part)) {
      if (part->cmsg_level != SOL_SOCKET) continue;
      if (part->cmsg_type == SO_TIMESTAMPNS) {
        timespec stamp;
        std::memcpy(&stamp, CMSG_DATA(part), sizeof(stamp));
        message.time = std::chrono::seconds(stamp.tv_sec) + std::chrono::nanoseconds(stamp.tv_nsec);
      } else if (part->cmsg_type == SO_RXQ_OVFL) {
        std::memcpy(&message.lost, CMSG_DATA(part), sizeof(message.lost));
        message.has_lost = true;
      }
    }
  }

  int socket_ = -1;
};

}  // namespace articula::detail
