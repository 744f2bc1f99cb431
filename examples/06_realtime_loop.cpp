// SPDX-License-Identifier: Apache-2.0
// The Q2D in real time: 1 kHz under SCHED_FIFO, supervised, operated and recorded. The run ends
// after two seconds or by Ctrl-C.
#include <articula/articula.hpp>
#include <articula/loop/realtime/run_realtime.hpp>
#include <articula/loop/realtime/stop_on_signal.hpp>
#include <articula/recording/csv_writer.hpp>
#include <articula/recording/record_stream.hpp>
#include <articula/remote/remote.hpp>
#include <articula/robots/q2d.hpp>

#include <cstdio>

using namespace articula;

int main() {
  // On the real arm: Q2dCan in place of Q2dSim.
  // `overruns` tolerates the overruns of a desktop machine; omit it for an arm.
  SupervisedLoop<Q2dSim, PidPlusGravity> arm(
      SupervisionOptions{.behaviour = SafeBehaviour::hold, .overruns = 1000});
  Remote remote(arm);  // View shows it in a browser
  const auto session = remote.connect("example", true);
  session->ask(remote::Activate{});
  session->ask(remote::Go{{{"shoulder_active_joint", -0.5}, {"elbow_active_joint", 0.5}}});
  session->release_controls();

  // Another thread writes the records, so that the loop never waits for the disk.
  CsvWriter<Q2d, EffortCommand<2>> csv("realtime_loop.csv");
  RecordStream stream(csv);
  StopFlag stop;
  const StopOnSignal ctrl_c(stop);
  const RealtimeOptions options{.thread = {.priority = 99}, .run = {.cycles = 2000, .stop = &stop}};
  const RunReport report = run(remote, options, remote.each(stream));
  stream.close();
  csv.close();

  const JointVector<2>& q = arm.state().position;
  std::printf("%s after %d cycles at (%.2f, %.2f) rad\n", to_string(report.end).data(),
              static_cast<int>(report.cycles), q[0], q[1]);
  // finished after 2000 cycles at (-0.50, 0.50) rad
  const auto us = [](auto duration) { return static_cast<double>(duration.count()) / 1e3; };
  std::printf("latency: median %.0f, 99 %% %.0f, longest %.0f us; %d overruns\n",
              us(report.latency.percentile(0.5)), us(report.latency.percentile(0.99)),
              us(report.latency.max()), static_cast<int>(report.overruns));
  return report.end == RunEnd::finished ? 0 : 1;
}
