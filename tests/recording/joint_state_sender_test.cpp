// SPDX-License-Identifier: Apache-2.0
// Joint states over UDP, on the loopback interface.
#include <articula/loop/joint_state_sender.hpp>
#include <articula/robots/q2d.hpp>

#include <poll.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "catch.hpp"
#include "record.hpp"

using namespace articula;

namespace {

/// Listens on a port of the system's choice.
class Listener {
 public:
  Listener() : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    REQUIRE(::bind(socket_, reinterpret_cast<sockaddr*>(&address), size) == 0);
    REQUIRE(::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) == 0);
    port_ = ntohs(address.sin_port);
  }
  ~Listener() { ::close(socket_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }

  /// All datagrams that have arrived. On the loopback interface they are there once they are sent.
  [[nodiscard]] std::vector<std::string> received() const {
    std::vector<std::string> datagrams;
    std::array<char, 4096> buffer{};
    for (;;) {
      const auto size = ::recv(socket_, buffer.data(), buffer.size(), MSG_DONTWAIT);
      if (size < 0) return datagrams;
      datagrams.emplace_back(buffer.data(), static_cast<std::size_t>(size));
    }
  }

 private:
  int socket_;
  std::uint16_t port_ = 0;
};

}  // namespace

TEST_CASE("every so-many-th joint state is sent as JSON that PlotJuggler reads") {
  const Listener listener;
  JointStateSender<Q2d> sender({.port = listener.port(), .divisor = 20});
  auto record = support::some_record();
  for (int k = 0; k < 100; ++k) {
    record.time = k;
    sender.write(record);
  }
  CHECK(sender.sent() == 5);
  CHECK(sender.not_sent() == 0);
  const auto datagrams = listener.received();
  REQUIRE(datagrams.size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    const Json json = Json::parse(datagrams[i]);
    CHECK(json["timestamp"] == 20.0 * static_cast<double>(i));
    CHECK(json["q2d"]["shoulder_active_joint"]["position"] == record.state.position[0]);
    CHECK(json["q2d"]["elbow_active_joint"]["velocity"] == record.state.velocity[1]);
    CHECK(json["q2d"]["elbow_active_joint"]["effort"] == record.state.effort[1]);
    CHECK(json["q2d"].size() == 2);
  }
}

TEST_CASE("NaN goes as null, so that the text stays JSON") {
  JointState<2> state;
  state.position[1] = std::numeric_limits<double>::quiet_NaN();
  const Json json = Json::parse(joint_state_json(Q2d(), 0, state).dump());
  CHECK(json["q2d"]["elbow_active_joint"]["position"].is_null());
}

TEST_CASE("what the system does not take is counted and does not disturb") {
  // Nobody listens: from the second datagram on the system may say so.
  std::uint16_t port = 0;
  { port = Listener().port(); }
  JointStateSender<Q2d> sender({.port = port, .divisor = 1});
  for (int k = 0; k < 10; ++k) sender.write(support::some_record());
  CHECK(sender.sent() + sender.not_sent() == 10);
}

TEST_CASE("options that make no sense are refused by name") {
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(JointStateSender<Q2d>({.address = "here"}), Contains("address 'here'"));
  CHECK_THROWS_WITH(JointStateSender<Q2d>({.divisor = 0}), Contains("divisor 0"));
}
