// SPDX-License-Identifier: Apache-2.0
// Joint states over UDP, on the loopback interface.
#include <articula/recording/joint_state_sender.hpp>
#include <articula/robots/pr2.hpp>
#include <articula/robots/q2d.hpp>

#include <poll.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "catch.hpp"
#include "remote/record.hpp"

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
    CHECK(json["q2d"]["elbow_active_joint"]["reference"]["velocity"] ==
          record.reference.velocity[1]);
    CHECK(json["q2d"].size() == 2);
  }
}

TEST_CASE("a robot of many joints takes several datagrams, which together are the record") {
  const Listener listener;
  constexpr int n = joint_count<Pr2>;
  const std::string link(model_of(Pr2()).links.back().name.view());
  JointStateSender<Pr2> sender({.port = listener.port(), .contents = {.links = {link}}});
  CycleRecord<n, EffortCommand<n>> record;
  record.time = 0.1 + 0.2;
  for (int j = 0; j < n; ++j) {  // long numbers
    record.state.position[j] = -1e-200 / (j + 3);
    record.state.velocity[j] = -1e-201 / (j + 3);
    record.state.effort[j] = -1e-202 / (j + 3);
    record.reference.position[j] = -1e-203 / (j + 3);
  }
  sender.write(record);
  const auto datagrams = listener.received();
  REQUIRE(datagrams.size() > 1);
  CHECK(sender.sent() == datagrams.size());
  Json together;
  std::size_t joints = 0;
  for (const std::string& text : datagrams) {
    CHECK(text.size() <= JointStateSender<Pr2>::longest_datagram);
    const Json json = Json::parse(text);
    CHECK(json["timestamp"] == record.time);
    if (json.contains("pr2")) joints += json["pr2"].size();
    together.merge_patch(json);
  }
  CHECK(joints == moving_joint_count<Pr2>);  // none is sent twice
  Json expected = joint_state_json(Pr2(), record.time, record.state);
  add_references(Pr2(), expected, record.reference);
  add_extras(Pr2(), expected, {Pr2(), {.links = {link}}}, record.state);
  CHECK(nlohmann::json(together) == nlohmann::json(expected));

  JointStateSender<Pr2> brief(
      {.port = listener.port(), .references = false, .contents = {.mimic_joints = false}});
  brief.write(record);
  CHECK(listener.received().size() < datagrams.size());
}

TEST_CASE("mimic joints and links go with the joints, links as ROS's transforms") {
  constexpr int n = joint_count<Pr2>;
  JointState<n> state;
  for (int j = 0; j < n; ++j) state.position[j] = 0.01 * (j + 1);
  const std::string link(model_of(Pr2()).links.back().name.view());
  Json json = joint_state_json(Pr2(), 0, state);
  add_extras(Pr2(), json, {Pr2(), {.links = {link}}}, state);
  const auto names = moving_joint_names(Pr2());
  const auto all = moving_joint_positions(Pr2(), state.position);
  REQUIRE(json["pr2"].size() == names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    CHECK(json["pr2"][std::string(names[i])]["position"] == all[static_cast<int>(i)]);
  }
  const auto pose = forward_kinematics(Pr2(), state.position, link);
  const Json& transform = json["links"][link];
  CHECK(transform["translation"]["z"] == pose.translation().z());
  const Json& r = transform["rotation"];
  const Eigen::Quaterniond rotation(r["w"], r["x"], r["y"], r["z"]);
  CHECK((rotation.toRotationMatrix() - pose.linear()).norm() < 1e-14);  // rounding
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
  {
    port = Listener().port();
  }
  JointStateSender<Q2d> sender({.port = port, .divisor = 1});
  for (int k = 0; k < 10; ++k) sender.write(support::some_record());
  CHECK(sender.sent() + sender.not_sent() == 10);
}

TEST_CASE("options that make no sense are refused by name") {
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(JointStateSender<Q2d>({.address = "here"}), Contains("address 'here'"));
  CHECK_THROWS_WITH(JointStateSender<Q2d>({.divisor = 0}), Contains("divisor 0"));
}
