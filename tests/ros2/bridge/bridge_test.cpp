// SPDX-License-Identifier: Apache-2.0
// Whatever comes from a domain of ROS 2, the bridge answers it or drops it, and keeps its size.
#include "articula/ros2/bridge/bridge.hpp"
#include "articula/ros2/messages/action_msgs.hpp"
#include "articula/ros2/messages/control_msgs.hpp"
#include "articula/ros2/messages/controller_manager_msgs.hpp"
#include "articula/ros2/messages/rcl_interfaces.hpp"
#include "articula/ros2/messages/rosgraph_msgs.hpp"
#include "articula/ros2/messages/sensor_msgs.hpp"
#include "articula/ros2/messages/type_description_interfaces.hpp"
#include "articula/ros2/node/ros_time.hpp"

#include "bridged_arm.hpp"

#include <nlohmann/json.hpp>

#include <malloc.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <thread>
#include <vector>

using namespace articula;
using namespace articula::ros2;
using support::BridgedArm;
using support::Bytes;

namespace {

using Json = nlohmann::json;

Json frames() {
  std::ifstream file(ARTICULA_ROS2_FRAMES "/jazzy.json");
  return Json::parse(file);
}

Bytes from_hex(const std::string& digits) {
  Bytes bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    bytes.push_back(static_cast<std::byte>(std::stoi(digits.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

/// The name of a service or topic of the recorded robot, with this robot's nodes.
std::string own_name(std::string name) {
  for (const std::string node : {"/arm_controller", "/bridge"}) {
    if (name.starts_with(node + "/")) name = "/pid_plus_gravity" + name.substr(node.size());
  }
  return name;
}

/// Whether the bytes are a message of a type.
using Check = std::function<bool(Sample)>;
template <class Service>
Check reply_of() {
  return [](Sample bytes) {
    typename Service::Response response{};
    return decode(bytes, response) == CdrError::none;
  };
}

std::map<std::string, Check> all_replies() {
  namespace c = controller_manager_msgs::srv;
  namespace r = rcl_interfaces::srv;
  using Follow = control_msgs::action::FollowJointTrajectory<Jazzy>;
  using J = Jazzy;
  return {{"send_goal", reply_of<SendGoal<Follow>>()},
          {"get_result", reply_of<GetResult<Follow>>()},
          {"cancel_goal", reply_of<action_msgs::srv::CancelGoal<J>>()},
          {"query_state", reply_of<control_msgs::srv::QueryTrajectoryState<J>>()},
          {"cleanup_controller", reply_of<c::CleanupController<J>>()},
          {"configure_controller", reply_of<c::ConfigureController<J>>()},
          {"load_controller", reply_of<c::LoadController<J>>()},
          {"unload_controller", reply_of<c::UnloadController<J>>()},
          {"list_controllers", reply_of<c::ListControllers<J>>()},
          {"list_controller_types", reply_of<c::ListControllerTypes<J>>()},
          {"list_hardware_components", reply_of<c::ListHardwareComponents<J>>()},
          {"list_hardware_interfaces", reply_of<c::ListHardwareInterfaces<J>>()},
          {"reload_controller_libraries", reply_of<c::ReloadControllerLibraries<J>>()},
          {"set_hardware_component_state", reply_of<c::SetHardwareComponentState<J>>()},
          {"switch_controller", reply_of<c::SwitchController<J>>()},
          {"describe_parameters", reply_of<r::DescribeParameters<J>>()},
          {"get_parameter_types", reply_of<r::GetParameterTypes<J>>()},
          {"get_parameters", reply_of<r::GetParameters<J>>()},
          {"list_parameters", reply_of<r::ListParameters<J>>()},
          {"set_parameters", reply_of<r::SetParameters<J>>()},
          {"set_parameters_atomically", reply_of<r::SetParametersAtomically<J>>()},
          {"get_type_description",
           reply_of<type_description_interfaces::srv::GetTypeDescription<J>>()}};
}

}  // namespace

TEST_CASE("the requests of ROS 2's tools, as they were recorded, have replies of their types") {
  BridgedArm arm;
  arm.ask(remote::Activate{});
  const auto replies = all_replies();
  std::map<std::string, int> answered;
  std::map<std::string, Bytes> recorded, own;  // by the names of the frames
  for (const Json& frame : frames()) {
    const auto topic = frame.at("topic").get<std::string>();
    recorded[frame.at("name").get<std::string>()] = from_hex(frame.at("cdr"));
    if (!topic.starts_with("rq/") || !topic.ends_with("Request")) continue;
    const std::string service = own_name(topic.substr(2, topic.size() - 2 - 7));
    const std::string name = service.substr(service.rfind('/') + 1);
    CAPTURE(frame.at("name").get<std::string>(), service);
    REQUIRE(replies.contains(name));
    const auto reply = arm.transport.request(service, from_hex(frame.at("cdr")));
    for (int k = 0; k < 50 && reply->empty(); ++k) arm.run(1);
    CHECK_FALSE(reply->empty());
    CHECK(replies.at(name)(*reply));
    own[frame.at("name").get<std::string>()] = *reply;
    ++answered[name];
  }
  // What the recorded robot answered, where this one must answer the same: to requests that do not
  // depend on it, and to those for controllers, goals and parameters that it does not have.
  for (const auto& [request, reply] : std::map<std::string, std::string>{
           {"cm_reload_no.reload_controller_libraries", "cm_reload_no.reload_controller_libraries"},
           {"cm_unload.unload_controller", "cm_unload_active.unload_controller"},
           {"cm_cleanup.cleanup_controller", "cm_cleanup_refused.cleanup_controller"},
           {"par_desc_none.describe_parameters", "par_desc_none.describe_parameters"},
           {"par_types.get_parameter_types", "par_types.get_parameter_types"},
           {"par_typedesc.get_type_description", "par_typedesc.get_type_description"}}) {
    CAPTURE(request);
    CHECK(own.at(request + ".request") == recorded.at(reply + ".reply"));
  }
  const auto decoded = [&]<class Service>(TypeOf<Service>, const std::string& request) {
    typename Service::Response response{};
    CHECK(decode(own.at(request + ".request"), response) == CdrError::none);
    return response;
  };
  using Follow = control_msgs::action::FollowJointTrajectory<Jazzy>;
  CHECK_FALSE(decoded(TypeOf<SendGoal<Follow>>(), "act_abort.send_goal").accepted);
  CHECK(decoded(TypeOf<GetResult<Follow>>(), "act_abort.get_result").status == 0);
  const auto cancel = TypeOf<action_msgs::srv::CancelGoal<Jazzy>>();
  CHECK(decoded(cancel, "act_cancel.cancel_goal").return_code ==
        2);  // unknown, as act_cancel_unknown
  const auto query = TypeOf<control_msgs::srv::QueryTrajectoryState<Jazzy>>();
  CHECK_FALSE(decoded(query, "act_query_fail.query_state").success);
  CHECK(decoded(query, "act_query_fail.query_state").name.empty());
  const auto switched = decoded(TypeOf<controller_manager_msgs::srv::SwitchController<Jazzy>>(),
                                "cm_switch_unknown.switch_controller");
  CHECK_FALSE(switched.ok);
  CHECK(
      switched.message ==
      "controller 'arm_controller': unknown name; controllers: pid_plus_gravity, computed_torque");
  CHECK(answered.size() == replies.size());
  CHECK(arm.bridge.dropped().malformed == 0);
}

TEST_CASE("the topics and services have the types and hashes that ROS 2's tools look for") {
  BridgedArm arm;
  std::map<std::string, int> compared;
  for (const Json& frame : frames()) {
    const auto topic = frame.at("topic").get<std::string>();
    if (!topic.starts_with("rt/")) continue;
    const auto found = arm.transport.topics.find(own_name(topic.substr(2)));
    if (found == arm.transport.topics.end()) continue;
    CAPTURE(topic);
    CHECK(found->second.endpoint.hash == frame.at("type_hash").get<std::string>());
    ++compared[topic];
  }
  CHECK(compared.size() >= 9);
}

TEST_CASE("messages of ROS 2's tools, as they were recorded, are taken or refused with a reason") {
  BridgedArm arm;
  arm.ask(remote::Activate{});
  int taken = 0;
  for (const Json& frame : frames()) {
    const auto topic = own_name(frame.at("topic").get<std::string>().substr(2));
    const auto found = arm.transport.topics.find(topic);
    if (found == arm.transport.topics.end() || found->second.readers.empty()) continue;
    arm.transport.publish(topic, from_hex(frame.at("cdr")));
    ++taken;
  }
  arm.run(10);
  CHECK(taken >= 2);
  CHECK(arm.bridge.dropped().malformed == 0);
  CHECK(arm.bridge.dropped().refused >= 1);  // the recorded robot has other joints
}

TEST_CASE("random bytes reach neither the loop nor the memory") {
  BridgedArm arm;
  arm.ask(remote::Activate{});
  std::mt19937 random(5);
  const auto number = [&](std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
  };
  std::vector<std::string> topics, services;
  std::map<std::string, Bytes> recorded;
  for (const auto& [name, topic] : arm.transport.topics) {
    if (!topic.readers.empty()) topics.push_back(name);
  }
  for (const auto& own : arm.transport.services) services.push_back(own.first);
  for (const Json& frame : frames()) {
    auto name = frame.at("topic").get<std::string>().substr(2);
    if (name.ends_with("Request")) name.resize(name.size() - 7);
    recorded[own_name(name)] = from_hex(frame.at("cdr"));
  }
  // Recorded messages with some bytes changed, or bytes at random.
  const auto bytes_for = [&](const std::string& name) {
    Bytes bytes = recorded[name];
    if (bytes.empty() || number(4) == 0) {
      bytes = Bytes(number(200));
      for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
      if (bytes.size() > 2) bytes[0] = std::byte{0}, bytes[1] = std::byte{1};
    } else {
      for (std::size_t k = number(4); k > 0; --k) {
        bytes[4 + number(bytes.size() - 4)] = static_cast<std::byte>(random());
      }
      if (number(4) == 0) bytes.resize(number(bytes.size()));
    }
    return bytes;
  };
  const auto some = [&](int count) {
    for (int k = 0; k < count; ++k) {
      if (k % 4 == 0) {
        const std::string& name = topics[number(topics.size())];
        arm.transport.publish(name, bytes_for(name));
      } else {
        const std::string& name = services[number(services.size())];
        arm.transport.request(name, bytes_for(name));
      }
      if (k % 16 == 0) arm.run(1);
    }
    arm.run(50);
  };
  for (int k = 0; k < 5000; ++k) {  // The port keeps the last cycles and switches.
    const std::string service = "/controller_manager/switch_controller";
    arm.transport.request(service, recorded.at(service));
    arm.run(1);
  }
  some(20'000);
  const auto before = mallinfo2().uordblks;
  some(80'000);
  const auto after = mallinfo2().uordblks;
  CHECK(after <= before + 100'000);
  CHECK(arm.bridge.dropped().malformed > 10'000);
  const auto states = arm.transport.last<sensor_msgs::msg::JointState<Jazzy>>("/joint_states");
  REQUIRE(states);
  for (const double position : states->position) CHECK(std::abs(position) < 1.6);
  CHECK(arm.loop->port().situation().mode != LoopMode::fault);
}

TEST_CASE("with the loop's time, stamps and the clock agree") {
  BridgedArm arm({.use_sim_time = true});
  arm.run(995);
  const auto clock = arm.transport.last<rosgraph_msgs::msg::Clock>("/clock");
  const auto states = arm.transport.last<sensor_msgs::msg::JointState<Jazzy>>("/joint_states");
  REQUIRE((clock && states));
  CHECK(clock->clock.sec == 0);
  CHECK(clock->clock.nanosec > 900'000'000);
  CHECK(states->header.stamp.nanosec == clock->clock.nanosec);
  BridgedArm other;
  CHECK_FALSE(other.transport.topics.contains("/clock"));
}

TEST_CASE("with another simulator's time, stamps follow its clock") {
  BridgedArm arm({.use_sim_time = true, .clock_topic = "/clock"});
  const auto stamp = [&] {
    const auto states = arm.transport.last<sensor_msgs::msg::JointState<Jazzy>>("/joint_states");
    REQUIRE(states);
    return from_message(states->header.stamp);
  };
  std::chrono::milliseconds told{0};
  const auto pass = [&](int milliseconds) {
    for (int k = 0; k < milliseconds; ++k) {
      told += std::chrono::milliseconds(1);
      arm.publish("/clock",
                  rosgraph_msgs::msg::Clock{to_message<builtin_interfaces::msg::Time>(told)});
      arm.run(1);
    }
  };
  told = std::chrono::seconds(100);
  pass(50);
  CHECK(told - stamp() < std::chrono::milliseconds(15));
  const auto count = arm.transport.topics["/joint_states"].count;
  arm.run(50);  // the other simulator is paused
  CHECK(arm.transport.topics["/joint_states"].count == count);
  told = std::chrono::seconds(0);  // it was reset
  pass(50);
  CHECK(told - stamp() < std::chrono::milliseconds(15));
  CHECK(arm.transport.topics["/clock"].count == 0);  // the bridge sends none of its own
  CHECK_THROWS_WITH(BridgedArm({.clock_topic = "/clock"}),
                    "ros2: clock_topic '/clock' needs use_sim_time");
}

TEST_CASE("two bridges share a transport by their namespaces, and one may end before it") {
  BridgedArm arm({.name_space = "/left"});
  const auto loop = support::switched_arm();
  auto right = std::make_unique<BridgeNodes>(loop->port(), arm.transport,
                                             BridgeOptions{.name_space = "/right"});
  CHECK(arm.transport.services.contains("/left/pid_plus_gravity/set_parameters"));
  CHECK(arm.transport.services.contains("/right/pid_plus_gravity/set_parameters"));
  right.reset();
  const Bytes nothing = support::bytes_of(std_msgs::msg::Float64MultiArray<Jazzy>{});
  arm.transport.publish("/right/pid_plus_gravity/commands", nothing);
  CHECK(arm.transport.request("/right/controller_manager/list_controllers", nothing)->empty());
}

TEST_CASE("a bridge in a thread of its own serves a running loop") {
  struct Counting final : Transport {
    explicit Counting(std::atomic<int>& count) : count_(count) {}
    struct Writer final : SampleWriter {
      explicit Writer(std::atomic<int>& count) : count_(count) {}
      void write(Sample) override { ++count_; }
      [[nodiscard]] std::size_t readers() const override { return 1; }
      std::atomic<int>& count_;
    };
    std::unique_ptr<SampleWriter> advertise(const TopicEndpoint&) override {
      return std::make_unique<Writer>(count_);
    }
    void subscribe(const TopicEndpoint&, OnSample) override {}
    void serve(const ServiceEndpoint&, OnRequest) override {}
    void poll(std::chrono::microseconds longest) override {
      if (count_ > 200) throw std::runtime_error("the network is gone");
      std::this_thread::sleep_for(longest);
    }
    std::atomic<int>& count_;
  };
  std::atomic<int> count = 0;
  const auto loop = support::switched_arm();
  Bridge bridge(loop->port(), std::make_unique<Counting>(count), {});
  for (int k = 0; k < 20'000 && bridge.error().empty(); ++k) {
    loop->cycles(1);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  CHECK(count > 200);
  CHECK(bridge.error() == "the network is gone");
  CHECK(bridge.dropped().malformed == 0);
  CHECK_THROWS_WITH(Bridge(loop->port(), nullptr, {}), "ros2: there is no transport");
}
