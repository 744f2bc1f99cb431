// SPDX-License-Identifier: Apache-2.0
// One session at a time has the controls: taken, released, lost.
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "catch.hpp"
#include "remote/remote_arm.hpp"

using namespace articula;
using namespace articula::remote;
using support::elbow;
using support::PlainArm;
using support::shoulder;
using support::SupervisedArm;

namespace {

using Arm = SupervisedLoop<Q2dSim, PidPlusGravity>;

/// A loop in motion whose operator is silent for 50 cycles, and then the next cycle is made.
template <class Check>
void after_silence(OperatorLoss when_lost, const Check& check) {
  Arm arm;
  Remote remote(arm, {.operator_lifetime = 0.05, .when_operator_is_lost = when_lost});
  const auto session = remote.connect("silent", true);
  const auto cycles = [&](int count) {
    for (int k = 0; k < count; ++k) static_cast<void>(remote.update());
  };
  session->ask(Activate{});
  cycles(10);
  session->ask(Go{{{shoulder, 1.5}}});
  cycles(49);
  REQUIRE(std::as_const(arm).reference().velocity[0] != 0);
  cycles(4);
  check(arm, remote, cycles);
}

}  // namespace

TEST_CASE("one session takes and releases the controls, others watch") {
  SupervisedArm arm;
  const auto other = arm.remote.connect("other", true);
  CHECK(arm.session->take_controls().empty());
  CHECK(arm.session->take_controls().empty());
  CHECK(arm.session->has_controls());
  CHECK(arm.remote.situation().operator_name == "test");
  CHECK(other->take_controls() ==
        "somebody else has the controls: test; it must release them first");
  const auto number = other->ask(Activate{});
  const auto answer = other->answer();
  REQUIRE(answer);
  CHECK(answer->request == number);
  CHECK(answer->verdict == support::Verdict::refused);
  CHECK(answer->text == "somebody else has the controls: test; it must release them first");
  other->release_controls();
  CHECK(arm.session->has_controls());
  arm.session->release_controls();
  CHECK(arm.remote.situation().operator_name.empty());
  CHECK(other->take_controls().empty());
  CHECK(other->has_controls());
  CHECK(!arm.session->has_controls());
}

TEST_CASE("a request takes controls that are free; who may watch only gets none") {
  SupervisedArm arm;
  const auto spectator = arm.remote.connect("spectator", false);
  CHECK(spectator->take_controls() == "this client may watch only");
  spectator->ask(Activate{});
  CHECK(spectator->answer()->text == "this client may watch only");
  CHECK(arm.ask(Activate{}).verdict == support::Verdict::done);
  CHECK(arm.session->has_controls());
}

TEST_CASE("a motion goes on when its operator releases the controls") {
  SupervisedArm arm;
  arm.ask(Activate{});
  arm.ask(Go{{{shoulder, 1}}});
  arm.cycles(100);
  arm.session->release_controls();
  arm.cycles(4000);
  CHECK(arm.loop.reference().position[0] == 1);
}

TEST_CASE("a motion stops when its operator's session ends") {
  SupervisedArm arm;
  arm.ask(Activate{});
  arm.ask(Go{{{shoulder, 1.5}}});
  arm.cycles(100);
  arm.session.reset();
  CHECK(arm.remote.situation().operator_name.empty());
  arm.cycles(2);
  CHECK(arm.remote.situation().motion == "stop");
  arm.cycles(2000);
  CHECK(arm.loop.reference().velocity[0] == 0);
  CHECK(arm.loop.reference().position[0] < 1.4);
  CHECK(arm.loop.mode() == LoopMode::active);
}

TEST_CASE("what a lost operator has asked is not begun after the loss") {
  SupervisedArm arm;
  arm.ask(Activate{});
  arm.session->ask(Go{{{shoulder, 1.5}}});
  arm.session->ask(Pull{"tool_link", {}, {0, 30, 0}});
  arm.session.reset();
  arm.cycles(1000);
  CHECK(arm.loop.reference().position == JointVector<2>(0, 0));
  CHECK(std::abs(arm.loop.state().position[0]) < 1e-6);
}

TEST_CASE("a lost operator's activation is not begun after the loss") {
  SupervisedArm arm({.when_operator_is_lost = OperatorLoss::deactivate});
  arm.session->ask(Activate{});
  arm.session.reset();
  arm.cycles(100);
  CHECK(arm.loop.mode() == LoopMode::inactive);
}

TEST_CASE("a lost operator's deactivation is still done") {
  SupervisedArm arm;
  arm.ask(Activate{});
  arm.session->ask(Deactivate{});
  arm.session.reset();
  arm.cycles(20);
  CHECK(arm.loop.mode() == LoopMode::inactive);
}

TEST_CASE("what an operator has asked is not begun after the loop has found the silence") {
  Arm arm;
  Remote remote(arm, {.operator_lifetime = 0.01});  // 10 cycles
  const auto session = remote.connect("silent", true);
  session->ask(Activate{});
  for (int k = 0; k < 20; ++k) session->ask(SetSpeed{1});  // one in each period
  session->ask(Go{{{shoulder, 1.5}}});
  for (int k = 0; k < 1000; ++k) static_cast<void>(remote.update());
  CHECK(arm.mode() == LoopMode::active);
  CHECK(std::as_const(arm).reference().position[0] == 0);
}

TEST_CASE("the loss of an operator does not stop the first motion of the next") {
  SupervisedArm arm;
  arm.ask(Activate{});
  arm.ask(Go{{{shoulder, 1.5}}});
  const auto next = arm.remote.connect("next", true);
  arm.session.reset();
  next->ask(Go{{{shoulder, -0.5}}});
  arm.cycles(4000);
  CHECK(arm.loop.reference().position[0] == -0.5);
}

TEST_CASE("the loss of an operator deactivates before the next one activates") {
  SupervisedArm arm({.when_operator_is_lost = OperatorLoss::deactivate});
  arm.ask(Activate{});
  const auto next = arm.remote.connect("next", true);
  arm.session.reset();
  next->ask(Activate{});
  arm.cycles(20);
  CHECK(arm.loop.mode() == LoopMode::active);
}

TEST_CASE("a pull ends with the release of the controls, also behind many requests") {
  SupervisedArm arm;
  arm.ask(Activate{});
  arm.session->ask(Pull{"tool_link", {}, {0, 30, 0}});
  while (!arm.session->answer()) arm.session->ask(SetSpeed{1});  // until one is refused
  arm.session->release_controls();
  arm.cycles(200);  // enough to be pulled away, too few for the controller to bring it back
  CHECK(std::abs(arm.loop.state().position[0]) < 1e-6);
}

TEST_CASE("a stop finds a place, and overtakes references that wait") {
  SupervisedArm arm;
  arm.ask(Activate{});
  for (int k = 1; k <= 64; ++k) arm.session->ask(SetReference{{{shoulder, 0.01 * k}}});
  const auto number = arm.session->ask(Stop{});
  arm.cycles(100);
  CHECK(arm.loop.reference().position[0] == 0);
  std::optional<Answer> last;
  while (const auto answer = arm.session->answer()) last = answer;
  REQUIRE(last);
  CHECK(last->request == number);
  CHECK(last->verdict == support::Verdict::done);
}

TEST_CASE("who may operate may stop without the controls, a spectator may not") {
  SupervisedArm arm;
  const auto other = arm.remote.connect("other", true);
  const auto spectator = arm.remote.connect("spectator", false);
  arm.ask(Activate{});
  arm.ask(Go{{{shoulder, 1.5}}});
  spectator->ask(Stop{});
  arm.cycles(2);
  CHECK(spectator->answer()->verdict == support::Verdict::refused);
  CHECK(arm.remote.situation().motion == "go");
  other->ask(Stop{});
  arm.cycles(2);
  CHECK(other->answer()->verdict == support::Verdict::done);
  CHECK(arm.remote.situation().motion == "stop");
  CHECK(arm.session->has_controls());
}

TEST_CASE("a silent operator is lost: the motion stops") {
  after_silence(OperatorLoss::stop, [](Arm& arm, auto& remote, const auto& cycles) {
    CHECK(remote.situation().motion == "stop");
    cycles(2000);
    CHECK(arm.mode() == LoopMode::active);
    CHECK(arm.reference().velocity[0] == 0);
    CHECK(arm.reference().position[0] < 1);
  });
}

TEST_CASE("a silent operator is lost: the loop is deactivated, if so declared") {
  after_silence(OperatorLoss::deactivate,
                [](Arm& arm, auto&, const auto&) { CHECK(arm.mode() == LoopMode::inactive); });
}

TEST_CASE("a sign of life keeps the controls") {
  Arm arm;
  Remote remote(arm, {.operator_lifetime = 0.05});
  const auto session = remote.connect("alive", true);
  session->ask(Activate{});
  for (int k = 0; k < 10; ++k) static_cast<void>(remote.update());
  session->ask(Go{{{shoulder, 1.5}}});
  for (int k = 0; k < 200; ++k) {
    if (k % 20 == 0) session->keep_alive();
    static_cast<void>(remote.update());
  }
  CHECK(remote.situation().motion == "go");
}

TEST_CASE("an operator's silence is measured in the host's time, however fast the simulation is") {
  Arm arm;
  Remote remote(arm, {.operator_lifetime = 60});
  const auto session = remote.connect("slow", true);
  session->ask(Activate{});
  for (int k = 0; k < 10; ++k) static_cast<void>(remote.update());
  session->ask(PlaySignals{{{shoulder, SineSignal{0.05, 2}}}, 200});
  for (int k = 0; k < 100'000; ++k) {  // 100 s, in less than 60 s of the host
    static_cast<void>(remote.update());
    if (k % 1000 == 0) REQUIRE(session->has_controls());  // somebody looks, as a view does
  }
  CHECK(remote.situation().motion == "signals");
}

TEST_CASE("the controls of an operator that is silent pass to others, who hear of it") {
  Arm arm;
  Remote remote(arm, {.operator_lifetime = 1e-9});
  const auto silent = remote.connect("silent", true), other = remote.connect("other", true);
  CHECK(silent->take_controls().empty());
  CHECK(other->take_controls().empty());
  CHECK(!silent->has_controls());
  bool heard = false;
  while (const auto event = other->event()) {
    heard = heard || (event->text == "the operator silent is silent" &&
                      event->level == Event::Level::warning);
  }
  CHECK(heard);
}

TEST_CASE("a loop without supervision cannot be deactivated when its operator is lost") {
  Loop<Q2dSim, PidPlusGravity> arm;
  CHECK_THROWS_AS(Remote(arm, {.when_operator_is_lost = OperatorLoss::deactivate}),
                  std::invalid_argument);
  CHECK_THROWS_WITH(Remote(arm, {.operator_lifetime = 0}),
                    "remote: operator_lifetime 0 is not a number > 0");
}
