// SPDX-License-Identifier: Apache-2.0
// A running loop as clients of both middlewares see and steer it, over DDS on loopback.
#include "articula/ros2/bridge/bridge.hpp"
#include "articula/ros2/messages/action_msgs.hpp"
#include "articula/ros2/messages/control_msgs.hpp"
#include "articula/ros2/messages/controller_manager_msgs.hpp"
#include "articula/ros2/messages/rcl_interfaces.hpp"
#include "articula/ros2/names.hpp"

#include "bridged_arm.hpp"
#include "cyclone_peer.hpp"
#include "fast_dds_peer.hpp"
#include "support.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <random>
#include <string>
#include <thread>
#include <vector>

using namespace articula::ros2;
using namespace articula::ros2::test;
using support::elbow_joint;
using support::shoulder_joint;
using Clock = std::chrono::steady_clock;

namespace {

using Listing = controller_manager_msgs::srv::ListControllers<Jazzy>;
using SetHardware = controller_manager_msgs::srv::SetHardwareComponentState<Jazzy>;
using SetGains = rcl_interfaces::srv::SetParameters<Jazzy>;
using GetGains = rcl_interfaces::srv::GetParameters<Jazzy>;
using Follow = control_msgs::action::FollowJointTrajectory<Jazzy>;
using Trajectory = trajectory_msgs::msg::JointTrajectory<Jazzy>;
using Feedback = FeedbackMessage<Follow>;

// A simulated Q2D that runs in its own thread at its own rate.
struct RunningArm {
  RunningArm() {
    thread = std::thread([this] {
      for (auto next = Clock::now(); runs; next += std::chrono::milliseconds(1)) {
        std::this_thread::sleep_until(next);
        loop->cycles(1);
      }
    });
  }
  RunningArm(const RunningArm&) = delete;
  RunningArm& operator=(const RunningArm&) = delete;
  ~RunningArm() {
    runs = false;
    thread.join();
  }
  std::unique_ptr<support::AnyLoop> loop = support::switched_arm();
  std::atomic<bool> runs = true;
  std::thread thread{};
};

// A peer that sends random bytes to topics and services of the bridge.
class Noise {
 public:
  explicit Noise(unsigned domain) : peer_(domain) {
    add(topic_name("/pid_plus_gravity/joint_trajectory"), dds_type_name<Trajectory>());
    add(request_topic_name("/controller_manager/list_controllers"),
        dds_type_name<Listing::Request>());
    add(request_topic_name("/pid_plus_gravity/set_parameters"), dds_type_name<SetGains::Request>());
  }
  void send() {
    Bytes bytes(4 + random_() % 200);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random_() & 0xff);
    if (random_() % 2 == 0) bytes[0] = bytes[2] = bytes[3] = std::byte{0}, bytes[1] = std::byte{1};
    peer_.write(writers_[random_() % writers_.size()], bytes);
  }

 private:
  void add(const std::string& topic, const std::string& type) {
    writers_.push_back(peer_.make_writer(topic, type));
  }
  FastDdsPeer peer_;
  std::vector<std::size_t> writers_{};
  std::mt19937 random_{1};
};

// Waits at most 10 s for a condition while random bytes come.
template <class Condition>
bool wait(Noise& noise, Condition condition) {
  const auto end = Clock::now() + std::chrono::seconds(10);
  while (!condition()) {
    if (Clock::now() > end) return false;
    noise.send();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

// A client of a service as rmw_fastrtps has it.
template <class Service>
class Client {
 public:
  Client(FastDdsPeer& peer, Noise& noise, const std::string& service)
      : peer_(peer),
        noise_(noise),
        requests_(peer.make_writer(request_topic_name(service),
                                   dds_type_name<typename Service::Request>())),
        replies_(peer.make_reader(reply_topic_name(service),
                                  dds_type_name<typename Service::Response>())) {}
  [[nodiscard]] bool is_ready() const {
    return peer_.matches_of_writer(requests_) == 1 && peer_.matches_of_reader(replies_) == 1;
  }
  std::int64_t send(const typename Service::Request& request) {
    return peer_.request(requests_, replies_, bytes_of(request));
  }
  typename Service::Response wait_for(std::int64_t number) {
    typename Service::Response response{};
    std::vector<FastDdsPeer::Reply> replies;
    REQUIRE(wait(noise_, [&] { return !(replies = peer_.take_replies(replies_)).empty(); }));
    CHECK(replies[0].is_mine);
    CHECK(replies[0].sequence == number);
    REQUIRE(decode(replies[0].bytes, response) == CdrError::none);
    return response;
  }
  typename Service::Response call(const typename Service::Request& request) {
    return wait_for(send(request));
  }

 private:
  FastDdsPeer& peer_;
  Noise& noise_;
  std::size_t requests_, replies_;
};

std::string state_of(const Listing::Response& list, const std::string& name) {
  for (const auto& controller : list.controller) {
    if (controller.name == name) return controller.state;
  }
  return "absent";
}

}  // namespace

TEST_CASE("clients of both middlewares steer a running loop while random bytes come") {
  talk_over_udp_only();
  RunningArm arm;
  const Bridge bridge(arm.loop->port(), {.dds = {.domain = domain()}});
  FastDdsPeer fast(domain());
  CyclonePeer cyclone(domain());
  Noise noise(domain());

  const std::string action = "/pid_plus_gravity/follow_joint_trajectory";
  Client<SetHardware> set_hardware(fast, noise, "/controller_manager/set_hardware_component_state");
  Client<Listing> list(fast, noise, "/controller_manager/list_controllers");
  Client<SetGains> set_gains(fast, noise, "/pid_plus_gravity/set_parameters");
  Client<GetGains> get_gains(fast, noise, "/pid_plus_gravity/get_parameters");
  Client<SendGoal<Follow>> send_goal(fast, noise, send_goal_name(action));
  Client<GetResult<Follow>> get_result(fast, noise, get_result_name(action));
  const auto feedback_reader =
      fast.make_reader(topic_name(feedback_name(action)), dds_type_name<Feedback>());
  const int states_reader = cyclone.make_states_reader(topic_name("/joint_states"));
  cyclone.make_switch_client("/controller_manager/switch_controller");
  REQUIRE(wait(noise, [&] {
    return set_hardware.is_ready() && list.is_ready() && set_gains.is_ready() &&
           get_gains.is_ready() && send_goal.is_ready() && get_result.is_ready() &&
           fast.matches_of_reader(feedback_reader) == 1 && cyclone.finds_service();
  }));

  // Joint states in Cyclone DDS.
  std::vector<CyclonePeer::JointStates> states;
  REQUIRE(wait(noise, [&] { return !(states = cyclone.take_states(states_reader)).empty(); }));
  CHECK(states[0].names == std::vector<std::string>{shoulder_joint, elbow_joint});
  REQUIRE(states[0].positions.size() == 2);
  CHECK(std::abs(states[0].positions[0]) < 0.01);

  CHECK(state_of(list.call({}), "pid_plus_gravity") == "inactive");
  SetHardware::Request activation;
  activation.name = "q2d";
  activation.target_state.label = "active";
  CHECK(set_hardware.call(activation).ok);
  CHECK(state_of(list.call({}), "pid_plus_gravity") == "active");

  // Gains.
  const std::string gain = "gains." + shoulder_joint + ".p";
  SetGains::Request change;
  change.parameters.resize(1);
  change.parameters[0].name = gain;
  change.parameters[0].value.type = rcl_interfaces::msg::ParameterType::floating_point;
  change.parameters[0].value.double_value = 2000;
  const auto set = set_gains.call(change);
  REQUIRE(set.results.size() == 1);
  CHECK(set.results[0].successful);
  GetGains::Request names;
  names.names = {gain};
  const auto got = get_gains.call(names);
  REQUIRE(got.values.size() == 1);
  CHECK(got.values[0].double_value == 2000);

  // A goal: accepted, feedback, result; the joints arrive.
  SendGoal<Follow>::Request goal;
  goal.goal_id.uuid[0] = 1;
  goal.goal.trajectory.joint_names = {shoulder_joint, elbow_joint};
  goal.goal.trajectory.points = {{.positions = {0.3, -0.2}, .time_from_start = {1, 0}}};
  REQUIRE(send_goal.call(goal).accepted);
  GetResult<Follow>::Request question;
  question.goal_id.uuid[0] = 1;
  const std::int64_t asked = get_result.send(question);
  std::vector<Bytes> feedbacks;
  REQUIRE(wait(noise, [&] { return !(feedbacks = fast.take(feedback_reader)).empty(); }));
  Feedback feedback;
  REQUIRE(decode(feedbacks[0], feedback) == CdrError::none);
  CHECK(feedback.goal_id.uuid[0] == 1);
  CHECK(feedback.feedback.joint_names.size() == 2);
  const auto result = get_result.wait_for(asked);
  CHECK(result.status == action_msgs::msg::GoalStatus::succeeded);
  CHECK(result.result.error_string == "Goal successfully reached!");
  cyclone.take_states(states_reader);
  REQUIRE(wait(noise, [&] { return !(states = cyclone.take_states(states_reader)).empty(); }));
  CHECK(std::abs(states.back().positions[0] - 0.3) < 0.02);
  CHECK(std::abs(states.back().positions[1] + 0.2) < 0.02);

  // Switching in the dialect of Cyclone DDS, done and refused.
  const auto switched = [&](std::int64_t number, const std::string& on, const std::string& off) {
    cyclone.request_switch(number, {on}, {off});
    std::optional<CyclonePeer::Reply> reply;
    REQUIRE(wait(noise, [&] { return (reply = cyclone.take_reply()).has_value(); }));
    CHECK(reply->client == cyclone.client());
    CHECK(reply->sequence == number);
    return *reply;
  };
  CHECK(switched(1, "computed_torque", "pid_plus_gravity").success);
  CHECK(state_of(list.call({}), "computed_torque") == "active");
  const auto refused = switched(2, "ghost", "computed_torque");
  CHECK_FALSE(refused.success);
  CHECK(refused.message ==
        "controller 'ghost': unknown name; controllers: pid_plus_gravity, computed_torque");
  CHECK(state_of(list.call({}), "computed_torque") == "active");

  // A late joiner.
  const int description = cyclone.make_reader(topic_name("/robot_description"), true);
  std::vector<std::string> texts;
  REQUIRE(wait(noise, [&] { return !(texts = cyclone.take(description)).empty(); }));
  CHECK(texts[0].find("<robot name=\"q2d\"") != std::string::npos);

  REQUIRE(wait(noise, [&] { return bridge.dropped().malformed > 100; }));
  CHECK(bridge.error().empty());
}
