// SPDX-License-Identifier: Apache-2.0
// Bridges beside each other, and clients that vanish in the middle of something.
#include "articula/ros2/bridge/bridge.hpp"
#include "articula/ros2/messages/action_msgs.hpp"
#include "articula/ros2/messages/control_msgs.hpp"
#include "articula/ros2/messages/controller_manager_msgs.hpp"
#include "articula/ros2/messages/sensor_msgs.hpp"
#include "articula/ros2/names.hpp"

#include "bridged_arm.hpp"
#include "fast_dds_peer.hpp"
#include "support.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

using namespace articula::ros2;
using namespace articula::ros2::test;
using support::elbow_joint;
using support::shoulder_joint;
using Clock = std::chrono::steady_clock;

extern char** environ;  // NOLINT: POSIX

namespace {

using Follow = control_msgs::action::FollowJointTrajectory<Jazzy>;
using Switching = controller_manager_msgs::srv::SwitchController<Jazzy>;
using Listing = controller_manager_msgs::srv::ListControllers<Jazzy>;
using SetHardware = controller_manager_msgs::srv::SetHardwareComponentState<Jazzy>;
using States = sensor_msgs::msg::JointState<Jazzy>;

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

template <class Condition>
bool eventually(Condition condition) {
  const auto end = Clock::now() + std::chrono::seconds(60);
  while (!condition()) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

// A client of a service as rmw_fastrtps has it.
template <class Service>
class Client {
 public:
  Client(FastDdsPeer& peer, const std::string& service)
      : peer_(peer),
        requests_(peer.make_writer(request_topic_name(service),
                                   dds_type_name<typename Service::Request>())),
        replies_(peer.make_reader(reply_topic_name(service),
                                  dds_type_name<typename Service::Response>())) {}
  void send(const typename Service::Request& request) {
    REQUIRE(eventually([&] {
      return peer_.matches_of_writer(requests_) == 1 && peer_.matches_of_reader(replies_) == 1;
    }));
    peer_.request(requests_, replies_, bytes_of(request));
  }
  typename Service::Response call(const typename Service::Request& request) {
    send(request);
    typename Service::Response response{};
    std::vector<FastDdsPeer::Reply> replies;
    REQUIRE(eventually([&] { return !(replies = peer_.take_replies(replies_)).empty(); }));
    REQUIRE(decode(replies[0].bytes, response) == CdrError::none);
    return response;
  }

 private:
  FastDdsPeer& peer_;
  std::size_t requests_, replies_;
};

SetHardware::Request activation() {
  SetHardware::Request request;
  request.name = "q2d";
  request.target_state.label = "active";
  return request;
}

SendGoal<Follow>::Request goal_of(std::uint8_t id, double shoulder, int seconds) {
  SendGoal<Follow>::Request goal;
  goal.goal_id.uuid[0] = id;
  goal.goal.trajectory.joint_names = {shoulder_joint, elbow_joint};
  goal.goal.trajectory.points = {{.positions = {shoulder, -0.2}, .time_from_start = {seconds, 0}}};
  return goal;
}

const std::string action = "/pid_plus_gravity/follow_joint_trajectory";

// The domain of the test that has started this process.
unsigned given_domain() {
  const char* const text = std::getenv("ARTICULA_TEST_DOMAIN");  // NOLINT(concurrency-mt-unsafe)
  return text == nullptr ? domain() : static_cast<unsigned>(std::strtoul(text, nullptr, 10));
}

// Runs a test case of this program in a process of its own, in the domain of this one.
pid_t start(const std::string& tag) {
  ::setenv("ARTICULA_TEST_DOMAIN", std::to_string(domain()).c_str(), 1);  // NOLINT
  std::array<std::string, 2> words{"/proc/self/exe", tag};
  std::array<char*, 3> arguments{words[0].data(), words[1].data(), nullptr};
  pid_t process = 0;
  REQUIRE(::posix_spawn(&process, words[0].c_str(), nullptr, nullptr, arguments.data(), environ) ==
          0);
  return process;
}

constexpr int many = 20;  // topics

std::string topic_of(int number) { return "/topic_" + std::to_string(number); }

// How long a transport takes to end while a reader of its topics stands still.
Clock::duration time_to_end(int topics) {
  auto transport = std::make_unique<FastDdsTransport>(FastDdsOptions{.domain = domain()});
  std::vector<std::unique_ptr<SampleWriter>> writers;
  for (int k = 0; k < topics; ++k) {
    writers.push_back(transport->advertise(text_topic(topic_of(k), {.depth = 10})));
  }
  const pid_t reader = start("[.reader]");
  const bool found = poll_until(*transport, [&] {
    return std::all_of(writers.begin(), writers.end(),
                       [](const auto& writer) { return writer->readers() == 1; });
  });
  ::kill(reader, SIGSTOP);
  int status = 0;
  ::waitpid(reader, &status, WUNTRACED);
  for (const auto& writer : writers) writer->write(text_bytes("read by nobody"));
  const auto before = Clock::now();
  writers.clear();
  transport.reset();
  const auto time = Clock::now() - before;
  ::kill(reader, SIGKILL);
  ::waitpid(reader, &status, 0);
  REQUIRE(found);
  return time;
}

}  // namespace

TEST_CASE("a process that is going to stand still", "[.reader]") {
  talk_over_udp_only();
  FastDdsPeer peer(given_domain());
  for (int k = 0; k < many; ++k) {
    peer.make_reader(topic_name(topic_of(k)), dds_type_name<TextMessage>());
  }
  std::this_thread::sleep_for(std::chrono::minutes(2));
}

TEST_CASE("many topics wait no longer than one for a reader that stands still") {
  // Each waits for some 0.3 s: together 0.3 s, and one after another 6 s. 5 leaves room for noise.
  CHECK(time_to_end(many) < 5 * time_to_end(1));
}

TEST_CASE("a client that is going to be killed", "[.victim]") {
  talk_over_udp_only();
  FastDdsPeer peer(given_domain());
  Client<SetHardware> set_hardware(peer, "/controller_manager/set_hardware_component_state");
  Client<SendGoal<Follow>> send_goal(peer, send_goal_name(action));
  Client<GetResult<Follow>> get_result(peer, get_result_name(action));
  Client<Listing> list(peer, "/controller_manager/list_controllers");
  CHECK(set_hardware.call(activation()).ok);
  CHECK(send_goal.call(goal_of(1, 0.3, 1000)).accepted);
  GetResult<Follow>::Request question;
  question.goal_id.uuid[0] = 1;
  get_result.send(question);  // its reply comes when the goal ends
  for (;;) list.send({});     // replies are on their way when the signal comes
}

TEST_CASE("a client that is killed with a goal and requests leaves a bridge that serves others") {
  talk_over_udp_only();
  RunningArm arm;
  const Bridge bridge(arm.loop->port(), {.dds = {.domain = domain()}});
  const pid_t victim = start("[.victim]");
  const bool began =
      eventually([&] { return arm.loop->port().situation().motion == "trajectory"; });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // for requests
  ::kill(victim, SIGKILL);
  int status = 0;
  ::waitpid(victim, &status, 0);
  REQUIRE(began);
  CHECK(WIFSIGNALED(status));

  // Another client sees the goal's motion, replaces it, and gets to the end of its own.
  FastDdsPeer peer(domain());
  Client<SendGoal<Follow>> send_goal(peer, send_goal_name(action));
  Client<GetResult<Follow>> get_result(peer, get_result_name(action));
  CHECK(send_goal.call(goal_of(2, 0.2, 1)).accepted);
  GetResult<Follow>::Request question;
  question.goal_id.uuid[0] = 2;
  const auto result = get_result.call(question);
  CHECK(result.status == action_msgs::msg::GoalStatus::succeeded);
  CHECK(bridge.error().empty());
}

TEST_CASE("two bridges in namespaces of one domain are two robots") {
  talk_over_udp_only();
  RunningArm left_arm, right_arm;
  const Bridge left(left_arm.loop->port(), {.dds = {.domain = domain()}, .name_space = "/left"});
  const Bridge right(right_arm.loop->port(), {.dds = {.domain = domain()}, .name_space = "/right"});
  FastDdsPeer peer(domain());
  Client<SetHardware> set_left(peer, "/left/controller_manager/set_hardware_component_state");
  Client<Switching> switch_left(peer, "/left/controller_manager/switch_controller");
  Client<Listing> list_left(peer, "/left/controller_manager/list_controllers");
  Client<Listing> list_right(peer, "/right/controller_manager/list_controllers");
  const auto states_left =
      peer.make_reader(topic_name("/left/joint_states"), dds_type_name<States>());
  const auto states_right =
      peer.make_reader(topic_name("/right/joint_states"), dds_type_name<States>());
  CHECK(set_left.call(activation()).ok);
  const auto state_of = [](const Listing::Response& list, const std::string& name) {
    for (const auto& controller : list.controller) {
      if (controller.name == name) return controller.state;
    }
    return std::string("absent");
  };
  CHECK(state_of(list_left.call({}), "pid_plus_gravity") == "active");
  CHECK(state_of(list_right.call({}), "pid_plus_gravity") == "inactive");

  // Switches one after another, each with its answer, and goals between them.
  Client<SendGoal<Follow>> send_goal(peer, send_goal_name("/left" + action));
  for (int k = 0; k < 20; ++k) {
    Switching::Request request;
    request.activate_controllers = {k % 2 == 0 ? "computed_torque" : "pid_plus_gravity"};
    request.deactivate_controllers = {k % 2 == 0 ? "pid_plus_gravity" : "computed_torque"};
    request.strictness = 2;
    CHECK(switch_left.call(request).ok);
    const bool accepted =
        send_goal.call(goal_of(static_cast<std::uint8_t>(10 + k), 0.01 * k, 1)).accepted;
    CHECK(accepted == (k % 2 == 1));  // by the controller that is active
  }
  CHECK(right_arm.loop->port().situation().mode == articula::LoopMode::inactive);
  REQUIRE(eventually([&] { return !peer.take(states_left).empty(); }));
  REQUIRE(eventually([&] { return !peer.take(states_right).empty(); }));
  CHECK(left.error().empty());
  CHECK(right.error().empty());
}
