// SPDX-License-Identifier: Apache-2.0
/// @file Loops of the program in ROS 2. Without Fast DDS they are refused.
#include "ros2_options.hpp"

#include "files/within.hpp"

#ifdef ARTICULA_PROGRAM_HAS_ROS2
#include <articula/ros2/bridge/bridge.hpp>
#include <articula/ros2/dds/fast_dds_transport.hpp>
#include <articula/ros2/hardware/topic_robot.hpp>
#endif

#include <CLI/CLI.hpp>

#include <cstdio>
#include <regex>
#include <string>

namespace terminal {

namespace {

/// Refuses what the command line has that ROS 2 does not take.
void check(const Ros2Options& options) {
#ifndef ARTICULA_PROGRAM_HAS_ROS2
  static_cast<void>(options);
  throw Refusal(
      "this articula was built without ROS 2: build it where CMake finds Fast DDS (Debian 12: "
      "libfastrtps-dev)");
#else
  const std::string& space = options.name_space;
  static const std::regex names("(/[A-Za-z_][A-Za-z0-9_]*)*");
  if (!std::regex_match(space, names)) {
    throw Refusal("--namespace " + space +
                  ": expected names of letters, digits and _, without a digit first, each after a "
                  "/, as /left");
  }
#endif
}

#ifdef ARTICULA_PROGRAM_HAS_ROS2

namespace ros2 = articula::ros2;

ros2::Distribution distribution_of(const Ros2Options& options) {
  if (options.distribution == "humble") return ros2::Distribution::humble;
  if (options.distribution == "rolling") return ros2::Distribution::rolling;
  return ros2::Distribution::jazzy;
}

ros2::FastDdsOptions dds_of(const Ros2Options& options) {
  return {.domain = options.domain, .interfaces = options.interfaces};
}

/// Prints where programs of ROS 2 find the loop.
void tell(const Ros2Options& options) {
  std::string where;
  for (const std::string& interface : options.interfaces) where += " " + interface;
  std::printf("ROS 2 %s, domain %u, by%s%s%s\n", options.distribution.c_str(), options.domain,
              where.c_str(), options.name_space.empty() ? "" : ", below ",
              options.name_space.c_str());
}

/// What the numbers for a controller are.
std::string quantity_of(ControllerKind kind) {
  using enum ControllerKind;
  if (kind == bypass) return "effort";
  return kind == velocity_by_effort || kind == forward_velocity ? "velocity" : "position";
}

/// What the file says of a controller.
ros2::ControllerOptions options_of(const PlannedController& controller) {
  const articula::ControllerConfig& config = controller.config;
  ros2::ControllerOptions options{.command_quantity = quantity_of(controller.kind),
                                  .gain_prefix = config.gain_prefix};
  if (config.type.find('/') != std::string::npos) options.type = config.type;
  options.constraints.emplace();
  if (controller.has_tolerances) options.constraints->goal_time = config.goal_time;
  for (const articula::ConfiguredJoint& joint : config.joints) {
    options.joints.push_back(joint.name);
    options.constraints->joints.push_back(
        {joint.path_tolerance, joint.goal_tolerance,
         controller.has_tolerances ? config.stopped_velocity_tolerance : 0});
  }
  if (ros2::is_gripper(options.type)) {
    const articula::ConfiguredGripper& gripper = config.gripper;
    options.gripper = {.goal_tolerance = gripper.goal_tolerance,
                       .allow_stalling = gripper.allow_stalling,
                       .stall_velocity_threshold = gripper.stall_velocity_threshold,
                       .stall_timeout = gripper.stall_timeout};
  }
  return options;
}

#endif

}  // namespace

void add_ros2_options(CLI::App& command, Ros2Options& options) {
  CLI::Option* wanted =
      command.add_flag("--ros2", options.is_wanted, "programs of ROS 2 see and operate it");
  command
      .add_option("--domain", options.domain, "of ROS 2; the variable ROS_DOMAIN_ID sets it, too")
      ->check(within(0, 232))
      ->envname("ROS_DOMAIN_ID")
      ->capture_default_str();
  command.add_option("--distribution", options.distribution, "of ROS 2")
      ->check(CLI::IsMember({"humble", "jazzy", "rolling"}))
      ->needs(wanted)
      ->capture_default_str();
  command.add_option("--namespace", options.name_space, "of its nodes and topics, as /left")
      ->needs(wanted);
  command
      .add_option("--frame-prefix", options.frame_prefix,
                  "before the names of its frames in /tf, as left/")
      ->needs(wanted);
  command
      .add_option("--interface", options.interfaces,
                  "an IPv4 address of this host for ROS 2, in place of loopback")
      ->check(CLI::ValidIPV4)
      ->allow_extra_args(false)
      ->needs(wanted);
}

Attach ros2_bridge(const Ros2Options& options, const ControllersPlan& plan) {
  if (!options.is_wanted) return {};
  check(options);
#ifdef ARTICULA_PROGRAM_HAS_ROS2
  ros2::BridgeOptions bridge{.distribution = distribution_of(options),
                             .dds = dds_of(options),
                             .name_space = options.name_space,
                             .frame_prefix = options.frame_prefix,
                             .operates = options.operates,
                             .use_sim_time = options.use_sim_time};
  for (const PlannedController& controller : plan.controllers) {
    bridge.controllers[controller.name] = options_of(controller);
  }
  return [bridge, options](articula::remote::Port& port) -> std::shared_ptr<void> {
    auto attached = std::make_shared<ros2::Bridge>(port, bridge);
    tell(options);
    return attached;
  };
#else
  static_cast<void>(plan);
  return {};
#endif
}

Attach ros2_robot(const Ros2Options& options) {
  if (!options.is_wanted) return {};
  check(options);
#ifdef ARTICULA_PROGRAM_HAS_ROS2
  if (!options.operates) throw Refusal("--read-only: a robot behind topics takes commands");
  return [options](articula::remote::Port& port) -> std::shared_ptr<void> {
    const ros2::Distribution distribution = distribution_of(options);
    ros2::TopicRobotOptions topics{.distribution = distribution};
    topics.name_space = options.name_space;
    topics.warn = [](const std::string& warning) {
      std::fprintf(stderr, "warning: %s\n", warning.c_str());
    };
    topics.joint_states_topic = options.name_space + topics.joint_states_topic;
    topics.joint_commands_topic = options.name_space + topics.joint_commands_topic;
    auto attached = std::make_shared<ros2::TopicRobot>(
        port, std::make_unique<ros2::FastDdsTransport>(dds_of(options), distribution), topics);
    tell(options);
    return attached;
  };
#else
  return {};
#endif
}

}  // namespace terminal
