// SPDX-License-Identifier: Apache-2.0
/// @file Joint states over UDP, for live plots. POSIX; needs nlohmann-json (target
/// articula::recording).
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/recording/record_json.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <string>
#include <system_error>
#include <vector>

namespace articula {

/// Splits a record into texts of limited length. Each is JSON of the same shape: it has all values
/// of the first level ("timestamp"), and whole members of the objects there (joints, links).
/// @param json     an object, of which some members may be objects
/// @param longest  length of a text [bytes]. A member that is longer has a text of its own; that of
///                 a joint has at most 1000 bytes, its name included.
/// @return         one text if everything fits
/// Real-time: no (allocates).
[[nodiscard]] inline std::vector<std::string> split_json(const Json& json, std::size_t longest) {
  std::string whole = json.dump();
  if (whole.size() <= longest) return {whole};
  std::string values;
  for (const auto& [name, member] : json.items()) {
    if (!member.is_object()) values += Json(name).dump() + ":" + member.dump() + ",";
  }
  std::vector<std::string> texts;
  for (const auto& [name, members] : json.items()) {
    if (!members.is_object()) continue;
    const std::string head = "{" + values + Json(name).dump() + ":{", end = "}}";
    std::string text;
    for (const auto& [key, member] : members.items()) {
      const std::string entry = Json(key).dump() + ":" + member.dump();
      if (!text.empty() && text.size() + 1 + entry.size() + end.size() > longest) {
        texts.push_back(text + end);
        text.clear();
      }
      text += (text.empty() ? head : ",") + entry;
    }
    if (!text.empty()) texts.push_back(text + end);
  }
  return texts;
}

/// The receiver, rate and contents of joint states over UDP.
struct JointStateSenderOptions {
  std::string address = "127.0.0.1";  ///< IPv4
  std::uint16_t port = 9870;          ///< the default of PlotJuggler's UDP server
  int divisor = 20;                   ///< sends every 20th record: 50 Hz at 1 kHz
  bool references = true;             ///< sends the references of the joints
  RecordContents contents{};          ///< mimic joints and links to send
};

/// Sends the joint states of every `divisor`-th record over UDP as JSON. It is a sink for
/// RecordStream. In PlotJuggler, start "UDP Server" with the protocol "json" and the timestamp
/// field "timestamp". JSON that exceeds a datagram is split into several with the same timestamp.
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
