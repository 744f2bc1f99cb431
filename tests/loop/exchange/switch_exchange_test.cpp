// SPDX-License-Identifier: Apache-2.0
// Controllers are switched from another thread. Built with the thread sanitizer, this is the proof
// that the two do not race.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>

#include "catch.hpp"
#include "numbers.hpp"
#include "test_controllers.hpp"

using namespace articula;
using support::ConstantEffort;
using namespace std::chrono_literals;

namespace {

template <class R>
using Controllers = Switch<R, ConstantEffort<R>, PidPlusGravity<R>, ComputedTorque<R>>;
template <class R>
using Careful = Limited<R, Controllers<R>>;
using Parts = Groups<Q2d, Controllers<Q2d>, Controllers<Q2d>>;

const SwitchOptions<2> options{.names = {"constant", "pid", "computed"},
                               .fallbacks = {{"constant", {"pid"}}}};

Controllers<Q2d> controllers() { return Controllers<Q2d>(options, {}, {}, {}); }

void cycle(Controllers<Q2d>& c) { static_cast<void>(c.update({{}, {}, 1e-3})); }

}  // namespace

TEST_CASE("requests are passed on in order, and each has its outcome") {
  Controllers<Q2d> c = controllers();
  SwitchExchange exchange(c);
  CHECK(exchange.request({.start = {"pid"}}) == 1);
  CHECK(exchange.request({.stop = {"constant"}, .start = {"pid"}}) == 2);
  CHECK(exchange.request({.start = {"nonsense"}, .replace = true}) == 3);
  exchange.apply(c);
  CHECK_FALSE(exchange.outcome());  // the cycle in which they are done comes first
  c.start({{}, {}, 1e-3});
  cycle(c);
  CHECK(exchange.apply(c));
  CHECK(exchange.list()[1].status == ControllerStatus::active);
  auto outcome = exchange.outcome();
  REQUIRE(outcome);
  CHECK(outcome->request == 1);
  CHECK(outcome->outcome.answer == SwitchAnswer::occupied);
  outcome = exchange.outcome();
  REQUIRE(outcome);
  CHECK(outcome->request == 2);
  CHECK(outcome->outcome.answer == SwitchAnswer::done);
  outcome = exchange.outcome();
  REQUIRE(outcome);
  CHECK(outcome->request == 3);
  CHECK(outcome->outcome.answer == SwitchAnswer::unknown_name);
  CHECK(outcome->outcome.controller == "nonsense");
  CHECK_FALSE(exchange.outcome());
}

TEST_CASE("switches, failures and fallbacks are listed and reported") {
  Controllers<Q2d> c = controllers();
  SwitchExchange exchange(c);
  CHECK(exchange.list()[0].name == "constant");
  CHECK(exchange.list()[0].status == ControllerStatus::active);
  CHECK_FALSE(exchange.apply(c));
  CHECK_FALSE(exchange.event());
  c.start({{}, {}, 1e-3});
  c.member<0>().effort = support::not_a_number;
  cycle(c);
  CHECK(exchange.apply(c));
  CHECK_FALSE(exchange.apply(c));
  CHECK(exchange.list()[0].status == ControllerStatus::failed);
  CHECK(exchange.list()[1].status == ControllerStatus::active);
  auto event = exchange.event();
  REQUIRE(event);
  CHECK(event->controller == "constant");
  CHECK(event->before == ControllerStatus::active);
  CHECK(event->after == ControllerStatus::failed);
  event = exchange.event();
  REQUIRE(event);
  CHECK(event->controller == "pid");
  CHECK(event->after == ControllerStatus::active);
  CHECK_FALSE(exchange.event());
  CHECK(to_string(event->after) == "active");
}

TEST_CASE("too many requests are refused, and outcomes that nobody takes are in nobody's way") {
  Controllers<Q2d> c = controllers();
  SwitchExchange exchange(c);
  const auto n = SwitchExchange<3>::capacity;
  for (std::uint64_t k = 1; k <= n; ++k) CHECK(exchange.request({}) == k);
  CHECK(exchange.request({}) == 0);
  exchange.apply(c);
  CHECK(exchange.request({}) == n + 1);
  exchange.apply(c);                   // this outcome finds no room
  CHECK_FALSE(exchange.ask({}, 1ms));  // nobody applies
  std::atomic<bool> done = false;
  std::thread other([&] {
    while (!done) exchange.apply(c);
  });
  const auto outcome = exchange.ask({.stop = {"pid"}}, 10s);
  done = true;
  other.join();
  REQUIRE(outcome);
  CHECK(outcome->answer == SwitchAnswer::not_active);
}

TEST_CASE("groups and limited switches have an exchange as well") {
  Parts parts({{{"s", {"shoulder_active_joint"}}, {"e", {"elbow_active_joint"}, 2}}}, controllers(),
              controllers());
  SwitchExchange<6> of_groups(parts);
  CHECK(of_groups.list()[4].name == "e/pid");
  of_groups.request({.start = {"e/pid"}, .replace = true});
  of_groups.apply(parts);
  parts.start({{}, {}, 1e-3});
  CHECK(of_groups.apply(parts));
  CHECK(of_groups.list()[4].status == ControllerStatus::active);

  CommandLimits<2> limits = command_limits(Q2d());
  limits.acceleration = {20, 20};
  Careful<Q2d> careful(limits, controllers());
  SwitchExchange of_limited(careful);
  of_limited.request({.start = {"computed"}, .replace = true});
  of_limited.apply(careful);
  careful.start({{}, {}, 1e-3});
  CHECK(careful.controller().active() == "computed");
}

TEST_CASE("of a group with a divisor the outcome comes first, then the list shows it") {
  Parts parts({{{"s", {"shoulder_active_joint"}}, {"e", {"elbow_active_joint"}, 10}}},
              controllers(), controllers());
  SwitchExchange exchange(parts);
  parts.start({{}, {}, 1e-3});
  const auto cycle = [&] {
    exchange.apply(parts);
    static_cast<void>(parts.update({{}, {}, 1e-3}));
  };
  cycle();
  exchange.request({.start = {"e/pid"}, .replace = true});
  cycle();
  cycle();
  CHECK(exchange.outcome().has_value());
  CHECK(exchange.list()[4].status == ControllerStatus::inactive);
  for (int k = 3; k <= 10; ++k) cycle();  // the group is asked in the tenth cycle after its first
  cycle();
  CHECK(exchange.list()[4].status == ControllerStatus::active);
}

TEST_CASE("a running loop is switched, listed and watched by another thread") {
  Loop<Q2dSim, Controllers> loop(controllers());
  SwitchExchange exchange(loop.controller());
  StopFlag stop;
  int refused = 0, done = 0, events = 0;
  bool lists_make_sense = true;
  std::thread other([&] {
    const Name names[] = {"constant", "pid", "computed", "nonsense"};
    for (std::size_t k = 0; k < 300; ++k) {
      const auto outcome = exchange.ask({.start = {names[k % 4]}, .replace = true}, 60s);
      if (!outcome) break;
      (outcome->answer == SwitchAnswer::done ? done : refused) += 1;
      // Who was asked for is active by now, and nobody else.
      Name active;
      int count = 0;
      for (const ControllerInfo& info : exchange.list()) {
        if (info.status != ControllerStatus::active) continue;
        active = info.name;
        ++count;
      }
      const Name& asked = names[k % 4];
      lists_make_sense = lists_make_sense && count == 1 && (asked == "nonsense" || active == asked);
      while (exchange.event()) ++events;
    }
    stop.request();
  });
  SimulatedClock clock;
  double largest = 0;
  JointVector<2> before = JointVector<2>::Zero();
  const RunReport report = run(loop, clock, {.stop = &stop}, [&](auto& l, const RunReport& now) {
    exchange.apply(l.controller());
    largest = std::max(largest, (l.command().effort - before).cwiseAbs().maxCoeff());
    before = l.command().effort;
    return now.status == Status::ok;
  });
  other.join();
  CHECK(report.end == RunEnd::stopped);
  CHECK(done == 224);
  CHECK(refused == 76);  // nonsense, and at first what is active already
  CHECK(lists_make_sense);
  CHECK(events > 0);
  CHECK(largest <= loop.controller().slew()[0] * loop.period() + 1e-12);  // all of them ask for 0
}
