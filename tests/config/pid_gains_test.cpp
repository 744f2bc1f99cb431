// SPDX-License-Identifier: Apache-2.0
#include <articula/config/load_controller_manager.hpp>
#include <articula/config/load_pid_gains.hpp>
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/loop/loop.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/robots/ur10.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <numbers>
#include <string>

#include "catch.hpp"
#include "config_support.hpp"
#include "scratch_file.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::config_file;
using support::example_file;
using support::yaml;

namespace {

/// A rod on a wall that is turned against the floor.
struct OnWall {
  static constexpr RobotDescription description{
      .name = "on_wall",
      .gravity = {0, 0, -9.81},
      .links = std::to_array<Link>(
          {{.name = "floor"},
           {.name = "wall"},
           {.name = "rod", .mass = 1, .inertia = {.xx = 0.1, .yy = 0.1, .zz = 0.1}}}),
      .joints = std::to_array<Joint>(
          {{.name = "mount",
            .parent = "floor",
            .child = "wall",
            .orientation = {std::numbers::pi / 2, 0, 0}},
           {.name = "pivot", .type = JointType::continuous, .parent = "wall", .child = "rod"}})};
};

/// The course's gains, which the robot brings along as well.
void check_course(const JointPidGains<2>& gains) {
  for (std::size_t j = 0; j < 2; ++j) {
    CHECK(gains[j].proportional == Q2d::pid_gains[j].proportional);
    CHECK(gains[j].integral == Q2d::pid_gains[j].integral);
    CHECK(gains[j].derivative == Q2d::pid_gains[j].derivative);
    CHECK(gains[j].integral_clamp_min == Q2d::pid_gains[j].integral_clamp_min);
    CHECK(gains[j].integral_clamp_max == Q2d::pid_gains[j].integral_clamp_max);
    CHECK(gains[j].output_clamp_max == PidGains::infinity);
    CHECK(gains[j].anti_windup == AntiWindup::conditional_integration);
  }
}

}  // namespace

TEST_CASE("the course's pid_plus_gravity.yaml gives the course's gains, chain and priority") {
  const PidConfig<2> config = load_pid_gains(Q2d(), example_file("pid_plus_gravity.yaml"));
  check_course(config.gains);
  CHECK(config.name == "pid_plus_gravity_controller");
  REQUIRE(config.gravity);
  CHECK(*config.gravity == Vector3<double>{0, 0, -9.8});
  CHECK(config.chain_root == "origin_link");
  CHECK(config.chain_tip == "tool_link");
  CHECK(config.priority == 99);
  CHECK(config.notes.empty());
  REQUIRE(config.joints.size() == 2);
  CHECK(config.joints[1].name == "elbow_active_joint");
  CHECK(config.joints[1].place.line == 5);
}

TEST_CASE("from the course's files to a loop that moves as that with the robot's own gains") {
  const auto manager = load_controller_manager(example_file("q2d_controllers.yaml"));
  const auto config = load_pid_gains(Q2d(), example_file("pid_plus_gravity.yaml"));
  Loop<Q2dSim, PidPlusGravity> loop(Q2dSim({.period = manager.period()}),
                                    PidPlusGravity<Q2d>(config.gains));
  Loop<Q2dSim, PidPlusGravity> own;
  CHECK(loop.period() == own.period());
  loop.reference().position = own.reference().position = {-1.0, 1.0};
  for (int k = 0; k < 500; ++k) {
    REQUIRE(loop.update() == Status::ok);
    REQUIRE(own.update() == Status::ok);
    REQUIRE(loop.command().effort == own.command().effort);  // bit by bit
  }
  CHECK(loop.state().position[0] < -0.4);  // it does move
}

TEST_CASE("the same parameters in every layout of ROS 1 and ROS 2") {
  const std::string parameters =
      "joints: [shoulder_active_joint, elbow_active_joint]\n"
      "shoulder_active_joint: {p: 2310, i: 4640, d: 0.299, i_clamp_max: 27.94, i_clamp_min: "
      "-27.94}\n"
      "elbow_active_joint: {p: 339, i: 851, d: 0.351, i_clamp: 13.62}\n";
  const auto below = [&](const std::string& head, int levels) {
    std::string text = head;
    std::string indentation(static_cast<std::size_t>(2 * levels), ' ');
    for (std::size_t begin = 0; begin < parameters.size();) {
      const std::size_t end = parameters.find('\n', begin) + 1;
      text += indentation + parameters.substr(begin, end - begin);
      begin = end;
    }
    return text;
  };
  const std::string layouts[] = {
      parameters,
      below("q2d:\n", 1),
      below("ns:\n  q2d:\n", 2),
      below("q2d:\n  ros__parameters:\n", 2),
      below("/q2d:\n  ros__parameters:\n", 2),
      below("/ns/q2d:\n  ros__parameters:\n", 2),
      below("/**/q2d:\n  ros__parameters:\n", 2),
      below("ns:\n  q2d:\n    ros__parameters:\n", 3),
      below("/**:\n  ros__parameters:\n", 2),
      below("other: {ros__parameters: {frame_id: base}}\nq2d:\n  ros__parameters:\n", 2),
      below("other: {type: joint_state_controller/JointStateController, publish_rate: 50}\n"
            "q2d:\n  type: a/B\n",
            1),
  };
  for (const std::string& text : layouts) {
    INFO(text);
    check_course(load_pid_gains(Q2d(), yaml(text)).gains);
    if (text.find("q2d") != std::string::npos) {
      check_course(load_pid_gains(Q2d(), yaml(text), "q2d").gains);
    }
    if (text.find("ns") != std::string::npos) {
      check_course(load_pid_gains(Q2d(), yaml(text), "ns").gains);
      check_course(load_pid_gains(Q2d(), yaml(text), "/ns/q2d").gains);
    }
  }
}

TEST_CASE("keys with dots are nested maps, as in ROS 2") {
  const auto config = load_pid_gains(Q2d(), yaml("q:\n"
                                                 "  ros__parameters:\n"
                                                 "    dof_names: [shoulder_active_joint,"
                                                 " elbow_active_joint]\n"
                                                 "    gains.shoulder_active_joint.p: 5\n"
                                                 "    gains.shoulder_active_joint: {d: 2}\n"
                                                 "    gains: {elbow_active_joint.p: 6}\n"
                                                 "    gravity.z: -9.8\n"));
  CHECK(config.gains[0].proportional == 5);
  CHECK(config.gains[0].derivative == 2);
  CHECK(config.gains[1].proportional == 6);
  CHECK(config.gravity == Vector3<double>{0, 0, -9.8});
}

TEST_CASE("what stands under /** is weaker than what is the controller's own") {
  const std::string text =
      "/**:\n  ros__parameters: {use_sim_time: true, priority: 10, elbow_active_joint: {p: 1, d: "
      "7}}\n"
      "q2d:\n  ros__parameters:\n    joints: [shoulder_active_joint, elbow_active_joint]\n"
      "    shoulder_active_joint: {p: 2}\n    elbow_active_joint: {p: 3}\n    priority: 20\n";
  const auto config = load_pid_gains(Q2d(), yaml(text));
  CHECK(config.priority == 20);
  CHECK(config.gains[1].proportional == 3);
  CHECK(config.gains[1].derivative == 7);
  REQUIRE(config.notes.size() == 1);
  CHECK(config.notes[0].find("test:2:35: ") == 0);
  CHECK(config.notes[0].find("use_sim_time: not used") != std::string::npos);
}

TEST_CASE("the UR10 lab's pid maps, one controller for each joint, make one set of gains") {
  const auto config = load_pid_gains(Ur10(), config_file("ur10_controllers.yaml"));
  for (const PidGains& gains : config.gains) {
    CHECK(gains.proportional == 1000);
    CHECK(gains.integral == 0.01);
    CHECK(gains.derivative == 10);
    CHECK(gains.integral_clamp_max == PidGains::infinity);
  }
  CHECK(config.type == "effort_controllers/JointPositionController");
  REQUIRE(config.notes.size() == 8);  // ROS 1 has no integral without i_clamp; two sections
  CHECK(config.notes[0].find(":16:23: ") != std::string::npos);
  CHECK(config.notes[0].find("no i_clamp is given") != std::string::npos);

  // By namespace and by type as well; one of the controllers alone is not enough for the robot.
  const std::string type = "effort_controllers/JointPositionController";
  for (const std::string& name : {std::string("ur10"), type}) {
    CHECK(load_pid_gains(Ur10(), config_file("ur10_controllers.yaml"), name).gains[5].derivative ==
          10);
  }
  CHECK_THROWS_WITH(load_pid_gains(Ur10(), config_file("ur10_controllers.yaml"),
                                   "elbow_joint_position_controller"),
                    Contains("has the joint 'shoulder_pan_joint', which is missing"));
}

TEST_CASE("group controllers with pid maps, anchors and a symmetric clamp") {
  const auto config = load_pid_gains(Ur10(), config_file("ur10_group.yaml"));
  for (const PidGains& gains : config.gains) {
    CHECK(gains.proportional == 1000);
    CHECK(gains.integral_clamp_max == 5);
    CHECK(gains.integral_clamp_min == -5);
  }
}

TEST_CASE("gains of trajectory controllers, in the robot's order whatever the file's") {
  const auto config = load_pid_gains(Ur10(), config_file("ur10_trajectory.yaml"));
  const double proportional[] = {4000, 10000, 2000, 500, 500, 10};
  for (std::size_t j = 0; j < 6; ++j) CHECK(config.gains[j].proportional == proportional[j]);
  CHECK(config.gains[2].velocity_feedforward == 1);
  CHECK(config.gains[0].velocity_feedforward == 0);
  REQUIRE(config.notes.size() == 4);
  CHECK(std::all_of(config.notes.begin(), config.notes.end(), [](const std::string& note) {
    return note.find("not used") != std::string::npos;
  }));
}

TEST_CASE("every key of pid_controller means what it says") {
  const auto config = load_pid_gains(Q2d(), config_file("arm_controllers.yaml"));
  const PidGains& shoulder = config.gains[0];
  const PidGains& elbow = config.gains[1];
  CHECK(shoulder.proportional == 2310);
  CHECK(shoulder.output_clamp_max == PidGains::infinity);
  CHECK(shoulder.anti_windup == AntiWindup::none);
  CHECK(shoulder.error_deadband == 1e-16);
  CHECK(shoulder.velocity_feedforward == 0.5);
  CHECK(elbow.output_clamp_max == 13.62);
  CHECK(elbow.output_clamp_min == -13.62);
  CHECK(elbow.anti_windup == AntiWindup::back_calculation);
  CHECK(elbow.tracking_time == 0.02);
  CHECK(config.type == "pid_controller/PidController");  // from the controller manager
  CHECK(config.notes.size() == 5);
}

TEST_CASE("what our gains have beyond ROS's can be given, too") {
  const auto config = load_pid_gains(
      Q2d(),
      yaml("gains:\n"
           "  shoulder_active_joint: {p: 1, derivative_filter_time: 0.01, position_weight: 0.5,\n"
           "    velocity_weight: 0, velocity_feedforward: 3, acceleration_feedforward: 4,\n"
           "    saturation: false, u_clamp_max: 1, u_clamp_min: -1, antiwindup: false}\n"
           "  elbow_active_joint: {p: 1, ff_velocity_scale: 2, antiwindup_strategy: legacy}\n"));
  CHECK(config.gains[0].derivative_filter_time == 0.01);
  CHECK(config.gains[0].position_weight == 0.5);
  CHECK(config.gains[0].velocity_weight == 0);
  CHECK(config.gains[0].velocity_feedforward == 3);
  CHECK(config.gains[0].acceleration_feedforward == 4);
  CHECK(config.gains[0].output_clamp_max == PidGains::infinity);
  CHECK(config.gains[1].velocity_feedforward == 2);
  CHECK(config.notes.size() == 2);  // antiwindup: false, and legacy
}

TEST_CASE("the diagonals of Kp and Kd are gains of computed torque control") {
  const auto config = load_pid_gains(Q2d(), config_file("computed_torque.yaml"));
  CHECK(config.gains[0].proportional == 400);
  CHECK(config.gains[1].derivative == 40);
  const auto short_form = load_pid_gains(
      Q2d(), yaml("joints: [elbow_active_joint, shoulder_active_joint]\nKp: [1, 2]\nKd: [3, 4]\n"));
  CHECK(short_form.gains[0].proportional == 2);
  CHECK(short_form.gains[1].derivative == 3);
}

TEST_CASE("gravity may be a list, and stands in the frame of the chain's root") {
  const std::string gains =
      "gains: {shoulder_active_joint: {p: 1}, elbow_active_joint: {p: 1}}\ngravity: ";
  CHECK(load_pid_gains(Q2d(), yaml(gains + "[0, 0, -9.8]")).gravity == Vector3<double>{0, 0, -9.8});

  // The wall's z axis points along the floor's -y, so falling along the floor's -z is along the
  // wall's -y.
  const std::string on_wall = "gains: {pivot: {p: 1}}\nchain: {root: wall, tip: rod}\ngravity: ";
  CHECK_NOTHROW(load_pid_gains(OnWall(), yaml(on_wall + "[0, -9.81, 0]")));
  CHECK_THROWS_WITH(load_pid_gains(OnWall(), yaml(on_wall + "[0, 0, -9.81]")),
                    Contains("is not that of robot 'on_wall'"));
  const std::string on_floor = "gains: {pivot: {p: 1}}\ngravity: ";
  CHECK_NOTHROW(load_pid_gains(OnWall(), yaml(on_floor + "[0, 0, -9.81]")));
}

TEST_CASE("a robot that is a value takes its gravity from the file") {
  const ControllerConfig config = load_controller(example_file("pid_plus_gravity.yaml"));
  REQUIRE(config.gravity);
  auto model = model_of(Q2d());
  CHECK_NOTHROW(pid_gains(model, config));
  model.mechanism.gravity = {0, 0, -1.62};  // on the moon
  CHECK_THROWS_WITH(pid_gains(model, config), Contains("expected (0, 0, -1.62)"));
}

TEST_CASE("a file is read as a text is, and a missing one is named") {
  const support::ScratchFile file("gains.yaml");
  std::ofstream(file.path())
      << "gains: {shoulder_active_joint: {p: 7}, elbow_active_joint: {p: 8}}";
  CHECK(load_pid_gains(Q2d(), file.path()).gains[1].proportional == 8);
  CHECK_THROWS_WITH(load_pid_gains(Q2d(), "no/such.yaml"), "no/such.yaml: the file cannot be read");
  CHECK_THROWS_WITH(load_pid_gains(Q2d(), "/"), "/: it is a folder, expected a file");
}
