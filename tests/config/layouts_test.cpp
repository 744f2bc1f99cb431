// SPDX-License-Identifier: Apache-2.0
#include <articula/config/load_controller_manager.hpp>
#include <articula/config/load_pid_gains.hpp>
#include <articula/config/load_signals.hpp>
#include <articula/config/load_trajectory_tolerances.hpp>
#include <articula/robots/q2d.hpp>

#include <algorithm>
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
  } catch (const FileError& error) {
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
        "test:1:12: /left/**.ros__parameters: not used, no section is in this namespace");
}

TEST_CASE("of several sections that mean a controller the later one is stronger, as in ROS 2") {
  const std::string all = "/**: {ros__parameters: {priority: 10}}\n";
  const std::string left = "/left/**: {ros__parameters: {priority: 20}}\n";
  const std::string arms = "/**/arm: {ros__parameters: {priority: 30}}\n";
  const std::string own = "/left/arm: " + controller("1");
  CHECK(loaded(all + left + arms + own).priority == 30);
  CHECK(loaded(arms + all + left + own).priority == 20);
  CHECK(loaded(own + arms + left + all).priority == 10);
  CHECK(loaded(arms + own + left).priority == 20);
  CHECK(loaded(all + left + "/right/arm: " + controller("1")).priority == 10);
  CHECK(loaded(arms + own + left).notes.empty());  // no value of its own was replaced

  // The order is that of ros__parameters, not of the keys around them.
  CHECK(
      loaded("/**: {arm: {ros__parameters: {priority: 1}}, ros__parameters: {priority: 2}}\n" + own)
          .priority == 2);
  CHECK(
      loaded("/**: {ros__parameters: {priority: 2}, arm: {ros__parameters: {priority: 1}}}\n" + own)
          .priority == 1);

  // A controller's own value that a later section replaces is noted; other entries of a map stay.
  const auto config = loaded(own +
                             "/**:\n  ros__parameters:\n    elbow_active_joint: {p: 7, d: 2}\n"
                             "    shoulder_active_joint: {p: 1}\n");
  CHECK(config.gains[0].proportional == 1);
  CHECK(config.gains[1].proportional == 7);
  CHECK(config.gains[1].derivative == 2);
  CHECK(config.notes ==
        std::vector<std::string>{
            "test:1:136: /left/arm.ros__parameters.elbow_active_joint.p: not used: "
            "/**.ros__parameters.elbow_active_joint.p in line 4 comes later and counts, as in "
            "ROS 2"});
}

TEST_CASE("the forms of wildcards mean the controllers that they mean in ROS 2") {
  struct Case {
    std::string pattern;
    std::vector<std::string> covered, others;
  };
  const std::vector<Case> cases = {
      {"/**", {"arm", "/left/arm", "/left/upper/arm"}, {}},
      {"/*", {"arm"}, {"/left/arm"}},
      {"/**/arm", {"arm", "/left/arm", "/left/upper/arm"}, {"/left/leg"}},
      {"/*/arm", {"/left/arm"}, {"arm", "/left/upper/arm", "/left/leg"}},
      {"/left/**", {"/left/arm", "/left/upper/arm"}, {"/right/arm", "/lefty/arm", "arm"}},
      {"/left/*", {"/left/arm"}, {"/left/upper/arm", "arm"}},
      {"/left/**/arm", {"/left/arm", "/left/upper/arm"}, {"arm", "/left/leg"}},
      {"/**/upper/*", {"/upper/arm", "/left/upper/arm"}, {"/left/arm", "arm"}},
      {"/*/*/arm", {"/left/upper/arm"}, {"/left/arm"}},
      {"arm", {"arm"}, {"/left/arm", "/army"}},
      {"/left/arm", {"/left/arm"}, {"arm"}},
  };
  for (const Case& each : cases) {
    for (const bool covered : {true, false}) {
      for (const std::string& name : covered ? each.covered : each.others) {
        CAPTURE(each.pattern, name);
        CHECK(detail::SectionName(each.pattern).matches(detail::SectionName(name)) == covered);
        if (each.pattern.find('*') == std::string::npos) continue;
        // In a file that has both, whichever comes first; and with the key in two parts.
        const std::string own = name + ": " + controller("1");
        const std::string parameters = "{ros__parameters: {priority: 5}}";
        const std::string key = each.pattern + ": ";
        const std::size_t slash = each.pattern.rfind('/');
        for (const std::string& text :
             {key + parameters + "\n" + own, own + key + parameters + "\n",
              own + (slash == 0
                         ? key + parameters + "\n"
                         : each.pattern.substr(0, slash) + ": {\"" +
                               each.pattern.substr(slash + 1) + "\": " + parameters + "}\n")}) {
          CHECK(loaded(text, name).priority.has_value() == covered);
        }
      }
    }
  }
}

TEST_CASE("a controller may be there by a wildcard alone") {
  for (const std::string key : {"/**/arm", "/*/arm", "/left/**/arm", "/*/*/arm"}) {
    INFO(key);
    const std::string text = key + ": " + controller("3");
    CHECK(loaded(text).gains[1].proportional == 3);
    CHECK(loaded(text, "arm").name == "arm");
    CHECK_THAT(complaint("/**: {ros__parameters: {priority: 1}}\n" + text, "leg"),
               Contains("no controller with gains called 'leg'"));
  }
  // It is asked for in a namespace: what is of that namespace counts.
  const std::string text = "/**/arm: " + controller("3") +
                           "/left/**: {ros__parameters: {priority: 4}}\n"
                           "/right/*: {ros__parameters: {priority: 5}}\n";
  CHECK(loaded(text, "/left/arm").priority == 4);
  CHECK(loaded(text, "right/arm").priority == 5);
  CHECK_FALSE(loaded(text, "arm").priority);
  // One of that name that has a section is meant by it, whatever its namespace.
  CHECK(loaded(text + "/left/arm: {ros__parameters: {gravity: {z: -9.8}}}\n", "arm").priority == 4);
  // Both forms mean the same arm.
  CHECK(loaded("/**/arm: {ros__parameters: {priority: 6}}\n/*/arm: " + controller("1")).priority ==
        6);
  CHECK(loaded("/*/arm: " + controller("1") + "/**/arm: {ros__parameters: {priority: 6}}\n")
            .priority == 6);
  // The controller manager lists it, and /** has its parameters.
  const std::string listed =
      "controller_manager: {ros__parameters: {update_rate: 5, j: {type: a/StateBroadcaster},\n"
      "  arm: {type: pid_controller/PidController}}}\n/**: " +
      controller("8");
  CHECK(loaded(listed).gains[0].proportional == 8);
  CHECK(loaded(listed).type == "pid_controller/PidController");
  CHECK(loaded(listed, "arm").name == "arm");
  // A slip in the section of an arm is one, in that of everybody it is noted.
  CHECK_THAT(complaint("/**/arm: {ros__parameters: {priorit: 1, joints: [elbow_active_joint], "
                       "elbow_active_joint: {p: 1}}}\n"),
             Contains("/**/arm.ros__parameters.priorit: unknown key"));
}

TEST_CASE("constraints of a wildcard count, and what is for joints of others is noted") {
  const auto file = support::config_file("wildcard_controllers.yaml");
  const auto left = load_trajectory_tolerances(Q2d(), file, "/left/arm_controller");
  CHECK(left.tolerances.goal_time == 2);
  CHECK(left.tolerances.path_position[0] == 0.2);
  CHECK(left.tolerances.path_position[1] == 0.1);
  CHECK(left.tolerances.goal_position[0] == 0.02);
  const auto right = load_trajectory_tolerances(Q2d(), file, "/right/arm_controller");
  CHECK(right.tolerances.path_position[0] == 0.2);
  CHECK(right.tolerances.path_position[1] == 0);
  const auto gains = load_pid_gains(Q2d(), file);
  CHECK(gains.gains[0].anti_windup == AntiWindup::none);
  CHECK(gains.gains[1].anti_windup == AntiWindup::conditional_integration);
  CHECK(gains.gains[1].derivative == 0.25);
  for (const auto& notes : {left.notes, right.notes, gains.notes}) {
    for (const std::string part : {"gains", "constraints"}) {
      CHECK(std::find(notes.begin(), notes.end(),
                      support::config_file("wildcard_controllers.yaml").name() +
                          (part == "gains" ? ":7:20" : ":10:20") + ": /**.ros__parameters." + part +
                          ".wrist_joint: not used: joint 'wrist_joint' is not this "
                          "controller's") != notes.end());
    }
  }
  // The controller's own words for joints that it lacks are slips.
  CHECK_THAT(complaint("arm:\n  ros__parameters:\n    joints: [elbow_active_joint]\n"
                       "    gains: {elbow_active_joint: {p: 1}, elbow_activ_joint: {p: 1}}\n"),
             Contains("test:4:41: arm.ros__parameters.gains.elbow_activ_joint: unknown key"));
  // So is what is no joint, and what is no gain, wherever it stands.
  CHECK_THAT(
      complaint("/**: {ros__parameters: {constraints: {goal_tim: 1}}}\narm: " + controller("1")),
      Contains("/**.ros__parameters.constraints.goal_tim: unknown key"));
  CHECK_THAT(
      complaint("/**: {ros__parameters: {elbow_active_joint: {dd: 1}}}\narm: " + controller("1")),
      Contains("/**.ros__parameters.elbow_active_joint.dd: unknown key"));
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
  CHECK(manager.notes[0] == "test:3:14: /**.ros__parameters.gravity: not used here");
  CHECK(loaded(text).notes ==
        std::vector<std::string>{"test:4:10: /**.ros__parameters.foo: not used here"});
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
        "test:2:55: b.priority: the priority differs from that in line 1, expected the same for "
        "controllers that are combined");
  CHECK_THAT(complaint(both("gravity: {z: -9.8}", "gravity: {z: 9.8}")),
             Contains("b.gravity: the gravity differs from that in line 1"));
  CHECK_THAT(complaint(both("chain: {root: base_link}", "chain: {root: origin_link}")),
             Contains("b.chain.root: the root differs from that in line 1"));
  CHECK_THAT(complaint(both("chain: {tip: base_link}", "chain: {tip: tool_link}")),
             Contains("b.chain.tip: the tip differs from that in line 1"));
  // What only the second one says is checked as well.
  CHECK_THAT(complaint(both("type: a/B", "type: a/B, chain: {root: nowhere}")),
             Contains("b.chain.root: robot 'q2d' has no link 'nowhere'"));
  CHECK_THAT(complaint(both("type: a/B", "type: a/B, gravity: {z: 9.8}")),
             Contains("b.gravity: gravity (0, 0, 9.8) m/s^2 is not that of robot 'q2d'"));
  CHECK_THAT(complaint(both("constraints: {goal_time: 1}", "constraints: {goal_time: 2}")),
             Contains("b: its options of trajectories differ from those in line 1"));
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
             Contains("a.P: unknown key 'P', expected one of p, Kp, pid, ...; did you mean 'p'?"));
  CHECK_THAT(complaint("a: {joint: elbow_active_joint, p: 1, pid: {p: 2}}\n", "a"),
             Contains("gains of 'elbow_active_joint' a second time"));
}
