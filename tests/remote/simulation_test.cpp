// SPDX-License-Identifier: Apache-2.0
// Simulated loops are paused, stepped, sped up, reset and pulled at.
#include <articula/dynamics/forward_dynamics.hpp>
#include <articula/hardware/mock/mock_hardware.hpp>

#include <cmath>
#include <string>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "remote/remote_arm.hpp"
#include "robots/energy.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using namespace articula::remote;
using support::elbow;
using support::PlainArm;
using support::RemoteArm;
using support::shoulder;
using support::SupervisedArm;

TEST_CASE("a paused simulation makes no cycles but single steps") {
  PlainArm arm;
  arm.cycles(10);
  REQUIRE(arm.ask(Pause{true}).verdict == support::Verdict::done);
  CHECK(arm.remote.situation().paused);
  const double time = arm.loop.time();
  arm.cycles(100);
  CHECK(arm.loop.time() == time);
  REQUIRE(arm.ask(Step{3}).verdict == support::Verdict::done);
  CHECK(std::abs(arm.loop.time() - time - 3e-3) < 1e-12);
  CHECK(arm.ask(Step{0}).verdict == support::Verdict::refused);
  REQUIRE(arm.ask(Pause{false}).verdict == support::Verdict::done);
  CHECK(arm.ask(Step{1}).text == "single steps need a paused simulation: pause it first");
}

TEST_CASE("a paused loop can be activated, and its motions wait") {
  SupervisedArm arm;
  REQUIRE(arm.ask(Pause{true}).verdict == support::Verdict::done);
  REQUIRE(arm.ask(Activate{}).verdict == support::Verdict::done);
  REQUIRE(arm.ask(Go{{{shoulder, 1}}}).verdict == support::Verdict::done);
  const JointVector<2> position = arm.loop.reference().position;
  arm.cycles(100);
  CHECK(arm.loop.reference().position == position);
  REQUIRE(arm.ask(Step{50}).verdict == support::Verdict::done);
  CHECK(arm.loop.reference().position[0] > position[0]);
}

TEST_CASE("simulated time passes slower and faster") {
  PlainArm arm;
  for (const double factor : {0.01, 0.1, 0.3, 1.0, 2.5, 100.0}) {
    CAPTURE(factor);
    REQUIRE(arm.ask(SetSpeed{factor}).verdict == support::Verdict::done);
    CHECK(arm.remote.situation().speed == factor);
    const double time = arm.loop.time();
    arm.cycles(1000);
    CHECK(std::abs(arm.loop.time() - time - factor) <= std::max(1.0, factor) * 1e-3 + 1e-9);
  }
  CHECK(arm.ask(SetSpeed{0}).verdict == support::Verdict::refused);
  CHECK(arm.ask(SetSpeed{101}).verdict == support::Verdict::refused);
  CHECK(arm.ask(SetSpeed{support::not_a_number}).verdict == support::Verdict::refused);
}

TEST_CASE("every cycle of a fast simulation is published") {
  PlainArm arm;
  arm.ask(SetSpeed{10});
  Cycle cycle;
  while (arm.session->next(cycle)) {
  }
  const auto before = cycle.number;
  arm.cycles(20);
  auto expected = before;
  while (arm.session->next(cycle)) CHECK(cycle.number == ++expected);
  CHECK(expected - before >= 190);
}

TEST_CASE("a reset puts an active arm at rest into a position, from where it goes on") {
  SupervisedArm supervised;
  supervised.ask(Activate{});
  PlainArm plain;
  const auto check = [](auto& arm) {
    arm.ask(Go{{{shoulder, 1}, {elbow, -1}}});
    arm.cycles(400);
    REQUIRE(arm.ask(Reset{{{elbow, 0.5}}}).verdict == support::Verdict::done);
    arm.cycles(2);
    CHECK((arm.loop.hardware().true_state().position - JointVector<2>(0, 0.5)).norm() < 1e-3);
    CHECK(arm.loop.hardware().true_state().velocity.norm() < 0.1);
    CHECK((arm.loop.reference().position - JointVector<2>(0, 0.5)).norm() < 1e-3);
    arm.cycles(500);
    CHECK((arm.loop.state().position - JointVector<2>(0, 0.5)).norm() < 1e-3);
    CHECK(arm.remote.situation().mode == LoopMode::active);
    CHECK(arm.ask(Reset{{{elbow, 5}}}).verdict == support::Verdict::refused);
  };
  check(supervised);
  check(plain);
}

TEST_CASE("a reset leaves an arm inactive that was not active") {
  SupervisedArm arm;
  REQUIRE(arm.ask(Reset{{{shoulder, 0.3}}}).verdict == support::Verdict::done);
  CHECK(arm.loop.mode() == LoopMode::inactive);
  CHECK(arm.loop.hardware().true_state().position == JointVector<2>(0.3, 0));
}

TEST_CASE("a pull moves the arm, and the controller brings it back") {
  SupervisedArm arm;
  arm.ask(Activate{});
  arm.cycles(100);
  REQUIRE(arm.ask(Pull{"tool_link", {0, 0, 0}, {0, 30, 0}}).verdict == support::Verdict::done);
  arm.cycles(200);
  const double pulled = arm.loop.state().position[0];
  CHECK(pulled > 1e-4);
  // The drive resists, and measures its own effort alone.
  CHECK(arm.loop.state().effort[0] < -1);
  REQUIRE(arm.ask(Pull{"tool_link", {}, {}}).verdict == support::Verdict::done);
  arm.cycles(3000);
  CHECK(std::abs(arm.loop.state().position[0]) < pulled / 10);
  CHECK(std::abs(arm.loop.state().effort[0]) < 1);

  CHECK(arm.ask(Pull{"hand", {}, {1, 0, 0}}).text.find("'hand'") != std::string::npos);
  CHECK(arm.ask(Pull{"tool_link", {}, {1e4, 0, 0}}).verdict == support::Verdict::refused);
  CHECK(arm.ask(Pull{"tool_link", {support::not_a_number, 0, 0}, {1, 0, 0}}).verdict ==
        support::Verdict::refused);
}

TEST_CASE("a pull ends with the session that asked for it, and with its controls") {
  SupervisedArm arm;
  arm.ask(Activate{});
  arm.ask(Pull{"tool_link", {}, {0, 30, 0}});
  arm.cycles(1000);
  const double pushed = arm.loop.state().effort[0];
  REQUIRE(pushed < -1);
  SECTION("session") { arm.session.reset(); }
  SECTION("controls") { arm.session->release_controls(); }
  arm.cycles(3000);
  CHECK(std::abs(arm.loop.state().effort[0]) < 1);
}

TEST_CASE("the efforts of a pull do the work of its force") {
  const support::TiltedQ2d robot;
  const LinkIndex link = link_index(robot, "tool_link");
  support::Random random(7);
  for (int k = 0; k < 100; ++k) {
    const JointVector<2> q = random.vector<2>(1.5), v = random.vector<2>(2);
    const Eigen::Vector3d point = random.vector<3>(0.2), force = random.vector<3>(20);
    LinkPull<support::TiltedQ2d> pull;
    pull.set(link, point, force);
    // The power of the force is that of the efforts, by differences of the point's position.
    const double step = 1e-6;
    const auto at = [&](double time) -> Eigen::Vector3d {
      return forward_kinematics(robot, JointVector<2>(q + time * v), link) * point;
    };
    const double power = force.dot(at(step) - at(-step)) / (2 * step);
    CHECK(std::abs(pull.effort(robot, q).dot(v) - power) < 1e-6);
  }
}

TEST_CASE("an effort from outside moves a simulated arm as a drive's does, and does its work") {
  using Arm = Simulator<Model<2>>;
  support::Random random(8);
  for (int k = 0; k < 50; ++k) {
    const SimulatorOptions<2> options{.initial_position = random.vector<2>(1),
                                      .initial_velocity = random.vector<2>(1)};
    const Model<2> robot = support::free_arm<support::TiltedQ2d>();
    Arm pulled(robot, options), driven(robot, options);
    const JointVector<2> effort = random.vector<2>(5), external = random.vector<2>(5);
    pulled.set_external_effort(external);
    const double before = support::energy(pulled);
    const JointVector<2> start = pulled.true_state().position;
    const JointVector<2> acceleration = forward_dynamics(robot, start, pulled.true_state().velocity,
                                                         JointVector<2>(effort + external));
    static_cast<void>(pulled.write(EffortCommand<2>{effort}));
    static_cast<void>(driven.write(EffortCommand<2>{effort + external}));
    CHECK(pulled.true_state().position == driven.true_state().position);
    CHECK(pulled.true_state().velocity == driven.true_state().velocity);
    CHECK(pulled.true_state().effort == effort);
    const JointVector<2> way = pulled.true_state().position - start;
    CHECK(std::abs(support::energy(pulled) - before - (effort + external).dot(way)) < 1e-9);
    CHECK((pulled.true_state().velocity - options.initial_velocity - 1e-3 * acceleration).norm() <
          1e-3);
  }
}

TEST_CASE("a drive that follows positions ideally reports the effort against a pull") {
  Simulator<Q2d> arm({.drives = DriveModel::ideal});
  arm.set_external_effort({3, -1});
  static_cast<void>(arm.write(PositionCommand<2>{}));
  CHECK(arm.true_state().position == JointVector<2>(0, 0));
  CHECK((arm.true_state().effort - JointVector<2>(-3, 1)).norm() < 1e-12);
}

TEST_CASE("hardware that is not simulated refuses the requests for simulations") {
  RemoteArm<SupervisedLoop<MockHardware<Q2d>, PidPlusGravity>> arm;
  CHECK(!arm.remote.robot().is_simulated);
  for (const Request& request : std::initializer_list<Request>{Pause{}, Step{}, SetSpeed{}, Reset{},
                                                               Pull{"tool_link", {}, {1, 0, 0}}}) {
    const Answer answer = arm.ask(request);
    CHECK(answer.verdict == support::Verdict::refused);
    CHECK(answer.text == "this robot is not simulated");
  }
}
