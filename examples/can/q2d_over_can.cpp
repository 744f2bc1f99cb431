// SPDX-License-Identifier: Apache-2.0
// The Quanser arm, or can_drives, on a CAN bus, with the same controller as on Q2dSim.
//
//   q2d_over_can [<interface>] [<cycles>]        for example: q2d_over_can vcan0 2000
#include <articula/articula.hpp>
#include <articula/loop/realtime/run_realtime.hpp>
#include <articula/loop/realtime/stop_on_signal.hpp>
#include <articula/robots/q2d_can.hpp>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string_view>

using namespace articula;

int main(int argc, char** argv) try {
  Loop<Q2dCan, PidPlusGravity> loop(Q2dCan(argc > 1 ? argv[1] : "can0"));  // enables the drives
  loop.reference().position = {-1.0, 1.0};                                 // rad
  StopFlag stop;
  const StopOnSignal stop_on_signal(stop);
  const RunOptions options{.cycles = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 2000,
                           .stop = &stop};
  const RunReport report =
      run(loop, {.thread = {.priority = 80}, .run = options});  // and disables them

  const std::string_view status = to_string(report.status);
  const std::string_view cause = to_string(loop.hardware().fault().cause);
  std::printf("%llu cycles, %.*s, %.*s, at %.3f %.3f rad\n",  // 2000 cycles, ok, no fault, ...
              static_cast<unsigned long long>(report.cycles), static_cast<int>(status.size()),
              status.data(), static_cast<int>(cause.size()), cause.data(), loop.state().position[0],
              loop.state().position[1]);
  return report.status == Status::ok ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "q2d_over_can: %s\n", error.what());
  return 2;
}
