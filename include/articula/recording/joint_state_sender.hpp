// SPDX-License-Identifier: Apache-2.0
/// @file Joint states over UDP, for live plots. POSIX; needs nlohmann-json (target
/// articula::recording).
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/recording/record_json.hpp"
#include "articula/recording/split_json.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <string>
#include <system_error>

namespace articula {

/// The receiver, rate and contents of joint states over UDP.
struct JointStateSenderOptions {
  std::string address = "127.0.0.1";  ///< IPv4
  std::uint16_t port = 9870;          ///< the default of PlotJuggler's UDP server
  int divisor = 20;                   ///< sends every 20th record: 50 Hz at 1 kHz
  bool references = true;             ///< sends the references of the joints
  RecordContents contents{};          ///< mimic joints and links to send
};

/// Sends the joint states of every `divisor`-th record over UDP as JSON. It is a sink for
/// RecordStream. In PlotJuggler, start "UDP Server" with the protocol "json" and the timestamp field
/// "timestamp". JSON that exceeds a datagram is split into several with the same timestamp.
/// Datagrams that the system refuses are counted and lost.
/// @tparam R  the robot
template <Robot R>
class JointStateSender {
 public:
  static constexpr std::size_t longest_datagram = 2048;  ///< what PlotJuggler reads [bytes]

  /// @throws std::invalid_argument if the address is not IPv4, the divisor is less than 1, or the
  ///         robot has no link of a name
  /// @throws std::system_error if the system refuses a socket
  explicit JointStateSender(const R& robot, const JointStateSenderOptions& options = {})
      : robot_(robot), extras_(robot, options.contents), options_(options) {
    if (options.divisor < 1) {
      detail::refuse({"joint state sender: divisor ", options.divisor, " is less than 1"});
    }
    target_.sin_family = AF_INET;
    target_.sin_port = htons(options.port);
    if (inet_pton(AF_INET, options.address.c_str(), &target_.sin_addr) != 1) {
      detail::refuse(
          {"joint state sender: address '", options.address, "' is not an IPv4 address"});
    }
    socket_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (socket_ < 0) {
      throw std::system_error(errno, std::generic_category(), "joint state sender: socket");
    }
  }
  /// For a robot known at compile time.
  explicit JointStateSender(const JointStateSenderOptions& options = {})
    requires DescribedRobot<R>
      : JointStateSender(R(), options) {}
  ~JointStateSender() { ::close(socket_); }
  JointStateSender(const JointStateSender&) = delete;
  JointStateSender& operator=(const JointStateSender&) = delete;

  /// Sends the joint states of the first record, and of every `divisor`-th after it.
  /// Real-time: no (allocates, calls the system).
  template <class Command>
  void write(const CycleRecord<joint_count<R>, Command>& record) {
    if (records_++ % static_cast<std::uint64_t>(options_.divisor) != 0) return;
    Json json = joint_state_json(robot_, record.time, record.state);
    if (options_.references) add_references(robot_, json, record.reference);
    add_extras(robot_, json, extras_, record.state);
    for (const std::string& text : split_json(json, longest_datagram)) {
      const auto sent = ::sendto(socket_, text.data(), text.size(), MSG_DONTWAIT,
                                 reinterpret_cast<const sockaddr*>(&target_), sizeof target_);
      ++(sent < 0 ? not_sent_ : sent_);
    }
  }

  /// Number of datagrams sent.
  [[nodiscard]] std::uint64_t sent() const noexcept { return sent_; }
  /// Number of datagrams that the system refused.
  [[nodiscard]] std::uint64_t not_sent() const noexcept { return not_sent_; }

 private:
  [[no_unique_address]] R robot_;
  RecordExtras<R> extras_;
  JointStateSenderOptions options_;
  int socket_ = -1;
  sockaddr_in target_{};
  std::uint64_t records_ = 0;
  std::uint64_t sent_ = 0;
  std::uint64_t not_sent_ = 0;
};

}  // namespace articula
