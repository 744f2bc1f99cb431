// SPDX-License-Identifier: Apache-2.0
// A supervised loop at work between other threads: one posts references, one operates it, one
// receives the records. Built with the thread sanitizer, this is the proof that they do not race.
#include <articula/articula.hpp>
#include <articula/loop/run.hpp>
#include <articula/loop/simulated_clock.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>
#include <articula/recording/cycle_record.hpp>
#include <articula/recording/record_stream.hpp>
#include <articula/recording/recorder.hpp>
#include <articula/robots/q2d.hpp>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <thread>

#include "catch.hpp"

using namespace articula;

TEST_CASE("a supervised loop is operated, fed and watched by other threads") {
  using ArmLoop = SupervisedLoop<Q2dSim, PidPlusGravity>;
  using Record = CycleRecordOf<ArmLoop>;
  ArmLoop loop(SupervisionOptions{.reference_lifetime = 0.5});
  StopFlag stop;
  auto recorder = std::make_unique<Recorder<Record, 128>>(16);
  std::uint64_t received = 0;
  bool in_order = true;
  std::uint64_t last = 0;
  RecordStream<Record> stream({[&](const Record& record) {
    in_order = in_order && record.cycle > last;
    last = record.cycle;
    ++received;
  }});

  std::atomic<bool> done = false;
  std::thread poster([&] {
    JointReference<2> reference;
    for (int k = 0; !done; ++k) {
      reference.position.setConstant(0.2 * std::sin(0.001 * k));
      loop.post(reference);
      std::this_thread::yield();
    }
  });
  std::uint64_t activations = 0, dumps = 0;
  std::thread operator_thread([&] {
    while (activations < 8) {
      switch (loop.mode()) {
        case LoopMode::inactive:
          loop.request_activation();
          break;
        case LoopMode::active:
          ++activations;
          loop.request_deactivation();
          break;
        case LoopMode::fault:
          loop.acknowledge_fault();
          break;
        case LoopMode::starting:
          break;
      }
      recorder->trigger();
      if (recorder->frozen()) {
        recorder->for_each([&](const Record& record) { dumps += record.cycle > 0 ? 1U : 0U; });
        recorder->resume();
      }
      std::this_thread::yield();
    }
    stop.request();
  });

  SimulatedClock clock;
  std::uint64_t sent = 0;
  const RunReport report =
      run(loop, clock, {.stop = &stop}, [&](const ArmLoop& l, const RunReport& r) {
        const Record record = record_of(l, r);
        recorder->add(record, r.status != Status::ok && r.status != Status::inactive);
        sent += stream.push(record) ? 1U : 0U;
        return true;
      });
  done = true;
  poster.join();
  operator_thread.join();
  stream.close();
  CHECK(report.end == RunEnd::stopped);
  CHECK(loop.mode() == LoopMode::inactive);
  CHECK(in_order);
  CHECK(received == sent);
  CHECK(sent + stream.dropped() == report.cycles);
}
