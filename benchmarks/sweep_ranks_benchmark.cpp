// SPDX-License-Identifier: Apache-2.0
// Sweeps on many ranks: what a row costs the rank that computes it and rank 0, and a model of both
// for more ranks than this machine has.
//
// The model has discrete events. A rank computes a chunk of 64 runs, whose time is random within 20 %
// of its mean, and sends it. Rank 0 takes chunks one after the other, for the measured time, and sends
// the next one. A message takes 20 us. Each rank has two chunks, as in continue_sweep_with_mpi. The
// runs that rank 0 computes are left out. The efficiency is that of all ranks, 1 for a rank alone.
#include <articula/sim/random_draw.hpp>
#include <articula/sweep/jobs/chunk_packing.hpp>
#include <articula/sweep/run_chunk.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace articula;

constexpr std::uint64_t chunk_size = 64;
constexpr std::size_t metric_count = 19;  // of a Q2D whose two joints step

/// Takes no time to run.
struct Instant {
  [[nodiscard]] std::vector<SweepParameter> parameters() const {
    return {{"a", "1", 0, 1}, {"b", "1", 0, 1}, {"c", "1", 0, 1}, {"d", "1", 0, 1}};
  }
  [[nodiscard]] std::vector<SweepMetric> metrics() const {
    std::vector<SweepMetric> all;
    for (std::size_t k = 0; k < metric_count; ++k) all.push_back({std::to_string(k), "1"});
    return all;
  }
  [[nodiscard]] SimulationEnd run(const SweepRun& run, std::span<double> metrics) const {
    for (std::size_t k = 0; k < metrics.size(); ++k) {
      metrics[k] = std::exp(run.parameters[k % 4] * static_cast<double>(k + 1));
    }
    return SimulationEnd::stable;
  }
};

/// The parts of the work beside the runs.
class Rows {
 public:
  Rows() : file_(std::tmpfile()) {
    for (std::uint64_t k = 0; k < 100; ++k) {
      computed_.push_back(compute_chunk(experiment_, samples_, {k * chunk_size, chunk_size}, true));
      packed_.push_back(packing_.pack(computed_.back()));
    }
  }
  Rows(const Rows&) = delete;
  Rows& operator=(const Rows&) = delete;
  ~Rows() { std::fclose(file_); }

  /// In the rank that computes a chunk: lines of CSV, and bytes for MPI.
  void write_lines() {
    ComputedChunk& chunk = computed_[next_++ % computed_.size()];
    chunk.lines.clear();
    for (const SweepRow& row : chunk.rows) append_row(chunk.lines, row);
    benchmark::DoNotOptimize(packing_.pack(chunk));
  }
  /// In rank 0.
  void collect() {
    const ComputedChunk chunk = packing_.unpack(packed_[next_++ % packed_.size()]);
    for (const SweepRow& row : chunk.rows) result_.add(row);
    std::fwrite(chunk.lines.data(), 1, chunk.lines.size(), file_);
    if (next_ % 1000 == 0) std::rewind(file_);
  }

 private:
  Instant experiment_{};
  Samples samples_{experiment_.parameters(), {.runs = 1'000'000}};
  detail::ChunkPacking packing_{samples_, metric_count};
  SweepResult result_{experiment_.metrics(), {}};
  std::vector<ComputedChunk> computed_{};
  std::vector<std::string> packed_{};
  std::size_t next_ = 0;
  std::FILE* file_;
};

/// The least time of rank 0 for a chunk [s]: other programs make it longer, never shorter.
double measured_collection() {
  static const double least = [] {
    Rows rows;
    double seconds = 1;
    for (int k = 0; k < 2000; ++k) {
      const auto begin = std::chrono::steady_clock::now();
      rows.collect();
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
      seconds = std::min(seconds, taken.count());
    }
    return seconds;
  }();
  return least;
}

/// @param ranks    that compute, and rank 0
/// @param run      time of a run [s]
/// @param collect  of rank 0 for a chunk [s]
double modelled_efficiency(std::size_t ranks, double run, double collect) {
  constexpr double message = 20e-6;
  const std::size_t chunks = 200 * ranks;
  std::size_t left = chunks;
  std::uint64_t drawn = 0;
  double work = 0;
  const auto time_of_chunk = [&] {
    const double share = detail::share_of_bits(detail::random_bits(1, drawn++));
    const double time = run * static_cast<double>(chunk_size) * (0.8 + 0.4 * share);
    work += time;
    return time;
  };
  using Arrival = std::pair<double, std::size_t>;  // at rank 0, and from which rank
  std::priority_queue<Arrival, std::vector<Arrival>, std::greater<>> arrivals;
  std::vector<double> second(ranks, 0);  // when the next chunk is with a rank; < 0: never
  for (std::size_t rank = 1; rank < ranks; ++rank) {
    arrivals.emplace(time_of_chunk() + message, rank);
    left -= 2;
  }
  double free = 0;  // when rank 0 is free
  while (!arrivals.empty()) {
    const auto [arrival, rank] = arrivals.top();
    arrivals.pop();
    free = std::max(free, arrival) + collect;
    if (second[rank] >= 0) {
      const double begin = std::max(arrival - message, second[rank]);
      arrivals.emplace(begin + time_of_chunk() + message, rank);
    }
    second[rank] = left > 0 ? free + message : -1;
    if (left > 0) --left;
  }
  return work / (static_cast<double>(ranks) * free);
}

void lines(benchmark::State& bench) {
  Rows rows;
  for (auto _ : bench) rows.write_lines();
  bench.SetItemsProcessed(bench.iterations() * static_cast<std::int64_t>(chunk_size));
}
void collection(benchmark::State& bench) {
  Rows rows;
  for (auto _ : bench) rows.collect();
  bench.SetItemsProcessed(bench.iterations() * static_cast<std::int64_t>(chunk_size));
}
void ranks(benchmark::State& bench) {
  const double run = 1e-6 * static_cast<double>(bench.range(1)), collect = measured_collection();
  double efficiency = 0;
  for (auto _ : bench) {
    efficiency = modelled_efficiency(static_cast<std::size_t>(bench.range(0)), run, collect);
  }
  bench.counters["efficiency"] = efficiency;
  bench.counters["collect_us_per_row"] = 1e6 * collect / static_cast<double>(chunk_size);
}

BENCHMARK(lines)->Name("sweep_ranks/lines_of_64_rows");
BENCHMARK(collection)->Name("sweep_ranks/collection_of_64_rows");
BENCHMARK(ranks)
    ->Name("sweep_ranks/model")
    ->ArgNames({"ranks", "run_us"})
    ->ArgsProduct({{16, 64, 256, 1024, 4096}, {100, 300, 1000, 10000}})
    ->Iterations(1);

}  // namespace
