// SPDX-License-Identifier: Apache-2.0
// Unusual but valid files, as programs and people write them.
#include <articula/control/limits/command_limits.hpp>
#include <articula/dynamics/dynamics.hpp>
#include <articula/urdf/urdf.hpp>

#include "catch.hpp"
#include "urdf_text.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

using namespace articula;
using Catch::Contains;
using support::joint, support::robot, support::solid;

namespace {

/// A pendulum with a <ros2_control> whose joint has this inside.
std::string controlled(const std::string& inside) {
  return robot(
      "<link name=\"base\"/>" + solid("rod") +
      joint("pivot", "continuous", "base", "rod", "<limit effort=\"100\" velocity=\"3\"/>") +
      "<ros2_control name=\"c\" type=\"system\"><joint name=\"pivot\">" + inside +
      "</joint></ros2_control>");
}

JointLimits limits_with(const std::string& command) {
  const Model<1> model = load_urdf<1>(
      UrdfSource(controlled("<command_interface name=" + command + "</command_interface>")));
  return model.joints[0].limits;
}

std::string param(const std::string& name, const std::string& text) {
  return "<param name=\"" + name + "\">" + text + "</param>";
}

using Notices = std::vector<std::string>;

}  // namespace

TEST_CASE("numbers of commands with comments, infinities and white space") {
  CHECK(limits_with("\"effort\">" + param("max", "<!-- N m --> 87 \n")).effort == 87);
  CHECK(limits_with("\"effort\">" + param("max", "8<!-- . -->7")).effort == 87);
  CHECK(limits_with("\"effort\">" + param("max", "inf")).effort == 100);
  CHECK(limits_with("\"mode\">" + param("max", "auto")).effort == 100);
  CHECK_THROWS_WITH(limits_with("\"effort\">" + param("max", "much")),
                    Contains("effort max: 'much' is not a finite number"));
}

TEST_CASE("a joint has one limit for both directions, the narrower one, with a notice") {
  const auto notices = [](const std::string& bounds) {
    return read_urdf(UrdfSource(controlled("<command_interface name=\"velocity\">" + bounds +
                                           "</command_interface>")))
        ->notices;
  };
  const std::string velocity = "<ros2_control>: joint 'pivot': velocity: ";
  const auto both = [](const char* min, const char* max) {
    return param("min", min) + param("max", max);
  };
  CHECK(limits_with("\"velocity\">" + both("-1", "2")).velocity == 1);
  CHECK(notices(both("-1", "2")) ==
        Notices{velocity + "min -1 and max 2 differ; 1 is used in both directions"});
  CHECK(limits_with("\"velocity\">" + both("-2", "1.5")).velocity == 1.5);
  CHECK(notices(param("max", "1.5")) ==
        Notices{velocity + "min -inf and max 1.5 differ; 1.5 is used in both directions"});
  CHECK(notices(both("-2", "2.0")).empty());
  CHECK(limits_with("\"velocity\">" + both("0", "0")).velocity == 0);
  for (const auto& [min, max] : {std::pair{"0", "1"}, std::pair{"-1", "0"}}) {
    CHECK_THROWS_WITH(limits_with("\"velocity\">" + both(min, max)),
                      Contains("<ros2_control>: joint 'pivot': velocity: its limits (min ") &&
                          Contains(") exclude one direction"));
  }
}

TEST_CASE("contradictory limits are reported where they are not used") {
  const auto read = [](const std::string& kind, const std::string& bounds, bool kinematic,
                       const std::string& mimic = "<mimic joint=\"pivot\"/>") {
    const std::string range = "<limit lower=\"-1\" upper=\"1\" effort=\"9\" velocity=\"3\"/>";
    return read_urdf(
        UrdfSource(robot("<link name=\"base\"/>" + solid("rod") + solid("end") +
                         joint("pivot", "revolute", "base", "rod", range) +
                         joint("next", "revolute", "rod", "end", range + mimic) +
                         "<ros2_control name=\"c\" type=\"system\"><hardware><plugin>p</plugin>"
                         "</hardware><joint name=\"pivot\"/><joint name=\"next\">"
                         "<command_interface name=\"" +
                         kind + "\">" + bounds + "</command_interface></joint></ros2_control>")),
        {.kinematic = kinematic});
  };
  const auto has = [](const UrdfDescription& description, const std::string& notice) {
    return std::count(description->notices.begin(), description->notices.end(), notice) == 1;
  };
  const std::string owner = "<ros2_control>: joint 'next': ", bounds = param("min", "0");
  for (const std::string kind : {"velocity", "effort", "torque"}) {
    for (const bool kinematic : {false, true}) {
      CHECK(has(read(kind, bounds + param("max", "3"), kinematic),
                owner + kind + ": its limits (min 0, max 3) are ignored: it mimics 'pivot'"));
      CHECK(has(read(kind, param("min", "2"), kinematic),
                owner + kind + ": its limits (min 2, max inf) are ignored: it mimics 'pivot'"));
      if (kinematic && kind != "velocity") {
        CHECK(has(
            read(kind, bounds, true, ""),
            owner + kind + ": its limits (min 0, max inf) are ignored: the robot is kinematic"));
      } else {
        CHECK_THROWS_WITH(read(kind, bounds, kinematic, ""), Contains("exclude one direction"));
      }
    }
  }
  const UrdfDescription place = read("position", param("min", "2"), false);
  CHECK(has(place,
            "joint 'next': its limits, 2 .. inf in <ros2_control> and -1 .. 1 in <limit>, "
            "leave it no position; it mimics 'pivot', so those of <limit> are used"));
  CHECK(place->joints[1].limits.lower == -1);
  CHECK_THROWS_WITH(read("position", param("min", "2"), false, ""),
                    Contains("leave it no position"));
}

TEST_CASE("soft limits that leave a joint no room are noted") {
  const auto notices = [](const std::string& lower, const std::string& upper) {
    return read_urdf(UrdfSource(
                         robot("<link name=\"base\"/>" + solid("rod") +
                               joint("pivot", "revolute", "base", "rod",
                                     "<limit lower=\"-1\" upper=\"1\" effort=\"9\" velocity=\"3\"/>"
                                     "<safety_controller soft_lower_limit=\"" +
                                         lower + "\" soft_upper_limit=\"" + upper + "\"/>"))))
        ->notices;
  };
  CHECK(notices("1", "3") == Notices{"joint 'pivot': its soft limits, 1 .. 3, leave it no room to "
                                     "move within its limits, -1 .. 1"});
  CHECK(notices("-3", "-1").size() == 1);
  CHECK(notices("0.5", "3").empty());
}

TEST_CASE("torque and force are other words for effort") {
  for (const std::string kind : {"torque", "force"}) {
    const std::string command = "\"" + kind + "\">";
    CHECK(limits_with(command + param("min", "-5") + param("max", "5")).effort == 5);
    CHECK(limits_with(command + param("max", "auto")).effort == 100);  // a notice says so
    CHECK_THROWS_WITH(limits_with(command + param("min", "-5") + param("max", "0")),
                      Contains(kind + ": its limits (min -5, max 0) exclude one direction"));
  }
}

TEST_CASE("limits of acceleration and jerk are read") {
  const std::string both = param("min", "-20") + param("max", "20");
  CHECK(limits_with("\"acceleration\">" + both).acceleration == 20);
  CHECK(limits_with("\"acceleration\">" + param("max", "15")).acceleration == 15);
  CHECK(limits_with("\"acceleration\">" + param("min", "-15")).acceleration == 15);
  CHECK(limits_with("\"acceleration\">" + param("min", "-8") + param("max", "15")).acceleration ==
        8);
  CHECK(limits_with("\"jerk\">" + param("max", "900")).jerk == 900);
  CHECK(limits_with("\"velocity\">").acceleration == JointLimits::infinity);
  CHECK(limits_with("\"acceleration\">" + param("max", "0")).acceleration == JointLimits::infinity);

  const auto notices = [](const std::string& command) {
    return read_urdf(UrdfSource(
                         controlled("<command_interface name=" + command + "</command_interface>")))
        ->notices;
  };
  const std::string owner = "<ros2_control>: joint 'pivot': ";
  CHECK(notices("\"acceleration\">" + both).empty());
  CHECK(notices("\"jerk\">" + param("max", "900")).empty());
  CHECK(notices("\"acceleration\">" + param("min", "-8") + param("max", "15")) ==
        Notices{owner + "acceleration: min -8 and max 15 differ; 8 is used in both directions"});
  CHECK(limits_with("\"acceleration\">" + param("max", "-4")).acceleration == 4);
  CHECK(notices("\"acceleration\">" + param("max", "-4")) ==
        Notices{owner + "acceleration: the size of max -4, 4, is used in both directions"});
  CHECK(notices("\"jerk\">" + param("min", "4")) ==
        Notices{owner + "jerk: the size of min 4, 4, is used in both directions"});
  CHECK(notices("\"jerk\">" + param("min", "-4")).empty());
  CHECK(notices("\"jerk\">" + param("max", "0")) ==
        Notices{owner + "jerk: a limit of 0 is ignored, because the joint could not move"});
  CHECK(notices("\"jerk\">" + param("max", "much")) ==
        Notices{owner + "jerk max: 'much' is not a number and is ignored"});

  const Model<1> model = load_urdf<1>(UrdfSource(controlled(
      "<command_interface name=\"acceleration\">" + both + "</command_interface>" +
      "<command_interface name=\"jerk\">" + param("max", "9") + "</command_interface>")));
  CHECK(command_limits(model).acceleration[0] == 20);
  CHECK(command_limits(model).jerk[0] == 9);
  CommandLimits<1> beyond = command_limits(model);
  beyond.acceleration[0] = 21;
  CHECK_THROWS_WITH(validate(model, beyond), Contains("acceleration 21 is above the limit 20"));
}

TEST_CASE("limits of acceleration and jerk are read from URDF 1.2, too") {
  const auto pivot = [](const std::string& rates) {
    return read_urdf(UrdfSource(support::pendulum(
        solid("rod"), joint("pivot", "continuous", "base", "rod",
                            "<limit effort=\"1\" velocity=\"1\" " + rates + "/>"))));
  };
  const JointLimits limits =
      pivot("acceleration=\"7\" deceleration=\"5\" jerk=\"60\"")->joints[0].limits;
  CHECK(limits.acceleration == 5);
  CHECK(limits.jerk == 60);
  CHECK(pivot("jerk=\"0\"")->notices ==
        Notices{"joint 'pivot': <limit>: jerk '0' is not a number > 0 and is ignored"});
}

TEST_CASE("mistakes in ros2_control are reported") {
  const auto notices = [](const std::string& component, const std::string& mechanics = "") {
    return read_urdf(UrdfSource(robot(
                         "<link name=\"base\"/>" + solid("rod") + solid("end") +
                         joint("pivot", "continuous", "base", "rod") +
                         (mechanics.empty() ? joint("weld", "fixed", "rod", "end") : mechanics) +
                         component)))
        ->notices;
  };
  const auto component = [&](const std::string& inside) {
    return notices("<ros2_control name=\"c\" type=\"system\">" + inside + "</ros2_control>");
  };
  const auto pivot = [&](const std::string& inside, const std::string& attributes = "") {
    return component("<joint name=\"pivot\"" + attributes + ">" + inside + "</joint>");
  };
  const auto command = [&](const std::string& kind, const std::string& inside) {
    return pivot("<command_interface name=\"" + kind + "\">" + inside + "</command_interface>");
  };
  const std::string owner = "<ros2_control>: joint 'pivot': ",
                    effort = owner + "<command_interface name=\"effort\">: ",
                    unknown = " is unknown and is ignored", meant_max = "; did you mean 'max'?";
  CHECK(command("effort", param("min", "-5") + param("max", "5")).empty());

  SECTION("limits under another name") {
    CHECK(command("effort", param("maximum", "5")) ==
          Notices{effort + "the parameter 'maximum'" + unknown + meant_max});
    CHECK(command("effort", param("Max", "5")) ==
          Notices{effort + "the parameter 'Max'" + unknown + meant_max});
    CHECK(command("effort", param("upper_limit", "5")) ==
          Notices{effort + "the parameter 'upper_limit'" + unknown + meant_max});
    CHECK(command("effort", param("bound", "5")) ==
          Notices{effort + "the parameter 'bound'" + unknown});
    CHECK(command("efort", param("max", "5")) ==
          Notices{owner +
                  "<command_interface name=\"efort\">: its max is ignored; limits are read for "
                  "position, velocity, effort (or torque, force), acceleration and jerk; did you "
                  "mean 'effort'?"});
    CHECK(pivot("<state_interface name=\"effort\">" + param("max", "5") + "</state_interface>") ==
          Notices{owner + "<state_interface name=\"effort\">: its max is ignored; limits are "
                          "read from commands"});
    CHECK(pivot(param("max_effort", "5")) ==
          Notices{owner + "<joint>: the parameter 'max_effort'" + unknown});
    CHECK(pivot(param("can_id", "5")).empty());
    CHECK(pivot("<command_interface name=\"effort\" max=\"5\"/>") ==
          Notices{effort + "<command_interface>: the attribute 'max'" + unknown});
    CHECK(pivot("<command_interface name=\"effort\"><max>5</max></command_interface>") ==
          Notices{effort + "<command_interface>: the element <max>" + unknown});
    CHECK(pivot("<state_interface name=\"position\">" + param("initial", "5") +
                "</state_interface>") ==
          Notices{owner + "<state_interface name=\"position\">: the parameter 'initial'" + unknown +
                  "; did you mean 'initial_value'?"});
    CHECK(
        notices("<ros2control name=\"c\" type=\"system\"/>") ==
        Notices{"<robot>: the element <ros2control>" + unknown + "; did you mean 'ros2_control'?"});
    CHECK(notices("<gazebo/><material name=\"grey\"/><plugin/>").empty());
    CHECK(pivot("<comand_interface name=\"effort\"/>") ==
          Notices{owner + "<joint>: the element <comand_interface>" + unknown +
                  "; did you mean 'command_interface'?"});
  }
  SECTION("limits that are switched off") {
    const std::string off =
        ": <limits enable=\"false\"/>: min and max are ignored there, and <limit> is used";
    CHECK(pivot("<limits enable=\"false\"/>") == Notices{"<ros2_control>: joint 'pivot'" + off});
    CHECK(command("effort", "<limits enable=\"False\"/>" + param("max", "5")) ==
          Notices{owner + "effort" + off});
    CHECK(command("effort", "<limits/>") == Notices{effort + "<limits> has no enable, so the "
                                                             "limits are used"});
    CHECK(command("effort", "<limits enable=\"no\"/>") ==
          Notices{effort + "<limits>: enable 'no' is neither true nor false and is ignored"});
  }
  SECTION("parts without name, text or sense") {
    CHECK(notices("<ros2_control/>") ==
          Notices{"<ros2_control>: it has no name", "<ros2_control>: it has no type"});
    CHECK(notices("<ros2_control name=\"c\" type=\"robot\" is_async=\"1\" rw_rate=\"-2\"/>") ==
          Notices{"<ros2_control> 'c': type 'robot' is none of system, actuator, sensor",
                  "<ros2_control> 'c': is_async '1' is neither true nor false and is ignored",
                  "<ros2_control> 'c': rw_rate '-2' is not a whole number >= 0"});
    CHECK(component("<hardware/>") ==
          Notices{"<ros2_control> 'c': its <hardware> has no <plugin>"});
    CHECK(component("<joints/>") == Notices{"<ros2_control> 'c': <ros2_control>: the element "
                                            "<joints>" +
                                            unknown + "; did you mean 'joint'?"});
    CHECK(component("<sensor/>") == Notices{"<ros2_control> 'c': sensor '': it has no name"});
    CHECK(pivot("<command_interface/>") == Notices{owner + "a <command_interface> has no name"});
    CHECK(command("effort", "<param>5</param>") ==
          Notices{effort + "a <param> has no name and is ignored"});
    CHECK(command("effort", "<param name=\"initial_value\"/>") ==
          Notices{effort + "the parameter 'initial_value' is empty"});
    CHECK(component("<transmission name=\"t\"><joint name=\"pivot\"/></transmission>") ==
          Notices{"transmission 't': it has no <plugin>", "transmission 't': a <joint> has no role",
                  "transmission 't': joint 'pivot' is not in its <ros2_control>"});
  }
  SECTION("joints that cannot be commanded, or are twice") {
    CHECK(component("<joint name=\"weld\"><command_interface name=\"position\"/></joint>") ==
          Notices{"<ros2_control>: joint 'weld': it is fixed, so its commands move nothing"});
    CHECK(component("<joint name=\"weld\"/>") ==
          Notices{"<ros2_control>: joint 'weld': it is fixed"});
    CHECK(pivot("", " mimic=\"true\"") ==
          Notices{owner + "mimic=\"true\", but the joint has no <mimic>"});
    const std::string taken =
        "<joint name=\"pivot\"><command_interface name=\"position\"/></joint>";
    CHECK(component(taken + taken) == Notices{owner + "it occurs twice"});
    const std::string effort_command = "<command_interface name=\"effort\"/>";
    CHECK(pivot(effort_command + effort_command) ==
          Notices{effort + "it occurs twice; the narrower limits are used"});
    CHECK(pivot("<state_interface name=\"effort\"/><state_interface name=\"effort\"/>") ==
          Notices{owner + "<state_interface name=\"effort\">: it occurs twice"});
    CHECK(notices("<ros2_control name=\"c\" type=\"system\">" + taken +
                  "</ros2_control><ros2_control name=\"d\" type=\"system\">" + taken +
                  "</ros2_control>") ==
          Notices{owner + "it occurs in two <ros2_control>; the narrower limits are used"});
    const std::string both =
        "<ros2_control name=\"c\" type=\"system\"><joint name=\"pivot\"/><joint name=\"end\">"
        "<command_interface name=\"position\"/></joint></ros2_control>";
    CHECK(notices(both, joint("end", "continuous", "rod", "end", "<mimic joint=\"pivot\"/>")) ==
          Notices{"<ros2_control>: joint 'end': it mimics 'pivot', so its commands are ignored"});
  }
  SECTION("the same in many joints is one line") {
    CHECK(component("<joint name=\"pivot\"><command_interface name=\"effort\">" +
                    param("maximum", "5") +
                    "</command_interface></joint><joint name=\"weld\"><command_interface "
                    "name=\"effort\">" +
                    param("maximum", "5") + "</command_interface></joint>")[0] ==
          effort + "the parameter 'maximum'" + unknown + meant_max + " Also in 1 other");
  }
}

TEST_CASE("soft limits of a safety controller are read where they can be used") {
  const auto description = [](const std::string& safety, const std::string& type = "revolute") {
    return read_urdf(UrdfSource(support::pendulum(
        solid("rod"),
        joint("pivot", type, "base", "rod",
              "<limit lower=\"-2\" upper=\"2\" effort=\"1\" velocity=\"1\"/><safety_controller " +
                  safety + "/>"))));
  };
  const std::string range = "soft_lower_limit=\"-1.9\" soft_upper_limit=\"1.8\" ";
  const UrdfDescription pivot = description(range + "k_position=\"20\" k_velocity=\"0\"");
  CHECK(pivot->notices.empty());
  const CommandLimits<1> limits = command_limits(load_urdf<1>(pivot));
  CHECK(limits.soft_lower[0] == -1.9);
  CHECK(limits.soft_upper[0] == 1.8);
  CHECK(limits.soft_rate[0] == 20);
  CHECK(description(range)->joints[0].limits.soft_rate == JointLimits::infinity);

  const std::string owner = "joint 'pivot': ", safety = owner + "<safety_controller>: ";
  const auto unused = [&](const std::string& text, const std::string& type = "revolute") {
    const UrdfDescription read = description(text, type);
    CHECK(read->joints[0].limits.soft_lower == -JointLimits::infinity);
    CHECK(read->joints[0].limits.soft_rate == JointLimits::infinity);
    REQUIRE(!read->notices.empty());
    return read->notices.back();
  };
  CHECK(description("")->notices.empty());
  CHECK(unused("k_velocity=\"5\"") == safety + "k_velocity is ignored");
  CHECK(unused("k_position=\"5\"") == safety + "k_position is ignored without soft limits");
  CHECK(unused("soft_lower_limit=\"-1\"") ==
        safety + "soft limits -1 .. (none) are ignored: one of them is missing");
  CHECK(unused("soft_lower_limit=\"0\" soft_upper_limit=\"0\"") ==
        safety + "soft limits 0 .. 0 are ignored: they leave the joint no room to move");
  CHECK(unused(range + "k_position=\"-1\"") ==
        safety + "soft limits -1.9 .. 1.8 are ignored: k_position is negative");
  CHECK(unused("soft_lower_limit=\"low\" soft_upper_limit=\"0\"") ==
        safety + "soft_lower_limit 'low' is not a number and is ignored");
  CHECK(unused("soft_lower_limit=\"3\" soft_upper_limit=\"4\"") ==
        owner + "its soft limits, 3 .. 4, are ignored: they are beyond its limits, -2 .. 2");
  CHECK(unused("soft_lower=\"-1\"") ==
        owner +
            "<safety_controller>: the attribute 'soft_lower' is unknown and is "
            "ignored");
}

TEST_CASE("tabs and line ends between the numbers of an attribute") {
  const auto loaded = [](const std::string& xyz) {
    return load_urdf<1>(
        UrdfSource(support::pendulum(solid("rod"), joint("pivot", "continuous", "base", "rod",
                                                         "<origin xyz=\"" + xyz + "\"/>"))));
  };
  for (const std::string blank : {"\t", "\n", "\r\n", " \t "}) {
    const auto rod =
        forward_kinematics(loaded("1" + blank + "2" + blank + "3"), JointVector<1>(0.0), "rod");
    CHECK(rod.translation() == Eigen::Vector3d(1, 2, 3));
  }
}

TEST_CASE("a mimic joint may move a link without mass if the joint that it follows moves one") {
  const std::string file =
      robot("<link name=\"base\"/>" + solid("a") + "<link name=\"pad\"/>" +
            joint("i", "continuous", "base", "a") +
            joint("k", "continuous", "a", "pad", "<mimic joint=\"i\" multiplier=\"-1\"/>"));
  const auto model = load_urdf<1, 2>(UrdfSource(file));
  CHECK(mass_matrix(model, JointVector<1>(0.3))(0, 0) == Approx(1));
  // The other way round as well; but some mass there must be.
  const std::string follower = "<mimic joint=\"i\"/>";
  const auto turned = [&](const std::string& last) {
    return robot("<link name=\"base\"/><link name=\"a\"/>" + last +
                 joint("i", "continuous", "base", "a") +
                 joint("k", "continuous", "base", "b", follower));
  };
  CHECK_NOTHROW(load_urdf<1, 2>(UrdfSource(turned(solid("b")))));
  CHECK_THROWS_WITH((load_urdf<1, 2>(UrdfSource(turned("<link name=\"b\"/>")))),
                    Contains("joint 'i': the joint moves no link that has mass"));
}

TEST_CASE("inertia without mass is accepted when asked for") {
  const std::string disc =
      "<link name=\"rod\"><inertial><mass value=\"0\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" "
      "iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial></link>";
  const UrdfSource file = UrdfSource(support::pendulum(disc));
  CHECK_THROWS_WITH(load_urdf<1>(file), Contains("has inertia but no mass"));
  const auto model = load_urdf<1>(file, {.allow_unphysical = true});
  CHECK(mass_matrix(model, JointVector<1>(0.0))(0, 0) == Approx(1));
}

TEST_CASE("a chain that is too long is refused, and not followed") {
  std::string inside = solid("l0");
  for (int i = 1; i < 4000; ++i) {
    const std::string name = std::to_string(i), before = std::to_string(i - 1);
    inside +=
        "<link name=\"l" + name + "\"/>" + joint("j" + name, "fixed", "l" + before, "l" + name);
  }
  CHECK_THROWS_WITH(read_urdf(UrdfSource(robot(inside))), Contains("links in one chain"));
}

TEST_CASE("an error about the robot names the robot") {
  const std::string file = "<robot name=\"base\"><link name=\"base\"/><link name=\"b\"/>" +
                           joint("base", "fixed", "base", "b") + "</robot>";
  CHECK_THROWS_WITH(read_urdf(UrdfSource(file)), Contains("robot 'base': no joint moves"));
}

TEST_CASE("limits of a mimic joint that contradict the mimicked joint's are ignored and reported") {
  const auto finger = [](const std::string& name, const std::string& link, double lower,
                         double upper, const std::string& mimic) {
    return joint(name, "prismatic", "base", link,
                 "<limit lower=\"" + std::to_string(lower) + "\" upper=\"" + std::to_string(upper) +
                     "\" effort=\"1\" velocity=\"1\"/>" + mimic);
  };
  const auto read = [&](const std::string& others) {
    return read_urdf(UrdfSource(robot("<link name=\"base\"/>" + solid("a") + solid("b") +
                                      solid("c") + finger("left", "a", 0, 0.5, "") + others)));
  };
  const std::string minus = "<mimic joint=\"left\" multiplier=\"-1\"/>";
  const std::string weld = joint("weld", "fixed", "base", "c");
  const UrdfDescription opposite = read(finger("right", "b", 0, 0.5, minus) + weld);
  CHECK(opposite->notices ==
        std::vector<std::string>{
            "joint 'right': its limits, 0 .. 0.5, are ignored: within them 'left', "
            "which it mimics -1 times, could not move"});
  const JointLimits limits = load_urdf<1, 2>(opposite).joints[0].limits;
  CHECK(limits.lower == 0);
  CHECK(limits.upper == 0.5);
  // Limits that only narrow it do count; and so do those that leave no room together.
  CHECK(read(finger("right", "b", -0.25, 0, minus) + weld)->notices.empty());
  const UrdfDescription both =
      read(finger("up", "b", 0, 0.25, "<mimic joint=\"left\"/>") +
           finger("down", "c", -0.5, -0.25, "<mimic joint=\"left\" multiplier=\"-1\"/>"));
  REQUIRE(both->notices.size() == 1);
  CHECK_THAT(both->notices[0], Contains("joint 'left'") && Contains("the joints that mimic it"));
}

TEST_CASE("document types and processing instructions are passed over") {
  const std::string rod = support::pendulum();
  for (const std::string prolog :
       {"<!DOCTYPE robot>", "<?xml version=\"1.0\"?>\n<!DOCTYPE robot SYSTEM \"a>b.dtd\">",
        "<!DOCTYPE robot PUBLIC \"it's\" 'r\"' [\n]\n>",
        "<!DOCTYPE robot [ <!ENTITY m \"]>\"> <!-- ]> ' --> <?pi ]> ' ?> <!ELEMENT robot (link)> "
        "]>",
        "<?x a > b \" ' <link> ?>", "<?xml version=\"1.0\"?><?xml-model href=\"a>b\"?>", "<?x?>"}) {
    INFO(prolog);
    CHECK_NOTHROW(load_urdf<1>(UrdfSource(prolog + "\n" + rod)));
  }
  std::string inside = rod;
  inside.insert(inside.find("<joint"),
                "<?x <joint> \" > & &m; ?><!-- &m; --><a><![CDATA[&m;]]></a>");
  CHECK_NOTHROW(load_urdf<1>(UrdfSource(inside + "<?end > ?>")));
  // Lines after it keep their numbers.
  CHECK_THROWS_WITH(load_urdf<1>(UrdfSource("<!DOCTYPE robot [\n<!ENTITY m '2'>\n]>\n<robot a>")),
                    Contains("URDF:4: an attribute has no value"));
  // An ampersand alone is no XML, but people write it; entities of XML's own are read.
  const auto named = load_urdf<1>(UrdfSource(
      support::pendulum(solid("a & b"), joint("&lt;&#65;&amp;m;", "continuous", "base", "a & b"))));
  CHECK(named.joints[0].name.view() == "<A&m;");
}

TEST_CASE("a mimic of a mimic that is left out mimics the last joint of the chain") {
  // Two arms: end mimics mid, which is on the other one and mimics master.
  const std::string file =
      robot("<link name=\"base\"/>" + solid("a") + solid("b") + solid("c") +
            joint("master", "continuous", "base", "a") +
            joint("mid", "continuous", "base", "b",
                  "<mimic joint=\"master\" multiplier=\"2\" offset=\"0.5\"/>") +
            joint("end", "continuous", "a", "c",
                  "<mimic joint=\"mid\" multiplier=\"-1\" offset=\"0.25\"/>"));
  const auto end_of = [&](const UrdfOptions& options) {
    const UrdfDescription robot = read_urdf(UrdfSource(file), options);
    for (const Joint& joint : robot->joints) {
      if (joint.name.view() == "end") return joint;
    }
    return Joint{};
  };
  for (const std::string tip : {"", "c"}) {
    const Mimic mimic = end_of({.tip = tip}).mimic;
    CHECK(mimic.joint.view() == "master");
    CHECK(mimic.multiplier == -2);
    CHECK(mimic.offset == -0.25);  // 0.25 - 0.5
  }
  // Held by one that is left out, at 0.25 - (2 * 0.125 + 0.5), or by the one between.
  const std::string beyond = file.substr(0, file.rfind("</robot>")) + solid("d") +
                             joint("tool", "continuous", "c", "d") + "</robot>";
  const auto held = [&](const LockedJoint& lock) {
    const UrdfDescription robot = read_urdf(UrdfSource(beyond), {.root = "a", .locked = {lock}});
    REQUIRE(robot->joints[0].name.view() == "end");
    CHECK(robot->joints[0].type == JointType::fixed);
    return robot->joints[0].orientation.x;  // the axis is x
  };
  CHECK(held({"master", 0.125}) == Approx(-0.5));
  CHECK(held({"mid", 1}) == Approx(-0.75));
  CHECK_THROWS_WITH(read_urdf(UrdfSource(beyond), {.root = "a"}),
                    Contains("joint 'end': it mimics 'master', which is not between root and tip: "
                             "lock 'master' at a position"));
}

TEST_CASE("limits of many turns are reported") {
  const auto notices = [](const char* type, const char* lower, const char* upper) {
    const std::string limit = "<limit lower=\"" + std::string(lower) + "\" upper=\"" + upper +
                              "\" effort=\"9\" velocity=\"2\"/>";
    return read_urdf(UrdfSource(robot("<link name=\"base\"/>" + solid("a") +
                                      joint("elbow", type, "base", "a", limit))))
        ->notices;
  };
  CHECK(notices("revolute", "-1", "170") ==
        Notices{"joint 'elbow': its limits, -1 .. 170 rad, are more than four turns from 0; are "
                "they degrees?"});
  CHECK(notices("revolute", "-25.2", "1").size() == 1);
  CHECK(notices("revolute", "-25.1", "25.1").empty());
  CHECK(notices("prismatic", "-1", "170").empty());
}

TEST_CASE("angles of more than a turn and inertias of giants are reported") {
  const auto notices = [](const std::string& links, const std::string& origin) {
    return read_urdf(UrdfSource(robot("<link name=\"base\"/>" + links +
                                      joint("elbow", "continuous", "base", "a", origin))))
        ->notices;
  };
  CHECK(notices(solid("a"), "<origin rpy='0 -90 0'/>") ==
        Notices{"joint 'elbow': <origin>: rpy 0 -90 0 rad is more than a turn; are these "
                "degrees?"});
  CHECK(notices(solid("a"), "<origin rpy='6.2832 0 -6.28319'/>").empty());
  const auto link = [](const char* angle, const char* inertia) {
    const std::string i(inertia);
    return "<link name='a'><inertial><origin rpy='0 0 " + std::string(angle) +
           "'/><mass value='2'/><inertia ixx='" + i + "' iyy='" + i + "' izz='" + i +
           "' ixy='0' ixz='0' iyz='0'/></inertial></link>";
  };
  CHECK(notices(link("1", "4500"), "").empty());
  CHECK(notices(link("90", "4500"), "") ==
        Notices{"link 'a': <inertial>: <origin>: rpy 0 0 90 rad is more than a turn; are "
                "these degrees?"});
  CHECK(notices(link("0", "20000"), "") ==
        Notices{"link 'a': <inertial>: the inertia is that of 2 kg at a distance of 100 m; is it "
                "in kg m^2?"});
}

TEST_CASE("limits that are expressions in braces are ignored and reported") {
  std::string file = support::pendulum();
  file.insert(file.rfind("</robot>"),
              "<ros2_control name='c' type='system'><joint name='pivot'><command_interface "
              "name='effort'><param name='min'>{-2*pi}</param><param "
              "name='max'>3</param></command_interface></joint>"
              "</ros2_control>");
  const UrdfDescription pendulum = read_urdf(UrdfSource(file));
  CHECK(pendulum->notices ==
        std::vector<std::string>{"<ros2_control>: joint 'pivot': effort min: '{-2*pi}' is not "
                                 "a number and is ignored",
                                 "<ros2_control>: joint 'pivot': effort: min -inf and max 3 "
                                 "differ; 3 is used in both directions"});
  CHECK(pendulum->joints[0].limits.effort == 3);
}

TEST_CASE("a place beyond the limits is reported") {
  const std::string limit = "<limit lower=\"-1\" upper=\"1\" effort=\"9\" velocity=\"2\"/>";
  const std::string file = robot(
      "<link name=\"base\"/>" + solid("a") + solid("b") + solid("c") +
      joint("elbow", "revolute", "base", "a", limit) +
      joint("follower", "revolute", "a", "b", limit + "<mimic joint=\"elbow\" multiplier=\"2\"/>") +
      joint("wheel", "continuous", "b", "c") +
      "<ros2_control name=\"c\" type=\"system\"><joint name=\"elbow\"><state_interface "
      "name=\"position\"><param name=\"initial_value\">1.5</param></state_interface></joint>"
      "</ros2_control>");
  const auto notices = [&](const UrdfOptions& options) {
    return read_urdf(UrdfSource(file), options)->notices;
  };
  CHECK(notices({}) ==
        Notices{"joint 'elbow': its initial_value is 1.5, beyond its limits, -1 .. 1"});
  CHECK(notices({.locked = {{"elbow", 0.5}, {"follower", -1}}}).empty());
  CHECK(notices({.locked = {{"elbow", 0.75}}}) ==
        Notices{"joint 'follower': it is locked at 1.5, beyond its limits, -1 .. 1"});
  CHECK(notices({.locked = {{"elbow", -1.25}, "follower"}}) ==
        Notices{"joint 'elbow': it is locked at -1.25, beyond its limits, -1 .. 1"});
  CHECK(notices({.root = "b", .locked = {{"elbow", 3}, "follower"}, .gravity = {0, 0, -1.6}})
            .size() == 1);
  CHECK(notices({.locked = {{"wheel", 100}}}).size() == 1);  // of the initial_value
}

TEST_CASE("ignored limits and reductions of 0 are reported") {
  const auto notices = [](const std::string& text) { return read_urdf(UrdfSource(text))->notices; };
  const auto limited = [&](const std::string& bounds) {
    return notices(support::pendulum(solid("rod"),
                                     joint("pivot", "continuous", "base", "rod",
                                           "<limit effort=\"1\" velocity=\"1\" " + bounds + "/>")));
  };
  CHECK(limited("").empty());
  CHECK(limited("lower=\"0\" upper=\"0\"").empty());
  REQUIRE(limited("lower=\"-1\" upper=\"2\"").size() == 1);
  CHECK(limited("lower=\"-1\" upper=\"2\"")[0] ==
        "joint 'pivot': it is continuous, so its position limits, -1 .. 2, are ignored");
  CHECK(notices(controlled("<command_interface name=\"position\">" + param("max", "3") +
                           "</command_interface>"))
            .size() == 1);

  std::string geared = support::pendulum();
  geared.insert(geared.rfind("</robot>"),
                "<transmission name=\"t\"><joint name=\"pivot\"/><actuator name=\"m\">"
                "<mechanicalReduction>0</mechanicalReduction></actuator></transmission>");
  REQUIRE(notices(geared).size() == 1);
  CHECK(notices(geared)[0] ==
        "transmission 't': actuator 'm': its mechanical reduction is 0, so it moves nothing");
}

TEST_CASE("a mimic in ros2_control alone is reported") {
  const auto notices = [](const std::string& mimic, const std::string& attributes,
                          const std::string& inside) {
    return read_urdf(UrdfSource(robot("<link name=\"base\"/>" + solid("a") + solid("b") +
                                      joint("i", "continuous", "base", "a") +
                                      joint("k", "continuous", "base", "b", mimic) +
                                      "<ros2_control name=\"c\" type=\"system\"><joint name=\"k\"" +
                                      attributes + ">" + inside + "</joint></ros2_control>")))
        ->notices;
  };
  const std::string follower = "<mimic joint=\"i\"/>",
                    counts = "' is ignored: only <mimic> in the joint itself is read";
  const std::string absent =
      "<ros2_control>: joint 'k': it mimics 'i', which is not in its <ros2_control>";
  CHECK(notices(follower, "", param("mimic", "i")) == Notices{absent});
  CHECK(notices(follower, " mimic=\"true\"", "") == Notices{absent});
  REQUIRE(notices("", "", param("mimic", "i") + param("multiplier", "2")).size() == 1);
  CHECK(notices("", "", param("mimic", "i"))[0] == "<ros2_control>: joint 'k': mimic 'i" + counts);
  REQUIRE(notices(follower, " mimic=\"false\"", "").size() == 1);
  CHECK(notices(follower, " mimic=\"false\"", "")[0] ==
        "<ros2_control>: joint 'k': mimic 'false" + counts);
}

TEST_CASE("elements that occur twice and are equal or ignored are reported") {
  const auto notices = [](const std::string& inside, const std::string& type = "continuous") {
    const std::string file = robot("<link name=\"base\"/>" + solid("rod") + solid("tip") +
                                   joint("pivot", "continuous", "base", "rod") +
                                   joint("end", type, "rod", "tip", inside));
    return read_urdf(UrdfSource(file))->notices;
  };
  const std::string second = "joint 'end': a second <";
  CHECK(notices("<axis xyz=\"0 0 1\"/><axis xyz=\" 0 0.0\t1e0\"/><axis xyz=\"0 0 1\"/>") ==
        Notices{second + "axis> repeats the first"});
  CHECK(notices("<parent link=\"rod\"/><limit effort=\"1\" velocity=\"1\"/>"
                "<limit velocity=\"1\" effort=\"1\"/>") ==
        Notices{second + "parent> repeats the first", second + "limit> repeats the first"});
  CHECK(notices("<safety_controller k_velocity=\"1\"/><safety_controller k_velocity=\"2\"/>") ==
        Notices{second + "safety_controller> is ignored",
                "joint 'end': <safety_controller>: k_velocity is ignored"});
  CHECK(notices("<dynamics damping=\"1\"/><dynamics damping=\"2\"/><gazebo/><gazebo/>", "fixed") ==
        Notices{second + "dynamics> is ignored"});
  // What is left out says what it is by default.
  CHECK(notices("<origin rpy=\"0 0 0\"/><origin xyz=\"0 0 0\"/>") ==
        Notices{second + "origin> repeats the first"});
  CHECK_THROWS_WITH(notices("<origin xyz=\"1 0 0\"/><origin/>", "fixed"),
                    Contains("joint 'end': a second <origin> differs from the first"));
  std::string twice = solid("rod");
  const std::size_t begin = twice.find("<inertial>");
  const std::string inertial = twice.substr(begin, twice.find("</link>") - begin);
  twice.insert(begin, inertial + "<visual/><visual/><collision/><collision/>");
  CHECK(read_urdf(UrdfSource(support::pendulum(twice)))->notices ==
        Notices{"link 'rod': a second <inertial> repeats the first"});
}

TEST_CASE("a word that many links or joints have is reported once") {
  std::string inside = "<link name=\"l0\"/>";
  for (int i = 1; i <= 28; ++i) {
    const std::string name = "l" + std::to_string(i), before = "l" + std::to_string(i - 1);
    inside += solid(name) + joint("j" + std::to_string(i), "continuous", before, name,
                                  "<dynamics damping=\"1\" D=\"1\"/><self_collision_checking/>"
                                  "<self_collision_checking/>" +
                                      std::string(i % 14 == 3 ? "<axes/>" : "") +
                                      std::string(i == 5 ? "<axsi/>" : ""));
  }
  const std::string tail = " is unknown and is ignored";
  CHECK(read_urdf(UrdfSource(robot(inside)))->notices ==
        std::vector<std::string>{
            "joint 'j1': <dynamics>: the attribute 'D'" + tail + "; also in 27 others",
            "joint 'j1': <joint>: the element <self_collision_checking>" + tail +
                "; also in 27 others",
            "joint 'j3': <joint>: the element <axes>" + tail +
                "; did you mean 'axis'? Also in 1 other",
            "joint 'j5': <joint>: the element <axsi>" + tail + "; did you mean 'axis'?"});
}

TEST_CASE("words that URDF does not know are reported") {
  const auto notices = [](const std::string& inside, const std::string& attributes = "") {
    const std::string pivot = "<joint name=\"pivot\" type=\"continuous\"" + attributes +
                              "><parent link=\"base\"/><child link=\"rod\"/>" + inside + "</joint>";
    return read_urdf(UrdfSource(support::pendulum(solid("rod"), pivot)))->notices;
  };
  const auto about = [](const std::string& place, const std::string& word,
                        const std::string& meant = "") {
    return place + word + " is unknown and is ignored" +
           (meant.empty() ? "" : "; did you mean " + meant + "?");
  };
  const std::string pivot = "joint 'pivot': ";

  SECTION("of joints") {
    CHECK(notices("<limit uper=\"1.2\" effort=\"1\" velocity=\"1\"/>") ==
          Notices{about(pivot + "<limit>: ", "the attribute 'uper'", "'upper'")});
    CHECK(notices("<axes xyz=\"0 0 1\"/>") ==
          Notices{about(pivot + "<joint>: ", "the element <axes>", "'axis'")});
    CHECK(notices("<dynamic damping=\"1\"/>") ==
          Notices{about(pivot + "<joint>: ", "the element <dynamic>", "'dynamics'")});
    CHECK(notices("<dynamics damping=\"1\" frcitoin=\"1\" fricton=\"1\"/>") ==
          Notices{about(pivot + "<dynamics>: ", "the attribute 'frcitoin'", "'friction'"),
                  about(pivot + "<dynamics>: ", "the attribute 'fricton'", "'friction'")});
    CHECK(notices("<origin XYZ=\"1 0 0\" quat_xyzw=\"0 0 0 1\"/>") ==
          Notices{about(pivot + "<origin>: ", "the attribute 'XYZ'", "'xyz'"),
                  about(pivot + "<origin>: ", "the attribute 'quat_xyzw'")});
    CHECK(notices("<joint_properties damping=\"1\"/><joint_properties/>", " damping=\"1\"") ==
          Notices{about(pivot + "<joint>: ", "the attribute 'damping'"),
                  about(pivot + "<joint>: ", "the element <joint_properties>")});
    CHECK(notices("<axis xyz=\"0 0 1\"><xyz/></axis>") ==
          Notices{about(pivot + "<axis>: ", "the element <xyz>")});
  }
  SECTION("of links, and before those that they explain") {
    const std::string rod =
        "<link name=\"a\nrod\"><inertial_ ixx=\"1\"/><visuals/><inertial><mass value=\"2\" "
        "unit=\"kg\"/><origin xzy=\"1 0 0\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" "
        "iyz=\"0\" izz=\"1\" iyx=\"0\"/></inertial></link>";
    const std::string limit = "<limit lower=\"0\" uper=\"1\" effort=\"1\" velocity=\"1\"/>";
    const std::string link = "link 'a rod': ";
    CHECK(
        read_urdf(
            UrdfSource(support::pendulum(rod, joint("pivot", "revolute", "base", "a\nrod", limit))))
            ->notices == Notices{about(link + "<link>: ", "the element <inertial_>", "'inertial'"),
                                 about(link + "<link>: ", "the element <visuals>", "'visual'"),
                                 about(link + "<mass>: ", "the attribute 'unit'"),
                                 about(link + "<origin>: ", "the attribute 'xzy'", "'xyz'"),
                                 // ixx, iyy and iyz are as close.
                                 about(link + "<inertia>: ", "the attribute 'iyx'"),
                                 about(pivot + "<limit>: ", "the attribute 'uper'", "'upper'"),
                                 pivot + "it cannot move: its lower and upper limits are 0"});
  }
  SECTION("not what others read") {
    CHECK(notices("<calibration rising=\"1\"/>"
                  "<gazebo><limits/></gazebo><drake:spring k=\"1\"/>"
                  "<limit lower=\"0\" upper=\"0\" effort=\"1\" velocity=\"1\" acceleration=\"1\" "
                  "drake:jerk=\"1\"/>",
                  " xmlns=\"http://www.ros.org\"")
              .empty());
    CHECK(read_urdf(UrdfSource(support::pendulum(
                        "<link name=\"rod\" type=\"laser\"><visual><orign/></visual><collision "
                        "nam=\"c\"><geometri/></collision><sensor/>" +
                        solid("rod").substr(solid("rod").find("<inertial>")) +
                        "<jont><limt/></jont><joints/>")))
              ->notices.empty());
  }
}
