// SPDX-License-Identifier: Apache-2.0
#include <articula/config/load_controller_manager.hpp>
#include <articula/config/load_pid_gains.hpp>
#include <articula/config/load_trajectory_tolerances.hpp>
#include <articula/robots/q2d.hpp>

#include <string>

#include "catch.hpp"
#include "config_support.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::config_file;
using support::example_file;
using support::yaml;

namespace {

/// What is said about a text.
std::string complaint(const std::string& text, const std::string& name = "") {
  try {
    static_cast<void>(load_pid_gains(Q2d(), yaml(text), name));
  } catch (const FileError& error) {
    return error.what();
  }
  return "none";
}

const std::string joints = "joints: [shoulder_active_joint, elbow_active_joint]\n";
const std::string gains = "gains:\n  shoulder_active_joint: {p: 1}\n  elbow_active_joint: {p: 1}\n";

}  // namespace

TEST_CASE("what is not one YAML map is refused with its place") {
  CHECK(complaint("") == "test: it is empty, expected parameters");
  CHECK(complaint("# nothing\n---\n") == "test: it is empty, expected parameters");
  CHECK(complaint("~") == "test: it is empty, expected parameters");
  CHECK(complaint("abc") == "test:1:1: the word 'abc' at the top, expected a map of parameters");
  CHECK(complaint("- 1\n- 2\n") ==
        "test:1:1: a list of 2 at the top, expected a map of parameters");
  CHECK(complaint(gains + "---\n" + gains) ==
        "test:4:1: a second document begins, expected one document in a file");
  CHECK_THAT(complaint("gains: {a: [1, 2}\n"), Contains("test:1:") && Contains("it is not YAML"));
  CHECK_THAT(complaint("gains: \"\\q\"\n"), Contains("it is not YAML"));
  CHECK_THAT(complaint("a: *nobody\n"), Contains("test:1:4: it is not YAML"));
  CHECK(complaint("gains:\n\tp: 1\n") == "test:2:1: a tab in the indentation, expected spaces");
  CHECK(complaint(std::string("a: 1\nb\0: 2", 10)) ==
        "test:2:2: a NUL character, expected UTF-8 text (UTF-16 is not supported)");
  // A tab elsewhere, blank lines with tabs and Windows line ends do no harm.
  CHECK(complaint("gains:\r\n  shoulder_active_joint:\t{p:\t1}\r\n\t\r\n"
                  "  elbow_active_joint: {p: 1}\t# fine\r\n") == "none");
}

TEST_CASE("one of two equal keys is never taken silently") {
  CHECK(complaint("gains: {}\n" + gains) ==
        "test:2:1: the key 'gains' is also in line 1, expected every key once");
  CHECK(complaint(joints + "elbow_active_joint: {p: 1, d: 2, p: 3}\n") ==
        "test:2:34: elbow_active_joint: the key 'p' is also in line 2, expected every key once");
  CHECK_THAT(complaint("a:\n  ros__parameters:\n    gravity: {z: -9.8}\n    gravity.z: -9.8\n"),
             Contains("test:4:5: a.ros__parameters: 'gravity.z' is also in line 3"));
  CHECK_THAT(complaint("gains: {shoulder_active_joint: {<<: {p: 1}}}"),
             Contains("the merge key <<"));
  CHECK_THAT(complaint("? [a, b]\n: 1\n"), Contains("a list of 0 as a key, expected a word"));
  CHECK_THAT(complaint("? {a: b}\n: 1\n"), Contains("as a key, expected a word"));
  CHECK_THAT(complaint(": 1\n"), Contains("expected a word"));
}

TEST_CASE("what grows without end is stopped") {
  std::string bomb = "a: &a [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (char c = 'b'; c <= 'i'; ++c) {
    const std::string last(1, static_cast<char>(c - 1));
    std::string list;
    for (int k = 0; k < 10; ++k) list += "*" + last + ", ";
    bomb += std::string(1, c) + ": &" + std::string(1, c) + " [" + list + "]\n";
  }
  CHECK_THAT(complaint(bomb), Contains("it is too large, copies of aliases included"));
  CHECK_THAT(complaint("a: &a [1, *a]\n"), Contains("an alias inside its own anchor"));
  CHECK_THAT(complaint("a: " + std::string(100, '[') + std::string(100, ']')),
             Contains("nested too deeply"));
  CHECK_THAT(complaint("a: " + std::string(10000, '[')), Contains("test:1:"));
  CHECK_THAT(complaint("a: " + std::string(10000, '{')), Contains("test:1:"));
  CHECK_THAT(complaint("a: " + std::string(10000, '-')), Contains("test:1:"));
  std::string stairs;
  for (int k = 0; k < 200; ++k) stairs += std::string(static_cast<std::size_t>(k), ' ') + "a:\n";
  CHECK_THAT(complaint(stairs), Contains("nested too deeply"));
  // Aliases of aliases go deep, too.
  std::string chain = "a0: &a0 [[[[[[[[[1]]]]]]]]]\n";
  for (int k = 1; k < 5; ++k) {
    const std::string n = std::to_string(k), m = std::to_string(k - 1);
    chain += "a" + n + ": &a" + n + " [[[[[[[[*a" + m + "]]]]]]]]\n";
  }
  CHECK_THAT(complaint(chain), Contains("nested too deeply"));
  CHECK_THAT(complaint(std::string(ConfigSource::capacity + 1, ' ')),
             Contains("larger than 1 MiB"));
  std::string many = "a: [";
  for (int k = 0; k < 30000; ++k) many += "1,";
  CHECK_THAT(complaint(many + "]"), Contains("it is too large"));
  CHECK_THAT(complaint("a:\n  ros__parameters:\n    " + std::string(500, '.') + "z: 1\n"),
             Contains("too many dots"));
  std::string sections = "/**: {ros__parameters: {";
  for (int k = 0; k < 1000; ++k) sections += "k" + std::to_string(k) + ": 1, ";
  sections += "}}\n";
  for (int k = 0; k < 1000; ++k)
    sections += "s" + std::to_string(k) + ": {ros__parameters: {p: 1}}\n";
  CHECK_THAT(complaint(sections), Contains("too large, copies for wildcards included"));
}

TEST_CASE("unknown keys are answered with the known ones, the nearest first") {
  CHECK_THAT(complaint(gains + "gravitiy: {z: -9.8}\n"),
             Contains("test:4:1: gravitiy: unknown key 'gravitiy', expected one of gravity, gains, "
                      "priority, ...; did you mean 'gravity'?"));
  CHECK_THAT(
      complaint(joints + "shoulder_active_joint: {p: 1, iclamp: 3}\nelbow_active_joint: {p: 1}"),
      Contains("test:2:31: shoulder_active_joint.iclamp: unknown key 'iclamp', expected "
               "one of i_clamp, i_clamp_min, i_clamp_max, ...; did you mean 'i_clamp'?"));
  CHECK_THAT(complaint("joints: [shoulder_active_joint]\n" + gains),
             Contains("test:4:3: gains.elbow_active_joint: unknown key"));
  CHECK_THAT(complaint(gains + "chain: {rot: origin_link}\n"),
             Contains("expected one of root, tip; did you mean 'root'?"));
  CHECK_THAT(complaint(gains + "gravity: {z: -9.8, w: 1}\n"),
             Contains("gravity.w: unknown key 'w'"));
  CHECK_THAT(complaint(gains + "constraints: {elbow: {goal: 1}}\n"),
             Contains("constraints.elbow: unknown key"));
}

TEST_CASE("missing and superfluous joints are named") {
  CHECK(
      complaint("joints: [shoulder_active_joint]\nshoulder_active_joint: {p: 1}\n") ==
      "test:1:1: robot 'q2d' has the joint 'elbow_active_joint', which is missing, expected gains "
      "for each of its 2 joints");
  CHECK_THAT(complaint(joints + "shoulder_active_joint: {p: 1}\n"),
             Contains("test:1:33: joints[1]: joint 'elbow_active_joint' has no gains"));
  CHECK_THAT(complaint(joints + "shoulder_active_joint: {p: 1}\nelbow_active_joint: {i: 1}\n"),
             Contains("test:3:21: elbow_active_joint: the key 'p' is missing"));
  CHECK_THAT(complaint("gains: {shoulder_active_joint: {p: 1}, elbo_active_joint: {p: 1}}"),
             Contains("gains.elbo_active_joint: robot 'q2d' has no joint 'elbo_active_joint', "
                      "expected one of shoulder_active_joint, elbow_active_joint; did you mean "
                      "'elbow_active_joint'?"));
  CHECK_THAT(complaint("joints: [elbow_active_joint, elbow_active_joint]\ngains: {}\n"),
             Contains("test:1:30: joints[1]: 'elbow_active_joint' a second time"));
  CHECK_THAT(complaint(joints + "dof_names: [elbow_active_joint]\n" + gains),
             Contains("dof_names: 'joints' has the same meaning, expected one of the two keys"));
  CHECK_THAT(complaint(joints + gains + "elbow_active_joint: {p: 2}\n"),
             Contains("gains of 'elbow_active_joint' a second time"));
  CHECK_THAT(complaint(joints + "Kp: [1, 0.5, 0, 1]\nKd: [1, 1]\n"),
             Contains("test:2:9: Kp[1]: the number 0.5, expected 0 off the diagonal"));
  CHECK_THAT(complaint(joints + "Kp: [1, 2, 3]\nKd: [1, 1]\n"), Contains("a number for each of 2"));
  CHECK_THAT(complaint(joints + "Kp: [1, 2]\n"), Contains("the key 'Kd' is missing"));
}

TEST_CASE("gravity and chain must be the robot's") {
  CHECK(
      complaint(gains + "gravity: {x: 0, y: 0, z: -9.81}\n") ==
      "test:4:10: gravity: gravity (0, 0, -9.81) m/s^2 is not that of robot 'q2d', expected (0, 0, "
      "-9.8) in the frame of its base, or a robot with the file's gravity");
  CHECK_THAT(complaint(gains + "chain: {root: elbow_active_link}\n"),
             Contains("chain.root: the link 'elbow_active_link' moves"));
  CHECK_THAT(complaint(gains + "chain: {root: origin_link, tip: shoulder_passive_link}\n"),
             Contains("chain.tip: the chain to 'shoulder_passive_link' of robot 'q2d' leaves joint "
                      "'elbow_active_joint' out"));
  CHECK_THAT(complaint(gains + "chain: {tip: tool}\n"),
             Contains("robot 'q2d' has no link 'tool', expected one of origin_link"));
  CHECK(complaint(gains + "chain: {root: base_link, tip: elbow_active_link}\n") == "none");
}

TEST_CASE("which controller is meant must be clear") {
  const std::string two =
      "a:\n  ros__parameters: {gains: {}}\nb:\n  ros__parameters: {gains: {}}\n";
  CHECK_THAT(complaint(two), Contains("there are several: a in line 2, b in line 4") &&
                                 Contains("one of a, b by name"));
  CHECK_THAT(complaint(two, "c"), Contains("called 'c'") && Contains("one of a, b"));
  CHECK_THAT(complaint("a: {ros__parameters: {x: 1}}\n"),
             Contains("there is no controller with gains in it"));
  CHECK_THAT(complaint("a: {ros__parameters: 5}\n"), Contains("a.ros__parameters: the number 5"));
  CHECK_THAT(complaint("u:\n  one: {type: x/Y, joint: elbow_active_joint, pid: {p: 1}}\n"
                       "  two: {type: x/Y, joint: elbow_active_joint, pid: {p: 1}}\n"),
             Contains("test:3:27: u.two.joint: joint 'elbow_active_joint' is also in line 2"));
  CHECK_THROWS_WITH(load_controller_manager(yaml("a: {ros__parameters: {x: 1}}")),
                    Contains("there is no controller_manager in it"));
}

TEST_CASE("what belongs to no controller is noted") {
  const auto config = load_pid_gains(
      Q2d(), yaml("robot:\n  rate: 5\n  arm: {type: a/B, gains: {shoulder_active_joint: {p: 1}, "
                  "elbow_active_joint: {p: 1}}}\n"));
  REQUIRE(config.notes.size() == 1);
  CHECK(config.notes[0] == "test:2:3: robot.rate: not used, it belongs to no controller");
}

TEST_CASE("the controller manager's rate, types and thread") {
  const auto q2d = load_controller_manager(example_file("q2d_controllers.yaml"));
  CHECK(q2d.update_rate == 1000);
  CHECK(q2d.period() == 1e-3);
  CHECK(q2d.notes.empty());
  REQUIRE(q2d.controllers.size() == 4);
  CHECK(q2d.controllers[2].name == "pid_plus_gravity_controller");
  CHECK(q2d.controllers[2].type == "effort_controllers/PidPlusGravityController");

  const auto arm = load_controller_manager(config_file("arm_controllers.yaml"));
  CHECK(arm.update_rate == 100);
  CHECK(arm.notes.size() == 1);
  CHECK_FALSE(arm.thread_priority);

  const auto bare = load_controller_manager(
      yaml("controller_manager: {thread_priority: 50, cpu_affinity: [2, 3], lock_memory: true}\n"));
  CHECK(bare.update_rate == 100);
  CHECK(bare.thread_priority == 50);
  CHECK(bare.processors == std::vector<int>{2, 3});
  CHECK(bare.lock_memory == true);
  REQUIRE(bare.notes.size() == 1);
  CHECK_THAT(bare.notes[0], Contains("no update_rate is given: 100 Hz"));
  CHECK_THROWS_WITH(load_controller_manager(yaml("controller_manager: {update_rat: 5}")),
                    Contains("did you mean 'update_rate'?"));
}

TEST_CASE("constraints of the joint trajectory controller are tolerances") {
  const auto config = load_trajectory_tolerances(Q2d(), config_file("arm_controllers.yaml"));
  CHECK(config.name == "arm_controller");
  CHECK(config.tolerances.path_position == JointVector<2>(0.2, 0.1));
  CHECK(config.tolerances.goal_position == JointVector<2>(0.02, 0.01));
  CHECK(config.tolerances.stopped_velocity == JointVector<2>(0.01, 0.01));
  CHECK(config.tolerances.path_velocity.isZero());
  CHECK(config.tolerances.goal_time == 0);
  CHECK_FALSE(config.allow_partial_joints);
  CHECK(config.trajectory.interpolation == Interpolation::splines);
  CHECK(config.notes.size() == 5);  // one of them about the section of the pid_controller
  CHECK_FALSE(config.joints[0].gains);

  const auto other = load_trajectory_tolerances(
      Q2d(),
      yaml("joints: [elbow_active_joint, shoulder_active_joint]\ninterpolation_method: none\n"
           "allow_partial_joints_goal: true\nallow_integration_in_goal_trajectories: true\n"
           "allow_nonzero_velocity_at_trajectory_end: true\n"
           "constraints: {goal_time: 2, elbow_active_joint: {goal: 0.5}}\n"));
  CHECK(other.tolerances.goal_position == JointVector<2>(0, 0.5));
  CHECK(other.tolerances.goal_time == 2);
  CHECK(other.allow_partial_joints);
  CHECK(other.allow_integration);
  CHECK(other.trajectory.allow_motion_at_end);
  CHECK(other.trajectory.interpolation == Interpolation::none);
}
