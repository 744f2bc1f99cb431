// SPDX-License-Identifier: Apache-2.0
// The runner on a simulated clock: what is due when, what is skipped, what is counted, how it ends.
#include <articula/articula.hpp>
#include <articula/hardware/mock/mock_hardware.hpp>
#include <articula/loop/realtime/hardware_clock.hpp>
#include <articula/loop/realtime/monotonic_clock.hpp>
#include <articula/loop/run.hpp>
#include <articula/loop/simulated_clock.hpp>
#include <articula/robots/q2d.hpp>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include "catch.hpp"
#include "numbers.hpp"

using namespace articula;
using namespace std::chrono_literals;
using std::chrono::nanoseconds;

namespace {

static_assert(LoopClock<SimulatedClock> && LoopClock<MonotonicClock> && !LoopClock<int>);
static_assert(RunnableLoop<Loop<Q2dSim, Bypass>> && !RunnableLoop<Q2dSim>);
static_assert(!PacingHardware<Q2dSim>);

/// A loop whose cycles take as long as a test says, and that notes when they begin.
struct TimedLoop {
  SimulatedClock* clock;
  std::vector<nanoseconds> takes{};  ///< per cycle; where there is none: no time
  std::vector<nanoseconds> starts{};
  std::uint64_t told = 0;
  int stops = 0;

  [[nodiscard]] double period() const noexcept { return 1e-3; }
  [[nodiscard]] Status update() noexcept {
    starts.push_back(clock->now());
    if (starts.size() <= takes.size()) clock->advance(takes[starts.size() - 1]);
    return Status::ok;
  }
  void missed_periods(std::uint64_t periods) noexcept { told += periods; }
  [[nodiscard]] Status stop() noexcept {
    ++stops;
    return Status::ok;
  }
};

std::vector<nanoseconds> ms(const std::vector<double>& values) {
  std::vector<nanoseconds> times;
  for (const double value : values) times.push_back(nanoseconds(std::llround(value * 1e6)));
  return times;
}

using MockLoop = Loop<MockHardware<Q2d>, PidPlusGravity>;

}  // namespace

TEST_CASE("cycles begin on a grid of periods, however long they take") {
  SimulatedClock clock;
  TimedLoop loop{&clock, ms({0.1, 0.9, 0.999, 1.0, 0})};
  const RunReport report = run(loop, clock, {.cycles = 5});
  CHECK(loop.starts == ms({1, 2, 3, 4, 5}));
  CHECK(report.end == RunEnd::finished);
  CHECK(report.cycles == 5);
  CHECK(report.overruns == 0);  // to end just when the next is due is in time
  CHECK(report.missed == 0);
  CHECK(report.latency.max() == 0ns);
  CHECK(report.period.min() == 1ms);
  CHECK(report.period.max() == 1ms);
  CHECK(report.period.count() == 4);
  CHECK(report.execution.max() == 1ms);
  CHECK(report.execution.min() == 0ns);
  CHECK(loop.stops == 1);
}

TEST_CASE("an overrun skips whole periods, and the grid stays") {
  SimulatedClock clock;
  TimedLoop loop{&clock, ms({0.5, 1.1, 3.7, 0.5})};
  const RunReport report = run(loop, clock, {.cycles = 5});
  CHECK(loop.starts == ms({1, 2, 4, 8, 9}));
  CHECK(report.overruns == 2);
  CHECK(report.missed == 1 + 3);
  CHECK(loop.told == 4);
  CHECK(report.latency.max() == 0ns);
}

TEST_CASE("the time of the function after each cycle counts as well") {
  SimulatedClock clock;
  TimedLoop loop{&clock, ms({0.4})};
  const RunReport report = run(loop, clock, {.cycles = 2}, [&](auto&, const RunReport& r) {
    CHECK(r.timing.update == (r.cycles == 1 ? 400us : 0us));
    clock.advance(700us);
    return true;
  });
  CHECK(report.overruns == 1);
  CHECK(report.execution.max() == 1100us);
}

TEST_CASE("waking up late is latency, and does not shift the grid") {
  struct LateClock : SimulatedClock {
    int waits = 0;
    nanoseconds wait_until(nanoseconds due) noexcept {
      SimulatedClock::wait_until(due);
      if (++waits == 2) advance(300us);
      return due;
    }
  } clock;
  TimedLoop loop{&clock};
  const RunReport report = run(loop, clock, {.cycles = 4});
  CHECK(loop.starts == ms({1, 2.3, 3, 4}));
  CHECK(report.latency.max() == 300us);
  CHECK(report.period.max() == 1300us);
  CHECK(report.period.min() == 700us);
  CHECK(report.overruns == 0);
}

TEST_CASE("a run ends with the overrun that is one too many") {
  SimulatedClock clock;
  TimedLoop loop{&clock, ms({2, 0, 2, 0, 2, 0})};
  const RunReport report = run(loop, clock, {.overruns = 2});
  CHECK(report.end == RunEnd::overruns);
  CHECK(report.cycles == 3);
  CHECK(report.overruns == 2);
  CHECK(loop.stops == 1);
}

TEST_CASE("a raised stop flag ends the run before the next cycle") {
  SimulatedClock clock;
  TimedLoop loop{&clock};
  StopFlag stop;
  const RunReport report = run(loop, clock, {.stop = &stop}, [&](auto&, const RunReport& r) {
    if (r.cycles == 7) stop.request();
    return true;
  });
  CHECK(report.end == RunEnd::stopped);
  CHECK(report.cycles == 7);
  CHECK(loop.stops == 1);

  stop.clear();
  CHECK(run(loop, clock, {.cycles = 2, .stop = &stop}).end == RunEnd::finished);
}

TEST_CASE("another thread ends the run") {
  Loop<Q2dSim, PidPlusGravity> loop;
  SimulatedClock clock;
  StopFlag stop;
  std::atomic<bool> going = false;
  std::thread other([&] {
    while (!going) std::this_thread::yield();
    stop.request();
  });
  const RunReport report = run(loop, clock, {.stop = &stop}, [&](auto&, const RunReport& r) {
    going = true;
    return r.status == Status::ok;
  });
  other.join();
  CHECK(report.end == RunEnd::stopped);
}

TEST_CASE("without a function a run ends with the first cycle that is not ok") {
  MockLoop loop(MockHardware<Q2d>({{MockFaultKind::goes_silent, 10, 1}}));
  SimulatedClock clock;
  const RunReport report = run(loop, clock);
  CHECK(report.end == RunEnd::declined);
  CHECK(report.status == Status::stale_state);
  CHECK(report.cycles == 10);
}

TEST_CASE("the last command of a Loop is the safe one, and the hardware is inactive then") {
  JointState<2> moving;
  moving.position = {0.3, -0.2};
  for (const bool well : {true, false}) {
    CAPTURE(well);
    MockHardware<Q2d> hardware(well ? std::vector<MockFault>{}
                                    : std::vector<MockFault>{{MockFaultKind::fails_to_read, 5}});
    hardware.set_state(moving);
    MockLoop loop(std::move(hardware));
    loop.reference().position = {1, 1};
    SimulatedClock clock;
    static_cast<void>(run(loop, clock, {.cycles = 10}));
    // The Q2D stands upright: its weight needs no effort.
    CHECK(loop.hardware().written().effort.isZero(0));
    CHECK_FALSE(loop.hardware().active());
  }
}

TEST_CASE("hardware that cannot be deactivated shows in the status") {
  struct Stubborn : MockHardware<Q2d> {
    using MockHardware<Q2d>::MockHardware;
    [[nodiscard]] Status deactivate() noexcept { return Status::hardware_fault; }
  };
  Loop<Stubborn, Pid> loop;
  SimulatedClock clock;
  const RunReport report = run(loop, clock, {.cycles = 3});
  CHECK(report.end == RunEnd::finished);
  CHECK(report.status == Status::hardware_fault);
}

TEST_CASE("an exception of the function ends control before it gets out") {
  MockLoop loop;
  SimulatedClock clock;
  CHECK_THROWS_AS(run(loop, clock, {},
                      [](auto&, const RunReport& r) -> bool {
                        if (r.cycles == 3) throw std::runtime_error("no more");
                        return true;
                      }),
                  std::runtime_error);
  CHECK_FALSE(loop.hardware().active());
}

TEST_CASE("the simulated arm moves on the clock as it does in a loop of one's own") {
  Loop<Q2dSim, PidPlusGravity> by_hand, on_clock;
  by_hand.reference().position = on_clock.reference().position = {-1, 1};
  for (int k = 0; k < 2000; ++k) REQUIRE(by_hand.update() == Status::ok);
  SimulatedClock clock;
  JointVector<2> last;
  static_cast<void>(run(on_clock, clock, {.cycles = 2000}, [&](auto& loop, const RunReport&) {
    last = loop.state().position;
    return true;
  }));
  CHECK(last == by_hand.state().position);
  CHECK(clock.now() == 2000ms);
}

TEST_CASE("a period that is none is refused") {
  struct Odd {
    double seconds;
    [[nodiscard]] double period() const { return seconds; }
    [[nodiscard]] Status update() noexcept { return Status::ok; }
    [[nodiscard]] Status stop() noexcept { return Status::ok; }
  };
  SimulatedClock clock;
  for (const double period : {0.0, -1.0, 1e-10, 1e4, support::not_a_number, support::infinity}) {
    Odd loop{period};
    CHECK_THROWS_AS(run(loop, clock), std::invalid_argument);
  }
}

namespace {

/// A bus whose cycles take as long as a test says; 0: no cycle comes, and the wait fails at once.
struct Bus {
  SimulatedClock* clock;
  std::vector<nanoseconds> periods;
  std::size_t next = 0;
  nanoseconds last{0};

  [[nodiscard]] Status wait_for_cycle(nanoseconds timeout) noexcept {
    const nanoseconds period = next < periods.size() ? periods[next++] : 1ms;
    if (period == 0ns) return Status::hardware_fault;
    if (last + period > clock->now() + timeout) {
      clock->advance(timeout);
      return Status::stale_state;
    }
    last += period;
    clock->wait_until(last);
    return Status::ok;
  }
};
static_assert(PacingHardware<Bus>);

}  // namespace

TEST_CASE("hardware can pace the loop, and what it leaves out is counted") {
  SimulatedClock clock;
  SECTION("with a slow clock of its own") {
    Bus bus{&clock, std::vector<nanoseconds>(1000, 1010us)};
    TimedLoop loop{&clock};
    HardwareClock pace(bus, clock, loop.period());
    const RunReport report = run(loop, pace, {.cycles = 1000});
    CHECK(loop.starts.back() == 1010ms);
    CHECK(report.missed == 0);
    CHECK(report.overruns == 0);
    CHECK(report.latency.max() == 0ns);
    CHECK(report.period.max() == 1010us);
  }
  SECTION("silent for some cycles: the loop goes on without it, half a period late") {
    Bus bus{&clock, ms({1, 1, 0, 0})};
    TimedLoop loop{&clock};
    HardwareClock pace(bus, clock, loop.period());
    const RunReport report = run(loop, pace, {.cycles = 4});
    CHECK(loop.starts == ms({1, 2, 3.5, 4.5}));
    CHECK(report.missed == 0);
    CHECK(report.latency.max() == 500us);
    CHECK(pace.timeouts() == 2);
  }
}

TEST_CASE("the monotonic clock does not wake up early") {
  MonotonicClock clock;
  for (int k = 0; k < 20; ++k) {
    const nanoseconds due = clock.now() + 200us;
    CHECK(clock.wait_until(due) == due);
    CHECK(clock.now() >= due);
  }
  CHECK(clock.wait_until(clock.now() - 1s) < clock.now());  // what has passed is not waited for
}
