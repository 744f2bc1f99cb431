// SPDX-License-Identifier: Apache-2.0
// The Quanser arm with CiA 402 drives. Another node sends SYNC, which paces the loop.
//
//   can_drives --protocol=cia402 --sync-period=0.001 &
//   q2d_paced_by_bus [<interface>] [<cycles>]    for example: q2d_paced_by_bus vcan0 2000
#include <articula/articula.hpp>
#include <articula/hardware/can/can_hardware.hpp>
#include <articula/hardware/can/socketcan.hpp>
#include <articula/hardware/cia402/cia402_codec.hpp>
#include <articula/loop/realtime/run_realtime.hpp>
#include <articula/loop/realtime/stop_on_signal.hpp>

#include "protocols.hpp"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

using namespace articula;

using Codec = Cia402Codec<Q2d, EffortCommand<2>, SyncProducer::another_node>;
using Arm = CanHardware<Q2d, Codec, SocketCan>;

int main(int argc, char** argv) try {
  Loop<Arm, PidPlusGravity> loop(
      Arm(Codec(examples::q2d_cia402), SocketCan(argc > 1 ? argv[1] : "can0")));
  loop.reference().position = {-1.0, 1.0};  // rad
  StopFlag stop;
  const StopOnSignal stop_on_signal(stop);
  RealtimeOptions options{.thread = {.priority = 80}, .run = {.cycles = 2000, .stop = &stop}};
  if (argc > 2) options.run.cycles = std::strtoull(argv[2], nullptr, 10);
  options.thread.warn = [](const std::string& refusal) { std::puts(refusal.c_str()); };
  const RunReport report = run(loop, options);  // paced by the bus

  std::printf("%d cycles, %s, %s, %d without SYNC, at %.3f %.3f rad\n",
              static_cast<int>(report.cycles), to_string(report.status).data(),
              describe(loop.hardware().fault()).c_str(),
              static_cast<int>(loop.hardware().statistics().unpaced), loop.state().position[0],
              loop.state().position[1]);  // 2000 cycles, ok, no fault, 0 without SYNC, ...
  return report.status == Status::ok ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "q2d_paced_by_bus: %s\n", error.what());
  return 2;
}
