// SPDX-License-Identifier: Apache-2.0
#include <articula/config/load_controller.hpp>
#include <articula/config/load_controller_manager.hpp>
#include <articula/config/load_pid_gains.hpp>
#include <articula/config/load_signals.hpp>
#include <articula/config/load_trajectory_tolerances.hpp>
#include <articula/robots/q2d.hpp>

#include <array>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "config_support.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::yaml;

namespace {

std::string complaint_of(auto load) {
  try {
    load();
  } catch (const FileError& error) {
    return error.what();
  }
  return "none";
}
std::string of_gains(const std::string& text) {
  return complaint_of([&] { static_cast<void>(load_pid_gains(Q2d(), yaml(text))); });
}
std::string of_waves(const std::string& text) {
  return complaint_of([&] { static_cast<void>(load_signals(Q2d(), yaml(text))); });
}
std::string of_manager(const std::string& text) {
  return complaint_of([&] { static_cast<void>(load_controller_manager(yaml(text))); });
}

/// A rod that turns without end, a slide that mimics it, and what is welded to them.
struct Spinner {
  static constexpr RobotDescription description{
      .name = "spinner",
      .gravity = {0, 0, -9.81},
      .links = std::to_array<Link>(
          {{.name = "base"},
           {.name = "rod", .mass = 1, .inertia = {.xx = 0.1, .yy = 0.1, .zz = 0.1}},
           {.name = "slide", .mass = 1, .inertia = {.xx = 0.1, .yy = 0.1, .zz = 0.1}},
           {.name = "tip"}}),
      .joints = std::to_array<Joint>({{.name = "pivot",
                                       .type = JointType::continuous,
                                       .parent = "base",
                                       .child = "rod",
                                       .axis = {0, 1, 0}},
                                      {.name = "follower",
                                       .type = JointType::prismatic,
                                       .parent = "rod",
                                       .child = "slide",
                                       .limits = {.lower = -1, .upper = 1},
                                       .mimic = {.joint = "pivot"}},
                                      {.name = "weld", .parent = "slide", .child = "tip"}})};
};

const std::string joints = "joints: [shoulder_active_joint, elbow_active_joint]\n";
const std::string shoulder = joints + "shoulder_active_joint: {p: 1}\n";

}  // namespace

TEST_CASE("a key that is nearly right is named before the one that seems to be missing") {
  for (const auto& [gains, key, meant] : {std::tuple{"{P: 1}", "P", "p"},
                                          {"{kp: 1, ki: 2, kd: 3}", "kp", "p"},
                                          {"{Kp: 1}", "Kp", "p"},
                                          {"{pidd: {p: 1}}", "pidd", "pid"},
                                          {"{PID: {p: 1}}", "PID", "pid"}}) {
    CHECK_THAT(of_gains(shoulder + "elbow_active_joint: " + gains),
               Contains("test:3:22: elbow_active_joint." + std::string(key) + ": unknown key '" +
                        key + "', expected one of ") &&
                   Contains("did you mean '" + std::string(meant) + "'?"));
  }
  // A value that is there is no slip, and a key that is like none is not why p is missing.
  CHECK_THAT(of_gains(shoulder + "elbow_active_joint: {i: 1, x: 2}"),
             Contains("test:3:21: elbow_active_joint: the key 'p' is missing"));
  CHECK_THAT(of_gains(joints + "Kp: [1, 1]\nkd: [1, 1]\n"),
             Contains("unknown key 'kd', expected one of ") && Contains("did you mean 'Kd'?"));
  CHECK_THAT(of_gains(shoulder + "elbow_active_joint: {p: 1}\ngravity: {x: 0, zz: -9.8}\n"),
             Contains("gravity.zz: unknown key 'zz'"));
  CHECK_THAT(of_waves("waveforms: {elbow_active_joint: {amplitud: 1, frequency: 1}}"),
             Contains("unknown key 'amplitud', expected one of amplitude, ") &&
                 Contains("did you mean 'amplitude'?"));
  CHECK_THAT(of_waves("waveforms: {elbow_active_joint: {amplitude: 1, freqency: 1}}"),
             Contains("unknown key 'freqency', expected one of frequency, ") &&
                 Contains("did you mean 'frequency'?"));
  CHECK_THAT(of_manager("controller_manager: {update_rate: 1, arm: {tpye: a/B}}"),
             Contains("controller_manager.arm.tpye: unknown key 'tpye', expected one of ") &&
                 Contains("did you mean 'type'?"));
  CHECK_THAT(of_manager("controller_manager: {update_rate: 1, arm: {}}"),
             Contains("controller_manager.arm: the key 'type' is missing"));
  CHECK_THAT(of_manager("controller_manager: {update_rate: 1, arm: }"),
             Contains("controller_manager.arm: nothing, expected a map"));
  CHECK_THAT(
      of_manager("controller_manager: {update_rate: 1, overrun: {manage: true}}"),
      Contains("unknown key 'overrun', expected one of ") && Contains("did you mean 'overruns'?"));
}

TEST_CASE("few keys are listed, the nearest") {
  CHECK(of_gains(shoulder + "elbow_active_joint: {p: 1, iclamp: 3}") ==
        "test:3:28: elbow_active_joint.iclamp: unknown key 'iclamp', expected one of "
        "i_clamp, i_clamp_min, i_clamp_max, ...; did you mean 'i_clamp'?");
  CHECK_THAT(of_gains(shoulder + "elbow_active_joint: {p: 1}\nzzzzzzzzzz: 1\n"),
             Contains("expected one of ") && Contains(", ..."));
}

TEST_CASE("joints that are missing or another robot's are found before their gains") {
  const std::string gains = "    shoulder_active_joint: {p: 1}\n    elbow_active_joint: {p: 1}\n";
  CHECK_THAT(of_gains("c:\n  ros__parameters:\n" + gains),
             Contains("c.ros__parameters: the key 'joints' is missing"));
  CHECK_THAT(
      of_gains("c:\n  ros__parameters:\n    joint_s: [a]\n" + gains),
      Contains("unknown key 'joint_s', expected one of ") && Contains("did you mean 'joints'?"));
  CHECK_THAT(complaint_of([] {
               static_cast<void>(load_trajectory_tolerances(
                   Q2d(), yaml("constraints: {elbow_active_joint: {goal: 0.1}}")));
             }),
             Contains("the key 'joints' is missing"));
  CHECK_THAT(of_gains("joints: [shoulder_active_joint, elbow_joint]\n"
                      "shoulder_active_joint: {p: 1}\nelbow_active_joint: {p: 1}\n"),
             Contains("test:1:33: joints[1]: robot 'q2d' has no joint 'elbow_joint', expected"));
  CHECK_THAT(of_gains(joints + "shoulder_active_joint: {p: 1}\n"),
             Contains("test:1:33: joints[1]: joint 'elbow_active_joint' has no gains"));
  for (const std::string key : {"p: [1, 2]", "p: 1", "pid: {elbow_active_joint: {p: 1}}"}) {
    CHECK_THAT(
        of_gains(joints + key + "\n"),
        Contains("gains of several joints at once, expected gains of each joint below its name, "
                 "such as shoulder_active_joint: {p: ...}"));
  }
  CHECK_THAT(of_gains("gains: [1, 2]"), Contains("gains: a list of 2, expected a map"));
}

TEST_CASE("messages state why a joint takes no commands") {
  const auto complaint = [](const std::string& joint) {
    return complaint_of([&] {
      static_cast<void>(load_pid_gains(Spinner(), yaml("gains: {" + joint + ": {p: 1}}")));
    });
  };
  CHECK(complaint("pivot") == "none");
  CHECK_THAT(complaint("follower"),
             Contains("joint 'follower' of robot 'spinner' mimics 'pivot', expected one of pivot"));
  CHECK_THAT(complaint("weld"), Contains("joint 'weld' of robot 'spinner' is fixed"));
  CHECK_THAT(complaint("pivott"), Contains("robot 'spinner' has no joint 'pivott', expected "
                                           "one of pivot; did you mean 'pivot'?"));
}

TEST_CASE("clamps have 0 between them and gains are not negative") {
  const auto complaint = [](const std::string& gains) {
    return of_gains(shoulder + "elbow_active_joint: {" + gains + "}\n");
  };
  for (const std::string clamp : {"i_clamp", "u_clamp"}) {
    CHECK_THAT(complaint("p: 1, i: 1, " + clamp + "_min: 27.94, " + clamp + "_max: 27.94"),
               Contains("test:3:") && Contains("elbow_active_joint." + clamp +
                                               "_min: the number 27.94, expected a number <= 0"));
    CHECK_THAT(
        complaint("p: 1, i: 1, " + clamp + "_max: -5"),
        Contains("elbow_active_joint." + clamp + "_max: the number -5, expected a number >= 0"));
    CHECK(complaint("p: 1, " + clamp + "_min: 0, " + clamp + "_max: 0") == "none");
  }
  CHECK(complaint("p: -1") ==
        "test:3:25: elbow_active_joint.p: the number -1, expected a number >= 0");
  CHECK_THAT(complaint("p: 1, i: -2"), Contains(".i: the number -2, expected a number >= 0"));
  CHECK_THAT(complaint("p: 1, d: -3"), Contains(".d: the number -3, expected a number >= 0"));
  CHECK_THAT(of_gains(joints + "Kp: [1, -1]\nKd: [1, 1]\n"),
             Contains("Kp[1]: the number -1, expected a number >= 0"));
}

TEST_CASE("numbers that no double holds are numbers") {
  for (const std::string number : {"1e999", "-1e999", "1e-400"}) {
    CHECK_THAT(of_gains(shoulder + "elbow_active_joint: {p: " + number + "}"),
               Contains("elbow_active_joint.p: the number " + number +
                        ", which is beyond the range of double, expected a number"));
  }
}

TEST_CASE("ros__parameters is spelt so, and below a name") {
  const std::string below = "\n    joints: [shoulder_active_joint, elbow_active_joint]\n";
  for (const std::string key :
       {"ros_parameters:", "ros__parameter:", "ROS__parameters:", "ros___parameters:"}) {
    INFO(key);
    const std::string text = "c:\n  " + key + below;
    CHECK_THAT(of_gains(text), Contains("test:2:3: c.ros") || Contains("test:2:3: c.ROS"));
    CHECK_THAT(of_gains(text), Contains("unknown key '") && Contains("expected 'ros__parameters'"));
  }
  CHECK_THAT(of_manager("controller_manager:\n  ros_parameters: {update_rate: 1}\n"),
             Contains("expected 'ros__parameters'"));
  CHECK_THAT(
      of_gains("ros__parameters: {joints: [a]}\n"),
      Contains("test:1:1: ros__parameters: 'ros__parameters' at the top, expected it below"));
}

TEST_CASE("a section named after a joint is one of those that count") {
  CHECK_THAT(of_gains("shoulder_active_joint: {p: 1, i: 2}\nelbow_active_joint: {P: 1, i: 2}\n"),
             Contains("test:2:22: elbow_active_joint.P: unknown key 'P', expected one of ") &&
                 Contains("did you mean 'p'?"));
  CHECK_THAT(of_waves("shoulder_active_joint: {amplitude: 1, frequency: 1}\n"
                      "elbow_active_joint: {amplitud: 1, frequency: 1}\n"),
             Contains("test:2:22: elbow_active_joint.amplitud: unknown key 'amplitud'"));
}

TEST_CASE("sections that are not used are noted where none was asked for by name") {
  const std::string gains =
      "a: {ros__parameters: {gains: {shoulder_active_joint: {p: 1}, elbow_active_joint: {p: 1}}}}\n"
      "b: {ros__parameters: {gain: {elbow_active_joint: {p: 1}}}}\n"
      "controller_manager: {update_rate: 1}\n";
  const auto config = load_pid_gains(Q2d(), yaml(gains));
  REQUIRE(config.notes.size() == 1);
  CHECK(config.notes[0] == "test:2:5: b.ros__parameters: not used, it is no controller with gains");
  CHECK(load_pid_gains(Q2d(), yaml(gains), "a").notes.empty());

  const auto waves = load_signals(
      Q2d(), yaml("a: {waveforms: {elbow_active_joint: {amplitude: 1, frequency: 1}}}\n"
                  "b: {signals: {shoulder_active_joint: {amplitude: 1, frequency: 1}}, x: 1}\n"));
  CHECK(waves.signals.size() == 1);
  REQUIRE(waves.notes.size() == 1);
  CHECK(waves.notes[0] == "test:2:1: b: not used, it is no section of waveforms");
}

TEST_CASE("which way round is noted where the file and the joint say different things") {
  const auto notes = [](const auto& robot, const std::string& text) {
    return load_pid_gains(robot, yaml(text)).notes;
  };
  for (const std::string key : {"angle_wraparound", "normalize_error"}) {
    CHECK(notes(Spinner(), "gains: {pivot: {p: 1, " + key + ": true}}").empty());
    const auto kept = notes(Spinner(), "gains: {pivot: {p: 1, " + key + ": false}}");
    REQUIRE(kept.size() == 1);
    CHECK(kept[0] == "test:1:" + std::to_string(25 + key.size()) + ": gains.pivot." + key +
                         ": not used: continuous joints take the short way round, others do not");
    CHECK(notes(Q2d(), shoulder + "elbow_active_joint: {p: 1, " + key + ": false}").empty());
    CHECK(notes(Q2d(), shoulder + "elbow_active_joint: {p: 1, " + key + ": true}").size() == 1);
  }
  CHECK_THAT(of_gains(shoulder +
                      "elbow_active_joint: {p: 1, angle_wraparound: true, normalize_error: false}"),
             Contains("'angle_wraparound' has the same meaning, expected one of the two keys"));
}

TEST_CASE("a decimal comma is named") {
  const auto elbow = [](const std::string& gains) {
    return of_gains(shoulder + "elbow_active_joint: {" + gains + "}\n");
  };
  CHECK(of_gains(joints + "shoulder_active_joint:\n  p: 1,5\n") ==
        "test:3:6: shoulder_active_joint.p: the word '1,5', expected a number; write 1.5 if "
        "the comma is a decimal one");
  // In braces, YAML takes the comma for the end of the value.
  const std::string braces =
      "test:3:27: elbow_active_joint.5: unknown key '5', expected a decimal point, if the comma "
      "before it is a decimal one";
  CHECK(elbow("p: 1,5") == braces);
  CHECK(elbow("p: 1,5, d: 2") == braces);
  CHECK_THAT(elbow("ff_velocity_scale: -2,5e-1"),
             Contains("unknown key '5e-1', expected a decimal point"));  // and p misses
  CHECK_THAT(elbow("p: 1, 5: 2"), Contains("unknown key '5'"));
  CHECK_THAT(of_gains(shoulder + "elbow_active_joint: {p: 1}\ngravity: [0, 0, -9,8]\n"),
             Contains("gravity: a list of 4, expected three numbers with decimal points"));
  CHECK_THAT(of_waves("waveforms: {elbow_active_joint: {amplitude: 1,5, frequency: 1}}"),
             Contains("elbow_active_joint.5: unknown key '5', expected a decimal point"));
  CHECK_THAT(of_manager("controller_manager:\n  update_rate: 1,5\n"),
             Contains("expected a whole number from 1 to 1000000; write 1.5 if"));
}

TEST_CASE("marks between thousands are refused, and what may be a decimal comma is named") {
  const auto alone = [](const std::string& number) {
    return of_gains(joints + "shoulder_active_joint:\n  p: " + number + "\n");
  };
  const auto braces = [](const std::string& number) {
    return of_gains(shoulder + "elbow_active_joint: {p: " + number + ", d: 1}\n");
  };
  CHECK(alone("1,000") ==
        "test:3:6: shoulder_active_joint.p: the word '1,000', expected a number; write 1.000 if "
        "the comma is a decimal one");
  CHECK_THAT(braces("1,000"), Contains("test:3:27: elbow_active_joint.000: unknown key '000', "
                                       "expected a decimal point, if the comma before"));
  for (const auto& [number, meant] :
       {std::pair{"12,500", "12.500"}, {"0,125", "0.125"}, {"1,0000", "1.0000"}}) {
    CHECK_THAT(alone(number), Contains(std::string("; write ") + meant + " if the comma is"));
  }
  CHECK_THAT(of_manager("controller_manager:\n  update_rate: 1,000\n"), Contains("write 1.000"));
  for (const std::string number :
       {"1,234,567", "1,234.5", "1.000,5", "1.234.567", "1'000", "1_000", "1 000"}) {
    INFO(number);
    CHECK_THAT(alone(number), Contains("the word '" + number + "', expected a number"));
    CHECK_THAT(braces(number), Contains("test:3:") && Contains("elbow_active_joint."));
  }
  CHECK_THAT(of_waves("waveforms: {elbow_active_joint: {amplitude: 1,000, frequency: 1}}"),
             Contains("elbow_active_joint.000: unknown key '000', expected a decimal point"));
  CHECK_THAT(
      of_gains(shoulder + "elbow_active_joint: {p: 1}\npriority: 100\n"),
      Contains("the number 100, expected a whole number from 0 to 99") && !Contains("to 99 "));
}

TEST_CASE("messages name units, expressions and quotation marks around numbers") {
  const auto p = [](const std::string& value) {
    return of_gains(joints + "shoulder_active_joint:\n  p: " + value + "\n");
  };
  for (const std::string value : {"5;", "5,", "5%"}) {
    CHECK_THAT(p(value), Contains("'" + value + "', expected a number; write the number alone, 5"));
  }
  for (const std::string value : {"5 Nm", "5N", "30deg"}) {
    CHECK_THAT(p(value), Contains("'" + value +
                                  "', expected a number; write a number in SI units, and no unit"));
  }
  CHECK_THAT(p("\"5\""), Contains("the quoted text '5', expected a number without quotes"));
  for (const std::string value : {"1/2", "2*3", "pi/2"}) {
    CHECK_THAT(p(value), Contains("expected a number; expressions are not computed"));
  }
  CHECK_THAT(p("N/A"), Contains("the word 'N/A', expected a number") && !Contains("computed"));
  CHECK_THAT(p("\xEF\xBC\x91"), Contains("; U+FF11 is no ASCII character"));
  CHECK_THAT(p("\xE2\x80\x9C"
               "5"),
             Contains("U+201C is no ASCII"));
  CHECK_THAT(p("5\xE9"), Contains("; a byte of it is not UTF-8"));
  CHECK_THAT(of_gains("joints: shoulder_active_joint, elbow_active_joint\n"),
             Contains("expected a list in brackets, [shoulder_active_joint, elbow_active_joint]"));
  CHECK_THAT(of_gains("joints:\n  - shoulder_active_joint\n  -elbow_active_joint\n"),
             Contains("test:3:3: it is not YAML") && Contains("expected a blank behind the dash"));
  CHECK_THAT(of_manager("controller_manager: {update_rate: 1, arm: a/B}\n"),
             Contains("controller_manager.arm: the word 'a/B', expected a map with the type in it, "
                      "{type: a/B}"));
  CHECK(of_manager("controllermanager:\n  ros__parameters: {update_rate: 1}\n") ==
        "test: there is no controller_manager in it, expected one, in place of "
        "'controllermanager'");
}

TEST_CASE("decimal commas in the matrices of computed torque are refused") {
  const auto kp = [](const std::string& list) {
    return of_gains(joints + "Kp: " + list + "\nKd: [1, 1]\n");
  };
  CHECK(
      kp("[1,5, 2,5]") ==
      "test:2:5: Kp: a list of 4, expected a number for each of 2 joints with decimal points, or a "
      "matrix by rows with a blank behind every comma");
  CHECK_THAT(kp("[1,5,2,5]"), Contains("Kp[1]: the number 5, expected 0 off the diagonal"));
  CHECK_THAT(kp("[1,5, 2]"), Contains("a list of 3") && Contains("with decimal points"));
  CHECK_THAT(kp("[1.5, 2, 3]"), Contains("a list of 3, expected a number for each of 2 joints"));
  CHECK_THAT(of_gains(joints + "Kp: [1, 1]\nKd: [0,5, 0,5]\n"),
             Contains("test:3:5: Kd: a list of 4") && Contains("with decimal points"));
  // This may be both: 1.0 and 0.5, or a matrix with 1 and 5 on its diagonal.
  CHECK_THAT(
      kp("[1,0, 0,5]"),
      Contains("a number for each of 2 joints with decimal points, or a matrix by rows with a "
               "blank behind every comma"));
  for (const std::string matrix : {"[1, 0, 0, 5]", "[1,0,0,5]", "[1.0,0.0, 0.0,5.0]"}) {
    CHECK(kp(matrix) == "none");
  }
  CHECK_THAT(kp("[1, 0,\n     0, 5]"), Contains("none"));
  CHECK(kp("[1,0,\n     0,5]") == "none");  // a line for each row
  CHECK(kp("[1, 1]\nqos_overrides: {}\nstart_type_description_service: true") == "none");
  const std::string one = "joints: [pivot]\n";
  const auto spinner = [&](const std::string& list) {
    return complaint_of([&] {
      static_cast<void>(load_pid_gains(Spinner(), yaml(one + "Kp: " + list + "\nKd: [1]\n")));
    });
  };
  CHECK(spinner("[15]") == "none");
  CHECK_THAT(spinner("[1,5]"), Contains("a number for each of 1 joint with decimal points"));
}

TEST_CASE("placeholders without a value are named") {
  const auto p = [](const std::string& value) {
    return of_gains(joints + "shoulder_active_joint:\n  p: " + value + "\n");
  };
  const auto in_braces = [](const std::string& value) {
    return of_gains(shoulder + "elbow_active_joint: {p: " + value + "}\n");
  };
  const std::string unfilled = "' without a value, expected ";
  for (const std::string value : {"${kp}", "$(find pkg)", "$kp", "$(arg a) 1", "<kp>", "<%= kp %>",
                                  "\"{{ kp }}\"", "'@kp@'"}) {
    INFO(value);
    CHECK_THAT(p(value), Contains("test:3:6: shoulder_active_joint.p: the placeholder '") &&
                             Contains(unfilled + "a number"));
  }
  const std::string its_value =
      "its value: ConfigSource(file, {{\"kp\", \"...\"}}), or articula run --value kp=...";
  for (const std::string value : {"{{ kp }}", "{{kp}}"}) {
    CHECK(p(value) ==
          "test:3:7: shoulder_active_joint.p: the placeholder '" + value + unfilled + its_value);
    CHECK(in_braces(value) ==
          "test:3:26: elbow_active_joint.p: the placeholder '" + value + unfilled + its_value);
  }
  for (const std::string value : {"@kp@", "%kp%"}) {
    const std::string expected =
        "expected the placeholder '" + value + "' in line 3 to be replaced by a template tool";
    CHECK_THAT(p(value), Contains("test:3:6: it is not YAML") && Contains(expected));
    CHECK_THAT(in_braces(value), Contains("test:3:25: it is not YAML") && Contains(expected));
  }
  CHECK_THAT(of_gains("gains: {\n  a: {p: ${p}},\n  b: {p: 1}}\n"),
             Contains("it is not YAML") && Contains("the placeholder '${p}' in line 2"));
  CHECK_THAT(of_gains("{% for j in joints %}\n{{ j }}: {p: 1}\n{% endfor %}\n"),
             Contains("test:1:2: it is not YAML") && Contains("'{% for j in joints %}' in line 1"));
  // YAML passes over lines that begin with % and hold no %YAML.
  CHECK(of_gains(joints + "%gains%\n") == "test:2:1: the placeholder '%gains%" + unfilled +
                                              "its value: ConfigSource(file, {{\"gains\", "
                                              "\"...\"}}), or articula run --value gains=...");
  CHECK_THAT(of_gains("% gains of the arm\n" + shoulder),
             Contains("test:1:1: a % at the beginning of the line"));
  CHECK(of_gains("%YAML 1.2\n---\n" + shoulder + "elbow_active_joint: {p: 1}\n") == "none");
  for (const std::string name :
       {"\"{{ joint }}\"", "<joint>", "$(var prefix)elbow", "\"${a}elbow\""}) {
    INFO(name);
    CHECK_THAT(
        of_gains("joints: [shoulder_active_joint, " + name + "]\n"),
        Contains("test:1:33: joints[1]: the placeholder '") && Contains(unfilled + "a name"));
    CHECK_THAT(complaint_of([&] { static_cast<void>(load_controller(yaml("joint: " + name))); }),
               Contains("test:1:8: joint: the placeholder '"));
  }
  // What is not used may have them, and comments.
  CHECK(of_gains(shoulder + "elbow_active_joint: {p: 1}  # <kp> @kp@\n" +
                 "robot_description: $(find arm)/arm.urdf\n") == "none");
}

TEST_CASE("characters that look like others are named") {
  const auto p = [](const std::string& value) {
    return of_gains(joints + "shoulder_active_joint:\n  p: " + value + "\n");
  };
  CHECK_THAT(p("\xE2\x88\x92"
               "1"),
             Contains("expected a number; write an ordinary minus sign, -"));
  CHECK_THAT(of_gains(shoulder + "elbow_active_joint: {p: 1, u_clamp_max: inf}"),
             Contains("u_clamp_max: the word 'inf', expected a number; infinity is .inf"));
  CHECK_THAT(of_gains(joints + "shoulder_active_joint:\n  p\xEF\xBC\x9A 1\n"),
             Contains("expected a map, and an ordinary colon and a blank"));
  CHECK_THAT(of_gains(joints + "shoulder_active_joint: {p:1, d:2}\n"),
             Contains("test:2:25: shoulder_active_joint.p:1: unknown key 'p:1', expected a blank "
                      "behind the colon"));
  CHECK_THAT(of_gains(joints + "shoulder_active_joint:\n  p:1\n"),
             Contains("the word 'p:1', expected a map, and a blank behind the colon"));
  CHECK_THAT(of_gains(joints + "shoulder_active_joint: {p=1}\n"),
             Contains("unknown key 'p=1', expected a colon and a blank in place of '='"));
  CHECK(of_gains(std::string("\xFF\xFE"
                             "j\0",
                             4)) ==
        "test:1:4: a NUL character, expected UTF-8 text (UTF-16 is not supported)");
  std::string wide, wider;
  for (const char c : shoulder) {
    wide += {c, '\0'};
    wider += {'\0', c};
  }
  for (const std::string& text : {wide, wider}) {
    CHECK_THAT(of_gains(text),
               Contains("test:1:") && Contains("a NUL character, expected UTF-8 text"));
  }
  // Carriage returns alone end lines as well.
  CHECK_THAT(of_gains("joints: [shoulder_active_joint, elbow_active_joint]\r"
                      "shoulder_active_joint: {p: 1}\relbow_active_joint: {p: many}\r"),
             Contains("test:3:25: elbow_active_joint.p: the word 'many'"));
}

TEST_CASE("characters that look like blanks and are letters to YAML are named") {
  for (const auto& [odd, name] : {std::pair<std::string, std::string>{"\xC2\xA0",
                                                                      "a no-break space "
                                                                      "(U+00A0)"},
                                  {"\xE2\x80\x8B", "a zero-width space (U+200B)"},
                                  {"\xEF\xBB\xBF", "a byte order mark (U+FEFF)"},
                                  {"\xE2\x80\xAF", "a narrow no-break space (U+202F)"},
                                  {"\xE3\x80\x80", "an ideographic space (U+3000)"}}) {
    INFO(name);
    const std::string code = "<" + name.substr(name.find('(') + 1, 6) + ">";
    const std::string expected = " with " + name + ", expected ";
    for (const std::string& value : {odd + "1", "1" + odd}) {
      CHECK_THAT(of_gains(joints + "shoulder_active_joint:\n  p: " + value + "\n"),
                 Contains("test:3:6: shoulder_active_joint.p: the word '") && Contains(code) &&
                     Contains(expected + "a number"));
    }
    CHECK_THAT(of_gains("joints: [shoulder_active_joint, elbow_active_joint" + odd + "]\n"),
               Contains("test:1:33: joints[1]: the word 'elbow_active_joint" + code + "'" +
                        expected + "a name"));
    // As indentation, before and behind a key, instead of the blank behind a colon.
    CHECK_THAT(of_gains(joints + "shoulder_active_joint:\n" + odd + "p: 1\n"),
               Contains("test:3:1: the key '" + code + "p'" + expected + "an ordinary blank"));
    CHECK_THAT(of_gains(shoulder + "elbow_active_joint" + odd + ": {p: 1}\n"),
               Contains("test:3:1: the key 'elbow_active_joint" + code + "'" + expected));
    CHECK_THAT(of_gains(shoulder + "elbow_active_joint: {p:" + odd + "1}\n"),
               Contains("test:3:22: elbow_active_joint: the key 'p:" + code + "1'" + expected));
    CHECK_THAT(
        of_gains(shoulder + "elbow_active_joint: {p: 1} " + odd + "\n"),
        Contains("test:3:") && Contains("it is not YAML") && Contains("in place of " + name));
    // In a comment they do no harm.
    CHECK(of_gains(shoulder + "elbow_active_joint: {p: 1}  #" + odd + "\n") == "none");
  }
  CHECK(of_gains(joints + "shoulder_active_joint:\n  \tp: 1\n") ==
        "test:3:3: a tab in the indentation, expected spaces");
}

TEST_CASE("messages about waveforms below a joint state where they belong") {
  const std::string expected =
      "expected 'waveforms' in the section itself, and the joints below it: waveforms: "
      "{elbow_active_joint: {amplitude: ..., frequency: ...}}";
  for (const std::string wave :
       {"waveforms: [{amplitude: 1, frequency: 1}]", "waveforms: {amplitude: 1, frequency: 1}",
        "amplitude: 1, frequency: 1", "type: step, height: 1"}) {
    INFO(wave);
    CHECK(of_waves("c:\n  joint: elbow_active_joint\n  elbow_active_joint: {" + wave + "}\n") ==
          "test:3:3: c.elbow_active_joint: waveforms below 'elbow_active_joint', " + expected);
    CHECK(of_waves("c:\n  ros__parameters:\n    elbow_active_joint: {" + wave + "}\n") ==
          "test:3:5: c.ros__parameters.elbow_active_joint: waveforms below 'elbow_active_joint', " +
              expected);
  }
  // A section that is a joint's may have them.
  CHECK(of_waves("c: {elbow_active_joint: {waveforms: [{amplitude: 1, frequency: 1}]}}") == "none");
  CHECK_THAT(of_waves("waveforms: {type: sine, amplitude: 1}"),
             Contains("waveforms.type: robot 'q2d' has no joint 'type', expected one of shoulder"));
}

TEST_CASE("a waveform with another shape's keys is refused with its own") {
  const auto wave = [](const std::string& keys) {
    return of_waves("waveforms:\n  elbow_active_joint: {" + keys + "}\n");
  };
  const auto missing = [](const std::string& key, const std::string& unknown) {
    return "test:2:23: waveforms.elbow_active_joint: the key '" + key +
           "' is missing, expected it in this map; its key '" + unknown + "' is unknown";
  };
  CHECK(wave("type: ramp, rate: 1, duration: 2") == missing("height", "rate"));
  CHECK(wave("type: ramp, height: 1, rate: 2") == missing("duration", "rate"));
  CHECK(wave("type: ramp, height: 1, duration: 2, rate: 2") ==
        "test:2:60: waveforms.elbow_active_joint.rate: unknown key 'rate', expected one of "
        "duration, target, type, ...");
  CHECK(wave("type: step, amplitude: 1") == missing("height", "amplitude"));
  CHECK(wave("type: chirp, amplitude: 1, f0: 1") == missing("first_frequency", "f0"));
  CHECK(wave("amplitude: 1, omega: 1") == missing("frequency", "omega"));
  CHECK_THAT(wave("type: ramp, heigth: 1, duration: 2"),
             Contains("unknown key 'heigth', expected one of height, ") &&
                 Contains("; did you mean 'height'?"));
}

TEST_CASE("a file without any waveform is refused, one with some may have empty places") {
  const std::string such =
      ", expected waveforms, such as <joint>: {amplitude: ..., frequency: ...}";
  CHECK(of_waves("waveforms: []") == "test:1:12: waveforms: an empty list" + such);
  CHECK(of_waves("c:\n  waveforms: {}\n") == "test:2:14: c.waveforms: an empty map" + such);
  CHECK(of_waves("waveforms: {elbow_active_joint: []}") ==
        "test:1:33: waveforms.elbow_active_joint: an empty list" + such);
  const auto some = load_signals(
      Q2d(), yaml("c: {waveforms: []}\n"
                  "d: {waveforms: {elbow_active_joint: {amplitude: 1, frequency: 1}}}\n"));
  CHECK(some.signals.size() == 1);
  CHECK(some.notes ==
        std::vector<std::string>{"test:1:16: c.waveforms: there is no waveform in it"});

  const std::string wave = ": {elbow_active_joint: {amplitude: 1, frequency: 1}}\n";
  for (const std::string key : {"waveform", "Waveform", "wave_forms", "WAVEFORMS", "wavefroms"}) {
    CHECK(of_waves("c:\n  ros__parameters:\n    " + key + wave) ==
          "test:3:5: c.ros__parameters." + key + ": unknown key '" + key +
              "', expected 'waveforms'");
    CHECK_THAT(of_waves(key + ": []\n"), Contains("unknown key '" + key + "'"));
  }
  // As the name of a section it is as good as any.
  CHECK(of_waves("waveform" + wave) == "none");
  CHECK_THAT(of_waves("amplitude: 1\nfrequency: 1\n"), Contains("the key 'joint' is missing"));
}

TEST_CASE("what is there is named where something is missing") {
  CHECK(of_gains(shoulder + "elbow_active_joint: {waveforms: []}\n") ==
        "test:3:21: elbow_active_joint: the key 'p' is missing, expected it in this map; its key "
        "'waveforms' is unknown");
  CHECK(of_gains("a: {ros__parameters: {joints: [x]}}\nb: {ros__parameters: {joints: [x]}}\n") ==
        "test: there is no controller with gains in it, expected one besides a, b");
  CHECK(of_manager("gains: {elbow_active_joint: {p: 1}}\n") ==
        "test: there is no controller_manager in it, expected one");
  CHECK(of_gains("a:\n  ros__parameters:\n  joints: [x]\n") ==
        "test:2:3: a.ros__parameters: nothing, expected a map of parameters, further to the right");
}
