// SPDX-License-Identifier: Apache-2.0
// How late a loop at 1 kHz wakes up, beside cyclictest (Debian: rt-tests), one after the other on
// the same machine at the same priority. Both count from when a cycle was due to when it began.
//
//   jitter [seconds] [priority]      default: 10 s at priority 99
#include <articula/articula.hpp>
#include <articula/loop/realtime/run_realtime.hpp>
#include <articula/robots/q2d.hpp>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

namespace {

using namespace articula;

double us(std::chrono::nanoseconds duration) { return static_cast<double>(duration.count()) / 1e3; }

void print(const char* name, const DurationHistogram& histogram) {
  std::printf("%-10s min %8.1f  mean %8.1f  50 %% %8.1f  99 %% %8.1f  99.9 %% %8.1f  max %8.1f\n",
              name, us(histogram.min()), us(histogram.mean()), us(histogram.percentile(0.5)),
              us(histogram.percentile(0.99)), us(histogram.percentile(0.999)), us(histogram.max()));
}

}  // namespace

int main(int argument_count, char** arguments) {
  const int seconds = argument_count > 1 ? std::atoi(arguments[1]) : 10;
  const int priority = argument_count > 2 ? std::atoi(arguments[2]) : 99;
  if (seconds < 1 || priority < 1 || priority > 99) {
    std::fputs("usage: jitter [seconds >= 1] [priority 1 .. 99]\n", stderr);
    return 2;
  }
  std::puts("cyclictest, in us:");
  std::fflush(stdout);
  const std::string cyclictest =
      "cyclictest --mlockall --quiet --threads=1 --interval=1000 --priority=" +
      std::to_string(priority) + " --loops=" + std::to_string(seconds * 1000);
  const int status = std::system(cyclictest.c_str());

  try {
    Loop<Q2dSim, PidPlusGravity> loop;
    const RunReport report =
        run(loop, {.thread = {.priority = priority},
                   .run = {.cycles = static_cast<std::uint64_t>(seconds) * 1000}});
    std::puts("Loop<Q2dSim, PidPlusGravity>, in us:");
    print("latency", report.latency);
    print("period", report.period);
    print("execution", report.execution);
    std::printf("%llu cycles, %llu overruns, %llu periods missed\n",
                static_cast<unsigned long long>(report.cycles),
                static_cast<unsigned long long>(report.overruns),
                static_cast<unsigned long long>(report.missed));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return status == 0 ? 0 : 1;
}
