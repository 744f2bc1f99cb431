// SPDX-License-Identifier: Apache-2.0
/// @file A sweep for tests of resumption, MPI and memory:
///
///     sweeper <folder> <threads> [--kill <run> | --fail | --leave | --runs <number>]
///
/// Writes rows.csv and checkpoint, and prints the number of runs and the most memory that the
/// process had [kB]. With --kill, the process that computes this run kills itself, unless
/// <folder>/killed exists. With --leave, rank 0 does not come to the sweep. With --runs, there are
/// so many runs, each of which is short.
#include <articula/sweep/jobs/resumable_sweep.hpp>
#ifdef ARTICULA_TEST_MPI
#include <articula/sweep/jobs/mpi_session.hpp>
#include <articula/sweep/jobs/resumable_mpi_sweep.hpp>
#endif

#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <thread>
#include <vector>

using namespace articula;

namespace {

constexpr std::uint64_t never = ~std::uint64_t{0}, failing = 990;

struct Chaos {
  std::filesystem::path folder{};
  std::uint64_t kill = never;
  bool fails = false;
  int steps = 2000;

  [[nodiscard]] std::vector<SweepParameter> parameters() const {
    return {{"rate", "1", 3.6, 4}, {"start", "1", 0.1, 0.9}};
  }
  [[nodiscard]] std::vector<SweepMetric> metrics() const { return {{"last", "1"}, {"log", "1"}}; }
  [[nodiscard]] SimulationEnd run(const SweepRun& run, std::span<double> metrics) const {
    if (run.number == kill && !std::filesystem::exists(folder / "killed")) {
      std::ofstream(folder / "killed").close();
      std::this_thread::sleep_for(std::chrono::milliseconds(100));  // the others get ahead
      std::raise(SIGKILL);
    }
    if (fails && run.number == failing) throw std::runtime_error("it fails");
    double x = run.parameters[1], sum = 0;
    for (int k = 0; k < steps; ++k) {
      x = run.parameters[0] * x * (1 - x);
      sum += std::log(x);
    }
    metrics[0] = x;
    metrics[1] = run.number % 50 == 0 ? std::nan("") : sum;
    return x > 0.9 ? SimulationEnd::unstable : SimulationEnd::stable;
  }
};

}  // namespace

int main(int count, char** words) try {
  const std::vector<std::string> arguments(words, words + count);
  Chaos chaos{arguments.at(1)};
  SweepOptions options{.sampling = {.method = SamplingMethod::sobol, .runs = 3000, .seed = 4}};
  options.threads = std::stoi(arguments.at(2));
  options.chunk = 20;
  options.worst_metric = "log";
  if (count > 4 && arguments[3] == "--kill") chaos.kill = std::stoull(arguments[4]);
  chaos.fails = count > 3 && arguments[3] == "--fail";
  double interval = 0.001;
  if (count > 4 && arguments[3] == "--runs") {
    options.sampling.runs = std::stoull(arguments[4]);
    chaos.steps = 10;
    interval = 1;
  }
  const SweepFiles files{chaos.folder / "rows.csv", chaos.folder / "checkpoint", interval, "chaos"};
#ifdef ARTICULA_TEST_MPI
  const MpiSession mpi;
  if (count > 3 && arguments[3] == "--leave" && mpi.rank() == 0)
    throw std::runtime_error("no sweep");
  const SweepResult result = mpi.is_active() ? resumable_sweep_with_mpi(chaos, options, files)
                                             : resumable_sweep(chaos, options, files);
  if (mpi.rank() > 0) return 0;
#else
  const SweepResult result = resumable_sweep(chaos, options, files);
#endif
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%llu runs %ld kB\n", static_cast<unsigned long long>(result.runs()),
              usage.ru_maxrss);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "sweeper: %s\n", error.what());
  return 1;
}
