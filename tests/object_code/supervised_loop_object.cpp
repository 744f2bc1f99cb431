// SPDX-License-Identifier: Apache-2.0
#include <articula/articula.hpp>
#include <articula/loop/exchange/event_ring.hpp>
#include <articula/loop/run_report.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>
#include <articula/recording/cycle_record.hpp>
#include <articula/recording/recorder.hpp>
#include <articula/robots/q2d.hpp>

using namespace articula;

using ArmLoop = SupervisedLoop<Q2dSim, PidPlusGravity>;
using Record = CycleRecordOf<ArmLoop>;

Status update(ArmLoop& loop) noexcept { return loop.update(); }

void post(ArmLoop& loop, const JointReference<2>& reference) noexcept { loop.post(reference); }

void record(const ArmLoop& loop, const RunReport& report, Recorder<Record, 1000>& recorder,
            EventRing<Record, 1024>& ring) noexcept {
  const Record now = record_of(loop, report);
  recorder.add(now, now.status != Status::ok);
  ring.push(now);
}

void count(RunReport& report) noexcept { report.execution.add(report.timing.update); }
