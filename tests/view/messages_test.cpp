// SPDX-License-Identifier: Apache-2.0
#include "articula/view/protocol/messages/messages.hpp"

#include "articula/ros2/cdr_decoder.hpp"
#include "articula/ros2/messages/sensor_msgs.hpp"
#include "articula/view/protocol/messages/channels.hpp"
#include "articula/view/protocol/requests/requests.hpp"
#include "catch.hpp"
#include "fake_port.hpp"

#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <vector>

using namespace articula::view;
namespace remote = articula::remote;
namespace ros2 = articula::ros2;

namespace {

remote::Cycle cycle(std::uint64_t number) {
  const double k = static_cast<double>(number);
  return {.number = number,
          .time = 1e-3 * k,
          .status = articula::Status::stale_state,
          .position = {0.1 * k, 1 / 3.0},
          .velocity = {k, -k},
          .effort = {5, 6},
          .reference_position = {7, 8},
          .reference_velocity = {9, 10},
          .reference_acceleration = {11, 12},
          .reference_effort = {13, 14},
          .command = {{15, 16}},
          .latency = 1e-6,
          .period = 1.5e-3,
          .update = 2e-6,
          .input = {.read = articula::Status::stale_state,
                    .request = articula::LoopRequest::deactivation,
                    .posted = number % 2 == 1,
                    .missed = number}};
}

/// The members of a message are those of its topic's schema.
void check_members(Topic topic, const Json& message) {
  std::set<std::string> members, described;
  for (const auto& item : message.items()) members.insert(item.key());
  const Json schema = Json::parse(channel_of(topic).schema);
  for (const auto& item : schema["properties"].items()) described.insert(item.key());
  CHECK(members == described);
}

}  // namespace

TEST_CASE("cycles are columns, and every number comes back with all its bits") {
  support::FakePort port;
  const std::vector<remote::Cycle> cycles{cycle(3), cycle(4), cycle(5)};
  const Json json = Json::parse(cycles_message(port.robot(), cycles, 17));
  check_members(Topic::cycles, json);
  CHECK(json["dropped"] == 17);
  CHECK(json["number"] == Json{3, 4, 5});
  CHECK(json["status"] == Json{5, 5, 5});
  CHECK(json["period"] == Json{1.5e-3, 1.5e-3, 1.5e-3});
  CHECK(json["input"]["read"] == Json{5, 5, 5});
  CHECK(json["input"]["request"] == Json{2, 2, 2});
  CHECK(json["input"]["posted"] == Json{1, 0, 1});
  CHECK(json["input"]["missed"] == Json{3, 4, 5});
  for (std::size_t k = 0; k < cycles.size(); ++k) {
    CHECK(json["time"][k].get<double>() == cycles[k].time);
    for (std::size_t j = 0; j < 2; ++j) {
      CHECK(json["position"][j][k].get<double>() == cycles[k].position[j]);
      CHECK(json["velocity"][j][k].get<double>() == cycles[k].velocity[j]);
      CHECK(json["reference_effort"][j][k].get<double>() == cycles[k].reference_effort[j]);
      CHECK(json["command"]["effort"][j][k].get<double>() == cycles[k].command[0][j]);
    }
  }
}

TEST_CASE("changes of the controller have the number of their cycle, and -0 keeps its sign") {
  support::FakePort port;
  std::vector<remote::Cycle> cycles{cycle(3), cycle(4)};
  cycles[1].changes = {{.cycle = 4, .gains = {{"pid.elbow.p", 5}}},
                       {.cycle = 4, .request = {.stop = {"pid"}, .start = {"bypass"}}}};
  cycles[0].command[0][1] = -0.0;
  const Json json = Json::parse(cycles_message(port.robot(), cycles, 0));
  REQUIRE(json["changes"].size() == 2);
  CHECK(json["changes"][0] == Json{{"cycle", 4}, {"change", {{"gains", {{"pid.elbow.p", 5}}}}}});
  CHECK(json["changes"][1]["change"]["start"] == Json{"bypass"});
  CHECK(std::signbit(json["command"]["effort"][1][0].get<double>()));
}

TEST_CASE("a number that is not finite, or missing, is null") {
  support::FakePort port;
  remote::Cycle bad = cycle(1);
  bad.position[0] = std::numeric_limits<double>::quiet_NaN();
  bad.velocity[1] = std::numeric_limits<double>::infinity();
  bad.effort.clear();
  bad.command.clear();
  const Json json = Json::parse(cycles_message(port.robot(), std::vector{bad}, 0));
  CHECK(json["position"][0][0].is_null());
  CHECK(json["velocity"][1][0].is_null());
  CHECK(json["effort"][1][0].is_null());
  CHECK(json["command"]["effort"][0][0].is_null());
  CHECK_NOTHROW(Json::parse(joint_states_message(port.robot(), bad, 0)));
}

TEST_CASE("joint states have the mimic joints, too") {
  support::FakePort port;
  const Json json = Json::parse(joint_states_message(port.robot(), cycle(2), 1'500'000'000));
  check_members(Topic::joint_states, json);
  CHECK(json["header"]["stamp"] == Json{{"sec", 1}, {"nsec", 500'000'000}});
  CHECK(json["name"] == Json{"shoulder", "elbow", "finger"});
  CHECK(json["position"][2].get<double>() == Approx(-2 / 3.0 + 0.5));
  CHECK(json["velocity"][2].get<double>() == 4);
  CHECK(json["effort"] == Json{5.0, 6.0, 0.0});
}

TEST_CASE("a cycle as messages of ROS 2 has the numbers of its JSON") {
  support::FakePort port;
  const remote::Cycle own = cycle(2);
  const auto decoded = [](const std::string& bytes) {
    ros2::sensor_msgs::msg::JointState<ros2::Jazzy> message;
    REQUIRE(ros2::decode(std::as_bytes(std::span(bytes)), message) == ros2::CdrError::none);
    CHECK(message.header.stamp.sec == 1);
    CHECK(message.header.stamp.nanosec == 500'000'000);
    return message;
  };
  const Json json = Json::parse(joint_states_message(port.robot(), own, 1'500'000'000));
  const auto states = decoded(ros_states_message(port.robot(), own, 1'500'000'000));
  CHECK(Json(states.name) == json["name"]);
  CHECK(Json(states.position) == json["position"]);
  CHECK(Json(states.velocity) == json["velocity"]);
  CHECK(Json(states.effort) == json["effort"]);
  const auto reference = decoded(ros_reference_message(port.robot(), own, 1'500'000'000));
  CHECK(reference.name == std::vector<std::string>{"shoulder", "elbow"});
  CHECK(reference.position == own.reference_position);
  CHECK(reference.velocity == own.reference_velocity);
  CHECK(reference.effort == own.reference_effort);
  const auto command = decoded(ros_command_message(port.robot(), own, 1'500'000'000));
  CHECK(command.position.empty());
  CHECK(command.effort == own.command[0]);

  remote::Cycle bad = own;
  bad.effort.clear();
  bad.command.clear();
  CHECK(std::isnan(decoded(ros_states_message(port.robot(), bad, 1'500'000'000)).effort[0]));
  CHECK(decoded(ros_command_message(port.robot(), bad, 1'500'000'000)).effort.empty());
}

TEST_CASE("transforms place every link but the root in the root") {
  support::FakePort port;
  const Json json =
      Json::parse(transforms_message(port.link_poses({0.5, 0}), port.robot().links.front(), 0));
  check_members(Topic::transforms, json);
  REQUIRE(json["transforms"].size() == 2);
  const Json& arm = json["transforms"][0];
  CHECK(arm["parent_frame_id"] == "base");
  CHECK(arm["child_frame_id"] == "upper_arm");
  CHECK(arm["translation"] == Json{{"x", 0.0}, {"y", 0.0}, {"z", 1.0}});
  CHECK(arm["rotation"]["z"].get<double>() == std::sin(0.25));
}

TEST_CASE("what changes seldom has the members of its schema") {
  support::FakePort port;
  check_members(Topic::situation, situation_json(port.situation(), true, false));
  check_members(Topic::statistics, statistics_json(port.statistics()));
  const Json entry = log_json({1.5, remote::Event::Level::warning, "text"}, 0);
  check_members(Topic::log, entry);
  CHECK(entry["level"] == 3);
  const Json situation = situation_json(port.situation(), true, false);
  CHECK(situation["mode"] == "active");
  CHECK(situation["fault"] == "ok");
  CHECK(situation["controllers"][1] == Json{{"name", "bypass"}, {"status", "inactive"}});
}

TEST_CASE("a robot has its limits, null where there are none") {
  support::FakePort port;
  const Json json = robot_json(port.robot());
  CHECK(json["joints"][0]["limits"]["lower"] == -1.5);
  CHECK(json["joints"][0]["limits"]["effort"].is_null());
  CHECK(json["joints"][0]["position_unit"] == "rad");
  CHECK(json["mimics"][0] ==
        Json{{"name", "finger"}, {"joint", 1}, {"multiplier", -2.0}, {"offset", 0.5}});
  const Json parameters = parameters_json(port.parameters());
  CHECK(parameters["parameters"][0]["highest"] == 100.0);
}

TEST_CASE("the schemas of services, and of topics in JSON, are JSON schemas") {
  for (std::size_t i = 0; i < topic_count; ++i) {
    const Json entry = advertisement_of(static_cast<Topic>(i));
    if (entry["encoding"] == "cdr") continue;
    CHECK(entry["encoding"] == "json");
    CHECK(entry["schemaEncoding"] == "jsonschema");
    CHECK(Json::parse(entry["schema"].get<std::string>())["type"] == "object");
  }
  for (const Service& service : services()) {
    INFO(service.name);
    const Json schema = schema_of(service.members);
    CHECK(schema["type"] == "object");
    CHECK((service.members.empty() || schema["properties"].size() == service.members.size()));
  }
}
