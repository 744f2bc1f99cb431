// SPDX-License-Identifier: Apache-2.0
// Controllers are listed and switched, and their gains read and set, whatever the composition.
#include <algorithm>
#include <cmath>
#include <limits>

#include "catch.hpp"
#include "numbers.hpp"
#include "remote/remote_arm.hpp"

using namespace articula;
using namespace articula::remote;
using support::elbow;
using support::RemoteArm;
using support::shoulder;
using support::SupervisedArm;

namespace {

template <class R>
using Controllers = Switch<R, PidPlusGravity<R>, ComputedTorque<R>>;
using SwitchedArm = RemoteArm<SupervisedLoop<Q2dSim, Controllers>>;

template <class R>
using TwoGroups = Groups<R, Controllers<R>, JointImpedance<R>>;
using GroupLoop = ControlLoop<Q2dSim, TwoGroups<Q2d>>;

TwoGroups<Q2d> two_groups() {
  return TwoGroups<Q2d>({{{"upper", {shoulder}, 1}, {"lower", {elbow}, 2}}}, Controllers<Q2d>(),
                        JointImpedance<Q2d>({{{100, 1}, {20, 0.5}}}));
}

std::optional<Parameter> parameter(Port& port, const std::string& name) {
  for (const Parameter& p : port.parameters()) {
    if (p.name == name) return p;
  }
  return std::nullopt;
}

ControllerStatus status_of(Port& port, std::string_view name) {
  for (const ControllerInfo& info : port.situation().controllers) {
    if (info.name.view() == name) return info.status;
  }
  FAIL("no such controller");
  return {};
}

}  // namespace

TEST_CASE("a single controller is listed by its name, active while the loop is") {
  SupervisedArm arm;
  CHECK(status_of(arm.remote, "pid_plus_gravity") == ControllerStatus::inactive);
  arm.ask(Activate{});
  CHECK(status_of(arm.remote, "pid_plus_gravity") == ControllerStatus::active);
  const Answer answer = arm.ask(SwitchControllers{{"pid"}});
  CHECK(answer.verdict == support::Verdict::refused);
  CHECK(answer.text == "this loop has one controller, 'pid_plus_gravity', and nothing to switch");
}

TEST_CASE("controllers of a Switch are switched, and the list shows it with the answer") {
  SwitchedArm arm;
  arm.ask(Activate{});
  CHECK(status_of(arm.remote, "pid_plus_gravity") == ControllerStatus::active);
  CHECK(arm.ask(SwitchControllers{{"computed_torque"}, {"pid_plus_gravity"}}).verdict ==
        support::Verdict::done);
  CHECK(status_of(arm.remote, "pid_plus_gravity") == ControllerStatus::inactive);
  CHECK(status_of(arm.remote, "computed_torque") == ControllerStatus::active);
  CHECK(arm.ask(SwitchControllers{.start = {"pid_plus_gravity"}, .replace = true}).verdict ==
        support::Verdict::done);
  CHECK(status_of(arm.remote, "pid_plus_gravity") == ControllerStatus::active);

  const Answer unknown = arm.ask(SwitchControllers{{"knee"}});
  CHECK(unknown.verdict == support::Verdict::refused);
  CHECK(unknown.text ==
        "controller 'knee': unknown name; controllers: pid_plus_gravity, computed_torque");
  const Answer misspelt = arm.ask(SwitchControllers{{"computed_torqe"}});
  CHECK(misspelt.text ==
        "controller 'computed_torqe': unknown name; did you mean 'computed_torque'?");
  const Answer occupied = arm.ask(SwitchControllers{{"computed_torque"}});
  CHECK(occupied.verdict == support::Verdict::refused);
  CHECK(occupied.text.find("another controller of these joints") != std::string::npos);
  CHECK(
      arm.ask(SwitchControllers{{"knee", "computed_torque"}, {"pid_plus_gravity"}, true}).verdict ==
      support::Verdict::done);
  CHECK(status_of(arm.remote, "computed_torque") == ControllerStatus::active);
  CHECK(arm.ask(SwitchControllers{{std::string(64, 'x')}}).verdict == support::Verdict::refused);
  CHECK(arm.ask(SwitchControllers{std::vector<std::string>(17, "x")}).verdict ==
        support::Verdict::refused);
}

TEST_CASE("gains have the names and units of their controller and joint") {
  SupervisedArm arm;
  const auto p = parameter(arm.remote, "pid_plus_gravity." + shoulder + ".p");
  REQUIRE(p);
  CHECK(p->value == 2310);
  CHECK(p->unit == "N m/rad");
  CHECK(p->lowest == 0);
  CHECK(parameter(arm.remote, "pid_plus_gravity." + elbow + ".i")->unit == "N m/(rad s)");
  CHECK(parameter(arm.remote, "pid_plus_gravity." + elbow + ".d")->unit == "N m s/rad");
  CHECK(parameter(arm.remote, "pid_plus_gravity." + elbow + ".i_clamp_max")->value == 13.62);
  CHECK(parameter(arm.remote, "pid_plus_gravity." + elbow + ".i_clamp_max")->unit == "N m");
  CHECK(parameter(arm.remote, "pid_plus_gravity." + elbow + ".position_weight")->unit == "1");
}

TEST_CASE("units follow from the command and the law of a controller") {
  SwitchedArm arm;
  CHECK(parameter(arm.remote, "computed_torque." + shoulder + ".p")->unit == "1/s^2");
  CHECK(parameter(arm.remote, "computed_torque." + shoulder + ".d")->unit == "1/s");
  CHECK(parameter(arm.remote, "computed_torque." + shoulder + ".u_clamp_max")->unit == "rad/s^2");
  CHECK(parameter(arm.remote, "pid_plus_gravity." + shoulder + ".p")->value == 2310);

  using Velocity = VelocityByEffort<Q2d>;
  const JointPidGains<2> gains{{{.proportional = 3}, {.proportional = 1}}};
  ControlLoop<Q2dSim, Velocity> loop{Velocity(gains)};
  Remote remote(loop);
  CHECK(parameter(remote, "velocity_by_effort." + shoulder + ".p")->unit == "N m s/rad");
  CHECK(parameter(remote, "velocity_by_effort." + shoulder + ".i")->unit == "N m/rad");
  CHECK(parameter(remote, "velocity_by_effort." + shoulder + ".velocity_feedforward")->unit ==
        "N m s/rad");
  CHECK(unit_text({.effort = 1, .position = -1}, true) == "N/m");
}

TEST_CASE("gains are found through groups, on the joints of each") {
  RemoteArm<GroupLoop> arm({}, two_groups());
  CHECK(parameter(arm.remote, "upper/pid_plus_gravity." + shoulder + ".p"));
  CHECK(parameter(arm.remote, "upper/computed_torque." + shoulder + ".p"));
  CHECK(!parameter(arm.remote, "upper/pid_plus_gravity." + elbow + ".p"));
  const auto stiffness = parameter(arm.remote, "joint_impedance." + elbow + ".stiffness");
  REQUIRE(stiffness);
  CHECK(stiffness->value == 20);
  CHECK(stiffness->unit == "N m/rad");
  CHECK(!parameter(arm.remote, "joint_impedance." + shoulder + ".stiffness"));

  CHECK(arm.ask(SetParameters{{{"joint_impedance." + elbow + ".stiffness", 25}}}).verdict ==
        support::Verdict::done);
  CHECK(parameter(arm.remote, "joint_impedance." + elbow + ".stiffness")->value == 25);
  CHECK(arm.ask(SwitchControllers{{"upper/computed_torque"}, {"upper/pid_plus_gravity"}}).verdict ==
        support::Verdict::done);
  CHECK(status_of(arm.remote, "upper/computed_torque") == ControllerStatus::active);
}

TEST_CASE("gains are found through limits and sums of laws on some joints") {
  using Law = OnJoints<2, PidLaw<2>>;
  using Sum = EffortController<Q2d, Law, Law>;
  const JointPidGains<2> gains{{{.proportional = 100}, {.proportional = 50}}};
  const auto on = [&](std::string_view joint) {
    return Law(Q2d(), PidLaw<2>(Q2d(), gains), std::span(&joint, 1));
  };
  CommandLimits<2> limits = command_limits(Q2d());
  limits.acceleration = {20, 40};
  limits.jerk = {2000, 4000};
  using Careful = Limited<Q2d, Sum>;
  ControlLoop<Q2dSim, Careful> loop(Q2dSim(), Careful(limits, Sum(Q2d(), on(shoulder), on(elbow))));
  Remote remote(loop);
  CHECK(parameter(remote, "controller_1." + shoulder + ".p")->value == 100);
  CHECK(parameter(remote, "controller_1." + elbow + ".p")->value == 50);
  CHECK(!parameter(remote, "controller_1." + elbow + ".p_2"));
}

TEST_CASE("gains are set in the controller all together, and take effect") {
  SupervisedArm arm;
  arm.ask(Activate{});
  const std::string name = "pid_plus_gravity." + shoulder;
  CHECK(arm.ask(SetParameters{{{name + ".p", 1000}, {name + ".d", 5}}}).verdict ==
        support::Verdict::done);
  CHECK(parameter(arm.remote, name + ".p")->value == 1000);
  CHECK(arm.loop.controller().part<PidLaw<2>>().gains()[0].proportional == 1000);
  CHECK(arm.loop.controller().part<PidLaw<2>>().gains()[0].derivative == 5);
  CHECK(arm.loop.controller().part<PidLaw<2>>().gains()[1].proportional == 339);
}

TEST_CASE("gains of which one is bad are refused together, and nothing changes") {
  SupervisedArm arm;
  arm.ask(Activate{});
  const std::string name = "pid_plus_gravity." + shoulder;
  const auto refused = [&](const std::string& gain, double value, const std::string& words) {
    const Answer answer = arm.ask(SetParameters{{{name + ".p", 7}, {name + gain, value}}});
    CAPTURE(answer.text);
    CHECK(answer.verdict == support::Verdict::refused);
    CHECK(answer.text.find(words) != std::string::npos);
    CHECK(parameter(arm.remote, name + ".p")->value == 2310);
    CHECK(arm.loop.controller().part<PidLaw<2>>().gains()[0].proportional == 2310);
  };
  refused(".d", -1, "parameter '" + name + ".d': -1 N m s/rad is not within 0 .. inf");
  refused(".d", support::not_a_number, ": nan N m s/rad");
  refused(".d", std::numeric_limits<double>::infinity(), "derivative inf is not finite");
  refused(".i_clamp_max", -0.1, "is not within 0 .. inf");
  refused(".position_weight", 1.5, "is not within 0 .. 1");
  refused(".q", 1, "there is no parameter '" + name + ".q'");
  CHECK(arm.ask(SetParameters{}).verdict == support::Verdict::refused);
}

TEST_CASE("the log tells what requests change, and what became of those that were refused") {
  SwitchedArm arm;
  arm.ask(Activate{});
  const std::string p = "pid_plus_gravity." + elbow + ".p";
  const auto log = [&] {
    std::vector<std::string> lines;
    while (const auto event = arm.session->event()) {
      const bool warns = event->level == Event::Level::warning;
      if (event->text.starts_with("test: ")) lines.push_back((warns ? "! " : "") + event->text);
    }
    return lines;
  };
  log();
  arm.ask(SetParameters{{{p, 300}}});
  CHECK(log() == std::vector<std::string>{"test: set_parameters " + p + " = 300"});
  const Answer negative = arm.ask(SetParameters{{{p, -1}}});
  CHECK(log() ==
        std::vector<std::string>{"! test: set_parameters " + p + " = -1: " + negative.text});
  const Answer unknown = arm.ask(SwitchControllers{{"pid"}, {"computed_torque"}});
  const std::string request = "test: switch_controllers start pid stop computed_torque";
  CHECK(log() == std::vector<std::string>{request, "! " + request + ": " + unknown.text});
  arm.ask(Go{{{elbow, 100}}});  // sliders make such requests many times a second
  CHECK(log().empty());
}

TEST_CASE("gains that follow each other before the loop takes them add up") {
  SupervisedArm arm;
  const std::string name = "pid_plus_gravity." + shoulder;
  arm.session->ask(SetParameters{{{name + ".p", 1000}}});
  arm.session->ask(SetParameters{{{name + ".d", 5}}});
  arm.cycles(3);
  CHECK(parameter(arm.remote, name + ".p")->value == 1000);
  CHECK(parameter(arm.remote, name + ".d")->value == 5);
  CHECK(arm.loop.controller().part<PidLaw<2>>().gains()[0].proportional == 1000);
}

TEST_CASE("gains that timed out do not come with later ones") {
  SupervisedArm arm({.answer_time = 0.01});
  const std::string name = "pid_plus_gravity." + shoulder;
  const auto& law = arm.loop.controller().part<PidLaw<2>>();
  const double p = law.gains()[0].proportional, d = law.gains()[0].derivative;
  arm.session->ask(SetParameters{{{name + ".p", p + 1}}});
  std::optional<Answer> answer;
  while (!(answer = arm.session->answer())) {
  }
  CHECK(answer->verdict == support::Verdict::timed_out);
  arm.session->ask(SetParameters{{{name + ".d", d + 1}}});
  arm.cycles(3);
  CHECK(law.gains()[0].proportional == p);
  CHECK(law.gains()[0].derivative == d);
  CHECK(arm.session->answer()->verdict == support::Verdict::refused);
  CHECK(arm.ask(SetParameters{{{name + ".d", d + 1}}}).verdict == support::Verdict::done);
  CHECK(law.gains()[0].proportional == p);
  CHECK(law.gains()[0].derivative == d + 1);
}
