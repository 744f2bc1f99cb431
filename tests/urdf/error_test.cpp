// SPDX-License-Identifier: Apache-2.0
/// @file An error of a URDF is one line with file, element, reason and figures.
#include <articula/urdf/urdf.hpp>

#include <console_bridge/console.h>

#include "catch.hpp"
#include "urdf_text.hpp"

#include <array>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <utility>

using namespace articula;
using Catch::Contains;
using support::joint;
using support::pendulum;
using support::robot;
using support::solid;

namespace {

const std::string base = "<link name=\"base\"/>";

/// The message of the exception, empty if none is thrown.
std::string refusal(const std::string& source, const UrdfOptions& options = {}) {
  try {
    static_cast<void>(load_urdf<1>(source, options));
  } catch (const FileError& error) {
    const std::string message = error.what();
    CHECK(message.find('\n') == std::string::npos);
    return message;
  }
  return "";
}

/// The end of a message about a mass that is missing.
const std::string kinematic =
    "; to load the robot without masses and dynamics, use load_kinematic_urdf (KINEMATIC in CMake, "
    "or articula run --mock)";

/// A pendulum whose joint has that inside.
std::string with_joint(const std::string& inside, const std::string& type = "continuous") {
  return pendulum(solid("rod"), joint("pivot", type, "base", "rod", inside));
}

/// A pendulum whose rod has that <inertial>.
std::string with_inertial(const std::string& inside) {
  return pendulum("<link name=\"rod\"><inertial>" + inside + "</inertial></link>");
}

std::string inertial(const std::string& mass, const std::string& ixx = "1",
                     const std::string& ixy = "0") {
  return with_inertial("<mass value=\"" + mass + "\"/><inertia ixx=\"" + ixx + "\" ixy=\"" + ixy +
                       "\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/>");
}

}  // namespace

TEST_CASE("A good URDF is accepted") {
  CHECK(refusal(pendulum()).empty());
  CHECK(refusal(inertial("2")).empty());
}

TEST_CASE("Files that cannot be read") {
  CHECK(refusal("no/such.urdf") == "no/such.urdf: the file cannot be read");
  CHECK(refusal("/") == "/: it is a folder, expected a file");
  CHECK(refusal("") == ": the file cannot be read");
  CHECK(refusal(std::string("<robot>\0</robot>", 16)) ==
        "URDF:1:8: a NUL character, expected UTF-8 text (UTF-16 is not supported)");
}

TEST_CASE("The file is named") {
  const auto file = std::filesystem::temp_directory_path() / "articula_error_test.urdf";
  std::ofstream(file) << inertial("-0.3");
  CHECK(refusal(file.string()) == file.string() + ": link 'rod': the mass is negative (-0.3 kg)");
  std::filesystem::remove(file);
}

TEST_CASE("Text that is not XML") {
  CHECK(refusal("<") == "URDF:1: a tag has no name");
  CHECK(refusal("<robot name=r>") == "URDF:1: an attribute's value is not in quotes");
  CHECK(refusal("<robot\n name=\"r") == "URDF:2: an attribute's value is not in quotes");
  CHECK(refusal("<robot a>") == "URDF:1: an attribute has no value");
  CHECK(refusal("<robot name='r'>\n\n<link name='a'/>") ==
        "URDF:3: <robot> of line 1 is not closed");
  CHECK(refusal("<robot name='r'></robot></link>") == "URDF:1: </link> closes no open element");
  CHECK(refusal("<robot name='r'>\n<link name='a'>\n\n</robot>") ==
        "URDF:4: </robot> is found, but <link> of line 2 is open");
  CHECK(refusal("<!-- <robot>") == "URDF:1: a comment is not closed");
  CHECK(refusal("<![CDATA[ <robot>") == "URDF:1: a CDATA section is not closed");
  CHECK(refusal("<?xml version='1.0'>") == "URDF:1: a <? is not closed by ?>");
  CHECK(refusal("<!ELEMENT robot><robot/>") ==
        "URDF:1: <! begins neither a comment, a CDATA section nor a document type");
  CHECK(refusal("<robot\n name='r' name='s'/>") == "URDF:2: the attribute 'name' is given twice");
  CHECK(refusal(pendulum() + "\n" + pendulum()) ==
        "URDF:2: there is a second top element; XML allows one");
  CHECK(refusal(pendulum() + "\n\n>") == "URDF:3: there is text outside of the top element");
  const auto file = std::filesystem::temp_directory_path() / "articula_no_xml_test.urdf";
  const std::string nul = ":1:";
  const std::string utf8 = ": a NUL character, expected UTF-8 text (UTF-16 is not supported)";
  for (const auto& [text, fault] :
       {std::pair<std::string, std::string>{" \n", ": this is not XML: it has no tag"},
        {"version 1", ": this is not XML: it has no tag"},
        {std::string("\xFF\xFE<\0r\0", 6), nul + "4" + utf8},
        {std::string("<\0r\0", 4), nul + "2" + utf8},
        {std::string("\0<\0r", 4), nul + "1" + utf8}}) {
    std::ofstream(file, std::ios::binary) << text;
    CHECK(refusal(file.string()) == file.string() + fault);
  }
  std::filesystem::remove(file);
}

TEST_CASE("Declarations of a document type are refused where they are used") {
  const auto with = [](const std::string& declarations, const std::string& robot = pendulum()) {
    return refusal("<!DOCTYPE robot [" + declarations + "]>\n" + robot);
  };
  const std::string entity = "<!ENTITY m '2'>";
  CHECK(with(entity).empty());
  std::string used = pendulum();
  used.replace(used.find("\"2\""), 3, "\"&m;\"");
  CHECK(with(entity, used) ==
        "URDF:2: the entity &m; is not supported: write its text (&amp; &lt; &gt; &quot; "
        "&apos; are "
        "supported)");
  CHECK(refusal("<robot name='r'>\n&m;</robot>") ==
        "URDF:2: the entity &m; is not supported: write its text (&amp; &lt; &gt; &quot; "
        "&apos; are "
        "supported)");
  CHECK(with("<!ATTLIST joint type CDATA 'fixed'>") ==
        "URDF:1: values of attributes in a document type are not supported");
  CHECK(with("<!ATTLIST joint type CDATA #IMPLIED> <!ENTITY m '2'>").empty());
  CHECK(with("<!ENTITY % x '<!ENTITY m 2>'>").empty());
  CHECK(with("<!ENTITY % x ''> %x;") ==
        "URDF:1: the use of an entity in a document type is not supported");
  CHECK(with("<!ENTITY m ']>\n") == "URDF:1: the document type is not closed");
  CHECK(refusal("<!DOCTYPE robot [\n") == "URDF:2: the document type is not closed");
  CHECK(refusal("<!DOCTYPE robot [<!--\n]>") == "URDF:1: a comment is not closed");
  CHECK(refusal("<robot name='r'><!DOCTYPE robot></robot>") ==
        "URDF:1: the document type must stand before the top element");
  CHECK(refusal("<!DOCTYPE robot>\n<!DOCTYPE robot>\n" + pendulum()) ==
        "URDF:2: there is a second document type; XML allows one");
  CHECK(refusal("<?x a=\"?>\"?>\n" + pendulum()) ==  // ends at the first ?>
        "URDF:1: there is text outside of the top element");
}

TEST_CASE("Unexpanded xacro is refused") {
  const std::string advice =
      " is unexpanded xacro: run `xacro r.xacro > r.urdf` and load the result";
  CHECK(refusal(robot("<xacro:property name='m' value='2'/><xacro:arm/>")) ==
        "URDF: <xacro:property>" + advice);
  std::string text = pendulum();  // complete, but for what is to be added
  CHECK(refusal(text.insert(text.rfind("</robot>"), "<xacro:if value='1'/>")) ==
        "URDF: <xacro:if>" + advice);
  CHECK(refusal(with_joint("<limit effort=\"${e}\" velocity=\"1\"/>")) ==
        "URDF: joint 'pivot': '${e}'" + advice);
  CHECK(refusal(
            pendulum(solid("$(arg p)rod"), joint("pivot", "continuous", "base", "$(arg p)rod"))) ==
        "URDF: link '$(arg p)rod': '$(arg p)rod'" + advice);
}

TEST_CASE("Links and joints with capital letters are refused") {
  CHECK(refusal(robot(base + solid("rod") + "<Joint name=\"pivot\" type=\"fixed\"/>")) ==
        "URDF: <Joint name=\"pivot\">: write the element's name as <joint>");
}

TEST_CASE("Elements nested without end") {
  std::string deep;
  for (int i = 0; i < 1000000; ++i) deep += "<a>";
  CHECK(refusal(deep) == "URDF:1: elements are nested more than 100 deep");
}

TEST_CASE("XML without a robot") {
  CHECK(refusal("<link name='a'/>") == "URDF: the top element must be <robot>, but is <link>");
  CHECK(refusal("<robot/>") == "URDF: No name given for the robot.");
  CHECK(refusal(robot("")) == "URDF: No link elements found in urdf file");
  CHECK(refusal(robot(base)) == "URDF: robot 'r': no joint moves");
}

TEST_CASE("Inertias of no real body") {
  CHECK(
      refusal(inertial("0")) ==
      "URDF: link 'rod': the link has inertia but no mass (mass 0 kg, principal moments of inertia "
      "1, 1, 1 kg m^2); to accept it, set allow_unphysical (ALLOW_UNPHYSICAL in CMake, "
      "--allow-unphysical of articula)");
  CHECK(
      refusal(inertial("1", "2.5")) ==
      "URDF: link 'rod': the inertia breaks the triangle inequality (mass 1 kg, principal moments "
      "of inertia 1, 1, 2.5 kg m^2); to accept it, set allow_unphysical (ALLOW_UNPHYSICAL in "
      "CMake, --allow-unphysical of articula)");
  CHECK(refusal(inertial("1", "1", "-1.5")) ==
        "URDF: link 'rod': the inertia is not positive definite (mass 1 kg, principal moments of "
        "inertia -0.5, 1, 2.5 kg m^2); to accept it, set allow_unphysical (ALLOW_UNPHYSICAL in "
        "CMake, --allow-unphysical of articula)");
  const std::string bad =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
      "izz='2.5'/></inertial>";
  const auto link = [&](const char* name) {
    return "<link name='" + std::string(name) + "'>" + bad + "</link>";
  };
  CHECK(
      refusal(robot(base + link("rod") + link("tool") + link("flag") +
                    "<joint name='pivot' type='continuous'><parent link='base'/><child link='rod'/>"
                    "<axis xyz='0 0 1'/></joint><joint name='weld' type='fixed'><parent "
                    "link='rod'/><child link='tool'/></joint><joint name='weld2' "
                    "type='fixed'><parent link='rod'/><child link='flag'/></joint>")) ==
      "URDF: link 'rod': the inertia breaks the triangle inequality (mass 1 kg, principal moments "
      "of inertia 1, 1, 2.5 kg m^2); to accept it and those of 'tool', 'flag', set "
      "allow_unphysical (ALLOW_UNPHYSICAL in CMake, --allow-unphysical of articula)");
  CHECK(refusal(inertial("-1"), {.allow_unphysical = true}) ==
        "URDF: link 'rod': the mass is negative (-1 kg)");
  CHECK(refusal(pendulum("<link name='rod'/>")) ==
        "URDF: joint 'pivot': the joint moves no link that has mass (lock it, or give link "
        "'rod' a mass)" +
            kinematic);
}

TEST_CASE("Texts that are not numbers") {
  for (const char* number : {"nan", "inf", "-inf", "1e999", "1,5", "0x10", "2 kg", "", "--1"}) {
    CAPTURE(number);
    CHECK(refusal(inertial(number)).find("rod") != std::string::npos);
    CHECK(refusal(with_joint("<limit effort=\"" + std::string(number) + "\" velocity=\"1\"/>"))
              .find("pivot") != std::string::npos);
    CHECK(refusal(with_joint("<origin xyz=\"0 0 " + std::string(number) + "\"/>")).find("pivot") !=
          std::string::npos);
    CHECK(refusal(with_joint("<origin rpy=\"0 0 " + std::string(number) + "\"/>")).find("pivot") !=
          std::string::npos);
  }
  const std::string useless =
      "a number is NaN, infinite or too large (more than 1e50, or an angle of more than 1e9 rad)";
  CHECK(refusal(with_joint("<origin xyz=\"1e50 0 0\"/>")).empty());
  CHECK(refusal(with_joint("<origin xyz=\"1e51 0 0\"/>")) == "URDF: joint 'pivot': " + useless);
  CHECK(refusal(with_inertial("<origin xyz=\"1e200 0 0\"/><mass value=\"2\"/><inertia ixx=\"1\" "
                              "ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/>")) ==
        "URDF: link 'rod': " + useless);
  CHECK(refusal(with_joint("<axis xyz=\"1e200 0 0\"/>")).empty());  // a direction like any other
}

TEST_CASE(
    "A text that is not a number is named with its element, and never used as a format of printf") {
  const std::string none = "' is not a finite number";
  std::map<std::string, std::string> messages = {
      {"pi/2", "'pi/2" + none + "; expressions are not computed"},
      {"1\xC2\xA0", "'1<U+00A0>' with a no-break space (U+00A0) is not a finite number"},
      {"\xE2\x88\x92"
       "1",
       "'\xE2\x88\x92"
       "1" +
           none + "; write an ordinary minus sign, -"}};
  for (const std::string text : {"%s%s%s%s%s%s%s%s%n%n", "A%dB", "%kp%", "@kp@", "1_000", "inf"}) {
    messages[text] = "'" + text + none;
  }
  for (const auto& [text, message] : messages) {
    CAPTURE(text);
    CHECK(refusal(inertial(text)) == "URDF: link 'rod': <mass>: value: " + message);
    CHECK(refusal(inertial("1", text)) == "URDF: link 'rod': <inertia>: ixx: " + message);
    CHECK(refusal(with_inertial("<origin rpy=\"0 " + text + " 0\"/><mass value=\"1\"/>")) ==
          "URDF: link 'rod': <origin>: rpy: " + message);
    for (const auto& [name, attribute] : {std::pair<std::string, std::string>{"origin", "xyz"},
                                          {"axis", "xyz"},
                                          {"limit", "lower"},
                                          {"dynamics", "friction"},
                                          {"mimic", "multiplier"}}) {
      CHECK(refusal(with_joint("<" + name + " " + attribute + "=\"" + text + "\"/>")) ==
            "URDF: joint 'pivot': <" + name + ">: " + attribute + ": " + message);
    }
  }
  const std::string axis = "URDF: joint 'pivot': <axis>: xyz: '";
  CHECK(refusal(with_joint("<axis xyz=\"0 0 1,5\"/>")) ==
        axis + "1,5" + none + "; write 1.5 if the comma is a decimal one");
  CHECK(refusal(with_joint("<axis xyz=\"0, 0 1\"/>")) ==
        axis + "0," + none + "; write the number alone, 0");
  for (const std::string text : {"0,0,", "0,0,1"}) {
    CHECK(refusal(with_joint("<axis xyz=\"" + text + " 0 1\"/>")) ==
          axis + text + none + "; separate numbers by blanks, not by commas");
  }
  for (const std::string text : {"{{ m }}", "{% m %}", "<%= m %>"}) {
    CHECK(refusal(inertial(text)) ==
          "URDF: link 'rod': '" + text +
              "' is an unexpanded placeholder: run the template tool and load "
              "the result");
  }
}

TEST_CASE("An inertia that urdfdom cannot read is not left out") {
  CHECK(refusal(with_inertial("<mass value=\"1\"/>")).find("[rod]") != std::string::npos);
  CHECK(refusal(with_inertial("<mass/>")).find("[rod]") != std::string::npos);
}

TEST_CASE("Elements that occur twice and differ") {
  const std::string limit = "<limit effort=\"1\" velocity=\"1\"/>",
                    other = " differs from the first: remove one of them";
  for (const auto& [name, inside] :
       {std::pair<std::string, std::string>{"limit",
                                            limit + "<limit effort=\"2\" velocity=\"1\"/>"},
        {"limit", limit + "<limit effort=\"1\" velocity=\"1\" lower=\"-1\"/>"},
        {"mimic", "<mimic joint=\"a\"/><mimic joint=\"b\"/>"},
        {"axis", "<axis xyz=\"0 0 1\"/><axis xyz=\"0 1 0\"/>"},
        {"axis", "<axis xyz=\"0 0 1\"/><axis/>"},
        {"origin", "<origin xyz=\"1 0 0\"/><origin xyz=\"1 0 0\" rpy=\"0 0 1\"/>"},
        {"dynamics", "<dynamics damping=\"1\"/><dynamics friction=\"1\"/>"},
        {"parent", "<parent link=\"other\"/>"},
        {"child", "<child link=\"other\"/>"}}) {
    INFO(inside);
    CHECK(refusal(with_joint(inside)) == "URDF: joint 'pivot': a second <" + name + ">" + other);
  }
  const std::string mass = "<mass value=\"2\"/>",
                    inertia =
                        "<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" "
                        "izz=\"1\"/>";
  const std::string twice = "</inertial><inertial>";
  for (const auto& [name, inside] :
       {std::pair<std::string, std::string>{"mass", mass + "<mass value=\"3\"/>" + inertia},
        {"inertia", mass + inertia + "<inertia ixx=\"2\"/>"},
        {"origin", "<origin/><origin xyz=\"0 0 1\"/>" + mass + inertia},
        {"inertial", mass + inertia + twice + "<mass value=\"3\"/>" + inertia},
        {"inertial", mass + inertia + twice + mass + inertia + "<origin xyz=\"0 0 1\"/>"}}) {
    INFO(inside);
    CHECK(refusal(with_inertial(inside)) == "URDF: link 'rod': a second <" + name + ">" + other);
  }
}

TEST_CASE("Impossible joints") {
  CHECK(refusal(with_joint("<axis xyz=\"0 0 0\"/>")) ==
        "URDF: joint 'pivot': the axis has length 0 (0 0 0)");
  CHECK(refusal(with_joint("<limit lower=\"1\" upper=\"-0.5\" effort=\"1\" velocity=\"1\"/>",
                           "revolute")) ==
        "URDF: joint 'pivot': the lower limit is above the upper limit (lower 1, upper -0.5)");
  CHECK(refusal(with_joint("<limit effort=\"-2\" velocity=\"1\"/>")) ==
        "URDF: joint 'pivot': the effort limit is negative (-2)");
  CHECK(refusal(with_joint("<limit effort=\"2\" velocity=\"-1\"/>")) ==
        "URDF: joint 'pivot': the velocity limit is negative (-1)");
  CHECK(refusal(with_joint("<dynamics damping=\"-0.1\"/>")) ==
        "URDF: joint 'pivot': the damping is negative (-0.1)");
  CHECK(refusal(with_joint("<dynamics friction=\"-0.1\"/>")) ==
        "URDF: joint 'pivot': the friction is negative (-0.1)");
  CHECK(refusal(with_joint("", "revolute")).find("[pivot]") != std::string::npos);  // no limits
  CHECK(refusal(with_joint("<limit lower=\"0\"/>", "revolute")).find("[pivot]") !=
        std::string::npos);
  CHECK(refusal(with_joint("", "ball")).find("[ball]") != std::string::npos);
  for (const char* type : {"planar", "floating"}) {
    CHECK(refusal(with_joint("", type)) ==
          "URDF: joint 'pivot': it is " + std::string(type) +
              ", but joints must have one degree of freedom: lock it, or choose a root beyond it");
  }
}

TEST_CASE("Floating joints can be locked or left behind") {
  const std::string text =
      robot(base + solid("body") + solid("rod") + joint("float", "floating", "base", "body") +
            joint("pivot", "continuous", "body", "rod"));
  CHECK(refusal(text).find("floating") != std::string::npos);
  CHECK(refusal(text, {.locked = {"float"}}).empty());
  CHECK(refusal(text, {.root = "body"}).empty());
  CHECK(refusal(text, {.locked = {{"float", 1}}}).find("floating") != std::string::npos);
}

TEST_CASE("Links that do not form a tree") {
  const std::string a = solid("a"), b = solid("b"), c = solid("c");
  CHECK(refusal(robot(a + b + joint("i", "continuous", "a", "b") +
                      joint("j", "continuous", "a", "b"))) ==
        "URDF: link 'b': it is the child of two joints, 'i' and 'j'");
  CHECK(refusal(robot(a + b + joint("i", "continuous", "a", "b") +
                      joint("j", "continuous", "b", "a"))) ==
        "URDF: link 'a': it is part of a loop");
  CHECK(refusal(robot(a + b + c + joint("i", "continuous", "b", "c") +
                      joint("j", "continuous", "c", "b"))) ==
        "URDF: link 'b': it is part of a loop");
  CHECK(refusal(robot(a + joint("i", "continuous", "a", "a"))) ==
        "URDF: link 'a': it is part of a loop");
  CHECK(refusal(robot(a + b)) ==
        "URDF: Failed to find root link: Two root links found: [a] and [b]");
  CHECK(refusal(robot(a + "<link name='b'>" + joint("i", "continuous", "a", "b") + "</link>")) ==
        "URDF: Failed to find root link: Two root links found: [a] and [b]; a possible "
        "cause: link 'b': <link>: the element <joint> is unknown and is ignored");
  CHECK(refusal(robot(a + joint("i", "continuous", "a", "x"))) ==
        "URDF: joint 'i': its child link 'x' is not a <link> of the file; links: a");
  CHECK(refusal(robot(a + solid("forearm") + joint("i", "continuous", "foreram", "a"))) ==
        "URDF: joint 'i': its parent link 'foreram' is not a <link> of the file; did you mean "
        "'forearm'?");
  CHECK(refusal(robot(a + solid("FORE_ARM") + joint("i", "continuous", "FORE_AMR", "a"))) ==
        "URDF: joint 'i': its parent link 'FORE_AMR' is not a <link> of the file; did you mean "
        "'FORE_ARM'?");
  CHECK_THAT(refusal(robot("<link/>" + a + joint("i", "continuous", "a", "x"))),
             Contains("No name given for the link"));
  CHECK_THAT(refusal(robot(a + a + joint("i", "continuous", "a", "x"))), Contains("not unique"));
  // In time, though words as long as these could be compared letter by letter for minutes.
  const std::string long_name(60000, 'x'), other(60000, 'y');
  CHECK_THAT(refusal(robot(a + solid(long_name) + joint("i", "continuous", "a", other))),
             Contains("'" + other + "' is not a <link> of the file"));
  CHECK(refusal(robot(a + "<joint name='i' type='fixed'/>")) ==
        "URDF: joint 'i': it has no child link");
}

TEST_CASE("Invalid names") {
  const std::string a = solid("a"), long_name(64, 'x'), longest(63, 'x');
  CHECK(refusal(robot(a + a)) == "URDF: link 'a' is not unique.");
  CHECK(refusal(robot(a + solid("b") + solid("c") + joint("i", "continuous", "a", "b") +
                      joint("i", "continuous", "b", "c"))) == "URDF: joint 'i' is not unique.");
  CHECK(!refusal(robot(solid("") + a + joint("i", "continuous", "", "a"))).empty());
  CHECK(refusal(robot(base + a + joint("", "continuous", "base", "a"))) ==
        "URDF: joint '': the name is missing");
  CHECK(refusal(robot(base + solid(longest) + joint("i", "continuous", "base", longest))).empty());
  CHECK(refusal(robot(base + solid(long_name) + joint("i", "continuous", "base", long_name))) ==
        "URDF: '" + long_name + "': the name has 64 characters; at most 63 are supported");
}

TEST_CASE("Names of odd characters") {
  // TinyXML reads bytes that are not UTF-8, and control characters, otherwise than it writes them.
  for (const char* name : {"a\xC7\x33\xC7\x1F", "\xFF", "&#x1F;", "&#0;", "a&lt;b", "\xC3\xA4"}) {
    CAPTURE(name);
    CHECK_NOTHROW(refusal(pendulum(solid(name), joint(name, "continuous", "base", name))));
  }
}

TEST_CASE("Joints that mimic no free joint") {
  const auto mimics = [](const std::string& other, const UrdfOptions& options = {}) {
    return refusal(robot(base + solid("a") + solid("b") + solid("c") +
                         joint("i", "continuous", "base", "a") + joint("j", "fixed", "base", "c") +
                         joint("k", "continuous", "a", "b", "<mimic joint=\"" + other + "\"/>")),
                   options);
  };
  CHECK(mimics("x") == "URDF: joint 'k': the mimicked joint does not exist (x)");
  CHECK(mimics("j") == "URDF: joint 'k': the mimicked joint is fixed or mimics another joint (j)");
  CHECK(mimics("k") == "URDF: joint 'k': it mimics itself");
  const std::string circle = joint("i", "continuous", "base", "a", "<mimic joint=\"k\"/>") +
                             joint("k", "continuous", "a", "b", "<mimic joint=\"i\"/>");
  CHECK(refusal(robot(base + solid("a") + solid("b") + circle)) ==
        "URDF: joint 'k': it mimics itself through 'i'");
  CHECK(
      mimics("i", {.root = "a"}) ==
      "URDF: joint 'k': it mimics 'i', which is not between root and tip: lock 'i' at a position, "
      "or choose root and tip so that it is between them");
}

TEST_CASE("An unknown word is named as a possible cause of an error in its element") {
  const std::string odd = "<limit lower='1' upper='-1' effort='1' velocity='1' uper='2'/>";
  const std::string fault = refusal(with_joint(odd, "revolute"));
  CHECK_THAT(fault,
             Contains("pivot") && Contains("a possible cause: joint 'pivot'") && Contains("uper"));
  const std::string elsewhere =
      robot("<link name='base' foo='1'/>" + solid("rod") +
            joint("pivot", "revolute", "base", "rod",
                  "<limit lower='1' upper='-1' effort='1' velocity='1'/>"));
  CHECK_THAT(refusal(elsewhere), !Contains("possible cause") && Contains("pivot"));
}

TEST_CASE("Options with names that do not exist") {
  CHECK(refusal(pendulum(), {.root = "x"}) ==
        "URDF: root 'x': there is no such link; links: base, rod");
  CHECK(refusal(pendulum(), {.tip = "x"}) ==
        "URDF: tip 'x': there is no such link; links: base, rod");
  CHECK(refusal(pendulum(), {.root = "rod", .tip = "base"}) ==
        "URDF: tip 'base': it is not a descendant of root 'rod'");
  CHECK(refusal(pendulum(), {.locked = {"x"}}) ==
        "URDF: locked joint 'x': there is no such joint; joints: pivot");
  CHECK(refusal(pendulum(), {.locked = {"pivto"}}) ==
        "URDF: locked joint 'pivto': there is no such joint; did you mean 'pivot'?");
  CHECK(refusal(pendulum(), {.gravity = {0, 0, 1e60}}) ==
        "URDF: robot 'r': a number is NaN, infinite or too large (more than 1e50, or an angle of "
        "more than 1e9 rad) (gravity)");
}

TEST_CASE("Options with unusable figures") {
  const auto tolerance = [](double value) {
    return refusal(pendulum(), {.right_angle_tolerance = value});
  };
  CHECK(tolerance(0.1).empty());
  CHECK(tolerance(0).empty());
  CHECK(tolerance(0.2) == "URDF: right_angle_tolerance 0.2 is not within 0 .. 0.1");
  CHECK(tolerance(-1e-9) == "URDF: right_angle_tolerance -1e-09 is not within 0 .. 0.1");
  CHECK(tolerance(std::numeric_limits<double>::quiet_NaN()) ==
        "URDF: right_angle_tolerance nan is not within 0 .. 0.1");
  CHECK(tolerance(std::numeric_limits<double>::infinity()) ==
        "URDF: right_angle_tolerance inf is not within 0 .. 0.1");
  CHECK_THROWS_AS(read_urdf(pendulum(), {.right_angle_tolerance = 1}), FileError);

  CHECK(refusal(pendulum(), {.locked = {{"pivot", 0}, {"pivot", 1}}}) ==
        "URDF: joint 'pivot': it is locked at two positions, 0 and 1");
  CHECK(refusal(pendulum(), {.locked = {{"pivot", std::numeric_limits<double>::infinity()}}}) ==
        "URDF: joint 'pivot': it cannot be locked at inf");
}

TEST_CASE("Impossible limits in ros2_control") {
  const auto control = [](const std::string& inside) {
    std::string text = pendulum();
    return refusal(text.insert(text.rfind("</robot>"),
                               "<ros2_control><joint name=\"pivot\">"
                               "<command_interface name=\"effort\">" +
                                   inside +
                                   "</command_interface></joint>"
                                   "</ros2_control>"));
  };
  CHECK(control("<param name=\"max\">3</param>").empty());
  CHECK(control("<param name=\"max\">much</param>") ==
        "URDF: <ros2_control>: joint 'pivot': effort max: 'much' is not a finite number");
  CHECK(control("<param name=\"min\">1e999</param>") ==
        "URDF: <ros2_control>: joint 'pivot': effort min: '1e999' is not a finite number");
  const auto bounds = [&](const std::string& min, const std::string& max) {
    return control("<param name=\"min\">" + min + "</param><param name=\"max\">" + max +
                   "</param>");
  };
  CHECK(bounds("-0.2", "0.2").empty());
  CHECK(bounds("0", "0").empty());  // no effort at all, and a notice says so
  for (const auto& [min, max, said] : {std::array{"0", "0.2", "(min 0, max 0.2)"},
                                       std::array{"-27.94", "0", "(min -27.94, max 0)"},
                                       std::array{"-0.2", "-0.0", "(min -0.2, max -0)"}}) {
    CHECK(bounds(min, max) ==
          std::string("URDF: <ros2_control>: joint 'pivot': effort: its limits ") + said +
              " exclude one direction, but a joint has one limit for both: give a min below 0 "
              "and a max above 0, or <limits enable=\"false\"/>");
  }
  CHECK_THAT(control("<param name=\"max\">0</param>"), Contains("(min -inf, max 0) exclude one"));
  CHECK(bounds("0.2", "-0.2") ==
        "URDF: <ros2_control>: joint 'pivot': effort: its limits (min 0.2, max -0.2) exclude 0");
  CHECK(bounds("{-2*pi}", "{2*pi}").empty());  // ignored, with a notice
  CHECK(control("<param name=\"max\">-5</param>") ==
        "URDF: <ros2_control>: joint 'pivot': effort: its limits (min -inf, max -5) exclude 0");
}

TEST_CASE("Limits of position in two elements must have a position in common") {
  const auto position = [](const char* min, const char* max,
                           const UrdfOptions& options = {.locked = {"turn"}}) {
    std::string text = robot(base + solid("rod") + solid("tool") +
                             joint("pivot", "revolute", "base", "rod",
                                   "<limit lower='-1' upper='1' effort='1' velocity='1'/>") +
                             joint("turn", "continuous", "rod", "tool"));
    const std::string command =
        std::string("<command_interface name='position'><param name='min'>") + min +
        "</param><param name='max'>" + max + "</param></command_interface>";
    return refusal(text.insert(text.rfind("</robot>"), "<ros2_control><joint name='pivot'>" +
                                                           command + "</joint><joint name='turn'>" +
                                                           command + "</joint></ros2_control>"),
                   options);
  };
  CHECK(position("-3", "0.5").empty());
  CHECK(position("{-pi}", "{pi}").empty());
  CHECK(
      position("3", "2") ==
      "URDF: joint 'pivot': its limits, 3 .. 2 in <ros2_control> and -1 .. 1 in <limit>, leave it "
      "no position");
  CHECK(position("3", "255") ==
        "URDF: joint 'pivot': its limits, 3 .. 255 in <ros2_control> and -1 .. 1 in <limit>, leave "
        "it no position");
  // Joints that are held or left out need no limits.
  CHECK(position("3", "255", {.locked = {"pivot"}}).empty());
  CHECK(position("3", "255", {.root = "rod"}).empty());
}

TEST_CASE("A robot of another size is refused with the sizes and names") {
  const std::string arm = URDF_FILES "/arm.urdf", gripper = URDF_FILES "/gripper.urdf";
  CHECK_THROWS_WITH(load_urdf<4>(arm),
                    arm +
                        ": robot 'arm': it has 3 joints: turn, shoulder, lift; load it with <3>, "
                        "not <4>");
  CHECK_THROWS_WITH(load_urdf<2>(gripper),
                    gripper +
                        ": robot 'gripper': it has 2 joints: wrist, left_knuckle; and mimic "
                        "joints: left_slide, right_knuckle, right_curl; load it with <2, 5>, "
                        "not <2>");
  CHECK_NOTHROW(load_urdf<2, 5>(gripper));
}

TEST_CASE("urdfdom's messages do not reach the program's receiver") {
  struct Receiver final : console_bridge::OutputHandler {
    void log(const std::string&, console_bridge::LogLevel, const char*, int) override { ++count; }
    int count = 0;
  } receiver;
  console_bridge::useOutputHandler(&receiver);
  const auto level = console_bridge::getLogLevel();
  CHECK(!refusal(robot("")).empty());
  CHECK(console_bridge::getOutputHandler() == &receiver);
  CHECK(console_bridge::getLogLevel() == level);
  console_bridge::restorePreviousOutputHandler();
  CHECK(receiver.count == 0);

  console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_NONE);
  CHECK(refusal(robot("")) == "URDF: No link elements found in urdf file");
  console_bridge::setLogLevel(level);
}
