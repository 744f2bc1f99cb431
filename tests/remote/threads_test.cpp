// SPDX-License-Identifier: Apache-2.0
// A loop runs in one thread while others watch it, operate it and leave. Built with the thread
// sanitizer, this is the proof that they do not race.
#include <articula/loop/simulated_clock.hpp>

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "catch.hpp"
#include "random.hpp"
#include "remote/remote_arm.hpp"

using namespace articula;
using namespace articula::remote;
using support::elbow;
using support::shoulder;

namespace {

template <class R>
using Controllers = Switch<R, PidPlusGravity<R>, ComputedTorque<R>>;

Request request(support::Random& random) {
  const std::string& joint = random.one_in(2) ? shoulder : elbow;
  switch (random.integer(0, 11)) {
    case 0:
      return Activate{};
    case 1:
      return PlayTrajectory{{{joint}, {{.time_from_start = 0.3, .positions = {0.1}}}}};
    case 2:
      return SwitchControllers{.start = {"computed_torque"}, .replace = true};
    case 3:
      return SetParameters{{{"pid_plus_gravity." + joint + ".p", random.number(100, 2000)}}};
    case 4:
      return Pull{"tool_link", {}, {0, random.number(-5, 5), 0}};
    case 5:
      return PlaySignals{{{joint, SineSignal{0.1, 1}}}, 0.1};
    case 6:
      return SetReference{{{joint, random.number(-1, 1)}}};
    case 7:
      return Stop{};
    default:
      return Go{{{joint, random.number(-1, 1)}}};
  }
}

}  // namespace

TEST_CASE("a loop is watched and operated by other threads, and each request is answered") {
  SupervisedLoop<Q2dSim, Controllers> loop;
  Remote remote(loop, {.operator_lifetime = 1e9, .answer_time = 60});
  StopFlag stop;
  constexpr int operators = 3, sessions = 20, requests = 20;
  std::atomic<int> at_work = operators;
  std::atomic<std::uint64_t> asked = 0, answered = 0;
  std::vector<std::thread> threads;
  for (int k = 0; k < operators; ++k) {
    threads.emplace_back([&, k] {
      support::Random random(static_cast<unsigned>(k));
      for (int s = 0; s < sessions; ++s) {
        const auto session = remote.connect("operator", true);
        std::uint64_t last = 0;
        for (int r = 0; r < requests; ++r) {
          last = session->ask(request(random));
          session->keep_alive();
          std::this_thread::yield();
        }
        asked += last;
        session->ask(Stop{});  // ends a motion that would be answered at its end
        for (std::uint64_t own = 0; own < last + 1;) {
          if (session->answer()) {
            ++own;
          } else {
            std::this_thread::yield();
          }
        }
        answered += last;
        if (random.one_in(2)) session->release_controls();
      }
      if (--at_work == 0) stop.request();
    });
  }
  std::uint64_t cycles = 0;
  bool in_order = true;
  threads.emplace_back([&] {
    const auto session = remote.connect("spectator", false);
    Cycle cycle;
    std::uint64_t before = 0;
    while (at_work > 0) {
      while (session->next(cycle)) {
        in_order = in_order && cycle.number > before;
        before = cycle.number;
        ++cycles;
      }
      while (session->event()) {
      }
      static_cast<void>(remote.situation());
      static_cast<void>(remote.parameters());
      static_cast<void>(remote.statistics());
      static_cast<void>(remote.link_poses({0, 0}));
      std::this_thread::yield();
    }
  });

  SimulatedClock clock;
  const RunReport report = remote.run(clock, {.stop = &stop});
  for (std::thread& thread : threads) thread.join();
  CHECK(report.end == RunEnd::stopped);
  CHECK(loop.mode() == LoopMode::inactive);
  CHECK(asked == operators * sessions * requests);
  CHECK(answered == asked);
  CHECK(cycles > 0);
  CHECK(in_order);
}
