// SPDX-License-Identifier: Apache-2.0
/// @file A model moves as its URDF describes.
#include <articula/dynamics/dynamics.hpp>
#include <articula/urdf/urdf.hpp>

#include <Eigen/Geometry>

#include "catch.hpp"
#include "urdf_text.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <locale>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

using namespace articula;
using Eigen::Vector3d;

namespace {

const std::string arm_file = URDF_FILES "/arm.urdf";

Eigen::Isometry3d at(double x, double y, double z, double roll = 0, double pitch = 0,
                     double yaw = 0) {
  return Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch, Vector3d::UnitY()) * Eigen::AngleAxisd(roll, Vector3d::UnitX());
}

}  // namespace

TEST_CASE("A URDF gives joints in the order of the tree") {
  const Model<3> arm = load_urdf<3>(arm_file);
  CHECK(arm.name.view() == "arm");
  CHECK(joint_names(arm) == std::array<std::string_view, 3>{"turn", "shoulder", "lift"});
  CHECK(arm.joints[0].type == JointType::continuous);
  CHECK(arm.joints[1].type == JointType::revolute);
  CHECK(arm.joints[2].type == JointType::prismatic);
  CHECK(arm.links.size() == 6);
}

TEST_CASE("Links stand where the URDF puts them") {
  const Model<3> arm = load_urdf<3>(arm_file);
  const JointVector<3> q{0.7, -0.4, 0.2};
  const Eigen::Isometry3d expected =
      at(0, 0, 0.1, 0, 0, 3.14159265359) * at(0, 0, 0.2) * at(0, 0, 0, 0, 0, q[0]) *
      at(0, 0.1, 0.3, -1.5707963, 0, 1.5707963) * at(0, 0, 0, 0, 0, q[1]) *
      at(0.4, 0, 0, 0.3, -0.2, 0.1) * at(q[2], 0, 0) * at(0, 0, 0.05, 0, 1.5707963, 0);
  const Eigen::Isometry3d tool = forward_kinematics(arm, q, "tool");
  CHECK((tool.matrix() - expected.matrix()).norm() < 1e-14);  // rounding of ten products
}

TEST_CASE("Angles reach the model with all digits") {
  const UrdfDescription arm = read_urdf(arm_file);
  for (const Joint& joint : arm->joints) {
    if (joint.name.view() != "shoulder") continue;
    CHECK(joint.orientation == Vector3<double>{-1.5707963, 0, 1.5707963});
  }
  const UrdfDescription upright = read_urdf(support::pendulum(
      support::solid("rod"),
      support::joint("pivot", "continuous", "base", "rod", "<origin rpy=\"0.3 1.569 -0.2\"/>")));
  CHECK(upright->joints[0].orientation == Vector3<double>{0.3, 1.569, -0.2});
}

TEST_CASE("Weights act at the centres of mass") {
  const Model<3> arm = load_urdf<3>(arm_file);
  const JointVector<3> q{0.3, 0.9, 0.1};
  // Potential energy from the centres of mass in the file; the base does not move.
  const auto energy = [&](const JointVector<3>& at_q) {
    const auto height = [&](std::string_view link, double mass, const Vector3d& center) {
      return mass * (forward_kinematics(arm, at_q, link) * center).z();
    };
    return 9.81 * (height("column", 3.5, {0.01, 0.02, 0.15}) + height("upper", 2, {0.2, 0, 0}) +
                   height("tool", 0.8, {0, 0.01, 0.03}));
  };
  const JointVector<3> effort = gravity(arm, q);
  for (int j = 0; j < 3; ++j) {
    const JointVector<3> step = 1e-4 * JointVector<3>::Unit(j);
    const double slope = (energy(q + step) - energy(q - step)) / 2e-4;
    CHECK(effort[j] == Approx(slope).margin(1e-6));  // 1e-8 |E'''| / 6, and rounding 1e-14 / 1e-4
  }
}

TEST_CASE("Drives have the limits of the URDF, narrowed by ros2_control") {
  const Model<3> arm = load_urdf<3>(arm_file);
  const JointLimits &turn = arm.joints[0].limits, &shoulder = arm.joints[1].limits,
                    &lift = arm.joints[2].limits;
  CHECK(turn.lower == -JointLimits::infinity);
  CHECK(turn.upper == JointLimits::infinity);
  CHECK(turn.velocity == 1.25);
  CHECK(turn.effort == 50);
  CHECK(shoulder.lower == -1);
  CHECK(shoulder.upper == 2.5);
  CHECK(shoulder.velocity == 2);
  CHECK(shoulder.effort == 30);
  CHECK(lift.lower == 0);
  CHECK(lift.upper == 0.35);
  CHECK(lift.effort == 120);  // that limit is not enabled
  CHECK(arm.joints[0].damping == 0.5);
  CHECK(arm.joints[0].friction == 0.25);
}

TEST_CASE("Transmissions are read in all dialects") {
  const std::string drives =
      "<transmission name=\"simple\" type=\"SimpleTransmission\"><actuator name=\"motor\"/>"
      "<joint name=\"pivot\"/><mechanicalReduction>-79.25</mechanicalReduction></transmission>"
      "<transmission name=\"wrist\" type=\"WristTransmission\"><rightActuator name=\"r\" "
      "mechanicalReduction=\"60.5\"/><leftActuator name=\"l\" mechanicalReduction=\"60\"/>"
      "<flexJoint name=\"pivot\" mechanicalReduction=\"-1\"/><rollJoint name=\"missing\"/>"
      "</transmission>"
      "<ros2_control name=\"c\" type=\"system\"><joint name=\"pivot\"/><transmission name=\"new\">"
      "<plugin>p</plugin><actuator name=\"a\" role=\"actuator1\"><mechanical_reduction>325.949"
      "</mechanical_reduction></actuator><joint name=\"pivot\" role=\"joint1\"/>"
      "</transmission></ros2_control>";
  std::string text = support::pendulum();
  text.insert(text.rfind("</robot>"), drives);
  const UrdfDescription pendulum = read_urdf(text);
  const auto& transmissions = pendulum->transmissions;
  REQUIRE(transmissions.size() == 3);
  CHECK(transmissions[0].name == "simple");
  CHECK(transmissions[0].type == "SimpleTransmission");
  REQUIRE(transmissions[0].actuators.size() == 1);
  CHECK(transmissions[0].actuators[0].mechanical_reduction == -79.25);
  REQUIRE(transmissions[1].actuators.size() == 2);
  CHECK(transmissions[1].actuators[0].name == "r");
  CHECK(transmissions[1].actuators[0].mechanical_reduction == 60.5);
  REQUIRE(transmissions[1].joints.size() == 2);
  CHECK(transmissions[1].joints[0].mechanical_reduction == -1);
  CHECK(transmissions[2].type == "p");
  CHECK(transmissions[2].actuators[0].mechanical_reduction == 325.949);
  REQUIRE(pendulum->notices.size() == 1);
  CHECK(pendulum->notices[0] == "transmission 'wrist': joint 'missing': there is no such joint");

  CHECK(read_urdf(arm_file)->transmissions.at(0).actuators.at(0).mechanical_reduction == 100.5);
}

TEST_CASE("A rotated root is reported unless gravity is set") {
  const auto robot = [](const std::string& mount) {
    std::string text = support::pendulum();
    text.insert(text.find("<link"), "<link name='world'/>");
    text.insert(text.rfind("</robot>"),
                "<joint name='mount' type='" + mount +
                    "'><parent link='world'/><child link='base'/><axis xyz='1 0 0'/>"
                    "<origin rpy='1.5707963267948966 0 0'/><limit lower='0' upper='1' effort='1' "
                    "velocity='1'/></joint>");
    return text;
  };
  const auto notices = [&](const std::string& mount, const UrdfOptions& options) {
    return read_urdf(robot(mount), options)->notices;
  };
  CHECK(notices("fixed", {}).empty());
  CHECK(notices("fixed", {.root = "base"}) ==
        std::vector<std::string>{
            "root 'base': the file rotates its frame, but gravity is 0 0 -9.81 in it; to keep the "
            "gravity of the file's root, set it to 0 -9.81 0"});
  CHECK(notices("fixed", {.root = "base", .gravity = {0, -9.8, 0}}).empty());
  const std::vector<std::string> turned{
      "root 'base': joint 'mount' rotates its frame, but gravity is 0 0 -9.81 in it"};
  for (const char* type : {"revolute", "planar", "floating"}) {
    CAPTURE(type);
    CHECK(notices(type, {.root = "base"}) == turned);
  }
  CHECK(notices("prismatic", {.root = "base"}) == notices("fixed", {.root = "base"}));

  // What is said to be there is what makes the whole robot's efforts.
  const JointVector<1> q{0.5};
  const Vector3<double> there{0, -9.81, 0};
  const double whole = gravity(load_urdf<1>(robot("fixed")), q)[0];
  const double part =
      gravity(load_urdf<1>(robot("fixed"), {.root = "base", .gravity = there}), q)[0];
  INFO("of " << whole << " N m");
  CHECK(std::abs(whole - part) <= 1e-14);  // some roundings of a few N m
}

TEST_CASE("A fixed joint need not be locked") {
  std::string text = support::pendulum();
  text.insert(text.rfind("</robot>"),
              "<link name='tool'/><joint name='weld' type='fixed'><parent link='rod'/>"
              "<child link='tool'/></joint>");
  CHECK(read_urdf(text, {.locked = {"weld"}})->notices ==
        std::vector<std::string>{"joint 'weld': it is locked, but is fixed anyway"});
}

TEST_CASE("A file and its text give the same robot") {
  std::ifstream file(arm_file);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const JointVector<3> q{0.1, 0.2, 0.3};
  const JointVector<3> expected = gravity(load_urdf<3>(arm_file), q);
  CHECK(gravity(load_urdf<3>(text), q) == expected);
  CHECK(gravity(load_urdf<3>(std::string_view(text)), q) == expected);
  CHECK(gravity(load_urdf<3>(("\xEF\xBB\xBF \n" + text).c_str()), q) == expected);
  CHECK(gravity(load_urdf<3>(std::filesystem::path(arm_file)), q) == expected);
}

TEST_CASE("A description cannot be changed; changed contents are checked again") {
  STATIC_REQUIRE(
      std::is_const_v<std::remove_reference_t<decltype(*std::declval<UrdfDescription&>())>>);
  UrdfContents contents = *read_urdf(support::pendulum());
  contents.joints[0].damping = 7;
  CHECK(UrdfDescription(contents)->joints[0].damping == 7);
  contents.links[1].mass = -1;
  CHECK_THROWS_WITH(UrdfDescription(contents), Catch::Contains("the mass is negative (-1 kg)"));
  contents = *read_urdf(arm_file);
  contents.right_angle_tolerance = 1;
  CHECK_THROWS_WITH(UrdfDescription(contents), Catch::Contains("right_angle_tolerance 1"));
}

TEST_CASE("A file that is parsed once gives several robots") {
  const UrdfDocument document = parse_urdf(arm_file);
  CHECK(read_urdf(document)->notices == read_urdf(arm_file)->notices);
  CHECK(load_urdf<2>(read_urdf(document, {.locked = {"lift"}})).joint_count == 2);
  const UrdfDescription drawn = read_urdf(document, {.kinematic = true});
  for (const Link& link : drawn->links) CHECK(link.mass == 0);
  CHECK(load_kinematic_urdf<3>(drawn).joint_count == 3);
}

TEST_CASE("Root and tip select a chain") {
  const Model<2> chain = load_urdf<2>(arm_file, {.root = "column", .tip = "tool"});
  CHECK(joint_names(chain) == std::array<std::string_view, 2>{"shoulder", "lift"});
  CHECK(chain.links.front().name.view() == "column");
  CHECK(chain.links.back().name.view() == "tool");
  const Model<2> beyond = load_urdf<2>(arm_file, {.root = "column"});
  const JointVector<2> q{0.3, 0.1};
  CHECK(gravity(chain, q) == gravity(beyond, q));

  // Its root is turned by no joint, so nobody need be told about gravity.
  CHECK(read_urdf(arm_file, {.root = "column"})->notices == read_urdf(arm_file)->notices);

  // Off the chain are the left finger and all that it carries.
  const Model<2> wrist = load_urdf<2>(URDF_FILES "/gripper.urdf", {.tip = "left_finger"});
  CHECK(joint_names(wrist) == std::array<std::string_view, 2>{"wrist", "left_knuckle"});
  CHECK(wrist.links.size() == 3);
}

TEST_CASE("A chain reports the masses that its joints carry in the file and that it leaves out") {
  const auto about_tip = [](const UrdfOptions& options) {
    std::vector<std::string> notices = read_urdf(URDF_FILES "/gripper.urdf", options)->notices;
    std::erase_if(notices, [](const std::string& each) { return !each.starts_with("tip"); });
    return notices;
  };
  // The right finger, 0.12 kg, with its tip, 0.04 kg, and the left tip, 0.05 kg.
  CHECK(about_tip({.tip = "left_finger"}) ==
        std::vector<std::string>{
            "tip 'left_finger': the chain's joints carry 0.21 kg that are left out, at joint "
            "'right_knuckle' and 1 more; to include them, set no tip and lock all other joints"});
  // What hangs on what stands still changes nothing, be that the root or held by a lock.
  const std::vector<std::string> left_tip{
      "tip 'left_finger': the chain's joints carry 0.05 kg that are left out, at joint "
      "'left_slide'; to include them, set no tip and lock all other joints"};
  CHECK(about_tip({.root = "palm", .tip = "left_finger"}) == left_tip);
  CHECK(about_tip({.tip = "left_finger", .locked = {"wrist"}}) == left_tip);
  CHECK(about_tip({}).empty());
  CHECK(read_urdf(arm_file, {.tip = "tool"})->notices == read_urdf(arm_file)->notices);
  using support::joint, support::robot, support::solid;
  const std::string arm_on_a_mast = robot(
      "<link name=\"base\"/>" + solid("other") + solid("mast") + solid("camera") + solid("arm") +
      joint("leader", "continuous", "base", "other") +
      joint("follower", "continuous", "base", "mast", "<mimic joint=\"leader\"/>") +
      joint("mount", "fixed", "mast", "camera") + joint("elbow", "continuous", "mast", "arm"));
  CHECK(read_urdf(arm_on_a_mast, {.tip = "arm", .locked = {"leader"}})->notices.empty());
  CHECK(read_urdf(arm_on_a_mast, {.tip = "arm", .locked = {"follower"}})->notices.empty());
}

TEST_CASE("Locked joints stay where they are put") {
  const JointVector<3> q{0.7, -0.4, 0.2}, v{0.5, -1, 0.3};
  // All angles as they are written: locked or not, the right ones would be taken differently.
  const Model<3> arm = load_urdf<3>(arm_file, {.right_angle_tolerance = 0});

  SECTION("at zero") {
    const Model<2> locked =
        load_urdf<2>(arm_file, {.locked = {"shoulder"}, .right_angle_tolerance = 0});
    CHECK(joint_names(locked) == std::array<std::string_view, 2>{"turn", "lift"});
    const JointVector<3> at_zero{q[0], 0, q[2]};
    CHECK((forward_kinematics(locked, {q[0], q[2]}, "tool").matrix() -
           forward_kinematics(arm, at_zero, "tool").matrix())
              .norm() < 1e-15);
    const JointVector<3> all = gravity(arm, at_zero);
    CHECK((gravity(locked, {q[0], q[2]}) - Eigen::Vector2d(all[0], all[2])).norm() < 1e-13);
  }
  SECTION("at a position, turning and sliding") {
    const Model<1> locked = load_urdf<1>(
        arm_file, {.locked = {{"shoulder", q[1]}, {"lift", q[2]}}, .right_angle_tolerance = 0});
    CHECK((forward_kinematics(locked, JointVector<1>(q[0]), "tool").matrix() -
           forward_kinematics(arm, q, "tool").matrix())
              .norm() < 1e-14);
    CHECK(mass_matrix(locked, JointVector<1>(q[0]))(0, 0) ==
          Approx(mass_matrix(arm, q)(0, 0)).epsilon(1e-13));
  }
  SECTION("where the pitch is a right angle") {
    const std::string text = support::pendulum(
        support::solid("rod"), support::joint("pivot", "continuous", "base", "rod",
                                              "<origin xyz=\"1 2 3\" rpy=\"0.3 1.5707963267948966 "
                                              "-0.2\"/><axis xyz=\"1 0 0\"/>") +
                                   support::solid("tip") +
                                   support::joint("end", "continuous", "rod", "tip"));
    const Model<1> held = load_urdf<1>(text, {.locked = {{"pivot", 0.9}}});
    const Model<2> free = load_urdf<2>(text);
    CHECK((forward_kinematics(held, JointVector<1>(0.5), "tip").matrix() -
           forward_kinematics(free, {0.9, 0.5}, "tip").matrix())
              .norm() < 1e-14);
  }
  SECTION("with those that mimic them") {
    const std::string gripper = URDF_FILES "/gripper.urdf";
    const Model<1> held = load_urdf<1>(gripper, {.locked = {{"left_knuckle", 0.4}}});
    const Model<2, 5> free = load_urdf<2, 5>(gripper);
    for (const char* link : {"left_finger", "right_finger", "left_tip", "right_tip"}) {
      CHECK((forward_kinematics(held, JointVector<1>(0.6), link).matrix() -
             forward_kinematics(free, {0.6, 0.4}, link).matrix())
                .norm() < 1e-14);
    }
  }
}

TEST_CASE("Gravity is that of the options") {
  const JointVector<1> q = JointVector<1>::Constant(0.4);
  const std::string text = support::pendulum(
      "<link name=\"rod\"><inertial><origin xyz=\"0 0 -1\"/><mass value=\"2\"/><inertia ixx=\"1\" "
      "ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial></link>");
  CHECK(gravity(load_urdf<1>(text), q)[0] == Approx(2 * 9.81 * std::sin(0.4)));
  CHECK(gravity(load_urdf<1>(text, {.gravity = {0, 0, -1.62}}), q)[0] ==
        Approx(2 * 1.62 * std::sin(0.4)));
}

TEST_CASE("Unphysical inertias are accepted when asked for, and reported") {
  const std::string file = URDF_FILES "/unphysical.urdf";
  CHECK_THROWS_WITH(
      load_urdf<2>(file),
      Catch::Contains(
          "link 'flat': the inertia breaks the triangle inequality (mass 2 kg, principal "
          "moments of inertia 0.01, 0.02, 0.05 kg m^2)"));
  const UrdfDescription robot = read_urdf(file, {.allow_unphysical = true});
  REQUIRE(robot->notices.size() == 3);
  CHECK(robot->notices[0].starts_with("link 'flat': the inertia breaks the triangle inequality"));
  CHECK(robot->notices[1].starts_with("link 'point': the inertia is not positive definite"));
  CHECK(robot->notices[2].starts_with("link 'massless': the link has inertia but no mass"));

  const Model<2> model = load_urdf<2>(file, {.allow_unphysical = true});
  const JointMatrix<2> M = mass_matrix(model, {0, 0});
  CHECK(M(0, 0) == Approx(0.05 + 0.7 * 0.3 * 0.3 + 0.001));
  CHECK(M(1, 1) == Approx(0.7 * 0.2 * 0.2 + 0.001));
}

TEST_CASE("Limits that leave no room are reported") {
  const std::string file = support::pendulum(
      support::solid("rod"),
      support::joint("pivot", "revolute", "base", "rod", "<limit effort=\"0\" velocity=\"0\"/>"));
  const UrdfDescription robot = read_urdf(file);
  REQUIRE(robot->notices.size() == 3);
  CHECK(robot->notices[0] == "joint 'pivot': it cannot move: its lower and upper limits are 0");
  CHECK(robot->notices[1] == "joint 'pivot': its velocity limit is 0, so it must not move");
  CHECK(robot->notices[2] == "joint 'pivot': its effort limit is 0, so it cannot be driven");
  CHECK(read_urdf(
            support::robot("<link name=\"base\"/>" + support::solid("rod") + support::solid("bob") +
                           support::joint("pivot", "revolute", "base", "rod",
                                          "<limit effort=\"0\" velocity=\"0\"/>") +
                           support::joint("knee", "continuous", "rod", "bob")),
            {.locked = {"pivot"}})
            ->notices.empty());
}

TEST_CASE("A link that moves without a mass of its own is reported") {
  const std::string base = "<link name=\"base\"/>", frame = "<link name=\"frame\"/>";
  const auto notices = [&](const std::string& first, const std::string& second) {
    return read_urdf(support::robot(base + frame + support::solid("rod") +
                                    support::joint("i", first, "base", "frame") +
                                    support::joint("j", second, "frame", "rod")))
        ->notices;
  };
  CHECK(notices("continuous", "fixed") ==
        std::vector<std::string>{"link 'frame': it has no <inertial> and is taken as massless, "
                                 "but joint 'i' moves it"});
  CHECK(notices("continuous", "continuous").size() == 1);
  CHECK(notices("fixed", "continuous").empty());  // a mere frame
}

TEST_CASE("Numbers are read the same in every locale") {
  struct Comma final : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  const UrdfDescription arm = read_urdf(arm_file);
  std::string message;
  try {
    static_cast<void>(read_urdf(URDF_FILES "/unphysical.urdf"));
  } catch (const FileError& error) {
    message = error.what();
  }
  std::locale::global(before);
  CHECK(arm->joints[0].origin.z == 0.1);
  CHECK(arm->transmissions[0].actuators[0].mechanical_reduction == 100.5);
  CHECK(message.find("0.01, 0.02, 0.05") != std::string::npos);
}
