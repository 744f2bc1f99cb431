// SPDX-License-Identifier: Apache-2.0
// Sheets, cycles and link poses of described and loaded robots, of each kind of command.
#include <articula/control/drive_impedance.hpp>
#include <articula/hardware/mock/mock_hardware.hpp>
#include <articula/robots/gripper_arm.hpp>

#include <string>
#include <vector>

#include "catch.hpp"
#include "remote/remote_arm.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using namespace articula::remote;
using support::elbow;
using support::RemoteArm;
using support::shoulder;
using support::SupervisedArm;

namespace {

/// Whether a loop is activated by its Remote and follows a go.
template <class Arm>
void check_go(Arm& arm, const std::string& joint, double position) {
  REQUIRE(arm.ask(Activate{}).verdict == support::Verdict::done);
  REQUIRE(arm.ask(Go{{{joint, position}}}).verdict == support::Verdict::done);
  arm.cycles(20000);
  const int index = joint_index(arm.loop.hardware().robot(), joint);
  CHECK(arm.loop.reference().position[index] == position);
  CHECK(std::abs(arm.loop.state().position[index] - position) < 0.01);
}

}  // namespace

TEST_CASE("the sheet of a described robot") {
  SupervisedArm arm;
  const RobotSheet& sheet = arm.remote.robot();
  CHECK(sheet.name == "q2d");
  REQUIRE(sheet.joints.size() == 2);
  CHECK(sheet.joints[0].name == shoulder);
  CHECK(sheet.joints[0].limits.velocity == 2.27);
  CHECK(sheet.joints[0].effort_unit() == "N m");
  CHECK(sheet.mimics.empty());
  REQUIRE(sheet.links.size() == 7);
  CHECK(sheet.links[0] == "origin_link");
  CHECK(sheet.commands == std::vector<std::string>{"effort"});
  CHECK(sheet.urdf.find("<robot name=\"q2d\"") != std::string::npos);
  CHECK(sheet.period == 1e-3);
  CHECK(sheet.is_simulated);

  SupervisedArm given({.urdf = "<robot/>"});
  CHECK(given.remote.robot().urdf == "<robot/>");
}

TEST_CASE("links are placed where forward kinematics places them") {
  SupervisedArm arm;
  const std::vector<LinkPose> poses = arm.remote.link_poses({0.3, -0.7});
  REQUIRE(poses.size() == arm.remote.robot().links.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    CHECK(poses[i].link == arm.remote.robot().links[i]);
    const Eigen::Isometry3d expected =
        forward_kinematics(Q2d(), JointVector<2>(0.3, -0.7), poses[i].link);
    const auto& [x, y, z, w] = poses[i].rotation;
    const Eigen::Vector3d translation(poses[i].translation.data());
    CHECK((translation - expected.translation()).norm() < 1e-12);
    CHECK((Eigen::Quaterniond(w, x, y, z).toRotationMatrix() - expected.linear()).norm() < 1e-12);
  }
  CHECK_THROWS_WITH(arm.remote.link_poses({0.3}), "link_poses: 1 positions for 2 joints");
}

TEST_CASE("a cycle has the numbers of state, reference and command") {
  SupervisedArm arm;
  arm.ask(Activate{});
  arm.ask(Go{{{shoulder, 0.5}}});
  arm.cycles(100);
  const auto& state = arm.loop.state();
  const JointReference<2> reference = std::as_const(arm.loop).reference();
  const JointVector<2> command = arm.loop.command().effort;
  const double position = state.position[0], effort = state.effort[0], time = arm.loop.time();
  // The loop publishes a cycle when its timing is known, at the latest in the next one.
  arm.ask(Pause{});
  arm.cycles(1);
  Cycle cycle, last;
  while (arm.session->next(cycle)) {
    if (cycle.time == time) last = cycle;
  }
  CHECK(last.status == Status::ok);
  CHECK(last.mode == LoopMode::active);
  CHECK(last.position[0] == position);
  CHECK(last.effort[0] == effort);
  CHECK(last.reference_position[0] == reference.position[0]);
  CHECK(last.reference_velocity[0] == reference.velocity[0]);
  CHECK(last.reference_acceleration[0] == reference.acceleration[0]);
  REQUIRE(last.command.size() == 1);
  CHECK(last.command[0] == std::vector<double>{command[0], command[1]});
}

TEST_CASE("a session that was slow has the last seconds of cycles") {
  SupervisedArm arm;
  const auto other = arm.remote.connect("fast", false);
  Cycle cycle;
  std::uint64_t taken = 0;
  for (int k = 0; k < 100; ++k) {
    arm.cycles(100);
    while (other->next(cycle)) ++taken;
  }
  CHECK(taken == 9999);
  REQUIRE(arm.session->next(cycle));
  CHECK(cycle.number == 9999 - 4096 + 1);
  std::uint64_t kept = 1;
  while (arm.session->next(cycle)) ++kept;
  CHECK(kept == 4096);
  CHECK(arm.remote.statistics().dropped == 0);
}

TEST_CASE("a model made at run time") {
  using Arm = Simulator<Model<2>>;
  using Pid2 = PidPlusGravity<Model<2>>;
  const Model<2> model = support::model<Q2d>();
  RemoteArm<SupervisedControlLoop<Arm, Pid2>> arm({}, Arm(model), Pid2(model, Q2d::pid_gains));
  CHECK(arm.remote.robot().joints[1].name == elbow);
  check_go(arm, elbow, -0.5);
}

TEST_CASE("mimic joints, prismatic ones among them") {
  RemoteArm<SupervisedLoop<MockHardware<GripperArm, PositionCommand<joint_count<GripperArm>>>,
                           ForwardPosition>>
      arm;
  const RobotSheet& sheet = arm.remote.robot();
  CHECK(sheet.mimics.size() == 5);
  for (const SheetMimic& mimic : sheet.mimics) {
    CHECK(!mimic.name.empty());
    CHECK(mimic.joint == joint_count<GripperArm> - 1);
    CHECK(std::abs(mimic.multiplier) == 1);
  }
  CHECK(sheet.commands == std::vector<std::string>{"position"});
  const SheetJoint& last = sheet.joints.back();
  check_go(arm, last.name, (last.limits.lower + last.limits.upper) / 2);

  // Four of its joints may have a trajectory each, and one trajectory may replace several.
  const auto play = [&](const std::vector<std::size_t>& joints) {
    PlayTrajectory own;
    for (const std::size_t j : joints) {
      own.trajectory.joint_names.push_back(sheet.joints[j].name);
    }
    own.trajectory.points = {
        {.time_from_start = 1, .positions = std::vector<double>(joints.size(), 0.1)}};
    return own;
  };
  for (std::size_t j = 0; j < 4; ++j) arm.session->ask(play({j}));
  arm.cycles(10);
  const Answer fifth = arm.ask(play({4}));
  CHECK(fifth.verdict == support::Verdict::refused);
  CHECK(fifth.text == "trajectory: invalid goal: trajectories at once 5 are more than 4");
  CHECK(arm.ask(play({4, 2, 1, 0}), 2000).verdict == support::Verdict::done);
  CHECK(arm.loop.reference().position[3] == 0.1);
}

TEST_CASE("velocity commands and springs in drives") {
  using Velocity = PositionByVelocity<Q2d>;
  const JointPidGains<2> gains{{{.proportional = 20}, {.proportional = 20}}};
  RemoteArm<SupervisedControlLoop<Q2dSim, Velocity>> velocities({}, Q2dSim(), Velocity(gains));
  CHECK(velocities.remote.robot().commands == std::vector<std::string>{"velocity"});
  check_go(velocities, elbow, 0.5);

  using Springs = DriveImpedance<Q2d>;
  const JointImpedanceGains<2> springs{{{2000, 50}, {400, 10}}};
  RemoteArm<SupervisedControlLoop<Q2dSim, Springs>> impedance({}, Q2dSim(), Springs(springs));
  CHECK(impedance.remote.robot().commands ==
        std::vector<std::string>{"position", "velocity", "stiffness", "damping", "effort"});
  check_go(impedance, elbow, 0.5);
  CHECK(impedance.remote.parameters().front().name ==
        "drive_impedance.shoulder_active_joint.stiffness");
}

TEST_CASE("limits of motion that no description gives are completed") {
  const MotionLimits<2> limits = default_motion_limits(support::free_arm());
  CHECK(limits.velocity == JointVector<2>(1, 1));
  CHECK(limits.acceleration == JointVector<2>(4, 4));
  CHECK(limits.jerk == JointVector<2>(40, 40));
}
