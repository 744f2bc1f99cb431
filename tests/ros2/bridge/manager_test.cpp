// SPDX-License-Identifier: Apache-2.0
// ROS 2's tools see a loop's controllers, joints and frames, and switch controllers and hardware.
#include "articula/ros2/dds/domain_id.hpp"
#include "articula/ros2/messages/controller_manager_msgs.hpp"
#include "articula/ros2/messages/rcl_interfaces.hpp"
#include "articula/ros2/messages/sensor_msgs.hpp"
#include "articula/ros2/messages/tf2_msgs.hpp"

#include "bridged_arm.hpp"

#include <algorithm>
#include <string>

using namespace articula;
using namespace articula::ros2;
namespace srv = controller_manager_msgs::srv;
namespace msg = controller_manager_msgs::msg;
using support::BridgedArm;
using support::elbow_joint;
using support::shoulder_joint;

namespace {

using Switching = srv::SwitchController<Jazzy>;
using SetHardware = srv::SetHardwareComponentState<Jazzy>;
const std::string manager = "/controller_manager/";

template <class Layout = Jazzy>
msg::ControllerState<Layout> controller(BridgedArm& arm, const std::string& name) {
  const auto list = arm.call<srv::ListControllers<Layout>>(manager + "list_controllers");
  for (const auto& own : list.controller) {
    if (own.name == name) return own;
  }
  FAIL("no such controller: " << name);
  return {};
}

SetHardware::Response set_hardware(BridgedArm& arm, const std::string& label) {
  SetHardware::Request request;
  request.name = "q2d";
  request.target_state.label = label;
  return arm.call<SetHardware>(manager + "set_hardware_component_state", request);
}

Switching::Response switch_to(BridgedArm& arm, std::vector<std::string> start,
                              std::vector<std::string> stop, int strictness = 2) {
  Switching::Request request;
  request.activate_controllers = std::move(start);
  request.deactivate_controllers = std::move(stop);
  request.strictness = strictness;
  return arm.call<Switching>(manager + "switch_controller", request);
}

}  // namespace

TEST_CASE("the hardware is activated and deactivated by its name") {
  BridgedArm arm;
  CHECK(controller(arm, "pid_plus_gravity").state == "inactive");
  const auto active = set_hardware(arm, "active");
  CHECK(active.ok);
  CHECK(active.state.label == "active");
  CHECK(active.state.id == 3);
  CHECK(controller(arm, "pid_plus_gravity").state == "active");
  CHECK(set_hardware(arm, "active").ok);
  CHECK_FALSE(set_hardware(arm, "finalized").ok);
  const auto inactive = set_hardware(arm, "inactive");
  CHECK(inactive.ok);
  CHECK(inactive.state.id == 2);
  SetHardware::Request other;
  other.name = "arm";
  other.target_state.label = "active";
  const auto unknown = arm.call<SetHardware>(manager + "set_hardware_component_state", other);
  CHECK_FALSE(unknown.ok);
  CHECK(unknown.state.id == 0);
}

TEST_CASE("a controller of a group is found under the name that is listed") {
  BridgedArm arm({.name_space = "/cell"}, support::grouped_arm());
  const std::string name = "upper/pid_plus_gravity",
                    path = "/cell/controller_manager/list_controllers";
  const auto all = arm.call<srv::ListControllers<Jazzy>>(path).controller;
  const auto own = std::ranges::find(all, name, [](const auto& each) { return each.name; });
  REQUIRE(own != all.end());
  CHECK(own->required_state_interfaces == std::vector<std::string>{shoulder_joint + "/position",
                                                                   shoulder_joint + "/velocity",
                                                                   shoulder_joint + "/effort"});
  const auto& topics = arm.transport.topics;
  CHECK(topics.contains("/cell/" + name + "/controller_state"));
  CHECK(topics.contains("/cell/" + name + "/follow_joint_trajectory/_action/feedback"));
  arm.publish("/cell/" + name + "/commands", std_msgs::msg::Float64MultiArray<Jazzy>{});
  const auto line = arm.transport.last<rcl_interfaces::msg::Log<Jazzy>>("/rosout");
  REQUIRE(line);
  CHECK(line->name == "cell.upper.pid_plus_gravity");
}

TEST_CASE("a loop with one controller is already as a spawner wants it") {
  BridgedArm arm({}, support::plain_arm());
  const std::vector<std::string> own{"pid_plus_gravity"};
  constexpr int best_effort = 1, strict = 2;
  const auto begun = switch_to(arm, own, {}, best_effort);
  CHECK(begun.ok);
  CHECK(begun.message.find("nothing to switch") != std::string::npos);
  CHECK_FALSE(switch_to(arm, own, {}, strict).ok);
  CHECK_FALSE(switch_to(arm, {}, own, best_effort).ok);
  CHECK_FALSE(switch_to(arm, {"pid"}, {}, best_effort).ok);
}

TEST_CASE("controllers are listed with what they claim") {
  BridgedArm arm;
  set_hardware(arm, "active");
  const auto own = controller(arm, "pid_plus_gravity");
  CHECK(own.type == "joint_trajectory_controller/JointTrajectoryController");
  CHECK(own.claimed_interfaces ==
        std::vector<std::string>{shoulder_joint + "/effort", elbow_joint + "/effort"});
  CHECK(own.required_state_interfaces.size() == 6);
  CHECK(own.update_rate == 1000);
  CHECK(controller(arm, "computed_torque").claimed_interfaces.empty());
  CHECK(controller(arm, "computed_torque").required_command_interfaces.size() == 2);
  CHECK(controller(arm, "joint_state_broadcaster").state == "active");
  const auto types = arm.call<srv::ListControllerTypes<Jazzy>>(manager + "list_controller_types");
  CHECK(types.types.size() == 2);
  CHECK(types.base_classes.size() == 2);
}

TEST_CASE("the hardware is listed with its interfaces") {
  BridgedArm arm;
  set_hardware(arm, "active");
  const auto list =
      arm.call<srv::ListHardwareComponents<Jazzy>>(manager + "list_hardware_components");
  REQUIRE(list.component.size() == 1);
  const auto& own = list.component[0];
  CHECK(own.name == "q2d");
  CHECK(own.type == "system");
  CHECK(own.rw_rate == 1000);
  CHECK(own.state.label == "active");
  REQUIRE(own.command_interfaces.size() == 2);
  CHECK(own.command_interfaces[0].is_claimed);
  CHECK(own.state_interfaces.size() == 6);
  const auto all =
      arm.call<srv::ListHardwareInterfaces<Jazzy>>(manager + "list_hardware_interfaces");
  CHECK(all.command_interfaces[1].name == elbow_joint + "/effort");
  CHECK(all.command_interfaces[1].data_type == "double");
  CHECK(all.state_interfaces[0].name == shoulder_joint + "/position");
}

TEST_CASE("controllers are switched, and refusals say why") {
  BridgedArm arm;
  const auto early = switch_to(arm, {"computed_torque"}, {"pid_plus_gravity"});
  CHECK_FALSE(early.ok);
  CHECK(early.message ==
        "the hardware is not active: ros2 control set_hardware_component_state q2d active");
  set_hardware(arm, "active");
  const auto done = switch_to(arm, {"computed_torque"}, {"pid_plus_gravity"});
  CHECK(done.ok);
  CHECK(controller(arm, "computed_torque").state == "active");
  CHECK(controller(arm, "pid_plus_gravity").state == "inactive");

  const auto occupied = switch_to(arm, {"pid_plus_gravity"}, {});
  CHECK_FALSE(occupied.ok);
  CHECK(occupied.message.find("another controller of these joints") != std::string::npos);
  CHECK(switch_to(arm, {"pid_plus_gravity"}, {}, 4).ok);  // by force
  CHECK(controller(arm, "computed_torque").state == "inactive");

  // A name that comes twice is one controller.
  const std::vector<std::string> twice(2, "computed_torque"), back(2, "pid_plus_gravity");
  CHECK(switch_to(arm, twice, back).ok);
  CHECK(switch_to(arm, back, twice).ok);

  const auto unknown = switch_to(arm, {"ghost"}, {});
  CHECK_FALSE(unknown.ok);
  CHECK(unknown.message ==
        "controller 'ghost': unknown name; controllers: pid_plus_gravity, computed_torque");
  CHECK(switch_to(arm, {"ghost", "computed_torque"}, {"pid_plus_gravity"}, 1).ok);
  CHECK(controller(arm, "computed_torque").state == "active");
  CHECK_FALSE(switch_to(arm, {}, {}, -2).ok);
  CHECK(switch_to(arm, {}, {}).ok);
}

TEST_CASE("the broadcaster of joint states is switched as a controller") {
  BridgedArm arm;
  const std::string name = "joint_state_broadcaster";
  CHECK_FALSE(switch_to(arm, {name}, {}).ok);
  CHECK(switch_to(arm, {}, {name}).ok);
  CHECK(controller(arm, name).state == "inactive");
  const auto count = arm.transport.topics["/joint_states"].count;
  arm.run(50);
  CHECK(arm.transport.topics["/joint_states"].count == count);
  CHECK_FALSE(switch_to(arm, {}, {name}).ok);
  CHECK(switch_to(arm, {name}, {}).ok);
  arm.run(50);
  CHECK(arm.transport.topics["/joint_states"].count >= count + 5);
}

TEST_CASE("a warning of the transport is in the log") {
  BridgedArm arm;
  arm.transport.own_warnings = {"a publisher is not heard"};
  arm.run(2);
  CHECK(arm.transport.last<rcl_interfaces::msg::Log<Jazzy>>("/rosout")->msg ==
        "a publisher is not heard");
  CHECK(arm.transport.topics["/rosout"].count == 1);
}

TEST_CASE("what has no meaning for compiled controllers is answered so") {
  BridgedArm arm;
  const auto ok = [&]<class Service>(const char* service, TypeOf<Service>, const char* name) {
    typename Service::Request request;
    request.name = name;
    return arm.call<Service>(manager + service, request).ok;
  };
  const auto load = TypeOf<srv::LoadController<Jazzy>>();
  const auto configure = TypeOf<srv::ConfigureController<Jazzy>>();
  CHECK(ok("load_controller", load, "computed_torque"));
  CHECK_FALSE(ok("load_controller", load, "ghost"));
  const auto line = arm.transport.last<rcl_interfaces::msg::Log<Jazzy>>("/rosout");
  REQUIRE(line);
  CHECK(line->level == 30);
  CHECK(line->msg ==
        "load_controller: there is no controller 'ghost'; the loop has joint_state_broadcaster, "
        "pid_plus_gravity, computed_torque");
  CHECK(ok("configure_controller", configure, "computed_torque"));
  CHECK_FALSE(ok("configure_controller", configure, ""));
  CHECK_FALSE(ok("unload_controller", TypeOf<srv::UnloadController<Jazzy>>(), "computed_torque"));
  CHECK_FALSE(ok("cleanup_controller", TypeOf<srv::CleanupController<Jazzy>>(), "computed_torque"));
  CHECK_FALSE(arm.call<srv::ReloadControllerLibraries<Jazzy>>(
                     manager + "reload_controller_libraries", {.force_kill = true})
                  .ok);
}

TEST_CASE("joint states, frames and the description come as RViz and MoveIt read them") {
  BridgedArm arm;
  set_hardware(arm, "active");
  arm.run(1000);
  const auto states = arm.transport.last<sensor_msgs::msg::JointState<Jazzy>>("/joint_states");
  REQUIRE(states);
  CHECK(states->name == std::vector<std::string>{shoulder_joint, elbow_joint});
  CHECK(states->position.size() == 2);
  CHECK(states->effort.size() == 2);
  const auto stamp = std::chrono::seconds(states->header.stamp.sec);
  CHECK((arm.now - stamp < std::chrono::seconds(1) && arm.now >= stamp));
  const auto count = arm.transport.topics["/joint_states"].count;
  CHECK((count >= 95 && count <= 105));  // 100 Hz
  CHECK(arm.transport.topics["/robot_description"].endpoint.quality.transient_local);
  const auto moving = arm.transport.last<tf2_msgs::msg::TFMessage<Jazzy>>("/tf");
  const auto fixed = arm.transport.last<tf2_msgs::msg::TFMessage<Jazzy>>("/tf_static");
  REQUIRE((moving && fixed));
  CHECK(moving->transforms.size() == 2);
  CHECK(moving->transforms.size() + fixed->transforms.size() + 1 ==
        arm.loop->port().robot().links.size());
  for (const auto& transform : moving->transforms) {
    CHECK_FALSE(transform.header.frame_id.empty());
    CHECK(transform.header.frame_id != transform.child_frame_id);
  }
  const auto activity =
      arm.transport.last<msg::ControllerManagerActivity<Jazzy>>("/controller_manager/activity");
  REQUIRE(activity);
  REQUIRE(activity->controllers.size() == 3);
  CHECK(activity->controllers[1].state.label == "active");
  CHECK(activity->hardware_components[0].state.id == 3);
}

TEST_CASE("frames of two robots differ by their prefix") {
  BridgedArm arm({.frame_prefix = "left/"});
  arm.run(50);
  for (const std::string topic : {"/tf", "/tf_static"}) {
    const auto frames = arm.transport.last<tf2_msgs::msg::TFMessage<Jazzy>>(topic);
    REQUIRE(frames);
    CHECK_FALSE(frames->transforms.empty());
    for (const auto& transform : frames->transforms) {
      CHECK(transform.header.frame_id.starts_with("left/"));
      CHECK(transform.child_frame_id.starts_with("left/"));
    }
  }
}

TEST_CASE("each distribution gets its layout, and Humble no hashes") {
  BridgedArm humble({.distribution = Distribution::humble, .name_space = "/left"});
  const std::string service = "/left/controller_manager/list_controllers";
  CHECK(humble.transport.services.at(service).endpoint.hash.empty());
  CHECK(humble.call<srv::ListControllers<Humble>>(service).controller.size() == 3);
  CHECK(humble.transport.topics.contains("/left/joint_states"));
  CHECK(humble.transport.topics.contains("/tf"));
  CHECK_FALSE(humble.transport.topics.contains("/left/controller_manager/activity"));
  CHECK_FALSE(humble.transport.topics.contains("/left/pid_plus_gravity/speed_scaling_input"));
  static_cast<void>(humble.ask(articula::remote::Activate{}));
  humble.run(50);
  const auto& topics = humble.transport.topics;
  CHECK(topics.at("/left/pid_plus_gravity/controller_state").count > 0);
  CHECK(topics.at("/left/pid_plus_gravity/state").count ==
        topics.at("/left/pid_plus_gravity/controller_state").count);
  BridgedArm rolling({.distribution = Distribution::rolling});
  CHECK(controller<Rolling>(rolling, "computed_torque").update_rate == 1000);
  CHECK(rolling.transport.services.at(manager + "list_controllers")
            .endpoint.hash.starts_with("RIHS01_"));
  CHECK_FALSE(rolling.transport.topics.contains("/pid_plus_gravity/state"));
}

TEST_CASE("a client that watches only cannot switch") {
  BridgedArm arm({.operates = false});
  CHECK_FALSE(set_hardware(arm, "active").ok);
  CHECK(arm.bridge.dropped().refused == 1);
  // Nor what the bridge does itself.
  CHECK_FALSE(switch_to(arm, {}, {"joint_state_broadcaster"}).ok);
  CHECK(controller(arm, "joint_state_broadcaster").state == "active");
}

TEST_CASE("the controls go back to others when ROS has been silent") {
  BridgedArm arm;
  set_hardware(arm, "active");
  CHECK(arm.loop->port().situation().operator_name == "ROS 2");
  arm.now -= std::chrono::hours(1);  // the clock was set
  arm.run(1100);
  CHECK(arm.loop->port().situation().operator_name.empty());
  const auto session = arm.loop->port().connect("window", true);
  CHECK(session->take_controls().empty());
  const auto refused = set_hardware(arm, "inactive");
  CHECK_FALSE(refused.ok);
  CHECK(refused.state.label == "active");
}

TEST_CASE("options that make no sense are refused") {
  const auto loop = support::switched_arm();
  support::MemoryTransport transport;
  const auto make = [&](const BridgeOptions& options) {
    BridgeNodes(loop->port(), transport, options);
  };
  CHECK_THROWS_WITH(make({.name_space = "left"}),
                    "ros2: name_space 'left' does not begin with / or ends with it");
  CHECK_THROWS_WITH(make({.state_rate = 0}), "ros2: state_rate 0 is not within 0 .. 1000000");
  const auto make_with = [&](const ControllerOptions& options) {
    make({.controllers = {{"pid_plus_gravity", options}}});
  };
  CHECK_THROWS_WITH(make_with({.command_quantity = "torque"}),
                    "ros2: command_quantity of 'pid_plus_gravity': 'torque' is not position, "
                    "velocity or effort");
  CHECK_THROWS_WITH(make({.gain_prefix = "gains"}),
                    "ros2: gain_prefix 'gains' does not end with a dot: add one");
  const std::string type = "position_controllers/GripperActionController";
  CHECK_THROWS_WITH(make_with({.gain_prefix = "gains"}),
                    "ros2: gain_prefix 'gains' does not end with a dot: add one");
  CHECK_THROWS_WITH(make_with({.type = type}),
                    "ros2: gripper 'pid_plus_gravity' has the joints shoulder_active_joint, "
                    "elbow_active_joint, not '': name one of them as its joint");
  CHECK_THROWS_WITH(
      make_with({.type = type, .gripper = {.stall_timeout = -1}}),
      "ros2: stall_timeout -1 of gripper 'pid_plus_gravity' is not within 0 .. 1000000");
  CHECK_THROWS_WITH(make_with({.gripper = {.allow_stalling = true}}),
                    "ros2: controller 'pid_plus_gravity' has options of a gripper, but its type, "
                    "joint_trajectory_controller/JointTrajectoryController, is none");
  CHECK_THROWS_WITH(make_with({.constraints = TrajectoryConstraints{.joints = {{}}}}),
                    "ros2: constraints of 'pid_plus_gravity' are for 1 joints, not 2");
  CHECK_THROWS_WITH(make_with({.constraints = TrajectoryConstraints{.goal_time = -1}}),
                    "ros2: constraint goal_time of 'pid_plus_gravity': -1 is not a finite number "
                    ">= 0");
  CHECK_THROWS_WITH(make({.controllers = {{"pid_plus_gravty", {}}}}),
                    "ros2: the options are for a controller 'pid_plus_gravty', which the loop does "
                    "not list; did you mean 'pid_plus_gravity'?");
  CHECK(domain_id("") == 0);
  CHECK(domain_id("232") == 232);
  for (const char* text : {"abc", "7x", "233", "-1", " 1"}) {
    CAPTURE(text);
    CHECK_THROWS_WITH(domain_id(text), "ROS_DOMAIN_ID '" + std::string(text) +
                                           "' is not a whole number within 0 .. 232: set another "
                                           "one");
  }
}

TEST_CASE("a switch without a strictness does what can be done, as in ros2_control") {
  BridgedArm arm;
  set_hardware(arm, "active");
  CHECK_FALSE(switch_to(arm, {"computed_torque", "unknown"}, {"pid_plus_gravity"}).ok);
  CHECK(switch_to(arm, {"computed_torque", "unknown"}, {"pid_plus_gravity"}, 0).ok);
  CHECK(controller(arm, "computed_torque").state == "active");
}

TEST_CASE("a loop that stands still says nothing") {
  BridgedArm arm;
  arm.run(100);
  const auto count = [&] { return arm.transport.topics["/joint_states"].count; };
  const auto before = count();
  CHECK(before > 5);
  for (int k = 0; k < 1000; ++k) arm.bridge.update(arm.now += std::chrono::milliseconds(1));
  CHECK(count() <= before + 1);
  arm.run(100);
  CHECK(count() > before + 5);
}

TEST_CASE("what best effort leaves out is in the log, and taken joints are a failure") {
  BridgedArm arm;
  set_hardware(arm, "active");
  const auto logged = [&] {  // the last warning
    std::string warning;
    for (const auto& bytes : arm.transport.topics["/rosout"].sent) {
      rcl_interfaces::msg::Log<Jazzy> line;
      REQUIRE(decode(bytes, line) == CdrError::none);
      if (line.level == 30) warning = line.msg;
    }
    arm.transport.topics["/rosout"].sent.clear();
    return warning;
  };
  const int best_effort = 1;
  // As `ros2 control set_controller_state` asks for one controller:
  const auto taken = switch_to(arm, {"computed_torque"}, {}, best_effort);
  CHECK_FALSE(taken.ok);
  CHECK(taken.message ==
        "Could not activate controller : 'computed_torque': controller 'computed_torque': another "
        "controller of these joints is active or starts, too; stop it or replace it");
  CHECK(logged() == "switch_controller: " + taken.message);
  CHECK(switch_to(arm, {"pid_plus_gravity"}, {}, best_effort).ok);
  CHECK(logged() == "switch_controller: controller 'pid_plus_gravity': already active");
  CHECK(switch_to(arm, {}, {"computed_torque"}, best_effort).ok);
  CHECK(logged() == "switch_controller: controller 'computed_torque': not active");
  CHECK(switch_to(arm, {"ghost"}, {}, best_effort).ok);
  CHECK(logged() ==
        "switch_controller: controller 'ghost': unknown name; controllers: pid_plus_gravity, "
        "computed_torque");
  CHECK(switch_to(arm, {"joint_state_broadcaster"}, {}, best_effort).ok);
  CHECK(logged() == "switch_controller: controller 'joint_state_broadcaster': already active");
  CHECK(controller(arm, "pid_plus_gravity").state == "active");
}
