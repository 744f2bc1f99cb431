// SPDX-License-Identifier: Apache-2.0
/// @file What the packages of robots and grippers bring along: placeholders, sections of which
/// nothing is known, and sections that say nothing.
#include <articula/config/load_controller_manager.hpp>
#include <articula/config/load_pid_gains.hpp>
#include <articula/config/load_signals.hpp>
#include <articula/config/load_trajectory_tolerances.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/robots/ur10.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "catch.hpp"
#include "config_support.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::config_file;
using support::yaml;

namespace {

const std::string ur = CONFIG_FILES "ur_driver_controllers.yaml";
const std::string trajectory = "joint_trajectory_controller";

bool has_note(const std::vector<std::string>& notes, const std::string& part) {
  return std::any_of(notes.begin(), notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

template <class F>
std::string complaint_of(F load) {
  try {
    static_cast<void>(load());
  } catch (const FileError& error) {
    return error.what();
  }
  return "none";
}

/// A controller of the Q2D in the layout of ROS 2.
const std::string arm =
    "arm:\n  ros__parameters:\n    joints: [shoulder_active_joint, elbow_active_joint]\n"
    "    gains: {shoulder_active_joint: {p: 1}, elbow_active_joint: {p: 2}}\n"
    "    constraints: {goal_time: 3}\n";
const std::string manager =
    "controller_manager: {ros__parameters: {update_rate: 250, arm: {type: a/B}}}\n";

}  // namespace

TEST_CASE("the driver of Universal Robots with and without a prefix") {
  const auto config =
      load_trajectory_tolerances(Ur10(), ConfigSource(ur, {{"tf_prefix", ""}}), trajectory);
  CHECK(config.tolerances.path_position[0] == 0.2);
  CHECK(config.tolerances.path_position[2] == 0.3);
  CHECK(config.tolerances.stopped_velocity[5] == 0.2);
  const auto left = load_controller({ur, {{"tf_prefix", "left_"}}}, trajectory);
  REQUIRE(left.joints.size() == 6);
  CHECK(left.joints[2].name == "left_elbow_joint");
  CHECK(left.joints[2].path_tolerance == 0.3);
  for (const std::string name :
       {"scaled_joint_trajectory_controller", "passthrough_trajectory_controller"}) {
    CHECK(load_controller({ur, {{"tf_prefix", "left_"}}}, name).joints[0].name ==
          "left_shoulder_pan_joint");
  }
  CHECK(load_controller({ur, {{"tf_prefix", ""}}}, "joint_state_broadcaster").joints.empty());
  // The manager has no placeholder, and does not mind those of others.
  CHECK(load_controller_manager(ur).update_rate == 500);
  CHECK(load_controller_manager({ur, {{"tf_prefix", "x"}}}).controllers.size() == 6);
}

TEST_CASE("a placeholder without a value is named, and how to give it") {
  const std::string how =
      "ConfigSource(file, {{\"tf_prefix\", \"...\"}}), or articula run --value tf_prefix=...";
  CHECK(complaint_of([] { return load_controller(ur, trajectory); }) ==
        ur +
            ":33:14: joint_trajectory_controller.ros__parameters.joints[0]: the placeholder "
            "'$(var tf_prefix)' without a value, expected a name, or a "
            "value for it: " +
            how);
  CHECK_THAT(complaint_of([] { return load_controller({ur, {{"prefix", ""}}}, trajectory); }),
             Contains("'$(var tf_prefix)'") && Contains(how + "; there are values for 'prefix'"));
  CHECK_THAT(complaint_of([] {
               const std::string joints = "joints: [elbow_active_joint]\nconstraints: ";
               return load_trajectory_tolerances(
                   Q2d(), ConfigSource::text(joints + "{$(var x)elbow: {goal: 1}}\n", "test",
                                             {{"y", "1"}, {"z", "2"}}));
             }),
             Contains("unknown key '$(var x)elbow'") && Contains("values for 'y', 'z'"));
  const auto keys = [](const std::string& key) {
    return complaint_of([&] {
      return load_trajectory_tolerances(
          Q2d(), yaml("joints: [elbow_active_joint]\nconstraints: {" + key + ": {goal: 1}}\n"));
    });
  };
  CHECK_THAT(keys("$(var tf_prefix)elbow"),
             Contains("unknown key '$(var tf_prefix)elbow'") && Contains(how));
  CHECK_THAT(complaint_of([] {
               return load_signals(
                   Q2d(), yaml("waveforms: {$(var tf_prefix)elbow: {amplitude: 1, frequency: 1}}"));
             }),
             Contains("has no joint '$(var tf_prefix)elbow', expected") && Contains(how));
}

TEST_CASE("values fill in all kinds of placeholders, in all that loads") {
  const auto of = [](const std::string& text, const ConfigValues& values) {
    return ConfigSource::text(text, "test", values);
  };
  for (const std::string placeholder :
       {"$(var x)", "$(arg x)", "$( var  x )", "${x}", "${ x }", "{{ x }}", "{{x}}", "@x@", "%x%",
        "<x>", "<%= x %>", "$x"}) {
    INFO(placeholder);
    const ConfigValues values = {{"x", "3"}};
    const std::string joints = "joints: [elbow_active_joint]\n";
    CHECK(load_controller(of(joints + "elbow_active_joint: {p: " + placeholder + "}\n", values))
              .joints[0]
              .gains->proportional == 3);
    CHECK(load_pid_gains(Q2d(), of("elbow_active_joint: {p: " + placeholder + "}\n", values), "",
                         GainsOf::some_joints)
              .gains[1]
              .proportional == 3);
    CHECK(load_trajectory_tolerances(
              Q2d(), of(joints + "constraints: {goal_time: " + placeholder + "}\n", values))
              .tolerances.goal_time == 3);
    CHECK(load_controller_manager(of("update_rate: " + placeholder + "\n", values)).update_rate ==
          3);
    CHECK(load_signals(Q2d(), of("waveforms: {elbow_active_joint: {frequency: 1, amplitude: " +
                                     placeholder + "}}\n",
                                 values))
              .signals.size() == 1);
  }
  CHECK(load_controller(of("joint: $(env ARM)_$(find-pkg-share arm)\np: 1\n",
                           {{"env ARM", "left"}, {"find-pkg-share arm", "elbow"}}))
            .joints[0]
            .name == "left_elbow");
  // What has no value stays as it is, and a value is not filled in again.
  CHECK_THAT(
      complaint_of([&] {
        return load_controller(of("joint: $(var a)\np: 1\n", {{"a", "$(var b)"}, {"b", "c"}}));
      }),
      Contains("the placeholder '$(var b)'"));
  // Lines and columns are those of the file, in which the value is not.
  CHECK_THAT(complaint_of([&] {
               return load_controller(of("joint: elbow\npid: {p: $(var a), i: $(var a), d: many}\n",
                                         {{"a", "123456789.25"}}));
             }),
             Contains("test:2:36: pid.d: the word 'many'"));
  CHECK_THAT(complaint_of([&] {
               return load_controller(of("joint: elbow\npid: {i: $(var a)$(var b), p: 1}\n",
                                         {{"a", ""}, {"b", "many"}}));
             }),
             Contains("test:2:10: pid.i: the word 'many'"));
  CHECK_THAT(
      complaint_of([&] { return load_controller(of("joint: $(var a)\n", {{"a", "b\nc"}})); }),
      Contains("the value of 'a' has a line break or tab"));
}

TEST_CASE("a gripper, sections that say nothing, values between them") {
  const auto file = config_file("parallel_gripper_controllers.yaml");
  CHECK(load_controller_manager(file).controllers.size() == 3);
  const auto loaded = load_pid_gains(Q2d(), file, "", GainsOf::some_joints);
  CHECK(loaded.gains[1].derivative == 0.5);
  CHECK(has_note(loaded.notes, "servo: not used, it belongs to no controller"));
  const std::string text =
      "gripper_controller:\n  ros__parameters:\n    joint: elbow_active_joint\n"
      "    gains: {elbow_active_joint: {p: 5}}\n    max_effort: 25\n    max_velocity: 0.15\n"
      "    max_effort_interface: elbow_active_joint/max_effort\n    max_velocity_interface: \"\"\n";
  const auto gripper = load_pid_gains(Q2d(), yaml(text), "", GainsOf::some_joints);
  CHECK(gripper.gains[1].proportional == 5);
  for (const std::string key :
       {"max_effort", "max_velocity", "max_effort_interface", "max_velocity_interface"}) {
    CHECK(has_note(gripper.notes, "gripper_controller.ros__parameters." + key + ": not used"));
  }
  CHECK_THROWS_WITH(load_controller(yaml(text + "    max_velocit: 1\n")),
                    Contains("unknown key 'max_velocit', expected one of max_velocity, max_effort, "
                             "max_velocity_interface, ...; did you mean 'max_velocity'?"));
}

TEST_CASE("no unrelated section is a reason to refuse a file") {
  for (const std::string other :
       {"joint_state_broadcaster: {ros__parameters: }\n",
        "joint_state_broadcaster:\n  ros__parameters:\n",
        "b: {ros__parameters: {}}\n",
        "b: {ros__parameters: 5}\n",
        "b: {ros__parameters: [1, 2]}\n",
        "b: {ros__parameters: some text}\n",
        "b:\n",
        "b: ~\n",
        "b: 5\n",
        "b: [1, 2]\n",
        "b: text\n",
        "b: {}\n",
        "b:\n  ros__parameters:\n  joints: [x]\n",
        "b: {ros__parameters: {a.c: 1, a: {c: 2}}}\n",
        "b: {ros__parameters: {joints: 5, gains: 3}}\n",
        "b: {c: {ros__parameters: }}\n",
        "b: {ros__parameters: {foo: 5, joints: 7}}\n",
        "b: {ros__parameters: {joints: [q]}}\n",
        "b: {ros__parameters: {gains: 5}}\n",
        "b: {joints: [q], gains: 5}\n",
        "b: {ros__parameters: {joints: [q], a.c: 1, a: {c: 2}}}\n",
        "moveit: {arm: {type: FollowJointTrajectory, joints: [q], gains: 5}}\n",
        "/ns/b: {ros__parameters: }\n",
        "/**/b: {ros__parameters: }\n",
        "/other/**: {ros__parameters: 5}\n"}) {
    INFO(other);
    for (const std::string& text : {other + manager + arm, manager + arm + other}) {
      CHECK(load_controller(yaml(text)).joints.size() == 2);
      CHECK(load_pid_gains(Q2d(), yaml(text)).gains[1].proportional == 2);
      CHECK(load_trajectory_tolerances(Q2d(), yaml(text)).tolerances.goal_time == 3);
      CHECK(load_controller_manager(yaml(text)).update_rate == 250);
      CHECK(load_signals(Q2d(), yaml(text + "w: {ros__parameters: {waveforms: {elbow_active_joint: "
                                            "{amplitude: 1, frequency: 1}}}}\n"))
                .signals.size() == 1);
    }
  }
  // Without a controller manager, what looks like a controller's section counts before other maps.
  const std::string typed =
      "arm: {type: effort_controllers/JointTrajectoryController, joints: "
      "[elbow_active_joint], gains: {elbow_active_joint: {p: 1}}}\n";
  for (const std::string& text : {arm, typed}) {
    for (const std::string other : {"b: {joints: [q], gains: 5}\n", "b: {c: {joints: [q]}}\n",
                                    "b: {arm: {type: FollowJointTrajectory, joints: [q]}}\n"}) {
      CHECK(load_controller(yaml(text + other)).name == "arm");
      const auto notes = load_controller(yaml(other + text)).notes;
      CHECK(has_note(notes, "not used, it has neither ros__parameters nor the type of a plugin"));
    }
  }
  const std::string node = "b: {ros__parameters: {joints: [q]}}\n";
  CHECK(has_note(load_controller(yaml(manager + arm + node)).notes,
                 "b.ros__parameters: not used, the controller_manager does not list it"));
  CHECK_THAT(complaint_of([&] { return load_controller(yaml(arm + node)); }),
             Contains("there are several: arm in line 2, b in line 6"));
  // Only a map of gains makes a controller.
  CHECK(load_controller(yaml("camera: {ros__parameters: {gains: 4.0}}\n" + arm)).name == "arm");
  // A listed controller may name its state, as some robots' files do.
  CHECK(has_note(
      load_controller_manager(yaml("controller_manager: {ros__parameters: {update_rate: 100, "
                                   "b: {type: joint_state_broadcaster/JointStateBroadcaster, "
                                   "state: active}}}\n"))
          .notes,
      "b.state: not used: the program decides which controller is active"));
  // Beside a controller's own parameters a map with joints is no section.
  CHECK_THAT(complaint_of([&] {
               return load_controller(yaml("gains: {a: {p: 1}}\nother: {joints: [a]}\n"));
             }),
             Contains("unknown key 'other'"));
  // Without types and ros__parameters as well.
  CHECK(load_controller(
            yaml("b:\narm: {joints: [elbow_active_joint], gains: {elbow_active_joint: {p: 1}}}\n"))
            .name == "arm");
  // What is asked for by name, or may have been meant, is refused for its own fault.
  const std::string broken = "b: {ros__parameters: 5}\n";
  CHECK_THAT(complaint_of([&] { return load_controller(yaml(broken + arm), "b"); }),
             Contains("b.ros__parameters: the number 5, expected a map of parameters"));
  CHECK_THAT(complaint_of([&] { return load_controller(yaml(broken)); }),
             Contains("b.ros__parameters: the number 5, expected a map of parameters"));
  CHECK_THAT(
      complaint_of([&] {
        return load_controller_manager(yaml("controller_manager: {ros__parameters: 5}\n" + arm));
      }),
      Contains("controller_manager.ros__parameters: the number 5"));
  CHECK(has_note(load_controller(yaml(broken + arm)).notes, "the number 5, expected a map of "));
}

TEST_CASE("the parts of a section that a file repeats are one") {
  const std::string rate =
      "/**:\n  controller_manager:\n    ros__parameters:\n      update_rate: 250\n";
  const std::string elbow =
      "/**:\n  arm:\n    ros__parameters:\n      joints: [elbow_active_joint]\n";
  const std::string gains =
      "/**:\n  arm:\n    ros__parameters:\n      gains: {elbow_active_joint: {p: 2}}\n";
  CHECK(load_controller_manager(yaml(rate + elbow + gains)).update_rate == 250);
  const auto loaded =
      load_pid_gains(Q2d(), yaml(elbow + rate + gains), "arm", GainsOf::some_joints);
  CHECK(loaded.gains[1].proportional == 2);
  // ROS 2 writes gains.a.p and gains.b.p in any order; and some parts are empty.
  const std::string more =
      "/**:\n  arm:\n    ros__parameters:\n      gains: {shoulder_active_joint: {p: 3}}\n"
      "      joints: [elbow_active_joint, shoulder_active_joint]\n";
  const std::string empty = "/**:\n  arm:\n    ros__parameters:\n";
  CHECK(load_pid_gains(Q2d(), yaml(empty + gains + empty + more), "arm").gains[0].proportional ==
        3);
  CHECK(load_controller(yaml("b:\n  ros__parameters:\nb:\n  ros__parameters:\n" + arm)).name ==
        "arm");
  // No value counts twice.
  CHECK_THAT(complaint_of([&] { return load_controller(yaml(elbow + rate + elbow), "arm"); }),
             Contains("test:12:7") && Contains("the key 'joints' is also in line 4"));
  CHECK_THAT(complaint_of([&] { return load_controller(yaml(elbow + "/**: 5\n"), "arm"); }),
             Contains("the key '/**' is also in line 1"));
  // Within a section a repeated map is a slip.
  CHECK_THAT(complaint_of([&] {
               return load_controller(yaml(elbow + "      gains: {elbow_active_joint: {p: 1}}\n"
                                                   "      gains: {elbow_active_joint: {p: 2}}\n"));
             }),
             Contains("the key 'gains' is also in line 5"));
}

TEST_CASE("what ROS calls save_i_term and enable_feedforward") {
  const auto loaded = [](const std::string& more, const std::string& gains) {
    return load_pid_gains(Q2d(),
                          yaml("dof_names: [elbow_active_joint, shoulder_active_joint]\n" + more +
                               "reference_and_state_interfaces: [position, velocity]\n"
                               "gains: {elbow_active_joint: {p: 1, " +
                               gains + "}, shoulder_active_joint: {p: 1}}\n"));
  };
  const auto kept = loaded("", "save_i_term: true");
  CHECK(kept.keeps_integral == std::array{false, true});
  CHECK(has_note(kept.notes, "save_i_term: used by ControlToolboxPidLaw only"));
  CHECK(loaded("", "save_i_term: false").notes.empty());

  const auto on = loaded("enable_feedforward: true\n", "feedforward_gain: 0.5");
  CHECK(on.gains[1].velocity_feedforward == 0.5);
  CHECK(on.notes.empty());
  const auto off = loaded("enable_feedforward: false\n", "feedforward_gain: 0.5");
  CHECK(off.gains[1].velocity_feedforward == 0);
  CHECK(has_note(off.notes, "feedforward_gain: not used: enable_feedforward is false"));
  const auto unsaid = loaded("", "feedforward_gain: 0.5");
  CHECK(unsaid.gains[1].velocity_feedforward == 0.5);
  CHECK(has_note(unsaid.notes, "no enable_feedforward is given: true here"));
  // Where it is off, no velocity is needed.
  const std::string alone =
      "joint: elbow_active_joint\ngains: {elbow_active_joint: {p: 1, feedforward_gain: 2}}\n";
  CHECK_NOTHROW(load_controller(yaml(alone + "enable_feedforward: false\n")));
  CHECK_THROWS_WITH(load_controller(yaml(alone + "enable_feedforward: true\n")),
                    Contains("expected 0, or position and velocity"));
  CHECK_THROWS_WITH(load_controller(yaml(alone + "enable_feedforward: many\n")),
                    Contains("enable_feedforward: the word 'many', expected true or false"));
}

TEST_CASE("the laws of control_toolbox take what they take there") {
  const std::string text =
      "gains:\n  elbow_active_joint: {p: -1, i: -2, d: 3, u_clamp_min: 1, u_clamp_max: 4}\n"
      "  shoulder_active_joint: {p: 1}\n";
  CHECK_THROWS_WITH(load_pid_gains(Q2d(), yaml(text)),
                    Contains(".p: the number -1, expected a number >= 0"));
  const auto config = load_pid_gains(Q2d(), yaml(text), "", GainsOf::all_joints, GainSigns::any);
  CHECK(config.gains[1].integral == -2);
  CHECK(config.gains[1].output_clamp_min == 1);
  CHECK(load_controller(yaml(text), "", GainSigns::any).joints[0].gains->proportional == -1);
  CHECK_THROWS_WITH(
      load_controller(yaml("gains: {a: {p: 1, u_clamp_min: 4, u_clamp_max: 1}}\n"), "",
                      GainSigns::any),
      Contains("u_clamp_max: the number 1, expected a number that is not below u_clamp_min"));
  CHECK_THROWS_WITH(load_controller(yaml("gains: {a: {p: 1, u_clamp_min: 1}}\n")),
                    Contains("u_clamp_min: the number 1, expected a number <= 0"));
}
