// SPDX-License-Identifier: Apache-2.0
#include <articula/config/load_controller_manager.hpp>
#include <articula/config/load_pid_gains.hpp>
#include <articula/config/load_signals.hpp>
#include <articula/robots/q2d.hpp>

#include <string>
#include <vector>

#include "catch.hpp"
#include "config_support.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::yaml;

namespace {

PidConfig<2> loaded(const std::string& text, const std::string& name = "") {
  return load_pid_gains(Q2d(), yaml(text), name);
}
std::string complaint(const std::string& text, const std::string& name = "") {
  try {
    static_cast<void>(loaded(text, name));
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "none";
}

std::string controller(const std::string& p) {
  return "{ros__parameters: {joints: [shoulder_active_joint, elbow_active_joint], "
         "shoulder_active_joint: {p: " +
         p + "}, elbow_active_joint: {p: " + p + "}}}\n";
}
std::string of_joint(const std::string& joint, const std::string& more) {
  return "{joint: " + joint + ", pid: {p: 1}, " + more + "}\n";
}
std::string both(const std::string& shoulder, const std::string& elbow) {
  return "a: " + of_joint("shoulder_active_joint", shoulder) +
         "b: " + of_joint("elbow_active_joint", elbow);
}

}  // namespace

TEST_CASE("a wildcard counts in its namespace") {
  const auto priority = [](const std::string& wildcard, const std::string& section) {
    return loaded(wildcard + ": {ros__parameters: {priority: 50}}\n" + section + ": " +
                  controller("1"))
        .priority;
  };
  CHECK(priority("/**", "arm") == 50);
  CHECK(priority("/**", "/left/arm") == 50);
  CHECK(priority("/left/**", "/left/arm") == 50);
  CHECK(priority("/left/**", "/left/upper/arm") == 50);
  CHECK(priority("/left/*", "/left/arm") == 50);
  CHECK(priority("/*", "arm") == 50);
  CHECK_FALSE(priority("/left/**", "/right/arm"));
  CHECK_FALSE(priority("/left/**", "/lefty/arm"));
  CHECK_FALSE(priority("/left/**", "arm"));
  CHECK_FALSE(priority("/left/*", "/left/upper/arm"));
  CHECK_FALSE(priority("/*", "/left/arm"));

  const auto config = loaded(
      "/left/**: {ros__parameters: {elbow_active_joint: {i: 500}}}\n"
      "/right/arm: " +
      controller("1"));
  CHECK(config.gains[1].integral == 0);
  REQUIRE(config.notes.size() == 1);
  CHECK(config.notes[0] ==
        "test:1: /left/**.ros__parameters: not used, no section is in this namespace");
}

TEST_CASE("of two wildcards the one that is nearer to the controller is stronger") {
  for (const std::string text :
       {"/**: {ros__parameters: {priority: 10}}\n/left/**: {ros__parameters: {priority: 20}}\n",
        "/left/**: {ros__parameters: {priority: 20}}\n/**: {ros__parameters: {priority: 10}}\n"}) {
    CHECK(loaded(text + "/left/arm: " + controller("1")).priority == 20);
    CHECK(loaded(text + "/right/arm: " + controller("1")).priority == 10);
  }
}

TEST_CASE("what a section inherits and does not know is noted with its own place") {
  const std::string text =
      "/**:\n  ros__parameters:\n    gravity: {z: -9.8}\n    foo: 1\n"
      "controller_manager: {ros__parameters: {update_rate: 500}}\n"
      "c: " +
      controller("1");
  const auto manager = load_controller_manager(yaml(text));
  CHECK(manager.update_rate == 500);
  REQUIRE(manager.notes.size() == 2);
  CHECK(manager.notes[0] == "test:3: /**.ros__parameters.gravity: not used here");
  CHECK(loaded(text).notes ==
        std::vector<std::string>{"test:4: /**.ros__parameters.foo: not used here"});
  CHECK(loaded(text).gravity == Vector3<double>{0, 0, -9.8});

  const std::string waves =
      "/**: {ros__parameters: {use_sim_time: true, foo: 1}}\n"
      "w: {ros__parameters: {waveforms: {elbow_active_joint: {amplitude: 1, frequency: 1}}}}\n";
  const SignalConfig signals = load_signals(Q2d(), yaml(waves));
  CHECK(signals.signals.size() == 1);
  CHECK(signals.notes.size() == 2);

  // What is known is checked, and named as it stands in the file.
  CHECK_THAT(complaint("/**: {ros__parameters: {gravity: {z: many}}}\nc: " + controller("1")),
             Contains("test:1:38: /**.ros__parameters.gravity.z: the word 'many'"));
  CHECK_THAT(
      complaint("/**: {ros__parameters: {elbow_active_joint: {d: many}}}\nc: " + controller("1")),
      Contains("/**.ros__parameters.elbow_active_joint.d: the word 'many'"));
}

TEST_CASE("gains under /** are no reason to take the controller manager for a controller") {
  const auto config = loaded(
      "/**: {ros__parameters: {gains: {shoulder_active_joint: {p: 1}, elbow_active_joint: {p: "
      "2}}}}\n"
      "controller_manager: {ros__parameters: {update_rate: 1000}}\n"
      "c: {ros__parameters: {priority: 5}}\n");
  CHECK(config.name == "c");
  CHECK(config.gains[1].proportional == 2);
  CHECK(complaint("controller_manager: {update_rate: 1}\nc: " + controller("1"), "d") ==
        "test: there is no controller with gains called 'd' in it, expected one of c");
}

TEST_CASE("the same name in two namespaces is told apart") {
  const std::string text = "left:\n  arm: " + controller("1") + "right:\n  arm: " + controller("2");
  for (const std::string name : {"", "arm"}) {
    CHECK(
        complaint(text, name) ==
        "test:4:9: right.arm.ros__parameters: there are several: left/arm in line 2, right/arm in "
        "line 4, expected one of left/arm, right/arm by name");
  }
  CHECK(loaded(text, "left/arm").gains[0].proportional == 1);
  CHECK(loaded(text, "/right/arm").gains[0].proportional == 2);
  CHECK(loaded(text, "right").gains[0].proportional == 2);
  // A full name is meant before the last part of another one.
  CHECK(loaded("arm: " + controller("3") + text, "arm").gains[0].proportional == 3);
}

TEST_CASE("types are those of the namespace's own controller manager") {
  const std::string text =
      "left: {controller_manager: {arm: {type: a/Left}}, arm: " + controller("1") +
      " }\n"
      "right: {controller_manager: {arm: {type: a/Right}}, arm: " +
      controller("2") + " }\n";
  CHECK(loaded(text, "left").type == "a/Left");
  CHECK(loaded(text, "right").type == "a/Right");
}

TEST_CASE("a broadcaster is no controller") {
  const std::string text =
      "controller_manager: {b: {type: joint_state_broadcaster/JointStateBroadcaster}}\n"
      "b: {ros__parameters: {joints: [shoulder_active_joint], extra_joints: [x]}}\n"
      "joint_state_broadcaster: {ros__parameters: {joints: [shoulder_active_joint]}}\n"
      "arm: " +
      controller("1");
  CHECK(load_controller(yaml(text)).name == "arm");
}

TEST_CASE("controllers of one joint each are put together where they say the same") {
  const auto config = loaded(both("priority: 7, gravity: {z: -9.8}", "chain: {tip: tool_link}"));
  CHECK(config.priority == 7);
  CHECK(config.chain_tip == "tool_link");
  CHECK(config.gravity == Vector3<double>{0, 0, -9.8});
  CHECK(loaded(both("priority: 7", "priority: 7")).priority == 7);

  CHECK(complaint(both("priority: 7", "priority: 8")) ==
        "test:2:55: b.priority: the priority is another one in line 1, expected the same for "
        "controllers that are put together");
  CHECK_THAT(complaint(both("gravity: {z: -9.8}", "gravity: {z: 9.8}")),
             Contains("b.gravity: the gravity is another one in line 1"));
  CHECK_THAT(complaint(both("chain: {root: base_link}", "chain: {root: origin_link}")),
             Contains("b.chain.root: the root is another one in line 1"));
  CHECK_THAT(complaint(both("chain: {tip: base_link}", "chain: {tip: tool_link}")),
             Contains("b.chain.tip: the tip is another one in line 1"));
  // What only the second one says is checked as well.
  CHECK_THAT(complaint(both("type: a/B", "type: a/B, chain: {root: nowhere}")),
             Contains("b.chain.root: robot 'q2d' has no link 'nowhere'"));
  CHECK_THAT(complaint(both("type: a/B", "type: a/B, gravity: {z: 9.8}")),
             Contains("b.gravity: gravity (0, 0, 9.8) m/s^2 is not that of robot 'q2d'"));
  CHECK_THAT(complaint(both("constraints: {goal_time: 1}", "constraints: {goal_time: 2}")),
             Contains("b: its options of trajectories are not those in line 1"));
  CHECK_THAT(complaint(both("type: effort/Pos", "type: velocity/Pos")),
             Contains("b: its type is 'velocity/Pos', that of the controller in line 1 is "
                      "'effort/Pos', expected the name or the type"));
}

TEST_CASE("a controller of one joint may have any gain among its parameters") {
  const std::string text =
      "a: {type: x/Y, joint: shoulder_active_joint, p: 1, u_clamp_max: 3, u_clamp_min: -3,\n"
      "    antiwindup_strategy: back_calculation, tracking_time_constant: 0.5, priority: 9}\n"
      "b: {type: x/Y, joint: elbow_active_joint, p: 2, position_weight: 0.5}\n";
  const auto config = loaded(text);
  CHECK(config.gains[0].output_clamp_max == 3);
  CHECK(config.gains[0].anti_windup == AntiWindup::back_calculation);
  CHECK(config.gains[0].tracking_time == 0.5);
  CHECK(config.gains[1].position_weight == 0.5);
  CHECK(config.priority == 9);
  CHECK_THAT(complaint("a: {type: x/Y, joint: elbow_active_joint, u_clamp_max: 3}\n", "a"),
             Contains("a: the key 'p' is missing"));
  CHECK_THAT(complaint("a: {type: x/Y, joint: elbow_active_joint, P: 1, i: 3}\n", "a"),
             Contains("a.P: unknown key 'P', expected 'p'?"));
  CHECK_THAT(complaint("a: {joint: elbow_active_joint, p: 1, pid: {p: 2}}\n", "a"),
             Contains("gains of 'elbow_active_joint' a second time"));
}
