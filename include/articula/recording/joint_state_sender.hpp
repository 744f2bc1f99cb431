// SPDX-License-Identifier: Apache-2.0
/// @file Joint states for whoever listens. POSIX; needs nlohmann-json (target articula::recording).
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

/// Where joint states are sent, and how often.
struct JointStateSenderOptions {
  std::string address = "127.0.0.1";  ///< IPv4
  std::uint16_t port = 9870;          ///< the one on which PlotJuggler's UDP server listens
  int divisor = 20;                   ///< every 20th record is sent: 50 Hz at 1 kHz
  bool references = true;             ///< the joints' references are sent, too
  RecordContents contents{};          ///< mimic joints are sent, and links' poses if named
};

/// Sends the joint states of every so-many-th record over UDP as JSON, for which PlotJuggler's "UDP
/// Server" with the protocol "json" and its timestamp field "timestamp" listens. A sink for
/// RecordStream. What does not fit into one datagram goes in several, each of which is JSON with the
/// same timestamp: PlotJuggler adds each figure to its curve by name. Datagrams that the system does
/// not take are counted, not sent again.
/// @tparam R  the robot
template <Robot R>
class JointStateSender {
 public:
  static constexpr std::size_t longest_datagram = 2048;  ///< what PlotJuggler reads [bytes]

  /// @throws std::invalid_argument if the address is none, the divisor is not positive, or the
  ///         robot has no link of a name
  /// @throws std::system_error if the system refuses a socket
  explicit JointStateSender(const R& robot, const JointStateSenderOptions& options = {})
      : robot_(robot),
        extras_(robot, options.contents),
        divisor_(options.divisor),
        references_(options.references) {
    if (options.divisor < 1) {
      detail::refuse({"joint state sender: divisor ", options.divisor, " is not at least 1"});
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

  /// Sends the record's joint states if it is one of those, beginning with the first.
  /// Real-time: no (allocates, calls the system).
  template <class Command>
  void write(const CycleRecord<joint_count<R>, Command>& record) {
    if (records_++ % static_cast<std::uint64_t>(divisor_) != 0) return;
    Json json = joint_state_json(robot_, record.time, record.state);
    if (references_) add_references(robot_, json, record.reference);
    add_extras(robot_, json, extras_, record.state);
    for (const std::string& text : split_json(json, longest_datagram)) {
      const auto sent = ::sendto(socket_, text.data(), text.size(), MSG_DONTWAIT,
                                 reinterpret_cast<const sockaddr*>(&target_), sizeof target_);
      ++(sent < 0 ? not_sent_ : sent_);
    }
  }

  /// Datagrams that the system took.
  [[nodiscard]] std::uint64_t sent() const noexcept { return sent_; }
  /// Datagrams that it did not.
  [[nodiscard]] std::uint64_t not_sent() const noexcept { return not_sent_; }

 private:
  [[no_unique_address]] R robot_;
  RecordExtras<R> extras_;
  int divisor_;
  bool references_;
  int socket_ = -1;
  sockaddr_in target_{};
  std::uint64_t records_ = 0;
  std::uint64_t sent_ = 0;
  std::uint64_t not_sent_ = 0;
};

}  // namespace articula
