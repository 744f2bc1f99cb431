// SPDX-License-Identifier: Apache-2.0
// What a thread asks of the system. Which of it the system grants depends on who runs the test:
// both answers are tested, each where it is given.
#include <articula/articula.hpp>
#include <articula/loop/realtime/run_realtime.hpp>
#include <articula/loop/realtime/stop_on_signal.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>
#include <articula/robots/q2d.hpp>

#include <csignal>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "catch.hpp"

using namespace articula;

namespace {

/// Calls on a thread of its own, so that the test's stays as it is.
template <class Function>
void on_thread(Function function) {
  std::thread(function).join();
}

}  // namespace

TEST_CASE("a thread gets the priority it asks for, or an error says why not") {
  on_thread([] {
    try {
      make_realtime({.priority = 42, .lock_memory = false, .strict = true});
      int policy = 0;
      sched_param parameters{};
      REQUIRE(pthread_getschedparam(pthread_self(), &policy, &parameters) == 0);
      CHECK(policy == SCHED_FIFO);
      CHECK(parameters.sched_priority == 42);
    } catch (const std::system_error& error) {
      CHECK(error.code() == std::errc::operation_not_permitted);
      CHECK(std::string(error.what()).find("SCHED_FIFO priority 42") != std::string::npos);
      CHECK(std::string(error.what()).find("ulimit -r") != std::string::npos);
    }
  });
}

TEST_CASE("a thread runs on the processors it asks for") {
  on_thread([] {
    cpu_set_t allowed;
    REQUIRE(pthread_getaffinity_np(pthread_self(), sizeof allowed, &allowed) == 0);
    int processor = 0;
    while (!CPU_ISSET(static_cast<std::size_t>(processor), &allowed)) ++processor;
    make_realtime({.priority = 0, .processors = {processor}, .lock_memory = false, .strict = true});
    CHECK(sched_getcpu() == processor);
  });
}

TEST_CASE("a refusal is a warning, or an error for those who ask") {
  // The highest processor number that can be named is hardly there.
  ThreadOptions options{.priority = 0, .processors = {CPU_SETSIZE - 1}, .lock_memory = false};
  options.strict = true;
  on_thread([&] { CHECK_THROWS_AS(make_realtime(options), std::system_error); });
  options.strict = false;
  on_thread([&] { CHECK_NOTHROW(make_realtime(options)); });
  std::vector<std::string> warnings;
  options.warn = [&](const std::string& warning) { warnings.push_back(warning); };
  on_thread([&] { make_realtime(options); });
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("processors") != std::string::npos);
}

TEST_CASE("notices of a loop are warnings before it runs") {
  JointPidGains<2> gains = Q2d::pid_gains;
  gains[1].derivative = 1e5;
  Loop<Q2dSim, Pid> loop{Pid<Q2d>(gains)};
  SupervisedLoop<Q2dSim, Pid> supervised{Q2dSim(), Pid<Q2d>(gains)};
  std::vector<std::string> warnings;
  const RealtimeOptions options{
      .thread = {.priority = 0,
                 .lock_memory = false,
                 .warn = [&](const std::string& line) { warnings.push_back(line); }},
      .run = {.cycles = 1}};
  on_thread([&] { CHECK(run(loop, options).cycles == 1); });
  on_thread([&] { CHECK(run(supervised, options).cycles == 1); });
  REQUIRE(warnings.size() == 2);
  CHECK(warnings[0].find("joint 'elbow_active_joint' is unstable with the gains ") !=
        std::string::npos);
  CHECK(warnings[1] == warnings[0]);
}

TEST_CASE("options that make no sense are refused by name") {
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(make_realtime({.priority = 100}), Contains("priority 100"));
  CHECK_THROWS_WITH(make_realtime({.priority = -1}), Contains("priority -1"));
  CHECK_THROWS_WITH(make_realtime({.processors = {-1}}), Contains("processor -1"));
  rlimit stack{};
  if (getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur != RLIM_INFINITY) {
    CHECK_THROWS_WITH(make_realtime({.stack_size = stack.rlim_cur}), Contains("stack_size"));
  }
}

TEST_CASE("a loop runs in real time, as far as the system lets it, until a signal") {
  struct sigaction before{};
  REQUIRE(sigaction(SIGTERM, nullptr, &before) == 0);
  on_thread([] {
    Loop<Q2dSim, PidPlusGravity> loop;
    StopFlag stop;
    const StopOnSignal stop_on_signal(stop);
    CHECK_THROWS_AS(StopOnSignal(stop), std::logic_error);
    RealtimeOptions options{.run = {.stop = &stop}};
    options.thread.warn = [](const std::string&) {};
    const RunReport report = run(loop, options, [](auto&, const RunReport& r) {
      if (r.cycles == 20) static_cast<void>(std::raise(SIGTERM));
      return r.status == Status::ok;
    });
    CHECK(report.end == RunEnd::stopped);
    CHECK(report.cycles == 20);
    CHECK(report.latency.count() == 20);
  });
  struct sigaction after{};
  REQUIRE(sigaction(SIGTERM, nullptr, &after) == 0);
  CHECK(after.sa_handler == before.sa_handler);
}
