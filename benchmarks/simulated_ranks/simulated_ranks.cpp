// SPDX-License-Identifier: Apache-2.0
// A sweep on many ranks of a cluster that SimGrid simulates: the messages and the rows are those of
// continue_sweep_with_mpi, and the runs only take their time.
//
//   simulated_ranks RUN_TIME CHUNKS
//
// RUN_TIME is the mean time of a run [s]. The time of each run is random within 20 % of it. CHUNKS
// is the number of chunks for each rank but rank 0, which computes no runs here. Prints the
// efficiency: the time of all runs in one rank, over the product of simulated time and number of
// ranks.
#include <articula/sim/random_draw.hpp>
#include <articula/sweep/jobs/mpi_sweep.hpp>

#include "../plain_rows.hpp"

#include <mpi.h>
#include <smpi/smpi.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <span>
#include <string_view>

namespace {

using namespace articula;

/// Its runs take simulated time, and no other.
struct Waiting : PlainRows {
  double run_time;  ///< mean [s]

  void run_together(std::span<SweepRow> rows) const {
    double time = 0;
    for (SweepRow& row : rows) {
      row.end = run(row.run(), row.metrics);
      time += run_time * (0.8 + 0.4 * detail::share_of_bits(row.seed));
    }
    smpi_execute_benched(time);
  }
};

/// In the place of ChunkThread: rank 0 computes nothing, since its thread would not be simulated.
struct NoChunks {
  [[nodiscard]] static bool wants_chunk() { return false; }
  [[nodiscard]] static bool owes_chunk() { return false; }
  [[nodiscard]] static std::optional<detail::ChunkThread::Outcome> take() { return {}; }
  static void give(const SweepChunk&) {}
  static void wait(std::chrono::microseconds most) { usleep(static_cast<unsigned>(most.count())); }
};

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const Waiting experiment{{}, std::atof(argv[1])};
  SweepOptions options;
  options.sampling.runs =
      std::strtoull(argv[2], nullptr, 10) * options.chunk * static_cast<std::uint64_t>(ranks - 1);
  const Samples samples(experiment.parameters(), options.sampling);
  const detail::ChunkPacking packing{samples, Waiting::metric_count};
  const double begin = MPI_Wtime();
  if (rank != 0) {
    const auto compute = [&](const SweepChunk& chunk) {
      return compute_chunk(experiment, samples, chunk, true);
    };
    detail::work_for_mpi(compute, packing, MPI_COMM_WORLD);
  } else {
    std::FILE* const file = std::tmpfile();
    SweepHooks hooks;
    hooks.lines = [&](std::string_view lines) { std::fwrite(lines.data(), 1, lines.size(), file); };
    SweepResult result(experiment.metrics(), options);
    detail::ChunkOrder order(options, samples, result, hooks, ranks);
    NoChunks none;
    detail::hand_out_for_mpi(order, packing, options.chunk, ranks, none, MPI_COMM_WORLD);
    order.rethrow();
    const double time = MPI_Wtime() - begin;
    const auto runs = static_cast<double>(options.sampling.runs);
    std::printf("%d ranks, %g ms a run: efficiency %.3f, %llu runs, mean of metric 1 %.17g\n",
                ranks, 1e3 * experiment.run_time, runs * experiment.run_time / (time * ranks),
                static_cast<unsigned long long>(result.runs()), result.summary("1").mean());
    std::fclose(file);
  }
  MPI_Finalize();
}
