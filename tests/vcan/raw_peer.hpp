// SPDX-License-Identifier: Apache-2.0
/// @file Another participant on a CAN interface, written on the kernel's interface alone.
#pragma once

#include "catch.hpp"

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

namespace support {

/// Runs a shell command that must succeed.
inline void shell(const std::string& command) {
  CAPTURE(command);
  REQUIRE(std::system(command.c_str()) == 0);
}

/// Another participant. It hears everything but its own frames.
class RawPeer {
 public:
  explicit RawPeer(const char* interface = "vcan0")
      : socket_(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK, CAN_RAW)) {
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex(interface));
    REQUIRE(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0);
  }
  RawPeer(const RawPeer&) = delete;
  RawPeer& operator=(const RawPeer&) = delete;
  ~RawPeer() { ::close(socket_); }

  /// @param identifier  with the kernel's flags
  [[nodiscard]] bool send(std::uint32_t identifier, const std::vector<std::uint8_t>& data) const {
    can_frame frame{};
    frame.can_id = identifier;
    frame.can_dlc = static_cast<std::uint8_t>(data.size());
    for (std::size_t i = 0; i < data.size(); ++i) frame.data[i] = data[i];
    return ::write(socket_, &frame, sizeof(frame)) == sizeof(frame);
  }
  /// The next frame, if one comes in time.
  [[nodiscard]] std::optional<can_frame> receive(int milliseconds = 0) const {
    pollfd entry{socket_, POLLIN, 0};
    can_frame frame{};
    if (milliseconds > 0) static_cast<void>(::poll(&entry, 1, milliseconds));
    if (::read(socket_, &frame, sizeof(frame)) != sizeof(frame)) return {};
    return frame;
  }
  /// All frames that have come.
  [[nodiscard]] std::vector<can_frame> receive_all() const {
    std::vector<can_frame> frames;
    while (const auto frame = receive()) frames.push_back(*frame);
    return frames;
  }

 private:
  int socket_;
};

inline void sleep_milliseconds(long milliseconds) {
  const timespec time{milliseconds / 1000, milliseconds % 1000 * 1'000'000};
  ::nanosleep(&time, nullptr);
}

/// vcan0 as it was at the beginning.
inline void restore_interface() {
  shell("ip link show vcan0 > /dev/null 2>&1 || ip link add vcan0 type vcan");
  shell("tc qdisc del dev vcan0 root 2> /dev/null; ip link set vcan0 up");
}

}  // namespace support
