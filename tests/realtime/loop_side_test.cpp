// SPDX-License-Identifier: Apache-2.0
// The runner, the exchange with other threads, the recorder and the supervision do not touch the
// heap, whatever happens.
#include <articula/articula.hpp>
#include <articula/hardware/mock/mock_hardware.hpp>
#include <articula/loop/exchange/event_ring.hpp>
#include <articula/loop/exchange/latest_value.hpp>
#include <articula/loop/realtime/monotonic_clock.hpp>
#include <articula/loop/run.hpp>
#include <articula/loop/simulated_clock.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>
#include <articula/recording/cycle_record.hpp>
#include <articula/recording/record_stream.hpp>
#include <articula/recording/recorder.hpp>
#include <articula/robots/q2d.hpp>

#include <chrono>
#include <memory>

#include "allocation_guard.hpp"
#include "catch.hpp"
#include "numbers.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using articula::testing::heap_calls_in;
using Kind = MockFaultKind;

TEST_CASE("latest value and event ring do not touch the heap") {
  LatestValue<JointReference<7>> latest;
  EventRing<JointReference<7>, 8> ring;
  JointReference<7> reference;
  CHECK(heap_calls_in([&] {
          for (int k = 0; k < 100; ++k) {
            latest.write(reference);
            static_cast<void>(latest.update());
            ring.push(reference);
            if (k % 3 == 0) static_cast<void>(ring.pop(reference));
          }
        }) == 0);
}

TEST_CASE("a supervised loop does not touch the heap in any of its modes") {
  using MockLoop = SupervisedLoop<MockHardware<support::TiltedQ2d>, PidPlusGravity>;
  for (const auto behaviour :
       {SafeBehaviour::hold, SafeBehaviour::damp, SafeBehaviour::zero_effort}) {
    MockLoop loop(MockHardware<support::TiltedQ2d>({{Kind::fails_to_read, 50, 10},
                                                    {Kind::measures_nan, 100, 10, 1},
                                                    {Kind::goes_silent, 150, 10, 0},
                                                    {Kind::measures_velocity, 200, 10, 1, 50},
                                                    {Kind::fails_to_write, 250, 10}}),
                  {.behaviour = behaviour, .reference_lifetime = 0.02});
    JointReference<2> reference;
    int faults = 0;
    CHECK(heap_calls_in([&] {
            for (int k = 0; k < 1000; ++k) {
              if (loop.mode() == LoopMode::inactive) loop.request_activation();
              if (k % 40 < 15) loop.post(reference);
              if (k % 333 == 0) loop.missed_periods(2);
              reference.position[0] = k % 500 == 77 ? support::not_a_number : 0.1;
              static_cast<void>(loop.update());
              if (loop.mode() == LoopMode::fault && k % 10 == 0) {
                ++faults;
                loop.acknowledge_fault();
              }
            }
            static_cast<void>(loop.stop());
          }) == 0);
    CHECK(faults > 5);
  }
}

TEST_CASE("a run, with recording and overruns, does not touch the heap") {
  using ArmLoop = Loop<Q2dSim, PidPlusGravity>;
  using Record = CycleRecordOf<ArmLoop>;
  ArmLoop loop;
  auto recorder = std::make_unique<Recorder<Record, 64>>(8);
  RecordStream<Record, 256> stream({[](const Record&) {}});
  SimulatedClock clock;
  StopFlag stop;
  RunReport report;
  CHECK(heap_calls_in([&] {
          report = run(loop, clock, {.cycles = 2000, .stop = &stop},
                       [&](ArmLoop& l, const RunReport& r) {
                         l.reference().position.setConstant(r.cycles % 500 < 250 ? 0.5 : -0.5);
                         const Record record = record_of(l, r);
                         recorder->add(record, r.cycles == 300);
                         stream.push(record);
                         if (recorder->frozen()) recorder->resume();
                         if (r.cycles % 100 == 0) clock.advance(std::chrono::milliseconds(3));
                         return true;
                       });
        }) == 0);
  stream.close();
  CHECK(report.cycles == 2000);
  CHECK(report.overruns == 20);
}

TEST_CASE("a run on the system's clock does not touch the heap") {
  Loop<Q2dSim, PidPlusGravity> loop;
  MonotonicClock clock;
  CHECK(heap_calls_in([&] { static_cast<void>(run(loop, clock, {.cycles = 20})); }) == 0);
}
