// SPDX-License-Identifier: Apache-2.0
// The gains of a loop are parameters as ros2 param and rqt_reconfigure expect them.
#include "articula/ros2/messages/rcl_interfaces.hpp"
#include "articula/ros2/messages/trajectory_msgs.hpp"
#include "articula/ros2/messages/type_description_interfaces.hpp"

#include "articula/ros2/node/parameter_server.hpp"
#include "bridged_arm.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace articula;
using namespace articula::ros2;
namespace srv = rcl_interfaces::srv;
using support::BridgedArm;
using support::elbow_joint;
using support::shoulder_joint;

namespace {

using Type = rcl_interfaces::msg::ParameterType;
using Parameter = rcl_interfaces::msg::Parameter<Jazzy>;
using Event = rcl_interfaces::msg::ParameterEvent<Jazzy>;
using Names = std::vector<std::string>;
const std::string node = "/pid_plus_gravity/";
const std::string p = "gains.shoulder_active_joint.p";

Parameter number(const std::string& name, double value) {
  return {.name = name, .value = {.type = Type::floating_point, .double_value = value}};
}

double get(BridgedArm& arm, const std::string& name) {
  const auto got = arm.call<srv::GetParameters<Jazzy>>(node + "get_parameters", {.names = {name}});
  REQUIRE(got.values.size() == 1);
  CHECK(got.values[0].type == Type::floating_point);
  return got.values[0].double_value;
}

auto set(BridgedArm& arm, const std::vector<Parameter>& parameters) {
  return arm.call<srv::SetParameters<Jazzy>>(node + "set_parameters", {.parameters = parameters})
      .results;
}

auto set_all(BridgedArm& arm, const std::vector<Parameter>& parameters) {
  return arm
      .call<srv::SetParametersAtomically<Jazzy>>(node + "set_parameters_atomically",
                                                 {.parameters = parameters})
      .result;
}

}  // namespace

TEST_CASE("parameters are listed by prefix and depth") {
  BridgedArm arm;
  const auto list = [&](Names prefixes, std::uint64_t depth) {
    return arm
        .call<srv::ListParameters<Jazzy>>(node + "list_parameters",
                                          {.prefixes = std::move(prefixes), .depth = depth})
        .result;
  };
  const auto all = list({}, 0);
  CHECK(std::find(all.names.begin(), all.names.end(), p) != all.names.end());
  CHECK(std::find(all.names.begin(), all.names.end(), "joints") != all.names.end());
  CHECK(all.prefixes == Names{"gains." + shoulder_joint, "gains." + elbow_joint, "constraints",
                              "constraints." + shoulder_joint, "constraints." + elbow_joint});
  CHECK(all.names.size() == 2 * 14 + 6 + 5);
  CHECK(list({}, 1).names.size() == 5);
  CHECK(list({"gains." + elbow_joint}, 1).names.size() == 14);
  CHECK(list({"gains"}, 1).names.empty());
  CHECK(list({"gains"}, 2).names.size() == 28);
  CHECK(list({"gain"}, 0).names.empty());
}

TEST_CASE("parameters are read and described, and unknown ones are answered as ROS does") {
  BridgedArm arm;
  CHECK(get(arm, p) == 2310);
  const auto got =
      arm.call<srv::GetParameters<Jazzy>>(node + "get_parameters", {.names = {"joints", "ghost"}});
  REQUIRE(got.values.size() == 2);
  CHECK(got.values[0].string_array_value == Names{shoulder_joint, elbow_joint});
  CHECK(got.values[1].type == Type::not_set);
  using Types = srv::GetParameterTypes<Jazzy>;
  CHECK(arm.call<Types>(node + "get_parameter_types", {.names = {p, "use_sim_time"}}).types ==
        std::vector<std::uint8_t>{Type::floating_point, Type::boolean});
  CHECK(arm.call<Types>(node + "get_parameter_types", {.names = {p, "ghost"}}).types.empty());
  using Describe = srv::DescribeParameters<Jazzy>;
  const auto described =
      arm.call<Describe>(node + "describe_parameters",
                         {.names = {p, "gains." + shoulder_joint + ".position_weight", "joints"}});
  REQUIRE(described.descriptors.size() == 3);
  CHECK(described.descriptors[0].description == "Output for an error. [N m/rad]");
  CHECK(described.descriptors[0].additional_constraints == "within 0 .. inf");
  CHECK(described.descriptors[0].floating_point_range.empty());
  REQUIRE(described.descriptors[1].floating_point_range.size() == 1);
  CHECK(described.descriptors[1].floating_point_range[0].to_value == 1);
  CHECK(described.descriptors[2].read_only);
  CHECK(arm.call<Describe>(node + "describe_parameters", {.names = {"ghost"}}).descriptors.empty());
  using Description = type_description_interfaces::srv::GetTypeDescription<Jazzy>;
  CHECK_FALSE(arm.call<Description>(node + "get_type_description").successful);
}

TEST_CASE("a gain is set, and everybody learns of it") {
  BridgedArm arm;
  const auto results = set(arm, {number(p, 2000)});
  REQUIRE(results.size() == 1);
  CHECK(results[0].successful);
  CHECK(get(arm, p) == 2000);
  const auto event = arm.transport.last<Event>("/parameter_events");
  REQUIRE(event);
  CHECK(event->node == "/pid_plus_gravity");
  REQUIRE(event->changed_parameters.size() == 1);
  CHECK(event->changed_parameters[0].name == p);
  CHECK(event->changed_parameters[0].value.double_value == 2000);
  Parameter integer{.name = p, .value = {.type = Type::integer, .integer_value = 1500}};
  CHECK(set(arm, {integer})[0].successful);
  CHECK(get(arm, p) == 1500);
}

TEST_CASE("a gain that another client sets is an event, too") {
  BridgedArm arm;
  arm.ask(remote::SetParameters{{{"computed_torque." + elbow_joint + ".p", 77}}});
  arm.run(300);
  const auto event = arm.transport.last<Event>("/parameter_events");
  REQUIRE(event);
  CHECK(event->node == "/computed_torque");
  CHECK(event->changed_parameters[0].value.double_value == 77);
}

TEST_CASE("parameters are refused one by one, with the reason") {
  BridgedArm arm;
  const auto results =
      set(arm, {number(p, -1),
                number("gains." + elbow_joint + ".p", 300),
                number("ghost", 1),
                {.name = p, .value = {.type = Type::string, .string_value = "soft"}},
                {.name = "use_sim_time", .value = {.type = Type::boolean, .bool_value = true}}});
  REQUIRE(results.size() == 5);
  CHECK_FALSE(results[0].successful);
  CHECK(results[0].reason.find("-1 N m/rad is not within 0 .. inf") != std::string::npos);
  CHECK(results[1].successful);
  CHECK(results[2].reason == "parameter 'ghost' cannot be set because it was not declared");
  CHECK(results[3].reason.find("is of type {double}, setting it to {string}") != std::string::npos);
  CHECK(results[4].reason.find("read-only") != std::string::npos);
  CHECK(get(arm, p) == 2310);
  CHECK(get(arm, "gains." + elbow_joint + ".p") == 300);
  CHECK(set(arm, {}).empty());
}

TEST_CASE("parameters are set atomically") {
  BridgedArm arm;
  const auto refused = set_all(arm, {number("gains." + elbow_joint + ".p", 300), number(p, -1)});
  CHECK_FALSE(refused.successful);
  CHECK(refused.reason.find("-1 N m/rad") != std::string::npos);
  CHECK(get(arm, "gains." + elbow_joint + ".p") == 339);
  CHECK(set_all(arm, {number("gains." + elbow_joint + ".p", 300), number(p, 2000)}).successful);
  CHECK(get(arm, p) == 2000);
  CHECK(set_all(arm, {}).successful);
  CHECK_FALSE(set_all(arm, {number(p, 1), number("ghost", 1)}).successful);
  CHECK(get(arm, p) == 2000);
}

TEST_CASE("of several values for one parameter, the last one holds") {
  BridgedArm arm;
  const double before = get(arm, p);
  CHECK(set(arm, {number(p, 300), number(p, before)}).at(1).successful);
  CHECK(get(arm, p) == before);
  CHECK(set_all(arm, {number(p, 300), number(p, before)}).successful);
  CHECK(get(arm, p) == before);
  CHECK(set_all(arm, {number(p, before), number(p, 300)}).successful);
  CHECK(get(arm, p) == 300);
}

TEST_CASE("a client that watches only sets neither gains nor constraints") {
  BridgedArm arm({.operates = false});
  for (const std::string& name : {p, std::string("constraints.goal_time")}) {
    const double before = get(arm, name);
    CHECK_FALSE(set(arm, {number(name, before + 1)}).at(0).successful);
    CHECK(get(arm, name) == before);
  }
}

TEST_CASE("a dumped file loads again") {
  BridgedArm arm;
  set(arm, {number(p, 2000)});
  const Names names = arm.call<srv::ListParameters<Jazzy>>(node + "list_parameters").result.names;
  const auto values =
      arm.call<srv::GetParameters<Jazzy>>(node + "get_parameters", {.names = names}).values;
  std::vector<Parameter> dumped;
  for (std::size_t i = 0; i < names.size(); ++i) dumped.push_back({names[i], values[i]});
  set(arm, {number(p, 1000)});
  for (const auto& result : set(arm, dumped)) CHECK(result.successful);
  CHECK(get(arm, p) == 2000);
}

namespace {

// Keeps numbers and counts the changes under way. It refuses numbers below 0.
class SlowStore final : public ParameterStore {
 public:
  std::vector<NodeParameter> list() override {
    std::vector<NodeParameter> all;
    for (const auto& [name, value] : numbers) {
      all.push_back({.value = to_value(value)});
      all.back().descriptor.name = name;
      all.back().descriptor.type = all.back().value.type;
    }
    return all;
  }
  void set(const NamedValues& values, OnSet on_set) override {
    REQUIRE(!pending);
    ++calls;
    pending = [this, values, on_set] {
      for (const auto& own : values) {
        if (own.value.double_value < 0) return on_set(own.name + " is below 0");
      }
      for (const auto& own : values) numbers[own.name] = own.value.double_value;
      on_set({});
    };
  }
  void settle() {
    while (pending) std::exchange(pending, nullptr)();
  }

  std::map<std::string, double> numbers{};
  std::function<void()> pending{};
  int calls = 0;
};

}  // namespace

TEST_CASE("hundreds of parameters are set by one request to the loop") {
  support::MemoryTransport transport;
  Context context(transport, Distribution::jazzy);
  const Node own(context, "arm");
  SlowStore store;
  std::vector<Parameter> wanted;
  for (int k = 0; k < 200; ++k) {
    store.numbers["g" + std::to_string(k)] = 0;
    wanted.push_back(number("g" + std::to_string(k), k));
  }
  const ParameterServer server(own, store);
  const auto ask = [&] {
    const auto reply = transport.request(
        "/arm/set_parameters",
        support::bytes_of(srv::SetParameters<Jazzy>::Request{.parameters = wanted}));
    store.settle();
    srv::SetParameters<Jazzy>::Response response;
    REQUIRE(decode(*reply, response) == CdrError::none);
    REQUIRE(response.results.size() == wanted.size());
    return response.results;
  };
  for (const auto& result : ask()) CHECK(result.successful);
  CHECK(store.calls == 1);
  CHECK(store.numbers["g199"] == 199);

  // One that is refused does not keep the others from being set, one after the other.
  for (Parameter& each : wanted) each.value.double_value += 1;
  wanted[7].value.double_value = -1;
  wanted[9].name = "ghost";
  const auto results = ask();
  for (std::size_t k = 0; k < results.size(); ++k) {
    CHECK(results[k].successful == (k != 7 && k != 9));
  }
  CHECK(results[7].reason == "g7 is below 0");
  CHECK(results[9].reason.find("not declared") != std::string::npos);
  CHECK(store.numbers["g199"] == 200);
  CHECK(store.numbers["g7"] == 7);
  CHECK(store.calls == 1 + 1 + 199);
}

TEST_CASE("all nodes have parameters") {
  BridgedArm arm;
  for (const std::string own : {"/controller_manager/", "/joint_state_broadcaster/",
                                "/robot_state_publisher/", "/computed_torque/"}) {
    const auto names = arm.call<srv::ListParameters<Jazzy>>(own + "list_parameters").result.names;
    CHECK(std::find(names.begin(), names.end(), "use_sim_time") != names.end());
  }
  const auto type = arm.call<srv::GetParameters<Jazzy>>("/controller_manager/get_parameters",
                                                        {.names = {"pid_plus_gravity.type"}});
  CHECK(type.values[0].string_value == "joint_trajectory_controller/JointTrajectoryController");
}

TEST_CASE("a text that is a number is taken for one, as `ros2 param load` sends it") {
  BridgedArm arm;
  const std::string clamp = "gains." + shoulder_joint + ".u_clamp_max";
  const auto text = [](const std::string& name, const std::string& value) {
    return Parameter{name, to_value(value)};
  };
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(get(arm, clamp) == infinity);
  CHECK(set(arm, {text(clamp, "inf")})[0].successful);
  CHECK(set(arm, {text(clamp, "20.5")})[0].successful);
  CHECK(get(arm, clamp) == 20.5);
  CHECK(set(arm, {text(clamp, ".inf")})[0].successful);
  CHECK(get(arm, clamp) == infinity);
  CHECK(set(arm, {text(p, "1e-05")})[0].successful);
  CHECK(get(arm, p) == 1e-5);
  for (const char* value : {"", "nan", "20 N", "0x", "-inf"}) {
    CAPTURE(value);
    CHECK_FALSE(set(arm, {text(p, value)})[0].successful);
  }
}

TEST_CASE("constraints are parameters, and hold for trajectories that bring no tolerances") {
  BridgedArm arm;
  arm.ask(remote::Activate{});
  const std::string constraint = "constraints." + shoulder_joint + ".trajectory";
  CHECK(get(arm, constraint) == 0);
  const auto bad = set(arm, {number(constraint, -1)});
  CHECK(bad[0].reason == "parameter '" + constraint + "': -1 is not a finite number >= 0");
  CHECK_FALSE(set_all(arm, {number(constraint, 0.1), number(p, -1)}).successful);
  CHECK(get(arm, constraint) == 0);
  CHECK(set_all(arm, {number(constraint, 1e-7), number(p, 2000)}).successful);
  CHECK(get(arm, constraint) == 1e-7);
  trajectory_msgs::msg::JointTrajectory<Jazzy> trajectory;
  trajectory.joint_names = {shoulder_joint};
  trajectory.points = {{.positions = {1}, .time_from_start = {1, 0}}};
  arm.publish(node + "joint_trajectory", trajectory);
  arm.run(1500);
  CHECK(arm.bridge.dropped().refused == 1);
  CHECK(arm.logged("path tolerance violated"));
}

TEST_CASE("constraints begin as the tolerances of the loop, and 0 is not checked") {
  BridgedArm arm({}, support::plain_arm());
  CHECK(get(arm, "constraints.goal_time") == 3);
  CHECK(get(arm, "constraints.stopped_velocity_tolerance") == 0.2);
  const std::string path = "constraints." + shoulder_joint + ".trajectory";
  CHECK(get(arm, path) == 0.5);
  CHECK(get(arm, "constraints." + elbow_joint + ".goal") == 0.1);
  trajectory_msgs::msg::JointTrajectory<Jazzy> trajectory;
  trajectory.joint_names = {shoulder_joint};
  trajectory.points = {{.positions = {1}, .time_from_start = {1, 0}}};
  remote::SetParameters weak{{{"pid_plus_gravity." + shoulder_joint + ".p", 0},
                              {"pid_plus_gravity." + shoulder_joint + ".i", 0},
                              {"pid_plus_gravity." + shoulder_joint + ".d", 0}}};
  REQUIRE(arm.ask(weak).verdict == remote::Verdict::done);
  arm.publish(node + "joint_trajectory", trajectory);
  arm.run(1500);
  CHECK(arm.bridge.dropped().refused == 1);  // the path's tolerance of the loop
  CHECK(set_all(arm, {number(path, 0), number("constraints." + shoulder_joint + ".goal", 0)})
            .successful);
  trajectory.points = {{.positions = {-1}, .time_from_start = {1, 0}}};
  arm.publish(node + "joint_trajectory", trajectory);
  arm.run(5000);  // longer than goal_time after the end
  CHECK(arm.bridge.dropped().refused == 1);
  CHECK(arm.loop->port().situation().motion == "rest");
}

TEST_CASE("constraints of the options hold for their controller") {
  BridgedArm arm({.controllers = {{"pid_plus_gravity",
                                   {.constraints = TrajectoryConstraints{
                                        .goal_time = 2, .joints = {{0.3, 0.01}, {}}}}}}});
  CHECK(get(arm, "constraints.goal_time") == 2);
  CHECK(get(arm, "constraints." + shoulder_joint + ".trajectory") == 0.3);
  CHECK(get(arm, "constraints." + elbow_joint + ".trajectory") == 0);
  const std::string velocity = "constraints.stopped_velocity_tolerance";
  CHECK(get(arm, velocity) == 0);
  CHECK(set_all(arm, {number(velocity, 0.02)}).successful);
  CHECK(get(arm, velocity) == 0.02);
}

TEST_CASE("a request for more names than a node has room for is answered without them") {
  BridgedArm arm;
  using Get = rcl_interfaces::srv::GetParameters<Jazzy>;
  Get::Request request{.names = std::vector<std::string>(1001, "x")};
  const auto service = "/controller_manager/get_parameters";
  CHECK(arm.call<Get>(service, request).values.empty());
  const auto results = set(arm, std::vector<Parameter>(1001, number(p, 1)));
  REQUIRE(results.size() == 1001);
  CHECK(results[1000].reason == "a request has at most 1000 parameters");
  CHECK_FALSE(set_all(arm, std::vector<Parameter>(1001, number(p, 1))).successful);
  CHECK(get(arm, p) == 2310);
  CHECK(arm.bridge.dropped().refused == 3);
  request.names.pop_back();
  CHECK(arm.call<Get>(service, request).values.size() == 1000);
}

TEST_CASE("the feed-forward of velocity has the name of ROS") {
  BridgedArm arm;
  const std::string name = "gains." + shoulder_joint + ".ff_velocity_scale";
  CHECK(get(arm, name) == 0);
  CHECK(set(arm, {number(name, 1.5)})[0].successful);
  CHECK(get(arm, name) == 1.5);
  const auto other = set(arm, {number("gains." + shoulder_joint + ".velocity_feedforward", 1)});
  CHECK(other[0].reason.find("not declared") != std::string::npos);
}

TEST_CASE("gains have the names of the course if their prefix is empty") {
  BridgedArm arm({.gain_prefix = ""});
  CHECK(get(arm, "shoulder_active_joint.p") == 2310);
  CHECK(set(arm, {number("shoulder_active_joint.p", 2000)})[0].successful);
  CHECK(get(arm, "shoulder_active_joint.p") == 2000);
  CHECK(set(arm, {number(p, 1000)})[0].reason.find("not declared") != std::string::npos);
}
